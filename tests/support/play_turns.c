// play_turns.c - the script of turning sweeps: forms of every kind that move and turn are thrown into a yard of posts,
// planks and a ground of triangles, and put where they stop; batches ask for many ways at once.
#include "core/math.h"
#include "support/play.h"

#include <math.h>

enum { CELLS = 12, SAMPLES = CELLS + 1, POSTS = 16, WAYS = 8, HULL = 0, MESH, FIELD };

static void make_ground(play *p)
{
    float vertices[SAMPLES * SAMPLES][3], heights[SAMPLES * SAMPLES];
    uint16_t triangles[2 * CELLS * CELLS][3];
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i) {
        int32_t column = i % SAMPLES, row = i / SAMPLES;
        vertices[i][0] = (float)column, vertices[i][1] = play_wave(column, row), vertices[i][2] = (float)row;
        heights[i] = play_wave(row, column);
    }
    for (int32_t i = 0; i < CELLS * CELLS; ++i) {
        int32_t corner = i / CELLS * SAMPLES + i % CELLS,
                v[4] = {corner, corner + SAMPLES, corner + SAMPLES + 1, corner + 1};
        for (int32_t k = 0; k < 3; ++k) {
            triangles[2 * i][k] = (uint16_t)v[k];
            triangles[2 * i + 1][k] = (uint16_t)v[(k + 2) % 4];
        }
    }
    fe_mesh_def mesh;
    fe_mesh_def_init(&mesh, sizeof mesh);
    mesh.vertices = vertices[0], mesh.vertex_count = SAMPLES * SAMPLES;
    mesh.indices = triangles, mesh.triangle_count = 2 * CELLS * CELLS, mesh.index_type = FE_INDEX_U16;
    PLAY(p, fe_mesh_create(world_store(p->world), &mesh, p->assets + MESH));
    fe_heightfield_def field;
    fe_heightfield_def_init(&field, sizeof field);
    field.rows = field.columns = SAMPLES, field.cell_x = field.cell_z = 1.0f, field.heights = heights;
    PLAY(p, fe_heightfield_create(world_store(p->world), &field, p->assets + FIELD));
}

static void make_hull(play *p)
{
    enum { POINTS = 24 };
    float points[POINTS][3];
    fe_hull_def def;
    for (int32_t i = 0; i < 3 * POINTS; ++i) points[i / 3][i % 3] = play_between(p, -0.6f, 0.6f);
    fe_hull_def_init(&def, sizeof def);
    def.points = points[0], def.point_count = POINTS;
    PLAY(p, fe_hull_create(world_store(p->world), &def, p->assets + HULL));
}

static void any_form(play *p, int32_t i, fe_geometry *out)
{
    if (i % 6 == 0) fe_geometry_box(out, 1.2f, 0.08f, 0.15f);
    if (i % 6 == 1) fe_geometry_capsule(out, 0.9f, 0.1f);
    if (i % 6 == 2) fe_geometry_cylinder(out, 0.7f, 0.2f);
    if (i % 6 == 3) fe_geometry_cone(out, 0.6f, 0.4f);
    if (i % 6 == 4) fe_geometry_hull(out, p->assets[HULL]);
    if (i % 6 == 5) fe_geometry_sphere(out, 0.3f);
}

static void build(play *p)
{
    make_hull(p);
    make_ground(p);
    part ground = part_static_box(1.0f, 1.0f, 1.0f, -12.0, 0.0, -6.0);
    fe_geometry_mesh(&ground.geometry, p->assets[MESH]);
    play_add(p, &ground);
    ground.body.transform.position.x = 0.0;
    fe_geometry_heightfield(&ground.geometry, p->assets[FIELD]);
    play_add(p, &ground);
    part below = part_plane(0.0f, 1.0f, 0.0f);
    below.body.transform.position.y = -3.0;
    play_add(p, &below);
    for (int32_t i = 0; i < POSTS; ++i) {
        part post = part_static_box(0.02f, 3.0f, 0.3f, 1.5 * i - 12.0, 1.5, (double)play_between(p, -4.0f, 4.0f));
        if (i % 4) any_form(p, i, &post.geometry);
        play_add(p, &post);
    }
}

static fe_path any_way(play *p)
{
    fe_path way = {.start = {{0.0, 0.0, 0.0}, {0.0f, 0.0f, 0.0f, 1.0f}}};
    way.start.position.x = (double)play_between(p, -11.0f, 11.0f), way.start.position.y = 5.0;
    way.start.position.z = (double)play_between(p, -5.0f, 5.0f);
    way.start.rotation.x = play_between(p, -1.0f, 1.0f), way.start.rotation.y = play_between(p, -1.0f, 1.0f);
    way.translation.x = (double)play_between(p, -3.0f, 3.0f), way.translation.z = (double)play_between(p, -3.0f, 3.0f);
    way.translation.y = (double)play_between(p, -8.0f, 0.0f);
    way.turn.x = play_between(p, -7.0f, 7.0f), way.turn.y = play_between(p, -7.0f, 7.0f);
    way.turn.z = play_between(p, -7.0f, 7.0f);
    return way;
}

static fe_quat turned_by(fe_vec3 turn, double part, fe_quat q)
{
    double x = (double)turn.x, y = (double)turn.y, z = (double)turn.z, angle = sqrt(x * x + y * y + z * z), s, c;
    fe__sincos(0.5 * part * angle, &s, &c);
    fe_quat k = {(float)(s * x / angle), (float)(s * y / angle), (float)(s * z / angle), (float)c};
    return (fe_quat){k.w * q.x + k.x * q.w + k.y * q.z - k.z * q.y, k.w * q.y - k.x * q.z + k.y * q.w + k.z * q.x,
                     k.w * q.z + k.x * q.y - k.y * q.x + k.z * q.w, k.w * q.w - k.x * q.x - k.y * q.y - k.z * q.z};
}

static void tell(play *p, const fe_hit *hit)
{
    fe__hash_double(&p->told, hit->fraction);
    fe__hash_double(&p->told, hit->point.x);
    fe__hash_double(&p->told, (double)hit->normal.y);
}

static void place(play *p)
{
    part a = part_sphere(0.3f, 0.0, 0.0, 0.0);
    any_form(p, p->step, &a.geometry);
    fe_path way = any_way(p);
    fe_hit hit;
    if (fe_world_sweep_turning(p->world, &a.geometry, &way.start, &way.translation, &way.turn, NULL, &hit) != 1) return;
    tell(p, &hit);
    if (hit.flags & FE_HIT_STARTED_INSIDE) return;
    fe_transform *at = &a.body.transform;
    *at = way.start;
    at->position.x += hit.fraction * way.translation.x, at->position.y += hit.fraction * way.translation.y,
        at->position.z += hit.fraction * way.translation.z;
    at->rotation = turned_by(way.turn, hit.fraction, at->rotation);
    play_add(p, &a);
}

static void act(play *p)
{
    if (p->step % 2 == 0) place(p);
    if (p->step % 10 != 5) return;
    fe_path ways[WAYS];
    fe_hit hits[WAYS];
    fe_geometry form;
    any_form(p, p->step / 10, &form);
    for (int32_t i = 0; i < WAYS; ++i) ways[i] = any_way(p);
    if (fe_world_sweep_many(p->world, &form, ways, sizeof *ways, WAYS, NULL, 1, hits, sizeof *hits) < 0) return;
    for (int32_t i = 0; i < WAYS; ++i) tell(p, &hits[i]);
}

const script script_turns = {"turns", 150, build, act};
