// closest.h - the point of the world nearest to a point.
#ifndef FE_QUERY_CLOSEST_H
#define FE_QUERY_CLOSEST_H
#include "query/scene.h"

// Of all shapes no farther than `most`; of equally near ones that of the body created first. 1: there is one.
int32_t fe__closest(const fe__scene *scene, fe_dvec3 point, double most, fe_closest *out_closest);
// On the shapes of a body's list from `first` to before `end` (-1: its end), however far.
int32_t fe__closest_on_shapes(const fe__scene *scene, fe_dvec3 point, int32_t first, int32_t end,
                              fe_closest *out_closest);

#endif
