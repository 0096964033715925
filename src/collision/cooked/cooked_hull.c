// cooked_hull.c - convex hulls as bytes; see cooked.h.
//
// A hull that is read keeps the invariants of form/hull.h: it is closed, of one piece by Euler's formula, its faces are
// flat and convex, neighbours bend outwards, and it is thick enough to have a mass. The bounds of the checks allow for
// the rounding of floats.
#include "collision/cooked/cooked.h"
#include "collision/hull_build/hull_builder.h"
#include "core/bytes.h"

// The rounding of floats and of the builder's grid, in extents e. A plane's distance, 4.4 e at most from the origin, is
// the next float: 5.3e-7. A normal is off by 5.2e-8, over 1.8 e; a vertex by half a step of the grid on each axis,
// 2^-26 e.
#define ROUNDING 1e-6
// |n|^2 of a unit vector in floats is off by some 1.1e-7.
#define UNIT_SLACK 1e-6
// A face's slab is at most a quarter of the tolerance, and a 32nd of the thickness (hull_build/hull_builder.c).
#define FLAT_OF_TOLERANCE 0.25
#define FLAT_OF_THICKNESS (1.0 / 32.0)
// Corners that were dropped lay in the slab on either side.
#define WIDTH_LEFT (1.0 - 2.0 * FLAT_OF_THICKNESS)
// Few vertices make a hull thinner than its points, which have the least thickness d. The tetrahedron that it grew from
// (hull_build/quickhull.c) has a height of d / 2 at least over a base of area A. No point is farther from the base's
// longest side L than the base's third corner, or farther from its ends than sqrt 3 L: the other sides have 1, 4.2 and
// 4.2 A at most. So the ball in it has a radius of d / 2 / 10.4, and no width of the hull is less than d / 10.4.
// WIDTH_LEFT and ROUNDING leave 0.08 d of it.
#define THICKNESS_LEFT (1.0 / 16.0)
// Twice the sine below which edges are parallel for the builder.
#define PARALLEL 2e-5

// ---- writing -------------------------------------------------------------------------------------------------------
int64_t fe__cooked_hull_size(const fe__hull *h)
{
    int32_t measures = 4 * 7, points = 12 * (h->vertex_count + h->face_count + h->direction_count);
    return FE__COOKED_HULL_COUNTS + measures + points + 2 * 2 * h->edge_count + h->face_count + 2 * h->edge_count;
}

static unsigned char *write_lanes(const fe__hull_lanes *lanes, int32_t count, unsigned char *out)
{
    for (int32_t i = 0; i < count; ++i) out = fe__put_vec3(out, fe__hull_lane(lanes, i));
    return out;
}

unsigned char *fe__cooked_hull_write(const fe__hull *h, unsigned char *out)
{
    out = fe__put_i32(fe__put_i32(fe__put_i32(out, h->vertex_count), h->face_count), h->direction_count);
    out = fe__put_float(fe__put_float(fe__put_vec3(out, h->origin), h->thickness), h->extent);
    out = fe__put_float(fe__put_float(out, h->tolerance), h->error);
    out = write_lanes(&h->vertices, h->vertex_count, out);
    out = write_lanes(&h->normals, h->face_count, out);
    out = write_lanes(&h->directions, h->direction_count, out);
    for (int32_t i = 0; i < h->face_count; ++i) {
        uint16_t half = h->faces[i].edge;
        for (int32_t k = 0; k < h->faces[i].count; ++k, half = h->edges[half].next) out = fe__put_u16(out, half);
    }
    for (int32_t i = 0; i < h->face_count; ++i) *out++ = (unsigned char)h->faces[i].count;
    return fe__put_bytes(out, h->corners, 2 * h->edge_count);
}

// ---- counts and numbers --------------------------------------------------------------------------------------------
int32_t fe__cooked_hull_counts(fe__cooked *c, fe__hull *h)
{
    if (!fe__cooked_int(c, "the number of vertices", 4, FE__HULL_VERTICES, &h->vertex_count) ||
        !fe__cooked_int(c, "the number of faces", 4, 2 * h->vertex_count - 4, &h->face_count) ||
        !fe__cooked_int(c, "the number of directions", 0, FE__HULL_DIRECTIONS, &h->direction_count))
        return 0;
    h->edge_count = h->vertex_count + h->face_count - 2; // Euler's formula
    return 1;
}

int64_t fe__cooked_hull_block(const fe__hull *h)
{
    fe__hull counted = *h;
    return fe__hull_share(&counted, NULL);
}

static int32_t read_point(fe__cooked *c, const char *name, int32_t index, float most, fe_vec3 *out)
{
    const unsigned char *at = c->at;
    *out = fe__take_vec3(&c->at);
    const float v[3] = {out->x, out->y, out->z};
    for (int32_t k = 0; k < 3; ++k) {
        if (v[k] >= -most && v[k] <= most) continue;
        return fe__cooked_refuse(c, at + 4 * k, "%s %d has %.9g as its %c, must be within %.9g", name, (int)index,
                                 (double)v[k], "xyz"[k], (double)most);
    }
    return 1;
}

static int32_t read_measures(fe__cooked *c, fe__hull *h)
{
    const float most = 4.0f * FE_MAX_LENGTH; // The diagonal of all points is shorter.
    return read_point(c, "origin", 0, FE_MAX_LENGTH, &h->origin) &&
           fe__cooked_float(c, "thickness", 0.0f, most, &h->thickness) &&
           fe__cooked_float(c, "extent", (float)FE__HULL_LEAST_THICKNESS, most, &h->extent) &&
           fe__cooked_float(c, "tolerance", 0.0f, most, &h->tolerance) &&
           fe__cooked_float(c, "error", 0.0f, most, &h->error);
}

static int32_t read_vertices(fe__cooked *c, fe__hull *h)
{
    for (int32_t i = 0; i < h->vertex_count; ++i) {
        const unsigned char *at = c->at;
        fe_vec3 v;
        if (!read_point(c, "vertex", i, 2.0f * FE_MAX_LENGTH, &v)) return 0;
        fe_dvec3 p = fe__dadd(fe__widen(h->origin), fe__widen(v));
        const double most = (double)FE_MAX_LENGTH;
        if (fe__absd(p.x) > most || fe__absd(p.y) > most || fe__absd(p.z) > most)
            return fe__cooked_refuse(c, at, "vertex %d is farther than %.9g m", (int)i, most);
        fe__hull_set_vertex(h, i, v);
    }
    return 1;
}

static int32_t read_units(fe__cooked *c, const char *name, const fe__hull_lanes *lanes, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        const unsigned char *at = c->at;
        fe_vec3 n;
        if (!read_point(c, name, i, 2.0f, &n)) return 0;
        double square = fe__ddot(fe__widen(n), fe__widen(n));
        if (fe__absd(square - 1.0) > UNIT_SLACK)
            return fe__cooked_refuse(c, at, "%s %d is no unit vector: |n|^2 is %.9g", name, (int)i, square);
        fe__hull_set_lane(lanes, i, n);
    }
    return 1;
}

// ---- topology ------------------------------------------------------------------------------------------------------
static int32_t read_faces(fe__cooked *c, fe__hull *h)
{
    int32_t corners = 0;
    for (int32_t i = 0; i < h->face_count; ++i) {
        const unsigned char *at = c->at;
        uint8_t count = fe__take_u8(&c->at);
        corners += count;
        if (count < 3 || corners > 2 * h->edge_count)
            return fe__cooked_refuse(c, at, "face %d has %d corners, all have %d", (int)i, count, 2 * h->edge_count);
        fe__hull_own_faces(h)[i].count = count;
    }
    if (corners == 2 * h->edge_count) return 1;
    return fe__cooked_refuse(c, c->at, "the faces have %d corners, must have %d: V - E + F = 2", (int)corners,
                             (int)(2 * h->edge_count));
}

static int32_t read_corners(fe__cooked *c, fe__hull *h)
{
    const unsigned char *start = c->at;
    fe__take_bytes(&c->at, fe__hull_own_corners(h), 2 * h->edge_count);
    for (int32_t i = 0; i < 2 * h->edge_count; ++i) {
        if (h->corners[i] < h->vertex_count) continue;
        return fe__cooked_refuse(c, start + i, "corner %d is vertex %d of %d", (int)i, h->corners[i],
                                 (int)h->vertex_count);
    }
    return 1;
}

// Half-edges 2 k and 2 k + 1 must be the two sides of one edge.
static int32_t check_twins(fe__cooked *c, const fe__hull *h, const unsigned char *start)
{
    for (int32_t i = 0; i < 2 * h->edge_count; i += 2) {
        const fe__hull_edge *a = h->edges + i, *b = a + 1;
        if (a->origin < b->origin && h->edges[a->next].origin == b->origin && h->edges[b->next].origin == a->origin &&
            a->face != b->face)
            continue;
        return fe__cooked_refuse(c, start, "half-edges %d and %d are no two sides of an edge", (int)i, (int)(i + 1));
    }
    return 1;
}

// The half-edges around each vertex must form one ring, and there must be no others.
static int32_t check_rings(fe__cooked *c, const fe__hull *h, const unsigned char *start)
{
    int32_t met = 0, at_vertex[FE__HULL_VERTICES] = {0};
    for (int32_t i = 0; i < 2 * h->edge_count; ++i) at_vertex[h->edges[i].origin] += 1;
    for (int32_t v = 0; v < h->vertex_count; ++v) {
        int32_t around = 0;
        if (at_vertex[v] < 2) return fe__cooked_refuse(c, start, "vertex %d has %d edges", (int)v, (int)at_vertex[v]);
        int32_t edge = h->spokes[v];
        do edge = h->edges[edge ^ 1].next, around += 1;
        while (edge != h->spokes[v]);
        if (around != at_vertex[v])
            return fe__cooked_refuse(c, start, "vertex %d has %d edges, of which %d are around it", (int)v,
                                     (int)at_vertex[v], (int)around);
        met += around;
    }
    return met == 2 * h->edge_count;
}

static int32_t read_topology(fe__cooked *c, fe__hull *h)
{
    uint16_t half[FE__HULL_CORNERS];
    uint8_t seen[FE__HULL_CORNERS] = {0};
    const unsigned char *start = c->at;
    for (int32_t i = 0; i < 2 * h->edge_count; ++i) half[i] = fe__take_u16(&c->at);
    if (!read_faces(c, h) || !read_corners(c, h)) return 0;
    for (int32_t i = 0; i < 2 * h->edge_count; ++i) // Each half-edge belongs to one corner.
        if (half[i] >= 2 * h->edge_count || seen[half[i]]++)
            return fe__cooked_refuse(c, start + 2 * i, "corner %d has half-edge %d: none of %d, or that of another",
                                     (int)i, half[i], (int)(2 * h->edge_count));
    fe__hull_connect(h, half);
    return check_twins(c, h, start) && check_rings(c, h, start);
}

// ---- shape ---------------------------------------------------------------------------------------------------------
static int32_t check_sizes(fe__cooked *c, const fe__hull *h, const unsigned char *measures)
{
    fe_dvec3 sides = fe__dsub(fe__widen(h->high), fe__widen(h->low));
    double longest = fe__maxd(sides.x, fe__maxd(sides.y, sides.z)), extent = (double)h->extent;
    if (longest > extent * (1.0 + ROUNDING))
        return fe__cooked_refuse(c, measures + 16, "the hull is %.9g m long, and its points are %.9g m", longest,
                                 extent);
    double width = (double)INFINITY, slack = ROUNDING * extent; // least width between a face and a vertex below it
    for (int32_t i = 0; i < h->face_count; ++i) {
        fe_dvec3 n = fe__widen(fe__hull_normal(h, i));
        double lowest = (double)h->distances[i];
        for (int32_t v = 0; v < h->vertex_count; ++v)
            lowest = fe__mind(lowest, fe__ddot(n, fe__widen(fe__hull_vertex(h, v))));
        width = fe__mind(width, (double)h->distances[i] - lowest);
    }
    double least = THICKNESS_LEFT * fe__hull_least_thickness(extent);
    if (width < least || WIDTH_LEFT * (double)h->thickness > width + slack)
        return fe__cooked_refuse(c, measures + 12, "the hull is %.9g m thick, must be at least %.9g and %.9g", width,
                                 least, (double)h->thickness);
    double most = fe__mind(FLAT_OF_TOLERANCE * (double)h->tolerance, FLAT_OF_THICKNESS * (double)h->thickness);
    if ((double)h->flatness > most + slack)
        return fe__cooked_refuse(c, measures, "a face is hollow by %.9g m, at most %.9g", (double)h->flatness,
                                 most + slack);
    return 1;
}

// How far the face turns to the right at its corner k, m: so far the corner lies inside of the line past it. Rounding
// moves each corner; it moves a tip between two corners that are near each other by as many times more as its sides are
// longer than the line.
static double turn_right_at(const fe__hull *h, const fe__hull_face *face, int32_t k)
{
    const uint8_t *corner = h->corners + face->first;
    fe_dvec3 v[3], n = fe__widen(fe__hull_normal(h, h->edges[face->edge].face));
    for (int32_t i = 0; i < 3; ++i) v[i] = fe__widen(fe__hull_vertex(h, corner[(k + i) % face->count]));
    fe_dvec3 in = fe__dsub(v[1], v[0]), out = fe__dsub(v[2], v[1]), past = fe__dadd(in, out);
    double square = fe__ddot(past, past), sides = sqrt(fe__ddot(in, in)) + sqrt(fe__ddot(out, out));
    if (square == 0.0) return (double)INFINITY;
    return (-fe__ddot(fe__dcross(in, out), n) - ROUNDING * (double)h->extent * sides) / sqrt(square);
}

static int32_t check_faces(fe__cooked *c, const fe__hull *h, const unsigned char *normals)
{
    double most = fe__mind(FLAT_OF_TOLERANCE * (double)h->tolerance, FLAT_OF_THICKNESS * (double)h->thickness);
    for (int32_t i = 0; i < h->face_count; ++i)
        for (int32_t k = 0; k < h->faces[i].count; ++k)
            if (!(turn_right_at(h, h->faces + i, k) <= most))
                return fe__cooked_refuse(c, normals + 12 * i, "face %d turns right at its corner %d", (int)i,
                                         (int)((k + 1) % h->faces[i].count));
    return 1;
}

static int32_t check_bends(fe__cooked *c, const fe__hull *h, const unsigned char *normals)
{
    for (int32_t k = 0; k < h->edge_count; ++k) {
        fe_dvec3 left = fe__widen(fe__hull_lane(&h->left, k)), right = fe__widen(fe__hull_lane(&h->right, k));
        if (fe__ddot(fe__dcross(left, right), fe__widen(fe__hull_lane(&h->vectors, k))) > 0.0) continue;
        return fe__cooked_refuse(c, normals + 12 * h->edges[2 * k].face, "faces %d and %d do not bend outwards",
                                 h->edges[2 * k].face, h->edges[2 * k + 1].face);
    }
    return 1;
}

// If directions are kept, each edge must be along one of them.
static int32_t check_directions(fe__cooked *c, const fe__hull *h, const unsigned char *directions)
{
    for (int32_t k = 0; h->direction_count && k < h->edge_count; ++k) {
        fe_dvec3 side = fe__widen(fe__hull_lane(&h->vectors, k));
        double most = PARALLEL * PARALLEL * fe__ddot(side, side);
        int32_t is_along = 0;
        for (int32_t i = 0; i < h->direction_count && !is_along; ++i) {
            fe_dvec3 n = fe__dcross(side, fe__widen(fe__hull_lane(&h->directions, i)));
            is_along = fe__ddot(n, n) <= most;
        }
        if (!is_along)
            return fe__cooked_refuse(c, directions, "edge %d is along none of the %d directions", (int)k,
                                     (int)h->direction_count);
    }
    return 1;
}

int32_t fe__cooked_hull_read(fe__cooked *c, fe__hull *h, void *block)
{
    const unsigned char *measures = c->at, *normals = measures + 28 + 12 * h->vertex_count,
                        *directions = normals + 12 * h->face_count;
    fe__hull_share(h, block);
    if (!read_measures(c, h) || !read_vertices(c, h) || !read_units(c, "normal", &h->normals, h->face_count) ||
        !read_units(c, "direction", &h->directions, h->direction_count) || !read_topology(c, h))
        return 0;
    fe__hull_place_planes(h);
    fe__hull_finish(h);
    if (!check_sizes(c, h, measures) || !check_faces(c, h, normals) || !check_bends(c, h, normals) ||
        !check_directions(c, h, directions))
        return 0;
    fe__hull_weigh(h);
    fe_vec3 i = h->mass.inertia;
    if (h->mass.volume > 0.0 && i.x > 0.0f && i.y > 0.0f && i.z > 0.0f && h->inner_radius > 0.0f) return 1;
    return fe__cooked_refuse(c, measures, "the hull has no mass: its volume is %.9g m3", h->mass.volume);
}
