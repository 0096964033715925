// play.c - plays a recording to its end and prints how many steps there were, and the hash of the world. So it is seen
// that what a language wrote is a recording.
//   feather-play run.feather
#include "feather.h"

#include <inttypes.h>
#include <stdio.h>

static int fail(void)
{
    printf("%s\n", fe_last_error());
    return 1;
}

int main(int count, char **arguments)
{
    static unsigned char piece[65536];
    const fe_world *world;
    fe_player *player;
    fe_result result;
    uint32_t hash[2];
    int64_t steps = 0;
    FILE *file = count == 2 ? fopen(arguments[1], "rb") : NULL;
    if (!file || fe_player_create(NULL, &player) != FE_OK) return 1;
    for (size_t size; (size = fread(piece, 1, sizeof piece, file)) > 0;)
        if (fe_player_feed(player, piece, (int64_t)size) != FE_OK) return fail();
    fclose(file);
    while ((result = fe_player_step(player)) == FE_OK) ++steps;
    if (result != FE_END) return fail();
    if (fe_player_get_world(player, &world) != FE_OK || fe_world_hash(world, hash) != FE_OK) return fail();
    printf("%" PRId64 " %08" PRIx32 "%08" PRIx32 "\n", steps, hash[1], hash[0]);
    return fe_player_destroy(player) == FE_OK ? 0 : fail();
}
