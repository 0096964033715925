// events.c - what the step reports: touching begun, kept, ended; impacts; bodies that woke or fell asleep. In the order
// of creation.
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

// ---- encounters -----------------------------------------------------------------------------------------------------
// The events of compounds: what their parts' pairs found, told of the whole shapes.

// Of pairs of parts that have something to report, in any order; and of encounters that lost pairs since the last step
void fe__report_encounters(fe__step *step, int32_t *pairs, int32_t count);

// ---- events ---------------------------------------------------------------------------------------------------------

static int32_t touches(const fe_world *w, int32_t head)
{
    int32_t sensor = (w->pairs[head].flags & FE__PAIR_SENSOR) != 0;
    for (int32_t pair = head; pair >= 0; pair = w->pairs[pair].next_patch) {
        const fe__contact *m = w->contacts + pair;
        const fe__points *q = fe__points_of(w, m);
        for (int32_t i = 0; i < (int32_t)m->point_count; ++i)
            if (q->separation[i] <= 0.0f || (!sensor && q->total_impulse[i] > 0.0f)) return 1;
    }
    return 0;
}

fe__hit_impact fe__impact_of(const fe_world *w, int32_t head)
{
    fe__hit_impact sum = {.pair = head};
    for (int32_t pair = head; pair >= 0; pair = w->pairs[pair].next_patch) {
        const fe__contact *m = w->contacts + pair;
        const fe__points *q = fe__points_of(w, m);
        if (m->point_count > 0.0f) sum.approach = fe__maxf(sum.approach, w->features[m->points].approach);
        for (int32_t i = 0; i < (int32_t)m->point_count; ++i) {
            sum.impulse += q->total_impulse[i];
            if (q->total_impulse[i] > sum.largest) sum.largest = q->total_impulse[i], sum.pair = pair, sum.point = i;
        }
    }
    return sum;
}

void fe__add_hit(fe_world *w, int32_t pair, const fe__hit_impact *sum)
{
    const fe__pair *p = w->pairs + pair;
    if (sum->approach < w->tuning.hit_event_threshold || sum->impulse <= 0.0f) return;
    const fe__contact *m = w->contacts + sum->pair;
    float sign = p->flags & FE__PAIR_FLIPPED ? -1.0f : 1.0f;
    fe__pair_event_record e = fe__pair_event_of(w, pair, FE_EVENT_ENTER);
    fe__hit_event_record *r = w->hit_events + w->hit_event_count++;
    *r = (fe__hit_event_record){e.serial_a,
                                e.serial_b,
                                {.body_a = e.body_a,
                                 .body_b = e.body_b,
                                 .shape_a = e.shape_a,
                                 .shape_b = e.shape_b,
                                 .material_a = fe__pair_material(w, sum->pair, 0)->user_id,
                                 .material_b = fe__pair_material(w, sum->pair, 1)->user_id,
                                 .point = fe__contact_point(w, sum->pair, sum->point),
                                 .normal = fe__scale(sign, fe__vec3(m->normal[0], m->normal[1], m->normal[2])),
                                 .speed = sum->approach,
                                 .impulse = sum->impulse,
                                 .part_a = fe__part_of_serial(e.serial_a),
                                 .part_b = fe__part_of_serial(e.serial_b),
                                 .triangle_a = e.field_a ? e.triangle : -1,
                                 .triangle_b = e.field_a ? -1 : e.triangle}};
}

// What the points that were kept hardly hold is looked at again in the next step, all patches of a pair at once
static void outgrow(fe_world *w, int32_t head)
{
    for (int32_t pair = head; pair >= 0; pair = w->pairs[pair].next_patch)
        if (w->pairs[pair].left_out && fe__load_outgrows(w, pair)) w->contacts[head].surface.tolerance = 0.0f;
}

// ---- looking, on any thread: pairs that have something to report go to the list of results -------------------------
enum { PAIRS_IN_BLOCK = 256, AHEAD = 16 }; // AHEAD: records come from memory while those before them are looked at

FE_FETCHES fetch_ahead(const fe_world *w, const int32_t *pairs, int32_t i, int32_t end)
{
    if (i + 3 * AHEAD < end) __builtin_prefetch(&w->pairs[pairs[i + 3 * AHEAD]].flags);
    if (i + 2 * AHEAD < end) fe__fetch(w->contacts + pairs[i + 2 * AHEAD], sizeof *w->contacts);
    if (i + AHEAD < end) __builtin_prefetch(w->points + w->contacts[pairs[i + AHEAD]].points);
}

typedef struct look_job {
    const fe__step *step;
    const int32_t *pairs;
} look_job;

static void look_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const look_job *job = argument;
    const fe__step *step = job->step;
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        int32_t pair = job->pairs[i];
        fe__pair *p = w->pairs + pair;
        fetch_ahead(w, job->pairs, i, end);
        if (p->flags & FE__PAIR_PATCH || !(p->flags & FE__PAIR_MAY_REPORT)) continue;
        if (p->left_out || p->next_patch >= 0) outgrow(w, pair);
        int32_t now = touches(w, pair) || p->flags & FE__PAIR_CROSSED;
        p->flags &= ~(uint32_t)FE__PAIR_CROSSED;
        int32_t before = (p->flags & FE__PAIR_TOUCHING) != 0, reports = now != before;
        if (now && before) reports = (p->events & (FE_SHAPE_EVENTS_STAY | FE_SHAPE_EVENTS_HIT)) != 0;
        reports |= (p->flags & FE__PAIR_ONCE) != 0;
        p->result = now ? (int16_t)(before ? FE_EVENT_STAY : FE_EVENT_ENTER) : (int16_t)FE_EVENT_EXIT;
        if (reports) s->results[atomic_fetch_add_explicit(&s->result_count, 1, memory_order_relaxed)] = pair;
    }
}

static void forget_if_asleep(fe_world *w, int32_t pair)
{
    fe__pair *p = w->pairs + pair;
    p->flags &= ~(uint32_t)FE__PAIR_ONCE;
    if (w->bodies[p->body_a].awake_index < 0 && w->bodies[p->body_b].awake_index < 0) fe__pair_retire(w, pair);
}

static void set_touching(fe_world *w, int32_t pair, int32_t touches)
{
    fe__pair *p = w->pairs + pair;
    if (p->flags & FE__PAIR_OF_PARTS)
        fe__encounter_touch(w, pair, touches);
    else
        p->flags = touches ? p->flags | FE__PAIR_TOUCHING : p->flags & ~(uint32_t)FE__PAIR_TOUCHING;
}

int32_t fe__settle_pair(fe__step *step, int32_t pair)
{
    fe_world *w = step->world;
    const fe__pair *p = w->pairs + pair;
    int32_t kind = p->result, before = (p->flags & FE__PAIR_TOUCHING) != 0, now = kind != FE_EVENT_EXIT;
    if (p->flags & FE__PAIR_ONCE) forget_if_asleep(w, pair);
    if (!now && !before) return 0;
    if (now != before) set_touching(w, pair, now);
    if (!now) fe__defer_pair(step, pair, 0.0f);
    return kind;
}

static void report(fe__step *step, int32_t pair)
{
    fe_world *w = step->world;
    const fe__pair *p = w->pairs + pair;
    int32_t kind = fe__settle_pair(step, pair);
    if (!kind) return;
    if (kind != FE_EVENT_EXIT && !(p->flags & FE__PAIR_SENSOR) && p->events & FE_SHAPE_EVENTS_HIT) {
        fe__hit_impact sum = fe__impact_of(w, pair);
        fe__add_hit(w, pair, &sum);
    }
    if (p->events & (kind == FE_EVENT_STAY ? (uint32_t)FE_SHAPE_EVENTS_STAY : (uint32_t)FE_SHAPE_EVENTS_TOUCH))
        w->pair_events[w->pair_event_count++] = fe__pair_event_of(w, pair, kind);
}

// ---- order ---------------------------------------------------------------------------------------------------------
// Stable sorts by B, then by A, of whole shapes. The records are moved once, along the cycles of the permutation.
static void sort_records(fe__step *step, unsigned char *records, int32_t count, size_t size)
{
    fe__sort_item *items = fe__sort_room(step);
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
    fe_world *w = step->world;
    w->pair_event_count = w->hit_event_count = 0;
    fe__report_owed_exits(w);
    fe__step_scratch *s = step->scratch;
    atomic_store(&s->result_count, 0);
    int32_t count;
    look_job job = {step, fe__busy_pairs(step, &count)};
    fe__parallel_for(&w->workers, count, PAIRS_IN_BLOCK, look_block, &job);
    count = atomic_load(&s->result_count);
    int32_t of_parts = 0; // gathered at the front
    for (int32_t i = 0; i < count; ++i) {
        if (w->pairs[s->results[i]].flags & FE__PAIR_OF_PARTS)
            s->results[of_parts++] = s->results[i];
        else
            report(step, s->results[i]);
    }
    if (of_parts || w->first_changed) fe__report_encounters(step, s->results, of_parts);
    sort_records(step, (unsigned char *)w->pair_events, w->pair_event_count, sizeof *w->pair_events);
    sort_records(step, (unsigned char *)w->hit_events, w->hit_event_count, sizeof *w->hit_events);
}

void fe__collect_body_events(fe__step *step)
{
    fe_world *w = step->world;
    fe__sort_item *items = fe__sort_room(step);
    int32_t count = 0;
    for (int32_t i = 0; i < w->disturbed_count; ++i) {
        int32_t index = w->disturbed[i];
        fe__body *body = w->bodies + index;
        int32_t awake = body->awake_index >= 0, before = (body->flags & FE__BODY_SEEN_AWAKE) != 0;
        body->flags &= ~(uint32_t)(FE__BODY_DISTURBED | FE__BODY_SEEN_AWAKE);
        if (awake) body->flags |= FE__BODY_SEEN_AWAKE;
        int32_t reports =
            fe__id_pool_is_alive(&w->body_ids, index) && body->flags & FE__BODY_ENABLED && body->type != FE_BODY_STATIC;
        if (reports && awake != before) items[count++] = (fe__sort_item){body->serial, index, awake};
    }
    w->disturbed_count = 0;
    fe__sort_keys(items, count, items + count);
    w->body_event_count = count;
    for (int32_t i = 0; i < count; ++i)
        w->body_events[i] = (fe__body_event_record){items[i].key,
                                                    {fe__body_handle(w, items[i].value),
                                                     items[i].spare ? FE_EVENT_WAKE : FE_EVENT_SLEEP, 0}};
}

// ---- encounters -----------------------------------------------------------------------------------------------------
// See stages.h.
//
// The pairs come in the order of creation, so that sums of impulses and the choice among equally deep points are the
// same whatever the workers did.

// m, FLT_MAX without points
static float least_separation(const fe_world *w, int32_t head)
{
    float least = FLT_MAX;
    for (int32_t pair = head; pair >= 0; pair = w->pairs[pair].next_patch) {
        const fe__contact *m = w->contacts + pair;
        const fe__points *q = fe__points_of(w, m);
        for (int32_t i = 0; i < (int32_t)m->point_count; ++i) least = fe__minf(least, q->separation[i]);
    }
    return least;
}

static void add_impact(const fe_world *w, fe__encounter *e, int32_t pair)
{
    fe__hit_impact sum = fe__impact_of(w, pair);
    e->impulse += sum.impulse;
    e->approach = fe__maxf(e->approach, sum.approach);
    if (sum.largest > e->largest) e->largest = sum.largest, e->hit_pair = sum.pair, e->hit_point = sum.point;
}

// A pair that touches
static void add(fe_world *w, int32_t pair)
{
    const fe__pair *p = w->pairs + pair;
    fe__encounter *e = fe__encounter_of(w, pair);
    float depth = least_separation(w, pair);
    if (!e->deepest || depth < e->depth) e->deepest = pair, e->depth = depth;
    if (!(p->flags & FE__PAIR_SENSOR) && p->events & FE_SHAPE_EVENTS_HIT) add_impact(w, e, pair);
    fe__encounter_note(w, e);
}

static fe__pair_event_record exit_of(const fe_world *w, const fe__encounter *e)
{
    const fe__shape *a = w->shapes + e->shape_a, *b = w->shapes + e->shape_b;
    return (fe__pair_event_record){.serial_a = a->serial,
                                   .serial_b = b->serial,
                                   .body_a = fe__body_handle(w, a->body),
                                   .body_b = fe__body_handle(w, b->body),
                                   .shape_a = fe__shape_handle(w, e->shape_a),
                                   .shape_b = fe__shape_handle(w, e->shape_b),
                                   .kind = FE_EVENT_EXIT,
                                   .is_trigger = ((a->flags | b->flags) & FE__SHAPE_TRIGGER) != 0,
                                   .triangle = -1};
}

static void report_touch(fe_world *w, fe__encounter *e)
{
    uint32_t events = w->shapes[e->shape_a].events | w->shapes[e->shape_b].events;
    int32_t now = e->touching > 0, before = e->entered;
    e->entered = (uint16_t)now;
    if (before && !now && events & FE_SHAPE_EVENTS_TOUCH) w->pair_events[w->pair_event_count++] = exit_of(w, e);
    if (!now || !e->deepest) return;
    int32_t kind = before ? FE_EVENT_STAY : FE_EVENT_ENTER;
    if (events & (before ? (uint32_t)FE_SHAPE_EVENTS_STAY : (uint32_t)FE_SHAPE_EVENTS_TOUCH))
        w->pair_events[w->pair_event_count++] = fe__pair_event_of(w, e->deepest, kind);
}

static void report_encounter(fe_world *w, fe__encounter *e)
{
    report_touch(w, e);
    if (e->hit_pair) {
        const fe__pair *p = w->pairs + e->hit_pair;
        fe__hit_impact sum = {e->impulse, e->largest, e->approach, e->hit_pair, e->hit_point};
        fe__add_hit(w, p->flags & FE__PAIR_PATCH ? p->head : e->hit_pair, &sum);
    }
    e->deepest = e->hit_pair = 0;
    e->impulse = e->largest = e->approach = 0.0f;
    fe__encounter_reported(w, e);
}

void fe__report_encounters(fe__step *step, int32_t *pairs, int32_t count)
{
    fe_world *w = step->world;
    fe__sort_pairs(step, pairs, count);
    for (int32_t i = 0; i < count; ++i) {
        int32_t kind = fe__settle_pair(step, pairs[i]);
        if (kind && kind != FE_EVENT_EXIT) add(w, pairs[i]);
    }
    while (w->first_changed) report_encounter(w, fe__record(&w->encounters, w->first_changed));
}

// ---- break joints ---------------------------------------------------------------------------------------------------
// Joints that bore too much in the step, by its reactions, go: their events first, in the order of
// creation.

static int32_t exceeds(fe_vec3 a, float most) { return most > 0.0f && fe__dot(a, a) > most * most; }

// Reads the step's reactions; writes events in the order of creation, then removes the joints in that order
void fe__break_joints(fe__step *step)
{
    fe_world *w = step->world;
    fe__sort_item *items = fe__sort_room(step);
    int32_t count = 0;
    w->joint_event_count = 0;
    if (!w->breakable_count || step->dt == 0.0f) return;
    for (int32_t i = 0; i < w->awake_joint_count; ++i) {
        int32_t joint = w->awake_joints[i];
        const fe__joint_record *r = w->joint_records + joint;
        if (w->joints.joints[joint].colour < 0 || (r->break_force == 0.0f && r->break_torque == 0.0f)) continue;
        fe_vec3 force, torque;
        fe__joint_reaction_of(&w->joints, w->bodies, joint, &force, &torque);
        if (exceeds(force, r->break_force) || exceeds(torque, r->break_torque))
            items[count++] = (fe__sort_item){w->joints.frames[joint].serial, joint, 0};
    }
    fe__sort_keys(items, count, items + count);
    w->joint_event_count = count;
    for (int32_t i = 0; i < count; ++i) {
        int32_t joint = items[i].value;
        const fe__joint_record *r = w->joint_records + joint;
        fe_joint_event e = {fe__joint_handle(w, joint),
                            fe__joint_end_handle(w, joint, 0),
                            fe__joint_end_handle(w, joint, 1),
                            r->user_data,
                            FE_EVENT_BREAK,
                            r->type,
                            {0, 0, 0},
                            {0, 0, 0}};
        fe__joint_reaction_of(&w->joints, w->bodies, joint, &e.force, &e.torque);
        w->joint_events[i] = (fe__joint_event_record){items[i].key, e};
    }
    for (int32_t i = 0; i < count; ++i) fe__joint_remove(w, items[i].value);
}
