// narrowphase.c - the narrow phase of one pair: two shapes, one manifold, one contact.
//
// Called by the collide stage on any thread, for pairs that cannot be recycled. Double positions are subtracted here,
// so that everything below is float and small. Only the pair's own records are written.
#define FE_W 4
#include "step/narrowphase.h"

#include "collision/form/clip.h"
#include "collision/form/flat.h"
#include "collision/form/form.h"
#include "collision/form/hull.h"
#include "collision/manifold/bridge.h"
#include "collision/manifold/collide.h"
#include "core/simd.h"
#include "step/load.h"
#include "step/stages.h"
#include "world/body.h"
#include "world/contact.h"
#include "world/encounter.h"

#include <float.h>
#include <string.h>

// ---- narrow seam ----------------------------------------------------------------------------------------------------
// Inner edges of a floor made of boxes or hulls.

// Where static boxes or hulls lie flush, an inner edge or face gives way to the face that is open. Of a pair with a
// static body
void fe__mend_seam(const fe_world *world, const fe__view *v, float margin, float fall, fe__manifold *found);

// ---- narrow ---------------------------------------------------------------------------------------------------------

// How far a pair may slide or turn before it needs a new manifold: at most this, m, and a share of the thinner form.
// Less for round forms and for edges side by side, whose normal turns with them.
#define RECYCLE_MOST 0.03f
#define RECYCLE_SHARE 0.1f
#define RECYCLE_ROUND 0.0005f
// of a rim that stands, whose points are where its load leans
#define RECYCLE_AIMED 0.03f

// Closer than this to each other, m, shapes are placed in floats: a float of it is a micrometre fine. Beyond (a wide
// ground) in double.
#define NEAR 16.0

static fe__mat3 rotation_between(fe_quat a, fe_quat b)
{
    const float least = FE__LEAST_LEAN;
    fe_quat q = fe__product(fe__conjugate(a), b);
    return fe__matrix(
        (fe_quat){fe__flush(q.x, least), fe__flush(q.y, least), fe__flush(q.z, least), fe__flush(q.w, least)});
}

// B in A's frame. A plane has no centre that matters: its frame is put at B, so that a plane is as exact a thousand
// kilometres off.
static void set_view(fe__view *v, const fe__shape *a, const fe__shape *b, const fe__pose *pose_a,
                     const fe__pose *pose_b)
{
    v->a = a, v->b = b, v->form_a = a->form;
    v->origin = pose_a->position;
    v->rotation = fe__matrix(pose_a->rotation);
    v->relative.rotation =
        fe__form_is_ball(&b->form) ? fe__matrix(fe__identity()) : rotation_between(pose_a->rotation, pose_b->rotation);
    fe_dvec3 between = fe__dsub(pose_b->position, pose_a->position);
    if (fe__form_is_unbounded(&a->form)) {
        fe__plane_move_frame(&v->form_a, pose_a->rotation, between);
        v->relative.position = fe__vec3(0.0f, 0.0f, 0.0f);
        v->origin = pose_b->position;
    } else if (fe__ddot(between, between) < NEAR * NEAR)
        v->relative.position = fe__mul_transposed(&v->rotation, fe__narrow(between));
    else
        v->relative.position = fe__narrow(fe__drotate_back(pose_a->rotation, between));
}

// ---- ahead of time -------------------------------------------------------------------------------------------------
// Contacts are made once per step. What will touch only later in the step needs its contact now, or it would be found a
// step late, up to v dt deep.

// speed = |v| + |w| reach; as in recycle.simd.c
static float speed_by_spin(const fe__body *body) { return body->speed - fe__length(fe__quad_vector(body->velocity)); }

// |vA - vB|, |vA| and |vB| side by side: three roots, one after the other, are what a pair would wait for longest
float fe__reach_in_step(const fe__step *step, const fe__body *a, const fe__body *b)
{
    wide va = *(const quad *)a->velocity, vb = *(const quad *)b->velocity;
    wide3 v = w_xyz(w_transpose(va - vb, va, vb, w_set(0.0f)));
    wide speed = w_sqrt(w_dot(v, v));
    return (speed[0] + (a->speed - speed[1]) + (b->speed - speed[2])) * step->dt + step->fall;
}

// The same along the normal from the solver's A to its B: while a gap along it stays open, they cannot touch
static float reach_along(const fe__step *step, const fe__body *a, const fe__body *b, fe_vec3 normal)
{
    fe_vec3 v = fe__sub(fe__quad_vector(a->velocity), fe__quad_vector(b->velocity));
    return (fe__maxf(fe__dot(normal, v), 0.0f) + speed_by_spin(a) + speed_by_spin(b)) * step->dt + step->fall;
}

typedef struct prediction {
    fe__view v;
    fe__places at;
    fe__manifold found;
} prediction;

// the manifold at out->at. `fall`: m, what gravity brings a body towards another one until then
static void predict_there(const fe__step *step, const fe__contact *m, const fe__view *v, float fall, prediction *out)
{
    const fe_world *world = step->world;
    const fe__body *a = world->bodies + m->body_a, *b = world->bodies + m->body_b;
    const fe__places *at = &out->at;
    int32_t a_is_b = m->body_a != v->a->body;
    fe__pose pose_a = a_is_b ? fe__shape_pose_at(b, v->a, at->centre_b, at->rotation_b)
                             : fe__shape_pose_at(a, v->a, at->centre_a, at->rotation_a);
    fe__pose pose_b = a_is_b ? fe__shape_pose_at(a, v->b, at->centre_a, at->rotation_a)
                             : fe__shape_pose_at(b, v->b, at->centre_b, at->rotation_b);
    set_view(&out->v, v->a, v->b, &pose_a, &pose_b);
    out->found.axis = -1, out->found.axis_separation = 0.0f, out->found.count = 0; // its points stay unwritten
    const fe__pair_load load = {{fe__tell_pair_load}, world, (int32_t)(m - world->contacts), at, &out->v};
    out->found.load = fe__load_chooses(&out->v) ? &load.asked : NULL;
    fe__collide(&out->v.form_a, &v->b->form, &out->v.relative, world->tuning.speculative_distance, &out->found);
    out->found.load = NULL; // it ends here
    if (a->type == FE_BODY_STATIC) fe__mend_seam(world, &out->v, world->tuning.speculative_distance, fall, &out->found);
}

static void predict(const fe__step *step, const fe__contact *m, const fe__view *v, float time, prediction *out)
{
    const fe_world *world = step->world;
    fe__advance(world, world->bodies + m->body_a, time, &out->at.centre_a, &out->at.rotation_a);
    fe__advance(world, world->bodies + m->body_b, time, &out->at.centre_b, &out->at.rotation_b);
    float share = time / step->dt; // fe__advance falls as one step of that length does
    predict_there(step, m, v, share * share * step->fall, out);
}

static float deepest_of(const fe__manifold *found)
{
    float deepest = found->points[0].separation;
    for (int32_t i = 1; i < found->count; ++i) deepest = fe__minf(deepest, found->points[i].separation);
    return deepest;
}

// The manifold of the poses at the end of the step, or, when they overlap there, of the poses on the way where they
// touch at the mean speed: the right features and normal for an impact, none for bodies that pass each other by. Deep
// in, features say nothing any more, and the nearest ones of now must do.
static int32_t look_ahead(const fe__step *step, const fe__contact *m, fe__view *v, fe__places *at, fe__manifold *found)
{
    prediction end, touch;
    predict(step, m, v, step->dt, &end);
    if (!end.found.count) return 0;
    float now = deepest_of(found), then = deepest_of(&end.found);
    if (now > 0.0f && then < 0.0f) {
        predict(step, m, v, step->dt * (now / (now - then)), &touch);
        if (touch.found.count) end = touch;
    }
    if (-deepest_of(&end.found) > fe__minf(fe__form_thickness(&v->a->form), fe__form_thickness(&v->b->form)) &&
        !fe__form_is_unbounded(&v->a->form))
        return found->count > 0;
    *v = end.v, *at = end.at, *found = end.found;
    return 1;
}

// What may outrun its thickness has its contact with a static or kinematic body where it touches first.
static int32_t look_far_ahead(const fe__step *step, const fe__contact *m, fe__view *v, fe__places *at,
                              fe__manifold *found)
{
    const fe_world *world = step->world;
    prediction touch;
    if (!fe__predict_touch(world, (int32_t)(m - world->contacts), step->dt, &touch.at)) return 0;
    predict_there(step, m, v, step->fall, &touch);
    if (!touch.found.count) return 0;
    *v = touch.v, *at = touch.at, *found = touch.found;
    return 1;
}

static void copy4(float *out, fe_quat q) { out[0] = q.x, out[1] = q.y, out[2] = q.z, out[3] = q.w; }

static void note_poses(fe__contact *m, const fe__places *at, const fe__body *a, const fe__body *b)
{
    copy4(m->found_a, at->rotation_a);
    copy4(m->found_b, at->rotation_b);
    fe_dvec3 span = fe__dsub(at->centre_a, at->centre_b), now = fe__dsub(fe__centre_of(a), fe__centre_of(b));
    fe__copy3(m->found_span, fe__narrow(span));
    fe__copy3(m->found_low, fe__narrow(fe__dsub(span, fe__widen(fe__quad_vector(m->found_span)))));
    // torques need no sum over both bodies where only B is moved: the arms of the touch
    fe_vec3 arms = a->type == FE_BODY_KINEMATIC ? fe__quad_vector(m->found_span) : fe__narrow(now);
    fe__copy3(m->span, a->type == FE_BODY_STATIC ? fe__vec3(0.0f, 0.0f, 0.0f) : arms);
}

// ---- points: a lane each -------------------------------------------------------------------------------------------
typedef float loose_quad __attribute__((vector_size(16), aligned(4), may_alias));
_Static_assert(offsetof(fe__manifold_point, separation) == offsetof(fe__manifold_point, point) + 12,
               "a point and its separation are loaded as one");
_Static_assert((int)FE_W == (int)FE__POINTS && (int)FE_W == (int)FE_MAX_POINTS, "a lane for each point");

static inline wide3 spread(fe_vec3 a) { return (wide3){w_set(a.x), w_set(a.y), w_set(a.z)}; }
static inline wide keep(wide_mask lanes, wide a) { return (wide)((wide_int)lanes & (wide_int)a); } // others are 0
static inline wide3 keep3(wide_mask lanes, wide3 a)
{
    return (wide3){keep(lanes, a.x), keep(lanes, a.y), keep(lanes, a.z)};
}
static inline wide3 turn(const fe__mat3 *m, wide3 a)
{
    return w_add_scaled(w_add_scaled(w_scale(a.x, spread(m->x)), a.y, spread(m->y)), a.z, spread(m->z));
}
// of one or more; the others are the first again
static inline wide4 load_points(const fe__manifold *found)
{
    const fe__manifold_point *p = found->points;
    const loose_quad *first = (const loose_quad *)p, *second = (const loose_quad *)(found->count > 1 ? p + 1 : p),
                     *third = (const loose_quad *)(found->count > 2 ? p + 2 : p),
                     *fourth = (const loose_quad *)(found->count > 3 ? p + 3 : p);
    return w_transpose(*first, *second, *third, *fourth);
}

static inline float sum_of(wide a) { return (a[0] + a[1]) + (a[2] + a[3]); }

static inline wide_int first_lanes(int32_t count) { return (wide_int){0, 1, 2, 3} < count; }

// What features bore that are gone is borne by those that are new, in equal parts
static wide hand_on(wide old, wide impulse, wide_int fresh, int old_count)
{
    int32_t count = -(fresh[0] + fresh[1] + fresh[2] + fresh[3]);
    float left = fe__maxf(sum_of(keep(first_lanes(old_count), old)) - sum_of(impulse), 0.0f);
    return count > 0 ? w_choose(fresh, w_set(left / (float)count), impulse) : impulse;
}

// Impulses stay with the features that meet, of one point or more. All are compared with all: which are the same no
// branch can guess
static void match_impulses(fe__points *q, fe__features *features, int old_count, const fe__manifold *found,
                           int32_t hands_on)
{
    const fe__manifold_point *p = found->points;
    int32_t last = found->count - 1;
    wide_int there = first_lanes(found->count), before, now, known = {0, 0, 0, 0};
    memcpy(&before, features->ids, sizeof before);
    for (int32_t i = 0; i < FE_W; ++i) now[i] = (int32_t)p[fe__mini(i, last)].id;
    wide old = *(const quad *)q->normal_impulse, impulse = w_set(0.0f);
    for (int32_t j = 0; j < FE_W; ++j) {
        wide_int same = (now == before[j]) & ((wide_int){0, 0, 0, 0} + j < old_count);
        impulse = w_choose(same, w_set(old[j]), impulse);
        known |= same;
    }
    impulse = keep(there, impulse);
    if (hands_on) impulse = hand_on(old, impulse, there & ~known, old_count);
    *(quad *)q->normal_impulse = impulse;
    now = (now & there) | (before & ~there);
    memcpy(features->ids, &now, sizeof now);
}

static inline float greatest(wide a) { return fe__maxf(fe__maxf(a[0], a[1]), fe__maxf(a[2], a[3])); }

// points from A's frame to arms: from the centre of the solver's A, or of B when A is static (its centre may be far)
static void set_points(fe__contact *m, fe__points *q, const fe__view *v, const fe__places *at,
                       const fe__manifold *found, const fe__body *a)
{
    int32_t is_static = a->type == FE_BODY_STATIC;
    wide3 base = spread(fe__narrow(fe__dsub(v->origin, is_static ? at->centre_b : at->centre_a)));
    wide3 span = is_static ? w_zero3() : spread(fe__quad_vector(m->found_span));
    wide_mask there = (wide_int){0, 1, 2, 3} < found->count;
    wide4 point = load_points(found);
    wide3 arm = keep3(there, w_add(base, turn(&v->rotation, w_xyz(point)))), arm_b = w_add(arm, span);
    // of a round side it is the core that rotates
    wide3 n = spread(fe__quad_vector(m->normal)), core_a = w_add_scaled(arm, w_set(-m->surface.radius_a), n),
          core_b = w_add_scaled(arm_b, w_set(m->surface.radius_b), n);
    wide surfaces = w_max(w_dot(arm, arm), w_dot(arm_b, arm_b)),
         cores = w_max(w_dot(core_a, core_a), w_dot(core_b, core_b));
    wide separation = keep(there, point.w);
    *(quad *)q->separation = separation;
    w_scatter(q->point[0].arm, sizeof *q->point / sizeof(float), w_in_order, w_with(arm, separation));
    m->longest_arm = sqrtf(greatest(w_max(surfaces, keep(there, cores))));
}

// A record that it has is zeros until it is released
static void set_no_points(fe__contact *m, fe__points *q, const fe__body *a, const fe__body *b)
{
    if (m->points) *q = (fe__points){.twist_impulse = 0.0f};
    for (int k = 0; k < 3; ++k) m->normal[k] = 0.0f;
    m->point_count = 0.0f;
    m->longest_arm = fe__maxf(a->reach, b->reach); // whatever part of the bodies may come near
}

void fe__drop_points(fe_world *world, int32_t pair)
{
    fe__contact *m = world->contacts + pair;
    world->pairs[pair].axis = -1;
    set_no_points(m, fe__points_of(world, m), world->bodies + m->body_a, world->bodies + m->body_b);
    m->surface.tolerance = 0.0f;
    fe__points_release(world, pair);
}

// Separations now of a manifold found ahead of time, along its normal: as in recycle.simd.c. Its arms stay those of the
// touch, and the turns from there to now take the place of the rotations.
static void step_back(fe__contact *m, fe__points *q, const fe__places *at, const fe__body *a, const fe__body *b)
{
    fe_quat turn_a = fe__product(fe__rotation_of(a), fe__conjugate(at->rotation_a)),
            turn_b = fe__product(fe__rotation_of(b), fe__conjugate(at->rotation_b));
    copy4(m->found_a, turn_a);
    copy4(m->found_b, turn_b);
    fe_vec3 n = fe__quad_vector(m->normal), zero = {0.0f, 0.0f, 0.0f};
    fe_vec3 na = fe__sub(fe__rotate_back(turn_a, n), n), nb = fe__sub(fe__rotate_back(turn_b, n), n),
            slope = fe__sub(nb, na);
    fe_dvec3 then = fe__dsub(at->centre_b, at->centre_a), now = fe__dsub(fe__centre_of(b), fe__centre_of(a));
    fe_vec3 span = a->type == FE_BODY_STATIC ? zero : fe__quad_vector(m->found_span);
    float constant = fe__dot(n, fe__narrow(fe__dsub(now, then))) + fe__dot(nb, span) +
                     m->surface.radius_a * fe__dot(na, n) + m->surface.radius_b * fe__dot(nb, n);
    for (int i = 0; i < (int)m->point_count; ++i)
        q->separation[i] = q->point[i].separation + constant + fe__dot(slope, fe__quad_vector(q->point[i].arm));
}

float fe__recycle_tolerance(const fe__view *v, int32_t left_out)
{
    int32_t is_round = fe__form_roundness(&v->a->form) > 0.0f || fe__form_roundness(&v->b->form) > 0.0f;
    if (is_round && left_out != FE_LEFT_REST) return RECYCLE_ROUND;
    float least = fe__minf(fe__form_thickness(&v->a->form), fe__form_thickness(&v->b->form));
    return fe__minf(RECYCLE_MOST, (is_round ? RECYCLE_AIMED : RECYCLE_SHARE) * least);
}

// A manifold's normal points away from fe__collide's A; the solver's A may be the other one. What leans so little
// against the world's axes that only rounding knows lies along them. Inlined: returned in halves, written and read
// again as one, three floats cost a stall.
FE_INLINE fe_vec3 solvers_normal(const fe__contact *m, const fe__view *v, fe_vec3 normal)
{
    fe_vec3 n = fe__mul(&v->rotation, normal);
    n = fe__vec3(fe__flush(n.x, FE__LEAST_LEAN), fe__flush(n.y, FE__LEAST_LEAN), fe__flush(n.z, FE__LEAST_LEAN));
    return m->body_a != v->a->body ? fe__neg(n) : n;
}

// and back
static fe_vec3 kernels_normal(const fe__contact *m, const fe__view *v)
{
    fe_vec3 n = fe__mul_transposed(&v->rotation, fe__quad_vector(m->normal));
    return m->body_a != v->a->body ? fe__neg(n) : n;
}

static void write_contact(fe__contact *m, const fe__view *v, const fe__manifold *found, int32_t a_is_b)
{
    fe__copy3(m->normal, solvers_normal(m, v, found->normal));
    m->point_count = (float)found->count;
    float pivot_a = fe__form_pivot(&v->form_a, found->normal),
          pivot_b = fe__form_pivot(&v->b->form, fe__mul_transposed(&v->relative.rotation, found->normal));
    m->surface.radius_a = a_is_b ? pivot_b : pivot_a;
    m->surface.radius_b = a_is_b ? pivot_a : pivot_b;
}

void fe__write_manifold(const fe_world *world, fe__contact *m, const fe__view *v, const fe__places *at,
                        const fe__manifold *found, int32_t ahead)
{
    const fe__body *a = world->bodies + m->body_a, *b = world->bodies + m->body_b;
    fe__points *q = fe__points_of(world, m);
    note_poses(m, at, a, b);
    if (!found->count) {
        set_no_points(m, q, a, b);
        return;
    }
    write_contact(m, v, found, m->body_a != v->a->body);
    set_points(m, q, v, at, found, a);
    if (ahead) step_back(m, q, at, a, b);
}

// A gap between two shapes without points: of two planes with this normal that have the shapes beyond them; without a
// normal, of the shapes
typedef struct gap {
    float distance; // m
    fe_vec3 normal; // unit, from fe__collide's A to its B, A's frame; or (0, 0, 0)
} gap;

// with points a kernel leaves the older axis_separation
static gap gap_of(const fe__view *v, const fe__manifold *found)
{
    if (!found->count) return (gap){found->axis_separation, found->normal};
    if (fe__form_is_unbounded(&v->form_a)) return (gap){deepest_of(found), found->normal};
    fe_vec3 n = found->normal, from_b = fe__neg(fe__mul_transposed(&v->relative.rotation, n));
    fe_vec3 on_a = fe__narrow(fe__form_support(&v->form_a, fe__widen(n))),
            on_b = fe__narrow(fe__form_support(&v->b->form, fe__widen(from_b)));
    on_b = fe__add(v->relative.position, fe__mul(&v->relative.rotation, on_b));
    return (gap){fe__dot(n, fe__sub(on_b, on_a)) - v->form_a.radius - v->b->form.radius, n};
}

static fe__places places_now(const fe__body *a, const fe__body *b)
{
    return (fe__places){fe__centre_of(a), fe__centre_of(b), fe__rotation_of(a), fe__rotation_of(b)};
}

void fe__write_apart(fe_world *world, int32_t pair, const fe__apart *apart)
{
    fe__pair *p = world->pairs + pair;
    fe__contact *m = world->contacts + pair;
    const fe__body *a = world->bodies + m->body_a, *b = world->bodies + m->body_b;
    const fe__shape *x = world->shapes + p->shape_a, *y = world->shapes + p->shape_b;
    const fe__places at = places_now(a, b);
    int32_t a_is_x = m->body_a == x->body;
    p->axis = -1; // a kernel's memory begins with the first points, whenever the pair was made: unrelated bodies must
                  // not matter
    p->axis_separation = apart->axis_separation;
    m->surface.tolerance = apart->slack;
    note_poses(m, &at, a, b);
    set_no_points(m, fe__points_of(world, m), a, b);
    fe__copy3(m->normal, apart->normal);
    // what turns the core turns the round layer about it nowhere else
    m->surface.radius_a = (a_is_x ? x : y)->arm, m->surface.radius_b = (a_is_x ? y : x)->arm;
}

// ---- one-way shapes ------------------------------------------------------------------------------------------------
// The least cosine between a one-way shape's direction and a normal that holds: 60 degrees, so that its edges do not
// catch what passes by
#define ONE_WAY_COSINE 0.5f

// The normal from the shape to what it meets
static int32_t holds(const fe__shape *shape, fe_vec3 outward)
{
    fe_vec3 direction = fe__rotate(shape->pose.rotation, shape->one_way);
    return fe__dot(direction, outward) >= ONE_WAY_COSINE * sqrtf(fe__dot(direction, direction));
}

static int32_t is_held(const fe__view *v, const fe__manifold *found)
{
    fe_vec3 normal = fe__mul(&v->rotation, found->normal); // from v->a to v->b
    return (!(v->a->flags & FE__SHAPE_ONE_WAY) || holds(v->a, normal)) &&
           (!(v->b->flags & FE__SHAPE_ONE_WAY) || holds(v->b, fe__neg(normal)));
}

typedef enum sides { HOLDS, UNDECIDED, PASSES } sides;

// What a one-way shape does with the other. Decided where they first meet, by the side; what passes goes on until they
// are apart. What passes a part of a compound passes all that it meets in the meantime.
static sides sides_of(const fe_world *world, int32_t pair, int32_t passing, const fe__view *v,
                      const fe__manifold *found)
{
    const fe__pair *p = world->pairs + pair;
    if (!((v->a->flags | v->b->flags) & FE__SHAPE_ONE_WAY)) return HOLDS;
    if (passing) return PASSES;
    if (!found->count || p->flags & FE__PAIR_LINKED) return HOLDS;
    const fe__encounter *e = p->flags & FE__PAIR_OF_PARTS ? fe__encounter_of(world, pair) : NULL;
    if (!(e && e->passing) && is_held(v, found)) return HOLDS;
    return e && e->held && !e->passing ? UNDECIDED : PASSES; // what other parts hold may yet come to lie on this one
}

// some way off now, but closing within the step: the normal may turn on that way
static int32_t may_touch_from_afar(const fe__step *step, const fe__pair *p, const fe__contact *m, const fe__view *v,
                                   const fe__manifold *found)
{
    const fe__body *bodies = step->world->bodies;
    if (!found->count || p->flags & FE__PAIR_SENSOR) return 0;
    float gap = deepest_of(found);
    if (gap <= FE__TURNS_LITTLE) return 0;
    fe_vec3 normal = solvers_normal(m, v, found->normal);
    return gap <= reach_along(step, bodies + m->body_a, bodies + m->body_b, normal);
}

// Against what is static or kinematic, its thickness or the other's
static int32_t may_outrun(const fe__body *a, const fe__shape *x, const fe__shape *y, float reach)
{
    return a->type != FE_BODY_DYNAMIC && reach > fe__minf(fe__form_thickness(&x->form), fe__form_thickness(&y->form));
}

// Does what the old points bore act along the same normal? The features of what has a rim change with the least turn,
// from a line to a point and back, and a heap that loses its load with each of them never sleeps
static int32_t hands_on(const fe__contact *m, const fe__view *v, const fe__manifold *found)
{
    const float same_way = 0.98f; // cos 11.5 degrees
    if (!(fe__form_is_curved(&v->a->form) || fe__form_is_curved(&v->b->form))) return 0;
    return fe__dot(fe__quad_vector(m->normal), solvers_normal(m, v, found->normal)) > same_way;
}

static int32_t tell_apart(fe_world *world, int32_t pair, const fe__apart *apart, fe__apart *out)
{
    if (out)
        *out = *apart;
    else
        fe__write_apart(world, pair, apart);
    return 1;
}

// 1: it is apart, and how is told. 0: it has points. `apart`: NULL: the pair is written, of which the flags are read by
// others meanwhile
static int32_t collide(const fe__step *step, int32_t pair, fe__apart *apart, int32_t *out_changes_sides)
{
    fe_world *world = step->world;
    fe__pair *p = world->pairs + pair;
    fe__contact *m = world->contacts + pair;
    const fe__body *a = world->bodies + m->body_a, *b = world->bodies + m->body_b;
    const fe__shape *x = world->shapes + p->shape_a, *y = world->shapes + p->shape_b;
    float margin = world->tuning.speculative_distance, reach = fe__reach_in_step(step, a, b);
    fe__places at = places_now(a, b);
    fe__view v;
    int32_t ahead = 0, passed = (p->flags & FE__PAIR_PASSING) != 0;
    if (p->flags & FE__PAIR_SWAPPED)
        set_view(&v, y, x, &y->pose, &x->pose);
    else
        set_view(&v, x, y, &x->pose, &y->pose);
    fe__manifold found; // its points stay unwritten
    found.axis = p->axis, found.axis_separation = p->axis_separation, found.count = (int32_t)m->point_count;
    if (p->axis >= 0) found.last = kernels_normal(m, &v);
    const fe__pair_load load = {{fe__tell_pair_load}, world, pair, &at, &v};
    found.load = fe__load_chooses(&v) ? &load.asked : NULL;
    fe__collide(&v.form_a, &v.b->form, &v.relative, fe__maxf(margin, reach), &found);
    int32_t passing = passed && found.count; // a seam may take points away from what passes
    if (a->type == FE_BODY_STATIC) fe__mend_seam(world, &v, fe__maxf(margin, reach), 0.0f, &found);
    int32_t axis = found.axis;
    float axis_separation = found.axis_separation;
    sides sides = p->flags & FE__PAIR_DENIED ? HOLDS : sides_of(world, pair, passing, &v, &found);
    *out_changes_sides = passed != (sides == PASSES);
    if (p->flags & FE__PAIR_DENIED || sides != HOLDS)
        return tell_apart(world, pair, &(fe__apart){.axis_separation = axis_separation}, apart);

    int32_t near = found.count && deepest_of(&found) <= margin;
    if (near && apart) return 0;
    if (may_touch_from_afar(step, p, m, &v, &found)) {
        int32_t fast = may_outrun(a, x, y, reach);
        if (fast && apart) return 0;
        ahead = (fast ? look_far_ahead : look_ahead)(step, m, &v, &at, &found);
    }
    if (ahead && apart) return 0;
    if (!ahead && !near) {
        gap left = gap_of(&v, &found);
        const fe__apart now = {axis_separation, fe__slack(left.distance, margin), solvers_normal(m, &v, left.normal)};
        return tell_apart(world, pair, &now, apart);
    }
    p->axis_separation = axis_separation;
    p->axis = axis;
    p->left_out = (uint8_t)found.left_out;
    if (!m->points) fe__points_take(world, pair);
    match_impulses(fe__points_of(world, m), world->features + m->points, (int)m->point_count, &found,
                   hands_on(m, &v, &found));
    float tolerance = fe__recycle_tolerance(&v, found.left_out);
    if (found.round) tolerance = fe__minf(tolerance, RECYCLE_ROUND);
    m->surface.tolerance = ahead ? FE__AHEAD : tolerance;
    fe__write_manifold(world, m, &v, &at, &found, ahead);
    return 0;
}

int32_t fe__collide_pair(const fe__step *step, int32_t pair)
{
    int32_t changes_sides;
    collide(step, pair, NULL, &changes_sides);
    return changes_sides;
}

int32_t fe__collide_apart(const fe__step *step, int32_t pair, fe__apart *out_apart)
{
    const fe__pair *p = step->world->pairs + pair;
    const fe__shape *shapes = step->world->shapes;
    int32_t changes_sides; // of one-way shapes
    if ((shapes[p->shape_a].flags | shapes[p->shape_b].flags) & FE__SHAPE_ONE_WAY) return 0;
    return collide(step, pair, out_apart, &changes_sides);
}

// ---- narrow seam ----------------------------------------------------------------------------------------------------
// Static boxes and hulls that lie flush: what rolls or slides over the seam must not feel the edge of
// the next one.
//
// Called by narrowphase.c with a manifold of a static box or hull. A direction m of contact at a point q of it holds
// only while no other such solid near the same body goes on from q and rises along m: it must lie in the normal cone of
// both (as in terrain_surface.h). A manifold whose points all fail is exchanged for that of the face that the
// surroundings allow, which may have no points.

enum { SEAM_ID = 0x20000000 };

typedef struct seam {
    fe__solid solid;
    fe__surroundings around;
    fe__solid other;    // what touches the solid: any form
    float margin, fall; // m; see fe__terrain
} seam;

static int32_t ground_shuts(const seam *s, const fe__neighbour *n, fe_vec3 q, fe_vec3 m, fe_vec3 off)
{
    fe__solid_rim rim = {fe__dadd(n->position, fe__widen(fe__mul_transposed(&n->axes, q))),
                         fe__widen(fe__mul_transposed(&n->axes, fe__sub(off, q))),
                         fe__dadd(n->position, fe__widen(fe__mul_transposed(&n->axes, s->other.centre)))};
    return fe__ground_rises_at(&n->ground, &rim, fe__widen(fe__mul_transposed(&n->axes, m)), (double)FE__FLUSH);
}

// Is the body carried over to another face of the solid from across a gap? Not where its middle lies too deep already,
// as it does below most faces
static int32_t gap_shuts(const seam *s, fe_vec3 q, fe_vec3 m, float separation)
{
    const fe__crossing crossing = {.body = s->other, .around = &s->around, .fall = s->fall};
    const float beside = 0.01f; // cosine
    const float least = s->other.form->radius - fe__most_below(&crossing);
    fe_vec3 middle = fe__mul_transposed(&s->solid.axes, fe__sub(fe__solid_middle(&s->other), s->solid.centre));
    for (int32_t face = -1; (face = fe__solid_face_below(&s->solid, face + 1, middle, least)) >= 0;) {
        fe_vec3 f = fe__solid_normal(&s->solid, face);
        if (fe__dot(f, m) < -beside || fe__is_along_face(m, f)) continue;
        fe_vec3 on_face = fe__add_scaled(q, fe__solid_height(&s->solid, face) - fe__dot(f, q), f);
        if (fe__is_carried_over(&crossing, on_face, f, &q, separation)) return 1;
    }
    return 0;
}

static int32_t is_shut(const seam *s, fe_vec3 q, fe_vec3 m, float separation)
{
    fe_vec3 off = fe__solid_off_rim(&s->solid, q, m);
    for (int32_t i = 0; i < s->around.solid_count; ++i)
        if (fe__solid_goes_on(s->around.solids + i, off, m)) return 1;
    for (int32_t i = 0; i < s->around.ground_count; ++i)
        if (ground_shuts(s, s->around.grounds + i, q, m, off)) return 1;
    return gap_shuts(s, q, m, separation);
}

static int32_t all_shut(const seam *s, const fe_vec3 *q, const fe__manifold *found, fe_vec3 m)
{
    for (int32_t i = 0; i < found->count; ++i)
        if (!is_shut(s, q[i], m, found->points[i].separation)) return 0;
    return 1;
}

// ---- the face instead ----------------------------------------------------------------------------------------------
static void face_of(const fe__solid *p, fe_vec3 direction, fe__face *face)
{
    fe__form_face(p->form, fe__mul_transposed(&p->axes, direction), face);
    for (int32_t i = 0; i < face->count; ++i) face->vertex[i] = fe__add(p->centre, fe__mul(&p->axes, face->vertex[i]));
}

static float height_over(const seam *s, fe_vec3 f, float top)
{
    fe__face face;
    face_of(&s->other, fe__neg(f), &face);
    float low = FLT_MAX;
    for (int32_t i = 0; i < face.count; ++i) low = fe__minf(low, fe__dot(f, face.vertex[i]));
    return low - top - s->other.form->radius;
}

static void project(const fe__face *face, fe_vec3 origin, const fe__mat3 *frame, fe__clip_vertex *out)
{
    for (int32_t i = 0; i < face->count; ++i) {
        fe_vec3 p = fe__mul_transposed(frame, fe__sub(face->vertex[i], origin));
        out[i] = (fe__clip_vertex){p.x, p.y, p.z, fe__clip_id(i > 0 ? i - 1 : face->count - 1, i)};
    }
}

// The other's feature over the face with normal f. `sign`: -1 when the manifold's A is the other.
static void touch_face(const seam *s, fe_vec3 f, float sign, fe__manifold *found)
{
    fe__face reference, incident;
    face_of(&s->solid, f, &reference);
    face_of(&s->other, fe__neg(f), &incident);
    fe_vec3 edge = fe__sub(reference.vertex[1], reference.vertex[0]), u = fe__scale(1.0f / fe__length(edge), edge);
    fe__mat3 frame = {u, fe__cross(f, u), f};
    fe__clip_vertex side[FE_FACE_VERTICES], vertex[FE_CLIP_VERTICES];
    project(&reference, reference.vertex[0], &frame, side);
    project(&incident, reference.vertex[0], &frame, vertex);
    // what is over a gap that counts as flush is over both faces, or it would be over none
    const float slack = FE__FLUSH, tie = 5e-5f; // m
    int32_t count = fe__clip_polygon(side, reference.count, vertex, incident.count, slack);
    found->count = fe__keep_near(vertex, count, s->other.form->radius, s->margin, tie, NULL, NULL);
    if (found->count) found->normal = fe__scale(sign, f);
    for (int32_t i = 0; i < found->count; ++i) {
        fe_vec3 p = fe__add_scaled(fe__add_scaled(reference.vertex[0], vertex[i].u, frame.x), vertex[i].v, frame.y);
        found->points[i] = (fe__manifold_point){fe__add_scaled(p, 0.5f * vertex[i].height, f), vertex[i].height,
                                                (uint32_t)SEAM_ID | (incident.id & 0xff) << 16 | vertex[i].id};
    }
}

static void take_open_face(const seam *s, const fe_vec3 *q, fe_vec3 m, float sign, fe__manifold *found)
{
    const float none = -fe__form_thickness(s->other.form); // what is deeper did not come over that face
    float most = none;
    fe_vec3 best = m;
    for (int32_t face = 0; face < fe__solid_face_count(&s->solid); ++face) {
        fe_vec3 f = fe__solid_normal(&s->solid, face);
        const float level = -0.01f; // cosine: not against what was found
        if (fe__dot(f, m) < level) continue;
        float height = height_over(s, f, fe__solid_height(&s->solid, face));
        if (height <= most || all_shut(s, q, found, f)) continue;
        most = height, best = f;
    }
    found->count = 0;
    found->axis = -1;
    found->axis_separation = 0.0f; // look again in the next step
    found->normal = fe__vec3(0.0f, 0.0f, 0.0f);
    if (most > none && most <= s->margin) touch_face(s, best, sign, found);
}

// What of the solid the point stands for. Of an edge touched askew, a point some way off may lie beside it: under a
// ground, which has no inside.
static fe_vec3 touched(const seam *s, const fe__manifold_point *p, fe_vec3 m)
{
    fe_vec3 q = fe__solid_draw_in(&s->solid, fe__add_scaled(p->point, -0.5f * p->separation, m));
    enum { TURNS = 4 }; // to the edge and back into the solid: each leaves sin^2 of the normal's lean of the way
    for (int32_t i = 0; s->around.ground_count && i < TURNS; ++i)
        q = fe__solid_draw_in(&s->solid, fe__solid_raise(&s->solid, q, m, fe__absf(p->separation)));
    return q;
}

void fe__mend_seam(const fe_world *world, const fe__view *v, float margin, float fall, fe__manifold *found)
{
    int32_t solid_is_a = fe__is_static_solid(world, v->a);
    const fe__shape *solid = solid_is_a ? v->a : v->b, *other = solid_is_a ? v->b : v->a;
    if (!found->count || !fe__is_static_solid(world, solid) || world->bodies[other->body].static_pairs < 2) return;
    seam s; // the numbers of what is around say how many are written
    s.margin = margin, s.fall = fall;
    fe__solid a = {.form = &v->a->form, .axes = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}}};
    fe__solid b = {.form = &v->b->form, .centre = v->relative.position, .axes = v->relative.rotation};
    s.solid = solid_is_a ? a : b, s.other = solid_is_a ? b : a;
    fe__find_surroundings(world, v, solid, other, fe__solid_middle(&s.other), &s.around);
    if (!(s.around.solid_count | s.around.ground_count)) return;
    float sign = solid_is_a ? 1.0f : -1.0f;
    fe_vec3 m = fe__scale(sign, found->normal), q[FE_MAX_POINTS];
    for (int32_t i = 0; i < found->count; ++i) q[i] = touched(&s, found->points + i, m);
    if (all_shut(&s, q, found, m)) take_open_face(&s, q, m, sign, found);
}

// ---- surroundings ---------------------------------------------------------------------------------------------------

int32_t fe__is_static_solid(const fe_world *w, const fe__shape *shape)
{
    return fe__form_is_solid(&shape->form) && w->bodies[shape->body].type == FE_BODY_STATIC &&
           !(shape->flags & FE__SHAPE_TRIGGER);
}

static fe__mat3 axes_of(const fe__view *v, const fe__shape *shape)
{
    fe__mat3 r = fe__matrix(shape->pose.rotation);
    return (fe__mat3){fe__mul_transposed(&v->rotation, r.x), fe__mul_transposed(&v->rotation, r.y),
                      fe__mul_transposed(&v->rotation, r.z)};
}

static fe__solid place_solid(const fe__view *v, const fe__shape *shape)
{
    return (fe__solid){&shape->form,
                       fe__mul_transposed(&v->rotation, fe__narrow(fe__dsub(shape->pose.position, v->origin))),
                       axes_of(v, shape)};
}

static fe__neighbour place_ground(const fe_world *w, const fe__view *v, const fe__shape *shape)
{
    return (fe__neighbour){fe__store_ground(w->store, &shape->form),
                           fe__drotate_back(shape->pose.rotation, fe__dsub(v->origin, shape->pose.position)),
                           axes_of(v, shape)};
}

// ---- the nearest ---------------------------------------------------------------------------------------------------
static float beyond(float x, float low, float high) { return fe__maxf(fe__maxf(low - x, x - high), 0.0f); }

// of a point from a box, m2
static float distance_from(fe_vec3 low, fe_vec3 high, fe_vec3 p)
{
    fe_vec3 away = {beyond(p.x, low.x, high.x), beyond(p.y, low.y, high.y), beyond(p.z, low.z, high.z)};
    return fe__dot(away, away);
}

static float distance_of_solid(const fe__solid *s, fe_vec3 centre)
{
    const fe__form *f = s->form;
    fe_vec3 p = fe__mul_transposed(&s->axes, fe__sub(centre, s->centre));
    if (!fe__form_is_hull(f)) return distance_from(fe__neg(f->half), f->half, p);
    return distance_from(fe__add_scaled(f->offset, f->scale, f->hull->low),
                         fe__add_scaled(f->offset, f->scale, f->hull->high), p);
}

static float distance_of_ground(const fe__neighbour *n, fe_vec3 centre)
{
    fe__bounds box = fe__ground_bounds(&n->ground);
    fe_dvec3 p = fe__dadd(n->position, fe__widen(fe__mul_transposed(&n->axes, centre)));
    return distance_from(fe__narrow(fe__dsub(box.low, p)), fe__narrow(fe__dsub(box.high, p)),
                         (fe_vec3){0.0f, 0.0f, 0.0f});
}

// Where the next one goes among at most `most`, of which the farthest makes room. -1: it is no nearer
static int32_t place_for(float distance, float *distances, int32_t *count, int32_t most)
{
    int32_t place = *count;
    if (*count < most)
        ++*count;
    else {
        place = 0;
        for (int32_t i = 1; i < most; ++i)
            if (distances[i] > distances[place]) place = i;
        if (distance >= distances[place]) return -1;
    }
    distances[place] = distance;
    return place;
}

// How far off is what may hold a body up? What is round is held from as far beyond its lowest point as the rim that it
// touches lies on this side. m2
static float farthest_that_holds(const fe__form *form)
{
    const float wide = 2.0f;
    float reach = wide * fe__form_reach(form, fe__form_middle(form));
    return reach * reach;
}

void fe__find_surroundings(const fe_world *w, const fe__view *v, const fe__shape *self, const fe__shape *other,
                           fe_vec3 centre, fe__surroundings *found)
{
    float most = -1.0f; // m2, asked for once something is there: of a hull that is a walk of its vertices
    float grounds[FE__NEIGHBOURS], solids[FE__NEAR_SOLIDS]; // their distances, m2
    found->ground_count = found->solid_count = 0;
    for (int32_t pair = w->bodies[other->body].first_contact; pair >= 0; pair = fe__next_pair(w, pair, other->body)) {
        const fe__pair *p = w->pairs + pair;
        const fe__shape *x = w->shapes + p->shape_a, *y = w->shapes + p->shape_b, *near = x == other ? y : x;
        if (p->flags & FE__PAIR_PATCH || near == self || (x != other && y != other)) continue;
        int32_t is_ground = p->next_patch >= 0;
        if (!is_ground && !fe__is_static_solid(w, near)) continue;
        if (most < 0.0f) most = farthest_that_holds(&other->form);
        if (is_ground) {
            fe__neighbour n = place_ground(w, v, near);
            float distance = distance_of_ground(&n, centre);
            int32_t place = distance > most ? -1 : place_for(distance, grounds, &found->ground_count, FE__NEIGHBOURS);
            if (place >= 0) found->grounds[place] = n;
        } else {
            fe__solid s = place_solid(v, near);
            float distance = distance_of_solid(&s, centre);
            int32_t place = distance > most ? -1 : place_for(distance, solids, &found->solid_count, FE__NEAR_SOLIDS);
            if (place >= 0) found->solids[place] = s;
        }
    }
}
