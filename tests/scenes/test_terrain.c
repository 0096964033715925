// Heightfields and flush boxes carry what rolls, slides and rests on them as a plane does; edges that are not there are
// not felt.
#include "scenes/mechanics.h"
#include "scenes/terrain.h"

#include <string.h>

#if defined(FE_SANITIZED)
enum { HEADINGS = 2, RAIN = 60, NEEDLES = 8 };
#else
enum { HEADINGS = 16, RAIN = 500, NEEDLES = 32 };
#endif

// ---- rolling and sliding -------------------------------------------------------------------------------------------

enum { SPHERE, CAPSULE, BOX, FORMS };
typedef void make_ground(scene *s, fe_material m);

#define SPEED 10.0 // m/s

static fe_geometry form_of(int kind)
{
    return kind == SPHERE ? sphere(0.5) : kind == CAPSULE ? capsule(0.5, 0.3) : box(0.5, 0.25, 0.4);
}
static double height_of(int kind) { return kind == SPHERE ? 0.5 : kind == CAPSULE ? 0.3 : 0.25; }
// a box loses a good part of its speed in 5 s
static fe_material surface_of(int kind) { return friction(kind == BOX ? 0.1 : 0.5); }

static void plane_ground(scene *s, fe_material m) { add_ground(s, m); }
static void one_field(scene *s, fe_material m) { add_field(s, 100, 1.0, -50, -50, level, m); }
static void two_fields(scene *s, fe_material m)
{
    add_field(s, 100, 1.0, -100, -50, level, m);
    add_field(s, 100, 1.0, 0, -50, level, m);
}
// four whose corner is where every ride passes
static void four_fields(scene *s, fe_material m)
{
    for (int i = 0; i < 4; ++i) add_field(s, 50, 1.0, i % 2 ? 0 : -50, i / 2 ? 0 : -50, level, m);
}
static void row_of_boxes(scene *s, fe_material m)
{
    for (int i = 0; i < 20; ++i) add_static(s, box(1.25, 0.5, 2), v3(-23.75 + 2.5 * i, -0.5, 0), UNTURNED, m);
}

typedef struct ride {
    double least, most, kick, way; // height over rest, m; vertical speed, m/s; m
} ride;

// 10 m/s from `start` for so many steps; the first few, in which a body settles into its overlap, do not count
static ride go(void **state, make_ground *ground, int kind, double heading, vec start, int steps)
{
    enum { SETTLED = 5 };
    scene s = scene_begin(state);
    fe_material m = surface_of(kind);
    ground(&s, m);
    vec along = v3(cos(heading), 0, sin(heading)), axle = cross(v3(0, 1, 0), along);
    fe_quat turn = turned(v3(0, 1, 0), -heading);
    if (kind == CAPSULE) turn = compose(turn, turned(v3(1, 0, 0), PI / 2)); // lies across
    fe_body body = add_dynamic(&s, form_of(kind), plus(start, v3(0, height_of(kind), 0)), turn, m, WATER);
    set_velocity(&s, body, times(SPEED, along), kind == BOX ? v3(0, 0, 0) : times(SPEED / height_of(kind), axle));
    ride r = {1e9, -1e9, 0, 0};
    for (int i = 0; i < steps; ++i) {
        run(&s, 1);
        double y = position(&s, body).y - height_of(kind);
        if (i < SETTLED) continue;
        r.least = fmin(r.least, y), r.most = fmax(r.most, y), r.kick = fmax(r.kick, fabs(velocity(&s, body).y));
    }
    r.way = dot(minus(position(&s, body), start), along);
    scene_end(&s);
    return r;
}

static void as_on_a_plane(const ride *r, const ride *plane)
{
    FE_WITHIN(r->least, -LINEAR_SLOP, LINEAR_SLOP);
    FE_WITHIN(r->most, -LINEAR_SLOP, LINEAR_SLOP);
    FE_WITHIN(r->kick, 0, 0.05);
    FE_NEAR(r->way, plane->way, 1e-3 * plane->way);
}

// through the middle, 300 steps at every heading: along the grid, along and across the diagonals
static void rides_on(void **state, make_ground *ground)
{
    for (int kind = 0; kind < FORMS; ++kind) {
        ride plane = go(state, plane_ground, kind, 0, v3(0, 0, 0), 300);
        for (int i = 0; i < HEADINGS; ++i) {
            double heading = 2 * PI * i / HEADINGS + (HEADINGS < 16 ? PI / 4 : 0);
            ride r = go(state, ground, kind, heading, times(-20, v3(cos(heading), 0, sin(heading))), 300);
            as_on_a_plane(&r, &plane);
        }
    }
}

static void flat_fields_are_planes(void **state) { rides_on(state, one_field); }
static void two_fields_side_by_side_are_one(void **state) { rides_on(state, two_fields); }
static void four_fields_at_a_corner_are_one(void **state) { rides_on(state, four_fields); }

static void flush_boxes_are_one(void **state)
{
    for (int kind = 0; kind < FORMS; ++kind) {
        ride plane = go(state, plane_ground, kind, 0, v3(0, 0, 0), 280),
             r = go(state, row_of_boxes, kind, 0, v3(-24, 0, 0.1), 280);
        as_on_a_plane(&r, &plane);
        r = go(state, row_of_boxes, kind, PI, v3(24, 0, -0.3), 280);
        as_on_a_plane(&r, &plane);
    }
}

// 10 m/s over a slope of 20 degrees, at an angle to its fall line, through its middle after 2 s straight on; a plane or
// a field
static vec ride_on_slope(void **state, int kind, double heading, int field)
{
    enum { STEPS = 240, SETTLED = 5 };
    const double angle = 20 * DEGREES;
    scene s = scene_begin(state);
    fe_material m = surface_of(kind);
    if (field)
        place_field(&s, make_field(&s, 100, 1.0, 0, 0, level), rotate(slope_turn(angle), v3(-50, 0, -50)),
                    slope_turn(angle), m);
    else
        add_slope(&s, angle, m);
    vec n = slope_normal(angle);
    fe_quat turn = compose(slope_turn(angle), turned(v3(0, 1, 0), -heading));
    vec along = rotate(turn, v3(1, 0, 0)), axle = cross(n, along),
        start = plus(times(-20, along), times(height_of(kind), n));
    if (kind == CAPSULE) turn = compose(turn, turned(v3(1, 0, 0), PI / 2)); // lies across
    fe_body body = add_dynamic(&s, form_of(kind), start, turn, m, WATER);
    set_velocity(&s, body, times(SPEED, along), kind == BOX ? v3(0, 0, 0) : times(SPEED / height_of(kind), axle));
    for (int i = 0; i < STEPS; ++i) {
        run(&s, 1);
        if (i < SETTLED) continue;
        FE_NEAR(dot(position(&s, body), n), height_of(kind), LINEAR_SLOP);
        FE_NEAR(dot(velocity(&s, body), n), 0, 0.05);
    }
    vec way = minus(position(&s, body), start);
    scene_end(&s);
    return way;
}

// At every heading over a field turned by 20 degrees: as far as over a slope, nothing off it, and nothing aside, but
// for the capsule: its axis may point anywhere, nothing turns it back, and where it points it rolls.
static void tilted_fields_are_planes(void **state)
{
    for (int kind = 0; kind < FORMS; ++kind) {
        for (int i = 0; i < HEADINGS; ++i) {
            double heading = 2 * PI * i / HEADINGS + (HEADINGS < 16 ? PI / 4 : 0);
            vec plane = ride_on_slope(state, kind, heading, 0), field = ride_on_slope(state, kind, heading, 1);
            FE_NEAR(length(field), length(plane), 1e-3 * length(plane));
            if (kind != CAPSULE) FE_NEAR(length(minus(field, plane)), 0, 1e-3 * length(plane));
        }
    }
}

// B50: a body of a character, rotations locked, walks over many triangles at a constant speed: never a vertical speed
// above 0.5 m/s
static void characters_do_not_stumble(void **state)
{
    for (int i = 0; i < HEADINGS; ++i) {
        scene s = scene_begin(state);
        add_field(&s, 100, 0.4, -20, -20, level, friction(0));
        fe_body body = add_dynamic(&s, box(0.406, 0.914, 0.406), v3(0, 0.914, 0), UNTURNED, friction(0), WATER);
        MUST(fe_body_set_mass(s.world, body, 500));
        MUST(fe_body_set_locks(s.world, body, 0, FE_AXIS_X | FE_AXIS_Y | FE_AXIS_Z));
        set_gravity(&s, v3(0, -2.03 * G, 0));
        double heading = 2 * PI * i / HEADINGS;
        for (int step = 0; step < 180; ++step) {
            set_velocity(&s, body, v3(5 * cos(heading), velocity(&s, body).y, 5 * sin(heading)), v3(0, 0, 0));
            run(&s, 1);
            FE_WITHIN(fabs(velocity(&s, body).y), 0, 0.05);
        }
        scene_end(&s);
    }
}

// ---- rain ----------------------------------------------------------------------------------------------------------

static double wave(double x, double z) { return 0.5 * sin(2 * PI * 0.1 * x) * sin(2 * PI * 0.2 * z); }

static uint64_t seed;
static double draw(double low, double high)
{
    seed = seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * (double)(seed >> 11) * 0x1p-53;
}

// of the triangles, which lie below the wave's hills and above its valleys
static double ground_below(const scene *s, vec p)
{
    fe_query_filter filter;
    fe_query_filter_init(&filter, sizeof filter);
    filter.mask = 2;
    fe_hit hit;
    fe_dvec3 from = {p.x, 10, p.z}, way = {0, -20, 0};
    return fe_world_raycast(s->world, &from, &way, &filter, &hit) == 1 ? hit.point.y : -1e9;
}

static fe_material resisting(double rolling) { return (fe_material)SURFACE(0.5f, 0.5f, 0, (float)rolling, 0.02f); }

static fe_body add_wave(scene *s, fe_material m)
{
    fe_body field = add_field(s, 40, 1.0, -20, -20, wave, m);
    MUST(fe_body_set_filter(s->world, field, 2, UINT32_MAX, 0));
    return field;
}

static int awake_of(const scene *s, const fe_body *bodies, int count)
{
    int sum = 0;
    for (int i = 0; i < count; ++i) {
        int32_t awake = 0;
        MUST(fe_body_get_awake(s->world, bodies[i], &awake));
        sum += awake;
    }
    return sum;
}

static void all_above_ground(const scene *s, const fe_body *bodies, int count)
{
    for (int i = 0; i < count; ++i) {
        vec p = position(s, bodies[i]);
        if (fabs(p.x) < 20 && fabs(p.z) < 20) FE_WITHIN(p.y - ground_below(s, p), 0, 20);
    }
}

static double ramp(double x, double z)
{
    (void)z;
    return fmax(x, 0);
}

// At 20 m/s a ball comes 0.24 m nearer to a slope of 45 degrees in a step, from wherever it starts. The slope is found
// in the step before it is touched: the ball sinks in by less than the distance from which contacts are made, 2 cm.
static void what_slides_into_a_slope_does_not_sink(void **state)
{
    enum { PLACES = 16, STEPS = 12 };
    const double radius = 0.5, step = 20.0 / 60.0, deepest = 0.02;
    for (int i = 0; i < PLACES; ++i) {
        scene s = scene_begin(state);
        add_field(&s, 40, 1.0, -20, -20, ramp, friction(0));
        vec from = v3(-2 - step * i / PLACES, radius, 0.3);
        fe_body ball = add_dynamic(&s, sphere(radius), from, UNTURNED, friction(0), 1000);
        set_velocity(&s, ball, v3(20, 0, 0), v3(0, 0, 0));
        for (int k = 0; k < STEPS; ++k) {
            run(&s, 1);
            vec p = position(&s, ball);
            FE_TRUE((p.y - p.x) / sqrt(2.0) > radius - deepest);
        }
        scene_end(&s);
    }
}

static void rain_comes_to_rest_on_a_wave(void **state)
{
    enum { SECONDS = 8, LONGEST = 12 };
    static fe_body bodies[RAIN];
    scene s = scene_begin(state);
    fe_material m = resisting(0.2);
    add_wave(&s, m);
    seed = 1;
    for (int i = 0; i < RAIN; ++i) {
        double x = draw(-14, 14), z = draw(-14, 14), turn = draw(0, 3);
        vec axis = v3(1, draw(-1, 1), draw(-1, 1));
        fe_geometry form = i % 3 == 0 ? sphere(0.3) : i % 3 == 1 ? box(0.3, 0.2, 0.4) : capsule(0.3, 0.2);
        bodies[i] = add_dynamic(&s, form, v3(x, 1.5 + 0.01 * i, z), turned(axis, turn), m, WATER);
        MUST(fe_body_set_sleep_allowed(s.world, bodies[i], 1));
    }
    int seconds = 0;
    for (; seconds < SECONDS || (seconds < LONGEST && awake_of(&s, bodies, RAIN)); ++seconds) {
        run(&s, 60);
        all_above_ground(&s, bodies, RAIN);
    }
    assert_int_equal(awake_of(&s, bodies, RAIN), 0);
    scene_end(&s);
    shortfall unrest = {"seconds until the last drop of rain rests", 0};
    measure(&unrest, seconds, SECONDS, LONGEST);
    report_shortfall(&unrest);
}

// B49: thin boxes from 5 m, turning: none below the ground, and all asleep in the end, heaps of them in the valleys
// too.
static int needles(void **state)
{
    static fe_body bodies[NEEDLES * NEEDLES];
    int count = 0;
    scene s = scene_begin(state);
    fe_material m = resisting(0.1);
    add_wave(&s, m);
    seed = 2;
    for (int i = 0; i < NEEDLES * NEEDLES; ++i) {
        bodies[count] = add_dynamic(&s, box(0.02, 0.2, 0.04),
                                    v3(0.5 * (i % NEEDLES - NEEDLES / 2), 5, 0.5 * (i / NEEDLES - NEEDLES / 2)),
                                    UNTURNED, m, WATER);
        vec v = v3(draw(-1, 1), 0, 0), w = v3(draw(-5, 5), 0, 0);
        v.y = draw(-1, 1), v.z = draw(-1, 1), w.y = draw(-5, 5), w.z = draw(-5, 5);
        set_velocity(&s, bodies[count], v, w);
        MUST(fe_body_set_sleep_allowed(s.world, bodies[count], 1));
        ++count;
    }
    run(&s, 300);
    for (int i = 0; i < count; ++i) {
        vec p = position(&s, bodies[i]);
        if (fabs(p.x) < 20 && fabs(p.z) < 20) FE_WITHIN(p.y, ground_below(&s, p) - LINEAR_SLOP, 20);
    }
    int awake = awake_of(&s, bodies, count);
    scene_end(&s);
    return awake;
}

static void needles_stay_above_ground(void **state) { (void)needles(state); }

static void needles_fall_asleep(void **state) { assert_int_equal(needles(state), 0); }

// ---- edits, holes, materials ---------------------------------------------------------------------------------------

static void set_flat(scene *s, fe_asset asset, int row, int column, int size, float height)
{
    float heights[256];
    for (int i = 0; i < size * size; ++i) heights[i] = height;
    MUST(fe_heightfield_set_heights(world_store(s->world), asset, row, column, size, size, heights));
}

// The ground falls 0.3 m under one of two sleepers: that one wakes and follows, the other sleeps on.
static void sleepers_wake_when_their_ground_changes(void **state)
{
    scene s = scene_begin(state);
    fe_asset asset = make_field(&s, 40, 1.0, -20, -20, level);
    place_field(&s, asset, v3(-20, 0, -20), UNTURNED, friction(0.5));
    fe_body near = add_dynamic(&s, box(0.5, 0.5, 0.5), v3(0.2, 0.5, 0.3), UNTURNED, friction(0.5), WATER);
    fe_body far = add_dynamic(&s, box(0.5, 0.5, 0.5), v3(10.2, 0.5, 0.3), UNTURNED, friction(0.5), WATER);
    const fe_body both[2] = {near, far};
    for (int i = 0; i < 2; ++i) MUST(fe_body_set_sleep_allowed(s.world, both[i], 1));
    run(&s, 90);
    assert_int_equal(awake_of(&s, both, 2), 0);
    set_flat(&s, asset, 16, 16, 9, -0.3f);
    assert_int_equal(awake_of(&s, &near, 1), 1);
    assert_int_equal(awake_of(&s, &far, 1), 0);
    run(&s, 120);
    FE_NEAR(position(&s, near).y, 0.2, LINEAR_SLOP);
    FE_NEAR(position(&s, far).y, 0.5, LINEAR_SLOP);
    assert_int_equal(awake_of(&s, both, 2), 0);
    set_flat(&s, asset, 16, 16, 9, -0.2f); // and up again: pushed out from below
    run(&s, 120);
    FE_NEAR(position(&s, near).y, 0.3, LINEAR_SLOP);
    scene_end(&s);
}

static fe_body field_with(scene *s, const uint8_t *holes, const uint8_t *kinds, const fe_material *materials, int count)
{
    float heights[81] = {0};
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = 9, def.heights = heights;
    def.holes = holes, def.cell_materials = kinds, def.materials = materials, def.material_count = count;
    fe_asset asset;
    MUST(fe_heightfield_create(world_store(s->world), &def, &asset));
    fe_body body = place_field(s, asset, v3(-4, 0, -4), UNTURNED, friction(0.5));
    MUST(fe_asset_destroy(world_store(s->world), asset)); // its shape keeps it
    return body;
}

// One cell is a hole: what is small falls through, what is large rests across its rim, a box with its middle over solid
// ground too.
static void holes_let_through_what_fits(void **state)
{
    uint8_t holes[64] = {0};
    holes[4 * 8 + 4] = 1; // x 0..1, z 0..1
    scene s = scene_begin(state);
    field_with(&s, holes, NULL, NULL, 0);
    fe_body small = add_dynamic(&s, sphere(0.3), v3(0.5, 0.4, 0.5), UNTURNED, friction(0.5), WATER);
    run(&s, 60);
    FE_WITHIN(position(&s, small).y, -10, -2);

    fe_body plank = add_dynamic(&s, box(1.2, 0.1, 0.3), v3(0.5, 0.11, 0.5), UNTURNED, friction(0.5), WATER);
    fe_body overhang = add_dynamic(&s, box(0.4, 0.2, 0.4), v3(-0.15, 0.21, 2.5), UNTURNED, friction(0.5), WATER);
    run(&s, 120);
    FE_NEAR(position(&s, plank).y, 0.1, LINEAR_SLOP);
    FE_NEAR(tilt(&s, plank), 0, 0.01);
    FE_NEAR(position(&s, overhang).y, 0.2, LINEAR_SLOP);
    MUST(fe_body_destroy(s.world, plank));

    // a ball of radius 1 over a square hole of side 1 touches the middles of its sides, 0.5 m off: its centre is sqrt(1
    // - 0.25) above
    fe_body ball = add_dynamic(&s, sphere(1), v3(0.5, 0.9, 0.5), UNTURNED, friction(0.5), WATER);
    run(&s, 240);
    FE_NEAR(position(&s, ball).y, sqrt(0.75), LINEAR_SLOP);
    FE_NEAR(length(minus(position(&s, ball), v3(0.5, sqrt(0.75), 0.5))), 0, 0.01);
    scene_end(&s);
}

// Half of the field is ice. A box that slides at v comes to rest after v^2 / (2 mu g) on the rough half, and does not
// slow down on the other.
static void each_cell_has_its_material(void **state)
{
    uint8_t kinds[64];
    const fe_material materials[2] = {SURFACE(0.5f, 0.5f, 0, 0, 0), SURFACE(0, 0, 0, 0, 0)};
    for (int i = 0; i < 64; ++i) kinds[i] = i / 8 >= 4;
    scene s = scene_begin(state);
    field_with(&s, NULL, kinds, materials, 2);
    fe_body rough = add_dynamic(&s, box(0.3, 0.3, 0.3), v3(-3, 0.3, -2), UNTURNED, friction(0.5), WATER);
    fe_body icy = add_dynamic(&s, box(0.3, 0.3, 0.3), v3(-3, 0.3, 2), UNTURNED, friction(0.5), WATER);
    set_velocity(&s, rough, v3(2, 0, 0), v3(0, 0, 0));
    set_velocity(&s, icy, v3(2, 0, 0), v3(0, 0, 0));
    run(&s, 60);
    FE_NEAR(position(&s, rough).x, -3 + 4 / (2 * 0.5 * G), 0.02); // the scheme's first step: v h
    FE_NEAR(velocity(&s, icy).x, 2, 1e-4);
    scene_end(&s);
}

// A ball in a valley has a contact with each side; without friction they carry its weight.
static void contacts_tell_the_patches(void **state)
{
    scene s = scene_begin(state);
    // a valley along x, its sides rise by 1 m a metre
    float heights[9] = {1, 1, 1, 0, 0, 0, 1, 1, 1};
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = 3, def.cell_x = 4, def.cell_z = 1, def.heights = heights;
    fe_asset asset;
    MUST(fe_heightfield_create(world_store(s.world), &def, &asset));
    fe_body ground = place_field(&s, asset, v3(-4, 0, -1), UNTURNED, friction(0));
    fe_body ball = add_dynamic(&s, sphere(0.5), v3(0.3, 0.5 * sqrt(2), 0), UNTURNED, friction(0), WATER);
    run(&s, 60);
    fe_contact contacts[8];
    int32_t count = fe_body_get_contacts(s.world, ball, contacts, sizeof *contacts, 8);
    assert_int_equal(count, 2);
    vec push = v3(0, 0, 0);
    for (int32_t i = 0; i < count; ++i) {
        assert_int_equal(contacts[i].point_count, 1);
        const int32_t ground_is_a = contacts[i].body_a == ground;
        FE_TRUE(ground_is_a || contacts[i].body_b == ground);
        assert_in_range(ground_is_a ? contacts[i].triangle_a : contacts[i].triangle_b, 0, 7);
        assert_int_equal(ground_is_a ? contacts[i].triangle_b : contacts[i].triangle_a, -1);
        double sign = contacts[i].body_b == ball ? 1 : -1;
        vec n = times(sign, from_world(&s, widen(contacts[i].normal)));
        FE_NEAR(n.y, sqrt(0.5), 1e-5);
        push = plus(push, times((double)contacts[i].points[0].total_impulse, n));
    }
    FE_NEAR(push.y, mass_of(&s, ball) * G * STEP, 0.01 * mass_of(&s, ball) * G * STEP);
    FE_NEAR(position(&s, ball).y, 0.5 * sqrt(2), LINEAR_SLOP);
    // the pair begins and ends to touch once, whatever patches come and go
    fe_pair_event events[8];
    int begins = 0, ends = 0;
    set_velocity(&s, ball, v3(0, 5, 0), v3(0, 0, 0));
    for (int step = 0; step < 90; ++step) {
        run(&s, 1);
        int32_t n = fe_world_get_pair_events(s.world, events, sizeof *events, 8);
        for (int32_t i = 0; i < n; ++i)
            begins += events[i].kind == FE_EVENT_ENTER, ends += events[i].kind == FE_EVENT_EXIT;
    }
    FE_TRUE(begins == 1 && ends == 1);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(flat_fields_are_planes),
        TEST(two_fields_side_by_side_are_one),
        TEST(four_fields_at_a_corner_are_one),
        TEST(flush_boxes_are_one),
        TEST(tilted_fields_are_planes),
        WITH_4_SUBSTEPS(flat_fields_are_planes),
        WITH_4_SUBSTEPS(flush_boxes_are_one),
        TEST(characters_do_not_stumble),
        TEST(what_slides_into_a_slope_does_not_sink),
        TEST(rain_comes_to_rest_on_a_wave),
        TEST(needles_stay_above_ground),
        TEST(needles_fall_asleep),
        TEST(sleepers_wake_when_their_ground_changes),
        TEST(holes_let_through_what_fits),
        TEST(each_cell_has_its_material),
        TEST(contacts_tell_the_patches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
