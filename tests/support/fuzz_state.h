// fuzz_state.h - what the harness and the calls share: the stream, the handles that were ever given, room for arrays.
#ifndef FE_TESTS_FUZZ_STATE_H
#define FE_TESTS_FUZZ_STATE_H
#include "core/bytes.h"
#include "feather.h"
#include "support/fuzz.h"
#include "support/values.h"

enum { FUZZ_HANDLES = 48, FUZZ_MOST_STEPS = 300, FUZZ_TAIL = 64, FUZZ_ROOM = 1 << 14 };

typedef struct fuzz_snapshot {
    unsigned char *bytes;
    int64_t size, capacity;
} fuzz_snapshot;

typedef struct fuzz {
    const uint8_t *bytes;
    size_t size, at;
    fe_world *world;
    fe_body bodies[FUZZ_HANDLES]; // last given ones, in a ring: dead ones stay until they are overwritten
    fe_shape shapes[FUZZ_HANDLES];
    fe_joint joints[FUZZ_HANDLES];
    fe_asset assets[8];
    int32_t asset_count;
    int32_t body_count, shape_count, joint_count; // given
    int32_t steps;
    int32_t call_count;
    const char *call_name;
    fe__hash told;
    int32_t fail_after; // allocations: the one that brings it to 0 fails
    uint32_t failures;  // see fuzz_setting
    uint64_t chance;    // state of its draws
    int32_t is_stepping;
    int64_t blocks;
    fuzz_snapshot before, after; // of the world, around the call at hand
    int64_t *refused;            // or NULL
    int32_t is_wild;
    int32_t tells;                                          // the environment has FE_FUZZ_TELL: prints each call
    _Alignas(64) unsigned char room[FUZZ_ROOM + FUZZ_TAIL]; // for arrays in and out
} fuzz;

typedef enum fuzz_effect {
    FUZZ_WRITES,
    FUZZ_MOVES,  // likewise, and all numbers are checked afterwards
    FUZZ_READS,  // changes nothing, whatever it returns
    FUZZ_SEVERAL // several calls and all numbers: of one that is refused, those before it may show in a snapshot
} fuzz_effect;
typedef struct fuzz_call {
    const char *name;
    int32_t (*run)(fuzz *f); // fe_result or a count
    fuzz_effect effect;
} fuzz_call;
extern const fuzz_call fuzz_calls[];
extern const int32_t fuzz_call_count;

typedef struct fuzz_span {
    void *data;
    uint32_t stride;
    int32_t count;
} fuzz_span;

_Noreturn void fuzz_fail(const fuzz *f, const char *what);
void fuzz_check(fuzz *f);               // all that can be read is a number
fe_result fuzz_step(fuzz *f, float dt); // fe_world_step, until memory lasts
uint8_t fuzz_byte(fuzz *f);
uint32_t fuzz_word(fuzz *f);
float fuzz_float(fuzz *f);
float fuzz_size(fuzz *f);
fe_vec3 fuzz_vec3(fuzz *f);
fe_dvec3 fuzz_dvec3(fuzz *f);
fe_quat fuzz_quat(fuzz *f);
fe_transform fuzz_transform(fuzz *f);
fe_handle fuzz_handle(fuzz *f, const fe_handle *known, const fe_handle *other);
fe_body fuzz_body(fuzz *f);
fe_shape fuzz_shape(fuzz *f);
uint32_t fuzz_struct_size(fuzz *f, uint32_t right);
void fuzz_array(fuzz *f, uint32_t packed, fuzz_span *out); // in f->room, stride and count as a client might give them

// NULL now and then, where a pointer is asked
static inline const void *or_null(fuzz *f, const void *pointer) { return fuzz_byte(f) == 1 ? NULL : pointer; }

// fuzz_calls.c
fe_geometry fuzz_geometry(fuzz *f);
void fuzz_fill_room(fuzz *f); // with floats most of which any call takes
// fuzz_pairs.c
int32_t fuzz_set_filter(fuzz *f);
int32_t fuzz_judge_shape(fuzz *f);
int32_t fuzz_set_one_way(fuzz *f);
int32_t fuzz_read_bounds(fuzz *f);
int32_t fuzz_overlap_shapes(fuzz *f);
int32_t fuzz_overlap_bounds(fuzz *f);
int32_t fuzz_read_overlaps(fuzz *f);
// fuzz_terrain.c
fe_asset fuzz_asset(fuzz *f); // some asset, or what is none
void fuzz_scale(fuzz *f, fe_geometry *geometry);
int32_t fuzz_create_field(fuzz *f); // or a hull
int32_t fuzz_place_field(fuzz *f);
int32_t fuzz_edit_field(fuzz *f);
int32_t fuzz_destroy_asset(fuzz *f);
// fuzz_reads.c
int32_t fuzz_draw(fuzz *f);
int32_t fuzz_clone(fuzz *f);
int32_t fuzz_load(fuzz *f);
int32_t fuzz_hold(fuzz *f);
int32_t fuzz_keep(fuzz *f);
// fuzz_joints.c
int32_t fuzz_create_joint(fuzz *f);
int32_t fuzz_join(fuzz *f);
int32_t fuzz_set_joint(fuzz *f);
int32_t fuzz_set_joint_front(fuzz *f);
int32_t fuzz_make_joint(fuzz *f);
int32_t fuzz_name_joint(fuzz *f);
int32_t fuzz_destroy_joint(fuzz *f);
int32_t fuzz_read_joint(fuzz *f);
int32_t fuzz_list_joints(fuzz *f);
int32_t fuzz_read_joints(fuzz *f);
int32_t fuzz_write_joints(fuzz *f);

#endif
