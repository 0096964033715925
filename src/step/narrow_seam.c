// narrow_seam.c - static boxes and hulls that lie flush: what rolls or slides over the seam must not feel the edge of
// the next one.
//
// Called by narrow.c with a manifold of a static box or hull. A direction m of contact at a point q of it holds only
// while no other such solid near the same body goes on from q and rises along m: it must lie in the normal cone of both
// (as in terrain_surface.h). A manifold whose points all fail is exchanged for that of the face that the surroundings
// allow, which may have no points.
#include "step/narrow_seam.h"

#include "collision/form/clip.h"
#include "collision/form/hull_form.h"
#include "collision/form/solid.h"
#include "collision/form/support.h"
#include "collision/manifold/bridge.h"
#include "step/surroundings.h"

#include <float.h>

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
