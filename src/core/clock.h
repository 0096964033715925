// clock.h - the time that profiles are measured in and spinning threads look at. No result depends on it.
#ifndef FE_CORE_CLOCK_H
#define FE_CORE_CLOCK_H
#include "core/contraction.h"

double fe__clock(void); // s, monotonic

#endif
