// test_hosts.c - inside other programs: threads with another floating-point state, the host's own job system, one pool
// for several worlds, calls that come while a world steps.
#include "core/threads.h"
#include "fe_test.h"
#include "support/play.h"

#include <pthread.h>
#include <string.h>

#ifdef FE_SANITIZED
enum { STEPS = 40 };
#else
enum { STEPS = 120 };
#endif

static fe_world *new_world(fe_pool *pool, const fe_task_system *tasks)
{
    fe_world_def def;
    fe_world *world = NULL;
    fe_world_def_init(&def, sizeof def);
    def.pool = pool;
    def.tasks = tasks;
    FE_TRUE(fe_world_create(&def, &world) == FE_OK);
    return world;
}

typedef struct outcome {
    uint64_t hash, told;
} outcome;

static outcome finish(play *p, const script *s)
{
    play_until(p, s, STEPS);
    outcome o = {play_hash(p), play_told(p)};
    assert_int_equal(p->errors, 0);
    fe_world_destroy(p->world);
    return o;
}

// what every host must get: one worker, nothing special
static outcome plain_outcome(const script *s)
{
    play p;
    play_begin(&p, new_world(NULL, NULL));
    return finish(&p, s);
}

static void same(outcome a, outcome b)
{
    FE_TRUE(a.hash == b.hash);
    FE_TRUE(a.told == b.told);
}

// ---- the floating-point state --------------------------------------------------------------------------------------
#if defined(__x86_64__)
#include <xmmintrin.h>
// rounding up, flush to zero, denormals are zero; exceptions masked
enum { HOSTILE = 0xDFC0 };
static uint64_t read_state(void) { return _mm_getcsr() & ~UINT64_C(0x3F); } // without the flags that operations raise
static void write_state(uint64_t state) { _mm_setcsr((unsigned)state); }
#elif defined(__aarch64__)
enum { HOSTILE = 0x01400000 }; // FPCR: FZ and rounding up
static uint64_t read_state(void)
{
    uint64_t state;
    __asm__ volatile("mrs %0, fpcr" : "=r"(state));
    return state;
}
static void write_state(uint64_t state) { __asm__ volatile("msr fpcr, %0" : : "r"(state)); }
#else
enum { HOSTILE = 0 };
static uint64_t read_state(void) { return 0; }
static void write_state(uint64_t state) { (void)state; }
#endif

static int32_t states_lost; // calls that came back with another state

// only around the library's calls: the script's own arithmetic must stay
static void set_hostile(play *p)
{
    (void)p;
    write_state(HOSTILE);
}

static int32_t check_hostile(play *p, fe_result result)
{
    states_lost += read_state() != HOSTILE;
    write_state((uint64_t)(uintptr_t)p->user);
    p->errors += result < 0;
    return 0;
}

static void the_host_keeps_its_floating_point_state(void **state)
{
    (void)state;
    const script *const scripts[] = {&script_crowd, &script_brief};
    for (int32_t i = 0; i < 2; ++i) {
        play p;
        states_lost = 0;
        play_begin(&p, new_world(NULL, NULL));
        p.before = set_hostile;
        p.after = check_hostile;
        p.user = (void *)(uintptr_t)read_state();
        same(finish(&p, scripts[i]), plain_outcome(scripts[i]));
        assert_int_equal(states_lost, 0);
    }
}

// ---- the host's jobs -----------------------------------------------------------------------------------------------

static void run_backwards(void *user, fe_task task, void *argument, int32_t count)
{
    ++*(int32_t *)user;
    for (int32_t i = count - 1; i >= 0; --i) task(argument, i);
}

static void run_shuffled(void *user, fe_task task, void *argument, int32_t count)
{
    int32_t order[FE_MAX_WORKERS];
    uint32_t *seed = user;
    for (int32_t i = 0; i < count; ++i) order[i] = i;
    for (int32_t i = count - 1; i > 0; --i) {
        *seed = *seed * UINT32_C(1664525) + UINT32_C(1013904223);
        int32_t k = (int32_t)((*seed >> 8) % (uint32_t)(i + 1)), held = order[i];
        order[i] = order[k], order[k] = held;
    }
    for (int32_t i = 0; i < count; ++i) task(argument, order[i]);
}

typedef struct host_job {
    fe_task task;
    void *argument;
    int32_t index;
} host_job;

static void *do_job(void *argument)
{
    const host_job *job = argument;
    write_state(HOSTILE); // the host's threads may round as they like
    job->task(job->argument, job->index);
    return NULL;
}

// a thread for each task: what no host does, and what every order may come to
static void run_on_threads(void *user, fe_task task, void *argument, int32_t count)
{
    pthread_t threads[FE_MAX_WORKERS];
    host_job jobs[FE_MAX_WORKERS];
    (void)user;
    for (int32_t i = 0; i < count; ++i) {
        jobs[i] = (host_job){task, argument, i};
        if (pthread_create(threads + i, NULL, do_job, jobs + i) != 0) do_job(jobs + i), threads[i] = pthread_self();
    }
    for (int32_t i = 0; i < count; ++i)
        if (!pthread_equal(threads[i], pthread_self())) pthread_join(threads[i], NULL);
}

static outcome host_outcome(const script *s, int32_t workers, void (*run)(void *, fe_task, void *, int32_t), void *user)
{
    fe_task_system tasks = {sizeof tasks, workers, run, user};
    play p;
    play_begin(&p, new_world(NULL, &tasks));
    memset(&tasks, 0, sizeof tasks); // it was copied
    return finish(&p, s);
}

static void a_host_task_system_gives_the_same_bits(void **state)
{
    (void)state;
    outcome expected = plain_outcome(&script_crowd);
    int32_t runs = 0;
    uint32_t seed = 7;
    same(host_outcome(&script_crowd, 4, run_backwards, &runs), expected);
    assert_in_range(runs, 1, 1000000); // it was asked
    same(host_outcome(&script_crowd, 16, run_shuffled, &seed), expected);
    same(host_outcome(&script_crowd, 1, run_shuffled, &seed), expected);
    same(host_outcome(&script_crowd, 3, run_on_threads, NULL), expected);
}

// ---- one pool, several worlds --------------------------------------------------------------------------------------

typedef struct host_thread {
    play play;
    const script *script;
} host_thread;

// asserts belong to the main thread: here only steps
static void *play_in_thread(void *argument)
{
    host_thread *t = argument;
    play_until(&t->play, t->script, STEPS);
    return NULL;
}

static void worlds_on_one_pool_step_at_once(void **state)
{
    (void)state;
    enum { THREADS = 3 };
    static host_thread hosts[THREADS];
    const script *const scripts[THREADS] = {&script_crowd, &script_mixed, &script_crowd};
    fe_pool *pool = NULL;
    pthread_t threads[THREADS];
    FE_TRUE(fe_pool_create(4, &pool) == FE_OK);
    for (int32_t i = 0; i < THREADS; ++i) {
        play_begin(&hosts[i].play, new_world(pool, NULL));
        hosts[i].script = scripts[i];
    }
    assert_int_equal(fe_pool_destroy(pool), FE_ERROR_STATE);
    for (int32_t i = 0; i < THREADS; ++i) FE_TRUE(pthread_create(threads + i, NULL, play_in_thread, hosts + i) == 0);
    for (int32_t i = 0; i < THREADS; ++i) pthread_join(threads[i], NULL);
    for (int32_t i = 0; i < THREADS; ++i) same(finish(&hosts[i].play, scripts[i]), plain_outcome(scripts[i]));
    assert_int_equal(fe_pool_destroy(pool), FE_OK);
}

// ---- calls during a step -------------------------------------------------------------------------------------------

typedef struct intruder {
    fe_world *world;
    fe_body body;
    fe_shape shape;
    int32_t runs, refused, calls;
} intruder;

static void intrude(intruder *in)
{
    fe_world *w = in->world;
    const fe_vec3 v = {1.0f, 0.0f, 0.0f};
    fe_transform t = fe_make_transform(0.0, 0.0, 0.0);
    fe_dvec3 from = {0.0, 5.0, 0.0}, along = {0.0, -10.0, 0.0};
    fe_hit hit;
    fe_body body;
    uint32_t words[2];
    const int32_t results[] = {fe_world_step(w, 0.01f),
                               fe_body_create(w, NULL, &body),
                               fe_body_destroy(w, in->body),
                               fe_body_set_transform(w, in->body, &t),
                               fe_body_get_transform(w, in->body, &t),
                               fe_body_add_impulse(w, in->body, &v),
                               fe_shape_destroy(w, in->shape),
                               fe_world_set_gravity(w, &v),
                               fe_world_raycast(w, &from, &along, NULL, &hit),
                               fe_world_get_pair_events(w, NULL, 0, 0),
                               fe_world_hash(w, words),
                               fe_world_destroy(w)};
    in->calls = (int32_t)(sizeof results / sizeof *results);
    in->refused = 0;
    for (int32_t i = 0; i < in->calls; ++i) in->refused += results[i] == FE_ERROR_STEPPING;
}

static void *intrude_from_a_thread(void *argument)
{
    intrude(argument);
    return NULL;
}

static void run_and_intrude(void *user, fe_task task, void *argument, int32_t count)
{
    intruder *in = user;
    pthread_t thread;
    if (in->runs++ == 0 && pthread_create(&thread, NULL, intrude_from_a_thread, in) == 0) pthread_join(thread, NULL);
    for (int32_t i = 0; i < count; ++i) task(argument, i);
}

static void calls_during_a_step_are_refused_and_change_nothing(void **state)
{
    (void)state;
    intruder in = {0};
    fe_task_system tasks = {sizeof tasks, 4, run_and_intrude, &in};
    play p;
    play_begin(&p, new_world(NULL, &tasks));
    in.world = p.world;
    script_crowd.build(&p);
    in.body = p.actors[p.groups[0]];
    in.shape = p.shapes[p.groups[0]];
    play_until(&p, &script_crowd, STEPS);
    assert_in_range(in.runs, 1, 1000000);
    assert_int_equal(in.refused, in.calls);
    same((outcome){play_hash(&p), play_told(&p)}, plain_outcome(&script_crowd));
    fe_world_destroy(p.world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_host_keeps_its_floating_point_state),
        cmocka_unit_test(a_host_task_system_gives_the_same_bits),
        cmocka_unit_test(worlds_on_one_pool_step_at_once),
        cmocka_unit_test(calls_during_a_step_are_refused_and_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
