// points.c - see points.h.
#include "world/points.h"

#include "world/pair_mix.h"

#include <assert.h>

static int32_t grow_order(fe_world *world, int64_t need)
{
    int32_t known = world->point_order_capacity;
    if (!FE_RESERVE(&world->memory, world->point_order, world->point_order_capacity, need)) return 0;
    for (int32_t i = known; i < world->point_order_capacity; ++i) world->point_order[i] = i;
    return 1;
}

// The first special row of a world: its extras are mixed before any is read
static int32_t grow_extras(fe_world *world, int64_t need)
{
    int32_t known = world->extra_capacity;
    if (!FE_RESERVE(&world->memory, world->extras, world->extra_capacity, need)) return 0;
    for (int32_t i = 1; i < world->pair_limit && !known; ++i)
        if (!(world->pairs[i].flags & FE__PAIR_FREE)) fe__pair_mix_surface(world, i);
    return 1;
}

int32_t fe__points_reserve(fe_world *world, int64_t more, int32_t with_extras)
{
    fe__memory *memory = &world->memory;
    int64_t need = atomic_load(&world->point_count) + more;
    return FE_RESERVE(memory, world->points, world->point_capacity, need) &&
           FE_RESERVE(memory, world->features, world->feature_capacity, need) &&
           FE_RESERVE(memory, world->point_serials, world->point_serial_capacity, 2 * need) &&
           grow_order(world, need) && (!with_extras || grow_extras(world, world->point_capacity));
}

void fe__points_take(fe_world *world, int32_t pair)
{
    int32_t place = atomic_fetch_add_explicit(&world->point_count, 1, memory_order_relaxed);
    assert(place < world->point_order_capacity);
    int32_t points = world->contacts[pair].points = world->point_order[place];
    world->points[points] = (fe__points){.twist_impulse = 0.0f};
    world->features[points] = (fe__features){.approach = 0.0f};
    for (int32_t side = 0; side < 2; ++side)
        world->point_serials[2 * points + side] = fe__pair_serial(world, pair, side);
    if (points >= world->extra_capacity) return;
    world->extras[points] = (fe__extra){.restitution = 0.0f};
    if (fe__extra_of(world, world->contacts + pair)) fe__pair_mix_surface(world, pair);
}

void fe__points_release(fe_world *world, int32_t pair)
{
    fe__contact *m = world->contacts + pair;
    if (!m->points) return;
    int32_t last = atomic_load_explicit(&world->point_count, memory_order_relaxed) - 1;
    atomic_store_explicit(&world->point_count, last, memory_order_relaxed);
    world->point_order[last] = m->points;
    m->points = 0;
    world->pairs[pair].left_out = 0;
}
