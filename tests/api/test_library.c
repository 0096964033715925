// What belongs to no world: version, names, sentences, pools.
#include "api/api_test.h"

#include <pthread.h>

static void the_version_is_the_header_s(void **state)
{
    (void)state;
    assert_int_equal(fe_version(), FE_VERSION_MAJOR << 16 | FE_VERSION_MINOR << 8 | FE_VERSION_PATCH);
}

static void results_have_names(void **state)
{
    (void)state;
    assert_string_equal(fe_result_name(FE_OK), "FE_OK");
    assert_string_equal(fe_result_name(FE_FOREIGN), "FE_FOREIGN");
    assert_string_equal(fe_result_name(FE_END), "FE_END");
    assert_string_equal(fe_result_name(FE_ERROR_ARGUMENT), "FE_ERROR_ARGUMENT");
    assert_string_equal(fe_result_name(FE_ERROR_STALE), "FE_ERROR_STALE");
    assert_string_equal(fe_result_name(FE_ERROR_KIND), "FE_ERROR_KIND");
    assert_string_equal(fe_result_name(FE_ERROR_STEPPING), "FE_ERROR_STEPPING");
    assert_string_equal(fe_result_name(FE_ERROR_MEMORY), "FE_ERROR_MEMORY");
    assert_string_equal(fe_result_name(FE_ERROR_LIMIT), "FE_ERROR_LIMIT");
    assert_string_equal(fe_result_name(FE_ERROR_UNSUPPORTED), "FE_ERROR_UNSUPPORTED");
    assert_string_equal(fe_result_name(FE_ERROR_STATE), "FE_ERROR_STATE");
    assert_string_equal(fe_result_name(FE_ERROR_BUSY), "FE_ERROR_BUSY");
    assert_string_equal(fe_result_name(FE_ERROR_DEGENERATE), "FE_ERROR_DEGENERATE");
    assert_string_equal(fe_result_name(FE_ERROR_DATA), "FE_ERROR_DATA");
    assert_string_equal(fe_result_name(FE_ERROR_VERSION), "FE_ERROR_VERSION");
    assert_string_equal(fe_result_name(FE_ERROR_DIVERGED), "FE_ERROR_DIVERGED");
    assert_string_equal(fe_result_name(-99), "unknown");
    assert_string_equal(fe_result_name(1), "unknown");
}

static void *first_sentence(void *argument)
{
    (void)argument;
    const char *sentence = fe_last_error();
    assert_non_null(sentence);
    return strstr(sentence, "fe_world_step") ? (void *)sentence : NULL;
}

static void sentences_belong_to_their_thread_and_outlive_success(void **state)
{
    (void)state;
    fe_world *world = new_world();
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_step(world, -1));
    SAYS("fe_world_step: dt is -1, must be 0..1");
    pthread_t thread;
    void *seen;
    assert_int_equal(pthread_create(&thread, NULL, first_sentence, NULL), 0);
    assert_int_equal(pthread_join(thread, &seen), 0);
    assert_null(seen);
    OK(fe_world_step(world, 0.01f));
    SAYS("fe_world_step: dt is -1");
    OK(fe_world_destroy(world));
}

static void a_pool_serves_its_worlds_and_ends_after_them(void **state)
{
    (void)state;
    fe_pool *pool = NULL;
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_pool_create(0, &pool));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_pool_create(65, &pool));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_pool_create(1, NULL));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_pool_destroy(NULL));
    assert_null(pool);
    OK(fe_pool_create(2, &pool));
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.pool = pool;
    fe_world *a, *b;
    OK(fe_world_create(&def, &a));
    OK(fe_world_create(&def, &b));
    fe_counters counters = {.struct_size = sizeof counters};
    OK(fe_world_get_counters(a, &counters));
    assert_int_equal(counters.workers, 2);
    step(a, 2);
    step(b, 2);
    REFUSES(NULL, FE_ERROR_STATE, fe_pool_destroy(pool));
    SAYS("still serves 2 worlds");
    OK(fe_world_destroy(a));
    REFUSES(NULL, FE_ERROR_STATE, fe_pool_destroy(pool));
    OK(fe_world_destroy(b));
    OK(fe_pool_destroy(pool));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_version_is_the_header_s),
        cmocka_unit_test(results_have_names),
        cmocka_unit_test(sentences_belong_to_their_thread_and_outlive_success),
        cmocka_unit_test(a_pool_serves_its_worlds_and_ends_after_them),
    };
    return cmocka_run_group_tests_name("library", tests, NULL, NULL);
}
