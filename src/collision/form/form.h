// form.h - the forms of shapes: what they weigh, where they end, how they look from a direction.
//
// A form lives in the frame of its shape. Everything below the world knows forms and poses only; bodies and shapes are
// the world's. Only collision/ asks for the kind of a form; all others ask for its traits.
//
// A new form takes
//   - its kind below (before the triangle; of two forms the later one is A in fe__collide), and its fields in fe__form,
//   - a file here with what fe__form_traits lists, and its line in form_table.c,
//   - in manifold/ a kernel for each partner that deserves one, in the table of collide.c; the general convex path
//   serves all others,
//   - in cast/ its ray and its nearest point, and its line in cast/cast_table.c,
//   - its public number and fields in feather.h, which the API reads in one place.
#ifndef FE_COLLISION_FORM_FORM_H
#define FE_COLLISION_FORM_FORM_H
#include "collision/form/clip.h"
#include "core/math.h"

#include <stddef.h>

// ---- form -----------------------------------------------------------------------------------------------------------

// The kinds of forms, in the order of the kernels. A triangle is no public form: heightfields and meshes hand
// out theirs one by one. A compound is no form to touch: its parts are (compound.h).
typedef enum fe__form_type {
    FE__FORM_SPHERE,
    FE__FORM_CAPSULE,
    FE__FORM_BOX,
    FE__FORM_CYLINDER,
    FE__FORM_CONE,
    FE__FORM_HULL,
    FE__FORM_PLANE,
    FE__FORM_HEIGHTFIELD,
    FE__FORM_MESH,
    FE__FORM_TRIANGLE,
    FE__FORM_COMPOUND,
    FE__FORM_TYPES
} fe__form_type;

// sphere: radius.  capsule: half_height along y, radius.  box: half.  plane: the half space normal . p <= distance,
// normal of length 1. Unused fields are 0, so that each of these is a core (point, segment, box) swelled by its radius.
// cylinder, cone: half, the half widths of the box around it: x and z are the radius of the rim, y half the height
// along y. A cone's tip is at +half.y, its base at -half.y. They are cores of their own; their radius is 0. triangle:
// vertices, turning left around the side that counts. heightfield, mesh: its record's index, its bounds (heightfield.h,
// mesh.h). compound: its record's index. hull: its record's index, where that is, and offset + scale x is the form's
// point for the hull's point x (hull.h).
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
        struct {
            int32_t hull_field; // field
            float scale;        // > 0
            fe_vec3 offset;     // of the hull's frame in the form's, m
            const struct fe__hull *hull;
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

// mass, kg, principal moments about the centre of mass, kg m2, and that centre in the form's frame, m. `axes` turns the
// principal axes into the form's where `is_turned`; else they are the same. A static form has none
typedef struct fe__mass {
    float mass;
    fe_vec3 inertia;
    fe_vec3 centre;
    int32_t is_turned;
    fe_quat axes;
} fe__mass;

typedef struct fe__bounds {
    fe_dvec3 low, high;
} fe__bounds;

static inline void fe__bounds_add(fe__bounds *all, const fe__bounds *b)
{
    all->low =
        (fe_dvec3){fe__mind(all->low.x, b->low.x), fe__mind(all->low.y, b->low.y), fe__mind(all->low.z, b->low.z)};
    all->high = (fe_dvec3){fe__maxd(all->high.x, b->high.x), fe__maxd(all->high.y, b->high.y),
                           fe__maxd(all->high.z, b->high.z)};
}

struct fe__face; // form.h

// ---- traits --------------------------------------------------------------------------------------------------------
typedef struct fe__form_traits {
    const char *name;    // in the sentences of errors
    int32_t geometry;    // fe_geometry_type, -1: not public
    uint8_t static_only; // without mass: on static bodies alone,
    uint8_t is_carried;  // or on kinematic ones too
    uint8_t is_ball;     // no rotation changes it, and it touches at one point
    uint8_t flat_faces;  // a polyhedron of its half widths, or a triangle
    uint8_t curved;      // a core with a rim: cylinder, cone
    uint8_t is_hull;     // known by an asset's hull (hull.h)
    uint8_t unbounded;   // no box holds it, so that it is in no tree
    uint8_t is_field;    // a surface of triangles (ground.h), touched in patches
    uint8_t has_asset;   // shares what it is made of: fe__form.field,
    uint8_t has_scale;   // of which there are records for each scale
    uint8_t of_parts;    // stands for its parts, and is in no tree
    fe__mass (*mass)(const fe__form *form, double density);
    fe__bounds (*bounds)(const fe__form *form, const fe__pose *pose);
    float (*reach)(const fe__form *form, fe_vec3 centre);
    float (*thickness)(const fe__form *form);
    fe__form (*shrunk)(const fe__form *form, float by);
    fe_dvec3 (*support)(const fe__form *form, fe_dvec3 direction);
    void (*face)(const fe__form *form, fe_vec3 direction, struct fe__face *face);
} fe__form_traits;
extern const fe__form_traits fe__forms[FE__FORM_TYPES]; // form_table.c

static inline const fe__form_traits *fe__traits_of(const fe__form *form) { return fe__forms + form->type; }
static inline int32_t fe__form_is_static_only(const fe__form *form) { return fe__traits_of(form)->static_only; }
static inline int32_t fe__form_is_carried(const fe__form *form) { return fe__traits_of(form)->is_carried; }
static inline int32_t fe__form_is_ball(const fe__form *form) { return fe__traits_of(form)->is_ball; }
static inline int32_t fe__form_has_flat_faces(const fe__form *form) { return fe__traits_of(form)->flat_faces; }
static inline int32_t fe__form_is_curved(const fe__form *form) { return fe__traits_of(form)->curved; }
static inline int32_t fe__form_is_unbounded(const fe__form *form) { return fe__traits_of(form)->unbounded; }
static inline int32_t fe__form_is_hull(const fe__form *form) { return fe__traits_of(form)->is_hull; }
static inline int32_t fe__form_is_field(const fe__form *form) { return fe__traits_of(form)->is_field; }
static inline int32_t fe__form_has_asset(const fe__form *form) { return fe__traits_of(form)->has_asset; }
static inline int32_t fe__form_is_of_parts(const fe__form *form) { return fe__traits_of(form)->of_parts; }

int32_t fe__form_of_geometry(int32_t geometry); // the kind with that public number, -1: none

// ---- what each form tells of itself --------------------------------------------------------------------------------
static inline fe__mass fe__form_mass(const fe__form *form, float density)
{
    return fe__traits_of(form)->mass(form, (double)density);
}
// Bounds at a pose, in the world, as tight as the form allows. A plane's are infinite on all sides but the one its
// normal faces, if that is an axis; callers treat what is unbounded apart.
static inline fe__bounds fe__form_bounds(const fe__form *form, const fe__pose *pose)
{
    return fe__traits_of(form)->bounds(form, pose);
}
// largest distance from `centre` (form's frame) to a point of the form, m; 0 for what is static only
static inline float fe__form_reach(const fe__form *form, fe_vec3 centre)
{
    return fe__traits_of(form)->reach(form, centre);
}
// smallest half width of the form, m: what a fast body may not outrun; FLT_MAX for planes and what is of triangles
static inline float fe__form_thickness(const fe__form *form) { return fe__traits_of(form)->thickness(form); }
// the form without its outermost layer, `by` (m, less than its thickness) thick
static inline fe__form fe__form_shrunk(const fe__form *form, float by) { return fe__traits_of(form)->shrunk(form, by); }

// radius with which the form rolls, m: 0 for a box
static inline float fe__form_roundness(const fe__form *form)
{
    return fe__form_is_curved(form) ? form->half.x : form->radius;
}
// How far below the surface, along the unit normal n (form's frame) on which it is touched, lies what keeps its place
// when the form rolls, m: of a round one its radius. A rim's circle turns about the y axis: what it touches at stays as
// deep. To second order in the turn, r s = pivot s^2 with s = |n across the axis|. Where the face is touched, nothing
// rolls. A cone's side is touched along its length, and the axis is farther below it the farther it is from the tip.
// Within a step the points take along what they bear by as much too far, or not far enough, as their pivot is short or
// long. So it is that of the point of the side under the centre of mass, 3/2 h from the tip, where a cone that lies is
// borne: then no moment is left about the line. 3/2 h sin a, tan a = r / 2h, is 3/2 of the thickness.
static inline float fe__form_pivot(const fe__form *form, fe_vec3 n)
{
    if (!fe__form_is_curved(form)) return form->radius;
    float across = sqrtf(n.x * n.x + n.z * n.z);
    if (!(across > fe__absf(n.y))) return 0.0f;
    return form->type == FE__FORM_CONE ? 1.5f * fe__form_thickness(form) : form->half.x / across;
}

// ---- points --------------------------------------------------------------------------------------------------------
// A ball without size: the probe of a ray
static inline fe__form fe__point_form(void) { return (fe__form){.type = FE__FORM_SPHERE}; }
static inline int32_t fe__form_is_point(const fe__form *form)
{
    return form->type == FE__FORM_SPHERE && form->radius == 0.0f;
}

// ---- planes (surface.c)
// ---------------------------------------------------------------------------------------------- Does the box reach
// into the half space?
int32_t fe__plane_meets_box(const fe__form *plane, const fe__pose *pose, const fe__bounds *box, double gap);
// The plane in a frame whose origin is `away` (world axes) from that of its shape: as exact a thousand kilometres off
void fe__plane_move_frame(fe__form *plane, fe_quat rotation, fe_dvec3 away);

// ---- shape ----------------------------------------------------------------------------------------------------------
// The record of a shape: form, local pose, material, filter; where it is now and its box in the broad phase.

enum {
    FE__SHAPE_TRIGGER = 1,
    FE__SHAPE_CENTRED = 2, // local pose is the identity
    FE__SHAPE_IN_TREE = 4,
    FE__SHAPE_IN_PLANES = 8, // planes are in a list, not in a tree
    FE__SHAPE_JUDGED = 32,   // the pair filter judges its new pairs
    FE__SHAPE_ONE_WAY = 64,  // holds back only what comes against one_way
    FE__SHAPE_MOVED = 16     // in the list of proxies whose box is new: looks for pairs in the next step
};

// A serial holds, from the low bits, the number of a part + 1 (0: no part), then that of creation. So parts come behind
// their compound, and before what was created after it.
enum { FE__PART_BITS = 16 };
static inline int32_t fe__part_of_serial(uint64_t serial)
{
    return (int32_t)(serial & ((1u << FE__PART_BITS) - 1)) - 1;
}
static inline uint64_t fe__serial_of_whole(uint64_t serial) { return serial >> FE__PART_BITS << FE__PART_BITS; }

// First what a query reads: two cache lines.
typedef struct fe__shape {
    uint32_t layer, mask;
    uint32_t flags; // FE__SHAPE_*
    int32_t body;
    fe__pose pose; // in the world, follows the body
    fe__form form;
    fe_vec3 local_position; // m, body's frame
    fe_quat local_rotation;
    fe_material material;
    int32_t group;   // 0: none
    uint32_t events; // fe_shape_events
    float density;
    float arm; // from the body's centre of mass to the farthest point of its core, m; 0 for what is static only
    fe_vec3 surface_velocity;
    fe_vec3 one_way;        // its own frame, any length but zero
    int32_t next, previous; // of the body's shapes, in the order of creation
    uint64_t serial;        // of creation and of the part, never reused by another shape
    uint64_t body_serial;   // of its body
    uint64_t user_data;
    int32_t next_user; // of the same asset, -1: none
    int32_t parent;    // the shape whose part it is, right before the parts in the body's list; -1: it is no part
} fe__shape;

// What the caller knows: of a part, its compound
static inline int32_t fe__whole_shape(const fe__shape *shapes, int32_t shape)
{
    int32_t parent = shapes[shape].parent;
    return parent >= 0 ? parent : shape;
}

// ---- sound ----------------------------------------------------------------------------------------------------------
// Forms as numbers, and forms that come from bytes.

// What is no asset's of a form: all there is of one without an asset, and the kind alone of another
typedef struct fe__form_numbers {
    int32_t kind; // fe__form_type
    float radius, half_height, distance;
    fe_vec3 half, normal;
} fe__form_numbers;
fe__form_numbers fe__numbers_of_form(const fe__form *form);
fe__form fe__form_of_numbers(const fe__form_numbers *numbers);

// Is it one that the API could have made, of those without an asset?
int32_t fe__form_is_sound(const fe__form *form);
static inline int32_t fe__forms_are_alike(const fe__form *a, const fe__form *b)
{
    return a->type == b->type;
} // in kind
// Have they the same kind and the same numbers, or the same asset?
int32_t fe__forms_are_same(const fe__form *a, const fe__form *b);

// ---- ray hit --------------------------------------------------------------------------------------------------------
// Where a ray meets a form.

typedef struct fe__ray_hit {
    double t;
    fe_dvec3 normal; // unit, form's frame
    double depth;    // > 0 when inside, else 0
    int32_t inside;
    int32_t triangle; // number, of a heightfield or a mesh; the face of a hull; else -1
    int32_t index;    // of a triangle of the ground: see ground.h
} fe__ray_hit;

// ---- support --------------------------------------------------------------------------------------------------------
// What the general convex path knows of a form: the core's farthest point in a direction, and the face that
// looks that way.
//
// With both a form is complete for GJK, EPA and the manifold. The swelling radius stays outside: it is added to the
// distance of the cores.

// The point of the core farthest along `direction` (any length), form's frame. Of equally far points always the same.
static inline fe_dvec3 fe__form_support(const fe__form *form, fe_dvec3 direction)
{
    return fe__traits_of(form)->support(form, direction);
}

// A face of the core: polygon (turning left around the normal), segment or point, form's frame.
typedef struct fe__face {
    int32_t count;  // > 2 polygon, 2 segment, 1 point
    fe_vec3 normal; // unit; of a polygon only
    fe_vec3 vertex[FE_FACE_VERTICES];
    uint32_t id;     // of the face within the form
    float rim;       // a disc's radius, of whose rim the vertices are some points; else 0
    int32_t low;     // of a disc: the vertex farthest along the direction asked for, or 0 where that is across the disc
    int32_t pattern; // of a disc: FE_RIM_*
    const fe_vec3 *foot; // given: where the load on the face presses, form's frame; NULL: nobody knows
} fe__face;

// Of more corners than a face gives, those over which the load leans are among them
static inline void fe__form_face_under(const fe__form *form, fe_vec3 direction, const fe_vec3 *foot, fe__face *face)
{
    face->rim = 0.0f, face->pattern = FE_RIM_LEANS;
    face->foot = foot;
    fe__traits_of(form)->face(form, direction, face);
}

static inline void fe__form_face(const fe__form *form, fe_vec3 direction, fe__face *face)
{
    fe__form_face_under(form, direction, NULL, face);
}

#endif
