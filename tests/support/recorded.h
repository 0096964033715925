// recorded.h - recordings in memory, for tests: made, kept, played.
#ifndef FE_TESTS_RECORDED_H
#define FE_TESTS_RECORDED_H
#include "feather.h"

typedef struct recorded {
    unsigned char *bytes;
    int64_t size, capacity;
} recorded;

fe_recorder *recorded_begin(fe_world *world, uint32_t flags, int32_t keyframe_steps);
void recorded_read(recorded *r, fe_recorder *recorder); // what waits, behind what there is
void recorded_free(recorded *r);

typedef struct played {
    fe_result result; // of the last step: FE_END, when all went well
    int64_t steps;
    fe_player *player; // to be destroyed
} played;

// All of it, up to an error; fed `piece` bytes at a time, 0: at once
played recorded_play(const unsigned char *bytes, int64_t size, int32_t workers, int32_t simd, int64_t piece);
uint64_t recorded_hash(const fe_player *player); // of its world

#endif
