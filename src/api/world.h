// world.h - what snapshots share with the API of worlds.
#ifndef FE_API_WORLD_H
#define FE_API_WORLD_H
#include "api/check.h"

fe_result fe__create_world(const char *function, const fe_world_def *def, fe_world **out_world);
fe_result fe__check_tuning(const char *function, const fe_world_tuning *tuning);

#endif
