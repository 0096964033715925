// compare.h - a replay beside its recording.
#ifndef FE_REPLAY_COMPARE_H
#define FE_REPLAY_COMPARE_H
#include "replay/player.h"

// FE_OK, or FE_ERROR_DIVERGED for the first time that something is told
fe_result fe__player_differs(const char *function, fe_player *player, const fe_divergence *what, const char *format,
                             ...) FE_PRINTF_LIKE(4, 5);
// The step that was just made, beside what is told of it: the rest of the call
fe_result fe__player_compare_step(const char *function, fe_player *player, int32_t flags);
fe_result fe__player_compare_keyframe(const char *function, fe_player *player, const fe__fed_chunk *keyframe);

#endif
