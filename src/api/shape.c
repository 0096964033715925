// shape.c - the API of shapes: geometry, material, filter, life.
#include "api/asset_form.h"

#include <inttypes.h>
#include "core/fp_state.h"
#include "world/handles.h"
#include "world/mass.h"
#include "world/shapes.h"
#include "world/sleep.h"

// ---- geometry ------------------------------------------------------------------------------------------------------

void fe_geometry_init(fe_geometry *geometry, uint32_t struct_size)
{
    fe_geometry defaults = {.struct_size = sizeof defaults};
    fe__init_struct(geometry, &defaults, sizeof defaults, struct_size);
}

#define FE_CHECK_LENGTH(value) FE_CHECK_FLOAT(value, FE_LEAST_LENGTH, FE_MAX_LENGTH)

// Kept as given when its length is 1 to the rounding of floats, so that reading a plane and setting it again changes
// nothing.
static fe_vec3 unit_normal(fe_vec3 n)
{
    const double tolerance = 1e-7;
    fe__fp_state fp = fe__fp_enter();
    fe_dvec3 wide = fe__widen(n);
    double length = sqrt(fe__ddot(wide, wide));
    if (fe__absd(length - 1.0) >= tolerance) n = fe__narrow(fe__dscale(1.0 / length, wide));
    fe__fp_leave(fp);
    return n;
}

static fe_result read_plane(const char *function, const fe_geometry *geometry, fe__form *out_form)
{
    const fe_vec3 *normal = &geometry->normal;
    int32_t finite = __builtin_isfinite(normal->x) && __builtin_isfinite(normal->y) && __builtin_isfinite(normal->z);
    if (!finite || (normal->x == 0.0f && normal->y == 0.0f && normal->z == 0.0f)) {
        return fe__fail(function, FE_ERROR_ARGUMENT,
                        "geometry->normal is (%.9g, %.9g, %.9g), must be finite and not zero", (double)normal->x,
                        (double)normal->y, (double)normal->z);
    }
    FE_CHECK_FLOAT(geometry->distance, -FE_MAX_LOCAL, FE_MAX_LOCAL);
    out_form->normal = unit_normal(*normal);
    out_form->distance = geometry->distance;
    return FE_OK;
}

// What a form does not use stays 0 (see form.h). On FE_OK its asset is kept alive until fe__let_go_of_asset.
static fe_result read_geometry(const char *function, const fe_world *world, const fe_geometry *geometry,
                               fe__form *out_form)
{
    fe_geometry whole = {.struct_size = sizeof whole};
    FE_READ_STRUCT(geometry, &whole);
    geometry = &whole;
    FE_CHECK_RESERVED(geometry->reserved);
    FE_CHECK_RESERVED(geometry->reserved_end);
    *out_form = (fe__form){.type = fe__form_of_geometry(geometry->type)};
    if (out_form->type < 0)
        return fe__fail(function, FE_ERROR_ARGUMENT, "type is %" PRId32 ", no fe_geometry_type", geometry->type);
    FE_TRY(fe__check_has_scale(function, geometry));
    switch (geometry->type) {
    case FE_GEOMETRY_SPHERE:
        FE_CHECK_LENGTH(geometry->radius);
        out_form->radius = geometry->radius;
        return FE_OK;
    case FE_GEOMETRY_CAPSULE:
        FE_CHECK_LENGTH(geometry->half_height);
        FE_CHECK_LENGTH(geometry->radius);
        out_form->half_height = geometry->half_height;
        out_form->radius = geometry->radius;
        return FE_OK;
    case FE_GEOMETRY_CYLINDER:
    case FE_GEOMETRY_CONE:
        FE_CHECK_LENGTH(geometry->half_height);
        FE_CHECK_LENGTH(geometry->radius);
        out_form->half = fe__vec3(geometry->radius, geometry->half_height, geometry->radius);
        return FE_OK;
    case FE_GEOMETRY_BOX:
        FE_CHECK_LENGTH(geometry->half_extents.x);
        FE_CHECK_LENGTH(geometry->half_extents.y);
        FE_CHECK_LENGTH(geometry->half_extents.z);
        out_form->half = geometry->half_extents;
        return FE_OK;
    case FE_GEOMETRY_HULL:
        return fe__read_asset_form(function, world->store, geometry, FE__ASSET_HULL, out_form);
    case FE_GEOMETRY_HEIGHTFIELD:
        return fe__read_asset_form(function, world->store, geometry, FE__ASSET_HEIGHTFIELD, out_form);
    case FE_GEOMETRY_MESH:
        return fe__read_asset_form(function, world->store, geometry, FE__ASSET_MESH, out_form);
    default:
        return read_plane(function, geometry, out_form);
    }
}

// Planes and heightfields are static only; meshes are carried by kinematic bodies too.
static fe_result check_owner(const char *function, const fe_world *world, int32_t body, const fe__form *form)
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

static fe_result check_one_way(const char *function, const fe__form *form, uint32_t one_way)
{
    if (!one_way || !fe__form_is_static_only(form)) return FE_OK;
    return fe__fail(function, FE_ERROR_UNSUPPORTED, "a %s cannot be one-way", fe__traits_of(form)->name);
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
    FE_TRY(check_one_way(function, form, (uint32_t)def->one_way));
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
    FE_TRY(read_geometry(function, world, geometry, &form));
    fe_result result = create_shape(function, world, index, &full, &form, out_shape);
    fe__let_go_of_asset(world->store, &form);
    return result;
}

fe_result fe_shape_destroy(fe_world *world, fe_shape shape)
{
    FE_WRITE_ALONE(world);
    FE_FIND_SHAPE(index, shape);
    fe__fp_state fp = fe__fp_enter();
    fe__shape_destroy(world, index);
    fe__fp_leave(fp);
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
    FE_TRY(check_one_way(function, form, world->shapes[shape].flags & FE__SHAPE_ONE_WAY));
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
    FE_TRY(read_geometry(function, world, geometry, &form));
    fe_result result = set_form(function, world, index, &form);
    fe__let_go_of_asset(world->store, &form);
    return result;
}

fe_result fe_shape_get_geometry(const fe_world *world, fe_shape shape, fe_geometry *out_geometry)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_STRUCT_SIZE(out_geometry);
    const fe__form *form = &world->shapes[index].form;
    fe_geometry geometry = {.struct_size = sizeof geometry,
                            .type = fe__traits_of(form)->geometry,
                            .radius = form->radius};
    if (fe__form_has_asset(form)) {
        geometry.asset = fe__asset_handle(world, form->field);
        geometry.scale = fe__scale_of(world->store, form);
    } else if (fe__form_is_curved(form)) {
        geometry.radius = form->half.x;
        geometry.half_height = form->half.y;
    } else {
        geometry.half_height = form->half_height;
        geometry.half_extents = form->half;
        geometry.normal = form->normal;
        geometry.distance = form->distance;
    }
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
    world->shapes[index].density = density;
    fe__body_disturb(world, world->shapes[index].body);
    fe__body_densities_changed(world, world->shapes[index].body);
    fe__fp_leave(fp);
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

// What rests by friction may start to slide, what lies on a belt to move.
static void renew_surface(fe_world *world, int32_t index)
{
    fe__fp_state fp = fe__fp_enter();
    fe__body_disturb(world, world->shapes[index].body);
    fe__shape_material_changed(world, index);
    fe__fp_leave(fp);
}

fe_result fe_shape_set_material(fe_world *world, fe_shape shape, const fe_material *material)
{
    FE_WRITE(world);
    FE_FIND_SHAPE(index, shape);
    FE_TRY(fe__check_material(function, material));
    world->shapes[index].material = *material;
    renew_surface(world, index);
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
    world->shapes[index].surface_velocity = *velocity;
    renew_surface(world, index);
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
    fe__shape_set_filter(world, index, layer, mask, group);
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
    fe__shape_set_judged(world, index, enabled);
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
    FE_TRY(check_one_way(function, &world->shapes[index].form, (uint32_t)enabled));
    fe__fp_state fp = fe__fp_enter();
    fe__shape_set_one_way(world, index, enabled, direction);
    fe__fp_leave(fp);
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
    fe__shape_set_trigger(world, index, trigger);
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
    world->shapes[index].events = events;
    fe__fp_state fp = fe__fp_enter();
    fe__shape_material_changed(world, index);
    fe__fp_leave(fp);
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
