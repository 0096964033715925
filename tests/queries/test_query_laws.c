// The laws of the queries on random input, with the failing case printed.
//
//     build/tests/queries/test_query_laws 1000000     that many inputs
//
// The inputs like edges: whole numbers, equal sizes, no rotation, zero translations, so that surfaces touch exactly and
// edges lie along edges.
#include "api/api_test.h"
#include "queries/dice.h"

#include <stdlib.h>

#if defined(FE_SANITIZED)
enum { INPUTS = 3000 };
#else
enum { INPUTS = 100000 };
#endif
enum { BODIES = 24, PER_WORLD = 200 };

static int32_t inputs = INPUTS;

typedef struct source {
    dice dice;
    int32_t round; // whole numbers
} source;

static double number(source *s, double most)
{
    double x = uniform(&s->dice, -most, most);
    return s->round ? (double)(int64_t)x : x;
}
static fe_dvec3 place(source *s, double most)
{
    double x = number(s, most), y = number(s, most);
    return fe_make_dvec3(x, y, number(s, most));
}

static fe_quat rotation(source *s)
{
    static const fe_quat simple[] = {{0, 0, 0, 1}, {1, 0, 0, 0}, {0, 0, 1, 1}, {1, 1, 1, 1}};
    if (s->round || one_of(&s->dice, 4) == 0) return simple[one_of(&s->dice, 4)];
    float x = (float)uniform(&s->dice, -1, 1), y = (float)uniform(&s->dice, -1, 1), z = (float)uniform(&s->dice, -1, 1),
          w = (float)uniform(&s->dice, 0.1, 1);
    return (fe_quat){x, y, z, w};
}

static float length_of(source *s)
{
    static const float sizes[] = {0.5f, 1, 1, 2, 0.001f, 100};
    return s->round ? sizes[one_of(&s->dice, 6)] : (float)(0.01 * pow(1000, uniform(&s->dice, 0, 1)));
}

static fe_geometry geometry(source *s, int32_t types)
{
    fe_geometry g;
    float a = length_of(s), b = length_of(s), c = length_of(s);
    switch (one_of(&s->dice, types)) {
    case 0:
        fe_geometry_sphere(&g, a);
        break;
    case 1:
        fe_geometry_capsule(&g, a, b);
        break;
    case 2:
        fe_geometry_box(&g, a, b, c);
        break;
    case 3:
        fe_geometry_plane(&g, 0, 1, 0, -a);
        break;
    default:
        fe_geometry_sphere(&g, 0);
        break;
    }
    return g;
}

// Steps, slopes and holes.
static void add_field(source *s, fe_world *world, double middle)
{
    enum { SAMPLES = 8 };
    float heights[SAMPLES * SAMPLES];
    uint8_t holes[(SAMPLES - 1) * (SAMPLES - 1)];
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i) heights[i] = (float)number(s, 2);
    for (size_t i = 0; i < sizeof holes; ++i) holes[i] = one_of(&s->dice, 8) == 0;
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = SAMPLES, def.cell_x = 2, def.cell_z = 3, def.heights = heights, def.holes = holes;
    fe_asset asset;
    fe_geometry g;
    OK(fe_heightfield_create(world_store(world), &def, &asset));
    fe_geometry_heightfield(&g, asset);
    add_shape(world, new_body(world, FE_BODY_STATIC, middle - 7, 0, -10), &g);
}

static fe_world *random_world(source *s)
{
    fe_world *world = new_world();
    double middle = one_of(&s->dice, 3) == 0 ? 1e6 : 0;
    add_field(s, world, middle);
    for (int32_t i = 1; i < BODIES; ++i) {
        fe_body_def def;
        fe_body_def_init(&def, sizeof def);
        def.type = one_of(&s->dice, 3);
        def.transform.position = place(s, 10);
        def.transform.position.x += middle;
        def.transform.rotation = rotation(s);
        fe_body body;
        OK(fe_body_create(world, &def, &body));
        for (int32_t shapes = one_of(&s->dice, 3) == 0 ? 3 : 1; shapes > 0; --shapes) {
            fe_shape_def shape;
            fe_shape_def_init(&shape, sizeof shape);
            if (shapes > 1)
                shape.frame.position = fe_make_vec3((float)number(s, 3), (float)number(s, 3), (float)number(s, 3));
            shape.trigger = one_of(&s->dice, 5) == 0;
            fe_geometry g = geometry(s, def.type == FE_BODY_STATIC && i < 3 ? 4 : 3);
            fe_shape handle;
            OK(fe_shape_create(world, body, &shape, &g, &handle));
        }
    }
    return world;
}

typedef struct input {
    fe_geometry geometry;
    fe_transform start;
    fe_dvec3 way;
} input;

static input random_input(source *s, const fe_world *world)
{
    static const double lengths[] = {20, 20, 20, 1, 0.001, 1e4};
    fe_body bodies[BODIES];
    input in = {.geometry = geometry(s, 5)};
    if (in.geometry.type == FE_GEOMETRY_PLANE) fe_geometry_sphere(&in.geometry, 0);
    fe_world_get_bodies(world, bodies, BODIES);
    in.start = fe_make_transform(0, 0, 0);
    in.start.position = body_transform(world, bodies[one_of(&s->dice, BODIES)]).position;
    fe_dvec3 off = place(s, 12);
    in.start.position.x += off.x, in.start.position.y += off.y, in.start.position.z += off.z;
    in.start.rotation = rotation(s);
    in.way = place(s, lengths[one_of(&s->dice, 6)]);
    if (one_of(&s->dice, 3) == 0) in.way.y = 0; // along surfaces
    if (one_of(&s->dice, 4) == 0) in.way.x = 0;
    return in;
}

// ---- the laws ------------------------------------------------------------------------------------------------------
static double along(fe_vec3 n, fe_dvec3 way) { return (double)n.x * way.x + (double)n.y * way.y + (double)n.z * way.z; }

static const char *broken_by_hit(const input *in, const fe_hit *hit)
{
    double square =
        along(hit->normal, fe_make_dvec3((double)hit->normal.x, (double)hit->normal.y, (double)hit->normal.z));
    if (!(square > 0.999999 && square < 1.000001)) return "a normal has length 1";
    if (!(along(hit->normal, in->way) <= 0)) return "a normal never points along the way";
    if (!(hit->fraction >= 0 && hit->fraction <= 1)) return "a fraction is in 0..1";
    if (hit->flags && (hit->fraction > 0 || !(hit->depth >= 0))) return "a start inside is a hit at 0, with a depth";
    if (!hit->flags && hit->depth != 0) return "only a start inside has a depth";
    return NULL;
}

static const char *broken_by_sweep(const fe_world *world, const input *in)
{
    static fe_hit hits[BODIES];
    fe_body inside[BODIES];
    fe_hit first;
    int32_t all = fe_world_sweep_all(world, &in->geometry, &in->start, &in->way, NULL, hits, sizeof *hits, BODIES),
            flagged = 0;
    int32_t overlap = fe_world_overlap(world, &in->geometry, &in->start, NULL, inside, BODIES);
    if (all < 0 || overlap < 0) return "a good query is answered";
    for (int32_t i = 0; i < all; ++i) {
        const char *broken = broken_by_hit(in, &hits[i]);
        if (broken) return broken;
        flagged += (hits[i].flags & FE_HIT_STARTED_INSIDE) != 0;
        if (hits[i].flags && (i >= overlap || hits[i].body != inside[i]))
            return "what starts inside is what overlaps, in order of creation";
    }
    if (flagged != overlap) return "overlap and a start inside are one";
    if ((fe_world_overlap_any(world, &in->geometry, &in->start, NULL) == 1) != (overlap > 0)) return "any overlap";
    int32_t result = fe_world_sweep(world, &in->geometry, &in->start, &in->way, NULL, &first);
    if (result != (all > 0 ? 1 : 0) || fe_world_sweep_any(world, &in->geometry, &in->start, &in->way, NULL) != result)
        return "first, any and all agree";
    if ((result == 1 && first.flags != 0) != (overlap > 0))
        return "overlap and a start inside are one for the first hit";
    if (all > 0 && memcmp(&first, hits, sizeof first) != 0) return "the first of all is the first";
    if (in->way.x == 0 && in->way.y == 0 && in->way.z == 0 && all != overlap)
        return "a zero translation is an overlap test";
    return NULL;
}

static const char *broken_by_ray(const fe_world *world, const input *in)
{
    if (in->geometry.type != FE_GEOMETRY_SPHERE || in->geometry.radius != 0) return NULL;
    fe_hit ray, sweep;
    memset(&ray, 0, sizeof ray), memset(&sweep, 0, sizeof sweep);
    int32_t result = fe_world_raycast(world, &in->start.position, &in->way, NULL, &ray);
    if (result != fe_world_sweep(world, &in->geometry, &in->start, &in->way, NULL, &sweep) ||
        memcmp(&ray, &sweep, sizeof ray) != 0)
        return "a sphere of radius 0 sweeps as a ray";
    return NULL;
}

// From where a sweep stopped, nothing overlaps. A heightfield may, whose triangles let pass what comes from below; it
// is the first body.
static const char *broken_by_stop(const fe_world *world, const input *in)
{
    fe_hit hit;
    if (in->geometry.type == FE_GEOMETRY_SPHERE && in->geometry.radius == 0) return NULL; // a ray ends on the surface
    if (fe_world_sweep(world, &in->geometry, &in->start, &in->way, NULL, &hit) != 1 || hit.flags) return NULL;
    fe_transform stop = in->start;
    stop.position.x += hit.fraction * in->way.x, stop.position.y += hit.fraction * in->way.y,
        stop.position.z += hit.fraction * in->way.z;
    fe_body bodies[2], field;
    fe_world_get_bodies(world, &field, 1);
    int32_t count = fe_world_overlap(world, &in->geometry, &stop, NULL, bodies, 2);
    if (count > 1 || (count == 1 && bodies[0] != field)) return "a sweep stops outside";
    return NULL;
}

static const char *broken_by_nan(const fe_world *world, const input *in)
{
    fe_dvec3 way = in->way;
    fe_hit hit;
    way.y = (double)NOT_A_NUMBER;
    if (fe_world_sweep(world, &in->geometry, &in->start, &way, NULL, &hit) != FE_ERROR_ARGUMENT)
        return "NaN is refused";
    return NULL;
}

static void print_input(const input *in, uint64_t seed, int32_t number_of_world)
{
    const fe_geometry *g = &in->geometry;
    const fe_transform *t = &in->start;
    print_error("world %d, seed 0x%llx, geometry %d r %a h %a half %a %a %a\n", (int)number_of_world,
                (unsigned long long)seed, (int)g->type, (double)g->radius, (double)g->half_height,
                (double)g->half_extents.x, (double)g->half_extents.y, (double)g->half_extents.z);
    print_error("start %a %a %a, rotation %a %a %a %a, way %a %a %a\n", t->position.x, t->position.y, t->position.z,
                (double)t->rotation.x, (double)t->rotation.y, (double)t->rotation.z, (double)t->rotation.w, in->way.x,
                in->way.y, in->way.z);
}

static void the_laws_of_queries_hold(void **state)
{
    (void)state;
    static const char *(*const laws[])(const fe_world *, const input *) = {broken_by_sweep, broken_by_ray,
                                                                           broken_by_stop, broken_by_nan};
    for (int32_t w = 0; w * PER_WORLD < inputs; ++w) {
        uint64_t seed = UINT64_C(88172645463325252) + (uint64_t)(uint32_t)w * UINT64_C(0x9e3779b97f4a7c15);
        source s = {.dice = {seed}, .round = w % 2};
        fe_world *world = random_world(&s);
        for (int32_t i = 0; i < PER_WORLD; ++i) {
            input in = random_input(&s, world);
            for (size_t l = 0; l < sizeof laws / sizeof *laws; ++l) {
                const char *broken = laws[l](world, &in);
                if (!broken) continue;
                print_error("broken: %s\n", broken);
                print_input(&in, seed, w);
                fail();
            }
        }
        OK(fe_world_destroy(world));
    }
}

// ---- sliding -------------------------------------------------------------------------------------------------------

// Flat ground at 0: flush boxes from -6 to 6, a heightfield behind them, a plane under the rest.
static fe_world *flat_world(void)
{
    enum { SAMPLES = 9 };
    static const float heights[SAMPLES * SAMPLES];
    fe_world *world = new_world();
    for (int i = -3; i < 3; ++i) add_box(world, new_body(world, FE_BODY_STATIC, 2 * i + 1, -1, 0), 1);
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = SAMPLES, def.cell_x = def.cell_z = 0.75f, def.heights = heights;
    fe_asset asset;
    fe_geometry g;
    OK(fe_heightfield_create(world_store(world), &def, &asset));
    fe_geometry_heightfield(&g, asset);
    add_shape(world, new_body(world, FE_BODY_STATIC, -3, 0, 5), &g);
    fe_geometry_plane(&g, 0, 1, 0, 0);
    add_shape(world, new_body(world, FE_BODY_STATIC, 0, 0, 0), &g);
    return world;
}

// What came down on a surface and stopped slides along it, over the seams, and up from it, and is hit by nothing.
static void what_has_stopped_slides(void **state)
{
    (void)state;
    fe_world *world = flat_world();
    const double places[] = {0, 8, 20}; // over boxes, field, plane
    const fe_quat turns[] = {{0, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
    for (int i = 0; i < 27; ++i) {
        fe_geometry g;
        fe_geometry_box(&g, 0.5f, 0.25f, 0.375f);
        if (i % 3 == 1) fe_geometry_sphere(&g, 0.5f);
        if (i % 3 == 2) fe_geometry_capsule(&g, 0.5f, 0.25f);
        fe_transform t = fe_make_transform(-1.3, 3, places[i / 3 % 3]);
        t.rotation = turns[i / 9];
        const fe_dvec3 down = {0.1, -5, 0.05}, slides[] = {{2.6, 0, 0}, {-2.3, 0, 0.3}, {0, 0, 0.7}, {1, 0.5, 0.2}};
        fe_hit hit;
        HIT(fe_world_sweep(world, &g, &t, &down, NULL, &hit));
        FE_WITHIN(hit.fraction, 0.4, 0.6);
        t.position.x += hit.fraction * down.x, t.position.y += hit.fraction * down.y,
            t.position.z += hit.fraction * down.z;
        for (int s = 0; s < 4; ++s) assert_int_equal(fe_world_sweep(world, &g, &t, &slides[s], NULL, &hit), 0);
        fe_dvec3 on = {0, -1e-3, 0}; // but what goes on into the ground stops where it is
        HIT(fe_world_sweep(world, &g, &t, &on, NULL, &hit));
        FE_WITHIN(hit.fraction, 0, 1e-4);
        FE_TRUE(hit.flags == 0);
    }
    OK(fe_world_destroy(world));
}

int main(int argc, char **argv)
{
    if (argc > 1) inputs = atoi(argv[1]);
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_laws_of_queries_hold),
                                       cmocka_unit_test(what_has_stopped_slides)};
    return cmocka_run_group_tests_name("query_laws", tests, NULL, NULL);
}
