// test_stack.c - how much of the caller's stack the library takes: whole plays, each on a painted stack of a thread's
// own.
//
// 64 KB is what wasm-ld gives a whole program, variables and all, where what overflows is not noticed. So half of it is
// the bound for whatever is called; what a play and the C library take counts too.
#include "fe_test.h"
#include "support/play.h"

#include <pthread.h>
#include <string.h>

#ifdef FE_SANITIZED // whose own records of a thread, nearly a megabyte, lie there too: only the plays themselves count
enum { STACK = 4 * 1024 * 1024, MOST = STACK, SHORTER = 10 };
#else
enum { STACK = 64 * 1024, MOST = STACK / 2, SHORTER = 1 };
#endif
enum { PAINT = 0xA5, PAGE = 4096 };

typedef struct visit {
    const script *script;
    int32_t steps;
    play play;
    const unsigned char *top; // of the stack, below what the system keeps there
} visit;

static void *play_script(void *argument)
{
    visit *v = argument;
    v->top = __builtin_frame_address(0);
    play_until(&v->play, v->script, v->steps);
    return NULL;
}

// bytes of stack that so many steps of a script take
static int32_t deepest(const script *s, int32_t steps, int32_t simd)
{
    static _Alignas(PAGE) unsigned char stack[STACK];
    static visit v;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.simd = simd;
    fe_world *world = NULL;
    FE_TRUE(fe_world_create(&def, &world) == FE_OK);
    v = (visit){.script = s, .steps = steps / SHORTER};
    play_begin(&v.play, world);
    memset(stack, PAINT, sizeof stack);
    pthread_attr_t attributes;
    pthread_t thread;
    FE_TRUE(!pthread_attr_init(&attributes) && !pthread_attr_setstack(&attributes, stack, sizeof stack));
    FE_TRUE(!pthread_create(&thread, &attributes, play_script, &v) && !pthread_join(thread, NULL));
    pthread_attr_destroy(&attributes);
    assert_int_equal(v.play.errors, 0);
    fe_world_destroy(world);
    const unsigned char *low = stack;
    while (low < v.top && *low == PAINT) ++low;
    print_message("%s: %d bytes of stack\n", s->name, (int)(v.top - low));
    return (int32_t)(v.top - low);
}

static void whatever_is_called_takes_half_of_a_small_stack_at_most(void **state)
{
    static const int32_t sets[] = {FE_SIMD_AUTO, FE_SIMD_PLAIN};
    (void)state;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; ++i) {
        FE_WITHIN(deepest(&script_brief, 200, sets[i]), 1, MOST); // every kind of call
        FE_WITHIN(deepest(&script_mixed, 100, sets[i]), 1, MOST); // every pair of shapes
        FE_WITHIN(deepest(&script_terrain, 50, sets[i]), 1, MOST);
        FE_WITHIN(deepest(&script_fast, 50, sets[i]), 1, MOST);
        FE_WITHIN(deepest(&script_joints, 50, sets[i]), 1, MOST);
        FE_WITHIN(deepest(&script_cloth, 20, sets[i]), 1, MOST); // a large batch
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whatever_is_called_takes_half_of_a_small_stack_at_most),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
