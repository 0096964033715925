// Asks a scene after some steps a thousand rays, sweeps and overlaps (answers.h). A fingerprint is FNV-1a over what was
// hit and how far.
#include "answers.h"

#include "peers/peer.h"
#include "random.h"
#include "stats.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { QUERIES = 1000, STEPS = 120, SUBSTEPS = 4, ROUNDS = 12, BLOCKS = 10, KINDS = 3 };
static const uint64_t SEED = 0x1234567u, FNV_START = 0xcbf29ce484222325u, FNV_PRIME = 0x100000001b3u;

const char *const bench_answer_names[BENCH_ANSWER_SETS] = {"queries:bowl-300", "queries:terrain-128"};
const char *const bench_answer_phases[] = {"ray", "sweep", "overlap", NULL};

static bench_probe next_probe(uint64_t *state)
{
    bench_probe p = {.shape = bench_make_box(0.4f, 0.3f, 0.5f), .rotation = {0.0, 0.0, 0.0, 1.0}};
    for (int k = 0; k < 3; k++) p.way.origin[k] = (k == 1 ? 10.0 : 12.0) * bench_random(state) - (k == 1 ? 0.0 : 6.0);
    for (int k = 0; k < 3; k++) p.way.translation[k] = 12.0 * bench_random(state) - (k == 1 ? 10.0 : 6.0);
    return p;
}

static void add_word(uint64_t *print, uint64_t word) { *print = (*print ^ word) * FNV_PRIME; }

// Fractions as floats: queries answer in doubles, whose last bits are of no interest
static void ask(bench_world *world, int32_t kind, const bench_probe *p, uint64_t *print)
{
    double fraction = 0.0;
    float narrow;
    uint32_t bits;
    int32_t hit;
    if (kind == 0)
        hit = bench_feather.raycast(world, &p->way, &fraction);
    else if (kind == 1)
        hit = bench_feather.sweep(world, p, &fraction);
    else
        hit = bench_feather.overlap(world, p);
    narrow = (float)fraction;
    memcpy(&bits, &narrow, sizeof bits);
    add_word(print, (uint64_t)(uint32_t)hit << 32 | bits);
}

// Time of a block of queries in units of the calibration loop beside it, each at its fastest of all rounds: another
// program, or the other thread of the core, slows some rounds, seldom all.
static void ask_all(bench_world *world, double (*calibrate)(void), bench_reference *out)
{
    const int32_t rounds = calibrate != NULL ? ROUNDS : 1;
    for (int32_t kind = 0; kind < KINDS; kind++) {
        double least[BLOCKS], unit = HUGE_VAL;
        for (int32_t block = 0; block < BLOCKS; block++) least[block] = HUGE_VAL;
        for (int32_t round = 0; round < rounds; round++) {
            uint64_t state = SEED, print = FNV_START;
            for (int32_t block = 0; block < BLOCKS; block++) {
                if (calibrate != NULL) unit = fmin(unit, calibrate());
                const double start = bench_cpu_ms();
                for (int32_t i = 0; i < QUERIES / BLOCKS; i++) {
                    const bench_probe p = next_probe(&state);
                    ask(world, kind, &p, &print);
                }
                least[block] = fmin(least[block], bench_cpu_ms() - start);
            }
            if (round == 0) add_word(&out->quick, print);
        }
        for (int32_t block = 0; block < BLOCKS; block++)
            out->phases[kind] += least[block] / (calibrate != NULL ? unit : 1.0);
    }
}

int bench_answers(int32_t set, double (*calibrate)(void), bench_reference *out)
{
    bench_scene scene;
    memset(out, 0, sizeof *out);
    snprintf(out->scene, sizeof out->scene, "%s", bench_answer_names[set]);
    if (bench_scene_build(strchr(bench_answer_names[set], ':') + 1, &scene) != 0) return -1;
    bench_world *world = bench_feather.create(&scene, 1, SUBSTEPS);
    int status = world == NULL ? -1 : 0;
    for (int32_t i = 0; i < STEPS && status == 0; i++) status = bench_feather.step(world, scene.dt);
    if (status == 0) ask_all(world, calibrate, out);
    // Times of sweeps along terrain swing between runs by more than any regression would: rays alone there
    out->phase_count = set == 0 ? KINDS : 1;
    out->full = out->quick;
    out->passed = status == 0;
    if (world != NULL) bench_feather.destroy(world);
    bench_scene_destroy(&scene);
    return status;
}
