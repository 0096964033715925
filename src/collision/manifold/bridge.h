// bridge.h - a narrow gap between two level surfaces: what one of them carries passes over to the other, and does not
// feel its rim.
//
// Of a body that lies on a surface, nothing can be touched at the rim of another that is level with it, but along the
// normal of both: whoever holds the body up keeps it as high as the other's face. What is round is held up as long as
// its lowest point is over the first surface or nearer to it; then it dips into the gap, and the two rims have it.
#ifndef FE_COLLISION_MANIFOLD_BRIDGE_H
#define FE_COLLISION_MANIFOLD_BRIDGE_H
#include "collision/manifold/patch.h"

// Is the direction m that of the face with the normal f? To a thousandth of a radian, which roundings reach
static inline int32_t fe__is_along_face(fe_vec3 m, fe_vec3 f)
{
    const float flat = 1e-3f;
    fe_vec3 lean = fe__sub(m, f);
    return fe__dot(lean, lean) <= flat * flat;
}

typedef struct fe__crossing {
    fe__solid body; // of any form
    const fe__surroundings *around;
    const fe__neighbour *own; // the touched surface, when it may go on elsewhere; or NULL
    float fall;               // m, as in fe__terrain
    fe_vec3 edge, out;        // `own` counts farther along `out` than `edge` alone; (0, 0, 0): all of it
} fe__crossing;

// How far below a face the lowest point of a body may lie that is carried over to it, m. What lies deeper met a step
float fe__most_below(const fe__crossing *crossing);
// Of the face through q with the unit normal f, the body touches the rim, `separation` apart along another direction:
// is it carried over to the face by something level with it? `rim`: where it touches, or NULL: not known. All in the
// common frame
int32_t fe__is_carried_over(const fe__crossing *c, fe_vec3 q, fe_vec3 f, const fe_vec3 *rim, float separation);

#endif
