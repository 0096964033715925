// print_golden.c - prints what golden.txt holds, as this machine computes it, of all scripts but the two big ones;
// without cmocka, for machines that are only emulated (tests/determinism/aarch64). Worlds of a batch that go on from
// there must be what the single world becomes.
//
//   feather-golden [simd] [steps] [script]...    fe_simd, 0: the widest; of each script, at most; those named only
#include "support/play.h"

#include <stdlib.h>
#include <string.h>

static int is_asked(const script *s, int count, char **arguments)
{
    for (int i = 3; i < count; ++i)
        if (strcmp(arguments[i], s->name) == 0) return 1;
    return count <= 3;
}

enum { BATCH_WORLDS = 2, BATCH_STEPS = 5 };

// The world as it is now, and two in a batch, step on: the same hash?
static int goes_on_in_a_batch(const char *name, fe_world *world, int32_t simd)
{
    fe_batch_def def;
    fe_batch *batch = NULL;
    uint32_t alone[2], words[2 * BATCH_WORLDS];
    fe_batch_def_init(&def, sizeof def);
    def.world_count = BATCH_WORLDS, def.simd = simd;
    int done = fe_batch_create(world, &def, &batch) == FE_OK &&
               fe_batch_step(batch, 1.0f / 60.0f, BATCH_STEPS, NULL, NULL) == 0 && fe_batch_hash(batch, words) == FE_OK;
    for (int32_t i = 0; done && i < BATCH_STEPS; ++i) done = fe_world_step(world, 1.0f / 60.0f) == FE_OK;
    done = done && fe_world_hash(world, alone) == FE_OK;
    for (int32_t i = 0; done && i < BATCH_WORLDS; ++i) done = memcmp(words + 2 * i, alone, sizeof alone) == 0;
    if (!done) fprintf(stderr, "%s: a batch goes another way. %s\n", name, fe_last_error());
    if (batch) fe_batch_destroy(batch);
    return done;
}

int main(int count, char **arguments)
{
    const script *const scripts[] = {&script_crowd,  &script_mixed,  &script_terrain, &script_fast,
                                     &script_joints, &script_spawn,  &script_solids,  &script_meshes,
                                     &script_cooked, &script_scales, &script_turns,   &script_compounds};
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    int32_t steps = count > 2 ? atoi(arguments[2]) : INT32_MAX;
    def.simd = count > 1 ? atoi(arguments[1]) : FE_SIMD_AUTO;
    for (size_t i = 0; i < sizeof scripts / sizeof *scripts; ++i) {
        fe_world *world;
        if (!is_asked(scripts[i], count, arguments)) continue;
        if (fe_world_create(&def, &world) != FE_OK) {
            fprintf(stderr, "%s\n", fe_last_error());
            return 1;
        }
        play_print(stdout, scripts[i], world, steps);
        if (!goes_on_in_a_batch(scripts[i]->name, world, def.simd)) return 1;
        fe_world_destroy(world);
    }
    return 0;
}
