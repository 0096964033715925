// golden.h - the golden hashes of scripts, and runs that are held against them; what the programs that compare hashes
// share.
#ifndef FE_TESTS_GOLDEN_H
#define FE_TESTS_GOLDEN_H
#include "fe_test.h"
#include "support/play.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GOLDEN "tests/determinism/golden.txt"
enum { MOST_LINES = 64 };

typedef struct golden {
    char script[16];
    int step;
    uint64_t hash; // of the world
    uint64_t told; // of all events, moved bodies and rays up to here
} golden;

static golden lines[MOST_LINES];
static int32_t line_count;

static inline void read_golden(void)
{
    FILE *file = fopen(GOLDEN, "r");
    if (!file) return;
    while (line_count < MOST_LINES) {
        golden *g = lines + line_count;
        if (fscanf(file, "%15s %d %" SCNx64 " %" SCNx64, g->script, &g->step, &g->hash, &g->told) != 4) break;
        ++line_count;
    }
    fclose(file);
}

static inline const golden *find_golden(const char *script, int32_t step)
{
    for (int32_t i = 0; i < line_count; ++i)
        if (lines[i].step == step && strcmp(lines[i].script, script) == 0) return lines + i;
    return NULL;
}

// ---- worlds --------------------------------------------------------------------------------------------------------

// NULL: this CPU has no such set
static inline fe_world *new_world(int32_t simd, int32_t workers)
{
    fe_world_def def;
    fe_world *world = NULL;
    fe_world_def_init(&def, sizeof def);
    def.simd = simd;
    def.worker_count = workers;
    fe_result result = fe_world_create(&def, &world);
    if (result == FE_ERROR_UNSUPPORTED) return NULL;
    FE_TRUE(result == FE_OK);
    return world;
}

static inline void compare(const play *p, const script *s, int32_t workers)
{
    const golden *g = find_golden(s->name, p->step);
    if (!g) fail_msg("no golden hash of %s at step %d: write it with 'test_determinism update'", s->name, (int)p->step);
    if (g->hash == play_hash(p) && g->told == play_told(p)) return;
    fail_msg("%s, %d workers, step %d: hash %016" PRIx64 " and told %016" PRIx64 ", golden are %016" PRIx64
             " and %016" PRIx64
             "\n(if results were meant to change: run 'test_determinism update' and commit the file)",
             s->name, (int)workers, (int)p->step, play_hash(p), play_told(p), g->hash, g->told);
}

static inline void run(const script *s, int32_t simd, int32_t workers, int32_t steps)
{
    play p;
    play_begin(&p, new_world(simd, workers));
    while (p.step < steps) {
        play_until(&p, s, p.step + PLAY_CHECK_STEPS);
        compare(&p, s, workers);
    }
    assert_int_equal(p.errors, 0);
    fe_world_destroy(p.world);
}

// A script and the set of kernels it runs with
typedef struct condition {
    const script *script;
    int32_t simd;
} condition;

#define GOLDEN_TEST(script, name, set)                                                                 \
    {                                                                                                  \
#script "_has_the_golden_hashes_with_" name, gives_the_golden_hashes, NULL, NULL, &(condition) \
        {                                                                                              \
            &script_##script, set                                                                      \
        }                                                                                              \
    }

// Skips where this CPU has no such set.
static inline void need_simd(int32_t simd)
{
    fe_world *probe = new_world(simd, 1);
    if (!probe) {
        print_message("*** NOT TESTED: SIMD set %d is not on this CPU ***\n", (int)simd);
        skip();
    }
    fe_world_destroy(probe);
}

#endif
