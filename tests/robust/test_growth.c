// test_growth.c - what a call costs does not grow with what it has nothing to do with, nor a level with its square:
// instructions are counted, at one size and at many times that.
#include "fe_test.h"
#include "feather.h"
#include "support/count_steps.h"

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_goes_with_its_own_ignored_pairs),
    };
    return cmocka_run_group_tests_name("growth", tests, NULL, NULL);
}
