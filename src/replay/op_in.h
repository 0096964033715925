// op_in.h - calls out of a recording: arguments are taken one after another, from bytes that may be anybody's.
//
// What is taken beyond the end is 0, and `result` says so: a call is made only when all of its arguments were there.
// Values are not judged here. The API that is called judges them, as it does for any caller.
#ifndef FE_REPLAY_OP_IN_H
#define FE_REPLAY_OP_IN_H
#include "core/memory.h"
#include "recording/recorder.h"
#include "recording/op_write.h"

// Arrays of a call, by place; then the handles that it returned when it was recorded, and those that it returns now
enum { FE__IN_THEN = 2, FE__IN_NOW = 3, FE__IN_ROOMS = 4 };

typedef struct fe__room {
    unsigned char *bytes;
    int32_t capacity;
} fe__room;

typedef struct fe__replay_asset {
    fe_asset recorded, own;
} fe__replay_asset;

typedef struct fe__op_in {
    const unsigned char *at, *end;
    fe_world *world;
    fe_result result; // FE_OK; FE_ERROR_DATA: cut; FE_ERROR_MEMORY
    fe_result failed; // with FE_ERROR_DIVERGED: what the call returned; FE_OK: other handles
    fe_handle handle; // and the first of these
    fe__memory *memory;
    fe__room rooms[FE__IN_ROOMS];
    const fe__replay_asset *assets; // own handles of recorded ones
    int32_t asset_count;
} fe__op_in;

typedef struct fe__op_call {
    const char *name;
    fe_result (*play)(fe__op_in *in); // FE_OK, FE_ERROR_DATA, FE_ERROR_MEMORY, FE_ERROR_DIVERGED
} fe__op_call;

// NULL: no call has that number
const fe__op_call *fe__op_call_of(int32_t number);

uint8_t fe__in_u8(fe__op_in *in);
uint32_t fe__in_u32(fe__op_in *in);
uint64_t fe__in_u64(fe__op_in *in);
static inline int32_t fe__in_i32(fe__op_in *in) { return (int32_t)fe__in_u32(in); }
static inline float fe__in_float(fe__op_in *in) { return (fe__float_word){.bits = fe__in_u32(in)}.value; }
uint64_t fe__in_varint(fe__op_in *in);
int64_t fe__in_signed(fe__op_in *in);
int32_t fe__in_count(fe__op_in *in); // at least 0
// So many bytes as they are; NULL: there are not as many
const unsigned char *fe__in_bytes(fe__op_in *in, int64_t size);
// Structs: 1: there is one. What an older one lacks is 0
int32_t fe__in_plain(fe__op_in *in, void *out, size_t size, const fe__words *words);
int32_t fe__in_sized(fe__op_in *in, void *out, size_t size, const fe__words *words);
// Arrays, in room `place`
void *fe__in_array(fe__op_in *in, int32_t place, int32_t count, size_t size, const fe__words *words);
void *fe__in_sized_array(fe__op_in *in, int32_t place, int32_t count, size_t size, const fe__words *words);
void *fe__in_room(fe__op_in *in, int32_t place, int32_t count); // for handles, zeros
void fe__in_asset(fe__op_in *in, fe_asset *asset);              // the recorded handle becomes the player's own
// What the call came to, beside what was recorded
fe_result fe__in_compare(fe__op_in *in, fe_result result, const fe_handle *now, const fe_handle *then, int32_t count);
void fe__in_free(fe__op_in *in);

#endif
