// `feather-bench queries [SCENE]...`: rays, sweeps and overlaps in Feather and Bullet, by turns, on the same scenes,
// after their timed steps; then what building meshes and hulls costs (the scene "builds").
//
// Times are of the processor, one thread. What holds are the ratios of one run; the hits of both stand beside them, for
// a fast answer must be the same answer. Bullet counts in floats, sweeps stop some millimetres early (its margins), so
// that some hits differ. Writes build/queries.csv.
#include "bench.h"

#include "builds.h"
#include "memory.h"
#include "options.h"
#include "peers/peer.h"
#include "random.h"
#include "report.h"
#include "svg.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COUNT = 20000, BLOCK = 500, PLOTTED = 16 };

typedef enum kind { RAY, SPHERE, CAPSULE, BOX, OVERLAP, KINDS } kind;
static const char *const kind_names[KINDS] = {"ray", "sweep of a sphere", "sweep of a capsule", "sweep of a box",
                                              "overlap"};

typedef struct side {
    const bench_engine *engine;
    bench_world *world;
    double create_us, remove_us; // a body
    double ms[KINDS];
    int32_t hits[KINDS];
    double fractions[KINDS]; // sum over the hits
} side;

enum { SIDES = 2 };

// ---- what is asked -------------------------------------------------------------------------------------------------

// The rays of the speed table in the middle of the scene; where it is wide, the same about places all over it.
static bench_ray make_way(const bench_scene *scene, uint64_t *state, uint64_t *places)
{
    bench_ray way;
    double to[3], half = fmax(scene->query_half - 20.0, 0.0);
    for (int axis = 0; axis < 3; axis++)
        way.origin[axis] = axis == 1 ? 30.0 * bench_random(state) : 40.0 * bench_random(state) - 20.0;
    for (int axis = 0; axis < 3; axis++)
        to[axis] = axis == 1 ? 30.0 * bench_random(state) - 5.0 : 40.0 * bench_random(state) - 20.0;
    for (int axis = 0; axis < 3; axis++) way.translation[axis] = to[axis] - way.origin[axis];
    for (int axis = 0; axis < 3 && half > 0.0; axis += 2) way.origin[axis] += half * (2.0 * bench_random(places) - 1.0);
    return way;
}

static bench_probe *make_probes(const bench_scene *scene, kind of)
{
    bench_probe *probes = bench_allocate(COUNT, sizeof *probes);
    uint64_t state = 0x1234567u, places = 0x7654321u, turns = 0x2468aceu;
    const double overlap_heights = 0.2; // of a way's start: where the bodies are
    for (int32_t i = 0; i < COUNT; i++) {
        bench_probe *p = &probes[i];
        p->way = make_way(scene, &state, &places);
        p->shape = bench_make_box(0.4f, 0.3f, 0.5f);
        if (of == SPHERE) p->shape = bench_make_sphere(scene->query_radius);
        if (of == CAPSULE) p->shape = bench_make_capsule(0.3f, 0.3f);
        if (of == OVERLAP)
            p->shape = i % 2 ? bench_make_box(1.0f, 1.0f, 1.0f) : bench_make_sphere(1.0f),
            p->way.origin[1] *= overlap_heights;
        double square = 0.0;
        for (int k = 0; k < 4; k++)
            p->rotation[k] = 2.0 * bench_random(&turns) - 1.0, square += p->rotation[k] * p->rotation[k];
        for (int k = 0; k < 4; k++) p->rotation[k] /= sqrt(square);
    }
    return probes;
}

static void ask_block(side *s, kind of, const bench_probe *probes)
{
    double start = bench_cpu_ms();
    for (int32_t i = 0; i < BLOCK; i++) {
        double fraction = 0.0;
        if (of == RAY)
            s->hits[of] += s->engine->raycast(s->world, &probes[i].way, &fraction);
        else if (of == OVERLAP)
            s->hits[of] += s->engine->overlap(s->world, &probes[i]);
        else
            s->hits[of] += s->engine->sweep(s->world, &probes[i], &fraction);
        s->fractions[of] += fraction;
    }
    s->ms[of] += bench_cpu_ms() - start;
}

static void ask_all(side sides[SIDES], const bench_scene *scene)
{
    for (kind of = RAY; of < KINDS; of++) {
        bench_probe *probes = make_probes(scene, of);
        for (int32_t done = 0; done < COUNT; done += BLOCK) {
            for (int32_t i = 0; i < SIDES; i++) {
                if (sides[i].engine != NULL) ask_block(&sides[i], of, probes + done);
            }
        }
        free(probes);
    }
}

// ---- a scene -------------------------------------------------------------------------------------------------------

static int play(side *s, const bench_scene *scene)
{
    double start = bench_cpu_ms();
    s->world = s->engine->create(scene, 1, s->engine->has_workers ? 4 : 0);
    s->create_us = 1e3 * (bench_cpu_ms() - start) / scene->body_count;
    if (s->world == NULL) return -1;
    for (int32_t i = 0; i < scene->warm_up_steps + scene->timed_steps; i++) {
        if (s->engine->step(s->world, scene->dt) != 0) return -1;
    }
    return 0;
}

static void take_all_away(side *s, const bench_scene *scene)
{
    double start = bench_cpu_ms();
    for (int32_t i = 0; i < scene->body_count; i++) s->engine->take_away(s->world, i);
    s->remove_us = 1e3 * (bench_cpu_ms() - start) / scene->body_count;
}

static void print_line(const char *what, double ours, double theirs)
{
    printf("  %-20s %10.3f", what, ours);
    if (theirs > 0.0) printf(" %10.3f %8.2f", theirs, theirs / ours);
}

// For the plot: Bullet's time over Feather's, by kind
static double plotted[KINDS][PLOTTED];
static char plotted_names[PLOTTED][64];
static int32_t plotted_count;

static int draw(const char *path)
{
    const char *labels[PLOTTED];
    bench_series series[KINDS];
    for (int32_t i = 0; i < plotted_count; i++) labels[i] = plotted_names[i];
    for (kind of = RAY; of < KINDS; of++) series[of] = (bench_series){kind_names[of], NULL, plotted[of], plotted_count};
    return plotted_count > 0
               ? bench_svg_bars(path, "Time of a query, Bullet / Feather", labels, plotted_count, series, KINDS)
               : 0;
}

static void print_scene(const bench_scene *scene, const side sides[SIDES], FILE *csv)
{
    const int32_t plot = plotted_count < PLOTTED && sides[1].engine != NULL ? plotted_count++ : -1;
    if (plot >= 0) snprintf(plotted_names[plot], sizeof plotted_names[plot], "%s", scene->name);
    printf("\n%s, us each      %16s %10s %8s %9s %9s %10s %10s\n", scene->name, "feather", "bullet", "bullet/", "hits",
           "bullet", "fraction", "bullet");
    for (kind of = RAY; of < KINDS; of++) {
        double us[SIDES], mean[SIDES];
        for (int32_t i = 0; i < SIDES; i++) {
            us[i] = 1e3 * sides[i].ms[of] / COUNT;
            mean[i] = sides[i].hits[of] > 0 ? sides[i].fractions[of] / sides[i].hits[of] : 0.0;
        }
        print_line(kind_names[of], us[0], us[1]);
        if (plot >= 0) plotted[of][plot] = us[1] / us[0];
        printf(" %9d %9d %10.6f %10.6f\n", sides[0].hits[of], sides[1].hits[of], mean[0], mean[1]);
        fprintf(csv, "%s,%s,%.6f,%.6f,%d,%d\n", scene->name, kind_names[of], us[0], us[1], sides[0].hits[of],
                sides[1].hits[of]);
    }
    if (scene->body_count < COUNT) return;
    print_line("body added", sides[0].create_us, sides[1].create_us);
    printf("\n");
    print_line("body removed", sides[0].remove_us, sides[1].remove_us);
    printf("\n");
    fprintf(csv, "%s,body added,%.6f,%.6f,,\n%s,body removed,%.6f,%.6f,,\n", scene->name, sides[0].create_us,
            sides[1].create_us, scene->name, sides[0].remove_us, sides[1].remove_us);
}

static int run_scene(const char *name, FILE *csv)
{
    bench_scene scene;
    if (strcmp(name, "builds") == 0) {
        bench_time_builds(csv);
        return 0;
    }
    if (bench_scene_build(name, &scene) != 0) {
        fprintf(stderr, "feather-bench: no scene \"%s\"; try: feather-bench list\n", name);
        return -1;
    }
    side sides[SIDES] = {{.engine = &bench_feather}};
    for (int32_t i = 0; i < bench_engine_count; i++) {
        if (strcmp(bench_engines[i].name, "bullet") == 0) sides[1].engine = bench_engines[i].engine;
    }
    if (sides[1].engine == NULL) fprintf(stderr, "*** bullet IS MISSING: install libbullet-dev and build again ***\n");
    int status = 0;
    for (int32_t i = 0; i < SIDES; i++) status |= sides[i].engine != NULL ? play(&sides[i], &scene) : 0;
    if (status == 0) {
        ask_all(sides, &scene);
        for (int32_t i = 0; i < SIDES; i++) {
            if (sides[i].engine != NULL) take_all_away(&sides[i], &scene);
        }
        print_scene(&scene, sides, csv);
    }
    for (int32_t i = 0; i < SIDES; i++) {
        if (sides[i].world != NULL) sides[i].engine->destroy(sides[i].world);
    }
    bench_scene_destroy(&scene);
    return status;
}

int bench_command_queries(int argc, char **argv)
{
    static const char *const usual[] = {"rest-500",     "many-14",  "bowl-1500",      "level-100000",
                                        "terrain-1024", "mesh-256", "hullcloud-2000", "builds"};
    FILE *csv = fopen("build/queries.csv", "w");
    if (csv == NULL) {
        fprintf(stderr, "feather-bench: cannot write build/queries.csv\n");
        return 1;
    }
    fprintf(csv, "scene,query,feather_us,bullet_us,feather_hits,bullet_hits\n");
    int status = 0;
    for (int i = 0; i < argc; i++) status |= run_scene(argv[i], csv);
    for (size_t i = 0; i < sizeof usual / sizeof *usual && argc == 0; i++) status |= run_scene(usual[i], csv);
    fclose(csv);
    status |= draw("build/queries.svg");
    return status == 0 ? 0 : 1;
}
