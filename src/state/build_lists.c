// build_lists.c - ignored bodies, encounters, who is awake, and events, out of a snapshot.
#include "state/build.h"

#include "world/encounter.h"
#include "world/ignore.h"
#include "world/joint_list.h"
#include "world/pair_list.h"
#include "world/pairs.h"

#include <string.h>

// The record that a row names: taken out of those that are neither free nor known
static void *claim_record(const fe__record_pool *pool, int32_t slot)
{
    int32_t state;
    if (slot < 1 || slot >= pool->limit) return NULL;
    memcpy(&state, fe__record(pool, slot), sizeof state);
    if (state != -1) return NULL;
    memset(fe__record(pool, slot), 0, (size_t)pool->size);
    return fe__record(pool, slot);
}

// ---- ignored bodies -------------------------------------------------------------------------------------------------
static int32_t take_ignore(fe__build *b, int32_t i)
{
    fe_world *w = b->world;
    fe__ignore_row row;
    fe__take_row(b->snapshot, FE__TABLE_IGNORES, i, &row);
    fe__ignore *record = claim_record(&w->ignores, row.slot);
    int32_t x = row.body[0], y = row.body[1];
    if (!record || !fe__id_pool_is_alive(&w->body_ids, x) || !fe__id_pool_is_alive(&w->body_ids, y) || x == y ||
        fe__pair_set_find(&w->ignored, x, y) >= 0)
        return fe__snapshot_refuse(b->snapshot, "ignored pairs: row %d is of none", (int)i);
    record->body[0] = x, record->body[1] = y;
    for (int k = 0; k < 2; ++k) record->links[k] = (fe__link){row.next[k], -1};
    fe__pair_set_insert(&w->ignored, x, y, row.slot);
    return 1;
}

// fe__link.previous is -1 until the link was met
static int32_t follow_ignored(fe__build *b, int32_t body, int64_t *met)
{
    const fe_world *w = b->world;
    const fe__body *of = w->bodies + body;
    int32_t previous = 0, ignores = (of->flags & FE__BODY_IGNORES) != 0;
    for (int32_t i = of->first_ignored; i; ++*met) {
        fe__ignore *record = i < w->ignores.limit ? fe__record(&w->ignores, i) : NULL;
        fe__link *link = record && record->body[0] == body ? record->links : record ? record->links + 1 : NULL;
        if (!record || (record->body[0] != body && record->body[1] != body) || link->previous != -1 ||
            fe__pair_set_find(&w->ignored, record->body[0], record->body[1]) != i)
            return fe__snapshot_refuse(b->snapshot, "ignored pairs: the list of body %d leads astray", (int)body);
        link->previous = previous, previous = i;
        i = link->next;
    }
    return ignores == (of->first_ignored != 0) ||
           fe__snapshot_refuse(b->snapshot, "body in slot %d: its flags are not those of its lists", (int)body);
}

int32_t fe__build_ignores(fe__build *b, const fe__world_row *row)
{
    fe_world *w = b->world;
    int32_t rows = fe__rows_of(b->snapshot, FE__TABLE_IGNORES);
    int64_t met = 0;
    if (!fe__build_pool(b, &w->ignores, row->ignore_limit, FE__TABLE_FREE_IGNORES, FE__TABLE_IGNORES)) return 0;
    if (!fe__pair_set_reserve(&w->ignored, fe__memory_of(b), rows)) return fe__lack_memory(b);
    for (int32_t i = 0; i < rows; ++i)
        if (!take_ignore(b, i)) return 0;
    for (int32_t body = 0; body < w->body_ids.slot_count; ++body)
        if (fe__id_pool_is_alive(&w->body_ids, body) && !follow_ignored(b, body, &met)) return 0;
    return met == 2 * (int64_t)rows || fe__snapshot_refuse(b->snapshot, "ignored pairs: one is in no list");
}

// ---- encounters ----------------------------------------------------------------------------------------------------
static int32_t take_encounter(fe__build *b, int32_t i)
{
    fe_world *w = b->world;
    fe__encounter_row row;
    fe__take_row(b->snapshot, FE__TABLE_ENCOUNTERS, i, &row);
    fe__encounter *e = claim_record(&w->encounters, row.slot);
    int32_t x = row.shape_a, y = row.shape_b;
    if (!e || !fe__id_pool_is_alive(&w->shape_ids, x) || !fe__id_pool_is_alive(&w->shape_ids, y) ||
        w->shapes[x].serial >= w->shapes[y].serial || fe__pair_set_find(&w->encounter_set, x, y) >= 0 ||
        row.lead >= w->pair_limit)
        return fe__snapshot_refuse(b->snapshot, "encounters: row %d is of none", (int)i);
    e->shape_a = x, e->shape_b = y, e->lead = row.lead;
    e->denied = row.denied, e->entered = row.entered;
    fe__pair_set_insert(&w->encounter_set, x, y, row.slot);
    ++w->encounter_count;
    return 1;
}

static int32_t count_pairs_of_parts(fe__build *b)
{
    fe_world *w = b->world;
    for (int32_t pair = 1; pair < w->pair_limit; ++pair) {
        const fe__pair *p = w->pairs + pair;
        if (p->flags & (FE__PAIR_FREE | FE__PAIR_PATCH) || !(p->flags & FE__PAIR_OF_PARTS)) continue;
        fe__encounter *e = fe__encounter_of(w, pair);
        if (!e) return fe__snapshot_refuse(b->snapshot, "pair %d: its shapes have no encounter", (int)pair);
        ++e->pairs, ++w->part_pair_count;
        e->touching += (p->flags & FE__PAIR_TOUCHING) != 0;
        e->held += (p->flags & FE__PAIR_LINKED) != 0;
        e->passing += (p->flags & FE__PAIR_PASSING) != 0;
    }
    return 1;
}

static int32_t is_lead(const fe_world *w, const fe__encounter *e)
{
    const fe__pair *p = w->pairs + e->lead;
    if (!e->lead) return e->touching == 0;
    return !(p->flags & (FE__PAIR_FREE | FE__PAIR_PATCH)) && p->flags & FE__PAIR_OF_PARTS &&
           p->flags & FE__PAIR_TOUCHING && fe__encounter_of(w, e->lead) == e;
}

// The list of those to report of is in no order that matters
static int32_t close_encounter(fe__build *b, int32_t i)
{
    fe_world *w = b->world;
    fe__encounter_row row;
    fe__take_row(b->snapshot, FE__TABLE_ENCOUNTERS, i, &row);
    fe__encounter *e = fe__record(&w->encounters, row.slot);
    if (e->pairs == 0 || !is_lead(w, e))
        return fe__snapshot_refuse(b->snapshot, "encounters: row %d has no pairs, or another leads", (int)i);
    if (row.listed) fe__encounter_note(w, e);
    return 1;
}

int32_t fe__build_encounters(fe__build *b, const fe__world_row *row)
{
    fe_world *w = b->world;
    int32_t rows = fe__rows_of(b->snapshot, FE__TABLE_ENCOUNTERS);
    if (!fe__build_pool(b, &w->encounters, row->encounter_limit, FE__TABLE_FREE_ENCOUNTERS, FE__TABLE_ENCOUNTERS))
        return 0;
    if (!fe__pair_set_reserve(&w->encounter_set, fe__memory_of(b), rows)) return fe__lack_memory(b);
    for (int32_t i = 0; i < rows; ++i)
        if (!take_encounter(b, i)) return 0;
    if (!count_pairs_of_parts(b)) return 0;
    for (int32_t i = 0; i < rows; ++i)
        if (!close_encounter(b, i)) return 0;
    return 1;
}

// ---- who is awake ---------------------------------------------------------------------------------------------------
static int32_t is_awake(const fe_world *w, int32_t body) { return w->bodies[body].awake_index >= 0; }
static int32_t is_dynamic(const fe_world *w, int32_t body) { return w->bodies[body].type == FE_BODY_DYNAMIC; }

static int32_t take_awake_bodies(fe__build *b)
{
    fe_world *w = b->world;
    int32_t rows = fe__rows_of(b->snapshot, FE__TABLE_AWAKE_BODIES);
    if (rows > w->body_count) return fe__snapshot_refuse(b->snapshot, "awake bodies: %d are too many", (int)rows);
    for (int32_t i = 0; i < rows; ++i) {
        int32_t slot = fe__listed_slot(b->snapshot, FE__TABLE_AWAKE_BODIES, i);
        if (!fe__id_pool_is_alive(&w->body_ids, slot) || is_awake(w, slot) || w->bodies[slot].type == FE_BODY_STATIC ||
            !(w->bodies[slot].flags & FE__BODY_ENABLED))
            return fe__snapshot_refuse(b->snapshot, "awake bodies: %d cannot be", (int)slot);
        w->bodies[slot].awake_index = i;
        w->awake_bodies[w->awake_body_count++] = slot;
    }
    // who has one gets another when the graph is built
    for (int32_t slot = 0; slot < w->body_ids.slot_count; ++slot)
        if (fe__id_pool_is_alive(&w->body_ids, slot) && w->bodies[slot].island >= 0 &&
            !(is_awake(w, slot) && is_dynamic(w, slot)))
            return fe__snapshot_refuse(b->snapshot, "body in slot %d: it is in an island, and not awake", (int)slot);
    return 1;
}

static int32_t take_awake_pairs(fe__build *b)
{
    fe_world *w = b->world;
    for (int32_t i = 0; i < fe__rows_of(b->snapshot, FE__TABLE_AWAKE_PAIRS); ++i) {
        int32_t pair = fe__listed_slot(b->snapshot, FE__TABLE_AWAKE_PAIRS, i);
        if (pair < 1 || pair >= w->pair_limit || w->pairs[pair].flags & FE__PAIR_FREE ||
            w->pairs[pair].awake_index >= 0)
            return fe__snapshot_refuse(b->snapshot, "awake pairs: %d cannot be", (int)pair);
        w->pairs[pair].awake_index = i;
        w->awake_pairs[w->awake_pair_count++] = pair;
        w->awake_linked_count += (w->pairs[pair].flags & FE__PAIR_LINKED) != 0;
    }
    return 1;
}

// Normal, bodies and arms are those of the contact, which nothing has changed since
static int32_t take_deferrals(fe__build *b)
{
    fe_world *w = b->world;
    for (int32_t i = 0; i < fe__rows_of(b->snapshot, FE__TABLE_DEFERRALS); ++i) {
        fe__deferral_row row;
        fe__take_row(b->snapshot, FE__TABLE_DEFERRALS, i, &row);
        const fe__pair *p = row.slot < w->pair_limit ? w->pairs + row.slot : NULL;
        if (!p || p->flags & FE__PAIR_FREE || p->awake_index < 0 || w->awake_pairs[p->awake_index] < 0 ||
            p->flags & (FE__PAIR_PATCH | FE__PAIR_MAY_REPORT) || p->next_patch >= 0 ||
            w->contacts[row.slot].point_count > 0.0f)
            return fe__snapshot_refuse(b->snapshot, "deferred pairs: %d cannot be", (int)row.slot);
        fe__deferral *d = w->deferrals + p->awake_index;
        fe__defer(d, w->odometers, w->bodies, w->contacts + row.slot, row.gap);
        d->gap = row.gap, d->most = row.most;
        memcpy(d->apart, row.apart, sizeof d->apart);
        d->turned_a = w->odometers[d->body_a].turned - row.turned[0];
        d->turned_b = w->odometers[d->body_b].turned - row.turned[1];
        w->awake_pairs[p->awake_index] = ~row.slot;
    }
    return 1;
}

// A pair is awake while one of its bodies is, or to be looked at once. What is in the constraint graph is awake with
// all that moves in it, or not at all
static int32_t check_awake_pair(fe__build *b, int32_t pair)
{
    const fe_world *w = b->world;
    const fe__pair *p = w->pairs + pair;
    int32_t a = is_awake(w, p->body_a), c = is_awake(w, p->body_b), awake = p->awake_index >= 0;
    int32_t linked = (p->flags & FE__PAIR_LINKED) != 0, patch = (p->flags & FE__PAIR_PATCH) != 0;
    int32_t must = (a || c) && (!patch || linked), may = must || (!patch && p->flags & FE__PAIR_ONCE);
    if (awake ? may : !must) {
        if (!linked || !awake) return 1;
        if ((a || !is_dynamic(w, p->body_a)) && (c || !is_dynamic(w, p->body_b))) return 1;
    }
    return fe__snapshot_refuse(b->snapshot, "pair %d: it is %s, its bodies are not", (int)pair,
                               awake ? "awake" : "asleep");
}

static int32_t take_awake_joints(fe__build *b)
{
    fe_world *w = b->world;
    int32_t rows = fe__rows_of(b->snapshot, FE__TABLE_AWAKE_JOINTS), awake = 0;
    if (rows > w->joint_count) return fe__snapshot_refuse(b->snapshot, "awake joints: %d are too many", (int)rows);
    for (int32_t i = 0; i < rows; ++i) {
        int32_t joint = fe__listed_slot(b->snapshot, FE__TABLE_AWAKE_JOINTS, i);
        if (joint < 1 || joint > w->joint_ids.slot_count || w->joint_ids.slots[joint - 1].next != FE_ID_ALIVE ||
            w->joint_records[joint].awake_index >= 0)
            return fe__snapshot_refuse(b->snapshot, "awake joints: %d cannot be", (int)joint);
        w->joint_records[joint].awake_index = i;
        w->awake_joints[w->awake_joint_count++] = joint;
    }
    for (int32_t joint = w->first_joint; joint; joint = w->joint_records[joint].order_next) {
        const fe__joint_record *r = w->joint_records + joint;
        int32_t x = r->body[0], y = r->body[1], linked = w->joints.joints[joint].colour >= 0;
        int32_t some = (is_dynamic(w, x) && is_awake(w, x)) || (is_dynamic(w, y) && is_awake(w, y));
        int32_t all = (!is_dynamic(w, x) || is_awake(w, x)) && (!is_dynamic(w, y) || is_awake(w, y));
        awake += some;
        if (some != (r->awake_index >= 0) || (linked && some != all))
            return fe__snapshot_refuse(b->snapshot, "joint %d: it is awake, its bodies are not", (int)joint);
    }
    return awake == rows || fe__snapshot_refuse(b->snapshot, "awake joints: %d, not %d", (int)rows, (int)awake);
}

int32_t fe__build_awake(fe__build *b)
{
    const fe_world *w = b->world;
    if (!take_awake_bodies(b) || !take_awake_pairs(b) || !take_deferrals(b) || !take_awake_joints(b)) return 0;
    for (int32_t pair = 1; pair < w->pair_limit; ++pair)
        if (!(w->pairs[pair].flags & FE__PAIR_FREE) && !check_awake_pair(b, pair)) return 0;
    return 1;
}

// ---- events ---------------------------------------------------------------------------------------------------------
#define TAKE_EVENTS(build, table, array, used, capacity)                                                \
    do {                                                                                                \
        int32_t rows = fe__rows_of((build)->snapshot, table);                                           \
        if (!FE_RESERVE(fe__memory_of(build), array, capacity, rows)) return fe__lack_memory(build);    \
        for (used = 0; used < rows; ++used) fe__take_row((build)->snapshot, table, used, array + used); \
    } while (0)

int32_t fe__build_events(fe__build *b)
{
    fe_world *w = b->world;
    TAKE_EVENTS(b, FE__TABLE_PAIR_EVENTS, w->pair_events, w->pair_event_count, w->pair_event_capacity);
    TAKE_EVENTS(b, FE__TABLE_BODY_EVENTS, w->body_events, w->body_event_count, w->body_event_capacity);
    TAKE_EVENTS(b, FE__TABLE_HIT_EVENTS, w->hit_events, w->hit_event_count, w->hit_event_capacity);
    TAKE_EVENTS(b, FE__TABLE_JOINT_EVENTS, w->joint_events, w->joint_event_count, w->joint_event_capacity);
    return 1;
}
