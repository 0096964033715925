// restore_contacts.c - pairs out of a snapshot: their slots, shapes, contacts, points, and the lists of the bodies.
#include "collision/manifold/patch.h"
#include "snapshot/restore.h"
#include "solver/graph/graph.h"
#include "world/contact.h"
#include "world/contact_creation.h"
#include "world/encounter.h"
#include "world/filter.h"
#include "world/joint.h"

#include <string.h>

// ---- build pairs ----------------------------------------------------------------------------------------------------

static int32_t refuse_pair(fe__build *b, int32_t pair, const char *why)
{
    return fe__snapshot_refuse(b->snapshot, "pair %d: %s", (int)pair, why);
}

// ---- slots: free, of an owed exit, or of a pair. fe__pair.result says which, until all are known --------------------
enum { SLOT_UNKNOWN, SLOT_OF_NONE };
enum { UNMET = -2 }; // fe__link.previous, until the list was followed to it

static int32_t claim_slot(fe__build *b, int32_t slot, int32_t limit)
{
    if (slot < 1 || slot >= limit || b->world->pairs[slot].result != SLOT_UNKNOWN)
        return fe__snapshot_refuse(b->snapshot, "pairs: slot %d is not free", (int)slot);
    memset(b->world->contacts + slot, 0, sizeof *b->world->contacts);
    b->world->pairs[slot].result = SLOT_OF_NONE;
    b->world->pairs[slot].flags = FE__PAIR_FREE;
    return 1;
}

static int32_t take_free(fe__build *b, int32_t limit)
{
    fe_world *w = b->world;
    for (int32_t i = fe__rows_of(b->snapshot, FE__TABLE_FREE_PAIRS) - 1; i >= 0; --i) {
        int32_t slot = fe__listed_slot(b->snapshot, FE__TABLE_FREE_PAIRS, i);
        if (!claim_slot(b, slot, limit)) return 0;
        w->pairs[slot].links[0].next = w->first_free_pair;
        w->first_free_pair = slot;
    }
    return 1;
}

static int32_t take_owed(fe__build *b, int32_t limit)
{
    fe_world *w = b->world;
    for (int32_t i = fe__rows_of(b->snapshot, FE__TABLE_OWED) - 1; i >= 0; --i) {
        fe__owed_row row;
        memset(&row, 0, sizeof row);
        fe__take_row(b->snapshot, FE__TABLE_OWED, i, &row);
        if (!claim_slot(b, row.slot, limit)) return 0;
        memcpy(w->contacts + row.slot, &row.exit, sizeof row.exit);
        w->pairs[row.slot].links[0].next = w->first_owed;
        w->first_owed = row.slot;
        ++w->owed_count;
    }
    return 1;
}

// ---- one pair ------------------------------------------------------------------------------------------------------
static int32_t is_in_broad_phase(const fe_world *w, int32_t shape)
{
    return shape < w->shape_ids.slot_count && w->shapes[shape].flags & (FE__SHAPE_IN_TREE | FE__SHAPE_IN_PLANES);
}

enum {
    BY_NATURE = FE__PAIR_SENSOR | FE__PAIR_FLIPPED | FE__PAIR_SWAPPED | FE__PAIR_PATCH | FE__PAIR_OF_PARTS,
    BY_STATE =
        FE__PAIR_TOUCHING | FE__PAIR_LINKED | FE__PAIR_ONCE | FE__PAIR_CROSSED | FE__PAIR_DENIED | FE__PAIR_PASSING
};

static int32_t check_shapes(fe__build *b, int32_t pair)
{
    fe_world *w = b->world;
    fe__pair *p = w->pairs + pair;
    if (!is_in_broad_phase(w, p->shape_a) || !is_in_broad_phase(w, p->shape_b))
        return refuse_pair(b, pair, "one of its shapes is not there");
    const fe__shape *x = w->shapes + p->shape_a, *y = w->shapes + p->shape_b;
    if (x->serial >= y->serial || x->body == y->body || x->flags & y->flags & FE__SHAPE_IN_PLANES)
        return refuse_pair(b, pair, "such shapes make none");
    p->body_a = x->body, p->body_b = y->body;
    if (w->bodies[p->body_a].type == FE_BODY_STATIC && w->bodies[p->body_b].type == FE_BODY_STATIC)
        return refuse_pair(b, pair, "both bodies are static");
    if (fe__form_is_field(&x->form) && fe__form_is_field(&y->form))
        return refuse_pair(b, pair, "two surfaces of triangles never meet");
    uint32_t number = p->flags >> FE__PAIR_NUMBER_SHIFT, known = (uint32_t)BY_NATURE | (uint32_t)BY_STATE;
    if (number >= FE__PATCHES || p->flags << FE__PAIR_NUMBER_SHIFT >> FE__PAIR_NUMBER_SHIFT & ~known ||
        (p->flags & ~(uint32_t)BY_STATE) != fe__pair_nature(w, p->shape_a, p->shape_b, (int32_t)number))
        return refuse_pair(b, pair, "its flags are not those of its shapes");
    return 1;
}

static int32_t is_triangle(const fe_store *store, const fe__form *form, int32_t triangle)
{
    const fe__asset *a = fe__store_asset(store, form->field);
    if (a->kind == FE__ASSET_MESH)
        return triangle < a->mesh.given_count && fe__mesh_slot(&a->mesh, triangle) < a->mesh.triangle_count;
    int64_t cells = (int64_t)(a->field.rows - 1) * (a->field.columns - 1);
    return triangle / 2 < cells && !fe__heightfield_is_hole(&a->field, triangle / 2);
}

static int32_t check_triangle(fe__build *b, int32_t pair)
{
    const fe_world *w = b->world;
    const fe__pair *p = w->pairs + pair;
    const fe__form *x = &w->shapes[p->shape_a].form, *y = &w->shapes[p->shape_b].form;
    if (p->triangle < 0) return 1;
    const fe__form *field = fe__form_is_field(x) ? x : fe__form_is_field(y) ? y : NULL;
    return (field && is_triangle(w->store, field, p->triangle)) || refuse_pair(b, pair, "it is on no such triangle");
}

// ---- its contact, and its points where it has some ------------------------------------------------------------------
typedef struct taken { // rows so far
    int32_t pairs, patches, points;
    int64_t links; // in lists of bodies
} taken;

static int32_t check_contact(fe__build *b, int32_t pair)
{
    fe_world *w = b->world;
    const fe__pair *p = w->pairs + pair;
    fe__contact *m = w->contacts + pair;
    int32_t flipped = (p->flags & FE__PAIR_FLIPPED) != 0, linked = (p->flags & FE__PAIR_LINKED) != 0;
    m->body_a = flipped ? p->body_b : p->body_a, m->body_b = flipped ? p->body_a : p->body_b;
    m->kind = fe__pair_kind(w, p->shape_a, p->shape_b);
    if (linked != (m->colour >= 0) || (linked && p->flags & (FE__PAIR_SENSOR | FE__PAIR_DENIED)))
        return refuse_pair(b, pair, "it is in the constraint graph without a colour, or the other way round");
    if (linked && w->bodies[m->body_b].type != FE_BODY_DYNAMIC) return refuse_pair(b, pair, "nothing in it can move");
    if (!(w->row_kinds >> m->kind & 1)) return refuse_pair(b, pair, "there are no rows of the kind of its shapes");
    if (linked && !fe__recolour_contact(w->bodies, m)) return refuse_pair(b, pair, "its colour is taken");
    return 1;
}

static void take_points(fe__build *b, int32_t pair, const fe__touching_row *row, int32_t number)
{
    fe_world *w = b->world;
    fe__contact *m = w->contacts + pair;
    int32_t points = m->points = number + 1;
    m->colour = row->colour;
    m->point_count = row->point_count;
    memcpy(m->span, row->span, sizeof m->span);
    w->pairs[pair].left_out = (uint8_t)row->left_out;
    fe__take_row(b->snapshot, FE__TABLE_POINTS, number, w->points + points);
    fe__take_row(b->snapshot, FE__TABLE_FEATURES, number, w->features + points);
    if (fe__rows_of(b->snapshot, FE__TABLE_EXTRAS))
        fe__take_row(b->snapshot, FE__TABLE_EXTRAS, number, w->extras + points);
    for (int32_t side = 0; side < 2; ++side) w->point_serials[2 * points + side] = fe__pair_serial(w, pair, side);
}

static void take_contact(fe__build *b, int32_t pair, taken *t)
{
    fe__contact *m = b->world->contacts + pair;
    memset(m, 0, sizeof *m);
    m->colour = -1;
    fe__take_row(b->snapshot, FE__TABLE_FOUND, t->pairs, m);
    if (t->points == fe__rows_of(b->snapshot, FE__TABLE_TOUCHING)) return;
    fe__touching_row row;
    fe__take_row(b->snapshot, FE__TABLE_TOUCHING, t->points, &row);
    if (row.slot == pair) take_points(b, pair, &row, t->points++);
}

static void take_patch(fe__build *b, int32_t pair, taken *t)
{
    fe__pair *p = b->world->pairs + pair;
    p->awake_index = p->next_patch = p->head = p->triangle = -1;
    if (t->patches == fe__rows_of(b->snapshot, FE__TABLE_PATCHES)) return;
    fe__patch_row row;
    fe__take_row(b->snapshot, FE__TABLE_PATCHES, t->patches, &row);
    if (row.slot != pair) return;
    p->next_patch = row.next_patch, p->head = row.head, p->triangle = row.triangle;
    ++t->patches;
}

// Heads, and the patches that are linked
static int32_t is_listed(const fe__pair *p) { return !(p->flags & FE__PAIR_PATCH) || p->flags & FE__PAIR_LINKED; }

static int32_t take_pair(fe__build *b, int32_t pair, taken *t)
{
    fe_world *w = b->world;
    fe__pair *p = w->pairs + pair;
    fe__take_row(b->snapshot, FE__TABLE_PAIRS, t->pairs, p);
    take_patch(b, pair, t);
    if (!check_shapes(b, pair) || !check_triangle(b, pair)) return 0;
    take_contact(b, pair, t);
    if (!check_contact(b, pair)) return 0;
    p->events = (uint8_t)(w->shapes[p->shape_a].events | w->shapes[p->shape_b].events);
    p->links[0].previous = p->links[1].previous = is_listed(p) ? UNMET : -1;
    t->links += is_listed(p) ? 2 : 0;
    fe__pair_note_colour(w, w->contacts + pair);
    w->linked_count += w->contacts[pair].colour >= 0;
    ++t->pairs;
    return 1;
}

static int32_t take_pairs(fe__build *b, int32_t rows, taken *t)
{
    fe_world *w = b->world;
    fe__snapshot *s = b->snapshot;
    for (int32_t pair = 1; pair < w->pair_limit; ++pair)
        if (w->pairs[pair].result == SLOT_UNKNOWN && !take_pair(b, pair, t)) return 0;
    atomic_store(&w->point_count, t->points + 1);
    if (t->pairs != rows || t->points != fe__rows_of(s, FE__TABLE_TOUCHING))
        return fe__snapshot_refuse(s, "points: there are some of no pair, or not in the order of pairs");
    return t->patches == fe__rows_of(s, FE__TABLE_PATCHES) ||
           fe__snapshot_refuse(s, "patches: there are some of no pair, or not in the order of pairs");
}

// ---- heads and patches ---------------------------------------------------------------------------------------------
static int32_t check_patches(fe__build *b, int32_t head)
{
    const fe_world *w = b->world;
    const fe__pair *h = w->pairs + head;
    int32_t number = 1, patch = h->next_patch;
    for (; patch >= 0; patch = w->pairs[patch].next_patch, ++number) {
        const fe__pair *p = w->pairs + patch;
        if (patch >= w->pair_limit || number >= FE__PATCHES || p->flags & FE__PAIR_FREE || p->head != head ||
            (int32_t)(p->flags >> FE__PAIR_NUMBER_SHIFT) != number || p->shape_a != h->shape_a ||
            p->shape_b != h->shape_b)
            return refuse_pair(b, head, "its patches are not its own");
    }
    int32_t has_patches = fe__is_field_pair(w, h->shape_a, h->shape_b) && !(h->flags & FE__PAIR_DENIED);
    return number == (has_patches ? FE__PATCHES : 1) || refuse_pair(b, head, "it lacks patches");
}

static int32_t count_head(fe__build *b, int32_t head)
{
    fe_world *w = b->world;
    const fe__pair *p = w->pairs + head;
    if (!check_patches(b, head)) return 0;
    if (p->head != -1) return refuse_pair(b, head, "it has a head");
    if (!fe__pair_set_add(&w->pair_set, p->shape_a, p->shape_b, head))
        return refuse_pair(b, head, "its shapes have another one");
    int32_t contacts = p->next_patch >= 0 ? FE__PATCHES : 1;
    const int32_t ends[2] = {p->body_a, p->body_b};
    int32_t with_static = w->bodies[ends[0]].type == FE_BODY_STATIC || w->bodies[ends[1]].type == FE_BODY_STATIC;
    for (int k = 0; k < 2; ++k)
        w->bodies[ends[k]].contact_count += contacts, w->bodies[ends[k]].static_pairs += with_static;
    ++w->pair_count;
    w->field_pair_count += contacts > 1;
    w->trigger_pair_count += (p->flags & FE__PAIR_SENSOR) != 0;
    return 1;
}

static int32_t count_heads(fe__build *b, int32_t rows)
{
    const fe_world *w = b->world;
    int32_t heads = 0;
    if (!fe__pair_set_reserve(&b->world->pair_set, fe__memory_of(b), rows)) return fe__lack_memory(b);
    for (int32_t pair = 1; pair < w->pair_limit; ++pair) {
        if (w->pairs[pair].flags & (FE__PAIR_FREE | FE__PAIR_PATCH)) continue;
        if (!count_head(b, pair)) return 0;
        heads += w->pairs[pair].next_patch >= 0 ? FE__PATCHES : 1;
    }
    return heads == rows || fe__snapshot_refuse(b->snapshot, "pairs: a patch has no head");
}

// ---- lists of bodies ------------------------------------------------------------------------------------------------
static int32_t follow_list(fe__build *b, int32_t body, int64_t *met)
{
    fe_world *w = b->world;
    int32_t previous = -1;
    for (int32_t pair = w->bodies[body].first_contact; pair >= 0;) {
        if (pair == 0 || pair >= w->pair_limit || w->pairs[pair].flags & FE__PAIR_FREE || !is_listed(w->pairs + pair))
            return fe__snapshot_refuse(b->snapshot, "body in slot %d: its list leads to no pair", (int)body);
        fe__pair *p = w->pairs + pair;
        fe__link *link = p->body_a == body ? p->links : p->links + 1;
        if ((p->body_a != body && p->body_b != body) || link->previous != UNMET)
            return fe__snapshot_refuse(b->snapshot, "body in slot %d: its list leads astray", (int)body);
        link->previous = previous, previous = pair;
        pair = link->next;
        ++*met;
    }
    return 1;
}

static int32_t follow_lists(fe__build *b, int64_t links)
{
    const fe_world *w = b->world;
    int64_t met = 0;
    for (int32_t body = 0; body < w->body_ids.slot_count; ++body)
        if (w->body_ids.slots[body].next == FE_ID_ALIVE && !follow_list(b, body, &met)) return 0;
    return met == links || fe__snapshot_refuse(b->snapshot, "pairs: one is in no list");
}

// ---- all -----------------------------------------------------------------------------------------------------------
static int32_t check_rows(fe__build *b, const fe__world_row *row)
{
    fe__snapshot *s = b->snapshot;
    int64_t rows = fe__rows_of(s, FE__TABLE_PAIRS), limit = row->pair_limit;
    int32_t points = fe__rows_of(s, FE__TABLE_TOUCHING);
    if (rows != fe__rows_of(s, FE__TABLE_FOUND) ||
        limit != 1 + rows + fe__rows_of(s, FE__TABLE_FREE_PAIRS) + fe__rows_of(s, FE__TABLE_OWED))
        return fe__snapshot_refuse(s, "pairs: %lld rows do not fill %lld slots", (long long)rows, (long long)limit);
    if (points != fe__rows_of(s, FE__TABLE_POINTS) || points != fe__rows_of(s, FE__TABLE_FEATURES) ||
        fe__rows_of(s, FE__TABLE_EXTRAS) != (row->has_extras ? points : 0))
        return fe__snapshot_refuse(s, "points: tables of one thing have not as many rows");
    return 1;
}

// Record 0 of contacts, points and features is none, and zeros
static int32_t open_arrays(fe__build *b, const fe__world_row *row)
{
    fe_world *w = b->world;
    fe__memory *memory = fe__memory_of(b);
    int32_t limit = row->pair_limit, points = fe__rows_of(b->snapshot, FE__TABLE_TOUCHING);
    if (!FE_OPEN(memory, w->contacts, w->contact_capacity, limit) ||
        !FE_RESERVE(memory, w->pairs, w->pair_capacity, limit) ||
        !FE_RESERVE(memory, w->awake_pairs, w->awake_pair_capacity, limit) ||
        !FE_RESERVE(memory, w->deferrals, w->deferral_capacity, limit) ||
        !FE_OPEN(memory, w->points, w->point_capacity, (int64_t)points + 1) ||
        !FE_OPEN(memory, w->features, w->feature_capacity, (int64_t)points + 1) ||
        !fe__points_reserve(w, points, row->has_extras))
        return fe__lack_memory(b);
    memset(w->contacts, 0, sizeof *w->contacts);
    memset(w->points, 0, sizeof *w->points);
    memset(w->features, 0, sizeof *w->features);
    return 1;
}

int32_t fe__build_pairs(fe__build *b, const fe__world_row *row)
{
    fe_world *w = b->world;
    int32_t rows = fe__rows_of(b->snapshot, FE__TABLE_PAIRS);
    taken t = {.links = 0};
    if (!check_rows(b, row) || !open_arrays(b, row) || !take_free(b, row->pair_limit) || !take_owed(b, row->pair_limit))
        return 0;
    w->pair_limit = row->pair_limit;
    return take_pairs(b, rows, &t) && count_heads(b, rows) && follow_lists(b, t.links);
}

// ---- build lists ----------------------------------------------------------------------------------------------------
// Ignored bodies, encounters, who is awake, and events, out of a snapshot.

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
