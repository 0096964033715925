// ignore.c - see ignore.h.
#include "world/ignore.h"

#include "world/pairs.h"
#include "world/proxies.h"
#include "world/sleep.h"

fe_result fe__ignore_collision(fe_world *world, int32_t a, int32_t b, int32_t ignore)
{
    int32_t ignored = fe__pair_set_find(&world->ignored, a, b) >= 0;
    if (ignored == ignore) return FE_OK;
    if (!ignore) {
        fe__pair_set_remove(&world->ignored, a, b);
        for (int32_t i = world->bodies[a].first_shape; i >= 0; i = world->shapes[i].next)
            fe__shape_mark_moved(world, i);
        return FE_OK;
    }
    if (!fe__pair_set_reserve(&world->ignored, &world->memory, 1)) return FE_ERROR_MEMORY;
    fe__body_disturb(world, a);
    fe__body_disturb(world, b);
    fe__pair_set_insert(&world->ignored, a, b, 0);
    world->bodies[a].flags |= FE__BODY_IGNORES;
    world->bodies[b].flags |= FE__BODY_IGNORES;
    fe__body_refilter(world, a);
    return FE_OK;
}
