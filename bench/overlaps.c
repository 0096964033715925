// Separating axes between all pairs of solids that are near, found by sorting along x (overlaps.h).
#include "overlaps.h"

#include "memory.h"
#include "solid.h"
#include "vec.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- solids in the world -------------------------------------------------------------------------------------------

// Of a body, or of a part of one
typedef struct placed {
    const bench_solid *solid;
    int32_t body;
    double centre[3];
    double (*points)[3], (*normals)[3], (*edges)[3]; // the solid's, turned; points from the world's origin
} placed;

static double (*turned(double (*all)[3], int32_t count, const double *rotation, const double *centre))[3]
{
    double(*out)[3] = bench_allocate((size_t)count, sizeof *out);
    for (int32_t i = 0; i < count; i++) {
        bench_turn(rotation, all[i], out[i]);
        for (int k = 0; k < 3 && centre != NULL; k++) out[i][k] += centre[k];
    }
    return out;
}

static placed place(const bench_solid *solid, int32_t body, const bench_pose *pose, const double *at)
{
    placed p = {.solid = solid, .body = body};
    bench_turn(pose->rotation, at, p.centre);
    for (int k = 0; k < 3; k++) p.centre[k] += pose->position[k];
    p.points = turned(solid->points, solid->point_count, pose->rotation, p.centre);
    p.normals = turned(solid->normals, solid->face_count, pose->rotation, NULL);
    p.edges = turned(solid->edges, solid->edge_count, pose->rotation, NULL);
    return p;
}

// What a shape consists of; `owned`: solids to free with it. A sphere or a capsule of nothing.
typedef struct parts {
    const bench_solid **solids;
    double (*at)[3];
    int32_t count;
    int32_t owned;
} parts;

static parts parts_of(const bench_shape *shape)
{
    static const double middle[3] = {0.0, 0.0, 0.0};
    parts p = {.count = shape->form == BENCH_COMPOUND ? shape->part_count : 1, .owned = shape->form != BENCH_HULL};
    p.solids = bench_allocate((size_t)p.count, sizeof *p.solids);
    p.at = bench_allocate((size_t)p.count, sizeof *p.at);
    for (int32_t i = 0; i < p.count; i++)
        memcpy(p.at[i], shape->form == BENCH_COMPOUND ? shape->parts[i].at : middle, sizeof p.at[i]);
    switch (shape->form) {
    case BENCH_HULL:
        p.solids[0] = shape->solid;
        break;
    case BENCH_BOX:
        p.solids[0] = bench_solid_box(shape->half);
        break;
    case BENCH_CYLINDER:
        p.solids[0] = bench_solid_cylinder((double)shape->half_height, (double)shape->radius);
        break;
    case BENCH_COMPOUND:
        for (int32_t i = 0; i < p.count; i++) p.solids[i] = bench_solid_box(shape->parts[i].half);
        break;
    case BENCH_SPHERE:
    case BENCH_CAPSULE:
    case BENCH_TERRAIN:
    case BENCH_MESH:
        p.count = 0;
        break;
    }
    return p;
}

static void free_parts(parts *p)
{
    for (int32_t i = 0; i < p->count && p->owned; i++) bench_solid_free((bench_solid *)p->solids[i]);
    free(p->solids);
    free(p->at);
}

// ---- two solids ----------------------------------------------------------------------------------------------------

// How far a solid reaches along a direction from another's least point: the overlap along it, if b lies that way
static double overlap_along(const placed *a, const placed *b, const double *direction)
{
    double top = -DBL_MAX, least = DBL_MAX;
    for (int32_t i = 0; i < a->solid->point_count; i++) top = fmax(top, bench_dot(a->points[i], direction));
    for (int32_t i = 0; i < b->solid->point_count; i++) least = fmin(least, bench_dot(b->points[i], direction));
    return top - least;
}

static double overlap_by_edges(const placed *a, const placed *b, double best)
{
    const double parallel = 1e-6; // sine
    for (int32_t i = 0; i < a->solid->edge_count; i++) {
        for (int32_t k = 0; k < b->solid->edge_count && best > 0.0; k++) {
            double n[3];
            bench_cross(a->edges[i], b->edges[k], n);
            const double length = bench_length(n);
            if (length < parallel) continue;
            for (int axis = 0; axis < 3; axis++) n[axis] /= length;
            best = fmin(best, overlap_along(a, b, n));
            best = fmin(best, overlap_along(b, a, n)); // the opposite direction
        }
    }
    return best;
}

// > 0: how deep; else they are apart
static double overlap_of(const placed *a, const placed *b)
{
    double between[3], best = DBL_MAX;
    bench_minus(a->centre, b->centre, between);
    if (bench_length(between) > a->solid->radius + b->solid->radius) return 0.0;
    for (int32_t i = 0; i < a->solid->face_count && best > 0.0; i++)
        best = fmin(best, overlap_along(a, b, a->normals[i]));
    for (int32_t i = 0; i < b->solid->face_count && best > 0.0; i++)
        best = fmin(best, overlap_along(b, a, b->normals[i]));
    return best > 0.0 ? overlap_by_edges(a, b, best) : 0.0;
}

// ---- ground --------------------------------------------------------------------------------------------------------

static const double PIT = 6.0; // m, half of its width

// How deep a ball is in what stands still, m. Over a ridge of the hills the plane under its centre is not what is
// nearest
static double depth_of(const bench_scene *scene, const double *point, double radius)
{
    double height = 0.0, normal[3] = {0.0, 1.0, 0.0};
    switch (scene->ground) {
    case BENCH_GROUND_PIT:
        return radius + fmax(-point[1], fmax(fabs(point[0]), fabs(point[2])) - PIT);
    case BENCH_GROUND_MESH:
        if (!bench_hills_height(point[0], point[2], &height, normal)) return -DBL_MAX;
        if (radius > 0.0 && point[1] > height) return radius - bench_hills_distance(point);
        return (height - point[1]) * normal[1] + radius;
    case BENCH_GROUND_FLOOR:
    case BENCH_GROUND_NONE:
        break;
    }
    return radius - point[1];
}

static int is_lost(const bench_scene *scene, const double *p)
{
    const double below = 0.3, wall = 2.0, bottomless = 50.0; // m
    double height, normal[3];
    if (!(fabs(p[0]) + fabs(p[2]) < 1e5 && p[1] > -bottomless)) return 1;
    switch (scene->ground) {
    case BENCH_GROUND_PIT:
        return fmax(fabs(p[0]), fabs(p[2])) > PIT + wall || p[1] < -below;
    case BENCH_GROUND_MESH:
        return !bench_hills_height(p[0], p[2], &height, normal) || p[1] < height - below;
    case BENCH_GROUND_FLOOR:
    case BENCH_GROUND_NONE:
        break;
    }
    return p[1] < -below;
}

// A cylinder's rim has a deepest point between the corners of its prism: the depth in a plane is by its exact reach.
static double depth_of_cylinder(const bench_scene *scene, const bench_shape *shape, const bench_pose *pose)
{
    const double y[3] = {0.0, 1.0, 0.0}, *p = pose->position;
    double axis[3], reach[3];
    bench_turn(pose->rotation, y, axis);
    for (int k = 0; k < 3; k++)
        reach[k] = (double)shape->half_height * fabs(axis[k]) +
                   (double)shape->radius * sqrt(fmax(0.0, 1.0 - axis[k] * axis[k]));
    const double floor = reach[1] - p[1];
    if (scene->ground != BENCH_GROUND_PIT) return floor;
    return fmax(floor, fmax(fabs(p[0]) + reach[0], fabs(p[2]) + reach[2]) - PIT);
}

static double depth_of_round(const bench_scene *scene, const bench_shape *shape, const bench_pose *pose)
{
    double deepest = -DBL_MAX;
    for (int end = -1; end <= 1; end += 2) {
        const double local[3] = {0.0, end * (shape->form == BENCH_CAPSULE ? (double)shape->half_height : 0.0), 0.0};
        double at[3];
        bench_turn(pose->rotation, local, at);
        for (int k = 0; k < 3; k++) at[k] += pose->position[k];
        deepest = fmax(deepest, depth_of(scene, at, (double)shape->radius));
    }
    return deepest;
}

// ---- all -----------------------------------------------------------------------------------------------------------

typedef struct crowd {
    placed *all;
    int32_t count;
} crowd;

static void add_body(crowd *c, const bench_scene *scene, const parts *p, int32_t body, const bench_pose *pose,
                     bench_overlaps *sum)
{
    const bench_shape *shape = &scene->shapes[scene->bodies[body].shape];
    if (p->count == 0) sum->into_ground = fmax(sum->into_ground, depth_of_round(scene, shape, pose));
    if (shape->form == BENCH_CYLINDER && scene->ground != BENCH_GROUND_MESH)
        sum->into_ground = fmax(sum->into_ground, depth_of_cylinder(scene, shape, pose));
    for (int32_t i = 0; i < p->count; i++) {
        c->all = bench_resize(c->all, (size_t)c->count + 1, sizeof *c->all);
        placed *here = &c->all[c->count++];
        *here = place(p->solids[i], body, pose, p->at[i]);
        for (int32_t k = 0; k < here->solid->point_count; k++)
            sum->into_ground = fmax(sum->into_ground, depth_of(scene, here->points[k], 0.0));
    }
}

static double left_of(const placed *p) { return p->centre[0] - p->solid->radius; }

static int by_left(const void *a, const void *b)
{
    const double x = left_of(a), y = left_of(b);
    return (x > y) - (x < y);
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void measure_pairs(crowd *c, bench_overlaps *sum)
{
    double *depths = NULL;
    qsort(c->all, (size_t)c->count, sizeof *c->all, by_left);
    for (int32_t i = 0; i < c->count; i++) {
        const placed *a = &c->all[i];
        for (int32_t k = i + 1; k < c->count && left_of(&c->all[k]) <= a->centre[0] + a->solid->radius; k++) {
            const double depth = c->all[k].body != a->body ? overlap_of(a, &c->all[k]) : 0.0;
            if (depth <= 0.0) continue;
            depths = bench_resize(depths, (size_t)sum->pairs + 1, sizeof *depths);
            depths[sum->pairs++] = depth;
        }
    }
    if (sum->pairs == 0) return;
    qsort(depths, (size_t)sum->pairs, sizeof *depths, by_value);
    sum->deepest = depths[sum->pairs - 1];
    sum->p99 = depths[(int32_t)(0.99 * sum->pairs)];
    sum->median = depths[sum->pairs / 2];
    free(depths);
}

bench_overlaps bench_measure_overlaps(const bench_scene *scene, const bench_pose *poses)
{
    bench_overlaps sum = {0, 0.0, 0.0, 0.0, -HUGE_VAL, 0};
    crowd c = {NULL, 0};
    parts *forms = bench_allocate((size_t)scene->shape_count, sizeof *forms);
    for (int32_t i = 0; i < scene->shape_count; i++) forms[i] = parts_of(&scene->shapes[i]);
    for (int32_t i = 0; i < scene->body_count; i++) {
        if (!scene->bodies[i].dynamic) continue;
        if (is_lost(scene, poses[i].position)) {
            sum.lost++;
        } else {
            add_body(&c, scene, &forms[scene->bodies[i].shape], i, &poses[i], &sum);
        }
    }
    measure_pairs(&c, &sum);
    for (int32_t i = 0; i < c.count; i++) free(c.all[i].points), free(c.all[i].normals), free(c.all[i].edges);
    for (int32_t i = 0; i < scene->shape_count; i++) free_parts(&forms[i]);
    free(c.all);
    free(forms);
    return sum;
}
