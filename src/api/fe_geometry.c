// fe_geometry.c - see fe_geometry.h.
#include "api/fe_geometry.h"

#include <inttypes.h>
#include "api/fe_store.h"
#include "core/fp_state.h"

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

// What a form does not use stays 0 (see form.h).
fe_result fe__read_geometry(const char *function, fe_store *store, const fe_geometry *geometry, fe__form *out_form)
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
        return fe__read_asset_form(function, store, geometry, FE__ASSET_HULL, out_form);
    case FE_GEOMETRY_HEIGHTFIELD:
        return fe__read_asset_form(function, store, geometry, FE__ASSET_HEIGHTFIELD, out_form);
    case FE_GEOMETRY_MESH:
        return fe__read_asset_form(function, store, geometry, FE__ASSET_MESH, out_form);
    case FE_GEOMETRY_COMPOUND:
        return fe__read_asset_form(function, store, geometry, FE__ASSET_COMPOUND, out_form);
    default:
        return read_plane(function, geometry, out_form);
    }
}

// ---- and back ------------------------------------------------------------------------------------------------------

fe_geometry fe__geometry_of(const fe_store *store, const fe__form *form)
{
    fe_geometry geometry = {.struct_size = sizeof geometry,
                            .type = fe__traits_of(form)->geometry,
                            .radius = form->radius};
    if (fe__form_has_asset(form)) {
        geometry.asset = fe__store_parent(store, form->field)->handle;
        geometry.scale = fe__scale_of(store, form);
    } else if (fe__form_is_curved(form)) {
        geometry.radius = form->half.x;
        geometry.half_height = form->half.y;
    } else {
        geometry.half_height = form->half_height;
        geometry.half_extents = form->half;
        geometry.normal = form->normal;
        geometry.distance = form->distance;
    }
    return geometry;
}
