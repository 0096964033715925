// Compares worlds with the scene they were built from (start.h), and `feather-bench peers`: all cases and speed scenes,
// in all engines.
#include "start.h"

#include "bench.h"
#include "memory.h"
#include "trial.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static int is_near(const double *is, const double *must, int32_t planar)
{
    const double tolerance = 1e-4; // m, at the origin: a float at 500 m has steps of 3e-5
    const double far = fabs(must[0]) + fabs(must[1]) + fabs(must[2]);
    const double allowed = fmax(tolerance, 1e-7 * far);
    return fabs(is[0] - must[0]) <= allowed && fabs(is[1] - must[1]) <= allowed &&
           (planar || fabs(is[2] - must[2]) <= allowed);
}

int bench_check_start(const bench_engine *engine, bench_world *world, const bench_scene *scene)
{
    const double mass_tolerance = 1e-5; // relative: float sums of float masses
    const int32_t count = engine->count_bodies(world);
    const double mass = engine->read_mass(world), expected = bench_scene_mass(scene);
    int status = 0;
    if (count != scene->body_count) {
        fprintf(stderr, "feather-bench: %s has %d bodies on %s instead of %d\n", engine->name, count, scene->name,
                scene->body_count);
        return -1;
    }
    if (!(fabs(mass - expected) <= mass_tolerance * expected)) {
        fprintf(stderr, "feather-bench: %s has %.9g kg on %s instead of %.9g\n", engine->name, mass, scene->name,
                expected);
        return -1;
    }
    bench_pose *poses = bench_allocate((size_t)count, sizeof *poses);
    engine->read_poses(world, poses);
    for (int32_t i = 0; i < count && status == 0; i++) {
        const double *is = poses[i].position, *must = scene->bodies[i].start.position;
        if (is_near(is, must, scene->planar)) continue;
        fprintf(stderr, "feather-bench: %s starts body %d of %s at (%g, %g, %g) instead of (%g, %g, %g)\n",
                engine->name, i, scene->name, is[0], is[1], is[2], must[0], must[1], must[2]);
        status = -1;
    }
    free(poses);
    return status;
}

typedef struct tally {
    int32_t built, wrong, refused;
} tally;

static void try_scene(tally *t, const bench_scene *scene)
{
    for (int32_t e = 0; e < bench_engine_count; e++) {
        const bench_engine *engine = bench_engines[e].engine;
        if (engine == NULL || (engine->planar_only && !scene->planar)) continue;
        bench_world *world = engine->create(scene, 1, 8);
        if (world == NULL) {
            t->refused++;
            continue;
        }
        t->built++;
        t->wrong += bench_check_start(engine, world, scene) != 0;
        engine->destroy(world);
    }
}

int bench_command_peers(int argc, char **argv)
{
    tally t = {0, 0, 0};
    bench_scene scene;
    (void)argc, (void)argv;
    for (int32_t i = 0; i < bench_case_count(); i++) {
        const bench_case *rule = bench_case_at(i);
        for (int32_t planar = rule->planar == BENCH_PLANAR_ONLY; planar <= (rule->planar != BENCH_NOT_PLANAR);
             planar++) {
            bench_trial_build(&scene, rule, planar);
            try_scene(&t, &scene);
            bench_scene_destroy(&scene);
        }
    }
    for (int32_t i = 0; i < bench_family_count; i++) {
        if (!bench_families[i].is_default || bench_scene_build(bench_families[i].name, &scene) != 0) continue;
        try_scene(&t, &scene);
        bench_scene_destroy(&scene);
    }
    printf("%d worlds as their scenes say, %d otherwise, %d refused\n", t.built - t.wrong, t.wrong, t.refused);
    return t.wrong != 0;
}
