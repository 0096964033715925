// Hulls: one with the points of a box is a box; they stand, bridge, pile up and stop as fast as other forms; their
// assets live as long as their shapes.
#include "scenes/mechanics.h"

#include "support/hull_clouds.h"
#include "meshes.h"

#include <stdlib.h>

// ---- hulls ---------------------------------------------------------------------------------------------------------
static fe_asset asset_of(fe_store *store, const float (*points)[3], int count)
{
    fe_hull_def def;
    fe_asset asset = 0;
    fe_hull_def_init(&def, sizeof def);
    def.points = points[0], def.point_count = count;
    MUST(fe_hull_create(store, &def, &asset));
    return asset;
}

static fe_geometry hull(const scene *s, const float (*points)[3], int count)
{
    fe_geometry form;
    fe_geometry_hull(&form, asset_of(world_store(s->world), points, count));
    return form;
}

static fe_geometry hull_box_at(const scene *s, vec half, vec centre)
{
    float points[8][3];
    for (int i = 0; i < 8; ++i) {
        points[i][0] = (float)(centre.x + (i & 1 ? half.x : -half.x));
        points[i][1] = (float)(centre.y + (i & 2 ? half.y : -half.y));
        points[i][2] = (float)(centre.z + (i & 4 ? half.z : -half.z));
    }
    return hull(s, (const float(*)[3])points, 8);
}

// a box as itself, or as its eight points
static fe_geometry block(const scene *s, int as_hull, double x, double y, double z)
{
    return as_hull ? hull_box_at(s, v3(x, y, z), v3(0, 0, 0)) : box(x, y, z);
}

enum { ROCK_POINTS = 32 };
static fe_geometry rock(const scene *s, uint64_t seed, double radius)
{
    float points[ROCK_POINTS][3];
    for (int i = 0; i < ROCK_POINTS; ++i) {
        vec d = cloud_direction(&seed);
        points[i][0] = (float)(radius * d.x), points[i][1] = (float)(radius * d.y),
        points[i][2] = (float)(radius * d.z);
    }
    return hull(s, (const float(*)[3])points, ROCK_POINTS);
}

// ---- what they weigh -----------------------------------------------------------------------------------------------
static void a_hull_weighs_what_its_points_enclose(void **state)
{
    scene s = scene_begin(state);
    const double part = 1e-5;
    fe_body a = add_dynamic(&s, box(0.3, 0.5, 0.7), v3(0, 0, 0), UNTURNED, friction(0.5), WATER),
            b = add_dynamic(&s, hull_box_at(&s, v3(0.3, 0.5, 0.7), v3(1, 2, 3)), v3(9, 0, 0), UNTURNED, friction(0.5),
                            WATER);
    fe_mass_data box_data = mass_data_of(&s, a), hull_data = mass_data_of(&s, b);
    FE_NEAR(hull_data.mass, box_data.mass, part * box_data.mass);
    FE_NEAR(length(minus(widen(hull_data.centre), v3(1, 2, 3))), 0, part);
    double sum = box_data.inertia.x + box_data.inertia.y + box_data.inertia.z;
    FE_NEAR(hull_data.inertia.x + hull_data.inertia.y + hull_data.inertia.z, sum, part * sum);
    // about an axis of the body: spin and angular momentum go the same way in both
    for (int k = 0; k < 3; ++k) {
        vec axis = v3(k == 0, k == 1, k == 2), torque = times(1000, axis);
        set_velocity(&s, a, v3(0, 0, 0), v3(0, 0, 0)), set_velocity(&s, b, v3(0, 0, 0), v3(0, 0, 0));
        add_torque(&s, a, torque), add_torque(&s, b, torque);
        run(&s, 1);
        FE_NEAR(length(minus(spin(&s, a), spin(&s, b))), 0, 1e-4 * length(spin(&s, a)));
    }
    // regular tetrahedron of edge a: m a^2 / 20 about any axis, a^3 / (6 sqrt 2)
    const float tetrahedron[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    fe_body t = add_dynamic(&s, hull(&s, tetrahedron, 4), v3(20, 0, 0), UNTURNED, friction(0.5), WATER);
    fe_mass_data data = mass_data_of(&s, t);
    double edge = sqrt(8), mass = (double)WATER * edge * edge * edge / (6 * sqrt(2));
    FE_NEAR(data.mass, mass, part * mass);
    FE_NEAR(data.inertia.x, mass * edge * edge / 20, part * mass);
    FE_NEAR(data.inertia.y, mass * edge * edge / 20, part * mass);
    FE_NEAR(data.inertia.z, mass * edge * edge / 20, part * mass);
    scene_end(&s);
}

// ---- a hull of a box is a box --------------------------------------------------------------------------------------
enum { MOST_BODIES = 64 };
typedef struct ends {
    int count;
    vec at[MOST_BODIES];
    double tilt[MOST_BODIES];
} ends;

static void note(ends *e, const scene *s, fe_body body)
{
    e->at[e->count] = position(s, body);
    e->tilt[e->count++] = tilt(s, body);
}

typedef void build(scene *s, int as_hull, ends *e);

static void pyramid(scene *s, int as_hull, ends *e)
{
    fe_body body[MOST_BODIES];
    int count = 0;
    add_ground(s, friction(0.6));
    fe_geometry form = block(s, as_hull, 0.5, 0.5, 0.5);
    for (int row = 0; row < 10; ++row)
        for (int i = 0; i < 10 - row; ++i)
            body[count++] =
                add_dynamic(s, form, v3(1.05 * (i + 0.5 * row), 0.5 + row, 0), UNTURNED, friction(0.6), WATER);
    run(s, 240);
    for (int i = 0; i < count; ++i) note(e, s, body[i]);
}

static void on_slope(scene *s, int as_hull, ends *e)
{
    const double angle = 20 * DEGREES;
    add_slope(s, angle, friction(0.6));
    fe_geometry form = block(s, as_hull, 0.5, 0.5, 0.5);
    fe_body holds = add_dynamic(s, form, times(0.5, slope_normal(angle)), slope_turn(angle), friction(0.6), WATER),
            slides = add_dynamic(s, form, plus(times(0.5, slope_normal(angle)), v3(0, 0, 3)), slope_turn(angle),
                                 friction(0), WATER);
    run(s, 60);
    note(e, s, holds), note(e, s, slides);
}

static void stack_of_ten(scene *s, int as_hull, ends *e)
{
    fe_body body[10];
    add_static(s, block(s, as_hull, 5, 0.5, 5), v3(0, -0.5, 0), UNTURNED, friction(0.6));
    fe_geometry form = block(s, as_hull, 0.5, 0.5, 0.5);
    for (int i = 0; i < 10; ++i)
        body[i] = add_dynamic(s, form, v3(0.01 * (i & 1), 0.5 + i, 0), UNTURNED, friction(0.6), WATER);
    run(s, 300);
    for (int i = 0; i < 10; ++i) note(e, s, body[i]);
}

static void drop_on_edge(scene *s, int as_hull, ends *e)
{
    add_ground(s, friction(0.6));
    fe_body body =
        add_dynamic(s, block(s, as_hull, 0.5, 0.5, 0.5), v3(0, 1.2, 0), turned(v3(0, 0, 1), 0.6), friction(0.6), WATER);
    run(s, 240);
    note(e, s, body);
}

static void ends_as_boxes(void **state, build *make)
{
    ends of[2] = {{0}};
    for (int as_hull = 0; as_hull < 2; ++as_hull) {
        scene s = scene_begin(state);
        make(&s, as_hull, of + as_hull);
        scene_end(&s);
    }
    for (int i = 0; i < of[0].count; ++i) {
        FE_NEAR(length(minus(of[1].at[i], of[0].at[i])), 0, 1e-3);
        FE_NEAR(of[1].tilt[i], of[0].tilt[i], 1e-3);
    }
}

static void a_pyramid_stands_as_of_boxes(void **state) { ends_as_boxes(state, pyramid); }
static void a_slope_holds_it_as_a_box(void **state) { ends_as_boxes(state, on_slope); }
static void ten_stand_as_boxes_do(void **state) { ends_as_boxes(state, stack_of_ten); }
static void it_falls_from_its_edge_as_a_box(void **state) { ends_as_boxes(state, drop_on_edge); }

// What is given far from its frame's origin is the same body there.
static void where_the_points_are_does_not_matter(void **state)
{
    scene s = scene_begin(state);
    add_static(&s, box(20, 0.5, 20), v3(0, -0.5, 0), UNTURNED, friction(0.6));
    fe_body near = add_dynamic(&s, hull_box_at(&s, v3(0.5, 0.5, 0.5), v3(0, 0, 0)), v3(0, 0.6, 0), UNTURNED,
                               friction(0.6), WATER),
            far = add_dynamic(&s, hull_box_at(&s, v3(0.5, 0.5, 0.5), v3(64, -32, 16)), v3(-58, 32.6, -16), UNTURNED,
                              friction(0.6), WATER);
    run(&s, 120);
    vec at = plus(position(&s, far), v3(64, -32, 16));
    FE_NEAR(length(minus(at, plus(position(&s, near), v3(6, 0, 0)))), 0, 1e-3);
    scene_end(&s);
}

// Far from the middle of a wide ground: a float of its coordinates is 6e-5 m coarse.
static void a_wide_ground_bears_it_anywhere(void **state)
{
    for (int as_hull = 0; as_hull < 2; ++as_hull) {
        scene s = scene_begin(state);
        add_static(&s, block(&s, as_hull, 1000, 1, 1000), v3(0, -1, 0), UNTURNED, friction(0.6));
        fe_body body = add_dynamic(&s, block(&s, 1, 0.5, 0.5, 0.5), v3(700, 0.5, -900), turned(v3(0, 1, 0), 0.4),
                                   friction(0.6), WATER);
        run(&s, 300);
        FE_NEAR(length(minus(position(&s, body), v3(700, 0.5, -900))), 0, 1e-3);
        FE_TRUE(length(velocity(&s, body)) < 1e-3 && length(spin(&s, body)) < 1e-3);
        scene_end(&s);
    }
}

// ---- arch ----------------------------------------------------------------------------------------------------------
// Half a circle of 17 voussoirs between two abutments
static void an_arch_bears_itself(void **state)
{
    enum { STONES = 17 };
    const double inner = 4, outer = 5, half_width = 0.5;
    scene s = scene_begin(state);
    add_ground(&s, friction(0.8));
    fe_body stone[STONES], abutment[2];
    for (int side = 0; side < 2; ++side)
        abutment[side] = add_dynamic(&s, box(1, 1, 1), v3(side ? 4.5 : -4.5, 1, 0), UNTURNED, friction(0.8), 2 * WATER);
    for (int i = 0; i < STONES; ++i) {
        float points[8][3];
        double middle = PI * (i + 0.5) / STONES, r = 0.5 * (inner + outer);
        vec centre = v3(-r * cos(middle), 2 + r * sin(middle), 0);
        for (int k = 0; k < 8; ++k) {
            double angle = PI * (i + (k & 1)) / STONES, at = k & 2 ? outer : inner;
            points[k][0] = (float)(-at * cos(angle) - centre.x), points[k][1] = (float)(2 + at * sin(angle) - centre.y);
            points[k][2] = (float)(k & 4 ? half_width : -half_width);
        }
        stone[i] = add_dynamic(&s, hull(&s, (const float(*)[3])points, 8), centre, UNTURNED, friction(0.8), 2 * WATER);
    }
    double key = position(&s, stone[STONES / 2]).y;
    run(&s, 20 * 60);
    FE_WITHIN(position(&s, stone[STONES / 2]).y, key - 0.1, key + 0.01);
    for (int side = 0; side < 2; ++side) FE_NEAR(position(&s, abutment[side]).x, side ? 4.5 : -4.5, 0.05);
    scene_end(&s);
}

// ---- pile ----------------------------------------------------------------------------------------------------------
typedef struct solid {
    int32_t count;
    vec at[64];
} solid;

// its vertices, in the scene
static solid solid_of(const scene *s, fe_body body)
{
    fe_shape shape;
    fe_geometry form = {.struct_size = sizeof form};
    fe_vec3 points[64];
    solid out;
    FE_NEAR(fe_body_get_shapes(s->world, body, &shape, 1), 1, 0);
    MUST(fe_shape_get_geometry(s->world, shape, &form));
    out.count = fe_hull_get_vertices(world_store(s->world), form.asset, points, 0, 64);
    FE_WITHIN(out.count, 4, 64);
    for (int32_t i = 0; i < out.count; ++i) out.at[i] = plus(position(s, body), axis_of(s, body, widen(points[i])));
    return out;
}

// How far one has to move along n to be free of the other: no less than the overlap
static double overlap_along(const solid *a, const solid *b, vec n)
{
    double most = -1e9, least = 1e9;
    for (int32_t i = 0; i < a->count; ++i) most = fmax(most, dot(n, a->at[i]));
    for (int32_t i = 0; i < b->count; ++i) least = fmin(least, dot(n, b->at[i]));
    return most - least;
}

// The least found around a direction: the normal of a manifold that moved a little since it was made
static double overlap_around(const solid *a, const solid *b, vec n)
{
    uint64_t random = 1;
    double least = overlap_along(a, b, n);
    for (double size = 0.3; size > 1e-3; size *= 0.97) {
        vec m = plus(n, times(size, cloud_direction(&random)));
        m = times(1 / length(m), m);
        double overlap = overlap_along(a, b, m);
        if (overlap < least) least = overlap, n = m;
    }
    return least;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

static void a_pile_of_rocks_rests(void **state)
{
    enum { ROCKS = 60, MOST = 2000 };
    const double radius = 0.4;
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    for (int k = 0; k < 4; ++k)
        add_static(&s, box(k < 2 ? 0.5 : 2.5, 3, k < 2 ? 2.5 : 0.5),
                   k < 2 ? v3(k ? 2 : -2, 3, 0) : v3(0, 3, k > 2 ? 2 : -2), UNTURNED, friction(0.6));
    fe_geometry form = rock(&s, 7, radius);
    fe_body body[ROCKS];
    for (int i = 0; i < ROCKS; ++i)
        body[i] = add_dynamic(&s, form, v3(0.9 * (i % 3 - 1), 0.6 + 0.9 * (i / 9), 0.9 * (i / 3 % 3 - 1)),
                              turned(v3(1, i % 5, i % 7), i), friction(0.6), WATER);
    run(&s, 500);
    static double overlaps[MOST];
    int count = 0;
    for (int i = 0; i < ROCKS; ++i) {
        vec at = position(&s, body[i]);
        FE_TRUE(fabs(at.x) < 1.5 && fabs(at.z) < 1.5 && at.y > 0 && length(velocity(&s, body[i])) < 0.05);
        solid a = solid_of(&s, body[i]);
        for (int32_t k = 0; k < a.count; ++k) FE_TRUE(a.at[k].y > -0.01);
        fe_contact contacts[MOST_CONTACTS];
        int32_t touched = fe_body_get_contacts(s.world, body[i], contacts, sizeof *contacts, MOST_CONTACTS);
        for (int32_t c = 0; c < touched; ++c)
            for (int j = 0; j < ROCKS; ++j) {
                if (j == i || contacts[c].body_a != body[i] || contacts[c].body_b != body[j]) continue;
                solid b = solid_of(&s, body[j]);
                overlaps[count++] = overlap_around(&a, &b, from_world(&s, widen(contacts[c].normal)));
                FE_TRUE(count < MOST);
            }
    }
    FE_TRUE(count > ROCKS);
    qsort(overlaps, (size_t)count, sizeof *overlaps, ascending);
    FE_WITHIN(overlaps[count * 99 / 100], -1, 2 * LINEAR_SLOP);
    scene_end(&s);
}

// ---- needles -------------------------------------------------------------------------------------------------------
enum { HEAPS = 32, NEEDLES = 12 };

// They may rock on, but on the springs that bear them: a needle that another bears overlaps it by g / w^2,
// w = 2 pi contact_hertz, 0.28 mm. What rocks falls by no more than that, in the mean of many heaps: m g (g / w^2).
static void needles_come_to_rest(void **state)
{
    const float points[6][3] = {{-0.5f, 0, 0},      {0.5f, 0, 0},        {0, 0.01f, 0},
                                {0, -0.01f, 0.01f}, {0, -0.01f, -0.01f}, {0.1f, 0.01f, 0}};
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    fe_geometry form = hull(&s, points, 6);
    fe_body body[HEAPS * NEEDLES];
    for (int k = 0; k < HEAPS * NEEDLES; ++k) {
        int heap = k / NEEDLES, i = k % NEEDLES;
        body[k] = add_dynamic(&s, form, v3(20 * heap, 0.5 + 0.1 * i, 0), turned(v3(i % 3, 1, i % 2), k), friction(0.6),
                              WATER);
    }
    run(&s, 600);
    for (int k = 0; k < HEAPS * NEEDLES; ++k) {
        vec at = position(&s, body[k]);
        FE_TRUE(at.y > 0 && at.y < 0.3 && fabs(at.x - 20 * (k / NEEDLES)) < 5 && fabs(at.z) < 5);
    }
    double weights = HEAPS * NEEDLES * mass_of(&s, body[0]) * G;
    FE_WITHIN(totals_of(&s, body, HEAPS * NEEDLES).kinetic, 0, weights * sink(G, 1, 0));
    scene_end(&s);
}

// ---- with every other form -----------------------------------------------------------------------------------------
static double nothing_or_bump(double x, double z) { return 0.2 * sin(x) * cos(z); }

static void every_form_rests_on_a_hull_and_a_hull_on_every_form(void **state)
{
    scene s = scene_begin(state);
    fe_geometry can, hat;
    fe_geometry_cylinder(&can, 0.3f, 0.3f);
    fe_geometry_cone(&hat, 0.3f, 0.3f);
    fe_geometry cube = hull_box_at(&s, v3(0.3, 0.3, 0.3), v3(0, 0, 0)),
                plate = hull_box_at(&s, v3(1, 0.5, 1), v3(0, 0, 0));
    fe_geometry forms[] = {sphere(0.3), capsule(0.2, 0.3), box(0.3, 0.3, 0.3), can, hat, cube};
    fe_body on[6], under[6];
    for (int i = 0; i < 6; ++i) {
        fe_quat lying = i == 1 ? turned(v3(0, 0, 1), PI / 2) : UNTURNED;
        add_static(&s, plate, v3(4 * i, -0.5, 0), UNTURNED, friction(0.6));
        on[i] = add_dynamic(&s, forms[i], v3(4 * i, 0.4, 0), lying, friction(0.6), WATER);
        fe_geometry wide = forms[i];
        wide.radius *= 4, wide.half_extents = fe_make_vec3(1, 0.3f, 1);
        add_static(&s, i == 5 ? plate : wide, v3(4 * i, i == 5 ? -0.5 : 0, 9), UNTURNED, friction(0.6));
        under[i] = add_dynamic(&s, cube, v3(4 * i, 2, 9), UNTURNED, friction(0.6), WATER);
    }
    run(&s, 300);
    for (int i = 0; i < 6; ++i) {
        FE_NEAR(position(&s, on[i]).y, 0.3, LINEAR_SLOP);
        FE_TRUE(length(velocity(&s, on[i])) < 0.01);
    }
    const double top[6] = {1.2, 1.4, 0.3, 0.3, -1, 0}; // a cube does not stand on a cone's tip
    for (int i = 0; i < 6; ++i)
        if (top[i] >= 0) FE_NEAR(position(&s, under[i]).y, top[i] + 0.3, 2 * LINEAR_SLOP);
    scene_end(&s);
}

static void a_heightfield_holds_hulls(void **state)
{
    enum { ROCKS = 30 };
    scene s = scene_begin(state);
    add_field(&s, 40, 0.5, -10, -10, level, friction(0.6));
    fe_body body[ROCKS], cube = add_dynamic(&s, hull_box_at(&s, v3(0.5, 0.5, 0.5), v3(3, 3, 3)), v3(-3, -2, -3),
                                            UNTURNED, friction(0.6), WATER);
    fe_geometry form = rock(&s, 3, 0.4);
    for (int i = 0; i < ROCKS; ++i)
        body[i] = add_dynamic(&s, form, v3(1.2 * (i % 6) - 4, 1 + 0.2 * i, 1.2 * (i / 6) + 1), turned(v3(1, i, 2), i),
                              friction(0.6), WATER);
    run(&s, 400);
    vec middle = plus(position(&s, cube), axis_of(&s, cube, v3(3, 3, 3)));
    FE_NEAR(length(minus(middle, v3(0, 0.5, 0))), 0, LINEAR_SLOP);
    for (int i = 0; i < ROCKS; ++i) {
        solid a = solid_of(&s, body[i]);
        double low = 1;
        for (int32_t k = 0; k < a.count; ++k) low = fmin(low, a.at[k].y);
        FE_NEAR(low, 0, 2 * LINEAR_SLOP);
    }
    scene_end(&s);
}

static void hills_hold_rocks(void **state)
{
    enum { ROCKS = 30 };
    scene s = scene_begin(state);
    add_field(&s, 60, 0.5, -15, -15, nothing_or_bump, friction(0.9));
    fe_body body[ROCKS];
    for (int i = 0; i < ROCKS; ++i)
        body[i] = add_dynamic(&s, rock(&s, 3 + (uint64_t)i, 0.4), v3(1.2 * (i % 6) - 4, 1 + 0.2 * i, 1.2 * (i / 6)),
                              turned(v3(1, i, 2), i), friction(0.9), WATER);
    run(&s, 300);
    for (int i = 0; i < ROCKS; ++i) {
        vec at = position(&s, body[i]);
        FE_TRUE(at.y > nothing_or_bump(at.x, at.z));
    }
    scene_end(&s);
}

static void nothing_thin_is_passed_through(void **state)
{
    enum { ROCKS = 20 };
    scene s = scene_begin(state);
    add_ground(&s, friction(0.5));
    // friction turns nobody aside by more than 0.5 x 193 m/s: in half a second nobody gets round it
    add_static(&s, hull_box_at(&s, v3(0.02, 10, 52), v3(0, 0, 0)), v3(0, 10, 0), UNTURNED, friction(0.5));
    fe_body body[ROCKS];
    for (int i = 0; i < ROCKS; ++i) {
        body[i] = add_dynamic(&s, rock(&s, 11 + (uint64_t)i, 0.1), v3(-3 - 0.37 * i, 1 + 0.4 * i, i % 5 - 2.0),
                              UNTURNED, friction(0.5), WATER);
        set_velocity(&s, body[i], v3(60 + 7 * i, 0, 0), v3(0, i, 3));
    }
    run(&s, 30);
    for (int i = 0; i < ROCKS; ++i) FE_TRUE(position(&s, body[i]).x < 0);
    scene_end(&s);
}

// ---- queries -------------------------------------------------------------------------------------------------------
static void queries_see_a_box(void **state)
{
    enum { TRIES = 500 };
    (void)state;
    uint64_t random = 5;
    const double exact = 1e-6;
    for (int round = 0; round < 8; ++round) {
        scene s[2] = {scene_begin(NULL), scene_begin(NULL)};
        vec half = v3(0.3 + 0.2 * round, 0.5, 0.9), at = times(3, cloud_vector(&random));
        fe_quat q = turned(cloud_direction(&random), round);
        for (int k = 0; k < 2; ++k) add_static(&s[k], block(&s[k], k, half.x, half.y, half.z), at, q, friction(0.5));
        for (int i = 0; i < TRIES; ++i) {
            vec from = plus(at, times(3, cloud_vector(&random))), way = times(6, cloud_direction(&random));
            fe_hit a, b;
            fe_closest ca, cb;
            int32_t hit = fe_world_raycast(s[0].world, &from, &way, NULL, &a);
            FE_NEAR(fe_world_raycast(s[1].world, &from, &way, NULL, &b), hit, 0);
            if (hit) {
                FE_NEAR(b.fraction, a.fraction, exact);
                FE_NEAR(length(minus(widen(b.normal), widen(a.normal))), 0, exact);
                FE_TRUE(b.flags == a.flags && b.triangle >= 0 && b.triangle < 6);
                FE_NEAR(b.depth, a.depth, exact);
            }
            FE_NEAR(fe_world_closest_point(s[0].world, &from, 100.0, NULL, &ca), 1, 0);
            FE_NEAR(fe_world_closest_point(s[1].world, &from, 100.0, NULL, &cb), 1, 0);
            FE_NEAR(cb.distance, ca.distance, exact);
            FE_NEAR(length(minus(cb.point, ca.point)), 0, 10 * exact);

            fe_geometry form = i % 3 == 0 ? sphere(0.3) : i % 3 == 1 ? capsule(0.4, 0.2) : box(0.2, 0.3, 0.4);
            fe_transform start = {from, turned(cloud_direction(&random), i)};
            hit = fe_world_sweep(s[0].world, &form, &start, &way, NULL, &a);
            FE_NEAR(fe_world_sweep(s[1].world, &form, &start, &way, NULL, &b), hit, 0);
            if (hit) {
                FE_NEAR(b.fraction, a.fraction, 1e-4);
                FE_NEAR(b.depth, a.depth, 1e-4);
            }
            FE_NEAR(fe_world_overlap_any(s[1].world, &form, &start, NULL),
                    fe_world_overlap_any(s[0].world, &form, &start, NULL), 0);
        }
        scene_end(&s[0]), scene_end(&s[1]);
    }
}

// A ground of every form: what a hull that moves may meet
static void every_ground(scene *s)
{
    fe_quat q = turned(v3(1, 2, 3), 0.7);
    add_static(s, sphere(0.7), v3(-3, 1, 0), q, friction(0.5));
    add_static(s, capsule(0.5, 0.4), v3(3, 1, 0), q, friction(0.5));
    add_static(s, box(0.6, 0.4, 0.5), v3(0, 1, -3), q, friction(0.5));
    add_static(s, rock(s, 9, 0.8), v3(0, 1, 3), q, friction(0.5));
    add_mesh(s, 16, 0.5, -4, -4, 0.3, level, friction(0.5));
}

// The same box as a box, as a hull, and as a hull whose origin is 2 m off: all that moves is met alike. A box before a
// box stops within 0.1 mm, the ways are 8 m long.
static void a_hull_moves_as_a_box(void **state)
{
    enum { TRIES = 2000 };
    scene s = scene_begin(state);
    every_ground(&s);
    vec half = v3(0.3, 0.2, 0.5), aside = v3(1.2, -1.0, 1.25);
    fe_geometry forms[3] = {box(half.x, half.y, half.z), hull_box_at(&s, half, v3(0, 0, 0)),
                            hull_box_at(&s, half, aside)};
    uint64_t random = 5;
    int hits = 0, overlaps = 0;
    for (int i = 0; i < TRIES; ++i) {
        vec from = plus(v3(0, 2, 0), times(4, cloud_vector(&random))), way = times(8, cloud_direction(&random));
        fe_quat q = turned(cloud_direction(&random), i);
        fe_transform start = {from, q}, off = {minus(from, rotate(q, aside)), q};
        fe_hit a;
        int32_t hit = fe_world_sweep(s.world, &forms[0], &start, &way, NULL, &a),
                over = fe_world_overlap_any(s.world, &forms[0], &start, NULL);
        hits += hit == 1, overlaps += over == 1;
        for (int k = 1; k < 3; ++k) {
            fe_hit b;
            FE_NEAR(fe_world_sweep(s.world, &forms[k], k == 1 ? &start : &off, &way, NULL, &b), hit, 0);
            FE_NEAR(fe_world_overlap_any(s.world, &forms[k], k == 1 ? &start : &off, NULL), over, 0);
            if (!hit) continue;
            FE_TRUE(b.flags == a.flags && (b.flags || b.body == a.body));
            FE_NEAR(b.fraction, a.fraction, 1e-4 / 8 + 1e-7);
        }
    }
    FE_TRUE(hits > TRIES / 4 && overlaps > TRIES / 20);
    scene_end(&s);
}

static void what_is_no_hull_is_not_moved_as_one(void **state)
{
    scene s = scene_begin(state), other = scene_begin(state);
    fe_transform at = fe_make_transform(0, 3, 0);
    fe_geometry foreign = hull_box_at(&other, v3(1, 1, 1), v3(0, 0, 0)),
                own = hull_box_at(&s, v3(1, 1, 1), v3(0, 0, 0)), none = own;
    FE_TRUE(fe_world_overlap_any(s.world, &own, &at, NULL) == 0);
    FE_TRUE(fe_world_overlap_any(s.world, &foreign, &at, NULL) == FE_ERROR_STALE);
    none.asset = 0;
    FE_TRUE(fe_world_overlap_any(s.world, &none, &at, NULL) == FE_ERROR_STALE);
    MUST(fe_asset_destroy(world_store(s.world), own.asset));
    FE_TRUE(fe_world_overlap_any(s.world, &own, &at, NULL) == FE_ERROR_STALE);
    scene_end(&s), scene_end(&other);
}

// ---- assets --------------------------------------------------------------------------------------------------------
static void a_shape_keeps_its_hull(void **state)
{
    scene s = scene_begin(state);
    fe_store_def def;
    fe_store_def_init(&def, sizeof def);
    fe_store *foreign;
    MUST(fe_store_create(&def, &foreign));
    const float points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    fe_asset there = asset_of(foreign, points, 4);
    fe_geometry form = hull_box_at(&s, v3(0.5, 0.5, 0.5), v3(0, 0, 0)), other, got = {.struct_size = sizeof got};
    add_ground(&s, friction(0.5));
    fe_body body = add_dynamic(&s, form, v3(0, 0.5, 0), UNTURNED, friction(0.5), WATER);
    fe_shape shape;
    FE_NEAR(fe_body_get_shapes(s.world, body, &shape, 1), 1, 0);
    MUST(fe_asset_destroy(world_store(s.world), form.asset));
    run(&s, 60);
    FE_NEAR(position(&s, body).y, 0.5, LINEAR_SLOP);
    MUST(fe_shape_get_geometry(s.world, shape, &got));
    FE_TRUE(got.type == FE_GEOMETRY_HULL && got.asset == form.asset && got.radius == 0);
    FE_NEAR(fe_shape_set_geometry(s.world, shape, &form), FE_ERROR_STALE, 0); // none new of what is gone
    fe_geometry_hull(&other, there);
    FE_TRUE(fe_shape_set_geometry(s.world, shape, &other) < 0); // another store's
    fe_geometry_heightfield(&other, make_field(&s, 2, 1, 0, 0, level));
    other.type = FE_GEOMETRY_HULL;
    FE_NEAR(fe_shape_set_geometry(s.world, shape, &other), FE_ERROR_KIND, 0);
    other = box(0.4, 0.4, 0.4);
    MUST(fe_shape_set_geometry(s.world, shape, &other)); // its last user lets go
    fe_hull_info info;
    fe_hull_info_init(&info, sizeof info);
    FE_NEAR(fe_hull_get_info(world_store(s.world), form.asset, &info), FE_ERROR_STALE, 0);
    other = rock(&s, 1, 0.5);
    MUST(fe_shape_set_geometry(s.world, shape, &other));
    run(&s, 60);
    FE_TRUE(position(&s, body).y > 0.2);
    scene_end(&s);
    MUST(fe_store_destroy(foreign));
}

// ---- one answer ----------------------------------------------------------------------------------------------------
static void pile_with(int32_t simd, int32_t workers, uint32_t hash[2])
{
    fe_world_def def;
    scene s = {NULL, UNTURNED, 4, STEP / 4};
    fe_world_def_init(&def, sizeof def);
    def.substeps = 4, def.simd = simd, def.worker_count = workers;
    if (fe_world_create(&def, &s.world) == FE_ERROR_UNSUPPORTED) return;
    set_gravity(&s, v3(0, -G, 0));
    add_ground(&s, friction(0.6));
    add_field(&s, 10, 1, -5, -5, nothing_or_bump, friction(0.6));
    fe_geometry forms[5] = {rock(&s, 1, 0.4), rock(&s, 2, 0.5), box(0.3, 0.3, 0.3), capsule(0.3, 0.2), sphere(0.3)};
    for (int i = 0; i < 80; ++i)
        add_dynamic(&s, forms[i % 5], v3(i % 4 - 2, 1 + 0.4 * (i / 4), i / 4 % 4 - 2), turned(v3(1, i, 3), i),
                    friction(0.6), WATER);
    run(&s, 120);
    uint32_t now[2];
    MUST(fe_world_hash(s.world, now));
    if (!hash[0] && !hash[1]) hash[0] = now[0], hash[1] = now[1];
    FE_TRUE(hash[0] == now[0] && hash[1] == now[1]);
    scene_end(&s);
}

static void every_machine_part_gives_the_same_bits(void **state)
{
    (void)state;
    uint32_t hash[2] = {0, 0};
    const int32_t workers[] = {1, 2, 3, 8};
    for (int i = 0; i < 4; ++i) pile_with(FE_SIMD_AUTO, workers[i], hash);
    for (int32_t simd = FE_SIMD_AUTO + 1; simd <= FE_SIMD_AVX512; ++simd) pile_with(simd, 2, hash);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_hull_weighs_what_its_points_enclose),
        TEST(a_pyramid_stands_as_of_boxes),
        EVERY_WAY_UP(a_slope_holds_it_as_a_box),
        TEST(ten_stand_as_boxes_do),
        EVERY_WAY_UP(it_falls_from_its_edge_as_a_box),
        TEST(where_the_points_are_does_not_matter),
        TEST(a_wide_ground_bears_it_anywhere),
        TEST(an_arch_bears_itself),
        WITH_4_SUBSTEPS(an_arch_bears_itself),
        TEST(a_pile_of_rocks_rests),
        WITH_4_SUBSTEPS(a_pile_of_rocks_rests),
        TEST(needles_come_to_rest),
        WITH_4_SUBSTEPS(needles_come_to_rest),
        TEST(every_form_rests_on_a_hull_and_a_hull_on_every_form),
        TEST(a_heightfield_holds_hulls),
        TEST(hills_hold_rocks),
        TEST(nothing_thin_is_passed_through),
        TEST(queries_see_a_box),
        TEST(a_hull_moves_as_a_box),
        TEST(what_is_no_hull_is_not_moved_as_one),
        TEST(a_shape_keeps_its_hull),
        TEST(every_machine_part_gives_the_same_bits),
    };
    return cmocka_run_group_tests_name("hulls", tests, NULL, NULL);
}
