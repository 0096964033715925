// rows.c - see rows.h: the world, its slots, and what has a slot: bodies, shapes, joints.
#include "state/rows.h"

#include "collision/form/sound.h"
#include "store/asset_key.h"
#include "world/asset_users.h"

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
