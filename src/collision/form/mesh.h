// mesh.h - a mesh of triangles as rays and the narrow phase read it: leaves of four triangles under a tree of eight
// children a node.
//
// collision/mesh_build makes it, a store owns it, and nothing of it changes but its materials. One block of memory
// holds all arrays, without pointers inside: the same definition makes the same bytes on every machine.
#ifndef FE_COLLISION_FORM_MESH_H
#define FE_COLLISION_FORM_MESH_H
#include "collision/form/form.h"

// ---- mesh -----------------------------------------------------------------------------------------------------------
// Slots. Triangles stand in the order of the tree: slot 4 l + k is triangle k of leaf l. All leaves are full but the
// last. `numbers` is a permutation of the caller's triangle numbers: first the numbers of the slots, then the numbers
// of the triangles that were dropped.
//
// Vertices are floats as the caller gave them. A leaf names its corners by bytes, counted from the first vertex of its
// group; a vertex that several groups need stands in each, with the same bits.
//
// Nodes. A node's children are all nodes, or all leaves, and stand one after another. Their boxes are counted in steps
// from the node's low corner, 2^exponent m a step on each axis, and rounded outwards: no vertex is outside.
//
// Scale. A mesh under a scale has the arrays of its asset, so that vertices and nodes are unscaled, m. A reader of a
// vertex multiplies it in double, where the product is exact. A walk down the tree multiplies the boxes, or divides the
// box or ray that it looks for. In a mirror the second and the third corner change places, so that the outside stays
// outside.

enum {
    FE__MESH_TRIANGLES = 1 << 27, // A definition has at most so many triangles.
    FE__MESH_VERTICES = 1 << 28,  // A definition has at most so many vertices.
    FE__MESH_MATERIALS = 255,
    FE__MESH_WIDTH = 8,            // A node has at most so many children.
    FE__MESH_LEAF = 4,             // A leaf has so many triangles.
    FE__MESH_GROUP = 256,          // A byte can name so many vertices: they are a group.
    FE__MESH_DEPTH = 64,           // The tree has at most so many levels.
    FE__MESH_LEAST_EXPONENT = -40, // A step is 2 to this power or more.
    FE__MESH_SHORTCUT = 32         // A cycle of `numbers` has a shortcut after so many elements.
};

// The kinds of a triangle's edges. A body feels an edge if it may push along the edge's own normals.
typedef enum fe__mesh_edge {
    FE__MESH_EDGE_SMOOTH, // The edge is flat or concave and is not felt.
    FE__MESH_EDGE_BENT,   // It is convex by so little that it is not felt.
    FE__MESH_EDGE_CONVEX, // It is felt.
    FE__MESH_EDGE_OPEN,   // It has no neighbour and is felt.
    FE__MESH_EDGE_ODD,    // More than two triangles share it, or two that wind against each other: it is felt.
    FE__MESH_EDGES
} fe__mesh_edge;

typedef struct fe__mesh_leaf {
    uint32_t first_vertex; // first vertex of the leaf's group
    uint8_t corner[FE__MESH_LEAF][3];
} fe__mesh_leaf;
_Static_assert(sizeof(fe__mesh_leaf) == 16, "four bytes a triangle");

typedef struct fe__mesh_node {
    float origin[3]; // low corner of the node's box, m
    int8_t exponent[3];
    uint8_t count;  // number of children, 1..8
    uint32_t first; // first child: leaf `first` - FE__MESH_LEAVES if that bit is set, else node `first`
    uint8_t low[3][FE__MESH_WIDTH], high[3][FE__MESH_WIDTH];
} fe__mesh_node;
_Static_assert(sizeof(fe__mesh_node) == 68, "a node has no padding");
#define FE__MESH_LEAVES 0x80000000u

// A shortcut leads from element `from` of a cycle of `numbers` back to element `to`, FE__MESH_SHORTCUT before it.
typedef struct fe__mesh_shortcut {
    int32_t from, to;
} fe__mesh_shortcut;
#define FE__MESH_HAS_SHORTCUT 0x80000000u // bit of an element of `numbers`

typedef struct fe__mesh {
    int32_t triangle_count;    // slots
    int32_t given_count;       // triangles of the definition
    int32_t vertex_count;      // vertices of all groups together
    int32_t node_count, depth; // size of the tree
    int32_t shortcut_count;
    int32_t is_two_sided;
    int32_t is_scaled, is_mirrored;
    double scale[3];   // 1 each, or the scale of the shapes with this mesh
    fe_vec3 low, high; // bounds, scaled
    // The builder's counts for the definition: vertices that differ, triangles that were dropped, edges by kind.
    int32_t welded_count;
    int32_t degenerate_count, duplicate_count, open_count, odd_count, flipped_count;
    double area, volume; // m2; m3, 0 unless the mesh is closed

    // All arrays lie in `block`.
    const float *vertices; // x y z
    const fe__mesh_leaf *leaves;
    const fe__mesh_node *nodes;         // [0] is the root
    const uint32_t *numbers;            // [given_count]
    const fe__mesh_shortcut *shortcuts; // sorted by `from`
    const uint32_t *data;               // the caller's data for each slot, NULL: none
    const uint8_t *edges;     // for each slot: fe__mesh_edge of corner 0 to 1, 1 to 2, 2 to 0, as digits to base 5
    const uint8_t *materials; // for each slot, NULL: none
    void *block;
    int64_t size; // size of the block, bytes
} fe__mesh;

static inline int32_t fe__mesh_leaf_count(int32_t triangle_count)
{
    return (int32_t)(((int64_t)triangle_count + FE__MESH_LEAF - 1) / FE__MESH_LEAF);
}
static inline int32_t fe__mesh_number(const fe__mesh *mesh, int32_t slot)
{
    return (int32_t)(mesh->numbers[slot] & ~FE__MESH_HAS_SHORTCUT);
}
// The number of the asset's corner that is corner `corner` of the scaled triangle.
static inline int32_t fe__mesh_own_corner(const fe__mesh *mesh, int32_t corner)
{
    return mesh->is_mirrored && corner ? 3 - corner : corner;
}
// The unscaled corner of the asset's triangle.
static inline const float *fe__mesh_vertex(const fe__mesh *mesh, int32_t slot, int32_t corner)
{
    const fe__mesh_leaf *leaf = mesh->leaves + slot / FE__MESH_LEAF;
    return mesh->vertices + 3 * ((size_t)leaf->first_vertex + leaf->corner[slot % FE__MESH_LEAF][corner]);
}
// 2^exponent
static inline double fe__mesh_power(int32_t exponent)
{
    union {
        uint64_t bits;
        double value;
    } power = {(uint64_t)(1023 + exponent) << 52};
    return power.value;
}
// The length of a step on an axis, m, and its inverse.
static inline double fe__mesh_step(const fe__mesh_node *node, int32_t axis)
{
    return fe__mesh_power(node->exponent[axis]);
}
static inline double fe__mesh_per_step(const fe__mesh_node *node, int32_t axis)
{
    return fe__mesh_power(-node->exponent[axis]);
}

// The form of a shape with this mesh; `index` is the index of its record.
fe__form fe__mesh_form(const fe__mesh *mesh, int32_t index);

// Finds the slot of a triangle by its number, in at most 2 FE__MESH_SHORTCUT steps. A slot of triangle_count or more
// means that the triangle was dropped.
int32_t fe__mesh_slot(const fe__mesh *mesh, int32_t number);
// The kind of the scaled triangle's side from that corner to the next, and the corners of the scaled triangle.
fe__mesh_edge fe__mesh_edge_of(const fe__mesh *mesh, int32_t slot, int32_t corner);
void fe__mesh_corners(const fe__mesh *mesh, int32_t slot, fe_dvec3 corner[3]);

// ---- mesh walk ------------------------------------------------------------------------------------------------------
// The walk finds the triangles of a mesh near a box, in the order of their slots.

enum {
    // All children of each level but the one that is looked into wait on the stack.
    FE__MESH_WALK_STACK = FE__MESH_DEPTH * (FE__MESH_WIDTH - 1) + FE__MESH_WIDTH,
    FE__MESH_NEAR = 64
};

// The bounds of a triangle, unscaled; the fourth numbers mean nothing.
typedef struct fe__mesh_span {
    _Alignas(16) float low[4], high[4];
} fe__mesh_span;

// The triangles near a box. They are found once; walks for boxes inside of this one then need not go down the tree.
typedef struct fe__mesh_near {
    fe__bounds box; // in the mesh's frame
    int32_t count;  // number of triangles; -1: there are more than fit
    // terrain_course.h marks here the triangles that a moving form may touch; without it these fields are 0.
    int32_t is_all;      // All triangles that the form may touch are here.
    uint64_t among;      // bit i: it may touch triangle i on its way
    uint64_t among_last; // bit i: it may touch triangle i at the end of its way
    float margin;        // The form may touch triangles that it comes nearer to than this, m.
    int32_t slots[FE__MESH_NEAR];
    fe__mesh_span spans[FE__MESH_NEAR];
} fe__mesh_near;

typedef struct fe__mesh_walk {
    const fe__mesh *mesh;
    const fe__mesh_near *near;          // walked instead of the tree, or NULL
    fe__bounds box;                     // in the frame of the vertices, unscaled
    _Alignas(16) float low[4], high[4]; // the least and the greatest float in the box; the fourth is 0
    fe_dvec3 origin;                    // in the mesh's frame
    int32_t slot, end;                  // next slot and end of the leaf, or places in `near`
    int32_t top;
    uint32_t stack[FE__MESH_WALK_STACK]; // children that wait, below `top`
} fe__mesh_walk;

// `near` may be NULL. It is used if the box is inside of its box.
void fe__mesh_walk_begin(fe__mesh_walk *walk, const fe__mesh *mesh, const fe__mesh_near *near, const fe__bounds *box,
                         fe_dvec3 origin);
// Gives the scaled triangle, its vertices relative to the origin.
void fe__mesh_triangle(const fe__mesh *mesh, int32_t slot, fe_dvec3 origin, fe__form *triangle);
void fe__mesh_find_near(const fe__mesh *mesh, const fe__bounds *box, fe__mesh_near *near);
// Returns the slot of the next triangle whose bounds meet the box; a scaled mesh gives some that all but meet it. The
// triangle's vertices are relative to the walk's origin. -1: no more
int32_t fe__mesh_walk_next(fe__mesh_walk *walk, fe__form *triangle);
int32_t fe__mesh_walk_next_slot(fe__mesh_walk *walk);

#endif
