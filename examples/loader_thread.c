// loader_thread.c - the next level loads while the present one plays: a thread fills a store, the world steps.
//
//     cc loader_thread.c -lfeather -lm -pthread -o loader_thread && ./loader_thread
//
// A store may be filled by any thread while worlds that use it step. A world belongs to one thread: the loader never
// touches it. It makes the heightfields, which is the expensive part, and hands their handles over; the thread of the
// world makes the shapes. Two worlds share the store here: a field is in memory once.
#include "feather.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#define DT (1.0f / 60)

enum { TILES = 8, SAMPLES = 129, BALLS = 16, WORLDS = 2 };

typedef struct loader {
    fe_store *store;
    pthread_mutex_t lock; // guards the two below
    fe_asset tiles[TILES];
    int ready;
} loader;

static int32_t must(int32_t result)
{
    if (result >= 0) return result;
    printf("%s\n", fe_last_error());
    exit(1);
}

// Tile k covers x in [64 k, 64 k + 64]. Heights depend on the place alone, so that neighbours meet.
static void *load(void *argument)
{
    loader *l = argument;
    static float heights[SAMPLES * SAMPLES];
    for (int tile = 0; tile < TILES; ++tile) {
        for (int row = 0; row < SAMPLES; ++row)
            for (int column = 0; column < SAMPLES; ++column)
                heights[row * SAMPLES + column] =
                    sinf(0.1f * (float)(tile * (SAMPLES - 1) + column)) * cosf(0.1f * (float)row);
        fe_heightfield_def def;
        fe_heightfield_def_init(&def, sizeof def);
        def.rows = def.columns = SAMPLES;
        def.cell_x = def.cell_z = 0.5f;
        def.heights = heights;
        fe_asset asset;
        must(fe_heightfield_create(l->store, &def, &asset));
        pthread_mutex_lock(&l->lock);
        l->tiles[l->ready++] = asset;
        pthread_mutex_unlock(&l->lock);
    }
    return NULL;
}

static int take_ready(loader *l, fe_asset *out_tiles)
{
    pthread_mutex_lock(&l->lock);
    int count = l->ready;
    for (int i = 0; i < count; ++i) out_tiles[i] = l->tiles[i];
    pthread_mutex_unlock(&l->lock);
    return count;
}

// A tile, and balls that fall on it.
static void add_tile(fe_world *world, int tile, fe_asset asset)
{
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.type = FE_BODY_STATIC;
    def.transform = fe_make_transform(64.0 * tile, 0, 0);
    fe_geometry field, ball;
    fe_geometry_heightfield(&field, asset);
    fe_geometry_sphere(&ball, 0.5f);
    fe_body body;
    fe_shape shape;
    must(fe_body_create(world, &def, &body));
    must(fe_shape_create(world, body, NULL, &field, &shape));
    def.type = FE_BODY_DYNAMIC;
    for (int i = 0; i < BALLS; ++i) {
        def.transform = fe_make_transform(64.0 * tile + 4 * i + 2, 5, 32);
        must(fe_body_create(world, &def, &body));
        must(fe_shape_create(world, body, NULL, &ball, &shape));
    }
}

int main(void)
{
    loader l = {.lock = PTHREAD_MUTEX_INITIALIZER};
    must(fe_store_create(NULL, &l.store));
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.store = l.store;
    fe_world *worlds[WORLDS];
    for (int i = 0; i < WORLDS; ++i) must(fe_world_create(&def, &worlds[i]));

    pthread_t thread;
    if (pthread_create(&thread, NULL, load, &l)) return 1;
    int placed = 0, steps = 0;
    for (int after = 0; after < 300; ++steps) {
        fe_asset tiles[TILES];
        int ready = take_ready(&l, tiles);
        for (; placed < ready; ++placed)
            for (int i = 0; i < WORLDS; ++i) add_tile(worlds[i], placed, tiles[placed]);
        for (int i = 0; i < WORLDS; ++i) must(fe_world_step(worlds[i], DT));
        after += placed == TILES;
    }
    pthread_join(thread, NULL);

    int64_t store_bytes;
    must(fe_store_get_bytes(l.store, &store_bytes));
    printf("%d tiles of %d x %d samples, %d steps of %d worlds\n", placed, SAMPLES, SAMPLES, steps, WORLDS);
    printf("the store has %.2f MB\n", (double)store_bytes / 1e6);
    for (int i = 0; i < WORLDS; ++i) {
        fe_counters counters;
        fe_counters_init(&counters, sizeof counters);
        must(fe_world_get_counters(worlds[i], &counters));
        fe_bounds bounds;
        must(fe_world_get_bounds(worlds[i], &bounds));
        printf("world %d: %d bodies, %d contacts, x from %.0f to %.0f m, %.2f MB\n", i, counters.bodies,
               counters.contacts, bounds.lower.x, bounds.upper.x, (double)counters.bytes / 1e6);
        must(fe_world_destroy(worlds[i]));
    }
    return fe_store_destroy(l.store) == FE_OK ? 0 : 1;
}
