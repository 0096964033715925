// play_jointed.c - two big scripts of joints, as large as the bench's: 300 people of fourteen bones who fall on rough
// ground (ragdolls-300), and a cloth of 100 x 100 balls in one island (joints-100), which tears along a row. Joints are
// destroyed while it all moves.
#include "support/play.h"

#include "../../examples/machines.h"

enum { PEOPLE = 300, COLUMNS = 18, REMEMBERED = 90, SAMPLES = 41, CLOTH = 100, TEAR = 3 };

// ---- people --------------------------------------------------------------------------------------------------------

static void add_rough_ground(play *p)
{
    float heights[SAMPLES * SAMPLES];
    fe_asset field = 0;
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i)
        heights[i] = 0.0625f * (float)((i % SAMPLES * 7 + i / SAMPLES * 3) % 5);
    def.rows = def.columns = SAMPLES, def.heights = heights;
    PLAY(p, fe_heightfield_create(world_store(p->world), &def, &field));
    part ground = part_static_box(1.0f, 1.0f, 1.0f, -2.0, 0.0, -2.0);
    fe_geometry_heightfield(&ground.geometry, field);
    play_add(p, &ground);
}

static void build_people(play *p)
{
    add_rough_ground(p);
    for (int32_t i = 0; i < PEOPLE; ++i) {
        ragdoll person;
        const double x = 2.0 * (i % COLUMNS), y = 0.4 + 0.03125 * (i % 7), z = 2.0 * (i / COLUMNS);
        PLAY(p, ragdoll_build(p->world, fe_make_transform(x, y, z), 5, &person));
        for (int32_t k = 1; k < RAGDOLL_BONES && i < REMEMBERED; ++k) p->joints[p->joint_count++] = person.joints[k];
    }
}

// Every fifth of those remembered, none in the order of their making
static void take_people_apart(play *p)
{
    if (p->step != 30) return;
    for (int32_t i = 0; i < p->joint_count; i += 5)
        PLAY(p, fe_joint_destroy(p->world, p->joints[(i * 7 + 3) % p->joint_count]));
}

// ---- cloth ---------------------------------------------------------------------------------------------------------

static void tie(play *p, fe_body a, fe_body b, double x, double z, float break_force)
{
    const fe_dvec3 point = {x, 0, z};
    const fe_vec3 axis = {1, 0, 0};
    fe_joint joint;
    fe_ball_joint_def d;
    fe_ball_joint_def_init(&d, sizeof d);
    d.break_force = break_force;
    PLAY(p, fe_ball_joint_def_at(p->world, &d, a, b, &point, &axis));
    PLAY(p, fe_ball_joint_create(p->world, &d, &joint));
    if (break_force > 0.0f) p->joints[p->joint_count++] = joint;
}

// Held along one border; row TEAR bears what is beyond it by strings too weak for that
static void build_cloth(play *p)
{
    fe_body row[2][CLOTH];
    for (int32_t z = 0; z < CLOTH; ++z) {
        fe_body *here = row[z % 2], *behind = row[(z + 1) % 2];
        for (int32_t x = 0; x < CLOTH; ++x) {
            part ball = part_sphere(0.4f, x, 0.0, z);
            fe_shape shape;
            if (z == 0) ball.body.type = FE_BODY_STATIC;
            ball.shape.mask = 0;
            PLAY(p, fe_body_create(p->world, &ball.body, here + x));
            PLAY(p, fe_shape_create(p->world, here[x], &ball.shape, &ball.geometry, &shape));
            if (x > 0 && z > 0) tie(p, here[x - 1], here[x], x - 0.5, z, 0);
            if (z > 0) tie(p, behind[x], here[x], x, z - 0.5, z == TEAR ? 4e4f + 1e3f * (float)(x % 9) : 0.0f);
        }
    }
}

static void cut_cloth(play *p)
{
    if (p->step != 40) return;
    for (int32_t i = 0; i < p->joint_count; i += 3)
        if (fe_joint_is_valid(p->world, p->joints[i])) PLAY(p, fe_joint_destroy(p->world, p->joints[i]));
}

const script script_people = {"people", 50, build_people, take_people_apart};
const script script_cloth = {"cloth", 50, build_cloth, cut_cloth};
