// test_growth.c - what a call costs does not grow with what it has nothing to do with, nor a level with its square:
// instructions are counted, at one size and at many times that.
#include "fe_test.h"
#include "feather.h"
#include "support/count_steps.h"
#include "world/world.h"

#define OK(call) assert_int_equal(call, FE_OK)

static fe_world *new_world(void)
{
    fe_world *world = NULL;
    OK(fe_world_create(NULL, &world));
    return world;
}

static fe_body new_body(fe_world *world, int32_t type, double x)
{
    fe_body_def def;
    fe_body body = 0;
    fe_body_def_init(&def, sizeof def);
    def.type = type;
    def.transform.position.x = x;
    OK(fe_body_create(world, &def, &body));
    return body;
}

// A size, and the call at it. Each scene is made before the count begins.
typedef struct scene {
    fe_world *world;
    fe_body body;
    fe_shape shape;
    int32_t count;
} scene;

// What `call` takes at `large`, in what it takes at `small`; 0: it cannot be counted here
static double growth_of(void (*make)(scene *s), void (*call)(void *s), int32_t small, int32_t large)
{
    double steps[2];
    for (int32_t i = 0; i < 2; ++i) {
        scene s = {.world = new_world(), .count = i ? large : small};
        make(&s);
        steps[i] = (double)count_steps(call, &s);
        OK(fe_world_destroy(s.world));
        if (steps[i] < 0.0) skip();
    }
    return steps[1] / steps[0];
}

// ---- ignored pairs -------------------------------------------------------------------------------------------------
static void make_ignoring_row(scene *s)
{
    fe_body last = new_body(s->world, FE_BODY_DYNAMIC, 0.0);
    for (int32_t i = 1; i < s->count; ++i) {
        fe_body next = new_body(s->world, FE_BODY_DYNAMIC, 3.0 * i);
        OK(fe_world_ignore_collision(s->world, last, next, 1));
        if (i == s->count / 2) s->body = next;
        last = next;
    }
}

static void destroy_body(void *argument)
{
    const scene *s = argument;
    (void)fe_body_destroy(s->world, s->body);
}

// it ignores two others, in a world of 250 or of 16 000 such pairs: a search in a table of them may be a little longer
static void a_body_goes_with_its_own_ignored_pairs(void **state)
{
    (void)state;
    FE_WITHIN(growth_of(make_ignoring_row, destroy_body, 250, 16000), 0.5, 2.0);
}

// ---- many shapes on one body ---------------------------------------------------------------------------------------
static fe_shape add_box(fe_world *world, fe_body body, int32_t place)
{
    fe_shape_def def;
    fe_geometry box;
    fe_shape shape = 0;
    fe_shape_def_init(&def, sizeof def);
    def.frame.position = fe_make_vec3(1.5f * (float)(place % 64), 0.0f, 1.5f * (float)(place / 64));
    fe_geometry_box(&box, 0.5f, 0.5f, 0.5f);
    OK(fe_shape_create(world, body, &def, &box, &shape));
    return shape;
}

static void make_shapes(scene *s)
{
    for (int32_t i = 0; i < s->count; ++i) {
        fe_shape shape = add_box(s->world, s->body, i);
        if (i == s->count / 2) s->shape = shape;
    }
    OK(fe_world_step(s->world, 1.0f / 60.0f));
}

static void make_level(scene *s)
{
    s->body = new_body(s->world, FE_BODY_STATIC, 0.0);
    make_shapes(s);
}

static void make_lift(scene *s)
{
    s->body = new_body(s->world, FE_BODY_KINEMATIC, 0.0);
    make_shapes(s);
}

static void make_raft_of_given_mass(scene *s)
{
    s->body = new_body(s->world, FE_BODY_DYNAMIC, 0.0);
    OK(fe_body_set_mass(s->world, s->body, 5.0f));
    make_shapes(s);
}

static void add_a_box(void *argument)
{
    const scene *s = argument;
    (void)add_box(s->world, s->body, s->count);
}

static void remove_a_box(void *argument)
{
    const scene *s = argument;
    (void)fe_shape_destroy(s->world, s->shape);
}

static void make_a_box_heavier(void *argument)
{
    const scene *s = argument;
    (void)fe_shape_set_density(s->world, s->shape, 500.0f);
}

static void exchange_a_box(void *argument)
{
    const scene *s = argument;
    fe_geometry sphere;
    fe_geometry_sphere(&sphere, 0.3f);
    (void)fe_shape_set_geometry(s->world, s->shape, &sphere);
}

// The tree is a level or two deeper, and an array may double: not twice the work for 16 times the shapes
static void a_shape_costs_the_same_on_a_body_of_many(void **state)
{
    (void)state;
    FE_WITHIN(growth_of(make_level, add_a_box, 250, 4000), 0.3, 2.0);
    FE_WITHIN(growth_of(make_level, remove_a_box, 250, 4000), 0.3, 2.0);
    FE_WITHIN(growth_of(make_level, make_a_box_heavier, 250, 4000), 0.3, 2.0);
    FE_WITHIN(growth_of(make_level, exchange_a_box, 250, 4000), 0.3, 2.0);
    FE_WITHIN(growth_of(make_lift, add_a_box, 250, 4000), 0.3, 2.0);
    FE_WITHIN(growth_of(make_raft_of_given_mass, add_a_box, 250, 4000), 0.3, 2.0);
}

// What a level had is not in what a step reads of it: the reach and the thickness are those of the shapes that it has.
static void a_level_forgets_the_shapes_that_are_gone(void **state)
{
    (void)state;
    float reach[2], thickness[2];
    for (int32_t k = 0; k < 2; ++k) {
        fe_world *world = new_world();
        fe_body level = new_body(world, FE_BODY_STATIC, 0.0);
        fe_geometry slab;
        fe_shape huge = 0;
        fe_geometry_box(&slab, 900.0f, 0.005f, 900.0f);
        for (int32_t i = 0; i < 40; ++i) (void)add_box(world, level, i);
        if (k) OK(fe_shape_create(world, level, NULL, &slab, &huge));
        if (k) OK(fe_shape_destroy(world, huge));
        OK(fe_world_step(world, 1.0f / 60.0f));
        const fe__body *body = world->bodies + fe__id_slot_of(level);
        reach[k] = body->reach, thickness[k] = body->thickness;
        OK(fe_world_destroy(world));
    }
    FE_TRUE(reach[0] == reach[1] && thickness[0] == thickness[1]);
}

// ---- what sleeps ---------------------------------------------------------------------------------------------------
static void add_sleeper(fe_world *world, double x, double y, double z)
{
    fe_body_def def;
    fe_body body = 0;
    fe_shape shape = 0;
    fe_geometry box;
    fe_body_def_init(&def, sizeof def);
    def.awake = 0;
    def.transform = fe_make_transform(x, y, z);
    OK(fe_body_create(world, &def, &body));
    fe_geometry_box(&box, 0.5f, 0.5f, 0.5f);
    OK(fe_shape_create(world, body, NULL, &box, &shape));
}

// Bytes that the world grows by while a ball rolls against a box that sleeps 100 m from a heap that sleeps too
static double growth_by_a_touch(int32_t side, int32_t *out_heap_pairs)
{
    fe_world *world = new_world();
    fe_counters counters = {.struct_size = sizeof counters};
    fe_geometry ball;
    fe_shape shape = 0;
    const fe_vec3 none = {0}, speed = {5.0f, 0.0f, 0.0f};
    OK(fe_world_set_gravity(world, &none));
    for (int32_t i = 0; i < side * side * side; ++i)
        add_sleeper(world, 1.002 * (i % side), 1.002 * (i / side % side), 1.002 * (i / (side * side)));
    add_sleeper(world, -100.0, 0.0, 0.0);
    fe_body rolling = new_body(world, FE_BODY_DYNAMIC, -110.0);
    fe_geometry_sphere(&ball, 0.5f);
    OK(fe_shape_create(world, rolling, NULL, &ball, &shape));
    OK(fe_body_set_linear_velocity(world, rolling, &speed));
    OK(fe_world_step(world, 1.0f / 60.0f));
    OK(fe_world_get_counters(world, &counters));
    double before = (double)counters.bytes;
    *out_heap_pairs = counters.pairs;
    for (int32_t i = 0; i < 180 && counters.awake_bodies == 1; ++i) {
        OK(fe_world_step(world, 1.0f / 60.0f));
        OK(fe_world_get_counters(world, &counters));
    }
    assert_int_equal(counters.awake_bodies, 2);
    OK(fe_world_destroy(world));
    return (double)counters.bytes - before;
}

// It reserves for what hangs together with the box, not for the heap, whose rows would take at least 230 bytes a
// contact. What it takes more beside a heap is lists by body: of clusters 12 bytes, of the step some more.
static void a_touch_wakes_no_memory_of_a_heap_elsewhere(void **state)
{
    (void)state;
    enum { SIDE = 12, LIST_BYTES = 64 * SIDE * SIDE * SIDE };
    int32_t few, many;
    double alone = growth_by_a_touch(0, &few), beside = growth_by_a_touch(SIDE, &many);
    FE_TRUE(many > 5000);
    FE_WITHIN(beside, 0.0, alone + LIST_BYTES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_goes_with_its_own_ignored_pairs),
        cmocka_unit_test(a_shape_costs_the_same_on_a_body_of_many),
        cmocka_unit_test(a_level_forgets_the_shapes_that_are_gone),
        cmocka_unit_test(a_touch_wakes_no_memory_of_a_heap_elsewhere),
    };
    return cmocka_run_group_tests_name("growth", tests, NULL, NULL);
}
