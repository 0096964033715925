// narrow_seam.c - static boxes that lie flush: what rolls or slides over the seam must not feel the edge of the next
// one.
//
// Called by narrow.c with a manifold of a static box. A direction m of contact at a point q of the box holds only while
// no other static box near the same body goes on from q and rises along m: it must lie in the normal cone of both (as
// in terrain_surface.h). A manifold whose points all fail is exchanged for that of the box's face that the surroundings
// allow, which may have no points.
#include "step/narrow_seam.h"

#include "collision/form/clip.h"
#include "collision/form/support.h"
#include "world/pair_list.h"

#include <float.h>

// Boxes closer than this lie flush, m
#define FLUSH 0.001f
// So far inside its rim a face is asked whether it is open, m, and as a share of its half width: the rim itself lies in
// every inner corner
#define INSIDE 0.01f
#define INSIDE_SHARE 0.1f

enum { MOST_NEAR = 8, SEAM_ID = 0x20000000 };

// A box in the frame of fe__collide's A.
typedef struct placed {
    const fe__form *form;
    fe_vec3 centre;
    fe__mat3 axes;
} placed;

typedef struct seam {
    placed box, near[MOST_NEAR];
    int32_t near_count;
    placed other; // what touches the box
    float margin;
} seam;

static placed place(const fe__view *v, const fe__shape *shape)
{
    fe__mat3 r = fe__matrix(shape->pose.rotation);
    placed p = {.form = &shape->form,
                .centre = fe__mul_transposed(&v->rotation, fe__narrow(fe__dsub(shape->pose.position, v->origin)))};
    p.axes = (fe__mat3){fe__mul_transposed(&v->rotation, r.x), fe__mul_transposed(&v->rotation, r.y),
                        fe__mul_transposed(&v->rotation, r.z)};
    return p;
}

static int32_t is_static_box(const fe_world *w, const fe__shape *shape)
{
    return fe__form_has_flat_faces(&shape->form) && w->bodies[shape->body].type == FE_BODY_STATIC &&
           !(shape->flags & FE__SHAPE_TRIGGER);
}

// Other static boxes that the same shape is near
static void find_near(const fe_world *w, const fe__view *v, const fe__shape *box, const fe__shape *other, seam *s)
{
    for (int32_t pair = w->bodies[other->body].first_contact; pair >= 0 && s->near_count < MOST_NEAR;
         pair = fe__next_pair(w, pair, other->body)) {
        const fe__pair *p = w->pairs + pair;
        const fe__shape *x = w->shapes + p->shape_a, *y = w->shapes + p->shape_b, *n = x == other ? y : x;
        if ((x == other || y == other) && n != box && is_static_box(w, n)) s->near[s->near_count++] = place(v, n);
    }
}

// Does the near box hold q, and go on from there along m?
static int32_t goes_on(const placed *n, fe_vec3 q, fe_vec3 m)
{
    fe_vec3 half = n->form->half, p = fe__mul_transposed(&n->axes, fe__sub(q, n->centre)),
            along = fe__mul_transposed(&n->axes, m);
    if (fe__absf(p.x) > half.x + FLUSH || fe__absf(p.y) > half.y + FLUSH || fe__absf(p.z) > half.z + FLUSH) return 0;
    float reach = fe__absf(along.x) * half.x + fe__absf(along.y) * half.y + fe__absf(along.z) * half.z;
    return reach - fe__dot(along, p) > FLUSH;
}

// towards 0, unless it is the face's own axis
static float inwards(float x, float half, int32_t is_axis)
{
    float step = fe__minf(fe__minf(INSIDE, INSIDE_SHARE * half), fe__absf(x));
    return is_axis ? x : x > 0.0f ? x - step : x + step;
}

static int32_t is_shut(const seam *s, fe_vec3 q, fe_vec3 m)
{
    const float leans = 1e-10f; // sin^2 of what is no face's normal: 2 seconds of arc
    fe_vec3 half = s->box.form->half, along = fe__mul_transposed(&s->box.axes, m),
            p = fe__mul_transposed(&s->box.axes, fe__sub(q, s->box.centre));
    float xx = along.x * along.x, yy = along.y * along.y, zz = along.z * along.z;
    int32_t x = yy + zz < leans, y = xx + zz < leans, z = xx + yy < leans;
    if (x || y || z) p = fe__vec3(inwards(p.x, half.x, x), inwards(p.y, half.y, y), inwards(p.z, half.z, z));
    q = fe__add(s->box.centre, fe__mul(&s->box.axes, p));
    for (int32_t i = 0; i < s->near_count; ++i)
        if (goes_on(s->near + i, q, m)) return 1;
    return 0;
}

static int32_t all_shut(const seam *s, const fe_vec3 *q, int32_t count, fe_vec3 m)
{
    for (int32_t i = 0; i < count; ++i)
        if (!is_shut(s, q[i], m)) return 0;
    return 1;
}

// ---- the face instead ----------------------------------------------------------------------------------------------
static fe_vec3 face_normal(const placed *box, int32_t face)
{
    fe_vec3 axis = face / 2 == 0 ? box->axes.x : face / 2 == 1 ? box->axes.y : box->axes.z;
    return face & 1 ? axis : fe__neg(axis);
}

static void face_of(const placed *p, fe_vec3 direction, fe__face *face)
{
    fe__form_face(p->form, fe__mul_transposed(&p->axes, direction), face);
    for (int32_t i = 0; i < face->count; ++i) face->vertex[i] = fe__add(p->centre, fe__mul(&p->axes, face->vertex[i]));
}

static float height_over(const seam *s, fe_vec3 f)
{
    fe__face face;
    face_of(&s->other, fe__neg(f), &face);
    const fe_vec3 half = s->box.form->half, along = fe__mul_transposed(&s->box.axes, f);
    float low = FLT_MAX, top = fe__absf(along.x) * half.x + fe__absf(along.y) * half.y + fe__absf(along.z) * half.z;
    for (int32_t i = 0; i < face.count; ++i) low = fe__minf(low, fe__dot(f, fe__sub(face.vertex[i], s->box.centre)));
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
    face_of(&s->box, f, &reference);
    face_of(&s->other, fe__neg(f), &incident);
    fe_vec3 edge = fe__sub(reference.vertex[1], reference.vertex[0]), u = fe__scale(1.0f / fe__length(edge), edge);
    fe__mat3 frame = {u, fe__cross(f, u), f};
    fe__clip_vertex side[FE_FACE_VERTICES], vertex[FE_CLIP_VERTICES];
    project(&reference, reference.vertex[0], &frame, side);
    project(&incident, reference.vertex[0], &frame, vertex);
    const float slack = 1e-5f, tie = 5e-5f; // m
    int32_t count = fe__clip_polygon(side, reference.count, vertex, incident.count, slack), near = 0;
    for (int32_t i = 0; i < count; ++i) {
        vertex[i].height -= s->other.form->radius;
        if (vertex[i].height <= s->margin) vertex[near++] = vertex[i];
    }
    found->count = fe__reduce_to_four(vertex, near, tie);
    if (found->count) found->normal = fe__scale(sign, f);
    for (int32_t i = 0; i < found->count; ++i) {
        fe_vec3 p = fe__add_scaled(fe__add_scaled(reference.vertex[0], vertex[i].u, frame.x), vertex[i].v, frame.y);
        found->points[i] = (fe__manifold_point){fe__add_scaled(p, 0.5f * vertex[i].height, f), vertex[i].height,
                                                (uint32_t)SEAM_ID | (incident.id & 0xff) << 16 | vertex[i].id};
    }
}

static void take_open_face(const seam *s, const fe_vec3 *q, fe_vec3 m, float sign, fe__manifold *found)
{
    float most = -FLT_MAX;
    fe_vec3 best = m;
    for (int32_t face = 0; face < 6; ++face) {
        fe_vec3 f = face_normal(&s->box, face);
        float height = height_over(s, f);
        const float level = -0.01f; // cosine: not against what was found
        if (fe__dot(f, m) < level || height <= most || all_shut(s, q, found->count, f)) continue;
        most = height, best = f;
    }
    found->count = 0;
    found->axis = -1;
    found->axis_separation = 0.0f; // look again in the next step
    found->normal = fe__vec3(0.0f, 0.0f, 0.0f);
    if (most > -FLT_MAX && most <= s->margin) touch_face(s, best, sign, found);
}

void fe__mend_seam(const fe_world *world, const fe__view *v, float margin, fe__manifold *found)
{
    int32_t box_is_a = is_static_box(world, v->a);
    const fe__shape *box = box_is_a ? v->a : v->b, *other = box_is_a ? v->b : v->a;
    if (!found->count || !is_static_box(world, box) || world->bodies[other->body].static_pairs < 2) return;
    seam s = {.margin = margin};
    find_near(world, v, box, other, &s);
    if (!s.near_count) return;
    placed a = {.form = &v->a->form, .axes = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}}};
    placed b = {.form = &v->b->form, .centre = v->relative.position, .axes = v->relative.rotation};
    s.box = box_is_a ? a : b, s.other = box_is_a ? b : a;
    float sign = box_is_a ? 1.0f : -1.0f;
    fe_vec3 m = fe__scale(sign, found->normal), q[FE_MAX_POINTS];
    for (int32_t i = 0; i < found->count; ++i)
        q[i] = fe__add_scaled(found->points[i].point, -0.5f * found->points[i].separation, m);
    if (all_shut(&s, q, found->count, m)) take_open_face(&s, q, m, sign, found);
}
