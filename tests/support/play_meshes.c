// play_meshes.c - the script of meshes: two of them side by side, of alternating diagonals and with materials, under a
// rain of every form; a closed one, whose outside counts; a drum, which is one two-sided mesh that turns; a trigger;
// materials that change under sleeping bodies, a mesh whose handle dies.
#include "support/play.h"

#include <string.h>

enum { CELLS = 14, SAMPLES = CELLS + 1, FIELDS = 2, BODIES = 150, DRUMMED = 14, DRUM = FIELDS, ROCK, FIRST };
enum { PILLARS = 12 }; // of the drum

static const fe_material surfaces[3] = {SURFACE(0.6f, 0.5f, 0.0f, 0.1f, 0.02f), SURFACE(0.1f, 0.1f, 0.0f, 0.1f, 0.02f),
                                        SURFACE(0.6f, 0.5f, 0.6f, 0.1f, 0.02f)};

static fe_asset make_ground(play *p, int32_t which)
{
    float vertices[SAMPLES * SAMPLES][3];
    uint16_t triangles[2 * CELLS * CELLS][3];
    uint8_t kinds[2 * CELLS * CELLS];
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i) {
        int32_t column = i % SAMPLES, row = i / SAMPLES;
        vertices[i][0] = (float)column, vertices[i][1] = play_wave(column + which * CELLS, row),
        vertices[i][2] = (float)row;
    }
    for (int32_t i = 0; i < CELLS * CELLS; ++i) {
        int32_t corner = i / CELLS * SAMPLES + i % CELLS, flip = (i % CELLS + i / CELLS) % 2;
        int32_t v[4] = {corner, corner + SAMPLES, corner + SAMPLES + 1, corner + 1};
        for (int32_t k = 0; k < 3; ++k) {
            triangles[2 * i][k] = (uint16_t)v[(k + flip) % 4];
            triangles[2 * i + 1][k] = (uint16_t)v[(k + 2 + flip) % 4];
        }
        kinds[2 * i] = kinds[2 * i + 1] = (uint8_t)(i % 11 == 0 ? 1 : i % 13 == 0 ? 2 : 0);
    }
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = vertices[0], def.vertex_count = SAMPLES * SAMPLES;
    def.indices = triangles, def.triangle_count = 2 * CELLS * CELLS, def.index_type = FE_INDEX_U16;
    if (which) def.triangle_materials = kinds, def.materials = surfaces, def.material_count = 3;
    PLAY(p, fe_mesh_create(world_store(p->world), &def, p->assets + which));
    return p->assets[which];
}

// An octahedron, each side of it cut into four
static fe_asset make_rock(play *p)
{
    const float size = 1.5f;
    float vertices[6 + 32 * 3][3] = {{0}};
    int32_t triangles[32][3];
    fe_asset rock = 0;
    for (int32_t side = 0; side < 8; ++side) {
        float corner[3][3] = {{0}};
        for (int32_t k = 0; k < 3; ++k) corner[k][k] = side >> k & 1 ? size : -size;
        int32_t turned = ((side & 1) + (side >> 1 & 1) + (side >> 2 & 1)) % 2 == 0;
        float(*v)[3] = vertices + 12 * side;
        for (int32_t i = 0; i < 12; ++i) {
            // the corners of the three outer triangles, then those of the inner one: halves of two corners each
            int32_t part = i / 3, k = i % 3, a = part < 3 ? part : k, b = part < 3 ? (part + k) % 3 : (k + 1) % 3;
            for (int32_t axis = 0; axis < 3; ++axis) v[i][axis] = 0.5f * (corner[a][axis] + corner[b][axis]);
            triangles[4 * side + part][turned ? 2 - k : k] = 12 * side + i;
        }
    }
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = vertices[0], def.vertex_count = 96, def.indices = triangles, def.triangle_count = 32;
    PLAY(p, fe_mesh_create(world_store(p->world), &def, &rock));
    return rock;
}

// The corners of a ring of twelve, without sines: halves and the root of 3/4
static void ring_corner(int32_t i, float *out_x, float *out_y)
{
    static const float cosines[PILLARS] = {1.0f,  0.8660254f,  0.5f,  0.0f, -0.5f, -0.8660254f,
                                           -1.0f, -0.8660254f, -0.5f, 0.0f, 0.5f,  0.8660254f};
    *out_x = 2.0f * cosines[i % PILLARS], *out_y = 2.0f * cosines[(i + 9) % PILLARS];
}

// A lying drum: sides, two ends, and three blades within
static fe_asset make_drum(play *p)
{
    enum { BLADES = 3, SIDES = 2 * PILLARS, ENDS = 2 * (PILLARS - 2), ALL = SIDES + ENDS + 2 * BLADES };
    const float length = 3.0f, inner = 0.6f;
    float vertices[2 * (PILLARS + BLADES)][3];
    int32_t triangles[ALL][3], count = 0;
    for (int32_t i = 0; i < PILLARS + BLADES; ++i) {
        float x, y, keep = i < PILLARS ? 1.0f : inner;
        ring_corner(i < PILLARS ? i : 4 * (i - PILLARS), &x, &y);
        for (int32_t end = 0; end < 2; ++end) {
            float *v = vertices[2 * i + end];
            v[0] = keep * x, v[1] = keep * y, v[2] = end ? 0.5f * length : -0.5f * length;
        }
    }
    for (int32_t i = 0; i < PILLARS + BLADES; ++i) {
        int32_t a = i < PILLARS ? i : 4 * (i - PILLARS), b = i < PILLARS ? (i + 1) % PILLARS : i;
        const int32_t both[2][3] = {{2 * a, 2 * b, 2 * b + 1}, {2 * a, 2 * b + 1, 2 * a + 1}};
        memcpy(triangles[count], both, sizeof both), count += 2;
    }
    for (int32_t i = 1; i + 1 < PILLARS; ++i)
        for (int32_t end = 0; end < 2; ++end, ++count)
            triangles[count][0] = end, triangles[count][1] = 2 * i + end, triangles[count][2] = 2 * (i + 1) + end;
    fe_mesh_def def;
    fe_asset drum = 0;
    fe_mesh_def_init(&def, sizeof def);
    def.flags = FE_MESH_TWO_SIDED, def.vertices = vertices[0], def.vertex_count = 2 * (PILLARS + BLADES);
    def.indices = triangles, def.triangle_count = count;
    PLAY(p, fe_mesh_create(world_store(p->world), &def, &drum));
    return drum;
}

static void choose_form(play *p, int32_t i, float size, fe_geometry *out)
{
    switch (i % 7) {
    case 0:
        fe_geometry_sphere(out, size);
        break;
    case 1:
        fe_geometry_capsule(out, size, 0.6f * size);
        break;
    case 2:
        fe_geometry_cylinder(out, 0.7f * size, size);
        break;
    case 3:
        fe_geometry_cone(out, size, 0.8f * size);
        break;
    case 4:
        fe_geometry_hull(out, p->assets[FIELDS]);
        break;
    default:
        fe_geometry_box(out, size, 0.5f * size, 0.8f * size);
    }
}

static part any_part(play *p, int32_t i)
{
    double x = (double)play_between(p, -12.0f, 12.0f), z = (double)play_between(p, 2.0f, 12.0f);
    part a = part_sphere(1.0f, x, 2.5 + 0.03 * i, z);
    choose_form(p, i, play_between(p, 0.15f, 0.4f), &a.geometry);
    play_tumble(p, i, -50.0f, &a);
    return a;
}

static void add_hull(play *p)
{
    enum { POINTS = 20 };
    float points[POINTS][3];
    fe_hull_def def;
    for (int32_t i = 0; i < 3 * POINTS; ++i) points[i / 3][i % 3] = play_between(p, -0.35f, 0.35f);
    fe_hull_def_init(&def, sizeof def);
    def.points = points[0], def.point_count = POINTS;
    PLAY(p, fe_hull_create(world_store(p->world), &def, p->assets + FIELDS));
}

static void build(play *p)
{
    add_hull(p);
    for (int32_t i = 0; i < FIELDS; ++i) {
        part ground = part_static_box(1.0f, 1.0f, 1.0f, (i - 1) * (double)CELLS, 0.0, 0.0);
        fe_geometry_mesh(&ground.geometry, make_ground(p, i));
        play_add(p, &ground);
    }
    part drum = part_box(1.0f, 1.0f, 1.0f, 0.0, 6.0, -4.0), rock = part_static_box(1.0f, 1.0f, 1.0f, 4.0, 1.0, 6.0);
    fe_geometry_mesh(&drum.geometry, make_drum(p));
    fe_geometry_mesh(&rock.geometry, make_rock(p));
    drum.body.type = FE_BODY_KINEMATIC, drum.body.angular_velocity.z = 2.0f;
    play_add(p, &drum);
    play_add(p, &rock);
    for (int32_t i = 0; i < BODIES; ++i) {
        part a = any_part(p, i);
        if (i < DRUMMED) {
            a.body.transform.position = (fe_dvec3){0.6 * (i % 3 - 1), 5.5 + 0.4 * (i / 6), -4.8 + 0.8 * (i / 3 % 3)};
            a.body.linear_velocity = (fe_vec3){0.0f, 0.0f, 0.0f};
        }
        play_add(p, &a);
    }
}

static void act(play *p)
{
    if (p->step == 100) PLAY(p, fe_asset_destroy(world_store(p->world), p->assets[0]));
    if (p->step == 120) {
        const fe_material slippery[3] = {surfaces[1], surfaces[2], surfaces[0]};
        PLAY(p, fe_mesh_set_materials(world_store(p->world), p->assets[1], slippery, sizeof *slippery, 3));
    }
    if (p->step == 140) PLAY(p, fe_body_set_type(p->world, p->actors[ROCK], FE_BODY_KINEMATIC));
    if (p->step == 150) PLAY(p, fe_shape_set_trigger(p->world, p->shapes[DRUM], 1));
    if (p->step == 170) {
        fe_geometry ball;
        fe_geometry_sphere(&ball, 0.5f);
        PLAY(p, fe_shape_set_geometry(p->world, p->shapes[0], &ball)); // the first mesh is gone, with its asset
    }
}

const script script_meshes = {"meshes", 200, build, act};
