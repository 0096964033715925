// joints.c - see joints.h. Joints come in the order of their creation.
#include "draw/joints.h"

#include "draw/colours.h"
#include "draw/contacts.h"
#include "draw/gauge.h"
#include "draw/shapes.h"
#include "world/anchor.h"
#include "world/handles.h"
#include "world/joint_state.h"
#include "world/joints.h"
#include "world/pose.h"

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
