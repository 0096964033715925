// rooms.c - a server of a thousand rooms: each a world of its own, all made from one, stepped together on one pool.
//
//     cc rooms.c -lfeather -lm -o rooms && ./rooms [ROOMS [WORKERS]]
//
// A room is a floor, a tower of crates, and a ball on a spring that its player swings at the tower. Players' pulls go
// in, positions come out, as arrays over all rooms. A room whose tower has fallen is set back to how it began. At the
// end a room is compared with a world that was stepped alone: they are the same, bit for bit.
#include "feather.h"

#include <stdio.h>
#include <stdlib.h>

enum { CRATES = 8, STEPS = 240, MOST_ROOMS = 100000 };
#define DT (1.0f / 60)

static int32_t must(int32_t result)
{
    if (result >= 0) return result;
    printf("%s\n", fe_last_error());
    exit(1);
}

static fe_body add(fe_world *world, int32_t type, double x, double y, const fe_geometry *form)
{
    fe_body_def def;
    fe_body body;
    fe_shape shape;
    fe_body_def_init(&def, sizeof def);
    def.type = type;
    def.transform = fe_make_transform(x, y, 0.0);
    must(fe_body_create(world, &def, &body));
    must(fe_shape_create(world, body, NULL, form, &shape));
    return body;
}

// What every room is at first. Its handles name the same things in all of them
typedef struct room {
    fe_world *world;
    fe_body ball, top; // of the tower
} room;

static room make_room(void)
{
    room r;
    fe_geometry form;
    must(fe_world_create(NULL, &r.world));
    fe_geometry_plane(&form, 0.0f, 1.0f, 0.0f, 0.0f);
    add(r.world, FE_BODY_STATIC, 0.0, 0.0, &form);
    fe_geometry_box(&form, 0.3f, 0.3f, 0.3f);
    for (int32_t i = 0; i < CRATES; ++i) r.top = add(r.world, FE_BODY_DYNAMIC, 0.0, 0.3 + 0.6 * i, &form);
    fe_geometry_sphere(&form, 0.4f);
    r.ball = add(r.world, FE_BODY_DYNAMIC, -3.0, 1.0, &form);
    fe_distance_joint_def spring;
    fe_joint joint;
    fe_distance_joint_def_init(&spring, sizeof spring);
    spring.body_b = r.ball; // body_a 0: the world
    spring.frame_a.position = (fe_vec3){-3.0f, 4.0f, 0.0f};
    spring.lower = 0.0f, spring.upper = 6.0f, spring.spring_hertz = 1.0f, spring.target = 3.0f;
    must(fe_distance_joint_create(r.world, &spring, &joint));
    return r;
}

// N along x: each player has a strength and a rhythm of its own
static float pull_of(int32_t player, int32_t step)
{
    int32_t period = 40 + player % 37;
    return (step % period < period / 2 ? 200.0f : -200.0f) * (float)(1 + player % 29);
}

static fe_array array_of(const fe_body *body, int32_t field, int32_t row, int32_t rooms, float **out_data)
{
    fe_array a;
    fe_array_init(&a, sizeof a);
    a.field = field, a.items = body, a.item_count = 1;
    a.bytes = (int64_t)rooms * row * (int64_t)sizeof(float);
    *out_data = a.data = calloc((size_t)(rooms * row), sizeof(float));
    if (!a.data) must(FE_ERROR_MEMORY);
    return a;
}

// The same room, alone
static int32_t is_as_alone(const room *r, const uint8_t *resets, int32_t player, const uint32_t words[2])
{
    fe_world *alone;
    fe_state *start;
    uint32_t own[2];
    must(fe_state_create(r->world, NULL, &start));
    must(fe_world_clone(r->world, NULL, &alone));
    for (int32_t step = 0; step < STEPS; ++step) {
        fe_vec3 force = {pull_of(player, step), 0.0f, 0.0f};
        must(fe_body_add_force(alone, r->ball, &force));
        must(fe_world_step(alone, DT));
        if (resets[step]) must(fe_world_set_state(alone, start));
    }
    must(fe_world_hash(alone, own));
    must(fe_world_destroy(alone));
    must(fe_state_destroy(start));
    return own[0] == words[0] && own[1] == words[1];
}

int main(int argc, char **argv)
{
    int32_t rooms = argc > 1 ? atoi(argv[1]) : 1000, workers = argc > 2 ? atoi(argv[2]) : 2, fallen = 0, same = 0;
    if (rooms < 1 || rooms > MOST_ROOMS) rooms = 1000;
    room r = make_room();
    fe_pool *pool;
    fe_batch *batch;
    fe_batch_def def;
    must(fe_pool_create(workers, &pool));
    fe_batch_def_init(&def, sizeof def);
    def.world_count = rooms, def.pool = pool;
    must(fe_batch_create(r.world, &def, &batch));

    float *forces, *tops;
    fe_array input = array_of(&r.ball, FE_FIELD_FORCE, 6, rooms, &forces),
             output = array_of(&r.top, FE_FIELD_TRANSFORM, 7, rooms, &tops);
    must(fe_batch_bind(batch, &input, 1, &output, 1));
    uint8_t *has_fallen = calloc((size_t)rooms, 1);
    static uint8_t resets[3][STEPS]; // of rooms 0, 28 and the last
    const int32_t looked_at[3] = {0, 28 % rooms, rooms - 1};
    uint32_t *words = malloc((size_t)rooms * 2 * sizeof *words);
    if (!has_fallen || !words) must(FE_ERROR_MEMORY);
    for (int32_t step = 0; step < STEPS; ++step) {
        for (int32_t i = 0; i < rooms; ++i) forces[6 * i] = pull_of(i, step);
        must(fe_batch_step(batch, DT, 1, NULL, NULL));
        for (int32_t i = 0; i < rooms; ++i) {
            has_fallen[i] = tops[7 * i + 1] < 0.3f * CRATES;
            fallen += has_fallen[i];
        }
        for (int32_t k = 0; k < 3; ++k) resets[k][step] = has_fallen[looked_at[k]];
        must(fe_batch_reset(batch, has_fallen, NULL, NULL));
    }
    must(fe_batch_hash(batch, words));
    for (int32_t k = 0; k < 3; ++k) same += is_as_alone(&r, resets[k], looked_at[k], words + 2 * looked_at[k]);
    printf("%d rooms, %d steps each; %d towers fell; %d of 3 rooms are as a world alone\n", rooms, STEPS, fallen, same);
    must(fe_batch_destroy(batch));
    must(fe_pool_destroy(pool));
    must(fe_world_destroy(r.world));
    free(forces), free(tops), free(has_fallen), free(words);
    return same != 3 || fallen == 0;
}
