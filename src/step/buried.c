// buried.c - see buried.h.
#include "step/buried.h"

#include "world/filter.h"
#include "world/proxies.h"

// ---- who is --------------------------------------------------------------------------------------------------------
typedef struct census {
    const fe_world *world;
    const uint8_t *is_buried; // by shape, as soon as it is known
    int32_t shape, met;
} census;

static int32_t may_be_new(const fe_world *w, int32_t shape, int32_t other)
{
    return fe__pair_set_find(&w->pair_set, shape, other) < 0 && fe__may_collide(w, shape, other);
}

static int32_t count_new(void *context, int32_t other)
{
    census *c = context;
    if (other != c->shape && fe__may_be_buried(c->world, other) && may_be_new(c->world, c->shape, other)) ++c->met;
    return c->met <= FE__BURIED_BY;
}

static void find_in_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    const fe_world *w = step->world;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        census c = {w, NULL, i, 0};
        if (w->shapes[i].flags & FE__SHAPE_IN_TREE && fe__may_be_buried(w, i))
            fe__tree_query_proxy(&w->moving_tree, &w->moving_tree, i, count_new, &c);
        step->scratch->is_buried[i] = c.met > FE__BURIED_BY;
    }
}

static int32_t count_buried(void *context, int32_t other)
{
    census *c = context;
    if (other != c->shape && c->is_buried[other] && may_be_new(c->world, c->shape, other)) ++c->met;
    return c->met <= FE__BURIED_BY;
}

// Counts how many buried ones each meets, no farther than the search before counted.
static void count_in_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    fe__step_scratch *s = step->scratch;
    int32_t met = 0;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        census c = {step->world, s->is_buried, s->buried[i], 0};
        fe__tree_query_proxy(&step->world->moving_tree, &step->world->moving_tree, s->buried[i], count_buried, &c);
        met += c.met;
    }
    atomic_fetch_add(&s->buried_meetings, met); // of two million shapes at most
}

int32_t fe__find_buried(fe__step *step)
{
    enum { SHAPES_IN_BLOCK = 64 };
    fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    int32_t shapes = w->shape_ids.slot_count;
    if (!FE_RENEW(w->step_memory, s->is_buried, s->is_buried_capacity, shapes)) return 0;
    fe__parallel_for(&w->workers, shapes, SHAPES_IN_BLOCK, find_in_block, step);
    int32_t count = 0;
    for (int32_t i = 0; i < shapes; ++i) count += s->is_buried[i];
    if (!FE_RENEW(w->step_memory, s->buried, s->buried_capacity, count)) return 0;
    for (int32_t i = 0; i < shapes; ++i)
        if (s->is_buried[i]) s->buried[s->buried_count++] = i;
    fe__parallel_for(&w->workers, s->buried_count, SHAPES_IN_BLOCK, count_in_block, step);
    return 1;
}

// ---- whom they meet ------------------------------------------------------------------------------------------------
static fe_dvec3 centre_of(const fe_world *w, int32_t shape)
{
    fe__bounds b = fe__shape_bounds(w, shape, 0.0f);
    return fe__dadd(fe__dscale(0.5, b.low), fe__dscale(0.5, b.high));
}

// Puts two zeros before each of the lowest 21 bits.
static uint64_t spread(uint64_t bits)
{
    bits = (bits | bits << 32) & UINT64_C(0x001F00000000FFFF);
    bits = (bits | bits << 16) & UINT64_C(0x001F0000FF0000FF);
    bits = (bits | bits << 8) & UINT64_C(0x100F00F00F00F00F);
    bits = (bits | bits << 4) & UINT64_C(0x10C30C30C30C30C3);
    return (bits | bits << 2) & UINT64_C(0x1249249249249249);
}

static uint64_t cell_along(double x, double low, double high)
{
    const double last = (double)((1 << 21) - 1);
    return high > low ? spread((uint64_t)((x - low) / (high - low) * last)) : 0;
}

// Where a point lies on Morton's curve through the box (Morton 1966)
static uint64_t place_on_curve(fe_dvec3 p, const fe__bounds *box)
{
    return cell_along(p.x, box->low.x, box->high.x) | cell_along(p.y, box->low.y, box->high.y) << 1 |
           cell_along(p.z, box->low.z, box->high.z) << 2;
}

static fe__bounds box_of_centres(const fe__step *step)
{
    const fe__step_scratch *s = step->scratch;
    fe__bounds box = {centre_of(step->world, s->buried[0]), centre_of(step->world, s->buried[0])};
    for (int32_t i = 1; i < s->buried_count; ++i) {
        fe_dvec3 p = centre_of(step->world, s->buried[i]);
        box.low = (fe_dvec3){fe__mind(box.low.x, p.x), fe__mind(box.low.y, p.y), fe__mind(box.low.z, p.z)};
        box.high = (fe_dvec3){fe__maxd(box.high.x, p.x), fe__maxd(box.high.y, p.y), fe__maxd(box.high.z, p.z)};
    }
    return box;
}

// Sorts them along the curve, and those in one place by their creation.
static void sort_buried(const fe__step *step, fe__sort_item *items)
{
    const fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    int32_t n = s->buried_count;
    fe__bounds box = box_of_centres(step);
    for (int32_t i = 0; i < n; ++i)
        items[i] = (fe__sort_item){.key = w->shapes[s->buried[i]].serial, .value = s->buried[i]};
    fe__sort_keys(items, n, items + n);
    for (int32_t i = 0; i < n; ++i) items[i].key = place_on_curve(centre_of(w, items[i].value), &box);
    fe__sort_keys(items, n, items + n);
    for (int32_t i = 0; i < n; ++i) s->buried[i] = items[i].value;
}

static void try_pair(const fe__step *step, int32_t a, int32_t b)
{
    const fe_world *w = step->world;
    fe__step_scratch *s = step->scratch;
    int32_t moved = (w->shapes[a].flags | w->shapes[b].flags) & FE__SHAPE_MOVED;
    if (!moved || fe__tree_parts(&w->moving_tree, a, b) || !may_be_new(w, a, b)) return;
    int32_t first = w->shapes[a].serial < w->shapes[b].serial;
    s->candidates[s->candidate_count++] = first ? (fe__candidate){a, b} : (fe__candidate){b, a};
}

int32_t fe__find_beside(fe__step *step)
{
    fe_world *w = step->world;
    const fe__step_scratch *s = step->scratch;
    if (!s->buried_count) return 1;
    // as in fe__reserve_step: what is sorted lies where the rows will
    int64_t blocks = 2 * (int64_t)s->buried_count * (int64_t)sizeof(fe__sort_item) / (int64_t)sizeof(fe__row_block);
    if (!FE_RENEW(w->step_memory, w->solver.rows, w->solver.row_capacity, blocks + 1)) return 0;
    sort_buried(step, fe__sort_scratch(step));
    for (int32_t i = 0; i < s->buried_count; ++i)
        for (int32_t k = i + 1; k <= i + FE__BESIDE && k < s->buried_count; ++k)
            try_pair(step, s->buried[i], s->buried[k]);
    return 1;
}

void fe__buried_keep_looking(fe__step *step)
{
    fe_world *w = step->world;
    const fe__step_scratch *s = step->scratch;
    for (int32_t i = 0; i < s->buried_count; ++i)
        if (w->bodies[w->shapes[s->buried[i]].body].awake_index >= 0) fe__shape_mark_moved(w, s->buried[i]);
}
