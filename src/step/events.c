// events.c - what the step reports: touching begun, kept, ended; impacts; broken joints; bodies that woke or fell
// asleep. All events stand in the order of creation, whatever the workers did.
//
// A pair touches when a point had an impulse, or a gap of 0 or less, during the step. Exits of pairs that ended
// otherwise (destroyed, re-filtered, boxes apart) wait in their records (fe_world.first_owed) and come out here.
#include "step/stages.h"

#include "core/sort.h"
#include "step/load.h"
#include "world/contact.h"
#include "world/contact_creation.h"
#include "world/encounter.h"
#include "world/joint.h"
#include "world/joint_creation.h"
#include "world/world.h"
#include "world/world_memory.h"

#include <float.h>

// ---- pairs ----------------------------------------------------------------------------------------------------------

static int32_t touches(const fe_world *world, int32_t head)
{
    int32_t is_sensor = (world->pairs[head].flags & FE__PAIR_SENSOR) != 0;
    for (int32_t pair = head; pair >= 0; pair = world->pairs[pair].next_patch) {
        const fe__contact *contact = world->contacts + pair;
        const fe__points *points = fe__points_of(world, contact);
        for (int32_t i = 0; i < (int32_t)contact->point_count; ++i)
            if (points->separation[i] <= 0.0f || (!is_sensor && points->total_impulse[i] > 0.0f)) return 1;
    }
    return 0;
}

enum { PAIRS_IN_BLOCK = 256, AHEAD = 16 };

// Fetches the records of later pairs while earlier ones are looked at.
FE_FETCHES fetch_ahead(const fe_world *world, const int32_t *pairs, int32_t i, int32_t end)
{
    if (i + 3 * AHEAD < end) __builtin_prefetch(&world->pairs[pairs[i + 3 * AHEAD]].flags);
    if (i + 2 * AHEAD < end) fe__fetch(world->contacts + pairs[i + 2 * AHEAD], sizeof *world->contacts);
    if (i + AHEAD < end) __builtin_prefetch(world->points + world->contacts[pairs[i + AHEAD]].points);
}

typedef struct touch_job {
    const fe__step *step;
    const int32_t *pairs;
} touch_job;

// Lists the pairs that have something to report. Their fe__pair.result becomes the kind of the event.
static void find_touching(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const touch_job *job = argument;
    fe_world *world = job->step->world;
    fe__step_scratch *scratch = job->step->scratch;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        int32_t head = job->pairs[i];
        fe__pair *p = world->pairs + head;
        fetch_ahead(world, job->pairs, i, end);
        if (p->flags & FE__PAIR_PATCH || !(p->flags & FE__PAIR_MAY_REPORT)) continue;
        // if the points that were kept hardly hold the load, the next step looks at all patches again
        if (p->left_out || p->next_patch >= 0)
            for (int32_t pair = head; pair >= 0; pair = world->pairs[pair].next_patch)
                if (world->pairs[pair].left_out && fe__load_outgrows(world, pair))
                    world->contacts[head].surface.tolerance = 0.0f;
        int32_t touches_now = touches(world, head) || p->flags & FE__PAIR_CROSSED;
        int32_t touched = (p->flags & FE__PAIR_TOUCHING) != 0, reports = touches_now != touched;
        p->flags &= ~(uint32_t)FE__PAIR_CROSSED;
        if (touches_now && touched) reports = (p->events & (FE_SHAPE_EVENTS_STAY | FE_SHAPE_EVENTS_HIT)) != 0;
        reports |= (p->flags & FE__PAIR_ONCE) != 0;
        p->result = touches_now ? (int16_t)(touched ? FE_EVENT_STAY : FE_EVENT_ENTER) : (int16_t)FE_EVENT_EXIT;
        if (reports)
            scratch->results[atomic_fetch_add_explicit(&scratch->result_count, 1, memory_order_relaxed)] = head;
    }
}

// A listed pair begins or ceases to touch. Returns the fe_event_kind that it has to report, 0: nothing
static int32_t settle_pair(fe__step *step, int32_t pair)
{
    fe_world *world = step->world;
    fe__pair *p = world->pairs + pair;
    int32_t kind = p->result, touched = (p->flags & FE__PAIR_TOUCHING) != 0, touches_now = kind != FE_EVENT_EXIT;
    if (p->flags & FE__PAIR_ONCE) {
        p->flags &= ~(uint32_t)FE__PAIR_ONCE;
        int32_t is_asleep = world->bodies[p->body_a].awake_index < 0 && world->bodies[p->body_b].awake_index < 0;
        if (is_asleep) fe__pair_retire(world, pair);
    }
    if (!touches_now && !touched) return 0;
    if (touches_now != touched) {
        if (p->flags & FE__PAIR_OF_PARTS)
            fe__encounter_touch(world, pair, touches_now);
        else
            p->flags ^= FE__PAIR_TOUCHING;
    }
    if (!touches_now) fe__defer_pair(step, pair, 0.0f);
    return kind;
}

// ---- impacts --------------------------------------------------------------------------------------------------------

typedef struct impact {
    float impulse, largest; // sum of the points' impulses, and the largest of them, N s
    float approach;         // the fastest, m/s
    int32_t pair, point;    // place of the largest impulse: the pair or a patch of it
} impact;

static impact impact_of(const fe_world *world, int32_t head)
{
    impact sum = {.pair = head};
    for (int32_t pair = head; pair >= 0; pair = world->pairs[pair].next_patch) {
        const fe__contact *contact = world->contacts + pair;
        const fe__points *points = fe__points_of(world, contact);
        if (contact->point_count > 0.0f)
            sum.approach = fe__maxf(sum.approach, world->features[contact->points].approach);
        for (int32_t i = 0; i < (int32_t)contact->point_count; ++i) {
            float impulse = points->total_impulse[i];
            sum.impulse += impulse;
            if (impulse > sum.largest) sum.largest = impulse, sum.pair = pair, sum.point = i;
        }
    }
    return sum;
}

// Reports an impact that is fast enough. `head` is the pair of the shapes.
static void report_impact(fe_world *world, int32_t head, const impact *sum)
{
    if (sum->approach < world->tuning.hit_event_threshold || sum->impulse <= 0.0f) return;
    const fe__contact *contact = world->contacts + sum->pair;
    float sign = world->pairs[head].flags & FE__PAIR_FLIPPED ? -1.0f : 1.0f;
    fe__pair_event_record e = fe__pair_event_of(world, head, FE_EVENT_ENTER);
    world->hit_events[world->hit_event_count++] =
        (fe__hit_event_record){e.serial_a,
                               e.serial_b,
                               {.body_a = e.body_a,
                                .body_b = e.body_b,
                                .shape_a = e.shape_a,
                                .shape_b = e.shape_b,
                                .material_a = fe__pair_material(world, sum->pair, 0)->user_id,
                                .material_b = fe__pair_material(world, sum->pair, 1)->user_id,
                                .point = fe__contact_point(world, sum->pair, sum->point),
                                .normal = fe__scale(sign, fe__quad_vector(contact->normal)),
                                .speed = sum->approach,
                                .impulse = sum->impulse,
                                .part_a = fe__part_of_serial(e.serial_a),
                                .part_b = fe__part_of_serial(e.serial_b),
                                .triangle_a = e.field_a ? e.triangle : -1,
                                .triangle_b = e.field_a ? -1 : e.triangle}};
}

static void report_pair(fe__step *step, int32_t pair)
{
    fe_world *world = step->world;
    const fe__pair *p = world->pairs + pair;
    int32_t kind = settle_pair(step, pair);
    if (!kind) return;
    if (kind != FE_EVENT_EXIT && !(p->flags & FE__PAIR_SENSOR) && p->events & FE_SHAPE_EVENTS_HIT) {
        impact sum = impact_of(world, pair);
        report_impact(world, pair, &sum);
    }
    if (p->events & (kind == FE_EVENT_STAY ? (uint32_t)FE_SHAPE_EVENTS_STAY : (uint32_t)FE_SHAPE_EVENTS_TOUCH))
        world->pair_events[world->pair_event_count++] = fe__pair_event_of(world, pair, kind);
}

// ---- encounters of compounds ----------------------------------------------------------------------------------------
// The pairs of their parts are summed up and reported as one pair of the whole shapes (world/encounter.h).

// Adds a touching pair of parts to its encounter. Sums, and the choice among equally deep pairs, follow the order of
// these calls.
static void add_to_encounter(fe_world *world, int32_t head)
{
    const fe__pair *p = world->pairs + head;
    fe__encounter *encounter = fe__encounter_of(world, head);
    float least = FLT_MAX;
    for (int32_t pair = head; pair >= 0; pair = world->pairs[pair].next_patch) {
        const fe__contact *contact = world->contacts + pair;
        const fe__points *points = fe__points_of(world, contact);
        for (int32_t i = 0; i < (int32_t)contact->point_count; ++i) least = fe__minf(least, points->separation[i]);
    }
    if (!encounter->deepest || least < encounter->depth) encounter->deepest = head, encounter->depth = least;
    if (!(p->flags & FE__PAIR_SENSOR) && p->events & FE_SHAPE_EVENTS_HIT) {
        impact sum = impact_of(world, head);
        encounter->impulse += sum.impulse;
        encounter->approach = fe__maxf(encounter->approach, sum.approach);
        if (sum.largest > encounter->largest)
            encounter->largest = sum.largest, encounter->hit_pair = sum.pair, encounter->hit_point = sum.point;
    }
    fe__encounter_note(world, encounter);
}

static fe__pair_event_record exit_of_encounter(const fe_world *world, const fe__encounter *encounter)
{
    const fe__shape *a = world->shapes + encounter->shape_a, *b = world->shapes + encounter->shape_b;
    return (fe__pair_event_record){.serial_a = a->serial,
                                   .serial_b = b->serial,
                                   .body_a = fe__body_handle(world, a->body),
                                   .body_b = fe__body_handle(world, b->body),
                                   .shape_a = fe__shape_handle(world, encounter->shape_a),
                                   .shape_b = fe__shape_handle(world, encounter->shape_b),
                                   .kind = FE_EVENT_EXIT,
                                   .is_trigger = ((a->flags | b->flags) & FE__SHAPE_TRIGGER) != 0,
                                   .triangle = -1};
}

static void report_encounter(fe_world *world, fe__encounter *encounter)
{
    uint32_t events = world->shapes[encounter->shape_a].events | world->shapes[encounter->shape_b].events;
    int32_t touches_now = encounter->touching > 0, touched = encounter->entered;
    encounter->entered = (uint16_t)touches_now;
    if (touched && !touches_now && events & FE_SHAPE_EVENTS_TOUCH)
        world->pair_events[world->pair_event_count++] = exit_of_encounter(world, encounter);
    if (touches_now && encounter->deepest) {
        uint32_t asked = touched ? (uint32_t)FE_SHAPE_EVENTS_STAY : (uint32_t)FE_SHAPE_EVENTS_TOUCH;
        if (events & asked)
            world->pair_events[world->pair_event_count++] =
                fe__pair_event_of(world, encounter->deepest, touched ? FE_EVENT_STAY : FE_EVENT_ENTER);
    }
    if (encounter->hit_pair) {
        const fe__pair *p = world->pairs + encounter->hit_pair;
        impact sum = {encounter->impulse, encounter->largest, encounter->approach, encounter->hit_pair,
                      encounter->hit_point};
        report_impact(world, p->flags & FE__PAIR_PATCH ? p->head : encounter->hit_pair, &sum);
    }
    encounter->deepest = encounter->hit_pair = 0;
    encounter->impulse = encounter->largest = encounter->approach = 0.0f;
    fe__encounter_reported(world, encounter);
}

// ---- stages ---------------------------------------------------------------------------------------------------------

// Sorts events by B, then, stably, by A, of whole shapes: the two serials that each record begins with. The records are
// moved once, along the cycles of the permutation.
static void sort_records(fe__step *step, unsigned char *records, int32_t count, size_t size)
{
    fe__sort_item *items = fe__sort_scratch(step);
    for (int32_t key = 1; key >= 0; --key) {
        for (int32_t i = 0; i < count; ++i) {
            if (key) items[i].value = i;
            items[i].key =
                ((const uint64_t *)(const void *)(records + (size_t)items[i].value * size))[key] >> FE__PART_BITS;
        }
        fe__sort_keys(items, count, items + count);
    }
    union {
        fe__pair_event_record pair;
        fe__hit_event_record hit;
        unsigned char bytes[sizeof(fe__hit_event_record)];
    } held;
    for (int32_t i = 0; i < count; ++i) {
        if (items[i].value == i || items[i].value < 0) continue;
        __builtin_memcpy(held.bytes, records + (size_t)i * size, size);
        for (int32_t at = i, from; at >= 0; at = from) {
            from = items[at].value;
            items[at].value = -1;
            if (from == i) {
                __builtin_memcpy(records + (size_t)at * size, held.bytes, size);
                break;
            }
            __builtin_memcpy(records + (size_t)at * size, records + (size_t)from * size, size);
        }
    }
}

void fe__collect_events(fe__step *step)
{
    fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    world->pair_event_count = world->hit_event_count = 0;
    fe__report_owed_exits(world);
    atomic_store(&scratch->result_count, 0);
    int32_t count;
    touch_job job = {step, fe__active_pairs(step, &count)};
    fe__parallel_for(&world->workers, count, PAIRS_IN_BLOCK, find_touching, &job);
    count = atomic_load(&scratch->result_count);
    int32_t *results = scratch->results, part_pairs = 0; // pairs of parts gather at the front
    for (int32_t i = 0; i < count; ++i) {
        if (world->pairs[results[i]].flags & FE__PAIR_OF_PARTS)
            results[part_pairs++] = results[i];
        else
            report_pair(step, results[i]);
    }
    fe__sort_pairs(step, results, part_pairs);
    for (int32_t i = 0; i < part_pairs; ++i) {
        int32_t kind = settle_pair(step, results[i]);
        if (kind && kind != FE_EVENT_EXIT) add_to_encounter(world, results[i]);
    }
    while (world->first_changed) report_encounter(world, fe__record(&world->encounters, world->first_changed));
    sort_records(step, (unsigned char *)world->pair_events, world->pair_event_count, sizeof *world->pair_events);
    sort_records(step, (unsigned char *)world->hit_events, world->hit_event_count, sizeof *world->hit_events);
}

void fe__collect_body_events(fe__step *step)
{
    fe_world *world = step->world;
    fe__sort_item *items = fe__sort_scratch(step);
    int32_t count = 0;
    for (int32_t i = 0; i < world->disturbed_count; ++i) {
        int32_t index = world->disturbed[i];
        fe__body *body = world->bodies + index;
        int32_t is_awake = body->awake_index >= 0, was_awake = (body->flags & FE__BODY_SEEN_AWAKE) != 0;
        body->flags &= ~(uint32_t)(FE__BODY_DISTURBED | FE__BODY_SEEN_AWAKE);
        if (is_awake) body->flags |= FE__BODY_SEEN_AWAKE;
        int32_t reports = fe__id_pool_is_alive(&world->body_ids, index) && body->flags & FE__BODY_ENABLED &&
                          body->type != FE_BODY_STATIC;
        if (reports && is_awake != was_awake) items[count++] = (fe__sort_item){body->serial, index, is_awake};
    }
    world->disturbed_count = 0;
    fe__sort_keys(items, count, items + count);
    world->body_event_count = count;
    for (int32_t i = 0; i < count; ++i)
        world->body_events[i] = (fe__body_event_record){items[i].key,
                                                        {fe__body_handle(world, items[i].value),
                                                         items[i].spare ? FE_EVENT_WAKE : FE_EVENT_SLEEP, 0}};
}

static int32_t exceeds(fe_vec3 a, float most) { return most > 0.0f && fe__dot(a, a) > most * most; }

// Reads the step's reactions; writes events in the order of creation, then removes the joints in that order.
void fe__break_joints(fe__step *step)
{
    fe_world *world = step->world;
    fe__sort_item *items = fe__sort_scratch(step);
    int32_t count = 0;
    world->joint_event_count = 0;
    if (!world->breakable_count || step->dt == 0.0f) return;
    for (int32_t i = 0; i < world->awake_joint_count; ++i) {
        int32_t joint = world->awake_joints[i];
        const fe__joint_record *r = world->joint_records + joint;
        if (world->joints.joints[joint].colour < 0 || (r->break_force == 0.0f && r->break_torque == 0.0f)) continue;
        fe_vec3 force, torque;
        fe__joint_reaction_of(&world->joints, world->bodies, joint, &force, &torque);
        if (exceeds(force, r->break_force) || exceeds(torque, r->break_torque))
            items[count++] = (fe__sort_item){world->joints.frames[joint].serial, joint, 0};
    }
    fe__sort_keys(items, count, items + count);
    world->joint_event_count = count;
    for (int32_t i = 0; i < count; ++i) {
        int32_t joint = items[i].value;
        const fe__joint_record *r = world->joint_records + joint;
        fe_joint_event e = {fe__joint_handle(world, joint),
                            fe__joint_end_handle(world, joint, 0),
                            fe__joint_end_handle(world, joint, 1),
                            r->user_data,
                            FE_EVENT_BREAK,
                            r->type,
                            {0, 0, 0},
                            {0, 0, 0}};
        fe__joint_reaction_of(&world->joints, world->bodies, joint, &e.force, &e.torque);
        world->joint_events[i] = (fe__joint_event_record){items[i].key, e};
    }
    for (int32_t i = 0; i < count; ++i) fe__joint_remove(world, items[i].value);
}
