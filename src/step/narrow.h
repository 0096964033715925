// narrow.h - what the narrow phases of plain pairs (narrow.c) and of pairs with a heightfield (narrow_field.c) share.
#ifndef FE_WORLD_NARROW_H
#define FE_WORLD_NARROW_H
#include "collision/manifold/collide.h"
#include "world/world.h"

// A gap on whose way the features of two shapes change little, m
#define FE__TURNS_LITTLE 0.005f

typedef struct fe__view {
    const fe__shape *a, *b; // fe__collide's
    fe__form form_a;        // a plane's is moved next to B
    fe__relative relative;
    fe_dvec3 origin; // of the frame of A, world
    fe__mat3 rotation;
} fe__view;

// where the two bodies are when the manifold is looked for: the solver's A and B
typedef struct fe__places {
    fe_dvec3 centre_a, centre_b;
    fe_quat rotation_a, rotation_b;
} fe__places;

static inline fe_quat fe__rotation_of(const fe__body *b)
{
    return (fe_quat){b->rotation[0], b->rotation[1], b->rotation[2], b->rotation[3]};
}
static inline fe_dvec3 fe__centre_of(const fe__body *b) { return (fe_dvec3){b->centre[0], b->centre[1], b->centre[2]}; }
static inline void fe__copy3(float *out, fe_vec3 a) { out[0] = a.x, out[1] = a.y, out[2] = a.z; }

// how far the pair can close in the step, m
float fe__reach_in_step(const fe_world *world, const fe__body *a, const fe__body *b, float dt);
// where a body would be at the end of a step without contacts, and a shape of it then
void fe__advance(const fe_world *world, const fe__body *body, float dt, fe_dvec3 *centre, fe_quat *rotation);
fe__pose fe__shape_pose_at(const fe__body *body, const fe__shape *shape, fe_dvec3 centre, fe_quat rotation);
// how far a manifold with points may slide or turn before it is looked for anew, m
float fe__recycle_tolerance(const fe__view *v);
// Where static boxes lie flush, an inner edge or face gives way to the face that is open (narrow_seam.c).
void fe__mend_seam(const fe_world *world, const fe__view *v, float margin, fe__manifold *found);
// Everything of a contact but its tolerance and impulses. `ahead`: `at` is not where the bodies are now.
void fe__write_manifold(const fe_world *world, fe__contact *m, const fe__view *v, const fe__places *at, const fe__manifold *found,
                        int32_t ahead);

#endif
