// fe_compound.c - the API of compounds: assets of a store, made of parts. From any thread.
#include "api/fe_store.h"
#include "api/fe_geometry.h"
#include "core/fp_state.h"
#include "store/asset.h"
#include "world/body.h"

#include <stdio.h>
#include <string.h>

enum { LEAST_PART = 8 }; // bytes of a part that every client has

// ---- birth ---------------------------------------------------------------------------------------------------------

static fe_compound_part default_part(void)
{
    return (fe_compound_part){.struct_size = sizeof(fe_compound_part),
                              .density = -1.0f,
                              .frame.rotation.w = 1.0f,
                              .geometry.struct_size = sizeof(fe_geometry),
                              .material = fe__default_material()};
}

void fe_compound_part_init(fe_compound_part *part, uint32_t struct_size)
{
    fe_compound_part defaults = default_part();
    fe__init_struct(part, &defaults, sizeof defaults, struct_size);
}

static fe_result check_part(const char *function, const fe_compound_part *part)
{
    if (part->density != -1.0f) FE_CHECK_FLOAT(part->density, 0.0f, FE_MAX_DENSITY);
    FE_CHECK_VEC3(&part->frame.position, FE_MAX_LOCAL);
    FE_CHECK_QUAT(&part->frame.rotation);
    FE_CHECK_BOOL(part->own_material);
    if (part->own_material) FE_TRY(fe__check_material(function, &part->material));
    int32_t type = part->geometry.type;
    if (type != FE_GEOMETRY_PLANE && type != FE_GEOMETRY_COMPOUND) return FE_OK;
    return fe__fail(function, FE_ERROR_UNSUPPORTED, "a compound has no %s among its parts",
                    type == FE_GEOMETRY_PLANE ? "plane" : "compound");
}

// On FE_OK the part's asset is kept alive.
static fe_result read_part(const char *function, fe_store *store, const fe_compound_part *part, uint32_t stride,
                           fe__compound_part *out_part)
{
    fe_compound_part full = default_part();
    uint32_t size;
    memcpy(&size, part, sizeof size);
    if (size > stride)
        return fe__fail(function, FE_ERROR_ARGUMENT, "struct_size is %lu, more than the stride, %lu",
                        (unsigned long)size, (unsigned long)stride);
    FE_READ_STRUCT(part, &full);
    if (full.geometry.struct_size > sizeof full.geometry) // what it has beyond would lie in the part's next field
        return fe__fail(function, FE_ERROR_ARGUMENT,
                        "geometry.struct_size is %lu, more than the %lu of a part's geometry",
                        (unsigned long)full.geometry.struct_size, (unsigned long)sizeof full.geometry);
    FE_TRY(check_part(function, &full));
    *out_part = (fe__compound_part){.position = full.frame.position,
                                    .density = full.density,
                                    .own_material = full.own_material,
                                    .material = full.material,
                                    .user_data = full.user_data};
    fe__fp_state fp = fe__fp_enter();
    out_part->rotation = fe__unit_rotation(full.frame.rotation);
    fe__fp_leave(fp);
    return fe__read_geometry(function, store, &full.geometry, &out_part->form);
}

// As many as could be read are in compound->count, whatever is returned
static fe_result read_parts(const char *function, fe_store *store, const fe_compound_part *parts, uint32_t stride,
                            int32_t count, fe__compound *compound)
{
    for (compound->count = 0; compound->count < count; ++compound->count) {
        char place[64]; // stands before the sentence of an error
        snprintf(place, sizeof place, "%s, parts[%d]", function, (int)compound->count);
        FE_TRY(read_part(place, store, fe__at_const(parts, stride, compound->count), stride,
                         compound->parts + compound->count));
    }
    return FE_OK;
}

static fe_result create(const char *function, fe_store *store, const fe_compound_part *parts, uint32_t stride,
                        int32_t count, fe_asset *out_asset)
{
    fe__asset asset = {.kind = FE__ASSET_COMPOUND};
    fe__compound *compound = &asset.compound;
    compound->parts = fe__making_block(store, &asset, (int64_t)sizeof *compound->parts * count);
    if (!compound->parts) return fe__report(function, FE_ERROR_MEMORY);
    fe_result result = read_parts(function, store, parts, stride, count, compound);
    if (result == FE_OK) return fe__report(function, fe__making_put(store, &asset, out_asset));
    fe__making_drop(store, &asset);
    return result;
}

fe_result fe_compound_create(fe_store *store, const fe_compound_part *parts, uint32_t stride, int32_t count,
                             fe_asset *out_asset)
{
    if (out_asset) *out_asset = 0;
    FE_BEGIN_STORE(store);
    FE_CHECK_POINTER(out_asset);
    FE_CHECK_INT(count, 1, FE__MOST_PARTS);
    FE_CHECK_ARRAY(parts, count);
    FE_CHECK_RECORD_STRIDE(stride, LEAST_PART, count);
    fe_asset asset;
    FE_TRY(create(function, store, parts, stride, count, &asset));
    *out_asset = asset;
    return FE_OK;
}

// ---- reading -------------------------------------------------------------------------------------------------------
// Under the store's lock: another thread may destroy the asset.

static fe_result find_compound(const char *function, const fe_store *store, fe_asset handle,
                               const fe__asset **out_asset)
{
    int32_t index;
    FE_TRY(fe__find_asset_of(function, "compound", store, FE__ASSET_COMPOUND, handle, &index));
    *out_asset = fe__store_asset(store, index);
    return FE_OK;
}

// A heightfield's bounds follow its edits
static fe__bounds part_bounds(const fe_store *store, const fe__compound_part *part)
{
    fe__pose pose = {fe__widen(part->position), part->rotation};
    fe__form form = fe__form_is_field(&part->form) ? fe__asset_form(store, part->form.field) : part->form;
    return fe__form_bounds(&form, &pose);
}

static fe_compound_info describe(const fe_store *store, const fe__asset *asset)
{
    const fe__compound *c = &asset->compound;
    fe__bounds all = part_bounds(store, c->parts);
    for (int32_t i = 1; i < c->count; ++i) {
        fe__bounds b = part_bounds(store, c->parts + i);
        fe__bounds_add(&all, &b);
    }
    return (fe_compound_info){.struct_size = sizeof(fe_compound_info),
                              .part_count = c->count,
                              .lower = fe__narrow(all.low),
                              .upper = fe__narrow(all.high),
                              .bytes = (int64_t)asset->blocks[0].size};
}

FE_DEFINE_EMPTY_INIT(fe_compound_info_init, fe_compound_info, info)

fe_result fe_compound_get_info(const fe_store *store, fe_asset compound, fe_compound_info *out_info)
{
    FE_BEGIN_STORE(store);
    FE_CHECK_STRUCT_SIZE(out_info);
    const fe__asset *asset;
    fe_compound_info info;
    fe__fp_state fp = fe__fp_enter();
    fe__store_lock(store);
    fe_result result = find_compound(function, store, compound, &asset);
    if (result == FE_OK) info = describe(store, asset);
    fe__store_unlock(store);
    fe__fp_leave(fp);
    if (result == FE_OK) fe__write_struct(out_info, &info, sizeof info);
    return result;
}

static fe_result describe_part(const char *function, const fe_store *store, fe_asset compound, int32_t part,
                               fe_compound_part *out_part)
{
    const fe__asset *asset;
    FE_TRY(find_compound(function, store, compound, &asset));
    FE_CHECK_INT(part, 0, asset->compound.count - 1);
    const fe__compound_part *p = asset->compound.parts + part;
    *out_part = (fe_compound_part){.struct_size = sizeof *out_part,
                                   .density = p->density,
                                   .frame = {p->position, p->rotation},
                                   .own_material = p->own_material,
                                   .geometry = fe__geometry_of(store, &p->form),
                                   .material = p->material,
                                   .user_data = p->user_data};
    return FE_OK;
}

fe_result fe_compound_get_part(const fe_store *store, fe_asset compound, int32_t part, fe_compound_part *out_part)
{
    FE_BEGIN_STORE(store);
    FE_CHECK_STRUCT_SIZE(out_part);
    fe_compound_part whole;
    fe__store_lock(store);
    fe_result result = describe_part(function, store, compound, part, &whole);
    fe__store_unlock(store);
    if (result == FE_OK) fe__write_struct(out_part, &whole, sizeof whole);
    return result;
}
