// mesh_walk.h - the triangles of a mesh near a box, in the order of their slots.
#ifndef FE_COLLISION_FORM_MESH_WALK_H
#define FE_COLLISION_FORM_MESH_WALK_H
#include "collision/form/form.h"
#include "collision/form/mesh.h"

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
