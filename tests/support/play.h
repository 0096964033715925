// play.h - scripts: whole runs of a world, told once, played under many conditions.
//
// A script builds a scene and says which calls come before each step. Every call that can fail goes through PLAY, so
// that a test can look at the world before and after it, make it fail, or change the thread's state around it. Two
// plays of one script make the same calls in the same order; numbers come from integers, and no rule of C leaves the
// order of two draws open.
#ifndef FE_TESTS_PLAY_H
#define FE_TESTS_PLAY_H
#include "core/bytes.h"
#include "feather.h"
#include "support/values.h"

#include <stdio.h>

enum { PLAY_MOST_ACTORS = 1024, PLAY_MOST_JOINTS = 1400, PLAY_CHECK_STEPS = 50 }; // from one golden hash to the next

typedef struct play play;
struct play {
    fe_world *world;
    fe_body actors[PLAY_MOST_ACTORS];  // 0: not there now
    fe_shape shapes[PLAY_MOST_ACTORS]; // the first shape of each
    int32_t actor_count;
    fe_joint joints[PLAY_MOST_JOINTS]; // in the order of creation
    int32_t joint_count;
    int32_t groups[16]; // first actors or joints, as the script needs them
    fe_asset assets[8]; // as the script needs them
    uint32_t seed;
    int32_t step;   // steps made
    float dt;       // s, of the steps
    fe__hash told;  // events, moved bodies and rays so far
    int32_t errors; // calls that failed and were not repeated

    // Around each call. `after` returns 1 to have it repeated; NULL: errors are printed and counted
    void (*before)(play *p);
    int32_t (*after)(play *p, fe_result result);
    void *user;
};

typedef struct script {
    const char *name;
    int32_t steps;
    void (*build)(play *p);
    void (*act)(play *p); // calls before step p->step + 1
} script;

extern const script script_crowd;     // 1000 contacts, every feature, bodies come and go (play_crowd.c)
extern const script script_mixed;     // 300 bodies fall and come to rest
extern const script script_terrain;   // heightfields (play_terrain.c)
extern const script script_fast;      // bodies that outrun their thickness (play_fast.c)
extern const script script_joints;    // joints of all types (play_joints.c)
extern const script script_spawn;     // bodies that queries place (play_spawn.c)
extern const script script_solids;    // hulls, cylinders and cones (play_solids.c)
extern const script script_meshes;    // meshes under bodies of every form (play_meshes.c)
extern const script script_cooked;    // assets that were saved and loaded (play_cooked.c)
extern const script script_scales;    // hulls and meshes under scales (play_scales.c)
extern const script script_turns;     // forms that move and turn, put where they stop (play_turns.c)
extern const script script_compounds; // compounds under compounds (play_compounds.c)
extern const script script_people;    // 300 ragdolls (play_jointed.c)
extern const script script_cloth;     // 10 000 balls in one island of joints (play_jointed.c)
extern const script script_brief;     // two dozen bodies, 200 steps, every kind of call

void play_begin(play *p, fe_world *world);               // an empty play; `world` has been made
void play_until(play *p, const script *s, int32_t step); // builds before the first step
uint64_t play_hash(const play *p);                       // of the world
uint64_t play_told(const play *p);
void play_print(FILE *out, const script *s, fe_world *world, int32_t steps); // a line for each check, as in golden.txt

void play_before(play *p);
int32_t play_after(play *p, fe_result result, const char *text);
#define PLAY(p, call)   \
    do {                \
        play_before(p); \
    } while (play_after((p), (call), #call))

// ---- what scripts are written with ---------------------------------------------------------------------------------
uint32_t play_draw(play *p); // the next of 2^24 numbers
float play_between(play *p, float low, float high);
float play_wave(int32_t column, int32_t row); // heights of a ground, of integers: no library decides its last bit

typedef struct part {
    fe_body_def body;
    fe_shape_def shape;
    fe_geometry geometry;
} part;

part part_sphere(float radius, double x, double y, double z);
part part_capsule(float half_height, float radius, double x, double y, double z);
part part_box(float half_x, float half_y, float half_z, double x, double y, double z);
part part_static_box(float half_x, float half_y, float half_z, double x, double y, double z);
part part_plane(float x, float y, float z);
// Part i of a rain on uneven ground: turned by chance, with resistance to rolling; some ask for all events, are
// triggers, or are thrown at `fall` m/s along y
void play_tumble(play *p, int32_t i, float fall, part *out_part);
void play_put(play *p, int32_t actor, const part *part); // makes the actor's body and first shape
int32_t play_add(play *p, const part *part);             // as a new actor
void play_remove(play *p, int32_t actor);                // no harm when it is not there

// 1: this build and this CPU have the set
static inline int32_t has_simd(int32_t simd)
{
    fe_world_def def;
    fe_world *world;
    fe_world_def_init(&def, sizeof def);
    def.simd = simd;
    return fe_world_create(&def, &world) == FE_OK && fe_world_destroy(world) == FE_OK;
}

#endif
