// form.h - the forms of shapes: mass, bounds, support function and faces of each kind; and the record of a shape.
//
// The API makes forms from fe_geometry; the narrow phase, the casts and the queries read them. A form lives in the
// frame of its shape. Code below world/ knows forms and poses only. Only collision/ asks for the kind of a form; all
// others ask for its traits. CONTRIBUTING.md lists what a new form takes; its kind goes before the triangle, and of two
// forms the one with the later kind is A in fe__collide.
#ifndef FE_COLLISION_FORM_FORM_H
#define FE_COLLISION_FORM_FORM_H
#include "collision/form/clip.h"
#include "core/math.h"

#include <stddef.h>

// ---- form -----------------------------------------------------------------------------------------------------------
// The kinds of forms, in the order of the kernels. A triangle is no public form: heightfields and meshes hand
// out theirs one by one. Nothing touches a compound as such: its parts collide (compound.h).
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

// A form is a core swelled by a radius. Fields that a kind does not use are 0.
//
//   sphere       radius; the core is the origin
//   capsule      half_height along y, radius; the core is a segment
//   box          half, the half widths; no radius
//   plane        the half space normal . p <= distance; |normal| = 1
//   cylinder     half: x and z are the radius of the rim, y is half the height along y; no radius
//   cone         the same; its tip is at +half.y, its base at -half.y
//   triangle     vertices, turning left around the side that counts
//   heightfield  index of its record, bounds (heightfield.h); a mesh has the same (mesh.h)
//   compound     index of its record (compound.h)
//   hull         index of its record, its address; offset + scale x is the form's point for the hull's point x (hull.h)
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
            int32_t field; // index of the asset's record in the store
            fe_vec3 low, high;
        };
        struct {
            int32_t hull_field; // the same number as `field`
            float scale;        // > 0
            fe_vec3 offset;     // origin of the hull's frame in the form's frame, m
            const struct fe__hull *hull;
        };
    };
} fe__form;

// A pose in the world: double position, unit rotation.
typedef struct fe__pose {
    fe_dvec3 position;
    fe_quat rotation;
} fe__pose;

// The world pose of a shape that stands at (position, rotation) in the frame of a body at `body`.
static inline fe__pose fe__compose(const fe__pose *body, fe_vec3 position, fe_quat rotation)
{
    return (fe__pose){fe__dadd(body->position, fe__drotate(body->rotation, fe__widen(position))),
                      fe__normalized(fe__product(body->rotation, rotation))};
}

// Forms for static bodies alone have mass 0.
typedef struct fe__mass {
    float mass;        // kg
    fe_vec3 inertia;   // principal moments about the centre of mass, kg m2
    fe_vec3 centre;    // centre of mass in the form's frame, m
    int32_t is_turned; // 0: the principal axes are the form's, and `axes` means nothing
    fe_quat axes;      // turns the principal axes into the form's
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

struct fe__face; // below

// ---- traits --------------------------------------------------------------------------------------------------------
typedef struct fe__form_traits {
    const char *name;    // The sentences of errors say it.
    int32_t geometry;    // fe_geometry_type, -1: not public
    uint8_t static_only; // The form has no mass: only static bodies may have it.
    uint8_t is_carried;  // Kinematic bodies may have it too.
    uint8_t is_ball;     // No rotation changes it, and it touches at one point.
    uint8_t flat_faces;  // It is a polyhedron given by its half widths, or a triangle.
    uint8_t curved;      // The core has a rim: cylinder, cone.
    uint8_t is_hull;     // An asset's hull holds its vertices and faces (hull.h).
    uint8_t unbounded;   // No box holds it, so that it is in no tree.
    uint8_t is_field;    // It is a surface of triangles (ground.h) and may touch in several manifolds.
    uint8_t has_asset;   // Shapes share its data by fe__form.field.
    uint8_t has_scale;   // The asset has a record for each scale.
    uint8_t of_parts;    // It stands for its parts, and is in no tree.
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

// Returns the kind with that public number, -1: none
int32_t fe__form_of_geometry(int32_t geometry);

// ---- mass, bounds, widths ------------------------------------------------------------------------------------------
static inline fe__mass fe__form_mass(const fe__form *form, float density)
{
    return fe__traits_of(form)->mass(form, (double)density);
}
// Bounds at a pose, in the world, as tight as the form allows. A plane's are infinite on all sides but the one its
// normal faces, if that is an axis; callers treat unbounded forms apart.
static inline fe__bounds fe__form_bounds(const fe__form *form, const fe__pose *pose)
{
    return fe__traits_of(form)->bounds(form, pose);
}
// Bounding radius: the largest distance from `centre` (form's frame) to a point of the form, m; 0 for planes,
// heightfields and compounds.
static inline float fe__form_reach(const fe__form *form, fe_vec3 centre)
{
    return fe__traits_of(form)->reach(form, centre);
}
// The smallest half width of the form, m: a fast body must not move farther than that unseen. FLT_MAX for planes,
// heightfields, meshes and compounds
static inline float fe__form_thickness(const fe__form *form) { return fe__traits_of(form)->thickness(form); }
// The form without its outermost layer, which is `by` thick (m, less than the form's thickness).
static inline fe__form fe__form_shrunk(const fe__form *form, float by) { return fe__traits_of(form)->shrunk(form, by); }

// The radius with which the form rolls, m: 0 for a box.
static inline float fe__form_roundness(const fe__form *form)
{
    return fe__form_is_curved(form) ? form->half.x : form->radius;
}
// The pivot: how far below the surface lies the point that keeps its place when the form rolls, m. It is measured along
// the unit normal n (form's frame) at which the form is touched. A round form's pivot is its radius. A rim's circle
// turns about the y axis, so that the point of touch stays as deep: to second order in the turn, r s = pivot s^2 with
// s = |n across the axis|. A form that is touched on its flat face does not roll: 0.
//
// A cone's side is touched along its length, and its axis is farther below the side the farther it is from the tip.
// Within a step a contact point moves its load too far, or not far enough, by as much as its pivot is too short or too
// long. So all points of the side have the pivot of the point under the centre of mass, 3/2 h from the tip, which bears
// a cone that lies: then no moment is left about the line. It is 3/2 h sin a, tan a = r / 2h, or 3/2 of the thickness.
static inline float fe__form_pivot(const fe__form *form, fe_vec3 n)
{
    if (!fe__form_is_curved(form)) return form->radius;
    float across = sqrtf(n.x * n.x + n.z * n.z);
    if (!(across > fe__absf(n.y))) return 0.0f;
    return form->type == FE__FORM_CONE ? 1.5f * fe__form_thickness(form) : form->half.x / across;
}

// ---- points and planes ---------------------------------------------------------------------------------------------
// A ball of radius 0 is the probe of a ray.
static inline fe__form fe__point_form(void) { return (fe__form){.type = FE__FORM_SPHERE}; }
static inline int32_t fe__form_is_point(const fe__form *form)
{
    return form->type == FE__FORM_SPHERE && form->radius == 0.0f;
}
// Does the box come as near as `gap`, m, to the half space?
int32_t fe__plane_meets_box(const fe__form *plane, const fe__pose *pose, const fe__bounds *box, double gap);
// Moves the plane into a frame whose origin is `away` (world axes) from that of its shape. The distance is computed in
// double, so that it is as exact a thousand kilometres off.
void fe__plane_move_frame(fe__form *plane, fe_quat rotation, fe_dvec3 away);

// ---- shape ----------------------------------------------------------------------------------------------------------

enum {
    FE__SHAPE_TRIGGER = 1,
    FE__SHAPE_CENTRED = 2, // The local pose is the identity.
    FE__SHAPE_IN_TREE = 4,
    FE__SHAPE_IN_PLANES = 8, // Planes are in a list, not in a tree.
    FE__SHAPE_MOVED = 16,    // The box is new and in the list of such proxies: it looks for pairs in the next step.
    FE__SHAPE_JUDGED = 32,   // The pair filter judges its new pairs.
    FE__SHAPE_ONE_WAY = 64   // It holds back only bodies that come against one_way.
};

// A serial holds the number of a part + 1 in its low bits (0: no part), and above them the number of the creation. So
// parts are ordered behind their compound, and before all shapes that were created after it.
enum { FE__PART_BITS = 16 };
static inline int32_t fe__part_of_serial(uint64_t serial)
{
    return (int32_t)(serial & ((1u << FE__PART_BITS) - 1)) - 1;
}
static inline uint64_t fe__serial_of_whole(uint64_t serial) { return serial >> FE__PART_BITS << FE__PART_BITS; }

// The record of a shape. The fields that queries read come first: they are two cache lines.
typedef struct fe__shape {
    uint32_t layer, mask;
    uint32_t flags; // FE__SHAPE_*
    int32_t body;
    fe__pose pose; // in the world; follows the body
    fe__form form;
    fe_vec3 local_position; // m, body's frame
    fe_quat local_rotation;
    fe_material material;
    int32_t group;   // 0: none
    uint32_t events; // fe_shape_events
    float density;
    float arm; // distance of the core's farthest point from the body's centre of mass, m; 0: a static only form
    fe_vec3 surface_velocity;
    fe_vec3 one_way;        // in the shape's frame; any length but zero
    int32_t next, previous; // links of the list of the body's shapes, in the order of creation
    uint64_t serial;        // creation and part; no other shape ever gets it again
    uint64_t body_serial;   // the serial of the body
    uint64_t user_data;
    int32_t next_user; // the next shape with the same asset, -1: none
    int32_t parent;    // the compound's shape, which stands right before its parts in the body's list; -1: no part
} fe__shape;

// The shape that the caller knows: the compound's if `shape` is a part.
static inline int32_t fe__whole_shape(const fe__shape *shapes, int32_t shape)
{
    int32_t parent = shapes[shape].parent;
    return parent >= 0 ? parent : shape;
}

// ---- validation ----------------------------------------------------------------------------------------------------
// The numbers of a form that are not in an asset: snapshots and assets store them. A form with an asset has only its
// kind here.
typedef struct fe__form_numbers {
    int32_t kind; // fe__form_type
    float radius, half_height, distance;
    fe_vec3 half, normal;
} fe__form_numbers;
fe__form_numbers fe__numbers_of_form(const fe__form *form);
fe__form fe__form_of_numbers(const fe__form_numbers *numbers);

// Could the API have made this form? Forms with an asset are not valid here: their assets are checked elsewhere.
int32_t fe__form_is_sound(const fe__form *form);
// Are both of one kind?
static inline int32_t fe__forms_are_alike(const fe__form *a, const fe__form *b) { return a->type == b->type; }
// Have both the same kind and the same numbers, or the same asset?
int32_t fe__forms_are_same(const fe__form *a, const fe__form *b);

// ---- ray hit --------------------------------------------------------------------------------------------------------
// The point where a ray, origin + t translation, meets a form.
typedef struct fe__ray_hit {
    double t;
    fe_dvec3 normal;  // unit, form's frame
    double depth;     // > 0: the ray begins inside, so deep, m
    int32_t inside;   // The ray begins inside.
    int32_t triangle; // number of a heightfield's or a mesh's triangle, or of a hull's face; -1: other forms
    int32_t index;    // index of the triangle in ground.h
} fe__ray_hit;

// ---- support and faces ---------------------------------------------------------------------------------------------
// The general convex path knows a form by two functions: the core's farthest point in a direction, and the face that
// looks that way. With both a form is complete for GJK, EPA and the manifold. The radius stays outside: it is added to
// the distance of the cores.

// The point of the core farthest along `direction` (any length), form's frame. Of equally far points always the same.
static inline fe_dvec3 fe__form_support(const fe__form *form, fe_dvec3 direction)
{
    return fe__traits_of(form)->support(form, direction);
}

// A face of the core in the form's frame: a polygon that turns left around its normal, a segment or a point.
typedef struct fe__face {
    int32_t count;  // > 2 polygon, 2 segment, 1 point
    fe_vec3 normal; // unit; only a polygon has one
    fe_vec3 vertex[FE_FACE_VERTICES];
    uint32_t id; // the number of the face within the form
    float rim;   // radius of a disc, if the vertices are points of its rim; 0: the face is no disc
    // A disc's vertex farthest along the direction asked for; 0: the direction is across the disc
    int32_t low;
    int32_t pattern;     // FE_RIM_* of a disc
    const fe_vec3 *foot; // input: the point where the load on the face presses, form's frame; NULL: it is not known
} fe__face;

// If the face has more corners than fit, those over which the load leans are among the ones given.
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
