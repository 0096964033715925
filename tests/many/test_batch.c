// test_batch.c - clones, states and batches: each world of a batch is, step by step, what it would be alone, whatever
// the workers, the block, the mask and the SIMD set.
//
//   test_batch          what belongs to every run
//   test_batch 1000     besides, a batch beside a loop at so many random moments, and a thousand times as many resets
#include "fe_test.h"
#include "robust/counting_allocator.h"
#include "support/play.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define OK(call) FE_TRUE((call) == FE_OK)
#define DT (1.0f / 60.0f)
enum { WORLDS = 9, MOST_ITEMS = 32 };
#if defined(FE_SANITIZED)
enum { SETS = 1, CASES = 1 }; // of SIMD sets; of scripts that a batch plays
#else
enum { SETS = 5, CASES = 4 };
#endif
static int32_t whole; // random moments, 0: none
static const int32_t sets[] = {FE_SIMD_PLAIN, FE_SIMD_SSE2, FE_SIMD_AVX2, FE_SIMD_AVX512, FE_SIMD_NEON};

// ---- worlds to start from -----------------------------------------------------------------------------------------
static fe_world *play_world(const script *s, int32_t steps, play *p)
{
    fe_world *world;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.number = 5;
    OK(fe_world_create(&def, &world));
    play_begin(p, world);
    play_until(p, s, steps);
    return world;
}

static fe_world *make_world(fe_store *store, const fe_allocator *allocator)
{
    fe_world_def def;
    fe_world *world;
    fe_world_def_init(&def, sizeof def);
    def.store = store, def.allocator = allocator;
    OK(fe_world_create(&def, &world));
    return world;
}

static fe_body add(fe_world *world, int32_t type, double y, const fe_geometry *form)
{
    fe_body_def def;
    fe_body body;
    fe_shape shape;
    fe_body_def_init(&def, sizeof def);
    def.type = type;
    def.transform = fe_make_transform(0.0, y, 0.0);
    OK(fe_body_create(world, &def, &body));
    OK(fe_shape_create(world, body, NULL, form, &shape));
    return body;
}

// A ball over a plane
static fe_world *ball_world(fe_body *out_ball)
{
    fe_world *world = make_world(NULL, NULL);
    fe_geometry form;
    fe_geometry_plane(&form, 0.0f, 1.0f, 0.0f, 0.0f);
    add(world, FE_BODY_STATIC, 0.0, &form);
    fe_geometry_sphere(&form, 0.5f);
    *out_ball = add(world, FE_BODY_DYNAMIC, 2.0, &form);
    return world;
}

static void step(fe_world *world) { OK(fe_world_step(world, DT)); }
static void destroy(fe_world *world) { OK(fe_world_destroy(world)); }

static uint64_t hash_of(const fe_world *world)
{
    uint32_t words[2];
    OK(fe_world_hash(world, words));
    return words[0] | (uint64_t)words[1] << 32;
}

static int32_t same_bytes(const fe_world *a, const fe_world *b)
{
    int64_t size = fe_world_save(a, NULL, NULL, 0);
    if (size <= 0 || fe_world_save(b, NULL, NULL, 0) != size) return 0;
    unsigned char *of_a = malloc((size_t)size), *of_b = malloc((size_t)size);
    FE_TRUE(of_a && of_b && fe_world_save(a, NULL, of_a, size) == size && fe_world_save(b, NULL, of_b, size) == size);
    int32_t same = memcmp(of_a, of_b, (size_t)size) == 0;
    free(of_a), free(of_b);
    return same;
}

static fe_batch *make_batch(const fe_world *source, int32_t worlds, int32_t workers, int32_t block, int32_t simd)
{
    fe_batch_def def;
    fe_batch *batch = NULL;
    fe_batch_def_init(&def, sizeof def);
    def.world_count = worlds, def.worker_count = workers, def.block = block, def.simd = simd;
    OK(fe_batch_create(source, &def, &batch));
    return batch;
}

static fe_world *world_of(const fe_batch *batch, int32_t i)
{
    fe_world *world = NULL;
    OK(fe_batch_get_world(batch, i, &world));
    return world;
}

// ---- clones and states --------------------------------------------------------------------------------------------
static int32_t take_refusal(play *p, fe_result result)
{
    if (result < 0 && result != FE_ERROR_STALE) fail_msg("step %d: %s", (int)p->step, fe_last_error());
    return 0;
}

// Two plays of one script from the same step on, in a world and in another one like it
static void goes_on_alike(const script *s, const play *from, fe_world *other, int32_t to)
{
    static play p, q;
    p = q = *from;
    q.world = other;
    p.after = q.after = take_refusal; // assets are the store's, which both have
    for (int32_t i = from->step + 1; i <= to; ++i) {
        play_until(&p, s, i);
        play_until(&q, s, i);
        if (play_hash(&p) != play_hash(&q) || play_told(&p) != play_told(&q))
            fail_msg("%s goes another way in step %d", s->name, (int)i);
    }
}

static void a_clone_goes_on(const script *s, int32_t at, int32_t to)
{
    static play p;
    for (int32_t i = 0; i < SETS; ++i) {
        if (!has_simd(sets[i])) continue;
        fe_world *world = play_world(s, at, &p), *clone;
        fe_world_def def;
        fe_world_def_init(&def, sizeof def);
        def.simd = sets[i], def.worker_count = 1 + i;
        OK(fe_world_clone(world, &def, &clone));
        FE_TRUE(hash_of(clone) == hash_of(world) && same_bytes(world, clone));
        goes_on_alike(s, &p, clone, to);
        destroy(world); // a store of its own lives on
        step(clone);
        destroy(clone);
    }
}

// A state that was taken before returns to its world, and to a clone that went its own way
static void a_state_returns(const script *s, int32_t at, int32_t to)
{
    static play p, q;
    fe_world *world = play_world(s, at, &p), *clone;
    fe_state *state;
    uint64_t then = hash_of(world);
    OK(fe_state_create(world, NULL, &state));
    OK(fe_world_clone(world, NULL, &clone));
    q = p, q.world = clone, q.after = take_refusal;
    play_until(&q, s, to);
    OK(fe_world_set_state(clone, state));
    FE_TRUE(hash_of(clone) == then && same_bytes(world, clone));
    goes_on_alike(s, &p, clone, at + 5);
    OK(fe_world_set_state(world, state));
    OK(fe_world_set_state(clone, state));
    goes_on_alike(s, &p, clone, at + 10);
    destroy(world);
    OK(fe_world_set_state(clone, state)); // it outlives whom it was taken of
    FE_TRUE(hash_of(clone) == then);
    destroy(clone);
    OK(fe_state_destroy(state));
}

#define CASE(name, at, to)                       \
    static void name##_is_cloned(void **state)   \
    {                                            \
        (void)state;                             \
        a_clone_goes_on(&script_##name, at, to); \
        a_state_returns(&script_##name, at, to); \
    }
CASE(brief, 60, 90)
CASE(crowd, 30, 42)
CASE(mixed, 60, 80)
CASE(terrain, 60, 80)
CASE(fast, 40, 60)
CASE(joints, 40, 60)
CASE(meshes, 40, 60)
CASE(compounds, 40, 60)

// ---- a batch is a loop --------------------------------------------------------------------------------------------
typedef struct course { // what both do: forces on some bodies, and who steps
    fe_body bodies[MOST_ITEMS];
    int32_t count;
    float forces[WORLDS][MOST_ITEMS][6];
    uint8_t mask[WORLDS];
    uint32_t seed;
} course;

static float draw(course *c)
{
    c->seed = c->seed * 1664525u + 1013904223u;
    return (float)(c->seed >> 8) / (float)(1 << 23) - 1.0f;
}

static void choose_bodies(course *c, const fe_world *world)
{
    static fe_body all[4096];
    int32_t count = fe_world_get_bodies(world, all, 4096), type;
    c->count = 0;
    for (int32_t i = 0; i < count && i < 4096 && c->count < MOST_ITEMS; ++i) {
        OK(fe_body_get_type(world, all[i], &type));
        if (type == FE_BODY_DYNAMIC) c->bodies[c->count++] = all[i];
    }
}

static void next(course *c)
{
    for (int32_t w = 0; w < WORLDS; ++w) {
        c->mask[w] = draw(c) > -0.5f;
        for (int32_t i = 0; i < c->count; ++i)
            for (int32_t k = 0; k < 6; ++k) c->forces[w][i][k] = 50.0f * draw(c);
    }
}

static fe_array array_of(const fe_handle *items, int32_t count, int32_t field, int32_t row, void *data)
{
    fe_array a;
    fe_array_init(&a, sizeof a);
    a.field = field, a.items = items, a.item_count = count, a.data = data;
    a.bytes = (int64_t)sizeof(float) * WORLDS * count * row;
    return a;
}

// The array is packed: as many rows a world as there are bodies
static float *packed_forces(const course *c, float *out)
{
    for (int32_t w = 0; w < WORLDS; ++w)
        memcpy(out + w * c->count * 6, c->forces[w], (size_t)c->count * 6 * sizeof *out);
    return out;
}

static void is_a_loop(const script *s, int32_t at, int32_t workers, int32_t block, int32_t simd, int32_t calls)
{
    static play p;
    static course c;
    static float forces[WORLDS * MOST_ITEMS * 6], poses[WORLDS * MOST_ITEMS * 7], pose[7];
    fe_world *world = play_world(s, at, &p), *alone[WORLDS];
    fe_batch *batch = make_batch(world, WORLDS, workers, block, simd);
    int32_t results[WORLDS];
    c.seed = 7u * (uint32_t)at;
    choose_bodies(&c, world);
    for (int32_t w = 0; w < WORLDS; ++w) OK(fe_world_clone(world, NULL, &alone[w]));
    fe_array input = array_of(c.bodies, c.count, FE_FIELD_FORCE, 6, forces),
             output = array_of(c.bodies, c.count, FE_FIELD_TRANSFORM, 7, poses);
    OK(fe_batch_bind(batch, &input, 1, &output, 1));
    for (int32_t i = 0; i < calls; ++i) {
        int32_t each = 1 + i % 3;
        next(&c);
        packed_forces(&c, forces);
        FE_TRUE(fe_batch_step(batch, DT, each, c.mask, results) == 0);
        for (int32_t w = 0; w < WORLDS; ++w) {
            FE_TRUE(results[w] == FE_OK);
            for (int32_t k = 0; k < each && c.mask[w]; ++k) {
                OK(fe_world_add_forces(alone[w], c.bodies, c.forces[w][0], 0, c.count));
                step(alone[w]);
            }
            if (hash_of(world_of(batch, w)) != hash_of(alone[w]))
                fail_msg("%s: world %d goes another way in step %d", s->name, (int)w, (int)i);
            fe_dvec3 origin = {0.0, 0.0, 0.0};
            if (!c.mask[w]) continue;
            OK(fe_world_get_transforms_f32(alone[w], c.bodies + c.count - 1, &origin, pose, 0, 1));
            FE_TRUE(memcmp(pose, poses + (w * c.count + c.count - 1) * 7, sizeof pose) == 0);
        }
    }
    uint32_t words[2 * WORLDS];
    OK(fe_batch_hash(batch, words));
    for (int32_t w = 0; w < WORLDS; ++w)
        FE_TRUE((words[2 * w] | (uint64_t)words[2 * w + 1] << 32) == hash_of(alone[w]));
    FE_TRUE(fe_batch_reset(batch, c.mask, NULL, results) == 0);
    for (int32_t w = 0; w < WORLDS; ++w) FE_TRUE(hash_of(world_of(batch, w)) == hash_of(c.mask[w] ? world : alone[w]));
    for (int32_t w = 0; w < WORLDS; ++w) destroy(alone[w]);
    OK(fe_batch_destroy(batch));
    destroy(world);
}

enum { CALLS = 9 }; // of one, two and three steps

static void a_batch_is_a_loop(void **state)
{
    (void)state;
    static const struct {
        const script *script;
        int32_t at;
    } cases[] = {{&script_brief, 60}, {&script_joints, 30}, {&script_meshes, 30}, {&script_terrain, 60}};
    static const int32_t workers[] = {1, 2, 3, 8}, blocks[] = {0, 1, 5, 1 << 20};
    for (int32_t i = 0; i < CASES; ++i)
        for (int32_t k = 0; k < 4; ++k)
            is_a_loop(cases[i].script, cases[i].at, workers[k], blocks[(i + k) % 4], FE_SIMD_AUTO, CALLS);
    for (int32_t i = 0; i < SETS; ++i)
        if (has_simd(sets[i])) is_a_loop(&script_joints, 30, 2, 0, sets[i], CALLS);
}

// Scripts, moments, workers, blocks and SIMD sets by chance, each for 200 steps
static void a_batch_is_a_loop_at_random_moments(void **state)
{
    (void)state;
    static const script *const scripts[] = {&script_brief, &script_joints,    &script_meshes, &script_terrain,
                                            &script_fast,  &script_compounds, &script_solids, &script_scales};
    static const int32_t workers[] = {1, 2, 3, 16};
    static course chance = {.seed = 1};
    enum { LONG = 100, MOST_BLOCK = 12, LATEST = 200 };
    for (int32_t i = 0; i < whole; ++i) {
        uint32_t drawn[5];
        for (int32_t k = 0; k < 5; ++k) drawn[k] = (uint32_t)(1e6f * (draw(&chance) + 1.0f));
        int32_t simd = sets[drawn[4] % SETS];
        is_a_loop(scripts[drawn[0] % 8], (int32_t)(drawn[1] % LATEST), workers[drawn[2] % 4],
                  (int32_t)(drawn[3] % MOST_BLOCK), has_simd(simd) ? simd : FE_SIMD_AUTO, LONG);
    }
}

static void worlds_share_a_pool_and_go_their_own_ways(void **state)
{
    (void)state;
    fe_body ball;
    fe_pool *pool;
    fe_batch *batch;
    fe_world *world = ball_world(&ball), *own;
    fe_batch_def def;
    OK(fe_pool_create(3, &pool));
    fe_batch_def_init(&def, sizeof def);
    def.world_count = WORLDS, def.pool = pool;
    OK(fe_batch_create(world, &def, &batch));
    FE_TRUE(fe_pool_destroy(pool) == FE_ERROR_STATE);
    OK(fe_body_set_linear_velocity(world_of(batch, 4), ball, &(fe_vec3){3.0f, 0.0f, 0.0f}));
    OK(fe_world_clone(world_of(batch, 4), NULL, &own));
    FE_TRUE(fe_batch_step(batch, DT, 20, NULL, NULL) == 0);
    for (int32_t i = 0; i < 20; ++i) step(own), step(world);
    for (int32_t w = 0; w < WORLDS; ++w) FE_TRUE(hash_of(world_of(batch, w)) == hash_of(w == 4 ? own : world));
    OK(fe_batch_destroy(batch));
    OK(fe_pool_destroy(pool));
    destroy(own), destroy(world);
}

// ---- fields -------------------------------------------------------------------------------------------------------
enum { JOINTS = 3 };
typedef struct arm {
    fe_world *world;
    fe_body bodies[JOINTS + 1];
    fe_joint joints[JOINTS]; // a hinge, a slider, a distance
} arm;

// Three links in a row, without weight
static arm make_arm(float motor_max)
{
    arm a = {.world = make_world(NULL, NULL)};
    fe_geometry form;
    fe_geometry_box(&form, 0.2f, 0.1f, 0.1f);
    OK(fe_world_set_gravity(a.world, &(fe_vec3){0.0f, 0.0f, 0.0f}));
    for (int32_t i = 0; i <= JOINTS; ++i) {
        a.bodies[i] = add(a.world, FE_BODY_DYNAMIC, 1.0, &form);
        fe_transform t = fe_make_transform(i, 1.0, 0.0);
        OK(fe_body_set_transform(a.world, a.bodies[i], &t));
    }
    fe_hinge_joint_def hinge;
    fe_hinge_joint_def_init(&hinge, sizeof hinge);
    OK(fe_hinge_joint_def_at(a.world, &hinge, a.bodies[0], a.bodies[1], &(fe_dvec3){0.5, 1.0, 0.0},
                             &(fe_vec3){0.0f, 0.0f, 1.0f}));
    hinge.motor_max = motor_max;
    OK(fe_hinge_joint_create(a.world, &hinge, &a.joints[0]));
    fe_configurable_joint_def slider;
    fe_configurable_joint_def_init(&slider, sizeof slider);
    slider.body_a = a.bodies[1], slider.body_b = a.bodies[2];
    slider.frame_a.position = (fe_vec3){0.5f, 0.0f, 0.0f}, slider.frame_b.position = (fe_vec3){-0.5f, 0.0f, 0.0f};
    slider.axes[FE_DOF_LINEAR_X].motion = FE_MOTION_FREE;
    slider.axes[FE_DOF_LINEAR_X].motor_max = motor_max;
    OK(fe_configurable_joint_create(a.world, &slider, &a.joints[1]));
    fe_distance_joint_def distance;
    fe_distance_joint_def_init(&distance, sizeof distance);
    distance.body_a = a.bodies[2], distance.body_b = a.bodies[3];
    OK(fe_distance_joint_create(a.world, &distance, &a.joints[2]));
    return a;
}

// One field of one world after the other, against the getters
static void fields_are_what_the_getters_say(void **state)
{
    (void)state;
    arm a = make_arm(100.0f);
    fe_batch *batch = make_batch(a.world, WORLDS, 2, 0, FE_SIMD_AUTO);
    for (int32_t w = 0; w < WORLDS; ++w) {
        fe_vec3 v = {0.1f * (float)w, 0.2f, -0.3f}, spin = {0.3f, -0.1f * (float)w, 0.2f};
        OK(fe_body_set_linear_velocity(world_of(batch, w), a.bodies[0], &v));
        OK(fe_body_set_angular_velocity(world_of(batch, w), a.bodies[1], &spin));
    }
    FE_TRUE(fe_batch_step(batch, DT, 7, NULL, NULL) == 0);
    static float poses[WORLDS][JOINTS + 1][7], speeds[WORLDS][JOINTS + 1][6], awake[WORLDS][JOINTS + 1],
        angles[WORLDS][JOINTS][2], reactions[WORLDS][JOINTS][6], gravity[WORLDS][3];
    static double exact[WORLDS][JOINTS + 1][7];
    const fe_array arrays[] = {array_of(a.bodies, JOINTS + 1, FE_FIELD_TRANSFORM, 7, poses),
                               array_of(a.bodies, JOINTS + 1, FE_FIELD_VELOCITY, 6, speeds),
                               array_of(a.bodies, JOINTS + 1, FE_FIELD_AWAKE, 1, awake),
                               array_of(a.joints, JOINTS, FE_FIELD_JOINT, 2, angles),
                               array_of(a.joints, JOINTS, FE_FIELD_REACTION, 6, reactions),
                               array_of(NULL, 1, FE_FIELD_GRAVITY, 3, gravity)};
    for (int32_t i = 0; i < 6; ++i) FE_TRUE(fe_batch_read(batch, &arrays[i], NULL) == 0);
    fe_array doubles = array_of(a.bodies, JOINTS + 1, FE_FIELD_TRANSFORM, 7, exact);
    doubles.is_double = 1, doubles.bytes *= 2;
    FE_TRUE(fe_batch_read(batch, &doubles, NULL) == 0);
    for (int32_t w = 0; w < WORLDS; ++w) {
        const fe_world *world = world_of(batch, w);
        for (int32_t i = 0; i <= JOINTS; ++i) {
            float pose[7], speed[6];
            int32_t is_awake;
            fe_dvec3 origin = {0.0, 0.0, 0.0};
            fe_transform t;
            OK(fe_world_get_transforms_f32(world, &a.bodies[i], &origin, pose, 0, 1));
            OK(fe_world_get_velocities(world, &a.bodies[i], speed, 0, 1));
            OK(fe_body_get_awake(world, a.bodies[i], &is_awake));
            OK(fe_body_get_transform(world, a.bodies[i], &t));
            FE_TRUE(memcmp(pose, poses[w][i], sizeof pose) == 0 && memcmp(speed, speeds[w][i], sizeof speed) == 0);
            FE_TRUE(awake[w][i] == (float)is_awake && exact[w][i][0] == t.position.x && exact[w][i][2] == t.position.z);
        }
        for (int32_t i = 0; i < JOINTS; ++i) {
            fe_joint_state js;
            fe_vec3 force, torque;
            fe_joint_state_init(&js, sizeof js);
            OK(fe_joint_get_state(world, a.joints[i], &js));
            OK(fe_joint_get_reaction(world, a.joints[i], &force, &torque));
            const float at[] = {js.angle, js.translation.x, js.length},
                        rate[] = {js.angular_velocity.x, js.linear_velocity.x, js.speed};
            FE_TRUE(angles[w][i][0] == at[i] && angles[w][i][1] == rate[i]);
            FE_TRUE(reactions[w][i][0] == force.x && reactions[w][i][2] == force.z && reactions[w][i][5] == torque.z);
        }
        FE_TRUE(gravity[w][0] == 0.0f && gravity[w][1] == 0.0f && gravity[w][2] == 0.0f);
    }
    OK(fe_batch_destroy(batch));
    destroy(a.world);
}

// What is read relative to a body is what a rotation of the whole arm leaves as it was
static void fields_are_read_in_a_body_s_frame(void **state)
{
    (void)state;
    arm a = make_arm(100.0f);
    fe_batch *batch = make_batch(a.world, WORLDS, 1, 0, FE_SIMD_AUTO);
    static float poses[WORLDS][JOINTS + 1][7], speeds[WORLDS][1][6];
    const float half = 0.5f * 0.9f; // a turn of 0.9 rad about y, by world
    for (int32_t w = 0; w < WORLDS; ++w) {
        float angle = half * (float)w;
        fe_quat q = {0.0f, sinf(angle), 0.0f, cosf(angle)};
        for (int32_t i = 0; i <= JOINTS; ++i) {
            fe_transform t = {{i * cos(2.0 * (double)angle) + 3.0, 1.0, -i * sin(2.0 * (double)angle)}, q};
            fe_vec3 ahead = {2.0f * cosf(2.0f * angle), 0.0f, -2.0f * sinf(2.0f * angle)};
            OK(fe_body_set_transform(world_of(batch, w), a.bodies[i], &t));
            OK(fe_body_set_linear_velocity(world_of(batch, w), a.bodies[i], &ahead));
        }
    }
    fe_array pose = array_of(a.bodies, JOINTS + 1, FE_FIELD_TRANSFORM, 7, poses),
             speed = array_of(a.bodies + 2, 1, FE_FIELD_VELOCITY, 6, speeds);
    pose.relative_to = speed.relative_to = a.bodies[0];
    FE_TRUE(fe_batch_read(batch, &pose, NULL) == 0 && fe_batch_read(batch, &speed, NULL) == 0);
    const double rounding = 1e-5; // of floats, 3 m long
    for (int32_t w = 0; w < WORLDS; ++w) {
        for (int32_t i = 0; i <= JOINTS; ++i) {
            FE_NEAR(poses[w][i][0], i, rounding);
            FE_NEAR(poses[w][i][1], 0, rounding);
            FE_NEAR(poses[w][i][2], 0, rounding);
            FE_NEAR(fabsf(poses[w][i][6]), 1, rounding);
        }
        FE_NEAR(speeds[w][0][0], 2, rounding);
        FE_NEAR(speeds[w][0][2], 0, rounding);
    }
    OK(fe_batch_destroy(batch));
    destroy(a.world);
}

// Drives and forces along the free axes are the calls that they stand for; a joint's force moves no centre of mass
static void inputs_are_the_calls_that_they_stand_for(void **state)
{
    (void)state;
    arm a = make_arm(100.0f);
    fe_batch *batch = make_batch(a.world, WORLDS, 2, 1, FE_SIMD_AUTO);
    fe_world *alone;
    static float speeds[WORLDS][2], gravity[WORLDS][3];
    for (int32_t w = 0; w < WORLDS; ++w) {
        speeds[w][0] = 0.5f * (float)w, speeds[w][1] = -0.2f * (float)w;
        gravity[w][1] = -(float)w;
    }
    const fe_array inputs[] = {array_of(a.joints, 2, FE_FIELD_JOINT_SPEED, 1, speeds),
                               array_of(NULL, 1, FE_FIELD_GRAVITY, 3, gravity)};
    OK(fe_batch_bind(batch, inputs, 2, NULL, 0));
    OK(fe_world_clone(a.world, NULL, &alone));
    FE_TRUE(fe_batch_step(batch, DT, 10, NULL, NULL) == 0);
    OK(fe_joint_set_motor_speed(alone, a.joints[0], FE_DOF_ANGULAR_X, speeds[5][0]));
    OK(fe_joint_set_motor_speed(alone, a.joints[1], FE_DOF_LINEAR_X, speeds[5][1]));
    OK(fe_world_set_gravity(alone, &(fe_vec3){0.0f, gravity[5][1], 0.0f}));
    for (int32_t i = 0; i < 10; ++i) step(alone);
    FE_TRUE(hash_of(world_of(batch, 5)) == hash_of(alone));
    destroy(alone);
    OK(fe_batch_destroy(batch));
    destroy(a.world);
}

// Between its two bodies: no momentum comes of it. In several steps of a call it acts in all of them.
static void a_joint_s_force_turns_and_pulls(void **state)
{
    (void)state;
    arm a = make_arm(0.0f);
    fe_batch *batch = make_batch(a.world, WORLDS, 2, 1, FE_SIMD_AUTO),
             *one = make_batch(a.world, WORLDS, 2, 1, FE_SIMD_AUTO);
    static float forces[WORLDS][JOINTS];
    for (int32_t w = 0; w < WORLDS; ++w) forces[w][0] = (float)w, forces[w][1] = -2.0f, forces[w][2] = 0.5f * (float)w;
    fe_array force = array_of(a.joints, JOINTS, FE_FIELD_JOINT_FORCE, 1, forces);
    OK(fe_batch_bind(batch, &force, 1, NULL, 0));
    OK(fe_batch_bind(one, &force, 1, NULL, 0));
    FE_TRUE(fe_batch_step(batch, DT, 10, NULL, NULL) == 0);
    for (int32_t i = 0; i < 10; ++i) FE_TRUE(fe_batch_step(one, DT, 1, NULL, NULL) == 0);
    for (int32_t w = 0; w < WORLDS; ++w) {
        const fe_world *world = world_of(batch, w);
        fe_dvec3 linear, angular;
        fe_joint_state js;
        fe_joint_state_init(&js, sizeof js);
        FE_TRUE(hash_of(world) == hash_of(world_of(one, w)));
        OK(fe_world_get_momentum(world, &(fe_dvec3){0.0, 0.0, 0.0}, &linear, &angular));
        // of forces of 12 N over a sixth of a second, on 16 kg each: rounding alone
        FE_NEAR(linear.x, 0, 1e-3);
        FE_NEAR(linear.y, 0, 1e-3);
        FE_NEAR(angular.z, 0, 1e-3);
        OK(fe_joint_get_state(world, a.joints[0], &js));
        FE_TRUE(w == 0 || js.angular_velocity.x > 0.0f);
        OK(fe_joint_get_state(world, a.joints[1], &js));
        FE_TRUE(w > 0 || js.linear_velocity.x < 0.0f); // where nothing turns and flings it out
    }
    OK(fe_batch_destroy(batch));
    OK(fe_batch_destroy(one));
    destroy(a.world);
}

static void what_is_written_is_read(void **state)
{
    (void)state;
    fe_body ball;
    fe_world *world = ball_world(&ball);
    fe_batch *batch = make_batch(world, WORLDS, 1, 0, FE_SIMD_AUTO);
    static float in[WORLDS][7], out[WORLDS][7];
    uint8_t mask[WORLDS] = {0};
    for (int32_t w = 0; w < WORLDS; ++w) {
        const float pose[7] = {(float)w, 2.0f, -1.0f, 0.0f, 0.0f, 0.0f, 1.0f};
        memcpy(in[w], pose, sizeof pose);
        mask[w] = (uint8_t)(w % 2);
    }
    fe_array written = array_of(&ball, 1, FE_FIELD_TRANSFORM, 7, in),
             read = array_of(&ball, 1, FE_FIELD_TRANSFORM, 7, out);
    FE_TRUE(fe_batch_write(batch, &written, mask, NULL) == 0 && fe_batch_read(batch, &read, NULL) == 0);
    for (int32_t w = 0; w < WORLDS; ++w) FE_TRUE(out[w][0] == (mask[w] ? (float)w : 0.0f) && out[w][1] == 2.0f);
    OK(fe_batch_destroy(batch));
    destroy(world);
}

// ---- what fails, fails alone --------------------------------------------------------------------------------------
// A box of 2 kg on a slope of 0.2 rad, where friction of 0.6 holds it
static fe_world *slope_world(fe_body *out_ground, fe_body *out_box, fe_shape *out_shape)
{
    fe_world *world = make_world(NULL, NULL);
    fe_geometry form;
    fe_geometry_plane(&form, sinf(0.2f), cosf(0.2f), 0.0f, 0.0f);
    *out_ground = add(world, FE_BODY_STATIC, 0.0, &form);
    fe_geometry_box(&form, 0.5f, 0.2f, 0.4f);
    *out_box = add(world, FE_BODY_DYNAMIC, 0.0, &form);
    const fe_transform at = {{0.2 * sin(0.2), 0.2 * cos(0.2), 0.0}, {0.0f, 0.0f, -sinf(0.1f), cosf(0.1f)}};
    OK(fe_body_set_transform(world, *out_box, &at));
    OK(fe_body_set_mass(world, *out_box, 2.0f));
    FE_TRUE(fe_body_get_shapes(world, *out_box, out_shape, 1) == 1);
    return world;
}

// Gravity pulls it by m g, so its contacts push it by as much, straight up; and the ground by the opposite
static void contacts_bear_what_weighs(void **state)
{
    (void)state;
    fe_body ground, box;
    fe_shape shape;
    fe_world *world = slope_world(&ground, &box, &shape);
    fe_batch *batch = make_batch(world, WORLDS, 2, 0, FE_SIMD_AUTO);
    static float masses[WORLDS][1], forces[WORLDS][2][3], seen[WORLDS][1][3];
    for (int32_t w = 0; w < WORLDS; ++w) masses[w][0] = 2.0f + (float)w;
    fe_array mass = array_of(&box, 1, FE_FIELD_MASS, 1, masses);
    fe_array both = array_of((fe_handle[]){box, ground}, 2, FE_FIELD_CONTACT_FORCE, 3, forces),
             along = array_of(&box, 1, FE_FIELD_CONTACT_FORCE, 3, seen);
    along.relative_to = box;
    FE_TRUE(fe_batch_write(batch, &mass, NULL, NULL) == 0);
    FE_TRUE(fe_batch_read(batch, &both, NULL) == 0); // before the first step
    FE_TRUE(forces[1][0][1] == 0.0f && forces[1][1][1] == 0.0f);
    FE_TRUE(fe_batch_step(batch, DT, 300, NULL, NULL) == 0); // it sleeps by now
    FE_TRUE(fe_batch_read(batch, &both, NULL) == 0 && fe_batch_read(batch, &along, NULL) == 0);
    for (int32_t w = 0; w < WORLDS; ++w) {
        double weight = 9.81 * (double)masses[w][0], most = 2e-3 * weight; // of what an iteration leaves
        FE_NEAR(forces[w][0][0], 0, most);
        FE_NEAR(forces[w][0][1], weight, most);
        FE_NEAR(forces[w][0][2], 0, most);
        for (int32_t k = 0; k < 3; ++k) FE_TRUE(forces[w][0][k] == -forces[w][1][k]);
        FE_NEAR(seen[w][0][0], -weight * sin(0.2), most); // friction
        FE_NEAR(seen[w][0][1], weight * cos(0.2), most);
    }
    OK(fe_batch_destroy(batch));
    destroy(world);
}

static void masses_and_frictions_are_those_of_the_calls(void **state)
{
    (void)state;
    fe_body ground, box;
    fe_shape shape;
    fe_world *world = slope_world(&ground, &box, &shape), *alone;
    fe_batch *batch = make_batch(world, WORLDS, 2, 0, FE_SIMD_AUTO);
    static float masses[WORLDS][1], frictions[WORLDS][2], seen[WORLDS][2], weighed[WORLDS][1];
    for (int32_t w = 0; w < WORLDS; ++w) {
        masses[w][0] = 1.0f + 0.5f * (float)w;
        frictions[w][0] = 0.05f * (float)w, frictions[w][1] = 0.04f * (float)w;
    }
    fe_array mass = array_of(&box, 1, FE_FIELD_MASS, 1, masses), weigh = array_of(&box, 1, FE_FIELD_MASS, 1, weighed),
             friction = array_of(&shape, 1, FE_FIELD_FRICTION, 2, frictions),
             look = array_of(&shape, 1, FE_FIELD_FRICTION, 2, seen);
    FE_TRUE(fe_batch_write(batch, &mass, NULL, NULL) == 0 && fe_batch_write(batch, &friction, NULL, NULL) == 0);
    FE_TRUE(fe_batch_read(batch, &weigh, NULL) == 0 && fe_batch_read(batch, &look, NULL) == 0);
    FE_TRUE(memcmp(seen, frictions, sizeof seen) == 0 && memcmp(weighed, masses, sizeof masses) == 0);
    FE_TRUE(fe_batch_step(batch, DT, 30, NULL, NULL) == 0);
    for (int32_t w = 0; w < WORLDS; ++w) {
        fe_material material;
        OK(fe_world_clone(world, NULL, &alone));
        OK(fe_body_set_mass(alone, box, masses[w][0]));
        OK(fe_shape_get_material(alone, shape, &material));
        material.static_friction = frictions[w][0], material.dynamic_friction = frictions[w][1];
        OK(fe_shape_set_material(alone, shape, &material));
        for (int32_t i = 0; i < 30; ++i) step(alone);
        FE_TRUE(hash_of(alone) == hash_of(world_of(batch, w)));
        destroy(alone);
    }
    // each bad row fails its world and changes nothing there
    int32_t results[WORLDS];
    static const float bad[] = {NAN, -1.0f, INFINITY};
    for (int32_t k = 0; k < 3; ++k) {
        masses[2][0] = frictions[2][1] = bad[k];
        FE_TRUE(fe_batch_write(batch, &mass, NULL, results) == 1 && results[2] == FE_ERROR_ARGUMENT);
        FE_TRUE(fe_batch_write(batch, &friction, NULL, results) == 1 && results[2] == FE_ERROR_ARGUMENT);
    }
    masses[2][0] = 0.0f;
    FE_TRUE(fe_batch_write(batch, &mass, NULL, results) == 1 && results[2] == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_batch_read(batch, &weigh, NULL) == 0 && weighed[2][0] == 2.0f);
    mass.items = &ground; // a static body has no mass
    FE_TRUE(fe_batch_write(batch, &mass, NULL, results) == WORLDS && results[0] == FE_ERROR_STATE);
    friction.items = &box;
    FE_TRUE(fe_batch_write(batch, &friction, NULL, NULL) == FE_ERROR_KIND);
    OK(fe_batch_destroy(batch));
    destroy(world);
}

static void a_bad_row_fails_its_world(void **state)
{
    (void)state;
    fe_body ball;
    fe_world *world = ball_world(&ball);
    fe_batch *batch = make_batch(world, WORLDS, 2, 0, FE_SIMD_AUTO);
    static float forces[WORLDS][6];
    int32_t results[WORLDS];
    forces[3][0] = NAN, forces[7][4] = INFINITY, forces[7][1] = 1.0f, forces[8][1] = 500.0f;
    fe_array input = array_of(&ball, 1, FE_FIELD_FORCE, 6, forces);
    OK(fe_batch_bind(batch, &input, 1, NULL, 0));
    FE_TRUE(fe_batch_step(batch, DT, 3, NULL, results) == 2);
    FE_TRUE(strstr(fe_last_error(), "world 3, array 0, item 0") != NULL);
    for (int32_t w = 0; w < WORLDS; ++w) FE_TRUE(results[w] == (w == 3 || w == 7 ? FE_ERROR_ARGUMENT : FE_OK));
    FE_TRUE(hash_of(world_of(batch, 3)) == hash_of(world) && hash_of(world_of(batch, 7)) == hash_of(world));
    for (int32_t i = 0; i < 3; ++i) step(world);
    FE_TRUE(hash_of(world_of(batch, 0)) == hash_of(world) && hash_of(world_of(batch, 8)) != hash_of(world));
    OK(fe_batch_destroy(batch));
    destroy(world);
}

// A target is what a definition may have: a hinge turns by no more than pi, a distance is not negative
static void a_target_has_the_range_of_the_definition(void **state)
{
    (void)state;
    arm a = make_arm(100.0f);
    fe_batch *batch = make_batch(a.world, WORLDS, 1, 0, FE_SIMD_AUTO);
    static float targets[WORLDS];
    static const float most[JOINTS] = {3.1415926f, 1e6f, 1e6f}, beyond[JOINTS] = {3.2f, 1.1e6f, -0.1f};
    for (int32_t k = 0; k < JOINTS; ++k) {
        const fe_array x = array_of(a.joints + k, 1, FE_FIELD_JOINT_TARGET, 1, targets);
        targets[3] = most[k];
        FE_TRUE(fe_batch_write(batch, &x, NULL, NULL) == 0);
        targets[3] = beyond[k];
        FE_TRUE(fe_batch_write(batch, &x, NULL, NULL) == 1);
        targets[3] = 0.0f;
    }
    OK(fe_batch_destroy(batch));
    destroy(a.world);
}

static void a_row_of_what_is_gone_is_zero(void **state)
{
    (void)state;
    fe_body ball;
    fe_world *world = ball_world(&ball);
    fe_batch *batch = make_batch(world, WORLDS, 1, 0, FE_SIMD_AUTO);
    static float poses[WORLDS][7];
    int32_t results[WORLDS];
    fe_array output = array_of(&ball, 1, FE_FIELD_TRANSFORM, 7, poses);
    OK(fe_batch_bind(batch, NULL, 0, &output, 1));
    OK(fe_body_destroy(world_of(batch, 2), ball));
    memset(poses, 0x55, sizeof poses);
    FE_TRUE(fe_batch_step(batch, DT, 1, NULL, results) == 1 && results[2] == FE_ERROR_STALE && results[1] == FE_OK);
    for (int32_t k = 0; k < 7; ++k) FE_TRUE(poses[2][k] == 0.0f);
    FE_TRUE(poses[1][1] > 1.0f);
    FE_TRUE(fe_batch_reset(batch, NULL, NULL, NULL) == 0 && fe_batch_step(batch, DT, 1, NULL, results) == 0);
    OK(fe_batch_destroy(batch));
    destroy(world);
}

// An item that is gone from any one world, the first too, is a fault of that world's
static void no_world_speaks_for_the_others(void **state)
{
    (void)state;
    fe_body ball;
    fe_world *world = ball_world(&ball);
    for (int32_t gone = 0; gone < 3; ++gone) {
        fe_batch *batch = make_batch(world, 3, 1, 0, FE_SIMD_AUTO);
        static float poses[3][7];
        int32_t results[3];
        fe_array pose = array_of(&ball, 1, FE_FIELD_TRANSFORM, 7, poses), seen = pose;
        pose.bytes = seen.bytes = sizeof poses, seen.relative_to = ball;
        FE_TRUE(fe_batch_read(batch, &pose, NULL) == 0);
        OK(fe_body_destroy(world_of(batch, gone), ball));
        FE_TRUE(fe_batch_read(batch, &seen, results) == 1 && results[gone] == FE_ERROR_STALE);
        for (int32_t w = 0; w < 3; ++w) poses[w][1] = 5.0f, poses[w][6] = 1.0f;
        FE_TRUE(fe_batch_write(batch, &pose, NULL, results) == 1 && results[gone] == FE_ERROR_STALE);
        FE_TRUE(fe_batch_read(batch, &pose, results) == 1 && results[gone] == FE_ERROR_STALE);
        for (int32_t w = 0; w < 3; ++w) FE_TRUE(poses[w][1] == (w == gone ? 0.0f : 5.0f));
        OK(fe_batch_bind(batch, &pose, 1, &seen, 1));
        FE_TRUE(fe_batch_step(batch, DT, 1, NULL, results) == 1 && results[gone] == FE_ERROR_STALE);
        for (int32_t w = 0; w < 3; ++w)
            if (w != gone) OK(fe_body_destroy(world_of(batch, w), ball));
        FE_TRUE(fe_batch_read(batch, &pose, NULL) == FE_ERROR_STALE &&
                fe_batch_write(batch, &pose, NULL, NULL) == FE_ERROR_STALE &&
                fe_batch_read(batch, &seen, NULL) == FE_ERROR_STALE &&
                fe_batch_bind(batch, &pose, 1, NULL, 0) == FE_ERROR_STALE);
        OK(fe_batch_destroy(batch));
    }
    destroy(world);
}

// A joint that breaks in one of many steps takes no force in the next: its world stands there
static void a_joint_that_breaks_ends_its_force(void **state)
{
    (void)state;
    arm a = make_arm(0.0f);
    fe_joint joint = a.joints[0];
    fe_hinge_joint_def def;
    fe_hinge_joint_def_init(&def, sizeof def);
    OK(fe_hinge_joint_get(a.world, joint, &def));
    def.break_force = 50.0f; // N: the links swing, and pull at it
    OK(fe_hinge_joint_set(a.world, joint, &def));
    fe_batch *batch = make_batch(a.world, 2, 1, 0, FE_SIMD_AUTO), *one = make_batch(a.world, 1, 1, 0, FE_SIMD_AUTO);
    static float torques[2] = {20.0f, 0.0f};
    int32_t results[2], steps = 0;
    fe_array input = array_of(&joint, 1, FE_FIELD_JOINT_FORCE, 1, torques);
    input.bytes = sizeof torques;
    OK(fe_batch_bind(batch, &input, 1, NULL, 0));
    FE_TRUE(fe_batch_step(batch, DT, 100, NULL, results) == 1);
    FE_TRUE(results[0] == FE_ERROR_STALE && results[1] == FE_OK);
    FE_TRUE(strstr(fe_last_error(), "world 0, array 0, item 0: an item that is gone") != NULL);
    // the same, one step a call
    input.bytes = sizeof *torques;
    OK(fe_batch_bind(one, &input, 1, NULL, 0));
    for (; steps < 100 && fe_joint_is_valid(world_of(one, 0), joint); ++steps)
        FE_TRUE(fe_batch_step(one, DT, 1, NULL, NULL) == 0);
    FE_TRUE(steps > 1 && steps < 100 && hash_of(world_of(one, 0)) == hash_of(world_of(batch, 0)));
    OK(fe_batch_destroy(one));
    OK(fe_batch_destroy(batch));
    destroy(a.world);
}

// ---- filters -------------------------------------------------------------------------------------------------------
static _Thread_local int32_t is_caller;

typedef struct journal {
    int32_t worlds[64]; // that asked, in order
    int32_t count, strangers;
} journal;

typedef struct judge {
    journal *journal;
    int32_t world;
} judge;

static int32_t refuse_all(void *user, const fe_filter_pair *pair)
{
    const judge *j = user;
    (void)pair;
    j->journal->strangers += !is_caller;
    FE_TRUE(j->journal->count < 64);
    j->journal->worlds[j->journal->count++] = j->world;
    return 0;
}

// Their answers may depend on what was asked before: the order is the same for any workers.
static void filters_are_asked_by_the_caller_in_the_order_of_worlds(void **state)
{
    (void)state;
    fe_body ball;
    fe_world *source = ball_world(&ball);
    fe_shape shape;
    FE_TRUE(fe_body_get_shapes(source, ball, &shape, 1) == 1);
    OK(fe_shape_set_pair_filter(source, shape, 1));
    is_caller = 1;
    for (int32_t workers = 1; workers <= 8; workers *= 2) {
        fe_batch *batch = make_batch(source, WORLDS, workers, 1, FE_SIMD_AUTO);
        journal asked = {{0}, 0, 0};
        judge judges[WORLDS];
        for (int32_t i = 0; i < WORLDS; i += 2) { // the others have none
            judges[i] = (judge){&asked, i};
            OK(fe_world_set_pair_filter(world_of(batch, i), refuse_all, judges + i));
        }
        FE_TRUE(fe_batch_step(batch, DT, 60, NULL, NULL) == 0);
        FE_TRUE(asked.strangers == 0 && asked.count == (WORLDS + 1) / 2);
        for (int32_t i = 0; i < asked.count; ++i) FE_TRUE(asked.worlds[i] == 2 * i);
        for (int32_t i = 0; i < WORLDS; ++i) {
            fe_transform at;
            OK(fe_body_get_transform(world_of(batch, i), ball, &at));
            FE_TRUE((at.position.y < 0.0) == (i % 2 == 0)); // it falls through the ground where the filter refuses
        }
        OK(fe_batch_destroy(batch));
    }
    destroy(source);
}

static void sets_states_of_single_worlds(void **state)
{
    (void)state;
    fe_body ball;
    fe_world *world = ball_world(&ball), *stranger = make_world(NULL, NULL);
    fe_batch *batch = make_batch(world, WORLDS, 2, 0, FE_SIMD_AUTO);
    fe_state *high, *foreign;
    const fe_state *states[WORLDS] = {NULL};
    int32_t results[WORLDS];
    fe_transform t = fe_make_transform(0.0, 9.0, 0.0), at;
    OK(fe_body_set_transform(world, ball, &t));
    OK(fe_state_create(world, NULL, &high));
    OK(fe_state_create(stranger, NULL, &foreign));
    states[4] = states[5] = high;
    FE_TRUE(fe_batch_step(batch, DT, 5, NULL, NULL) == 0);
    FE_TRUE(fe_batch_reset(batch, NULL, states, results) == 0);
    for (int32_t w = 0; w < WORLDS; ++w) {
        OK(fe_body_get_transform(world_of(batch, w), ball, &at));
        FE_TRUE(results[w] == FE_OK && at.position.y == (w == 4 || w == 5 ? 9.0 : 2.0));
    }
    states[8] = foreign;
    FE_TRUE(fe_batch_reset(batch, NULL, states, results) == FE_ERROR_STATE);
    OK(fe_state_destroy(foreign));
    FE_TRUE(fe_batch_reset(batch, NULL, states, results) == FE_ERROR_STALE);
    uint8_t mask[WORLDS] = {0};
    mask[4] = 1; // what is not asked for is not looked at
    FE_TRUE(fe_batch_reset(batch, mask, states, results) == 0);
    OK(fe_state_destroy(high));
    OK(fe_batch_destroy(batch));
    destroy(world), destroy(stranger);
}

// Each allocation of a batch's steps fails in turn: worlds fail alone, each after a whole step, and go on later
static void allocations_fail_one_by_one(void **state)
{
    (void)state;
    static play p;
    enum { STEPS = 4 };
    fe_world *world = play_world(&script_brief, 40, &p);
    uint64_t hash[STEPS + 1];
    fe_world *alone;
    OK(fe_world_clone(world, NULL, &alone));
    for (int32_t i = 0; i <= STEPS; ++i, step(alone)) hash[i] = hash_of(alone);
    destroy(alone);
    int64_t failures = 1;
    for (int64_t k = 1; failures > 0; k += 3) {
        counting c = {0};
        fe_allocator allocator = counting_allocator(&c);
        fe_batch_def def;
        fe_batch *batch = NULL;
        fe_batch_def_init(&def, sizeof def);
        def.world_count = 3, def.allocator = &allocator;
        c.fail_from = k, c.fail_count = 1;
        if (fe_batch_create(world, &def, &batch) != FE_OK) {
            FE_TRUE(c.failures == 1 && c.blocks == 0);
            continue;
        }
        int32_t results[3], made[3] = {0}, lost = 0;
        for (int32_t i = 0; i < STEPS + 1; ++i) {
            (void)fe_batch_step(batch, DT, 1, NULL, results);
            for (int32_t w = 0; w < 3; ++w) {
                FE_TRUE(results[w] == FE_OK || results[w] == FE_ERROR_MEMORY);
                made[w] += results[w] == FE_OK, lost += results[w] != FE_OK;
                if (made[w] <= STEPS) FE_TRUE(hash_of(world_of(batch, w)) == hash[made[w]]);
            }
        }
        // without memory for what they share, they are solved one by one
        FE_TRUE(lost <= c.failures);
        failures = c.failures;
        OK(fe_batch_destroy(batch));
        FE_TRUE(c.blocks == 0 && c.wrong == 0);
    }
    destroy(world);
}

// A step that fails takes its force back: the next call gives it again, and it counts once
static void a_force_counts_once(void **state)
{
    (void)state;
    enum { STEPS = 6 };
    static float forces[2][6] = {{3.0f, 200.0f, 0.0f, 0.0f, 5.0f, 0.0f}, {3.0f, 200.0f, 0.0f, 0.0f, 5.0f, 0.0f}};
    const fe_vec3 force = {3.0f, 200.0f, 0.0f}, torque = {0.0f, 5.0f, 0.0f}, own = {0.0f, 0.0f, 7.0f};
    fe_body ball;
    fe_world *world = ball_world(&ball), *alone;
    OK(fe_body_add_force(world, ball, &own)); // the caller's, from before: it stays, for one step
    uint64_t hash[STEPS + 1];
    OK(fe_world_clone(world, NULL, &alone));
    for (int32_t i = 0; i <= STEPS; ++i, step(alone)) {
        hash[i] = hash_of(alone);
        OK(fe_body_add_force(alone, ball, &force));
        OK(fe_body_add_torque(alone, ball, &torque));
    }
    destroy(alone);
    int64_t failures = 1;
    int32_t failed_steps = 0;
    for (int64_t k = 1; failures > 0; ++k) {
        counting c = {0};
        fe_allocator allocator = counting_allocator(&c);
        fe_batch_def def;
        fe_batch *batch = NULL;
        fe_batch_def_init(&def, sizeof def);
        def.world_count = 2, def.allocator = &allocator;
        OK(fe_batch_create(world, &def, &batch));
        fe_array input = array_of(&ball, 1, FE_FIELD_FORCE, 6, forces);
        input.bytes = sizeof forces;
        OK(fe_batch_bind(batch, &input, 1, NULL, 0));
        c.fail_from = c.calls + k, c.fail_count = 1;
        int32_t results[2], made[2] = {0};
        for (int32_t i = 0; i < STEPS; ++i) {
            failed_steps += fe_batch_step(batch, DT, 1, NULL, results);
            for (int32_t w = 0; w < 2; ++w) {
                made[w] += results[w] == FE_OK;
                FE_TRUE(hash_of(world_of(batch, w)) == hash[made[w]]);
            }
        }
        failures = c.failures;
        OK(fe_batch_destroy(batch));
        FE_TRUE(c.blocks == 0 && c.wrong == 0);
    }
    FE_TRUE(failed_steps > 0);
    destroy(world);
}

// A reset without memory says that, and not that an array was at fault
static void a_reset_that_fails_is_told(void **state)
{
    (void)state;
    fe_body ball;
    fe_world *world = ball_world(&ball);
    counting c = {0};
    fe_allocator allocator = counting_allocator(&c);
    fe_batch_def def;
    fe_batch *batch = NULL;
    fe_state *crowded;
    fe_geometry form;
    fe_geometry_sphere(&form, 0.5f);
    fe_batch_def_init(&def, sizeof def);
    def.world_count = 3, def.allocator = &allocator;
    OK(fe_batch_create(world, &def, &batch));
    for (int32_t i = 0; i < 200; ++i) add(world, FE_BODY_DYNAMIC, 4.0 + i, &form);
    OK(fe_state_create(world, NULL, &crowded));
    const fe_state *states[3] = {NULL, crowded, NULL};
    int32_t results[3];
    c.fail_from = c.calls + 1, c.fail_count = 1;
    FE_TRUE(fe_batch_reset(batch, NULL, states, results) == 1);
    FE_TRUE(results[0] == FE_OK && results[1] == FE_ERROR_MEMORY && results[2] == FE_OK);
    FE_TRUE(strstr(fe_last_error(), "world 1 stays as it was: no memory") != NULL);
    FE_TRUE(hash_of(world_of(batch, 1)) == hash_of(world_of(batch, 0)));
    FE_TRUE(fe_batch_reset(batch, NULL, states, NULL) == 0 && hash_of(world_of(batch, 1)) == hash_of(world));
    OK(fe_state_destroy(crowded));
    OK(fe_batch_destroy(batch));
    destroy(world);
}

static void memory_is_level(void **state)
{
    (void)state;
    static play p;
    counting c = {0};
    fe_allocator allocator = counting_allocator(&c);
    fe_world *world = play_world(&script_brief, 60, &p);
    fe_batch *batch = NULL;
    fe_batch_def def;
    fe_batch_def_init(&def, sizeof def);
    def.world_count = 2, def.allocator = &allocator;
    OK(fe_batch_create(world, &def, &batch));
    for (int32_t i = 0; i < 20; ++i) {
        FE_TRUE(fe_batch_step(batch, DT, 3, NULL, NULL) == 0 && fe_batch_reset(batch, NULL, NULL, NULL) == 0);
    }
    int64_t bytes = c.bytes;
    for (int32_t i = 0; i < 200 + 1000 * whole; ++i) {
        FE_TRUE(fe_batch_step(batch, DT, whole ? 1 : 3, NULL, NULL) == 0 &&
                fe_batch_reset(batch, NULL, NULL, NULL) == 0);
        fe_state *taken;
        OK(fe_state_create(world_of(batch, 1), &allocator, &taken));
        OK(fe_state_destroy(taken));
    }
    FE_TRUE(c.bytes == bytes);
    OK(fe_batch_destroy(batch));
    FE_TRUE(c.blocks == 0);
    destroy(world);
}

// ---- arguments ----------------------------------------------------------------------------------------------------
static void clones_and_states_are_checked(void **state)
{
    (void)state;
    fe_body ball;
    fe_world *world = ball_world(&ball), *other = make_world(NULL, NULL), *clone = NULL;
    fe_state *taken = NULL;
    fe_world_def def;
    fe_store *store;
    FE_TRUE(fe_world_clone(NULL, NULL, &clone) == FE_ERROR_ARGUMENT &&
            fe_world_clone(world, NULL, NULL) == FE_ERROR_ARGUMENT);
    fe_world_def_init(&def, sizeof def);
    def.worker_count = 65;
    FE_TRUE(fe_world_clone(world, &def, &clone) == FE_ERROR_ARGUMENT);
    OK(fe_world_get_store(other, &store));
    def.worker_count = 1, def.store = store;
    FE_TRUE(fe_world_clone(world, &def, &clone) == FE_ERROR_ARGUMENT && clone == NULL);
    OK(fe_world_get_store(world, &store));
    def.store = store;
    uint64_t data = 0;
    OK(fe_world_set_user_data(world, 77));
    OK(fe_world_clone(world, &def, &clone));
    OK(fe_world_get_user_data(clone, &data));
    FE_TRUE(data == 77);
    FE_TRUE(fe_store_destroy(store) == FE_ERROR_STATE);
    FE_TRUE(fe_state_create(NULL, NULL, &taken) == FE_ERROR_ARGUMENT &&
            fe_state_create(world, NULL, NULL) == FE_ERROR_ARGUMENT);
    OK(fe_state_create(world, NULL, &taken));
    FE_TRUE(fe_world_set_state(NULL, taken) == FE_ERROR_ARGUMENT &&
            fe_world_set_state(world, NULL) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_world_set_state(other, taken) == FE_ERROR_STATE);
    OK(fe_world_set_state(clone, taken));
    OK(fe_state_destroy(taken));
    FE_TRUE(fe_state_destroy(taken) == FE_ERROR_STALE && fe_world_set_state(world, taken) == FE_ERROR_STALE);
    FE_TRUE(fe_state_destroy(NULL) == FE_ERROR_ARGUMENT);
    destroy(clone), destroy(other), destroy(world);
}

static void batches_are_checked(void **state)
{
    (void)state;
    fe_body ball;
    fe_world *world = ball_world(&ball), *one;
    fe_batch *batch = NULL;
    fe_batch_def def;
    fe_recorder *recorder;
    fe_batch_def_init(&def, sizeof def);
    FE_TRUE(fe_batch_create(NULL, &def, &batch) == FE_ERROR_ARGUMENT &&
            fe_batch_create(world, &def, NULL) == FE_ERROR_ARGUMENT);
    def.world_count = 0;
    FE_TRUE(fe_batch_create(world, &def, &batch) == FE_ERROR_ARGUMENT);
    def.world_count = 2, def.worker_count = 65;
    FE_TRUE(fe_batch_create(world, &def, &batch) == FE_ERROR_ARGUMENT);
    def.worker_count = 1, def.block = -1;
    FE_TRUE(fe_batch_create(world, &def, &batch) == FE_ERROR_ARGUMENT);
    def.block = 0, def.simd = 99;
    FE_TRUE(fe_batch_create(world, &def, &batch) == FE_ERROR_ARGUMENT && batch == NULL);
    def.simd = FE_SIMD_AUTO;
    OK(fe_batch_create(world, NULL, &batch)); // one world
    OK(fe_batch_destroy(batch));
    OK(fe_batch_create(world, &def, &batch));
    FE_TRUE(fe_batch_get_world(batch, 2, &one) == FE_ERROR_ARGUMENT &&
            fe_batch_get_world(batch, -1, &one) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_batch_get_world(batch, 0, NULL) == FE_ERROR_ARGUMENT);
    OK(fe_batch_get_world(batch, 1, &one));
    FE_TRUE(fe_world_destroy(one) == FE_ERROR_STATE && fe_recorder_create(one, NULL, &recorder) == FE_ERROR_STATE);
    FE_TRUE(fe_batch_step(batch, NAN, 1, NULL, NULL) == FE_ERROR_ARGUMENT &&
            fe_batch_step(batch, 2.0f, 1, NULL, NULL) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_batch_step(batch, DT, 0, NULL, NULL) == FE_ERROR_ARGUMENT &&
            fe_batch_step(batch, DT, 1001, NULL, NULL) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_batch_hash(batch, NULL) == FE_ERROR_ARGUMENT);
    OK(fe_batch_destroy(batch));
    uint32_t words[4];
    FE_TRUE(fe_batch_destroy(batch) == FE_ERROR_STALE && fe_batch_step(batch, DT, 1, NULL, NULL) == FE_ERROR_STALE);
    FE_TRUE(fe_batch_reset(batch, NULL, NULL, NULL) == FE_ERROR_STALE && fe_batch_hash(batch, words) == FE_ERROR_STALE);
    FE_TRUE(fe_batch_get_world(batch, 0, &one) == FE_ERROR_STALE &&
            fe_batch_bind(batch, NULL, 0, NULL, 0) == FE_ERROR_STALE);
    FE_TRUE(fe_batch_step(NULL, DT, 1, NULL, NULL) == FE_ERROR_ARGUMENT && fe_batch_destroy(NULL) == FE_ERROR_ARGUMENT);
    destroy(world);
}

static void arrays_are_checked(void **state)
{
    (void)state;
    arm a = make_arm(100.0f);
    fe_batch *batch = make_batch(a.world, WORLDS, 1, 0, FE_SIMD_AUTO);
    static float data[WORLDS][7];
    fe_array right = array_of(a.bodies, 1, FE_FIELD_TRANSFORM, 7, data), x;
    FE_TRUE(fe_batch_read(batch, &right, NULL) == 0 && fe_batch_read(batch, NULL, NULL) == FE_ERROR_ARGUMENT);
#define REFUSED(change, result)                                    \
    do {                                                           \
        x = right;                                                 \
        change;                                                    \
        FE_TRUE(fe_batch_read(batch, &x, NULL) == (result));       \
        FE_TRUE(fe_batch_bind(batch, NULL, 0, &x, 1) == (result)); \
    } while (0)
    REFUSED(x.bytes -= 4, FE_ERROR_ARGUMENT);
    REFUSED(x.item_count = 0, FE_ERROR_ARGUMENT);
    REFUSED(x.item_count = 2, FE_ERROR_ARGUMENT);
    REFUSED(x.is_double = 1, FE_ERROR_ARGUMENT);
    REFUSED(x.is_double = 2, FE_ERROR_ARGUMENT);
    REFUSED(x.data = NULL, FE_ERROR_ARGUMENT);
    REFUSED(x.items = NULL, FE_ERROR_ARGUMENT);
    REFUSED(x.items = a.joints, FE_ERROR_KIND);
    REFUSED(x.field = FE_FIELD_NONE, FE_ERROR_ARGUMENT);
    REFUSED(x.field = 99, FE_ERROR_ARGUMENT);
    REFUSED(x.field = FE_FIELD_FORCE, FE_ERROR_ARGUMENT);   // is not read
    REFUSED(x.field = FE_FIELD_GRAVITY, FE_ERROR_ARGUMENT); // has no items
    REFUSED(x.relative_to = a.joints[0], FE_ERROR_KIND);
    REFUSED(x.origin.y = NAN, FE_ERROR_ARGUMENT);
    REFUSED(x.struct_size = 3, FE_ERROR_ARGUMENT);
    x = right, x.relative_to = a.bodies[1]; // what is written has no frame
    FE_TRUE(fe_batch_write(batch, &x, NULL, NULL) == FE_ERROR_ARGUMENT);
    x = right, x.field = FE_FIELD_AWAKE, x.bytes /= 7; // is not written
    FE_TRUE(fe_batch_write(batch, &x, NULL, NULL) == FE_ERROR_ARGUMENT);
    x.field = FE_FIELD_JOINT_TARGET, x.items = &a.joints[2]; // a distance has a target, a body has none
    FE_TRUE(fe_batch_write(batch, &x, NULL, NULL) == 0);
    OK(fe_batch_destroy(batch));
    destroy(a.world);
}

int main(int argc, char **argv)
{
    if (argc > 1) whole = atoi(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(brief_is_cloned),
        cmocka_unit_test(crowd_is_cloned),
        cmocka_unit_test(mixed_is_cloned),
        cmocka_unit_test(terrain_is_cloned),
        cmocka_unit_test(fast_is_cloned),
        cmocka_unit_test(joints_is_cloned),
        cmocka_unit_test(meshes_is_cloned),
        cmocka_unit_test(compounds_is_cloned),
        cmocka_unit_test(a_batch_is_a_loop),
        cmocka_unit_test(a_batch_is_a_loop_at_random_moments),
        cmocka_unit_test(worlds_share_a_pool_and_go_their_own_ways),
        cmocka_unit_test(fields_are_what_the_getters_say),
        cmocka_unit_test(fields_are_read_in_a_body_s_frame),
        cmocka_unit_test(inputs_are_the_calls_that_they_stand_for),
        cmocka_unit_test(a_joint_s_force_turns_and_pulls),
        cmocka_unit_test(what_is_written_is_read),
        cmocka_unit_test(contacts_bear_what_weighs),
        cmocka_unit_test(masses_and_frictions_are_those_of_the_calls),
        cmocka_unit_test(a_bad_row_fails_its_world),
        cmocka_unit_test(a_target_has_the_range_of_the_definition),
        cmocka_unit_test(a_row_of_what_is_gone_is_zero),
        cmocka_unit_test(no_world_speaks_for_the_others),
        cmocka_unit_test(a_joint_that_breaks_ends_its_force),
        cmocka_unit_test(filters_are_asked_by_the_caller_in_the_order_of_worlds),
        cmocka_unit_test(sets_states_of_single_worlds),
        cmocka_unit_test(allocations_fail_one_by_one),
        cmocka_unit_test(a_force_counts_once),
        cmocka_unit_test(a_reset_that_fails_is_told),
        cmocka_unit_test(memory_is_level),
        cmocka_unit_test(clones_and_states_are_checked),
        cmocka_unit_test(batches_are_checked),
        cmocka_unit_test(arrays_are_checked),
    };
    return cmocka_run_group_tests_name("batch", tests, NULL, NULL);
}
