// Sweeps of every form onto every flat ground, of 1 mm to 100 km, from 1 mm to 10 km away: all are met, all stop within
// a micrometre, and what stands there is stopped again or slides.
//
// The grounds' upper sides are flat: the gap is known without a judge. Doubles of lengths of 100 km are known to 1e-11
// m.
#include "api/api_test.h"
#include "queries/dice.h"

enum { SPHERE, CAPSULE, BOX, CYLINDER, CONE, HULL, MOVERS };
enum { ON_BOX, ON_HULL, ON_CYLINDER, ON_FIELD, ON_MESH, GROUNDS };

typedef struct bench {
    fe_world *world;
    fe_body ground;
    fe_shape shape;
    dice dice;
} bench;

static fe_asset cuboid(bench *b, float x, float y, float z)
{
    float points[24];
    for (int32_t i = 0; i < 8; ++i) {
        points[3 * i] = i & 1 ? x : -x;
        points[3 * i + 1] = i & 2 ? y : -y;
        points[3 * i + 2] = i & 4 ? z : -z;
    }
    fe_hull_def def;
    fe_hull_def_init(&def, sizeof def);
    def.points = points, def.point_count = 8;
    fe_asset asset;
    OK(fe_hull_create(world_store(b->world), &def, &asset));
    return asset;
}

// Two triangles, 2 s wide
static fe_asset floor_mesh(bench *b, float s)
{
    const float corners[12] = {-s, 0, -s, s, 0, -s, -s, 0, s, s, 0, s};
    const uint32_t indices[6] = {0, 2, 3, 0, 3, 1};
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = corners, def.vertex_count = 4, def.indices = indices, def.triangle_count = 2;
    fe_asset asset;
    OK(fe_mesh_create(world_store(b->world), &def, &asset));
    return asset;
}

static fe_asset floor_field(bench *b, float s)
{
    const float heights[4] = {0, 0, 0, 0};
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = 2, def.cell_x = def.cell_z = 2 * s, def.heights = heights;
    fe_asset asset;
    OK(fe_heightfield_create(world_store(b->world), &def, &asset));
    return asset;
}

// `top`: its upper side over its origin; `corner`: of what it covers from there to both sides, 0: from -s to s
static fe_geometry ground_of(bench *b, int32_t kind, float s, double *top, double *corner)
{
    fe_geometry g;
    float thick = fmaxf(0.1f * s, 0.001f);
    *top = thick, *corner = 0;
    if (kind == ON_BOX) fe_geometry_box(&g, s, thick, s);
    if (kind == ON_HULL) fe_geometry_hull(&g, cuboid(b, s, thick, s));
    if (kind == ON_CYLINDER) fe_geometry_cylinder(&g, thick, s);
    if (kind == ON_FIELD) fe_geometry_heightfield(&g, floor_field(b, s)), *top = 0, *corner = s;
    if (kind == ON_MESH) fe_geometry_mesh(&g, floor_mesh(b, s)), *top = 0;
    return g;
}

// `below`: how far it reaches under its origin
static fe_geometry mover_of(bench *b, int32_t kind, float s, double *below)
{
    fe_geometry g;
    *below = s;
    if (kind == SPHERE) fe_geometry_sphere(&g, s);
    if (kind == CAPSULE) fe_geometry_capsule(&g, s, s), *below = 2 * (double)s;
    if (kind == BOX) fe_geometry_box(&g, s, s, s);
    if (kind == CYLINDER) fe_geometry_cylinder(&g, s, s);
    if (kind == CONE) fe_geometry_cone(&g, s, s);
    if (kind == HULL) fe_geometry_hull(&g, cuboid(b, s, s, s));
    return g;
}

static fe_dvec3 in_frame(const fe_transform *t, double x, double y, double z)
{
    // q v q^-1 in double, for a quaternion of any length
    double qx = t->rotation.x, qy = t->rotation.y, qz = t->rotation.z, qw = t->rotation.w,
           k = 2 / (qx * qx + qy * qy + qz * qz + qw * qw);
    double cx = qy * z - qz * y, cy = qz * x - qx * z, cz = qx * y - qy * x;
    return fe_make_dvec3(t->position.x + x + k * (qw * cx + qy * cz - qz * cy),
                         t->position.y + y + k * (qw * cy + qz * cx - qx * cz),
                         t->position.z + z + k * (qw * cz + qx * cy - qy * cx));
}

#define ROUNDING 4e-16 // of the lengths involved

static void one_fall(bench *b, const fe_transform *frame, const fe_geometry *mover, double x, double z, double from,
                     double distance, double rounding)
{
    const fe_transform turned = {fe_make_dvec3(0, 0, 0), frame->rotation};
    fe_transform start = {in_frame(frame, x, from + distance, z), frame->rotation};
    double length = 2 * distance;
    fe_dvec3 down = in_frame(&turned, 0, -length, 0), aside = in_frame(&turned, distance, 0, 0),
             up = in_frame(&turned, 0, 1, 0);
    fe_hit hit;
    HIT(fe_world_sweep(b->world, mover, &start, &down, NULL, &hit));
    assert_int_equal(hit.flags, FE_HIT_DEFAULT);
    double gap = distance - hit.fraction * length;
    FE_WITHIN(gap, -rounding, 1e-6 + rounding);
    const double stop = 1e-7, sine = 1e-5 + rounding / stop; // of a way of a ten-millionth of a metre
    FE_NEAR(hit.normal.x, up.x, sine);
    FE_NEAR(hit.normal.y, up.y, sine);
    FE_NEAR(hit.normal.z, up.z, sine);
    // from there: on and on it is stopped, aside and back it is not
    start.position = in_frame(frame, x, from + gap, z);
    fe_dvec3 back = in_frame(&turned, 0, length, 0);
    HIT(fe_world_sweep(b->world, mover, &start, &down, NULL, &hit));
    assert_int_equal(hit.flags, FE_HIT_DEFAULT);
    FE_WITHIN(hit.fraction * length, 0, 1e-6 + rounding);
    assert_int_equal(fe_world_sweep(b->world, mover, &start, &back, NULL, &hit), 0);
    assert_int_equal(fe_world_overlap_any(b->world, mover, &start, NULL), 0);
    assert_int_equal(fe_world_sweep(b->world, mover, &start, &aside, NULL, &hit), 0);
}

static void fall_on(bench *b, int32_t ground, int32_t mover, float s, float m)
{
    const float widest = 5e4f; // half a cell of a field
    if (ground == ON_FIELD) s = fminf(s, widest);
    double top, below, corner;
    fe_geometry standing = ground_of(b, ground, s, &top, &corner), moving = mover_of(b, mover, m, &below);
    OK(fe_shape_set_geometry(b->world, b->shape, &standing));
    for (int32_t turned = 0; turned < 2; ++turned) {
        fe_transform frame = {fe_make_dvec3(0, 0, 0), {0, 0, 0, 1}};
        if (turned) {
            frame.rotation = (fe_quat){(float)uniform(&b->dice, -1, 1), (float)uniform(&b->dice, -1, 1),
                                       (float)uniform(&b->dice, -1, 1), 1};
        }
        OK(fe_body_set_transform(b->world, b->ground, &frame));
        OK(fe_body_get_transform(b->world, b->ground, &frame)); // of length 1
        const double distances[] = {1e-3, 1, 100, 1e4};
        for (int32_t d = 0; d < 4; ++d) {
            double x = corner + uniform(&b->dice, -0.6, 0.6) * (double)s,
                   z = corner + uniform(&b->dice, -0.6, 0.6) * (double)s;
            double lengths = 3 * (double)s + 3 * (double)m + 3 * distances[d];
            one_fall(b, &frame, &moving, x, z, top + below, distances[d], ROUNDING * lengths);
        }
    }
}

static void every_size_is_met(void **state)
{
    (void)state;
    const float sizes[] = {1e-3f, 0.05f, 1, 30, 500, 3000, 1e5f};
    enum { SIZES = sizeof sizes / sizeof *sizes };
    for (int32_t ground = 0; ground < GROUNDS; ++ground) {
        for (int32_t mover = 0; mover < MOVERS; ++mover) {
            bench b = {.world = new_world(), .dice = {UINT64_C(0x9e3779b97f4a7c15) + (uint32_t)(ground * 8 + mover)}};
            b.ground = new_body(b.world, FE_BODY_STATIC, 0, 0, 0);
            b.shape = add_box(b.world, b.ground, 1);
            for (int32_t i = 0; i < SIZES; ++i) {
                for (int32_t k = 0; k < SIZES; ++k) fall_on(&b, ground, mover, sizes[i], sizes[k]);
            }
            OK(fe_world_destroy(b.world));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_size_is_met)};
    return cmocka_run_group_tests_name("sweep_sizes", tests, NULL, NULL);
}
