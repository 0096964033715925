// tree.h - an 8-wide tree of boxes, for pairs and rays.
//
// A node has 8 lanes; a lane holds a box and a child: an inner node (>= 0), a proxy (~child), or nothing
// (FE_TREE_EMPTY, with an inside-out box that no test ever hits). There are no leaf objects: a proxy's box is tested
// side by side with its neighbours'. A proxy is an index of the caller's (a shape). Boxes are floats relative to
// `origin`, rounded outwards: a test may say "meets" too often, never too seldom, and what decides is the caller's
// exact test. So the tree's form is invisible in every answer.
//
// Invariant: every node but the root has at least two children, so there are fewer nodes than proxies.
#ifndef FE_BROADPHASE_TREE_H
#define FE_BROADPHASE_TREE_H
#include "collision/form/form.h"
#include "core/memory.h"
#include "core/simd_sets.h"

// ---- tree -----------------------------------------------------------------------------------------------------------

enum { FE_TREE_WIDTH = 8 };
#define FE_TREE_EMPTY INT32_MIN

typedef struct fe__tree_node {
    _Alignas(64) float box[6][FE_TREE_WIDTH]; // rows 0-2 low, 3-5 high
    int32_t child[FE_TREE_WIDTH];
    int32_t parent, lane; // parent -1: the root, or dead
    int32_t spare[6];
} fe__tree_node;
_Static_assert(sizeof(fe__tree_node) == 256, "four cache lines");

typedef struct fe__tree_kernels fe__tree_kernels;

// All zeros is an empty tree.
typedef struct fe__tree {
    const fe__tree_kernels *kernels; // of a SIMD set, NULL: of plain C
    fe__tree_node *nodes;            // the root is the first
    int32_t node_count, node_capacity, dead;
    int32_t *slot; // of a proxy: node * 8 + lane, -1: not in this tree
    int32_t slot_capacity;
    int32_t proxy_count;
    int32_t promised; // insertions that were reserved and have not come
    int32_t depth;    // no node is deeper; the root's is 0
    float built_cost; // when it was last built, 0: never
    fe_dvec3 origin;
} fe__tree;

void fe__tree_destroy(fe__tree *tree, fe__memory *memory);
// Room for `extra` more proxies with indices below `limit`: the insertions that follow cannot fail. 0: no memory,
// nothing changed.
int32_t fe__tree_reserve(fe__tree *tree, fe__memory *memory, int32_t limit, int32_t extra);
// Bounds are finite, low <= high.
void fe__tree_insert(fe__tree *tree, int32_t proxy, const fe__bounds *fat);
void fe__tree_remove(fe__tree *tree, int32_t proxy);
// 1 while `tight` lies in the proxy's box: reads only, any thread
int32_t fe__tree_holds(const fe__tree *tree, int32_t proxy, const fe__bounds *tight);
// asks memory for that box
FE_FETCHES fe__tree_fetch(const fe__tree *tree, int32_t proxy)
{
    int32_t slot = proxy < tree->slot_capacity ? tree->slot[proxy] : -1;
    if (slot >= 0) fe__fetch(tree->nodes + slot / FE_TREE_WIDTH, sizeof tree->nodes->box);
}
void fe__tree_get(const fe__tree *tree, int32_t proxy, fe__bounds *out_box);
// 1: the boxes of two proxies do not meet
int32_t fe__tree_parts(const fe__tree *tree, int32_t proxy, int32_t other);
// New boxes for `count` proxies; refits what is above them (all nodes at once when many moved).
void fe__tree_move(fe__tree *tree, const int32_t *proxies, const fe__bounds *fat, int32_t count);
// Builds anew what of at most FE_TREES trees has degenerated (cost, dead nodes, depth, an origin far off), or all when
// `force`. Needs scratch memory: 0 when there is none, and every tree stays as it was: a new origin shows in the last
// bits of the boxes. What was reserved stays reserved.
enum { FE_TREES = 2 };
int32_t fe__trees_rebuild(fe__tree *const *trees, int32_t count, fe__memory *memory, int32_t force);

typedef int32_t (*fe__tree_visit)(void *context, int32_t proxy);
typedef double (*fe__tree_ray_visit)(void *context, int32_t proxy, double limit);
typedef struct fe__tree_way {
    fe_dvec3 origin, translation, half;
} fe__tree_way;

// ---- the walks, once for each SIMD set -----------------------------------------------------------------------------
// What they visit, and in what order, does not depend on the set. `low` and `high` are x y z of a box relative to the
// tree's origin; the tree is not empty.
typedef void fe__tree_query_kernel(const fe__tree *tree, const float low[3], const float high[3], fe__tree_visit visit,
                                   void *context);
struct fe__tree_kernels {
    fe__tree_query_kernel *query;
    double (*sweep)(const fe__tree *const *trees, int32_t tree_count, const fe__tree_way *way, double limit,
                    fe__tree_ray_visit visit, void *context);
    double (*nearest)(const fe__tree *tree, fe_dvec3 point, double limit, fe__tree_ray_visit visit, void *context);
};
extern const fe__tree_kernels FE_BASE_SET(fe__tree_kernels);
const fe__tree_kernels *fe__tree_kernels_of(int32_t simd); // of a set that was built, else of plain C
static inline const fe__tree_kernels *fe__kernels_of_tree(const fe__tree *tree)
{
    return tree->kernels ? tree->kernels : &FE_BASE_SET(fe__tree_kernels);
}

// ---- questions -----------------------------------------------------------------------------------------------------
// Proxies whose boxes meet `box`, each once. Depth first; the order is the tree's, so the caller sorts what it keeps.
// `visit` returns 0 to stop and must not change the tree. Reads only, any thread.
void fe__tree_query(const fe__tree *tree, const fe__bounds *box, fe__tree_visit visit, void *context);
// the same against the box the proxy has in `of` (margins included), which may be the same tree: then the proxy itself
// is visited too
void fe__tree_query_proxy(const fe__tree *tree, const fe__tree *of, int32_t proxy, fe__tree_visit visit, void *context);

// Proxies of one or two trees together whose boxes meet a box of half widths `half` at origin + t * translation, 0 <= t
// <= limit <= 1, each once, of a node's children the nearest first. `visit` gets the limit and returns the new one
// (never greater; below 0 stops). Boxes at exactly the limit are still visited, so that ties can be decided by the
// caller. Returns the last limit. Reads only, any thread.
static inline double fe__tree_sweep(const fe__tree *const *trees, int32_t tree_count, const fe__tree_way *way,
                                    double limit, fe__tree_ray_visit visit, void *context)
{
    return fe__kernels_of_tree(trees[0])->sweep(trees, tree_count, way, limit, visit, context);
}
static inline double fe__tree_ray(const fe__tree *tree, fe_dvec3 origin, fe_dvec3 translation, double limit,
                                  fe__tree_ray_visit visit, void *context)
{
    const fe__tree_way way = {origin, translation, {0.0, 0.0, 0.0}};
    return fe__tree_sweep(&tree, 1, &way, limit, visit, context);
}

// Proxies whose boxes are no farther from a point than `limit` m, each once, of a node's children the nearest first.
// `visit` returns the new limit as above. Reads only, any thread.
static inline double fe__tree_nearest(const fe__tree *tree, fe_dvec3 point, double limit, fe__tree_ray_visit visit,
                                      void *context)
{
    return fe__kernels_of_tree(tree)->nearest(tree, point, limit, visit, context);
}

// ---- tree check -----------------------------------------------------------------------------------------------------
// Trees that come from bytes.

// Does it hang together? Each node that is not dead is met once, links lead both ways, boxes hold what is below them,
// as many proxies and nodes as are counted, no deeper than told. `takes` says whether a proxy may be there: it is below
// the capacity of `slot`, whose entries are -1 and are set here. *out_node: where it does not.
int32_t fe__tree_check(fe__tree *tree, int32_t (*takes)(void *context, int32_t proxy), void *context,
                       int32_t *out_node);

#endif
