// The ray against every shape asked one by one: nearest, ties, filters, starts inside, far from the origin; and its
// errors.
//
// Reference: fe__form_ray (tested against geometry on its own) over all shapes, with poses composed here, in the order
// of creation. Nothing of the trees.
#include "api/api_test.h"

#include "collision/cast/cast_kinds.h"

// ---- a random world and its reference ------------------------------------------------------------------------------

enum { BODIES = 150, SHAPES = 400 };

typedef struct known_shape {
    fe_shape shape;
    fe_body body;
    fe__form form;
    fe_frame frame;
    uint32_t layer;
    int32_t trigger;
} known_shape;

typedef struct known_world {
    fe_world *world;
    fe_dvec3 middle;
    known_shape shapes[SHAPES];
    int32_t count;
    fe_body bodies[BODIES];
    uint32_t random;
} known_world;

static double uniform(known_world *k, double low, double high)
{
    k->random = k->random * 1664525u + 1013904223u;
    return low + (high - low) * (k->random >> 8) / (1 << 24);
}

// Drawn one after the other: compilers may evaluate the members of an initializer in any order.
static fe_dvec3 random_vector(known_world *k, double most)
{
    double x = uniform(k, -most, most), y = uniform(k, -most, most), z = uniform(k, -most, most);
    return fe_make_dvec3(x, y, z);
}

static fe_quat random_rotation(known_world *k)
{
    fe_vec3 u = fe__narrow(random_vector(k, 1));
    return (fe_quat){u.x, u.y, u.z, (float)uniform(k, 0.1, 1)};
}

static void random_geometry(known_world *k, fe_geometry *geometry, fe__form *form, int32_t planes)
{
    float a = (float)uniform(k, 0.1, 2), b = (float)uniform(k, 0.1, 2), c = (float)uniform(k, 0.1, 2);
    *form = (fe__form){0};
    switch ((int)uniform(k, 0, planes ? 3.1 : 3)) {
    case 0:
        fe_geometry_sphere(geometry, a);
        form->type = FE__FORM_SPHERE;
        form->radius = a;
        break;
    case 1:
        fe_geometry_capsule(geometry, a, b);
        form->type = FE__FORM_CAPSULE;
        form->half_height = a, form->radius = b;
        break;
    case 2:
        fe_geometry_box(geometry, a, b, c);
        form->type = FE__FORM_BOX;
        form->half = fe_make_vec3(a, b, c);
        break;
    default:
        fe_geometry_plane(geometry, 0, 1, 0, -40);
        form->type = FE__FORM_PLANE;
        form->normal = fe_make_vec3(0, 1, 0), form->distance = -40;
        break;
    }
}

static void add_random_shape(known_world *k, fe_body body, int32_t type)
{
    known_shape *s = &k->shapes[k->count++];
    fe_geometry geometry;
    fe_shape_def def;
    fe_shape_def_init(&def, sizeof def);
    random_geometry(k, &geometry, &s->form, type == FE_BODY_STATIC);
    if (uniform(k, 0, 1) < 0.7) {
        def.frame.position = fe__narrow(random_vector(k, 2));
        def.frame.rotation = random_rotation(k);
    }
    def.layer = 1u << (int)uniform(k, 0, 3);
    def.trigger = uniform(k, 0, 1) < 0.2;
    s->body = body, s->layer = def.layer, s->trigger = def.trigger;
    OK(fe_shape_create(k->world, body, &def, &geometry, &s->shape));
    OK(fe_shape_get_frame(k->world, s->shape, &s->frame));
}

static void make_world(known_world *k, double middle, uint32_t seed)
{
    *k = (known_world){.world = new_world(), .middle = fe_make_dvec3(middle, -middle, middle / 2), .random = seed};
    for (int i = 0; i < BODIES; ++i) {
        fe_body_def def;
        fe_body_def_init(&def, sizeof def);
        def.type = (int32_t)uniform(k, 0, 3);
        def.transform.position = fe__dadd(k->middle, random_vector(k, 30));
        def.transform.rotation = random_rotation(k);
        OK(fe_body_create(k->world, &def, &k->bodies[i]));
        int32_t shapes = 1 + (int32_t)uniform(k, 0, 2.5);
        for (int32_t s = 0; s < shapes && k->count < SHAPES; ++s) add_random_shape(k, k->bodies[i], def.type);
    }
}

typedef struct answer {
    int32_t index; // of the shape, -1: nothing
    double fraction;
    fe_dvec3 normal;
    double depth;
    int32_t inside;
} answer;

static int32_t is_in(const fe_query_filter *filter, const known_shape *s)
{
    if (!(s->layer & filter->mask) || (s->trigger && !(filter->flags & FE_QUERY_TRIGGERS))) return 0;
    for (int32_t i = 0; i < filter->excluded_count; ++i) {
        if (filter->excluded[i] == s->body) return 0;
    }
    return 1;
}

// Shapes are asked in the order of creation of their bodies (each body got all its shapes before the next was made), so
// that < keeps the first.
static answer reference(const known_world *k, fe_dvec3 origin, fe_dvec3 translation, const fe_query_filter *filter)
{
    answer best = {.index = -1, .fraction = 2};
    for (int32_t i = 0; i < k->count; ++i) {
        const known_shape *s = &k->shapes[i];
        if (!is_in(filter, s)) continue;
        fe_transform t = body_transform(k->world, s->body);
        fe__pose body = {t.position, t.rotation}, pose = body;
        int32_t centred = s->frame.position.x == 0.0f && s->frame.rotation.w == 1.0f;
        if (!centred) pose = fe__compose(&body, s->frame.position, s->frame.rotation);
        if (s->form.type == FE__FORM_SPHERE) pose.rotation = fe__identity(); // a ball is asked without turning
        fe_dvec3 o = fe__drotate_back(pose.rotation, fe__dsub(origin, pose.position)),
                 d = fe__drotate_back(pose.rotation, translation);
        fe__ray_hit hit;
        if (!fe__form_ray(&s->form, o, d, 1.0, &hit) || hit.t >= best.fraction) continue;
        best = (answer){i, hit.t, fe__drotate(pose.rotation, hit.normal), hit.depth, hit.inside};
    }
    return best;
}

static int32_t compare(known_world *k, fe_dvec3 origin, fe_dvec3 translation, const fe_query_filter *filter)
{
    answer expected = reference(k, origin, translation, filter);
    fe_hit hit;
    memset(&hit, 0x55, sizeof hit);
    int32_t result = fe_world_raycast(k->world, &origin, &translation, filter, &hit);
    if (expected.index < 0) {
        assert_int_equal(result, 0);
        assert_true(hit.body == 0x5555555555555555ull); // untouched
        return 0;
    }
    assert_int_equal(result, 1);
    const known_shape *s = &k->shapes[expected.index];
    assert_true(hit.shape == s->shape && hit.body == s->body);
    FE_NEAR(hit.fraction, expected.fraction, 0); // the same computation: bit for bit
    fe_dvec3 point = {origin.x + hit.fraction * translation.x, origin.y + hit.fraction * translation.y,
                      origin.z + hit.fraction * translation.z};
    FE_TRUE(hit.point.x == point.x && hit.point.y == point.y && hit.point.z == point.z);
    FE_NEAR(hit.normal.x, expected.normal.x, 1e-6), FE_NEAR(hit.normal.y, expected.normal.y, 1e-6),
        FE_NEAR(hit.normal.z, expected.normal.z, 1e-6);
    double length = sqrt(fe__ddot(fe__widen(hit.normal), fe__widen(hit.normal)));
    FE_NEAR(length, 1, 1e-6);
    FE_TRUE(fe__ddot(fe__widen(hit.normal), translation) <= 1e-7 * sqrt(fe__ddot(translation, translation)));
    assert_int_equal(hit.triangle, -1);
    assert_int_equal((hit.flags & FE_HIT_STARTED_INSIDE) != 0, expected.inside);
    FE_NEAR(hit.depth, (float)expected.depth, 0);
    if (expected.inside) FE_NEAR(hit.fraction, 0, 0);
    return 1;
}

static fe_dvec3 somewhere(known_world *k) { return fe__dadd(k->middle, random_vector(k, 40)); }

static int32_t compare_many(known_world *k, int32_t rays)
{
    int32_t hits = 0;
    fe_body excluded[3];
    for (int32_t i = 0; i < rays; ++i) {
        fe_dvec3 from = somewhere(k), to = somewhere(k), translation = fe__dsub(to, from);
        fe_query_filter filter;
        fe_query_filter_init(&filter, sizeof filter);
        if (i % 3 == 1) filter.mask = 1u << (i / 3 % 4);
        if (i % 5 == 2) filter.flags = FE_QUERY_TRIGGERS;
        if (i % 4 == 3) {
            for (int e = 0; e < 3; ++e) excluded[e] = k->bodies[(int)uniform(k, 0, BODIES)];
            filter.excluded = excluded, filter.excluded_count = 3;
        }
        hits += compare(k, from, translation, &filter);
        if (i % 7 == 0) hits += compare(k, from, fe_make_dvec3(0, 0, 0), &filter);
    }
    return hits;
}

// At the origin, and where a float would be 64 m off.
static void a_ray_finds_what_a_walk_over_all_shapes_finds(void **state)
{
    (void)state;
    static known_world k;
    const double middles[] = {0, 1e6, 5e8};
    for (uint32_t i = 0; i < 3; ++i) {
        make_world(&k, middles[i], 7 + i);
        int32_t hits = compare_many(&k, 3000);
        FE_WITHIN(hits, 300, 3500);
        OK(fe_world_destroy(k.world));
    }
}

// Queries see bodies where the step left them, and after the trees were built anew.
static void a_ray_finds_it_while_the_world_moves(void **state)
{
    (void)state;
    static known_world k;
    make_world(&k, 100, 42);
    for (int i = 0; i < 5; ++i) {
        step(k.world, 7);
        FE_WITHIN(compare_many(&k, 200), 20, 230);
        if (i == 2) OK(fe_world_optimize(k.world));
    }
    OK(fe_world_destroy(k.world));
}

// ---- laws ----------------------------------------------------------------------------------------------------------

static fe_hit cast(const fe_world *world, fe_dvec3 from, fe_dvec3 translation)
{
    fe_hit hit;
    HIT(fe_world_raycast(world, &from, &translation, NULL, &hit));
    return hit;
}

// At equal fractions the body created first is hit, whatever its slot, its tree, its type.
static void ties_go_to_the_body_created_first(void **state)
{
    (void)state;
    fe_dvec3 from = {0, 10, 0}, down = {0, -20, 0};
    for (int first = 0; first < 3; ++first) {
        fe_world *world = new_world();
        fe_body spare = new_box(world, 50, 0, 0); // its slot is reused by the last
        fe_body bodies[3];
        OK(fe_body_destroy(world, spare));
        for (int i = 0; i < 3; ++i) {
            bodies[i] = new_body(world, (first + i) % 3, 0, 0, 0);
            fe_geometry plane;
            fe_geometry_plane(&plane, 0, 1, 0, 0.5f);
            if ((first + i) % 3 == FE_BODY_STATIC)
                add_shape(world, bodies[i], &plane);
            else
                add_box(world, bodies[i], 0.5f);
        }
        assert_true(cast(world, from, down).body == bodies[0]);
        OK(fe_body_set_enabled(world, bodies[0], 0));
        assert_true(cast(world, from, down).body == bodies[1]);
        OK(fe_body_set_enabled(world, bodies[0], 1)); // back in the tree, still the first
        assert_true(cast(world, from, down).body == bodies[0]);
        OK(fe_body_destroy(world, bodies[0]));
        fe_body last = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
        add_box(world, last, 0.5f);
        assert_true(cast(world, from, down).body == bodies[1]); // the slot of the first, the newest body
        OK(fe_world_destroy(world));
    }
}

static void ties_within_a_body_go_to_the_shape_created_first(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_STATIC, 0, 0, 0);
    fe_shape first = add_box(world, body, 1), second = add_box(world, body, 1);
    assert_true(cast(world, fe_make_dvec3(0.1, 5, 0), fe_make_dvec3(0, -10, 0)).shape == first);
    OK(fe_shape_destroy(world, first));
    add_box(world, body, 1);
    assert_true(cast(world, fe_make_dvec3(0.1, 5, 0), fe_make_dvec3(0, -10, 0)).shape == second);
    OK(fe_world_destroy(world));
}

static void the_end_of_the_segment_still_counts(void **state)
{
    (void)state;
    fe_world *world = new_world();
    new_ground(world);
    fe_dvec3 from = {0, 8, 0}, just = {0, -8, 0}, short_of = {0, -7.9999999, 0};
    fe_hit hit;
    FE_NEAR(cast(world, from, just).fraction, 1, 0);
    assert_int_equal(fe_world_raycast(world, &from, &short_of, NULL, &hit), 0);
    OK(fe_world_destroy(world));
}

// A start inside: fraction 0, the normal against the direction; without a direction the shortest way out.
static void a_start_inside_is_a_hit_at_once(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    add_box(world, body, 1);
    fe_hit hit = cast(world, fe_make_dvec3(0.75, 0, 0), fe_make_dvec3(0, 0, 3));
    assert_true(hit.flags == FE_HIT_STARTED_INSIDE);
    FE_NEAR(hit.fraction, 0, 0), FE_NEAR(hit.normal.z, -1, 0), FE_NEAR(hit.depth, 0.25, 1e-7),
        FE_NEAR(hit.point.x, 0.75, 0);
    hit = cast(world, fe_make_dvec3(0.75, 0, 0), fe_make_dvec3(0, 0, 0));
    FE_NEAR(hit.normal.x, 1, 1e-7), FE_NEAR(hit.depth, 0.25, 1e-7);
    fe_dvec3 outside = {2, 0, 0}, nowhere = {0, 0, 0};
    assert_int_equal(fe_world_raycast(world, &outside, &nowhere, NULL, &hit), 0);
    OK(fe_world_destroy(world));
}

static void an_empty_world_is_missed(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_dvec3 from = {0, 0, 0}, far = {1e10, -1e10, 1e10};
    fe_hit hit;
    assert_int_equal(fe_world_raycast(world, &from, &far, NULL, &hit), 0);
    fe_body lonely = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0); // no shape
    assert_int_equal(fe_world_raycast(world, &from, &far, NULL, &hit), 0);
    add_box(world, lonely, 1);
    HIT(fe_world_raycast(world, &from, &far, NULL, &hit));
    OK(fe_body_destroy(world, lonely));
    assert_int_equal(fe_world_raycast(world, &from, &far, NULL, &hit), 0);
    OK(fe_world_destroy(world));
}

// ---- arguments -----------------------------------------------------------------------------------------------------

static void bad_rays_are_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body box = new_box(world, 0, 0, 0);
    fe_dvec3 from = {0, 10, 0}, down = {0, -20, 0}, nan = {0, (double)NOT_A_NUMBER, 0},
             endless = {0, 0, (double)-INFINITE}, huge = {1e11, 0, 0};
    fe_hit hit, untouched;
    memset(&hit, 0x55, sizeof hit);
    untouched = hit;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_raycast(world, NULL, &down, NULL, &hit));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_raycast(world, &from, NULL, NULL, &hit));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_raycast(world, &from, &down, NULL, NULL));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_world_raycast(NULL, &from, &down, NULL, &hit));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_raycast(world, &nan, &down, NULL, &hit));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_raycast(world, &from, &endless, NULL, &hit));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_raycast(world, &huge, &down, NULL, &hit));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_raycast(world, &from, &huge, NULL, &hit));
    SAYS("translation.x is 1e+11");
    fe_query_filter good, bad;
    fe_query_filter_init(&good, sizeof good);
    fe_query_filter_init(NULL, sizeof good);
    assert_true(good.mask == 0xFFFFFFFF && good.flags == 0 && good.excluded_count == 0);
    bad = good, bad.flags = 2;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_raycast(world, &from, &down, &bad, &hit));
    bad = good, bad.excluded_count = 1;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_raycast(world, &from, &down, &bad, &hit));
    bad = good, bad.excluded_count = -1;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_raycast(world, &from, &down, &bad, &hit));
    bad = good, bad.struct_size = 7;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_raycast(world, &from, &down, &bad, &hit));
    assert_memory_equal(&hit, &untouched, sizeof hit);

    // stale exclusions are ignored, an older client's filter ends before them
    fe_body gone = new_box(world, 5, 0, 0), excluded[2] = {gone, 12345};
    OK(fe_body_destroy(world, gone));
    good.excluded = excluded, good.excluded_count = 2;
    HIT(fe_world_raycast(world, &from, &down, &good, &hit));
    excluded[1] = box;
    assert_int_equal(fe_world_raycast(world, &from, &down, &good, &hit), 0);
    good.struct_size = offsetof(fe_query_filter, excluded_count);
    HIT(fe_world_raycast(world, &from, &down, &good, &hit));
    OK(fe_world_destroy(world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ray_finds_what_a_walk_over_all_shapes_finds),
        cmocka_unit_test(a_ray_finds_it_while_the_world_moves),
        cmocka_unit_test(ties_go_to_the_body_created_first),
        cmocka_unit_test(ties_within_a_body_go_to_the_shape_created_first),
        cmocka_unit_test(the_end_of_the_segment_still_counts),
        cmocka_unit_test(a_start_inside_is_a_hit_at_once),
        cmocka_unit_test(an_empty_world_is_missed),
        cmocka_unit_test(bad_rays_are_refused),
    };
    return cmocka_run_group_tests_name("raycast", tests, NULL, NULL);
}
