// demo.c - what the library promises, measured: a table of values beside the exact ones, and a pile of 2000 bodies
// against the clock.
//
// Prints each value with its range and writes the same as build/demo.csv. Exits with 1 when a value is out of its
// range.
#include "feather.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DT (1.0f / 60.0f)
#define SUBSTEPS 8
#define GRAVITY 9.81
#define PI 3.14159265358979323846

static FILE *csv;
static int failures;

static void report(const char *scene, const char *value_name, double value, double low, double high, const char *exact)
{
    int ok = value >= low && value <= high; // false for NaN
    printf("%-44s %-26s %14.8g   in [%.8g, %.8g]   exact %-18s %s\n", scene, value_name, value, low, high, exact,
           ok ? "ok" : "OUT OF RANGE");
    if (csv) fprintf(csv, "\"%s, %s\",%.9g,%.9g,%.9g,%d\n", scene, value_name, value, low, high, ok);
    failures += !ok;
}

static void must(fe_result result)
{
    if (result >= 0) return;
    printf("%s: %s\n", fe_result_name(result), fe_last_error());
    exit(1);
}

// ---- building ------------------------------------------------------------------------------------------------------
static fe_world *make_world(int workers)
{
    fe_world_def def;
    fe_world *world;
    fe_world_def_init(&def, sizeof def);
    def.worker_count = workers;
    must(fe_world_create(&def, &world));
    return world;
}

static fe_body add_body(fe_world *world, int32_t type, const fe_transform *at, const fe_geometry *geometry,
                        float density, fe_material material)
{
    fe_body_def body_def;
    fe_shape_def shape_def;
    fe_body body;
    fe_shape shape;
    fe_body_def_init(&body_def, sizeof body_def);
    body_def.type = type;
    body_def.transform = *at;
    must(fe_body_create(world, &body_def, &body));
    fe_shape_def_init(&shape_def, sizeof shape_def);
    shape_def.density = density;
    shape_def.material = material;
    must(fe_shape_create(world, body, &shape_def, geometry, &shape));
    return body;
}

static fe_material make_material(float friction, float restitution)
{
    fe_shape_def defaults;
    fe_shape_def_init(&defaults, sizeof defaults);
    fe_material m = defaults.material;
    m.static_friction = m.dynamic_friction = friction;
    m.restitution = restitution;
    return m;
}

static fe_dvec3 position_of(const fe_world *world, fe_body body)
{
    fe_transform t;
    must(fe_body_get_transform(world, body, &t));
    return t.position;
}

static fe_vec3 velocity_of(const fe_world *world, fe_body body)
{
    fe_vec3 v;
    must(fe_body_get_linear_velocity(world, body, &v));
    return v;
}

static void add_plane(fe_world *world, double angle, fe_material material)
{
    fe_geometry plane;
    fe_transform at = fe_make_transform(0, 0, 0);
    fe_geometry_plane(&plane, (float)-sin(angle), (float)cos(angle), 0, 0);
    add_body(world, FE_BODY_STATIC, &at, &plane, 1000, material);
}

static void run(fe_world *world, int steps)
{
    for (int i = 0; i < steps; ++i) must(fe_world_step(world, DT));
}

static uint64_t hash_of(const fe_world *world)
{
    uint32_t words[2];
    must(fe_world_hash(world, words));
    return (uint64_t)words[1] << 32 | words[0];
}

// ---- the table -----------------------------------------------------------------------------------------------------
static fe_body build_pyramid(fe_world *world)
{
    enum { ROWS = 10 };
    fe_geometry cube;
    fe_body top = 0;
    fe_geometry_box(&cube, 0.25f, 0.25f, 0.25f);
    add_plane(world, 0, make_material(0.6f, 0));
    for (int row = 0; row < ROWS; ++row)
        for (int i = 0; i < ROWS - row; ++i) {
            fe_transform at = fe_make_transform(0.5 * i + 0.25 * row, 0.25 + 0.5 * row, 0);
            top = add_body(world, FE_BODY_DYNAMIC, &at, &cube, 1000, make_material(0.6f, 0));
        }
    return top;
}

static void pyramid(void)
{
    uint64_t hashes[2];
    double height = 0;
    for (int i = 0; i < 2; ++i) {
        fe_world *world = make_world(1 + i);
        fe_body top = build_pyramid(world);
        run(world, 180);
        height = position_of(world, top).y;
        hashes[i] = hash_of(world);
        must(fe_world_destroy(world));
    }
    report("pyramid of 55 boxes of 0.5 m, 3 s", "top box, m", height, 4.742, 4.750, "4.750");
    report("same scene, run twice", "identical", hashes[0] == hashes[1], 1, 1, "1");
}

// a cube of 1 m, flush on a slope; the distance it covers along the slope between two moments
static double slide(double degrees, float friction, int from_step, int to_step)
{
    fe_world *world = make_world(1);
    fe_geometry cube;
    double angle = degrees * PI / 180;
    fe_transform at = fe_make_transform(-0.5 * sin(angle), 0.5 * cos(angle), 0);
    at.rotation.z = (float)sin(angle / 2), at.rotation.w = (float)cos(angle / 2);
    fe_geometry_box(&cube, 0.5f, 0.5f, 0.5f);
    add_plane(world, angle, make_material(friction, 0));
    fe_body box = add_body(world, FE_BODY_DYNAMIC, &at, &cube, 1000, make_material(friction, 0));
    run(world, from_step);
    fe_dvec3 a = position_of(world, box);
    run(world, to_step - from_step);
    fe_dvec3 b = position_of(world, box);
    must(fe_world_destroy(world));
    return hypot((b.x - a.x) * cos(angle) + (b.y - a.y) * sin(angle), b.z - a.z);
}

// lets a body fall freely through `clear` metres; the clear height of its first rebound
static double rebound(const fe_geometry *geometry, double half, double clear, float restitution)
{
    fe_world *world = make_world(1);
    fe_transform at = fe_make_transform(0, half + clear, 0);
    add_plane(world, 0, make_material(0.6f, restitution));
    fe_body body = add_body(world, FE_BODY_DYNAMIC, &at, geometry, 1000, make_material(0.6f, restitution));
    double highest = 0;
    for (int i = 0, up = 0; i < 120; ++i) {
        run(world, 1);
        float vy = velocity_of(world, body).y;
        double y = position_of(world, body).y - half;
        up |= vy > 0;
        // between two steps the top lies vy^2 / 2g above
        if (up && vy > 0 && vy < GRAVITY * DT) highest = y + (double)vy * (double)vy / (2 * GRAVITY);
        if (up && vy < 0) break;
    }
    must(fe_world_destroy(world));
    return highest;
}

static void push(void)
{
    fe_world *world = make_world(1);
    fe_geometry ball;
    fe_transform at = fe_make_transform(0, 0, 0);
    fe_vec3 none = {0, 0, 0}, force = {10, 0, 0};
    float mass;
    must(fe_world_set_gravity(world, &none));
    fe_geometry_sphere(&ball, 0.25f);
    fe_body body = add_body(world, FE_BODY_DYNAMIC, &at, &ball, 500, make_material(0.6f, 0));
    must(fe_body_get_mass(world, body, &mass));
    for (int i = 0; i < 60; ++i) {
        must(fe_body_add_force(world, body, &force));
        run(world, 1);
    }
    double speed = velocity_of(world, body).x, exact = 10 / (double)mass;
    report("10 N for 1 s on 32.7 kg", "speed, m/s", speed, exact * (1 - 2e-5), exact * (1 + 2e-5), "0.30558");
    must(fe_world_destroy(world));
}

// ---- normals -------------------------------------------------------------------------------------------------------
static uint64_t random_state = 0x9e3779b97f4a7c15u;

static double uniform(double low, double high)
{
    random_state ^= random_state << 13, random_state ^= random_state >> 7, random_state ^= random_state << 17;
    return low + (high - low) * (double)(random_state >> 11) / 9007199254740992.0;
}

static fe_dvec3 turn(fe_quat q, fe_dvec3 a)
{
    double x = q.x, y = q.y, z = q.z, w = q.w, k = 2 / (x * x + y * y + z * z + w * w);
    fe_dvec3 t = {y * a.z - z * a.y, z * a.x - x * a.z, x * a.y - y * a.x};
    return fe_make_dvec3(a.x + k * (w * t.x + y * t.z - z * t.y), a.y + k * (w * t.y + z * t.x - x * t.z),
                         a.z + k * (w * t.z + x * t.y - y * t.x));
}

// outward normal of a box of half extents h at the point of its surface nearest to c (box frame)
static fe_dvec3 exact_normal(const double *h, const double *c)
{
    double d[3], square = 0, least = 1e30;
    int face = 0;
    for (int k = 0; k < 3; ++k) {
        d[k] = c[k] > h[k] ? c[k] - h[k] : c[k] < -h[k] ? c[k] + h[k] : 0;
        square += d[k] * d[k];
        if (h[k] - fabs(c[k]) < least) least = h[k] - fabs(c[k]), face = k;
    }
    for (int k = 0; k < 3 && square == 0; ++k) d[k] = k == face ? (c[k] < 0 ? -1 : 1) : 0;
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    return fe_make_dvec3(d[0] / length, d[1] / length, d[2] / length);
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// a static box and a sphere that overlaps it, in random poses; the angle between the contact's normal and the exact
// one, degrees
static double normal_error(int i)
{
    fe_world *world = make_world(1);
    double h[3], c[3], radius = uniform(0.1, 0.5);
    for (int k = 0; k < 3; ++k) h[k] = uniform(0.2, 1), c[k] = uniform(-h[k] - 0.5 * radius, h[k] + 0.5 * radius);
    for (int k = 0; k < 3; ++k) h[k] = (float)h[k];
    fe_transform box_at = fe_make_transform(uniform(-50, 50), uniform(-50, 50), uniform(-50, 50)), ball_at = box_at;
    fe_quat q = {(float)uniform(-1, 1), (float)uniform(-1, 1), (float)uniform(-1, 1), (float)uniform(0.1, 1)};
    box_at.rotation = q;
    fe_geometry box, ball;
    fe_geometry_box(&box, (float)h[0], (float)h[1], (float)h[2]);
    fe_geometry_sphere(&ball, (float)radius);
    fe_body block = add_body(world, FE_BODY_STATIC, &box_at, &box, 1000, make_material(0.6f, 0));
    must(fe_body_get_transform(world, block, &box_at));
    fe_dvec3 offset = turn(box_at.rotation, fe_make_dvec3(c[0], c[1], c[2]));
    ball_at.position =
        fe_make_dvec3(box_at.position.x + offset.x, box_at.position.y + offset.y, box_at.position.z + offset.z);
    fe_body sphere = add_body(world, FE_BODY_DYNAMIC, &ball_at, &ball, 1000, make_material(0.6f, 0));
    must(fe_world_step(world, 0));
    fe_contact contact;
    if (fe_body_get_contacts(world, sphere, &contact, sizeof contact, 1) != 1) {
        printf("pair %d: no contact\n", i);
        exit(1);
    }
    fe_dvec3 n = turn(box_at.rotation, exact_normal(h, c)), m = {contact.normal.x, contact.normal.y, contact.normal.z};
    fe_dvec3 x = {n.y * m.z - n.z * m.y, n.z * m.x - n.x * m.z, n.x * m.y - n.y * m.x};
    double error = atan2(sqrt(x.x * x.x + x.y * x.y + x.z * x.z), n.x * m.x + n.y * m.y + n.z * m.z);
    must(fe_world_destroy(world));
    return error * 180 / PI;
}

static void normals(void)
{
    enum { PAIRS = 2000 };
    static double errors[PAIRS];
    for (int i = 0; i < PAIRS; ++i) errors[i] = normal_error(i);
    qsort(errors, PAIRS, sizeof *errors, compare_doubles);
    report("sphere on box, 2000 random poses", "normal, 99th %, degrees", errors[PAIRS * 99 / 100], 0, 0.001, "0");
}

// ---- hulls on a mesh ------------------------------------------------------------------------------------------------
// A valley of square cells of 1 m whose height is the sum of two profiles, each x^2 / 16 at whole metres and straight
// between: all its edges are hollow, so that of a convex body no point is deeper below it than its deepest corner.
enum { CELLS = 24, SAMPLES = CELLS + 1, ROCK_POINTS = 24, ROCK_KINDS = 8, ROCKS = 400 };

static double profile(double x)
{
    double i = floor(x);
    return (i * i + (2 * i + 1) * (x - i)) / 16;
}

static void add_valley(fe_world *world, fe_store *store)
{
    static float vertices[SAMPLES * SAMPLES][3];
    static uint16_t triangles[CELLS * CELLS][2][3];
    for (int i = 0; i < SAMPLES * SAMPLES; ++i) {
        int x = i % SAMPLES - CELLS / 2, z = i / SAMPLES - CELLS / 2;
        vertices[i][0] = (float)x, vertices[i][1] = (float)(profile(x) + profile(z)), vertices[i][2] = (float)z;
    }
    for (int i = 0; i < CELLS * CELLS; ++i) {
        uint16_t a = (uint16_t)(i / CELLS * SAMPLES + i % CELLS), b = (uint16_t)(a + 1), c = (uint16_t)(a + SAMPLES);
        uint16_t corners[2][3] = {{a, c, (uint16_t)(c + 1)}, {a, (uint16_t)(c + 1), b}};
        memcpy(triangles[i], corners, sizeof corners);
    }
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = vertices[0], def.vertex_count = SAMPLES * SAMPLES;
    def.indices = triangles, def.triangle_count = 2 * CELLS * CELLS, def.index_type = FE_INDEX_U16;
    fe_asset mesh;
    must(fe_mesh_create(store, &def, &mesh));
    fe_geometry form;
    fe_geometry_mesh(&form, mesh);
    fe_transform at = fe_make_transform(0, 0, 0);
    add_body(world, FE_BODY_STATIC, &at, &form, 1000, make_material(0.6f, 0));
}

static fe_asset make_rock(fe_store *store)
{
    float points[ROCK_POINTS][3];
    for (int i = 0; i < ROCK_POINTS; ++i) {
        points[i][0] = (float)uniform(-0.5, 0.5), points[i][1] = (float)uniform(-0.3, 0.3);
        points[i][2] = (float)uniform(-0.4, 0.4);
    }
    fe_hull_def def;
    fe_hull_def_init(&def, sizeof def);
    def.points = points[0], def.point_count = ROCK_POINTS;
    fe_asset rock;
    must(fe_hull_create(store, &def, &rock));
    return rock;
}

// How far the deepest corner of a body's hull is below the valley, m; less than 0: above
static double depth_of(const fe_world *world, const fe_store *store, fe_body body, fe_asset rock)
{
    fe_vec3 corners[ROCK_POINTS];
    int32_t count = fe_hull_get_vertices(store, rock, corners, 0, ROCK_POINTS);
    fe_transform at;
    must(fe_body_get_transform(world, body, &at));
    double deepest = -INFINITY;
    for (int32_t i = 0; i < count; ++i) {
        fe_dvec3 offset = turn(at.rotation, fe_make_dvec3(corners[i].x, corners[i].y, corners[i].z));
        double ground = profile(at.position.x + offset.x) + profile(at.position.z + offset.z);
        deepest = fmax(deepest, ground - at.position.y - offset.y);
    }
    return deepest;
}

static void rocks(void)
{
    fe_world *world = make_world(1);
    fe_store *store;
    must(fe_world_get_store(world, &store));
    add_valley(world, store);
    fe_asset kinds[ROCK_KINDS];
    fe_body bodies[ROCKS];
    for (int i = 0; i < ROCK_KINDS; ++i) kinds[i] = make_rock(store);
    for (int i = 0; i < ROCKS; ++i) {
        fe_geometry form;
        fe_geometry_hull(&form, kinds[i % ROCK_KINDS]);
        fe_transform at = fe_make_transform(1.1 * (i % 10 - 4.5), 5 + 0.9 * (i / 100), 1.1 * (i / 10 % 10 - 4.5));
        bodies[i] = add_body(world, FE_BODY_DYNAMIC, &at, &form, 2500, make_material(0.6f, 0));
    }
    run(world, 480);
    double deepest = -INFINITY;
    for (int i = 0; i < ROCKS; ++i) deepest = fmax(deepest, depth_of(world, store, bodies[i], kinds[i % ROCK_KINDS]));
    report("400 hulls in a valley of triangles, 8 s", "deepest corner below, mm", 1e3 * deepest, 0, 5, "0");
    must(fe_world_destroy(world));
}

// ---- the pile ------------------------------------------------------------------------------------------------------
// A step, and the milliseconds that it took
static double timed_step(fe_world *world)
{
    fe_profile profile = {.struct_size = sizeof profile};
    run(world, 1);
    must(fe_world_get_profile(world, &profile));
    return profile.step;
}

// boxes, spheres and capsules poured into a pit of four walls
static void build_pile(fe_world *world, fe_body *bodies, int count)
{
    enum { SIDE = 10 };
    fe_geometry kinds[3], wall;
    fe_transform at;
    fe_geometry_box(&kinds[0], 0.4f, 0.3f, 0.5f);
    fe_geometry_sphere(&kinds[1], 0.45f);
    fe_geometry_capsule(&kinds[2], 0.3f, 0.3f);
    add_plane(world, 0, make_material(0.5f, 0));
    for (int i = 0; i < 4; ++i) {
        double x = i < 2 ? 16 * i - 8 : 0, z = i < 2 ? 0 : 16 * (i - 2) - 8;
        fe_geometry_box(&wall, i < 2 ? 1.0f : 9.0f, 20.0f, i < 2 ? 9.0f : 1.0f);
        at = fe_make_transform(x, 20, z);
        add_body(world, FE_BODY_STATIC, &at, &wall, 1000, make_material(0.3f, 0));
    }
    for (int i = 0; i < count; ++i) {
        int place = i % (SIDE * SIDE);
        at = fe_make_transform(1.3 * (place % SIDE - 4.5) + uniform(-0.1, 0.1), 1 + 1.5 * (i / (SIDE * SIDE)),
                               1.3 * (place / SIDE - 4.5) + uniform(-0.1, 0.1));
        bodies[i] = add_body(world, FE_BODY_DYNAMIC, &at, &kinds[i % 3], 1000, make_material(0.5f, 0));
    }
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// How much the body's surface at a point gives along n: 1/m + (r x n) . I^-1 (r x n), 1/kg; 0 for one that is not
// dynamic. Centre of mass and principal axes of the pile's bodies are their frames.
static double yielding(const fe_world *world, fe_body body, fe_dvec3 point, fe_vec3 n)
{
    fe_mass_data data = {.struct_size = sizeof data};
    float mass;
    must(fe_body_get_mass(world, body, &mass));
    if (mass == 0) return 0;
    fe_transform at;
    must(fe_body_get_mass_data(world, body, &data));
    must(fe_body_get_transform(world, body, &at));
    double r[3] = {point.x - at.position.x, point.y - at.position.y, point.z - at.position.z};
    double v[3] = {r[1] * n.z - r[2] * n.y, r[2] * n.x - r[0] * n.z, r[0] * n.y - r[1] * n.x};
    double x = at.rotation.x, y = at.rotation.y, z = at.rotation.z, w = at.rotation.w;
    double x_axis[3] = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)};
    double y_axis[3] = {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)};
    double z_axis[3] = {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
    return 1 / mass + pow(dot(x_axis, v), 2) / data.inertia.x + pow(dot(y_axis, v), 2) / data.inertia.y +
           pow(dot(z_axis, v), 2) / data.inertia.z;
}

typedef struct overlap_sums {
    double overlaps, formula, deepest; // m
} overlap_sums;

// A contact is a spring: at rest a point that bears the force f overlaps by f (sum of yieldings) / w2, w = 2 pi hertz,
// twice the hertz against what is not dynamic.
static void add_overlaps(const fe_world *world, const fe_contact *contact, overlap_sums *sums)
{
    const double hertz = 30, substep = DT / SUBSTEPS; // the library's defaults
    for (int32_t p = 0; p < contact->point_count; ++p) {
        const fe_contact_point *point = &contact->points[p];
        double a = yielding(world, contact->body_a, point->point, contact->normal);
        double b = yielding(world, contact->body_b, point->point, contact->normal);
        double w = 2 * PI * hertz * (a > 0 && b > 0 ? 1 : 2), force = point->normal_impulse / substep;
        if (!(force > 0)) continue;
        sums->overlaps -= point->separation;
        sums->formula += force * (a + b) / (w * w);
        sums->deepest = fmax(sums->deepest, -point->separation);
    }
}

// of all loaded points of the bodies
static overlap_sums sum_overlaps(const fe_world *world, const fe_body *bodies, int count)
{
    overlap_sums sums = {0};
    for (int i = 0; i < count; ++i) {
        fe_contact contacts[64];
        int32_t n = fe_body_get_contacts(world, bodies[i], contacts, sizeof *contacts, 64);
        for (int32_t k = 0; k < n && k < 64; ++k) add_overlaps(world, &contacts[k], &sums);
    }
    return sums;
}

static void pile(void)
{
    enum { BODIES = 2000, STEPS = 300 };
    uint64_t hashes[2];
    fe_body bodies[BODIES];
    overlap_sums sums;
    for (int workers = 1; workers <= 2; ++workers) {
        random_state = 0x1234567;
        fe_world *world = make_world(workers);
        build_pile(world, bodies, BODIES);
        double sum = 0, worst = 0;
        for (int i = 0; i < STEPS; ++i) {
            double ms = timed_step(world);
            sum += ms;
            worst = fmax(worst, ms);
        }
        fe_counters counters = {.struct_size = sizeof counters};
        must(fe_world_get_counters(world, &counters));
        hashes[workers - 1] = hash_of(world);
        char scene[64];
        snprintf(scene, sizeof scene, "pile of %d bodies, 5 s, %d worker%s", BODIES, workers, workers > 1 ? "s" : "");
        report(scene, "ms per step", sum / STEPS, 0, INFINITY, "-");
        printf("%-44s worst step %.2f ms, %d contacts, %d awake, %.0f KB\n", "", worst, counters.contacts,
               counters.awake_bodies, (double)counters.bytes / 1024);
        sums = sum_overlaps(world, bodies, BODIES);
        must(fe_world_destroy(world));
    }
    printf("%-44s deepest overlap %.1f mm\n", "", 1e3 * sums.deepest);
    report("pile of 2000 bodies, 5 s", "overlaps / (f / m_eff w2)", sums.overlaps / sums.formula, 0.98, 1.02, "1");
    report("pile of 2000 bodies, 1 and 2 workers", "identical", hashes[0] == hashes[1], 1, 1, "1");
}

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : "build/demo.csv";
    csv = fopen(path, "w");
    if (!csv) printf("cannot write %s\n", path);
    if (csv) fprintf(csv, "scene,value,low,high,ok\n");
    fe_geometry ball, cube;
    fe_geometry_sphere(&ball, 0.25f);
    fe_geometry_box(&cube, 0.25f, 0.25f, 0.25f);

    printf("Feather %d.%d.%d, 60 Hz, %d substeps\n\n", FE_VERSION_MAJOR, FE_VERSION_MINOR, FE_VERSION_PATCH, SUBSTEPS);
    pyramid();
    report("box on a 20 degree slope, friction 0.6", "slip in 10 s, m", slide(20, 0.6f, 0, 600), 0, 0.001, "0");
    report("box on a 35 degree slope, friction 0.3", "0.5 s to 2.5 s, m", slide(35, 0.3f, 30, 150), 9.650, 9.660,
           "9.648 (9.655)");
    report("bounce from 1 m, restitution 0.5: sphere", "height, m", rebound(&ball, 0.25, 1, 0.5f), 0.2490, 0.2502,
           "0.25");
    report("bounce from 1 m, restitution 0.5: flat box", "height, m", rebound(&cube, 0.25, 1, 0.5f), 0.2490, 0.2502,
           "0.25");
    push();
    normals();
    rocks();
    pile();

    if (csv) fclose(csv);
    printf("\n%s\n", failures ? "SOME VALUES ARE OUT OF RANGE" : "every value is in its range");
    return failures || !csv;
}
