// form.h - the forms of shapes: what they weigh, where they end, how a ray meets them.
//
// A form lives in the frame of its shape. Everything below this layer knows forms and poses only; bodies and shapes are the world's. No
// other folder switches over the kinds of forms.
#ifndef FE_COLLISION_FORM_FORM_H
#define FE_COLLISION_FORM_FORM_H
#include "core/math.h"

// The kinds of forms, in the order of the kernels. A triangle is no public form: heightfields hand out theirs one by one.
typedef enum fe__form_type {
    FE__FORM_SPHERE,
    FE__FORM_CAPSULE,
    FE__FORM_BOX,
    FE__FORM_PLANE,
    FE__FORM_HEIGHTFIELD,
    FE__FORM_TRIANGLE,
    FE__FORM_TYPES
} fe__form_type;

// sphere: radius.  capsule: half_height along y, radius.  box: half.  plane: the half space normal . p <= distance, normal of length 1.
// Unused fields are 0, so that each of these is a core (point, segment, box) swelled by its radius. triangle: vertices, turning left around
// the side that counts.  heightfield: its record's index, its bounds (heightfield.h).
typedef struct fe__form {
    int32_t type; // fe__form_type
    float radius;
    union {
        struct {
            float half_height;
            float distance;
            fe_vec3 half;
            fe_vec3 normal;
        };
        fe_vec3 vertex[3];
        struct {
            int32_t field; // its asset in the store
            fe_vec3 low, high;
        };
    };
} fe__form;

// A pose in the world: double position, unit rotation.
typedef struct fe__pose {
    fe_dvec3 position;
    fe_quat rotation;
} fe__pose;

// pose of `local` (position, rotation in the body's frame) on a body at `body`
static inline fe__pose fe__compose(const fe__pose *body, fe_vec3 position, fe_quat rotation)
{
    return (fe__pose){fe__dadd(body->position, fe__drotate(body->rotation, fe__widen(position))),
                      fe__normalized(fe__product(body->rotation, rotation))};
}

// Mass properties for a density: mass, kg; centre of mass and principal moments about it, in the form's frame (every form's principal axes
// are its own axes). What is static only has none.
typedef struct fe__mass {
    float mass;
    fe_vec3 inertia;
} fe__mass;
fe__mass fe__form_mass(const fe__form *form, float density);

// Bounds of a form at a pose, in the world, as tight as the form allows. A plane's are infinite on all sides but the one its normal faces,
// if that is an axis; callers treat planes apart.
typedef struct fe__bounds {
    fe_dvec3 low, high;
} fe__bounds;
fe__bounds fe__form_bounds(const fe__form *form, const fe__pose *pose);

// Does the box reach into the half space of a plane?
int32_t fe__plane_meets_box(const fe__form *plane, const fe__pose *pose, const fe__bounds *box);

// largest distance from `centre` (form's frame) to a point of the form; 0 for what is static only
float fe__form_reach(const fe__form *form, fe_vec3 centre);
// smallest half width of the form: what a fast body may not outrun; FLT_MAX for planes and heightfields
float fe__form_thickness(const fe__form *form);

// A ray against a form, exact, in double, in the form's frame: origin + t * translation, 0 <= t <= limit. Starting in the form is a hit at
// t = 0 with the normal against the direction (for a zero translation: the shortest way out) and the depth below the surface. A triangle is
// hit from its side only and has no inside; a heightfield's ray is in heightfield.h.
typedef struct fe__ray_hit {
    double t;
    fe_dvec3 normal; // unit, form's frame
    double depth;    // > 0 when inside, else 0
    int32_t inside;
    int32_t triangle; // of a heightfield, else -1
} fe__ray_hit;
int32_t fe__form_ray_at(const fe__form *form, const fe_dvec3 *origin, const fe_dvec3 *translation, double limit,
                        fe__ray_hit *hit); // 1: hit
static inline int32_t fe__form_ray(const fe__form *form, fe_dvec3 origin, fe_dvec3 translation, double limit, fe__ray_hit *hit)
{
    return fe__form_ray_at(form, &origin, &translation, limit, hit);
}

#endif
