// draw_joints.c - see drawing.h. The words are those of the joints' section in feather.h.
#include "draw/drawing.h"

#include "core/math.h"
#include "world/body.h"
#include "world/joint.h"
#include "world/joint_creation.h"
#include "world/joint_parts.h"
#include "world/world.h"

// ---- gauge ----------------------------------------------------------------------------------------------------------

// Of a range: 0 in its middle, 1 at its ends
static double use_of(double x, double lower, double upper)
{
    double half = 0.5 * (upper - lower), off = fe__absd(x - 0.5 * (lower + upper));
    const double least = 1e-3; // m or rad: a range that is a point
    return off / fe__maxd(half, least);
}

// From frame A to the drawing
static fe_vec3 place(const fe__gauge *g, fe_dvec3 p)
{
    return fe__in_drawing(g->drawing, fe__dadd(g->frame.position, fe__drotate(g->frame.rotation, p)));
}

static void draw(const fe__gauge *g, fe_dvec3 from, fe_dvec3 to) { fe__pen_line(g->pen, place(g, from), place(g, to)); }

// ---- angles --------------------------------------------------------------------------------------------------------
// What angle 0 points along, turned about the axis: Y about X, X about Y, X about Z
static fe_dvec3 pointer(const fe__gauge *g, int32_t axis, double angle)
{
    double s, c, r = (double)g->drawing->scale;
    fe__sincos(angle, &s, &c);
    s *= r, c *= r;
    return axis == 0 ? (fe_dvec3){0.0, c, s} : axis == 1 ? (fe_dvec3){c, 0.0, -s} : (fe_dvec3){c, s, 0.0};
}

static void draw_arc(const fe__gauge *g, int32_t axis, float lower, float upper, float angle)
{
    const fe_dvec3 zero = {0.0, 0.0, 0.0};
    int32_t steps = g->drawing->circle.segments;
    double low = (double)lower, step = ((double)upper - low) / (double)steps;
    g->pen->rgba = fe__use_colour(use_of((double)angle, low, (double)upper));
    fe_dvec3 last = pointer(g, axis, low);
    draw(g, zero, last);
    for (int32_t i = 1; i <= steps; ++i) {
        fe_dvec3 next = pointer(g, axis, low + step * (double)i);
        draw(g, last, next);
        last = next;
    }
    draw(g, last, zero);
    draw(g, zero, pointer(g, axis, (double)angle)); // the needle
}

// Axis X after a swing by the rotation vector (0, y, z): cos a X + sin a (0, z, -y) / a, a = |(y, z)|
static fe_dvec3 swung(const fe__gauge *g, double y, double z)
{
    double a = sqrt(y * y + z * z), s, c, r = (double)g->drawing->scale;
    fe__sincos(a, &s, &c);
    double k = a > 0.0 ? s / a : 1.0;
    return (fe_dvec3){r * c, r * k * z, -r * k * y};
}

static void draw_cone(const fe__gauge *g, float cone_y, float cone_z)
{
    enum { SPOKES = 4 };
    const fe__circle *c = &g->drawing->circle;
    const fe_dvec3 zero = {0.0, 0.0, 0.0};
    double a = (double)cone_y, b = (double)cone_z, y = (double)g->state->swing_y, z = (double)g->state->swing_z;
    g->pen->rgba = fe__use_colour(sqrt(y * y / (a * a) + z * z / (b * b)));
    for (int32_t i = 0; i < c->segments; ++i)
        draw(g, swung(g, a * c->cosine[i], b * c->sine[i]), swung(g, a * c->cosine[i + 1], b * c->sine[i + 1]));
    for (int32_t i = 0; i < SPOKES; ++i)
        draw(g, zero, swung(g, i & 1 ? 0.0 : a * (i & 2 ? -1.0 : 1.0), i & 1 ? b * (i & 2 ? -1.0 : 1.0) : 0.0));
    draw(g, zero, swung(g, y, z)); // the needle
}

// ---- lengths -------------------------------------------------------------------------------------------------------
// Along a unit vector of frame A, with a mark across at both ends and at x
static void draw_ruler(const fe__gauge *g, fe_dvec3 along, fe_dvec3 across, float lower, float upper, double x)
{
    double marks[3] = {(double)lower, (double)upper, x}, half = 0.125 * (double)g->drawing->scale;
    fe_dvec3 aside = fe__dscale(half, across);
    draw(g, fe__dscale(marks[0], along), fe__dscale(marks[1], along));
    for (int32_t i = 0; i < 3; ++i) {
        fe_dvec3 at = fe__dscale(marks[i], along);
        draw(g, fe__dsub(at, aside), fe__dadd(at, aside));
    }
}

static const fe_dvec3 axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};

static void draw_distance(const fe__gauge *g, const fe_distance_joint_def *def)
{
    if (!def->limit_enabled) return;
    fe_dvec3 d = fe__drotate_back(g->frame.rotation, fe__dsub(g->point, g->frame.position));
    double length = sqrt(fe__ddot(d, d)), upper = (double)def->upper;
    fe_dvec3 along = length > 0.0 ? fe__dscale(1.0 / length, d) : axes[0];
    fe_dvec3 across = fe__dcross(along, fe__absd(along.y) < 0.5 ? axes[1] : axes[0]);
    // a rope is slack down to 0
    double use = def->lower > 0.0f ? use_of(length, (double)def->lower, upper) : length / upper;
    g->pen->rgba = fe__use_colour(use);
    draw_ruler(g, along, across, def->lower, def->upper, length);
}

static void draw_configurable(const fe__gauge *g, const fe_configurable_joint_def *def)
{
    const fe_joint_state *s = g->state;
    const float x[6] = {s->translation.x, s->translation.y, s->translation.z, s->angle, s->swing_y, s->swing_z};
    for (int32_t k = 0; k < 6; ++k) {
        const fe_joint_axis *axis = def->axes + k;
        if (axis->motion != FE_MOTION_LIMITED) continue;
        if (k >= FE_DOF_ANGULAR_X) {
            draw_arc(g, k - FE_DOF_ANGULAR_X, axis->lower, axis->upper, x[k]);
            continue;
        }
        g->pen->rgba = fe__use_colour(use_of((double)x[k], (double)axis->lower, (double)axis->upper));
        draw_ruler(g, axes[k], axes[(k + 1) % 3], axis->lower, axis->upper, (double)x[k]);
    }
}

static void draw_ball(const fe__gauge *g, const fe_ball_joint_def *def)
{
    if (def->cone_enabled) draw_cone(g, def->cone_y, def->cone_z);
    if (def->limit_enabled) draw_arc(g, 0, def->lower, def->upper, g->state->angle);
}

void fe__draw_gauges(const fe__gauge *g, int32_t type, const fe__joint_any *def)
{
    switch (type) {
    case FE_JOINT_DISTANCE:
        draw_distance(g, &def->distance);
        return;
    case FE_JOINT_BALL:
        draw_ball(g, &def->ball);
        return;
    case FE_JOINT_HINGE:
        if (def->hinge.limit_enabled) draw_arc(g, 0, def->hinge.lower, def->hinge.upper, g->state->angle);
        return;
    case FE_JOINT_CONFIGURABLE:
        draw_configurable(g, &def->configurable);
        return;
    default: // a fixed joint has no range
        return;
    }
}

// ---- joints ---------------------------------------------------------------------------------------------------------
// See drawing.h. Joints come in the order of their creation.

// A joint that is drawn, and where its frames are
typedef struct tie {
    int32_t joint, body[2];
    fe_transform frame[2];
} tie;

static int32_t open_tie(const fe__drawing *d, int32_t joint, tie *t)
{
    const fe__joint_record *r = d->world->joint_records + joint;
    t->joint = joint;
    for (int32_t side = 0; side < 2; ++side) {
        t->body[side] = r->body[side];
        t->frame[side] = fe__joint_frame_now(d->world, joint, side);
    }
    int32_t drawn = fe__is_drawn(d, t->body[0]) || fe__is_drawn(d, t->body[1]);
    return drawn && (fe__is_in_box(d, t->frame[0].position) || fe__is_in_box(d, t->frame[1].position));
}

static void line(const fe__drawing *d, fe__pen *pen, fe_dvec3 from, fe_dvec3 to)
{
    fe__pen_line(pen, fe__in_drawing(d, from), fe__in_drawing(d, to));
}

// ---- what is drawn of a joint --------------------------------------------------------------------------------------
static void draw_axes(const fe__drawing *d, const fe_transform *frame, fe__pen *pen)
{
    static const fe__colour colours[3] = {FE__COLOUR_X, FE__COLOUR_Y, FE__COLOUR_Z};
    static const fe_dvec3 axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    double length = 0.5 * (double)d->scale;
    for (int32_t k = 0; k < 3; ++k) {
        fe_dvec3 way = fe__dscale(length, fe__drotate(frame->rotation, axes[k]));
        pen->rgba = fe__colours[colours[k]];
        line(d, pen, frame->position, fe__dadd(frame->position, way));
    }
}

static void draw_tie(const fe__drawing *d, const tie *t, fe__pen *pen)
{
    for (int32_t side = 0; side < 2; ++side) {
        pen->rgba = fe__colours[FE__COLOUR_ANCHOR];
        if (!fe__is_anchor(d->world, t->body[side]))
            line(d, pen, fe__centre_of(d->world->bodies + t->body[side]), t->frame[side].position);
        draw_axes(d, t->frame + side, pen);
    }
    pen->rgba = fe__colours[FE__COLOUR_GAP];
    line(d, pen, t->frame[0].position, t->frame[1].position);
}

static void draw_force(const fe__drawing *d, const tie *t, fe__pen *pen)
{
    const fe_world *w = d->world;
    fe_vec3 force, torque;
    fe__joint_reaction_of(&w->joints, w->bodies, t->joint, &force, &torque);
    double per_weight = (double)d->scale / fe__lighter_weight(w, t->body[0], t->body[1]);
    fe_dvec3 from = t->frame[1].position;
    pen->rgba = fe__colours[FE__COLOUR_FORCE];
    line(d, pen, from, fe__dadd(from, fe__dscale(per_weight, fe__widen(force))));
}

static void draw_limits(const fe__drawing *d, const tie *t, fe__pen *pen)
{
    fe__joint_any def;
    fe_joint_state state;
    fe__joint_describe(d->world, t->joint, &def);
    fe__joint_state_of(d->world, t->joint, &state);
    fe__gauge gauge = {d, pen, t->frame[0], t->frame[1].position, &state};
    fe__draw_gauges(&gauge, d->world->joint_records[t->joint].type, &def);
}

static void draw_anchors(const fe__drawing *d, const tie *t, fe__pen *pen)
{
    pen->rgba = fe__colours[FE__COLOUR_ANCHOR];
    for (int32_t side = 0; side < 2; ++side) fe__pen_vertex(pen, fe__in_drawing(d, t->frame[side].position));
}

// ---- the walk ------------------------------------------------------------------------------------------------------
static void draw_ties(const fe__drawing *d, fe__pen *pen, void draw(const fe__drawing *, const tie *, fe__pen *))
{
    const fe_world *w = d->world;
    for (int32_t joint = w->first_joint; joint; joint = w->joint_records[joint].order_next) {
        tie t;
        if (!open_tie(d, joint, &t)) continue;
        pen->owner = fe__joint_handle(w, joint);
        draw(d, &t, pen);
    }
}

void fe__draw_joint_lines(const fe__drawing *d, fe__pen *pen) { draw_ties(d, pen, draw_tie); }
void fe__draw_joint_forces(const fe__drawing *d, fe__pen *pen) { draw_ties(d, pen, draw_force); }
void fe__draw_joint_limits(const fe__drawing *d, fe__pen *pen) { draw_ties(d, pen, draw_limits); }
void fe__draw_joint_points(const fe__drawing *d, fe__pen *pen) { draw_ties(d, pen, draw_anchors); }
