// What the calls cost in C that bindings/*/tests/cost.* measure in other languages, ns a call: to compare with.
#include "feather.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { CALLS = 2000000, ROUNDS = 5, BODIES = 10000, READS = 100 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

// The best of some rounds, so that what else runs on the machine counts less.
#define MEASURE(NAME, COUNT, CALL)                                  \
    do {                                                            \
        double best = 1e30;                                         \
        for (int round = 0; round < ROUNDS; ++round) {              \
            double start = now();                                   \
            for (int i = 0; i < (COUNT); ++i) failed |= (CALL) < 0; \
            double spent = (now() - start) / (COUNT);               \
            if (spent < best) best = spent;                         \
        }                                                           \
        printf("%s %.2f\n", NAME, best);                            \
    } while (0)

int main(void)
{
    static fe_body bodies[BODIES];
    static float floats[BODIES * 7];
    fe_world *world;
    fe_body body;
    fe_shape shape;
    fe_geometry ball;
    fe_transform transform;
    fe_hit hit;
    fe_query_filter but_one;
    fe_vec3 velocity = fe_make_vec3(0, 0, 0);
    fe_dvec3 origin = fe_make_dvec3(0, 9, 0), down = fe_make_dvec3(0, -20, 0), zero = fe_make_dvec3(0, 0, 0);
    int failed = 0;
    if (fe_world_create(NULL, &world) != FE_OK) return 1;
    fe_geometry_sphere(&ball, 0.5f);
    if (fe_body_create(world, NULL, &body) != FE_OK || fe_shape_create(world, body, NULL, &ball, &shape) != FE_OK)
        return 1;
    MEASURE("is_valid", CALLS, fe_body_is_valid(world, body));
    MEASURE("get_transform", CALLS, fe_body_get_transform(world, body, &transform));
    MEASURE("set_velocity", CALLS, fe_body_set_linear_velocity(world, body, &velocity));
    MEASURE("raycast", CALLS / 10, fe_world_raycast(world, &origin, &down, NULL, &hit));
    if (fe_body_create(world, NULL, &bodies[0]) != FE_OK) return 1;
    fe_query_filter_init(&but_one, sizeof but_one);
    but_one.excluded = bodies;
    but_one.excluded_count = 1;
    MEASURE("raycast_excluding_one", CALLS / 10, fe_world_raycast(world, &origin, &down, &but_one, &hit));
    for (int i = 1; i < BODIES; ++i)
        if (fe_body_create(world, NULL, &bodies[i]) != FE_OK) return 1;
    MEASURE("bulk_10000_transforms", READS, fe_world_get_transforms_f32(world, bodies, &zero, floats, 0, BODIES));
    return failed | (fe_world_destroy(world) != FE_OK);
}
