// rollback.c - two players who each simulate the whole game, and a network between them that is late, lossy, and
// delivers twice and out of order.
//
//     cc rollback.c -lfeather -lm -o rollback && ./rollback [SECONDS [SEED]]
//
// Nobody waits for the other's input: a player predicts that it stays what it was, and goes on. When the true one comes
// and is another, the world goes back to that frame and makes the steps again. Each frame of the game:
//
//   1. what has arrived is read; the first frame whose prediction was wrong is remembered
//   2. fe_history_restore goes back to it, and the steps since are made again
//   3. fe_history_keep keeps the world, the inputs are applied, the world steps
//   4. the last inputs of this player are sent, sixteen at once, so that a lost packet does no harm
//
// Frames whose inputs are all known must be the same for both, and the same as in a game without a network.
#include "feather.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DT (1.0f / 60)

enum {
    PLAYERS = 2,
    CRATES = 24,
    SHOTS = 8,       // of a player at a time: the oldest goes
    INPUT_DELAY = 2, // frames between a key and its effect: so many need no prediction
    AHEAD = 8,       // frames that a player may be ahead of what it knows
    HISTORY = 16,    // frames kept
    SENT = 16,       // inputs in a packet
    LEAST_DELAY = 2, // frames that a packet takes, 33 to 133 ms
    MOST_DELAY = 8,
    LOST = 10,            // percent
    DOUBLED = 5,          // percent
    PACKETS = 256,        // under way
    MOST_FRAMES = 60 * 60 // a minute
};
enum { LEFT = 1, RIGHT = 2, FORWARD = 4, BACK = 8, FIRE = 16 };

static int32_t must(int32_t result)
{
    if (result >= 0) return result;
    printf("%s\n", fe_last_error());
    exit(1);
}

// ---- chance ---------------------------------------------------------------------------------------------------------
static uint32_t mix(uint32_t x)
{
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}
static uint32_t draw(uint32_t *state, uint32_t below) { return mix(*state += 0x9e3779b9u) % below; }

// A player holds its keys for a third of a second
static uint8_t keys_of(int player, int frame) { return (uint8_t)(mix((uint32_t)(player + 2 * (frame / 20))) & 31); }

// ---- the game -------------------------------------------------------------------------------------------------------
// What the world does not know: it goes back with it
typedef struct state {
    fe_body shots[PLAYERS][SHOTS];
    int next_shot[PLAYERS];
    uint8_t before[PLAYERS]; // keys of the frame before
} state;

typedef struct game {
    fe_world *world;
    fe_body cars[PLAYERS];
    state now;
} game;

static fe_body add(fe_world *world, int32_t type, double x, double y, double z, const fe_geometry *form)
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

static void game_begin(game *g)
{
    memset(g, 0, sizeof *g);
    fe_world_def def;
    fe_geometry form;
    fe_world_def_init(&def, sizeof def);
    def.number = 1; // the same handles for both
    must(fe_world_create(&def, &g->world));
    fe_geometry_plane(&form, 0.0f, 1.0f, 0.0f, 0.0f);
    add(g->world, FE_BODY_STATIC, 0.0, 0.0, 0.0, &form);
    fe_geometry_box(&form, 0.3f, 0.3f, 0.3f);
    for (int i = 0; i < CRATES; ++i)
        add(g->world, FE_BODY_DYNAMIC, 0.7 * (i % 4) - 1.05, 0.3 + 0.6 * (i / 8), 0.7 * (i / 4 % 2), &form);
    fe_geometry_box(&form, 0.5f, 0.25f, 0.8f);
    for (int p = 0; p < PLAYERS; ++p) g->cars[p] = add(g->world, FE_BODY_DYNAMIC, 0.0, 0.25, p ? 5.0 : -5.0, &form);
}

static void fire(game *g, int player)
{
    fe_transform at;
    fe_geometry ball;
    fe_body *shot = &g->now.shots[player][g->now.next_shot[player]++ % SHOTS];
    if (*shot) must(fe_body_destroy(g->world, *shot));
    must(fe_body_get_transform(g->world, g->cars[player], &at));
    fe_geometry_sphere(&ball, 0.15f);
    *shot = add(g->world, FE_BODY_DYNAMIC, at.position.x, at.position.y + 0.8, at.position.z, &ball);
    must(fe_body_set_linear_velocity(g->world, *shot, &(fe_vec3){0.0f, 1.0f, player ? -15.0f : 15.0f}));
}

// One frame: the same keys make the same calls in the same order
static void game_step(game *g, const uint8_t *keys)
{
    const float push = 4000.0f; // N
    for (int p = 0; p < PLAYERS; ++p) {
        fe_vec3 force = {push * (float)(((keys[p] & RIGHT) != 0) - ((keys[p] & LEFT) != 0)), 0.0f,
                         push * (float)(((keys[p] & FORWARD) != 0) - ((keys[p] & BACK) != 0))};
        must(fe_body_add_force(g->world, g->cars[p], &force));
        if (keys[p] & FIRE && !(g->now.before[p] & FIRE)) fire(g, p);
        g->now.before[p] = keys[p];
    }
    must(fe_world_step(g->world, DT));
}

static uint64_t game_hash(const game *g)
{
    uint32_t words[2];
    must(fe_world_hash(g->world, words));
    return words[0] | (uint64_t)words[1] << 32;
}

// ---- the network ----------------------------------------------------------------------------------------------------
typedef struct packet {
    int arrives;      // tick, 0: none
    int to;           // player
    int first, count; // frames of the inputs
    uint8_t keys[SENT];
} packet;

typedef struct network {
    packet packets[PACKETS];
    uint32_t chance;
    int sent, lost, doubled;
} network;

static void put(network *n, packet p, int tick)
{
    p.arrives = tick + LEAST_DELAY + (int)draw(&n->chance, MOST_DELAY - LEAST_DELAY + 1);
    for (int i = 0; i < PACKETS; ++i) {
        if (n->packets[i].arrives) continue;
        n->packets[i] = p;
        return;
    }
}

static void post(network *n, packet p, int tick)
{
    ++n->sent;
    if (draw(&n->chance, 100) < LOST) {
        ++n->lost;
        return;
    }
    put(n, p, tick);
    if (draw(&n->chance, 100) >= DOUBLED) return;
    ++n->doubled;
    put(n, p, tick);
}

// ---- a player -------------------------------------------------------------------------------------------------------
typedef struct player {
    game game;
    fe_history *history;
    state states[HISTORY];                       // beside the frames of the history
    uint8_t keys[PLAYERS][MOST_FRAMES + SENT];   // true ones, below `known`
    uint8_t played[PLAYERS][MOST_FRAMES + SENT]; // what the steps were made with
    int known[PLAYERS];
    int frame;                      // the next one
    uint64_t hash[MOST_FRAMES + 1]; // of the world before each frame, as it was last made
    int rollbacks, repeated;
} player;

// Known, or as it was last
static uint8_t expected(const player *me, int who, int frame)
{
    int known = me->known[who];
    return frame < known ? me->keys[who][frame] : known ? me->keys[who][known - 1] : 0;
}

static void make_frame(player *me)
{
    uint8_t keys[PLAYERS];
    for (int p = 0; p < PLAYERS; ++p) keys[p] = me->played[p][me->frame] = expected(me, p, me->frame);
    me->hash[me->frame] = game_hash(&me->game);
    game_step(&me->game, keys);
    ++me->frame;
}

static void keep(player *me)
{
    must(fe_history_keep(me->history, me->frame));
    me->states[me->frame % HISTORY] = me->game.now;
}

static void go_back(player *me, int frame)
{
    int now = me->frame;
    must(fe_history_restore(me->history, frame));
    me->game.now = me->states[frame % HISTORY];
    for (me->frame = frame; me->frame < now; ++me->repeated) {
        if (me->frame > frame) keep(me);
        make_frame(me);
    }
    ++me->rollbacks;
}

// The first frame that was made with other keys than these
static int read_packet(player *me, int from, const packet *p)
{
    int wrong = me->frame;
    for (int i = 0; i < p->count; ++i) {
        int frame = p->first + i;
        if (frame != me->known[from]) continue; // known, or something before it is lost: the next packet has both
        me->keys[from][frame] = p->keys[i];
        ++me->known[from];
        if (frame < wrong && me->played[from][frame] != p->keys[i]) wrong = frame;
    }
    return wrong;
}

static void receive(player *me, int index, network *n, int tick)
{
    int wrong = me->frame;
    for (int i = 0; i < PACKETS; ++i) {
        packet *p = &n->packets[i];
        if (!p->arrives || p->arrives > tick || p->to != index) continue;
        int first = read_packet(me, 1 - index, p);
        if (first < wrong) wrong = first;
        p->arrives = 0;
    }
    if (wrong < me->frame) go_back(me, wrong);
}

static void play_tick(player *me, int index, network *n, int tick, int frames)
{
    receive(me, index, n, tick);
    if (me->frame < frames && me->frame - me->known[1 - index] < AHEAD) {
        int due = me->frame + INPUT_DELAY;
        for (; me->known[index] <= due; ++me->known[index])
            me->keys[index][me->known[index]] = keys_of(index, me->known[index]);
        keep(me);
        make_frame(me);
    }
    packet p = {.to = 1 - index, .count = me->known[index] < SENT ? me->known[index] : SENT};
    p.first = me->known[index] - p.count;
    memcpy(p.keys, me->keys[index] + p.first, (size_t)p.count);
    post(n, p, tick);
}

static void player_begin(player *me)
{
    game_begin(&me->game);
    fe_history_def def;
    fe_history_def_init(&def, sizeof def);
    def.frames = HISTORY;
    must(fe_history_create(me->game.world, &def, &me->history));
}

// ---- all of it ------------------------------------------------------------------------------------------------------
// The game without a network, with every key known
static void play_alone(uint64_t *hash, int frames)
{
    game g;
    game_begin(&g);
    for (int frame = 0; frame < frames; ++frame) {
        uint8_t keys[PLAYERS];
        for (int p = 0; p < PLAYERS; ++p) keys[p] = keys_of(p, frame);
        hash[frame] = game_hash(&g);
        game_step(&g, keys);
    }
    must(fe_world_destroy(g.world));
}

int main(int argc, char **argv)
{
    static player players[PLAYERS];
    static network n;
    static uint64_t alone[MOST_FRAMES];
    int seconds = argc > 1 ? atoi(argv[1]) : 10;
    int frames = seconds > 0 && seconds < 60 ? 60 * seconds : MOST_FRAMES, ticks = 0;
    n.chance = argc > 2 ? (uint32_t)atoi(argv[2]) : 1;
    play_alone(alone, frames);
    for (int p = 0; p < PLAYERS; ++p) player_begin(&players[p]);
    // until both have made every frame, and know what they made it with
    while (players[0].known[1] < frames || players[1].known[0] < frames || players[0].frame < frames ||
           players[1].frame < frames) {
        ++ticks;
        for (int p = 0; p < PLAYERS; ++p) play_tick(&players[p], p, &n, ticks, frames);
    }
    int differ = 0;
    for (int frame = 0; frame < frames; ++frame)
        differ += players[0].hash[frame] != alone[frame] || players[1].hash[frame] != alone[frame];
    printf("%d frames in %d ticks; of %d packets %d were lost, %d came twice\n", frames, ticks, n.sent, n.lost,
           n.doubled);
    for (int p = 0; p < PLAYERS; ++p)
        printf("player %d went back %d times and made %d frames again\n", p, players[p].rollbacks, players[p].repeated);
    printf("%d frames differ from the game without a network\n", differ);
    for (int p = 0; p < PLAYERS; ++p) must(fe_world_destroy(players[p].game.world));
    return differ != 0;
}
