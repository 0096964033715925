// test_lockstep.c - batches whose worlds have nothing in common: whatever is beside it, each does what it does alone.
//
//   test_lockstep          what belongs to every run
//   test_lockstep 1000     besides, so many batches by chance
#include "core/clock.h"
#include "many/lockstep_worlds.h"
#include "robust/counting_allocator.h"

enum { MOST_WORLDS = 40, MOST_WORKERS = 8 };
#if SLOW_BUILD
enum { CALLS = 10, CASES = 4, RARELY_HEAVY = 20 };
#else
enum { CALLS = 24, CASES = 12, RARELY_HEAVY = 6 };
#endif
static int32_t whole; // batches by chance, 0: none
static const int32_t sets[] = {FE_SIMD_PLAIN, FE_SIMD_SSE2, FE_SIMD_AVX2, FE_SIMD_AVX512, FE_SIMD_NEON};

typedef struct plan {
    int32_t worlds, workers, block;
    int32_t simd, other_simd; // of the batch, of those alone
    int32_t calls;
    uint32_t seed;
} plan;

typedef struct twins { // worlds of a batch, and the same alone
    fe_batch *batch;
    int32_t count;
    fe_world *inside[MOST_WORLDS], *alone[MOST_WORLDS];
    const char *name[MOST_WORLDS]; // of what each became last
    int32_t same_set;
    uint32_t seed;
} twins;

static uint32_t draw(twins *t, uint32_t end)
{
    t->seed = t->seed * 1664525u + 1013904223u;
    return (uint32_t)((uint64_t)t->seed * end >> 32);
}

// ---- what a world tells --------------------------------------------------------------------------------------------
static int32_t same_hash(const fe_world *a, const fe_world *b)
{
    uint32_t x[2], y[2];
    MUST(fe_world_hash(a, x));
    MUST(fe_world_hash(b, y));
    return memcmp(x, y, sizeof x) == 0;
}

static int32_t same_bytes(const fe_world *a, const fe_world *b)
{
    static unsigned char *bytes[2];
    static int64_t room;
    int64_t size = fe_world_save(a, NULL, NULL, 0);
    if (size <= 0 || fe_world_save(b, NULL, NULL, 0) != size) return 0;
    for (int k = 0; k < 2 && size > room; ++k) FE_TRUE((bytes[k] = realloc(bytes[k], (size_t)size)));
    room = size > room ? size : room;
    FE_TRUE(fe_world_save(a, NULL, bytes[0], size) == size && fe_world_save(b, NULL, bytes[1], size) == size);
    if (memcmp(bytes[0], bytes[1], (size_t)size) == 0) return 1;
    fe_difference d = {.struct_size = sizeof d};
    if (fe_snapshot_compare(bytes[0], size, bytes[1], size, &d) == 1)
        print_error("%s %s: %s, alone %s\n", d.kind, d.field, d.a, d.b);
    return 0;
}

// same_pairs(a, b), and so for each kind of event
#define EVENTS(kind)                                                                     \
    static int32_t same_##kind##s(const fe_world *a, const fe_world *b)                  \
    {                                                                                    \
        int32_t count = fe_world_get_##kind##_events(a, NULL, 0, 0);                     \
        if (fe_world_get_##kind##_events(b, NULL, 0, 0) != count) return 0;              \
        size_t size = sizeof(fe_##kind##_event), all = (size_t)count * size;             \
        fe_##kind##_event *x = calloc(2 * (size_t)count + 2, size), *y = x + count + 1;  \
        FE_TRUE(x &&fe_world_get_##kind##_events(a, x, (uint32_t)size, count) == count); \
        FE_TRUE(fe_world_get_##kind##_events(b, y, (uint32_t)size, count) == count);     \
        int32_t same = memcmp(x, y, all) == 0;                                           \
        free(x);                                                                         \
        return same;                                                                     \
    }
EVENTS(pair)
EVENTS(hit)
EVENTS(body)
EVENTS(joint)

// All but memory: a world of a batch has none of its own for a step. Rows are those of a set of kernels
static int32_t same_counters(const fe_world *a, const fe_world *b, int32_t same_set)
{
    fe_counters x = {.struct_size = sizeof x}, y = {.struct_size = sizeof y};
    MUST(fe_world_get_counters(a, &x));
    MUST(fe_world_get_counters(b, &y));
    x.bytes = y.bytes = x.allocations = y.allocations = 0;
    x.workers = y.workers;
    if (!same_set) x.rows = y.rows, x.rows_whole = y.rows_whole, x.simd = y.simd, x.simd_width = y.simd_width;
    return memcmp(&x, &y, sizeof x) == 0;
}

static void compare(const twins *t, int32_t i, int32_t call, int32_t bytes)
{
    const fe_world *a = t->inside[i], *b = t->alone[i];
    const char *what = !same_hash(a, b)                    ? "goes another way"
                       : !same_pairs(a, b)                 ? "has other pair events"
                       : !same_hits(a, b)                  ? "has other hit events"
                       : !same_bodys(a, b)                 ? "has other body events"
                       : !same_joints(a, b)                ? "has other joint events"
                       : !same_counters(a, b, t->same_set) ? "counts otherwise"
                       : bytes && !same_bytes(a, b)        ? "has other bytes"
                                                           : NULL;
    if (what) fail_msg("world %d, %s, %s in call %d", (int)i, t->name[i], what, (int)call);
}

// ---- what is done to a world between steps -------------------------------------------------------------------------
static const moment *choose_moment(twins *t)
{
    const moment *m;
    do m = moments + draw(t, (uint32_t)moment_count);
    while (m->is_heavy && draw(t, RARELY_HEAVY));
    return m;
}

static void become(fe_world *world, const moment *m, int32_t from_bytes)
{
    if (from_bytes)
        MUST(fe_world_restore(world, NULL, m->bytes, m->size));
    else
        MUST(fe_world_set_state(world, m->state));
}

static void become_something(twins *t, int32_t i)
{
    const moment *m = choose_moment(t);
    t->name[i] = m->name;
    become(t->inside[i], m, (int32_t)draw(t, 2));
    become(t->alone[i], m, 0);
}

static void add_ball_at(fe_world *world, double x, double y, int32_t bullet)
{
    fe_body_def def;
    fe_shape_def shape_def;
    fe_body body;
    fe_shape shape;
    fe_geometry form = sphere(0.3);
    fe_body_def_init(&def, sizeof def);
    fe_shape_def_init(&shape_def, sizeof shape_def);
    def.transform = fe_make_transform(x, y, 0.1);
    def.linear_velocity.y = bullet ? -100.0f : -2.0f, def.bullet = bullet;
    shape_def.material.restitution = bullet ? 0.0f : 0.6f;
    MUST(fe_body_create(world, &def, &body));
    MUST(fe_shape_create(world, body, &shape_def, &form, &shape));
}

static int32_t let_all(void *user, const fe_filter_pair *pair)
{
    (void)user, (void)pair;
    return 1;
}

// One of many calls, the same for two worlds that are the same
static void poke(fe_world *world, uint32_t verb, uint32_t which, float x)
{
    static fe_body bodies[4096];
    static fe_joint joints[4096];
    int32_t body_count = fe_world_get_bodies(world, bodies, 4096),
            joint_count = fe_world_get_joints(world, joints, 4096);
    const fe_vec3 fast = {80.0f * x, 20.0f, 3.0f}, push = {500.0f * x, 900.0f, 0.0f}, down = {x, -9.81f, 0.5f};
    if (verb == 0) add_ball_at(world, 4.0 * (double)x, 4.0, 0);
    if (verb == 1) add_ball_at(world, 4.0 * (double)x, 6.0, 1);
    if (verb == 2) MUST(fe_world_set_gravity(world, &down));
    if (verb == 3) MUST(fe_world_set_substeps(world, 3 + (int32_t)(which % 3)));
    if (verb == 15) MUST(fe_world_set_pair_filter(world, which % 2 ? let_all : NULL, NULL));
    if (joint_count > 0 && verb == 4) (void)fe_joint_destroy(world, joints[which % (uint32_t)joint_count]);
    if (joint_count > 0 && verb == 5) (void)fe_joint_set_enabled(world, joints[which % (uint32_t)joint_count], 0);
    if (body_count <= 0) return;
    fe_body body = bodies[which % (uint32_t)body_count];
    if (verb == 6) (void)fe_body_destroy(world, body);
    if (verb == 7) (void)fe_body_set_linear_velocity(world, body, &fast);
    if (verb == 8) (void)fe_body_add_force(world, body, &push);
    if (verb == 9) (void)fe_body_set_mass(world, body, 1000.0f);
    if (verb == 10) (void)fe_body_set_awake(world, body, which % 2 == 0);
    if (verb == 11) (void)fe_body_set_type(world, body, (int32_t)(which / 8 % 3));
    if (verb == 12) (void)fe_body_set_locks(world, body, which / 8 % 8, which / 64 % 8);
    if (verb == 13) (void)fe_body_set_enabled(world, body, which / 8 % 2 == 0);
    if (verb == 14) {
        fe_ball_joint_def d = ball_def();
        fe_joint joint;
        d.body_a = body, d.body_b = bodies[which / 7 % (uint32_t)body_count];
        (void)fe_ball_joint_create(world, &d, &joint);
    }
}
enum { VERBS = 16 };

static void poke_some(twins *t)
{
    for (int32_t i = 0; i < t->count; ++i) {
        if (draw(t, 8)) continue;
        uint32_t verb = draw(t, VERBS), which = draw(t, 1u << 20);
        float x = (float)draw(t, 1000) * 0.002f - 1.0f;
        poke(t->inside[i], verb, which, x);
        poke(t->alone[i], verb, which, x);
    }
}

// Between the calls a world may become another one, or step by itself
static void turn_some(twins *t)
{
    static const fe_state *states[MOST_WORLDS];
    uint8_t mask[MOST_WORLDS] = {0};
    for (int32_t i = 0; i < t->count; ++i) {
        if (draw(t, 12) == 0) become_something(t, i);
        if (draw(t, 12) == 0) {
            MUST(fe_world_step(t->inside[i], DT));
            MUST(fe_world_step(t->alone[i], DT));
        }
        if (draw(t, 30)) continue;
        const moment *m = choose_moment(t);
        mask[i] = 1, states[i] = m->state, t->name[i] = m->name;
        become(t->alone[i], m, 0);
    }
    FE_TRUE(fe_batch_reset(t->batch, mask, states, NULL) == 0);
}

// ---- a batch beside a loop -----------------------------------------------------------------------------------------
static void twins_begin(twins *t, const plan *p, const fe_allocator *allocator)
{
    fe_world *empty = open_world(FE_SIMD_AUTO);
    fe_batch_def def;
    fe_world_def alone;
    fe_batch_def_init(&def, sizeof def);
    fe_world_def_init(&alone, sizeof alone);
    def.world_count = p->worlds, def.worker_count = p->workers, def.block = p->block, def.simd = p->simd;
    def.allocator = allocator, alone.simd = p->other_simd;
    *t = (twins){.count = p->worlds, .seed = p->seed, .same_set = p->simd == p->other_simd};
    MUST(fe_batch_create(empty, &def, &t->batch));
    for (int32_t i = 0; i < t->count; ++i) {
        MUST(fe_batch_get_world(t->batch, i, &t->inside[i]));
        MUST(fe_world_clone(empty, &alone, &t->alone[i]));
        t->name[i] = "new";
    }
    MUST(fe_world_destroy(empty));
}

static void twins_end(twins *t)
{
    MUST(fe_batch_destroy(t->batch));
    for (int32_t i = 0; i < t->count; ++i) MUST(fe_world_destroy(t->alone[i]));
}

static float choose_dt(twins *t)
{
    static const float lengths[] = {0.0f, 1.0f / 30.0f, 1.0f / 240.0f, 1e-6f, 0.01f};
    return draw(t, 3) ? DT : lengths[draw(t, 5)];
}

static const uint8_t *choose_mask(twins *t, uint8_t *mask)
{
    uint32_t share = draw(t, 4);
    for (int32_t i = 0; i < t->count; ++i) mask[i] = draw(t, 4) > share - 1;
    return share ? mask : NULL;
}

static void step_both(twins *t, int32_t call)
{
    static const int32_t sizes[] = {1, 1, 4, 2};
    uint8_t room[MOST_WORLDS];
    int32_t results[MOST_WORLDS], steps = sizes[draw(t, 4)];
    const uint8_t *mask = choose_mask(t, room);
    float dt = choose_dt(t);
    FE_TRUE(fe_batch_step(t->batch, dt, steps, mask, results) == 0);
    for (int32_t i = 0; i < t->count; ++i) {
        FE_TRUE(results[i] == FE_OK);
        for (int32_t k = 0; k < steps && (!mask || mask[i]); ++k) MUST(fe_world_step(t->alone[i], dt));
        compare(t, i, call, call % 6 == 5);
    }
}

static void is_a_loop(const plan *p)
{
    static twins t;
    twins_begin(&t, p, NULL);
    for (int32_t i = 0; i < t.count; ++i) become_something(&t, i);
    for (int32_t call = 0; call < p->calls; ++call) {
        step_both(&t, call);
        poke_some(&t);
        if (call % 4 == 3) turn_some(&t);
    }
    twins_end(&t);
}

static plan plan_of(uint32_t number, int32_t calls)
{
    static const int32_t workers[] = {1, 2, 3, 8}, blocks[] = {16, 1, 3, 0, 64}, worlds[] = {16, 40, 7, 1, 33, 2, 17};
    int32_t simd = sets[number % 4], other = sets[number / 4 % 5];
    if (!has_simd(simd)) simd = FE_SIMD_AUTO;
    if (number % 3 == 0 || !has_simd(other)) other = simd;
    return (plan){.worlds = worlds[number % 7],
                  .workers = workers[number % 4],
                  .block = blocks[number % 5],
                  .simd = simd,
                  .other_simd = other,
                  .calls = calls,
                  .seed = 77u * number + 1u};
}

static void what_is_beside_a_world_does_not_show(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < CASES; ++i) {
        plan p = plan_of(i, CALLS);
        is_a_loop(&p);
    }
}

static void batches_by_chance(void **state)
{
    (void)state;
    for (int32_t i = 0; i < whole; ++i) {
        plan p = plan_of((uint32_t)(CASES + i), 20);
        is_a_loop(&p);
    }
}

// Of each two moments, one world each
static void any_two_step_side_by_side(void **state)
{
    (void)state;
    enum { STEPS = SLOW_BUILD ? 2 : 6 };
    static twins t;
    plan p = {.worlds = 2, .workers = 1, .block = 2, .calls = 1};
    twins_begin(&t, &p, NULL);
    t.same_set = 1;
    for (int32_t a = 0; a < moment_count; ++a)
        for (int32_t b = 0; b < moment_count; ++b) {
            if (moments[a].is_heavy || moments[b].is_heavy) continue;
            const moment *both[2] = {moments + a, moments + b};
            for (int32_t i = 0; i < 2; ++i) {
                t.name[i] = both[i]->name;
                become(t.inside[i], both[i], 0);
                become(t.alone[i], both[i], 0);
            }
            FE_TRUE(fe_batch_step(t.batch, DT, STEPS, NULL, NULL) == 0);
            for (int32_t i = 0; i < 2; ++i) {
                for (int32_t k = 0; k < STEPS; ++k) MUST(fe_world_step(t.alone[i], DT));
                compare(&t, i, a * moment_count + b, 0);
            }
        }
    twins_end(&t);
}

// A body that may not sleep, or that one holds that may not, stays awake: what was tried shows nowhere
static void who_stays_awake_is_the_same(void **state)
{
    (void)state;
    static twins t;
    static fe_body bodies[4096];
    plan p = {.worlds = 1, .workers = 1};
    twins_begin(&t, &p, NULL);
    t.same_set = 1;
    for (int32_t a = 0; a < moment_count; ++a) {
        if (moments[a].is_heavy) continue;
        become(t.inside[0], moments + a, 0), become(t.alone[0], moments + a, 0);
        t.name[0] = moments[a].name;
        for (int32_t k = 0; k < 3; ++k) {
            int32_t count = fe_world_get_bodies(t.alone[0], bodies, 4096);
            FE_TRUE(fe_batch_step(t.batch, DT, 1, NULL, NULL) == 0);
            MUST(fe_world_step(t.alone[0], DT));
            compare(&t, 0, k, 1);
            if (count < 1) continue;
            fe_result inside = fe_body_set_awake(t.inside[0], bodies[count / 2], 0);
            FE_TRUE(fe_body_set_awake(t.alone[0], bodies[count / 2], 0) == inside);
        }
    }
    twins_end(&t);
}

// ---- memory --------------------------------------------------------------------------------------------------------
// Every second allocation fails, by chance: a world steps or stays, and in the end all memory is given back. The
// allocator looks for what was written behind a block, and gives no zeros
static void steps_fail_one_by_one(void **state)
{
    (void)state;
    enum { ROUNDS = SLOW_BUILD ? 2 : 6, STEPS = 12 };
    static twins t;
    int32_t lost = 0;
    for (uint32_t round = 0; round < ROUNDS; ++round) {
        counting c = {.chance = 1 + round};
        fe_allocator allocator = counting_allocator(&c);
        plan p = {.worlds = 20, .workers = 1, .block = 20, .seed = round, .simd = FE_SIMD_AUTO};
        twins_begin(&t, &p, &allocator);
        for (int32_t i = 0; i < t.count; ++i) become_something(&t, i);
        for (int32_t k = 0; k < STEPS; ++k) {
            int32_t results[MOST_WORLDS], failed;
            c.is_unlucky = k % 4 < 2;
            failed = fe_batch_step(t.batch, DT, 1, NULL, results);
            c.is_unlucky = 0;
            for (int32_t i = 0; i < t.count; ++i) {
                FE_TRUE(results[i] == FE_OK || results[i] == FE_ERROR_MEMORY);
                if (results[i] == FE_OK) MUST(fe_world_step(t.alone[i], DT));
                failed -= results[i] != FE_OK, lost += results[i] != FE_OK;
                if (!same_hash(t.inside[i], t.alone[i])) fail_msg("%s is not what it was", t.name[i]);
            }
            FE_TRUE(failed == 0);
            if (k == STEPS / 2)
                for (int32_t i = 0; i < t.count; ++i) become_something(&t, i);
        }
        twins_end(&t);
        FE_TRUE(c.blocks == 0 && c.bytes == 0 && c.wrong == 0);
    }
    FE_TRUE(lost > 0);
}

static const moment *find_moment(const char *name)
{
    const moment *m = moments;
    while (strcmp(m->name, name)) ++m;
    return m;
}

// Of a first step each allocation fails in turn, those for what the worlds share among them: then each solves itself
static void the_shared_graph_may_fail(void **state)
{
    (void)state;
    enum { WORLDS = 4, STRIDE = SLOW_BUILD ? 5 : 1 };
    static const char *const names[WORLDS] = {"bouncing", "ropes", "cradle", "bullets"};
    static twins t;
    int32_t whole_steps = 0;
    for (int64_t k = 1, failures = 1; failures; k += STRIDE) {
        counting c = {0};
        fe_allocator allocator = counting_allocator(&c);
        plan p = {.worlds = WORLDS, .workers = 1, .block = WORLDS};
        int32_t results[WORLDS];
        twins_begin(&t, &p, &allocator);
        for (int32_t i = 0; i < WORLDS; ++i) {
            t.name[i] = names[i];
            become(t.inside[i], find_moment(names[i]), 0), become(t.alone[i], find_moment(names[i]), 0);
        }
        c.fail_from = c.calls + k, c.fail_count = 1;
        int32_t failed = fe_batch_step(t.batch, DT, 1, NULL, results);
        failures = c.failures;
        whole_steps += failures && !failed;
        FE_TRUE(failed <= failures);
        for (int32_t i = 0; i < WORLDS; ++i) {
            if (results[i] == FE_OK) MUST(fe_world_step(t.alone[i], DT));
            if (!same_hash(t.inside[i], t.alone[i])) fail_msg("%s is not what it was", names[i]);
        }
        twins_end(&t);
        FE_TRUE(c.blocks == 0 && c.wrong == 0);
    }
    FE_TRUE(whole_steps >= (SLOW_BUILD ? 1 : 20)); // as many arrays as the shared graph has
}

// ---- histories -----------------------------------------------------------------------------------------------------
static void histories_take_worlds_back(void **state)
{
    (void)state;
    enum { WORLDS = 16, KEPT = 3, STEPS = 4 };
    static twins t;
    plan p = {.worlds = WORLDS, .workers = 2, .block = WORLDS, .seed = 9};
    fe_history *history[WORLDS];
    twins_begin(&t, &p, NULL);
    for (int32_t i = 0; i < t.count; ++i) {
        become_something(&t, i);
        MUST(fe_history_create(t.inside[i], NULL, &history[i]));
    }
    for (int32_t round = 0; round < 3; ++round) {
        for (int32_t k = 0; k < KEPT; ++k) {
            for (int32_t i = 0; i < t.count; ++i) MUST(fe_history_keep(history[i], KEPT * round + k));
            FE_TRUE(fe_batch_step(t.batch, DT, STEPS, NULL, NULL) == 0);
        }
        for (int32_t i = 0; i < t.count; ++i) {
            for (int32_t k = 0; k < STEPS * (KEPT - 1); ++k) MUST(fe_world_step(t.alone[i], DT));
            if (i % 3) {
                MUST(fe_history_restore(history[i], KEPT * round + KEPT - 1));
                FE_TRUE(same_bytes(t.inside[i], t.alone[i])); // counters are of the last step that was made
                continue;
            }
            for (int32_t k = 0; k < STEPS; ++k) MUST(fe_world_step(t.alone[i], DT));
            compare(&t, i, round, 1);
        }
    }
    twins_end(&t); // a history ends with its world
}

// ---- time ----------------------------------------------------------------------------------------------------------
// A world has its share of the time that its worker spends within the call, and no times of stages
static void no_time_counts_twice(void **state)
{
    (void)state;
    enum { WORLDS = 16, ROUNDS = 3 };
    static twins t;
    plan p = {.worlds = WORLDS, .workers = 1, .block = WORLDS};
    twins_begin(&t, &p, NULL);
    for (int32_t i = 0; i < t.count; ++i) become_something(&t, i);
    for (int32_t k = 0; k < ROUNDS; ++k) {
        double sum = 0, parts = 0, before = fe__clock();
        FE_TRUE(fe_batch_step(t.batch, k == 2 ? 0.0f : DT, 1, NULL, NULL) == 0);
        const double spent = 1e3 * (fe__clock() - before);
        for (int32_t i = 0; i < t.count; ++i) {
            fe_profile a = {.struct_size = sizeof a};
            MUST(fe_world_get_profile(t.inside[i], &a));
            FE_TRUE(a.step > 0.0f);
            sum += (double)a.step;
            parts +=
                (double)(a.pairs + a.collide + a.islands + a.solve + a.continuous + a.finalize + a.events + a.sleep);
        }
        FE_WITHIN(sum, 0, 1.0001 * spent);
        FE_TRUE(parts == 0.0);
    }
    twins_end(&t);
}

static int begin_all(void **state)
{
    (void)state;
    take_moments();
    return 0;
}

static int end_all(void **state)
{
    (void)state;
    forget_moments();
    return 0;
}

int main(int argc, char **argv)
{
    if (argc > 1) whole = atoi(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_two_step_side_by_side),  cmocka_unit_test(what_is_beside_a_world_does_not_show),
        cmocka_unit_test(batches_by_chance),          cmocka_unit_test(who_stays_awake_is_the_same),
        cmocka_unit_test(steps_fail_one_by_one),      cmocka_unit_test(the_shared_graph_may_fail),
        cmocka_unit_test(histories_take_worlds_back), cmocka_unit_test(no_time_counts_twice),
    };
    return cmocka_run_group_tests_name("lockstep", tests, begin_all, end_all);
}
