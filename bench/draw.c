// `feather-bench draw [BODIES]`: how long the calls that draw take, in a heap of boxes, spheres and capsules that has
// fallen for a second. The least of 50 calls, us; vertices go to an array that has room for all.
#include "bench.h"

#include "boxes.h"
#include "feather.h"
#include "memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { USUAL_BODIES = 5000, STEPS = 60, ROUNDS = 50 };

static double now(void) // us
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e6 * (double)t.tv_sec + 1e-3 * (double)t.tv_nsec;
}

static fe_geometry form_of(int32_t i)
{
    fe_geometry form;
    if (i % 3 == 0) fe_geometry_box(&form, 0.4f, 0.3f, 0.5f);
    if (i % 3 == 1) fe_geometry_sphere(&form, 0.4f);
    if (i % 3 == 2) fe_geometry_capsule(&form, 0.3f, 0.3f);
    return form;
}

static fe_world *heap_of(int32_t bodies)
{
    enum { SIDE = 20 };
    fe_world *world = NULL;
    fe_geometry form;
    if (fe_world_create(NULL, &world) != FE_OK) return NULL;
    fe_geometry_plane(&form, 0.0f, 1.0f, 0.0f, 0.0f);
    bench_add_body(world, FE_BODY_STATIC, 0.0, 0.0, 0.0, &form);
    for (int32_t i = 0; i < bodies; ++i) {
        form = form_of(i);
        bench_add_body(world, FE_BODY_DYNAMIC, 1.2 * (i % SIDE), 0.6 + 1.2 * (i / SIDE / SIDE), 1.2 * (i / SIDE % SIDE),
                       &form);
    }
    for (int32_t i = 0; i < STEPS; ++i)
        if (fe_world_step(world, 1.0f / 60.0f) != FE_OK) return NULL;
    return world;
}

typedef int32_t draw_call(const fe_world *world, const fe_draw_options *options, fe_draw_vertex *out, uint32_t stride,
                          int32_t capacity);

static void time_vertices(const fe_world *world, const char *name, draw_call *call, uint32_t parts)
{
    fe_draw_options options;
    fe_draw_options_init(&options, sizeof options);
    options.parts = parts;
    int32_t count = call(world, &options, NULL, 0, 0);
    fe_draw_vertex *out = bench_allocate((size_t)count, sizeof *out);
    double draws = 1e30, counts = 1e30;
    for (int32_t i = 0; i < ROUNDS; ++i) {
        double start = now();
        call(world, &options, out, sizeof *out, count);
        double middle = now();
        call(world, &options, NULL, 0, 0);
        double end = now();
        if (middle - start < draws) draws = middle - start;
        if (end - middle < counts) counts = end - middle;
    }
    printf("  %-26s %9d vertices %9.1f us, counted in %8.1f us\n", name, count, draws, counts);
    free(out);
}

static void time_instances(const fe_world *world)
{
    int32_t count = fe_world_draw_instances(world, NULL, NULL, 0, 0);
    fe_draw_instance *out = bench_allocate((size_t)count, sizeof *out);
    double least = 1e30;
    for (int32_t i = 0; i < ROUNDS; ++i) {
        double start = now();
        fe_world_draw_instances(world, NULL, out, sizeof *out, count);
        double end = now();
        if (end - start < least) least = end - start;
    }
    printf("  %-26s %9d          %9.1f us\n", "instances", count, least);
    free(out);
}

int bench_command_draw(int argc, char **argv)
{
    int32_t bodies = argc > 0 ? atoi(argv[0]) : USUAL_BODIES;
    fe_world *world = bodies > 0 ? heap_of(bodies) : NULL;
    if (world == NULL) {
        fprintf(stderr, "feather-bench: draw [BODIES]: %s\n", bodies > 0 ? fe_last_error() : "at least one");
        return 2;
    }
    printf("heap of %d\n", bodies);
    time_instances(world);
    time_vertices(world, "triangles of shapes", fe_world_draw_triangles, FE_DRAW_SHAPES | FE_DRAW_ISLANDS);
    time_vertices(world, "lines of shapes", fe_world_draw_lines, FE_DRAW_SHAPES | FE_DRAW_ISLANDS);
    time_vertices(world, "lines of contacts, forces", fe_world_draw_lines, FE_DRAW_CONTACTS | FE_DRAW_FORCES);
    time_vertices(world, "points of contacts", fe_world_draw_points, FE_DRAW_CONTACTS);
    time_vertices(world, "bounds and trees", fe_world_draw_lines, FE_DRAW_BOUNDS | FE_DRAW_TREES);
    fe_world_destroy(world);
    return 0;
}
