// fuzz_pairs.c - who may touch whom, and who does: pair filters, one-way shapes, bounds and overlaps. See fuzz.c.
#include "support/fuzz_state.h"

enum { MOST_FOUND = 8 };

// ---- pair filters --------------------------------------------------------------------------------------------------

// The world is busy while it asks; the two it asks about are a shape of each of two bodies.
static void check_question(const fuzz *f, const fe_filter_pair *pair)
{
    fe_transform t;
    if (fe_body_get_transform(f->world, pair->body_a, &t) != FE_ERROR_STEPPING ||
        fe_world_set_pair_filter(f->world, NULL, NULL) != FE_ERROR_STEPPING)
        fuzz_fail(f, "a call from within a pair filter");
    if (!pair->shape_a || !pair->shape_b || pair->shape_a == pair->shape_b || pair->body_a == pair->body_b)
        fuzz_fail(f, "a pair filter is asked about no pair");
}

static int32_t refuse(void *user, const fe_filter_pair *pair)
{
    check_question(user, pair);
    return 0;
}

// some of each: the answer is the pair's alone, so that equal streams get equal answers
static int32_t judge(void *user, const fe_filter_pair *pair)
{
    static const int32_t answers[] = {0, 1, 1, 0, 2, -1, 0, 1};
    check_question(user, pair);
    return answers[(pair->shape_a * 5 + pair->shape_b * 3) % 8];
}

int32_t fuzz_set_filter(fuzz *f)
{
    const fe_pair_filter filters[] = {NULL, refuse, judge, judge, judge};
    return fe_world_set_pair_filter(f->world, filters[fuzz_byte(f) % 5], f);
}

int32_t fuzz_judge_shape(fuzz *f)
{
    fe_shape shape = fuzz_shape(f);
    int32_t enabled = fuzz_byte(f) % 3, got = -1;
    fe_result result = fe_shape_set_pair_filter(f->world, shape, enabled);
    if (result != FE_OK) return result;
    if (fe_shape_get_pair_filter(f->world, shape, &got) != FE_OK || got != enabled)
        fuzz_fail(f, "a pair filter's switch that was not kept");
    return FE_OK;
}

// ---- one-way shapes ------------------------------------------------------------------------------------------------

int32_t fuzz_set_one_way(fuzz *f)
{
    fe_shape shape = fuzz_shape(f);
    int32_t enabled = fuzz_byte(f) % 3, got = -1;
    fe_vec3 direction = fuzz_vec3(f);
    fe_result result = fe_shape_set_one_way(f->world, shape, enabled, or_null(f, &direction));
    if (result != FE_OK) return result;
    if (fe_shape_get_one_way(f->world, shape, &got, &direction) != FE_OK || got != enabled)
        fuzz_fail(f, "a one-way switch that was not kept");
    return FE_OK;
}

// ---- bounds --------------------------------------------------------------------------------------------------------

int32_t fuzz_read_bounds(fuzz *f)
{
    fe_bounds b;
    uint8_t which = fuzz_byte(f) % 4;
    fe_bounds *out = or_null(f, &b) ? &b : NULL;
    int32_t result = which == 0   ? fe_world_get_bounds(f->world, out)
                     : which == 1 ? fe_body_get_bounds(f->world, fuzz_body(f), out)
                                  : fe_shape_get_bounds(f->world, fuzz_shape(f), out);
    if (result != FE_OK) return result;
    if (!f->is_wild && which > 1 && !(b.lower.x <= b.upper.x && b.lower.y <= b.upper.y && b.lower.z <= b.upper.z))
        fuzz_fail(f, "bounds that hold nothing");
    fe__hash_dvec3(&f->told, b.lower);
    fe__hash_dvec3(&f->told, b.upper);
    return result;
}

// ---- overlaps ------------------------------------------------------------------------------------------------------

static const fe_query_filter *some_filter(fuzz *f, fe_query_filter *out)
{
    fe_query_filter_init(out, sizeof *out);
    out->mask = fuzz_byte(f) * 3u;
    out->flags = fuzz_byte(f) % 3u;
    return or_null(f, out);
}

static void check_overlap(fuzz *f, const fe_overlap *found)
{
    fe_vec3 n = found->direction;
    float square = n.x * n.x + n.y * n.y + n.z * n.z;
    if (!fe_body_is_valid(f->world, found->body) || !fe_shape_is_valid(f->world, found->shape))
        fuzz_fail(f, "an overlap with nothing");
    fe__hash_u64(&f->told, found->shape);
    if (f->is_wild) return;
    if (!(found->depth >= 0.0f)) fuzz_fail(f, "an overlap of no depth");
    if (!(square > 0.999f && square < 1.001f)) fuzz_fail(f, "an overlap's direction that is no unit vector");
    fe__hash_vec3(&f->told, n);
}

int32_t fuzz_overlap_shapes(fuzz *f)
{
    fuzz_span a;
    fe_query_filter room;
    fe_geometry g = fuzz_geometry(f);
    fe_transform t = fuzz_transform(f);
    const fe_query_filter *filter = some_filter(f, &room);
    fuzz_array(f, sizeof(fe_overlap), &a);
    int32_t count =
        fe_world_overlap_shapes(f->world, or_null(f, &g), or_null(f, &t), filter, a.data, a.stride, a.count);
    for (int32_t i = 0; i < count && i < a.count && a.stride == sizeof(fe_overlap); ++i)
        check_overlap(f, (const fe_overlap *)a.data + i);
    return count;
}

static void check_shapes(fuzz *f, const fe_shape *shapes, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        if (!fe_shape_is_valid(f->world, shapes[i])) fuzz_fail(f, "a list with a shape that is none");
        fe__hash_u64(&f->told, shapes[i]);
    }
}

int32_t fuzz_overlap_bounds(fuzz *f)
{
    fe_shape shapes[MOST_FOUND];
    fe_query_filter room;
    fe_bounds b = {fuzz_dvec3(f), {0, 0, 0}};
    if (fuzz_byte(f) % 4) // the right way round
        b.upper = (fe_dvec3){b.lower.x + (double)fuzz_size(f), b.lower.y + 1.0, b.lower.z + 1.0};
    else
        b.upper = fuzz_dvec3(f);
    const fe_query_filter *filter = some_filter(f, &room);
    int32_t capacity = fuzz_byte(f) % (MOST_FOUND + 2) - 1;
    int32_t count =
        fe_world_overlap_bounds(f->world, or_null(f, &b), filter, or_null(f, shapes) ? shapes : NULL, capacity);
    check_shapes(f, shapes, count < capacity ? count : capacity);
    return count;
}

int32_t fuzz_read_overlaps(fuzz *f)
{
    fe_shape shapes[MOST_FOUND], shape = fuzz_shape(f);
    int32_t capacity = fuzz_byte(f) % (MOST_FOUND + 2) - 1;
    int32_t count = fe_shape_get_overlaps(f->world, shape, or_null(f, shapes) ? shapes : NULL, capacity);
    check_shapes(f, shapes, count < capacity ? count : capacity);
    return count;
}
