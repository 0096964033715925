// rollback.c - two players who each simulate the whole game, and a network between them that is late, lossy, and
// delivers twice and out of order. All in one process; rollback_udp.c does it with processes and sockets.
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
#include "rollback_session.h"

enum {
    SENT = 16,       // inputs in a packet
    LEAST_DELAY = 2, // frames that a packet takes, 33 to 133 ms
    MOST_DELAY = 8,
    LOST = 10,    // percent
    DOUBLED = 5,  // percent
    PACKETS = 256 // under way
};

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
static void receive(session *me, int index, network *n, int tick)
{
    for (int i = 0; i < PACKETS; ++i) {
        packet *p = &n->packets[i];
        if (!p->arrives || p->arrives > tick || p->to != index) continue;
        // where something before it is lost, the next packet has both
        for (int k = 0; k < p->count; ++k) learn(me, 1 - index, p->first + k, p->keys[k]);
        p->arrives = 0;
    }
    if (me->wrong < me->frame) go_back(me, me->wrong);
}

static void play_tick(session *me, int index, network *n, int tick, int frames)
{
    receive(me, index, n, tick);
    if (me->frame < frames && me->frame - me->known[1 - index] < AHEAD) {
        while (me->known[index] <= me->frame + INPUT_DELAY)
            learn(me, index, me->known[index], keys_of(index, me->known[index]));
        keep_and_make_frame(me);
    }
    packet p = {.to = 1 - index, .count = me->known[index] < SENT ? me->known[index] : SENT};
    p.first = me->known[index] - p.count;
    memcpy(p.keys, me->keys[index] + p.first, (size_t)p.count);
    post(n, p, tick);
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
    static session players[PLAYERS];
    static network n;
    static uint64_t alone[MOST_FRAMES];
    int seconds = argc > 1 ? atoi(argv[1]) : 10;
    int frames = seconds > 0 && seconds < 60 ? 60 * seconds : MOST_FRAMES, ticks = 0;
    n.chance = argc > 2 ? (uint32_t)atoi(argv[2]) : 1;
    play_alone(alone, frames);
    for (int p = 0; p < PLAYERS; ++p) {
        game_begin(&players[p].game);
        session_begin(&players[p], 0);
    }
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
