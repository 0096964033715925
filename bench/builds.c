// Meshes of hills and hulls of points in a ball, built by the engines in turns (builds.h). Medians of the processor's
// time. A hull of Feather keeps the 64 vertices that change its form least; Bullet's keeps all.
#include "builds.h"

#include "memory.h"
#include "peers/peer.h"
#include "random.h"
#include "stats.h"

#include <stdlib.h>
#include <string.h>

enum { SIDES = 2, MOST_RUNS = 200 };

typedef struct series {
    const bench_engine *engine;
    double ms[MOST_RUNS];
    int64_t bytes; // of the last
} series;

static int find_sides(series sides[SIDES])
{
    int count = 0;
    sides[count++].engine = &bench_feather;
    for (int32_t i = 0; i < bench_engine_count; i++) {
        const bench_engine *engine = bench_engines[i].engine;
        if (engine != NULL && strcmp(bench_engines[i].name, "bullet") == 0) sides[count++].engine = engine;
    }
    return count;
}

// `pieces`: triangles or hulls that a run builds
static void print(const char *what, series *sides, int count, int32_t runs, double pieces, FILE *csv)
{
    double ns[SIDES] = {0.0, 0.0}, bytes[SIDES] = {0.0, 0.0};
    for (int i = 0; i < count; i++) {
        ns[i] = 1e6 * bench_stats_of(sides[i].ms, runs).median / pieces;
        bytes[i] = (double)sides[i].bytes / pieces;
    }
    printf("  %-28s %10.1f", what, ns[0]);
    if (count > 1) printf(" %10.1f %8.2f", ns[1], ns[1] / ns[0]);
    printf(" %12.1f", bytes[0]);
    if (count > 1) printf(" %10.1f", bytes[1]);
    printf("\n");
    fflush(stdout);
    fprintf(csv, "build,%s,%.6f,%.6f,,\n", what, 1e-3 * ns[0], 1e-3 * ns[1]);
}

static void time_mesh(const char *what, int32_t cells, int32_t runs, FILE *csv)
{
    series sides[SIDES];
    const int count = find_sides(sides);
    bench_mesh mesh = bench_hills(cells);
    for (int32_t r = 0; r < runs; r++) {
        for (int i = 0; i < count; i++) sides[i].ms[r] = sides[i].engine->build_mesh(&mesh, &sides[i].bytes);
    }
    print(what, sides, count, runs, mesh.triangle_count, csv);
    bench_mesh_free(&mesh);
}

// Uniform in the ball of radius 1 m
static void draw_points(uint64_t *state, float *points, int32_t count)
{
    for (int32_t i = 0; i < count;) {
        double square = 0.0;
        for (int k = 0; k < 3; k++) {
            const double x = 2.0 * bench_random(state) - 1.0;
            points[3 * i + k] = (float)x;
            square += x * x;
        }
        if (square <= 1.0) i++;
    }
}

static void time_hull(const char *what, int32_t points, int32_t runs, FILE *csv)
{
    series sides[SIDES];
    const int count = find_sides(sides);
    float *cloud = bench_allocate((size_t)points, 3 * sizeof *cloud);
    uint64_t state = BENCH_SEED;
    for (int32_t r = 0; r < runs; r++) {
        draw_points(&state, cloud, points);
        for (int i = 0; i < count; i++) sides[i].ms[r] = sides[i].engine->build_hull(cloud, points, &sides[i].bytes);
    }
    print(what, sides, count, runs, 1.0, csv);
    free(cloud);
}

void bench_time_builds(FILE *csv)
{
    printf("\n%-30s %10s %10s %8s %12s %10s\n", "building, ns, bytes", "feather", "bullet", "bullet/", "bytes",
           "bullet");
    time_mesh("triangle of a mesh of 131 072", 256, 9, csv);
    time_mesh("triangle of a mesh of 1 048 352", 724, 3, csv);
    time_hull("hull of 1000 points", 1000, 100, csv);
    time_hull("hull of 32 points", 32, MOST_RUNS, csv);
}
