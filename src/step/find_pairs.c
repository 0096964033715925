// find_pairs.c - stage 1: which shapes came near each other.
//
// Shapes with a new box (fe_world.moved) ask the trees and the planes; what passes the filter and has no record is a
// candidate. Workers take chunks of one array to write to. What they wrote is sorted by creation, so that neither the
// workers nor the trees show. Nothing of the world is changed before all memory that the step can need is reserved.
#include "step/stages.h"

#include "step/buried.h"
#include "world/contact.h"
#include "world/contact_creation.h"
#include "world/encounter.h"
#include "world/filter.h"
#include "world/mass.h"
#include "world/proxies.h"
#include "world/world.h"
#include "world/world_memory.h"

#include <string.h>

// ---- crowd ----------------------------------------------------------------------------------------------------------
// Bodies that were put into one place: which of their pairs are left out.

// Moves candidates that are left out behind the others, and counts them in fe__step_scratch.left_out. 0: no memory
int32_t fe__thin_crowds(fe__step *step);
// Those look for each other again in the next step
void fe__keep_looking(fe__step *step);

// ---- pairs stage ----------------------------------------------------------------------------------------------------

enum {
    SHAPES_IN_BLOCK = 32,
    CANDIDATES_IN_CHUNK = 64,
    WORD_BITS = 32,
    MANY = 1024,  // boxes that one meets: from here on the search asks who is buried
    MEETINGS = 64 // that wait for what they read: enough to hide the memory's latency, few enough to stay in the cache
};

// Boxes that meet, of which most have a record already: its entry lies anywhere, and is asked for long before it is
// read
typedef struct search {
    const fe_world *world;
    fe__step_scratch *scratch;
    fe__candidate_chunk *chunk;
    int32_t shape;
    int32_t visits;       // boxes that it met in the moving tree
    int32_t meets_buried; // 1: it reports those with a lower index, too, for they do not search
    int32_t waiting;
    fe__candidate met[MEETINGS]; // `shape` then, and the other
} search;

static void add_candidate(search *s, fe__candidate c)
{
    fe__candidate_chunk *chunk = s->chunk;
    if (chunk->at == chunk->end) {
        chunk->at = atomic_fetch_add_explicit(&s->scratch->chunks_end, CANDIDATES_IN_CHUNK, memory_order_relaxed);
        chunk->end = chunk->at + CANDIDATES_IN_CHUNK;
    }
    if (chunk->at < s->scratch->candidate_capacity) s->scratch->candidates[chunk->at] = c;
    ++chunk->at;
}

// Bits, and not the shapes' own flags: those of a thousand shapes are in one cache line or two
static int32_t has_moved(const fe__step_scratch *s, int32_t shape)
{
    return s->moved_bits[shape / WORD_BITS] >> shape % WORD_BITS & 1;
}

static void judge_meetings(search *s)
{
    const fe_world *w = s->world;
    for (int32_t i = 0; i < s->waiting; ++i) {
        int32_t shape = s->met[i].shape_a, other = s->met[i].shape_b;
        if (fe__pair_set_find(&w->pair_set, shape, other) >= 0 || !fe__may_collide(w, shape, other)) continue;
        int32_t first = w->shapes[shape].serial < w->shapes[other].serial;
        add_candidate(s, first ? (fe__candidate){shape, other} : (fe__candidate){other, shape});
    }
    s->waiting = 0;
}

static int32_t wait_for(search *s, int32_t other)
{
    fe__pair_set_fetch(&s->world->pair_set, s->shape, other);
    s->met[s->waiting++] = (fe__candidate){s->shape, other};
    if (s->waiting == MEETINGS) judge_meetings(s);
    return 1;
}

// of two moved shapes the one with the lower index reports
static int32_t found(void *context, int32_t other)
{
    search *s = context;
    if (other <= s->shape && has_moved(s->scratch, other) && !(s->meets_buried && s->scratch->is_buried[other]))
        return 1;
    return wait_for(s, other);
}

// Who meets very many may be buried: all that was found will be searched anew
static int32_t found_of_few(void *context, int32_t other)
{
    search *s = context;
    if (++s->visits <= MANY) return found(context, other);
    atomic_store_explicit(&s->scratch->is_crowd, 1, memory_order_relaxed);
    return 0;
}

static int32_t found_of_buried(void *context, int32_t other)
{
    search *s = context;
    return !s->scratch->is_buried[other] || !has_moved(s->scratch, other) || wait_for(s, other);
}

static int32_t found_by_plane(void *context, int32_t other)
{
    const search *s = context;
    fe__bounds box;
    fe__tree_get(&s->world->moving_tree, other, &box);
    return fe__plane_comes_near(s->world, s->shape, &box) ? found(context, other) : 1;
}

static void search_plane(search *s)
{
    const double far = 1e30; // beyond every box
    fe__bounds all = {{-far, -far, -far}, {far, far, far}};
    fe__tree_query(&s->world->moving_tree, &all, found_by_plane, s);
}

static int32_t is_static(const search *s)
{
    return s->world->bodies[s->world->shapes[s->shape].body].type == FE_BODY_STATIC;
}

// Searches what stands still, for a shape that moves.
static void search_still(search *s)
{
    const fe_world *w = s->world;
    fe__tree_query_proxy(&w->static_tree, &w->moving_tree, s->shape, found, s);
    fe__bounds box;
    if (w->plane_count) fe__tree_get(&w->moving_tree, s->shape, &box);
    for (int32_t i = 0; i < w->plane_count; ++i) {
        if (fe__plane_comes_near(w, w->planes[i], &box)) found(s, w->planes[i]);
    }
}

static void search_tree(search *s, fe__tree_visit visit)
{
    const fe_world *w = s->world;
    int32_t is_still = is_static(s);
    fe__tree_query_proxy(&w->moving_tree, is_still ? &w->static_tree : &w->moving_tree, s->shape, visit, s);
    if (!is_still) search_still(s);
}

static int32_t touches_nothing(const fe__shape *shape) { return (!shape->layer || !shape->mask) && shape->group <= 0; }

static void search_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    search s = {step->world, step->scratch, step->scratch->chunks + worker, 0, 0, 0, 0, {{0}}};
    if (atomic_load_explicit(&s.scratch->is_crowd, memory_order_relaxed)) return;
    for (int32_t i = first; i < end; ++i) {
        s.shape = step->world->moved[i], s.visits = 0;
        const fe__shape *shape = step->world->shapes + s.shape;
        uint32_t flags = shape->flags;
        if (touches_nothing(shape)) continue;
        if (flags & FE__SHAPE_IN_PLANES) search_plane(&s);
        if (flags & FE__SHAPE_IN_TREE) search_tree(&s, fe__may_be_buried(s.world, s.shape) ? found_of_few : found);
    }
    judge_meetings(&s);
}

// Of all shapes, those that moved search, and those that a buried one may have moved to.
static void search_around_buried(search *s)
{
    const fe__shape *shape = s->world->shapes + s->shape;
    int32_t buried = s->scratch->is_buried[s->shape], moved = has_moved(s->scratch, s->shape);
    s->meets_buried = 0;
    if (!(shape->flags & (FE__SHAPE_IN_PLANES | FE__SHAPE_IN_TREE)) || touches_nothing(shape)) return;
    if (shape->flags & FE__SHAPE_IN_PLANES) {
        if (moved) search_plane(s);
    } else if (buried) {
        if (moved) search_still(s);
    } else if (is_static(s)) {
        if (moved) search_tree(s, found);
    } else if (moved) {
        search_still(s);
        s->meets_buried = 1;
        fe__tree_query_proxy(&s->world->moving_tree, &s->world->moving_tree, s->shape, found, s);
    } else if (s->scratch->buried_count) {
        fe__tree_query_proxy(&s->world->moving_tree, &s->world->moving_tree, s->shape, found_of_buried, s);
    }
}

static void search_block_around_buried(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    search s = {step->world, step->scratch, step->scratch->chunks + worker, 0, 0, 0, 0, {{0}}};
    for (s.shape = first; s.shape < end; ++s.shape) {
        search_around_buried(&s);
        judge_meetings(&s);
    }
}

static int32_t reserve_candidates(fe__step *step, int64_t room)
{
    fe__step_scratch *s = step->scratch;
    int32_t workers = step->world->workers.count;
    // the last chunk of each worker may be all but empty
    room += (int64_t)workers * CANDIDATES_IN_CHUNK;
    if (!FE_RENEW(step->world->step_memory, s->candidates, s->candidate_capacity, room)) return 0;
    for (int32_t i = 0; i < workers; ++i) s->chunks[i].at = s->chunks[i].end = 0;
    atomic_store(&s->chunks_end, 0);
    return 1;
}

// Leaves no gap where a worker did not fill its last chunk
static void close_gaps(fe__step *step)
{
    fe__step_scratch *s = step->scratch;
    for (int32_t i = 0; i < step->world->workers.count; ++i)
        for (int32_t k = s->chunks[i].at; k < s->chunks[i].end; ++k) s->candidates[k].shape_a = -1;
    s->candidate_count = 0;
    for (int32_t i = 0, end = atomic_load(&s->chunks_end); i < end; ++i)
        if (s->candidates[i].shape_a >= 0) s->candidates[s->candidate_count++] = s->candidates[i];
}

static void mark_moved(const fe__step *step, uint32_t bit)
{
    const fe_world *w = step->world;
    for (int32_t i = 0; i < w->moved_count; ++i) {
        uint32_t *word = step->scratch->moved_bits + w->moved[i] / WORD_BITS, mask = 1u << w->moved[i] % WORD_BITS;
        *word = bit ? *word | mask : *word & ~mask;
    }
}

// Beyond the capacity it only counts: with more room the search is done again
static int32_t search_few(fe__step *step)
{
    fe__step_scratch *s = step->scratch;
    const fe_world *w = step->world;
    do {
        if (!reserve_candidates(step, atomic_load(&s->chunks_end))) return 0;
        fe__parallel_for(&w->workers, w->moved_count, SHAPES_IN_BLOCK, search_block, step);
    } while (atomic_load(&s->chunks_end) > s->candidate_capacity && !atomic_load(&s->is_crowd));
    if (!atomic_load(&s->is_crowd)) close_gaps(step);
    return 1;
}

static int32_t search_crowd(fe__step *step)
{
    fe__step_scratch *s = step->scratch;
    const fe_world *w = step->world;
    atomic_store(&s->chunks_end, 0);
    if (!fe__find_buried(step)) return 0;
    int64_t beside = (int64_t)FE__BESIDE * s->buried_count;
    do {
        if (!reserve_candidates(step, atomic_load(&s->chunks_end) + beside)) return 0;
        fe__parallel_for(&w->workers, w->shape_ids.slot_count, SHAPES_IN_BLOCK, search_block_around_buried, step);
    } while (atomic_load(&s->chunks_end) + beside > s->candidate_capacity);
    close_gaps(step);
    return fe__find_beside(step);
}

static int32_t search_all(fe__step *step)
{
    fe__step_scratch *s = step->scratch;
    const fe_world *w = step->world;
    if (!FE_RESERVE(step->world->step_memory, s->moved_bits, s->moved_words, w->shape_capacity / WORD_BITS + 1))
        return 0;
    mark_moved(step, 1);
    s->buried_count = 0;
    atomic_store(&s->buried_meetings, 0);
    atomic_store(&s->is_crowd, 0);
    int32_t is_done = search_few(step) && (!atomic_load(&s->is_crowd) || search_crowd(step));
    mark_moved(step, 0);
    return is_done;
}

// by the creation of A, then B
static void sort_candidates(fe__step *step)
{
    fe__step_scratch *s = step->scratch;
    const fe__shape *shapes = step->world->shapes;
    int32_t n = s->candidate_count;
    fe__sort_item *items = fe__sort_room(step);
    for (int32_t pass = 0; pass < 2; ++pass) {
        for (int32_t i = 0; i < n; ++i) {
            if (!pass) items[i].value = s->candidates[i].shape_a, items[i].spare = s->candidates[i].shape_b;
            items[i].key = shapes[pass ? items[i].value : items[i].spare].serial;
        }
        fe__sort_keys(items, n, items + n);
    }
    for (int32_t i = 0; i < n; ++i) s->candidates[i] = (fe__candidate){items[i].value, items[i].spare};
}

// What the host says of a pair, in the order of creation, on this thread
static int32_t is_denied(const fe_world *w, const fe__candidate *c)
{
    const fe__shape *a = w->shapes + c->shape_a, *b = w->shapes + c->shape_b;
    if (!w->pair_filter || !((a->flags | b->flags) & FE__SHAPE_JUDGED)) return 0;
    const fe__encounter *known =
        a->parent >= 0 || b->parent >= 0 ? fe__find_encounter(w, c->shape_a, c->shape_b) : NULL;
    if (known) return known->denied;
    fe_filter_pair pair = {.body_a = fe__body_handle(w, a->body),
                           .body_b = fe__body_handle(w, b->body),
                           .shape_a = fe__shape_handle(w, c->shape_a),
                           .shape_b = fe__shape_handle(w, c->shape_b),
                           .body_user_data_a = w->bodies[a->body].user_data,
                           .body_user_data_b = w->bodies[b->body].user_data,
                           .shape_user_data_a = w->shapes[fe__whole_shape(w->shapes, c->shape_a)].user_data,
                           .shape_user_data_b = w->shapes[fe__whole_shape(w->shapes, c->shape_b)].user_data};
    return w->pair_filter(w->pair_filter_user, &pair) == 0;
}

void fe__find_new_pairs(fe__step *step)
{
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    fe__settle_sizes(w);
    step->failed = !search_all(step) || !fe__thin_crowds(step);
    if (step->failed) return;
    step->failed = !fe__find_due(step) || !fe__reserve_step(step);
    fe__keep_waiting(step);
    if (step->failed) return;
    sort_candidates(step);
    for (int32_t i = 0; i < s->candidate_count; ++i)
        fe__pair_create(w, s->candidates[i].shape_a, s->candidates[i].shape_b, is_denied(w, s->candidates + i));
    for (int32_t i = 0; i < w->moved_count; ++i) w->shapes[w->moved[i]].flags &= ~(uint32_t)FE__SHAPE_MOVED;
    w->moved_count = 0;
    fe__keep_looking(step);
    fe__buried_keep_looking(step);
}

// ---- crowd ----------------------------------------------------------------------------------------------------------
// See stages.h. n bodies born in one point have n (n - 1) / 2 pairs: a mistake of the host that would take all
// memory and minutes of time. A body is crowded when it has more than MOST pairs with dynamic bodies. Of the pairs of
// two crowded bodies, each keeps its KEPT deepest, and one that either of them keeps is made. So a body that carries a
// thousand others, which are not crowded, keeps them all.
//
// How deep: by how much the boxes of the two shapes overlap. Among equals, as in a point, those that were created next
// to each other come first: each body then keeps others than its neighbour, and nobody has all.

// With MOST contacts each, two bodies have colours enough for one between them. Who keeps KEPT is kept by as many
// others, and has MOST together: so a crowd finds colours too.
enum { MOST = FE__PAIR_COLOURS / 2, KEPT = MOST / 2 };

static int32_t counts(const fe_world *w, const fe__candidate *c)
{
    const fe__shape *a = w->shapes + c->shape_a, *b = w->shapes + c->shape_b;
    return w->bodies[a->body].type == FE_BODY_DYNAMIC && w->bodies[b->body].type == FE_BODY_DYNAMIC &&
           !((a->flags | b->flags) & FE__SHAPE_TRIGGER);
}

static fe__body *body_of(const fe_world *w, int32_t shape) { return w->bodies + w->shapes[shape].body; }

// fe__body.coming_contacts: so many candidates; of a crowded body ~place in the list of those
static int32_t is_crowded(const fe__body *body) { return body->coming_contacts < 0; }

// Whose shape is buried is crowded, however few of those that it meets were found
static int32_t is_among_many(const fe__step *step, const fe__body *body, int32_t shape)
{
    const fe__step_scratch *s = step->scratch;
    return body->coming_contacts + body->contact_count > MOST || (s->buried_count && s->is_buried[shape]);
}

static int32_t any_crowd(const fe__step *step)
{
    const fe_world *w = step->world;
    int32_t any = 0;
    for (int32_t i = 0; i < step->scratch->candidate_count; ++i) {
        const fe__candidate *c = step->scratch->candidates + i;
        if (!counts(w, c)) continue;
        fe__body *a = body_of(w, c->shape_a), *b = body_of(w, c->shape_b);
        ++a->coming_contacts, ++b->coming_contacts;
        any |= is_among_many(step, a, c->shape_a) || is_among_many(step, b, c->shape_b);
    }
    return any;
}

static void forget(const fe__step *step)
{
    for (int32_t i = 0; i < step->scratch->candidate_count; ++i) {
        const fe__candidate *c = step->scratch->candidates + i;
        body_of(step->world, c->shape_a)->coming_contacts = body_of(step->world, c->shape_b)->coming_contacts = 0;
    }
}

static int32_t list_crowded(const fe__step *step)
{
    const fe_world *w = step->world;
    int32_t count = 0;
    for (int32_t i = 0; i < 2 * step->scratch->candidate_count; ++i) {
        const fe__candidate *c = step->scratch->candidates + i / 2;
        int32_t shape = i % 2 ? c->shape_b : c->shape_a;
        fe__body *body = body_of(w, shape);
        if (is_crowded(body) || body->type != FE_BODY_DYNAMIC || !is_among_many(step, body, shape)) continue;
        body->coming_contacts = ~count++;
    }
    return count;
}

// ---- the deepest of each body --------------------------------------------------------------------------------------
// How many more pairs with crowded bodies it may have
static int32_t room_of(const fe_world *w, const fe__body *body)
{
    int32_t index = (int32_t)(body - w->bodies), room = KEPT;
    for (int32_t pair = body->first_contact; pair >= 0; pair = fe__next_pair(w, pair, index)) {
        const fe__pair *p = w->pairs + pair;
        room -= is_crowded(w->bodies + (p->body_a == index ? p->body_b : p->body_a));
    }
    return fe__maxi(room, 0);
}

static void prepare_crowd(const fe__step *step)
{
    const fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    for (int32_t i = 0; i < 2 * s->candidate_count; ++i) {
        const fe__candidate *c = s->candidates + i / 2;
        int32_t shape = i % 2 ? c->shape_b : c->shape_a;
        const fe__body *body = body_of(w, shape);
        if (!is_crowded(body) || s->crowd[~body->coming_contacts].shape == shape) continue;
        fe__crowded *place = s->crowd + ~body->coming_contacts;
        if (place->shape < 0) place->room = room_of(w, body);
        place->shape = shape;
        s->boxes[shape] = fe__shape_bounds(w, shape, 0.0f);
    }
}

// m, 0 where they do not overlap
static float depth_of(const fe__bounds *a, const fe__bounds *b)
{
    double x = fe__mind(a->high.x, b->high.x) - fe__maxd(a->low.x, b->low.x),
           y = fe__mind(a->high.y, b->high.y) - fe__maxd(a->low.y, b->low.y),
           z = fe__mind(a->high.z, b->high.z) - fe__maxd(a->low.z, b->low.z);
    return fe__maxf((float)fe__mind(x, fe__mind(y, z)), 0.0f);
}

// The larger, the dearer to the body of `own`: bits of the depth, then those of the distance of the serials
static uint64_t rank(float depth, uint64_t own, uint64_t other)
{
    const uint64_t most = UINT32_MAX;
    uint64_t distance = other > own ? 2 * (other - own) : 2 * (own - other) + 1;
    uint32_t bits;
    memcpy(&bits, &depth, sizeof bits);
    return (uint64_t)bits << 32 | (most - (distance < most ? distance : most));
}

// A heap whose root is the least dear. Of equals, as bodies of several shapes have them, the pair created first is the
// dearer
static int32_t is_less(const fe__step *step, fe__favourite x, fe__favourite y)
{
    const fe__shape *shapes = step->world->shapes;
    const fe__candidate *a = step->scratch->candidates + x.candidate, *b = step->scratch->candidates + y.candidate;
    if (x.rank != y.rank) return x.rank < y.rank;
    if (a->shape_a != b->shape_a) return shapes[a->shape_a].serial > shapes[b->shape_a].serial;
    return shapes[a->shape_b].serial > shapes[b->shape_b].serial;
}

static void sink(const fe__step *step, fe__favourite *heap, int32_t count, fe__favourite item)
{
    int32_t at = 0;
    for (int32_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && is_less(step, heap[child + 1], heap[child])) ++child;
        if (!is_less(step, heap[child], item)) break;
        heap[at] = heap[child];
    }
    heap[at] = item;
}

static void rise(const fe__step *step, fe__favourite *heap, int32_t at, fe__favourite item)
{
    for (; at > 0 && is_less(step, item, heap[(at - 1) / 2]); at = (at - 1) / 2) heap[at] = heap[(at - 1) / 2];
    heap[at] = item;
}

static void offer(const fe__step *step, const fe__body *body, fe__favourite item)
{
    fe__step_scratch *s = step->scratch;
    fe__crowded *place = s->crowd + ~body->coming_contacts;
    fe__favourite *heap = s->favourites + (int64_t)KEPT * ~body->coming_contacts;
    if (place->count < place->room)
        rise(step, heap, place->count++, item);
    else if (place->room && is_less(step, heap[0], item))
        sink(step, heap, place->count, item);
}

static int32_t is_in_crowd(const fe_world *w, const fe__candidate *c)
{
    return counts(w, c) && is_crowded(body_of(w, c->shape_a)) && is_crowded(body_of(w, c->shape_b));
}

static void find_favourites(const fe__step *step)
{
    const fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    for (int32_t i = 0; i < s->candidate_count; ++i) {
        const fe__candidate *c = s->candidates + i;
        if (!is_in_crowd(w, c)) continue;
        uint64_t a = w->shapes[c->shape_a].serial >> FE__PART_BITS, b = w->shapes[c->shape_b].serial >> FE__PART_BITS;
        float depth = depth_of(s->boxes + c->shape_a, s->boxes + c->shape_b);
        offer(step, body_of(w, c->shape_a), (fe__favourite){rank(depth, a, b), i});
        offer(step, body_of(w, c->shape_b), (fe__favourite){rank(depth, b, a), i});
    }
}

// ---- who is left out -----------------------------------------------------------------------------------------------
// Candidates to keep get the complement of their shape A; the others change places with them
static void leave_out(const fe__step *step, int32_t crowded)
{
    const fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    fe__candidate *c = s->candidates;
    for (int32_t i = 0; i < s->candidate_count; ++i)
        if (!is_in_crowd(w, c + i)) c[i].shape_a = ~c[i].shape_a;
    for (int32_t k = 0; k < crowded; ++k) {
        for (int32_t i = 0; i < s->crowd[k].count; ++i) {
            fe__candidate *kept = c + s->favourites[(int64_t)KEPT * k + i].candidate;
            if (kept->shape_a >= 0) kept->shape_a = ~kept->shape_a;
        }
    }
    int32_t count = 0;
    for (int32_t i = 0; i < s->candidate_count; ++i) {
        if (c[i].shape_a >= 0) continue;
        fe__candidate kept = {~c[i].shape_a, c[i].shape_b};
        c[i] = c[count], c[count++] = kept;
    }
    s->left_out = s->candidate_count - count;
}

int32_t fe__thin_crowds(fe__step *step)
{
    const fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    fe__memory *memory = step->world->step_memory;
    s->left_out = 0;
    int32_t is_done = 1;
    if (any_crowd(step)) {
        int32_t crowded = list_crowded(step);
        is_done = FE_RESERVE(memory, s->crowd, s->crowd_capacity, crowded) &&
                  FE_RESERVE(memory, s->favourites, s->favourite_capacity, (int64_t)KEPT * crowded) &&
                  FE_RESERVE(memory, s->boxes, s->box_capacity, w->shape_capacity);
        for (int32_t k = 0; k < crowded && is_done; ++k) s->crowd[k] = (fe__crowded){.shape = -1};
        if (is_done) {
            prepare_crowd(step);
            find_favourites(step);
            leave_out(step, crowded);
        }
    }
    forget(step);
    s->candidate_count -= s->left_out;
    return is_done;
}

void fe__keep_looking(fe__step *step)
{
    fe_world *w = step->world;
    const fe__candidate *c = step->scratch->candidates + step->scratch->candidate_count;
    for (int32_t i = 0; i < step->scratch->left_out; ++i) {
        const fe__body *a = body_of(w, c[i].shape_a), *b = body_of(w, c[i].shape_b);
        if (a->awake_index < 0 && b->awake_index < 0) continue;
        fe__shape_mark_moved(w, c[i].shape_a);
    }
}
