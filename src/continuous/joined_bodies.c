// joined_bodies.c - re-projection of joints after continuous collision: a bone that a wall stopped is where the wall
// is, and the others went on without it.
//
// Positions only, by sweeps over the joints of the tree, each closed at once by the masses of its two ends (a step of
// Newton's method on the gap d:  l = -K^-1 d,  dx = l / m,  turn = I^-1 (r x l)): few bodies, once in a while, and a
// tenth of the linear slop is enough. Poses are motions since the step began, in the solver's lines (float[8]: centre,
// 0 | rotation).
#define FE_W 4
#include "continuous/joined_bodies.h"

#include "continuous/continuous.h"
#include "continuous/motion_path.h"
#include "solver/motion_check.h"
#include "world/joint.h"
#include "world/body.h"

#include <math.h>

enum { MOST_SWEEPS = 32, MOST_ROUNDS = 3 };
#define REJOINED 5e-4  // m, a tenth of the linear slop
#define MOST_TURN 0.25 // rad, for an end at once: a gap's change is not linear in the turn
#define SINGULAR 1e-9  // added to the diagonal of K, as a share of its trace: locked bodies give nothing

typedef struct end {
    const fe__body *body;
    fe__motion_line *motion; // NULL: the body does not move in this step
    fe_dvec3 arm;            // m, world, now
    double mass[3];          // inverse, along the world's axes, 1/kg; 0: held
    double turn[3];          // 1: the body may turn about that axis of the world
} end;

static fe_quat turn_of(const end *e) { return e->motion ? fe__quat_of(e->motion->rotation) : fe__identity(); }

static end end_of(const fe_world *w, int32_t body, const float *local_arm, int32_t holds)
{
    const fe__body *b = w->bodies + body;
    const int locks = (int)b->lock_bits, moves = b->awake_index >= 0 && b->line >= 0,
              held = (holds && b->flags & FE__BODY_HELD) || b->type != FE_BODY_DYNAMIC;
    end e = {.body = b, .motion = moves ? w->solver.motion + b->line : NULL};
    e.arm = fe__drotate(turn_of(&e), fe__drotate(fe__rotation_of(b), fe__widen(fe__quad_vector(local_arm))));
    for (int k = 0; k < 3 && !held; ++k) {
        e.mass[k] = locks >> k & 1 ? 0.0 : (double)b->inverse_mass;
        e.turn[k] = locks >> (3 + k) & 1 ? 0.0 : 1.0;
    }
    return e;
}

// The anchor of an end, m, world
static fe_dvec3 point_of(const end *e)
{
    fe_dvec3 point = fe__dadd(fe__centre_of(e->body), e->arm);
    return e->motion ? fe__dadd(point, fe__widen(fe__quad_vector(e->motion->shift))) : point;
}

static fe_dvec3 scale_axes(const double *share, fe_dvec3 a)
{
    return (fe_dvec3){share[0] * a.x, share[1] * a.y, share[2] * a.z};
}

// I^-1 m for a moment m about the centre
static fe_dvec3 turn_by(const end *e, fe_dvec3 moment)
{
    const fe__body *b = e->body;
    fe_quat axes = fe__product(fe__product(turn_of(e), fe__rotation_of(b)), fe__quat_of(b->inertia_axes));
    fe_dvec3 m = fe__drotate_back(axes, scale_axes(e->turn, moment));
    m = (fe_dvec3){m.x / (double)b->inertia[0], m.y / (double)b->inertia[1], m.z / (double)b->inertia[2]};
    return scale_axes(e->turn, fe__drotate(axes, m));
}

// The displacement of an end's point by a push there (N s2): its inverse effective mass times the push
static fe_dvec3 response(const end *e, fe_dvec3 push)
{
    if (e->body->type != FE_BODY_DYNAMIC) return (fe_dvec3){0.0, 0.0, 0.0};
    return fe__dadd(scale_axes(e->mass, push), fe__dcross(turn_by(e, fe__dcross(e->arm, push)), e->arm));
}

static void move_end(const fe_world *w, const end *e, fe_dvec3 push)
{
    if (e->body->type != FE_BODY_DYNAMIC || !e->motion) return;
    fe__give_back(w, e->body, fe__narrow(scale_axes(e->mass, push)), w->solver.velocity[e->body->line].v);
    fe_dvec3 shift = scale_axes(e->mass, push), turn = turn_by(e, fe__dcross(e->arm, push));
    double angle = sqrt(fe__ddot(turn, turn)), half = 0.5 * (angle > MOST_TURN ? MOST_TURN / angle : 1.0);
    fe_quat q = {(float)(half * turn.x), (float)(half * turn.y), (float)(half * turn.z), 1.0f};
    q = fe__normalized(fe__product(q, turn_of(e)));
    float *p = e->motion->shift, *r = e->motion->rotation;
    p[0] = (float)((double)p[0] + shift.x), p[1] = (float)((double)p[1] + shift.y),
    p[2] = (float)((double)p[2] + shift.z);
    r[0] = q.x, r[1] = q.y, r[2] = q.z, r[3] = q.w;
}

// x with K x = d; K: both responses to pushes along the three axes
static fe_dvec3 push_for(const end *a, const end *b, fe_dvec3 d)
{
    fe_dvec3 column[3];
    for (int k = 0; k < 3; ++k) {
        const fe_dvec3 unit = {k == 0, k == 1, k == 2};
        column[k] = fe__dadd(response(a, unit), response(b, unit));
    }
    const double least = SINGULAR * (column[0].x + column[1].y + column[2].z);
    column[0].x += least, column[1].y += least, column[2].z += least;
    const fe_dvec3 yz = fe__dcross(column[1], column[2]), zx = fe__dcross(column[2], column[0]),
                   xy = fe__dcross(column[0], column[1]);
    const double volume = fe__ddot(column[0], yz), k = volume > 0.0 ? 1.0 / volume : 0.0;
    return (fe_dvec3){k * fe__ddot(yz, d), k * fe__ddot(zx, d), k * fe__ddot(xy, d)};
}

// Closes a joint that holds points together; returns how far it was open, m
static double close_joint(const fe_world *w, int32_t joint, int32_t holds)
{
    const fe__joint *j = w->joints.joints + joint;
    if (!(w->joints.frames[joint].parts >> FE__PART_POINT & 1)) return 0.0;
    end a = end_of(w, j->body_a, j->arm_a, holds), b = end_of(w, j->body_b, j->arm_b, holds);
    fe_dvec3 gap = fe__dsub(point_of(&b), point_of(&a));
    fe_dvec3 push = push_for(&a, &b, gap);
    move_end(w, &a, push), move_end(w, &b, fe__dscale(-1.0, push));
    return sqrt(fe__ddot(gap, gap));
}

// Sweeps until all joints are closed. holds: 1: stopped bodies stay
static void close_tree(const fe_world *w, const fe__joint_tree *tree, int32_t holds)
{
    const fe__tree_link *links = w->joints.forest.links + tree->first;
    double widest = 2.0 * REJOINED;
    for (int32_t sweep = 0; sweep < MOST_SWEEPS && widest > REJOINED; ++sweep) {
        widest = 0.0;
        for (int32_t i = 0; i < tree->count; ++i) {
            int32_t joint = links[sweep % 2 ? tree->count - 1 - i : i].joint;
            if (joint) widest = fe__maxd(widest, close_joint(w, joint, holds));
        }
    }
}

static void rejoin(const fe__step *step, const fe__joint_tree *tree)
{
    const fe_world *w = step->world;
    const fe__tree_link *links = w->joints.forest.links + tree->first;
    for (int32_t i = 0; i < tree->count; ++i) // a body that overflowed would take the others along
        if (!fe__motion_makes_sense(&w->solver, w->bodies[links[i].body].line)) return;
    for (int32_t i = 0; i < tree->count; ++i)
        w->solver.trail_count[w->bodies[links[i].body].line] = FE__NO_TRAIL; // straight motions now
    for (int32_t round = 0, stopped = 1; round < MOST_ROUNDS && stopped; ++round) {
        close_tree(w, tree, 1);
        // bodies that meet an obstacle where their joints brought them stop too
        stopped = 0;
        for (int32_t i = 0; i < tree->count; ++i)
            if (!(w->bodies[links[i].body].flags & FE__BODY_HELD)) stopped += fe__stop_body(step, links[i].body);
    }
    close_tree(w, tree, 0); // a joint whose ends are both held gives way, by as little as can be
    for (int32_t i = 0; i < tree->count; ++i) w->bodies[links[i].body].flags &= ~(uint32_t)FE__BODY_HELD;
}

// The tree that the body's joints are in; NULL: none
static const fe__joint_tree *tree_of_body(const fe_world *w, int32_t body)
{
    const fe__forest *f = &w->joints.forest;
    for (int32_t joint = w->bodies[body].first_joint; joint; joint = fe__next_joint(w, joint, body))
        if (w->joints.joints[joint].colour >= 0 && f->link_of[joint] >= 0)
            return f->trees + f->links[f->link_of[joint]].tree;
    return NULL;
}

void fe__rejoin_trees(fe__step *step)
{
    fe_world *w = step->world;
    const fe__step_scratch *s = step->scratch;
    for (int32_t i = 0, count = atomic_load(&s->swept_count); i < count; ++i) {
        fe__body *body = w->bodies + s->swept[i];
        if (!(body->flags & FE__BODY_HELD)) continue;
        const fe__joint_tree *tree = tree_of_body(w, s->swept[i]);
        if (tree) rejoin(step, tree);
        body->flags &= ~(uint32_t)FE__BODY_HELD;
    }
}
