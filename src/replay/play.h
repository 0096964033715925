// play.h - a player goes on, from call to call and from step to step.
#ifndef FE_REPLAY_PLAY_H
#define FE_REPLAY_PLAY_H
#include "replay/player.h"

// FE_OK, FE_END, FE_ERROR_DIVERGED (the first time), FE_ERROR_DATA, FE_ERROR_MEMORY, FE_ERROR_STATE; sentences are set
fe_result fe__player_step(const char *function, fe_player *player);
fe_result fe__player_seek(const char *function, fe_player *player, int64_t step);

#endif
