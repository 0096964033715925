// asset_bytes.c - see asset_bytes.h.
#include "store/asset_bytes.h"

#include "collision/cooked/cooked.h"
#include "collision/form/form.h"
#include "core/bytes.h"
#include "core/material.h"
#include "store/asset.h"
#include "store/store.h"

#include <stdio.h>

// ---- compound bytes -------------------------------------------------------------------------------------------------
// The parts of a compound as bytes, and the assets that they have.
//
//   parts, assets (counts) | parts | the bytes of each asset (asset_bytes.h)
//   a part   geometry | number of its asset, -1: none | radius, half height | half extents | scale | position |
//            rotation | density | 1: a material of its own | 0 | the material | user data
//
// Assets stand in the order in which parts first have them, each once, so that what is read is written again as it was.
// What a part does not have is 0 in all bits.

int64_t fe__compound_bytes(const fe_store *store, const fe__compound *compound);
// Under the lock. Returns the end
unsigned char *fe__compound_write(const fe_store *store, const fe__compound *compound, unsigned char *out);

// The compound and its block become the asset's, its assets live as long as it does. 0: refused, or no memory: the
// caller drops the asset with the parts that it has. The lock is free.
int32_t fe__compound_read(fe_store *store, fe__cooked *cooked, const unsigned char *end, fe__asset *asset);

// ---- asset bytes ----------------------------------------------------------------------------------------------------

// The last byte ends what is printed of it
static const unsigned char magic[8] = {'F', 'E', 'A', 'T', 'H', 'E', 'R', 0x1A};
enum { VERSION = 1, KIND_HEIGHTFIELD = 1, KIND_HULL = 2, KIND_MESH = 3, KIND_COMPOUND = 4 };
enum { HEADER = FE__ASSET_HEADER, KIND_AT = 12, MATERIALS_AT = 20, SIZE_AT = 24, HASH_AT = 32 };
enum { HAS_CELLS = 1 };                  // features of heightfields
enum { IS_TWO_SIDED = 1, HAS_DATA = 2 }; // and of meshes

typedef struct header {
    int32_t kind;
    uint32_t features;
    int32_t material_count;
} header;

// ---- writing -------------------------------------------------------------------------------------------------------
static header header_of(const fe__asset *a)
{
    header h = {.material_count = a->material_count};
    switch (a->kind) {
    case FE__ASSET_HEIGHTFIELD:
        h.kind = KIND_HEIGHTFIELD, h.features = a->field.cells ? HAS_CELLS : 0;
        break;
    case FE__ASSET_HULL:
        h.kind = KIND_HULL;
        break;
    case FE__ASSET_COMPOUND:
        h.kind = KIND_COMPOUND;
        break;
    default:
        h.kind = KIND_MESH, h.features = (a->mesh.is_two_sided ? IS_TWO_SIDED : 0) | (a->mesh.data ? HAS_DATA : 0);
    }
    return h;
}

static int64_t form_bytes(const fe_store *store, const fe__asset *a)
{
    switch (a->kind) {
    case FE__ASSET_HEIGHTFIELD:
        return fe__cooked_field_size(&a->field);
    case FE__ASSET_HULL:
        return fe__cooked_hull_size(&a->hull);
    case FE__ASSET_COMPOUND:
        return fe__compound_bytes(store, &a->compound);
    default:
        return fe__cooked_mesh_size(&a->mesh);
    }
}

static unsigned char *write_form(const fe_store *store, const fe__asset *a, unsigned char *out)
{
    switch (a->kind) {
    case FE__ASSET_HEIGHTFIELD:
        return fe__cooked_field_write(&a->field, out);
    case FE__ASSET_HULL:
        return fe__cooked_hull_write(&a->hull, out);
    case FE__ASSET_COMPOUND:
        return fe__compound_write(store, &a->compound, out);
    default:
        return fe__cooked_mesh_write(&a->mesh, out);
    }
}

static int64_t materials_bytes(int32_t count) { return (int64_t)FE__COOKED_MATERIAL * count; }
static int64_t padded(int64_t size) { return (size + 7) / 8 * 8; }

int64_t fe__asset_bytes(const fe_store *store, const fe__asset *a)
{
    return padded(HEADER + materials_bytes(a->material_count) + form_bytes(store, a));
}

void fe__asset_write(const fe_store *store, const fe__asset *a, unsigned char *out)
{
    header h = header_of(a);
    int64_t size = fe__asset_bytes(store, a);
    unsigned char *at = fe__put_bytes(out, magic, sizeof magic);
    at = fe__put_u32(fe__put_i32(fe__put_u32(at, VERSION), h.kind), h.features);
    at = fe__put_u64(fe__put_u64(fe__put_i32(at, h.material_count), (uint64_t)size), 0);
    for (int32_t i = 0; i < a->material_count; ++i) at = fe__cooked_material_write(a->materials + i, at);
    at = write_form(store, a, at);
    memset(at, 0, (size_t)(out + size - at));
}

// ---- the hash ------------------------------------------------------------------------------------------------------
static void hash_words(fe__hash *hash, const unsigned char *at, int64_t size)
{
    for (const unsigned char *end = at + size; at < end;) fe__hash_u64(hash, fe__take_u64(&at));
}

static uint64_t hash_of(const unsigned char *bytes, int64_t size)
{
    fe__hash hash = fe__hash_begin();
    hash_words(&hash, bytes, HASH_AT);
    hash_words(&hash, bytes + HEADER, size - HEADER);
    return fe__hash_end(&hash);
}

void fe__asset_seal(unsigned char *out, int64_t size) { fe__put_u64(out + HASH_AT, hash_of(out, size)); }

// ---- the header ----------------------------------------------------------------------------------------------------
typedef struct reading {
    fe_store *store;
    fe__cooked *cooked;
    const unsigned char *start, *end; // of the asset
    header header;
    fe__asset asset;
} reading;

static int32_t refuse_newer(fe__cooked *c, const char *what, uint32_t number)
{
    snprintf(c->sentence, sizeof c->sentence, "%s %lu is of a newer library", what, (unsigned long)number);
    c->result = FE_ERROR_VERSION;
    return 0;
}

// All that a version may not change is where it stands
static int32_t check_version(const reading *r)
{
    const unsigned char *at = r->start + sizeof magic;
    int64_t size = r->end - r->start;
    if (size < HEADER)
        return fe__cooked_refuse(r->cooked, r->start, "there are %lld bytes, a header has %d", (long long)size, HEADER);
    if (memcmp(r->start, magic, sizeof magic))
        return fe__cooked_refuse(r->cooked, r->start, "these are no bytes of fe_asset_save");
    uint32_t version = fe__take_u32(&at);
    return version > VERSION ? refuse_newer(r->cooked, "format", version) : 1;
}

// Size and hash: these are the bytes that were written, unless by intent
static int32_t check_whole(const reading *r)
{
    const unsigned char *at = r->start + SIZE_AT;
    int64_t size = r->end - r->start;
    uint64_t told = fe__take_u64(&at), hash = fe__take_u64(&at);
    if (told != (uint64_t)size || size % 8)
        return fe__cooked_refuse(r->cooked, r->start + SIZE_AT, "there are %lld bytes, fe_asset_save wrote %llu",
                                 (long long)size, (unsigned long long)told);
    if (hash != hash_of(r->start, size))
        return fe__cooked_refuse(r->cooked, r->start + HASH_AT, "the hash is not that of the bytes: they were altered");
    return 1;
}

static int32_t read_header(reading *r)
{
    static const uint32_t features[] = {
        [KIND_HEIGHTFIELD] = HAS_CELLS, [KIND_MESH] = IS_TWO_SIDED | HAS_DATA, [KIND_COMPOUND] = 0};
    fe__cooked *c = r->cooked;
    header *h = &r->header;
    if (!check_version(r) || !check_whole(r)) return 0;
    c->at = r->start + sizeof magic;
    uint32_t version = fe__take_u32(&c->at), kind = fe__take_u32(&c->at);
    h->features = fe__take_u32(&c->at);
    if (kind > KIND_COMPOUND) return refuse_newer(c, "kind", kind);
    if (version == 0 || kind == 0) return fe__cooked_refuse(c, r->start + sizeof magic, "0 is no version or kind");
    if (h->features & ~features[kind]) return refuse_newer(c, "feature", h->features & ~features[kind]);
    int32_t most = kind == KIND_HEIGHTFIELD || kind == KIND_MESH ? FE__MESH_MATERIALS : 0;
    if (!fe__cooked_int(c, "the number of materials", 0, most, &h->material_count)) return 0;
    if (kind == KIND_HEIGHTFIELD && h->material_count && !h->features)
        return fe__cooked_refuse(c, r->start + MATERIALS_AT, "there are materials, but no cells that have them");
    h->kind = (int32_t)kind;
    c->at = r->start + HEADER;
    return 1;
}
_Static_assert((int)FE__MESH_MATERIALS == (int)FE__FIELD_MATERIALS, "one limit for both");

// ---- the form ------------------------------------------------------------------------------------------------------
static int32_t refuse_size(reading *r, int64_t needed)
{
    return fe__cooked_refuse(r->cooked, r->cooked->at, "%lld bytes are left, must be %lld",
                             (long long)(r->end - r->cooked->at), (long long)needed);
}

// Are there so many bytes for the counts?
static int32_t has_room(reading *r, int64_t size) { return r->end - r->cooked->at >= size || refuse_size(r, size); }

// As many as the counts say, but for what fills the last eight, which is 0
static int32_t is_whole(reading *r, int64_t size)
{
    int64_t left = r->end - r->cooked->at;
    if (size > left || left - size > 7) return refuse_size(r, size);
    for (const unsigned char *at = r->cooked->at + size; at < r->end; ++at)
        if (*at) return fe__cooked_refuse(r->cooked, at, "%d stands behind the form, must be 0", *at);
    return 1;
}

static int32_t lack_memory(reading *r)
{
    r->cooked->result = FE_ERROR_MEMORY;
    return 0;
}

static int32_t read_field(reading *r)
{
    fe__heightfield *f = &r->asset.field;
    if (!has_room(r, FE__COOKED_FIELD_COUNTS) || !fe__cooked_field_counts(r->cooked, f)) return 0;
    int32_t has_cells = (r->header.features & HAS_CELLS) != 0;
    int64_t cells = has_cells ? (int64_t)(f->rows - 1) * (f->columns - 1) : 0;
    if (!is_whole(r, 4 * (int64_t)f->rows * f->columns + cells)) return 0;
    if (!fe__heightfield_allocate(r->store, &r->asset, has_cells)) return lack_memory(r);
    return fe__cooked_field_read(r->cooked, f, r->header.material_count);
}

static int32_t read_hull(reading *r)
{
    fe__hull *h = &r->asset.hull;
    if (!has_room(r, FE__COOKED_HULL_COUNTS) || !fe__cooked_hull_counts(r->cooked, h)) return 0;
    if (!is_whole(r, fe__cooked_hull_size(h) - FE__COOKED_HULL_COUNTS)) return 0;
    void *block = fe__making_block(r->store, &r->asset, fe__cooked_hull_block(h));
    return block ? fe__cooked_hull_read(r->cooked, h, block) : lack_memory(r);
}

static int32_t read_mesh(reading *r)
{
    fe__mesh *m = &r->asset.mesh;
    const fe__cooked_mesh about = {(r->header.features & IS_TWO_SIDED) != 0, (r->header.features & HAS_DATA) != 0,
                                   r->header.material_count};
    if (!has_room(r, FE__COOKED_MESH_COUNTS) || !fe__cooked_mesh_counts(r->cooked, m)) return 0;
    if (!is_whole(r, fe__cooked_mesh_arrays(m, &about))) return 0;
    void *block = fe__making_block(r->store, &r->asset, fe__cooked_mesh_block(m, &about));
    if (!block) return lack_memory(r);
    int64_t size = fe__cooked_mesh_scratch(m);
    void *scratch = fe__making_scratch(r->store, size);
    if (!scratch) return lack_memory(r);
    int32_t is_read = fe__cooked_mesh_read(r->cooked, &about, m, block, scratch);
    fe__making_release(r->store, scratch, size);
    return is_read;
}

static int32_t read_form(reading *r)
{
    switch (r->header.kind) {
    case KIND_HEIGHTFIELD:
        r->asset.kind = FE__ASSET_HEIGHTFIELD;
        return read_field(r);
    case KIND_HULL:
        r->asset.kind = FE__ASSET_HULL;
        return read_hull(r);
    case KIND_COMPOUND:
        r->asset.kind = FE__ASSET_COMPOUND;
        return fe__compound_read(r->store, r->cooked, r->end, &r->asset);
    default:
        r->asset.kind = FE__ASSET_MESH;
        return read_mesh(r);
    }
}

// ---- the whole -----------------------------------------------------------------------------------------------------
static int32_t read_materials(reading *r)
{
    fe__asset *a = &r->asset;
    int32_t count = r->header.material_count;
    if (count == 0) return 1;
    if (!has_room(r, materials_bytes(count))) return 0;
    a->materials = fe__making_block(r->store, a, (int64_t)sizeof *a->materials * count);
    if (!a->materials) return lack_memory(r);
    a->material_count = count;
    for (int32_t i = 0; i < count; ++i) {
        if (!fe__cooked_material_read(r->cooked, i, a->materials + i)) return 0;
        a->special |= fe__material_is_special(a->materials + i);
    }
    return 1;
}

static fe_result read_asset(fe_store *store, fe__cooked *c, const unsigned char *end, fe_asset *out_handle)
{
    reading r = {.store = store, .cooked = c, .start = c->at, .end = end};
    if (!read_header(&r)) return c->result;
    if (read_materials(&r) && read_form(&r)) {
        c->at = end;
        return c->result = fe__making_put(store, &r.asset, out_handle);
    }
    fe__making_drop(store, &r.asset);
    return c->result;
}

fe_result fe__asset_read(fe_store *store, const void *bytes, int64_t size, fe__cooked *c, fe_asset *out_handle)
{
    *c = (fe__cooked){.begin = bytes, .at = bytes};
    return read_asset(store, c, c->begin + size, out_handle);
}

fe_result fe__asset_read_part(fe_store *store, fe__cooked *c, const unsigned char *end, fe_asset *out_handle)
{
    int64_t left = end - c->at;
    if (left < HEADER)
        return fe__cooked_refuse(c, c->at, "%lld bytes are left, a header has %d", (long long)left, HEADER), c->result;
    const unsigned char *at = c->at + KIND_AT, *size_at = c->at + SIZE_AT;
    uint32_t kind = fe__take_u32(&at);
    uint64_t size = fe__take_u64(&size_at);
    if (kind == KIND_COMPOUND)
        return fe__cooked_refuse(c, c->at + KIND_AT, "a compound stands among the assets of a compound"), c->result;
    if (size > (uint64_t)left)
        return fe__cooked_refuse(c, c->at + SIZE_AT, "%lld bytes are left, the asset has %llu", (long long)left,
                                 (unsigned long long)size),
               c->result;
    return read_asset(store, c, c->at + size, out_handle);
}

// ---- compound bytes -------------------------------------------------------------------------------------------------

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

static int32_t out_of_memory(fe__cooked *c)
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

static int32_t read_child_form(fe_store *store, fe__cooked *c, children *kids, fe__form *form)
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
        if (!read_child_form(store, c, kids, &p->form)) return 0;
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
    if (!asset->compound.parts) return out_of_memory(c);
    if (!kids.count) return read_all(store, c, end, parts, &kids, &asset->compound);
    int64_t size = (int64_t)sizeof *kids.handles * kids.count;
    kids.handles = fe__making_scratch(store, size);
    if (!kids.handles) return out_of_memory(c);
    int32_t are_read = read_all(store, c, end, parts, &kids, &asset->compound);
    fe__making_release(store, kids.handles, size);
    return are_read;
}
