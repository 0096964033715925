// Compounds: one shape of several parts does what several shapes of one body do, and is told of as one.
#include "scene.h"

#include <stdlib.h>
#include <string.h>

enum { TABLE_PARTS = 5, MIXED_PARTS = 7, MOST_EVENTS = 64 };

static fe_compound_part part_of(fe_geometry form, vec at, fe_quat rotation)
{
    fe_compound_part p;
    fe_compound_part_init(&p, sizeof p);
    p.geometry = form;
    p.frame.position = narrow(at);
    p.frame.rotation = rotation;
    return p;
}

// A top of 1.2 x 0.05 x 0.8 m on four legs of 0.7 m
static void make_table(fe_compound_part parts[TABLE_PARTS])
{
    parts[0] = part_of(box(0.6, 0.025, 0.4), v3(0, 0.375, 0), UNTURNED);
    for (int i = 0; i < 4; ++i)
        parts[1 + i] = part_of(box(0.03, 0.35, 0.03), v3(i % 2 ? 0.5 : -0.5, 0, i / 2 ? 0.3 : -0.3), UNTURNED);
    for (int i = 0; i < TABLE_PARTS; ++i) parts[i].density = i ? 700 : 500;
}

static fe_asset hull_of(scene *s)
{
    static const float points[6][3] = {{0.3f, 0, 0},  {-0.3f, 0, 0}, {0, 0.4f, 0},
                                       {0, -0.2f, 0}, {0, 0, 0.3f},  {0, 0, -0.5f}};
    fe_hull_def d;
    fe_asset hull = 0;
    fe_hull_def_init(&d, sizeof d);
    d.points = points[0], d.point_count = 6;
    MUST(fe_hull_create(world_store(s->world), &d, &hull));
    return hull;
}

static fe_asset mesh_of(scene *s)
{
    static const float corners[4][3] = {{-1, 0, -1}, {-1, 0.2f, 1}, {1, 0.1f, 1}, {1, 0, -1}};
    static const uint32_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    fe_mesh_def d;
    fe_asset mesh = 0;
    fe_mesh_def_init(&d, sizeof d);
    d.vertices = corners[0], d.vertex_count = 4, d.indices = triangles, d.triangle_count = 2;
    MUST(fe_mesh_create(world_store(s->world), &d, &mesh));
    return mesh;
}

// Every form that may be a part; with a mesh for a body that is not dynamic. Returns how many
static int make_mixed(scene *s, int has_mesh, fe_compound_part parts[MIXED_PARTS])
{
    fe_geometry cone, cylinder, hull;
    fe_geometry_cone(&cone, 0.4f, 0.3f);
    fe_geometry_cylinder(&cylinder, 0.3f, 0.2f);
    fe_geometry_hull(&hull, hull_of(s));
    fe_geometry_set_scale(&hull, 1.0f, -1.2f, 0.8f);
    parts[0] = part_of(box(0.4, 0.2, 0.3), v3(0, 0, 0), turned(v3(1, 2, 3), 0.7));
    parts[1] = part_of(sphere(0.25), v3(0.7, 0.1, 0), UNTURNED);
    parts[2] = part_of(capsule(0.3, 0.1), v3(-0.7, 0.2, 0.1), turned(v3(0, 0, 1), 1.2));
    parts[3] = part_of(cylinder, v3(0.1, 0.5, -0.4), turned(v3(1, 0, 0), 0.4));
    parts[4] = part_of(cone, v3(0.2, -0.5, 0.4), turned(v3(1, 0, 1), 2.0));
    parts[5] = part_of(hull, v3(-0.2, 0.3, 0.6), turned(v3(0, 1, 0), 0.3));
    if (!has_mesh) return 6;
    fe_geometry mesh;
    fe_geometry_mesh(&mesh, mesh_of(s));
    parts[6] = part_of(mesh, v3(0, -0.9, 0), turned(v3(0, 1, 0), 0.2));
    return 7;
}

static fe_body add_empty(scene *s, int32_t type, vec at, fe_quat rotation)
{
    fe_body_def d;
    fe_body body = 0;
    fe_body_def_init(&d, sizeof d);
    d.type = type, d.transform.position = at, d.transform.rotation = rotation, d.sleep_allowed = 0;
    MUST(fe_body_create(s->world, &d, &body));
    return body;
}

static fe_asset make_asset(scene *s, const fe_compound_part *parts, int count)
{
    fe_asset asset = 0;
    MUST(fe_compound_create(world_store(s->world), parts, sizeof *parts, count, &asset));
    return asset;
}

static fe_shape add_compound(scene *s, fe_body body, const fe_compound_part *parts, int count, const fe_shape_def *def)
{
    fe_geometry g;
    fe_asset asset = make_asset(s, parts, count);
    fe_shape shape = 0;
    fe_geometry_compound(&g, asset);
    MUST(fe_shape_create(s->world, body, def, &g, &shape));
    MUST(fe_asset_destroy(world_store(s->world), asset)); // it lives on for the shape
    return shape;
}

static void add_singles(scene *s, fe_body body, const fe_compound_part *parts, int count, fe_shape *out)
{
    for (int i = 0; i < count; ++i) {
        fe_shape_def d;
        fe_shape_def_init(&d, sizeof d);
        if (parts[i].density >= 0) d.density = parts[i].density;
        if (parts[i].own_material) d.material = parts[i].material;
        d.frame = parts[i].frame;
        MUST(fe_shape_create(s->world, body, &d, &parts[i].geometry, out + i));
    }
}

static int is_same_motion(const scene *s, fe_body a, const scene *t, fe_body b)
{
    fe_transform x = body_transform(s->world, a), y = body_transform(t->world, b);
    fe_vec3 v = body_linear_velocity(s->world, a), w = body_linear_velocity(t->world, b);
    return !memcmp(&x, &y, sizeof x) && !memcmp(&v, &w, sizeof v);
}

static int pair_events(const scene *s, fe_pair_event *out)
{
    int32_t count = fe_world_get_pair_events(s->world, out, sizeof *out, MOST_EVENTS);
    FE_WITHIN(count, 0, MOST_EVENTS);
    return count;
}

// Runs, and counts the pair events of a kind with the shape
static int events_of(scene *s, fe_shape shape, int steps, int32_t kind, fe_pair_event *last)
{
    fe_pair_event events[MOST_EVENTS];
    int found = 0;
    for (int i = 0; i < steps; ++i) {
        run(s, 1);
        for (int k = 0, n = pair_events(s, events); k < n; ++k)
            if (events[k].kind == kind && (events[k].shape_a == shape || events[k].shape_b == shape))
                *last = events[k], ++found;
    }
    return found;
}

// ---- K3: a compound is its parts -----------------------------------------------------------------------------------

// The same forms in the same order are summed and solved in the same order: not a bit differs.
static void check_same_as_shapes(const fe_compound_part *parts, const fe_compound_part *same, int count, scene *a,
                                 scene *b)
{
    fe_shape shapes[MIXED_PARTS];
    fe_quat tilted = turned(v3(1, 0.3, 2), 0.4);
    add_ground(a, friction(0.5)), add_ground(b, friction(0.5));
    fe_body one = add_empty(a, FE_BODY_DYNAMIC, v3(0, 1.5, 0), tilted),
            other = add_empty(b, FE_BODY_DYNAMIC, v3(0, 1.5, 0), tilted);
    add_compound(a, one, parts, count, NULL);
    add_singles(b, other, same, count, shapes);
    fe_mass_data m = mass_data_of(a, one), n = mass_data_of(b, other);
    FE_TRUE(!memcmp(&m, &n, sizeof m));
    fe_bounds x, y;
    MUST(fe_body_get_bounds(a->world, one, &x)), MUST(fe_body_get_bounds(b->world, other, &y));
    FE_TRUE(!memcmp(&x, &y, sizeof x));
    for (int i = 0; i < 300; ++i) {
        run(a, 1), run(b, 1);
        FE_TRUE(is_same_motion(a, one, b, other));
    }
    FE_WITHIN(position(a, one).y, 0.02, 1.0); // it lies on the ground
}

static void a_table_is_its_five_boxes(void **state)
{
    fe_compound_part parts[TABLE_PARTS];
    scene a = scene_begin(state), b = scene_begin(state);
    make_table(parts);
    check_same_as_shapes(parts, parts, TABLE_PARTS, &a, &b);
    scene_end(&a), scene_end(&b);
}

static void a_compound_of_every_form_is_its_shapes(void **state)
{
    fe_compound_part parts[MIXED_PARTS], same[MIXED_PARTS]; // but for the handle of the hull
    scene a = scene_begin(state), b = scene_begin(state);
    int count = make_mixed(&a, 0, parts);
    make_mixed(&b, 0, same);
    check_same_as_shapes(parts, same, count, &a, &b);
    scene_end(&a), scene_end(&b);
}

// 1.2 x 0.05 x 0.8 m at 500 kg/m3 is 24 kg; four legs of 0.06 x 0.7 x 0.06 m at 700 kg/m3 are 7.056 kg, 0.375 m below
static void mass_is_the_sum_of_the_parts(void **state)
{
    fe_compound_part parts[TABLE_PARTS];
    scene s = scene_begin(state);
    make_table(parts);
    fe_body body = add_empty(&s, FE_BODY_DYNAMIC, v3(0, 1, 0), UNTURNED);
    fe_shape shape = add_compound(&s, body, parts, TABLE_PARTS, NULL);
    fe_mass_data m = mass_data_of(&s, body);
    FE_NEAR(m.mass, 31.056, 31.056e-6);
    FE_NEAR(m.centre.y, 0.375 * 24 / 31.056, 1e-6);
    double top = 24.0 / 12 * (0.05 * 0.05 + 0.8 * 0.8), leg = 7.056 / 12 * (0.7 * 0.7 + 0.06 * 0.06) + 7.056 * 0.09;
    double apart = 24 * 7.056 / 31.056 * 0.375 * 0.375;
    FE_NEAR(m.inertia.x, top + leg + apart, 1e-5 * (top + leg + apart));
    MUST(fe_shape_set_density(s.world, shape, 3000)); // all of them have their own
    FE_NEAR(mass_of(&s, body), 31.056, 31.056e-6);
    parts[0].density = -1;
    fe_body other = add_empty(&s, FE_BODY_DYNAMIC, v3(5, 1, 0), UNTURNED);
    shape = add_compound(&s, other, parts, TABLE_PARTS, NULL);
    FE_NEAR(mass_of(&s, other), 48 + 7.056, 60e-6);
    MUST(fe_shape_set_density(s.world, shape, 2000));
    FE_NEAR(mass_of(&s, other), 96 + 7.056, 110e-6);
    scene_end(&s);
}

// ---- events --------------------------------------------------------------------------------------------------------

static void a_pair_of_shapes_begins_once_and_ends_once(void **state)
{
    fe_compound_part parts[TABLE_PARTS];
    fe_pair_event e;
    scene s = scene_begin(state);
    make_table(parts);
    fe_body ground = add_static(&s, box(5, 0.5, 5), v3(0, -0.5, 0), UNTURNED, friction(0.5));
    fe_body body = add_empty(&s, FE_BODY_DYNAMIC, v3(0, 0.4, 0), turned(v3(1, 0, 0.5), 0.05));
    fe_shape_def d;
    fe_shape_def_init(&d, sizeof d);
    d.user_data = 9, d.events = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_HIT;
    fe_shape shape = add_compound(&s, body, parts, TABLE_PARTS, &d), seen[4];
    assert_int_equal(events_of(&s, shape, 120, FE_EVENT_ENTER, &e), 1);
    FE_TRUE(e.body_a == ground && e.body_b == body && e.shape_b == shape && e.part_a == -1);
    FE_WITHIN(e.part_b, 1, 4); // a leg
    fe_contact contacts[MOST_CONTACTS];
    int32_t count = fe_shape_get_contacts(s.world, shape, contacts, sizeof *contacts, MOST_CONTACTS), legs = 0;
    assert_int_equal(count, fe_body_get_contacts(s.world, body, NULL, 0, 0));
    for (int i = 0; i < count; ++i) {
        FE_TRUE(contacts[i].shape_b == shape && contacts[i].part_a == -1);
        FE_WITHIN(contacts[i].part_b, 1, 4);
        legs |= 1 << contacts[i].part_b;
    }
    assert_int_equal(legs, 2 | 4 | 8 | 16); // it stands on all four
    assert_int_equal(fe_shape_get_overlaps(s.world, shape, seen, 4), 1);
    fe_counters c;
    fe_counters_init(&c, sizeof c);
    MUST(fe_world_get_counters(s.world, &c));
    FE_TRUE(c.shapes == 2 && c.pairs == 1);
    set_velocity(&s, body, v3(0, 4, 0), v3(0, 0, 0));
    assert_int_equal(events_of(&s, shape, 20, FE_EVENT_EXIT, &e), 1);
    FE_TRUE(e.shape_b == shape && e.part_a == -1 && e.part_b == -1);
    assert_int_equal(fe_shape_get_overlaps(s.world, shape, seen, 4), 0);
    scene_end(&s);
}

// A ball that rolls from part to part stays on the shape; each step tells the part under it.
static void a_ball_rolls_over_the_parts_of_a_floor(void **state)
{
    enum { TILES = 8 };
    fe_compound_part parts[TILES];
    fe_pair_event events[MOST_EVENTS];
    scene s = scene_begin(state);
    for (int i = 0; i < TILES; ++i) parts[i] = part_of(box(0.5, 0.1, 1), v3(i + 0.5, -0.1, 0), UNTURNED);
    fe_body floor = add_empty(&s, FE_BODY_STATIC, v3(0, 0, 0), UNTURNED);
    fe_shape_def d;
    fe_shape_def_init(&d, sizeof d);
    d.events = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_STAY;
    fe_shape shape = add_compound(&s, floor, parts, TILES, &d);
    fe_body ball = add_dynamic(&s, sphere(0.2), v3(0.5, 0.2, 0), UNTURNED, friction(0.5), WATER);
    set_velocity(&s, ball, v3(2, 0, 0), v3(0, 0, -10));
    int enters = 0, exits = 0, last = 0;
    for (int i = 0; i < 180; ++i) {
        run(&s, 1);
        double x = position(&s, ball).x;
        int n = pair_events(&s, events);
        if (n) assert_int_equal(n, 1);
        if (!n) continue;
        FE_TRUE(events[0].shape_a == shape);
        enters += events[0].kind == FE_EVENT_ENTER, exits += events[0].kind == FE_EVENT_EXIT;
        if (events[0].kind != FE_EVENT_STAY) continue;
        FE_NEAR(events[0].part_a + 0.5, x, 0.5 + 0.04); // the ball's way of a step, at a seam
        last = events[0].part_a;
    }
    assert_int_equal(enters, 1), assert_int_equal(exits, 0);
    assert_int_equal(last, 6); // 0.5 m + 2 m/s 3 s
    fe_vec3 v = body_linear_velocity(s.world, ball);
    FE_NEAR(v.y, 0, 1e-3), FE_NEAR(v.x, 2, 0.01); // no seam was felt
    scene_end(&s);
}

static void a_hit_is_told_once_with_all_of_its_impulse(void **state)
{
    fe_compound_part parts[2] = {part_of(box(0.2, 0.2, 0.2), v3(-0.5, 0, 0), UNTURNED),
                                 part_of(box(0.2, 0.2, 0.2), v3(0.5, 0, 0), UNTURNED)};
    scene s = scene_begin(state);
    add_ground(&s, friction(0.5));
    fe_body body = add_empty(&s, FE_BODY_DYNAMIC, v3(0, 0.25, 0), UNTURNED);
    fe_shape_def d;
    fe_shape_def_init(&d, sizeof d);
    d.events = FE_SHAPE_EVENTS_HIT;
    fe_shape shape = add_compound(&s, body, parts, 2, &d);
    set_velocity(&s, body, v3(0, -5, 0), v3(0, 0, 0));
    fe_hit_event hit[4];
    int32_t count = 0;
    for (int i = 0; i < 10 && !count; ++i) {
        run(&s, 1);
        count = fe_world_get_hit_events(s.world, hit, sizeof *hit, 4);
    }
    assert_int_equal(count, 1);
    FE_TRUE(hit[0].shape_b == shape && hit[0].part_a == -1);
    FE_WITHIN(hit[0].part_b, 0, 1);
    FE_NEAR(hit[0].point.x, hit[0].part_b ? 0.5 : -0.5, 0.21);
    FE_NEAR(hit[0].impulse, 128 * 5, 128 * 0.5); // both cubes stop: 64 kg each
    scene_end(&s);
}

static void a_trigger_of_parts_is_entered_and_left_once(void **state)
{
    fe_compound_part parts[2] = {part_of(box(1, 0.5, 1), v3(0, 0, 0), UNTURNED),
                                 part_of(box(1, 0.5, 1), v3(0, -0.8, 0), UNTURNED)};
    fe_pair_event e;
    scene s = scene_begin(state);
    fe_body zone = add_empty(&s, FE_BODY_STATIC, v3(0, 0, 0), UNTURNED);
    fe_shape_def d;
    fe_shape_def_init(&d, sizeof d);
    d.trigger = 1;
    fe_shape shape = add_compound(&s, zone, parts, 2, &d), inside[4];
    fe_body ball = add_dynamic(&s, sphere(0.1), v3(0, 1, 0), UNTURNED, friction(0.5), WATER);
    assert_int_equal(events_of(&s, shape, 25, FE_EVENT_ENTER, &e), 1);
    FE_TRUE(e.is_trigger && e.part_a == 0 && e.body_b == ball);
    run(&s, 8);
    assert_int_equal(fe_shape_get_overlaps(s.world, shape, inside, 4), 1);
    assert_int_equal(events_of(&s, shape, 60, FE_EVENT_EXIT, &e), 1);
    FE_TRUE(e.is_trigger);
    assert_int_equal(fe_shape_get_overlaps(s.world, shape, inside, 4), 0);
    scene_end(&s);
}

// What ends between two steps ends with one exit, too.
static void whatever_goes_sends_one_exit(void **state)
{
    for (int how = 0; how < 6; ++how) {
        fe_compound_part parts[TABLE_PARTS];
        fe_pair_event e;
        scene s = scene_begin(state);
        make_table(parts);
        fe_body ground = add_ground(&s, friction(0.5));
        fe_body body = add_empty(&s, FE_BODY_DYNAMIC, v3(0, 0.36, 0), UNTURNED);
        fe_shape shape = add_compound(&s, body, parts, TABLE_PARTS, NULL);
        assert_int_equal(events_of(&s, shape, 30, FE_EVENT_ENTER, &e), 1);
        fe_geometry g = sphere(0.1);
        if (how == 0) MUST(fe_shape_destroy(s.world, shape));
        if (how == 1) MUST(fe_body_destroy(s.world, body));
        if (how == 2) MUST(fe_body_destroy(s.world, ground));
        if (how == 3) MUST(fe_body_set_enabled(s.world, body, 0));
        if (how == 4) MUST(fe_shape_set_filter(s.world, shape, 1, 0, 0));
        if (how == 5) MUST(fe_shape_set_geometry(s.world, shape, &g));
        assert_int_equal(events_of(&s, shape, 3, FE_EVENT_EXIT, &e), 1);
        scene_end(&s);
    }
}

// ---- queries: against the same parts as shapes of their own ---------------------------------------------------------

typedef struct twins {
    scene a, b; // the compound, its parts
    fe_shape compound, shapes[MIXED_PARTS];
    int count;
} twins;

static twins make_twins(void **state)
{
    fe_compound_part parts[MIXED_PARTS];
    twins t = {.a = scene_begin(state), .b = scene_begin(state)};
    fe_quat q = turned(v3(2, 1, 0.5), 0.9);
    t.count = make_mixed(&t.a, 1, parts);
    t.compound = add_compound(&t.a, add_empty(&t.a, FE_BODY_KINEMATIC, v3(0.1, 0.2, 0.3), q), parts, t.count, NULL);
    make_mixed(&t.b, 1, parts);
    add_singles(&t.b, add_empty(&t.b, FE_BODY_KINEMATIC, v3(0.1, 0.2, 0.3), q), parts, t.count, t.shapes);
    return t;
}

static void end_twins(twins *t) { scene_end(&t->a), scene_end(&t->b); }

static double drawn(void) { return rand() / (RAND_MAX / 2.0) - 1; }

static fe_transform drawn_pose(void)
{
    return (fe_transform){v3(2 * drawn(), 2 * drawn(), 2 * drawn()),
                          turned(v3(drawn(), drawn(), drawn() + 2), 3 * drawn())};
}

static void check_hits(const twins *t, int32_t met_a, int32_t met_b, const fe_hit *h, const fe_hit *k)
{
    assert_int_equal(met_a, met_b);
    if (!met_a) return;
    FE_TRUE(h->shape == t->compound && h->part >= 0 && h->part < t->count && k->shape == t->shapes[h->part]);
    FE_TRUE(k->part == -1 && h->triangle == k->triangle && h->fraction == k->fraction && h->flags == k->flags);
    FE_TRUE(!memcmp(&h->point, &k->point, sizeof h->point) && !memcmp(&h->normal, &k->normal, sizeof h->normal));
    FE_TRUE(h->depth == k->depth && !memcmp(h->barycentric, k->barycentric, sizeof h->barycentric));
}

static void rays_and_sweeps_meet_what_they_meet_of_the_parts(void **state)
{
    twins t = make_twins(state);
    int found = 0;
    srand(7);
    for (int i = 0; i < 2000; ++i) {
        fe_transform at = drawn_pose();
        fe_dvec3 way = minus(times(0.5, v3(drawn(), drawn(), drawn())), times(1.5, at.position));
        fe_geometry form = i % 3 ? box(0.1, 0.2, 0.15) : sphere(0.1);
        fe_vec3 turn = narrow(v3(drawn(), drawn(), drawn()));
        fe_hit h, k;
        int32_t met = fe_world_raycast(t.a.world, &at.position, &way, NULL, &h);
        check_hits(&t, met, fe_world_raycast(t.b.world, &at.position, &way, NULL, &k), &h, &k);
        check_hits(&t, fe_world_raycast_all(t.a.world, &at.position, &way, NULL, &h, sizeof h, 1),
                   fe_world_raycast_all(t.b.world, &at.position, &way, NULL, &k, sizeof k, 1), &h, &k);
        check_hits(&t, fe_shape_raycast(t.a.world, t.compound, &at.position, &way, &h), met, &h, &k);
        check_hits(&t, fe_body_raycast(t.a.world, h.body, &at.position, &way, &h), met, &h, &k);
        found += met;
        check_hits(&t, fe_world_sweep(t.a.world, &form, &at, &way, NULL, &h),
                   fe_world_sweep(t.b.world, &form, &at, &way, NULL, &k), &h, &k);
        check_hits(&t, fe_world_sweep_all(t.a.world, &form, &at, &way, NULL, &h, sizeof h, 1),
                   fe_world_sweep_all(t.b.world, &form, &at, &way, NULL, &k, sizeof k, 1), &h, &k);
        if (i % 20) continue;
        check_hits(&t, fe_world_sweep_turning(t.a.world, &form, &at, &way, &turn, NULL, &h),
                   fe_world_sweep_turning(t.b.world, &form, &at, &way, &turn, NULL, &k), &h, &k);
    }
    FE_WITHIN(found, 200, 2000);
    end_twins(&t);
}

// Of a compound: the deepest of its parts, the first of equals
static void overlaps_and_closest_points_are_those_of_the_parts(void **state)
{
    twins t = make_twins(state);
    int several = 0;
    srand(8);
    for (int i = 0; i < 2000; ++i) {
        fe_transform at = drawn_pose();
        at.position = times(0.6, at.position);
        fe_geometry form = i % 2 ? sphere(0.3) : box(0.3, 0.1, 0.2);
        fe_overlap o, all[MIXED_PARTS];
        fe_body body;
        fe_shape shape;
        int32_t met = fe_world_overlap_shapes(t.a.world, &form, &at, NULL, &o, sizeof o, 1);
        int32_t parts = fe_world_overlap_shapes(t.b.world, &form, &at, NULL, all, sizeof *all, MIXED_PARTS),
                deepest = 0;
        assert_int_equal(met, parts > 0);
        assert_int_equal(fe_world_overlap(t.a.world, &form, &at, NULL, &body, 1), parts > 0);
        assert_int_equal(fe_world_overlap_any(t.a.world, &form, &at, NULL), parts > 0);
        for (int k = 1; k < parts; ++k)
            if (all[k].depth > all[deepest].depth) deepest = k;
        if (met) {
            FE_TRUE(o.shape == t.compound && t.shapes[o.part] == all[deepest].shape && o.depth == all[deepest].depth);
            FE_TRUE(!memcmp(&o.direction, &all[deepest].direction, sizeof o.direction));
        }
        several += parts > 1;
        fe_bounds near = {minus(at.position, v3(0.2, 0.2, 0.2)), plus(at.position, v3(0.2, 0.2, 0.2))};
        met = fe_world_overlap_bounds(t.a.world, &near, NULL, &shape, 1);
        assert_int_equal(met, fe_world_overlap_bounds(t.b.world, &near, NULL, NULL, 0) > 0);
        FE_TRUE(!met || shape == t.compound);
        fe_closest c, d;
        assert_int_equal(fe_world_closest_point(t.a.world, &at.position, 10, NULL, &c), 1);
        assert_int_equal(fe_world_closest_point(t.b.world, &at.position, 10, NULL, &d), 1);
        FE_TRUE(c.shape == t.compound && t.shapes[c.part] == d.shape && c.distance == d.distance && d.part == -1);
        assert_int_equal(fe_shape_closest_point(t.a.world, t.compound, &at.position, &d), 1);
        FE_TRUE(!memcmp(&c, &d, sizeof c));
        assert_int_equal(fe_body_closest_point(t.a.world, c.body, &at.position, &d), 1);
        FE_TRUE(!memcmp(&c, &d, sizeof c));
    }
    FE_WITHIN(several, 100, 2000);
    end_twins(&t);
}

// ---- materials, filters, life --------------------------------------------------------------------------------------

// On a slope of 20 degrees a part of ice slides, one of rubber stands: tan 20 = 0.36.
static void a_part_has_its_own_material(void **state)
{
    for (int is_ice = 0; is_ice < 2; ++is_ice) {
        scene s = scene_begin(state);
        fe_compound_part parts[2] = {part_of(box(0.2, 0.2, 0.2), v3(0, 0.2, 0), UNTURNED),
                                     part_of(box(0.2, 0.1, 0.2), v3(0, 0.5, 0), UNTURNED)};
        fe_material ice = friction(0), rubber = friction(1);
        ice.user_id = 7, rubber.user_id = 8;
        parts[0].own_material = is_ice, parts[0].material = ice;
        add_slope(&s, 20 * DEGREES, friction(1));
        fe_body body = add_empty(&s, FE_BODY_DYNAMIC, v3(0, 0.001, 0), slope_turn(20 * DEGREES));
        fe_shape_def d;
        fe_shape_def_init(&d, sizeof d);
        d.material = rubber;
        fe_shape shape = add_compound(&s, body, parts, 2, &d);
        run(&s, 60);
        double way = length(position(&s, body));
        if (is_ice)
            FE_NEAR(way, G / 2 * sin(20 * DEGREES), 0.05);
        else
            FE_NEAR(way, 0, 0.005);
        fe_contact c;
        assert_int_equal(fe_shape_get_contacts(s.world, shape, &c, sizeof c, 1), 1);
        FE_TRUE(c.material_b == (is_ice ? 7u : 8u) && c.part_b == 0);
        fe_material before = rubber;
        before.user_id = 9;
        MUST(fe_shape_set_material(s.world, shape, &before));
        run(&s, 1);
        assert_int_equal(fe_shape_get_contacts(s.world, shape, &c, sizeof c, 1), 1);
        FE_TRUE(c.material_b == (is_ice ? 7u : 9u));
        scene_end(&s);
    }
}

static int32_t asked;
static int32_t refuse(void *user, const fe_filter_pair *pair)
{
    (void)user;
    asked += 1;
    return pair->shape_user_data_b == 5;
}

// Five boxes would ask five times.
static void the_pair_filter_is_asked_once(void **state)
{
    for (uint64_t data = 4; data < 6; ++data) {
        fe_compound_part parts[TABLE_PARTS];
        scene s = scene_begin(state);
        make_table(parts);
        add_ground(&s, friction(0.5));
        fe_body body = add_empty(&s, FE_BODY_DYNAMIC, v3(0, 0.36, 0), UNTURNED);
        fe_shape_def d;
        fe_shape_def_init(&d, sizeof d);
        d.pair_filter = 1, d.user_data = data;
        add_compound(&s, body, parts, TABLE_PARTS, &d);
        asked = 0;
        MUST(fe_world_set_pair_filter(s.world, refuse, NULL));
        run(&s, 12); // in which it falls by 0.2 m, if nothing holds it
        assert_int_equal(asked, 1);
        FE_TRUE((position(&s, body).y > 0.3) == (data == 5));
        scene_end(&s);
    }
}

// A shape keeps its handle, frame and settings through all forms; mass and contacts follow.
static void a_shape_becomes_a_compound_and_back(void **state)
{
    fe_compound_part parts[TABLE_PARTS];
    scene s = scene_begin(state);
    make_table(parts);
    fe_body ground = add_ground(&s, friction(0.5));
    fe_body body = add_dynamic(&s, box(0.5, 0.35, 0.5), v3(0, 0.35, 0), UNTURNED, friction(0.5), WATER);
    fe_shape shapes[4];
    assert_int_equal(fe_body_get_shapes(s.world, body, shapes, 4), 1);
    double mass = mass_of(&s, body);
    fe_geometry boxed, compound, read = {.struct_size = sizeof read};
    MUST(fe_shape_get_geometry(s.world, shapes[0], (boxed.struct_size = sizeof boxed, &boxed)));
    fe_asset asset = make_asset(&s, parts, TABLE_PARTS);
    fe_geometry_compound(&compound, asset);
    for (int i = 0; i < 3; ++i) {
        MUST(fe_shape_set_geometry(s.world, shapes[0], &compound));
        FE_NEAR(mass_of(&s, body), 31.056, 31.056e-6);
        assert_int_equal(fe_body_get_shapes(s.world, body, shapes + 1, 3), 1);
        FE_TRUE(shapes[1] == shapes[0]);
        MUST(fe_shape_get_geometry(s.world, shapes[0], &read));
        FE_TRUE(read.type == FE_GEOMETRY_COMPOUND && read.asset == asset);
        run(&s, 60);
        FE_NEAR(position(&s, body).y, 0.35, 0.002);
        FE_TRUE(normal_impulse(&s, body, ground) > 0);
        MUST(fe_shape_set_geometry(s.world, shapes[0], &boxed));
        FE_TRUE(mass_of(&s, body) == mass);
        run(&s, 60);
        FE_NEAR(position(&s, body).y, 0.35, 0.002);
    }
    scene_end(&s);
}

static void a_frame_moves_all_parts(void **state)
{
    fe_compound_part parts[2] = {part_of(sphere(0.1), v3(1, 0, 0), UNTURNED),
                                 part_of(sphere(0.1), v3(-1, 0, 0), UNTURNED)};
    scene s = scene_begin(state);
    fe_body body = add_empty(&s, FE_BODY_KINEMATIC, v3(10, 0, 0), UNTURNED);
    fe_shape shape = add_compound(&s, body, parts, 2, NULL);
    fe_frame frame = {narrow(v3(0, 5, 0)), turned(v3(0, 0, 1), PI / 2)}; // x becomes y
    MUST(fe_shape_set_frame(s.world, shape, &frame));
    fe_bounds b;
    MUST(fe_shape_get_bounds(s.world, shape, &b));
    FE_NEAR(b.lower.y, 3.9, 1e-5), FE_NEAR(b.upper.y, 6.1, 1e-5);
    FE_NEAR(b.lower.x, 9.9, 1e-5), FE_NEAR(b.upper.x, 10.1, 1e-5);
    fe_closest c;
    vec at = v3(10, 6.5, 0);
    assert_int_equal(fe_world_closest_point(s.world, &at, 1, NULL, &c), 1);
    FE_TRUE(c.part == 0);
    FE_NEAR(c.distance, 0.4, 1e-5);
    scene_end(&s);
}

// A belt of two parts, of which one stands across: both carry along x of the shape.
static void a_belt_of_turned_parts_runs_one_way(void **state)
{
    fe_compound_part parts[2] = {part_of(box(1, 0.1, 1), v3(0, 0, -1), UNTURNED),
                                 part_of(box(1, 0.1, 1), v3(0, 0, 1), turned(v3(0, 1, 0), PI / 2))};
    scene s = scene_begin(state);
    fe_body body = add_empty(&s, FE_BODY_STATIC, v3(0, -0.1, 0), UNTURNED);
    fe_shape_def d;
    fe_shape_def_init(&d, sizeof d);
    d.surface_velocity = narrow(v3(0.5, 0, 0));
    add_compound(&s, body, parts, 2, &d);
    for (int i = 0; i < 2; ++i)
        add_dynamic(&s, box(0.1, 0.1, 0.1), v3(-0.5, 0.1, i ? 1 : -1), UNTURNED, friction(0.5), WATER);
    run(&s, 60);
    fe_body bodies[3];
    assert_int_equal(fe_world_get_bodies(s.world, bodies, 3), 3);
    for (int i = 1; i < 3; ++i) FE_NEAR(velocity(&s, bodies[i]).x, 0.5, 0.01);
    scene_end(&s);
}

// What has come in from below through one tile of a one-way floor passes its neighbours too, wherever it drifts to: it
// flies as if there was no floor, and so does one through a floor of one piece.
static void what_passes_a_part_passes_them_all(void **state)
{
    enum { TILES = 4, BALLS = 12 };
    const double top = 0.3, apex = 0.42; // the ball turns round with its centre above the tiles and its foot inside
    fe_compound_part tiles[TILES];
    for (int i = 0; i < TILES; ++i) tiles[i] = part_of(box(0.5, top, 1), v3(i - 1.5, 0, 0), UNTURNED);
    scene s = scene_begin(state), free_flight = scene_begin(state);
    fe_shape_def one_way;
    fe_shape_def_init(&one_way, sizeof one_way);
    one_way.one_way = 1;
    add_compound(&s, add_empty(&s, FE_BODY_STATIC, v3(0, 0, 0), UNTURNED), tiles, TILES, &one_way);
    for (int i = 0; i < BALLS; ++i) {
        scene *of[2] = {&s, &free_flight};
        for (int k = 0; k < 2; ++k) {
            fe_shape_def d;
            fe_shape_def_init(&d, sizeof d);
            d.mask = 1, d.layer = 2; // not with each other
            fe_geometry form = sphere(0.2);
            fe_shape shape;
            fe_body ball = add_empty(of[k], FE_BODY_DYNAMIC, v3(-1.6 + 0.08 * i, -1, 0), UNTURNED);
            MUST(fe_shape_create(of[k]->world, ball, &d, &form, &shape));
            set_velocity(of[k], ball, v3(1, sqrt(2 * 9.81 * (apex + 1)), 0), v3(0, 0, 0));
        }
    }
    for (int i = 0; i < 90; ++i) {
        run(&s, 1), run(&free_flight, 1);
        fe_body there[BALLS + 1], here[BALLS];
        assert_int_equal(fe_world_get_bodies(s.world, there, BALLS + 1), BALLS + 1);
        assert_int_equal(fe_world_get_bodies(free_flight.world, here, BALLS), BALLS);
        for (int b = 0; b < BALLS; ++b) {
            vec p = position(&s, there[b + 1]), q = position(&free_flight, here[b]);
            FE_TRUE(p.x == q.x && p.y == q.y && p.z == q.z);
        }
    }
    scene_end(&s), scene_end(&free_flight);
}

// What stands on one tile is held by the next, although it meets it from the side.
static void what_a_part_holds_they_all_hold(void **state)
{
    fe_compound_part tiles[2] = {part_of(box(1, 0.3, 1), v3(-1, -0.3, 0), UNTURNED),
                                 part_of(box(1, 0.3, 1), v3(1, -0.3, 0), UNTURNED)};
    scene s = scene_begin(state);
    fe_shape_def one_way;
    fe_shape_def_init(&one_way, sizeof one_way);
    one_way.one_way = 1;
    add_compound(&s, add_empty(&s, FE_BODY_KINEMATIC, v3(0, 0, 0), UNTURNED), tiles, 2, &one_way);
    fe_body sled = add_dynamic(&s, box(0.2, 0.2, 0.2), v3(-0.6, 0.2, 0), UNTURNED, friction(0), WATER);
    set_velocity(&s, sled, v3(1, 0, 0), v3(0, 0, 0));
    run(&s, 72);
    FE_NEAR(position(&s, sled).x, 0.6, 0.01);
    FE_NEAR(position(&s, sled).y, 0.2, 0.01);
    scene_end(&s);
}

// A tower of compounds falls asleep, wakes when its lowest goes, and everything comes to rest again.
static void compounds_sleep_and_wake(void **state)
{
    fe_compound_part parts[TABLE_PARTS];
    scene s = scene_begin(state);
    make_table(parts);
    add_ground(&s, friction(0.5));
    fe_body bodies[3];
    for (int i = 0; i < 3; ++i) {
        bodies[i] = add_empty(&s, FE_BODY_DYNAMIC, v3(0, 0.351 + 0.752 * i, 0), UNTURNED);
        add_compound(&s, bodies[i], parts, TABLE_PARTS, NULL);
        MUST(fe_body_set_sleep_allowed(s.world, bodies[i], 1));
    }
    run(&s, 300);
    int32_t awake[3];
    for (int i = 0; i < 3; ++i) MUST(fe_body_get_awake(s.world, bodies[i], awake + i)), assert_int_equal(awake[i], 0);
    MUST(fe_body_destroy(s.world, bodies[0]));
    for (int i = 1; i < 3; ++i) MUST(fe_body_get_awake(s.world, bodies[i], awake + i)), assert_int_equal(awake[i], 1);
    run(&s, 600);
    for (int i = 1; i < 3; ++i) MUST(fe_body_get_awake(s.world, bodies[i], awake + i)), assert_int_equal(awake[i], 0);
    FE_NEAR(position(&s, bodies[1]).y, 0.35, 0.01);
    scene_end(&s);
}

// A fast ball does not pass a thin part.
static void fast_bodies_are_stopped(void **state)
{
    fe_compound_part parts[2] = {part_of(box(2, 0.01, 2), v3(0, 0, 0), UNTURNED),
                                 part_of(box(0.1, 1, 0.1), v3(0, -1, 0), UNTURNED)};
    scene s = scene_begin(state);
    fe_body floor = add_empty(&s, FE_BODY_STATIC, v3(0, 0, 0), UNTURNED);
    add_compound(&s, floor, parts, 2, NULL);
    fe_body ball = add_dynamic(&s, sphere(0.02), v3(0.7, 2, 0.3), UNTURNED, friction(0.5), WATER);
    fe_body shot = add_empty(&s, FE_BODY_DYNAMIC, v3(-1, 3, 0), UNTURNED); // a compound that is fast itself
    fe_compound_part two[2] = {part_of(sphere(0.02), v3(0.05, 0, 0), UNTURNED),
                               part_of(sphere(0.02), v3(-0.05, 0, 0), UNTURNED)};
    add_compound(&s, shot, two, 2, NULL);
    set_velocity(&s, ball, v3(0, -200, 0), v3(0, 0, 0));
    set_velocity(&s, shot, v3(0, -200, 0), v3(0, 0, 0));
    run(&s, 30);
    FE_TRUE(position(&s, ball).y > 0 && position(&s, shot).y > 0);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_table_is_its_five_boxes),
        WITH_4_SUBSTEPS(a_table_is_its_five_boxes),
        TEST(a_compound_of_every_form_is_its_shapes),
        TEST(mass_is_the_sum_of_the_parts),
        TEST(a_pair_of_shapes_begins_once_and_ends_once),
        TEST(a_ball_rolls_over_the_parts_of_a_floor),
        TEST(a_hit_is_told_once_with_all_of_its_impulse),
        TEST(a_trigger_of_parts_is_entered_and_left_once),
        TEST(whatever_goes_sends_one_exit),
        TEST(rays_and_sweeps_meet_what_they_meet_of_the_parts),
        TEST(overlaps_and_closest_points_are_those_of_the_parts),
        TEST(a_part_has_its_own_material),
        TEST(the_pair_filter_is_asked_once),
        TEST(a_shape_becomes_a_compound_and_back),
        TEST(a_frame_moves_all_parts),
        TEST(a_belt_of_turned_parts_runs_one_way),
        TEST(what_passes_a_part_passes_them_all),
        TEST(what_a_part_holds_they_all_hold),
        TEST(compounds_sleep_and_wake),
        TEST(fast_bodies_are_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
