// asset_users.c - see asset_users.h.
//
// Called by the API layer with checked arguments, between steps. A thread that edits an asset reads the tables of uses
// of other worlds: they are written under the store's lock only.
#include "world/asset_users.h"

#include "world/contact.h"
#include "world/proxies.h"
#include "world/shape.h"
#include "world/sleep.h"

#include <string.h>

// ---- store ----------------------------------------------------------------------------------------------------------

// Editors of assets read the worlds in the store's list: all that they read is set before the world joins.
fe_result fe__world_open_store(fe_world *world, const fe_world_def *def, const fe_world *source)
{
    world->member.world = world;
    if (source) {
        world->store = source->store;
        fe__store_join_beside(source->store, &world->member);
        return FE_OK;
    }
    if (def->store) {
        world->store = def->store;
        fe_result result = fe__store_join(def->store, &world->member);
        if (result != FE_OK) world->store = NULL;
        return result;
    }
    fe_result result = fe__store_create_own(def->allocator, world->number, &world->member, &world->store);
    if (result != FE_OK) return result;
    world->memory.guard = world->store->memory.guard;
    return FE_OK;
}

void fe__world_release_assets(fe_world *world)
{
    for (int32_t i = 0; i < world->use_count; ++i) fe__asset_release(world->store, world->uses[i].asset);
    world->use_count = 0;
    FE_FREE(&world->memory, world->uses, world->use_capacity);
}

void fe__world_close_store(fe_world *world)
{
    if (!world->store) return;
    fe__store_lock(world->store);
    fe__world_release_assets(world);
    fe__store_unlock(world->store);
    world->memory.guard = NULL;
    fe__store_leave(world->store, &world->member);
    world->store = NULL;
}

// ---- uses -----------------------------------------------------------------------------------------------------------

// Place of the asset's use in the table, or where it belongs.
static int32_t place_of(const fe_world *world, int32_t asset)
{
    int32_t low = 0, high = world->use_count;
    while (low < high) {
        int32_t middle = (low + high) / 2;
        if (world->uses[middle].asset < asset)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

fe__asset_use *fe__find_asset_use(const fe_world *world, int32_t asset)
{
    int32_t place = place_of(world, asset);
    return place < world->use_count && world->uses[place].asset == asset ? world->uses + place : NULL;
}

int32_t fe__uses_asset(const fe_world *world, int32_t asset)
{
    const fe_store *store = world->store;
    if (!fe__store_asset(store, asset)->scaled) return fe__find_asset_use(world, asset) != NULL;
    for (int32_t i = 0; i < world->use_count; ++i)
        if (fe__store_parent(store, world->uses[i].asset)->index == asset) return 1;
    return 0;
}

int32_t fe__reserve_asset_use(fe_world *world, const fe__form *form)
{
    int32_t assets = fe__form_has_asset(form);
    if (fe__form_is_of_parts(form)) {
        const fe__compound *compound = &fe__store_asset(world->store, form->field)->compound;
        for (int32_t i = 0; i < compound->count; ++i) assets += fe__form_has_asset(&compound->parts[i].form);
    }
    if (!assets) return 1;
    fe__store_lock(world->store);
    int32_t reserved = FE_RESERVE(&world->memory, world->uses, world->use_capacity, world->use_count + assets);
    fe__store_unlock(world->store);
    return reserved;
}

// The form is read anew: between the check of its handle and now another thread may have edited the heights.
void fe__shape_take_asset(fe_world *world, int32_t index)
{
    fe__shape *shape = world->shapes + index;
    shape->next_user = -1;
    if (!fe__form_has_asset(&shape->form)) return;
    int32_t asset = shape->form.field;
    fe__store_lock(world->store);
    fe__asset_use *use = fe__find_asset_use(world, asset);
    if (!use) { // the first user of the asset
        use = world->uses + place_of(world, asset);
        memmove(use + 1, use, (size_t)(world->uses + world->use_count - use) * sizeof *use);
        world->use_count += 1;
        *use = (fe__asset_use){asset, -1};
        fe__asset_retain(world->store, asset);
    }
    shape->next_user = use->first_user;
    use->first_user = index;
    shape->form = fe__asset_form(world->store, asset);
    fe__store_unlock(world->store);
}

void fe__shape_release_asset(fe_world *world, int32_t index)
{
    const fe__shape *shape = world->shapes + index;
    if (!fe__form_has_asset(&shape->form)) return;
    fe__store_lock(world->store);
    fe__asset_use *use = fe__find_asset_use(world, shape->form.field);
    int32_t *at = &use->first_user;
    while (*at != index) at = &world->shapes[*at].next_user;
    *at = shape->next_user;
    if (use->first_user < 0) { // the last user of the asset
        int32_t asset = use->asset;
        world->use_count -= 1;
        memmove(use, use + 1, (size_t)(world->uses + world->use_count - use) * sizeof *use);
        fe__asset_release(world->store, asset);
    }
    fe__store_unlock(world->store);
}

// ---- entering worlds ------------------------------------------------------------------------------------------------

// Enters a world as a writer, with no reader inside: queries read the samples.
static fe_result enter(fe_world *world)
{
    fe__owner *owner = &world->owner;
    if (!fe__owner_enter(owner)) {
        uint32_t occupation = atomic_load_explicit(&owner->occupation, memory_order_acquire);
        return occupation == FE__STEP ? FE_ERROR_STEPPING : FE_ERROR_BUSY;
    }
    if (fe__owner_be_alone(owner, FE__WRITER)) return FE_OK;
    fe__owner_leave(owner);
    return FE_ERROR_BUSY;
}

static int32_t uses_any(const fe_world *world, const fe__assets_entered *e)
{
    int32_t used = 0;
    for (int32_t i = 0; i < e->count && !used && world != e->but; ++i) used = fe__uses_asset(world, e->assets[i]);
    return used;
}

static void leave_until(fe_store *store, const fe__assets_entered *e, const fe__store_member *end)
{
    for (fe__store_member *m = store->first_member; m != end; m = m->next)
        if (uses_any(m->world, e)) fe__owner_leave(&m->world->owner);
}

fe_result fe__assets_enter_worlds(fe_store *store, const fe__assets_entered *e)
{
    for (fe__store_member *m = store->first_member; m; m = m->next) {
        fe_result entered = uses_any(m->world, e) ? enter(m->world) : FE_OK;
        if (entered == FE_OK) continue;
        leave_until(store, e, m);
        return entered;
    }
    return FE_OK;
}

void fe__assets_leave_worlds(fe_store *store, const fe__assets_entered *e) { leave_until(store, e, NULL); }

// ---- new heights ----------------------------------------------------------------------------------------------------

// 1: the other shape is over that part of the field, or near it.
static int32_t is_over(const fe_world *world, const fe__shape *field, int32_t other, const fe__bounds *part)
{
    const fe__shape *shape = world->shapes + other;
    fe__pose local = {fe__drotate_back(field->pose.rotation, fe__dsub(shape->pose.position, field->pose.position)),
                      fe__product(fe__conjugate(field->pose.rotation), shape->pose.rotation)};
    fe__bounds b = fe__form_bounds(&shape->form, &local);
    double margin = (double)world->tuning.speculative_distance;
    return b.low.x - margin <= part->high.x && b.high.x + margin >= part->low.x && b.low.z - margin <= part->high.z &&
           b.high.z + margin >= part->low.z;
}

// Shapes that touch that part of the shape, or are near it, wake and are looked at anew. part: NULL: all of it
static void renew_pairs(fe_world *world, int32_t index, const fe__bounds *part)
{
    const fe__shape *field = world->shapes + index;
    for (int32_t pair = world->bodies[field->body].first_contact; pair >= 0;
         pair = fe__next_pair(world, pair, field->body)) {
        const fe__pair *p = world->pairs + pair;
        if (p->flags & FE__PAIR_PATCH || (p->shape_a != index && p->shape_b != index)) continue;
        int32_t other = p->shape_a == index ? p->shape_b : p->shape_a;
        if (part && !is_over(world, field, other, part)) continue;
        world->contacts[pair].surface.tolerance = 0.0f; // no motion is small enough to keep the manifold
        if (p->flags & FE__PAIR_LINKED) fe__wake(world, world->shapes[other].body);
        fe__pair_look_once(world, pair);
    }
}

static void renew_shapes(fe_world *world, int32_t asset, const fe__form *form, const fe__bounds *part)
{
    const fe__asset_use *use = fe__find_asset_use(world, asset);
    for (int32_t shape = use ? use->first_user : -1; shape >= 0; shape = world->shapes[shape].next_user) {
        world->shapes[shape].form = *form;
        renew_pairs(world, shape, part);
        fe__shape_touch(world, shape);
    }
}

void fe__heightfield_edit(fe_store *store, int32_t asset, const fe__samples *part, const float *heights)
{
    fe__heightfield *field = &fe__store_asset(store, asset)->field;
    fe__heightfield_write(field, part, heights);
    fe__store_asset(store, asset)->is_keyed = 0;
    fe__store_asset(store, asset)->edition = ++store->editions;
    fe__form form = fe__heightfield_form(field, asset);
    fe__bounds changed = fe__samples_bounds(field, part);
    for (fe__store_member *m = store->first_member; m; m = m->next) renew_shapes(m->world, asset, &form, &changed);
}

// ---- new materials --------------------------------------------------------------------------------------------------

// Bodies that touch the shape wake: they may have to slide, or to stop.
static void renew_materials(fe_world *world, int32_t index)
{
    const fe__shape *shape = world->shapes + index;
    for (int32_t pair = world->bodies[shape->body].first_contact; pair >= 0;
         pair = fe__next_pair(world, pair, shape->body)) {
        const fe__pair *p = world->pairs + pair;
        if (!(p->flags & FE__PAIR_LINKED) || (p->shape_a != index && p->shape_b != index)) continue;
        fe__wake(world, world->shapes[p->shape_a == index ? p->shape_b : p->shape_a].body);
    }
    fe__shape_material_changed(world, index);
}

void fe__mesh_edit_materials(fe_store *store, int32_t asset, const void *materials, uint32_t stride)
{
    fe__mesh_write_materials(fe__store_asset(store, asset), materials, stride);
    fe__store_asset(store, asset)->edition = ++store->editions;
    for (fe__store_member *m = store->first_member; m; m = m->next) {
        fe_world *world = m->world;
        for (int32_t i = 0; i < world->use_count; ++i) {
            const fe__asset_use *use = world->uses + i;
            if (fe__store_parent(world->store, use->asset)->index != asset) continue;
            for (int32_t shape = use->first_user; shape >= 0; shape = world->shapes[shape].next_user)
                renew_materials(world, shape);
        }
    }
}

void fe__asset_renew(fe_world *world, const fe__asset_use *use)
{
    fe__form form = fe__asset_form(world->store, use->asset);
    renew_shapes(world, use->asset, &form, NULL);
    for (int32_t shape = use->first_user; shape >= 0; shape = world->shapes[shape].next_user)
        renew_materials(world, shape);
}
