// asset_bytes.c - see asset_bytes.h.
#include "store/asset_bytes.h"

#include "core/hash.h"
#include "store/compound_bytes.h"
#include "store/heightfield_asset.h"
#include "store/making.h"

#include <stdio.h>

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
