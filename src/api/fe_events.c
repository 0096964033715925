// fe_events.c - the API of what a step left behind: events and contacts.
#include "api/check.h"
#include "core/fp_state.h"
#include "world/encounter.h"
#include "world/world.h"
#include "world/contact.h"
#include "world/contact_creation.h"

#include <stddef.h>
#include <string.h>

// Records grow at their tail: an older client's stride may be shorter than a record, it gets the front.
enum { LEAST_RECORD = 8 };

static void put(void *out, uint32_t stride, int32_t i, const void *record, size_t size)
{
    memcpy(fe__at(out, stride, i), record, size < stride ? size : stride);
}

// ---- events --------------------------------------------------------------------------------------------------------

// Where the events of one kind lie: records with the event at an offset
typedef struct event_list {
    const void *records; // NULL: none yet
    size_t record_size, offset, event_size;
    int32_t count;
} event_list;
#define LIST_OF(kind)                                                                                        \
    (event_list)                                                                                             \
    {                                                                                                        \
        world->kind##_events, sizeof(fe__##kind##_event_record), offsetof(fe__##kind##_event_record, event), \
            sizeof(fe_##kind##_event), world->kind##_event_count                                             \
    }

static int32_t write_events(const char *function, event_list list, void *out_events, uint32_t stride, int32_t capacity)
{
    FE_CHECK_ARRAY(out_events, capacity);
    FE_CHECK_RECORD_STRIDE(stride, LEAST_RECORD, capacity);
    int32_t written = fe__mini(list.count, capacity);
    for (int32_t i = 0; i < written; ++i)
        put(out_events, stride, i, (const unsigned char *)list.records + list.record_size * (size_t)i + list.offset,
            list.event_size);
    return list.count;
}

static fe_pair_event describe_event(const fe__pair_event_record *r)
{
    return (fe_pair_event){.body_a = r->body_a,
                           .body_b = r->body_b,
                           .shape_a = r->shape_a,
                           .shape_b = r->shape_b,
                           .kind = r->kind,
                           .is_trigger = r->is_trigger,
                           .part_a = fe__part_of_serial(r->serial_a),
                           .part_b = fe__part_of_serial(r->serial_b),
                           .triangle_a = r->field_a ? r->triangle : -1,
                           .triangle_b = r->field_a ? -1 : r->triangle};
}

int32_t fe_world_get_pair_events(const fe_world *world, fe_pair_event *out_events, uint32_t stride, int32_t capacity)
{
    FE_READ(world);
    FE_CHECK_ARRAY(out_events, capacity);
    FE_CHECK_RECORD_STRIDE(stride, LEAST_RECORD, capacity);
    for (int32_t i = 0, written = fe__mini(world->pair_event_count, capacity); i < written; ++i) {
        fe_pair_event event = describe_event(world->pair_events + i);
        put(out_events, stride, i, &event, sizeof event);
    }
    return world->pair_event_count;
}

int32_t fe_world_get_body_events(const fe_world *world, fe_body_event *out_events, uint32_t stride, int32_t capacity)
{
    FE_READ(world);
    return write_events(function, LIST_OF(body), out_events, stride, capacity);
}

int32_t fe_world_get_hit_events(const fe_world *world, fe_hit_event *out_events, uint32_t stride, int32_t capacity)
{
    FE_READ(world);
    return write_events(function, LIST_OF(hit), out_events, stride, capacity);
}

int32_t fe_world_get_joint_events(const fe_world *world, fe_joint_event *out_events, uint32_t stride, int32_t capacity)
{
    FE_READ(world);
    return write_events(function, LIST_OF(joint), out_events, stride, capacity);
}

// ---- contacts ------------------------------------------------------------------------------------------------------

static int32_t point_count(const fe_world *world, int32_t pair)
{
    return world->pairs[pair].flags & FE__PAIR_SENSOR ? 0 : (int32_t)world->contacts[pair].point_count;
}

static fe_contact_point describe_point(const fe_world *world, int32_t pair, int32_t i)
{
    const fe__contact *c = &world->contacts[pair];
    const fe__points *q = fe__points_of(world, c);
    return (fe_contact_point){.point = fe__contact_point(world, pair, i),
                              .separation = q->separation[i],
                              .normal_impulse = q->normal_impulse[i],
                              .total_impulse = q->total_impulse[i],
                              .id = world->features[c->points].ids[i]};
}

// The solver may hold the pair with its sides exchanged: what is said of its B is then the negative of what B here
// feels. A twist about the normal stays: both its axis and its owner change sides.
static fe_contact describe(const fe_world *world, int32_t pair)
{
    const fe__pair *p = &world->pairs[pair];
    const fe__contact *c = &world->contacts[pair];
    const fe__points *q = fe__points_of(world, c);
    float side = p->flags & FE__PAIR_FLIPPED ? -1.0f : 1.0f;
    int32_t field_a = fe__form_is_field(&world->shapes[p->shape_a].form);
    fe_contact contact = {.body_a = fe__body_handle(world, p->body_a),
                          .body_b = fe__body_handle(world, p->body_b),
                          .shape_a = fe__shape_handle(world, p->shape_a),
                          .shape_b = fe__shape_handle(world, p->shape_b),
                          .material_a = fe__pair_material(world, pair, 0)->user_id,
                          .material_b = fe__pair_material(world, pair, 1)->user_id,
                          .normal = {side * c->normal[0], side * c->normal[1], side * c->normal[2]},
                          .point_count = point_count(world, pair),
                          .friction_impulse = {side * q->friction_impulse[0], side * q->friction_impulse[1],
                                               side * q->friction_impulse[2]},
                          .twist_impulse = q->twist_impulse,
                          .part_a = fe__part_of_serial(world->shapes[p->shape_a].serial),
                          .part_b = fe__part_of_serial(world->shapes[p->shape_b].serial),
                          .triangle_a = field_a ? p->triangle : -1,
                          .triangle_b = field_a ? -1 : p->triangle};
    for (int32_t i = 0; i < contact.point_count; ++i) contact.points[i] = describe_point(world, pair, i);
    return contact;
}

// The shape, or a part of it
static int32_t is_in(const fe_world *world, const fe__pair *p, int32_t shape)
{
    return fe__is_of_whole(world, p->shape_a, shape) || fe__is_of_whole(world, p->shape_b, shape);
}

// Of a body, or of one of its shapes (-1: all)
static int32_t write_contacts(const fe_world *world, int32_t body, int32_t shape, fe_contact *out_contacts,
                              uint32_t stride, int32_t capacity)
{
    int32_t count = 0;
    for (int32_t pair = world->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(world, pair, body)) {
        const fe__pair *p = &world->pairs[pair];
        if (shape >= 0 && !is_in(world, p, shape)) continue;
        if (point_count(world, pair) == 0) continue;
        if (count < capacity) {
            fe_contact contact = describe(world, pair);
            put(out_contacts, stride, count, &contact, sizeof contact);
        }
        count += 1;
    }
    return count;
}

int32_t fe_body_get_contacts(const fe_world *world, fe_body body, fe_contact *out_contacts, uint32_t stride,
                             int32_t capacity)
{
    FE_READ(world);
    FE_FIND_BODY(index, body);
    FE_CHECK_ARRAY(out_contacts, capacity);
    FE_CHECK_RECORD_STRIDE(stride, LEAST_RECORD, capacity);
    fe__fp_state fp = fe__fp_enter();
    int32_t count = write_contacts(world, index, -1, out_contacts, stride, capacity);
    fe__fp_leave(fp);
    return count;
}

int32_t fe_shape_get_contacts(const fe_world *world, fe_shape shape, fe_contact *out_contacts, uint32_t stride,
                              int32_t capacity)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_ARRAY(out_contacts, capacity);
    FE_CHECK_RECORD_STRIDE(stride, LEAST_RECORD, capacity);
    fe__fp_state fp = fe__fp_enter();
    int32_t count = write_contacts(world, world->shapes[index].body, index, out_contacts, stride, capacity);
    fe__fp_leave(fp);
    return count;
}

// ---- who is inside -------------------------------------------------------------------------------------------------

// The list of a body's pairs is in no order that shows: each is put where its creation says
static int32_t add_overlap(const fe_world *world, int32_t shape, fe_shape *out_shapes, int32_t count, int32_t capacity)
{
    int32_t place = fe__mini(count, capacity);
    uint64_t serial = world->shapes[shape].serial;
    while (place > 0 && world->shapes[fe__id_slot_of(out_shapes[place - 1])].serial > serial) {
        if (place < capacity) out_shapes[place] = out_shapes[place - 1];
        --place;
    }
    if (place < capacity) out_shapes[place] = fe__shape_handle(world, shape);
    return count + 1;
}

int32_t fe_shape_get_overlaps(const fe_world *world, fe_shape shape, fe_shape *out_shapes, int32_t capacity)
{
    FE_READ(world);
    FE_FIND_SHAPE(index, shape);
    FE_CHECK_ARRAY(out_shapes, capacity);
    int32_t body = world->shapes[index].body, count = 0;
    for (int32_t pair = world->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(world, pair, body)) {
        const fe__pair *p = &world->pairs[pair];
        if (p->flags & FE__PAIR_PATCH || !(p->flags & FE__PAIR_TOUCHING) || !is_in(world, p, index)) continue;
        if (p->flags & FE__PAIR_OF_PARTS && fe__encounter_of(world, pair)->lead != pair) continue;
        int32_t other = fe__is_of_whole(world, p->shape_a, index) ? p->shape_b : p->shape_a;
        count = add_overlap(world, fe__whole_shape(world->shapes, other), out_shapes, count, capacity);
    }
    return count;
}
