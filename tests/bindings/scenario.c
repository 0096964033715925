// The scene that every language plays: 300 bodies with joints on a heightfield, events, queries, 600 steps. All print
// the same two lines. Numbers are dyadic fractions, so that a language of doubles gives the library the same floats.
//   scenario [workers]
#include "feather.h"

#include <stdio.h>
#include <stdlib.h>

enum { BODIES = 300, STEPS = 600, SAMPLES = 17 };

typedef struct scene {
    fe_world *world;
    fe_store *store;
    fe_asset terrain;
    fe_body body[BODIES];
    int enter, leave, hit, sleep, wake, broken, rays, overlaps;
} scene;

static void check(int32_t result)
{
    if (result >= 0) return;
    fprintf(stderr, "%s\n", fe_last_error());
    exit(1);
}

static fe_dvec3 place(int i) { return fe_make_dvec3(i % 10 * 1.5 - 6.75, 2.0 + i / 60 * 1.5, i / 10 % 6 * 1.5 - 3.75); }

static void add_body(scene *s, int i)
{
    fe_body_def body;
    fe_shape_def shape;
    fe_geometry form;
    fe_shape made;
    fe_body_def_init(&body, sizeof body);
    fe_shape_def_init(&shape, sizeof shape);
    body.transform.position = place(i);
    shape.events = i % 5 == 0 ? FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_HIT : FE_SHAPE_EVENTS_TOUCH;
    if (i % 3 == 0) fe_geometry_sphere(&form, 0.5f);
    if (i % 3 == 1) fe_geometry_box(&form, 0.5f, 0.375f, 0.5f);
    if (i % 3 == 2) fe_geometry_capsule(&form, 0.25f, 0.375f);
    check(fe_body_create(s->world, &body, &s->body[i]));
    check(fe_shape_create(s->world, s->body[i], &shape, &form, &made));
}

static void add_terrain(scene *s)
{
    static float heights[SAMPLES * SAMPLES];
    for (int row = 0; row < SAMPLES; ++row)
        for (int column = 0; column < SAMPLES; ++column)
            heights[row * SAMPLES + column] = (float)((row * 7 + column * 3) % 5) * 0.125f;
    fe_heightfield_def field;
    fe_heightfield_def_init(&field, sizeof field);
    field.rows = field.columns = SAMPLES;
    field.cell_x = field.cell_z = 2.0f;
    field.heights = heights;
    check(fe_world_get_store(s->world, &s->store));
    check(fe_heightfield_create(s->store, &field, &s->terrain));

    fe_body_def still;
    fe_shape_def shape;
    fe_geometry form;
    fe_body ground;
    fe_shape made;
    fe_body_def_init(&still, sizeof still);
    fe_shape_def_init(&shape, sizeof shape);
    still.type = FE_BODY_STATIC;
    shape.frame.position = fe_make_vec3(-16, 0, -16);
    fe_geometry_heightfield(&form, s->terrain);
    check(fe_body_create(s->world, &still, &ground));
    check(fe_shape_create(s->world, ground, &shape, &form, &made));
}

/// A wall that moves through the heap.
static void add_sweeper(scene *s)
{
    fe_body_def body;
    fe_geometry form;
    fe_body sweeper;
    fe_shape made;
    fe_body_def_init(&body, sizeof body);
    body.type = FE_BODY_KINEMATIC;
    body.transform = fe_make_transform(-10, 1, 0);
    body.linear_velocity = fe_make_vec3(0.5f, 0, 0);
    fe_geometry_box(&form, 0.5f, 1, 4);
    check(fe_body_create(s->world, &body, &sweeper));
    check(fe_shape_create(s->world, sweeper, NULL, &form, &made));
}

/// Ties body i to its neighbour i + 1, in the middle between the two.
static void add_joint(scene *s, int i)
{
    fe_body a = s->body[i], b = s->body[i + 1];
    fe_dvec3 from = place(i), to = place(i + 1), middle = fe_make_dvec3(from.x + 0.75, from.y, from.z);
    fe_vec3 x = fe_make_vec3(1, 0, 0), z = fe_make_vec3(0, 0, 1);
    fe_joint made;
    if (i % 10 == 0) {
        fe_ball_joint_def ball;
        fe_ball_joint_def_init(&ball, sizeof ball);
        check(fe_ball_joint_def_at(s->world, &ball, a, b, &middle, &x));
        check(fe_ball_joint_create(s->world, &ball, &made));
    } else if (i % 10 == 4) {
        fe_hinge_joint_def hinge;
        fe_hinge_joint_def_init(&hinge, sizeof hinge);
        check(fe_hinge_joint_def_at(s->world, &hinge, a, b, &middle, &z));
        hinge.limit_enabled = 1, hinge.lower = -0.5f, hinge.upper = 0.5f;
        check(fe_hinge_joint_create(s->world, &hinge, &made));
    } else if (i % 10 == 7) {
        fe_distance_joint_def rod;
        fe_distance_joint_def_init(&rod, sizeof rod);
        check(fe_distance_joint_def_at(s->world, &rod, a, b, &from, &to));
        check(fe_distance_joint_create(s->world, &rod, &made));
    } else if (i % 10 == 2) {
        fe_fixed_joint_def fixed;
        fe_fixed_joint_def_init(&fixed, sizeof fixed);
        check(fe_fixed_joint_def_at(s->world, &fixed, a, b, &middle));
        fixed.break_force = 8192;
        check(fe_fixed_joint_create(s->world, &fixed, &made));
    }
}

/// What a player would do: shoot, lift, dig, remove.
static void act(scene *s, int step)
{
    if (step % 10 == 0) {
        fe_dvec3 origin = fe_make_dvec3(step / 10 % 16 - 7.5, 20, 0.25), down = fe_make_dvec3(0, -40, 0);
        fe_vec3 kick = fe_make_vec3(0, 512, 64);
        fe_hit hit;
        fe_geometry ball;
        fe_transform at = fe_make_transform(0, 1, 0);
        fe_geometry_sphere(&ball, 3);
        int32_t type = FE_BODY_STATIC, count;
        int32_t result = fe_world_raycast(s->world, &origin, &down, NULL, &hit);
        check(result);
        if (result == 1) check(fe_body_get_type(s->world, hit.body, &type));
        if (type == FE_BODY_DYNAMIC) {
            ++s->rays;
            check(fe_body_add_impulse_at(s->world, hit.body, &kick, &hit.point));
        }
        check(count = fe_world_overlap(s->world, &ball, &at, NULL, NULL, 0));
        s->overlaps += count;
    }
    if (step == 200) {
        static const float hill[9] = {1, 1, 1, 1, 2, 1, 1, 1, 1};
        check(fe_heightfield_set_heights(s->store, s->terrain, 7, 7, 3, 3, hill));
    }
    if (step == 400)
        for (int i = 60; i < 70; ++i) check(fe_body_destroy(s->world, s->body[i]));
}

/// Counts the events of a step.
static void listen(scene *s)
{
    static fe_pair_event pairs[4096];
    static fe_body_event bodies[4096];
    int32_t count;
    check(count = fe_world_get_pair_events(s->world, pairs, sizeof *pairs, 4096));
    for (int32_t i = 0; i < count && i < 4096; ++i) ++*(pairs[i].kind == FE_EVENT_ENTER ? &s->enter : &s->leave);
    check(count = fe_world_get_body_events(s->world, bodies, sizeof *bodies, 4096));
    for (int32_t i = 0; i < count && i < 4096; ++i) ++*(bodies[i].kind == FE_EVENT_SLEEP ? &s->sleep : &s->wake);
    check(count = fe_world_get_hit_events(s->world, NULL, 0, 0));
    s->hit += count;
    check(count = fe_world_get_joint_events(s->world, NULL, 0, 0));
    s->broken += count;
}

int main(int count, char **arguments)
{
    static scene s;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    if (count > 1) def.worker_count = atoi(arguments[1]);
    check(fe_world_create(&def, &s.world));
    add_terrain(&s);
    for (int i = 0; i < BODIES; ++i) add_body(&s, i);
    add_sweeper(&s);
    for (int i = 0; i + 1 < BODIES; ++i) add_joint(&s, i);
    for (int step = 0; step < STEPS; ++step) {
        act(&s, step);
        check(fe_world_step(s.world, (float)(1.0 / 60.0)));
        listen(&s);
    }
    uint32_t hash[2];
    check(fe_world_hash(s.world, hash));
    printf("hash %08x%08x\n", (unsigned)hash[1], (unsigned)hash[0]);
    printf("enter %d exit %d hit %d sleep %d wake %d break %d rays %d overlaps %d\n", s.enter, s.leave, s.hit, s.sleep,
           s.wake, s.broken, s.rays, s.overlaps);
    check(fe_world_destroy(s.world));
    return 0;
}
