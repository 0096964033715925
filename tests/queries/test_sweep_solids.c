// How far before a body a sweep of or onto a cylinder, a cone, a hull or a mesh stops: at most 1 micrometre, never in
// it.
//
//     build/tests/queries/test_sweep_solids 20000     that many cases a pair of forms, and the table of docs/QUERIES.md
//
// Shapes of 1 cm to 2 m, ways of 1 mm to 10 km, at the world's origin and 1e6 m off it. The judge is separation.h, in
// long double, and sure of a distance to 1e-9 m.
#include "queries/forms.h"

#include <stdio.h>
#include <stdlib.h>

#if defined(FE_SANITIZED)
enum { CASES = 100 };
#else
enum { CASES = 500 };
#endif

static int32_t cases = CASES;

typedef struct bench {
    fe_world *world;
    fe_store *store;
    fe_body body;
    fe_shape shape;
    dice dice;
} bench;

static fe_dvec3 along(fe_dvec3 p, double s, fe_dvec3 d)
{
    return fe_make_dvec3(p.x + s * d.x, p.y + s * d.y, p.z + s * d.z);
}

// ---- forms ---------------------------------------------------------------------------------------------------------

enum { HULL_POINTS = 8, SAMPLES = 4, TRIANGLES = 2 * (SAMPLES - 1) * (SAMPLES - 1) };

typedef struct sheet { // a rough one, no steeper than 45 degrees
    fe_asset asset;
    float points[SAMPLES * SAMPLES][3];
    int32_t corners[TRIANGLES][3];
} sheet;

static fe_geometry make_sheet(bench *b, sheet *f, double *out_reach)
{
    double cell = spread(&b->dice, 0.05, 1);
    uint32_t indices[TRIANGLES][3];
    *out_reach = 0;
    for (int32_t i = 0; i < SAMPLES * SAMPLES; ++i) {
        float *p = f->points[i];
        p[0] = (float)(cell * (i % SAMPLES - 0.5 * (SAMPLES - 1)));
        p[1] = (float)(cell * uniform(&b->dice, -0.2, 0.2));
        p[2] = (float)(cell * (i / SAMPLES - 0.5 * (SAMPLES - 1)));
        *out_reach = fmax(*out_reach, sqrt((double)(p[0] * p[0] + p[1] * p[1] + p[2] * p[2])));
    }
    for (int32_t i = 0; i < TRIANGLES; ++i) {
        int32_t cell_of = i / 2, at = cell_of / (SAMPLES - 1) * SAMPLES + cell_of % (SAMPLES - 1);
        const int32_t first[3] = {at, at + SAMPLES, at + SAMPLES + 1}, second[3] = {at, at + SAMPLES + 1, at + 1};
        memcpy(f->corners[i], i % 2 ? second : first, sizeof first);
        for (int32_t k = 0; k < 3; ++k) indices[i][k] = (uint32_t)f->corners[i][k];
    }
    fe_mesh_def d;
    fe_mesh_def_init(&d, sizeof d);
    d.vertices = f->points[0], d.vertex_count = SAMPLES * SAMPLES, d.indices = indices, d.triangle_count = TRIANGLES;
    OK(fe_mesh_create(b->store, &d, &f->asset));
    fe_geometry g;
    fe_geometry_mesh(&g, f->asset);
    return g;
}

// ---- the judge -----------------------------------------------------------------------------------------------------

typedef struct judged {
    const solid_form *mover, *still;
    const sheet *sheet; // stands instead of `still`, or NULL
    fe_transform start, pose;
} judged;

#define SURE 1e-9L // m

static separation judge(const judged *j, vec shift, int32_t triangle)
{
    convex mover = convex_of_form(j->mover, v_of(j->start.position), j->start.rotation);
    const sheet *f = j->sheet;
    if (!f) {
        convex still = convex_of_form(j->still, v_of(j->pose.position), j->pose.rotation);
        return separation_of(&mover, shift, &still, SURE);
    }
    separation best = {INFINITY, INFINITY, {0, 0, 0}};
    for (int32_t i = 0; i < TRIANGLES; ++i) {
        convex still = convex_at(FE_GEOMETRY_HULL, v_of(j->pose.position), j->pose.rotation);
        for (int32_t k = 0; k < 3; ++k) {
            const float *p = f->points[f->corners[i][k]];
            convex_add(&still, v_add(still.centre, v_turn(j->pose.rotation, (vec){p[0], p[1], p[2]})));
        }
        separation s = separation_of(&mover, shift, &still, SURE);
        if (i == triangle) best.away = s.away; // two triangles may be as near
        best.least = fminl(best.least, s.least), best.most = fminl(best.most, s.most);
    }
    return best;
}

typedef struct tally {
    int32_t hits, unsure;
    double least, most, normal; // m, m, sine of the largest error
} tally;

static void count(const judged *j, const fe_hit *hit, fe_dvec3 translation, tally *t)
{
    vec shift = v_scale(hit->fraction, v_of(translation));
    separation s = judge(j, shift, hit->triangle);
    if (!(s.most - s.least <= SURE)) {
        t->unsure += 1;
        return;
    }
    double radii = radius_of(j->mover) + (j->sheet ? 0 : radius_of(j->still));
    double error = (double)(v_length(v_cross(s.away, v_off(hit->normal))) / v_length(s.away));
    t->hits += 1;
    t->least = fmin(t->least, (double)s.least - radii), t->most = fmax(t->most, (double)s.most - radii);
    t->normal = fmax(t->normal, error);
}

// A way that meets the body somewhere in the middle: aimed from afar first, then taken from a start nearer by. A mesh
// is met from above, at most 27 degrees off the vertical.
static void one_case(bench *b, int32_t moving, int32_t standing, tally *t)
{
    static solid_form still, mover;
    static sheet mesh;
    int32_t is_mesh = standing == FE_GEOMETRY_MESH;
    make_form(b->store, &b->dice, standing, 0.01, 2, HULL_POINTS, &still);
    make_form(b->store, &b->dice, moving, 0.01, 2, HULL_POINTS, &mover);
    if (is_mesh) still.geometry = make_sheet(b, &mesh, &still.reach);
    double middle = uniform(&b->dice, 0, 1) < 0.5 ? 0 : 1e6, reach = mover.reach + still.reach;
    judged j = {.mover = &mover, .still = &still, .sheet = is_mesh ? &mesh : NULL};
    j.pose = (fe_transform){fe_make_dvec3(middle, -middle, uniform(&b->dice, -10, 10)), random_rotation(&b->dice)};
    if (is_mesh)
        j.pose.rotation = (fe_quat){(float)uniform(&b->dice, -0.1, 0.1), 0, (float)uniform(&b->dice, -0.1, 0.1), 1};
    OK(fe_shape_set_geometry(b->world, b->shape, &still.geometry));
    OK(fe_body_set_transform(b->world, b->body, &j.pose));
    OK(fe_body_get_transform(b->world, b->body, &j.pose)); // its rotation brought to length 1, in floats
    fe_dvec3 way = direction(&b->dice), aside = direction(&b->dice);
    if (is_mesh) {
        way.y = -2 - fabs(way.y);
        way = along(fe_make_dvec3(0, 0, 0), 1 / sqrt(way.x * way.x + way.y * way.y + way.z * way.z), way);
    }
    double off = uniform(&b->dice, 0, is_mesh ? 0.5 * still.reach : 0.7 * reach);
    j.start = (fe_transform){along(along(j.pose.position, off, aside), -3 * reach, way), random_rotation(&b->dice)};
    fe_dvec3 far = along(fe_make_dvec3(0, 0, 0), 6 * reach, way);
    fe_hit hit;
    int32_t met = fe_world_sweep(b->world, &mover.geometry, &j.start, &far, NULL, &hit) == 1 &&
                  !(hit.flags & FE_HIT_STARTED_INSIDE);
    if (met) {
        double length = spread(&b->dice, 1e-3, 1e4);
        j.start.position =
            along(along(j.start.position, hit.fraction * 6 * reach, way), -length * uniform(&b->dice, 0, 1), way);
        fe_dvec3 translation = along(fe_make_dvec3(0, 0, 0), length, way);
        met = fe_world_sweep(b->world, &mover.geometry, &j.start, &translation, NULL, &hit) == 1 &&
              !(hit.flags & FE_HIT_STARTED_INSIDE);
        if (met) count(&j, &hit, translation, t);
    }
    if (is_mesh) OK(fe_asset_destroy(b->store, mesh.asset));
    free_form(b->store, &mover);
    free_form(b->store, &still);
}

// ---- the table -----------------------------------------------------------------------------------------------------

static const struct {
    const char *name;
    int32_t type;
} kinds[] = {{"sphere", FE_GEOMETRY_SPHERE},     {"capsule", FE_GEOMETRY_CAPSULE}, {"box", FE_GEOMETRY_BOX},
             {"cylinder", FE_GEOMETRY_CYLINDER}, {"cone", FE_GEOMETRY_CONE},       {"hull", FE_GEOMETRY_HULL},
             {"mesh", FE_GEOMETRY_MESH}};
enum { OLD_KINDS = 3, MOVING_KINDS = 6, KINDS = 7 };

static tally tally_of(int32_t mover, int32_t still)
{
    bench b = {.world = new_world(), .dice = {UINT64_C(0x9e3779b97f4a7c15) + (uint32_t)(mover * 8 + still)}};
    OK(fe_world_get_store(b.world, &b.store));
    b.body = new_body(b.world, FE_BODY_STATIC, 0, 0, 0);
    b.shape = add_box(b.world, b.body, 1);
    tally t = {0, 0, INFINITY, -INFINITY, 0};
    for (int32_t i = 0; i < cases; ++i) one_case(&b, kinds[mover].type, kinds[still].type, &t);
    OK(fe_world_destroy(b.world));
    printf("| %-8s | %-8s | %6d | %9.4f | %9.4f | %7.1e |\n", kinds[mover].name, kinds[still].name, (int)t.hits,
           1e6 * t.least, 1e6 * t.most, t.normal);
    return t;
}

static void a_sweep_stops_before_the_body(void **state)
{
    (void)state;
    printf("| moving   | stands   | hits   | least, um | most, um  | normal  |\n|---|---|---|---|---|---|\n");
    for (int32_t mover = 0; mover < MOVING_KINDS; ++mover) {
        for (int32_t still = 0; still < KINDS; ++still) {
            if (mover < OLD_KINDS && still < OLD_KINDS) continue; // test_sweep_stop.c
            tally t = tally_of(mover, still);
            FE_WITHIN(t.hits, cases / 4, cases);
            FE_WITHIN(t.unsure, 0, cases / 100);
            FE_WITHIN(t.least, 2 * (double)SURE, 1e-6);
            FE_WITHIN(t.most, 0, 1e-6);
            FE_WITHIN(t.normal, 0, 0.02); // of a way of a ten-millionth of a metre
        }
    }
}

// Both stand upright, 160 m and 130 m high: what GJK makes of the box's edge before the cylinder's side is too far off
// by more than the gap. Seen from above it is a rectangle before a circle.
static void a_tall_box_stops_beside_a_tall_cylinder(void **state)
{
    (void)state;
    fe_world *world = new_world();
    const fe_dvec3 centre = {1e6, -1e6, 4.0194179626032156};
    fe_geometry cylinder, box;
    fe_geometry_cylinder(&cylinder, 66.2803116f, 1.4644295f);
    fe_geometry_box(&box, 0.770100832f, 80.5934067f, 0.122352712f);
    add_shape(world, new_body(world, FE_BODY_STATIC, centre.x, centre.y, centre.z), &cylinder);
    fe_transform start = fe_make_transform(1000040.1465341228, -1e6 - 30, -8.9362006859532066);
    fe_dvec3 way = {-61.511983071647016, 44.84424902130516, 19.816476913594187};
    fe_hit hit;
    HIT(fe_world_sweep(world, &box, &start, &way, NULL, &hit));
    real x = (real)start.position.x - centre.x + (real)hit.fraction * way.x,
         z = (real)start.position.z - centre.z + (real)hit.fraction * way.z,
         out_x = fabsl(x) - (real)box.half_extents.x, out_z = fabsl(z) - (real)box.half_extents.z;
    FE_WITHIN((double)(sqrtl(out_x * out_x + out_z * out_z) - (real)cylinder.radius), 1e-9, 1e-6);
    OK(fe_world_destroy(world));
}

static fe_geometry hull_of(fe_world *world, const float (*points)[3], int32_t count)
{
    fe_store *store;
    fe_hull_def d;
    fe_asset asset;
    fe_geometry g;
    OK(fe_world_get_store(world, &store));
    fe_hull_def_init(&d, sizeof d);
    d.points = points[0], d.point_count = count;
    OK(fe_hull_create(store, &d, &asset));
    fe_geometry_hull(&g, asset);
    return g;
}

// Where GJK begins with what was nearest before it ends a little off the way between the two, so that no plane across
// it holds them apart. Hulls have no side that is known better; nothing must be taken from the side that they have not.
static void a_hull_meets_a_hull_however_long_its_way(void **state)
{
    (void)state;
    enum { WAYS = 64 };
    static const float still[][3] = {
        {0x1.6ff2e2p-6f, -0x1.114706p-2f, -0x1.46a15p-4f},  {0x1.9db058p-3f, -0x1.8f861ep-3f, 0x1.3acd4ap-5f},
        {0x1.46332cp-2f, 0x1.e34d1ap-3f, 0x1.589be6p-3f},   {0x1.97998p-2f, -0x1.ff5d68p-4f, 0x1.ea3f24p-4f},
        {-0x1.cf3342p-3f, -0x1.281d6ep-3f, 0x1.140b3ep-5f}, {-0x1.d16574p-3f, 0x1.55f49p-3f, 0x1.cca7cp-5f},
        {0x1.e2056p-3f, -0x1.77fbbap-6f, -0x1.a6c8fcp-4f},  {0x1.7904e4p-2f, 0x1.d3b6d4p-3f, -0x1.0297bp-3f},
        {-0x1.873f42p-2f, 0x1.0d1e66p-2f, 0x1.f871e6p-7f},  {0x1.bfb1eep-3f, -0x1.751fb2p-4f, 0x1.36d7p-3f}};
    static const float moving[][3] = {
        {-0x1.d8272ep-5f, 0x1.8be32ap-6f, 0x1.154e72p-7f},   {-0x1.d9029p-5f, 0x1.82478ap-6f, -0x1.1b1e9p-7f},
        {0x1.90ac7ap-11f, 0x1.9a8c34p-6f, -0x1.4e010ap-8f},  {0x1.b42ee4p-5f, 0x1.8e677ep-6f, -0x1.b4a14ap-11f},
        {0x1.8ebd6p-7f, 0x1.593064p-7f, 0x1.3900d2p-8f},     {0x1.8072bep-5f, 0x1.158daep-8f, 0x1.03615ap-9f},
        {-0x1.b45e92p-8f, -0x1.c3bacep-6f, 0x1.5431d4p-10f}, {0x1.f0617ap-5f, -0x1.4f1dfcp-7f, -0x1.762e54p-7f},
        {0x1.619fc8p-5f, -0x1.68da6ep-6f, 0x1.9a242ap-10f},  {-0x1.33279ap-5f, -0x1.59c4cep-7f, 0x1.646442p-7f}};
    fe_world *world = new_world();
    fe_body_def d;
    fe_body_def_init(&d, sizeof d);
    d.type = FE_BODY_STATIC;
    d.transform = (fe_transform){{1e6, -1e6, 0x1.317a18227427ap+2},
                                 {-0x1.25f2fp-1f, -0x1.117c88p-4f, 0x1.4dd364p-1f, 0x1.f68336p-2f}};
    fe_body body;
    OK(fe_body_create(world, &d, &body));
    fe_geometry large = hull_of(world, still, (int32_t)(sizeof still / sizeof *still)),
                small = hull_of(world, moving, (int32_t)(sizeof moving / sizeof *moving));
    add_shape(world, body, &large);
    const fe_transform start = {{0x1.e847fe0bbebd1p+19, -0x1.e8480b3584b34p+19, 0x1.2f01bacdfd5d2p+2},
                                {0x1.ac1914p-1f, -0x1.8feb6cp-1f, 0x1.59a3f6p-1f, 0x1.e0562ep-2f}};
    const fe_dvec3 way = {-0x1.efea2a9ef3205p-4, 0x1.a43138a1c09d1p-4, 0x1.1079c0211f3e7p-6};
    double first = 0;
    for (int32_t i = 0; i < WAYS; ++i) {
        double longer = 1.0 + (double)i / WAYS;
        fe_dvec3 along = {longer * way.x, longer * way.y, longer * way.z};
        fe_hit hit;
        HIT(fe_world_sweep(world, &small, &start, &along, NULL, &hit));
        if (i == 0) first = hit.fraction;
        // of a way of 16 cm: a micrometre, which a stop may be before the body
        FE_WITHIN(hit.fraction * longer - first, -1e-5, 1e-5);
    }
    OK(fe_world_destroy(world));
}

int main(int argc, char **argv)
{
    if (argc > 1) cases = atoi(argv[1]);
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_sweep_stops_before_the_body),
                                       cmocka_unit_test(a_tall_box_stops_beside_a_tall_cylinder),
                                       cmocka_unit_test(a_hull_meets_a_hull_however_long_its_way)};
    return cmocka_run_group_tests_name("sweep_solids", tests, NULL, NULL);
}
