// print_golden.c - prints what golden.txt holds, as this machine computes it, of all scripts but the two big ones;
// without cmocka, for machines that are only emulated (tests/determinism/aarch64).
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
        fe_world_destroy(world);
    }
    return 0;
}
