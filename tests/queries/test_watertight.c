// No ray slips through a mesh that is scaled, mirrored, turned and up to 1e6 m off: neither at its vertices nor at its
// edges nor a hair beside them. A ray out of a closed mesh meets it where both sides count, and only there.
//
//     build/tests/queries/test_watertight 10000000    that many rays at a terrain, and that many out of a ball
#include "api/api_test.h"
#include "queries/exact.h"
#include "support/mesh_make.h"

#include <stdio.h>

#if defined(FE_SANITIZED)
enum { RAYS = 5000 };
#else
enum { RAYS = 100000 };
#endif
enum { PER_POSE = 250, ONE_SIDED = 1, TWO_SIDED = 2 }; // the last are layers

static int32_t rays = RAYS;

typedef struct bench {
    fe_world *world;
    fe_body bodies[2];
    fe_shape shapes[2];
    fe_transform pose;
    fe_vec3 scale;
} bench;

static void place(bench *b, int32_t count, uint32_t flags)
{
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = made.vertices[0], def.vertex_count = made.vertex_count;
    def.indices = made.triangles, def.triangle_count = made.triangle_count, def.flags = flags;
    fe_asset asset;
    fe_geometry g;
    fe_shape_def shape;
    fe_shape_def_init(&shape, sizeof shape);
    shape.layer = flags ? TWO_SIDED : ONE_SIDED;
    OK(fe_mesh_create(world_store(b->world), &def, &asset));
    fe_geometry_mesh(&g, asset);
    b->bodies[count] = new_body(b->world, FE_BODY_STATIC, 0, 0, 0);
    OK(fe_shape_create(b->world, b->bodies[count], &shape, &g, &b->shapes[count]));
}

static float random_scale(void)
{
    double size = pow(10, 2 * soup_random(&dice));
    return (float)(soup_random(&dice) < 0 ? -size : size);
}

// Every fourth pose is at the origin, unturned and mirrored at most: rays meet its vertices to the last bit
static void move(bench *b, int32_t count, int32_t number)
{
    fe_quat q = {0, 0, 0, 1};
    fe_dvec3 at = {0, 0, 0};
    float sign = soup_random(&dice) < 0 ? -1 : 1;
    b->scale = (fe_vec3){sign, 1, -1};
    if (number % 4) {
        q.x = (float)soup_random(&dice), q.y = (float)soup_random(&dice), q.z = (float)soup_random(&dice);
        b->scale.x = random_scale(), b->scale.y = random_scale(), b->scale.z = random_scale();
        at = random_point(number % 4 == 1 ? 10 : 1e6);
    }
    b->pose = (fe_transform){at, q};
    for (int32_t i = 0; i < count; ++i) {
        fe_geometry g = {.struct_size = sizeof g};
        OK(fe_shape_get_geometry(b->world, b->shapes[i], &g));
        fe_geometry_set_scale(&g, b->scale.x, b->scale.y, b->scale.z);
        OK(fe_shape_set_geometry(b->world, b->shapes[i], &g));
        OK(fe_body_set_transform(b->world, b->bodies[i], &b->pose));
    }
    OK(fe_body_get_transform(b->world, b->bodies[0], &b->pose));
}

static vec turned(const bench *b, fe_dvec3 p) // and scaled, relative to the body
{
    return v_turn(b->pose.rotation, (vec){(real)b->scale.x * p.x, (real)b->scale.y * p.y, (real)b->scale.z * p.z});
}

static fe_dvec3 to_world(const bench *b, fe_dvec3 p)
{
    vec v = v_add(turned(b, p), v_of(b->pose.position));
    return (fe_dvec3){(double)v.x, (double)v.y, (double)v.z};
}

static fe_dvec3 corner(int32_t triangle, int32_t k)
{
    const float *v = made.vertices[made.triangles[triangle][k]];
    return (fe_dvec3){v[0], v[1], v[2]};
}

// Of the asset: a vertex, a point of an edge, of the inside of a triangle, or `away` beside a vertex
static fe_dvec3 target(int32_t kind, double away)
{
    double part = 0.5 * (soup_random(&dice) + 1.0), s, t;
    int32_t triangle = fe__mini((int32_t)(part * made.triangle_count), made.triangle_count - 1),
            k = (int32_t)(dice >> 40) % 3;
    fe_dvec3 v = corner(triangle, k), u = corner(triangle, (k + 1) % 3), w = corner(triangle, (k + 2) % 3);
    s = 0.5 * (soup_random(&dice) + 1.0), t = kind == 2 ? 0.5 * (soup_random(&dice) + 1.0) * (1.0 - s) : 0.0;
    if (kind == 0) return v;
    if (kind == 3) return fe__dadd(v, random_point(away));
    return fe__dadd(v, fe__dadd(fe__dscale(s, fe__dsub(u, v)), fe__dscale(t, fe__dsub(w, v))));
}

static void print_ray(const bench *b, int32_t i, fe_dvec3 from, fe_dvec3 way)
{
    const fe_transform *t = &b->pose;
    print_error("ray %d from %a %a %a by %a %a %a, scale %a %a %a\n", (int)i, from.x, from.y, from.z, way.x, way.y,
                way.z, (double)b->scale.x, (double)b->scale.y, (double)b->scale.z);
    print_error("mesh at %a %a %a, rotation %a %a %a %a\n", t->position.x, t->position.y, t->position.z,
                (double)t->rotation.x, (double)t->rotation.y, (double)t->rotation.z, (double)t->rotation.w);
}

// The point is on the triangle that is told, up to a billionth of the way and the rounding of doubles out there, and
// the normal against the ray.
static int32_t is_true(const bench *b, fe_dvec3 way, const fe_hit *hit)
{
    if (hit->triangle < 0 || hit->triangle >= made.triangle_count) return 0;
    vec v[3];
    for (int32_t k = 0; k < 3; ++k) v[k] = turned(b, corner(hit->triangle, k));
    solid t = make_triangle_solid(v[0], v[1], v[2]);
    vec p = v_sub(v_of(hit->point), v_of(b->pose.position));
    real far = v_length(v_of(b->pose.position)), off = v_length(v_sub(p, nearest_on_triangle(&t, p)));
    return v_dot(v_off(hit->normal), v_of(way)) < 0 && off <= 1e-9L * v_length(v_of(way)) + 4e-16L * far;
}

static void look(const bench *b, int32_t i, uint32_t layer, fe_dvec3 from, fe_dvec3 to, int32_t expected)
{
    fe_dvec3 origin = to_world(b, from), way = fe__dsub(to_world(b, to), origin);
    fe_query_filter filter;
    fe_query_filter_init(&filter, sizeof filter);
    filter.mask = layer;
    fe_hit hit;
    int32_t met = fe_world_raycast(b->world, &origin, &way, &filter, &hit);
    if (met == expected && (!met || is_true(b, way, &hit))) return;
    print_error("%d hits, not %d\n", (int)met, (int)expected);
    print_ray(b, i, origin, way);
    if (met) print_error("triangle %d, fraction %a\n", (int)hit.triangle, hit.fraction);
    fail();
}

static const double beside[4] = {1e-9, 1e-7, 1e-5, 1e-3};

// Both ends lie beyond all heights: on different sides, whatever is aimed at
static void no_ray_slips_through_a_terrain(void **state)
{
    (void)state;
    bench b = {.world = new_world()};
    soup_terrain(&made, 60, 1.0, 0.5, &dice);
    place(&b, 0, 0);
    for (int32_t i = 0; i < rays; ++i) {
        if (i % PER_POSE == 0) move(&b, 1, i / PER_POSE);
        fe_dvec3 aim = target(i % 4, beside[i / 4 % 4]), side = random_point(2.0);
        aim.x = fe__maxd(-25.0, fe__mind(25.0, aim.x)), aim.z = fe__maxd(-25.0, fe__mind(25.0, aim.z));
        side.y = 1.0 + fe__absd(side.y);
        if (i % 8 < 4) side.x = 0.0, side.z = i % 16 < 8 ? 0.0 : side.z; // along axes too
        double up = (0.6 - aim.y) / side.y + 1.0, down = (aim.y + 0.6) / side.y + 1.0;
        fe_dvec3 from = fe__dadd(aim, fe__dscale(up, side)), to = fe__dsub(aim, fe__dscale(down, side));
        look(&b, i, ONE_SIDED, from, to, 1);
        if (side.x == 0.0 && side.z == 0.0) look(&b, i, ONE_SIDED, to, from, 0); // a slanted one may come out and in
    }
    printf("%d rays at a terrain, none missed\n", (int)rays);
    OK(fe_world_destroy(b.world));
}

static void a_ray_out_of_a_ball_meets_what_has_two_sides(void **state)
{
    (void)state;
    bench b = {.world = new_world()};
    soup_ball(&made, 4);
    place(&b, 0, 0);
    place(&b, 1, FE_MESH_TWO_SIDED);
    for (int32_t i = 0; i < rays; ++i) {
        if (i % PER_POSE == 0) move(&b, 2, i / PER_POSE);
        fe_dvec3 from = random_point(0.5), aim = target(i % 4, beside[i / 4 % 4]);
        fe_dvec3 out = fe__dadd(from, fe__dscale(5.0, fe__dsub(aim, from))); // from inside of radius 0.87 to beyond 1
        look(&b, i, TWO_SIDED, from, out, 1);
        look(&b, i, ONE_SIDED, from, out, 0);
        look(&b, i, ONE_SIDED, out, from, 1);
    }
    printf("%d rays out of a ball, and back: two sides miss none, one meets none\n", (int)rays);
    OK(fe_world_destroy(b.world));
}

int main(int argc, char **argv)
{
    if (argc > 1) rays = atoi(argv[1]);
    if (argc > 2) cmocka_set_test_filter(argv[2]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(no_ray_slips_through_a_terrain, reset),
        cmocka_unit_test_setup(a_ray_out_of_a_ball_meets_what_has_two_sides, reset),
    };
    return cmocka_run_group_tests_name("watertight", tests, NULL, reset);
}
