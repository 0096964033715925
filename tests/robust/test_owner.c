// Two threads in one world: a second writer, a reader beside a writer, a step or a destruction beside a reader are
// errors, never a crash.
#include "fe_test.h"
#include "feather.h"

#include <pthread.h>
#include <stdatomic.h>
#include <string.h>
#include <time.h>

enum { THREADS = 4, ROUNDS = 3000 };

typedef struct shared {
    fe_world *world;
    fe_body body;
    _Atomic int32_t stop, wrong, refused, done;
    int32_t readers;
} shared;

static int32_t is_expected(int32_t result)
{
    return result >= 0 || result == FE_ERROR_BUSY || result == FE_ERROR_STEPPING;
}

static void note(shared *s, int32_t result)
{
    atomic_fetch_add(result < 0 ? &s->refused : &s->done, 1);
    if (!is_expected(result)) atomic_store(&s->wrong, result);
}

// ---- writers -------------------------------------------------------------------------------------------------------

static void *write_on(void *argument)
{
    shared *s = argument;
    for (int32_t i = 0; i < ROUNDS; ++i) {
        fe_body body = 0;
        int32_t result = fe_body_create(s->world, NULL, &body);
        note(s, result);
        if (result != FE_OK) continue;
        fe_geometry ball;
        fe_geometry_sphere(&ball, 0.5f);
        fe_shape shape;
        note(s, fe_shape_create(s->world, body, NULL, &ball, &shape));
        if (i % 16 == 0) note(s, fe_world_step(s->world, 1.0f / 60.0f));
        while ((result = fe_body_destroy(s->world, body)) == FE_ERROR_BUSY || result == FE_ERROR_STEPPING)
            note(s, result);
        note(s, result);
    }
    return NULL;
}

static void run(shared *s, void *(*work)(void *), int32_t count)
{
    pthread_t threads[THREADS];
    for (int32_t i = 0; i < count; ++i) assert_int_equal(pthread_create(&threads[i], NULL, work, s), 0);
    for (int32_t i = 0; i < count; ++i) assert_int_equal(pthread_join(threads[i], NULL), 0);
}

// What each wrote is whole: in the end no body is left
static void two_writers_never_meet(void **state)
{
    (void)state;
    shared s = {.world = NULL};
    assert_int_equal(fe_world_create(NULL, &s.world), FE_OK);
    run(&s, write_on, 2);
    assert_int_equal(atomic_load(&s.wrong), 0);
    assert_int_equal(fe_world_get_bodies(s.world, NULL, 0), 0);
    assert_int_equal(fe_world_destroy(s.world), FE_OK);
}

// ---- readers beside a step -----------------------------------------------------------------------------------------

static void *read_on(void *argument)
{
    shared *s = argument;
    while (!atomic_load(&s->stop)) {
        fe_transform t;
        fe_hit hit;
        note(s, fe_body_get_transform(s->world, s->body, &t));
        note(s, fe_world_raycast(s->world, &(fe_dvec3){0, 50, 0}, &(fe_dvec3){0, -100, 0}, NULL, &hit));
    }
    return NULL;
}

static void make_scene(shared *s)
{
    *s = (shared){.world = NULL};
    assert_int_equal(fe_world_create(NULL, &s->world), FE_OK);
    fe_geometry ball;
    fe_geometry_sphere(&ball, 0.5f);
    for (int32_t i = 0; i < 20; ++i) {
        fe_body_def def;
        fe_body_def_init(&def, sizeof def);
        def.transform = fe_make_transform(0, i, 0);
        fe_shape shape;
        assert_int_equal(fe_body_create(s->world, &def, &s->body), FE_OK);
        assert_int_equal(fe_shape_create(s->world, s->body, NULL, &ball, &shape), FE_OK);
    }
}

// Either side notices: a step that would run beside a reader is refused and changes nothing; so the world steps as
// often as steps succeed
static void a_step_and_readers_exclude_each_other(void **state)
{
    (void)state;
    shared s;
    make_scene(&s);
    pthread_t threads[THREADS];
    for (int32_t i = 0; i < THREADS; ++i) assert_int_equal(pthread_create(&threads[i], NULL, read_on, &s), 0);
    int32_t steps = 0, refused = 0;
    for (int32_t i = 0; i < ROUNDS; ++i) {
        fe_result result = fe_world_step(s.world, 1.0f / 600.0f);
        steps += result == FE_OK;
        refused += result == FE_ERROR_BUSY;
        if (result != FE_OK && result != FE_ERROR_BUSY) atomic_store(&s.wrong, result);
    }
    atomic_store(&s.stop, 1);
    for (int32_t i = 0; i < THREADS; ++i) assert_int_equal(pthread_join(threads[i], NULL), 0);
    assert_int_equal(atomic_load(&s.wrong), 0);
    assert_int_equal(steps + refused, ROUNDS);
    assert_int_equal(fe_world_step(s.world, 1.0f / 60.0f), FE_OK); // nobody is left inside
    assert_int_equal(fe_world_destroy(s.world), FE_OK);
}

// ---- destruction ---------------------------------------------------------------------------------------------------

typedef struct stuck {
    fe_world *world;
    _Atomic int32_t inside, leave;
} stuck;

// A query on many rays that the host's own task system holds up: a reader that is inside for as long as the test likes
static void hold(void *user, fe_task task, void *argument, int32_t count)
{
    stuck *s = user;
    for (int32_t i = 0; i < count; ++i) task(argument, i);
    atomic_store(&s->inside, 1);
    while (!atomic_load(&s->leave)) {}
}

static void *query(void *argument)
{
    stuck *s = argument;
    static fe_ray rays[256];
    static fe_hit hits[256];
    return fe_world_raycast_many(s->world, rays, sizeof *rays, 256, NULL, 1, hits, sizeof *hits) == 0 ? s : NULL;
}

static void a_reader_keeps_its_world_alive(void **state)
{
    (void)state;
    stuck s = {.world = NULL};
    fe_task_system tasks;
    fe_task_system_init(&tasks, sizeof tasks);
    tasks.worker_count = 2, tasks.run = hold, tasks.user = &s;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.tasks = &tasks;
    assert_int_equal(fe_world_create(&def, &s.world), FE_OK);
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, query, &s), 0);
    while (!atomic_load(&s.inside)) {}
    assert_int_equal(fe_world_destroy(s.world), FE_ERROR_BUSY);
    FE_TRUE(strstr(fe_last_error(), "reading this world"));
    assert_int_equal(fe_world_step(s.world, 1.0f / 60.0f), FE_ERROR_BUSY);
    fe_vec3 gravity;
    assert_int_equal(fe_world_get_gravity(s.world, &gravity), FE_OK); // readers do not exclude each other
    atomic_store(&s.leave, 1);
    void *found = NULL;
    assert_int_equal(pthread_join(thread, &found), 0);
    assert_non_null(found);
    assert_int_equal(fe_world_destroy(s.world), FE_OK);
}

// More threads than processors, most of them gone: slots are given to those that come
static void *read_once(void *argument)
{
    shared *s = argument;
    fe_transform t;
    note(s, fe_body_get_transform(s->world, s->body, &t));
    return NULL;
}

static void threads_come_and_go(void **state)
{
    (void)state;
    shared s;
    make_scene(&s);
    for (int32_t i = 0; i < 300; ++i) {
        run(&s, read_once, THREADS);
        if (i % 50 == 0) assert_int_equal(fe_world_step(s.world, 1.0f / 60.0f), FE_OK);
    }
    assert_int_equal(atomic_load(&s.wrong), 0);
    assert_int_equal(atomic_load(&s.refused), 0);
    assert_int_equal(fe_world_destroy(s.world), FE_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_writers_never_meet),
        cmocka_unit_test(a_step_and_readers_exclude_each_other),
        cmocka_unit_test(a_reader_keeps_its_world_alive),
        cmocka_unit_test(threads_come_and_go),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
