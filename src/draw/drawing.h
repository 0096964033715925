// drawing.h - what a call draws, and how.
#ifndef FE_DRAW_DRAWING_H
#define FE_DRAW_DRAWING_H
#include "collision/surface/surface.h"
#include "world/joint.h"
#include "world/world.h"

// ---- drawing --------------------------------------------------------------------------------------------------------

enum {
    FE__DRAWN_ISLANDS = 16384, // that have a hue of their oldest body; of any further ones each body has its own
    FE__DRAW_ALL = 2 * FE_DRAW_TREES - 1
};

// What is drawn, and how: of a call
typedef struct fe__drawing {
    const fe_world *world;
    uint32_t parts; // fe_draw_flags
    fe_dvec3 origin;
    fe__bounds box;
    int32_t has_box; // 0: the box holds every place there is
    int32_t only;    // body, -1: all
    float scale;     // m
    fe__circle circle;
    uint8_t hue_of[FE__DRAWN_ISLANDS]; // by island: 1 + hue; 0: not met yet
} fe__drawing;

// `drawing` has its world, parts, origin, box, only and scale
void fe__drawing_begin(fe__drawing *drawing, int32_t segments);

// ---- colours --------------------------------------------------------------------------------------------------------
// Every colour of a drawing, in one table.
//
// Hues are of Okabe and Ito (Color universal design, 2008) and of Tol (Colour schemes, 2021): people who confuse red
// and green tell them apart.

#define FE__RGB(red, green, blue) \
    ((uint32_t)(red) | (uint32_t)(green) << 8 | (uint32_t)(blue) << 16 | (uint32_t)255 << 24)

typedef enum fe__colour {
    FE__COLOUR_STATIC,
    FE__COLOUR_KINEMATIC,
    FE__COLOUR_AWAKE, // where islands have no hues
    FE__COLOUR_ASLEEP,
    FE__COLOUR_ANCHOR, // from joints to bodies
    FE__COLOUR_GAP,    // between two points that should be one
    FE__COLOUR_X,
    FE__COLOUR_Y,
    FE__COLOUR_Z,
    FE__COLOUR_FORCE,
    FE__COLOUR_BOUNDS,
    FE__COLOUR_TREE,
    FE__COLOUR_CENTRE,
    FE__NAMED_COLOURS
} fe__colour;
enum { FE__HUES = 8, FE__LOADS = 6, FE__USES = 5 };

extern const uint32_t fe__colours[FE__NAMED_COLOURS];

uint32_t fe__body_colour(fe__drawing *drawing, int32_t body);
uint32_t fe__shape_colour(uint32_t body_colour, const fe__shape *shape);
// Of a force that is `load` times the weight of the lighter body
uint32_t fe__load_colour(double load);
// Of a range that is used: 0 in the middle, 1 at an end, more beyond
uint32_t fe__use_colour(double use);

// ---- draw contacts --------------------------------------------------------------------------------------------------
// Where bodies touch, and what passes there.

// m/s2: what weights are told in; standard gravity where there is none
double fe__drawn_gravity(const fe_world *world);
// N: of the lighter dynamic one of two bodies
double fe__lighter_weight(const fe_world *world, int32_t body_a, int32_t body_b);

void fe__draw_contact_lines(const fe__drawing *drawing, fe__pen *pen); // normals, forces
void fe__draw_contact_points(const fe__drawing *drawing, fe__pen *pen);

// ---- draw joints ----------------------------------------------------------------------------------------------------
// The range of a joint as a scale with a needle, in frame A.

// ---- gauge ----------------------------------------------------------------------------------------------------------

typedef struct fe__gauge {
    const fe__drawing *drawing;
    fe__pen *pen;
    fe_transform frame; // A's, world space
    fe_dvec3 point;     // of frame B, world space
    const fe_joint_state *state;
} fe__gauge;

// All ranges of a joint of a type (fe_joint_type)
void fe__draw_gauges(const fe__gauge *gauge, int32_t type, const fe__joint_any *def);

// ---- joints ---------------------------------------------------------------------------------------------------------
// Where joints hold their bodies, and how far they may go.

void fe__draw_joint_lines(const fe__drawing *drawing, fe__pen *pen); // anchors and frames
void fe__draw_joint_forces(const fe__drawing *drawing, fe__pen *pen);
void fe__draw_joint_limits(const fe__drawing *drawing, fe__pen *pen);
void fe__draw_joint_points(const fe__drawing *drawing, fe__pen *pen);

// ---- draw shapes ----------------------------------------------------------------------------------------------------
// What is drawn of single bodies, and of the boxes around them.

// ---- bodies ---------------------------------------------------------------------------------------------------------

void fe__draw_added_forces(const fe__drawing *drawing, fe__pen *pen); // for the next step, at the centres
void fe__draw_centre_lines(const fe__drawing *drawing, fe__pen *pen); // principal axes
void fe__draw_centre_points(const fe__drawing *drawing, fe__pen *pen);
void fe__draw_shape_boxes(fe__drawing *drawing, fe__pen *pen);
void fe__draw_trees(const fe__drawing *drawing, fe__pen *pen);

// ---- shapes ---------------------------------------------------------------------------------------------------------
// The walk over what is drawn: bodies in the order of creation, and the shapes of each.

// The shapes that a drawing shows, one after another:
//
//   fe__shape_walk walk = fe__shapes_begin(drawing);
//   while (fe__shapes_next(drawing, &walk)) ... walk.shape ...
typedef struct fe__shape_walk {
    int32_t next_body, next_shape;
    uint32_t body_colour;
    // of the shape at hand
    int32_t body, shape;
    uint32_t rgba;
    int32_t is_cut; // 0: it lies in the drawing's box
} fe__shape_walk;

fe__shape_walk fe__shapes_begin(const fe__drawing *drawing);
int32_t fe__shapes_next(fe__drawing *drawing, fe__shape_walk *walk); // 0: no more
fe__drawn fe__shape_surface(const fe__drawing *drawing, const fe__shape_walk *walk);

void fe__draw_shapes(fe__drawing *drawing, fe__pen *pen, void draw(const fe__drawn *surface, fe__pen *pen));

// As many as there are; the first `capacity` of them are written, `size` bytes each
int32_t fe__draw_instances(fe__drawing *drawing, void *out, uint32_t stride, uint32_t size, int32_t capacity);

static inline int32_t fe__is_drawn(const fe__drawing *d, int32_t body) { return d->only < 0 || d->only == body; }
static inline int32_t fe__is_in_box(const fe__drawing *d, fe_dvec3 p)
{
    const fe__bounds *b = &d->box;
    if (!d->has_box) return 1;
    return p.x >= b->low.x && p.x <= b->high.x && p.y >= b->low.y && p.y <= b->high.y && p.z >= b->low.z &&
           p.z <= b->high.z;
}
static inline fe_vec3 fe__in_drawing(const fe__drawing *d, fe_dvec3 p) { return fe__narrow(fe__dsub(p, d->origin)); }

// ---- draw -----------------------------------------------------------------------------------------------------------
// The world as vertices and instances, for whoever draws.
//
// Reads only, allocates nothing. api/fe_draw.c fills a fe__drawing with checked options and hands it a pen. What comes
// first: shapes in the order of their bodies' creation (draw_shapes.c), then contacts (draw_contacts.c), joints
// (draw_joints.c), and what is of single bodies and of the trees (draw_shapes.c).

void fe__draw_lines(fe__drawing *drawing, fe__pen *pen);
void fe__draw_triangles(fe__drawing *drawing, fe__pen *pen);
void fe__draw_points(fe__drawing *drawing, fe__pen *pen);

#endif
