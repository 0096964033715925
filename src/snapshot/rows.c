// rows.c - see rows.h: the world, its slots, and what has a slot: bodies, shapes, joints.
#include "snapshot/rows.h"

#include "collision/form/form.h"
#include "store/asset_key.h"
#include "world/asset_users.h"
#include "world/contact.h"
#include "world/contact_creation.h"
#include "world/encounter.h"
#include "world/filter.h"
#include "world/joint.h"

#include <string.h>

// ---- rows -----------------------------------------------------------------------------------------------------------

// ---- lists that are arrays: rows in their order ---------------------------------------------------------------------
#define ARRAY_ROWS(rows, length)                                       \
    int32_t fe__count_##rows(const fe_world *world) { return length; } \
    static int32_t next_##rows(const fe_world *world, int32_t place) { return (void)world, place + 1; }
#define ARRAY_RECORDS(rows, record)                                                \
    static const void *rows##_at(const fe_world *world, int32_t place, void *room) \
    {                                                                              \
        (void)room;                                                                \
        return record;                                                             \
    }

// ---- the world ------------------------------------------------------------------------------------------------------
int32_t fe__count_world(const fe_world *world) { return (void)world, 1; }
static int32_t next_world(const fe_world *world, int32_t place) { return (void)world, place + 1; }
static const void *world_at(const fe_world *world, int32_t place, void *room)
{
    (void)place;
    *(fe__world_row *)room = (fe__world_row){.user_data = world->user_data,
                                             .next_serial = world->next_serial,
                                             .step_number = world->step_number,
                                             .gravity = world->gravity,
                                             .substeps = world->substeps,
                                             .last_h = world->last_h,
                                             .last_dt = world->last_dt,
                                             .row_kinds = world->row_kinds,
                                             .pair_limit = world->pair_limit,
                                             .pair_colours = world->pair_colours,
                                             .static_colours = world->static_colours,
                                             .has_extras = world->extra_capacity > 0,
                                             .has_filter = world->pair_filter != NULL,
                                             .joint_row_kinds = world->joints.row_kinds,
                                             .most_joints = world->joints.most,
                                             .ignore_limit = world->ignores.limit,
                                             .encounter_limit = world->encounters.limit,
                                             .free_slots = {world->body_ids.free_head, world->shape_ids.free_head,
                                                            world->joint_ids.free_head},
                                             .tuning = world->tuning};
    return room;
}

// ---- slots ----------------------------------------------------------------------------------------------------------
ARRAY_ROWS(body_slots, world->body_ids.slot_count)
ARRAY_RECORDS(body_slots, world->body_ids.slots + place)
ARRAY_ROWS(shape_slots, world->shape_ids.slot_count)
ARRAY_RECORDS(shape_slots, world->shape_ids.slots + place)
ARRAY_ROWS(joint_slots, world->joint_ids.slot_count)
ARRAY_RECORDS(joint_slots, world->joint_ids.slots + place)

// ---- bodies: anchors are their joints' ------------------------------------------------------------------------------
#define SLOT_ROWS(rows, length, pool, with_hidden)                     \
    int32_t fe__count_##rows(const fe_world *world) { return length; } \
    static int32_t next_##rows(const fe_world *world, int32_t place)   \
    {                                                                  \
        return fe__next_slot(&world->pool, place, with_hidden);        \
    }

SLOT_ROWS(bodies, world->body_count, body_ids, 0)
ARRAY_RECORDS(bodies, world->bodies + place)
SLOT_ROWS(drifts, world->body_count, body_ids, 0)
ARRAY_RECORDS(drifts, world->drifts + place)

// ---- shapes: with the parts of compounds ----------------------------------------------------------------------------
SLOT_ROWS(shapes, world->shape_count, shape_ids, 1)
ARRAY_RECORDS(shapes, world->shapes + place)
SLOT_ROWS(forms, world->shape_count, shape_ids, 1)
static const void *forms_at(const fe_world *world, int32_t place, void *room)
{
    *(fe__form_numbers *)room = fe__numbers_of_form(&world->shapes[place].form);
    return room;
}

static int32_t is_first_user(const fe_world *world, int32_t shape)
{
    const fe__form *form = &world->shapes[shape].form;
    return fe__form_has_asset(form) && fe__find_asset_use(world, form->field)->first_user == shape;
}

int32_t fe__count_assets(const fe_world *world) { return world->use_count; }
static int32_t next_assets(const fe_world *world, int32_t place)
{
    do place = fe__next_slot(&world->shape_ids, place, 1);
    while (place < world->shape_ids.slot_count && !is_first_user(world, place));
    return place;
}
static const void *assets_at(const fe_world *world, int32_t place, void *room)
{
    int32_t index = world->shapes[place].form.field;
    const fe__asset *parent = fe__store_parent(world->store, index);
    fe__asset_key key = fe__asset_key_of(world->store, parent->index);
    *(fe__asset_row *)room = (fe__asset_row){
        {key.words[0], key.words[1]}, fe__store_asset(world->store, index)->scale, place, parent->kind, parent->handle};
    return room;
}

int32_t fe__next_asset_user(const fe_world *world, int32_t shape) { return next_assets(world, shape); }

// ---- joints: joint i has slot i - 1 ---------------------------------------------------------------------------------
#define JOINT_ROWS(rows, record)                      \
    SLOT_ROWS(rows, world->joint_count, joint_ids, 0) \
    ARRAY_RECORDS(rows, record)

JOINT_ROWS(joints, world->joint_records + place + 1)
JOINT_ROWS(joint_anchors, world->joints.joints + place + 1)
JOINT_ROWS(joint_frames, world->joints.frames + place + 1)
JOINT_ROWS(joint_reactions, world->joints.reactions + place + 1)

static int32_t next_of_type(const fe_world *world, int32_t place, int32_t type)
{
    do place = fe__next_slot(&world->joint_ids, place, 0);
    while (place < world->joint_ids.slot_count && world->joint_records[place + 1].type != type);
    return place;
}

#define TYPE_ROWS(rows, number)                                                                                     \
    int32_t fe__count_##rows(const fe_world *world) { return fe__live_records(world->joint_settings + number); }    \
    static int32_t next_##rows(const fe_world *world, int32_t place) { return next_of_type(world, place, number); } \
    ARRAY_RECORDS(rows, fe__record(world->joint_settings + number, world->joint_records[place + 1].settings))

TYPE_ROWS(distance_joints, FE_JOINT_DISTANCE)
TYPE_ROWS(ball_joints, FE_JOINT_BALL)
TYPE_ROWS(hinge_joints, FE_JOINT_HINGE)
TYPE_ROWS(fixed_joints, FE_JOINT_FIXED)
TYPE_ROWS(configurable_joints, FE_JOINT_CONFIGURABLE)

int32_t fe__count_joint_axes(const fe_world *world) { return fe__live_records(&world->joint_axes); }
static int32_t next_joint_axes(const fe_world *world, int32_t place)
{
    do place = fe__next_slot(&world->joint_ids, place, 0);
    while (place < world->joint_ids.slot_count && !world->joints.frames[place + 1].axes);
    return place;
}
ARRAY_RECORDS(joint_axes, world->joints.axes + world->joints.frames[place + 1].axes)

// ---- who is awake, planes -------------------------------------------------------------------------------------------
ARRAY_ROWS(awake_bodies, world->awake_body_count)
ARRAY_RECORDS(awake_bodies, fe__slot_in(room, world->awake_bodies[place]))
ARRAY_ROWS(awake_joints, world->awake_joint_count)
ARRAY_RECORDS(awake_joints, fe__slot_in(room, world->awake_joints[place]))
ARRAY_ROWS(planes, world->plane_count)
ARRAY_RECORDS(planes, fe__slot_in(room, world->planes[place]))

// ---- events ---------------------------------------------------------------------------------------------------------
ARRAY_ROWS(pair_events, world->pair_event_count)
ARRAY_RECORDS(pair_events, world->pair_events + place)
ARRAY_ROWS(body_events, world->body_event_count)
ARRAY_RECORDS(body_events, world->body_events + place)
ARRAY_ROWS(hit_events, world->hit_event_count)
ARRAY_RECORDS(hit_events, world->hit_events + place)
ARRAY_ROWS(joint_events, world->joint_event_count)
ARRAY_RECORDS(joint_events, world->joint_events + place)

// ---- trees ----------------------------------------------------------------------------------------------------------
ARRAY_ROWS(static_nodes, world->static_tree.node_count)
ARRAY_RECORDS(static_nodes, world->static_tree.nodes + place)
ARRAY_ROWS(moving_nodes, world->moving_tree.node_count)
ARRAY_RECORDS(moving_nodes, world->moving_tree.nodes + place)

int32_t fe__count_trees(const fe_world *world) { return (void)world, FE_TREES; }
static int32_t next_trees(const fe_world *world, int32_t place) { return (void)world, place + 1; }
// Free nodes decide how the next proxy comes in. Beyond these the tree has room whatever comes
static const void *trees_at(const fe_world *world, int32_t place, void *room)
{
    fe__tree *tree = room;
    *tree = place ? world->moving_tree : world->static_tree;
    tree->promised = (int32_t)fe__minl(tree->promised, fe__most_promised(tree));
    tree->node_capacity = (int32_t)fe__minl(tree->node_capacity, fe__most_nodes(tree));
    return room;
}

// ---- blocks of rows
// ---------------------------------------------------------------------------------------------------
FE__GATHER(world)
FE__GATHER(body_slots)
FE__GATHER(shape_slots)
FE__GATHER(joint_slots)
FE__GATHER(bodies)
FE__GATHER(drifts)
FE__GATHER(shapes)
FE__GATHER(forms)
FE__GATHER(assets)
FE__GATHER(joints)
FE__GATHER(distance_joints)
FE__GATHER(ball_joints)
FE__GATHER(hinge_joints)
FE__GATHER(fixed_joints)
FE__GATHER(configurable_joints)
FE__GATHER(joint_anchors)
FE__GATHER(joint_frames)
FE__GATHER(joint_reactions)
FE__GATHER(joint_axes)
FE__GATHER(awake_bodies)
FE__GATHER(awake_joints)
FE__GATHER(planes)
FE__GATHER(pair_events)
FE__GATHER(body_events)
FE__GATHER(hit_events)
FE__GATHER(joint_events)
FE__GATHER(trees)
FE__GATHER(static_nodes)
FE__GATHER(moving_nodes)

// ---- pair rows ------------------------------------------------------------------------------------------------------
// See rows.h: pairs, their contacts and points, ignored bodies, encounters.

#define ROWS(rows, length, following)                                  \
    int32_t fe__count_##rows(const fe_world *world) { return length; } \
    static int32_t next_##rows(const fe_world *world, int32_t place) { return following; }
#define RECORDS(rows, record)                                                      \
    static const void *rows##_at(const fe_world *world, int32_t place, void *room) \
    {                                                                              \
        (void)world, (void)room;                                                   \
        return record;                                                             \
    }

// ---- pairs: contact 0 is no contact ---------------------------------------------------------------------------------
static int32_t live_pairs(const fe_world *w) { return w->pair_count + w->field_pair_count * (FE__PATCHES - 1); }

static int32_t next_pair(const fe_world *w, int32_t place)
{
    for (place = fe__maxi(place, 0) + 1; place < w->pair_limit && w->pairs[place].flags & FE__PAIR_FREE;) ++place;
    return place;
}

static int32_t next_with_points(const fe_world *w, int32_t place)
{
    do place = next_pair(w, place);
    while (place < w->pair_limit && !w->contacts[place].points);
    return place;
}

// A pair that has patches, or one of them
static int32_t next_patched(const fe_world *w, int32_t place)
{
    do place = next_pair(w, place);
    while (place < w->pair_limit && w->pairs[place].next_patch < 0 && w->pairs[place].head < 0);
    return place;
}

static int32_t next_awake(const fe_world *w, int32_t place)
{
    do place = next_pair(w, place);
    while (place < w->pair_limit && w->pairs[place].awake_index < 0);
    return place;
}

static int32_t points_in_use(const fe_world *w)
{
    return atomic_load_explicit(&w->point_count, memory_order_relaxed) - 1;
}

ROWS(pairs, live_pairs(world), next_pair(world, place))
RECORDS(pairs, world->pairs + place)
ROWS(found, live_pairs(world), next_pair(world, place))
RECORDS(found, world->contacts + place)

ROWS(patches, world->field_pair_count *FE__PATCHES, next_patched(world, place))
static const void *patches_at(const fe_world *world, int32_t place, void *room)
{
    const fe__pair *p = world->pairs + place;
    *(fe__patch_row *)room = (fe__patch_row){place, p->next_patch, p->head, p->triangle};
    return room;
}

ROWS(touching, points_in_use(world), next_with_points(world, place))
static const void *touching_at(const fe_world *world, int32_t place, void *room)
{
    const fe__contact *m = world->contacts + place;
    *(fe__touching_row *)room = (fe__touching_row){
        place, m->colour, m->point_count, {m->span[0], m->span[1], m->span[2]}, world->pairs[place].left_out};
    return room;
}
ROWS(points, points_in_use(world), next_with_points(world, place))
RECORDS(points, world->points + world->contacts[place].points)
ROWS(features, points_in_use(world), next_with_points(world, place))
RECORDS(features, world->features + world->contacts[place].points)
ROWS(extras, world->extra_capacity ? points_in_use(world) : 0, next_with_points(world, place))
RECORDS(extras, world->extras + world->contacts[place].points)
ROWS(awake_pairs, world->awake_pair_count, next_awake(world, place))
RECORDS(awake_pairs, fe__slot_in(room, place))

// ---- deferred pairs -------------------------------------------------------------------------------------------------
static int32_t is_deferred(const fe_world *w, int32_t pair) { return w->awake_pairs[w->pairs[pair].awake_index] < 0; }

// The one count that is not kept: the list is short against all that is written
int32_t fe__count_deferrals(const fe_world *world)
{
    int32_t count = 0;
    for (int32_t i = 0; i < world->awake_pair_count; ++i) count += world->awake_pairs[i] < 0;
    return count;
}

static int32_t next_deferrals(const fe_world *world, int32_t place)
{
    do place = next_awake(world, place);
    while (place < world->pair_limit && !is_deferred(world, place));
    return place;
}

static const void *deferrals_at(const fe_world *world, int32_t place, void *room)
{
    const fe__deferral *d = world->deferrals + world->pairs[place].awake_index;
    *(fe__deferral_row *)room = (fe__deferral_row){place,
                                                   d->gap,
                                                   d->most,
                                                   {d->apart[0], d->apart[1], d->apart[2]},
                                                   {world->odometers[d->body_a].turned - d->turned_a,
                                                    world->odometers[d->body_b].turned - d->turned_b}};
    return room;
}

// ---- slots without a pair -------------------------------------------------------------------------------------------
ROWS(free_pairs, world->pair_limit - 1 - live_pairs(world) - world->owed_count,
     place < 0 ? world->first_free_pair : world->pairs[place].links[0].next)
RECORDS(free_pairs, fe__slot_in(room, place))

ROWS(owed, world->owed_count, place < 0 ? world->first_owed : world->pairs[place].links[0].next)
static const void *owed_at(const fe_world *world, int32_t place, void *room)
{
    fe__owed_row *row = room;
    row->slot = place;
    memcpy(&row->exit, world->contacts + place, sizeof row->exit);
    return room;
}

// ---- record pools ---------------------------------------------------------------------------------------------------
static int32_t next_free(const fe__record_pool *pool, int32_t place)
{
    int32_t next;
    if (place < 0) return pool->first_free;
    memcpy(&next, fe__record(pool, place), sizeof next);
    return next;
}

// A record that is given back holds the next free one where the first body or shape stood: what is found by its own
// bodies or shapes is in use
static int32_t is_known(const fe__pair_set *set, int32_t a, int32_t b, int32_t index)
{
    return a != b && a >= 0 && b >= 0 && fe__pair_set_find(set, a, b) == index;
}

static int32_t next_ignore(const fe_world *w, int32_t place)
{
    for (place = fe__maxi(place, 0) + 1; place < w->ignores.limit; ++place) {
        const fe__ignore *i = fe__record(&w->ignores, place);
        if (is_known(&w->ignored, i->body[0], i->body[1], place)) break;
    }
    return place;
}

static int32_t next_encounter(const fe_world *w, int32_t place)
{
    for (place = fe__maxi(place, 0) + 1; place < w->encounters.limit; ++place) {
        const fe__encounter *e = fe__record(&w->encounters, place);
        if (is_known(&w->encounter_set, e->shape_a, e->shape_b, place)) break;
    }
    return place;
}

ROWS(free_ignores, world->ignores.free_count, next_free(&world->ignores, place))
RECORDS(free_ignores, fe__slot_in(room, place))
ROWS(ignores, fe__live_records(&world->ignores), next_ignore(world, place))
static const void *ignores_at(const fe_world *world, int32_t place, void *room)
{
    const fe__ignore *i = fe__record(&world->ignores, place);
    *(fe__ignore_row *)room = (fe__ignore_row){place, {i->body[0], i->body[1]}, {i->links[0].next, i->links[1].next}};
    return room;
}

ROWS(free_encounters, world->encounters.free_count, next_free(&world->encounters, place))
RECORDS(free_encounters, fe__slot_in(room, place))
ROWS(encounters, fe__live_records(&world->encounters), next_encounter(world, place))
static const void *encounters_at(const fe_world *world, int32_t place, void *room)
{
    const fe__encounter *e = fe__record(&world->encounters, place);
    *(fe__encounter_row *)room =
        (fe__encounter_row){place, e->shape_a, e->shape_b, e->lead, e->denied, e->entered, e->listed};
    return room;
}

// ---- blocks of rows
// ---------------------------------------------------------------------------------------------------
FE__GATHER(pairs)
FE__GATHER(found)
FE__GATHER(patches)
FE__GATHER(touching)
FE__GATHER(points)
FE__GATHER(features)
FE__GATHER(extras)
FE__GATHER(free_pairs)
FE__GATHER(owed)
FE__GATHER(awake_pairs)
FE__GATHER(deferrals)
FE__GATHER(ignores)
FE__GATHER(free_ignores)
FE__GATHER(encounters)
FE__GATHER(free_encounters)
