// restore.c - see restore.h.
#include "snapshot/restore.h"

#include "broadphase/tree.h"
#include "collision/form/form.h"
#include "core/bytes.h"
#include "core/sort.h"
#include "snapshot/rows.h"
#include "solver/graph/graph.h"
#include "solver/solver.h"
#include "store/asset.h"
#include "world/asset_users.h"
#include "world/body.h"
#include "world/encounter.h"
#include "world/filter.h"
#include "world/joint.h"
#include "world/joint_creation.h"
#include "world/joint_parts.h"
#include "world/shape.h"
#include "world/world_memory.h"

#include <float.h>
#include <string.h>

// ---- assemble -------------------------------------------------------------------------------------------------------
// A whole world out of a snapshot.

// 0: refused, see snapshot->result; the caller frees what is there
int32_t fe__build_world(fe__build *build);

// ---- restore --------------------------------------------------------------------------------------------------------

int32_t fe__snapshot_prepare(fe__build *b, fe_world *world, fe_world *beside, int32_t number)
{
    beside->memory = world->memory; // counted on from here, and back when it is dropped
    beside->store = world->store;
    beside->number = number;
    beside->static_tree.kernels = world->static_tree.kernels;
    beside->moving_tree.kernels = world->moving_tree.kernels;
    b->world = beside;
    b->snapshot->number = number; // in the handles of its events
    return fe__build_world(b);
}

// ---- the exchange --------------------------------------------------------------------------------------------------
static void swap_bytes(unsigned char *a, unsigned char *b, size_t size)
{
    enum { PIECE = 256 };
    unsigned char held[PIECE];
    for (size_t at = 0; at < size; at += PIECE) {
        size_t piece = size - at < PIECE ? size - at : PIECE;
        memcpy(held, a + at, piece);
        memcpy(a + at, b + at, piece);
        memcpy(b + at, held, piece);
    }
}

void fe__world_follow_state(fe_world *world, int32_t burdened)
{
    world->solver.burdened = burdened;
    world->solver.unbuilt = world->awake_linked_count;
    fe__graph_forget(&world->solver);
    world->clusters.is_stale = world->joints.forest.changed = 1;
    if (world->scratch) atomic_store(&world->scratch->some_deferred, 1);
}

// Does the asset hold what the shapes had when the world was saved? The caller may have given another one for its key,
// and another thread may have edited it since the forms were taken: it could not enter the new state.
static int32_t is_as_saved(const fe__build *b, const fe_store *store, const fe__asset *asset)
{
    if (asset->kind != FE__ASSET_HEIGHTFIELD && asset->kind != FE__ASSET_MESH) return 1;
    if (asset->edition == 0 && !b->has_stand_ins) return 1;
    const fe__asset_key now = fe__asset_key_of(store, asset->index);
    for (int32_t i = 0; i < fe__rows_of(b->snapshot, FE__TABLE_ASSETS); ++i) {
        fe__asset_row row;
        fe__take_row(b->snapshot, FE__TABLE_ASSETS, i, &row);
        if (row.key[0] == now.words[0] && row.key[1] == now.words[1]) return 1;
    }
    return 0;
}

// The boxes and pairs are those of the saved world. Where an asset holds something else they are found anew.
void fe__snapshot_adopt(fe_world *world, fe_world *beside, const fe__build *build)
{
    fe__store_lock(world->store);
    for (int32_t i = 0; i < FE__MEMBERS; ++i) {
        const fe__members *members = fe__state_members + i;
        swap_bytes((unsigned char *)world + members->first, (unsigned char *)beside + members->first,
                   members->end - members->first);
    }
    fe__world_follow_state(world, beside->solver.burdened);
    for (int32_t i = 0; i < world->use_count; ++i)
        if (!is_as_saved(build, world->store, fe__store_parent(world->store, world->uses[i].asset)))
            fe__asset_renew(world, world->uses + i);
    fe__store_unlock(world->store);
}

void fe__snapshot_drop(fe_world *world, fe_world *beside)
{
    fe__store_lock(world->store);
    fe__world_release_assets(beside);
    fe__store_unlock(world->store);
    fe__world_free_state(beside);
    world->memory.bytes = beside->memory.bytes;
    world->memory.allocations = beside->memory.allocations;
}

// ---- build ----------------------------------------------------------------------------------------------------------
// See restore.h: slots, records of pools, the order of creation.

int32_t fe__lack_memory(const fe__build *b) { return fe__snapshot_fail(b->snapshot, FE_ERROR_MEMORY); }

// ---- slots ---------------------------------------------------------------------------------------------------------
// The stack of free slots holds each of them once, and nothing else
static int32_t follow_free(fe__build *b, fe__id_pool *pool, const char *name)
{
    int32_t slot = pool->free_head, seen = 0;
    for (; slot != FE_ID_NONE; ++seen) {
        if (slot < 0 || slot >= pool->slot_count || seen == pool->free_count)
            return fe__snapshot_refuse(b->snapshot, "%s: the stack of free slots leads astray", name);
        slot = pool->slots[slot].next;
    }
    return seen == pool->free_count || fe__snapshot_refuse(b->snapshot, "%s: a free slot is lost", name);
}

static int32_t build_pool_of_slots(fe__build *b, fe__id_pool *pool, fe__table_number table, int32_t free_head)
{
    const char *name = fe__tables[table].name;
    int32_t count = fe__rows_of(b->snapshot, table);
    if (count > FE_ID_MAX_SLOTS) return fe__snapshot_refuse(b->snapshot, "%s: %d are too many", name, (int)count);
    if (!FE_RESERVE(fe__memory_of(b), pool->slots, pool->capacity, count)) return fe__lack_memory(b);
    pool->slot_count = count;
    pool->free_head = free_head;
    for (int32_t i = 0; i < count; ++i) {
        fe__take_row(b->snapshot, table, i, pool->slots + i);
        int32_t next = pool->slots[i].next;
        if (next >= count) return fe__snapshot_refuse(b->snapshot, "%s: slot %d follows %d", name, (int)next, (int)i);
        pool->alive_count += next == FE_ID_ALIVE;
        pool->free_count += next >= 0 || next == FE_ID_NONE;
        if (next == FE_ID_HIDDEN && table == FE__TABLE_JOINT_SLOTS)
            return fe__snapshot_refuse(b->snapshot, "%s: slot %d is hidden", name, (int)i);
    }
    return follow_free(b, pool, name);
}

int32_t fe__build_slots(fe__build *b, const fe__world_row *row)
{
    fe_world *w = b->world;
    fe__id_pool_init(&w->body_ids, FE_KIND_BODY, w->number);
    fe__id_pool_init(&w->shape_ids, FE_KIND_SHAPE, w->number);
    fe__joints_init(w);
    return build_pool_of_slots(b, &w->body_ids, FE__TABLE_BODY_SLOTS, row->free_slots[0]) &&
           build_pool_of_slots(b, &w->shape_ids, FE__TABLE_SHAPE_SLOTS, row->free_slots[1]) &&
           build_pool_of_slots(b, &w->joint_ids, FE__TABLE_JOINT_SLOTS, row->free_slots[2]);
}

// ---- records of pools ----------------------------------------------------------------------------------------------
int32_t fe__build_pool(fe__build *b, fe__record_pool *pool, int32_t limit, fe__table_number free, fe__table_number used)
{
    int64_t free_count = fe__rows_of(b->snapshot, free), used_count = fe__rows_of(b->snapshot, used);
    const char *name = fe__tables[used].name;
    if (limit != 1 + free_count + used_count || (int64_t)limit * pool->size > INT32_MAX)
        return fe__snapshot_refuse(b->snapshot, "%s: %d records are not those in use and those that are free", name,
                                   (int)limit);
    if (!FE_RESERVE(fe__memory_of(b), pool->records, pool->capacity, limit * pool->size)) return fe__lack_memory(b);
    pool->limit = limit;
    pool->free_count = (int32_t)free_count;
    // from the last: each record holds the next one, and -1 until it is known to be free
    const int32_t unknown = -1;
    for (int32_t i = 1; i < limit; ++i) memcpy(fe__record(pool, i), &unknown, sizeof unknown);
    for (int32_t i = (int32_t)free_count - 1; i >= 0; --i) {
        int32_t slot = fe__listed_slot(b->snapshot, free, i), known;
        if (slot < 1 || slot >= limit)
            return fe__snapshot_refuse(b->snapshot, "%s: there is no record %d", name, (int)slot);
        memcpy(&known, fe__record(pool, slot), sizeof known);
        if (known != unknown) return fe__snapshot_refuse(b->snapshot, "%s: record %d is free twice", name, (int)slot);
        memcpy(fe__record(pool, slot), &pool->first_free, sizeof pool->first_free);
        pool->first_free = slot;
    }
    return 1;
}

// ---- order ---------------------------------------------------------------------------------------------------------
// Room for 2 count items; the serials of the first half are written
static int32_t sort_by_serial(fe__build *b, const char *what, fe__sort_item *items, int32_t count)
{
    fe__sort_keys(items, count, items + count);
    for (int32_t i = 1; i < count; ++i)
        if (items[i].key == items[i - 1].key)
            return fe__snapshot_refuse(b->snapshot, "%s: two have the serial %llu", what,
                                       (unsigned long long)items[i].key);
    return 1;
}

int32_t fe__build_order(fe__build *b, const fe__ordered *what, int32_t count)
{
    if (count == 0) return 1;
    size_t size = 2 * sizeof(fe__sort_item) * (size_t)count;
    fe__sort_item *items = fe__allocate_scratch(fe__memory_of(b), size);
    if (!items) return fe__lack_memory(b);
    for (int32_t i = 0, slot = -1; i < count; ++i) {
        slot = fe__next_slot(what->pool, slot, what->with_hidden);
        items[i] = (fe__sort_item){what->serial_of(b->world, slot), slot, 0};
    }
    int32_t sound = sort_by_serial(b, what->name, items, count);
    for (int32_t i = 0; i < count && sound; ++i) sound = what->list(b, items[i].value);
    fe__release(fe__memory_of(b), items, size);
    return sound;
}

// ---- assemble -------------------------------------------------------------------------------------------------------
// See restore.h: the members of the world, then the parts in their order.

// ---- the world -----------------------------------------------------------------------------------------------------
static int32_t take_world(fe__build *b, fe__world_row *row)
{
    fe_world *w = b->world;
    if (fe__rows_of(b->snapshot, FE__TABLE_WORLD) != 1)
        return fe__snapshot_refuse(b->snapshot, "there is not one world");
    fe__take_row(b->snapshot, FE__TABLE_WORLD, 0, row);
    row->tuning.struct_size = sizeof row->tuning;
    if (row->next_serial == 0 || row->next_serial >> (64 - FE__PART_BITS) != 0 || row->step_number < 0)
        return fe__snapshot_refuse(b->snapshot, "the next serial is %llu, the step %lld",
                                   (unsigned long long)row->next_serial, (long long)row->step_number);
    if (row->row_kinds >> FE__ROW_KINDS << FE__ROW_KINDS || row->joint_row_kinds >> FE__PARTS ||
        row->pair_colours > FE__PAIR_COLOURS || row->static_colours > FE__STATIC_COLOURS ||
        row->most_joints > FE_ID_MAX_SLOTS)
        return fe__snapshot_refuse(b->snapshot, "there are no such rows or colours");
    if (row->has_extras && !(row->row_kinds >> FE__ROW_SPECIAL))
        return fe__snapshot_refuse(b->snapshot, "there are extras, but no special rows");
    w->user_data = row->user_data;
    w->next_serial = row->next_serial;
    w->step_number = row->step_number;
    w->gravity = row->gravity;
    w->substeps = row->substeps;
    w->last_h = row->last_h, w->last_dt = row->last_dt;
    w->row_kinds = row->row_kinds;
    w->tuning = row->tuning;
    w->first_body = w->last_body = w->first_free_pair = -1;
    w->pair_limit = 1;
    atomic_store(&w->point_count, 1);
    w->pair_colours = row->pair_colours, w->static_colours = row->static_colours;
    w->joints.row_kinds = row->joint_row_kinds;
    w->joints.most = row->most_joints;
    w->joints.forest.changed = 1;
    fe__record_pool_init(&w->ignores, sizeof(fe__ignore));
    fe__record_pool_init(&w->encounters, sizeof(fe__encounter));
    return 1;
}

static int32_t build_with_assets(fe__build *b)
{
    if (!fe__rows_of(b->snapshot, FE__TABLE_ASSETS)) return 1;
    fe__store_lock(b->world->store);
    int32_t built = fe__build_assets(b);
    fe__store_unlock(b->world->store);
    return built;
}

int32_t fe__build_world(fe__build *b)
{
    fe__world_row row;
    memset(&row, 0, sizeof row);
    return take_world(b, &row) && fe__build_slots(b, &row) && fe__build_bodies(b) && fe__build_shapes(b) &&
           build_with_assets(b) && fe__build_parts(b) && fe__build_joints(b) && fe__build_trees(b) &&
           fe__build_ignores(b, &row) && fe__build_pairs(b, &row) && fe__build_encounters(b, &row) &&
           fe__build_awake(b) && fe__build_events(b);
}

// ---- build bodies ---------------------------------------------------------------------------------------------------
// Bodies and shapes out of a snapshot, and the assets that shapes have.

#define FARTHEST 1e20 // m: beyond what a body can reach
#define UNIT_ERROR 1e-3f

enum { NO_ASSET = -1 }; // in a form, until that is found

static int32_t is_rotation(const float *q)
{
    return fe__absf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1.0f) < UNIT_ERROR;
}

static int32_t is_slot_used(const fe__id_pool *pool, int32_t slot)
{
    return pool->slots[slot].next == FE_ID_ALIVE || pool->slots[slot].next == FE_ID_HIDDEN;
}

// ---- bodies --------------------------------------------------------------------------------------------------------
enum {
    BODY_FLAGS = FE__BODY_ENABLED | FE__BODY_BULLET | FE__BODY_SLEEP_ALLOWED | FE__BODY_MASS_GIVEN |
                 FE__BODY_ISOTROPIC | FE__BODY_IGNORES | FE__BODY_DISTURBED | FE__BODY_SEEN_AWAKE | FE__BODY_STRAINED |
                 FE__BODY_STRETCHED | FE__BODY_SIZES_STALE | FE__BODY_BURDENED
};

static int32_t stands(const fe__body *body)
{
    for (int k = 0; k < 3; ++k)
        if (body->velocity[k] != 0.0f || body->spin[k] != 0.0f) return 0;
    return 1;
}

// The solver multiplies by the quotients of both. Of shapes and of calls, no dynamic body has less; its inverse mass is
// what its mass says, to the last bit
static int32_t weighs(const fe__body *body)
{
    const float least = FE_LEAST_INERTIA, *i = body->inertia;
    return body->mass >= FE_LEAST_MASS && body->inverse_mass == 1.0f / body->mass && i[0] >= least && i[1] >= least &&
           i[2] >= least;
}

static int32_t check_body(fe__build *b, const fe__body *body, int32_t slot)
{
    fe__snapshot *s = b->snapshot;
    for (int k = 0; k < 3; ++k)
        if (fe__absd(body->centre[k]) > FARTHEST || fe__absd(body->origin[k]) > FARTHEST)
            return fe__snapshot_refuse(s, "body in slot %d: it is too far off", (int)slot);
    if (body->flags & ~(uint32_t)BODY_FLAGS)
        return fe__snapshot_refuse(s, "body in slot %d: its flags are 0x%x", (int)slot, (unsigned)body->flags);
    if (!is_rotation(body->rotation) || !is_rotation(body->inertia_axes))
        return fe__snapshot_refuse(s, "body in slot %d: a rotation has another length than 1", (int)slot);
    if (body->type == FE_BODY_DYNAMIC ? !weighs(body) : body->inverse_mass != 0.0f)
        return fe__snapshot_refuse(s, "body in slot %d: its mass is none of its type", (int)slot);
    if (body->type == FE_BODY_STATIC && !stands(body))
        return fe__snapshot_refuse(s, "body in slot %d: it is static, and moves", (int)slot);
    if (body->serial == 0 || body->serial >= b->world->next_serial)
        return fe__snapshot_refuse(s, "body in slot %d: its serial is %llu", (int)slot,
                                   (unsigned long long)body->serial);
    return 1;
}

static void complete_body(fe_world *w, int32_t slot)
{
    fe__body *body = w->bodies + slot;
    float speed = body->speed;
    for (int k = 0; k < 3; ++k) {
        body->centre_high[k] = (float)body->centre[k];
        body->centre_low[k] = (float)(body->centre[k] - (double)body->centre_high[k]);
    }
    body->line = body->awake_index = -1;
    body->first_shape = body->last_shape = body->order_next = body->order_previous = -1;
    body->locked = body->lock_bits != 0.0f;
    fe__odometer_place(w->odometers + slot, body->centre);
    fe__note_speed(body, w->odometers + slot);
    body->speed = speed;
    fe__note_swiftness(w, fe__swiftness_of(body));
    w->has_bullets |= (body->flags & FE__BODY_BULLET) != 0;
    w->has_stale_sizes |= (body->flags & FE__BODY_SIZES_STALE) != 0;
    w->solver.burdened |= (body->flags & FE__BODY_BURDENED) != 0;
}

static int32_t reserve_bodies(fe__build *b, int32_t slots)
{
    fe_world *w = b->world;
    fe__memory *memory = fe__memory_of(b);
    return (FE_OPEN(memory, w->bodies, w->body_capacity, slots) &&
            FE_RESERVE(memory, w->odometers, w->odometer_capacity, slots) &&
            FE_RESERVE(memory, w->drifts, w->drift_capacity, slots) &&
            FE_RESERVE(memory, w->awake_bodies, w->awake_body_capacity, slots) &&
            FE_RESERVE(memory, w->disturbed, w->disturbed_capacity, w->body_capacity)) ||
           fe__lack_memory(b);
}

static int32_t list_body(fe__build *b, int32_t slot)
{
    fe_world *w = b->world;
    fe__body *body = w->bodies + slot;
    body->order_previous = w->last_body;
    if (w->last_body >= 0)
        w->bodies[w->last_body].order_next = slot;
    else
        w->first_body = slot;
    w->last_body = slot;
    w->body_count += 1;
    w->static_count += body->type == FE_BODY_STATIC;
    w->kinematic_count += body->type == FE_BODY_KINEMATIC;
    if (body->flags & FE__BODY_DISTURBED) w->disturbed[w->disturbed_count++] = slot;
    return 1;
}

static uint64_t serial_of_body(const fe_world *w, int32_t slot) { return w->bodies[slot].serial; }

int32_t fe__build_bodies(fe__build *b)
{
    fe_world *w = b->world;
    int32_t slots = w->body_ids.slot_count, rows = fe__rows_of(b->snapshot, FE__TABLE_BODIES);
    if (rows != w->body_ids.alive_count || rows != fe__rows_of(b->snapshot, FE__TABLE_DRIFTS))
        return fe__snapshot_refuse(b->snapshot, "bodies: %d rows, %d slots in use", (int)rows,
                                   (int)w->body_ids.alive_count);
    if (!reserve_bodies(b, slots)) return 0;
    for (int32_t slot = 0, row = 0; slot < slots; ++slot) {
        memset(w->bodies + slot, 0, sizeof *w->bodies);
        if (w->body_ids.slots[slot].next != FE_ID_ALIVE) continue;
        fe__take_row(b->snapshot, FE__TABLE_BODIES, row, w->bodies + slot);
        fe__take_row(b->snapshot, FE__TABLE_DRIFTS, row++, w->drifts + slot);
        if (!check_body(b, w->bodies + slot, slot)) return 0;
        complete_body(w, slot);
    }
    return fe__build_order(b, &(fe__ordered){"bodies", &w->body_ids, 0, serial_of_body, list_body}, rows);
}

// ---- shapes --------------------------------------------------------------------------------------------------------
enum {
    SHAPE_FLAGS = FE__SHAPE_TRIGGER | FE__SHAPE_CENTRED | FE__SHAPE_IN_TREE | FE__SHAPE_IN_PLANES | FE__SHAPE_JUDGED |
                  FE__SHAPE_ONE_WAY | FE__SHAPE_MOVED
};

static int32_t is_centred(const fe__shape *s)
{
    fe_vec3 p = s->local_position;
    fe_quat q = s->local_rotation;
    return p.x == 0.0f && p.y == 0.0f && p.z == 0.0f && q.x == 0.0f && q.y == 0.0f && q.z == 0.0f && q.w == 1.0f;
}

// By its form and whether its body is enabled
static uint32_t place_of(const fe_world *w, const fe__shape *s)
{
    if (!(w->bodies[s->body].flags & FE__BODY_ENABLED) || fe__form_is_of_parts(&s->form)) return 0;
    return fe__form_is_unbounded(&s->form) ? FE__SHAPE_IN_PLANES : FE__SHAPE_IN_TREE;
}

static int32_t may_have(const fe__body *body, const fe__form *form)
{
    if (fe__form_is_of_parts(form) || !fe__form_is_static_only(form) || body->type == FE_BODY_STATIC) return 1;
    return fe__form_is_carried(form) && body->type == FE_BODY_KINEMATIC;
}

static int32_t check_serial(fe__build *b, const fe__shape *shape, int32_t slot)
{
    const fe_world *w = b->world;
    int32_t is_part = w->shape_ids.slots[slot].next == FE_ID_HIDDEN, part = fe__part_of_serial(shape->serial);
    uint64_t creation = shape->serial >> FE__PART_BITS;
    if (creation == 0 || creation >= w->next_serial || is_part != (part >= 0) || is_part != (shape->parent >= 0))
        return fe__snapshot_refuse(b->snapshot, "shape in slot %d: its serial is %llu, it is part of %d", (int)slot,
                                   (unsigned long long)shape->serial, (int)shape->parent);
    return 1;
}

static int32_t check_shape(fe__build *b, const fe__shape *shape, int32_t slot)
{
    fe__snapshot *s = b->snapshot;
    const fe_world *w = b->world;
    if (!fe__id_pool_is_alive(&w->body_ids, shape->body))
        return fe__snapshot_refuse(s, "shape in slot %d: there is no body %d", (int)slot, (int)shape->body);
    if (!fe__form_has_asset(&shape->form) && !fe__form_is_sound(&shape->form))
        return fe__snapshot_refuse(s, "shape in slot %d: it is no form", (int)slot);
    if (!may_have(w->bodies + shape->body, &shape->form))
        return fe__snapshot_refuse(s, "shape in slot %d: its body may not have this form", (int)slot);
    uint32_t place = place_of(w, shape) | (is_centred(shape) ? (uint32_t)FE__SHAPE_CENTRED : 0u);
    const uint32_t placing = FE__SHAPE_IN_TREE | FE__SHAPE_IN_PLANES | FE__SHAPE_CENTRED;
    if (shape->flags & ~(uint32_t)SHAPE_FLAGS || (shape->flags & placing) != place)
        return fe__snapshot_refuse(s, "shape in slot %d: its flags are 0x%x", (int)slot, (unsigned)shape->flags);
    if (!fe__form_is_of_parts(&shape->form) && fe__form_is_static_only(&shape->form) &&
        shape->flags & FE__SHAPE_ONE_WAY)
        return fe__snapshot_refuse(s, "shape in slot %d: this form cannot be one-way", (int)slot);
    const fe_quat q = shape->local_rotation;
    if (!is_rotation((const float[]){q.x, q.y, q.z, q.w}))
        return fe__snapshot_refuse(s, "shape in slot %d: a rotation has another length than 1", (int)slot);
    return check_serial(b, shape, slot);
}

static int32_t take_shape(fe__build *b, int32_t slot, int32_t row)
{
    fe__shape *shape = b->world->shapes + slot;
    fe__form_numbers numbers;
    fe__take_row(b->snapshot, FE__TABLE_SHAPES, row, shape);
    fe__take_row(b->snapshot, FE__TABLE_FORMS, row, &numbers);
    shape->form = fe__form_of_numbers(&numbers);
    if (fe__form_has_asset(&shape->form)) shape->form.field = NO_ASSET;
    if (!check_shape(b, shape, slot)) return 0;
    shape->body_serial = b->world->bodies[shape->body].serial;
    b->world->wants_hits |= (shape->events & FE_SHAPE_EVENTS_HIT) != 0;
    return 1;
}

static int32_t reserve_shapes(fe__build *b, int32_t slots)
{
    fe_world *w = b->world;
    fe__memory *memory = fe__memory_of(b);
    return (FE_OPEN(memory, w->shapes, w->shape_capacity, slots) &&
            FE_RESERVE(memory, w->moved, w->moved_capacity, w->shape_capacity)) ||
           fe__lack_memory(b);
}

// A part comes right behind the part before it, the first one behind its whole
static int32_t list_shape(fe__build *b, int32_t slot)
{
    fe_world *w = b->world;
    const fe__shape *shape = w->shapes + slot;
    fe__shape_list(w, slot, -1);
    if (shape->flags & FE__SHAPE_MOVED) w->moved[w->moved_count++] = slot;
    if (shape->parent < 0) return 1;
    w->part_count += 1;
    const fe__shape *whole = w->shapes + shape->parent;
    if (!fe__id_pool_is_alive(&w->shape_ids, shape->parent) || !fe__form_is_of_parts(&whole->form) ||
        whole->body != shape->body || fe__serial_of_whole(shape->serial) != whole->serial)
        return fe__snapshot_refuse(b->snapshot, "shape in slot %d: it is no part of %d", (int)slot, (int)shape->parent);
    return 1;
}

static uint64_t serial_of_shape(const fe_world *w, int32_t slot) { return w->shapes[slot].serial; }

int32_t fe__build_shapes(fe__build *b)
{
    fe_world *w = b->world;
    int32_t slots = w->shape_ids.slot_count, rows = fe__rows_of(b->snapshot, FE__TABLE_SHAPES), used = 0;
    for (int32_t slot = 0; slot < slots; ++slot) used += is_slot_used(&w->shape_ids, slot);
    if (rows != used || rows != fe__rows_of(b->snapshot, FE__TABLE_FORMS))
        return fe__snapshot_refuse(b->snapshot, "shapes: %d rows, %d slots in use", (int)rows, (int)used);
    if (!reserve_shapes(b, slots)) return 0;
    for (int32_t slot = 0, row = 0; slot < slots; ++slot) {
        memset(w->shapes + slot, 0, sizeof *w->shapes);
        if (is_slot_used(&w->shape_ids, slot) && !take_shape(b, slot, row++)) return 0;
    }
    return fe__build_order(b, &(fe__ordered){"shapes", &w->shape_ids, 1, serial_of_shape, list_shape}, rows);
}

// ---- assets --------------------------------------------------------------------------------------------------------
static int32_t find_asset(const fe__build *b, fe__asset_key key, fe_asset handle)
{
    for (int32_t i = 0; i < b->asset_count; ++i)
        if (fe__keys_are_same(b->keys[i], key)) return b->assets[i];
    return fe__store_find_key(b->world->store, key, handle);
}

// The record of a row: the asset, or what is made of it under a scale
static int32_t resolve(fe__build *b, const fe__asset_row *row, int32_t *out_index)
{
    fe_store *store = b->world->store;
    fe__asset_key key = {{row->key[0], row->key[1]}};
    int32_t index = find_asset(b, key, row->handle);
    if (index < 0) {
        b->missing = key;
        return fe__snapshot_fail(b->snapshot, FE_ERROR_STATE);
    }
    if (fe__store_asset(store, index)->kind != row->kind)
        return fe__snapshot_refuse(b->snapshot, "assets: that of shape %d is of another kind", (int)row->shape);
    *out_index = index;
    if (row->scale.x == 1.0f && row->scale.y == 1.0f && row->scale.z == 1.0f) return 1;
    const float s[3] = {fe__absf(row->scale.x), fe__absf(row->scale.y), fe__absf(row->scale.z)};
    int32_t has_scale = row->kind == FE__ASSET_HULL || row->kind == FE__ASSET_MESH;
    for (int k = 0; k < 3; ++k) has_scale &= s[k] >= FE_LEAST_VALUE && s[k] <= FE_MAX_VALUE;
    fe__scale_refusal refusal;
    fe_result made = has_scale ? fe__asset_scaled(store, index, row->scale, out_index, &refusal) : FE_ERROR_DEGENERATE;
    if (made == FE_OK) return 1;
    if (made != FE_ERROR_DEGENERATE) return fe__snapshot_fail(b->snapshot, made);
    return fe__snapshot_refuse(b->snapshot, "assets: that of shape %d cannot have its scale", (int)row->shape);
}

// The use is the world's from here on: whoever frees the world lets go of it. Two assets of one content may have become
// one: then its users come behind those that it has
static void add_use(fe__build *b, int32_t index, int32_t first_user)
{
    fe_world *w = b->world;
    fe__asset_use *known = fe__find_asset_use(w, index);
    if (known) {
        int32_t last = known->first_user;
        while (w->shapes[last].next_user >= 0) last = w->shapes[last].next_user;
        w->shapes[last].next_user = first_user;
        return;
    }
    int32_t place = w->use_count++;
    for (; place > 0 && w->uses[place - 1].asset > index; --place) w->uses[place] = w->uses[place - 1];
    w->uses[place] = (fe__asset_use){index, first_user};
    fe__asset_retain(w->store, index);
}

// A part has the record that its compound has, which may be another one of the same content
static int32_t record_of(const fe_world *w, int32_t slot, int32_t index)
{
    const fe__shape *part = w->shapes + slot;
    int32_t number = fe__part_of_serial(part->serial);
    if (part->parent < 0 || w->shapes[part->parent].form.field == NO_ASSET) return index;
    const fe__compound *compound = &fe__store_asset(w->store, w->shapes[part->parent].form.field)->compound;
    int32_t has_asset = number < compound->count && fe__form_has_asset(&compound->parts[number].form);
    return has_asset ? compound->parts[number].form.field : index;
}

// Every shape that has it gets its form, once. `users` counts those; out_apart: those that have another record
static int32_t give_form(fe__build *b, int32_t index, int32_t first_user, int32_t *users, int32_t *out_apart)
{
    fe_world *w = b->world;
    *out_apart = 0;
    for (int32_t slot = first_user; slot >= 0; slot = w->shapes[slot].next_user) {
        int32_t is_there = slot < w->shape_ids.slot_count && is_slot_used(&w->shape_ids, slot) &&
                           w->shapes[slot].form.field == NO_ASSET && --*users >= 0;
        int32_t record = is_there ? record_of(w, slot, index) : index;
        const fe__form form = fe__asset_form(w->store, record);
        if (!is_there || !fe__forms_are_alike(&w->shapes[slot].form, &form))
            return fe__snapshot_refuse(b->snapshot, "assets: shape %d does not have that of %d", (int)slot,
                                       (int)first_user);
        w->shapes[slot].form = form;
        *out_apart += record != index;
    }
    return 1;
}

// Adds each of the row's shapes to the users of its own record.
static int32_t add_uses_apart(fe__build *b, int32_t first_user, int32_t rows)
{
    fe_world *w = b->world;
    for (int32_t slot = first_user, next; slot >= 0; slot = next) {
        next = w->shapes[slot].next_user;
        w->shapes[slot].next_user = -1;
        if (!FE_RESERVE(fe__memory_of(b), w->uses, w->use_capacity, w->use_count + rows)) return fe__lack_memory(b);
        fe__asset_use *known = fe__find_asset_use(w, w->shapes[slot].form.field);
        if (known)
            w->shapes[slot].next_user = known->first_user, known->first_user = slot;
        else
            add_use(b, w->shapes[slot].form.field, slot);
    }
    return 1;
}

static int32_t build_asset(fe__build *b, const fe__asset_row *row, int32_t rows, int32_t *users)
{
    fe_world *w = b->world;
    int32_t index, apart;
    if (!resolve(b, row, &index)) return 0;
    fe__asset_retain(w->store, index); // what was just made for it goes again, if it has no use
    int32_t is_given = give_form(b, index, row->shape, users, &apart);
    if (is_given && apart) is_given = add_uses_apart(b, row->shape, rows);
    if (is_given && !apart) add_use(b, index, row->shape);
    fe__asset_release(w->store, index);
    return is_given;
}

int32_t fe__build_assets(fe__build *b)
{
    fe_world *w = b->world;
    int32_t rows = fe__rows_of(b->snapshot, FE__TABLE_ASSETS), users = 0;
    for (int32_t slot = 0; slot < w->shape_ids.slot_count; ++slot)
        users += is_slot_used(&w->shape_ids, slot) && fe__form_has_asset(&w->shapes[slot].form);
    if (!FE_RESERVE(fe__memory_of(b), w->uses, w->use_capacity, rows)) return fe__lack_memory(b);
    // compounds first: they tell what their parts have
    for (int32_t i = 0; i < 2 * rows; ++i) {
        fe__asset_row row;
        fe__take_row(b->snapshot, FE__TABLE_ASSETS, i % rows, &row);
        if ((row.kind == FE__ASSET_COMPOUND) == (i < rows) && !build_asset(b, &row, rows + 1, &users)) return 0;
    }
    return users == 0 || fe__snapshot_refuse(b->snapshot, "assets: %d shapes have none", (int)users);
}

// ---- parts ---------------------------------------------------------------------------------------------------------
static int32_t check_compound(fe__build *b, int32_t whole)
{
    const fe_world *w = b->world;
    const fe__compound *compound = &fe__store_asset(w->store, w->shapes[whole].form.field)->compound;
    int32_t count = 0;
    for (int32_t i = whole; (i = fe__next_of_whole(w, whole, i)) >= 0; ++count) {
        const fe__shape *part = w->shapes + i;
        if (count < compound->count && fe__part_of_serial(part->serial) == count &&
            fe__forms_are_same(&part->form, &compound->parts[count].form))
            continue;
        return fe__snapshot_refuse(b->snapshot, "shape in slot %d: it is no part of its compound", (int)i);
    }
    return count == compound->count || fe__snapshot_refuse(b->snapshot, "shape in slot %d: it lacks parts", (int)whole);
}

int32_t fe__build_parts(fe__build *b)
{
    fe_world *w = b->world;
    for (int32_t slot = 0; slot < w->shape_ids.slot_count; ++slot) {
        if (!is_slot_used(&w->shape_ids, slot)) continue;
        const fe__form *form = &w->shapes[slot].form;
        if (fe__form_has_asset(form) && !w->use_count)
            return fe__snapshot_refuse(b->snapshot, "shape in slot %d: its asset is nowhere", (int)slot);
        if (fe__form_is_of_parts(form) && !check_compound(b, slot)) return 0;
        fe__shape_place(w, slot);
    }
    return 1;
}

// ---- build joints ---------------------------------------------------------------------------------------------------
// Joints out of a snapshot: what they are made of follows from their settings, as when they were
// created; impulses, wound twists, reactions and colours are read.

// The table of a type's settings
static fe__table_number settings_table(int32_t type)
{
    return (fe__table_number)(FE__TABLE_DISTANCE_JOINTS + type - 1);
}
_Static_assert(FE_JOINT_DISTANCE == 1 && FE_JOINT_BALL == 2 && FE_JOINT_HINGE == 3 && FE_JOINT_FIXED == 4 &&
                   FE_JOINT_CONFIGURABLE == 5,
               "tables of settings are in the order of the types");

static int32_t reserve_joints(fe__build *b, int32_t slots)
{
    fe_world *w = b->world;
    fe__memory *memory = fe__memory_of(b);
    int32_t limit = 1 + slots, done = FE_RESERVE(memory, w->joints.joints, w->joint_capacity[0], limit) &&
                                      FE_RESERVE(memory, w->joints.frames, w->joint_capacity[1], limit) &&
                                      FE_RESERVE(memory, w->joints.reactions, w->joint_capacity[2], limit) &&
                                      FE_RESERVE(memory, w->joint_records, w->joint_capacity[3], limit) &&
                                      FE_RESERVE(memory, w->awake_joints, w->awake_joint_capacity, limit);
    if (!done) return fe__lack_memory(b);
    fe_result result = fe__record_pool_reserve(&w->joint_axes, memory, fe__rows_of(b->snapshot, FE__TABLE_JOINT_AXES));
    w->joints.axes = (fe__joint_axes *)(void *)w->joint_axes.records;
    for (int32_t type = 1; type < FE__JOINT_TYPES && result == FE_OK; ++type)
        result =
            fe__record_pool_reserve(w->joint_settings + type, memory, fe__rows_of(b->snapshot, settings_table(type)));
    return result == FE_OK || fe__snapshot_fail(b->snapshot, result);
}

static int32_t check_ends(fe__build *b, const fe__joint_record *r, int32_t joint)
{
    fe_world *w = b->world;
    int32_t hidden = 0;
    for (int k = 0; k < 2; ++k) {
        int32_t body = r->body[k];
        int32_t state = body < w->body_ids.slot_count ? w->body_ids.slots[body].next : FE_ID_NONE;
        if (state == FE_ID_HIDDEN && !hidden++ && !fe__is_anchor(w, body))
            fe__anchor_open(w, body, r->world_origin);
        else if (state != FE_ID_ALIVE)
            return fe__snapshot_refuse(b->snapshot, "joint %d: there is no body %d", (int)joint, (int)body);
    }
    return r->body[0] != r->body[1] || fe__snapshot_refuse(b->snapshot, "joint %d: both ends are one", (int)joint);
}

// ---- one joint -----------------------------------------------------------------------------------------------------
typedef struct rows_taken {
    int32_t settings[FE__JOINT_TYPES];
    int32_t axes;
} rows_taken;

static int32_t take_settings(fe__build *b, fe__joint_record *r, int32_t joint, rows_taken *taken)
{
    fe__record_pool *pool = b->world->joint_settings + r->type;
    int32_t row = taken->settings[r->type]++;
    if (row >= fe__rows_of(b->snapshot, settings_table(r->type)))
        return fe__snapshot_refuse(b->snapshot, "joint %d: its settings are not there", (int)joint);
    uint32_t words[FE__SETTINGS_WORDS];
    fe__take_row(b->snapshot, settings_table(r->type), row, words);
    r->settings = fe__record_pool_take(pool);
    memcpy(fe__record(pool, r->settings), words, (size_t)pool->size);
    return 1;
}

static int32_t take_state(fe__build *b, int32_t joint, int32_t row, rows_taken *taken)
{
    fe_world *w = b->world;
    fe__joint_frame *frame = w->joints.frames + joint;
    fe__take_row(b->snapshot, FE__TABLE_JOINT_ANCHORS, row, w->joints.joints + joint);
    fe__take_row(b->snapshot, FE__TABLE_JOINT_FRAMES, row, frame);
    fe__take_row(b->snapshot, FE__TABLE_JOINT_REACTIONS, row, w->joints.reactions + joint);
    if (frame->axes) fe__take_row(b->snapshot, FE__TABLE_JOINT_AXES, taken->axes++, w->joints.axes + frame->axes);
    if (frame->serial == 0 || frame->serial >= w->next_serial)
        return fe__snapshot_refuse(b->snapshot, "joint %d: its serial is %llu", (int)joint,
                                   (unsigned long long)frame->serial);
    return 1;
}

static int32_t take_joint(fe__build *b, int32_t joint, int32_t row, rows_taken *taken)
{
    fe_world *w = b->world;
    fe__joint_record *r = w->joint_records + joint;
    fe__take_row(b->snapshot, FE__TABLE_JOINTS, row, r);
    r->awake_index = -1;
    if (r->flags & ~(uint32_t)(FE__JOINT_ENABLED | FE__JOINT_COLLIDES))
        return fe__snapshot_refuse(b->snapshot, "joint %d: its flags are 0x%x", (int)joint, (unsigned)r->flags);
    if (!check_ends(b, r, joint) || !take_settings(b, r, joint, taken)) return 0;
    w->joints.joints[joint].body_a = r->body[0], w->joints.joints[joint].body_b = r->body[1];
    w->joints.joints[joint].colour = -1;
    fe__joint_any def;
    fe__joint_plan plan;
    memset(&def, 0, sizeof def);
    fe__joint_describe(w, joint, &def);
    fe__joint_make_plan(r->type, &def, &plan);
    if (fe__joint_needs_axes(&plan) && taken->axes >= fe__rows_of(b->snapshot, FE__TABLE_JOINT_AXES))
        return fe__snapshot_refuse(b->snapshot, "joint %d: its axes are not there", (int)joint);
    fe__joint_fill(w, joint, &plan);
    w->breakable_count += r->break_force > 0.0f || r->break_torque > 0.0f;
    return take_state(b, joint, row, taken);
}

// ---- lists ---------------------------------------------------------------------------------------------------------
// Joint i has slot i - 1
static int32_t list_joint(fe__build *b, int32_t slot)
{
    fe_world *w = b->world;
    int32_t joint = slot + 1;
    const fe__joint_record *r = w->joint_records + joint;
    fe__joint_add_to_body(w, joint, r->body[0]);
    fe__joint_add_to_body(w, joint, r->body[1]);
    fe__joint_append_to_order(w, joint);
    int32_t linked = w->joints.joints[joint].colour >= 0;
    if (linked == fe__joint_acts(w, joint) && (!linked || fe__joint_relink(&w->joints, w->bodies, joint))) return 1;
    return fe__snapshot_refuse(b->snapshot, "joint %d: colour %d and rows 0x%x are not what it may have", (int)joint,
                               (int)w->joints.joints[joint].colour, (unsigned)w->joints.joints[joint].rows);
}

static uint64_t serial_of_joint(const fe_world *w, int32_t slot) { return w->joints.frames[slot + 1].serial; }

// ---- all -----------------------------------------------------------------------------------------------------------
static int32_t check_rows(fe__build *b, int32_t rows)
{
    fe__snapshot *s = b->snapshot;
    if (rows == b->world->joint_ids.alive_count && rows == fe__rows_of(s, FE__TABLE_JOINT_ANCHORS) &&
        rows == fe__rows_of(s, FE__TABLE_JOINT_FRAMES) && rows == fe__rows_of(s, FE__TABLE_JOINT_REACTIONS))
        return 1;
    return fe__snapshot_refuse(s, "joints: %d rows, %d slots in use", (int)rows, (int)b->world->joint_ids.alive_count);
}

static int32_t check_all_taken(fe__build *b, const rows_taken *taken)
{
    int32_t all = taken->axes == fe__rows_of(b->snapshot, FE__TABLE_JOINT_AXES);
    for (int32_t type = 1; type < FE__JOINT_TYPES; ++type)
        all &= taken->settings[type] == fe__rows_of(b->snapshot, settings_table(type));
    if (!all) return fe__snapshot_refuse(b->snapshot, "joints: there are settings or axes of none");
    for (int32_t slot = 0; slot < b->world->body_ids.slot_count; ++slot)
        if (b->world->body_ids.slots[slot].next == FE_ID_HIDDEN && !fe__is_anchor(b->world, slot))
            return fe__snapshot_refuse(b->snapshot, "body slots: %d is hidden, but no joint's", (int)slot);
    return 1;
}

int32_t fe__build_joints(fe__build *b)
{
    fe_world *w = b->world;
    int32_t slots = w->joint_ids.slot_count, rows = fe__rows_of(b->snapshot, FE__TABLE_JOINTS);
    rows_taken taken = {{0}, 0};
    if (!check_rows(b, rows) || !reserve_joints(b, slots)) return 0;
    for (int32_t slot = 0, next = 0; slot < slots; ++slot)
        if (w->joint_ids.slots[slot].next == FE_ID_ALIVE && !take_joint(b, slot + 1, next++, &taken)) return 0;
    return check_all_taken(b, &taken) &&
           fe__build_order(b, &(fe__ordered){"joints", &w->joint_ids, 0, serial_of_joint, list_joint}, rows);
}

// ---- build trees ----------------------------------------------------------------------------------------------------
// The trees of boxes, and the list of planes, out of a snapshot. Their nodes are read, as their form
// decides when they are built anew, and with it how boxes are rounded.

// A walk goes down a tree that deep without harm to the stack. Trees deeper than 30 are built anew every eighth step
enum { DEEPEST = 1024 };

typedef struct taker {
    fe__build *build;
    const fe__tree *tree;
} taker;

static int32_t takes_proxy(void *context, int32_t proxy)
{
    const taker *t = context;
    const fe_world *w = t->build->world;
    if (proxy < 0 || proxy >= w->shape_ids.slot_count) return 0;
    const fe__shape *shape = w->shapes + proxy;
    if (!(shape->flags & FE__SHAPE_IN_TREE)) return 0; // of a slot without a shape they are 0
    return (w->bodies[shape->body].type == FE_BODY_STATIC) == (t->tree == &w->static_tree);
}

static int32_t check_counts(fe__build *b, const fe__tree *tree, fe__table_number table)
{
    int32_t rows = fe__rows_of(b->snapshot, table);
    if (tree->node_count == rows && tree->node_capacity >= rows && tree->node_capacity <= fe__most_nodes(tree) &&
        tree->promised <= fe__most_promised(tree) && (int64_t)rows + tree->promised <= tree->node_capacity &&
        tree->dead <= rows && (tree->proxy_count > 0) == (rows > 0) && tree->depth <= DEEPEST)
        return 1;
    return fe__snapshot_refuse(b->snapshot, "%s: %d nodes of %d, %d promised, %d deep", fe__tables[table].name,
                               (int)rows, (int)tree->node_capacity, (int)tree->promised, (int)tree->depth);
}

static int32_t build_tree(fe__build *b, fe__tree *tree, int32_t number, fe__table_number table)
{
    const fe_world *w = b->world;
    fe__memory *memory = fe__memory_of(b);
    const fe__tree_kernels *kernels = tree->kernels;
    fe__tree told = {.kernels = kernels};
    fe__take_row(b->snapshot, FE__TABLE_TREES, number, &told);
    if (!check_counts(b, &told, table)) return 0;
    if (!FE_RESERVE(memory, tree->slot, tree->slot_capacity, w->shape_capacity)) return fe__lack_memory(b);
    for (int32_t i = 0; i < tree->slot_capacity; ++i) tree->slot[i] = -1;
    // as large as it was: reserving would round it up
    if (told.node_capacity) tree->nodes = fe__allocate(memory, (size_t)told.node_capacity * sizeof *tree->nodes);
    if (told.node_capacity && !tree->nodes) return fe__lack_memory(b);
    told.nodes = tree->nodes, told.slot = tree->slot, told.slot_capacity = tree->slot_capacity;
    *tree = told;
    for (int32_t i = 0; i < tree->node_count; ++i) fe__take_row(b->snapshot, table, i, tree->nodes + i);
    int32_t node;
    if (fe__tree_check(tree, takes_proxy, &(taker){b, tree}, &node)) return 1;
    return fe__snapshot_refuse(b->snapshot, "%s: node %d does not hang together", fe__tables[table].name, (int)node);
}

// ---- planes --------------------------------------------------------------------------------------------------------
static int32_t build_planes(fe__build *b)
{
    fe_world *w = b->world;
    int32_t rows = fe__rows_of(b->snapshot, FE__TABLE_PLANES), seen = 0;
    if (!FE_RESERVE(fe__memory_of(b), w->planes, w->plane_capacity, rows)) return fe__lack_memory(b);
    for (; w->plane_count < rows; ++w->plane_count) {
        int32_t slot = fe__listed_slot(b->snapshot, FE__TABLE_PLANES, w->plane_count);
        if (slot >= w->shape_ids.slot_count || !(w->shapes[slot].flags & FE__SHAPE_IN_PLANES))
            return fe__snapshot_refuse(b->snapshot, "planes: shape %d is none", (int)slot);
        for (int32_t i = 0; i < w->plane_count; ++i)
            if (w->planes[i] == slot) return fe__snapshot_refuse(b->snapshot, "planes: %d is there twice", (int)slot);
        w->planes[w->plane_count] = slot;
    }
    for (int32_t slot = 0; slot < w->shape_ids.slot_count; ++slot)
        seen += (w->shapes[slot].flags & FE__SHAPE_IN_PLANES) != 0;
    return seen == rows ||
           fe__snapshot_refuse(b->snapshot, "planes: %d are listed, %d are there", (int)rows, (int)seen);
}

static int32_t check_all_in_trees(fe__build *b)
{
    const fe_world *w = b->world;
    int32_t in_trees = 0;
    for (int32_t slot = 0; slot < w->shape_ids.slot_count; ++slot)
        in_trees += (w->shapes[slot].flags & FE__SHAPE_IN_TREE) != 0;
    return in_trees == w->static_tree.proxy_count + w->moving_tree.proxy_count ||
           fe__snapshot_refuse(b->snapshot, "trees: %d shapes are to be in them", (int)in_trees);
}

int32_t fe__build_trees(fe__build *b)
{
    fe_world *w = b->world;
    if (fe__rows_of(b->snapshot, FE__TABLE_TREES) != FE_TREES)
        return fe__snapshot_refuse(b->snapshot, "trees: there are not two");
    return build_tree(b, &w->static_tree, 0, FE__TABLE_STATIC_NODES) &&
           build_tree(b, &w->moving_tree, 1, FE__TABLE_MOVING_NODES) && check_all_in_trees(b) && build_planes(b);
}
