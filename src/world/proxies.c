// proxies.c - boxes of shapes, and their places in the trees and in the list of planes.
#include "world/proxies.h"

#include "collision/form/hull.h"
#include "world/contact.h"

// A box in a tree is larger than its shape by half the speculative distance, for shapes no further apart than that must
// have a pair, and by a share of its size, so that a body may move a while before its tree changes: larger ones move
// further before it matters. A larger share makes more pairs that never touch: in a heap of mixed bodies a share of
// 0.12 makes 1.2 times as many, and costs 3 to 11 % of a step.
#define FAT_SHARE 0.05 // times the largest half extent
#define FAT_MOST 0.05  // m
// The box also reaches to where the body will be after so many steps at its velocity: pairs must exist before the
// shapes meet.
#define STEPS_AHEAD 2.0f
#define FIRST_DT (1.0f / 60.0f) // s, before the first step

// ---- bounds ---------------------------------------------------------------------------------------------------------

static fe__bounds grown(fe__bounds b, double margin)
{
    return (fe__bounds){{b.low.x - margin, b.low.y - margin, b.low.z - margin},
                        {b.high.x + margin, b.high.y + margin, b.high.z + margin}};
}

static inline fe__bounds bounds_of(const fe__shape *shape, float margin)
{
    return grown(fe__form_bounds(&shape->form, &shape->pose), (double)margin);
}

fe__bounds fe__shape_bounds(const fe_world *world, int32_t index, float margin)
{
    return bounds_of(world->shapes + index, margin);
}

// Extends a box by the way of the body in so many steps.
static fe__bounds swept(const fe_world *world, const fe__shape *shape, fe__bounds b, float steps)
{
    const fe__body *body = world->bodies + shape->body;
    double dt = (double)(steps * (world->last_dt > 0.0f ? world->last_dt : FIRST_DT));
    fe_dvec3 travel = fe__dscale(dt, fe__widen(fe__quad_vector(body->velocity)));
    b.low = fe__dadd(b.low, (fe_dvec3){fe__mind(travel.x, 0.0), fe__mind(travel.y, 0.0), fe__mind(travel.z, 0.0)});
    b.high = fe__dadd(b.high, (fe_dvec3){fe__maxd(travel.x, 0.0), fe__maxd(travel.y, 0.0), fe__maxd(travel.z, 0.0)});
    return b;
}

static float half_gap(const fe_world *world) { return 0.5f * world->tuning.speculative_distance; }

fe__bounds fe__shape_fat_bounds(const fe_world *world, int32_t index)
{
    const fe__shape *shape = world->shapes + index;
    fe__bounds b = bounds_of(shape, 0.0f);
    fe_dvec3 size = fe__dsub(b.high, b.low);
    double half = 0.5 * fe__maxd(fe__maxd(size.x, size.y), size.z);
    b = swept(world, shape, b, STEPS_AHEAD);
    return grown(b, (double)half_gap(world) + fe__mind(FAT_MOST, FAT_SHARE * half));
}

// ---- broad phase ----------------------------------------------------------------------------------------------------

static const fe__tree *tree_containing(const fe_world *world, const fe__shape *shape)
{
    return world->bodies[shape->body].type == FE_BODY_STATIC ? &world->static_tree : &world->moving_tree;
}

static fe__tree *tree_of(fe_world *world, const fe__shape *shape)
{
    return world->bodies[shape->body].type == FE_BODY_STATIC ? &world->static_tree : &world->moving_tree;
}

int32_t fe__reserve_proxies(fe_world *world, int32_t body_type, int32_t extra)
{
    fe__memory *memory = &world->memory;
    int32_t limit = world->shape_capacity;
    fe__tree *tree = body_type == FE_BODY_STATIC ? &world->static_tree : &world->moving_tree;
    return FE_RESERVE(memory, world->moved, world->moved_capacity, limit) &&
           FE_RESERVE(memory, world->planes, world->plane_capacity, (int64_t)world->plane_count + extra) &&
           fe__tree_reserve(tree, memory, limit, extra);
}

void fe__shape_mark_moved(fe_world *world, int32_t index)
{
    fe__shape *shape = &world->shapes[index];
    if (shape->flags & FE__SHAPE_MOVED || !(shape->flags & (FE__SHAPE_IN_TREE | FE__SHAPE_IN_PLANES))) return;
    shape->flags |= FE__SHAPE_MOVED;
    world->moved[world->moved_count++] = index;
}

void fe__shape_enter(fe_world *world, int32_t index)
{
    fe__shape *shape = &world->shapes[index];
    if (fe__form_is_of_parts(&shape->form)) return;
    if (fe__form_is_unbounded(&shape->form)) {
        shape->flags |= FE__SHAPE_IN_PLANES;
        world->planes[world->plane_count++] = index;
    } else {
        fe__bounds fat = fe__shape_fat_bounds(world, index);
        shape->flags |= FE__SHAPE_IN_TREE;
        fe__tree_insert(tree_of(world, shape), index, &fat);
    }
    fe__shape_mark_moved(world, index);
}

int32_t fe__shape_is_held(const fe_world *world, int32_t index)
{
    const fe__shape *shape = world->shapes + index;
    const fe__tree *tree = tree_containing(world, shape);
    double margin = (double)half_gap(world);
    fe__bounds rough = swept(world, shape, grown(fe__form_rough_bounds(&shape->form, &shape->pose), margin), 1.0f);
    int32_t held = fe__tree_holds(tree, index, &rough);
    if (held || !fe__form_is_hull(&shape->form)) return held;
    fe__bounds tight = swept(world, shape, bounds_of(shape, half_gap(world)), 1.0f);
    return fe__tree_holds(tree, index, &tight);
}

// FE__SHAPE_MOVED stays: the list still names the slot, and the next shape in it is in the list already.
void fe__shape_leave(fe_world *world, int32_t index)
{
    fe__shape *shape = &world->shapes[index];
    if (shape->flags & FE__SHAPE_IN_TREE) fe__tree_remove(tree_of(world, shape), index);
    if (shape->flags & FE__SHAPE_IN_PLANES) {
        int32_t place = 0;
        while (world->planes[place] != index) ++place;
        world->planes[place] = world->planes[--world->plane_count];
    }
    shape->flags &= ~(uint32_t)(FE__SHAPE_IN_TREE | FE__SHAPE_IN_PLANES);
}

void fe__shape_touch(fe_world *world, int32_t index)
{
    const fe__shape *shape = &world->shapes[index];
    if (shape->flags & FE__SHAPE_IN_TREE) {
        fe__bounds fat = fe__shape_fat_bounds(world, index);
        fe__tree_move(tree_of(world, shape), &index, &fat, 1);
    }
    fe__shape_mark_moved(world, index);
}

void fe__body_stretch_boxes(fe_world *world, int32_t index)
{
    for (int32_t i = world->bodies[index].first_shape; i >= 0; i = world->shapes[i].next) {
        int32_t in_tree = world->shapes[i].flags & FE__SHAPE_IN_TREE;
        if (in_tree && !fe__shape_is_held(world, i)) fe__shape_touch(world, i);
    }
}

int32_t fe__plane_comes_near(const fe_world *world, int32_t index, const fe__bounds *box)
{
    const fe__shape *plane = world->shapes + index;
    return fe__plane_meets_box(&plane->form, &plane->pose, box, (double)half_gap(world));
}

int32_t fe__boxes_part(const fe_world *world, const fe__pair *p)
{
    fe__bounds box_a, box_b;
    const fe__shape *a = world->shapes + p->shape_a, *b = world->shapes + p->shape_b;
    const fe__tree *tree_a = tree_containing(world, a), *tree_b = tree_containing(world, b);
    int32_t in_trees = (a->flags & b->flags & FE__SHAPE_IN_TREE) != 0;
    if (in_trees && tree_a == tree_b) return fe__tree_parts(tree_a, p->shape_a, p->shape_b);
    if (a->flags & FE__SHAPE_IN_TREE) fe__tree_get(tree_a, p->shape_a, &box_a);
    if (b->flags & FE__SHAPE_IN_TREE) fe__tree_get(tree_b, p->shape_b, &box_b);
    if (a->flags & FE__SHAPE_IN_PLANES) return !fe__plane_comes_near(world, p->shape_a, &box_b);
    if (b->flags & FE__SHAPE_IN_PLANES) return !fe__plane_comes_near(world, p->shape_b, &box_a);
    return box_a.high.x < box_b.low.x || box_b.high.x < box_a.low.x || box_a.high.y < box_b.low.y ||
           box_b.high.y < box_a.low.y || box_a.high.z < box_b.low.z || box_b.high.z < box_a.low.z;
}
