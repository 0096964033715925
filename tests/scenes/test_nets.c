// test_nets.c - nets of joints that open wide with few substeps: stretched islands, see docs/dev/ARCHITECTURE.md, Solver.
#include "scenes/joint_scene.h"

#include <string.h>

// The balls, 1 m apart, and their joints; the middle of the first row is static.
typedef struct net {
    int columns, rows, anchors, joint_count;
    fe_body ball[100][100]; // column, row
    fe_joint joint[20000];
} net;

static int is_anchor(const net *n, int column, int row)
{
    int first = (n->columns - n->anchors) / 2;
    return row == 0 && column >= first && column < first + n->anchors;
}

static void join(scene *s, net *n, fe_body a, fe_body b, vec at)
{
    n->joint[n->joint_count++] = add_ball(s, ball_def(), a, b, at, v3(0, 0, 1));
}

static net *hang_net(scene *s, int columns, int rows, int anchors, double gravity_scale)
{
    static net n;
    n.columns = columns, n.rows = rows, n.anchors = anchors, n.joint_count = 0;
    for (int k = 0; k < columns; ++k)
        for (int i = 0; i < rows; ++i) {
            vec at = v3(k, -i, 0);
            fe_body body = n.ball[k][i] = is_anchor(&n, k, i) ? add_anchor(s, at) : add_plain(s, sphere(0.4), at);
            if (!is_anchor(&n, k, i)) MUST(fe_body_set_gravity_scale(s->world, body, (float)gravity_scale));
            if (i > 0) join(s, &n, n.ball[k][i - 1], body, v3(k, 0.5 - i, 0));
            if (k > 0 && !(is_anchor(&n, k, i) && is_anchor(&n, k - 1, i)))
                join(s, &n, n.ball[k - 1][i], body, v3(k - 0.5, -i, 0));
        }
    return &n;
}

static void for_all_balls(scene *s, const net *n, void (*f)(scene *s, fe_body ball, double value), double value)
{
    for (int k = 0; k < n->columns; ++k)
        for (int i = 0; i < n->rows; ++i)
            if (!is_anchor(n, k, i)) f(s, n->ball[k][i], value);
}

static void set_weight(scene *s, fe_body ball, double scale)
{
    MUST(fe_body_set_gravity_scale(s->world, ball, (float)scale));
}
static void set_drag(scene *s, fe_body ball, double rate)
{
    MUST(fe_body_set_damping(s->world, ball, (float)rate, (float)rate));
}
#if !SLOW_BUILD
static void set_alone(scene *s, fe_body ball, double unused)
{
    (void)unused;
    touch_nothing(s, ball);
}
#endif

// ---- how far it opens -----------------------------------------------------------------------------------------------
// It falls until its joints hold it, and swings. 3.3 times the gap at rest, P2: what scenes of chains are allowed.
static void a_large_net_opens_by_what_it_weighs(void **state)
{
#if SLOW_BUILD
    (void)state;
    print_message("*** NOT TESTED: too slow in this build ***\n");
    skip();
#else
    enum { STEPS = 150 };
    const double scale = 2;
    scene s = scene_begin(state);
    net *n = hang_net(&s, 60, 100, 3, scale);
    for_all_balls(&s, n, set_alone, 0);
    double mass = mass_of(&s, n->ball[0][1]), load = (60 * 100 - 3) * mass * scale * G / 3, widest = 0;
    for (int i = 0; i < STEPS; ++i) {
        run(&s, 1);
        widest = fmax(widest, worst_gap(&s, n->joint, n->joint_count));
    }
    FE_WITHIN(widest, 0.5 * joint_give(&s, load, mass / 2), 3.3 * joint_give(&s, load, mass / 2));
    scene_end(&s);
#endif
}

// ---- what its joints bear -------------------------------------------------------------------------------------------
// A ladder of two columns. Its widest gap is that of the second row's, between two balls; the first hangs on what does
// not move.
static void check_ladder(const scene *s, const net *n, double scale)
{
    double mass = mass_of(s, n->ball[0][1]), load = (n->rows - 2) * mass * scale * G, force = 0;
    FE_NEAR(worst_gap(s, n->joint, n->joint_count), joint_give(s, load, mass / 2),
            0.02 * joint_give(s, load, mass / 2));
    for (int i = 0; i < n->joint_count; ++i) {
        vec f = force_of(s, n->joint[i]);
        force = fmax(force, f.y);
    }
    FE_NEAR(force, load + mass * scale * G, 0.015 * load);
}

// Its gaps are those of the world's substeps, whether it is stretched or not: 11 cm; 4 cm, where it stays stretched; 2
// cm, where it does not; 4 cm again, where it stays so
static void a_net_bears_the_same_however_stretched_it_is(void **state)
{
    const double scales[] = {36, 13, 6, 13};
    scene s = scene_begin(state);
    net *n = hang_net(&s, 2, 20, 2, scales[0]);
    for_all_balls(&s, n, set_drag, 2);
    for (int i = 0; i < 4; ++i) {
        for_all_balls(&s, n, set_weight, scales[i]);
        run(&s, 500);
        check_ladder(&s, n, scales[i]);
    }
    scene_end(&s);
}

// Its load is taken from it within six seconds, so slowly that it follows its gaps up; the step in which it is
// stretched no more does not show. A substep of its own weight would be g h = 0.4 m/s.
static void a_net_comes_back_without_a_jerk(void **state)
{
    enum { STEPS = 360 };
    const double most = 18, least = 4;
    scene s = scene_begin(state);
    net *n = hang_net(&s, 2, 20, 2, most);
    for_all_balls(&s, n, set_drag, 2);
    run(&s, 500);
    double before = position(&s, n->ball[0][19]).y, last = 0;
    for (int i = 1; i <= STEPS; ++i) {
        for_all_balls(&s, n, set_weight, most + (least - most) * i / STEPS);
        run(&s, 1);
        double now = position(&s, n->ball[0][19]).y, speed = (now - before) / STEP;
        FE_NEAR(speed, last, 0.03);
        before = now, last = speed;
    }
    scene_end(&s);
}

// ---- determinism ---------------------------------------------------------------------------------------------------
// A net that opens while it falls on a floor: islands below and above the size from which on all workers share one
static void hash_of_fall(fe_simd simd, int workers, int columns, int rows, uint32_t out_hash[4])
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.substeps = 4, def.worker_count = workers, def.simd = (int32_t)simd, def.gravity = fe_make_vec3(0, -(float)G, 0);
    scene s = {NULL, UNTURNED, 4, STEP / 4};
    memset(out_hash, 0, 4 * sizeof *out_hash);
    if (fe_world_create(&def, &s.world) < 0) return; // not on this processor
    (void)add_static(&s, box(200, 0.5, 200), v3(0, -rows, 0), UNTURNED, friction(0.6));
    net *n = hang_net(&s, columns, rows, 1, 12);
    run(&s, SLOW_BUILD ? 30 : 60);
    FE_WITHIN(worst_gap(&s, n->joint, n->joint_count), 0.05, 5);
    MUST(fe_world_hash(s.world, out_hash));
    scene_end(&s);
}

static void a_stretched_net_is_the_same_for_all_workers_and_sets(void **state)
{
    static const int sizes[][2] = {{12, 12}, {24, 36}};
    static const fe_simd sets[] = {FE_SIMD_PLAIN, FE_SIMD_SSE2, FE_SIMD_AVX2, FE_SIMD_AVX512, FE_SIMD_NEON};
    (void)state;
    for (int k = 0; k < 2; ++k) {
        uint32_t first[4], other[4];
        hash_of_fall(FE_SIMD_AUTO, 1, sizes[k][0], sizes[k][1], first);
        for (int workers = 2; workers <= (SLOW_BUILD ? 2 : 3); ++workers) {
            hash_of_fall(FE_SIMD_AUTO, workers, sizes[k][0], sizes[k][1], other);
            assert_memory_equal(first, other, sizeof first);
        }
        for (size_t i = 0; i < sizeof sets / sizeof *sets && !SLOW_BUILD; ++i) {
            hash_of_fall(sets[i], 1, sizes[k][0], sizes[k][1], other);
            if (other[0] | other[1] | other[2] | other[3]) assert_memory_equal(first, other, sizeof first);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_large_net_opens_by_what_it_weighs),
        WITH_4_SUBSTEPS(a_large_net_opens_by_what_it_weighs),
        TEST(a_net_bears_the_same_however_stretched_it_is),
        WITH_4_SUBSTEPS(a_net_bears_the_same_however_stretched_it_is),
        WITH_4_SUBSTEPS(a_net_comes_back_without_a_jerk),
        TEST(a_stretched_net_is_the_same_for_all_workers_and_sets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
