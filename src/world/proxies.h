// proxies.h - the places of shapes in the broad phase.
//
// A shape of a static body lives in the static tree, one of a moving body in the moving tree, planes in a list; a shape
// of a disabled body in none. A new place is noted in fe_world.moved, from which the next step finds new pairs.
#ifndef FE_WORLD_PROXIES_H
#define FE_WORLD_PROXIES_H
#include "world/contact.h"
#include "world/world.h"

fe__bounds fe__shape_bounds(const fe_world *world, int32_t shape, float margin);
// 1: its box in the tree holds the shape, and all that it may reach in a step
int32_t fe__shape_is_held(const fe_world *world, int32_t shape);
// 1: the box of another shape, as a tree holds it, comes near the plane. Planes are in no tree, and grow here.
int32_t fe__plane_comes_near(const fe_world *world, int32_t plane, const fe__bounds *box);
fe__bounds fe__shape_fat_bounds(const fe_world *world, int32_t shape); // as the trees hold them

int32_t fe__reserve_proxies(fe_world *world, int32_t body_type, int32_t extra); // 0: no memory
void fe__shape_enter(fe_world *world, int32_t shape); // into its tree or list, after fe__reserve_proxies
void fe__shape_leave(fe_world *world, int32_t shape);
void fe__shape_touch(fe_world *world, int32_t shape);       // after a change of pose or form: a new box, new pairs
void fe__shape_mark_moved(fe_world *world, int32_t shape);  // looks for pairs in the next step
void fe__body_stretch_boxes(fe_world *world, int32_t body); // renews boxes that no longer hold all that it may reach
int32_t fe__boxes_part(const fe_world *world, const fe__pair *pair); // 1: they no longer meet

#endif
