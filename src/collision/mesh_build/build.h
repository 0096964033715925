// build.h - a mesh from any triangles: from the caller's arrays to the record of form/mesh.h.
//
//   weld     vertices that are one                                       weld.c
//   edges    duplicates found, edges told by what meets there            edges.c
//   tree     triangles sorted into leaves, and the nodes above           tree.c
//   layout   groups of vertices, leaves, numbers, measures               layout.c, numbers.c
//
// Memory is had in three pieces, whose sizes are known before each: `room`, which lives until the mesh is written;
// `scratch`, which is given back before the mesh's block is had; the block. Of 2 million triangles and half as many
// vertices they take 91 MB at most.
#ifndef FE_COLLISION_MESH_BUILD_BUILD_H
#define FE_COLLISION_MESH_BUILD_BUILD_H
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
// Both zeroed and aligned to 64. 0: refused, see `refusal`.
int32_t fe__mesh_build(fe__mesh_builder *room, void *scratch, const fe__mesh_source *source);
// Then, without scratch: the size of the block.
int64_t fe__mesh_block_size(fe__mesh_builder *builder);
// `block`: so many bytes, zeroed, aligned to 64.
void fe__mesh_write(fe__mesh_builder *builder, void *block, fe__mesh *out_mesh);

// ---- steps ---------------------------------------------------------------------------------------------------------
int64_t fe__mesh_weld_size(const fe__mesh_source *source);
void fe__mesh_weld(fe__mesh_builder *builder);
int64_t fe__mesh_edges_size(const fe__mesh_source *source);
void fe__mesh_find_edges(fe__mesh_builder *builder);
int64_t fe__mesh_tree_size(const fe__mesh_source *source);
int32_t fe__mesh_node_room(int32_t triangle_count);
void fe__mesh_build_tree(fe__mesh_builder *builder);
// Marks them in `numbers`, a permutation, and writes them by `from`; returns how many. `seen`: count / 8 + 1 bytes
int32_t fe__mesh_shortcuts(uint32_t *numbers, int32_t count, uint8_t *seen, fe__mesh_shortcut *out);

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
