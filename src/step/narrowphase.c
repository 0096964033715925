// narrowphase.c - the narrow phase of one pair: two shapes, one manifold, one contact.
//
// Called by the collide stage on any thread, for pairs that cannot be recycled. Double positions are subtracted here,
// so that everything below is float and small. Only the pair's own records are written: the solver reads them.
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

// ---- neighbours of a static solid -----------------------------------------------------------------------------------
// The static boxes, hulls, meshes and heightfields near a body that touches one of them.

static int32_t is_static_solid(const fe_world *world, const fe__shape *shape)
{
    return fe__form_is_solid(&shape->form) && world->bodies[shape->body].type == FE_BODY_STATIC &&
           !(shape->flags & FE__SHAPE_TRIGGER);
}

static fe__mat3 axes_in_view(const fe__view *v, const fe__shape *shape)
{
    fe__mat3 r = fe__matrix(shape->pose.rotation);
    return (fe__mat3){fe__mul_transposed(&v->rotation, r.x), fe__mul_transposed(&v->rotation, r.y),
                      fe__mul_transposed(&v->rotation, r.z)};
}

// Square of the distance of a point from a box, m2.
static float square_from_box(fe_vec3 low, fe_vec3 high, fe_vec3 p)
{
    fe_vec3 away = {fe__maxf(fe__maxf(low.x - p.x, p.x - high.x), 0.0f),
                    fe__maxf(fe__maxf(low.y - p.y, p.y - high.y), 0.0f),
                    fe__maxf(fe__maxf(low.z - p.z, p.z - high.z), 0.0f)};
    return fe__dot(away, away);
}

static float square_from_solid(const fe__solid *solid, fe_vec3 centre)
{
    const fe__form *form = solid->form;
    fe_vec3 p = fe__mul_transposed(&solid->axes, fe__sub(centre, solid->centre));
    if (!fe__form_is_hull(form)) return square_from_box(fe__neg(form->half), form->half, p);
    return square_from_box(fe__add_scaled(form->offset, form->scale, form->hull->low),
                           fe__add_scaled(form->offset, form->scale, form->hull->high), p);
}

static float square_from_ground(const fe__neighbour *ground, fe_vec3 centre)
{
    fe__bounds box = fe__ground_bounds(&ground->ground);
    fe_dvec3 p = fe__dadd(ground->position, fe__widen(fe__mul_transposed(&ground->axes, centre)));
    return square_from_box(fe__narrow(fe__dsub(box.low, p)), fe__narrow(fe__dsub(box.high, p)),
                           (fe_vec3){0.0f, 0.0f, 0.0f});
}

// Returns the place of a new neighbour among the nearest `capacity`, whose farthest it may replace. -1: it is no nearer
static int32_t place_among_nearest(float square, float *squares, int32_t *count, int32_t capacity)
{
    int32_t place = *count;
    if (*count < capacity) {
        ++*count;
    } else {
        place = 0;
        for (int32_t i = 1; i < capacity; ++i)
            if (squares[i] > squares[place]) place = i;
        if (square >= squares[place]) return -1;
    }
    squares[place] = square;
    return place;
}

void fe__find_surroundings(const fe_world *world, const fe__view *v, const fe__shape *self, const fe__shape *other,
                           fe_vec3 centre, fe__surroundings *found)
{
    const float wide = 2.0f;
    float most = -1.0f; // m2, computed once something is there: for a hull that is a walk of its vertices
    float ground_squares[FE__NEIGHBOURS], solid_squares[FE__NEAR_SOLIDS];
    found->ground_count = found->solid_count = 0;
    for (int32_t pair = world->bodies[other->body].first_contact; pair >= 0;
         pair = fe__next_pair(world, pair, other->body)) {
        const fe__pair *p = world->pairs + pair;
        const fe__shape *a = world->shapes + p->shape_a, *b = world->shapes + p->shape_b, *near = a == other ? b : a;
        if (p->flags & FE__PAIR_PATCH || near == self || (a != other && b != other)) continue;
        int32_t is_ground = p->next_patch >= 0;
        if (!is_ground && !is_static_solid(world, near)) continue;
        if (most < 0.0f) {
            // A round form is held up from as far beyond its lowest point as the rim that it touches lies on this side.
            float reach = wide * fe__form_reach(&other->form, fe__form_middle(&other->form));
            most = reach * reach;
        }
        fe__mat3 axes = axes_in_view(v, near);
        if (is_ground) {
            fe_dvec3 position = fe__drotate_back(near->pose.rotation, fe__dsub(v->origin, near->pose.position));
            fe__neighbour ground = {fe__store_ground(world->store, &near->form), position, axes};
            float square = square_from_ground(&ground, centre);
            if (square > most) continue;
            int32_t place = place_among_nearest(square, ground_squares, &found->ground_count, FE__NEIGHBOURS);
            if (place >= 0) found->grounds[place] = ground;
        } else {
            fe_vec3 position = fe__mul_transposed(&v->rotation, fe__narrow(fe__dsub(near->pose.position, v->origin)));
            fe__solid solid = {&near->form, position, axes};
            float square = square_from_solid(&solid, centre);
            if (square > most) continue;
            int32_t place = place_among_nearest(square, solid_squares, &found->solid_count, FE__NEAR_SOLIDS);
            if (place >= 0) found->solids[place] = solid;
        }
    }
}

// ---- internal edges -------------------------------------------------------------------------------------------------
// A body that rolls or slides over static boxes and hulls that lie flush must not feel the edges between them.
//
// A direction m of contact at a point q of such a solid holds only while no other solid near the same body goes on from
// q and rises along m: it must lie in the normal cone of both (as in terrain_surface.h). Where one does, the direction
// is shut. A manifold whose points are all shut is exchanged for that of the face that the neighbours leave open, which
// may have no points.

enum { SEAM_ID = 0x20000000 };

typedef struct seam {
    fe__solid solid;
    fe__surroundings around;
    fe__solid other;    // the form that touches the solid, of any kind
    float margin, fall; // m; see fe__terrain
} seam;

static int32_t is_shut(const seam *s, fe_vec3 q, fe_vec3 m, float separation)
{
    fe_vec3 off = fe__solid_off_rim(&s->solid, q, m);
    for (int32_t i = 0; i < s->around.solid_count; ++i)
        if (fe__solid_goes_on(s->around.solids + i, off, m)) return 1;
    for (int32_t i = 0; i < s->around.ground_count; ++i) {
        const fe__neighbour *n = s->around.grounds + i;
        fe__solid_rim rim = {fe__dadd(n->position, fe__widen(fe__mul_transposed(&n->axes, q))),
                             fe__widen(fe__mul_transposed(&n->axes, fe__sub(off, q))),
                             fe__dadd(n->position, fe__widen(fe__mul_transposed(&n->axes, s->other.centre)))};
        fe_dvec3 up = fe__widen(fe__mul_transposed(&n->axes, m));
        if (fe__ground_rises_at(&n->ground, &rim, up, (double)FE__FLUSH)) return 1;
    }
    // The body may be carried over to another face of the solid from across a gap. Not where its middle lies too deep
    // already, as it does below most faces.
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

static int32_t all_shut(const seam *s, const fe_vec3 *q, const fe__manifold *found, fe_vec3 m)
{
    for (int32_t i = 0; i < found->count; ++i)
        if (!is_shut(s, q[i], m, found->points[i].separation)) return 0;
    return 1;
}

static void get_face(const fe__solid *solid, fe_vec3 direction, fe__face *face)
{
    fe__form_face(solid->form, fe__mul_transposed(&solid->axes, direction), face);
    for (int32_t i = 0; i < face->count; ++i)
        face->vertex[i] = fe__add(solid->centre, fe__mul(&solid->axes, face->vertex[i]));
}

static void project_face(const fe__face *face, fe_vec3 origin, const fe__mat3 *frame, fe__clip_vertex *out)
{
    for (int32_t i = 0; i < face->count; ++i) {
        fe_vec3 p = fe__mul_transposed(frame, fe__sub(face->vertex[i], origin));
        out[i] = (fe__clip_vertex){p.x, p.y, p.z, fe__clip_id(i > 0 ? i - 1 : face->count - 1, i)};
    }
}

// Clips the other's feature to the face with the normal f. `sign`: -1 when the manifold's A is the other
static void collide_with_face(const seam *s, fe_vec3 f, float sign, fe__manifold *found)
{
    fe__face reference, incident;
    get_face(&s->solid, f, &reference);
    get_face(&s->other, fe__neg(f), &incident);
    fe_vec3 edge = fe__sub(reference.vertex[1], reference.vertex[0]), u = fe__scale(1.0f / fe__length(edge), edge);
    fe__mat3 frame = {u, fe__cross(f, u), f};
    fe__clip_vertex side[FE_FACE_VERTICES], vertex[FE_CLIP_VERTICES];
    project_face(&reference, reference.vertex[0], &frame, side);
    project_face(&incident, reference.vertex[0], &frame, vertex);
    // a point over a gap that counts as flush is over both faces, or it would be over none
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

// Takes the open face over which the other is highest, of those that are not against the direction found.
static void collide_with_open_face(const seam *s, const fe_vec3 *q, fe_vec3 m, float sign, fe__manifold *found)
{
    const float level = -0.01f;                            // cosine between face and direction found
    const float none = -fe__form_thickness(s->other.form); // a form that is deeper did not come over that face
    float most = none;
    fe_vec3 best = m;
    for (int32_t i = 0; i < fe__solid_face_count(&s->solid); ++i) {
        fe_vec3 f = fe__solid_normal(&s->solid, i);
        if (fe__dot(f, m) < level) continue;
        fe__face face;
        get_face(&s->other, fe__neg(f), &face);
        float low = FLT_MAX;
        for (int32_t k = 0; k < face.count; ++k) low = fe__minf(low, fe__dot(f, face.vertex[k]));
        float height = low - fe__solid_height(&s->solid, i) - s->other.form->radius;
        if (height <= most || all_shut(s, q, found, f)) continue;
        most = height, best = f;
    }
    found->count = 0;
    found->axis = -1;
    found->axis_separation = 0.0f; // looked for again in the next step
    found->normal = fe__vec3(0.0f, 0.0f, 0.0f);
    if (most > none && most <= s->margin) collide_with_face(s, best, sign, found);
}

// Exchanges a manifold on an internal edge or face for that of the face that is open. For pairs with a static body.
static void correct_internal_edges(const fe_world *world, const fe__view *v, float margin, float fall,
                                   fe__manifold *found)
{
    enum { TURNS = 4 }; // to the edge and back into the solid: each leaves sin^2 of the normal's lean of the way
    int32_t solid_is_a = is_static_solid(world, v->a);
    const fe__shape *solid = solid_is_a ? v->a : v->b, *other = solid_is_a ? v->b : v->a;
    if (!found->count || !is_static_solid(world, solid) || world->bodies[other->body].static_pairs < 2) return;
    seam s; // not zeroed: the counts of its neighbours say how many are written
    s.margin = margin, s.fall = fall;
    fe__solid a = {.form = &v->a->form, .axes = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}}};
    fe__solid b = {.form = &v->b->form, .centre = v->relative.position, .axes = v->relative.rotation};
    s.solid = solid_is_a ? a : b, s.other = solid_is_a ? b : a;
    fe__find_surroundings(world, v, solid, other, fe__solid_middle(&s.other), &s.around);
    if (!(s.around.solid_count | s.around.ground_count)) return;
    float sign = solid_is_a ? 1.0f : -1.0f;
    fe_vec3 m = fe__scale(sign, found->normal), q[FE_MAX_POINTS];
    for (int32_t i = 0; i < found->count; ++i) {
        const fe__manifold_point *p = found->points + i;
        q[i] = fe__solid_draw_in(&s.solid, fe__add_scaled(p->point, -0.5f * p->separation, m));
        // On an edge touched askew, a point some way off may lie beside it: under a ground, which has no inside.
        for (int32_t k = 0; s.around.ground_count && k < TURNS; ++k)
            q[i] = fe__solid_draw_in(&s.solid, fe__solid_raise(&s.solid, q[i], m, fe__absf(p->separation)));
    }
    if (all_shut(&s, q, found, m)) collide_with_open_face(&s, q, m, sign, found);
}

// ---- pair view ------------------------------------------------------------------------------------------------------

// Closer than this to each other, m, shapes are placed in floats, which are a micrometre fine there. Farther off (a
// wide ground), in double.
#define NEAR 16.0

// Puts B into A's frame. A plane has no centre that matters: its frame is put at B, so that a plane is as exact a
// thousand kilometres off. Components of the rotation below FE__LEAST_LEAN are rounding: they become 0, so that stacked
// boxes do not drift.
static void set_view(fe__view *v, const fe__shape *a, const fe__shape *b, const fe__pose *pose_a,
                     const fe__pose *pose_b)
{
    v->a = a, v->b = b, v->form_a = a->form;
    v->origin = pose_a->position;
    v->rotation = fe__matrix(pose_a->rotation);
    if (fe__form_is_ball(&b->form)) {
        v->relative.rotation = fe__matrix(fe__identity());
    } else {
        const float least = FE__LEAST_LEAN;
        fe_quat q = fe__product(fe__conjugate(pose_a->rotation), pose_b->rotation);
        v->relative.rotation = fe__matrix(
            (fe_quat){fe__flush(q.x, least), fe__flush(q.y, least), fe__flush(q.z, least), fe__flush(q.w, least)});
    }
    fe_dvec3 between = fe__dsub(pose_b->position, pose_a->position);
    if (fe__form_is_unbounded(&a->form)) {
        fe__plane_move_frame(&v->form_a, pose_a->rotation, between);
        v->relative.position = fe__vec3(0.0f, 0.0f, 0.0f);
        v->origin = pose_b->position;
    } else if (fe__ddot(between, between) < NEAR * NEAR) {
        v->relative.position = fe__mul_transposed(&v->rotation, fe__narrow(between));
    } else {
        v->relative.position = fe__narrow(fe__drotate_back(pose_a->rotation, between));
    }
}

// ---- speculative contacts -------------------------------------------------------------------------------------------
// Contacts are made once per step. Shapes that touch only later in the step need their contact now, or it would be
// found a step late, up to v dt deep.

// |vA - vB|, |vA| and |vB| side by side: three roots one after the other would be the longest wait of a pair. A body's
// `speed` is |v| + |w| reach.
float fe__reach_in_step(const fe__step *step, const fe__body *a, const fe__body *b)
{
    wide va = *(const quad *)a->velocity, vb = *(const quad *)b->velocity;
    wide3 v = w_xyz(w_transpose(va - vb, va, vb, w_set(0.0f)));
    wide speed = w_sqrt(w_dot(v, v));
    return (speed[0] + (a->speed - speed[1]) + (b->speed - speed[2])) * step->dt + step->fall;
}

// Manifold for some poses of the two bodies
typedef struct prediction {
    fe__view v;
    fe__places at;
    fe__manifold found;
} prediction;

// Finds the manifold at out->at. `fall`: how far gravity brings a body towards another one until then, m
static void predict_at(const fe__step *step, const fe__contact *contact, const fe__view *v, float fall, prediction *out)
{
    const fe_world *world = step->world;
    const fe__body *a = world->bodies + contact->body_a, *b = world->bodies + contact->body_b;
    const fe__places *at = &out->at;
    int32_t a_is_b = contact->body_a != v->a->body;
    fe__pose pose_a = a_is_b ? fe__shape_pose_at(b, v->a, at->centre_b, at->rotation_b)
                             : fe__shape_pose_at(a, v->a, at->centre_a, at->rotation_a);
    fe__pose pose_b = a_is_b ? fe__shape_pose_at(a, v->b, at->centre_a, at->rotation_a)
                             : fe__shape_pose_at(b, v->b, at->centre_b, at->rotation_b);
    set_view(&out->v, v->a, v->b, &pose_a, &pose_b);
    out->found.axis = -1, out->found.axis_separation = 0.0f,
    out->found.count = 0; // not zeroed: its points stay unwritten
    const fe__pair_load load = {{fe__tell_pair_load}, world, (int32_t)(contact - world->contacts), at, &out->v};
    out->found.load = fe__load_chooses(&out->v) ? &load.asked : NULL;
    float margin = world->tuning.speculative_distance;
    fe__collide(&out->v.form_a, &v->b->form, &out->v.relative, margin, &out->found);
    out->found.load = NULL; // `load` ends here
    if (a->type == FE_BODY_STATIC) correct_internal_edges(world, &out->v, margin, fall, &out->found);
}

static void predict_after(const fe__step *step, const fe__contact *contact, const fe__view *v, float time,
                          prediction *out)
{
    const fe_world *world = step->world;
    fe__advance(world, world->bodies + contact->body_a, time, &out->at.centre_a, &out->at.rotation_a);
    fe__advance(world, world->bodies + contact->body_b, time, &out->at.centre_b, &out->at.rotation_b);
    float share = time / step->dt; // fe__advance falls as one step of that length does
    predict_at(step, contact, v, share * share * step->fall, out);
}

static float least_separation(const fe__manifold *found)
{
    float least = found->points[0].separation;
    for (int32_t i = 1; i < found->count; ++i) least = fe__minf(least, found->points[i].separation);
    return least;
}

// Takes the manifold of the poses at the end of the step, or, when they overlap there, of the poses on the way where
// they touch at the mean speed: the right features and normal for an impact, none for bodies that pass each other by.
// Deep inside, features say nothing any more, and the nearest ones of now must do. 1: there are points
static int32_t predict_manifold(const fe__step *step, const fe__contact *contact, fe__view *v, fe__places *at,
                                fe__manifold *found)
{
    prediction end, touch;
    predict_after(step, contact, v, step->dt, &end);
    if (!end.found.count) return 0;
    float gap_now = least_separation(found), gap_then = least_separation(&end.found);
    if (gap_now > 0.0f && gap_then < 0.0f) {
        predict_after(step, contact, v, step->dt * (gap_now / (gap_now - gap_then)), &touch);
        if (touch.found.count) end = touch;
    }
    float thickness = fe__minf(fe__form_thickness(&v->a->form), fe__form_thickness(&v->b->form));
    if (-least_separation(&end.found) > thickness && !fe__form_is_unbounded(&v->a->form)) return found->count > 0;
    *v = end.v, *at = end.at, *found = end.found;
    return 1;
}

// Takes the manifold where a fast body touches a static or kinematic one first. 1: there are points
static int32_t predict_first_touch(const fe__step *step, const fe__contact *contact, fe__view *v, fe__places *at,
                                   fe__manifold *found)
{
    const fe_world *world = step->world;
    prediction touch;
    if (!fe__predict_touch(world, (int32_t)(contact - world->contacts), step->dt, &touch.at)) return 0;
    predict_at(step, contact, v, step->fall, &touch);
    if (!touch.found.count) return 0;
    *v = touch.v, *at = touch.at, *found = touch.found;
    return 1;
}

// ---- points ---------------------------------------------------------------------------------------------------------
// A lane each.

typedef float loose_quad __attribute__((vector_size(16), aligned(4), may_alias));
_Static_assert(offsetof(fe__manifold_point, separation) == offsetof(fe__manifold_point, point) + 12,
               "a point and its separation are loaded as one");
_Static_assert((int)FE_W == (int)FE__POINTS && (int)FE_W == (int)FE_MAX_POINTS, "a lane for each point");

static inline wide3 spread(fe_vec3 a) { return (wide3){w_set(a.x), w_set(a.y), w_set(a.z)}; }
static inline wide keep(wide_mask lanes, wide a) { return (wide)((wide_int)lanes & (wide_int)a); } // others are 0
static inline wide_int first_lanes(int32_t count) { return (wide_int){0, 1, 2, 3} < count; }
static inline float sum_of(wide a) { return (a[0] + a[1]) + (a[2] + a[3]); }
static inline float greatest(wide a) { return fe__maxf(fe__maxf(a[0], a[1]), fe__maxf(a[2], a[3])); }
static inline wide3 turn(const fe__mat3 *m, wide3 a)
{
    return w_add_scaled(w_add_scaled(w_scale(a.x, spread(m->x)), a.y, spread(m->y)), a.z, spread(m->z));
}

// Impulses stay with the features that meet, at one point or more. Where `hands_on`, the impulses of features that are
// gone pass in equal parts to those that are new. All features are compared with all: which are the same no branch can
// guess.
static void match_impulses(fe__points *points, fe__features *features, int old_count, const fe__manifold *found,
                           int32_t hands_on)
{
    wide_int there = first_lanes(found->count), old_ids, ids, known = {0, 0, 0, 0};
    memcpy(&old_ids, features->ids, sizeof old_ids);
    for (int32_t i = 0; i < FE_W; ++i) ids[i] = (int32_t)found->points[fe__mini(i, found->count - 1)].id;
    wide old = *(const quad *)points->normal_impulse, impulse = w_set(0.0f);
    for (int32_t j = 0; j < FE_W; ++j) {
        wide_int same = (ids == old_ids[j]) & ((wide_int){0, 0, 0, 0} + j < old_count);
        impulse = w_choose(same, w_set(old[j]), impulse);
        known |= same;
    }
    impulse = keep(there, impulse);
    if (hands_on) {
        wide_int fresh = there & ~known;
        int32_t count = -(fresh[0] + fresh[1] + fresh[2] + fresh[3]);
        float left = fe__maxf(sum_of(keep(first_lanes(old_count), old)) - sum_of(impulse), 0.0f);
        if (count > 0) impulse = w_choose(fresh, w_set(left / (float)count), impulse);
    }
    *(quad *)points->normal_impulse = impulse;
    ids = (ids & there) | (old_ids & ~there);
    memcpy(features->ids, &ids, sizeof ids);
}

// Turns points in A's frame into arms: from the centre of the solver's A, or of B when A is static (its centre may be
// far).
static void set_points(fe__contact *contact, fe__points *points, const fe__view *v, const fe__places *at,
                       const fe__manifold *found, const fe__body *a)
{
    int32_t is_static = a->type == FE_BODY_STATIC, count = found->count;
    wide3 base = spread(fe__narrow(fe__dsub(v->origin, is_static ? at->centre_b : at->centre_a)));
    wide3 span = is_static ? w_zero3() : spread(fe__quad_vector(contact->found_span));
    wide_mask there = first_lanes(count);
    const fe__manifold_point *p = found->points; // one or more; lanes without one repeat the first
    const loose_quad *lane_0 = (const loose_quad *)p, *lane_1 = (const loose_quad *)(count > 1 ? p + 1 : p),
                     *lane_2 = (const loose_quad *)(count > 2 ? p + 2 : p),
                     *lane_3 = (const loose_quad *)(count > 3 ? p + 3 : p);
    wide4 point = w_transpose(*lane_0, *lane_1, *lane_2, *lane_3);
    wide3 arm = w_add(base, turn(&v->rotation, w_xyz(point)));
    arm = (wide3){keep(there, arm.x), keep(there, arm.y), keep(there, arm.z)};
    wide3 arm_b = w_add(arm, span);
    // a round side rotates with its core
    wide3 n = spread(fe__quad_vector(contact->normal)),
          core_a = w_add_scaled(arm, w_set(-contact->surface.radius_a), n),
          core_b = w_add_scaled(arm_b, w_set(contact->surface.radius_b), n);
    wide surfaces = w_max(w_dot(arm, arm), w_dot(arm_b, arm_b)),
         cores = w_max(w_dot(core_a, core_a), w_dot(core_b, core_b));
    wide separation = keep(there, point.w);
    *(quad *)points->separation = separation;
    w_scatter(points->point[0].arm, sizeof *points->point / sizeof(float), w_in_order, w_with(arm, separation));
    contact->longest_arm = sqrtf(greatest(w_max(surfaces, keep(there, cores))));
}

// ---- contact --------------------------------------------------------------------------------------------------------

static void copy_quat(float *out, fe_quat q) { out[0] = q.x, out[1] = q.y, out[2] = q.z, out[3] = q.w; }

static fe__places places_now(const fe__body *a, const fe__body *b)
{
    return (fe__places){fe__centre_of(a), fe__centre_of(b), fe__rotation_of(a), fe__rotation_of(b)};
}

// Writes the poses that a manifold is found in. A span is cA - cB.
static void set_found_poses(fe__contact *contact, const fe__places *at, const fe__body *a, const fe__body *b)
{
    copy_quat(contact->found_a, at->rotation_a);
    copy_quat(contact->found_b, at->rotation_b);
    fe_dvec3 span = fe__dsub(at->centre_a, at->centre_b), span_now = fe__dsub(fe__centre_of(a), fe__centre_of(b));
    fe__copy3(contact->found_span, fe__narrow(span));
    fe__copy3(contact->found_low, fe__narrow(fe__dsub(span, fe__widen(fe__quad_vector(contact->found_span)))));
    // torques need no sum over both bodies where only B is moved: the arms of the touch
    fe_vec3 arms = a->type == FE_BODY_KINEMATIC ? fe__quad_vector(contact->found_span) : fe__narrow(span_now);
    fe__copy3(contact->span, a->type == FE_BODY_STATIC ? fe__vec3(0.0f, 0.0f, 0.0f) : arms);
}

// A record of points that the pair has is zeroed, and stays so until it is released.
static void set_no_points(fe__contact *contact, fe__points *points, const fe__body *a, const fe__body *b)
{
    if (contact->points) *points = (fe__points){.twist_impulse = 0.0f};
    for (int k = 0; k < 3; ++k) contact->normal[k] = 0.0f;
    contact->point_count = 0.0f;
    contact->longest_arm = fe__maxf(a->reach, b->reach); // whatever part of the bodies may come near
}

void fe__drop_points(fe_world *world, int32_t pair)
{
    fe__contact *contact = world->contacts + pair;
    world->pairs[pair].axis = -1;
    set_no_points(contact, fe__points_of(world, contact), world->bodies + contact->body_a,
                  world->bodies + contact->body_b);
    contact->surface.tolerance = 0.0f;
    fe__points_release(world, pair);
}

// Computes the separations now of a manifold found ahead of time, along its normal: as in recycle.simd.c. Its arms stay
// those of the touch, and the turns from there to now take the place of the rotations.
static void step_back(fe__contact *contact, fe__points *points, const fe__places *at, const fe__body *a,
                      const fe__body *b)
{
    fe_quat turn_a = fe__product(fe__rotation_of(a), fe__conjugate(at->rotation_a)),
            turn_b = fe__product(fe__rotation_of(b), fe__conjugate(at->rotation_b));
    copy_quat(contact->found_a, turn_a);
    copy_quat(contact->found_b, turn_b);
    fe_vec3 n = fe__quad_vector(contact->normal), zero = {0.0f, 0.0f, 0.0f};
    fe_vec3 na = fe__sub(fe__rotate_back(turn_a, n), n), nb = fe__sub(fe__rotate_back(turn_b, n), n),
            slope = fe__sub(nb, na);
    fe_dvec3 delta_then = fe__dsub(at->centre_b, at->centre_a),
             delta_now = fe__dsub(fe__centre_of(b), fe__centre_of(a));
    fe_vec3 span = a->type == FE_BODY_STATIC ? zero : fe__quad_vector(contact->found_span);
    float constant = fe__dot(n, fe__narrow(fe__dsub(delta_now, delta_then))) + fe__dot(nb, span) +
                     contact->surface.radius_a * fe__dot(na, n) + contact->surface.radius_b * fe__dot(nb, n);
    for (int i = 0; i < (int)contact->point_count; ++i)
        points->separation[i] =
            points->point[i].separation + constant + fe__dot(slope, fe__quad_vector(points->point[i].arm));
}

// How far a pair may slide or turn before it needs a new manifold: at most this, m, and a share of the thinner form.
// Less for round forms and for edges side by side, whose normal turns with them.
#define RECYCLE_MOST 0.03f
#define RECYCLE_SHARE 0.1f
#define RECYCLE_ROUND 0.0005f
// share for a rim that stands, whose points are where its load leans
#define RECYCLE_AIMED 0.03f

float fe__recycle_tolerance(const fe__view *v, int32_t left_out)
{
    int32_t is_round = fe__form_roundness(&v->a->form) > 0.0f || fe__form_roundness(&v->b->form) > 0.0f;
    if (is_round && left_out != FE_LEFT_REST) return RECYCLE_ROUND;
    float least = fe__minf(fe__form_thickness(&v->a->form), fe__form_thickness(&v->b->form));
    return fe__minf(RECYCLE_MOST, (is_round ? RECYCLE_AIMED : RECYCLE_SHARE) * least);
}

// Turns a manifold's normal, which points away from fe__collide's A, into the solver's, whose A may be the other one.
// Components below FE__LEAST_LEAN are rounding: they become 0. Inlined, because three floats returned in halves, and
// read again as one, cost a stall.
FE_INLINE fe_vec3 solver_normal(const fe__contact *contact, const fe__view *v, fe_vec3 normal)
{
    fe_vec3 n = fe__mul(&v->rotation, normal);
    n = fe__vec3(fe__flush(n.x, FE__LEAST_LEAN), fe__flush(n.y, FE__LEAST_LEAN), fe__flush(n.z, FE__LEAST_LEAN));
    return contact->body_a != v->a->body ? fe__neg(n) : n;
}

void fe__write_manifold(const fe_world *world, fe__contact *contact, const fe__view *v, const fe__places *at,
                        const fe__manifold *found, int32_t ahead)
{
    const fe__body *a = world->bodies + contact->body_a, *b = world->bodies + contact->body_b;
    fe__points *points = fe__points_of(world, contact);
    set_found_poses(contact, at, a, b);
    if (!found->count) {
        set_no_points(contact, points, a, b);
        return;
    }
    fe__copy3(contact->normal, solver_normal(contact, v, found->normal));
    contact->point_count = (float)found->count;
    float pivot_a = fe__form_pivot(&v->form_a, found->normal),
          pivot_b = fe__form_pivot(&v->b->form, fe__mul_transposed(&v->relative.rotation, found->normal));
    int32_t a_is_b = contact->body_a != v->a->body;
    contact->surface.radius_a = a_is_b ? pivot_b : pivot_a;
    contact->surface.radius_b = a_is_b ? pivot_a : pivot_b;
    set_points(contact, points, v, at, found, a);
    if (ahead) step_back(contact, points, at, a, b);
}

void fe__write_apart(fe_world *world, int32_t pair, const fe__apart *apart)
{
    fe__pair *p = world->pairs + pair;
    fe__contact *contact = world->contacts + pair;
    const fe__body *a = world->bodies + contact->body_a, *b = world->bodies + contact->body_b;
    const fe__shape *shape_a = world->shapes + p->shape_a, *shape_b = world->shapes + p->shape_b;
    const fe__places at = places_now(a, b);
    int32_t is_in_order = contact->body_a == shape_a->body;
    // a kernel's memory begins with the first points, whenever the pair was made: bodies that do not touch must not
    // matter
    p->axis = -1;
    p->axis_separation = apart->axis_separation;
    contact->surface.tolerance = apart->slack;
    set_found_poses(contact, &at, a, b);
    set_no_points(contact, fe__points_of(world, contact), a, b);
    fe__copy3(contact->normal, apart->normal);
    // a turn of the core moves the round layer about it nowhere else
    contact->surface.radius_a = (is_in_order ? shape_a : shape_b)->arm;
    contact->surface.radius_b = (is_in_order ? shape_b : shape_a)->arm;
}

// ---- one-way shapes -------------------------------------------------------------------------------------------------

// The least cosine between a one-way shape's direction and a normal that holds: 60 degrees, so that its edges do not
// catch what passes by.
#define ONE_WAY_COSINE 0.5f

// `outward`: the normal from the shape to what it meets
static int32_t holds(const fe__shape *shape, fe_vec3 outward)
{
    if (!(shape->flags & FE__SHAPE_ONE_WAY)) return 1;
    fe_vec3 direction = fe__rotate(shape->pose.rotation, shape->one_way);
    return fe__dot(direction, outward) >= ONE_WAY_COSINE * sqrtf(fe__dot(direction, direction));
}

typedef enum sides { HOLDS, UNDECIDED, PASSES } sides;

// How a one-way shape takes the other. Their first meeting decides, by the side; a shape that passes goes on until
// they are apart. What passes a part of a compound passes all parts that it meets in the meantime.
static sides sides_of(const fe_world *world, int32_t pair, int32_t is_passing, const fe__view *v,
                      const fe__manifold *found)
{
    const fe__pair *p = world->pairs + pair;
    if (!((v->a->flags | v->b->flags) & FE__SHAPE_ONE_WAY)) return HOLDS;
    if (is_passing) return PASSES;
    if (!found->count || p->flags & FE__PAIR_LINKED) return HOLDS;
    const fe__encounter *encounter = p->flags & FE__PAIR_OF_PARTS ? fe__encounter_of(world, pair) : NULL;
    int32_t passes_part = encounter && encounter->passing;
    fe_vec3 normal = fe__mul(&v->rotation, found->normal); // from v->a to v->b
    if (!passes_part && holds(v->a, normal) && holds(v->b, fe__neg(normal))) return HOLDS;
    // a shape that other parts hold may yet come to lie on this one
    return encounter && encounter->held && !passes_part ? UNDECIDED : PASSES;
}

// ---- narrow phase of a pair -----------------------------------------------------------------------------------------

// 1: the shapes are some way off now, but may close within the step; the normal may turn on that way.
static int32_t may_touch_from_afar(const fe__step *step, const fe__pair *p, const fe__contact *contact,
                                   const fe__view *v, const fe__manifold *found)
{
    if (!found->count || p->flags & FE__PAIR_SENSOR) return 0;
    float gap = least_separation(found);
    if (gap <= FE__TURNS_LITTLE) return 0;
    // Motion along the normal from the solver's A to its B: while a gap along it stays open, they cannot touch. A
    // body's `speed` is |v| + |w| reach, as in recycle.simd.c.
    const fe__body *a = step->world->bodies + contact->body_a, *b = step->world->bodies + contact->body_b;
    fe_vec3 normal = solver_normal(contact, v, found->normal);
    fe_vec3 va = fe__quad_vector(a->velocity), vb = fe__quad_vector(b->velocity);
    float spin_a = a->speed - fe__length(va), spin_b = b->speed - fe__length(vb);
    float closing = fe__maxf(fe__dot(normal, fe__sub(va, vb)), 0.0f) + spin_a + spin_b;
    return gap <= closing * step->dt + step->fall;
}

// The distance of the shapes along found's normal, m, or in any direction if that is 0. With points a kernel leaves the
// older axis_separation, so that the gap is measured.
static float gap_of(const fe__view *v, const fe__manifold *found)
{
    if (!found->count) return found->axis_separation;
    if (fe__form_is_unbounded(&v->form_a)) return least_separation(found);
    fe_vec3 n = found->normal, from_b = fe__neg(fe__mul_transposed(&v->relative.rotation, n));
    fe_vec3 on_a = fe__narrow(fe__form_support(&v->form_a, fe__widen(n))),
            on_b = fe__narrow(fe__form_support(&v->b->form, fe__widen(from_b)));
    on_b = fe__add(v->relative.position, fe__mul(&v->relative.rotation, on_b));
    return fe__dot(n, fe__sub(on_b, on_a)) - v->form_a.radius - v->b->form.radius;
}

// The features of a form with a rim change with the least turn, from a line to a point and back, and a heap that loses
// its load with each change never sleeps. So new features take the load over while the normal stays.
static int32_t hands_impulses_on(const fe__contact *contact, const fe__view *v, const fe__manifold *found)
{
    const float same_way = 0.98f; // cos 11.5 degrees
    if (!(fe__form_is_curved(&v->a->form) || fe__form_is_curved(&v->b->form))) return 0;
    return fe__dot(fe__quad_vector(contact->normal), solver_normal(contact, v, found->normal)) > same_way;
}

static void write_points(fe_world *world, int32_t pair, const fe__view *v, const fe__places *at,
                         const fe__manifold *found, int32_t ahead)
{
    fe__contact *contact = world->contacts + pair;
    world->pairs[pair].left_out = (uint8_t)found->left_out;
    if (!contact->points) fe__points_take(world, pair);
    match_impulses(fe__points_of(world, contact), world->features + contact->points, (int)contact->point_count, found,
                   hands_impulses_on(contact, v, found));
    float tolerance = fe__recycle_tolerance(v, found->left_out);
    if (found->round) tolerance = fe__minf(tolerance, RECYCLE_ROUND);
    contact->surface.tolerance = ahead ? FE__AHEAD : tolerance;
    fe__write_manifold(world, contact, v, at, found, ahead);
}

// The narrow phase. With `out_apart` nothing is written but that. 1: no points, and *out_apart says how far apart; 0:
// there are points, or it needs another look. The flags of the pair are not written: others read them meanwhile.
static int32_t collide(const fe__step *step, int32_t pair, fe__apart *out_apart, int32_t *out_changes_sides)
{
    fe_world *world = step->world;
    fe__pair *p = world->pairs + pair;
    fe__contact *contact = world->contacts + pair;
    const fe__body *a = world->bodies + contact->body_a, *b = world->bodies + contact->body_b;
    const fe__shape *shape_a = world->shapes + p->shape_a, *shape_b = world->shapes + p->shape_b;
    float margin = world->tuning.speculative_distance, reach = fe__reach_in_step(step, a, b);
    fe__places at = places_now(a, b);
    fe__view v;
    if (p->flags & FE__PAIR_SWAPPED)
        set_view(&v, shape_b, shape_a, &shape_b->pose, &shape_a->pose);
    else
        set_view(&v, shape_a, shape_b, &shape_a->pose, &shape_b->pose);
    fe__manifold found; // not zeroed: its points stay unwritten
    found.axis = p->axis, found.axis_separation = p->axis_separation, found.count = (int32_t)contact->point_count;
    if (p->axis >= 0) {
        fe_vec3 n = fe__mul_transposed(&v.rotation, fe__quad_vector(contact->normal));
        found.last = contact->body_a != v.a->body ? fe__neg(n) : n;
    }
    const fe__pair_load load = {{fe__tell_pair_load}, world, pair, &at, &v};
    found.load = fe__load_chooses(&v) ? &load.asked : NULL;
    fe__collide(&v.form_a, &v.b->form, &v.relative, fe__maxf(margin, reach), &found);

    int32_t was_passing = (p->flags & FE__PAIR_PASSING) != 0;
    int32_t is_passing = was_passing && found.count; // before internal edges take points away
    if (a->type == FE_BODY_STATIC) correct_internal_edges(world, &v, fe__maxf(margin, reach), 0.0f, &found);
    fe__apart apart = {.axis_separation = found.axis_separation};
    int32_t axis = found.axis, is_denied = (p->flags & FE__PAIR_DENIED) != 0, ahead = 0;
    sides sides = is_denied ? HOLDS : sides_of(world, pair, is_passing, &v, &found);
    *out_changes_sides = was_passing != (sides == PASSES);
    if (!is_denied && sides == HOLDS) {
        int32_t is_near = found.count && least_separation(&found) <= margin;
        if (is_near && out_apart) return 0;
        if (may_touch_from_afar(step, p, contact, &v, &found)) {
            // against a static or kinematic body, farther than one of the two is thick
            int32_t is_fast = a->type != FE_BODY_DYNAMIC &&
                              reach > fe__minf(fe__form_thickness(&shape_a->form), fe__form_thickness(&shape_b->form));
            if (is_fast && out_apart) return 0;
            ahead = (is_fast ? predict_first_touch : predict_manifold)(step, contact, &v, &at, &found);
        }
        if (ahead && out_apart) return 0;
        if (ahead || is_near) {
            p->axis_separation = apart.axis_separation;
            p->axis = axis;
            write_points(world, pair, &v, &at, &found, ahead);
            return 0;
        }
        apart.slack = fe__slack(gap_of(&v, &found), margin);
        apart.normal = solver_normal(contact, &v, found.normal);
    }
    if (out_apart)
        *out_apart = apart;
    else
        fe__write_apart(world, pair, &apart);
    return 1;
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
    int32_t changes_sides;
    if ((shapes[p->shape_a].flags | shapes[p->shape_b].flags) & FE__SHAPE_ONE_WAY) return 0;
    return collide(step, pair, out_apart, &changes_sides);
}
