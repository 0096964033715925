// hull_scale.c - see hull_builder.h.
//
// Vertices and planes are computed in double, from those of the asset: a scale S takes the point p to S p and the
// normal n to S^-1 n.
#include "collision/hull_build/hull_builder.h"


#include <float.h>
#include <string.h>

static fe_dvec3 times(fe_vec3 scale, fe_dvec3 p)
{
    return (fe_dvec3){(double)scale.x * p.x, (double)scale.y * p.y, (double)scale.z * p.z};
}

static fe_dvec3 unit(fe_dvec3 v) { return fe__dscale(1.0 / sqrt(fe__ddot(v, v)), v); }

// ---- directions ----------------------------------------------------------------------------------------------------
// Of the edges that are not parallel; none when there are too many
static int32_t find_directions(const fe__hull *h, fe_vec3 scale, fe_dvec3 *direction)
{
    int32_t count = 0;
    for (int32_t k = 0; k < h->edge_count; ++k) {
        fe_dvec3 side = unit(times(scale, fe__widen(fe__hull_lane(&h->vectors, k))));
        if (fe__hull_is_known_direction(direction, count, side)) continue;
        if (count == FE__HULL_DIRECTIONS) return 0;
        direction[count++] = side;
    }
    return count;
}

static void set_counts(const fe__hull *from, int32_t direction_count, fe__hull *h)
{
    h->vertex_count = from->vertex_count;
    h->face_count = from->face_count;
    h->edge_count = from->edge_count;
    h->direction_count = direction_count;
}

int64_t fe__hull_scaled_size(const fe__hull *hull, fe_vec3 scale)
{
    fe_dvec3 direction[FE__HULL_DIRECTIONS];
    fe__hull h;
    set_counts(hull, find_directions(hull, scale, direction), &h);
    return fe__hull_share(&h, NULL);
}

// ---- topology ------------------------------------------------------------------------------------------------------
// In a mirror a face lies on the other side of each of its edges, and its corners run the other way. A half-edge keeps
// its number and its origin, so that it gets the face of the other of its pair.
static void turn_round(const fe__hull *from, fe__hull_edge *edges, fe__hull_face *faces, uint8_t *corners)
{
    uint16_t previous[FE__HULL_CORNERS];
    int32_t count = 2 * from->edge_count;
    for (int32_t i = 0; i < count; ++i) previous[from->edges[i].next] = (uint16_t)i;
    for (int32_t i = 0; i < count; ++i) {
        edges[i ^ 1].face = from->edges[i].face;
        edges[i ^ 1].next = (uint16_t)(previous[i] ^ 1);
    }
    for (int32_t i = 0; i < from->face_count; ++i) {
        const fe__hull_face *face = from->faces + i;
        faces[i].edge = (uint16_t)(previous[face->edge] ^ 1);
        for (int32_t k = 1; k < face->count; ++k)
            corners[face->first + k] = from->corners[face->first + face->count - k];
    }
}

static void write_topology(const fe__hull *from, int32_t is_mirrored, const fe__hull *h)
{
    fe__hull_edge *edges = (fe__hull_edge *)(uintptr_t)h->edges;
    fe__hull_face *faces = fe__hull_own_faces(h);
    uint8_t *corners = fe__hull_own_corners(h);
    memcpy(edges, from->edges, sizeof *edges * 2 * (size_t)from->edge_count);
    memcpy(faces, from->faces, sizeof *faces * (size_t)from->face_count);
    memcpy(corners, from->corners, 2 * (size_t)from->edge_count);
    memcpy((uint16_t *)(uintptr_t)h->spokes, from->spokes, sizeof *h->spokes * (size_t)from->vertex_count);
    if (is_mirrored) turn_round(from, edges, faces, corners);
}

// ---- geometry ------------------------------------------------------------------------------------------------------
static void write_vertices(const fe__hull *from, fe_vec3 scale, fe__hull *h)
{
    fe_dvec3 origin = fe__widen(from->origin);
    h->origin = fe__narrow(times(scale, origin));
    for (int32_t i = 0; i < h->vertex_count; ++i) {
        fe_dvec3 p = times(scale, fe__dadd(origin, fe__widen(fe__hull_vertex(from, i))));
        fe__hull_set_vertex(h, i, fe__narrow(fe__dsub(p, fe__widen(h->origin))));
    }
    fe_vec3 size = fe__sub(h->high, h->low);
    h->extent = fe__maxf(size.x, fe__maxf(size.y, size.z));
}

// The area of the polygon, as a vector (Newell)
static fe_dvec3 area_of(const fe__hull *h, int32_t face)
{
    const uint8_t *corner = h->corners + h->faces[face].first;
    fe_dvec3 start = fe__widen(fe__hull_vertex(h, corner[0])), area = {0.0, 0.0, 0.0};
    for (int32_t k = 2; k < h->faces[face].count; ++k)
        area = fe__dadd(area, fe__dcross(fe__dsub(fe__widen(fe__hull_vertex(h, corner[k - 1])), start),
                                         fe__dsub(fe__widen(fe__hull_vertex(h, corner[k])), start)));
    return area;
}

// A long scale spreads the rounding of a float's normal, a short one that of a sliver's corners: of the plane through
// the corners and the asset's own, scaled, the one that they lie less deep below.
static void write_planes(const fe__hull *from, fe_vec3 scale, fe__hull *h)
{
    double flatness = 0.0;
    for (int32_t i = 0; i < h->face_count; ++i) {
        fe_dvec3 n = fe__widen(fe__hull_normal(from, i)), area = area_of(h, i);
        fe_vec3 own = fe__narrow(unit((fe_dvec3){n.x / (double)scale.x, n.y / (double)scale.y, n.z / (double)scale.z}));
        double depth = fe__hull_set_plane(h, i, own), square = fe__ddot(area, area);
        if (square > 0.0 && fe__ddot(area, fe__widen(own)) > 0.0) {
            double through = fe__hull_set_plane(h, i, fe__narrow(unit(area)));
            if (through > depth)
                fe__hull_set_plane(h, i, own);
            else
                depth = through;
        }
        flatness = fe__maxd(flatness, depth);
    }
    h->flatness = fe__float_above(flatness);
}

// ---- measures ------------------------------------------------------------------------------------------------------
static double depth_below(const fe__hull *h, int32_t face)
{
    fe_dvec3 n = fe__widen(fe__hull_normal(h, face));
    double lowest = DBL_MAX;
    for (int32_t v = 0; v < h->vertex_count; ++v)
        lowest = fe__mind(lowest, fe__ddot(n, fe__widen(fe__hull_vertex(h, v))));
    return (double)h->distances[face] - lowest;
}

static int32_t is_thick_enough(fe__hull *h, fe__hull_refusal *refusal)
{
    double least = fe__hull_least_thickness((double)h->extent);
    *refusal = (fe__hull_refusal){.thickness = DBL_MAX, .least = least};
    for (int32_t i = 0; i < h->face_count; ++i) {
        double depth = depth_below(h, i);
        if (depth < refusal->thickness) refusal->thickness = depth, refusal->normal = fe__hull_unit_normal(h, i);
    }
    h->thickness = (float)refusal->thickness;
    return refusal->thickness >= least;
}

int32_t fe__hull_write_scaled(const fe__hull *hull, fe_vec3 scale, void *block, fe__hull *h, fe__hull_refusal *refusal)
{
    fe_dvec3 direction[FE__HULL_DIRECTIONS];
    memset(h, 0, sizeof *h);
    set_counts(hull, find_directions(hull, scale, direction), h);
    fe__hull_share(h, block);
    write_topology(hull, scale.x * scale.y * scale.z < 0.0f, h);
    write_vertices(hull, scale, h);
    write_planes(hull, scale, h);
    for (int32_t i = 0; i < h->direction_count; ++i) fe__hull_set_lane(&h->directions, i, fe__narrow(direction[i]));
    fe__hull_finish(h);
    float longest = fe__maxf(fe__absf(scale.x), fe__maxf(fe__absf(scale.y), fe__absf(scale.z)));
    h->tolerance = longest * hull->tolerance;
    h->error = longest * hull->error;
    if (!is_thick_enough(h, refusal)) return 0;
    fe__hull_weigh(h);
    return 1;
}
