// pose.h - where bodies and their shapes are, and would be.
#ifndef FE_WORLD_POSE_H
#define FE_WORLD_POSE_H
#include "world/world.h"

static inline fe_quat fe__rotation_of(const fe__body *b) { return fe__quat_of(b->rotation); }
static inline fe_dvec3 fe__centre_of(const fe__body *b)
{
    return (fe_dvec3){b->centre[0], b->centre[1], b->centre[2]};
} // of mass
static inline fe_dvec3 fe__origin_of(const fe__body *b) { return (fe_dvec3){b->origin[0], b->origin[1], b->origin[2]}; }

fe_quat fe__unit_rotation(fe_quat q);               // unchanged when its length is 1 already, q/|q| else
void fe__body_place_centre(fe__body *body);         // centre from origin, rotation and local centre
void fe__body_place(fe_world *world, int32_t body); // shapes' poses from the body's
void fe__shape_place(fe_world *world, int32_t shape);
// where a body would be at the end of a step of dt seconds without contacts, and a shape of it then
void fe__advance(const fe_world *world, const fe__body *body, float dt, fe_dvec3 *centre, fe_quat *rotation);
fe__pose fe__shape_pose_at(const fe__body *body, const fe__shape *shape, fe_dvec3 centre, fe_quat rotation);

#endif
