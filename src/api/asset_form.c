// asset_form.c - see asset_form.h.
#include "api/asset_form.h"

#include "core/fp_state.h"
#include "store/scaled_asset.h"

// ---- the scale -----------------------------------------------------------------------------------------------------
static int32_t is_each(fe_vec3 s, float x) { return s.x == x && s.y == x && s.z == x; }
static int32_t is_one(fe_vec3 s) { return is_each(s, 0.0f) || is_each(s, 1.0f); }

fe_result fe__check_has_scale(const char *function, const fe_geometry *geometry)
{
    int32_t kind = fe__form_of_geometry(geometry->type);
    fe_vec3 s = geometry->scale;
    if (kind < 0 || fe__forms[kind].has_scale || is_one(s)) return FE_OK;
    int32_t has_asset = fe__forms[kind].has_asset;
    return fe__fail(function, has_asset ? FE_ERROR_UNSUPPORTED : FE_ERROR_ARGUMENT,
                    "geometry->scale is (%.9g, %.9g, %.9g), of a %s it must be 0 or 1 on each axis; %s", (double)s.x,
                    (double)s.y, (double)s.z, fe__forms[kind].name,
                    has_asset ? "scale what it is made of" : "hulls and meshes have a scale");
}

static fe_result read_scale(const char *function, const fe_geometry *geometry, fe_vec3 *out_scale)
{
    const fe_vec3 one = {1.0f, 1.0f, 1.0f}, s = is_one(geometry->scale) ? one : geometry->scale;
    const float numbers[3] = {s.x, s.y, s.z};
    for (int32_t k = 0; k < 3; ++k) {
        float size = fe__absf(numbers[k]);
        if (size >= FE_LEAST_SCALE && size <= FE_MAX_SCALE) continue;
        return fe__fail(function, FE_ERROR_ARGUMENT,
                        "geometry->scale.%c is %.9g, its magnitude must be in [%.9g, %.9g]", "xyz"[k],
                        (double)numbers[k], (double)FE_LEAST_SCALE, (double)FE_MAX_SCALE);
    }
    *out_scale = s;
    return FE_OK;
}

static fe_result check_lengths(const char *function, const fe__asset *a, fe_vec3 scale)
{
    double most = fe__asset_farthest(a, scale);
    if (most <= (double)FE_MAX_LENGTH) return FE_OK;
    return fe__fail(function, FE_ERROR_ARGUMENT,
                    "geometry->scale takes a point to a coordinate of %.9g m, must be at most %.9g m", most,
                    (double)FE_MAX_LENGTH);
}

static fe_result tell_refusal(const char *function, int32_t kind, const fe__scale_refusal *r)
{
    if (kind == FE__ASSET_HULL)
        return fe__fail(function, FE_ERROR_DEGENERATE,
                        "geometry->scale makes the hull %.6f m thick, must be at least %.6f m", r->hull.thickness,
                        r->hull.least);
    return fe__fail(function, FE_ERROR_DEGENERATE, "geometry->scale leaves triangle %d of the mesh without height",
                    (int)r->triangle);
}

// The record of an asset that is found, under its lock
static fe_result find_scaled(const char *function, fe_store *store, fe_vec3 scale, int32_t *index)
{
    const fe__asset *a = fe__store_asset(store, *index);
    FE_TRY(check_lengths(function, a, scale));
    fe__scale_refusal refusal;
    fe_result result = fe__asset_scaled(store, *index, scale, index, &refusal);
    if (result == FE_ERROR_DEGENERATE) return tell_refusal(function, a->kind, &refusal);
    return fe__report(function, result);
}

// ---- the form ------------------------------------------------------------------------------------------------------
static fe_result find_record(const char *function, fe_store *store, const fe_geometry *geometry, int32_t kind,
                             fe_vec3 scale, int32_t *out_index)
{
    FE_TRY(fe__find_asset_of(function, "geometry->asset", store, kind, geometry->asset, out_index));
    return is_one(scale) ? FE_OK : find_scaled(function, store, scale, out_index);
}

fe_result fe__read_asset_form(const char *function, fe_store *store, const fe_geometry *geometry, int32_t kind,
                              fe__form *out_form)
{
    fe_vec3 scale = {1.0f, 1.0f, 1.0f};
    if (fe__forms[fe__form_of_geometry(geometry->type)].has_scale) FE_TRY(read_scale(function, geometry, &scale));
    int32_t index;
    fe__fp_state fp = fe__fp_enter();
    fe__store_lock(store);
    fe_result result = find_record(function, store, geometry, kind, scale, &index);
    if (result == FE_OK) {
        fe__asset_retain(store, index);
        *out_form = fe__asset_form(store, index);
    }
    fe__store_unlock(store);
    fe__fp_leave(fp);
    return result;
}

void fe__let_go_of_asset(fe_store *store, const fe__form *form)
{
    if (!fe__form_has_asset(form)) return;
    fe__store_lock(store);
    fe__asset_release(store, form->field);
    fe__store_unlock(store);
}

fe_vec3 fe__scale_of(const fe_store *store, const fe__form *form)
{
    if (!fe__form_has_asset(form)) return fe__vec3(0.0f, 0.0f, 0.0f);
    return fe__store_asset(store, form->field)->scale;
}
