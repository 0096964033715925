// The API of stores: who may use one, what its handles mean, how long an asset lives, edits that reach every world, and
// memory.
#include "api_test.h"
#include "robust/counting_allocator.h"

enum { ROWS = 9, COLUMNS = 9, SAMPLES = ROWS * COLUMNS };

static const float flat[SAMPLES];

static fe_store *new_store(uint32_t number, const fe_allocator *allocator)
{
    fe_store_def def;
    fe_store_def_init(&def, sizeof def);
    def.number = number;
    def.allocator = allocator;
    fe_store *store = NULL;
    OK(fe_store_create(&def, &store));
    assert_non_null(store);
    return store;
}

// NULL: a store of its own
static fe_world *new_world_on(fe_store *store)
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.store = store;
    fe_world *world = NULL;
    OK(fe_world_create(&def, &world));
    return world;
}

static fe_store *store_of(const fe_world *world)
{
    fe_store *store = NULL;
    OK(fe_world_get_store(world, &store));
    assert_non_null(store);
    return store;
}

static fe_heightfield_def flat_def(void)
{
    fe_heightfield_def d;
    fe_heightfield_def_init(&d, sizeof d);
    d.rows = ROWS, d.columns = COLUMNS, d.heights = flat;
    return d;
}

static fe_asset new_field(fe_store *store)
{
    fe_heightfield_def d = flat_def();
    fe_asset asset = 0;
    OK(fe_heightfield_create(store, &d, &asset));
    assert_true(asset != 0);
    return asset;
}

static fe_shape new_terrain(fe_world *world, fe_asset asset)
{
    fe_geometry g;
    fe_geometry_heightfield(&g, asset);
    return add_shape(world, new_body(world, FE_BODY_STATIC, 0, 0, 0), &g);
}

static int64_t bytes_of(const fe_store *store)
{
    int64_t bytes = -1;
    OK(fe_store_get_bytes(store, &bytes));
    return bytes;
}

// Height of the terrain under (4, 4)
static double height_of(const fe_world *world)
{
    fe_hit hit;
    assert_int_equal(fe_world_raycast(world, &(fe_dvec3){4.1, 100.0, 4.05}, &(fe_dvec3){0.0, -200.0, 0.0}, NULL, &hit),
                     1);
    return hit.point.y;
}

// ---- stores --------------------------------------------------------------------------------------------------------

static void a_store_has_defaults_and_refuses_what_is_wrong(void **state)
{
    (void)state;
    fe_store *store = NULL;
    fe_store_def def;
    fe_store_def_init(NULL, sizeof def);
    memset(&def, 0xEE, sizeof def);
    fe_store_def_init(&def, sizeof def);
    FE_TRUE(def.struct_size == sizeof def && def.number == 0 && !def.allocator);
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_store_create(&def, NULL));
    def.number = 4096;
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_store_create(&def, &store));
    SAYS("4096");
    fe_store_def_init(&def, sizeof def);
    def.struct_size = 0;
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_store_create(&def, &store));
    fe_store_def_init(&def, sizeof def);
    fe_allocator empty = {.struct_size = sizeof empty};
    def.allocator = &empty;
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_store_create(&def, &store));
    assert_null(store);
    OK(fe_store_create(NULL, &store));
    FE_TRUE(bytes_of(store) > 0);
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_store_get_bytes(store, NULL));
    OK(fe_store_destroy(store));
    int64_t bytes;
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_store_get_bytes(NULL, &bytes));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_store_destroy(NULL));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_asset_destroy(NULL, 1));
    float height = 0.0f;
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_heightfield_set_heights(NULL, 1, 0, 0, 1, 1, &height));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_heightfield_get_heights(NULL, 1, 0, 0, 1, 1, &height));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_world_get_store(NULL, &store));
    FE_TRUE(!fe_asset_is_valid(NULL, 1));
}

static void a_world_uses_the_store_of_its_definition_or_its_own(void **state)
{
    (void)state;
    fe_store *shared = new_store(0, NULL);
    fe_world *a = new_world_on(shared), *b = new_world_on(shared), *c = new_world_on(NULL), *d = new_world_on(NULL);
    FE_TRUE(store_of(a) == shared && store_of(b) == shared);
    FE_TRUE(store_of(c) != shared && store_of(d) != shared && store_of(c) != store_of(d));
    REFUSES(a, FE_ERROR_ARGUMENT, fe_world_get_store(a, NULL));

    REFUSES(a, FE_ERROR_STATE, fe_store_destroy(shared));
    SAYS("2 worlds");
    OK(fe_world_destroy(a));
    REFUSES(b, FE_ERROR_STATE, fe_store_destroy(shared));
    OK(fe_world_destroy(b));
    OK(fe_store_destroy(shared));

    fe_store *own = store_of(c);
    REFUSES(c, FE_ERROR_STATE, fe_store_destroy(own));
    SAYS("own");
    OK(fe_world_destroy(c));
    REFUSES(d, FE_ERROR_STALE, fe_store_destroy(own));
    OK(fe_world_destroy(d));
}

static void definitions_that_outlive_a_store_or_a_pool_are_refused(void **state)
{
    (void)state;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    fe_world *world = NULL, *other = new_world();
    fe_store *store = new_store(0, NULL);
    fe_pool *pool = NULL;
    OK(fe_pool_create(2, &pool));
    def.store = store, def.pool = pool;
    OK(fe_world_create(&def, &world));
    REFUSES(world, FE_ERROR_STATE, fe_pool_destroy(pool));
    OK(fe_world_destroy(world));
    world = NULL;

    OK(fe_store_destroy(store));
    REFUSES(NULL, FE_ERROR_STALE, fe_world_create(&def, &world));
    SAYS("store");
    REFUSES(NULL, FE_ERROR_STALE, fe_store_destroy(store));
    def.store = NULL;
    OK(fe_world_create(&def, &world)); // the pool lives, and nobody else uses it now
    OK(fe_world_destroy(world));
    OK(fe_pool_destroy(pool));
    world = NULL;
    REFUSES(NULL, FE_ERROR_STALE, fe_world_create(&def, &world));
    SAYS("pool");
    REFUSES(NULL, FE_ERROR_STALE, fe_pool_destroy(pool));
    def.pool = NULL;
    def.store = store_of(other);
    REFUSES(other, FE_ERROR_ARGUMENT, fe_world_create(&def, &world));
    SAYS("own");
    assert_null(world);
    OK(fe_world_destroy(other));
}

// ---- handles -------------------------------------------------------------------------------------------------------

static void handles_of_another_store_are_refused(void **state)
{
    (void)state;
    fe_store *one = new_store(17, NULL), *two = new_store(18, NULL), *drawn = new_store(0, NULL),
             *next = new_store(0, NULL);
    fe_world *world = new_world_on(one);
    fe_body body = new_body(world, FE_BODY_STATIC, 0, 0, 0);
    fe_asset mine = new_field(one), theirs = new_field(two), of_drawn = new_field(drawn), of_next = new_field(next);
    FE_TRUE(fe_asset_is_valid(one, mine) && fe_asset_is_valid(two, theirs));
    FE_TRUE(mine != theirs && of_drawn != of_next && mine < 1ull << 53);
    fe_asset own = new_field(store_of(world));
    FE_TRUE(own != mine && fe_asset_is_valid(one, own));
    const struct {
        fe_asset handle;
        fe_result result;
    } wrong[] = {{theirs, FE_ERROR_STALE}, {of_drawn, FE_ERROR_STALE}, {of_next, FE_ERROR_STALE},
                 {0, FE_ERROR_STALE},      {mine + 5, FE_ERROR_STALE}, {1ull << 60, FE_ERROR_STALE},
                 {body, FE_ERROR_KIND}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        fe_geometry g;
        float heights[1] = {0.0f};
        fe_geometry_heightfield(&g, wrong[i].handle);
        fe_shape made = 7;
        int64_t bytes_before = bytes_of(one);
        FE_TRUE(!fe_asset_is_valid(one, wrong[i].handle));
        REFUSES(world, wrong[i].result, fe_asset_destroy(one, wrong[i].handle));
        REFUSES(world, wrong[i].result, fe_heightfield_set_heights(one, wrong[i].handle, 0, 0, 1, 1, heights));
        REFUSES(world, wrong[i].result, fe_heightfield_get_heights(one, wrong[i].handle, 0, 0, 1, 1, heights));
        REFUSES(world, wrong[i].result, fe_shape_create(world, body, NULL, &g, &made));
        FE_TRUE(made == 0 && bytes_of(one) == bytes_before);
    }
    REFUSES(world, FE_ERROR_STALE, fe_asset_destroy(one, theirs));
    SAYS("store 18");
    OK(fe_world_destroy(world));
    OK(fe_store_destroy(one));
    OK(fe_store_destroy(two));
    OK(fe_store_destroy(drawn));
    OK(fe_store_destroy(next));
}

static void a_world_gives_its_number_to_its_own_store(void **state)
{
    (void)state;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.number = 99;
    fe_world *world = NULL;
    OK(fe_world_create(&def, &world));
    fe_asset asset = new_field(store_of(world));
    fe_store *same = new_store(99, NULL), *other = new_store(98, NULL);
    FE_TRUE(new_field(same) == asset); // the first of number 99 in each
    FE_TRUE(new_field(other) != asset);
    OK(fe_store_destroy(same));
    OK(fe_store_destroy(other));
    OK(fe_world_destroy(world));
}

// Numbers are drawn from 1..4095: no two living stores share a drawn one, even when the counter comes around.
static void a_drawn_number_is_free(void **state)
{
    (void)state;
    fe_store *kept = new_store(0, NULL);
    fe_asset asset = new_field(kept);
    for (int32_t i = 0; i < 2 * 4095; ++i) {
        fe_store *store = new_store(0, NULL);
        if (i % 500 == 0 || i >= 4090) FE_TRUE(new_field(store) != asset);
        OK(fe_store_destroy(store));
    }
    OK(fe_store_destroy(kept));
}

// ---- the life of an asset ------------------------------------------------------------------------------------------

static void a_destroyed_asset_lives_on_for_its_shapes_in_every_world(void **state)
{
    (void)state;
    counting memory = {0};
    fe_allocator allocator = counting_allocator(&memory);
    fe_store *store = new_store(0, &allocator);
    fe_world *a = new_world_on(store), *b = new_world_on(store);
    fe_asset warm = new_field(store); // the store has its tables now
    OK(fe_asset_destroy(store, warm));
    int64_t empty = memory.bytes, blocks = memory.blocks;
    fe_asset asset = new_field(store);
    FE_TRUE(asset != warm && memory.bytes >= empty + (int64_t)sizeof flat);
    FE_TRUE(bytes_of(store) == memory.bytes);
    fe_shape first = new_terrain(a, asset), second = new_terrain(a, asset), third = new_terrain(b, asset);
    int64_t full = memory.bytes;
    OK(fe_asset_destroy(store, asset));
    FE_TRUE(!fe_asset_is_valid(store, asset));
    REFUSES(a, FE_ERROR_STALE, fe_asset_destroy(store, asset));
    SAYS("lives on");
    fe_geometry g;
    fe_geometry_heightfield(&g, asset);
    fe_shape more;
    fe_body ground = new_body(a, FE_BODY_STATIC, 0, 0, 0);
    REFUSES(a, FE_ERROR_STALE, fe_shape_create(a, ground, NULL, &g, &more));
    fe_geometry got;
    fe_geometry_init(&got, sizeof got);
    OK(fe_shape_get_geometry(b, third, &got));
    FE_TRUE(got.asset == asset);
    OK(fe_shape_destroy(a, first));
    OK(fe_shape_destroy(a, second));
    FE_TRUE(memory.bytes == full && height_of(b) == 0.0);
    fe_geometry ball;
    fe_geometry_sphere(&ball, 1.0f);
    OK(fe_shape_set_geometry(b, third, &ball)); // the last user
    FE_TRUE(memory.bytes == empty && memory.blocks == blocks);

    asset = new_field(store); // its last user goes with its world
    new_terrain(b, asset);
    OK(fe_asset_destroy(store, asset));
    FE_TRUE(memory.bytes > empty);
    OK(fe_world_destroy(b));
    FE_TRUE(memory.bytes == empty);
    asset = new_field(store); // not destroyed: it stays without users
    new_terrain(a, asset);
    OK(fe_world_destroy(a));
    FE_TRUE(memory.bytes == full && fe_asset_is_valid(store, asset));
    OK(fe_store_destroy(store));
    FE_TRUE(memory.bytes == 0 && memory.blocks == 0 && memory.wrong == 0);
}

// Slots of many assets, freed in another order: the table of chunks grows, records stay.
static void many_assets_keep_their_heights(void **state)
{
    (void)state;
    enum { ASSETS = 300 };
    fe_asset assets[ASSETS];
    fe_store *store = new_store(0, NULL);
    float heights[SAMPLES], got[SAMPLES];
    fe_heightfield_def d = flat_def();
    d.heights = heights;
    for (int32_t round = 0; round < 2; ++round) {
        for (int32_t i = 0; i < ASSETS; ++i) {
            for (int32_t k = 0; k < SAMPLES; ++k) heights[k] = (float)(i + k);
            if (round == 0 || i % 3 == 0) OK(fe_heightfield_create(store, &d, assets + i));
        }
        for (int32_t i = 0; i < ASSETS; ++i) {
            OK(fe_heightfield_get_heights(store, assets[i], 0, 0, ROWS, COLUMNS, got));
            for (int32_t k = 0; k < SAMPLES; ++k) FE_TRUE(got[k] == (float)(i + k));
        }
        for (int32_t i = 0; i < ASSETS; i += 3) OK(fe_asset_destroy(store, assets[i]));
    }
    OK(fe_store_destroy(store));
}

// ---- edits ---------------------------------------------------------------------------------------------------------

static void edits_wake_bodies_in_every_world_and_in_no_other(void **state)
{
    (void)state;
    enum { WORLDS = 3 };
    fe_store *store = new_store(0, NULL);
    fe_asset asset = new_field(store), other = new_field(store);
    fe_world *worlds[WORLDS];
    fe_body near[WORLDS], far[WORLDS];
    for (int32_t i = 0; i < WORLDS; ++i) {
        worlds[i] = new_world_on(store);
        new_terrain(worlds[i], i < 2 ? asset : other);
        near[i] = new_box(worlds[i], 4, 0.5, 4);
        far[i] = new_box(worlds[i], 1, 0.5, 1);
        step(worlds[i], 120);
        FE_TRUE(!is_awake(worlds[i], near[i]) && !is_awake(worlds[i], far[i]));
    }
    uint64_t untouched = hash_of(worlds[2]);
    const float hill[9] = {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f};
    OK(fe_heightfield_set_heights(store, asset, 3, 3, 3, 3, hill));
    for (int32_t i = 0; i < 2; ++i) {
        FE_TRUE(is_awake(worlds[i], near[i]) && !is_awake(worlds[i], far[i]));
        FE_NEAR(height_of(worlds[i]), 1.0, 1e-3); // the box's top: it lies on what was 0
        step(worlds[i], 1);
    }
    FE_TRUE(hash_of(worlds[0]) == hash_of(worlds[1]));
    FE_TRUE(hash_of(worlds[2]) == untouched);
    for (int32_t i = 0; i < 2; ++i) step(worlds[i], 120);
    double top = height_of(worlds[0]);
    FE_NEAR(top, 1.5, 0.02); // pushed up by the new surface
    FE_TRUE(hash_of(worlds[0]) == hash_of(worlds[1]));
    for (int32_t i = 0; i < WORLDS; ++i) OK(fe_world_destroy(worlds[i]));
    OK(fe_store_destroy(store));
}

// A world on a shared store computes what one with its own does, whatever else the store holds.
static void a_shared_store_changes_no_result(void **state)
{
    (void)state;
    fe_store *store = new_store(0, NULL);
    for (int32_t i = 0; i < 5; ++i) new_field(store);
    fe_world *worlds[3] = {new_world_on(store), new_world_on(NULL), new_world_on(store)};
    float waves[SAMPLES];
    for (int32_t i = 0; i < SAMPLES; ++i) waves[i] = 0.3f * (float)((i * 7) % 5);
    fe_heightfield_def d = flat_def();
    d.heights = waves;
    for (int32_t w = 0; w < 3; ++w) {
        fe_asset asset = 0;
        OK(fe_heightfield_create(store_of(worlds[w]), &d, &asset));
        new_terrain(worlds[w], asset);
        for (int32_t i = 0; i < 6; ++i) {
            fe_body ball = new_body(worlds[w], FE_BODY_DYNAMIC, 1.0 + i, 2.0, 1.5 + 0.7 * i);
            add_sphere(worlds[w], ball, 0.4f);
            new_box(worlds[w], 1.2 + i, 3.5, 2.0 + 0.6 * i);
        }
    }
    for (int32_t i = 0; i < 90; ++i) {
        for (int32_t w = 0; w < 3; ++w) step(worlds[w], 1);
        FE_TRUE(hash_of(worlds[0]) == hash_of(worlds[1]));
        FE_TRUE(hash_of(worlds[0]) == hash_of(worlds[2]));
    }
    for (int32_t w = 0; w < 3; ++w) OK(fe_world_destroy(worlds[w]));
    OK(fe_store_destroy(store));
}

// A host whose job system calls the store in the middle of a step, or of a query.
typedef struct meddler {
    fe_store *store;
    fe_asset asset;
    int32_t calls;
    fe_result edit, read, create, destroy;
    double height;
} meddler;

static void meddle(void *user, fe_task task, void *argument, int32_t count)
{
    meddler *m = user;
    const float peak[1] = {2.0f};
    float got[SAMPLES];
    fe_asset made = 0;
    fe_heightfield_def d = flat_def();
    m->calls += 1;
    m->edit = fe_heightfield_set_heights(m->store, m->asset, 4, 4, 1, 1, peak);
    m->read = fe_heightfield_get_heights(m->store, m->asset, 0, 0, ROWS, COLUMNS, got);
    m->height = (double)got[4 * COLUMNS + 4];
    m->create = fe_heightfield_create(m->store, &d, &made);
    m->destroy = fe_asset_destroy(m->store, made);
    for (int32_t i = 0; i < count; ++i) task(argument, i);
}

static void edits_are_refused_while_a_world_that_uses_the_asset_is_entered(void **state)
{
    (void)state;
    meddler m = {.store = new_store(0, NULL)};
    m.asset = new_field(m.store);
    fe_task_system tasks;
    memset(&tasks, 0, sizeof tasks);
    tasks.struct_size = sizeof tasks, tasks.worker_count = 2, tasks.run = meddle, tasks.user = &m;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.store = m.store;
    fe_world *idle[2], *busy = NULL;
    OK(fe_world_create(&def, idle));
    def.tasks = &tasks;
    OK(fe_world_create(&def, &busy));
    def.tasks = NULL;
    OK(fe_world_create(&def, idle + 1));
    new_terrain(idle[0], m.asset);
    new_terrain(idle[1], m.asset);
    for (int32_t i = 0; i < 400; ++i) new_box(busy, 3.0 * (i % 20), 0.5, 3.0 * (i / 20) - 100.0); // enough for tasks
    new_ground(busy);

    OK(fe_world_step(busy, 1.0f / 60.0f)); // it does not use the asset
    FE_TRUE(m.calls > 0);
    assert_int_equal(m.edit, FE_OK);
    OK(fe_heightfield_set_heights(m.store, m.asset, 4, 4, 1, 1, flat));

    new_terrain(busy, m.asset);
    m.calls = 0;
    OK(fe_world_step(busy, 1.0f / 60.0f));
    FE_TRUE(m.calls > 0);
    assert_int_equal(m.edit, FE_ERROR_STEPPING);
    SAYS("fe_heightfield_set_heights");
    FE_TRUE(m.read == FE_OK && m.create == FE_OK && m.destroy == FE_OK);
    FE_TRUE(m.height == 0.0 && height_of(idle[0]) == 0.0);
    for (int32_t i = 0; i < 2; ++i) step(idle[i], 1); // those that were entered were left

    enum { RAYS = 2000 };
    fe_ray rays[RAYS];
    fe_hit hits[RAYS];
    memset(rays, 0, sizeof rays);
    memset(hits, 0, sizeof hits);
    for (int32_t i = 0; i < RAYS; ++i) rays[i].origin.y = 10.0, rays[i].translation.y = -20.0;
    m.calls = 0;
    FE_TRUE(fe_world_raycast_many(busy, rays, sizeof *rays, RAYS, NULL, 1, hits, sizeof *hits) >= 0);
    FE_TRUE(m.calls > 0);
    assert_int_equal(m.edit, FE_ERROR_BUSY);
    FE_TRUE(m.read == FE_OK && m.create == FE_OK && m.destroy == FE_OK && m.height == 0.0);
    for (int32_t i = 0; i < 2; ++i) step(idle[i], 1);

    OK(fe_heightfield_set_heights(m.store, m.asset, 4, 4, 1, 1, (const float[1]){2.0f}));
    FE_TRUE(height_of(idle[0]) > 1.5);
    for (int32_t i = 0; i < 2; ++i) OK(fe_world_destroy(idle[i]));
    OK(fe_world_destroy(busy));
    OK(fe_store_destroy(m.store));
}

// ---- memory --------------------------------------------------------------------------------------------------------

static fe_world *counted_world(counting *memory, fe_store *store)
{
    fe_allocator allocator = counting_allocator(memory);
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.allocator = &allocator;
    def.store = store;
    fe_world *world = NULL;
    OK(fe_world_create(&def, &world));
    return world;
}

static void a_thousand_worlds_share_one_heightfield(void **state)
{
    (void)state;
    enum { WORLDS = 1000, SIDE = 1024, LEAST = 1024 };
    counting memory = {0}, one = {0};
    fe_allocator allocator = counting_allocator(&memory);
    float *heights = calloc((size_t)SIDE * SIDE, sizeof *heights);
    fe_world **worlds = calloc(WORLDS, sizeof(fe_world *));
    FE_TRUE(heights && worlds);
    fe_world *alone = counted_world(&one, NULL);
    int64_t empty = one.bytes; // with a store of its own
    OK(fe_world_destroy(alone));

    fe_store *store = new_store(0, &allocator);
    fe_heightfield_def d = flat_def();
    d.rows = d.columns = SIDE, d.heights = heights;
    fe_asset asset = 0;
    OK(fe_heightfield_create(store, &d, &asset));
    int64_t field = memory.bytes;
    FE_TRUE(field == bytes_of(store));
    FE_WITHIN(field, (double)SIDE * SIDE * 4, (double)SIDE * SIDE * 4 * 1.01);
    for (int32_t i = 0; i < WORLDS; ++i) {
        worlds[i] = counted_world(&memory, store);
        new_terrain(worlds[i], asset);
    }
    FE_WITHIN(memory.bytes, 0, (double)field + (double)WORLDS * (double)(empty + LEAST));
    FE_TRUE(bytes_of(store) == field); // worlds pay for themselves
    for (int32_t i = 0; i < WORLDS; ++i) OK(fe_world_destroy(worlds[i]));
    OK(fe_store_destroy(store));
    FE_TRUE(memory.bytes == 0 && memory.blocks == 0 && memory.wrong == 0 && one.bytes == 0);
    free(heights);
    free(worlds);
}

// Every allocation of the store fails in turn: the call says so, leaves nothing behind, and succeeds when it is
// repeated.
static void a_store_without_memory_changes_nothing(void **state)
{
    (void)state;
    fe_heightfield_def d = flat_def();
    uint8_t cells[(ROWS - 1) * (COLUMNS - 1)] = {0};
    fe_material materials[2] = {{.static_friction = 1.0f}, {.static_friction = 0.1f}};
    d.cell_materials = cells, d.materials = materials, d.material_count = 2;
    int32_t failed_creations = 0;
    for (int32_t fail = 1; fail < 20; ++fail) {
        counting memory = {.fail_from = fail, .fail_count = 1};
        fe_allocator allocator = counting_allocator(&memory);
        fe_store_def def;
        fe_store_def_init(&def, sizeof def);
        def.allocator = &allocator;
        fe_store *store = NULL;
        if (fail == 1) {
            REFUSES(NULL, FE_ERROR_MEMORY, fe_store_create(&def, &store));
            FE_TRUE(!store && memory.blocks == 0);
        }
        OK(fe_store_create(&def, &store));
        fe_world *world = new_world_on(store);
        for (int32_t i = 0; i < 5; ++i) { // beyond the first chunk
            int64_t failures = memory.failures;
            fe_asset asset = 7;
            fe_result result = fe_heightfield_create(store, &d, &asset);
            if (memory.failures > failures) {
                assert_int_equal(result, FE_ERROR_MEMORY);
                FE_TRUE(asset == 0);
                failed_creations += 1;
                result = fe_heightfield_create(store, &d, &asset);
            }
            assert_int_equal(result, FE_OK);
            FE_TRUE(fe_asset_is_valid(store, asset));
            new_terrain(world, asset);
        }
        OK(fe_world_destroy(world));
        OK(fe_store_destroy(store));
        FE_TRUE(memory.blocks == 0 && memory.bytes == 0 && memory.wrong == 0);
    }
    FE_TRUE(failed_creations >= 12); // 4 blocks a field, the slots, a chunk
}

// The same for a world on a shared store: creation, and a shape that takes an asset.
static void a_world_without_memory_uses_no_asset(void **state)
{
    (void)state;
    counting of_store = {0};
    fe_allocator store_allocator = counting_allocator(&of_store);
    fe_store *store = new_store(0, &store_allocator);
    int32_t failed = 0;
    for (int32_t fail = 1; fail < 30; ++fail) {
        counting memory = {.fail_from = fail, .fail_count = 1};
        fe_allocator allocator = counting_allocator(&memory);
        fe_world_def def;
        fe_world_def_init(&def, sizeof def);
        def.allocator = &allocator;
        def.store = store;
        fe_world *world = NULL;
        fe_result result = fe_world_create(&def, &world);
        if (memory.failures) {
            assert_int_equal(result, FE_ERROR_MEMORY);
            FE_TRUE(!world && memory.blocks == 0);
            result = fe_world_create(&def, &world);
        }
        assert_int_equal(result, FE_OK);
        fe_asset asset = new_field(store);
        int64_t failures = memory.failures, bytes = of_store.bytes;
        fe_body body = 0;
        if (fe_body_create(world, NULL, &body) != FE_OK) OK(fe_body_create(world, NULL, &body));
        if (fe_body_set_type(world, body, FE_BODY_STATIC) != FE_OK) OK(fe_body_set_type(world, body, FE_BODY_STATIC));
        fe_geometry g;
        fe_geometry_heightfield(&g, asset);
        fe_shape shape = 7;
        failures = memory.failures;
        if (fe_shape_create(world, body, NULL, &g, &shape) != FE_OK) {
            FE_TRUE(memory.failures == failures + 1 && shape == 0);
            failed += 1;
            FE_TRUE(of_store.bytes == bytes);
            OK(fe_asset_destroy(store, asset)); // nobody uses it
            FE_TRUE(of_store.bytes < bytes);
            asset = new_field(store);
            fe_geometry_heightfield(&g, asset);
            OK(fe_shape_create(world, body, NULL, &g, &shape));
        }
        OK(fe_asset_destroy(store, asset));
        OK(fe_world_destroy(world));
        FE_TRUE(memory.blocks == 0 && memory.wrong == 0);
    }
    FE_TRUE(failed >= 5); // slots, shapes, uses, the trees...
    OK(fe_store_destroy(store));
    FE_TRUE(of_store.blocks == 0 && of_store.bytes == 0 && of_store.wrong == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_store_has_defaults_and_refuses_what_is_wrong),
        cmocka_unit_test(a_world_uses_the_store_of_its_definition_or_its_own),
        cmocka_unit_test(definitions_that_outlive_a_store_or_a_pool_are_refused),
        cmocka_unit_test(handles_of_another_store_are_refused),
        cmocka_unit_test(a_world_gives_its_number_to_its_own_store),
        cmocka_unit_test(a_drawn_number_is_free),
        cmocka_unit_test(a_destroyed_asset_lives_on_for_its_shapes_in_every_world),
        cmocka_unit_test(many_assets_keep_their_heights),
        cmocka_unit_test(edits_wake_bodies_in_every_world_and_in_no_other),
        cmocka_unit_test(a_shared_store_changes_no_result),
        cmocka_unit_test(edits_are_refused_while_a_world_that_uses_the_asset_is_entered),
        cmocka_unit_test(a_thousand_worlds_share_one_heightfield),
        cmocka_unit_test(a_store_without_memory_changes_nothing),
        cmocka_unit_test(a_world_without_memory_uses_no_asset),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
