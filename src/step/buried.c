// buried.c - finds the shapes that buried.h defines, and the pairs that they have among each other.
#include "step/buried.h"

#include "world/filter.h"
#include "world/proxies.h"

// ---- search for buried shapes ---------------------------------------------------------------------------------------

typedef struct census {
    const fe_world *world;
    const uint8_t *is_buried; // by shape; NULL: not known yet
    int32_t shape, met;       // new pairs that the shape has, FE__BURIED_BY + 1 at most
} census;

static int32_t may_be_new(const fe_world *world, int32_t shape, int32_t other)
{
    return fe__pair_set_find(&world->pair_set, shape, other) < 0 && fe__may_collide(world, shape, other);
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
    const fe_world *world = step->world;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        census c = {world, NULL, i, 0};
        if (world->shapes[i].flags & FE__SHAPE_IN_TREE && fe__may_be_buried(world, i))
            fe__tree_query_proxy(&world->moving_tree, &world->moving_tree, i, count_new, &c);
        step->scratch->is_buried[i] = c.met > FE__BURIED_BY;
    }
}

static int32_t count_buried(void *context, int32_t other)
{
    census *c = context;
    if (other != c->shape && c->is_buried[other] && may_be_new(c->world, c->shape, other)) ++c->met;
    return c->met <= FE__BURIED_BY;
}

// Counts how many other buried shapes each meets, no farther than the search before counted.
static void count_in_block(void *argument, int32_t first, int32_t end, int32_t worker)
{
    const fe__step *step = argument;
    fe__step_scratch *scratch = step->scratch;
    int32_t met = 0;
    (void)worker;
    for (int32_t i = first; i < end; ++i) {
        census c = {step->world, scratch->is_buried, scratch->buried[i], 0};
        fe__tree_query_proxy(&step->world->moving_tree, &step->world->moving_tree, scratch->buried[i], count_buried,
                             &c);
        met += c.met;
    }
    atomic_fetch_add(&scratch->buried_meetings, met); // no overflow: there are two million shapes at most
}

int32_t fe__find_buried(fe__step *step)
{
    enum { SHAPES_IN_BLOCK = 64 };
    fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    int32_t shapes = world->shape_ids.slot_count;
    if (!FE_RENEW(world->step_memory, scratch->is_buried, scratch->is_buried_capacity, shapes)) return 0;
    fe__parallel_for(&world->workers, shapes, SHAPES_IN_BLOCK, find_in_block, step);
    int32_t count = 0;
    for (int32_t i = 0; i < shapes; ++i) count += scratch->is_buried[i];
    if (!FE_RENEW(world->step_memory, scratch->buried, scratch->buried_capacity, count)) return 0;
    for (int32_t i = 0; i < shapes; ++i)
        if (scratch->is_buried[i]) scratch->buried[scratch->buried_count++] = i;
    fe__parallel_for(&world->workers, scratch->buried_count, SHAPES_IN_BLOCK, count_in_block, step);
    return 1;
}

// ---- pairs of two buried shapes -------------------------------------------------------------------------------------

static fe_dvec3 centre_of(const fe_world *world, int32_t shape)
{
    fe__bounds b = fe__shape_bounds(world, shape, 0.0f);
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

// Sorts the buried shapes along Morton's curve through their centres (Morton 1966), and those in one place by their
// creation.
static void sort_buried(const fe__step *step, fe__sort_item *items)
{
    const fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    int32_t n = scratch->buried_count, *buried = scratch->buried;
    fe__bounds box = {centre_of(world, buried[0]), centre_of(world, buried[0])};
    for (int32_t i = 1; i < n; ++i) {
        fe_dvec3 p = centre_of(world, buried[i]);
        box.low = (fe_dvec3){fe__mind(box.low.x, p.x), fe__mind(box.low.y, p.y), fe__mind(box.low.z, p.z)};
        box.high = (fe_dvec3){fe__maxd(box.high.x, p.x), fe__maxd(box.high.y, p.y), fe__maxd(box.high.z, p.z)};
    }
    for (int32_t i = 0; i < n; ++i)
        items[i] = (fe__sort_item){.key = world->shapes[buried[i]].serial, .value = buried[i]};
    fe__sort_keys(items, n, items + n);
    for (int32_t i = 0; i < n; ++i) {
        fe_dvec3 p = centre_of(world, items[i].value);
        items[i].key = cell_along(p.x, box.low.x, box.high.x) | cell_along(p.y, box.low.y, box.high.y) << 1 |
                       cell_along(p.z, box.low.z, box.high.z) << 2;
    }
    fe__sort_keys(items, n, items + n);
    for (int32_t i = 0; i < n; ++i) buried[i] = items[i].value;
}

int32_t fe__find_beside(fe__step *step)
{
    fe_world *world = step->world;
    fe__step_scratch *scratch = step->scratch;
    const int32_t n = scratch->buried_count, *buried = scratch->buried;
    if (!n) return 1;
    // as in fe__reserve_step: what is sorted lies where the rows will
    int64_t blocks = 2 * (int64_t)n * (int64_t)sizeof(fe__sort_item) / (int64_t)sizeof(fe__row_block);
    if (!FE_RENEW(world->step_memory, world->solver.rows, world->solver.row_capacity, blocks + 1)) return 0;
    sort_buried(step, fe__sort_scratch(step));
    for (int32_t i = 0; i < n; ++i) {
        for (int32_t k = i + 1; k <= i + FE__BESIDE && k < n; ++k) {
            int32_t a = buried[i], b = buried[k], is_first = world->shapes[a].serial < world->shapes[b].serial;
            int32_t some_moved = (world->shapes[a].flags | world->shapes[b].flags) & FE__SHAPE_MOVED;
            if (some_moved && !fe__tree_parts(&world->moving_tree, a, b) && may_be_new(world, a, b))
                scratch->candidates[scratch->candidate_count++] =
                    is_first ? (fe__candidate){a, b} : (fe__candidate){b, a};
        }
    }
    return 1;
}

void fe__buried_keep_looking(fe__step *step)
{
    fe_world *world = step->world;
    const fe__step_scratch *scratch = step->scratch;
    for (int32_t i = 0; i < scratch->buried_count; ++i)
        if (world->bodies[world->shapes[scratch->buried[i]].body].awake_index >= 0)
            fe__shape_mark_moved(world, scratch->buried[i]);
}
