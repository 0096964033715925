// Hulls by trying each triple of points, and their mass by tetrahedra from the origin (solid.h).
#include "solid.h"

#include "memory.h"
#include "vec.h"

#include <math.h>
#include <stdlib.h>

// ---- faces ---------------------------------------------------------------------------------------------------------

typedef struct cloud {
    double (*points)[3];
    int32_t count;
    double size;      // m, of the point farthest from the origin
    double tolerance; // m: nearer to a plane is on it
} cloud;

static cloud cloud_of(double (*points)[3], int32_t count)
{
    cloud c = {points, count, 0.0, 0.0};
    for (int32_t i = 0; i < count; i++) c.size = fmax(c.size, bench_length(points[i]));
    c.tolerance = 1e-7 * c.size;
    return c;
}

// The plane of three points, if all others are on one side of it
static int is_face(const cloud *c, int32_t i, int32_t j, int32_t k, double *normal, double *offset)
{
    double u[3], v[3];
    bench_minus(c->points[j], c->points[i], u);
    bench_minus(c->points[k], c->points[i], v);
    bench_cross(u, v, normal);
    const double length = bench_length(normal);
    if (length < 1e-9 * c->size * c->size) return 0;
    for (int axis = 0; axis < 3; axis++) normal[axis] /= length;
    *offset = bench_dot(normal, c->points[i]);
    int above = 0, below = 0;
    for (int32_t p = 0; p < c->count && !(above && below); p++) {
        const double height = bench_dot(normal, c->points[p]) - *offset;
        above |= height > c->tolerance, below |= height < -c->tolerance;
    }
    if (above && below) return 0;
    for (int axis = 0; axis < 3 && above; axis++) normal[axis] = -normal[axis];
    if (above) *offset = -*offset;
    return 1;
}

static int is_known(const bench_solid *s, const cloud *c, const double *normal, double offset)
{
    for (int32_t f = 0; f < s->face_count; f++) {
        if (bench_dot(s->normals[f], normal) > 1.0 - 1e-10 && fabs(s->offsets[f] - offset) < 10.0 * c->tolerance)
            return 1;
    }
    return 0;
}

// The corners on a plane, turning left about its normal. Returns how many.
static int32_t walk_rim(const cloud *c, const double *normal, double offset, int32_t *corners)
{
    double middle[3] = {0.0, 0.0, 0.0}, u[3], v[3];
    double *angles = bench_allocate((size_t)c->count, sizeof *angles);
    int32_t count = 0;
    for (int32_t p = 0; p < c->count; p++) {
        if (fabs(bench_dot(normal, c->points[p]) - offset) > 4.0 * c->tolerance) continue;
        for (int axis = 0; axis < 3; axis++) middle[axis] += c->points[p][axis];
        corners[count++] = p;
    }
    for (int axis = 0; axis < 3; axis++) middle[axis] /= count;
    bench_minus(c->points[corners[0]], middle, u);
    bench_cross(normal, u, v);
    for (int32_t i = 0; i < count; i++) {
        double arm[3];
        bench_minus(c->points[corners[i]], middle, arm);
        const double angle = atan2(bench_dot(arm, v), bench_dot(arm, u));
        const int32_t corner = corners[i];
        int32_t at = i;
        for (; at > 0 && angles[at - 1] > angle; at--) angles[at] = angles[at - 1], corners[at] = corners[at - 1];
        angles[at] = angle, corners[at] = corner;
    }
    free(angles);
    return count;
}

static void find_faces(bench_solid *s, const cloud *c)
{
    int32_t filled = 0;
    for (int32_t i = 0; i < c->count; i++) {
        for (int32_t j = i + 1; j < c->count; j++) {
            for (int32_t k = j + 1; k < c->count; k++) {
                double normal[3], offset;
                if (!is_face(c, i, j, k, normal, &offset) || is_known(s, c, normal, offset)) continue;
                const size_t faces = (size_t)s->face_count + 1;
                s->normals = bench_resize(s->normals, faces, sizeof *s->normals);
                s->offsets = bench_resize(s->offsets, faces, sizeof *s->offsets);
                s->loops = bench_resize(s->loops, (size_t)(filled + 1 + c->count), sizeof *s->loops);
                for (int axis = 0; axis < 3; axis++) s->normals[s->face_count][axis] = normal[axis];
                s->offsets[s->face_count++] = offset;
                s->loops[filled] = walk_rim(c, normal, offset, s->loops + filled + 1);
                filled += 1 + s->loops[filled];
            }
        }
    }
}

// ---- mass ----------------------------------------------------------------------------------------------------------

typedef struct moments {
    double volume, first[3], second[6]; // second: xx yy zz xy yz zx
} moments;

// Of the tetrahedron of three points and the origin
static void add_tetrahedron(moments *m, const double *a, const double *b, const double *c)
{
    double cross[3], sum[3];
    bench_cross(b, c, cross);
    const double volume = bench_dot(a, cross) / 6.0;
    m->volume += volume;
    for (int k = 0; k < 3; k++) {
        sum[k] = a[k] + b[k] + c[k];
        m->first[k] += volume * sum[k] / 4.0;
    }
    for (int k = 0; k < 6; k++) {
        const int i = k % 3, j = k < 3 ? i : (i + 1) % 3;
        m->second[k] += volume / 20.0 * (sum[i] * sum[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]);
    }
}

static moments moments_of(const bench_solid *s)
{
    moments m = {0.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
    const int32_t *loop = s->loops;
    for (int32_t f = 0; f < s->face_count; f++, loop += 1 + loop[0]) {
        for (int32_t i = 2; i < loop[0]; i++)
            add_tetrahedron(&m, s->points[loop[1]], s->points[loop[i]], s->points[loop[i + 1]]);
    }
    return m;
}

// Fills volume and inertia, and moves the frame's origin to the centre of mass.
static void weigh(bench_solid *s)
{
    const moments m = moments_of(s);
    double centre[3], second[6];
    for (int k = 0; k < 3; k++) centre[k] = m.first[k] / m.volume;
    for (int k = 0; k < 6; k++) {
        const int i = k % 3, j = k < 3 ? i : (i + 1) % 3;
        second[k] = m.second[k] - m.volume * centre[i] * centre[j];
    }
    s->volume = m.volume;
    for (int k = 0; k < 3; k++) s->inertia[k] = second[(k + 1) % 3] + second[(k + 2) % 3];
    for (int k = 3; k < 6; k++) s->inertia[k] = -second[k];
    for (int32_t p = 0; p < s->point_count; p++) bench_minus(s->points[p], centre, s->points[p]);
    for (int32_t f = 0; f < s->face_count; f++) s->offsets[f] -= bench_dot(s->normals[f], centre);
}

// ---- edges and corners ---------------------------------------------------------------------------------------------

static void add_edge(bench_solid *s, const double *from, const double *to)
{
    double d[3];
    bench_minus(to, from, d);
    const double length = bench_length(d);
    for (int k = 0; k < 3; k++) d[k] /= length;
    for (int32_t e = 0; e < s->edge_count; e++) {
        if (fabs(bench_dot(s->edges[e], d)) > 1.0 - 1e-9) return;
    }
    s->edges = bench_resize(s->edges, (size_t)s->edge_count + 1, sizeof *s->edges);
    for (int k = 0; k < 3; k++) s->edges[s->edge_count][k] = d[k];
    s->edge_count++;
}

static void find_edges(bench_solid *s)
{
    const int32_t *loop = s->loops;
    for (int32_t f = 0; f < s->face_count; f++, loop += 1 + loop[0]) {
        for (int32_t i = 0; i < loop[0]; i++)
            add_edge(s, s->points[loop[1 + i]], s->points[loop[1 + (i + 1) % loop[0]]]);
    }
}

// Only points that are corners of faces stay.
static void keep_corners(bench_solid *s)
{
    int32_t *number = bench_allocate((size_t)s->point_count, sizeof *number), kept = 0;
    int32_t *loop = s->loops;
    for (int32_t f = 0; f < s->face_count; f++, loop += 1 + loop[0]) {
        for (int32_t i = 1; i <= loop[0]; i++) number[loop[i]] = 1;
    }
    for (int32_t p = 0; p < s->point_count; p++) {
        if (!number[p]) continue;
        for (int k = 0; k < 3; k++) s->points[kept][k] = s->points[p][k];
        number[p] = kept++;
    }
    loop = s->loops;
    for (int32_t f = 0; f < s->face_count; f++, loop += 1 + loop[0]) {
        for (int32_t i = 1; i <= loop[0]; i++) loop[i] = number[loop[i]];
    }
    s->point_count = kept;
    free(number);
}

bench_solid *bench_solid_hull(double (*points)[3], int32_t count)
{
    bench_solid *s = bench_allocate(1, sizeof *s);
    s->points = bench_allocate((size_t)count, sizeof *s->points);
    s->point_count = count;
    for (int32_t p = 0; p < count; p++) {
        for (int k = 0; k < 3; k++) s->points[p][k] = points[p][k];
    }
    const cloud c = cloud_of(s->points, count);
    find_faces(s, &c);
    keep_corners(s);
    weigh(s);
    find_edges(s);
    for (int32_t p = 0; p < s->point_count; p++) s->radius = fmax(s->radius, bench_length(s->points[p]));
    return s;
}

bench_solid *bench_solid_box(const float half[3])
{
    double points[8][3];
    for (int i = 0; i < 8; i++) {
        for (int k = 0; k < 3; k++) points[i][k] = (i >> k & 1 ? 1.0 : -1.0) * (double)half[k];
    }
    return bench_solid_hull(points, 8);
}

bench_solid *bench_solid_cylinder(double half_height, double radius)
{
    double points[2 * BENCH_ROUND][3];
    for (int i = 0; i < 2 * BENCH_ROUND; i++) {
        const double angle = 2.0 * acos(-1.0) * (i / 2) / BENCH_ROUND;
        points[i][0] = radius * cos(angle), points[i][2] = radius * sin(angle);
        points[i][1] = i % 2 ? half_height : -half_height;
    }
    return bench_solid_hull(points, 2 * BENCH_ROUND);
}

void bench_solid_free(bench_solid *solid)
{
    if (solid == NULL) return;
    free(solid->points);
    free(solid->normals);
    free(solid->offsets);
    free(solid->loops);
    free(solid->edges);
    free(solid);
}
