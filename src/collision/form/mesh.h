// mesh.h - a mesh of triangles as rays and the narrow phase read it: leaves of four triangles under a tree of eight
// children a node.
//
// collision/mesh_build makes it, a store owns it, and nobody changes it but its materials. One block of memory holds
// all arrays, without pointers inside: the same definition makes the same bytes on every machine.
//
// Slots. Triangles stand in the order of the tree: slot 4 l + k is triangle k of leaf l. All leaves are full but the
// last. `numbers` is a permutation of the caller's triangle numbers: those of the slots, then those that were dropped.
//
// Vertices are floats as the caller gave them. A leaf names its corners by bytes, counted from the first vertex of its
// group; a vertex that several groups need stands in each, with the same bits.
//
// Nodes. A node's children are all nodes, or all leaves, and stand one after another. Their boxes are counted in steps
// from the node's low corner, 2^exponent m a step on each axis, and rounded outwards: no vertex is outside.
//
// Scale. A mesh under a scale has the arrays of its asset: vertices and nodes are the asset's, m. Who reads a vertex
// multiplies it, in double, where the product is exact; who goes down the tree does so with the boxes, or divides what
// is looked for. In a mirror the second and the third corner change places, so that the outside stays outside.
#ifndef FE_COLLISION_FORM_MESH_H
#define FE_COLLISION_FORM_MESH_H
#include "collision/form/form.h"

// ---- mesh -----------------------------------------------------------------------------------------------------------

enum {
    FE__MESH_TRIANGLES = 1 << 27, // of a definition, at most
    FE__MESH_VERTICES = 1 << 28,  // likewise
    FE__MESH_MATERIALS = 255,
    FE__MESH_WIDTH = 8,            // children of a node
    FE__MESH_LEAF = 4,             // triangles of a leaf
    FE__MESH_GROUP = 256,          // vertices of a group: what a byte names
    FE__MESH_DEPTH = 64,           // of the tree, at most
    FE__MESH_LEAST_EXPONENT = -40, // of a step
    FE__MESH_SHORTCUT = 32         // elements of a cycle of `numbers` from one shortcut to the next
};

// What an edge of a triangle is
typedef enum fe__mesh_edge {
    FE__MESH_EDGE_SMOOTH, // flat or concave: not felt
    FE__MESH_EDGE_BENT,   // convex, by less than is felt
    FE__MESH_EDGE_CONVEX, // felt
    FE__MESH_EDGE_OPEN,   // without a neighbour: felt
    FE__MESH_EDGE_ODD,    // of more than two triangles, or of two that wind against each other: felt
    FE__MESH_EDGES
} fe__mesh_edge;

typedef struct fe__mesh_leaf {
    uint32_t first_vertex; // of its group
    uint8_t corner[FE__MESH_LEAF][3];
} fe__mesh_leaf;
_Static_assert(sizeof(fe__mesh_leaf) == 16, "four bytes a triangle");

typedef struct fe__mesh_node {
    float origin[3]; // its low corner, m
    int8_t exponent[3];
    uint8_t count;  // of children, 1..8
    uint32_t first; // child: leaf `first` - FE__MESH_LEAVES when that bit is set, else node `first`
    uint8_t low[3][FE__MESH_WIDTH], high[3][FE__MESH_WIDTH];
} fe__mesh_node;
_Static_assert(sizeof(fe__mesh_node) == 68, "a node has no padding");
#define FE__MESH_LEAVES 0x80000000u

// From element `to` of a cycle of `numbers` back to the one FE__MESH_SHORTCUT before it
typedef struct fe__mesh_shortcut {
    int32_t from, to;
} fe__mesh_shortcut;
#define FE__MESH_HAS_SHORTCUT 0x80000000u // in `numbers`

typedef struct fe__mesh {
    int32_t triangle_count;    // slots
    int32_t given_count;       // triangles of the definition
    int32_t vertex_count;      // in all groups
    int32_t node_count, depth; // of the tree
    int32_t shortcut_count;
    int32_t is_two_sided;
    int32_t is_scaled, is_mirrored;
    double scale[3];   // 1 each, or that of the shapes that have it
    fe_vec3 low, high; // bounds, scaled
    // of the definition
    int32_t welded_count; // vertices that differ
    int32_t degenerate_count, duplicate_count, open_count, odd_count, flipped_count;
    double area, volume; // m2; m3, 0 unless it is closed

    // into `block`
    const float *vertices; // x y z
    const fe__mesh_leaf *leaves;
    const fe__mesh_node *nodes;         // 0: the root
    const uint32_t *numbers;            // given_count
    const fe__mesh_shortcut *shortcuts; // by `from`
    const uint32_t *data;               // of slots, NULL: none
    const uint8_t *edges;               // of slots: fe__mesh_edge of corner 0 to 1, 1 to 2, 2 to 0, as digits to base 5
    const uint8_t *materials;           // of slots, NULL: none
    void *block;
    int64_t size; // of the block, bytes
} fe__mesh;

static inline int32_t fe__mesh_leaf_count(int32_t triangle_count)
{
    return (int32_t)(((int64_t)triangle_count + FE__MESH_LEAF - 1) / FE__MESH_LEAF);
}
static inline int32_t fe__mesh_number(const fe__mesh *mesh, int32_t slot)
{
    return (int32_t)(mesh->numbers[slot] & ~FE__MESH_HAS_SHORTCUT);
}
// The corner of the asset's triangle that is corner `corner` of the scaled one
static inline int32_t fe__mesh_own_corner(const fe__mesh *mesh, int32_t corner)
{
    return mesh->is_mirrored && corner ? 3 - corner : corner;
}
// Unscaled
static inline const float *fe__mesh_vertex(const fe__mesh *mesh, int32_t slot, int32_t corner)
{
    const fe__mesh_leaf *leaf = mesh->leaves + slot / FE__MESH_LEAF;
    return mesh->vertices + 3 * ((size_t)leaf->first_vertex + leaf->corner[slot % FE__MESH_LEAF][corner]);
}
static inline double fe__mesh_power(int32_t exponent) // of 2
{
    union {
        uint64_t bits;
        double value;
    } power = {(uint64_t)(1023 + exponent) << 52};
    return power.value;
}
// 2^exponent, m, and what of it is 1
static inline double fe__mesh_step(const fe__mesh_node *node, int32_t axis)
{
    return fe__mesh_power(node->exponent[axis]);
}
static inline double fe__mesh_per_step(const fe__mesh_node *node, int32_t axis)
{
    return fe__mesh_power(-node->exponent[axis]);
}

// The form of a shape that has it; `index` is its record's.
fe__form fe__mesh_form(const fe__mesh *mesh, int32_t index);

// The slot of a triangle by its number, in at most 2 FE__MESH_SHORTCUT steps; at least triangle_count: it was dropped.
int32_t fe__mesh_slot(const fe__mesh *mesh, int32_t number);
// Of the side from that corner to the next, and the corners: of the scaled triangle
fe__mesh_edge fe__mesh_edge_of(const fe__mesh *mesh, int32_t slot, int32_t corner);
void fe__mesh_corners(const fe__mesh *mesh, int32_t slot, fe_dvec3 corner[3]);

// ---- mesh walk ------------------------------------------------------------------------------------------------------
// The triangles of a mesh near a box, in the order of their slots.

// Children that wait: of each level all but the one that is looked into
enum { FE__MESH_WALK_STACK = FE__MESH_DEPTH * (FE__MESH_WIDTH - 1) + FE__MESH_WIDTH };

enum { FE__MESH_NEAR = 64 };

// The bounds of a triangle, unscaled; the fourth numbers mean nothing
typedef struct fe__mesh_span {
    _Alignas(16) float low[4], high[4];
} fe__mesh_span;

// The triangles near a box: who asks for those near boxes inside of it again and again need not go down the tree
typedef struct fe__mesh_near {
    fe__bounds box; // in the mesh's frame
    int32_t count;  // of triangles; -1: there are more
    // of a form's way (terrain_course.h), else 0: are all triangles here that it may touch, and a bit for each of them:
    // on the way, and at its end
    int32_t is_all;
    uint64_t among, among_last;
    float margin; // m, that it comes nearer to
    int32_t slots[FE__MESH_NEAR];
    fe__mesh_span spans[FE__MESH_NEAR];
} fe__mesh_near;

typedef struct fe__mesh_walk {
    const fe__mesh *mesh;
    const fe__mesh_near *near;          // walked instead of the tree, or NULL
    fe__bounds box;                     // in the frame of its vertices, unscaled
    _Alignas(16) float low[4], high[4]; // the least and the greatest of the floats in it; the fourth is 0
    fe_dvec3 origin;                    // in the mesh's
    int32_t slot, end;                  // of the leaf, or places in `near`
    int32_t top;
    uint32_t stack[FE__MESH_WALK_STACK]; // up to `top`
} fe__mesh_walk;

// `near` may be NULL, and serves where the box is inside of its own.
void fe__mesh_walk_begin(fe__mesh_walk *walk, const fe__mesh *mesh, const fe__mesh_near *near, const fe__bounds *box,
                         fe_dvec3 origin);
// Its vertices relative to the origin
void fe__mesh_triangle(const fe__mesh *mesh, int32_t slot, fe_dvec3 origin, fe__form *triangle);
void fe__mesh_find_near(const fe__mesh *mesh, const fe__bounds *box, fe__mesh_near *near);
// Slot of the next triangle whose bounds meet the box or, of a scaled mesh, all but meet it, its vertices relative to
// the walk's origin; -1: no more.
int32_t fe__mesh_walk_next(fe__mesh_walk *walk, fe__form *triangle);
int32_t fe__mesh_walk_next_slot(fe__mesh_walk *walk); // the slot alone

#endif
