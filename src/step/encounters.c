// encounters.c - see encounters.h.
//
// The pairs come in the order of creation, so that sums of impulses and the choice among equally deep points are the
// same whatever the workers did.
#include "step/encounters.h"

#include "step/collide_stage.h"
#include "step/events.h"
#include "world/encounter.h"
#include "world/handles.h"
#include "world/pairs.h"

#include <float.h>

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

static void report(fe_world *w, fe__encounter *e)
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
    while (w->first_changed) report(w, fe__record(&w->encounters, w->first_changed));
}
