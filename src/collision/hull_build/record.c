// record.c - see record.h. What the arrays hold, and in which order, stands in form/hull.h.
#include "collision/hull_build/record.h"

#include "core/lanes.h"

// ---- room ----------------------------------------------------------------------------------------------------------
// Hands out arrays one after another; without a block it only counts.
typedef struct room {
    char *block;
    int64_t end;
} room;

static void *take(room *r, int64_t size)
{
    void *at = r->block ? r->block + r->end : NULL;
    r->end += (size + 63) / 64 * 64;
    return at;
}

static float *take_floats(room *r, int32_t count) { return take(r, (int64_t)sizeof(float) * fe__hull_padded(count)); }

static fe__hull_lanes take_lanes(room *r, int32_t count)
{
    const float *x = take_floats(r, count), *y = take_floats(r, count), *z = take_floats(r, count);
    return (fe__hull_lanes){x, y, z};
}

int64_t fe__hull_share(fe__hull *h, void *block)
{
    room of_block = {block, 0}, *r = &of_block;
    h->vertices = take_lanes(r, h->vertex_count);
    h->normals = take_lanes(r, h->face_count);
    h->distances = take_floats(r, h->face_count);
    h->tails = take_lanes(r, h->edge_count);
    h->vectors = take_lanes(r, h->edge_count);
    h->left = take_lanes(r, h->edge_count);
    h->right = take_lanes(r, h->edge_count);
    h->directions = take_lanes(r, h->direction_count);
    h->edges = take(r, (int64_t)sizeof(fe__hull_edge) * 2 * h->edge_count);
    h->faces = take(r, (int64_t)sizeof(fe__hull_face) * h->face_count);
    h->spokes = take(r, (int64_t)sizeof(uint16_t) * h->vertex_count);
    h->corners = take(r, 2 * h->edge_count);
    h->block = block;
    h->size = r->end;
    return r->end;
}

// ---- lanes ---------------------------------------------------------------------------------------------------------
static void pad(const float *array, int32_t count)
{
    for (int32_t i = count; i < fe__hull_padded(count); ++i) fe__hull_writable(array)[i] = array[0];
}

static void pad_lanes(const fe__hull_lanes *lanes, int32_t count)
{
    pad(lanes->x, count), pad(lanes->y, count), pad(lanes->z, count);
}

// ---- topology ------------------------------------------------------------------------------------------------------
void fe__hull_connect(fe__hull *h, const uint16_t *half)
{
    fe__hull_edge *edges = (fe__hull_edge *)(uintptr_t)h->edges;
    fe__hull_face *faces = fe__hull_own_faces(h);
    uint16_t *spokes = (uint16_t *)(uintptr_t)h->spokes;
    for (int32_t face = 0, first = 0; face < h->face_count; first += faces[face++].count) {
        int32_t count = faces[face].count;
        faces[face].first = (uint16_t)first, faces[face].edge = half[first];
        for (int32_t k = 0; k < count; ++k) {
            uint16_t own = half[first + k], next = half[k + 1 < count ? first + k + 1 : first];
            edges[own] = (fe__hull_edge){next, (uint16_t)face, h->corners[first + k], {0, 0, 0}};
            spokes[h->corners[first + k]] = own;
        }
    }
}

// ---- geometry ------------------------------------------------------------------------------------------------------
void fe__hull_set_vertex(fe__hull *h, int32_t i, fe_vec3 v)
{
    fe__hull_set_lane(&h->vertices, i, v);
    h->low = i ? fe__vec3(fe__minf(h->low.x, v.x), fe__minf(h->low.y, v.y), fe__minf(h->low.z, v.z)) : v;
    h->high = i ? fe__vec3(fe__maxf(h->high.x, v.x), fe__maxf(h->high.y, v.y), fe__maxf(h->high.z, v.z)) : v;
}

static double along(const fe__hull *h, fe_vec3 normal, int32_t vertex)
{
    return fe__ddot(fe__widen(normal), fe__widen(fe__hull_vertex(h, vertex)));
}

// Of all vertices, four at a time
static double farthest_along(const fe__hull *h, fe_vec3 normal)
{
    const double n[3] = {(double)normal.x, (double)normal.y, (double)normal.z};
    const fe__doubles x = {n[0], n[0]}, y = {n[1], n[1]}, z = {n[2], n[2]};
    double first = along(h, normal, 0);
    fe__doubles most = {first, first};
    int32_t whole = h->vertex_count / 4 * 4;
    for (int32_t v = 0; v < whole; v += 4) {
        fe__quad vx = *(const fe__quad *)(h->vertices.x + v), vy = *(const fe__quad *)(h->vertices.y + v),
                 vz = *(const fe__quad *)(h->vertices.z + v);
        most = fe__doubles_max(x * fe__doubles_low(vx) + y * fe__doubles_low(vy) + z * fe__doubles_low(vz), most);
        most = fe__doubles_max(x * fe__doubles_high(vx) + y * fe__doubles_high(vy) + z * fe__doubles_high(vz), most);
    }
    double farthest = fe__maxd(most[0], most[1]);
    int32_t rest = farthest == 0.0 ? 0 : whole; // of -0 and 0 the last one stays
    for (int32_t v = rest; v < h->vertex_count; ++v) farthest = fe__maxd(farthest, along(h, normal, v));
    return farthest;
}

double fe__hull_set_plane(const fe__hull *h, int32_t face, fe_vec3 normal)
{
    double farthest = farthest_along(h, normal), flatness = 0.0;
    float distance = fe__float_above(farthest);
    fe__hull_set_lane(&h->normals, face, normal);
    fe__hull_writable(h->distances)[face] = distance;
    const uint8_t *corner = h->corners + h->faces[face].first;
    for (int32_t k = 0; k < h->faces[face].count; ++k)
        flatness = fe__maxd(flatness, (double)distance - along(h, normal, corner[k]));
    return flatness;
}

void fe__hull_place_planes(fe__hull *h)
{
    double flatness = 0.0;
    for (int32_t i = 0; i < h->face_count; ++i)
        flatness = fe__maxd(flatness, fe__hull_set_plane(h, i, fe__hull_normal(h, i)));
    h->flatness = fe__float_above(flatness);
}

void fe__hull_finish(const fe__hull *h)
{
    for (int32_t k = 0; k < h->edge_count; ++k) {
        const fe__hull_edge *edge = &h->edges[2 * k];
        fe_vec3 tail = fe__hull_vertex(h, edge[0].origin);
        fe__hull_set_lane(&h->tails, k, tail);
        fe__hull_set_lane(&h->vectors, k, fe__sub(fe__hull_vertex(h, edge[1].origin), tail));
        fe__hull_set_lane(&h->left, k, fe__hull_normal(h, edge[0].face));
        fe__hull_set_lane(&h->right, k, fe__hull_normal(h, edge[1].face));
    }
    pad_lanes(&h->vertices, h->vertex_count);
    pad_lanes(&h->normals, h->face_count);
    pad(h->distances, h->face_count);
    pad_lanes(&h->tails, h->edge_count), pad_lanes(&h->vectors, h->edge_count);
    pad_lanes(&h->left, h->edge_count), pad_lanes(&h->right, h->edge_count);
    if (h->direction_count) pad_lanes(&h->directions, h->direction_count);
}
