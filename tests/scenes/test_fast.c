// Every form at 10 to 1000 m/s, sticks that spin among them, at hulls, cylinders, meshes and heightfields, which stand
// or come to meet them: none goes through.
//
//     build/tests/scenes/test_fast 10000      that many bodies
//
// What goes through is told by the body's centre, and a case that fails is printed.
#include "scenes/mechanics.h"
#include "scenes/meshes.h"

#include <stdio.h>

enum { SPHERE, CAPSULE, BOX, CYLINDER, CONE, HULL, STICK, KINDS };
enum { SLAB, DISC, SHEET, POLE, MESH_HILLS, FIELD_HILLS, TARGETS }; // the first three have a front, along their y axis
enum { STEPS = 15 };

static const char *const kind_names[] = {"sphere", "capsule", "box", "cylinder", "cone", "hull", "stick"};
static const char *const target_names[] = {"slab of a hull", "disc", "sheet of a mesh", "pole", "mesh", "heightfield"};

static int bodies = SLOW_BUILD ? 84 : 420;

typedef struct shot {
    fe_body body, target;
    vec before; // the centre, from the target
    fe_quat attitude;
    double radius, speed; // m, of a pole; m/s
} shot;

// ---- forms ---------------------------------------------------------------------------------------------------------
static fe_geometry hull_of(scene *s, const float (*points)[3], int count)
{
    fe_hull_def def;
    fe_asset asset = 0;
    fe_geometry form;
    fe_hull_def_init(&def, sizeof def);
    def.points = points[0], def.point_count = count;
    MUST(fe_hull_create(world_store(s->world), &def, &asset));
    fe_geometry_hull(&form, asset);
    return form;
}

// A box, then a point on each side of it that sticks out by up to as much again
static fe_geometry rock(scene *s, dice *d)
{
    float points[14][3];
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 3; ++k) points[i][k] = i >> k & 1 ? 0.1f : -0.1f;
    for (int i = 8; i < 14; ++i) {
        for (int k = 0; k < 3; ++k) points[i][k] = (float)uniform(d, -0.05, 0.05);
        points[i][i / 2 - 4] = (float)(uniform(d, 0.11, 0.2) * (i % 2 ? 1 : -1));
    }
    return hull_of(s, (const float(*)[3])points, 14);
}

static fe_geometry stick(dice *d)
{
    fe_geometry form;
    double half = uniform(d, 1, 2), r = uniform(d, 0.05, 0.1);
    fe_geometry_cylinder(&form, (float)half, (float)r);
    int sort = pick(d, 3);
    return sort == 0 ? box(r, half, r) : sort == 1 ? capsule(half, r) : form;
}

static fe_geometry form_of(scene *s, dice *d, int kind)
{
    fe_geometry form;
    double a = uniform(d, 0.1, 0.5), b = uniform(d, 0.1, 0.4);
    switch (kind) {
    case SPHERE:
        return sphere(0.1);
    case CAPSULE:
        return capsule(a, 0.1);
    case BOX:
        return box(a, b, 0.1);
    case CYLINDER:
        fe_geometry_cylinder(&form, (float)a, (float)b);
        return form;
    case CONE:
        fe_geometry_cone(&form, (float)a, (float)b);
        return form;
    case HULL:
        return rock(s, d);
    default:
        return stick(d);
    }
}

static double hills(double x, double z) { return 0.5 * sin(0.9 * x) * sin(0.7 * z); }

// Of a grid of 1 m; which diagonal a cell has, the mesh changes from cell to cell
static double hills_below(double x, double z, int is_mesh)
{
    double c = floor(x), r = floor(z), u = x - c, v = z - r;
    double h00 = hills(c, r), h10 = hills(c + 1, r), h01 = hills(c, r + 1), h11 = hills(c + 1, r + 1);
    int is_other = is_mesh && ((int)c + (int)r) % 2 == 0; // from (c + 1, r) to (c, r + 1)
    if (!is_other) return v >= u ? h00 + v * (h01 - h00) + u * (h11 - h01) : h00 + u * (h10 - h00) + v * (h11 - h10);
    return u + v <= 1 ? h00 + u * (h10 - h00) + v * (h01 - h00) : h11 + (1 - u) * (h01 - h11) + (1 - v) * (h10 - h11);
}

// ---- targets -------------------------------------------------------------------------------------------------------
typedef struct assets {
    fe_asset sheet, hills, field;
} assets;

static assets make_assets(scene *s)
{
    soup sheet = make_soup(40, 1.5, -30, -30, 0.3, level), hilly = make_soup(100, 1, -50, -50, 0, hills);
    assets a = {make_mesh(s, &sheet, 0), make_mesh(s, &hilly, 0), make_field(s, 100, 1, -50, -50, hills)};
    soup_free(&sheet);
    soup_free(&hilly);
    return a;
}

// 60 m wide, and 1 to 20 cm thick or none
static fe_geometry target_form(scene *s, dice *d, const assets *a, int target, double *out_radius)
{
    enum { SIDES = 16 };
    fe_geometry form;
    double half = uniform(d, 0.005, 0.1);
    *out_radius = uniform(d, 0.05, 0.5);
    if (target == SLAB) {
        float points[2 * SIDES][3];
        for (int i = 0; i < 2 * SIDES; ++i) {
            double angle = 2 * PI * (i / 2) / SIDES;
            points[i][0] = (float)(30 * cos(angle)), points[i][2] = (float)(30 * sin(angle));
            points[i][1] = (float)(i % 2 ? half : -half);
        }
        return hull_of(s, (const float(*)[3])points, 2 * SIDES);
    }
    if (target == DISC) fe_geometry_cylinder(&form, (float)half, 30);
    if (target == POLE) fe_geometry_cylinder(&form, 30, (float)*out_radius);
    if (target == SHEET) fe_geometry_mesh(&form, a->sheet);
    if (target == MESH_HILLS) fe_geometry_mesh(&form, a->hills);
    if (target == FIELD_HILLS) fe_geometry_heightfield(&form, a->field);
    return form;
}

static vec relative(const scene *s, const shot *a)
{
    return rotate(inverse(a->attitude), minus(position(s, a->body), position(s, a->target)));
}

// From 0.7 m and more before the target, and up to a step's way farther, at something near its middle. Half of those
// with a front, and of the poles, come towards the body.
static shot add_shot(scene *s, dice *d, const assets *assets, vec place, int kind, int target)
{
    int is_ground = target == MESH_HILLS || target == FIELD_HILLS;
    shot a = {.attitude = is_ground ? UNTURNED : any_rotation(d), .speed = pow(10, uniform(d, 1, 3))};
    fe_geometry standing = target_form(s, d, assets, target, &a.radius), flying = form_of(s, d, kind);
    double part = is_ground || pick(d, 2) ? 0 : uniform(d, 0.1, 1), mu = uniform(d, 0, 1), e = uniform(d, 0, 1);
    double tilt = uniform(d, 0, is_ground ? 60 : 70) * DEGREES, around = uniform(d, 0, 2 * PI);
    vec way = v3(sin(tilt) * cos(around), -cos(tilt), sin(tilt) * sin(around)), towards = v3(0, 1, 0),
        aim = v3(0, 0, 0);
    if (target == POLE) { // from aside
        way = v3(-cos(tilt), sin(tilt), 0), towards = v3(1, 0, 0);
        aim = v3(0, uniform(d, -2, 2), uniform(d, -a.radius, a.radius));
    } else {
        aim = v3(uniform(d, -2, 2), 0, uniform(d, -2, 2));
    }
    double clear = (kind == STICK ? 2.2 : 0.7) + (is_ground ? 0.5 : target == POLE ? a.radius : 0.1);
    vec from = minus(aim, times(clear / cos(tilt) + uniform(d, 0, 1) * a.speed * STEP, way));
    vec corner = target == FIELD_HILLS ? v3(-50, 0, -50) : v3(0, 0, 0);
    a.target = add_body(s, part > 0 ? FE_BODY_KINEMATIC : FE_BODY_STATIC, standing, plus(place, corner), a.attitude,
                        bouncy(mu, e), WATER);
    a.body = add_dynamic(s, flying, plus(place, rotate(a.attitude, from)), any_rotation(d), bouncy(mu, e), WATER);
    vec wall = times(part * a.speed, towards);
    if (part > 0) set_velocity(s, a.target, rotate(a.attitude, wall), v3(0, 0, 0));
    set_velocity(s, a.body, rotate(a.attitude, times((1 - part) * a.speed, way)),
                 somewhere(d, kind == STICK ? 50 : 20));
    a.before = relative(s, &a);
    return a;
}

// Of the way from a to b, in x and z, from the y axis
static double distance_to_axis(vec a, vec b)
{
    double x = b.x - a.x, z = b.z - a.z, square = x * x + z * z;
    double t = square > 0 ? fmax(0, fmin(1, -(a.x * x + a.z * z) / square)) : 0;
    return hypot(a.x + t * x, a.z + t * z);
}

// In front of it, or past its edge
static int is_held(const scene *s, shot *a, int target)
{
    vec p = relative(s, a), before = a->before;
    a->before = p;
    if (target == POLE) return fabs(p.y) > 29 || distance_to_axis(before, p) > 0.9 * a->radius;
    if (target == FIELD_HILLS) p.x -= 50, p.z -= 50;
    if (target == MESH_HILLS || target == FIELD_HILLS)
        return fabs(p.x) > 49 || fabs(p.z) > 49 || p.y > hills_below(p.x, p.z, target == MESH_HILLS);
    return p.y > 0 || hypot(p.x, p.z) > 29;
}

static void shoot(void **state, int target)
{
    int count = bodies / TARGETS / KINDS * KINDS;
    dice d = {(uint64_t)(1 + target)};
    scene s = scene_begin(state);
    shot *shots = calloc((size_t)count, sizeof *shots);
    set_gravity(&s, v3(0, 0, 0));
    assets assets = make_assets(&s);
    for (int i = 0; i < count; ++i)
        shots[i] = add_shot(&s, &d, &assets, v3(500.0 * (i % 100), 500.0 * (i / 100), 0), i % KINDS, target);
    for (int step = 0; step < STEPS; ++step) {
        run(&s, 1);
        for (int i = 0; i < count; ++i) {
            if (is_held(&s, shots + i, target)) continue;
            vec p = shots[i].before;
            print_error("%s %d at %g m/s through a %s in step %d, now at %g %g %g from it\n", kind_names[i % KINDS], i,
                        shots[i].speed, target_names[target], step, p.x, p.y, p.z);
            fail();
        }
    }
    printf("%d bodies at a %s: none through\n", count, target_names[target]);
    free(shots);
    scene_end(&s);
}

static void hulls_hold(void **state) { shoot(state, SLAB); }
static void cylinders_caps_hold(void **state) { shoot(state, DISC); }
static void flat_meshes_hold(void **state) { shoot(state, SHEET); }
static void poles_hold(void **state) { shoot(state, POLE); }
static void hilly_meshes_hold(void **state) { shoot(state, MESH_HILLS); }
static void hilly_heightfields_hold(void **state) { shoot(state, FIELD_HILLS); }

int main(int argc, char **argv)
{
    if (argc > 1) bodies = atoi(argv[1]) + TARGETS * KINDS - 1; // no fewer than that
    const struct CMUnitTest tests[] = {TEST(hulls_hold), TEST(cylinders_caps_hold), TEST(flat_meshes_hold),
                                       TEST(poles_hold), TEST(hilly_meshes_hold),   TEST(hilly_heightfields_hold)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
