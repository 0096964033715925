// rollback_game.h - a small game for the examples of rollback: two cars that shoot at a wall of crates.
//
// The same keys make the same calls in the same order, and so the same world, bit for bit.
#ifndef FEATHER_EXAMPLE_ROLLBACK_GAME_H
#define FEATHER_EXAMPLE_ROLLBACK_GAME_H
#include "feather.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DT (1.0f / 60)

enum {
    PLAYERS = 2,
    CRATES = 24,
    SHOTS = 8 // of a player at a time: the oldest goes
};
enum { LEFT = 1, RIGHT = 2, FORWARD = 4, BACK = 8, FIRE = 16 };

static inline int32_t must(int32_t result)
{
    if (result >= 0) return result;
    printf("%s\n", fe_last_error());
    exit(1);
}

static inline uint32_t mix(uint32_t x)
{
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}
static inline uint32_t draw(uint32_t *state, uint32_t below) { return mix(*state += 0x9e3779b9u) % below; }

// A player holds its keys for a third of a second
static inline uint8_t keys_of(int player, int frame)
{
    return (uint8_t)(mix((uint32_t)(player + 2 * (frame / 20))) & 31);
}

// What the world does not know: it goes back with it
typedef struct state {
    fe_body cars[PLAYERS], shots[PLAYERS][SHOTS];
    int32_t next_shot[PLAYERS];
    uint8_t before[PLAYERS]; // keys of the frame before
} state;

typedef struct game {
    fe_world *world;
    state now;
} game;

static inline fe_body add(fe_world *world, int32_t type, double x, double y, double z, const fe_geometry *form)
{
    fe_body_def def;
    fe_body body;
    fe_shape shape;
    fe_body_def_init(&def, sizeof def);
    def.type = type;
    def.transform = fe_make_transform(x, y, z);
    must(fe_body_create(world, &def, &body));
    must(fe_shape_create(world, body, NULL, form, &shape));
    return body;
}

static inline void game_begin(game *g)
{
    memset(g, 0, sizeof *g);
    fe_world_def def;
    fe_geometry form;
    fe_world_def_init(&def, sizeof def);
    def.number = 1; // the same handles for all
    must(fe_world_create(&def, &g->world));
    fe_geometry_plane(&form, 0.0f, 1.0f, 0.0f, 0.0f);
    add(g->world, FE_BODY_STATIC, 0.0, 0.0, 0.0, &form);
    fe_geometry_box(&form, 0.3f, 0.3f, 0.3f);
    for (int i = 0; i < CRATES; ++i)
        add(g->world, FE_BODY_DYNAMIC, 0.7 * (i % 4) - 1.05, 0.3 + 0.6 * (i / 8), 0.7 * (i / 4 % 2), &form);
    fe_geometry_box(&form, 0.5f, 0.25f, 0.8f);
    for (int p = 0; p < PLAYERS; ++p) g->now.cars[p] = add(g->world, FE_BODY_DYNAMIC, 0.0, 0.25, p ? 5.0 : -5.0, &form);
}

static inline void fire(game *g, int player)
{
    fe_transform at;
    fe_geometry ball;
    fe_body *shot = &g->now.shots[player][g->now.next_shot[player]++ % SHOTS];
    if (*shot) must(fe_body_destroy(g->world, *shot));
    must(fe_body_get_transform(g->world, g->now.cars[player], &at));
    fe_geometry_sphere(&ball, 0.15f);
    *shot = add(g->world, FE_BODY_DYNAMIC, at.position.x, at.position.y + 0.8, at.position.z, &ball);
    must(fe_body_set_linear_velocity(g->world, *shot, &(fe_vec3){0.0f, 1.0f, player ? -15.0f : 15.0f}));
}

// One frame
static inline void game_step(game *g, const uint8_t keys[PLAYERS])
{
    const float push = 4000.0f; // N
    for (int p = 0; p < PLAYERS; ++p) {
        fe_vec3 force = {push * (float)(((keys[p] & RIGHT) != 0) - ((keys[p] & LEFT) != 0)), 0.0f,
                         push * (float)(((keys[p] & FORWARD) != 0) - ((keys[p] & BACK) != 0))};
        must(fe_body_add_force(g->world, g->now.cars[p], &force));
        if (keys[p] & FIRE && !(g->now.before[p] & FIRE)) fire(g, p);
        g->now.before[p] = keys[p];
    }
    must(fe_world_step(g->world, DT));
}

static inline uint64_t game_hash(const game *g)
{
    uint32_t words[2];
    must(fe_world_hash(g->world, words));
    return words[0] | (uint64_t)words[1] << 32;
}

#endif
