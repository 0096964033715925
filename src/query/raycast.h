// raycast.h - the first shape on a segment.
//
// Called by the API's query functions with checked arguments, on any number of threads at once: it reads the world and writes its answer,
// nothing else. Layers: it stands on the world's records and trees, beside the step.
#ifndef FE_QUERY_RAYCAST_H
#define FE_QUERY_RAYCAST_H
#include "world/world.h"

// 1 and the hit, or 0. The filter is whole: mask, flags, excluded.
int32_t fe__raycast(const fe_world *world, const fe_dvec3 *origin, const fe_dvec3 *translation, const fe_query_filter *filter,
                    fe_hit *out_hit);

#endif
