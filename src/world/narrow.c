// narrow.c - the narrow phase of one pair: two shapes, one manifold, one contact.
//
// Called by the collide stage on any thread, for pairs that cannot be recycled. Double positions are subtracted here, so that everything below is
// float and small. Only the pair's own records are written.
#include "collision/collide.h"
#include "world/world.h"

#include <string.h>

// How far a pair may slide or turn before it needs a new manifold: at most this, m, and a share of the thinner form. Less for round forms, whose
// normal turns with them.
#define RECYCLE_MOST 0.03f
#define RECYCLE_SHARE 0.1f
#define RECYCLE_ROUND 0.0005f

// Closer than this to each other, m, shapes are placed in floats: a float of it is a micrometre fine. Beyond (a wide ground) in double.
#define NEAR 16.0

typedef struct view {
    const fe__shape *a, *b; // fe__collide's
    fe__form form_a;        // a plane's is moved next to B
    fe__relative relative;
    fe_dvec3 origin;        // of the frame of A, world
    fe__mat3 rotation;
} view;

// B in A's frame. A plane has no centre that matters: its frame is put at B, so that a plane is as exact a thousand kilometres off.
static view view_of(const fe_world *world, const fe__pair *p)
{
    view v = {.a = world->shapes + p->shape_a, .b = world->shapes + p->shape_b};
    if (p->flags & FE__PAIR_SWAPPED) v.a = world->shapes + p->shape_b, v.b = world->shapes + p->shape_a;
    v.form_a = v.a->form;
    v.origin = v.a->pose.position;
    v.rotation = fe__matrix(v.a->pose.rotation);
    v.relative.rotation = fe__matrix(fe__product(fe__conjugate(v.a->pose.rotation), v.b->pose.rotation));
    fe_dvec3 between = fe__dsub(v.b->pose.position, v.origin);
    if (v.form_a.type == FE_GEOMETRY_PLANE) {
        fe_dvec3 normal = fe__drotate(v.a->pose.rotation, fe__widen(v.form_a.normal));
        v.form_a.distance = (float)((double)v.form_a.distance - fe__ddot(normal, between));
        v.relative.position = fe__vec3(0.0f, 0.0f, 0.0f);
        v.origin = v.b->pose.position;
    } else if (fe__ddot(between, between) < NEAR * NEAR)
        v.relative.position = fe__mul_transposed(&v.rotation, fe__narrow(between));
    else
        v.relative.position = fe__narrow(fe__drotate_back(v.a->pose.rotation, between));
    return v;
}

static void copy3(float *out, fe_vec3 a) { out[0] = a.x, out[1] = a.y, out[2] = a.z; }

// impulses stay with the features that meet
static void match_impulses(fe__pair *p, fe__contact *m, const fe__manifold *found)
{
    float old[FE__POINTS];
    memcpy(old, m->normal_impulse, sizeof old);
    for (int i = 0; i < FE__POINTS; ++i) m->normal_impulse[i] = 0.0f;
    for (int i = 0; i < found->count; ++i)
        for (int j = 0; j < (int)m->normal[3]; ++j)
            if (p->ids[j] == found->points[i].id) m->normal_impulse[i] = old[j];
    for (int i = 0; i < found->count; ++i) p->ids[i] = found->points[i].id;
}

static void note_poses(fe__contact *m, const fe__body *a, const fe__body *b)
{
    memcpy(m->found_a, a->rotation, sizeof m->found_a);
    memcpy(m->found_b, b->rotation, sizeof m->found_b);
    for (int k = 0; k < 3; ++k) {
        double span = a->centre[k] - b->centre[k];
        m->found_span[k] = (float)span;
        m->found_low[k] = (float)(span - (double)m->found_span[k]);
        m->span[k] = a->type == FE_BODY_STATIC ? 0.0f : m->found_span[k];
    }
}

// points from A's frame to arms: from the centre of the solver's A, or of B when A is static (its centre may be far)
static void set_points(fe__contact *m, const view *v, const fe__manifold *found, const fe__body *a, const fe__body *b)
{
    const double *c = a->type == FE_BODY_STATIC ? b->centre : a->centre;
    fe_vec3 base = {(float)(v->origin.x - c[0]), (float)(v->origin.y - c[1]), (float)(v->origin.z - c[2])};
    float reach = 0.0f;
    for (int i = 0; i < FE__POINTS; ++i) {
        int there = i < found->count;
        fe_vec3 arm = there ? fe__add(base, fe__mul(&v->rotation, found->points[i].point)) : fe__vec3(0.0f, 0.0f, 0.0f);
        fe_vec3 arm_b = fe__add(arm, fe__vec3(m->span[0], m->span[1], m->span[2]));
        copy3(m->point[i], arm);
        m->point[i][3] = m->separation[i] = there ? found->points[i].separation : 0.0f;
        reach = fe__maxf(reach, fe__maxf(fe__dot(arm, arm), fe__dot(arm_b, arm_b)));
    }
    // without points, whatever part of the bodies may come near
    if (!found->count) reach = fe__maxf(a->local_centre[3] * a->local_centre[3], b->local_centre[3] * b->local_centre[3]);
    m->found_span[3] = sqrtf(reach);
}

// A pair without points need not be looked at until it may have moved through its gap.
static float tolerance(const view *v, const fe__manifold *found, float margin)
{
    if (!found->count) return fe__maxf(found->axis_separation - margin, 0.0f);
    if (v->a->form.radius > 0.0f || v->b->form.radius > 0.0f) return RECYCLE_ROUND;
    return fe__minf(RECYCLE_MOST, RECYCLE_SHARE * fe__minf(fe__form_thickness(&v->a->form), fe__form_thickness(&v->b->form)));
}

static void forget_impulses(fe__contact *m)
{
    for (int k = 0; k < FE__POINTS; ++k) m->normal_impulse[k] = m->friction_impulse[k] = m->total_impulse[k] = 0.0f;
}

void fe__collide_pair(fe_world *world, int32_t pair)
{
    fe__pair *p = world->pairs + pair;
    fe__contact *m = world->contacts + pair;
    const fe__body *a = world->bodies + m->body_a, *b = world->bodies + m->body_b;
    float margin = world->tuning.speculative_distance;
    view v = view_of(world, p);
    fe__manifold found = {.axis = p->axis, .axis_separation = p->axis_separation, .count = (int32_t)m->normal[3]};
    fe__collide(&v.form_a, &v.b->form, &v.relative, margin, &found);
    p->axis = found.axis, p->axis_separation = found.axis_separation;

    match_impulses(p, m, &found);
    if (!found.count) forget_impulses(m);
    // the manifold's normal points away from fe__collide's A; the solver's A may be the other one
    int32_t a_is_b = m->body_a != v.a->body;
    fe_vec3 normal = fe__mul(&v.rotation, found.normal);
    copy3(m->normal, a_is_b ? fe__neg(normal) : normal);
    m->normal[3] = (float)found.count;
    m->surface[1] = a_is_b ? v.b->form.radius : v.form_a.radius;
    m->surface[2] = a_is_b ? v.form_a.radius : v.b->form.radius;
    m->surface[3] = tolerance(&v, &found, margin);
    note_poses(m, a, b);
    set_points(m, &v, &found, a, b);
}
