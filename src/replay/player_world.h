// player_world.h - the world of a player, and the assets in it.
#ifndef FE_REPLAY_PLAYER_WORLD_H
#define FE_REPLAY_PLAYER_WORLD_H
#include "replay/player.h"

// The world becomes what the keyframe says; made, where there is none
fe_result fe__player_restore(const char *function, fe_player *player, const fe__fed_chunk *keyframe);
// The content of a recorded handle is this from here on
fe_result fe__player_name(const char *function, fe_player *player, fe_asset recorded, const uint64_t *key);
void fe__player_close_world(fe_player *player);
fe_asset fe__player_asset(const fe_player *player, fe_asset recorded); // the own one, 0: none
// What the recorded filter answered
int32_t fe__player_answer(void *user, const fe_filter_pair *pair);

#endif
