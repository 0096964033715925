// Convex hulls, cylinders and furniture: poured into a pit (hulls, cylinders, compounds), stacked (hullpyramid), let
// fall on hills of triangles (rocks) or thrown across them (mixedmesh). How deep they end in each other is measured
// (overlaps.c).
#include "../memory.h"
#include "../random.h"
#include "../scene.h"
#include "../solid.h"

#include <math.h>
#include <string.h>

enum { MOST_POINTS = 32 };

// ---- rocks ---------------------------------------------------------------------------------------------------------

// Uniform over all rotations (Shoemake 1992)
void bench_draw_rotation(uint64_t *state, double *out)
{
    const double a = bench_random(state), b = 2.0 * BENCH_PI * bench_random(state),
                 c = 2.0 * BENCH_PI * bench_random(state);
    out[0] = sqrt(1.0 - a) * sin(b), out[1] = sqrt(1.0 - a) * cos(b);
    out[2] = sqrt(a) * sin(c), out[3] = sqrt(a) * cos(c);
}

static void draw_direction(uint64_t *state, double *out)
{
    const double z = 2.0 * bench_random(state) - 1.0, angle = 2.0 * BENCH_PI * bench_random(state);
    const double r = sqrt(1.0 - z * z);
    out[0] = r * cos(angle), out[1] = r * sin(angle), out[2] = z;
}

bench_shape bench_draw_rock(uint64_t *state, int32_t least, int32_t most)
{
    const int32_t count = least + (int32_t)(bench_random(state) * (most - least + 1));
    double axes[3], points[MOST_POINTS][3];
    for (int k = 0; k < 3; k++) axes[k] = 0.35 + 0.25 * bench_random(state);
    for (int32_t i = 0; i < count; i++) {
        draw_direction(state, points[i]);
        const double depth = 0.85 + 0.15 * bench_random(state);
        for (int k = 0; k < 3; k++) points[i][k] *= axes[k] * depth;
    }
    return bench_make_hull(bench_solid_hull(points, count));
}

// ---- furniture -----------------------------------------------------------------------------------------------------

enum { MOST_PARTS = 6, KINDS = 3 };

typedef struct furniture {
    int32_t count;
    bench_part parts[MOST_PARTS];
} furniture;

static const furniture FURNITURE[KINDS] = {
    {5, // a table
     {{{0.0, 0.45, 0.0}, {0.6f, 0.05f, 0.4f}},
      {{-0.5, 0.0, -0.3}, {0.06f, 0.4f, 0.06f}},
      {{0.5, 0.0, -0.3}, {0.06f, 0.4f, 0.06f}},
      {{-0.5, 0.0, 0.3}, {0.06f, 0.4f, 0.06f}},
      {{0.5, 0.0, 0.3}, {0.06f, 0.4f, 0.06f}}}},
    {6, // a chair
     {{{0.0, 0.0, 0.0}, {0.25f, 0.05f, 0.25f}},
      {{-0.2, 0.35, 0.0}, {0.05f, 0.3f, 0.25f}},
      {{-0.19, -0.3, -0.19}, {0.05f, 0.25f, 0.05f}},
      {{0.19, -0.3, -0.19}, {0.05f, 0.25f, 0.05f}},
      {{-0.19, -0.3, 0.19}, {0.05f, 0.25f, 0.05f}},
      {{0.19, -0.3, 0.19}, {0.05f, 0.25f, 0.05f}}}},
    {2, // a T
     {{{0.0, 0.4, 0.0}, {0.5f, 0.1f, 0.1f}}, {{0.0, -0.1, 0.0}, {0.1f, 0.4f, 0.1f}}}},
};

// About its centre of mass
static bench_shape make_furniture(const furniture *kind)
{
    bench_part *parts = bench_allocate((size_t)kind->count, sizeof *parts);
    double all = 0.0, centre[3] = {0.0, 0.0, 0.0};
    memcpy(parts, kind->parts, (size_t)kind->count * sizeof *parts);
    for (int32_t i = 0; i < kind->count; i++) {
        const double volume = (double)parts[i].half[0] * (double)parts[i].half[1] * (double)parts[i].half[2];
        for (int k = 0; k < 3; k++) centre[k] += volume * parts[i].at[k];
        all += volume;
    }
    for (int32_t i = 0; i < kind->count; i++) {
        for (int k = 0; k < 3; k++) parts[i].at[k] -= centre[k] / all;
    }
    bench_shape shape = bench_make_compound(parts, kind->count);
    shape.density = 500.0f;
    return shape;
}

// ---- poured into a pit ---------------------------------------------------------------------------------------------

static void add_turned(bench_scene *scene, int32_t shape, const double *p, const double *rotation)
{
    const int32_t body = bench_add_dynamic(scene, shape, p[0], p[1], p[2]);
    memcpy(scene->bodies[body].start.rotation, rotation, sizeof scene->bodies[body].start.rotation);
}

// The place of body b, in layers of columns x columns
static void draw_place(uint64_t *state, int32_t b, int32_t columns, double lowest, double pitch, double *out)
{
    const double jitter = 0.2, middle = 0.5 * (columns - 1); // m, columns
    const int32_t layer = b / (columns * columns), c = b % (columns * columns);
    out[0] = pitch * (c % columns - middle) + jitter * (bench_random(state) - 0.5);
    out[1] = lowest + pitch * layer;
    out[2] = pitch * (c / columns - middle) + jitter * (bench_random(state) - 0.5);
}

static void begin_pit(bench_scene *scene, float half_height)
{
    bench_add_pit(scene, half_height);
    scene->ground = BENCH_GROUND_PIT;
    scene->warm_up_steps = 240;
    scene->timed_steps = 240;
}

void bench_build_hulls(bench_scene *scene, int32_t n)
{
    uint64_t state = BENCH_SEED;
    begin_pit(scene, 16.0f);
    for (int32_t b = 0; b < n; b++) {
        double place[3], rotation[4];
        draw_place(&state, b, 8, 1.0, 1.4, place);
        bench_draw_rotation(&state, rotation);
        bench_shape rock = bench_draw_rock(&state, 8, 32);
        rock.friction = 0.5f;
        add_turned(scene, bench_add_shape(scene, rock), place, rotation);
    }
}

void bench_build_cylinders(bench_scene *scene, int32_t n)
{
    uint64_t state = BENCH_SEED;
    begin_pit(scene, 13.0f);
    for (int32_t b = 0; b < n; b++) {
        double place[3], rotation[4];
        draw_place(&state, b, 8, 1.0, 1.4, place);
        bench_draw_rotation(&state, rotation);
        const double half_height = 0.25 + 0.25 * bench_random(&state), radius = 0.25 + 0.15 * bench_random(&state);
        bench_shape shape = bench_make_cylinder((float)half_height, (float)radius);
        shape.friction = 0.5f;
        add_turned(scene, bench_add_shape(scene, shape), place, rotation);
    }
}

void bench_build_compounds(bench_scene *scene, int32_t n)
{
    uint64_t state = BENCH_SEED;
    int32_t shapes[KINDS];
    begin_pit(scene, 16.0f);
    for (int32_t k = 0; k < KINDS; k++) {
        bench_shape shape = make_furniture(&FURNITURE[k]);
        shape.friction = 0.5f;
        shapes[k] = bench_add_shape(scene, shape);
    }
    for (int32_t b = 0; b < n; b++) {
        double place[3], rotation[4];
        draw_place(&state, b, 6, 1.2, 1.8, place);
        bench_draw_rotation(&state, rotation);
        add_turned(scene, shapes[b % KINDS], place, rotation);
    }
}

// ---- stacked -------------------------------------------------------------------------------------------------------

// The pyramid of n rows (pyramid.c), its boxes given as hulls: one hull for all
void bench_build_hullpyramid(bench_scene *scene, int32_t n)
{
    const float h = 0.5f, half[3] = {h, h, h};
    bench_build_pyramid(scene, n);
    bench_shape cube = bench_make_hull(bench_solid_box(half));
    bench_shape *box = &scene->shapes[scene->bodies[scene->body_count - 1].shape];
    cube.density = box->density, cube.friction = box->friction;
    *box = cube;
    scene->ground = BENCH_GROUND_FLOOR;
}

// ---- on hills ------------------------------------------------------------------------------------------------------

static void add_hills(bench_scene *scene)
{
    bench_add_static(scene, bench_add_shape(scene, bench_make_mesh(BENCH_HILLS_CELLS)), 0.0, 0.0, 0.0);
    scene->ground = BENCH_GROUND_MESH;
    scene->timed_steps = 240;
}

void bench_build_rocks(bench_scene *scene, int32_t n)
{
    const double pitch = 1.5, jitter = 0.3; // m
    const int32_t side = (int32_t)ceil(sqrt((double)n));
    uint64_t state = BENCH_SEED;
    add_hills(scene);
    for (int32_t b = 0; b < n; b++) {
        double p[3], rotation[4];
        p[0] = (b % side - 0.5 * side) * pitch + jitter * (bench_random(&state) - 0.5);
        p[1] = 4.0 + bench_random(&state);
        p[2] = (b / side - 0.5 * side) * pitch + jitter * (bench_random(&state) - 0.5);
        bench_draw_rotation(&state, rotation);
        add_turned(scene, bench_add_shape(scene, bench_draw_rock(&state, 12, 24)), p, rotation);
    }
    scene->warm_up_steps = 90;
}

void bench_build_mixedmesh(bench_scene *scene, int32_t n)
{
    enum { FORMS = 4 };
    const double pitch = 1.6, jitter = 0.3, upright[4] = {0.0, 0.0, 0.0, 1.0}; // m, m
    const int32_t side = (int32_t)ceil(sqrt((double)n));
    uint64_t state = BENCH_SEED;
    add_hills(scene);
    for (int32_t b = 0; b < n; b++) {
        double p[3], rotation[4];
        p[0] = (b % side - 0.5 * side) * pitch + jitter * (bench_random(&state) - 0.5);
        p[1] = 3.5;
        p[2] = (b / side - 0.5 * side) * pitch + jitter * (bench_random(&state) - 0.5);
        bench_draw_rotation(&state, rotation);
        bench_shape shape = b % FORMS == 0   ? bench_make_box(0.4f, 0.3f, 0.5f)
                            : b % FORMS == 1 ? bench_make_sphere(0.45f)
                            : b % FORMS == 2 ? bench_make_capsule(0.3f, 0.3f)
                                             : bench_draw_rock(&state, 12, 24);
        shape.friction = 0.4f;
        add_turned(scene, bench_add_shape(scene, shape), p, b % FORMS == 3 ? rotation : upright);
        bench_body *body = &scene->bodies[scene->body_count - 1];
        body->linear_velocity[0] = 5.0f, body->angular_velocity[2] = -10.0f;
    }
    scene->warm_up_steps = 60;
}
