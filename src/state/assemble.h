// assemble.h - a whole world out of a snapshot.
#ifndef FE_STATE_ASSEMBLE_H
#define FE_STATE_ASSEMBLE_H
#include "state/build.h"

// 0: refused, see snapshot->result; the caller frees what is there
int32_t fe__build_world(fe__build *build);

#endif
