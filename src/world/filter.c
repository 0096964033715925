// filter.c - whether two shapes may collide.
//
// Asked by the broad phase before a pair exists, so that shapes that may not collide cost no narrow phase, wake no body
// and make no event.
#include "world/filter.h"

#include "world/joint.h"

// Contacts need a dynamic body; a trigger also reports a kinematic one. Nothing changes between two static bodies. Two
// surfaces never meet.
static int32_t types_meet(const fe_world *world, const fe__shape *a, const fe__shape *b)
{
    int32_t type_a = world->bodies[a->body].type, type_b = world->bodies[b->body].type;
    if (type_a == FE_BODY_DYNAMIC || type_b == FE_BODY_DYNAMIC) return 1;
    if (fe__form_is_field(&a->form) && fe__form_is_field(&b->form)) return 0;
    return (a->flags | b->flags) & FE__SHAPE_TRIGGER && (type_a == FE_BODY_KINEMATIC || type_b == FE_BODY_KINEMATIC);
}

int32_t fe__may_collide(const fe_world *world, int32_t shape_a, int32_t shape_b)
{
    const fe__shape *a = &world->shapes[shape_a], *b = &world->shapes[shape_b];
    if (a->body == b->body) return 0;
    // a common group decides: above 0 they collide, below 0 they do not; without one the layers decide
    if (a->group == b->group && a->group != 0) {
        if (a->group < 0) return 0;
    } else if (!(a->layer & b->mask && b->layer & a->mask)) {
        return 0;
    }
    const fe__body *body_a = &world->bodies[a->body], *body_b = &world->bodies[b->body];
    uint32_t both = body_a->flags & body_b->flags;
    if (!(both & FE__BODY_ENABLED) || !types_meet(world, a, b)) return 0;
    if (both & FE__BODY_IGNORES && fe__pair_set_find(&world->ignored, a->body, b->body) >= 0) return 0;
    return !body_a->first_joint || !body_b->first_joint || !fe__bodies_joined(world, a->body, b->body);
}
