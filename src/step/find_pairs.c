// find_pairs.c - stage 1: which shapes came near each other.
//
// Shapes with a new box (fe_world.moved) ask the trees and the planes. Two shapes that pass the filter and have no
// record yet are a candidate. Workers take chunks of one array to write to; what they wrote is sorted by creation, so
// that neither the workers nor the trees show. The world does not change before all memory that the step can need is
// reserved (reserve.c). Then each candidate gets its record, which update_contacts.c looks at.
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

// ---- search ---------------------------------------------------------------------------------------------------------

enum {
    SHAPES_IN_BLOCK = 32,
    CANDIDATES_IN_CHUNK = 64,
    WORD_BITS = 32,
    MANY_VISITS = 1024, // a shape that meets more boxes than this makes the search look for buried shapes
    QUEUE_CAPACITY = 64 // long enough to hide the memory's latency, short enough to stay in the cache
};

// The search of one worker. Most boxes that meet have a record already, whose entry in the pair set lies anywhere in
// memory. So meetings are queued while their entries are fetched, and judged when the queue is full.
typedef struct search {
    const fe_world *world;
    fe__step_scratch *scratch;
    fe__candidate_chunk *chunk;
    int32_t shape;        // that searches now
    int32_t visits;       // boxes that it met in the moving tree
    int32_t meets_buried; // 1: it reports buried shapes with a lower index, too, because they do not search
    int32_t queued;
    fe__candidate queue[QUEUE_CAPACITY]; // in shape_a the shape that searched
} search;

// These bits say what the shapes' own flags say too, but a thousand of them lie in one or two cache lines.
static int32_t has_moved(const fe__step_scratch *scratch, int32_t shape)
{
    return scratch->moved_bits[shape / WORD_BITS] >> shape % WORD_BITS & 1;
}

static void judge_queue(search *s)
{
    const fe_world *world = s->world;
    fe__candidate_chunk *chunk = s->chunk;
    for (int32_t i = 0; i < s->queued; ++i) {
        int32_t shape = s->queue[i].shape_a, other = s->queue[i].shape_b;
        if (fe__pair_set_find(&world->pair_set, shape, other) >= 0 || !fe__may_collide(world, shape, other)) continue;
        if (chunk->at == chunk->end) {
            chunk->at = atomic_fetch_add_explicit(&s->scratch->chunks_end, CANDIDATES_IN_CHUNK, memory_order_relaxed);
            chunk->end = chunk->at + CANDIDATES_IN_CHUNK;
        }
        int32_t is_first = world->shapes[shape].serial < world->shapes[other].serial;
        if (chunk->at < s->scratch->candidate_capacity)
            s->scratch->candidates[chunk->at] =
                is_first ? (fe__candidate){shape, other} : (fe__candidate){other, shape};
        ++chunk->at;
    }
    s->queued = 0;
}

static void queue_meeting(search *s, int32_t other)
{
    fe__pair_set_fetch(&s->world->pair_set, s->shape, other);
    s->queue[s->queued++] = (fe__candidate){s->shape, other};
    if (s->queued == QUEUE_CAPACITY) judge_queue(s);
}

// Visits of a tree's boxes (fe__tree_visit) return 0 to end the walk.

static int32_t visit(void *context, int32_t other)
{
    search *s = context;
    // the one with the lower index reports, if both moved and search
    int32_t other_reports =
        other <= s->shape && has_moved(s->scratch, other) && !(s->meets_buried && s->scratch->is_buried[other]);
    if (!other_reports) queue_meeting(s, other);
    return 1;
}

// Ends the whole search at a shape that meets too many others: then all is searched anew, see search_crowd.
static int32_t visit_until_crowd(void *context, int32_t other)
{
    search *s = context;
    if (++s->visits <= MANY_VISITS) return visit(context, other);
    atomic_store_explicit(&s->scratch->is_crowd, 1, memory_order_relaxed);
    return 0;
}

static int32_t visit_moved_buried(void *context, int32_t other)
{
    search *s = context;
    if (s->scratch->is_buried[other] && has_moved(s->scratch, other)) queue_meeting(s, other);
    return 1;
}

static int32_t visit_near_plane(void *context, int32_t other)
{
    const search *s = context;
    fe__bounds box;
    fe__tree_get(&s->world->moving_tree, other, &box);
    return fe__plane_comes_near(s->world, s->shape, &box) ? visit(context, other) : 1;
}

// A plane has no box: it looks at every box of the moving tree.
static void search_from_plane(search *s)
{
    const double far = 1e30; // beyond every box
    fe__bounds all = {{-far, -far, -far}, {far, far, far}};
    fe__tree_query(&s->world->moving_tree, &all, visit_near_plane, s);
}

// Searches among static shapes, for a shape that moves.
static void search_static(search *s)
{
    const fe_world *world = s->world;
    fe__tree_query_proxy(&world->static_tree, &world->moving_tree, s->shape, visit, s);
    fe__bounds box;
    if (world->plane_count) fe__tree_get(&world->moving_tree, s->shape, &box);
    for (int32_t i = 0; i < world->plane_count; ++i)
        if (fe__plane_comes_near(world, world->planes[i], &box)) visit(s, world->planes[i]);
}

static void search_trees(search *s, fe__tree_visit visit_moving)
{
    const fe_world *world = s->world;
    int32_t is_static = world->bodies[world->shapes[s->shape].body].type == FE_BODY_STATIC;
    const fe__tree *own_tree = is_static ? &world->static_tree : &world->moving_tree;
    fe__tree_query_proxy(&world->moving_tree, own_tree, s->shape, visit_moving, s);
    if (!is_static) search_static(s);
}

static int32_t collides_with_nothing(const fe__shape *shape)
{
    return (!shape->layer || !shape->mask) && shape->group <= 0;
}

static void search_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    search s = {step->world, step->scratch, step->scratch->chunks + worker, 0, 0, 0, 0, {{0}}};
    if (atomic_load_explicit(&s.scratch->is_crowd, memory_order_relaxed)) return;
    for (int32_t i = first; i < end; ++i) {
        s.shape = step->world->moved[i], s.visits = 0;
        const fe__shape *shape = step->world->shapes + s.shape;
        uint32_t flags = shape->flags;
        if (collides_with_nothing(shape)) continue;
        if (flags & FE__SHAPE_IN_PLANES) search_from_plane(&s);
        if (flags & FE__SHAPE_IN_TREE)
            search_trees(&s, fe__may_be_buried(s.world, s.shape) ? visit_until_crowd : visit);
    }
    judge_queue(&s);
}

// The same once it is known who is buried. Buried shapes search among static ones only, so others must find them: what
// moved finds all that it meets, and what did not move finds the buried shapes that did.
static void search_block_of_crowd(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    const fe_world *world = step->world;
    search s = {world, step->scratch, step->scratch->chunks + worker, 0, 0, 0, 0, {{0}}};
    for (s.shape = first; s.shape < end; ++s.shape) {
        const fe__shape *shape = world->shapes + s.shape;
        int32_t is_moved = has_moved(s.scratch, s.shape);
        s.meets_buried = 0;
        if (!(shape->flags & (FE__SHAPE_IN_PLANES | FE__SHAPE_IN_TREE)) || collides_with_nothing(shape)) continue;
        if (shape->flags & FE__SHAPE_IN_PLANES) {
            if (is_moved) search_from_plane(&s);
        } else if (s.scratch->is_buried[s.shape]) {
            if (is_moved) search_static(&s);
        } else if (world->bodies[shape->body].type == FE_BODY_STATIC) {
            if (is_moved) search_trees(&s, visit);
        } else if (is_moved) {
            search_static(&s);
            s.meets_buried = 1;
            fe__tree_query_proxy(&world->moving_tree, &world->moving_tree, s.shape, visit, &s);
        } else if (s.scratch->buried_count) {
            fe__tree_query_proxy(&world->moving_tree, &world->moving_tree, s.shape, visit_moved_buried, &s);
        }
        judge_queue(&s);
    }
}

static int32_t reserve_candidates(fe__step *step, int64_t count)
{
    fe__step_scratch *scratch = step->scratch;
    int32_t workers = step->world->workers.count;
    // the last chunk of each worker may be all but empty
    count += (int64_t)workers * CANDIDATES_IN_CHUNK;
    if (!FE_RENEW(step->world->step_memory, scratch->candidates, scratch->candidate_capacity, count)) return 0;
    for (int32_t i = 0; i < workers; ++i) scratch->chunks[i].at = scratch->chunks[i].end = 0;
    atomic_store(&scratch->chunks_end, 0);
    return 1;
}

// Moves candidates up into the gaps that workers left in their last chunks.
static void close_gaps(fe__step *step)
{
    fe__step_scratch *scratch = step->scratch;
    for (int32_t i = 0; i < step->world->workers.count; ++i)
        for (int32_t k = scratch->chunks[i].at; k < scratch->chunks[i].end; ++k) scratch->candidates[k].shape_a = -1;
    scratch->candidate_count = 0;
    for (int32_t i = 0, end = atomic_load(&scratch->chunks_end); i < end; ++i)
        if (scratch->candidates[i].shape_a >= 0)
            scratch->candidates[scratch->candidate_count++] = scratch->candidates[i];
}

// Beyond its capacity the array of candidates is only counted: then the search is done again with more. Both searches
// return 0 when there is no memory.
static int32_t search_moved(fe__step *step)
{
    fe__step_scratch *scratch = step->scratch;
    const fe_world *world = step->world;
    do {
        if (!reserve_candidates(step, atomic_load(&scratch->chunks_end))) return 0;
        fe__parallel_for(&world->workers, world->moved_count, SHAPES_IN_BLOCK, search_block, step);
    } while (atomic_load(&scratch->chunks_end) > scratch->candidate_capacity && !atomic_load(&scratch->is_crowd));
    if (!atomic_load(&scratch->is_crowd)) close_gaps(step);
    return 1;
}

static int32_t search_crowd(fe__step *step)
{
    fe__step_scratch *scratch = step->scratch;
    const fe_world *world = step->world;
    atomic_store(&scratch->chunks_end, 0);
    if (!fe__find_buried(step)) return 0;
    int64_t beside = (int64_t)FE__BESIDE * scratch->buried_count;
    do {
        if (!reserve_candidates(step, atomic_load(&scratch->chunks_end) + beside)) return 0;
        fe__parallel_for(&world->workers, world->shape_ids.slot_count, SHAPES_IN_BLOCK, search_block_of_crowd, step);
    } while (atomic_load(&scratch->chunks_end) + beside > scratch->candidate_capacity);
    close_gaps(step);
    return fe__find_beside(step);
}

// Finds the candidates, in an order that hangs on workers and trees. 0: no memory
static int32_t find_candidates(fe__step *step)
{
    fe__step_scratch *scratch = step->scratch;
    const fe_world *world = step->world;
    int32_t words = world->shape_capacity / WORD_BITS + 1;
    if (!FE_RESERVE(step->world->step_memory, scratch->moved_bits, scratch->moved_words, words)) return 0;
    for (int32_t i = 0; i < world->moved_count; ++i)
        scratch->moved_bits[world->moved[i] / WORD_BITS] |= 1u << world->moved[i] % WORD_BITS;
    scratch->buried_count = 0;
    atomic_store(&scratch->buried_meetings, 0);
    atomic_store(&scratch->is_crowd, 0);
    int32_t is_done = search_moved(step) && (!atomic_load(&scratch->is_crowd) || search_crowd(step));
    for (int32_t i = 0; i < world->moved_count; ++i) scratch->moved_bits[world->moved[i] / WORD_BITS] = 0;
    return is_done;
}

// ---- pair limit -----------------------------------------------------------------------------------------------------
// n bodies born in one point have n (n - 1) / 2 pairs: a mistake of the host that would take all memory and minutes of
// time. A body is crowded when it has more than MOST_PAIRS pairs with dynamic bodies. Of the pairs of two crowded
// bodies, each body keeps the KEPT_PAIRS deepest, and a pair that either of them keeps is made. So a body that carries
// a thousand others, which are not crowded, keeps them all.
//
// The depth is the overlap of the boxes of the two shapes. Among equals, as in a point, those that were created next to
// each other come first: each body then keeps others than its neighbour does, and no body has all.
//
// With MOST_PAIRS contacts each, two bodies leave a colour of the constraint graph for the contact between them. A body
// that keeps KEPT_PAIRS is kept by about as many others, which makes MOST_PAIRS: so a crowd finds colours too.
enum { MOST_PAIRS = FE__PAIR_COLOURS / 2, KEPT_PAIRS = MOST_PAIRS / 2 };

static fe__body *body_of(const fe_world *world, int32_t shape) { return world->bodies + world->shapes[shape].body; }

// Only contacts of two dynamic bodies count towards the limit.
static int32_t is_limited(const fe_world *world, const fe__candidate *c)
{
    return body_of(world, c->shape_a)->type == FE_BODY_DYNAMIC && body_of(world, c->shape_b)->type == FE_BODY_DYNAMIC &&
           !((world->shapes[c->shape_a].flags | world->shapes[c->shape_b].flags) & FE__SHAPE_TRIGGER);
}

// While the limit is applied, fe__body.coming_contacts counts the body's candidates; in a crowded body it is ~heap, the
// complement of the index of its heap.
static int32_t is_crowded(const fe__body *body) { return body->coming_contacts < 0; }

// The body of a buried shape is crowded, however few of those that it meets were found.
static int32_t exceeds_limit(const fe__step *step, const fe__body *body, int32_t shape)
{
    const fe__step_scratch *scratch = step->scratch;
    return body->coming_contacts + body->contact_count > MOST_PAIRS ||
           (scratch->buried_count && scratch->is_buried[shape]);
}

// Gives each crowded body a heap. Returns how many there are.
static int32_t find_crowded_bodies(const fe__step *step)
{
    const fe_world *world = step->world;
    const fe__step_scratch *scratch = step->scratch;
    int32_t any = 0, count = 0;
    for (int32_t i = 0; i < scratch->candidate_count; ++i) {
        const fe__candidate *c = scratch->candidates + i;
        if (!is_limited(world, c)) continue;
        fe__body *a = body_of(world, c->shape_a), *b = body_of(world, c->shape_b);
        ++a->coming_contacts, ++b->coming_contacts;
        any |= exceeds_limit(step, a, c->shape_a) || exceeds_limit(step, b, c->shape_b);
    }
    for (int32_t i = 0; i < 2 * scratch->candidate_count && any; ++i) {
        const fe__candidate *c = scratch->candidates + i / 2;
        int32_t shape = i % 2 ? c->shape_b : c->shape_a;
        fe__body *body = body_of(world, shape);
        if (!is_crowded(body) && body->type == FE_BODY_DYNAMIC && exceeds_limit(step, body, shape))
            body->coming_contacts = ~count++;
    }
    return count;
}

// Empties the heaps, with a capacity of as many more pairs with crowded bodies as each body may get, and computes the
// boxes of all their shapes.
static void prepare_heaps(const fe__step *step, int32_t heap_count)
{
    const fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    for (int32_t k = 0; k < heap_count; ++k) scratch->heaps[k] = (fe__pair_heap){.shape = -1};
    for (int32_t i = 0; i < 2 * scratch->candidate_count; ++i) {
        const fe__candidate *c = scratch->candidates + i / 2;
        int32_t shape = i % 2 ? c->shape_b : c->shape_a, index = world->shapes[shape].body;
        const fe__body *body = world->bodies + index;
        if (!is_crowded(body) || scratch->heaps[~body->coming_contacts].shape == shape) continue;
        fe__pair_heap *heap = scratch->heaps + ~body->coming_contacts;
        if (heap->shape < 0) {
            int32_t capacity = KEPT_PAIRS;
            for (int32_t pair = body->first_contact; pair >= 0; pair = fe__next_pair(world, pair, index)) {
                const fe__pair *p = world->pairs + pair;
                capacity -= is_crowded(world->bodies + (p->body_a == index ? p->body_b : p->body_a));
            }
            heap->capacity = fe__maxi(capacity, 0);
        }
        heap->shape = shape;
        scratch->boxes[shape] = fe__shape_bounds(world, shape, 0.0f);
    }
}

// Overlap of two boxes along the axis where it is least, m; 0 where they do not overlap.
static float box_depth(const fe__bounds *a, const fe__bounds *b)
{
    double x = fe__mind(a->high.x, b->high.x) - fe__maxd(a->low.x, b->low.x),
           y = fe__mind(a->high.y, b->high.y) - fe__maxd(a->low.y, b->low.y),
           z = fe__mind(a->high.z, b->high.z) - fe__maxd(a->low.z, b->low.z);
    return fe__maxf((float)fe__mind(x, fe__mind(y, z)), 0.0f);
}

// The key by which the body `own` keeps pairs, the largest first: the bits of the depth, then the nearness of the two
// bodies in the order of creation, the later one first.
static uint64_t pair_rank(float depth, uint64_t own, uint64_t other)
{
    const uint64_t most = UINT32_MAX;
    uint64_t distance = other > own ? 2 * (other - own) : 2 * (own - other) + 1;
    uint32_t bits;
    memcpy(&bits, &depth, sizeof bits);
    return (uint64_t)bits << 32 | (most - (distance < most ? distance : most));
}

// The order of a heap. Ranks are equal only between bodies of several shapes: then the pair created first is kept.
static int32_t ranks_below(const fe__step *step, fe__ranked_pair x, fe__ranked_pair y)
{
    const fe__shape *shapes = step->world->shapes;
    const fe__candidate *a = step->scratch->candidates + x.candidate, *b = step->scratch->candidates + y.candidate;
    if (x.rank != y.rank) return x.rank < y.rank;
    if (a->shape_a != b->shape_a) return shapes[a->shape_a].serial > shapes[b->shape_a].serial;
    return shapes[a->shape_b].serial > shapes[b->shape_b].serial;
}

// Puts a pair into a body's top-k heap, whose root ranks lowest.
static void offer_pair(const fe__step *step, const fe__body *body, fe__ranked_pair pair)
{
    fe__step_scratch *scratch = step->scratch;
    fe__pair_heap *heap = scratch->heaps + ~body->coming_contacts;
    fe__ranked_pair *items = scratch->ranked_pairs + (int64_t)KEPT_PAIRS * ~body->coming_contacts;
    int32_t at = 0;
    if (heap->count < heap->capacity) { // the new leaf rises
        for (at = heap->count++; at > 0 && ranks_below(step, pair, items[(at - 1) / 2]); at = (at - 1) / 2)
            items[at] = items[(at - 1) / 2];
        items[at] = pair;
    } else if (heap->capacity && ranks_below(step, items[0], pair)) { // it replaces the root and sinks
        for (int32_t child; (child = 2 * at + 1) < heap->count; at = child) {
            if (child + 1 < heap->count && ranks_below(step, items[child + 1], items[child])) ++child;
            if (!ranks_below(step, items[child], pair)) break;
            items[at] = items[child];
        }
        items[at] = pair;
    }
}

static int32_t is_between_crowded(const fe_world *world, const fe__candidate *c)
{
    return is_limited(world, c) && is_crowded(body_of(world, c->shape_a)) && is_crowded(body_of(world, c->shape_b));
}

// Moves the candidates that no heap kept behind the others.
static void drop_candidates(const fe__step *step, int32_t heap_count)
{
    const fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    fe__candidate *c = scratch->candidates;
    for (int32_t i = 0; i < scratch->candidate_count; ++i) {
        if (!is_between_crowded(world, c + i)) continue;
        int32_t shape_a = c[i].shape_a, shape_b = c[i].shape_b;
        uint64_t a = world->shapes[shape_a].serial >> FE__PART_BITS, b = world->shapes[shape_b].serial >> FE__PART_BITS;
        float depth = box_depth(scratch->boxes + shape_a, scratch->boxes + shape_b);
        offer_pair(step, body_of(world, shape_a), (fe__ranked_pair){pair_rank(depth, a, b), i});
        offer_pair(step, body_of(world, shape_b), (fe__ranked_pair){pair_rank(depth, b, a), i});
    }
    // the shape A of a candidate that stays becomes its complement, until all have changed places
    for (int32_t i = 0; i < scratch->candidate_count; ++i)
        if (!is_between_crowded(world, c + i)) c[i].shape_a = ~c[i].shape_a;
    for (int32_t k = 0; k < heap_count; ++k) {
        for (int32_t i = 0; i < scratch->heaps[k].count; ++i) {
            fe__candidate *kept = c + scratch->ranked_pairs[(int64_t)KEPT_PAIRS * k + i].candidate;
            if (kept->shape_a >= 0) kept->shape_a = ~kept->shape_a;
        }
    }
    int32_t count = 0;
    for (int32_t i = 0; i < scratch->candidate_count; ++i) {
        if (c[i].shape_a >= 0) continue;
        fe__candidate kept = {~c[i].shape_a, c[i].shape_b};
        c[i] = c[count], c[count++] = kept;
    }
    scratch->dropped_count = scratch->candidate_count - count;
}

// Leaves fe__step_scratch.dropped_count candidates out: they stand behind the others. 0: no memory
static int32_t limit_pairs(fe__step *step)
{
    const fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    fe__memory *memory = step->world->step_memory;
    scratch->dropped_count = 0;
    int32_t is_done = 1, heap_count = find_crowded_bodies(step);
    if (heap_count) {
        is_done =
            FE_RESERVE(memory, scratch->heaps, scratch->heap_capacity, heap_count) &&
            FE_RESERVE(memory, scratch->ranked_pairs, scratch->ranked_capacity, (int64_t)KEPT_PAIRS * heap_count) &&
            FE_RESERVE(memory, scratch->boxes, scratch->box_capacity, world->shape_capacity);
        if (is_done) {
            prepare_heaps(step, heap_count);
            drop_candidates(step, heap_count);
        }
    }
    for (int32_t i = 0; i < scratch->candidate_count; ++i) {
        const fe__candidate *c = scratch->candidates + i;
        body_of(world, c->shape_a)->coming_contacts = body_of(world, c->shape_b)->coming_contacts = 0;
    }
    scratch->candidate_count -= scratch->dropped_count;
    return is_done;
}

// ---- stage ----------------------------------------------------------------------------------------------------------

// Sorts the candidates by the creation of shape A, then of shape B: two stable passes, the second key first.
static void sort_candidates(fe__step *step)
{
    fe__step_scratch *scratch = step->scratch;
    const fe__shape *shapes = step->world->shapes;
    int32_t n = scratch->candidate_count;
    fe__sort_item *items = fe__sort_scratch(step);
    for (int32_t pass = 0; pass < 2; ++pass) {
        for (int32_t i = 0; i < n; ++i) {
            if (!pass) items[i].value = scratch->candidates[i].shape_a, items[i].spare = scratch->candidates[i].shape_b;
            items[i].key = shapes[pass ? items[i].value : items[i].spare].serial;
        }
        fe__sort_keys(items, n, items + n);
    }
    for (int32_t i = 0; i < n; ++i) scratch->candidates[i] = (fe__candidate){items[i].value, items[i].spare};
}

// Asks the host's pair filter. It is called in the order of creation, on the stepping thread, and once for all parts
// of two compounds.
static int32_t is_denied(const fe_world *world, const fe__candidate *c)
{
    const fe__shape *a = world->shapes + c->shape_a, *b = world->shapes + c->shape_b;
    if (!world->pair_filter || !((a->flags | b->flags) & FE__SHAPE_JUDGED)) return 0;
    const fe__encounter *known =
        a->parent >= 0 || b->parent >= 0 ? fe__find_encounter(world, c->shape_a, c->shape_b) : NULL;
    if (known) return known->denied;
    fe_filter_pair pair = {.body_a = fe__body_handle(world, a->body),
                           .body_b = fe__body_handle(world, b->body),
                           .shape_a = fe__shape_handle(world, c->shape_a),
                           .shape_b = fe__shape_handle(world, c->shape_b),
                           .body_user_data_a = world->bodies[a->body].user_data,
                           .body_user_data_b = world->bodies[b->body].user_data,
                           .shape_user_data_a = world->shapes[fe__whole_shape(world->shapes, c->shape_a)].user_data,
                           .shape_user_data_b = world->shapes[fe__whole_shape(world->shapes, c->shape_b)].user_data};
    return world->pair_filter(world->pair_filter_user, &pair) == 0;
}

void fe__find_new_pairs(fe__step *step)
{
    fe_world *world = step->world;
    const fe__step_scratch *scratch = step->scratch;
    fe__settle_sizes(world);
    step->failed = !find_candidates(step) || !limit_pairs(step);
    if (step->failed) return;
    step->failed = !fe__find_expired(step) || !fe__reserve_step(step);
    fe__apply_skip_notes(step);
    if (step->failed) return;
    sort_candidates(step);
    const fe__candidate *candidates = scratch->candidates;
    for (int32_t i = 0; i < scratch->candidate_count; ++i)
        fe__pair_create(world, candidates[i].shape_a, candidates[i].shape_b, is_denied(world, candidates + i));
    for (int32_t i = 0; i < world->moved_count; ++i) world->shapes[world->moved[i]].flags &= ~(uint32_t)FE__SHAPE_MOVED;
    world->moved_count = 0;
    // shapes whose pairs were left out look for each other again in the next step
    const fe__candidate *dropped = candidates + scratch->candidate_count;
    for (int32_t i = 0; i < scratch->dropped_count; ++i) {
        const fe__body *a = body_of(world, dropped[i].shape_a), *b = body_of(world, dropped[i].shape_b);
        if (a->awake_index >= 0 || b->awake_index >= 0) fe__shape_mark_moved(world, dropped[i].shape_a);
    }
    fe__buried_keep_looking(step);
}
