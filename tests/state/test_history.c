// test_history.c - scripts played with rollback: after every few steps the world goes back 8 frames and makes them
// again. After each step the same hash and the same events as in the run without, after each return the same bytes as
// when the frame was kept. And the calls: arguments, numbers, bounds, assets, sleep, allocations that fail.
#include "fe_test.h"
#include "robust/counting_allocator.h"
#include "support/play.h"

#include <stdlib.h>
#include <string.h>

enum { BACK = 8, FRAMES = 16, MOST_STEPS = 256, NUMBER = 7 };

typedef struct bytes {
    unsigned char *data;
    int64_t size;
} bytes;

static bytes save(const fe_world *world)
{
    bytes b = {NULL, fe_world_save(world, NULL, NULL, 0)};
    FE_TRUE(b.size > 0);
    b.data = malloc((size_t)b.size);
    FE_TRUE(b.data && fe_world_save(world, NULL, b.data, b.size) == b.size);
    return b;
}

static int32_t is_saved(const fe_world *world, bytes as)
{
    bytes now = save(world);
    int32_t same = now.size == as.size && memcmp(now.data, as.data, (size_t)as.size) == 0;
    free(now.data);
    return same;
}

static void step(fe_world *world) { FE_TRUE(fe_world_step(world, 1.0f / 60.0f) == FE_OK); }

static fe_history *make_history(fe_world *world, int32_t frames, int64_t most)
{
    fe_history *history = NULL;
    fe_history_def def;
    fe_history_def_init(&def, sizeof def);
    def.frames = frames, def.bytes = most;
    FE_TRUE(fe_history_create(world, &def, &history) == FE_OK);
    return history;
}

static fe_world *make(const script *s, int32_t steps)
{
    static play p;
    fe_world *world;
    FE_TRUE(fe_world_create(NULL, &world) == FE_OK);
    play_begin(&p, world);
    play_until(&p, s, steps);
    return world;
}

static void destroy(fe_world *world) { FE_TRUE(fe_world_destroy(world) == FE_OK); }

// ---- rollback -------------------------------------------------------------------------------------------------------
typedef struct course {
    uint64_t hash[MOST_STEPS], told[MOST_STEPS];
} course;

static fe_world *new_world(fe_store **store, int32_t workers)
{
    fe_store_def store_def;
    fe_world_def def;
    fe_world *world;
    fe_store_def_init(&store_def, sizeof store_def);
    fe_world_def_init(&def, sizeof def);
    store_def.number = def.number = NUMBER;
    FE_TRUE(fe_store_create(&store_def, store) == FE_OK);
    def.store = *store, def.worker_count = workers;
    FE_TRUE(fe_world_create(&def, &world) == FE_OK);
    return world;
}

static void play_alone(const script *s, int32_t steps, course *c)
{
    static play p;
    fe_store *store;
    play_begin(&p, new_world(&store, 1));
    for (int32_t i = 1; i <= steps; ++i) {
        play_until(&p, s, i);
        c->hash[i] = play_hash(&p), c->told[i] = play_told(&p);
    }
    destroy(p.world);
    FE_TRUE(fe_store_destroy(store) == FE_OK);
}

typedef struct kept {
    play p;
    bytes saved;
} kept;

static void keep(fe_history *history, const play *p, kept *k)
{
    free(k->saved.data);
    k->p = *p, k->saved = save(p->world);
    FE_TRUE(fe_history_keep(history, p->step) == FE_OK);
}

static void go_on(const script *s, const course *c, play *p, int32_t to)
{
    play_until(p, s, to);
    if (play_hash(p) != c->hash[to] || play_told(p) != c->told[to])
        fail_msg("%s goes another way in step %d", s->name, (int)to);
}

// What a script does to the store is not undone: a second fe_asset_destroy is refused
static int32_t take_refusal(play *p, fe_result result)
{
    if (result < 0 && result != FE_ERROR_STALE) fail_msg("step %d: %s", (int)p->step, fe_last_error());
    return 0;
}

static void goes_back_and_on(const script *s, int32_t steps, int32_t every)
{
    static course c;
    static play p;
    static kept frames[FRAMES];
    fe_store *store;
    play_alone(s, steps, &c);
    fe_world *world = new_world(&store, 3);
    fe_history *history = make_history(world, FRAMES, 0);
    play_begin(&p, world);
    p.after = take_refusal;
    for (int32_t to = 1; to <= steps; ++to) {
        go_on(s, &c, &p, to);
        keep(history, &p, &frames[to % FRAMES]);
        if (to <= BACK || to % every != 0) continue;
        const kept *k = &frames[(to - BACK) % FRAMES];
        FE_TRUE(fe_history_restore(history, to - BACK) == FE_OK);
        if (!is_saved(world, k->saved)) fail_msg("%s: frame %d is another one", s->name, (int)(to - BACK));
        p = k->p;
        for (int32_t again = to - BACK + 1; again <= to; ++again) {
            go_on(s, &c, &p, again);
            keep(history, &p, &frames[again % FRAMES]);
        }
    }
    for (int32_t i = 0; i < FRAMES; ++i) free(frames[i].saved.data), frames[i].saved.data = NULL;
    destroy(world);
    FE_TRUE(fe_store_destroy(store) == FE_OK);
}

#define CASE(name, steps, every)                        \
    static void name##_goes_back_and_on(void **state)   \
    {                                                   \
        (void)state;                                    \
        goes_back_and_on(&script_##name, steps, every); \
    }
CASE(brief, 200, 1)
CASE(crowd, 60, 7)
CASE(mixed, 240, 16)
CASE(terrain, 200, 9)
CASE(fast, 120, 9)
CASE(joints, 120, 9)
CASE(spawn, 120, 9)
CASE(meshes, 120, 9)
CASE(scales, 60, 9)
CASE(compounds, 120, 9)

// ---- calls ----------------------------------------------------------------------------------------------------------
static void frames_are_counted_and_the_oldest_goes(void **state)
{
    (void)state;
    fe_world *world = make(&script_brief, 10);
    fe_history *history = make_history(world, 3, 0);
    fe_history_frame frames[4];
    FE_TRUE(fe_history_get_frames(history, NULL, 0, 0) == 0);
    for (int64_t i = -5; i < 0; ++i, step(world)) FE_TRUE(fe_history_keep(history, i) == FE_OK);
    FE_TRUE(fe_history_get_frames(history, frames, sizeof *frames, 4) == 3);
    for (int32_t i = 0; i < 3; ++i) FE_TRUE(frames[i].frame == i - 3 && frames[i].bytes > 1000);
    FE_TRUE(fe_history_restore(history, -4) == FE_ERROR_STALE && fe_history_restore(history, 0) == FE_ERROR_STALE);
    // numbers rise
    FE_TRUE(fe_history_keep(history, -1) == FE_ERROR_ARGUMENT && fe_history_keep(history, -2) == FE_ERROR_ARGUMENT);
    // those after a frame that is returned to go, it stays
    FE_TRUE(fe_history_restore(history, -2) == FE_OK && fe_history_restore(history, -1) == FE_ERROR_STALE);
    FE_TRUE(fe_history_restore(history, -2) == FE_OK && fe_history_keep(history, 7) == FE_OK);
    int64_t front[2] = {0, 1}; // a short record gets the front
    FE_TRUE(fe_history_get_frames(history, (fe_history_frame *)(void *)front, sizeof *front, 1) == 3);
    FE_TRUE(front[0] == -3 && front[1] == 1);
    destroy(world);
}

static void arguments_are_checked(void **state)
{
    (void)state;
    fe_world *world = make(&script_brief, 10);
    fe_history *history = NULL, *other = NULL;
    fe_history_def def;
    fe_history_def_init(&def, sizeof def);
    FE_TRUE(def.frames == 16 && def.bytes == 0);
    FE_TRUE(fe_history_create(NULL, &def, &history) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_history_create(world, &def, NULL) == FE_ERROR_ARGUMENT);
    def.frames = 0;
    FE_TRUE(fe_history_create(world, &def, &history) == FE_ERROR_ARGUMENT);
    def.frames = 65537;
    FE_TRUE(fe_history_create(world, &def, &history) == FE_ERROR_ARGUMENT);
    def.frames = 1, def.bytes = -1;
    FE_TRUE(fe_history_create(world, &def, &history) == FE_ERROR_ARGUMENT);
    def.bytes = 0, def.struct_size = 3;
    FE_TRUE(fe_history_create(world, &def, &history) == FE_ERROR_ARGUMENT && !history);
    FE_TRUE(fe_history_create(world, NULL, &history) == FE_OK && fe_history_create(world, NULL, &other) == FE_OK);
    FE_TRUE(fe_history_keep(NULL, 1) == FE_ERROR_ARGUMENT && fe_history_restore(NULL, 1) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_history_destroy(NULL) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_history_get_frames(NULL, NULL, 0, 0) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_history_keep(history, 1) == FE_OK && fe_history_get_frames(other, NULL, 0, 0) == 0);
    fe_history_frame frame;
    FE_TRUE(fe_history_get_frames(history, NULL, sizeof frame, 1) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_history_get_frames(history, &frame, 0, 1) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_history_get_frames(history, &frame, sizeof frame, -1) == FE_ERROR_ARGUMENT);
    // gone by itself, gone with its world, never one
    FE_TRUE(fe_history_destroy(history) == FE_OK && fe_history_destroy(history) == FE_ERROR_STALE);
    FE_TRUE(fe_history_keep(history, 2) == FE_ERROR_STALE && fe_history_restore(history, 1) == FE_ERROR_STALE);
    destroy(world);
    FE_TRUE(fe_history_keep(other, 2) == FE_ERROR_STALE && fe_history_restore(other, 1) == FE_ERROR_STALE);
    FE_TRUE(fe_history_get_frames(other, NULL, 0, 0) == FE_ERROR_STALE && fe_history_destroy(other) == FE_ERROR_STALE);
    FE_TRUE(fe_history_keep((fe_history *)(void *)&frame, 2) == FE_ERROR_STALE);
}

static void a_snapshot_in_between_changes_no_frame(void **state)
{
    (void)state;
    fe_world *world = make(&script_brief, 60), *donor = make(&script_mixed, 5);
    fe_history *history = make_history(world, 4, 0);
    bytes kept = save(world), foreign = save(donor);
    FE_TRUE(fe_history_keep(history, 1) == FE_OK);
    step(world);
    FE_TRUE(fe_world_restore(world, NULL, foreign.data, foreign.size) == FE_OK);
    FE_TRUE(fe_history_keep(history, 2) == FE_OK);
    step(world);
    FE_TRUE(fe_history_restore(history, 2) == FE_OK && is_saved(world, foreign));
    FE_TRUE(fe_history_restore(history, 1) == FE_OK && is_saved(world, kept));
    step(world);
    free(kept.data), free(foreign.data);
    destroy(world), destroy(donor);
}

static int64_t bytes_of(const fe_history *history, int32_t *out_count)
{
    fe_history_frame frames[32];
    int64_t sum = 0;
    *out_count = fe_history_get_frames(history, frames, sizeof *frames, 32);
    for (int32_t i = 0; i < *out_count; ++i) sum += frames[i].bytes;
    return sum;
}

static void bytes_are_bounded(void **state)
{
    (void)state;
    fe_world *world = make(&script_brief, 60);
    fe_history *wide = make_history(world, 32, 0);
    int32_t count;
    FE_TRUE(fe_history_keep(wide, 1) == FE_OK);
    int64_t one = bytes_of(wide, &count);
    fe_history *narrow = make_history(world, 32, 4 * one), *none = make_history(world, 32, one / 2);
    bytes before = save(world);
    FE_TRUE(fe_history_keep(none, 1) == FE_ERROR_LIMIT && fe_history_get_frames(none, NULL, 0, 0) == 0);
    FE_TRUE(is_saved(world, before));
    free(before.data);
    for (int64_t i = 1; i < 30; ++i, step(world)) {
        FE_TRUE(fe_history_keep(narrow, i) == FE_OK);
        FE_TRUE(bytes_of(narrow, &count) <= 4 * one && count >= 1);
    }
    FE_TRUE(count >= 2 && count <= 5);
    destroy(world);
}

// ---- sleep ----------------------------------------------------------------------------------------------------------
static fe_world *sleeping_world(fe_body *out_body)
{
    fe_world *world;
    play p;
    FE_TRUE(fe_world_create(NULL, &world) == FE_OK);
    play_begin(&p, world);
    part floor = part_plane(0.0f, 1.0f, 0.0f), box = part_box(0.5f, 0.5f, 0.5f, 0.0, 0.5, 0.0);
    play_add(&p, &floor);
    *out_body = p.actors[play_add(&p, &box)];
    for (int32_t i = 0; i < 240; ++i) step(world);
    int32_t awake = 1;
    FE_TRUE(fe_body_get_awake(world, *out_body, &awake) == FE_OK && !awake);
    return world;
}

static void frames_of_a_sleeping_world_share_what_they_hold(void **state)
{
    (void)state;
    fe_body body;
    fe_world *world = sleeping_world(&body);
    fe_history *history = make_history(world, 16, 0);
    fe_history_frame frames[16];
    bytes saved[8];
    for (int32_t i = 0; i < 8; ++i, step(world)) {
        saved[i] = save(world);
        FE_TRUE(fe_history_keep(history, i) == FE_OK);
    }
    FE_TRUE(fe_history_get_frames(history, frames, sizeof *frames, 16) == 8);
    for (int32_t i = 1; i < 8; ++i) FE_TRUE(frames[i].bytes < 100 && frames[0].bytes > 10 * frames[i].bytes);
    FE_TRUE(fe_history_restore(history, 5) == FE_OK && is_saved(world, saved[5]));
    // a call that wakes nobody is a change, too
    FE_TRUE(fe_body_set_user_data(world, body, 77) == FE_OK);
    bytes called = save(world);
    FE_TRUE(fe_history_keep(history, 6) == FE_OK);
    FE_TRUE(fe_history_get_frames(history, frames, sizeof *frames, 16) == 7 && frames[6].bytes > 1000);
    FE_TRUE(fe_history_restore(history, 5) == FE_OK && is_saved(world, saved[5]));
    FE_TRUE(fe_history_keep(history, 6) == FE_OK);
    FE_TRUE(fe_body_set_user_data(world, body, 77) == FE_OK && is_saved(world, called));
    // and what a call woke goes back to sleep
    FE_TRUE(fe_history_restore(history, 3) == FE_OK && is_saved(world, saved[3]));
    const fe_vec3 up = {0.0f, 3.0f, 0.0f};
    FE_TRUE(fe_body_set_linear_velocity(world, body, &up) == FE_OK);
    for (int32_t i = 0; i < 5; ++i) step(world);
    FE_TRUE(fe_history_restore(history, 1) == FE_OK && is_saved(world, saved[1]));
    for (int32_t i = 0; i < 8; ++i) free(saved[i].data);
    free(called.data);
    destroy(world);
}

// ---- assets ---------------------------------------------------------------------------------------------------------
static fe_asset make_field(fe_store *store)
{
    const float heights[9] = {0.0f, 0.1f, 0.0f, 0.2f, 0.0f, 0.1f, 0.0f, 0.1f, 0.3f};
    fe_heightfield_def def;
    fe_asset field;
    fe_heightfield_def_init(&def, sizeof def);
    def.rows = def.columns = 3, def.cell_x = def.cell_z = 4.0f, def.heights = heights;
    FE_TRUE(fe_heightfield_create(store, &def, &field) == FE_OK);
    return field;
}

static fe_body put_field(fe_world *world, fe_asset field)
{
    fe_geometry geometry;
    fe_body_def ground;
    fe_body body;
    fe_shape shape;
    fe_geometry_init(&geometry, sizeof geometry);
    geometry.type = FE_GEOMETRY_HEIGHTFIELD, geometry.asset = field;
    fe_body_def_init(&ground, sizeof ground);
    ground.type = FE_BODY_STATIC;
    FE_TRUE(fe_body_create(world, &ground, &body) == FE_OK);
    FE_TRUE(fe_shape_create(world, body, NULL, &geometry, &shape) == FE_OK);
    play p;
    play_begin(&p, world);
    part ball = part_sphere(0.3f, 4.0, 1.0, 4.0);
    play_add(&p, &ball);
    return body;
}

static float height_of(const fe_store *store, fe_asset field)
{
    float height = -1.0f;
    FE_TRUE(fe_heightfield_get_heights(store, field, 1, 1, 1, 1, &height) == FE_OK);
    return height;
}

// An edit is put back, and the editions before it are still theirs; another world sees its ground move back
static void edited_heights_are_put_back(void **state)
{
    (void)state;
    fe_store *store;
    fe_world *world = new_world(&store, 1), *other;
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.store = store;
    FE_TRUE(fe_world_create(&def, &other) == FE_OK);
    fe_asset field = make_field(store);
    put_field(world, field), put_field(other, field);
    fe_history *history = make_history(world, 8, 0);
    bytes saved[4];
    const float heights[4] = {0.0f, -1.0f, 0.5f, 0.25f};
    for (int32_t i = 0; i < 4; ++i) {
        if (i > 0) FE_TRUE(fe_heightfield_set_heights(store, field, 1, 1, 1, 1, heights + i) == FE_OK);
        for (int32_t k = 0; k < 30; ++k) step(world), step(other);
        saved[i] = save(world);
        FE_TRUE(fe_history_keep(history, i) == FE_OK);
    }
    for (int32_t i = 3; i >= 0; --i) {
        FE_TRUE(fe_history_restore(history, i) == FE_OK && is_saved(world, saved[i]));
        FE_TRUE(height_of(store, field) == heights[i]);
        step(world), step(other);
    }
    fe_bounds ground;
    fe_body bodies[2];
    FE_TRUE(fe_world_get_bodies(other, bodies, 2) == 2 && fe_body_get_bounds(other, bodies[0], &ground) == FE_OK);
    FE_TRUE(ground.lower.y > -0.1); // where it went down 1 m meanwhile
    for (int32_t i = 0; i < 4; ++i) free(saved[i].data);
    destroy(world), destroy(other);
    FE_TRUE(fe_store_destroy(store) == FE_OK);
}

// Its owner destroyed it, the world has none: it lives for the frame, and goes with it
static void assets_of_frames_stay(void **state)
{
    (void)state;
    fe_store *store;
    fe_world *world = new_world(&store, 1);
    fe_asset field = make_field(store);
    int64_t with_field, without;
    fe_body body = put_field(world, field);
    fe_history *history = make_history(world, 2, 0);
    FE_TRUE(fe_history_keep(history, 1) == FE_OK);
    bytes saved = save(world);
    FE_TRUE(fe_asset_destroy(store, field) == FE_OK && fe_body_destroy(world, body) == FE_OK);
    FE_TRUE(fe_store_get_bytes(store, &with_field) == FE_OK);
    step(world);
    FE_TRUE(fe_history_restore(history, 1) == FE_OK && is_saved(world, saved));
    for (int32_t k = 0; k < 30; ++k) step(world);
    FE_TRUE(fe_body_destroy(world, body) == FE_OK && fe_history_destroy(history) == FE_OK);
    FE_TRUE(fe_store_get_bytes(store, &without) == FE_OK && without < with_field);
    free(saved.data);
    destroy(world);
    FE_TRUE(fe_store_destroy(store) == FE_OK);
}

// ---- who is inside --------------------------------------------------------------------------------------------------
typedef struct caller {
    fe_history *history;
    fe_world *world;
    fe_result keep, restore;
    int32_t frames;
} caller;

static int32_t call_from_inside(void *user, const fe_filter_pair *pair)
{
    (void)pair;
    caller *c = user;
    c->keep = fe_history_keep(c->history, 100);
    c->restore = fe_history_restore(c->history, 1);
    c->frames = fe_history_get_frames(c->history, NULL, 0, 0);
    return 1;
}

static void a_step_refuses_histories(void **state)
{
    (void)state;
    fe_body body;
    fe_world *world = sleeping_world(&body);
    fe_history *history = make_history(world, 2, 0);
    caller c = {history, world, FE_OK, FE_OK, 0};
    FE_TRUE(fe_history_keep(history, 1) == FE_OK && fe_world_set_pair_filter(world, call_from_inside, &c) == FE_OK);
    play p;
    play_begin(&p, world);
    part box = part_box(0.5f, 0.5f, 0.5f, 0.0, 1.4, 0.0);
    play_add(&p, &box);
    fe_shape shapes[1];
    FE_TRUE(fe_body_get_shapes(world, p.actors[0], shapes, 1) == 1);
    FE_TRUE(fe_shape_set_pair_filter(world, shapes[0], 1) == FE_OK);
    step(world);
    FE_TRUE(c.keep == FE_ERROR_STEPPING && c.restore == FE_ERROR_STEPPING && c.frames == FE_ERROR_STEPPING);
    FE_TRUE(fe_history_restore(history, 1) == FE_OK); // the filter is the host's, and stays
    destroy(world);
}

// ---- memory ---------------------------------------------------------------------------------------------------------
// The world grows between the frames, so that arrays are made anew when it returns
static void each_allocation_may_fail_and_nothing_changes(void **state)
{
    (void)state;
    counting c = {.fail_count = 0};
    fe_world *world = counting_world(&c);
    static play p;
    play_begin(&p, world);
    play_until(&p, &script_brief, 20);
    fe_history *history = NULL;
    fe_result result = FE_ERROR_MEMORY;
    c.fail_count = 1;
    for (c.fail_from = 1; result != FE_OK; ++c.fail_from) {
        c.calls = 0;
        int64_t blocks = c.blocks;
        result = fe_history_create(world, NULL, &history);
        FE_TRUE(result == FE_OK || (result == FE_ERROR_MEMORY && c.blocks == blocks));
    }
    c.fail_count = 0;
    FE_TRUE(fe_history_keep(history, 0) == FE_OK);
    bytes first = save(world);
    play_until(&p, &script_brief, 60);
    bytes second = save(world);
    result = FE_ERROR_MEMORY;
    c.fail_count = 1;
    for (c.fail_from = 1; result != FE_OK; ++c.fail_from) {
        c.calls = 0;
        int64_t blocks = c.blocks;
        result = fe_history_keep(history, 1);
        if (result == FE_OK) break;
        FE_TRUE(result == FE_ERROR_MEMORY && fe_history_get_frames(history, NULL, 0, 0) == 1);
        FE_TRUE(c.blocks - blocks <= 1 && is_saved(world, second)); // a block for the next try
    }
    result = FE_ERROR_MEMORY;
    for (c.fail_from = 1; result != FE_OK; ++c.fail_from) {
        c.calls = 0;
        int64_t blocks = c.blocks;
        result = fe_history_restore(history, 0);
        if (result == FE_OK) break;
        FE_TRUE(result == FE_ERROR_MEMORY && fe_history_get_frames(history, NULL, 0, 0) == 2);
        FE_TRUE(c.blocks == blocks && is_saved(world, second));
    }
    FE_TRUE(c.fail_from > 1 && is_saved(world, first)); // an array was made anew
    c.fail_count = 0;
    free(first.data), free(second.data);
    destroy(world);
    FE_TRUE(c.blocks == 0 && c.bytes == 0 && c.wrong == 0);
}

// A settled loop of keeping and going back asks for no memory
static void a_full_history_allocates_nothing(void **state)
{
    (void)state;
    counting c = {.fail_count = 0};
    fe_world *world = counting_world(&c);
    static play p;
    play_begin(&p, world);
    part floor = part_plane(0.0f, 1.0f, 0.0f);
    play_add(&p, &floor);
    for (int32_t i = 0; i < 5; ++i) {
        part box = part_box(0.5f, 0.5f, 0.5f, 0.0, 0.5 + i, 0.0);
        box.body.sleep_allowed = 0;
        play_add(&p, &box);
    }
    for (int32_t i = 0; i < 120; ++i) step(world);
    fe_history *history = make_history(world, 4, 0);
    int64_t calls = 0;
    for (int64_t i = 0; i < 60; ++i) {
        if (i == 20) calls = c.calls;
        FE_TRUE(fe_history_keep(history, i) == FE_OK);
        step(world);
        if (i % 3 == 2) FE_TRUE(fe_history_restore(history, i - 2) == FE_OK);
    }
    FE_TRUE(c.calls == calls);
    destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(brief_goes_back_and_on),
        cmocka_unit_test(crowd_goes_back_and_on),
        cmocka_unit_test(mixed_goes_back_and_on),
        cmocka_unit_test(terrain_goes_back_and_on),
        cmocka_unit_test(fast_goes_back_and_on),
        cmocka_unit_test(joints_goes_back_and_on),
        cmocka_unit_test(spawn_goes_back_and_on),
        cmocka_unit_test(meshes_goes_back_and_on),
        cmocka_unit_test(scales_goes_back_and_on),
        cmocka_unit_test(compounds_goes_back_and_on),
        cmocka_unit_test(frames_are_counted_and_the_oldest_goes),
        cmocka_unit_test(arguments_are_checked),
        cmocka_unit_test(a_snapshot_in_between_changes_no_frame),
        cmocka_unit_test(bytes_are_bounded),
        cmocka_unit_test(frames_of_a_sleeping_world_share_what_they_hold),
        cmocka_unit_test(edited_heights_are_put_back),
        cmocka_unit_test(assets_of_frames_stay),
        cmocka_unit_test(a_step_refuses_histories),
        cmocka_unit_test(each_allocation_may_fail_and_nothing_changes),
        cmocka_unit_test(a_full_history_allocates_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
