// mesh_build.h - a mesh from any triangles: from the caller's arrays to the record of form/mesh.h.
//
//   weld     vertices that are one                                       mesh_builder.c
//   edges    duplicates found, edges told by what meets there            mesh_edges.c
//   tree     triangles sorted into leaves, and the nodes above           mesh_tree.c
//   layout   groups of vertices, leaves, numbers, measures               mesh_builder.c, mesh_builder.c
//   scale    the same mesh, larger, smaller, or in a mirror               mesh_builder.c
//
// Memory is had in three pieces, whose sizes are known before each: `room`, which lives until the mesh is written;
// `scratch`, which is given back before the mesh's block is had; the block. Of 2 million triangles and half as many
// vertices they take 91 MB at most.
#ifndef FE_COLLISION_MESH_BUILD_MESH_BUILD_H
#define FE_COLLISION_MESH_BUILD_MESH_BUILD_H
#include "collision/form/mesh.h"

#include <string.h>

// A triangle that is not higher than this share of its largest coordinate has no normal to speak of: the rounding of a
// float moves a corner by up to twice as much
#define FE__MESH_LEAST_HEIGHT 0x1p-25

// A checked definition: indices in range, coordinates finite
typedef struct fe__mesh_source {
    const unsigned char *vertices, *indices;
    uint32_t vertex_stride, index_stride;
    int32_t is_short; // indices of 16 bits
    int32_t vertex_count, triangle_count;
    double weld_distance; // m; 0: equal ones alone
    double edge_angle;    // rad
    const uint8_t *materials;
    const uint32_t *data;
    int32_t is_strict, is_two_sided;
} fe__mesh_source;

// Why there is no mesh: nothing is left of it (triangle -1), or it is strict and a triangle would be dropped
typedef struct fe__mesh_refusal {
    int32_t triangle;
    int32_t is_duplicate; // else without height
} fe__mesh_refusal;

enum { FE__MESH_DROPPED = 255 }; // in fe__mesh_builder.edges

typedef struct fe__mesh_builder {
    const fe__mesh_source *source;
    void *scratch;
    uint32_t *weld;  // of each vertex: the first that is one with it
    uint32_t *order; // of each slot: the triangle's number; then those dropped
    uint32_t *place; // of each vertex: in which group and where, for the layout
    fe__mesh_node *nodes;
    uint8_t *edges; // of each triangle: as fe__mesh.edges; FE__MESH_DROPPED
    uint8_t *seen;  // a bit for each triangle, for the numbers
    fe__mesh_shortcut *shortcuts;
    int32_t node_room;
    fe__mesh mesh; // counts and measures
    fe__mesh_refusal refusal;
} fe__mesh_builder;

int64_t fe__mesh_room_size(const fe__mesh_source *source);
int64_t fe__mesh_scratch_size(const fe__mesh_source *source);
// Both aligned to 64, the room zeroed. 0: refused, see `refusal`.
int32_t fe__mesh_build(fe__mesh_builder *room, void *scratch, const fe__mesh_source *source);
// Then, without scratch: the size of the block.
int64_t fe__mesh_block_size(fe__mesh_builder *builder);
// `block`: so many bytes, zeroed, aligned to 64.
void fe__mesh_write(fe__mesh_builder *builder, void *block, fe__mesh *out_mesh);

// The same triangles, in the same arrays, under a scale along the axes of the mesh. -1; else the number of a triangle
// that is too flat under it.
int32_t fe__mesh_scale(const fe__mesh *mesh, fe_vec3 scale, fe__mesh *out_mesh);

// ---- steps ---------------------------------------------------------------------------------------------------------
int64_t fe__mesh_weld_size(const fe__mesh_source *source);
void fe__mesh_weld(fe__mesh_builder *builder);
int64_t fe__mesh_edges_size(const fe__mesh_source *source);
void fe__mesh_find_edges(fe__mesh_builder *builder);
int32_t fe__mesh_is_flat(const fe_dvec3 corner[3]); // no higher than FE__MESH_LEAST_HEIGHT allows
int64_t fe__mesh_tree_size(const fe__mesh_source *source);
int32_t fe__mesh_node_room(int32_t triangle_count);
void fe__mesh_build_tree(fe__mesh_builder *builder);
// Marks them in `numbers`, a permutation, and writes them by `from`; returns how many. `seen`: count / 8 + 1 bytes
int32_t fe__mesh_shortcuts(uint32_t *numbers, int32_t count, uint8_t *seen, fe__mesh_shortcut *out);

// ---- what is made alike from bytes (collision/cooked) --------------------------------------------------------------
int64_t fe__mesh_seen_size(int32_t count); // bytes of what fe__mesh_shortcuts needs, and of what it writes at most
int64_t fe__mesh_shortcuts_size(int32_t count);
// Points the arrays into a block of so many bytes, which is returned, aligned to 64: they are its own, and so is their
// scale, 1. The counts are set. NULL: only the size.
int64_t fe__mesh_share(fe__mesh *mesh, void *block, int32_t has_data, int32_t has_materials);

typedef struct fe__mesh_arrays { // of a mesh that is being made
    float *vertices;
    fe__mesh_leaf *leaves;
    fe__mesh_node *nodes;
    uint32_t *numbers;
    fe__mesh_shortcut *shortcuts;
    uint32_t *data;
    uint8_t *edges, *materials;
} fe__mesh_arrays;
static inline fe__mesh_arrays fe__mesh_own_arrays(const fe__mesh *m)
{
    return (fe__mesh_arrays){(float *)(uintptr_t)m->vertices,
                             (fe__mesh_leaf *)(uintptr_t)m->leaves,
                             (fe__mesh_node *)(uintptr_t)m->nodes,
                             (uint32_t *)(uintptr_t)m->numbers,
                             (fe__mesh_shortcut *)(uintptr_t)m->shortcuts,
                             (uint32_t *)(uintptr_t)m->data,
                             (uint8_t *)(uintptr_t)m->edges,
                             (uint8_t *)(uintptr_t)m->materials};
}

// Frame and boxes of a node, whose count is set, from the bounds of all and of each child
typedef struct fe__mesh_box {
    float low[3], high[3];
} fe__mesh_box;
void fe__mesh_set_boxes(fe__mesh_node *node, const fe__mesh_box *whole, const fe__mesh_box *children);

// Area and volume: triangles are added in the caller's order, tetrahedra from the middle of the bounds
typedef struct fe__mesh_measures {
    fe_dvec3 middle;
    double area, volume;
} fe__mesh_measures;
static inline fe__mesh_measures fe__mesh_measures_begin(const fe__mesh *m)
{
    return (fe__mesh_measures){fe__dscale(0.5, fe__dadd(fe__widen(m->low), fe__widen(m->high))), 0.0, 0.0};
}
static inline void fe__mesh_measures_add(fe__mesh_measures *sum, const fe_vec3 corner[3])
{
    fe_dvec3 v[3];
    for (int32_t k = 0; k < 3; ++k) v[k] = fe__dsub(fe__widen(corner[k]), sum->middle);
    fe_dvec3 n = fe__dcross(fe__dsub(v[1], v[0]), fe__dsub(v[2], v[0]));
    sum->area += 0.5 * sqrt(fe__ddot(n, n));
    sum->volume += fe__ddot(v[0], n) / 6.0;
}
static inline void fe__mesh_measures_end(const fe__mesh_measures *sum, fe__mesh *m)
{
    m->area = sum->area;
    m->volume = m->open_count + m->odd_count + m->flipped_count == 0 ? sum->volume : 0.0;
}

// ---- reading the definition ----------------------------------------------------------------------------------------
static inline uint32_t fe__mesh_source_index(const fe__mesh_source *s, int32_t triangle, int32_t corner)
{
    const unsigned char *record = s->indices + (size_t)s->index_stride * (size_t)triangle;
    if (s->is_short) {
        uint16_t index;
        memcpy(&index, record + 2 * corner, sizeof index);
        return index;
    }
    uint32_t index;
    memcpy(&index, record + 4 * corner, sizeof index);
    return index;
}
// -0 counts as 0
static inline fe_vec3 fe__mesh_source_vertex(const fe__mesh_source *s, uint32_t vertex)
{
    fe_vec3 v;
    memcpy(&v, s->vertices + (size_t)s->vertex_stride * vertex, sizeof v);
    return (fe_vec3){v.x + 0.0f, v.y + 0.0f, v.z + 0.0f};
}
static inline uint32_t fe__mesh_welded(const fe__mesh_builder *b, int32_t triangle, int32_t corner)
{
    return b->weld[fe__mesh_source_index(b->source, triangle, corner)];
}
static inline void fe__mesh_welded_corners(const fe__mesh_builder *b, int32_t triangle, fe_vec3 corner[3])
{
    for (int32_t k = 0; k < 3; ++k) corner[k] = fe__mesh_source_vertex(b->source, fe__mesh_welded(b, triangle, k));
}

#endif
