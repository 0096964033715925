// crowd.c - see crowd.h. n bodies born in one point have n (n - 1) / 2 pairs: a mistake of the host that would take all
// memory and minutes of time. A body is crowded when it has more than MOST pairs with dynamic bodies. Of the pairs of
// two crowded bodies, each keeps its KEPT deepest, and one that either of them keeps is made. So a body that carries a
// thousand others, which are not crowded, keeps them all.
//
// How deep: by how much the boxes of the two shapes overlap. Among equals, as in a point, those that were created next
// to each other come first: each body then keeps others than its neighbour, and nobody has all.
#include "step/crowd.h"

#include "step/buried.h"
#include "world/pair_list.h"
#include "world/proxies.h"

#include <string.h>

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
