// compound_bytes.c - see compound_bytes.h.
#include "store/compound_bytes.h"

#include "collision/form/sound.h"
#include "core/material.h"
#include "core/ranges.h"
#include "store/asset_bytes.h"
#include "store/making.h"
#include "store/scaled_asset.h"

#include <stdio.h>

enum { COUNTS = 8, PART = 88 + FE__COOKED_MATERIAL };

// ---- writing: under the lock ---------------------------------------------------------------------------------------
// The asset of a part, or what its scaled record is made of. NULL: it has none
static fe__asset *asset_of(const fe_store *store, const fe__compound_part *part)
{
    if (!fe__form_has_asset(&part->form)) return NULL;
    return fe__store_asset(store, fe__store_parent(store, part->form.field)->index);
}

// Marks each asset with its number
static int32_t number_assets(const fe_store *store, const fe__compound *c)
{
    int32_t count = 0;
    for (int32_t i = 0; i < c->count; ++i) {
        fe__asset *asset = asset_of(store, c->parts + i);
        if (asset) asset->mark = -1;
    }
    for (int32_t i = 0; i < c->count; ++i) {
        fe__asset *asset = asset_of(store, c->parts + i);
        if (asset && asset->mark < 0) asset->mark = count++;
    }
    return count;
}

// From a part on, the first that has the asset of that number
static const fe__asset *find_numbered(const fe_store *store, const fe__compound *c, int32_t number, int32_t *part)
{
    for (;; ++*part) {
        const fe__asset *asset = asset_of(store, c->parts + *part);
        if (asset && asset->mark == number) return asset;
    }
}

int64_t fe__compound_bytes(const fe_store *store, const fe__compound *c)
{
    int64_t size = COUNTS + (int64_t)PART * c->count;
    int32_t count = number_assets(store, c);
    for (int32_t i = 0, part = 0; i < count; ++i) size += fe__asset_bytes(store, find_numbered(store, c, i, &part));
    return size;
}

static unsigned char *write_quat(unsigned char *at, fe_quat q)
{
    return fe__put_float(fe__put_float(fe__put_float(fe__put_float(at, q.x), q.y), q.z), q.w);
}

static unsigned char *write_part(const fe_store *store, const fe__compound_part *p, unsigned char *at)
{
    const fe__asset *asset = asset_of(store, p);
    const fe__form_numbers n = fe__numbers_of_form(&p->form);
    fe_vec3 scale = asset ? fe__store_asset(store, p->form.field)->scale : fe__vec3(0.0f, 0.0f, 0.0f);
    at = fe__put_i32(fe__put_i32(at, fe__forms[n.kind].geometry), asset ? asset->mark : -1);
    at = fe__put_vec3(fe__put_float(fe__put_float(at, n.radius), n.half_height), n.half);
    at = write_quat(fe__put_vec3(fe__put_vec3(at, scale), p->position), p->rotation);
    at = fe__put_i32(fe__put_i32(fe__put_float(at, p->density), p->own_material), 0);
    if (p->own_material)
        at = fe__cooked_material_write(&p->material, at);
    else
        at = (unsigned char *)memset(at, 0, FE__COOKED_MATERIAL) + FE__COOKED_MATERIAL;
    return fe__put_u64(at, p->user_data);
}

unsigned char *fe__compound_write(const fe_store *store, const fe__compound *c, unsigned char *out)
{
    int32_t count = number_assets(store, c);
    unsigned char *at = fe__put_i32(fe__put_i32(out, c->count), count);
    for (int32_t i = 0; i < c->count; ++i) at = write_part(store, c->parts + i, at);
    for (int32_t i = 0, part = 0; i < count; ++i) {
        const fe__asset *asset = find_numbered(store, c, i, &part);
        int64_t size = fe__asset_bytes(store, asset);
        fe__asset_write(store, asset, at);
        fe__asset_seal(at, size);
        at += size;
    }
    return at;
}

// ---- reading -------------------------------------------------------------------------------------------------------
// Until the compound has them, its assets are the store's, with handles that nobody knows
typedef struct children {
    fe_asset *handles;
    int32_t count, used; // those of parts so far are the first `used`
} children;

static int32_t lack_memory(fe__cooked *c)
{
    c->result = FE_ERROR_MEMORY;
    return 0;
}

static int32_t is_zero(fe__cooked *c, const char *name, int32_t bytes)
{
    for (const unsigned char *end = c->at + bytes; c->at < end; ++c->at)
        if (*c->at) return fe__cooked_refuse(c, c->at, "%s: %d, must be 0", name, *c->at);
    return 1;
}

static int32_t read_vec3(fe__cooked *c, const char *name, float most, fe_vec3 *out)
{
    return fe__cooked_float(c, name, -most, most, &out->x) && fe__cooked_float(c, name, -most, most, &out->y) &&
           fe__cooked_float(c, name, -most, most, &out->z);
}

static int32_t read_rotation(fe__cooked *c, fe_quat *q)
{
    const double unit_error = 1e-6; // of |q|^2: a unit quaternion in floats is off by some 2e-7
    const unsigned char *at = c->at;
    if (!fe__cooked_float(c, "rotation", -2.0f, 2.0f, &q->x) || !fe__cooked_float(c, "rotation", -2.0f, 2.0f, &q->y) ||
        !fe__cooked_float(c, "rotation", -2.0f, 2.0f, &q->z) || !fe__cooked_float(c, "rotation", -2.0f, 2.0f, &q->w))
        return 0;
    const double x = (double)q->x, y = (double)q->y, z = (double)q->z, w = (double)q->w;
    if (fe__absd(x * x + y * y + z * z + w * w - 1.0) < unit_error) return 1;
    return fe__cooked_refuse(c, at, "the rotation's length is not 1");
}

// ---- the form of a part ---------------------------------------------------------------------------------------------
// Of the asset under its scale: the part keeps it alive. The lock is held
static int32_t take_record(fe_store *store, fe__cooked *c, fe_asset handle, int32_t kind, fe_vec3 scale, fe__form *form)
{
    int32_t index;
    fe__scale_refusal refusal;
    if (fe__store_find(store, handle, &index) != FE_OK || fe__asset_form(store, index).type != kind)
        return fe__cooked_refuse(c, c->at, "the asset is of another kind than the part");
    if (scale.x != 1.0f || scale.y != 1.0f || scale.z != 1.0f) {
        fe_result made = fe__asset_takes_scale(fe__store_asset(store, index), scale)
                             ? fe__asset_scaled(store, index, scale, &index, &refusal)
                             : FE_ERROR_DEGENERATE;
        if (made == FE_ERROR_DEGENERATE) return fe__cooked_refuse(c, c->at, "the asset cannot have the scale");
        if (made != FE_OK) return c->result = made, 0;
    }
    fe__asset_retain(store, index);
    *form = fe__asset_form(store, index);
    return 1;
}

static int32_t read_asset_form(fe_store *store, fe__cooked *c, children *kids, int32_t kind, int32_t number,
                               fe__form *form)
{
    fe_vec3 scale;
    if (!is_zero(c, "sizes of a form that is an asset's", 20) || !read_vec3(c, "scale", FE_MAX_SCALE, &scale)) return 0;
    kids->used = fe__maxi(kids->used, number + 1);
    fe__store_lock(store);
    int32_t taken = take_record(store, c, kids->handles[number], kind, scale, form);
    fe__store_unlock(store);
    return taken;
}

static int32_t read_own_form(fe__cooked *c, int32_t kind, fe__form *form)
{
    const unsigned char *at = c->at;
    fe__form_numbers n = {.kind = kind};
    n.radius = fe__take_float(&c->at), n.half_height = fe__take_float(&c->at), n.half = fe__take_vec3(&c->at);
    *form = fe__form_of_numbers(&n);
    if (!fe__form_is_sound(form)) return fe__cooked_refuse(c, at, "these are no sizes of a %s", fe__forms[kind].name);
    return is_zero(c, "scale of a form without an asset", 12);
}

static int32_t read_form(fe_store *store, fe__cooked *c, children *kids, fe__form *form)
{
    const unsigned char *at = c->at;
    int32_t geometry = fe__take_i32(&c->at), kind = fe__form_of_geometry(geometry), number;
    if (kind < 0 || fe__forms[kind].of_parts || fe__forms[kind].unbounded)
        return fe__cooked_refuse(c, at, "geometry %d is none of a part", (int)geometry);
    int32_t has_asset = fe__forms[kind].has_asset, most = fe__mini(kids->used, kids->count - 1);
    if (has_asset && most < 0) return fe__cooked_refuse(c, at, "the part has an asset, but there are none");
    if (!fe__cooked_int(c, "the number of the asset", has_asset ? 0 : -1, has_asset ? most : -1, &number)) return 0;
    return has_asset ? read_asset_form(store, c, kids, kind, number, form) : read_own_form(c, kind, form);
}

// ---- parts ----------------------------------------------------------------------------------------------------------
// On 1 it counts among the compound's parts: what it has is let go of with them
static int32_t read_rest(fe__cooked *c, int32_t number, fe__compound_part *p)
{
    const unsigned char *at;
    if (!read_vec3(c, "position", FE_MAX_LOCAL, &p->position) || !read_rotation(c, &p->rotation)) return 0;
    at = c->at;
    if (!fe__cooked_float(c, "density", -1.0f, FE_MAX_DENSITY, &p->density)) return 0;
    if (p->density < 0.0f && p->density != -1.0f) return fe__cooked_refuse(c, at, "the density is below 0, and not -1");
    if (!fe__cooked_int(c, "own_material", 0, 1, &p->own_material) || !is_zero(c, "what has no use", 4)) return 0;
    if (!(p->own_material ? fe__cooked_material_read(c, number, &p->material)
                          : is_zero(c, "a material that the part has not", FE__COOKED_MATERIAL)))
        return 0;
    p->user_data = fe__take_u64(&c->at);
    return 1;
}

static int32_t read_parts(fe_store *store, fe__cooked *c, children *kids, int32_t count, fe__compound *compound)
{
    while (compound->count < count) {
        fe__compound_part *p = compound->parts + compound->count;
        p->material = fe__default_material(); // unless it has its own
        if (!read_form(store, c, kids, &p->form)) return 0;
        compound->count += 1;
        if (!read_rest(c, compound->count - 1, p)) return 0;
    }
    return kids->used == kids->count ||
           fe__cooked_refuse(c, c->at, "%d assets follow, parts have %d", (int)kids->count, (int)kids->used);
}

// ---- assets ---------------------------------------------------------------------------------------------------------
static int32_t read_children(fe_store *store, fe__cooked *c, const unsigned char *end, children *kids)
{
    for (int32_t count = kids->count; kids->used < count; ++kids->used) {
        if (fe__asset_read_part(store, c, end, kids->handles + kids->used) != FE_OK) return 0;
    }
    if (c->at == end) return 1;
    return fe__cooked_refuse(c, c->at, "%lld bytes stand behind the assets", (long long)(end - c->at));
}

// Those that parts have live on with them
static void let_go(fe_store *store, const children *kids, int32_t count)
{
    fe__store_lock(store);
    for (int32_t i = 0, index; i < count; ++i)
        if (fe__store_find(store, kids->handles[i], &index) == FE_OK) fe__asset_destroy(store, index);
    fe__store_unlock(store);
}

// ---- the whole -----------------------------------------------------------------------------------------------------
static int32_t read_counts(fe__cooked *c, const unsigned char *end, int32_t *out_parts, int32_t *out_assets)
{
    const unsigned char *at = c->at;
    if (end - at < COUNTS)
        return fe__cooked_refuse(c, at, "%lld bytes are left, must be %d", (long long)(end - at), COUNTS);
    if (!fe__cooked_int(c, "the number of parts", 1, FE__MOST_PARTS, out_parts) ||
        !fe__cooked_int(c, "the number of assets", 0, *out_parts, out_assets))
        return 0;
    int64_t needed = (int64_t)PART * *out_parts + (int64_t)FE__ASSET_HEADER * *out_assets, left = end - c->at;
    return left >= needed ||
           fe__cooked_refuse(c, c->at, "%lld bytes are left, must be %lld", (long long)left, (long long)needed);
}

static int32_t read_all(fe_store *store, fe__cooked *c, const unsigned char *end, int32_t parts, children *kids,
                        fe__compound *compound)
{
    const unsigned char *first_part = c->at;
    c->at += (int64_t)PART * parts;
    int32_t are_read = read_children(store, c, end, kids), made = kids->used;
    if (are_read) {
        c->at = first_part, kids->used = 0;
        are_read = read_parts(store, c, kids, parts, compound);
    }
    let_go(store, kids, made);
    if (are_read) c->at = end;
    return are_read;
}

int32_t fe__compound_read(fe_store *store, fe__cooked *c, const unsigned char *end, fe__asset *asset)
{
    int32_t parts;
    children kids = {0};
    if (!read_counts(c, end, &parts, &kids.count)) return 0;
    asset->compound.parts = fe__making_block(store, asset, (int64_t)sizeof *asset->compound.parts * parts);
    if (!asset->compound.parts) return lack_memory(c);
    if (!kids.count) return read_all(store, c, end, parts, &kids, &asset->compound);
    int64_t size = (int64_t)sizeof *kids.handles * kids.count;
    kids.handles = fe__making_scratch(store, size);
    if (!kids.handles) return lack_memory(c);
    int32_t are_read = read_all(store, c, end, parts, &kids, &asset->compound);
    fe__making_release(store, kids.handles, size);
    return are_read;
}
