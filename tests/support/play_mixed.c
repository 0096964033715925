// play_mixed.c - 300 bodies of all forms fall on flat ground in heaps, come to rest and sleep: many small islands. And
// a brief script, in which two dozen bodies meet with every kind of call: for tests that play it hundreds of times.
#include "support/any_joint.h"
#include "support/play.h"

enum { HEAPS = 20, HEAP_BODIES = 15 };

static part any_part(play *p, int32_t i, double x, double y, double z)
{
    float a = play_between(p, 0.15f, 0.4f), b = play_between(p, 0.15f, 0.4f), c = play_between(p, 0.15f, 0.4f);
    part made = i % 3 == 0   ? part_box(a, b, c, x, y, z)
                : i % 3 == 1 ? part_sphere(a, x, y, z)
                             : part_capsule(b, a, x, y, z);
    made.body.transform.rotation.x = play_between(p, -1.0f, 1.0f);
    made.body.transform.rotation.y = play_between(p, -1.0f, 1.0f);
    made.shape.material.rolling_resistance = 0.2f; // or spheres would never stop
    made.shape.material.spinning_resistance = 0.02f;
    if (i % 13 == 0) made.shape.events = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_HIT;
    return made;
}

static void build_mixed(play *p)
{
    part ground = part_static_box(60.0f, 1.0f, 60.0f, 0.0, -1.0, 0.0);
    play_add(p, &ground);
    for (int32_t i = 0; i < HEAPS * HEAP_BODIES; ++i) {
        int32_t heap = i / HEAP_BODIES, level = i % HEAP_BODIES;
        double x = 5.0 * (heap % 5 - 2) + (double)play_between(p, -0.3f, 0.3f);
        double z = 5.0 * (heap / 5.0 - 2.0) + (double)play_between(p, -0.3f, 0.3f);
        part a = any_part(p, i, x, 0.6 + 0.7 * level, z);
        play_add(p, &a);
    }
}

static void act_mixed(play *p) { (void)p; }

const script script_mixed = {"mixed", 600, build_mixed, act_mixed};

// ---- the brief one -------------------------------------------------------------------------------------------------

enum { BRIEF_BODIES = 18, ROOF = 1, TRIGGER = 2, FIRST = 3 };

static void build_brief(play *p)
{
    part ground = part_plane(0.0f, 1.0f, 0.0f), roof = part_box(1.0f, 0.1f, 1.0f, 0.0, 2.5, 0.0);
    part trigger = part_static_box(0.5f, 0.5f, 0.5f, 0.0, 0.5, 0.0);
    roof.body.type = FE_BODY_KINEMATIC;
    trigger.shape.trigger = 1;
    play_add(p, &ground);
    play_add(p, &roof);
    play_add(p, &trigger);
    for (int32_t i = 0; i < BRIEF_BODIES; ++i) {
        part a = any_part(p, i, 0.5 * (i % 3 - 1), 0.6 + 0.5 * (i / 3), 0.1 * (i % 4));
        a.shape.events = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_STAY | FE_SHAPE_EVENTS_HIT;
        play_add(p, &a);
    }
}

// a hill under where the crowd comes, while bodies stand there
static void bring_hill(play *p)
{
    enum { SAMPLES = 6 };
    float heights[SAMPLES * SAMPLES];
    uint8_t holes[(SAMPLES - 1) * (SAMPLES - 1)] = {0};
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i) heights[i] = 0.05f * (float)(i % 5);
    holes[7] = 1;
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = SAMPLES, def.cell_x = 2.0f, def.heights = heights, def.holes = holes;
    fe_asset hill = 0;
    PLAY(p, fe_heightfield_create(world_store(p->world), &def, &hill));
    part ground = part_static_box(1.0f, 1.0f, 1.0f, 2.0, 0.0, -2.0);
    fe_geometry_heightfield(&ground.geometry, hill);
    play_put(p, 200, &ground);
    PLAY(p, fe_asset_destroy(world_store(p->world), hill)); // lives with its shape
}

// sixteen at once, then gone at once
static void bring_crowd(play *p)
{
    enum { CROWD = 16 };
    fe_body_def defs[CROWD];
    fe_body *crowd = p->actors + 100, extra = 0;
    fe_geometry ball;
    fe_geometry_sphere(&ball, 0.3f);
    for (int32_t i = 0; i < CROWD; ++i) {
        fe_body_def_init(defs + i, sizeof defs[i]);
        defs[i].transform = fe_make_transform(3.0 + 0.5 * i, 0.4, 0.0);
    }
    if (p->step == 50) {
        PLAY(p, fe_body_create_many(p->world, defs, sizeof *defs, CROWD, crowd));
        for (int32_t i = 0; i < CROWD; ++i)
            PLAY(p, fe_shape_create(p->world, crowd[i], NULL, &ball, p->shapes + 100 + i));
        for (int32_t i = 0; i < CROWD; ++i) PLAY(p, fe_shape_create(p->world, crowd[0], NULL, &ball, &extra));
    }
    if (p->step == 52) bring_hill(p);
    if (p->step == 70) PLAY(p, fe_body_destroy_many(p->world, crowd, CROWD));
    if (p->step == 80) PLAY(p, fe_body_create_many(p->world, defs, sizeof *defs, CROWD, crowd));
}

// a joint of each type between neighbours, one of them too weak for its load; changed, switched, destroyed, and gone
// with their bodies
static void bring_joints(play *p)
{
    const fe_body *actor = p->actors + FIRST;
    any_def d[ANY_KINDS];
    for (int32_t kind = 0; kind < ANY_KINDS; ++kind) any_init(kind, &d[kind]);
    fe_distance_joint_def *distance = &d[ANY_DISTANCE].distance;
    fe_ball_joint_def *ball = &d[ANY_BALL].ball;
    fe_hinge_joint_def *hinge = &d[ANY_HINGE].hinge;
    fe_fixed_joint_def *fixed = &d[ANY_FIXED].fixed;
    fe_configurable_joint_def *six = &d[ANY_CONFIGURABLE].configurable;
    distance->body_a = p->actors[ROOF], distance->body_b = actor[0], distance->lower = 0, distance->upper = 3;
    ball->body_a = p->actors[ROOF], ball->body_b = actor[1], ball->break_force = 10; // N
    hinge->body_a = actor[6], hinge->body_b = actor[7], hinge->limit_enabled = 1;
    fixed->body_a = actor[7], fixed->body_b = actor[8], fixed->hertz = 2;
    six->body_a = actor[8], six->body_b = actor[17], six->axes[FE_DOF_LINEAR_Y].motion = FE_MOTION_FREE;
    six->axes[FE_DOF_ANGULAR_X].motion = FE_MOTION_LIMITED;
    for (int32_t kind = 0; kind < ANY_KINDS; ++kind) PLAY(p, any_create(kind, p->world, &d[kind], &p->joints[kind]));
}

static void change_joints(play *p)
{
    fe_world *w = p->world;
    fe_hinge_joint_def hinge = {.struct_size = sizeof hinge};
    fe_joint_def front = {.struct_size = sizeof front};
    if (p->step == 25) bring_joints(p);
    if (p->step == 33) {
        PLAY(p, fe_hinge_joint_get(w, p->joints[2], &hinge));
        hinge.motor_max = 1, hinge.motor_speed = 1;
        PLAY(p, fe_hinge_joint_set(w, p->joints[2], &hinge));
        PLAY(p, fe_joint_get(w, p->joints[3], &front));
        front.collide_connected = 1;
        PLAY(p, fe_joint_set(w, p->joints[3], &front));
        PLAY(p, fe_joint_set_enabled(w, p->joints[4], 0));
    }
    if (p->step == 43) PLAY(p, fe_joint_set_enabled(w, p->joints[4], 1));
    if (p->step == 48) PLAY(p, fe_joint_destroy(w, p->joints[3]));
}

static void act_brief(play *p)
{
    fe_world *w = p->world;
    const fe_body *actor = p->actors + FIRST;
    const part ball = part_sphere(0.3f, 0.0, 0.0, 0.0);
    fe_transform target = fe_make_transform(0.0, p->step % 40 < 20 ? 2.0 : 3.0, 0.0);
    if (p->step < 60) PLAY(p, fe_body_set_target(w, p->actors[ROOF], &target, 0.5f));
    if (p->step % 10 == 5 && p->step < 90) {
        int32_t i = FIRST + p->step / 10;
        play_remove(p, i);
        part a = any_part(p, p->step, 0.2, 4.0, 0.1);
        play_put(p, i, &a);
    }
    bring_crowd(p);
    change_joints(p);
    if (p->step == 20) PLAY(p, fe_body_set_type(w, actor[10], FE_BODY_STATIC));
    if (p->step == 30) PLAY(p, fe_body_set_type(w, actor[10], FE_BODY_DYNAMIC));
    if (p->step == 35) PLAY(p, fe_body_set_enabled(w, actor[11], 0));
    if (p->step == 45) PLAY(p, fe_body_set_enabled(w, actor[11], 1));
    if (p->step == 40) PLAY(p, fe_world_ignore_collision(w, actor[12], actor[13], 1));
    if (p->step == 55) PLAY(p, fe_world_ignore_collision(w, actor[12], actor[13], 0));
    if (p->step == 62) PLAY(p, fe_shape_set_geometry(w, p->shapes[FIRST + 14], &ball.geometry));
    if (p->step == 64) PLAY(p, fe_shape_set_trigger(w, p->shapes[FIRST + 15], 1));
    if (p->step == 66) PLAY(p, fe_shape_destroy(w, p->shapes[FIRST + 16]));
    if (p->step == 75) PLAY(p, fe_world_optimize(w));
    if (p->step == 150) play_remove(p, 200);
    if (p->step == 185) PLAY(p, fe_body_set_awake(w, actor[17], 1)); // after all have fallen asleep
}

const script script_brief = {"brief", 200, build_brief, act_brief};
