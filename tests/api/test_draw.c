// Drawing: what is drawn is where the bodies are and as large as they are, in whatever buffer, from wherever it is
// seen.
#include "api/api_test.h"
#include "core/bytes.h"
#include "support/play.h"

#include <stdlib.h>

enum { EVERYTHING = 2 * FE_DRAW_TREES - 1 };
typedef int32_t draw_call(const fe_world *world, const fe_draw_options *options, fe_draw_vertex *out_vertices,
                          uint32_t stride, int32_t capacity);
static draw_call *const calls[3] = {fe_world_draw_lines, fe_world_draw_triangles, fe_world_draw_points};

static fe_draw_options options_of(uint32_t parts)
{
    fe_draw_options options;
    fe_draw_options_init(&options, sizeof options);
    options.parts = parts;
    return options;
}

typedef struct drawn {
    fe_draw_vertex *vertices;
    int32_t count;
} drawn;

// As many as were counted
static drawn draw(draw_call *call, const fe_world *world, const fe_draw_options *options)
{
    drawn d = {NULL, call(world, options, NULL, 0, 0)};
    assert_true(d.count >= 0);
    d.vertices = calloc((size_t)d.count + 1, sizeof *d.vertices);
    assert_int_equal(call(world, options, d.vertices, sizeof *d.vertices, d.count), d.count);
    return d;
}

static fe_asset make_hull(fe_world *world)
{
    static const float points[][3] = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1.5f}, {1, 1, 1}, {1.5f, -0.5f, 0.3f}};
    fe_hull_def def;
    fe_hull_def_init(&def, sizeof def);
    def.points = points[0], def.point_count = 6;
    fe_asset hull = 0;
    OK(fe_hull_create(world_store(world), &def, &hull));
    return hull;
}

// A tetrahedron of 1/6 m3, closed
static fe_asset make_mesh(fe_world *world)
{
    static const float vertices[][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const uint32_t triangles[][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = vertices[0], def.vertex_count = 4, def.indices = triangles[0], def.triangle_count = 4;
    fe_asset mesh = 0;
    OK(fe_mesh_create(world_store(world), &def, &mesh));
    return mesh;
}

// 3 x 4 samples: 6 cells, of which the middle one of the first row is a hole
static fe_asset make_field(fe_world *world)
{
    static const float heights[12] = {0, 1, 0, 1, 1, 0, 1, 0, 0, 0.5f, 0, 0};
    static const uint8_t holes[6] = {0, 1, 0, 0, 0, 0};
    fe_heightfield_def def;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = 3, def.columns = 4, def.cell_x = 1.0f, def.cell_z = 2.0f, def.heights = heights, def.holes = holes;
    fe_asset field = 0;
    OK(fe_heightfield_create(world_store(world), &def, &field));
    return field;
}

static fe_quat turned(void) { return (fe_quat){0.3f, -0.5f, 0.1f, 0.8f}; }

static fe_body new_turned(fe_world *world, int32_t type, double x, const fe_geometry *geometry)
{
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.type = type, def.transform.position = fe_make_dvec3(x, 5, -2), def.transform.rotation = turned();
    fe_body body = 0;
    OK(fe_body_create(world, &def, &body));
    add_shape(world, body, geometry);
    return body;
}

// All closed forms, and their number
enum { CLOSED = 7 };
static void closed_forms(fe_world *world, fe_geometry out[CLOSED])
{
    fe_geometry_sphere(out, 0.7f);
    fe_geometry_capsule(out + 1, 0.6f, 0.4f);
    fe_geometry_box(out + 2, 0.5f, 1.25f, 0.75f);
    fe_geometry_cylinder(out + 3, 0.9f, 0.5f);
    fe_geometry_cone(out + 4, 0.8f, 0.6f);
    fe_geometry_hull(out + 5, make_hull(world));
    fe_geometry_hull(out + 6, out[5].asset);
    fe_geometry_set_scale(out + 6, -2.0f, 1.5f, 0.5f);
}

// ---- arguments -----------------------------------------------------------------------------------------------------
static void each_call_refuses_what_is_wrong(void **state)
{
    (void)state;
    fe_world *world = new_world_of(11), *other = new_world_of(12);
    fe_body body = new_box(world, 0, 1, 0), stale = new_box(world, 5, 1, 0), foreign = new_box(other, 0, 1, 0);
    fe_shape shape = add_sphere(world, body, 0.1f);
    fe_draw_vertex vertices[64];
    fe_draw_instance instances[4];
    OK(fe_body_destroy(world, stale));
    for (int32_t k = 0; k < 3; ++k) {
        assert_int_equal(calls[k](NULL, NULL, vertices, sizeof *vertices, 64), FE_ERROR_ARGUMENT);
        assert_int_equal(calls[k](world, NULL, NULL, sizeof *vertices, 1), FE_ERROR_ARGUMENT);
        assert_int_equal(calls[k](world, NULL, vertices, sizeof *vertices, -1), FE_ERROR_ARGUMENT);
        assert_int_equal(calls[k](world, NULL, vertices, 0, 64), FE_ERROR_ARGUMENT);
        assert_int_equal(calls[k](world, NULL, vertices, 15, 64), FE_ERROR_ARGUMENT);
    }
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_draw_instances(world, NULL, instances, 0, 4));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_draw_instances(world, NULL, NULL, sizeof *instances, 4));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_draw_instances(NULL, NULL, instances, sizeof *instances, 4));
#define WITH(field, value, error)                                                                   \
    do {                                                                                            \
        fe_draw_options o = options_of(FE_DRAW_SHAPES);                                             \
        o.field = value;                                                                            \
        REFUSES(world, error, fe_world_draw_lines(world, &o, vertices, 24, 64));                    \
        REFUSES(world, error, fe_world_draw_triangles(world, &o, vertices, 24, 64));                \
        REFUSES(world, error, fe_world_draw_points(world, &o, vertices, 24, 64));                   \
        REFUSES(world, error, fe_world_draw_instances(world, &o, instances, sizeof *instances, 4)); \
    } while (0)
    WITH(struct_size, 6, FE_ERROR_ARGUMENT);
    WITH(parts, 1024, FE_ERROR_ARGUMENT);
    WITH(origin.x, (double)NAN, FE_ERROR_ARGUMENT);
    WITH(origin.y, 2e9, FE_ERROR_ARGUMENT);
    WITH(lower.z, (double)NAN, FE_ERROR_ARGUMENT);
    WITH(lower.x, (double)-INFINITY, FE_ERROR_ARGUMENT);
    WITH(upper.y, (double)INFINITY, FE_ERROR_ARGUMENT);
    WITH(upper.x, -1.1e9, FE_ERROR_ARGUMENT);
    WITH(scale, 0.0f, FE_ERROR_ARGUMENT);
    WITH(scale, -1.0f, FE_ERROR_ARGUMENT);
    WITH(scale, NOT_A_NUMBER, FE_ERROR_ARGUMENT);
    WITH(segments, 2, FE_ERROR_ARGUMENT);
    WITH(segments, 129, FE_ERROR_ARGUMENT);
    WITH(only, stale, FE_ERROR_STALE);
    WITH(only, foreign, FE_ERROR_STALE);
    WITH(only, shape, FE_ERROR_KIND);
#undef WITH
    fe_draw_options crossed = options_of(FE_DRAW_SHAPES);
    crossed.lower.y = 2, crossed.upper.y = 1;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_world_draw_lines(world, &crossed, NULL, 0, 0));
    SAYS("upper.y");
    OK(fe_world_destroy(world));
    OK(fe_world_destroy(other));
}

static int32_t judged_draws;
static int32_t draw_in_filter(void *user, const fe_filter_pair *pair)
{
    (void)pair;
    fe_draw_vertex vertex;
    for (int32_t k = 0; k < 3; ++k)
        judged_draws += calls[k](user, NULL, &vertex, sizeof vertex, 1) == FE_ERROR_STEPPING;
    judged_draws += fe_world_draw_instances(user, NULL, NULL, 0, 0) == FE_ERROR_STEPPING;
    return 1;
}

static void no_call_draws_a_world_that_steps(void **state)
{
    (void)state;
    fe_world *world = new_world();
    new_ground(world);
    fe_body body = new_box(world, 0, 0.5, 0);
    fe_shape shape = 0;
    assert_int_equal(fe_body_get_shapes(world, body, &shape, 1), 1);
    OK(fe_shape_set_pair_filter(world, shape, 1));
    OK(fe_world_set_pair_filter(world, draw_in_filter, world));
    judged_draws = 0;
    step(world, 1);
    assert_int_equal(judged_draws, 4);
    OK(fe_world_destroy(world));
}

// A longer stride leaves what is between; a shorter one gets the front; with less room the first are written
static void vertices_lie_where_the_caller_says(void **state)
{
    (void)state;
    fe_world *world = new_world();
    new_box(world, 1, 2, 3);
    drawn all = draw(fe_world_draw_triangles, world, NULL);
    assert_int_equal(all.count, 36);
    struct {
        char before;
        unsigned char vertex[sizeof(fe_draw_vertex)];
        unsigned char after[7];
    } rows[36];
    memset(rows, 0x5a, sizeof rows);
    assert_int_equal(fe_world_draw_triangles(world, NULL, (void *)rows[0].vertex, sizeof *rows, 10), 36);
    for (int32_t i = 0; i < 36; ++i) {
        unsigned char untouched[sizeof(fe_draw_vertex)];
        memset(untouched, 0x5a, sizeof untouched);
        assert_memory_equal(rows[i].vertex, i < 10 ? (void *)&all.vertices[i] : untouched, sizeof *all.vertices);
        assert_memory_equal(rows[i].after, untouched, sizeof rows[i].after);
    }
    unsigned char fronts[36][16];
    assert_int_equal(fe_world_draw_triangles(world, NULL, (void *)fronts, 16, 36), 36);
    for (int32_t i = 0; i < 36; ++i) assert_memory_equal(fronts[i], &all.vertices[i], 16);
    free(all.vertices);
    OK(fe_world_destroy(world));
}

static void nothing_is_drawn_of_nothing(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_draw_options all = options_of(EVERYTHING), none = options_of(FE_DRAW_NONE);
    for (int32_t k = 0; k < 3; ++k) assert_int_equal(calls[k](world, &all, NULL, 0, 0), 0);
    new_box(world, 0, 0, 0);
    for (int32_t k = 0; k < 3; ++k) assert_int_equal(calls[k](world, &none, NULL, 0, 0), 0);
    assert_int_equal(fe_world_draw_instances(world, &none, NULL, 0, 0), 0);
    OK(fe_world_destroy(world));
}

// ---- surfaces ------------------------------------------------------------------------------------------------------
// Six times the volume that the triangles enclose, positive when they turn left seen from outside
static double volume_of(const drawn *d)
{
    double volume = 0.0;
    for (int32_t i = 0; i < d->count; i += 3) {
        const fe_draw_vertex *v = d->vertices + i;
        double a[3] = {(double)v[0].x, (double)v[0].y, (double)v[0].z},
               b[3] = {(double)v[1].x, (double)v[1].y, (double)v[1].z},
               c[3] = {(double)v[2].x, (double)v[2].y, (double)v[2].z};
        volume += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return volume / 6.0;
}

static int32_t same_place(const fe_draw_vertex *a, const fe_draw_vertex *b) { return memcmp(a, b, 12) == 0; }

// Each side of a triangle is that of one other, the other way round: bit for bit, or there is a gap
static void check_closed(const drawn *d)
{
    for (int32_t i = 0; i < d->count; ++i) {
        const fe_draw_vertex *from = d->vertices + i, *to = d->vertices + (i % 3 == 2 ? i - 2 : i + 1);
        int32_t partners = 0;
        for (int32_t k = 0; k < d->count; ++k)
            partners += same_place(to, d->vertices + k) && same_place(from, d->vertices + (k % 3 == 2 ? k - 2 : k + 1));
        assert_int_equal(partners, 1);
    }
}

// Boxes and hulls to the rounding of floats, 8 of them at 2^-24 of 10 m, over surfaces of at most 20 m2. Of n segments
// a circle has sin(2 pi / n) / (2 pi / n) of its area: with 64 all but 0.16 %, and a sphere's profile as much again.
static void closed_forms_are_drawn_as_large_as_they_weigh(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_geometry forms[CLOSED];
    closed_forms(world, forms);
    for (int32_t i = 0; i < CLOSED; ++i) {
        fe_draw_options options = options_of(FE_DRAW_SHAPES);
        options.only = new_turned(world, FE_BODY_DYNAMIC, 4.0 * i, forms + i);
        options.segments = 64, options.origin = fe_make_dvec3(4.0 * i, 5, -2);
        float mass = 0;
        OK(fe_body_get_mass(world, options.only, &mass));
        int32_t is_flat = forms[i].type == FE_GEOMETRY_BOX || forms[i].type == FE_GEOMETRY_HULL;
        drawn d = draw(fe_world_draw_triangles, world, &options);
        double expected = (double)mass / 1000.0;
        FE_NEAR(volume_of(&d), expected, expected * (is_flat ? 2e-6 : 0.01));
        free(d.vertices);
        options.segments = 7 + i;
        d = draw(fe_world_draw_triangles, world, &options);
        check_closed(&d);
        free(d.vertices);
    }
    OK(fe_world_destroy(world));
}

// A mirrored tetrahedron of a mesh keeps its outside
static void meshes_are_drawn_scaled_and_mirrored(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_geometry mesh;
    fe_geometry_mesh(&mesh, make_mesh(world));
    new_turned(world, FE_BODY_STATIC, 0, &mesh);
    drawn d = draw(fe_world_draw_triangles, world, NULL);
    assert_int_equal(d.count, 12);
    FE_NEAR(volume_of(&d), 1.0 / 6.0, 1e-5);
    check_closed(&d);
    free(d.vertices);
    fe_geometry_set_scale(&mesh, 2.0f, -3.0f, 0.5f);
    fe_draw_options options = options_of(FE_DRAW_SHAPES);
    options.only = new_turned(world, FE_BODY_KINEMATIC, 0, &mesh);
    d = draw(fe_world_draw_triangles, world, &options);
    FE_NEAR(volume_of(&d), 3.0 / 6.0, 1e-5);
    free(d.vertices);
    d = draw(fe_world_draw_lines, world, &options);
    assert_int_equal(d.count, 2 * 6); // each edge once
    free(d.vertices);
    OK(fe_world_destroy(world));
}

// 5 cells of two triangles, each looking up. Edges: 5 diagonals; 4 + 4 of rows, 3 + 4 + 4 of columns...
static void heightfields_are_drawn_without_their_holes(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body ground = new_body(world, FE_BODY_STATIC, 0, 0, 0);
    fe_geometry field;
    fe_geometry_heightfield(&field, make_field(world));
    add_shape(world, ground, &field);
    drawn d = draw(fe_world_draw_triangles, world, NULL);
    assert_int_equal(d.count, 5 * 2 * 3);
    double area = 0.0; // seen from above
    for (int32_t i = 0; i < d.count; i += 3) {
        const fe_draw_vertex *v = d.vertices + i;
        double up = 0.5 * (double)((v[1].z - v[0].z) * (v[2].x - v[0].x) - (v[1].x - v[0].x) * (v[2].z - v[0].z));
        FE_NEAR(up, 1.0, 1e-6);
        area += up;
    }
    FE_NEAR(area, 10.0, 1e-5);
    free(d.vertices);
    // sides along x: 2 of the first row of samples, 3 of each other; along z: 4 a row of cells; a diagonal a cell
    d = draw(fe_world_draw_lines, world, NULL);
    assert_int_equal(d.count, 2 * (2 + 3 + 3 + 4 + 4 + 5));
    free(d.vertices);
    // a box around the last cell of the second row
    fe_draw_options options = options_of(FE_DRAW_SHAPES);
    options.lower = fe_make_dvec3(2.4, -1, 2.4), options.upper = fe_make_dvec3(2.6, 3, 3.0);
    assert_int_equal(fe_world_draw_triangles(world, &options, NULL, 0, 0), 2 * 3);
    OK(fe_world_destroy(world));
}

static int32_t has_edge(const drawn *lines, const fe_draw_vertex *a, const fe_draw_vertex *b)
{
    for (int32_t i = 0; i < lines->count; i += 2) {
        const fe_draw_vertex *from = lines->vertices + i, *to = from + 1;
        if ((same_place(from, a) && same_place(to, b)) || (same_place(from, b) && same_place(to, a))) return 1;
    }
    return 0;
}

// Each triangle that is drawn has its three edges, wherever the box cuts: its neighbours may be left out.
static void what_is_cut_keeps_its_edges(void **state)
{
    (void)state;
    enum { PLACES = 6 };
    for (int32_t kind = 0; kind < 2; ++kind) {
        fe_world *world = new_world();
        fe_geometry ground;
        if (kind)
            fe_geometry_heightfield(&ground, make_field(world));
        else
            fe_geometry_mesh(&ground, make_mesh(world));
        add_shape(world, new_body(world, FE_BODY_STATIC, 0, 0, 0), &ground);
        fe_draw_options options = options_of(FE_DRAW_SHAPES);
        int32_t all = fe_world_draw_triangles(world, &options, NULL, 0, 0), left_out = 0;
        for (int32_t place = 0; place < PLACES * PLACES; ++place) {
            double x = 0.8 * (place % PLACES) - 1.0, z = 0.8 * (place / PLACES) - 1.0;
            options.lower = fe_make_dvec3(x, -5, z), options.upper = fe_make_dvec3(x + 0.01, 5, z + 0.01);
            drawn triangles = draw(fe_world_draw_triangles, world, &options),
                  lines = draw(fe_world_draw_lines, world, &options);
            left_out += triangles.count > 0 && triangles.count < all;
            for (int32_t i = 0; i < triangles.count; ++i)
                assert_true(has_edge(&lines, triangles.vertices + i, triangles.vertices + i / 3 * 3 + (i + 1) % 3));
            free(triangles.vertices), free(lines.vertices);
        }
        assert_true(left_out > 0);
        OK(fe_world_destroy(world));
    }
}

// The piece is flat in the plane, within the box, and as large as its cut: 6 x 4 m
static void a_plane_is_drawn_within_the_box(void **state)
{
    (void)state;
    fe_world *world = new_world();
    new_ground(world);
    fe_draw_options options = options_of(FE_DRAW_SHAPES);
    options.lower = fe_make_dvec3(-2, -5, 10), options.upper = fe_make_dvec3(4, 5, 14);
    options.origin = fe_make_dvec3(1, 50, 3);
    drawn d = draw(fe_world_draw_triangles, world, &options);
    double area = 0.0;
    for (int32_t i = 0; i < d.count; ++i) {
        const fe_draw_vertex *v = d.vertices + i;
        FE_WITHIN(v->x, -3.0 - 1e-6, 3.0 + 1e-6);
        FE_NEAR(v->y, -50.0, 1e-5);
        FE_WITHIN(v->z, 7.0 - 1e-6, 11.0 + 1e-6);
        if (i % 3 == 0) area += 0.5 * (double)((v[1].z - v->z) * (v[2].x - v->x) - (v[1].x - v->x) * (v[2].z - v->z));
    }
    FE_NEAR(area, 24.0, 1e-4);
    free(d.vertices);
    fe_draw_instance instance;
    assert_int_equal(fe_world_draw_instances(world, &options, &instance, sizeof instance, 1), 1);
    assert_int_equal(instance.type, FE_GEOMETRY_PLANE);
    FE_NEAR(instance.position.x, 0.0, 1e-5), FE_NEAR(instance.position.z, 9.0, 1e-5);
    FE_NEAR(instance.half_extents.x * instance.half_extents.z, 6.0, 1e-4);
    // a grid: its rim, and lines at whole metres, 5 + 1 and 3 + 1 with those on the rim, at least
    int32_t lines = fe_world_draw_lines(world, &options, NULL, 0, 0);
    FE_WITHIN(lines, 2 * (4 + 5 + 3), 2 * (4 + 7 + 5));
    options.lower.y = 1; // above it
    assert_int_equal(fe_world_draw_triangles(world, &options, NULL, 0, 0), 0);
    assert_int_equal(fe_world_draw_lines(world, &options, NULL, 0, 0), 0);
    assert_int_equal(fe_world_draw_instances(world, &options, NULL, 0, 0), 0);
    OK(fe_world_destroy(world));
}

// The same scene 500 000 km off draws the same, but for half the last digit of a double there, 6e-8 m, and that of the
// floats that hold bodies
static void a_far_world_is_drawn_as_well(void **state)
{
    (void)state;
    fe_draw_vertex vertices[2][36];
    for (int32_t far = 0; far < 2; ++far) {
        fe_world *world = new_world();
        double at = far ? 5e8 : 0.0;
        new_box(world, at + 1, 2, 3);
        fe_draw_options options = options_of(FE_DRAW_SHAPES);
        options.origin.x = at;
        assert_int_equal(fe_world_draw_triangles(world, &options, vertices[far], sizeof **vertices, 36), 36);
        OK(fe_world_destroy(world));
    }
    for (int32_t i = 0; i < 36; ++i) FE_NEAR(vertices[0][i].x, vertices[1][i].x, 3e-7);
}

// ---- what is drawn, and in which colour -----------------------------------------------------------------------------
static uint32_t colour_of(const fe_world *world, fe_body body, uint32_t parts)
{
    fe_draw_options options = options_of(parts);
    fe_draw_instance instance;
    options.only = body;
    assert_int_equal(fe_world_draw_instances(world, &options, &instance, sizeof instance, 1), 1);
    assert_true(instance.body == body);
    return instance.rgba;
}

static void colours_tell_what_bodies_are(void **state)
{
    (void)state;
    const uint32_t plain = FE_DRAW_SHAPES, islands = plain | FE_DRAW_ISLANDS, sleep = plain | FE_DRAW_SLEEP;
    const uint32_t alpha = 0xff000000u;
    fe_world *world = new_world();
    fe_body ground = new_ground(world), carrier = new_body(world, FE_BODY_KINEMATIC, 0, 9, 0);
    add_box(world, carrier, 0.5f);
    fe_body lower = new_box(world, 0, 0.5, 0), upper = new_box(world, 0, 1.5, 0), alone = new_box(world, 9, 0.5, 0);
    step(world, 2);
    assert_true(colour_of(world, lower, islands) == colour_of(world, upper, islands));
    assert_true(colour_of(world, lower, islands) != colour_of(world, alone, islands));
    assert_true(colour_of(world, lower, plain) == colour_of(world, alone, plain));
    assert_true(colour_of(world, ground, islands) != colour_of(world, carrier, islands));
    assert_true(colour_of(world, ground, plain) == colour_of(world, ground, EVERYTHING));
    uint32_t awake = colour_of(world, alone, sleep);
    OK(fe_body_set_awake(world, alone, 0));
    assert_true(colour_of(world, alone, sleep) != awake);
    assert_true(colour_of(world, alone, plain) == awake);
    assert_true((colour_of(world, lower, islands) & alpha) == alpha);
    fe_shape shape = 0;
    assert_int_equal(fe_body_get_shapes(world, upper, &shape, 1), 1);
    OK(fe_shape_set_trigger(world, shape, 1));
    assert_true((colour_of(world, upper, islands) & alpha) < alpha);
    OK(fe_body_set_enabled(world, lower, 0));
    assert_true((colour_of(world, lower, islands) & alpha) < alpha);
    OK(fe_world_destroy(world));
}

static void only_and_the_box_choose(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body bodies[3] = {new_box(world, 0, 0, 0), new_box(world, 10, 0, 0), new_box(world, 20, 0, 0)};
    fe_draw_options options = options_of(FE_DRAW_SHAPES | FE_DRAW_BOUNDS | FE_DRAW_CENTRES | FE_DRAW_TREES);
    options.only = bodies[1];
    drawn d = draw(fe_world_draw_lines, world, &options);
    assert_int_equal(d.count, 2 * (12 + 12 + 3 + 12));
    for (int32_t i = 0; i < d.count; ++i) FE_WITHIN(d.vertices[i].x, 9.0, 11.0);
    free(d.vertices);
    options = options_of(FE_DRAW_SHAPES);
    options.lower = fe_make_dvec3(10.4, -1, -1), options.upper = fe_make_dvec3(19.6, 1, 1);
    fe_draw_instance found[3];
    assert_int_equal(fe_world_draw_instances(world, &options, found, sizeof *found, 3), 2);
    assert_true(found[0].body == bodies[1] && found[1].body == bodies[2]);
    options.upper.x = 19.4;
    assert_int_equal(fe_world_draw_instances(world, &options, NULL, 0, 0), 1);
    OK(fe_world_destroy(world));
}

// A cube of 8000 N on the plane: its points at its corners, whose normals look up, and forces that carry it: `scale`
// long together. What carries is within 1 % after two seconds: it rests.
static void check_contacts(int32_t ground_first)
{
    fe_world *world = new_world();
    fe_body ground = ground_first ? new_ground(world) : 0, box = new_box(world, 3, 0.5, -4);
    if (!ground_first) ground = new_ground(world);
    OK(fe_body_set_sleep_allowed(world, box, 0));
    step(world, 120);
    fe_contact contact;
    assert_int_equal(fe_body_get_contacts(world, box, &contact, sizeof contact, 1), 1);
    fe_draw_options options = options_of(FE_DRAW_CONTACTS);
    options.scale = 2.0f;
    drawn points = draw(fe_world_draw_points, world, &options), lines = draw(fe_world_draw_lines, world, &options);
    assert_int_equal(points.count, contact.point_count);
    assert_int_equal(lines.count, 2 * contact.point_count);
    fe_shape shape = 0;
    assert_int_equal(fe_body_get_shapes(world, ground_first ? ground : box, &shape, 1), 1);
    for (int32_t i = 0; i < points.count; ++i) {
        const fe_dvec3 *at = &contact.points[i].point;
        const fe_draw_vertex *p = points.vertices + i, *from = lines.vertices + 2 * i, *to = from + 1;
        assert_true(p->x == (float)at->x && p->y == (float)at->y && p->z == (float)at->z && p->owner == shape);
        assert_true(same_place(p, from));
        FE_NEAR(to->x - from->x, 2.0f * contact.normal.x, 1e-6);
        FE_NEAR(to->y - from->y, 2.0f * contact.normal.y, 1e-6);
        FE_NEAR(to->z - from->z, 2.0f * contact.normal.z, 1e-6);
    }
    free(points.vertices), free(lines.vertices);
    options.parts = FE_DRAW_FORCES;
    lines = draw(fe_world_draw_lines, world, &options);
    double carried = 0.0;
    for (int32_t i = 0; i < lines.count; i += 2) carried += (double)(lines.vertices[i + 1].y - lines.vertices[i].y);
    FE_NEAR(carried, ground_first ? 2.0 : -2.0, 0.02); // on B
    free(lines.vertices);
    options.only = ground; // who has the contact too
    assert_int_equal(fe_world_draw_lines(world, &options, NULL, 0, 0), 2 * (contact.point_count + 1));
    OK(fe_world_destroy(world));
}

static void contacts_are_drawn_where_they_are(void **state)
{
    (void)state;
    check_contacts(1);
    check_contacts(0);
}

// ---- joints --------------------------------------------------------------------------------------------------------
static fe_body hinged(fe_world *world, fe_joint *out_joint)
{
    fe_body body = new_box(world, 1, 5, 0);
    fe_hinge_joint_def def;
    fe_hinge_joint_def_init(&def, sizeof def);
    const fe_dvec3 at = {0, 5, 0};
    const fe_vec3 axis = {0, 0, 1};
    OK(fe_hinge_joint_def_at(world, &def, 0, body, &at, &axis));
    def.limit_enabled = 1, def.lower = -1.0f, def.upper = 1.0f;
    OK(fe_hinge_joint_create(world, &def, out_joint));
    return body;
}

// Anchors at the hinge, one line from the body's centre to it; the scale of its limit changes its colour as it is used,
// and ends at the angle of the lower limit: a needle from the hinge
static void joints_and_limits_are_drawn(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_joint joint = 0;
    fe_body body = hinged(world, &joint);
    fe_draw_options options = options_of(FE_DRAW_JOINTS);
    drawn d = draw(fe_world_draw_points, world, &options);
    assert_int_equal(d.count, 2);
    for (int32_t i = 0; i < 2; ++i) {
        FE_NEAR(d.vertices[i].x, 0, 1e-6), FE_NEAR(d.vertices[i].y, 5, 1e-6), FE_NEAR(d.vertices[i].z, 0, 1e-6);
        assert_true(d.vertices[i].owner == joint);
    }
    free(d.vertices);
    assert_int_equal(fe_world_draw_lines(world, &options, NULL, 0, 0), 2 * (1 + 3 + 3 + 1));
    options.parts = FE_DRAW_LIMITS;
    drawn before = draw(fe_world_draw_lines, world, &options);
    assert_int_equal(before.count, 2 * (16 + 2 + 1));
    step(world, 240);
    drawn after = draw(fe_world_draw_lines, world, &options);
    FE_TRUE(before.vertices[0].rgba != after.vertices[0].rgba);
    fe_joint_state now = {.struct_size = sizeof now};
    OK(fe_joint_get_state(world, joint, &now));
    FE_NEAR(now.angle, -1.0, 0.01); // it hangs on its lower limit
    const fe_draw_vertex *needle = after.vertices + after.count - 1, *low = after.vertices + 1;
    FE_NEAR(needle->x, low->x, 0.01), FE_NEAR(needle->y, low->y, 0.01), FE_NEAR(needle->z, low->z, 0.01);
    free(before.vertices), free(after.vertices);
    options.only = body;
    FE_TRUE(fe_world_draw_lines(world, &options, NULL, 0, 0) > 0);
    options.only = new_box(world, 50, 0, 0);
    assert_int_equal(fe_world_draw_lines(world, &options, NULL, 0, 0), 0);
    OK(fe_world_destroy(world));
}

// ---- instances -----------------------------------------------------------------------------------------------------
static void instances_say_form_pose_and_size(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_geometry forms[CLOSED];
    closed_forms(world, forms);
    fe_body bodies[CLOSED];
    for (int32_t i = 0; i < CLOSED; ++i) bodies[i] = new_turned(world, FE_BODY_DYNAMIC, 4.0 * i, forms + i);
    fe_draw_options options = options_of(FE_DRAW_SHAPES);
    options.origin = fe_make_dvec3(100, 0, 0);
    fe_draw_instance out[CLOSED];
    assert_int_equal(fe_world_draw_instances(world, &options, NULL, 0, 0), CLOSED);
    assert_int_equal(fe_world_draw_instances(world, &options, out, sizeof *out, CLOSED), CLOSED);
    const fe_vec3 half[CLOSED] = {{0.7f, 0.7f, 0.7f}, {0.4f, 0.6f, 0.4f}, {0.5f, 1.25f, 0.75f}, {0.5f, 0.9f, 0.5f},
                                  {0.6f, 0.8f, 0.6f}, {1, 1, 1},          {-2.0f, 1.5f, 0.5f}};
    for (int32_t i = 0; i < CLOSED; ++i) {
        fe_transform at = body_transform(world, bodies[i]);
        assert_int_equal(out[i].type, forms[i].type);
        assert_true(out[i].body == bodies[i] && out[i].part == -1 && out[i].asset == forms[i].asset);
        assert_memory_equal(&out[i].half_extents, half + i, sizeof *half);
        assert_memory_equal(&out[i].rotation, &at.rotation, sizeof at.rotation);
        assert_true(out[i].position.x == (float)(at.position.x - 100) && out[i].position.y == (float)at.position.y);
        fe_shape shape = 0;
        assert_int_equal(fe_body_get_shapes(world, bodies[i], &shape, 1), 1);
        assert_true(out[i].shape == shape);
    }
    OK(fe_world_destroy(world));
}

// ---- determinism
// Two boxes, one above the other: each a closed surface of the compound's shape
static void parts_of_compounds_are_drawn(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_compound_part parts[2];
    for (int32_t i = 0; i < 2; ++i) {
        fe_compound_part_init(parts + i, sizeof *parts);
        fe_geometry_box(&parts[i].geometry, 0.5f, 0.25f, 0.5f);
        parts[i].frame.position.y = (float)i;
    }
    fe_asset compound = 0;
    OK(fe_compound_create(world_store(world), parts, sizeof *parts, 2, &compound));
    fe_geometry geometry;
    fe_geometry_compound(&geometry, compound);
    fe_body body = new_turned(world, FE_BODY_DYNAMIC, 3, &geometry);
    fe_shape shape = 0;
    assert_int_equal(fe_body_get_shapes(world, body, &shape, 1), 1);
    drawn d = draw(fe_world_draw_triangles, world, NULL);
    assert_int_equal(d.count, 2 * 36);
    FE_NEAR(volume_of(&d), 1.0, 1e-4);
    for (int32_t i = 0; i < d.count; ++i) assert_true(d.vertices[i].owner == shape);
    free(d.vertices);
    fe_draw_options options = options_of(FE_DRAW_BOUNDS);
    assert_int_equal(fe_world_draw_lines(world, &options, NULL, 0, 0), 2 * 24);
    fe_draw_instance out[2];
    assert_int_equal(fe_world_draw_instances(world, NULL, out, sizeof *out, 2), 2);
    assert_true(out[0].part == 0 && out[1].part == 1 && out[1].shape == shape && out[1].type == FE_GEOMETRY_BOX);
    OK(fe_world_destroy(world));
}

// ---- the same with any number of workers ----------------------------------------------------------------------------
static void add_vertices(fe__hash *hash, const drawn *d)
{
    for (int32_t i = 0; i < d->count; ++i) {
        const fe_draw_vertex *v = d->vertices + i;
        fe__hash_floats2(hash, v->x, v->y), fe__hash_float(hash, v->z), fe__hash_u32(hash, v->rgba);
        fe__hash_u64(hash, v->owner);
    }
}

static uint64_t hash_drawn(const fe_world *world)
{
    fe__hash hash = fe__hash_begin();
    fe_draw_options options = options_of(EVERYTHING);
    for (int32_t k = 0; k < 3; ++k) {
        drawn d = draw(calls[k], world, &options);
        FE_TRUE(d.count > 0);
        add_vertices(&hash, &d);
        free(d.vertices);
    }
    int32_t count = fe_world_draw_instances(world, &options, NULL, 0, 0);
    fe_draw_instance *all = calloc((size_t)count + 1, sizeof *all);
    assert_int_equal(fe_world_draw_instances(world, &options, all, sizeof *all, count), count);
    for (int32_t i = 0; i < count; ++i) {
        fe__hash_u64(&hash, (uint64_t)all[i].rgba << 32 | (uint32_t)all[i].type), fe__hash_u64(&hash, all[i].shape);
        fe__hash_vec3(&hash, all[i].position), fe__hash_vec3(&hash, all[i].half_extents);
        fe__hash_floats2(&hash, all[i].rotation.x, all[i].rotation.w);
    }
    free(all);
    return hash.state;
}

static void workers_and_kernels_do_not_show(void **state)
{
    (void)state;
    const script *const scripts[] = {&script_brief, &script_crowd, &script_joints, &script_meshes};
    const int32_t simd[] = {FE_SIMD_PLAIN, FE_SIMD_SSE2, FE_SIMD_AVX2, FE_SIMD_AVX512, FE_SIMD_NEON},
                  workers[] = {1, 2, 3, 8};
    enum { STEPS = 40 };
    for (int32_t s = 0; s < 4; ++s) {
        uint64_t first = 0;
        for (int32_t k = 0; k < 5 * 4; ++k) {
            fe_world_def def;
            fe_world *world = NULL;
            fe_world_def_init(&def, sizeof def);
            def.simd = simd[k / 4], def.worker_count = workers[k % 4], def.number = 7;
            if (k / 4 > 0 && k % 4 != k / 4 - 1) continue; // all workers with plain C, one number with each other set
            if (fe_world_create(&def, &world) == FE_ERROR_UNSUPPORTED) continue;
            play p;
            play_begin(&p, world);
            play_until(&p, scripts[s], STEPS);
            uint64_t hash = hash_drawn(world);
            if (!first) first = hash;
            FE_TRUE(hash == first);
            OK(fe_world_destroy(world));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_call_refuses_what_is_wrong),
        cmocka_unit_test(no_call_draws_a_world_that_steps),
        cmocka_unit_test(vertices_lie_where_the_caller_says),
        cmocka_unit_test(nothing_is_drawn_of_nothing),
        cmocka_unit_test(closed_forms_are_drawn_as_large_as_they_weigh),
        cmocka_unit_test(meshes_are_drawn_scaled_and_mirrored),
        cmocka_unit_test(heightfields_are_drawn_without_their_holes),
        cmocka_unit_test(what_is_cut_keeps_its_edges),
        cmocka_unit_test(a_plane_is_drawn_within_the_box),
        cmocka_unit_test(a_far_world_is_drawn_as_well),
        cmocka_unit_test(colours_tell_what_bodies_are),
        cmocka_unit_test(only_and_the_box_choose),
        cmocka_unit_test(contacts_are_drawn_where_they_are),
        cmocka_unit_test(joints_and_limits_are_drawn),
        cmocka_unit_test(instances_say_form_pose_and_size),
        cmocka_unit_test(parts_of_compounds_are_drawn),
        cmocka_unit_test(workers_and_kernels_do_not_show),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
