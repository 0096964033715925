// test_repeated_steps.c - a step that found no memory and is repeated at once: the run goes on to its end as if nothing
// had happened, in what the hash sees and in what it does not: boxes of the trees, orders of lists, free slots.
//
//   test_repeated_steps [failures]
#include "fe_test.h"
#include "robust/counting_allocator.h"
#include "support/play.h"
#include "world/contact.h"

static int32_t most_failures = 400; // allocations that fail, over all runs

enum { STEPS = 300 };

// ---- a scene whose trees are built anew far from where they began --------------------------------------------------
enum { SIDE = 4, TRAVELLERS = SIDE * SIDE * SIDE };

// A crowd at 400 m/s, without gravity. After 3 s it is farther from where its tree began than a tree puts up with.
static void build_travellers(play *p)
{
    fe_vec3 none = {0.0f, 0.0f, 0.0f};
    PLAY(p, fe_world_set_gravity(p->world, &none));
    for (int32_t i = 0; i < TRAVELLERS; ++i) {
        double x = 1.1 * (i % SIDE), y = 1.1 * (i / SIDE % SIDE), z = 1.1 * (i / SIDE / SIDE);
        part a = i % 3 ? part_sphere(0.4f, x, y, z) : part_box(0.4f, 0.3f, 0.4f, x, y, z);
        a.body.linear_velocity = fe_make_vec3(400.0f + play_between(p, -1.0f, 1.0f), play_between(p, -1.0f, 1.0f),
                                              play_between(p, -1.0f, 1.0f));
        a.shape.material.restitution = 1.0f;
        play_add(p, &a);
    }
}

static void let_travel(play *p) { (void)p; }

static const script script_travel = {"travel", STEPS, build_travellers, let_travel};

static const script *const scripts[] = {&script_travel, &script_brief, &script_fast,   &script_mixed,
                                        &script_joints, &script_spawn, &script_terrain};
enum { SCRIPTS = sizeof scripts / sizeof *scripts };

// ---- what a world holds --------------------------------------------------------------------------------------------
static void hash_indices(fe__hash *h, const int32_t *items, int32_t count)
{
    fe__hash_i32(h, count);
    for (int32_t i = 0; i < count; ++i) fe__hash_i32(h, items[i]);
}

static void hash_tree(fe__hash *h, const fe__tree *tree)
{
    fe__hash_i32(h, tree->proxy_count);
    for (int32_t i = 0; i < tree->slot_capacity; ++i) {
        if (tree->slot[i] < 0) continue;
        fe__bounds box;
        fe__tree_get(tree, i, &box);
        fe__hash_dvec3(h, box.low);
        fe__hash_dvec3(h, box.high);
        fe__hash_i32(h, tree->slot[i]);
    }
}

static uint64_t all_of(const play *p)
{
    const fe_world *w = p->world;
    fe__hash h = fe__hash_begin();
    fe__hash_u64(&h, play_hash(p));
    hash_tree(&h, &w->static_tree);
    hash_tree(&h, &w->moving_tree);
    hash_indices(&h, w->moved, w->moved_count);
    hash_indices(&h, w->awake_bodies, w->awake_body_count);
    hash_indices(&h, w->awake_pairs, w->awake_pair_count);
    hash_indices(&h, w->awake_joints, w->awake_joint_count);
    hash_indices(&h, w->disturbed, w->disturbed_count);
    const int32_t places[] = {w->pair_limit, w->first_free_pair, w->pair_count, w->linked_count, w->first_owed};
    hash_indices(&h, places, sizeof places / sizeof *places);
    for (int32_t i = 0; i < w->awake_pair_count; ++i) {
        int32_t pair = w->awake_pairs[i] < 0 ? ~w->awake_pairs[i] : w->awake_pairs[i];
        fe__hash_u64(&h, fe__pair_serial(w, pair, 0));
        fe__hash_u64(&h, fe__pair_serial(w, pair, 1));
        fe__hash_i32(&h, w->contacts[pair].colour);
    }
    return fe__hash_end(&h);
}

// ---- runs ----------------------------------------------------------------------------------------------------------
typedef struct run {
    counting memory;
    const script *script;
    uint32_t seed;         // of the failures, 0: none
    int32_t is_stepping;   // 1: the call at hand is the step
    uint64_t before;       // all that the world held then
    uint64_t after[STEPS]; // and after each step
} run;

static void act(play *p)
{
    run *r = p->user;
    r->script->act(p);
    r->before = all_of(p);
    r->is_stepping = 1;
    r->memory.is_unlucky = r->seed != 0;
}

static int32_t look_after(play *p, fe_result result)
{
    run *r = p->user;
    if (!r->is_stepping) {
        FE_TRUE(result >= 0);
        return 0;
    }
    if (result == FE_ERROR_MEMORY) {
        if (all_of(p) != r->before) fail_msg("%s: a failed step changed the world", r->script->name);
        return 1;
    }
    FE_TRUE(result == FE_OK);
    r->is_stepping = r->memory.is_unlucky = 0;
    r->after[p->step] = all_of(p);
    return 0;
}

static void make_run(run *r, const script *s, uint32_t seed)
{
    *r = (run){.script = s, .seed = seed, .memory.chance = UINT64_C(0x9E3779B97F4A7C15) * (seed + 1)};
    const script watched = {s->name, s->steps, s->build, act};
    play p;
    play_begin(&p, counting_world(&r->memory));
    p.user = r;
    p.after = look_after;
    play_until(&p, &watched, s->steps < STEPS ? s->steps : STEPS);
    FE_TRUE(fe_world_destroy(p.world) == FE_OK);
    assert_int_equal(r->memory.blocks, 0);
    assert_int_equal(r->memory.wrong, 0);
}

static void a_repeated_step_leaves_no_trace(void **state)
{
    (void)state;
    static run calm[SCRIPTS], unlucky;
    for (int32_t k = 0; k < SCRIPTS; ++k) make_run(calm + k, scripts[k], 0);
    int64_t failures = 0;
    for (uint32_t seed = 1; failures < most_failures; ++seed) {
        const run *c = calm + seed % SCRIPTS;
        make_run(&unlucky, c->script, seed);
        FE_TRUE(unlucky.memory.failures > 0);
        failures += unlucky.memory.failures;
        for (int32_t i = 0; i < STEPS; ++i)
            if (unlucky.after[i] != c->after[i])
                fail_msg("%s, seed %u: another world after step %d", c->script->name, seed, (int)i + 1);
    }
}

int main(int argc, char **argv)
{
    if (argc > 1) most_failures = atoi(argv[1]);
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_repeated_step_leaves_no_trace)};
    return cmocka_run_group_tests_name("repeated steps", tests, NULL, NULL);
}
