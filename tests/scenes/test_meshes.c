// Meshes carry what rests, slides, rolls and falls on them as a plane does; edges that are not there are not felt, and
// nothing passes.
#include "core/memory.h"
#include "scenes/meshes.h"

#include <string.h>

#if defined(FE_SANITIZED)
enum { HEADINGS = 2, RAIN = 60 };
#else
enum { HEADINGS = 8, RAIN = 600 };
#endif

// ---- rest ----------------------------------------------------------------------------------------------------------

// 7200 triangles under one box
static void a_slab_rests_on_a_fine_mesh(void **state)
{
    scene s = scene_begin(state);
    add_mesh(&s, 80, 0.1, -4, -4, 0.2, level, friction(0.5));
    fe_body slab = add_dynamic(&s, box(3, 0.1, 3), v3(0, 0.15, 0), UNTURNED, friction(0.5), WATER);
    run(&s, 120);
    FE_NEAR(position(&s, slab).y, 0.1, 0.001);
    FE_WITHIN(tilt(&s, slab), 0, 0.05 * DEGREES);
    scene_end(&s);
}

// A cube of 12 triangles, 2 m wide, about the origin
static soup cube(void)
{
    static const uint32_t indices[36] = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                         2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    soup m = {malloc(24 * sizeof(float)), malloc(sizeof indices), 8, 12};
    memcpy(m.indices, indices, sizeof indices);
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 3; ++k) m.vertices[3 * i + k] = i >> (2 - k) & 1 ? 1.0f : -1.0f;
    return m;
}

// Its edges and corners carry: what hangs over them by less than half stays, at the height of its top; a second mesh
// turned by 45 degrees carries a box across its edge.
static void edges_and_corners_carry(void **state)
{
    scene s = scene_begin(state);
    soup m = cube();
    fe_asset asset = make_mesh(&s, &m, 0);
    soup_free(&m);
    place_mesh(&s, FE_BODY_STATIC, asset, v3(0, 0, 0), UNTURNED, friction(0.8));
    place_mesh(&s, FE_BODY_STATIC, asset, v3(10, 0, 0), turned(v3(0, 0, 1), PI / 4), friction(0.8));
    fe_body over_corner = add_dynamic(&s, box(0.5, 0.1, 0.5), v3(0.9, 1.12, 0.9), UNTURNED, friction(0.8), WATER),
            over_edge = add_dynamic(&s, box(0.4, 0.1, 0.4), v3(-0.8, 1.12, -0.8), UNTURNED, friction(0.8), WATER),
            across = add_dynamic(&s, box(0.5, 0.1, 0.5), v3(10, sqrt(2) + 0.11, 0), UNTURNED, friction(0.8), WATER);
    run(&s, 30);
    FE_NEAR(position(&s, across).y, sqrt(2) + 0.1, LINEAR_SLOP);
    run(&s, 90);
    FE_NEAR(position(&s, over_corner).y, 1.1, LINEAR_SLOP);
    FE_NEAR(position(&s, over_edge).y, 1.1, LINEAR_SLOP);
    scene_end(&s);
}

// ---- rides ---------------------------------------------------------------------------------------------------------

enum { SPHERE, CAPSULE, BOX, CYLINDER, FORMS };
#define SPEED 5.0 // m/s
#define WAY 10.0  // m

static fe_geometry form_of(int kind)
{
    fe_geometry cylinder;
    fe_geometry_cylinder(&cylinder, 0.25f, 0.4f); // stands
    return kind == SPHERE    ? sphere(0.5)
           : kind == CAPSULE ? capsule(0.5, 0.3)
           : kind == BOX     ? box(0.5, 0.25, 0.4)
                             : cylinder;
}
static double height_of(int kind) { return kind == SPHERE ? 0.5 : kind == CAPSULE ? 0.3 : 0.25; }

typedef void make_ground(scene *s, fe_material m);
static void plane_ground(scene *s, fe_material m) { add_ground(s, m); }
static void one_mesh(scene *s, fe_material m) { add_mesh(s, 40, 1.0, -20.3, -20.4, 0.3, level, m); }
static void fine_mesh(scene *s, fe_material m) { add_mesh(s, 60, 0.2, -6, -6, 0.3, level, m); }
static void two_meshes(scene *s, fe_material m)
{
    add_mesh(s, 20, 1.0, -20, -10, 0.3, level, m);
    add_mesh(s, 27, 0.75, 0, -10.1, 0.3, level, m);
}
static void mesh_and_field(scene *s, fe_material m)
{
    add_mesh(s, 20, 1.0, -20, -10, 0.3, level, m);
    add_field(s, 20, 1.0, 0, -10, level, m);
}

typedef struct ride {
    double way, aside, kick; // m, m, m/s
} ride;

// Without friction a body slides on; a rolling one rolls.
static ride go(void **state, make_ground *ground, int kind, double heading, int is_rolling)
{
    enum { SETTLED = 5, STEPS = 120 };
    scene s = scene_begin(state);
    fe_material m = friction(is_rolling ? 0.5 : 0);
    ground(&s, m);
    vec along = v3(cos(heading), 0, sin(heading)), axle = cross(v3(0, 1, 0), along), start = times(-WAY / 2, along);
    fe_quat turn = turned(v3(0, 1, 0), -heading);
    if (kind == CAPSULE) turn = compose(turn, turned(v3(1, 0, 0), PI / 2)); // lies across
    fe_body body = add_dynamic(&s, form_of(kind), plus(start, v3(0, height_of(kind), 0)), turn, m, WATER);
    set_velocity(&s, body, times(SPEED, along), is_rolling ? times(SPEED / height_of(kind), axle) : v3(0, 0, 0));
    ride r = {0};
    for (int i = 0; i < STEPS; ++i) {
        run(&s, 1);
        if (i >= SETTLED) r.kick = fmax(r.kick, fabs(velocity(&s, body).y));
    }
    r.way = dot(minus(position(&s, body), start), along), r.aside = fabs(dot(minus(position(&s, body), start), axle));
    scene_end(&s);
    return r;
}

static void rides_on(void **state, make_ground *ground)
{
    for (int kind = 0; kind < FORMS; ++kind) {
        for (int is_rolling = 0; is_rolling <= (kind == SPHERE || kind == CAPSULE); ++is_rolling) {
            ride plane = go(state, plane_ground, kind, 0, is_rolling);
            for (int i = 0; i < HEADINGS; ++i) {
                ride r = go(state, ground, kind, 2 * PI * i / HEADINGS + 0.1, is_rolling);
                FE_NEAR(r.way, plane.way, 1e-3 * plane.way);
                FE_WITHIN(r.aside, 0, plane.aside + 0.005);
                FE_WITHIN(r.kick, 0, 0.005);
            }
        }
    }
}

static void a_flat_mesh_is_a_plane(void **state) { rides_on(state, one_mesh); }
static void a_fine_mesh_is_a_plane(void **state) { rides_on(state, fine_mesh); }
static void two_meshes_side_by_side_are_one(void **state) { rides_on(state, two_meshes); }
static void a_mesh_goes_on_as_a_heightfield(void **state) { rides_on(state, mesh_and_field); }

// ---- nothing passes ------------------------------------------------------------------------------------------------

static double waves(double x, double z) { return 0.8 * sin(0.4 * x) * cos(0.5 * z); }

static void shower(scene *s, fe_body *bodies, double speed)
{
    for (int i = 0; i < RAIN; ++i) {
        fe_geometry cylinder, cone;
        fe_geometry_cylinder(&cylinder, 0.1f, 0.05f), fe_geometry_cone(&cone, 0.1f, 0.08f);
        const fe_geometry forms[] = {sphere(0.05), capsule(0.1, 0.04), box(0.08, 0.05, 0.03), cylinder, cone};
        uint32_t k = (uint32_t)i;
        vec at = v3(12 * noise(7 * k), 3 + 2 * noise(7 * k + 1), 12 * noise(7 * k + 2));
        bodies[i] =
            add_dynamic(s, forms[i % 5], at, turned(v3(noise(7 * k + 3), 1.1, noise(7 * k + 4)), 3 * noise(7 * k + 5)),
                        friction(0.5), WATER);
        set_velocity(s, bodies[i], v3(0.3 * speed * noise(7 * k + 6), -speed, 0), v3(9 * noise(7 * k + 3), 0, 0));
    }
}

static void fast_bodies_stay_above(void **state)
{
    scene s = scene_begin(state);
    fe_body bodies[RAIN];
    add_mesh(&s, 80, 0.5, -20, -20, 0.3, waves, friction(0.5));
    shower(&s, bodies, 158);
    run(&s, 60);
    for (int i = 0; i < RAIN; ++i) {
        vec p = position(&s, bodies[i]);
        if (fabs(p.x) < 19 && fabs(p.z) < 19) FE_TRUE(p.y > waves(p.x, p.z) - 0.05);
    }
    scene_end(&s);
}

// ---- the same everywhere -------------------------------------------------------------------------------------------

static void hash_of_shower(int32_t workers, int32_t simd, uint32_t words[2])
{
    scene s = scene_begin(NULL);
    MUST(fe_world_destroy(s.world));
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.worker_count = workers, def.simd = simd;
    if (fe_world_create(&def, &s.world) < 0) { // a set that this machine lacks
        words[0] = 0;
        return;
    }
    fe_body bodies[RAIN];
    add_mesh(&s, 40, 1.0, -20, -20, 0.3, waves, friction(0.5));
    shower(&s, bodies, 20);
    run(&s, 30);
    MUST(fe_world_hash(s.world, words));
    scene_end(&s);
}

static void workers_and_lanes_change_nothing(void **state)
{
    (void)state;
    static const int32_t sets[] = {FE_SIMD_AUTO, FE_SIMD_PLAIN, FE_SIMD_SSE2, FE_SIMD_AVX2, FE_SIMD_AVX512};
    uint32_t expected[2], words[2];
    hash_of_shower(1, FE_SIMD_PLAIN, expected);
    for (int i = 0; i < 5; ++i) {
        hash_of_shower(1 + i % 3, sets[i], words);
        if (words[0]) assert_memory_equal(words, expected, sizeof expected);
    }
}

static int32_t allocations;
static void *count_allocation(void *user, uint64_t size, uint64_t alignment)
{
    (void)user;
    ++allocations;
    return fe__aligned_allocate(size, alignment);
}
static void release(void *user, void *memory, uint64_t size)
{
    (void)user, (void)size;
    fe__aligned_free(memory);
}

static void steps_on_a_mesh_allocate_nothing(void **state)
{
    scene s = scene_begin(state);
    MUST(fe_world_destroy(s.world));
    fe_allocator allocator;
    fe_allocator_init(&allocator, sizeof allocator);
    allocator.allocate = count_allocation, allocator.release = release;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.allocator = &allocator;
    MUST(fe_world_create(&def, &s.world));
    add_mesh(&s, 20, 0.5, -5, -5, 0.3, level, friction(0.5));
    for (int i = 0; i < 9; ++i)
        add_dynamic(&s, form_of(i % FORMS), v3(2.0 * (i % 3) - 2, 0.6, 2.0 * (i / 3) - 2), UNTURNED, friction(0.9),
                    WATER);
    run(&s, 240);
    int32_t before = allocations;
    run(&s, 60);
    assert_int_equal(allocations, before);
    scene_end(&s);
}

// ---- queries -------------------------------------------------------------------------------------------------------

static vec corner_of(const soup *m, int triangle, int k)
{
    const float *v = m->vertices + 3 * m->indices[3 * triangle + k];
    return v3((double)v[0], (double)v[1], (double)v[2]);
}

// By regions (Ericson, Real-Time Collision Detection, 5.1.5): the least of the face and the three sides
static double distance_to(const soup *m, int triangle, vec p)
{
    vec c[3];
    for (int k = 0; k < 3; ++k) c[k] = corner_of(m, triangle, k);
    vec n = cross(minus(c[1], c[0]), minus(c[2], c[0]));
    double best = 1e30;
    int is_over = 1;
    for (int k = 0; k < 3; ++k) {
        vec side = minus(c[(k + 1) % 3], c[k]), to = minus(p, c[k]);
        if (dot(cross(side, to), n) < 0) is_over = 0;
        double u = fmax(0, fmin(1, dot(side, to) / dot(side, side)));
        best = fmin(best, length(minus(to, times(u, side))));
    }
    return is_over ? fmin(best, fabs(dot(n, minus(p, c[0]))) / length(n)) : best;
}

// Where a ray meets a triangle from its front, else 2
static double meets(const soup *m, int triangle, vec from, vec way)
{
    vec a = corner_of(m, triangle, 0), e = minus(corner_of(m, triangle, 1), a), f = minus(corner_of(m, triangle, 2), a);
    vec n = cross(e, f), r = minus(from, a);
    double slope = -dot(n, way), t = dot(n, r) / slope;
    if (slope <= 0 || t < 0 || t > 1) return 2;
    vec q = plus(r, times(t, way));
    double u = dot(cross(q, f), n) / dot(n, n), v = dot(cross(e, q), n) / dot(n, n);
    return u >= 0 && v >= 0 && u + v <= 1 ? t : 2;
}

static double steep(double x, double z) { return 1.5 * sin(1.3 * x) * cos(1.7 * z); }

static void queries_see_every_triangle(void **state)
{
    enum { TRIES = 400 };
    scene s = scene_begin(state);
    soup m = make_soup(22, 0.5, -5.5, -5.5, 0.4, steep);
    place_mesh(&s, FE_BODY_STATIC, make_mesh(&s, &m, 0), v3(0, 0, 0), UNTURNED, friction(0.5));
    run(&s, 1);
    for (uint32_t i = 0; i < TRIES; ++i) {
        vec from = v3(5 * noise(9 * i), 3 + noise(9 * i + 1), 5 * noise(9 * i + 2)),
            way = v3(6 * noise(9 * i + 3), -6 + noise(9 * i + 4), 6 * noise(9 * i + 5));
        double t = 2, near = 1e30, slid = 2;
        for (int k = 0; k < m.triangle_count; ++k) t = fmin(t, meets(&m, k, from, way));
        for (int k = 0; k < m.triangle_count; ++k) near = fmin(near, distance_to(&m, k, from));
        fe_hit hit;
        int32_t met = fe_world_raycast(s.world, &from, &way, NULL, &hit) == 1;
        FE_TRUE(met == (t <= 1));
        if (met) {
            FE_NEAR(hit.fraction, t, 1e-9);
            FE_NEAR(meets(&m, hit.triangle, from, way), t, 1e-9);
        }
        fe_closest closest;
        MUST(fe_world_closest_point(s.world, &from, 100, NULL, &closest));
        FE_NEAR(closest.distance, near, 1e-6);
        FE_NEAR(distance_to(&m, closest.triangle, from), near, 1e-6);
        // a ball stops where it is its radius away from the nearest triangle
        const double radius = 0.3;
        fe_geometry ball = sphere(radius);
        fe_transform start = {.position = from, .rotation = UNTURNED};
        if (near < radius || fe_world_sweep(s.world, &ball, &start, &way, NULL, &hit) != 1) continue;
        vec stop = plus(from, times(hit.fraction, way));
        for (int k = 0; k < m.triangle_count; ++k) slid = fmin(slid, distance_to(&m, k, stop));
        FE_NEAR(slid, radius, 1e-6);
        FE_NEAR(distance_to(&m, hit.triangle, stop), radius, 1e-6);
    }
    soup_free(&m);
    scene_end(&s);
}

// ---- the way out ---------------------------------------------------------------------------------------------------

static int32_t overlap_of(const scene *s, const fe_geometry *form, vec at, fe_overlap *out)
{
    fe_transform pose = fe_make_transform(at.x, at.y, at.z);
    return fe_world_overlap_shapes(s->world, form, &pose, NULL, out, sizeof *out, 1);
}

static int32_t parts(const scene *s, const fe_geometry *form, vec at, const fe_overlap *way)
{
    vec there = plus(at, times((double)way->depth + 1e-5, widen(way->direction)));
    fe_transform pose = fe_make_transform(there.x, there.y, there.z);
    return fe_world_overlap_any(s->world, form, &pose, NULL) == 0;
}

// From outside a cube of triangles lets out as a box does, over its faces, edges and corners.
static void the_way_out_of_a_cube_is_that_of_a_box(void **state)
{
    const double places[][3] = {{0, 1.2, 0},      {0.9, 1.2, 0.1},  {1.2, 0.9, -0.1},   {1.1, 1.15, 0},
                                {1.05, 0.3, 0.2}, {1.1, 1.2, 1.15}, {-1.2, 1.1, -1.15}, {0.7, -1.3, 0.95}};
    const fe_geometry forms[] = {sphere(0.4), box(0.4, 0.4, 0.4), capsule(0.5, 0.3)};
    for (uint32_t flags = 0; flags <= FE_MESH_TWO_SIDED; flags += FE_MESH_TWO_SIDED) {
        scene s = scene_begin(state);
        soup m = cube();
        place_mesh(&s, FE_BODY_STATIC, make_mesh(&s, &m, flags), v3(0, 0, 0), UNTURNED, friction(0.5));
        soup_free(&m);
        add_static(&s, box(1, 1, 1), v3(10, 0, 0), UNTURNED, friction(0.5));
        run(&s, 1);
        for (int i = 0; i < 24; ++i) {
            const fe_geometry *form = forms + i % 3;
            vec at = v3(places[i / 3][0], places[i / 3][1], places[i / 3][2]);
            fe_overlap of_mesh, of_box;
            int32_t found = overlap_of(&s, form, at, &of_mesh);
            assert_int_equal(found, overlap_of(&s, form, plus(at, v3(10, 0, 0)), &of_box));
            if (!found) continue;
            FE_TRUE(parts(&s, form, at, &of_mesh));
            FE_WITHIN(of_mesh.depth, 0, 1.01 * (double)of_box.depth + 1e-5);
        }
        scene_end(&s);
    }
}

// 0.1 m into each of three sides that meet in an inner corner: sqrt(3) times as far is the least that parts all
static void the_way_out_of_a_corner_leads_from_all_sides(void **state)
{
    scene s = scene_begin(state);
    soup m = cube();
    for (int i = 0; i < 12; ++i) {
        uint32_t second = m.indices[3 * i + 1];
        m.indices[3 * i + 1] = m.indices[3 * i + 2], m.indices[3 * i + 2] = second; // seen from inside
    }
    place_mesh(&s, FE_BODY_STATIC, make_mesh(&s, &m, 0), v3(0, 0, 0), UNTURNED, friction(0.5));
    soup_free(&m);
    run(&s, 1);
    const fe_geometry forms[] = {sphere(0.4), box(0.4, 0.4, 0.4)};
    for (int i = 0; i < 2; ++i) {
        fe_overlap way;
        vec at = v3(0.7, -0.7, 0.7);
        assert_int_equal(overlap_of(&s, forms + i, at, &way), 1);
        FE_TRUE(parts(&s, forms + i, at, &way));
        FE_NEAR(way.depth, 0.1 * sqrt(3), 1e-4);
        FE_NEAR(length(minus(times(sqrt(3), widen(way.direction)), v3(-1, 1, -1))), 0, 1e-2);
    }
    scene_end(&s);
}

// Whatever lies across a rough surface comes free, whichever sides count.
static void the_way_out_parts(void **state)
{
    enum { TRIES = 200 };
    for (uint32_t flags = 0; flags <= FE_MESH_TWO_SIDED; flags += FE_MESH_TWO_SIDED) {
        scene s = scene_begin(state);
        soup m = make_soup(22, 0.5, -5.5, -5.5, 0.4, steep);
        place_mesh(&s, FE_BODY_STATIC, make_mesh(&s, &m, flags), v3(0, 0, 0), UNTURNED, friction(0.5));
        soup_free(&m);
        run(&s, 1);
        fe_geometry cylinder;
        fe_geometry_cylinder(&cylinder, 0.4f, 0.3f);
        const fe_geometry forms[] = {sphere(0.4), box(0.4, 0.3, 0.5), capsule(0.5, 0.3), cylinder};
        for (uint32_t i = 0; i < TRIES; ++i) {
            double x = 4 * noise(3 * i), z = 4 * noise(3 * i + 1);
            vec at = v3(x, steep(x, z) + 0.3 * noise(3 * i + 2), z);
            fe_overlap way;
            if (overlap_of(&s, forms + i % 4, at, &way) == 1) FE_TRUE(parts(&s, forms + i % 4, at, &way));
        }
        scene_end(&s);
    }
}

// ---- sides ---------------------------------------------------------------------------------------------------------

static void two_sided_meshes_stop_rays_and_sweeps_from_below(void **state)
{
    scene s = scene_begin(state);
    soup m = make_soup(4, 1.0, -2, -2, 0.2, level);
    place_mesh(&s, FE_BODY_STATIC, make_mesh(&s, &m, FE_MESH_TWO_SIDED), v3(0, 0, 0), UNTURNED, friction(0.5));
    place_mesh(&s, FE_BODY_STATIC, make_mesh(&s, &m, 0), v3(0, -1, 0), UNTURNED, friction(0.5));
    soup_free(&m);
    run(&s, 1);
    vec from = v3(0.1, -2, 0.2), way = v3(0, 4, 0);
    fe_hit hit;
    FE_TRUE(fe_world_raycast(s.world, &from, &way, NULL, &hit) == 1);
    FE_NEAR(hit.fraction, 0.5, 1e-9);
    FE_NEAR(hit.normal.y, -1, 1e-6);
    // a ball of 0.2 m passes the one-sided mesh, and stops where it touches the other: after 1.8 of 4 m
    fe_geometry ball = sphere(0.2);
    fe_transform start = fe_make_transform(from.x, from.y, from.z);
    FE_TRUE(fe_world_sweep(s.world, &ball, &start, &way, NULL, &hit) == 1);
    FE_NEAR(hit.fraction, 0.45, 1e-6);
    FE_NEAR(hit.normal.y, -1, 1e-6);
    scene_end(&s);
}

static void two_sided_meshes_hold_from_below(void **state)
{
    scene s = scene_begin(state);
    soup m = make_soup(8, 0.5, -2, -2, 0.2, level);
    place_mesh(&s, FE_BODY_STATIC, make_mesh(&s, &m, FE_MESH_TWO_SIDED), v3(0, 0, 0), UNTURNED, friction(0.5));
    soup_free(&m);
    fe_geometry forms[] = {sphere(0.2), box(0.2, 0.2, 0.2)};
    fe_body bodies[2];
    for (int i = 0; i < 2; ++i)
        bodies[i] = add_dynamic(&s, forms[i], v3(i - 0.5, -1, 0), UNTURNED, friction(0.5), WATER);
    set_gravity(&s, v3(0, G, 0));
    run(&s, 120);
    for (int i = 0; i < 2; ++i) FE_NEAR(position(&s, bodies[i]).y, -0.2, LINEAR_SLOP);
    scene_end(&s);
}

// ---- bodies with meshes --------------------------------------------------------------------------------------------

static void dynamic_bodies_cannot_have_meshes(void **state)
{
    scene s = scene_begin(state);
    soup m = make_soup(4, 1.0, -2, -2, 0, level);
    fe_asset asset = make_mesh(&s, &m, 0);
    soup_free(&m);
    fe_body ball = add_dynamic(&s, sphere(0.5), v3(0, 5, 0), UNTURNED, friction(0.5), WATER);
    fe_body floor = place_mesh(&s, FE_BODY_KINEMATIC, asset, v3(0, 0, 0), UNTURNED, friction(0.5));
    fe_geometry form;
    fe_geometry_mesh(&form, asset);
    fe_shape_def def;
    fe_shape shape;
    fe_shape_def_init(&def, sizeof def);
    FE_TRUE(fe_shape_create(s.world, ball, &def, &form, &shape) == FE_ERROR_UNSUPPORTED);
    FE_TRUE(fe_body_set_type(s.world, floor, FE_BODY_DYNAMIC) == FE_ERROR_UNSUPPORTED);
    FE_TRUE(fe_body_set_type(s.world, floor, FE_BODY_STATIC) == FE_OK);
    FE_TRUE(fe_body_set_type(s.world, floor, FE_BODY_KINEMATIC) == FE_OK);
    scene_end(&s);
}

// A lift goes up at 1 m/s; a turntable takes along what lies on it.
static void kinematic_meshes_carry(void **state)
{
    scene s = scene_begin(state);
    soup m = make_soup(8, 0.5, -2, -2, 0.2, level);
    fe_asset asset = make_mesh(&s, &m, 0);
    soup_free(&m);
    fe_body lift = place_mesh(&s, FE_BODY_KINEMATIC, asset, v3(0, 0, 0), UNTURNED, friction(0.8)),
            table = place_mesh(&s, FE_BODY_KINEMATIC, asset, v3(10, 0, 0), UNTURNED, friction(0.8));
    fe_body rider = add_dynamic(&s, box(0.3, 0.2, 0.3), v3(0.4, 0.2, 0), UNTURNED, friction(0.8), WATER),
            dancer = add_dynamic(&s, box(0.3, 0.2, 0.3), v3(11, 0.2, 0), UNTURNED, friction(0.8), WATER);
    set_velocity(&s, lift, v3(0, 1, 0), v3(0, 0, 0));
    set_velocity(&s, table, v3(0, 0, 0), v3(0, 0.5, 0));
    run(&s, 120);
    FE_NEAR(position(&s, rider).y, 120 * STEP + 0.2, LINEAR_SLOP);
    vec from = minus(position(&s, dancer), v3(10, 0, 0));
    FE_NEAR(from.x, cos(0.5 * 120 * STEP), 0.03);
    FE_NEAR(from.z, -sin(0.5 * 120 * STEP), 0.03);
    scene_end(&s);
}

// ---- materials -----------------------------------------------------------------------------------------------------

static void each_triangle_has_its_material(void **state)
{
    scene s = scene_begin(state);
    soup m = make_soup(20, 1.0, -10, -10, 0, level);
    uint8_t *kinds = malloc((size_t)m.triangle_count);
    for (int i = 0; i < m.triangle_count; ++i) kinds[i] = (uint8_t)(i >= m.triangle_count / 2); // rough beyond z = 0
    fe_material materials[2] = {friction(0), friction(1)};
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = m.vertices, def.vertex_count = m.vertex_count;
    def.indices = m.indices, def.triangle_count = m.triangle_count;
    def.triangle_materials = kinds, def.materials = materials, def.material_count = 2;
    fe_asset asset;
    MUST(fe_mesh_create(world_store(s.world), &def, &asset));
    place_mesh(&s, FE_BODY_STATIC, asset, v3(0, 0, 0), UNTURNED, friction(0.5));
    fe_body slides = add_dynamic(&s, box(0.3, 0.2, 0.3), v3(-5, 0.2, -5), UNTURNED, friction(1), WATER),
            stops = add_dynamic(&s, box(0.3, 0.2, 0.3), v3(-5, 0.2, 5), UNTURNED, friction(1), WATER);
    set_velocity(&s, slides, v3(3, 0, 0), v3(0, 0, 0)), set_velocity(&s, stops, v3(3, 0, 0), v3(0, 0, 0));
    run(&s, 60);
    FE_NEAR(velocity(&s, slides).x, 3, 1e-3);
    FE_NEAR(velocity(&s, stops).x, 0, 1e-3);
    // ice for all
    materials[1] = friction(0);
    MUST(fe_mesh_set_materials(world_store(s.world), asset, materials, 0, 2));
    set_velocity(&s, stops, v3(2, 0, 0), v3(0, 0, 0));
    run(&s, 60);
    FE_NEAR(velocity(&s, stops).x, 2, 1e-3);
    free(kinds);
    soup_free(&m);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        EVERY_WAY_UP(a_slab_rests_on_a_fine_mesh),
        EVERY_WAY_UP(edges_and_corners_carry),
        TEST(a_flat_mesh_is_a_plane),
        TEST(a_fine_mesh_is_a_plane),
        TEST(two_meshes_side_by_side_are_one),
        TEST(a_mesh_goes_on_as_a_heightfield),
        TEST(fast_bodies_stay_above),
        TEST(workers_and_lanes_change_nothing),
        TEST(steps_on_a_mesh_allocate_nothing),
        TEST(queries_see_every_triangle),
        TEST(the_way_out_of_a_cube_is_that_of_a_box),
        TEST(the_way_out_of_a_corner_leads_from_all_sides),
        TEST(the_way_out_parts),
        TEST(two_sided_meshes_stop_rays_and_sweeps_from_below),
        TEST(two_sided_meshes_hold_from_below),
        TEST(dynamic_bodies_cannot_have_meshes),
        TEST(kinematic_meshes_carry),
        TEST(each_triangle_has_its_material),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
