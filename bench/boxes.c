// boxes.c - see boxes.h.
#include "boxes.h"

#include "random.h"

#include <stddef.h>

void bench_add_body(fe_world *world, int32_t type, double x, double y, double z, const fe_geometry *form)
{
    fe_body_def def;
    fe_body body = 0;
    fe_shape shape = 0;
    fe_body_def_init(&def, sizeof def);
    def.type = type, def.transform = fe_make_transform(x, y, z);
    fe_body_create(world, &def, &body);
    fe_shape_create(world, body, NULL, form, &shape);
}

static fe_world *create(int32_t sleeps)
{
    fe_world_def def;
    fe_world_tuning tuning;
    fe_geometry ground;
    fe_world *world = NULL;
    fe_world_def_init(&def, sizeof def);
    def.worker_count = 1;
    if (fe_world_create(&def, &world) != FE_OK) return NULL;
    fe_world_tuning_init(&tuning, sizeof tuning);
    tuning.sleep_enabled = sleeps;
    fe_world_set_tuning(world, &tuning);
    fe_geometry_box(&ground, 300.0f, 1.0f, 300.0f);
    bench_add_body(world, FE_BODY_STATIC, 0.0, -1.0, 0.0, &ground);
    return world;
}

static fe_world *stepped(fe_world *world, int32_t steps)
{
    for (int32_t i = 0; i < steps; ++i)
        if (fe_world_step(world, 1.0f / 60.0f) != FE_OK) return NULL;
    return world;
}

fe_world *bench_create_pile(int32_t boxes)
{
    enum { COLUMNS = 8, LAYER = COLUMNS * COLUMNS, STEPS = 400 };
    const double pitch = 1.05, jitter = 0.1, layer_height = 1.2; // m
    fe_world *world = create(0);
    uint64_t state = 0x9e3779b97f4a7c15u;
    fe_geometry form;
    if (world == NULL) return NULL;
    fe_geometry_box(&form, 0.5f, 0.5f, 0.5f);
    for (int32_t i = 0; i < boxes; ++i) {
        int32_t c = i % LAYER;
        double x = pitch * (c % COLUMNS - COLUMNS / 2) + jitter * bench_random(&state);
        double z = pitch * (c / COLUMNS - COLUMNS / 2) + jitter * bench_random(&state);
        bench_add_body(world, FE_BODY_DYNAMIC, x, 1.0 + layer_height * (i / LAYER), z, &form);
    }
    return stepped(world, STEPS);
}

fe_world *bench_create_rest(int32_t boxes)
{
    enum { SIDE = 100, STEPS = 120 };
    const double pitch = 1.5; // m
    fe_world *world = create(1);
    fe_geometry form;
    if (world == NULL) return NULL;
    fe_geometry_box(&form, 0.5f, 0.5f, 0.5f);
    for (int32_t i = 0; i < boxes; ++i)
        bench_add_body(world, FE_BODY_DYNAMIC, pitch * (i % SIDE), 0.5, pitch * (i / SIDE), &form);
    return stepped(world, STEPS);
}
