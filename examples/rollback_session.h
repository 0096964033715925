// rollback_session.h - one player's copy of the game: what it knows of the keys, what it played, and the way back.
//
// A key that is not known yet is expected to be what it was last. When the true one comes and is another, the world
// goes back to that frame, and the steps since are made again.
#ifndef FEATHER_EXAMPLE_ROLLBACK_SESSION_H
#define FEATHER_EXAMPLE_ROLLBACK_SESSION_H
#include "rollback_game.h"

enum {
    INPUT_DELAY = 2,           // frames between a key and its effect: so many need no prediction
    AHEAD = 8,                 // frames that a player may be ahead of what it knows
    HISTORY = 32,              // frames kept
    MOST_FRAMES = 60 * 60,     // a minute
    MORE_FRAMES = 2 * HISTORY, // keys that may be known beyond
    NO_FRAME = -1
};

typedef struct session {
    game game;
    fe_history *history;
    state states[HISTORY];                              // beside the frames of the history
    uint8_t keys[PLAYERS][MOST_FRAMES + MORE_FRAMES];   // true ones, below `known`
    uint8_t played[PLAYERS][MOST_FRAMES + MORE_FRAMES]; // what the steps were made with
    int known[PLAYERS];
    int frame;                      // the next one
    int wrong;                      // the first frame that was made with a key that was not so, or `frame`
    uint64_t hash[MOST_FRAMES + 1]; // of the world before each frame, as it was last made
    int fault;                      // the frame in which this copy goes astray, to show a desync; NO_FRAME
    int rollbacks, repeated;
} session;

// For a game that is there, at its frame 0 or later
static inline void session_begin(session *s, int frame)
{
    fe_history_def def;
    fe_history_def_init(&def, sizeof def);
    def.frames = HISTORY;
    must(fe_history_create(s->game.world, &def, &s->history));
    s->frame = s->wrong = s->known[0] = s->known[1] = frame;
    s->fault = NO_FRAME;
    s->hash[frame] = game_hash(&s->game);
}

// Known, or as it was last
static inline uint8_t expected(const session *s, int who, int frame)
{
    int known = s->known[who];
    return frame < known ? s->keys[who][frame] : known ? s->keys[who][known - 1] : 0;
}

static inline void make_frame(session *s)
{
    uint8_t keys[PLAYERS];
    for (int p = 0; p < PLAYERS; ++p) keys[p] = s->played[p][s->frame] = expected(s, p, s->frame);
    if (s->frame == s->fault)
        must(fe_body_set_angular_velocity(s->game.world, s->game.now.cars[0], &(fe_vec3){0.0f, 0.001f, 0.0f}));
    game_step(&s->game, keys);
    s->hash[++s->frame] = game_hash(&s->game);
}

static inline void keep_and_make_frame(session *s)
{
    must(fe_history_keep(s->history, s->frame));
    s->states[s->frame % HISTORY] = s->game.now;
    make_frame(s);
    s->wrong = s->frame;
}

// The next key of a player; one that is known already says nothing new
static inline void learn(session *s, int who, int frame, uint8_t key)
{
    if (frame != s->known[who] || frame >= MOST_FRAMES + MORE_FRAMES) return;
    s->keys[who][frame] = key;
    ++s->known[who];
    if (frame < s->wrong && s->played[who][frame] != key) s->wrong = frame;
}

// The world as it was before a frame that is kept
static inline void return_to(session *s, int frame)
{
    must(fe_history_restore(s->history, frame));
    s->game.now = s->states[frame % HISTORY];
    s->frame = s->wrong = frame;
}

static inline void go_back(session *s, int frame)
{
    int now = s->frame;
    return_to(s, frame);
    make_frame(s); // the history holds this one
    while (s->frame < now) keep_and_make_frame(s);
    s->wrong = s->frame;
    ++s->rollbacks, s->repeated += now - frame;
}

// Frames whose keys are all known: the world before the next one is the same for everybody
static inline int confirmed(const session *s)
{
    int known = s->known[0] < s->known[1] ? s->known[0] : s->known[1];
    return known < s->frame ? known : s->frame;
}

#endif
