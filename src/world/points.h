// points.h - records of points: what a pair has only from its first points until they are gone.
//
// A linked pair has one; a sensor keeps what it was given until it ends; of the others those have one that the narrow
// phase of this step found points for. Two thirds of a heap's pairs are near misses and cost none. Points, features and
// extras share the index. As a step may not allocate once it changes the world, records are reserved for all pairs
// without that it may look at; then any thread may take one. Which one it gets shows nowhere: nothing goes over records
// in the order of their indices.
#ifndef FE_WORLD_POINTS_H
#define FE_WORLD_POINTS_H
#include "world/world.h"

// Room for so many beside those in use; with extras for special rows, or without. 0: no memory
int32_t fe__points_reserve(fe_world *world, int64_t more, int32_t with_extras);
// Of a pair that has none: zeros, but for its extra. Any thread, in a step that reserved it
void fe__points_take(fe_world *world, int32_t pair);
void fe__points_release(fe_world *world, int32_t pair); // nothing, if it has none

// Of shape A (0) or B (1): the order of everything. Numbers of patches make their serials theirs alone
enum { FE__PATCH_SHIFT = 56 };
static inline uint64_t fe__pair_serial(const fe_world *world, int32_t pair, int32_t side)
{
    const fe__pair *p = world->pairs + pair;
    if (!side) return world->shapes[p->shape_a].serial;
    return world->shapes[p->shape_b].serial | (uint64_t)(p->flags >> FE__PAIR_NUMBER_SHIFT) << FE__PATCH_SHIFT;
}

static inline fe__points *fe__points_of(const fe_world *world, const fe__contact *m)
{
    return world->points + m->points;
}

// Of a special row; NULL: it has none, all in it would be 0
static inline fe__extra *fe__extra_of(const fe_world *world, const fe__contact *m)
{
    return m->points && m->kind & FE__ROW_SPECIAL && m->points < world->extra_capacity ? world->extras + m->points
                                                                                       : NULL;
}

#endif
