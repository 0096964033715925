// One kind of body, of all sizes, poured into a walled pit: boxes (debris), spheres (balls), capsules (capsulespit).
#include "../random.h"
#include "../scene.h"

static const uint64_t SEED = 0x9e3779b97f4a7c15u;

enum {
    COLUMNS = 8,               // of a layer, along x and along z
    LAYER = COLUMNS * COLUMNS, // bodies of a layer
};

void bench_add_pit(bench_scene *scene, float half_height)
{
    bench_shape wall_x = bench_make_box(1.0f, half_height, 8.0f);
    bench_shape wall_z = bench_make_box(8.0f, half_height, 1.0f);
    wall_x.friction = wall_z.friction = 0.3f;
    int32_t across_x = bench_add_shape(scene, wall_x);
    int32_t across_z = bench_add_shape(scene, wall_z);
    bench_add_static(scene, bench_add_shape(scene, bench_make_box(20.0f, 1.0f, 20.0f)), 0.0, -1.0, 0.0);
    for (int32_t side = -1; side <= 1; side += 2) {
        bench_add_static(scene, across_x, 7.0 * side, (double)half_height - 1.0, 0.0);
        bench_add_static(scene, across_z, 0.0, (double)half_height - 1.0, 7.0 * side);
    }
}

// m, uniform
static float draw(uint64_t *state, double least, double range) { return (float)(least + range * bench_random(state)); }

static bench_shape draw_box(uint64_t *state)
{
    const float x = draw(state, 0.1, 0.5), y = draw(state, 0.1, 0.5);
    return bench_make_box(x, y, draw(state, 0.1, 0.5));
}

static bench_shape draw_sphere(uint64_t *state) { return bench_make_sphere(draw(state, 0.2, 0.3)); }

static bench_shape draw_capsule(uint64_t *state)
{
    const float radius = draw(state, 0.15, 0.2);
    return bench_make_capsule(draw(state, 0.2, 0.3), radius);
}

static void pour(bench_scene *scene, int32_t n, bench_shape (*draw_shape)(uint64_t *))
{
    const double pitch = 1.4, jitter = 0.2, middle = 0.5 * (COLUMNS - 1); // m, m, columns
    uint64_t state = SEED;
    bench_add_pit(scene, 21.0f);
    for (int32_t b = 0; b < n; b++) {
        int32_t layer = b / LAYER, c = b % LAYER;
        double x = pitch * (c % COLUMNS - middle) + jitter * (bench_random(&state) - 0.5);
        double z = pitch * (c / COLUMNS - middle) + jitter * (bench_random(&state) - 0.5);
        bench_shape shape = draw_shape(&state);
        shape.friction = 0.5f;
        bench_add_dynamic(scene, bench_add_shape(scene, shape), x, 1.0 + pitch * layer, z);
    }
    scene->warm_up_steps = 240;
    scene->timed_steps = 240;
}

void bench_build_debris(bench_scene *scene, int32_t n) { pour(scene, n, draw_box); }

void bench_build_balls(bench_scene *scene, int32_t n) { pour(scene, n, draw_sphere); }

void bench_build_capsulespit(bench_scene *scene, int32_t n) { pour(scene, n, draw_capsule); }
