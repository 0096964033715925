// store.h - the store: assets, the heavy data that the shapes of many worlds share.
//
// Any thread creates, reads and destroys assets, under the store's lock. Worlds that step take no lock: the records of
// assets stand in chunks that never move, and whoever learns an index has held the lock after its chunk and its record
// were written. A record lives as long as its owner or a world uses it; its samples change only when every world that
// uses it has been entered (world/asset_users.h).
#ifndef FE_STORE_STORE_H
#define FE_STORE_STORE_H
#include "collision/form/compound.h"
#include "collision/form/heightfield.h"
#include "collision/form/hull.h"
#include "collision/form/mesh.h"
#include "collision/form/form.h"
#include "collision/form/ground.h"
#include "core/id_pool.h"
#include "core/memory.h"
#include "core/mutex.h"
#include "core/registry.h"

typedef enum fe__asset_kind {
    FE__ASSET_HEIGHTFIELD,
    FE__ASSET_HULL,
    FE__ASSET_MESH,
    FE__ASSET_COMPOUND
} fe__asset_kind;

typedef struct fe__block {
    void *memory;
    size_t size;
} fe__block;

// What shapes share: a heightfield and the materials of its cells, a convex hull, a mesh and the materials of its
// triangles, or a compound, which uses the records of its parts.
enum { FE__ASSET_BLOCKS = 4 };
typedef struct fe__asset {
    int32_t kind; // fe__asset_kind
    int32_t block_count;
    fe__block blocks[FE__ASSET_BLOCKS]; // all memory that it owns
    union {
        fe__heightfield field;
        fe__hull hull;
        fe__mesh mesh;
        fe__compound compound;
    };
    fe_material *materials; // of the cells of a heightfield, the triangles of a mesh
    int32_t material_count;
    int32_t special;  // a material needs special rows
    int32_t is_keyed; // 1: `key` is that of the content as it is now (asset_key.h)
    uint64_t key[2];
    int64_t edition;   // of its heights or materials: no two contents of the store have the same. 0: as made
    int32_t users;     // worlds with shapes that have it, and calls that are about to make one; its scaled ones;
                       // parts of compounds
    int32_t destroyed; // by its owner: it goes with its last user
    fe_asset handle;   // kept here, so that it can be read without the lock
    int32_t index;     // its own
    int32_t mark;      // of whoever holds the lock, who has set it
    // Hulls and meshes under a scale are records of their own (asset.h): of the asset
    struct fe__asset *scaled; // the first of them
    // and of one of them
    struct fe__asset *parent; // NULL for an asset
    fe_vec3 scale;            // 1 each for an asset
    struct fe__asset *branch[2];
} fe__asset;

// Chunk k holds 4 * 2^k records: two shifts find one.
enum { FE__FIRST_CHUNK_BITS = 2, FE__CHUNKS = FE_ID_SLOT_BITS - FE__FIRST_CHUNK_BITS + 1 };

// A world in its store's list.
typedef struct fe__store_member {
    struct fe__store_member *next, *previous;
    fe_world *world;
} fe__store_member;

struct fe_store {
    fe__mutex lock;            // for all that follows
    fe__mutex allocator_guard; // a world and its own store share an allocator, see fe__memory.guard
    fe__memory memory;
    fe__entry entry; // in the registry, which counts the worlds
    fe__id_pool ids;
    int64_t editions;              // of all assets so far
    fe__asset *chunks[FE__CHUNKS]; // each written once
    fe__store_member *first_member;
};

// number 0: the next that no living store has
fe_result fe__store_create(const fe_allocator *allocator, int32_t number, fe_store **out_store);
// A world's own, which nobody may use or destroy but those that it shares it with; it goes with the last of them. The
// world has joined it, and shares the allocator and its guard.
fe_result fe__store_create_own(const fe_allocator *allocator, int32_t number, fe__store_member *member,
                               fe_store **out_store);
// FE_OK: destroyed. FE_ERROR_STALE: it was gone; FE_ERROR_STATE: so many worlds use it, or it is a world's own (0).
fe_result fe__store_try_destroy(fe_store *store, int32_t *out_users);

// A world begins to use the store. FE_ERROR_STALE: it is gone; FE_ERROR_ARGUMENT: it is another world's own.
fe_result fe__store_join(fe_store *store, fe__store_member *member);
void fe__store_join_beside(fe_store *store, fe__store_member *member); // a member is inside, and lets this one in
void fe__store_leave(fe_store *store, fe__store_member *member);
// What is no world, but has assets of it. By who uses the store already
void fe__store_retain(fe_store *store);
void fe__store_release(fe_store *store);

void fe__store_lock(const fe_store *store);
void fe__store_unlock(const fe_store *store);

// ---- under the lock ------------------------------------------------------------------------------------------------
// FE_OK, FE_ERROR_KIND, FE_ERROR_STALE: also for an asset that lives on for its shapes only
fe_result fe__store_find(const fe_store *store, fe_asset handle, int32_t *out_index);
void fe__asset_destroy(fe_store *store, int32_t index); // now, or with its last user
void fe__asset_retain(fe_store *store, int32_t index);
void fe__asset_release(fe_store *store, int32_t index); // the last user of a destroyed one frees it
void fe__compound_release_parts(fe_store *store, const fe__compound *compound);
// Gives a record a place and a handle; the store owns its blocks then. FE_ERROR_MEMORY, FE_ERROR_LIMIT: nothing
// changed.
fe_result fe__store_put(fe_store *store, const fe__asset *asset, fe_asset *out_handle);
// A block of an asset that is being made: zeroed, aligned to 64 bytes; NULL: no memory.
void *fe__asset_allocate(fe_store *store, fe__asset *asset, size_t size);
void fe__asset_free(fe_store *store, fe__asset *asset); // its blocks

// ---- without the lock -----------------------------------------------------------------------------------------------
// The record of an asset that the caller uses: it stays where it is.
static inline fe__asset *fe__store_asset(const fe_store *store, int32_t index)
{
    uint32_t i = (uint32_t)index + (1u << FE__FIRST_CHUNK_BITS);
    int32_t top = 31 - __builtin_clz(i);
    return store->chunks[top - FE__FIRST_CHUNK_BITS] + (i - (1u << top));
}
static inline const fe__heightfield *fe__store_field(const fe_store *store, int32_t index)
{
    return &fe__store_asset(store, index)->field;
}

// Of a form that is a field
static inline fe__ground fe__store_ground(const fe_store *store, const fe__form *form)
{
    const fe__asset *a = fe__store_asset(store, form->field);
    return a->kind == FE__ASSET_MESH ? (fe__ground){.mesh = &a->mesh} : (fe__ground){.field = &a->field};
}

// Of a shape; `triangle`: the number of one of its surface, -1: none in particular
static inline const fe_material *fe__material_of_shape(const fe_store *store, const fe__shape *shape, int32_t triangle)
{
    if (!fe__form_is_field(&shape->form) || triangle < 0) return &shape->material;
    const fe__asset *a = fe__store_asset(store, shape->form.field);
    if (!a->material_count) return &shape->material;
    if (a->kind == FE__ASSET_MESH) return a->materials + a->mesh.materials[fe__mesh_slot(&a->mesh, triangle)];
    return a->materials + a->field.cells[triangle / 2];
}
// The same by the triangle's index (collision/form/ground.h)
static inline const fe_material *fe__material_of_index(const fe_store *store, const fe__shape *shape, int32_t index)
{
    const fe__asset *a = fe__form_is_field(&shape->form) ? fe__store_asset(store, shape->form.field) : NULL;
    if (!a || index < 0 || !a->material_count) return &shape->material;
    return a->materials + (a->kind == FE__ASSET_MESH ? a->mesh.materials[index] : a->field.cells[index / 2]);
}

// What the caller knows: of a record under a scale, the asset
static inline const fe__asset *fe__store_parent(const fe_store *store, int32_t index)
{
    const fe__asset *a = fe__store_asset(store, index);
    return a->parent ? a->parent : a;
}

// The form of a shape that has the asset
static inline fe__form fe__asset_form(const fe_store *store, int32_t index)
{
    const fe__asset *a = fe__store_asset(store, index);
    if (a->kind == FE__ASSET_HULL) return fe__hull_form(&a->hull, index);
    if (a->kind == FE__ASSET_COMPOUND) return fe__compound_form(index);
    return a->kind == FE__ASSET_MESH ? fe__mesh_form(&a->mesh, index) : fe__heightfield_form(&a->field, index);
}

#endif
