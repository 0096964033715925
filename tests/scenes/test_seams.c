// What slides or rolls over seams does as on a plane, however the ground is made: of triangles of any form, of several
// meshes, of boxes or hulls side by side, or of one kind beside the other.
//
// Each form crosses the middle of the ground, where its kinds meet, at many headings. On a plane it goes as far, keeps
// to its line, and its height stays.
#include "scenes/meshes.h"

#if defined(FE_SANITIZED)
static int headings = 2;
#else
static int headings = 5; // with an argument 16
#endif

#define SPEED 5.0 // m/s
#define WAY 10.0  // m
#define STEPS 120

// ---- what moves ----------------------------------------------------------------------------------------------------
enum { SPHERE, CAPSULE, BOX, CYLINDER, CONE, HULL, KINDS };

static fe_asset make_hull(scene *s, const float *points, int count)
{
    fe_hull_def def;
    fe_hull_def_init(&def, sizeof def);
    def.points = points, def.point_count = count;
    fe_asset asset = 0;
    MUST(fe_hull_create(world_store(s->world), &def, &asset));
    return asset;
}

static fe_geometry block(scene *s, double x, double y, double z)
{
    float p[24];
    for (int i = 0; i < 8; ++i)
        p[3 * i] = (float)(i & 1 ? x : -x), p[3 * i + 1] = (float)(i & 2 ? y : -y),
              p[3 * i + 2] = (float)(i & 4 ? z : -z);
    fe_geometry form;
    fe_geometry_hull(&form, make_hull(s, p, 8));
    return form;
}

// Six sides, wider above than below
static fe_geometry prism(scene *s)
{
    float p[36];
    for (int i = 0; i < 12; ++i) {
        double r = i % 2 ? 0.45 : 0.4, angle = PI / 3 * (i / 2);
        p[3 * i] = (float)(r * cos(angle)), p[3 * i + 1] = i % 2 ? 0.25f : -0.25f,
              p[3 * i + 2] = (float)(r * sin(angle));
    }
    fe_geometry form;
    fe_geometry_hull(&form, make_hull(s, p, 12));
    return form;
}

typedef struct mover {
    const char *name;
    fe_geometry form;
    double height; // of its origin over the ground, m
    int lies, rolls;
} mover;

enum { MOVERS = KINDS + 3 };
static void make_movers(scene *s, mover movers[MOVERS])
{
    fe_geometry cylinder, cone;
    fe_geometry_cylinder(&cylinder, 0.25f, 0.4f);
    fe_geometry_cone(&cone, 0.3f, 0.4f);
    const mover all[MOVERS] = {{"sphere", sphere(0.5), 0.5, 0, 0},
                               {"capsule", capsule(0.5, 0.3), 0.3, 1, 0},
                               {"box", box(0.5, 0.25, 0.4), 0.25, 0, 0},
                               {"cylinder", cylinder, 0.25, 0, 0},
                               {"cone", cone, 0.3, 0, 0},
                               {"hull", prism(s), 0.25, 0, 0},
                               {"ball", sphere(0.5), 0.5, 0, 1},
                               {"roller", capsule(0.5, 0.3), 0.3, 1, 1},
                               {"wheel", cylinder, 0.4, 1, 1}};
    for (int i = 0; i < MOVERS; ++i) movers[i] = all[i];
}

// ---- grounds -------------------------------------------------------------------------------------------------------
typedef void make_ground(scene *s, vec at, fe_material m);

static void lay(scene *s, soup *m, vec at, fe_material material)
{
    place_mesh(s, FE_BODY_STATIC, make_mesh(s, m, 0), at, UNTURNED, material);
    soup_free(m);
}

static void plane(scene *s, vec at, fe_material m)
{
    fe_geometry form;
    fe_geometry_plane(&form, 0, 1, 0, 0);
    add_body(s, FE_BODY_STATIC, form, at, UNTURNED, m, WATER);
}
static void jittered_cells(scene *s, vec at, fe_material m)
{
    soup cells = make_soup(16, 1.0, -8.3, -8.4, 0.3, level);
    lay(s, &cells, at, m);
}

static void fine_cells(scene *s, vec at, fe_material m)
{
    soup cells = make_soup(160, 0.1, -8.03, -8.04, 0.3, level);
    lay(s, &cells, at, m);
}

// A band of triangles of 5 m by 5 mm, with wide ones on both sides
static void slivers(scene *s, vec at, fe_material m)
{
    enum { ROWS = 3, COLUMNS = 200 };
    soup band = make_soup(COLUMNS, 1.0, 0, 0, 0, level);
    for (int i = 0; i < band.vertex_count; ++i) {
        float *v = band.vertices + 3 * i;
        v[0] = 0.005f * v[0] - 0.5f, v[2] = 5.0f * v[2] - 7.5f;
    }
    band.triangle_count = 2 * ROWS * COLUMNS;
    soup left = make_soup(5, 3.0, -15.5, -7.5, 0.2, level), right = make_soup(5, 3.0, 0.5, -7.5, 0.2, level);
    lay(s, &band, at, m), lay(s, &left, at, m), lay(s, &right, at, m);
}

// Tiles of 2 m, cut into 3 x 3 or 4 x 4
static void t_junctions(scene *s, vec at, fe_material m)
{
    for (int i = 0; i < 64; ++i) {
        int column = i % 8, row = i / 8, cells = 3 + (column + row) % 2;
        soup tile = make_soup(cells, 2.0 / cells, 0, 0, 0.2, level);
        lay(s, &tile, plus(at, v3(2 * column - 8.3, 0, 2 * row - 8.4)), m);
    }
}

static void mesh_side(scene *s, vec at, fe_material m)
{
    soup side = make_soup(19, 0.75, -14.25, -7, 0.3, level);
    lay(s, &side, at, m);
}
static void two_meshes(scene *s, vec at, fe_material m)
{
    soup side = make_soup(15, 1.0, 0, -7.2, 0.3, level);
    mesh_side(s, at, m), lay(s, &side, at, m);
}
static void mesh_and_box(scene *s, vec at, fe_material m)
{
    mesh_side(s, at, m);
    add_static(s, box(7, 0.5, 7), plus(at, v3(7, -0.5, 0)), UNTURNED, m);
}
static void mesh_and_hull(scene *s, vec at, fe_material m)
{
    mesh_side(s, at, m);
    add_static(s, block(s, 7, 0.5, 7), plus(at, v3(7, -0.5, 0)), UNTURNED, m);
}
static void mesh_and_field(scene *s, vec at, fe_material m)
{
    mesh_side(s, at, m);
    place_field(s, make_field(s, 15, 1.0, 0, -7.2, level), plus(at, v3(0, 0, -7.2)), UNTURNED, m);
}

static void field_and_box(scene *s, vec at, fe_material m)
{
    place_field(s, make_field(s, 15, 1.0, 0, -7.2, level), plus(at, v3(0, 0, -7.2)), UNTURNED, m);
    add_static(s, box(7, 0.5, 7), plus(at, v3(-7, -0.5, 0)), UNTURNED, m);
}

static void tiles(scene *s, fe_geometry form, vec at, fe_material m)
{
    for (int i = 0; i < 196; ++i) add_static(s, form, plus(at, v3(i % 14 - 7.3, -0.5, i / 14 - 7.4)), UNTURNED, m);
}
static void box_tiles(scene *s, vec at, fe_material m) { tiles(s, box(0.5, 0.5, 0.5), at, m); }
static void hull_tiles(scene *s, vec at, fe_material m) { tiles(s, block(s, 0.5, 0.5, 0.5), at, m); }

// ---- rides ---------------------------------------------------------------------------------------------------------
typedef struct ride {
    double way, aside, kick; // m, m, m/s
} ride;

static ride go(scene *s, const mover *what, double heading, vec at)
{
    enum { SETTLED = 5 };
    vec along = v3(cos(heading), 0, sin(heading)), axle = cross(v3(0, 1, 0), along),
        start = plus(at, times(-WAY / 2, along));
    fe_quat turn = turned(v3(0, 1, 0), -heading);
    if (what->lies) turn = compose(turn, turned(v3(1, 0, 0), PI / 2));
    fe_body body =
        add_dynamic(s, what->form, plus(start, v3(0, what->height, 0)), turn, friction(what->rolls ? 0.5 : 0), WATER);
    set_velocity(s, body, times(SPEED, along), what->rolls ? times(SPEED / what->height, axle) : v3(0, 0, 0));
    vec begun = position(s, body);
    ride r = {0};
    for (int i = 0; i < STEPS; ++i) {
        run(s, 1);
        if (i >= SETTLED) r.kick = fmax(r.kick, fabs(velocity(s, body).y));
    }
    vec gone = minus(position(s, body), begun);
    r.way = dot(gone, along), r.aside = fabs(dot(gone, axle));
    MUST(fe_body_destroy(s->world, body));
    return r;
}

static void rides_on_at(void **state, make_ground *ground, vec at)
{
    // within 0.1 % of the way, 5 mm aside, 5 mm/s: LINEAR_SLOP and what a body at rest may move
    scene even = scene_begin(state), s = scene_begin(state);
    mover on_plane[MOVERS], movers[MOVERS];
    make_movers(&even, on_plane), make_movers(&s, movers);
    plane(&even, at, friction(1)), ground(&s, at, friction(1));
    for (int k = 0; k < MOVERS; ++k) {
        ride p = go(&even, on_plane + k, 0, at);
        double way = 0, aside = 0, kick = 0;
        for (int i = 0; i < headings; ++i) {
            ride r = go(&s, movers + k, 2 * PI * i / headings + 0.1, at);
            way = fmax(way, fabs(r.way - p.way)), aside = fmax(aside, r.aside - p.aside), kick = fmax(kick, r.kick);
        }
        FE_WITHIN(way, 0, 1e-3 * p.way);
        FE_WITHIN(aside, -1, 0.005);
        FE_WITHIN(kick, 0, 0.005);
    }
    scene_end(&even), scene_end(&s);
}
static void rides_on(void **state, make_ground *ground) { rides_on_at(state, ground, v3(0, 0, 0)); }

static void jittered_cells_are_a_plane(void **state) { rides_on(state, jittered_cells); }
static void fine_cells_are_a_plane(void **state) { rides_on(state, fine_cells); }
static void slivers_are_a_plane(void **state) { rides_on(state, slivers); }
static void t_junctions_are_a_plane(void **state) { rides_on(state, t_junctions); }
static void two_meshes_are_one(void **state) { rides_on(state, two_meshes); }
static void a_mesh_goes_on_as_a_heightfield(void **state) { rides_on(state, mesh_and_field); }
static void a_mesh_goes_on_as_a_box(void **state) { rides_on(state, mesh_and_box); }
static void a_mesh_goes_on_as_a_hull(void **state) { rides_on(state, mesh_and_hull); }
static void a_heightfield_goes_on_as_a_box(void **state) { rides_on(state, field_and_box); }
static void box_tiles_are_a_plane(void **state) { rides_on(state, box_tiles); }
static void hull_tiles_are_a_plane(void **state) { rides_on(state, hull_tiles); }

// A thousand kilometres out
static void so_they_are_far_out(void **state)
{
    rides_on_at(state, jittered_cells, v3(1e6, 0, -1e6));
    rides_on_at(state, mesh_and_box, v3(1e6, 0, -1e6));
    rides_on_at(state, hull_tiles, v3(1e6, 0, -1e6));
}

// ---- walls ---------------------------------------------------------------------------------------------------------
static fe_geometry wall(scene *s, int is_hull) { return is_hull ? block(s, 0.5, 0.5, 7) : box(0.5, 0.5, 7); }

static void wall_on_mesh(scene *s, vec at, fe_material m)
{
    jittered_cells(s, at, m), add_static(s, wall(s, 0), plus(at, v3(0.5, 0.5, 0)), UNTURNED, m);
}
static void hull_on_field(scene *s, vec at, fe_material m)
{
    place_field(s, make_field(s, 17, 1.0, 0, -8.2, level), plus(at, v3(-8.1, 0, -8.2)), UNTURNED, m);
    add_static(s, wall(s, 1), plus(at, v3(0.5, 0.5, 0)), UNTURNED, m);
}
// Of triangles, upright on the top of a box
static void mesh_on_box(scene *s, vec at, fe_material m)
{
    soup upright = make_soup(14, 1.0, 0, -7, 0.3, level);
    for (int i = 0; i < upright.vertex_count; ++i)
        upright.vertices[3 * i + 1] = upright.vertices[3 * i], upright.vertices[3 * i] = 0.0f;
    lay(s, &upright, at, m), add_static(s, box(8, 0.5, 8), plus(at, v3(0, -0.5, 0)), UNTURNED, m);
}

// Where two grounds make an inner corner, what slides over one is stopped by the other, even what touches only its
// foot, as a cone does.
static void walls_stop_at(void **state, make_ground *ground)
{
    const double heading = 0.1, slop = 0.005, least = 0.3; // rad; m, LINEAR_SLOP; m, of what moves before its origin
    // to the wall, and along it for the rest
    const double most = (WAY / 2 * cos(heading) - least + slop) * cos(heading) + WAY * sin(heading) * sin(heading);
    scene s = scene_begin(state);
    mover movers[MOVERS];
    make_movers(&s, movers);
    ground(&s, v3(0, 0, 0), friction(1));
    for (int k = 0; k < MOVERS; ++k) {
        ride r = go(&s, movers + k, heading, v3(0, 0, 0));
        FE_WITHIN(r.way, 0, most);
    }
    scene_end(&s);
}
static void walls_stop(void **state)
{
    walls_stop_at(state, wall_on_mesh), walls_stop_at(state, hull_on_field), walls_stop_at(state, mesh_on_box);
}

int main(int argc, char **argv)
{
    (void)argv;
    if (argc > 1) headings = 16;
    static setup tilted = {{0, 0, 0.147809f, 0.989016f}, 8}; // by 17 degrees
    const struct CMUnitTest tests[] = {
        TEST(jittered_cells_are_a_plane),
        TEST_WITH(jittered_cells_are_a_plane, ", tilted", tilted),
        TEST(fine_cells_are_a_plane),
        TEST(slivers_are_a_plane),
        TEST_WITH(slivers_are_a_plane, ", tilted", tilted),
        TEST(t_junctions_are_a_plane),
        TEST_WITH(t_junctions_are_a_plane, ", tilted", tilted),
        TEST(two_meshes_are_one),
        TEST_WITH(two_meshes_are_one, ", tilted", tilted),
        TEST(a_mesh_goes_on_as_a_heightfield),
        TEST(a_mesh_goes_on_as_a_box),
        TEST_WITH(a_mesh_goes_on_as_a_box, ", tilted", tilted),
        TEST(a_mesh_goes_on_as_a_hull),
        TEST(a_heightfield_goes_on_as_a_box),
        TEST_WITH(a_heightfield_goes_on_as_a_box, ", tilted", tilted),
        TEST(box_tiles_are_a_plane),
        TEST_WITH(box_tiles_are_a_plane, ", tilted", tilted),
        TEST(hull_tiles_are_a_plane),
        TEST_WITH(hull_tiles_are_a_plane, ", tilted", tilted),
        TEST(so_they_are_far_out),
        TEST(walls_stop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
