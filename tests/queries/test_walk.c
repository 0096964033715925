// Every query against a walk over every body: 300 of every kind, judged in long double (exact.h).
//
//     build/tests/queries/test_walk 100000            that many queries of each kind
//
// What passes within 2 micrometres without a touch, or goes as little in, may count either way.
#include "api/api_test.h"
#include "queries/dice.h"
#include "queries/exact.h"

#include "collision/form/form.h"

#include <stdlib.h>

#if defined(FE_SANITIZED)
enum { QUERIES = 150 };
#else
enum { QUERIES = 2500 };
#endif
enum {
    BODIES = 300,
    FIELDS = 2,
    PLANES = 3,
    SAMPLES = 8,
    TRIANGLES = 2 * (SAMPLES - 1) * (SAMPLES - 1),
    SHAPES = 800 + FIELDS * TRIANGLES
};
#define GRAZE 2e-6L // m

static int32_t queries = QUERIES;

// ---- a world of every kind ------------------------------------------------------------------------------------------
// A shape, or a triangle of a heightfield
typedef struct known_shape {
    fe_shape shape;
    int32_t triangle; // else -1
    int32_t rim;      // a side of it is a hole's or the field's: met from aside too
    solid solid;
    int32_t body; // index
    uint32_t layer;
    int32_t trigger;
} known_shape;

typedef struct known_world {
    fe_world *world;
    fe_dvec3 middle;
    fe_body bodies[BODIES];
    known_shape shapes[SHAPES];
    int32_t count;
    dice dice;
} known_world;

static fe_geometry random_geometry(known_world *k, int32_t types)
{
    fe_geometry g;
    float a = (float)uniform(&k->dice, 0.05, 2), b = (float)uniform(&k->dice, 0.05, 2),
          c = (float)uniform(&k->dice, 0.05, 2);
    int32_t type = FE_GEOMETRY_SPHERE + one_of(&k->dice, types); // then capsule, box
    if (type == FE_GEOMETRY_SPHERE) fe_geometry_sphere(&g, a);
    if (type == FE_GEOMETRY_CAPSULE) fe_geometry_capsule(&g, a, b);
    if (type == FE_GEOMETRY_BOX) fe_geometry_box(&g, a, b, c);
    return g;
}

static void add_known_shape(known_world *k, int32_t body, const fe_geometry *g)
{
    known_shape *s = &k->shapes[k->count++];
    fe_shape_def def;
    fe_shape_def_init(&def, sizeof def);
    if (chance(&k->dice, 0.6))
        def.frame.position = fe__narrow(random_vector(&k->dice, 2)), def.frame.rotation = random_rotation(&k->dice);
    def.layer = s->layer = 1u << one_of(&k->dice, 3);
    def.trigger = s->trigger = chance(&k->dice, 0.2);
    s->body = body, s->triangle = -1;
    OK(fe_shape_create(k->world, k->bodies[body], &def, g, &s->shape));
}

static int32_t has_rim(const uint8_t *holes, int32_t triangle)
{
    int32_t cells = SAMPLES - 1, row = triangle / 2 / cells, column = triangle / 2 % cells, out = triangle % 2 ? 1 : -1;
    int32_t r = row - out, c = column + out;
    return r < 0 || r >= cells || c < 0 || c >= cells || holes[r * cells + column] || holes[row * cells + c];
}

// Hills with holes, tilted: an entry for each triangle.
static void add_field(known_world *k, int32_t body)
{
    float heights[SAMPLES * SAMPLES];
    uint8_t holes[(SAMPLES - 1) * (SAMPLES - 1)];
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i) heights[i] = (float)uniform(&k->dice, -2, 2);
    for (int32_t i = 0; i < (SAMPLES - 1) * (SAMPLES - 1); ++i) holes[i] = (uint8_t)chance(&k->dice, 0.1);
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = SAMPLES, def.cell_x = 4.5f, def.cell_z = 5.25f, def.heights = heights, def.holes = holes;
    fe_asset asset;
    fe_geometry g;
    fe_shape shape;
    fe_transform t = {fe__dadd(k->middle, fe_make_dvec3(uniform(&k->dice, -25, -10), uniform(&k->dice, -15, 15),
                                                        uniform(&k->dice, -25, -10))),
                      {(float)uniform(&k->dice, -0.2, 0.2), 0, (float)uniform(&k->dice, -0.2, 0.2), 1}};
    OK(fe_heightfield_create(world_store(k->world), &def, &asset));
    OK(fe_body_set_type(k->world, k->bodies[body], FE_BODY_STATIC));
    OK(fe_body_set_transform(k->world, k->bodies[body], &t));
    OK(fe_body_get_transform(k->world, k->bodies[body], &t));
    fe_geometry_heightfield(&g, asset);
    OK(fe_shape_create(k->world, k->bodies[body], NULL, &g, &shape));
    for (int32_t i = 0; i < TRIANGLES; ++i) {
        int32_t cell = i / 2;
        if (holes[cell]) continue;
        solid s =
            make_field_solid(&def, cell / (SAMPLES - 1), cell % (SAMPLES - 1), i % 2, v_of(t.position), t.rotation);
        k->shapes[k->count++] = (known_shape){
            .shape = shape, .triangle = i, .rim = has_rim(holes, i), .solid = s, .body = body, .layer = 1};
    }
}

static void add_body(known_world *k, int32_t index)
{
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    int32_t has_plane = index % (BODIES / PLANES) == 9;
    def.type = has_plane ? FE_BODY_STATIC : one_of(&k->dice, 3);
    def.transform.position = fe__dadd(k->middle, random_vector(&k->dice, 25));
    def.transform.rotation = random_rotation(&k->dice);
    def.awake = one_of(&k->dice, 2);
    if (chance(&k->dice, 0.3))
        def.linear_locks = (uint32_t)one_of(&k->dice, 8), def.angular_locks = (uint32_t)one_of(&k->dice, 8);
    OK(fe_body_create(k->world, &def, &k->bodies[index]));
    if (index % (BODIES / FIELDS) == 7) {
        add_field(k, index);
        return;
    }
    for (int32_t shapes = 1 + (int32_t)(2.5 * uniform(&k->dice, 0, 1) * uniform(&k->dice, 0, 1)); shapes > 0;
         --shapes) {
        fe_geometry g = random_geometry(k, 3);
        add_known_shape(k, index, &g);
    }
    if (has_plane) {
        fe_geometry g;
        fe_geometry_plane(&g, (float)uniform(&k->dice, -0.2, 0.2), 1, 0, -22);
        add_known_shape(k, index, &g);
    }
}

// Where everything is now, as the library composes it.
static void learn_poses(known_world *k)
{
    for (int32_t i = 0; i < k->count; ++i) {
        known_shape *s = &k->shapes[i];
        if (s->triangle >= 0) continue;
        fe_transform t = body_transform(k->world, k->bodies[s->body]);
        fe_frame frame;
        fe_geometry g = {.struct_size = sizeof g};
        OK(fe_shape_get_frame(k->world, s->shape, &frame));
        OK(fe_shape_get_geometry(k->world, s->shape, &g));
        fe__pose body = {t.position, t.rotation}, pose = body;
        int32_t centred = frame.position.x == 0.0f && frame.position.y == 0.0f && frame.position.z == 0.0f &&
                          frame.rotation.w == 1.0f;
        if (!centred) pose = fe__compose(&body, frame.position, frame.rotation);
        s->solid = make_solid(&g, v_of(pose.position), pose.rotation);
    }
}

static void make_world(known_world *k, double middle, uint64_t seed)
{
    *k = (known_world){.world = new_world(), .middle = fe_make_dvec3(middle, -middle, middle / 2), .dice = {seed}};
    for (int32_t i = 0; i < BODIES; ++i) add_body(k, i);
    step(k->world, 2);
    learn_poses(k);
}

// ---- queries and who counts ----------------------------------------------------------------------------------------
typedef struct query {
    fe_geometry geometry;
    fe_transform start;
    fe_dvec3 way;
    fe_query_filter filter;
    fe_body excluded[3];
    solid mover;
    int32_t is_ray;
} query;

static void random_query(known_world *k, query *q, int32_t is_ray)
{
    fe_query_filter_init(&q->filter, sizeof q->filter);
    if (chance(&k->dice, 0.3)) q->filter.mask = 1u << one_of(&k->dice, 4);
    if (chance(&k->dice, 0.3)) q->filter.flags = FE_QUERY_TRIGGERS;
    if (chance(&k->dice, 0.3)) {
        for (int32_t i = 0; i < 3; ++i) q->excluded[i] = k->bodies[one_of(&k->dice, BODIES)];
        q->filter.excluded = q->excluded, q->filter.excluded_count = 3;
    }
    q->is_ray = is_ray;
    q->start.position = fe__dadd(k->middle, random_vector(&k->dice, 35));
    q->start.rotation = random_rotation(&k->dice);
    q->way = fe__dsub(fe__dadd(k->middle, random_vector(&k->dice, 35)), q->start.position);
    if (chance(&k->dice, 0.2)) q->way = fe__dscale(uniform(&k->dice, 0, 0.2), q->way);
    q->geometry = random_geometry(k, 3);
    if (is_ray) fe_geometry_sphere(&q->geometry, 0);
    q->mover = make_solid(&q->geometry, v_of(q->start.position), q->start.rotation);
}

static int32_t counts(const known_world *k, const query *q, const known_shape *s)
{
    if (!(s->layer & q->filter.mask) || (s->trigger && !(q->filter.flags & FE_QUERY_TRIGGERS))) return 0;
    for (int32_t i = 0; i < q->filter.excluded_count; ++i) {
        if (q->filter.excluded[i] == k->bodies[s->body]) return 0;
    }
    return 1;
}

// Bounding spheres: 0 when they stay apart.
static int32_t comes_near(const query *q, const known_shape *s, real end)
{
    if (s->solid.type == FE_GEOMETRY_PLANE) return 1;
    vec o = q->mover.centre,
        near = nearest_on_edge(o, v_add(v_add(o, v_scale(end, v_of(q->way))), (vec){1e-9L, 0, 0}), s->solid.centre);
    return v_length(v_sub(near, s->solid.centre)) <= s->solid.reach + q->mover.reach + 1e-3L;
}

// A triangle counts from its upper side: the nearest points just before the first touch tell.
static int meets_from_above(const query *q, const known_shape *s, real end)
{
    real low = 0, high = end;
    if (overlap_at(&q->mover, &s->solid, (vec){0, 0, 0}, GRAZE) >= 0) return 1;
    for (int32_t i = 0; i < 60; ++i) {
        real middle = (low + high) / 2;
        if (meets_on_the_way(&q->mover, &s->solid, v_of(q->way), middle, GRAZE) >= 0)
            high = middle;
        else
            low = middle;
    }
    nearness n = nearest(&q->mover, v_scale(low - 1e-5L / (1e-5L + v_length(v_of(q->way))), v_of(q->way)), &s->solid);
    real up = v_dot(v_sub(n.on_mover, n.on_still), s->solid.normal) / n.distance;
    if (!(n.distance > 0) || fabsl(up) < 0.01L) return 0;
    return up > 0 ? 1 : s->rim ? 0 : -1;
}

// 1: it is met before `end`, -1: not, 0: it is so close that both will do
static int meets(const query *q, const known_shape *s, real end)
{
    if (!comes_near(q, s, end)) return -1;
    if (s->triangle >= 0 && q->is_ray) return ray_meets_triangle(q->mover.centre, v_of(q->way), &s->solid, end, GRAZE);
    int met = meets_on_the_way(&q->mover, &s->solid, v_of(q->way), end, GRAZE);
    return met > 0 && s->triangle >= 0 ? meets_from_above(q, s, end) : met;
}

static int overlaps(const query *q, const known_shape *s)
{
    return comes_near(q, s, 0) ? overlap_at(&q->mover, &s->solid, (vec){0, 0, 0}, GRAZE) : -1;
}

static int32_t body_index(const known_world *k, fe_body body)
{
    int32_t i = 0;
    while (i < BODIES && k->bodies[i] != body) ++i;
    return i;
}
static int32_t shape_index(const known_world *k, fe_shape shape, int32_t triangle)
{
    int32_t i = 0;
    while (i < k->count && (k->shapes[i].shape != shape || k->shapes[i].triangle != triangle)) ++i;
    return i;
}

// ---- hits ----------------------------------------------------------------------------------------------------------
static int32_t cast(const known_world *k, const query *q, fe_hit *hit)
{
    return q->is_ray ? fe_world_raycast(k->world, &q->start.position, &q->way, &q->filter, hit)
                     : fe_world_sweep(k->world, &q->geometry, &q->start, &q->way, &q->filter, hit);
}
static int32_t cast_any(const known_world *k, const query *q)
{
    return q->is_ray ? fe_world_raycast_any(k->world, &q->start.position, &q->way, &q->filter)
                     : fe_world_sweep_any(k->world, &q->geometry, &q->start, &q->way, &q->filter);
}
static int32_t cast_all(const known_world *k, const query *q, fe_hit *hits, int32_t capacity)
{
    return q->is_ray
               ? fe_world_raycast_all(k->world, &q->start.position, &q->way, &q->filter, hits, sizeof *hits, capacity)
               : fe_world_sweep_all(k->world, &q->geometry, &q->start, &q->way, &q->filter, hits, sizeof *hits,
                                    capacity);
}

// Signed: below 0 inside. A triangle is not seen from below.
static real distance_of(const solid *s, vec p)
{
    if (s->type == EXACT_TRIANGLE && v_dot(s->normal, v_sub(p, s->vertex[0])) < -1e-9L) return INFINITY;
    solid point = {.type = FE_GEOMETRY_SPHERE, .vertices = 1, .vertex = {p}, .centre = p};
    real d = nearest(&point, (vec){0, 0, 0}, s).distance - s->radius;
    if (s->type != FE_GEOMETRY_BOX || d > 0) return d;
    d = -INFINITY;
    for (int k = 0; k < 3; ++k) d = fmaxl(d, fabsl(v_dot(v_sub(p, s->centre), s->axis[k])) - s->half[k]);
    return d;
}

// A hit is true: the gap to that shape is what it must be, and its normal is where the nearest points say.
static void check_hit(const known_world *k, const query *q, const fe_hit *hit)
{
    int32_t index = shape_index(k, hit->shape, hit->triangle);
    assert_true(index < k->count && k->bodies[k->shapes[index].body] == hit->body);
    const known_shape *s = &k->shapes[index];
    assert_true(counts(k, q, s));
    vec way = v_of(q->way), shift = v_scale(hit->fraction, way);
    FE_WITHIN(hit->fraction, 0, 1);
    FE_NEAR(v_length(v_off(hit->normal)), 1, 1e-6);
    FE_TRUE(v_dot(v_off(hit->normal), way) <= 0);
    if (hit->flags & FE_HIT_STARTED_INSIDE) {
        FE_NEAR(hit->fraction, 0, 0);
        FE_TRUE(overlap_at(&q->mover, &s->solid, shift, GRAZE) >= 0);
        FE_TRUE(v_dot(v_off(hit->normal), way) <= -0.999999L * v_length(way));
        FE_WITHIN(hit->depth, 0, 100);
        return;
    }
    nearness n = nearest(&q->mover, shift, &s->solid);
    real gap = n.distance - q->mover.radius - s->solid.radius, rounding = q->is_ray ? 1e-12L * (1 + v_length(way)) : 0;
    int32_t boxes = q->mover.type == FE_GEOMETRY_BOX && s->solid.type == FE_GEOMETRY_BOX;
    FE_WITHIN(gap, -rounding, boxes ? 1e-4L : q->is_ray ? rounding : 1e-6L);
    vec away = s->solid.type == FE_GEOMETRY_PLANE ? s->solid.normal : v_sub(n.on_mover, n.on_still);
    if (s->triangle >= 0 && q->is_ray) away = s->solid.normal;
    if (v_length(away) > 1e-8L)
        FE_WITHIN(v_length(v_sub(v_scale(1 / v_length(away), away), v_off(hit->normal))), 0, 1e-5);
    // the point is on both surfaces
    vec point = v_of(hit->point);
    real far = 1e-6L + v_length(point) * 1e-15L;
    FE_WITHIN(distance_of(&s->solid, point), -far, far);
    if (!q->is_ray) FE_WITHIN(distance_of(&q->mover, v_sub(point, shift)), -far, far + (boxes ? 1e-4L : 1e-6L));
}

// Nothing else that counts is met before the nearest hit; or, without one, nothing at all.
static int32_t check_nearest(const known_world *k, const query *q)
{
    fe_hit hit;
    memset(&hit, 0x55, sizeof hit);
    int32_t result = cast(k, q, &hit), any = cast_any(k, q);
    assert_true(result == 1 || result == 0);
    assert_int_equal(any, result);
    real end = result == 1 ? hit.fraction : 1;
    if (result == 1) check_hit(k, q, &hit);
    for (int32_t i = 0; i < k->count; ++i) {
        const known_shape *s = &k->shapes[i];
        if (!counts(k, q, s) || (result == 1 && ((s->shape == hit.shape && s->triangle == hit.triangle) ||
                                                 hit.flags & FE_HIT_STARTED_INSIDE)))
            continue;
        if (meets(q, s, end) > 0) {
            print_error("shape %d is met before fraction %.17Lg (result %d, shape %d)\n", i, end, result,
                        result == 1 ? shape_index(k, hit.shape, hit.triangle) : -1);
            fail();
        }
    }
    return result == 1;
}

// Each body that is met is told once, at its first shape, in order; with little room the front of the same.
static int32_t check_all(const known_world *k, const query *q)
{
    static fe_hit hits[BODIES], few[3];
    static int32_t told[BODIES];
    int32_t count = cast_all(k, q, hits, BODIES);
    FE_WITHIN(count, 0, BODIES);
    memset(told, -1, sizeof told);
    for (int32_t i = 0; i < count; ++i) {
        check_hit(k, q, &hits[i]);
        int32_t body = body_index(k, hits[i].body);
        assert_int_equal(told[body], -1);
        told[body] = i;
        if (i == 0) continue;
        FE_TRUE(hits[i - 1].fraction < hits[i].fraction ||
                (hits[i - 1].fraction == hits[i].fraction && body_index(k, hits[i - 1].body) < body));
    }
    for (int32_t i = 0; i < k->count; ++i) {
        const known_shape *s = &k->shapes[i];
        const fe_hit *hit = told[s->body] >= 0 ? &hits[told[s->body]] : NULL;
        if (!counts(k, q, s) ||
            (hit && ((hit->shape == s->shape && hit->triangle == s->triangle) || hit->flags & FE_HIT_STARTED_INSIDE)))
            continue;
        FE_TRUE(meets(q, s, hit ? hit->fraction : 1) <= 0);
    }
    assert_int_equal(cast_all(k, q, few, 3), count);
    assert_memory_equal(few, hits, sizeof *hits * (size_t)(count < 3 ? count : 3));
    assert_int_equal(cast_all(k, q, NULL, 0), count);
    fe_hit first;
    assert_int_equal(cast(k, q, &first), count > 0 ? 1 : 0);
    if (count > 0) assert_memory_equal(&first, hits, sizeof first);
    return count;
}

static void casts_find_what_a_walk_finds(int32_t is_ray)
{
    static known_world k;
    const double middles[] = {0, 1e6};
    query q;
    for (uint64_t w = 0; w < 2; ++w) {
        int64_t hits = 0, all = 0;
        make_world(&k, middles[w], UINT64_C(88172645463325252) + w);
        for (int32_t i = 0; i < queries / 2; ++i) {
            random_query(&k, &q, is_ray);
            hits += check_nearest(&k, &q);
            all += check_all(&k, &q);
        }
        FE_WITHIN(hits, queries / 8, queries / 2);
        FE_WITHIN(all, hits, 100 * hits);
        OK(fe_world_destroy(k.world));
    }
}

static void rays_find_what_a_walk_finds(void **state)
{
    (void)state;
    casts_find_what_a_walk_finds(1);
}

static void sweeps_find_what_a_walk_finds(void **state)
{
    (void)state;
    casts_find_what_a_walk_finds(0);
}

// ---- overlaps ------------------------------------------------------------------------------------------------------
static int32_t check_overlap(const known_world *k, const query *q)
{
    static fe_body found[BODIES], few[2];
    static int32_t told[BODIES];
    int32_t count = fe_world_overlap(k->world, &q->geometry, &q->start, &q->filter, found, BODIES), last = -1;
    FE_WITHIN(count, 0, BODIES);
    memset(told, 0, sizeof told);
    for (int32_t i = 0; i < count; ++i) {
        int32_t body = body_index(k, found[i]);
        FE_TRUE(body > last); // bodies were made in this order
        told[body] = 1, last = body;
    }
    int best[BODIES];
    for (int32_t i = 0; i < BODIES; ++i) best[i] = -1;
    for (int32_t i = 0; i < k->count; ++i) {
        const known_shape *s = &k->shapes[i];
        int o = counts(k, q, s) ? overlaps(q, s) : -1;
        if (o > best[s->body]) best[s->body] = o;
    }
    for (int32_t i = 0; i < BODIES; ++i) {
        if (best[i] != 0) FE_TRUE(told[i] == (best[i] > 0));
    }
    assert_int_equal(fe_world_overlap_any(k->world, &q->geometry, &q->start, &q->filter), count > 0 ? 1 : 0);
    assert_int_equal(fe_world_overlap(k->world, &q->geometry, &q->start, &q->filter, few, 2), count);
    assert_memory_equal(few, found, sizeof *few * (size_t)(count < 2 ? count : 2));
    return count;
}

static void overlaps_find_what_a_walk_finds(void **state)
{
    (void)state;
    static known_world k;
    query q;
    make_world(&k, 3000, UINT64_C(0x9e3779b97f4a7c15));
    int64_t all = 0;
    for (int32_t i = 0; i < queries; ++i) {
        random_query(&k, &q, i % 4 == 0);
        all += check_overlap(&k, &q);
    }
    FE_WITHIN(all, queries / 4, 20 * queries);
    OK(fe_world_destroy(k.world));
}

// What overlaps can be moved out along the normal by the depth, and not by less.
static void the_way_out_of_an_overlap_is_as_long_as_told(void **state)
{
    (void)state;
    static known_world k;
    query q;
    make_world(&k, 0, 12345);
    int32_t checked = 0;
    for (int32_t i = 0; i < queries; ++i) {
        fe_hit hit;
        random_query(&k, &q, 0);
        q.way = fe_make_dvec3(0, 0, 0);
        if (cast(&k, &q, &hit) != 1) continue;
        assert_int_equal(hit.flags, FE_HIT_STARTED_INSIDE);
        const solid *still = &k.shapes[shape_index(&k, hit.shape, hit.triangle)].solid;
        vec n = v_scale(1 / v_length(v_off(hit.normal)), v_off(hit.normal));
        real depth = hit.depth, rounding = 1e-5L; // floats: 1e-7 of depth and normal, over some 10 m
        FE_TRUE(overlap_at(&q.mover, still, v_scale(depth + rounding, n), 1e-7L) <= 0);
        // over a part of a triangle the way out may be shorter than that over its plane
        if (hit.triangle < 0) FE_TRUE(overlap_at(&q.mover, still, v_scale(depth - rounding, n), 1e-7L) >= 0);
        checked += 1;
    }
    FE_WITHIN(checked, queries / 8, queries);
    OK(fe_world_destroy(k.world));
}

// ---- the closest point ---------------------------------------------------------------------------------------------
static void the_closest_point_is_that_of_a_walk(void **state)
{
    (void)state;
    static known_world k;
    query q;
    make_world(&k, 1e6, 777);
    int32_t found = 0;
    for (int32_t i = 0; i < queries; ++i) {
        random_query(&k, &q, 1);
        double most = chance(&k.dice, 0.5) ? uniform(&k.dice, 0, 2) : 1e4;
        real best = INFINITY;
        vec p = v_of(q.start.position);
        for (int32_t s = 0; s < k.count; ++s) {
            if (counts(&k, &q, &k.shapes[s])) best = fminl(best, distance_of(&k.shapes[s].solid, p));
        }
        fe_closest c;
        int32_t result = fe_world_closest_point(k.world, &q.start.position, most, &q.filter, &c);
        if (result == 0) {
            FE_TRUE(best > most - 1e-9);
            continue;
        }
        assert_int_equal(result, 1);
        found += 1;
        const known_shape *s = &k.shapes[shape_index(&k, c.shape, c.triangle)];
        assert_true(counts(&k, &q, s) && k.bodies[s->body] == c.body);
        FE_NEAR(c.distance, best, 1e-9);
        FE_NEAR(distance_of(&s->solid, v_of(c.point)), 0, 2e-9); // a double at 1e6 m
        vec back = v_sub(p, v_scale(c.distance, v_off(c.normal)));
        FE_NEAR(v_length(v_sub(back, v_of(c.point))), 0, 2e-7 * (1 + fabs(c.distance)));
        fe_closest alone;
        HIT(fe_shape_closest_point(k.world, c.shape, &q.start.position, &alone));
        assert_memory_equal(&alone, &c, sizeof c);
    }
    FE_WITHIN(found, queries / 2, queries);
    OK(fe_world_destroy(k.world));
}

int main(int argc, char **argv)
{
    if (argc > 1) queries = atoi(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_find_what_a_walk_finds),
        cmocka_unit_test(sweeps_find_what_a_walk_finds),
        cmocka_unit_test(overlaps_find_what_a_walk_finds),
        cmocka_unit_test(the_way_out_of_an_overlap_is_as_long_as_told),
        cmocka_unit_test(the_closest_point_is_that_of_a_walk),
    };
    return cmocka_run_group_tests_name("walk", tests, NULL, NULL);
}
