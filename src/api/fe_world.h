// fe_world.h - what snapshots share with the API of worlds.
#ifndef FE_API_FE_WORLD_H
#define FE_API_FE_WORLD_H
#include "api/check.h"

// A definition with everything it points to, checked
typedef struct fe__whole_def {
    fe_world_def def;
    fe_allocator allocator;
    fe_task_system tasks;
} fe__whole_def;
fe_result fe__read_world_def(const char *function, const fe_world_def *def, fe__whole_def *whole); // NULL: the defaults
fe_result fe__report_creation(const char *function, const fe_world_def *def, fe_result result);
fe_result fe__read_tasks(const char *function, const fe_task_system *tasks, fe_task_system *copy);
// The caller is inside it, as of fe__world_create
fe_result fe__create_world(const char *function, const fe_world_def *def, fe_world **out_world);
// A state that did not return (fe_snapshot.c)
fe_result fe__report_return(const char *function, fe_result result);
fe_result fe__check_tuning(const char *function, const fe_world_tuning *tuning);

#endif
