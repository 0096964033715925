// fuzz_state.c - snapshots, broken and summed anew, as a libFuzzer target: make fuzz. What is refused changes nothing;
// what is accepted is a world that lives: it steps, it is read, saved, and destroyed body by body.
//
// The first byte chooses a snapshot, and whether it is restored in place or loaded anew. The others change it: place (3
// bytes), value (1).
#include "state/snapshot_bytes.h"
#include "support/play.h"

#include <stdio.h>

int LLVMFuzzerTestOneInput(const uint8_t *input, size_t size);

typedef struct seed {
    const script *script;
    int32_t steps;
} seed;
static const seed seeds[] = {{&script_brief, 40},  {&script_brief, 150}, {&script_joints, 60}, {&script_terrain, 40},
                             {&script_scales, 40}, {&script_solids, 40}, {&script_meshes, 40}};
enum { SEEDS = sizeof seeds / sizeof *seeds, NUMBER = 7 };
static bytes saved[SEEDS]; // with what their assets hold

static void must(int32_t holds, const char *what)
{
    if (holds) return;
    fprintf(stderr, "%s: %s\n", what, fe_last_error());
    abort();
}

static fe_world *new_world(void)
{
    fe_world_def def;
    fe_world *world;
    fe_world_def_init(&def, sizeof def);
    def.number = NUMBER;
    must(fe_world_create(&def, &world) == FE_OK, "a world");
    return world;
}

static bytes save_whole(const fe_world *world)
{
    bytes b = save_with_assets(world);
    must(b.data != NULL, "a snapshot");
    return b;
}

static void save_seeds(void)
{
    static play p;
    for (int32_t i = 0; i < SEEDS; ++i) {
        fe_world *world = new_world();
        play_begin(&p, world);
        play_until(&p, seeds[i].script, seeds[i].steps);
        saved[i] = save_whole(world);
        fe_world_destroy(world);
    }
}

static void live(fe_world *world)
{
    enum { STEPS = 4, MOST = 64 };
    fe_body bodies[MOST];
    uint32_t words[2];
    for (int32_t i = 0; i < STEPS; ++i)
        must(fe_world_step(world, i == 2 ? 0.0f : 1.0f / 60.0f) == FE_OK && fe_world_hash(world, words) == FE_OK,
             "a step");
    int64_t size = fe_world_save(world, NULL, NULL, 0);
    unsigned char *again = malloc((size_t)(size > 0 ? size : 1));
    must(size > 0 && fe_world_save(world, NULL, again, size) == size, "saved again");
    // what was put near the end of space may be out of it by now
    fe_result checked = fe_snapshot_check(again, size, NULL);
    must(checked == FE_OK || checked == FE_ERROR_DATA, "what was saved is checked");
    free(again);
    for (int32_t count = 1; count > 0;) {
        count = fe_world_get_bodies(world, bodies, MOST);
        for (int32_t i = 0; i < (count < MOST ? count : MOST); ++i)
            if (fe_body_is_valid(world, bodies[i])) must(fe_body_destroy(world, bodies[i]) == FE_OK, "a body goes");
    }
    must(fe_world_step(world, 1.0f / 60.0f) == FE_OK, "the last step");
}

static int32_t is_refused(fe_result result)
{
    return result == FE_ERROR_DATA || result == FE_ERROR_VERSION || result == FE_ERROR_STATE;
}

static void load_anew(bytes given)
{
    fe_world *world = NULL;
    fe_result result = fe_world_load(NULL, NULL, given.data, given.size, &world);
    must(result >= FE_OK || is_refused(result), "neither loaded nor refused");
    if (result < FE_OK) return;
    live(world);
    must(fe_world_destroy(world) == FE_OK, "a loaded world goes");
}

static void restore_in_place(bytes given, bytes whole)
{
    fe_world *world = NULL;
    must(fe_world_load(NULL, NULL, whole.data, whole.size, &world) >= FE_OK, "the seed");
    bytes before = save_whole(world);
    fe_result result = fe_world_restore(world, NULL, given.data, given.size);
    must(result >= FE_OK || is_refused(result), "neither restored nor refused");
    if (result < FE_OK) {
        bytes after = save_whole(world);
        must(after.size == before.size && !memcmp(after.data, before.data, (size_t)after.size), "a refusal changed it");
        free(after.data);
    } else {
        live(world);
    }
    free(before.data);
    must(fe_world_destroy(world) == FE_OK, "a restored world goes");
}

int LLVMFuzzerTestOneInput(const uint8_t *input, size_t size)
{
    if (!saved[0].data) save_seeds();
    if (size == 0) return 0;
    const bytes whole = saved[input[0] / 2 % SEEDS], given = {malloc((size_t)whole.size), whole.size};
    memcpy(given.data, whole.data, (size_t)whole.size);
    for (const uint8_t *edit = input + 1; edit + 4 <= input + size; edit += 4)
        given.data[(edit[0] | edit[1] << 8 | (int64_t)edit[2] << 16) % given.size] = edit[3];
    mend(given);
    if (input[0] % 2)
        load_anew(given);
    else
        restore_in_place(given, whole);
    free(given.data);
    return 0;
}
