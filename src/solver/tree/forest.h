// forest.h - the joints that form trees, to be solved at once and exactly.
//
// A sweep passes an impulse on from joint to joint: a load of a thousand links' mass at the end of a chain takes a
// thousand sweeps to be felt at its top, and until then the chain stretches. Where joints close no loop, all of them
// can be met at once, in time that grows with their number alone (tree_solver.h). A tree is a set of dynamic bodies,
// the joints between them, and at most one joint to the rest of the world, whose bodies all count as one.
//
// The world finds the trees (world/joint_tree.c); the graph gives lines and rows to those that are awake.
#ifndef FE_SOLVER_TREE_FOREST_H
#define FE_SOLVER_TREE_FOREST_H
#include <stdint.h>

// A body and the joint that holds it to its parent. Parents come before their children; the root is first.
typedef struct fe__tree_link {
    int32_t body;
    int32_t joint;   // 0: the root of a tree that hangs on nothing
    int32_t parent;  // link of the body above, counted from the tree's first; -1: the root
    int32_t holds_b; // 1: the body is B of the joint, 0: A
    int32_t form;    // FE__TREE_BALL...
    int32_t tree;
    float carried; // mass of the body and of all below it, kg
} fe__tree_link;

// How a joint lets its bodies move against each other
enum {
    FE__TREE_ALONG = 7, // bits of the joint's axes x, y, z
    FE__TREE_ABOUT = 7 << 3,
    FE__TREE_BALL = 1 << 6, // about all, and a plain point: no other bit is set
    FE__TREE_ROD = 1 << 7   // of fixed length, along x
};

// When a tree is solved
typedef enum fe__tree_kind {
    FE__TREE_LIGHT, // from the sweep on that left a joint open, to the end of the step
    FE__TREE_SHORT, // in every substep, without a guess from the last: see warm_start.inl
    FE__TREE_ROPE, // likewise, short or heavy, of ball joints alone: they have no rows, the sweep knows nothing of them
    FE__TREE_HEAVY // likewise; without a guess only where it turns fast
} fe__tree_kind;

typedef struct fe__joint_tree {
    int32_t first, count; // links
    int32_t kind;         // fe__tree_kind
    uint32_t locks;       // of each of its bodies
    uint64_t form;        // of all links: trees of different ones are not alike
} fe__joint_tree;

typedef struct fe__forest {
    fe__joint_tree *trees;
    fe__tree_link *links;
    int32_t *link_of; // by joint: its link, -1: in no tree
    int32_t tree_count, link_count;
    int32_t capacity[3]; // of the arrays above
    // joints were linked or unlinked, or masses of joined bodies changed, since the trees were found
    int32_t changed;
} fe__forest;

// A number of the form of a tree's links
uint64_t fe__form_of_tree(const fe__tree_link *links, int32_t count, fe__tree_kind kind, uint32_t locks);
// 1: tree a of one forest and tree b of another, or of the same, have as many links, each with the same parent and the
// same form of joint, so that they may be solved side by side
int32_t fe__trees_are_alike(const fe__forest *forest, int32_t a, const fe__forest *other, int32_t b);

#endif
