// play_compounds.c - the script of compounds: a floor of tiles, of which one is a mesh and one a heightfield, under a
// rain of tables, dumbbells and burrs among single forms; a carried ramp, a gate that is a trigger, forms that change
// into compounds and back, an asset whose handle dies, and compounds that leave.
#include "support/play.h"

enum { KINDS = 3, BODIES = 90, PARTS = 9, MESH = 5, FIELD = 6, HULL = 7, GROUND = 3, RAMP = 0, GATE, FLOOR, FIRST };

static fe_compound_part box_part(float half_x, float half_y, float half_z, float x, float y, float z)
{
    fe_compound_part p;
    fe_compound_part_init(&p, sizeof p);
    fe_geometry_box(&p.geometry, half_x, half_y, half_z);
    p.frame.position = fe_make_vec3(x, y, z);
    return p;
}

static void make_assets(play *p)
{
    float heights[81], points[12][3];
    static const float corners[4][3] = {{-3, 0, -3}, {-3, 0.25f, 3}, {3, 0, 3}, {3, -0.25f, -3}};
    static const uint32_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    fe_heightfield_def field;
    fe_mesh_def mesh;
    fe_hull_def hull;
    for (int32_t i = 0; i < 81; ++i) heights[i] = 0.25f * play_wave(i % 9, i / 9);
    fe_heightfield_def_init(&field, sizeof field);
    field.rows = field.columns = 9, field.heights = heights, field.cell_x = field.cell_z = 0.75f;
    PLAY(p, fe_heightfield_create(world_store(p->world), &field, p->assets + FIELD));
    fe_mesh_def_init(&mesh, sizeof mesh);
    mesh.vertices = corners[0], mesh.vertex_count = 4, mesh.indices = triangles, mesh.triangle_count = 2;
    PLAY(p, fe_mesh_create(world_store(p->world), &mesh, p->assets + MESH));
    for (int32_t i = 0; i < 36; ++i) points[i / 3][i % 3] = play_between(p, -0.25f, 0.25f);
    fe_hull_def_init(&hull, sizeof hull);
    hull.points = points[0], hull.point_count = 12;
    PLAY(p, fe_hull_create(world_store(p->world), &hull, p->assets + HULL));
}

static int32_t make_floor(const play *p, fe_compound_part parts[PARTS])
{
    for (int32_t i = 0; i < 9; ++i) {
        float x = 6.0f * (float)(i % 3 - 1), z = 6.0f * (float)(i / 3 - 1);
        parts[i] = box_part(3.0f, 0.5f, 3.0f, x, -0.5f, z);
        if (i == 4) fe_geometry_mesh(&parts[i].geometry, p->assets[MESH]), parts[i].frame.position.y = 0.25f;
        if (i == 2) {
            fe_geometry_heightfield(&parts[i].geometry, p->assets[FIELD]);
            parts[i].frame.position = fe_make_vec3(x - 3.0f, 0.0f, z - 3.0f);
        }
        parts[i].own_material = i % 2, parts[i].material.static_friction = 0.2f * (float)i;
        parts[i].material.rolling_resistance = 0.05f, parts[i].material.user_id = (uint64_t)i;
    }
    return 9;
}

static int32_t make_table(fe_compound_part parts[PARTS])
{
    parts[0] = box_part(0.5f, 0.0625f, 0.375f, 0.0f, 0.25f, 0.0f);
    parts[0].density = 400.0f;
    for (int32_t i = 0; i < 4; ++i)
        parts[1 + i] = box_part(0.0625f, 0.25f, 0.0625f, i % 2 ? 0.4f : -0.4f, -0.0625f, i / 2 ? 0.3f : -0.3f);
    return 5;
}

static int32_t make_dumbbell(fe_compound_part parts[PARTS])
{
    for (int32_t i = 0; i < 3; ++i)
        parts[i] = box_part(0.1f, 0.1f, 0.1f, 0.0f, i ? (float)(2 * i - 3) * 0.4f : 0.0f, 0.0f);
    fe_geometry_capsule(&parts[0].geometry, 0.3f, 0.06f);
    fe_geometry_sphere(&parts[1].geometry, 0.2f);
    fe_geometry_cylinder(&parts[2].geometry, 0.1f, 0.25f);
    parts[1].own_material = 1, parts[1].material.restitution = 0.5f;
    return 3;
}

static int32_t make_burr(const play *p, fe_compound_part parts[PARTS])
{
    for (int32_t i = 0; i < 4; ++i) {
        parts[i] = box_part(0.1f, 0.1f, 0.1f, 0.0f, 0.0f, 0.0f);
        parts[i].frame.rotation = (fe_quat){i & 1 ? 1.0f : 0.0f, i & 2 ? 1.0f : 0.0f, 0.5f, 1.0f};
        if (i % 2)
            fe_geometry_cone(&parts[i].geometry, 0.4f, 0.15f);
        else
            fe_geometry_hull(&parts[i].geometry, p->assets[HULL]);
    }
    fe_geometry_set_scale(&parts[0].geometry, 1.5f, -0.5f, 1.0f);
    parts[3].frame.position.x = 0.25f;
    return 4;
}

static void make_kind(play *p, int32_t kind)
{
    fe_compound_part parts[PARTS];
    int32_t count = kind == 0   ? make_table(parts)
                    : kind == 1 ? make_dumbbell(parts)
                    : kind == 2 ? make_burr(p, parts)
                                : make_floor(p, parts);
    PLAY(p, fe_compound_create(world_store(p->world), parts, sizeof *parts, count, p->assets + kind));
}

static void any_form(const play *p, int32_t i, fe_geometry *out)
{
    fe_geometry_compound(out, p->assets[i % KINDS]);
    if (i % 5 == 3) fe_geometry_box(out, 0.25f, 0.125f, 0.375f);
    if (i % 10 == 9) fe_geometry_sphere(out, 0.25f);
}

static void add_gates(play *p)
{
    part ramp = part_static_box(1.0f, 1.0f, 1.0f, -3.0, 1.0, 3.0);
    fe_geometry_compound(&ramp.geometry, p->assets[0]);
    ramp.body.type = FE_BODY_KINEMATIC, ramp.body.angular_velocity.y = 1.0f;
    ramp.shape.events = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_STAY;
    play_add(p, &ramp);
    part gate = part_static_box(1.0f, 1.0f, 1.0f, 2.0, 1.5, -2.0);
    fe_geometry_compound(&gate.geometry, p->assets[2]);
    gate.shape.trigger = 1;
    play_add(p, &gate);
}

static void build(play *p)
{
    make_assets(p);
    for (int32_t kind = 0; kind <= GROUND; ++kind) make_kind(p, kind);
    add_gates(p);
    part ground = part_static_box(1.0f, 1.0f, 1.0f, 0.0, 0.0, 0.0);
    fe_geometry_compound(&ground.geometry, p->assets[GROUND]);
    play_add(p, &ground);
    for (int32_t i = 0; i < BODIES; ++i) {
        double x = (double)play_between(p, -5.0f, 5.0f), z = (double)play_between(p, -5.0f, 5.0f);
        part a = part_sphere(0.25f, x, 1.5 + 0.06 * i, z);
        any_form(p, i, &a.geometry);
        play_tumble(p, i, -40.0f, &a);
        play_add(p, &a);
    }
}

static void act(play *p)
{
    fe_geometry g;
    if (p->step % 12 == 6 && p->step < 160) { // another form of what lies there
        any_form(p, p->step / 12 + 1, &g);
        PLAY(p, fe_shape_set_geometry(p->world, p->shapes[FIRST + p->step / 2], &g));
    }
    if (p->step % 16 == 3) play_remove(p, FIRST + p->step / 3);
    if (p->step == 60) PLAY(p, fe_asset_destroy(world_store(p->world), p->assets[0]));
    if (p->step == 61) make_kind(p, 0); // in its place, with a new handle
    if (p->step == 90) {
        const float heights[4] = {0.5f, 0.5f, 0.5f, 0.5f};
        PLAY(p, fe_heightfield_set_heights(world_store(p->world), p->assets[FIELD], 3, 3, 2, 2, heights));
    }
    if (p->step == 110) {
        const fe_frame frame = {{0.5f, 0.25f, 0.0f}, {0.0f, 0.5f, 0.0f, 1.0f}};
        PLAY(p, fe_shape_set_frame(p->world, p->shapes[RAMP], &frame));
    }
    if (p->step == 130) PLAY(p, fe_shape_set_trigger(p->world, p->shapes[GATE], 0));
    if (p->step == 150) play_remove(p, RAMP);
}

const script script_compounds = {"compounds", 200, build, act};
