// build_bodies.c - bodies and shapes out of a snapshot, and the assets that shapes have.
#include "state/build.h"

#include "collision/form/sound.h"
#include "core/array_sort.h"
#include "core/ranges.h"
#include "store/scaled_asset.h"
#include "world/asset_users.h"
#include "world/parts.h"
#include "world/pose.h"
#include "world/speed.h"

#include <float.h>
#include <string.h>

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
