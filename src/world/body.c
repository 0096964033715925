// body.c - see body.h.
#include "world/body.h"

#include <string.h>

fe_result fe__reserve_bodies(fe_world *world, int32_t extra)
{
    fe_result ids = fe__id_pool_reserve(&world->body_ids, &world->memory, extra);
    if (ids != FE_OK) return ids;
    int64_t opened = world->body_ids.slot_count, fresh = fe__maxi(0, extra - world->body_ids.free_count);
    if (!FE_RESERVE(&world->memory, world->bodies, world->body_capacity, opened + fresh) ||
        !FE_RESERVE(&world->memory, world->odometers, world->odometer_capacity, opened + fresh) ||
        !FE_RESERVE(&world->memory, world->drifts, world->drift_capacity, opened + fresh))
        return FE_ERROR_MEMORY;
    int64_t alive = (int64_t)world->body_count + extra;
    int32_t is_done = FE_RESERVE(&world->memory, world->awake_bodies, world->awake_body_capacity, alive) &&
                      FE_RESERVE(&world->memory, world->disturbed, world->disturbed_capacity, world->body_capacity);
    return is_done ? FE_OK : FE_ERROR_MEMORY;
}

// ---- pose -----------------------------------------------------------------------------------------------------------

// A rotation is kept bit for bit when its length is 1 to this accuracy. Rounding q/|q| to floats leaves less (half a
// unit in the last place, 6e-8), so that normalising twice changes nothing.
#define UNIT_TOLERANCE 1e-7

fe_quat fe__unit_rotation(fe_quat q)
{
    double x = (double)q.x, y = (double)q.y, z = (double)q.z, w = (double)q.w;
    double length = sqrt(x * x + y * y + z * z + w * w);
    return fe__absd(length - 1.0) < UNIT_TOLERANCE ? q : fe__normalized(q);
}

// centre = origin + R(q) local centre; high + low carry it to 48 bits for the float kernels
void fe__body_place_centre(fe__body *body)
{
    fe_dvec3 arm = fe__drotate(fe__rotation_of(body), fe__widen(fe__quad_vector(body->local_centre)));
    double c[3] = {body->origin[0] + arm.x, body->origin[1] + arm.y, body->origin[2] + arm.z};
    for (int k = 0; k < 3; ++k) {
        body->centre[k] = c[k];
        body->centre_high[k] = (float)c[k];
        body->centre_low[k] = (float)(c[k] - (double)body->centre_high[k]);
    }
}

static void place(fe__shape *shape, const fe__body *body)
{
    if (shape->flags & FE__SHAPE_CENTRED) {
        memcpy(&shape->pose.position, body->origin, sizeof shape->pose.position);
        memcpy(&shape->pose.rotation, body->rotation, sizeof shape->pose.rotation);
        return;
    }
    fe__pose pose = {fe__origin_of(body), fe__rotation_of(body)};
    shape->pose = fe__compose(&pose, shape->local_position, shape->local_rotation);
}

void fe__body_place(fe_world *world, int32_t index)
{
    const fe__body *body = &world->bodies[index];
    for (int32_t i = body->first_shape; i >= 0; i = world->shapes[i].next) place(&world->shapes[i], body);
}

void fe__shape_place(fe_world *world, int32_t index)
{
    place(&world->shapes[index], &world->bodies[world->shapes[index].body]);
}

void fe__advance(const fe_world *world, const fe__body *body, float dt, fe_dvec3 *centre, fe_quat *rotation)
{
    *centre = fe__centre_of(body), *rotation = fe__rotation_of(body);
    if (body->awake_index < 0) return;
    fe_vec3 v = fe__quad_vector(body->velocity), w = fe__scale(0.5f * dt, fe__quad_vector(body->spin));
    if (body->type == FE_BODY_DYNAMIC && !body->locked) v = fe__add_scaled(v, dt * body->gravity_scale, world->gravity);
    *centre = fe__dadd(*centre, fe__dscale((double)dt, fe__widen(v)));
    fe_quat q = *rotation, turn = fe__product((fe_quat){w.x, w.y, w.z, 0.0f}, q);
    *rotation = fe__normalized((fe_quat){q.x + turn.x, q.y + turn.y, q.z + turn.z, q.w + turn.w});
}

fe__pose fe__shape_pose_at(const fe__body *body, const fe__shape *shape, fe_dvec3 centre, fe_quat rotation)
{
    fe__pose pose = {centre, rotation};
    const float *c = body->local_centre;
    if (c[0] != 0.0f || c[1] != 0.0f || c[2] != 0.0f)
        pose.position = fe__dsub(centre, fe__drotate(rotation, fe__widen(fe__quad_vector(c))));
    return shape->flags & FE__SHAPE_CENTRED ? pose : fe__compose(&pose, shape->local_position, shape->local_rotation);
}

// ---- speed ----------------------------------------------------------------------------------------------------------

// Locked components are exactly +0, so that the solver's masks never meet a velocity they would have to keep.
void fe__body_stop_locked(fe_world *world, fe__body *body)
{
    uint32_t bits = (uint32_t)body->lock_bits;
    for (uint32_t k = 0; k < 3; ++k) {
        if (bits >> k & 1) body->velocity[k] = 0.0f;
        if (bits >> (k + 3) & 1) body->spin[k] = 0.0f;
    }
    fe__body_note_speed(world, body);
}
