// machines.c - what joints can do: the machines of machines.h at work, in numbers.
//
//     cc machines.c -lfeather -lm -o machines && ./machines
#include "machines.h"

#include <stdio.h>

#define DT (1.0f / 60.0f)

static fe_result run(fe_world *world, int steps)
{
    for (int i = 0; i < steps; ++i) MACHINE_TRY(fe_world_step(world, DT));
    return FE_OK;
}

static double x_of(const fe_world *world, fe_body body)
{
    fe_transform t;
    return fe_body_get_transform(world, body, &t) == FE_OK ? t.position.x : NAN;
}

static double y_of(const fe_world *world, fe_body body)
{
    fe_transform t;
    return fe_body_get_transform(world, body, &t) == FE_OK ? t.position.y : NAN;
}

static double degrees_of(const fe_world *world, fe_joint hinge)
{
    fe_joint_state s;
    s.struct_size = sizeof s;
    return fe_joint_get_state(world, hinge, &s) == FE_OK ? (double)(s.angle / MACHINE_DEGREE) : NAN;
}

static fe_result add_ground(fe_world *world)
{
    fe_geometry plane;
    fe_body ground;
    fe_geometry_plane(&plane, 0, 1, 0, 0);
    return machine_body(world, FE_BODY_STATIC, fe_make_transform(0, 0, 0), &plane, 0, &ground);
}

static fe_result show_ragdoll(fe_world *world)
{
    ragdoll r;
    float worst = 0;
    MACHINE_TRY(ragdoll_build(world, fe_make_transform(0, 2, 0), 5, &r));
    MACHINE_TRY(run(world, 240));
    for (int i = 1; i < RAGDOLL_BONES; ++i) {
        fe_joint_state s;
        s.struct_size = sizeof s;
        MACHINE_TRY(fe_joint_get_state(world, r.joints[i], &s));
        worst = fmaxf(worst, s.linear_error);
    }
    printf("ragdoll  lies at %.2f m, its worst joint is open by %.2f mm\n", y_of(world, r.bones[RAGDOLL_HEAD]),
           (double)worst * 1e3);
    return FE_OK;
}

// Waves of half a metre across the way, from x = 0 to 48, 0.1 m above the ground at the least
static fe_result add_hills(fe_world *world)
{
    enum { SAMPLES = 97 };
    static float heights[SAMPLES * SAMPLES];
    const float cell = 0.5f;
    fe_heightfield_def field;
    fe_store *store;
    fe_asset asset;
    fe_geometry form;
    fe_body body;
    for (int i = 0; i < SAMPLES * SAMPLES; ++i)
        heights[i] = 0.1f + 0.25f * (1 - cosf(0.5f * cell * (float)(i % SAMPLES)));
    fe_heightfield_def_init(&field, sizeof field);
    field.rows = field.columns = SAMPLES, field.cell_x = field.cell_z = cell, field.heights = heights;
    MACHINE_TRY(fe_world_get_store(world, &store));
    MACHINE_TRY(fe_heightfield_create(store, &field, &asset));
    fe_geometry_heightfield(&form, asset);
    return machine_body(world, FE_BODY_STATIC, fe_make_transform(0, 0, -24), &form, 0, &body);
}

static fe_result show_car(fe_world *world)
{
    const double valley = 12.566;
    car c;
    MACHINE_TRY(add_hills(world));
    MACHINE_TRY(car_build(world, valley, 0.2, 0, &c));
    MACHINE_TRY(car_drive(world, &c, 6, 400, 0));
    MACHINE_TRY(run(world, 300));
    fe_vec3 v;
    MACHINE_TRY(fe_body_get_linear_velocity(world, c.chassis, &v));
    printf("car      drove %.1f m over hills in 5 s, now at %.2f m/s\n", x_of(world, c.chassis) - valley, (double)v.x);
    return FE_OK;
}

static fe_result show_bridge(fe_world *world)
{
    bridge b;
    MACHINE_TRY(bridge_build(world, -30, 5, 0, &b));
    MACHINE_TRY(run(world, 600));
    printf("bridge   sags by %.2f m\n", 5 - y_of(world, b.planks[BRIDGE_PLANKS / 2]));
    return FE_OK;
}

static fe_result show_door(fe_world *world)
{
    door d;
    const fe_vec3 push = {0, 0, 60};
    const fe_dvec3 handle = {10.85, 1, 10};
    MACHINE_TRY(door_build(world, 10, 0, 10, &d));
    MACHINE_TRY(fe_body_add_impulse_at(world, d.leaf, &push, &handle));
    MACHINE_TRY(run(world, 20));
    printf("door     flung open to %.0f degrees", degrees_of(world, d.hinges[0]));
    MACHINE_TRY(run(world, 300));
    printf(", 5 s later at %.2f\n", degrees_of(world, d.hinges[0]));
    return FE_OK;
}

static fe_result show_crane(fe_world *world)
{
    crane c;
    fe_configurable_joint_def rail;
    fe_vec3 force, torque;
    fe_configurable_joint_def_init(&rail, sizeof rail);
    MACHINE_TRY(crane_build(world, 0, 12, -10, 1000, &c));
    MACHINE_TRY(fe_configurable_joint_get(world, c.winch, &rail));
    rail.axes[FE_DOF_LINEAR_X].target = 4;
    MACHINE_TRY(fe_configurable_joint_set(world, c.winch, &rail));
    MACHINE_TRY(run(world, 1800));
    MACHINE_TRY(fe_joint_get_reaction(world, c.chain[0], &force, &torque));
    printf("crane    carried %.0f kg on links of %.0f kg to x = %.2f m; the first bears %.0f N\n", (double)c.load_mass,
           (double)c.link_mass, x_of(world, c.load), (double)force.y);
    return FE_OK;
}

int main(void)
{
    static fe_result (*const shows[])(fe_world *) = {show_ragdoll, show_car, show_bridge, show_door, show_crane};
    for (int i = 0; i < 5; ++i) {
        fe_world *world;
        if (fe_world_create(NULL, &world) != FE_OK || add_ground(world) != FE_OK || shows[i](world) != FE_OK) {
            printf("%s\n", fe_last_error());
            return 1;
        }
        if (fe_world_destroy(world) != FE_OK) return 1;
    }
    return 0;
}
