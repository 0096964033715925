// hull_hull.c - hull against hull, and against a box taken for one: the axis of least overlap (hull_axis.c), then a
// face cut by a face, or two crossing edges.
//
// A kernel of collide.c's table. A face of A beats a face of B beats a pair of edges unless the later is better by
// fe__tie, and within a class the lowest feature wins. manifold->axis names the features of the last full test and
// axis_separation what that found along them: a face that has hardly moved since is cut again without another test.
#include "collision/form/hull_form.h"
#include "collision/manifold/facing_edges.h"
#include "collision/manifold/hull_axis.h"
#include "collision/manifold/hull_box.h"
#include "collision/manifold/kernels.h"

#include <assert.h>
#include <float.h>

typedef struct hull_pair {
    const fe__hull *a, *b;
    fe__relative b_in_a;        // of the hulls' frames
    float tie, slack;           // m; slack: by which a face reaches beyond its rim
    const fe__load_asked *load; // frame of A's form
    fe_vec3 offset;             // of A's hull in its form
} hull_pair;

// ---- the axis ------------------------------------------------------------------------------------------------------
enum { FACING_EDGES = FE__AXIS_OF_EDGES + 1 }; // a kind beside those of fe__hull_axis: edges that run side by side

// kind, then the features of A and of B, 10 bits each
static int32_t pack(const fe__hull_axis *axis) { return axis->kind << 20 | axis->a << 10 | axis->b; }
static int32_t kind_of(int32_t packed) { return packed >> 20; }

// The best axis; stops at the first class that separates by more than the margin. A face of B is better by `tie`.
static fe__hull_axis find_axis(const hull_pair *q, float tie, float margin)
{
    fe__hull_axis best = fe__hull_axis_of_faces_a(q->a, q->b, &q->b_in_a);
    if (best.separation > margin) return best;
    fe__hull_axis other = fe__hull_axis_of_faces_b(q->a, q->b, &q->b_in_a);
    int32_t deepest_of_a = other.a, deepest_of_b = best.b;
    if (other.separation > best.separation + tie) best = other;
    if (best.separation > margin) return best;
    other = fe__hull_axis_of_edges(q->a, q->b, &q->b_in_a, best.separation + q->tie, deepest_of_a, deepest_of_b);
    return other.separation > best.separation + q->tie ? other : best;
}

// ---- faces ---------------------------------------------------------------------------------------------------------
// Two hulls seen from that whose face is the reference
typedef struct face_pair {
    const fe__hull *own, *other;
    fe__relative other_in_own;
    int32_t face;
} face_pair;

static fe__relative turned_round(const fe__relative *r)
{
    const fe__mat3 *m = &r->rotation;
    fe__mat3 back = {{m->x.x, m->y.x, m->z.x}, {m->x.y, m->y.y, m->z.y}, {m->x.z, m->y.z, m->z.z}};
    return (fe__relative){fe__neg(fe__mul_transposed(m, r->position)), back};
}

static face_pair view_of(const hull_pair *q, int32_t kind, int32_t face)
{
    if (kind == FE__AXIS_OF_FACE_A) return (face_pair){q->a, q->b, q->b_in_a, face};
    return (face_pair){q->b, q->a, turned_round(&q->b_in_a), face};
}

// The other's vertex deepest below the face, and its separation
static int32_t deepest_below(const face_pair *p, float *separation)
{
    fe_vec3 normal = fe__hull_normal(p->own, p->face), in_other = fe__mul_transposed(&p->other_in_own.rotation, normal);
    float least = FLT_MAX;
    int32_t deepest = 0;
    for (int32_t v = 0; v < p->other->vertex_count; ++v) {
        float along = fe__dot(in_other, fe__hull_vertex(p->other, v));
        if (along < least) least = along, deepest = v;
    }
    *separation = least + (fe__dot(normal, p->other_in_own.position) - p->own->distances[p->face]);
    return deepest;
}

// The rise along the direction, sine, of the flatter of a face's two edges at its corner i
static float flatter_edge(const fe__hull *hull, const fe__hull_face *face, int32_t i, fe_vec3 direction)
{
    fe_vec3 corner = fe__hull_vertex(hull, hull->corners[face->first + i]);
    float least = 1.0f;
    for (int32_t k = 0; k < 2; ++k) {
        int32_t other = k == 0 ? (i + 1 < face->count ? i + 1 : 0) : (i > 0 ? i - 1 : face->count - 1);
        fe_vec3 edge = fe__sub(fe__hull_vertex(hull, hull->corners[face->first + other]), corner);
        least = fe__minf(least, fe__dot(direction, edge) / fe__length(edge));
    }
    return least;
}

static int32_t corner_of(const fe__hull *hull, const fe__hull_face *face, int32_t vertex)
{
    for (int32_t i = 0; i < face->count; ++i)
        if (hull->corners[face->first + i] == vertex) return i;
    return -1;
}

// What of a hull meets a face: the face whose corners are cut, and what of it lies along, but for 5 degrees
typedef enum lying { LIES_CORNER, LIES_EDGE, LIES_FACE } lying;
typedef struct incident {
    int32_t face;
    lying lies;
} incident;

// Of the faces around the vertex that which looks most against the direction: so the deepest point is among those kept.
// Where none lies along the reference, an edge may, as a wedge's that stands on it: then one of its two faces, or the
// other end of the edge would be lost.
static incident find_incident(const fe__hull *hull, int32_t vertex, fe_vec3 direction)
{
    int32_t best = -1;
    float least = FLT_MAX, flattest = FE__LIES_ALONG;
    for (int32_t f = 0; f < hull->face_count; ++f) {
        float cosine = fe__dot(direction, fe__hull_normal(hull, f));
        if (cosine < least && corner_of(hull, hull->faces + f, vertex) >= 0) best = f, least = cosine;
    }
    if (least < -FE_FACE_COS) return (incident){best, LIES_FACE};
    if (flatter_edge(hull, hull->faces + best, corner_of(hull, hull->faces + best, vertex), direction) < flattest)
        return (incident){best, LIES_EDGE};
    for (int32_t f = 0; f < hull->face_count; ++f) {
        float cosine = fe__dot(direction, fe__hull_normal(hull, f));
        int32_t corner =
            cosine < 0.0f ? corner_of(hull, hull->faces + f, vertex) : -1; // one of an edge's two looks down
        if (corner < 0) continue;
        float rise = flatter_edge(hull, hull->faces + f, corner, direction);
        if (rise < flattest || (rise == flattest && cosine < least)) best = f, flattest = rise, least = cosine;
    }
    return (incident){best, flattest < FE__LIES_ALONG ? LIES_EDGE : LIES_CORNER};
}

// Does an edge of the incident face, at the deepest vertex, run beside one of the reference's rim? Only then may these
// two be what touches.
static int32_t runs_beside_rim(const face_pair *p, int32_t deepest, int32_t incident, float separation)
{
    const fe__hull_face *face = p->own->faces + p->face, *other = p->other->faces + incident;
    const uint8_t *corners = p->own->corners + face->first, *of_other = p->other->corners + other->first;
    int32_t i = corner_of(p->other, other, deepest);
    float reach = FE__FACING_REACH * fe__maxf(FE__FACING_DEPTH, -separation);
    fe_vec3 n = fe__hull_normal(p->own, p->face), at = fe__hull_vertex(p->other, deepest), edge[2];
    for (int32_t k = 0; k < 2; ++k) {
        int32_t next = k == 0 ? (i + 1 < other->count ? i + 1 : 0) : (i > 0 ? i - 1 : other->count - 1);
        edge[k] = fe__mul(&p->other_in_own.rotation, fe__sub(fe__hull_vertex(p->other, of_other[next]), at));
    }
    at = fe__add(p->other_in_own.position, fe__mul(&p->other_in_own.rotation, at));
    fe_vec3 from = fe__hull_vertex(p->own, corners[face->count - 1]);
    for (int32_t c = 0; c < face->count; ++c) {
        fe_vec3 to = fe__hull_vertex(p->own, corners[c]), rim = fe__sub(to, from);
        float square = fe__dot(rim, rim), off = fe__dot(fe__cross(rim, n), fe__sub(at, from));
        from = to;
        for (int32_t k = 0; k < 2 && off * off <= reach * reach * square; ++k) {
            float along = fe__dot(rim, edge[k]);
            if (along * along > FE_FACE_COS * FE_FACE_COS * square * fe__dot(edge[k], edge[k])) return 1;
        }
    }
    return 0;
}

typedef struct plane_frame {
    fe_vec3 origin;
    fe__mat3 axes; // u, v, normal
} plane_frame;

static plane_frame frame_of(const face_pair *p, const fe__face *face)
{
    fe_vec3 n = face->normal, edge = fe__sub(face->vertex[1], face->vertex[0]);
    edge = fe__add_scaled(edge, -fe__dot(edge, n), n);
    fe_vec3 u = fe__scale(1.0f / fe__length(edge), edge);
    float below = p->own->distances[p->face] - fe__dot(n, face->vertex[0]);
    return (plane_frame){fe__add_scaled(face->vertex[0], below, n), {u, fe__cross(n, u), n}};
}

static void project(const plane_frame *frame, const fe__face *face, fe__clip_vertex *out)
{
    for (int32_t i = 0; i < face->count; ++i) {
        fe_vec3 p = fe__mul_transposed(&frame->axes, fe__sub(face->vertex[i], frame->origin));
        out[i] = (fe__clip_vertex){p.x, p.y, p.z, fe__clip_id(i > 0 ? i - 1 : face->count - 1, i)};
    }
}

// in the frame of the reference's hull
static fe__load load_of(const hull_pair *q, const face_pair *p)
{
    fe__load load = fe__tell_load(q->load);
    load.at = fe__sub(load.at, q->offset);
    return p->own == q->a ? load : fe__load_in_frame(&load, q->b_in_a.position, &q->b_in_a.rotation);
}

// Cuts the other's face by the reference; points and normal are in the frame of the reference's hull.
static void cut_faces(const hull_pair *q, const face_pair *p, int32_t face, float margin, fe__manifold *manifold)
{
    const fe__mat3 *r = &p->other_in_own.rotation;
    fe_vec3 normal = fe__hull_normal(p->own, p->face), in_other = fe__mul_transposed(r, normal);
    fe_vec3 own_foot, other_foot;
    fe__face reference, incident;
    reference.foot = incident.foot = NULL;
    if (fe__maxi(p->own->faces[p->face].count, p->other->faces[face].count) > FE_FACE_VERTICES) {
        const fe__load load = load_of(q, p);
        if (fe__find_foot(&load, fe__scale(p->own->distances[p->face], normal), normal, &own_foot)) {
            other_foot = fe__mul_transposed(r, fe__sub(own_foot, p->other_in_own.position));
            reference.foot = &own_foot, incident.foot = &other_foot;
        }
    }
    fe__hull_polygon(p->own, p->face, normal, &reference);
    fe__hull_polygon(p->other, face, fe__neg(in_other), &incident);
    for (int32_t i = 0; i < incident.count; ++i)
        incident.vertex[i] = fe__add(p->other_in_own.position, fe__mul(r, incident.vertex[i]));
    fe__clip_vertex side[FE_FACE_VERTICES], vertex[FE_CLIP_VERTICES];
    plane_frame frame = frame_of(p, &reference);
    project(&frame, &reference, side);
    project(&frame, &incident, vertex);
    int32_t count = fe__clip_polygon(side, reference.count, vertex, incident.count, q->slack);
    uint32_t faces = (uint32_t)(p->own == q->b) << 30 | reference.id << 20 | incident.id << 10, last[4];
    fe__foot foot = {.is_known = 0};
    if (count > 4) {
        const fe__load load = load_of(q, p);
        foot = fe__foot_in_plane(&load, frame.origin, frame.axes.x, frame.axes.y, frame.axes.z);
        fe__names_of_vertices(&foot.last, ~(uint32_t)0x3ff, faces, last);
        for (int32_t i = 0; i < foot.last.count; ++i) last[i] = (last[i] & 0x3e0) << 3 | (last[i] & 0x1f);
    }
    int32_t near = fe__keep_near(vertex, count, 0.0f, margin, 0.1f * q->tie, &foot, &manifold->left_out);
    manifold->normal = normal;
    for (int32_t i = 0; i < near; ++i) {
        fe_vec3 at = {vertex[i].u, vertex[i].v, 0.5f * vertex[i].height};
        uint32_t id = (vertex[i].id >> 8 & 0x1f) << 5 | (vertex[i].id & 0x1f);
        fe__add_point(manifold, fe__add(frame.origin, fe__mul(&frame.axes, at)), vertex[i].height, faces | id);
    }
}

static fe_vec3 normal_of(const hull_pair *q, int32_t kind, int32_t face)
{
    if (kind == FE__AXIS_OF_FACE_A) return fe__hull_normal(q->a, face);
    return fe__neg(fe__mul(&q->b_in_a.rotation, fe__hull_normal(q->b, face)));
}

static int32_t touch_facing_edges(const hull_pair *q, fe_vec3 normal, float separation, float margin,
                                  fe__manifold *manifold)
{
    fe__least_overlap least = {normal, separation};
    int32_t name;
    const fe_vec3 as_it_is = {1.0f, 1.0f, 1.0f};
    const fe__scaled_hull a = {q->a, as_it_is, q->a->inner_radius}, b = {q->b, as_it_is, q->b->inner_radius};
    if (!fe__touch_facing_edges(&a, &b, &q->b_in_a, &least, margin, manifold, &name)) return 0;
    manifold->axis = FACING_EDGES << 20 | name;
    return 1;
}

static void touch_face(const hull_pair *q, int32_t kind, int32_t face, float margin, fe__manifold *manifold)
{
    face_pair p = view_of(q, kind, face);
    float separation;
    int32_t deepest = deepest_below(&p, &separation);
    incident met =
        find_incident(p.other, deepest, fe__mul_transposed(&p.other_in_own.rotation, fe__hull_normal(p.own, face)));
    if (met.lies == LIES_EDGE && runs_beside_rim(&p, deepest, met.face, separation) &&
        touch_facing_edges(q, normal_of(q, kind, face), separation, margin, manifold))
        return;
    cut_faces(q, &p, met.face, margin, manifold);
    if (kind == FE__AXIS_OF_FACE_A) return;
    manifold->normal = fe__neg(fe__mul(&q->b_in_a.rotation, manifold->normal));
    for (int32_t i = 0; i < manifold->count; ++i)
        manifold->points[i].point =
            fe__add(q->b_in_a.position, fe__mul(&q->b_in_a.rotation, manifold->points[i].point));
}

// ---- edges ---------------------------------------------------------------------------------------------------------
static float deepest_of(const fe__manifold *manifold)
{
    float deepest = FLT_MAX;
    for (int32_t i = 0; i < manifold->count; ++i) deepest = fe__minf(deepest, manifold->points[i].separation);
    return deepest;
}

// An edge that lies across a face crosses two of its rims: both get their points, if the face says as deep an overlap
// as the edges do.
static int32_t lay_on_face(const hull_pair *q, const fe__hull_axis *axis, float margin, fe__manifold *manifold)
{
    fe_dvec3 n = fe__widen(axis->normal),
             against = fe__widen(fe__neg(fe__mul_transposed(&q->b_in_a.rotation, axis->normal)));
    int32_t face_a = fe__hull_facing(q->a, n), face_b = fe__hull_facing(q->b, against);
    float cos_a = fe__dot(fe__hull_normal(q->a, face_a), axis->normal),
          cos_b = fe__dot(fe__hull_normal(q->b, face_b), fe__narrow(against));
    int32_t kind = cos_b > cos_a ? FE__AXIS_OF_FACE_B : FE__AXIS_OF_FACE_A;
    if (fe__maxf(cos_a, cos_b) <= FE_FACE_COS) return 0;
    touch_face(q, kind, kind == FE__AXIS_OF_FACE_A ? face_a : face_b, margin, manifold);
    if (manifold->count && fe__absf(deepest_of(manifold) - axis->separation) <= q->tie) return 1;
    manifold->count = 0;
    return 0;
}

// Nearest points of two edges. Lines that meet outside of their edges while the hulls are apart say nothing.
static void touch_edges(const hull_pair *q, const fe__hull_axis *axis, float margin, fe__manifold *manifold)
{
    fe_vec3 p = fe__hull_lane(&q->a->tails, axis->a), d = fe__hull_lane(&q->a->vectors, axis->a);
    fe_vec3 o = fe__add(q->b_in_a.position, fe__mul(&q->b_in_a.rotation, fe__hull_lane(&q->b->tails, axis->b)));
    fe_vec3 e = fe__mul(&q->b_in_a.rotation, fe__hull_lane(&q->b->vectors, axis->b)), r = fe__sub(o, p);
    float dd = fe__dot(d, d), ee = fe__dot(e, e), de = fe__dot(d, e), dr = fe__dot(d, r), er = fe__dot(e, r),
          det = dd * ee - de * de;
    float s = fe__clampf((dr * ee - er * de) / det, 0.0f, 1.0f), t = fe__clampf((dr * de - er * dd) / det, 0.0f, 1.0f);
    fe_vec3 on_a = fe__add_scaled(p, s, d), on_b = fe__add_scaled(o, t, e), between = fe__sub(on_b, on_a);
    float most = axis->separation + q->tie;
    if (axis->separation > 0.0f && fe__dot(between, between) > most * most) return;
    if (lay_on_face(q, axis, margin, manifold)) return;
    manifold->normal = axis->normal;
    fe__add_point(manifold, fe__scale(0.5f, fe__add(on_a, on_b)), axis->separation, (uint32_t)pack(axis) | 1u << 31);
}

// ---- the kernel ----------------------------------------------------------------------------------------------------
// A face is kept while the separation along it is within this many ties (5 mm) of what the last full test found, and no
// deeper.
#define KEEP_TIES 10.0f

// 1: the answer is that of the face of the last full test
static int32_t touch_kept_face(const hull_pair *q, float margin, fe__manifold *manifold)
{
    int32_t packed = manifold->axis, kind = kind_of(packed);
    if (packed < 0 || kind >= FE__AXIS_OF_EDGES) return 0;
    int32_t face = kind == FE__AXIS_OF_FACE_A ? packed >> 10 & 0x3ff : packed & 0x3ff;
    face_pair p = view_of(q, kind, face);
    if (face >= p.own->face_count) return 0;
    float now, tied = KEEP_TIES * q->tie;
    deepest_below(&p, &now);
    if (now > margin) {
        fe__stay_apart(manifold, now, normal_of(q, kind, face));
        return 1;
    }
    if (!(fe__absf(now - manifold->axis_separation) < tied && now > -tied)) return 0;
    touch_face(q, kind, face, margin, manifold);
    return manifold->count > 0;
}

// Do the two edges of an axis run alike, but for 5 degrees?
static int32_t are_alike(const hull_pair *q, const fe__hull_axis *axis)
{
    fe_vec3 d = fe__hull_lane(&q->a->vectors, axis->a),
            e = fe__mul(&q->b_in_a.rotation, fe__hull_lane(&q->b->vectors, axis->b));
    float along = fe__dot(d, e);
    return along * along > FE_FACE_COS * FE_FACE_COS * fe__dot(d, d) * fe__dot(e, e);
}

static void touch(const hull_pair *q, float margin, fe__manifold *manifold)
{
    if (touch_kept_face(q, margin, manifold)) return;
    // edges side by side are followed by the face that their normal has turned to
    float tie = manifold->axis >= 0 && kind_of(manifold->axis) == FACING_EDGES ? 0.0f : q->tie;
    fe__hull_axis axis = find_axis(q, tie, margin);
    manifold->axis = pack(&axis);
    fe__stay_apart(manifold, axis.separation, axis.normal);
    if (axis.separation > margin) return;
    if (axis.kind != FE__AXIS_OF_EDGES)
        touch_face(q, axis.kind, axis.kind == FE__AXIS_OF_FACE_A ? axis.a : axis.b, margin, manifold);
    else if (!(are_alike(q, &axis) && touch_facing_edges(q, axis.normal, axis.separation, margin, manifold)))
        touch_edges(q, &axis, margin, manifold);
}

// A hull and where its frame is in the form's
typedef struct placed_hull {
    const fe__hull *hull;
    fe_vec3 offset;
} placed_hull;

static void touch_hulls(const placed_hull *a, const placed_hull *b, const fe__relative *b_in_a, float margin,
                        fe__manifold *manifold)
{
    const fe__mat3 *r = &b_in_a->rotation;
    hull_pair q = {.a = a->hull, .b = b->hull};
    q.b_in_a.rotation = *r;
    q.b_in_a.position = fe__sub(fe__add(b_in_a->position, fe__mul(r, b->offset)), a->offset);
    float smallest = fe__minf(q.a->inner_radius, q.b->inner_radius), largest = fe__maxf(q.a->extent, q.b->extent);
    q.tie = fe__tie(smallest);
    q.slack = 1e-4f * smallest + 1e-7f * largest;
    q.load = manifold->load, q.offset = a->offset;
    touch(&q, margin, manifold);
    for (int32_t i = 0; i < manifold->count; ++i)
        manifold->points[i].point = fe__add(manifold->points[i].point, a->offset);
}

static placed_hull place(const fe__form *form, fe__box_hull *room)
{
    if (fe__form_is_hull(form)) {
        assert(form->scale == 1.0f); // only casts shrink hulls
        return (placed_hull){form->hull, form->offset};
    }
    fe__box_as_hull(form, room);
    return (placed_hull){&room->hull, {0.0f, 0.0f, 0.0f}};
}

void fe__collide_hulls(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                       fe__manifold *manifold)
{
    fe__box_hull room; // of one of the two: boxes have a kernel of their own
    placed_hull first = place(a, &room), second = place(b, &room);
    touch_hulls(&first, &second, b_in_a, margin, manifold);
    // no axis separates them by more than the margin, yet neither faces nor edges meet: a corner near a rim
    if (manifold->count == 0 && !(manifold->axis_separation > margin))
        fe__collide_convex(a, b, b_in_a, margin, manifold);
}
