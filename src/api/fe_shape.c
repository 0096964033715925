// fe_shape.c - the API of shapes: geometry, material, filter, life.
#include "api/fe_store.h"
#include "api/check.h"
#include "api/fe_geometry.h"

#include <inttypes.h>
#include "core/fp_state.h"
#include "world/world.h"
#include "world/mass.h"
#include "world/shape.h"
#include "world/sleep.h"

// ---- what may be ---------------------------------------------------------------------------------------------------

// Planes and heightfields are static only; meshes are carried by kinematic bodies too.
static fe_result check_form_owner(const char *function, const fe_world *world, int32_t body, const fe__form *form)
{
    int32_t type = world->bodies[body].type;
    if (!fe__form_is_static_only(form) || type == FE_BODY_STATIC) return FE_OK;
    if (fe__form_is_carried(form)) {
        if (type == FE_BODY_KINEMATIC) return FE_OK;
        return fe__fail(function, FE_ERROR_UNSUPPORTED,
                        "body 0x%llx is dynamic, a %s needs a static or kinematic one; give it convex shapes instead",
                        fe__body_handle(world, body), fe__traits_of(form)->name);
    }
    return fe__fail(function, FE_ERROR_UNSUPPORTED, "body 0x%llx is not static, a %s needs a static one",
                    fe__body_handle(world, body), fe__traits_of(form)->name);
}

// Of a compound: each part. The caller keeps its asset alive.
static fe_result check_owner(const char *function, const fe_world *world, int32_t body, const fe__form *form)
{
    if (!fe__form_is_of_parts(form)) return check_form_owner(function, world, body, form);
    const fe__compound *compound = &fe__store_asset(world->store, form->field)->compound;
    for (int32_t i = 0; i < compound->count; ++i)
        FE_TRY(check_form_owner(function, world, body, &compound->parts[i].form));
    return FE_OK;
}

static fe_result check_form_one_way(const char *function, const fe__form *form)
{
    if (!fe__form_is_static_only(form)) return FE_OK;
    return fe__fail(function, FE_ERROR_UNSUPPORTED, "a %s cannot be one-way", fe__traits_of(form)->name);
}

static fe_result check_one_way(const char *function, const fe_world *world, const fe__form *form, uint32_t one_way)
{
    if (!one_way) return FE_OK;
    if (!fe__form_is_of_parts(form)) return check_form_one_way(function, form);
    const fe__compound *compound = &fe__store_asset(world->store, form->field)->compound;
    for (int32_t i = 0; i < compound->count; ++i) FE_TRY(check_form_one_way(function, &compound->parts[i].form));
    return FE_OK;
}

// ---- life ----------------------------------------------------------------------------------------------------------

enum { ALL_EVENTS = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_STAY | FE_SHAPE_EVENTS_HIT };

static fe_shape_def default_shape(void)
{
    return (fe_shape_def){.struct_size = sizeof(fe_shape_def),
                          .density = 1000.0f,
                          .frame.rotation.w = 1.0f,
                          .material = fe__default_material(),
                          .layer = 1,
                          .mask = UINT32_MAX,
                          .events = FE_SHAPE_EVENTS_TOUCH,
                          .one_way_direction = {0.0f, 1.0f, 0.0f}};
}

void fe_shape_def_init(fe_shape_def *def, uint32_t struct_size)
{
    fe_shape_def defaults = default_shape();
    fe__init_struct(def, &defaults, sizeof defaults, struct_size);
}

static fe_result read_shape_def(const char *function, const fe_shape_def *def, fe_shape_def *full)
{
    *full = default_shape();
    if (!def) return FE_OK;
    FE_READ_STRUCT(def, full);
    FE_CHECK_FLOAT(full->density, 0.0f, FE_MAX_DENSITY);
    FE_CHECK_VEC3(&full->frame.position, FE_MAX_LOCAL);
    FE_CHECK_QUAT(&full->frame.rotation);
    FE_TRY(fe__check_material(function, &full->material));
    FE_CHECK_FILTER(full->layer);
    FE_CHECK_BOOL(full->trigger);
    FE_CHECK_BITS(full->events, ALL_EVENTS);
    FE_CHECK_VEC3(&full->surface_velocity, FE_MAX_SPEED);
    FE_CHECK_BOOL(full->pair_filter);
    FE_CHECK_BOOL(full->one_way);
    FE_CHECK_DIRECTION(&full->one_way_direction);
    FE_CHECK_VEC3(&full->one_way_direction, FE_MAX_VALUE);
    return FE_OK;
}

static fe_result create_shape(const char *function, fe_world *world, int32_t body, const fe_shape_def *def,
                              const fe__form *form, fe_shape *out_shape)
{
    FE_TRY(check_owner(function, world, body, form));
    FE_TRY(check_one_way(function, world, form, (uint32_t)def->one_way));
    fe__fp_state fp = fe__fp_enter();
    int32_t shape = fe__shape_create(world, body, def, form);
    fe__fp_leave(fp);
    if (shape < 0) return fe__report(function, (fe_result)shape);
    *out_shape = fe__shape_handle(world, shape);
    return FE_OK;
}

fe_result fe_shape_create(fe_world *world, fe_body body, const fe_shape_def *def, const fe_geometry *geometry,
                          fe_shape *out_shape)
{
    if (out_shape) *out_shape = 0;
    FE_WRITE_ALONE(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_POINTER(out_shape);
    fe_shape_def full;
    FE_TRY(read_shape_def(function, def, &full));
    fe__form form;
    FE_TRY(fe__read_geometry(function, world->store, geometry, &form));
    fe_result result = create_shape(function, world, index, &full, &form, out_shape);
    if (result == FE_OK && world->recorder) fe__record_form(world->recorder, &form);
    fe__let_go_of_asset(world->store, &form);
    FE_TRY(result);
    FE_RECORD(shape_create, body, def, geometry, out_shape);
    return FE_OK;
}

fe_result fe_shape_destroy(fe_world *world, fe_shape shape)
{
    FE_WRITE_ALONE(world);
    FE_FIND_SHAPE(index, shape);
    fe__fp_state fp = fe__fp_enter();
    fe__shape_destroy(world, index);
    fe__fp_leave(fp);
    FE_RECORD(shape_destroy, shape);
    return FE_OK;
}

int32_t fe_shape_is_valid(const fe_world *world, fe_shape shape)
{
    int32_t index;
    return world && fe__id_pool_find(&world->shape_ids, shape, &index) == FE_OK;
}

fe_result fe_shape_get_body(const fe_world *world, fe_shape shape, fe_body *out_body)
{
    if (out_body) *out_body = 0;
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_POINTER(out_body);
    *out_body = fe__body_handle(world, world->shapes[index].body);
    return FE_OK;
}

// ---- form ----------------------------------------------------------------------------------------------------------

static fe_result set_form(const char *function, fe_world *world, int32_t shape, const fe__form *form)
{
    FE_TRY(check_owner(function, world, world->shapes[shape].body, form));
    FE_TRY(check_one_way(function, world, form, world->shapes[shape].flags & FE__SHAPE_ONE_WAY));
    fe__fp_state fp = fe__fp_enter();
    fe_result result = fe__shape_set_form(world, shape, form);
    fe__fp_leave(fp);
    return fe__report(function, result);
}

fe_result fe_shape_set_geometry(fe_world *world, fe_shape shape, const fe_geometry *geometry)
{
    FE_WRITE_ALONE(world);
    FE_FIND_SHAPE(index, shape);
    fe__form form;
    FE_TRY(fe__read_geometry(function, world->store, geometry, &form));
    fe_result result = set_form(function, world, index, &form);
    if (result == FE_OK && world->recorder) fe__record_form(world->recorder, &form);
    fe__let_go_of_asset(world->store, &form);
    FE_TRY(result);
    FE_RECORD(shape_set_geometry, shape, geometry);
    return FE_OK;
}

fe_result fe_shape_get_geometry(const fe_world *world, fe_shape shape, fe_geometry *out_geometry)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_STRUCT_SIZE(out_geometry);
    fe_geometry geometry = fe__geometry_of(world->store, &world->shapes[index].form);
    fe__write_struct(out_geometry, &geometry, sizeof geometry);
    return FE_OK;
}

fe_result fe_shape_set_frame(fe_world *world, fe_shape shape, const fe_frame *frame)
{
    FE_WRITE(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_POINTER(frame);
    FE_CHECK_VEC3(&frame->position, FE_MAX_LOCAL);
    FE_CHECK_QUAT(&frame->rotation);
    fe__fp_state fp = fe__fp_enter();
    fe__shape_set_local_pose(world, index, frame->position, frame->rotation);
    fe__fp_leave(fp);
    FE_RECORD(shape_set_frame, shape, frame);
    return FE_OK;
}

fe_result fe_shape_get_frame(const fe_world *world, fe_shape shape, fe_frame *out_frame)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_POINTER(out_frame);
    *out_frame = (fe_frame){world->shapes[index].local_position, world->shapes[index].local_rotation};
    return FE_OK;
}

fe_result fe_shape_set_density(fe_world *world, fe_shape shape, float density)
{
    FE_WRITE(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_FLOAT(density, 0.0f, FE_MAX_DENSITY);
    if (world->shapes[index].density == density) return FE_OK;
    fe__fp_state fp = fe__fp_enter();
    fe__shape_set_density(world, index, density);
    fe__fp_leave(fp);
    FE_RECORD(shape_set_density, shape, density);
    return FE_OK;
}

fe_result fe_shape_get_density(const fe_world *world, fe_shape shape, float *out_density)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_POINTER(out_density);
    *out_density = world->shapes[index].density;
    return FE_OK;
}

// ---- surface -------------------------------------------------------------------------------------------------------

fe_result fe_shape_set_material(fe_world *world, fe_shape shape, const fe_material *material)
{
    FE_WRITE(world);
    FE_FIND_SHAPE(index, shape);
    FE_TRY(fe__check_material(function, material));
    fe__fp_state fp = fe__fp_enter();
    fe__shape_set_material(world, index, material);
    fe__fp_leave(fp);
    FE_RECORD(shape_set_material, shape, material);
    return FE_OK;
}

fe_result fe_shape_get_material(const fe_world *world, fe_shape shape, fe_material *out_material)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_POINTER(out_material);
    *out_material = world->shapes[index].material;
    return FE_OK;
}

fe_result fe_shape_set_surface_velocity(fe_world *world, fe_shape shape, const fe_vec3 *velocity)
{
    FE_WRITE(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_VEC3(velocity, FE_MAX_SPEED);
    fe__fp_state fp = fe__fp_enter();
    fe__shape_set_surface_velocity(world, index, *velocity);
    fe__fp_leave(fp);
    FE_RECORD(shape_set_surface_velocity, shape, velocity);
    return FE_OK;
}

fe_result fe_shape_get_surface_velocity(const fe_world *world, fe_shape shape, fe_vec3 *out_velocity)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_POINTER(out_velocity);
    *out_velocity = world->shapes[index].surface_velocity;
    return FE_OK;
}

// ---- filter, trigger, events ---------------------------------------------------------------------------------------

fe_result fe_shape_set_filter(fe_world *world, fe_shape shape, uint32_t layer, uint32_t mask, int32_t group)
{
    FE_WRITE(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_FILTER(layer);
    fe__fp_state fp = fe__fp_enter();
    fe__shape_set_filter(world, index, layer, mask, group);
    fe__fp_leave(fp);
    FE_RECORD(shape_set_filter, shape, layer, mask, group);
    return FE_OK;
}

fe_result fe_shape_get_filter(const fe_world *world, fe_shape shape, uint32_t *out_layer, uint32_t *out_mask,
                              int32_t *out_group)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_POINTER(out_layer);
    FE_CHECK_POINTER(out_mask);
    FE_CHECK_POINTER(out_group);
    *out_layer = world->shapes[index].layer;
    *out_mask = world->shapes[index].mask;
    *out_group = world->shapes[index].group;
    return FE_OK;
}

fe_result fe_shape_set_pair_filter(fe_world *world, fe_shape shape, int32_t enabled)
{
    FE_WRITE(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_BOOL(enabled);
    fe__fp_state fp = fe__fp_enter();
    fe__shape_set_judged(world, index, enabled);
    fe__fp_leave(fp);
    FE_RECORD(shape_set_pair_filter, shape, enabled);
    return FE_OK;
}

fe_result fe_shape_get_pair_filter(const fe_world *world, fe_shape shape, int32_t *out_enabled)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_POINTER(out_enabled);
    *out_enabled = (world->shapes[index].flags & FE__SHAPE_JUDGED) != 0;
    return FE_OK;
}

fe_result fe_shape_set_one_way(fe_world *world, fe_shape shape, int32_t enabled, const fe_vec3 *direction)
{
    FE_WRITE(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_BOOL(enabled);
    if (direction) {
        FE_CHECK_DIRECTION(direction);
        FE_CHECK_VEC3(direction, FE_MAX_VALUE);
    }
    FE_TRY(check_one_way(function, world, &world->shapes[index].form, (uint32_t)enabled));
    fe__fp_state fp = fe__fp_enter();
    fe__shape_set_one_way(world, index, enabled, direction);
    fe__fp_leave(fp);
    FE_RECORD(shape_set_one_way, shape, enabled, direction);
    return FE_OK;
}

fe_result fe_shape_get_one_way(const fe_world *world, fe_shape shape, int32_t *out_enabled, fe_vec3 *out_direction)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_POINTER(out_enabled);
    FE_CHECK_POINTER(out_direction);
    *out_enabled = (world->shapes[index].flags & FE__SHAPE_ONE_WAY) != 0;
    *out_direction = world->shapes[index].one_way;
    return FE_OK;
}

fe_result fe_shape_set_trigger(fe_world *world, fe_shape shape, int32_t trigger)
{
    FE_WRITE(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_BOOL(trigger);
    fe__fp_state fp = fe__fp_enter();
    fe__shape_set_trigger(world, index, trigger);
    fe__fp_leave(fp);
    FE_RECORD(shape_set_trigger, shape, trigger);
    return FE_OK;
}

fe_result fe_shape_get_trigger(const fe_world *world, fe_shape shape, int32_t *out_trigger)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_POINTER(out_trigger);
    *out_trigger = (world->shapes[index].flags & FE__SHAPE_TRIGGER) != 0;
    return FE_OK;
}

fe_result fe_shape_set_events(fe_world *world, fe_shape shape, uint32_t events)
{
    FE_WRITE(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_BITS(events, ALL_EVENTS);
    fe__fp_state fp = fe__fp_enter();
    fe__shape_set_events(world, index, events);
    fe__fp_leave(fp);
    FE_RECORD(shape_set_events, shape, events);
    return FE_OK;
}

fe_result fe_shape_get_events(const fe_world *world, fe_shape shape, uint32_t *out_events)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_POINTER(out_events);
    *out_events = world->shapes[index].events;
    return FE_OK;
}

fe_result fe_shape_set_user_data(fe_world *world, fe_shape shape, uint64_t user_data)
{
    FE_WRITE(world);
    FE_FIND_SHAPE(index, shape);
    world->shapes[index].user_data = user_data;
    FE_RECORD(shape_set_user_data, shape, user_data);
    return FE_OK;
}

fe_result fe_shape_get_user_data(const fe_world *world, fe_shape shape, uint64_t *out_user_data)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_POINTER(out_user_data);
    *out_user_data = world->shapes[index].user_data;
    return FE_OK;
}
