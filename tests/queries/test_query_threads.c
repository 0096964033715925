// Eight threads ask one world at once and get what one thread gets; nothing is allocated; a batch spread over workers
// answers the same.
//
// For ThreadSanitizer above all: queries read and write nothing that is shared.
#include "api/api_test.h"
#include "queries/dice.h"
#include "robust/counting_allocator.h"

#include <pthread.h>

#if defined(FE_SANITIZED)
enum { QUERIES = 300 };
#else
enum { QUERIES = 3000 };
#endif
enum { THREADS = 8, BODIES = 300, MOST = 40 };

static fe_geometry geometry(dice *d)
{
    fe_geometry g;
    float a = (float)uniform(d, 0.2, 2), b = (float)uniform(d, 0.2, 2), c = (float)uniform(d, 0.2, 2);
    double kind = uniform(d, 0, 3);
    fe_geometry_box(&g, a, b, c);
    if (kind < 1) fe_geometry_sphere(&g, a);
    if (kind > 2) fe_geometry_capsule(&g, a, b);
    return g;
}

// Bodies of one to three shapes, in motion.
static fe_world *crowded_world(counting *memory, int32_t workers)
{
    fe_allocator allocator = counting_allocator(memory);
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.allocator = &allocator;
    def.worker_count = workers;
    fe_world *world;
    dice d = {UINT64_C(88172645463325252)};
    OK(fe_world_create(&def, &world));
    for (int32_t i = 0; i < BODIES; ++i) {
        fe_dvec3 p = random_vector(&d, 15);
        fe_body body = new_body(world, i % 3, p.x, p.y, p.z);
        for (int32_t shapes = 1 + i % 3; shapes > 0; --shapes) {
            fe_geometry g = geometry(&d);
            add_shape(world, body, &g);
        }
    }
    new_ground(world);
    step(world, 3);
    return world;
}

// One number over everything that a row of queries answers.
static uint64_t mix(uint64_t sum, const void *bytes, size_t size)
{
    const unsigned char *b = bytes;
    for (size_t i = 0; i < size; ++i) sum = (sum ^ b[i]) * UINT64_C(0x100000001b3);
    return sum;
}

typedef struct asker {
    const fe_world *world;
    uint64_t seed, sum;
    int32_t found;
} asker;

static void *ask(void *argument)
{
    asker *a = argument;
    dice d = {a->seed};
    for (int32_t i = 0; i < QUERIES; ++i) {
        fe_geometry g = geometry(&d);
        fe_transform t = fe_make_transform(0, 0, 0);
        t.position = random_vector(&d, 20);
        fe_dvec3 way = random_vector(&d, 20);
        fe_hit hits[MOST];
        fe_body bodies[MOST];
        fe_closest c;
        memset(hits, 0, sizeof hits), memset(bodies, 0, sizeof bodies), memset(&c, 0, sizeof c);
        int32_t counts[7] = {fe_world_raycast(a->world, &t.position, &way, NULL, &hits[0]),
                             fe_world_sweep(a->world, &g, &t, &way, NULL, &hits[1]),
                             fe_world_raycast_all(a->world, &t.position, &way, NULL, &hits[2], sizeof *hits, 8),
                             fe_world_sweep_all(a->world, &g, &t, &way, NULL, &hits[10], sizeof *hits, MOST - 10),
                             fe_world_overlap(a->world, &g, &t, NULL, bodies, MOST),
                             fe_world_closest_point(a->world, &t.position, 5, NULL, &c),
                             fe_world_sweep_any(a->world, &g, &t, &way, NULL)};
        a->sum =
            mix(mix(mix(mix(a->sum, hits, sizeof hits), bodies, sizeof bodies), &c, sizeof c), counts, sizeof counts);
        a->found += counts[3];
    }
    return NULL;
}

static void eight_threads_get_what_one_gets(void **state)
{
    (void)state;
    counting memory = {0};
    fe_world *world = crowded_world(&memory, 1);
    int64_t calls = memory.calls;
    uint64_t before = hash_of(world);
    asker alone[THREADS], together[THREADS];
    pthread_t threads[THREADS];
    for (int32_t i = 0; i < THREADS; ++i) {
        alone[i] = together[i] =
            (asker){.world = world, .seed = UINT64_C(0x9e3779b97f4a7c15) + (uint32_t)(i / 2)}; // two ask the same
        ask(&alone[i]);
    }
    for (int32_t i = 0; i < THREADS; ++i) assert_int_equal(pthread_create(&threads[i], NULL, ask, &together[i]), 0);
    for (int32_t i = 0; i < THREADS; ++i) assert_int_equal(pthread_join(threads[i], NULL), 0);
    for (int32_t i = 0; i < THREADS; ++i) {
        FE_TRUE(together[i].sum == alone[i].sum && together[i].found == alone[i].found);
        FE_WITHIN(alone[i].found, QUERIES, QUERIES * BODIES);
    }
    FE_TRUE(memory.calls == calls); // no query allocates
    FE_TRUE(hash_of(world) == before);
    OK(fe_world_destroy(world));
}

// Several threads may spread their batches over the same workers.
typedef struct batch {
    const fe_world *world;
    const fe_ray *rays;
    const fe_path *paths;
    const fe_geometry *geometry;
    int32_t spread;
    fe_hit rays_out[QUERIES], paths_out[QUERIES];
    int32_t hits;
} batch;

static void *ask_many(void *argument)
{
    batch *b = argument;
    b->hits =
        fe_world_raycast_many(b->world, b->rays, sizeof(fe_ray), QUERIES, NULL, b->spread, b->rays_out, sizeof(fe_hit));
    b->hits += fe_world_sweep_many(b->world, b->geometry, b->paths, sizeof(fe_path), QUERIES, NULL, b->spread,
                                   b->paths_out, sizeof(fe_hit));
    return NULL;
}

static void batches_do_not_depend_on_who_answers(void **state)
{
    (void)state;
    static fe_ray rays[QUERIES];
    static fe_path paths[QUERIES];
    static batch batches[3];
    counting memory = {0};
    fe_world *world = crowded_world(&memory, 4);
    int64_t calls = memory.calls;
    dice d = {12345};
    fe_geometry g = geometry(&d);
    for (int32_t i = 0; i < QUERIES; ++i) {
        rays[i].origin = random_vector(&d, 20), rays[i].translation = random_vector(&d, 20);
        paths[i] = (fe_path){fe_make_transform(rays[i].origin.x, rays[i].origin.y, rays[i].origin.z),
                             rays[i].translation,
                             {(float)(i % 3), 2, 3},
                             {0}};
    }
    pthread_t threads[3];
    for (int32_t i = 0; i < 3; ++i) {
        batch *b = &batches[i];
        b->world = world, b->rays = rays, b->paths = paths, b->geometry = &g, b->spread = i > 0;
        assert_int_equal(pthread_create(&threads[i], NULL, ask_many, b), 0);
    }
    for (int32_t i = 0; i < 3; ++i) assert_int_equal(pthread_join(threads[i], NULL), 0);
    for (int32_t i = 1; i < 3; ++i) {
        FE_WITHIN(batches[i].hits, 10, 2 * QUERIES);
        assert_int_equal(batches[i].hits, batches[0].hits);
        assert_memory_equal(batches[i].rays_out, batches[0].rays_out, sizeof batches[0].rays_out);
        assert_memory_equal(batches[i].paths_out, batches[0].paths_out, sizeof batches[0].paths_out);
    }
    FE_TRUE(memory.calls == calls);
    OK(fe_world_destroy(world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eight_threads_get_what_one_gets),
        cmocka_unit_test(batches_do_not_depend_on_who_answers),
    };
    return cmocka_run_group_tests_name("query_threads", tests, NULL, NULL);
}
