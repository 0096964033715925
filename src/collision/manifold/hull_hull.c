// hull_hull.c - hull against hull, and against a box taken for one: the axis of least overlap (hull_hull.c), then a
// face cut by a face, or two crossing edges.
//
// A kernel of collide.c's table. A face of A beats a face of B beats a pair of edges unless the later is better by
// fe__tie, and within a class the lowest feature wins. manifold->axis names the features of the last full test and
// axis_separation what that found along them: a face that has hardly moved since is cut again without another test.
#define FE_W 4
#include "collision/manifold/hull_hull.h"

#include "collision/form/hull.h"
#include "collision/manifold/facing_edges.h"
#include "collision/manifold/pair_kernels.h"
#include "core/lanes.h"
#include "core/simd.h"

#include <assert.h>
#include <float.h>
#include <string.h>

// ---- hull hull ------------------------------------------------------------------------------------------------------

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

// ---- hull axis ------------------------------------------------------------------------------------------------------
// See hull_hull.h. Four vertices, or four edges of A, are looked at side by side.

// Sine of the angle below which two edges are parallel: their cross product is rounding, and a face says it better
static const float parallel = 0.005f;

// ---- faces ---------------------------------------------------------------------------------------------------------
typedef struct lanes {
    wide x, y, z;
} lanes;

static inline wide wide_at(const float *from)
{
    wide to;
    memcpy(&to, from, sizeof to);
    return to;
}
static inline lanes lanes_at(const fe__hull_lanes *from, int32_t i)
{
    return (lanes){wide_at(from->x + i), wide_at(from->y + i), wide_at(from->z + i)};
}
// as fe__dot
static inline wide along(const lanes *a, fe_vec3 b) { return a->x * b.x + a->y * b.y + a->z * b.z; }

// The vertex least far along a direction; of equals the lowest. Lanes past the last vertex repeat the first.
static int32_t least_along(const fe__hull *hull, fe_vec3 direction, float *least)
{
    wide low = w_set(FLT_MAX);
    wide_int at = {0, 0, 0, 0}, index = {0, 1, 2, 3};
    for (int32_t v = 0; v < hull->vertex_count; v += FE_W) {
        lanes p = lanes_at(&hull->vertices, v);
        wide here = along(&p, direction);
        wide_int lower = here < low;
        low = w_min(here, low);
        at = (index & lower) | (at & ~lower);
        index += FE_W;
    }
    int32_t best = 0;
    for (int32_t k = 1; k < FE_W; ++k)
        if (low[k] < low[best] || (low[k] == low[best] && at[k] < at[best])) best = k;
    *least = low[best];
    return at[best];
}

// Which planes, four from i on, may hold a point q of the other hull farther off than `least`? A bit for each
static uint32_t faces_near(const fe__hull *hull, int32_t i, fe_vec3 q, float least)
{
    lanes normal = lanes_at(&hull->normals, i);
    int32_t rest = hull->face_count - i;
    return w_bits(along(&normal, q) - wide_at(hull->distances + i) >= least) & (rest < FE_W ? (1u << rest) - 1u : 0xfu);
}

static float size(fe_vec3 a) { return fe__absf(a.x) + fe__absf(a.y) + fe__absf(a.z); }

// Of `own`, against the vertices of `other`, which stands at `position` with axes turned by `rotation`. A plane holds
// the hulls apart by no more than it does any vertex: that which lies least far along the best so far shows most planes
// to be worse, side by side up to roundings, then by the same sum as all vertices.
static fe__hull_axis of_faces(const fe__hull *own, const fe__hull *other, fe_vec3 position, const fe__mat3 *rotation)
{
    const float rounding = 1e-5f; // of the sizes
    float doubt = rounding * (own->extent + other->extent + size(position));
    fe__hull_axis best = {.separation = -FLT_MAX};
    fe_vec3 nearest = fe__hull_vertex(other, 0), there = fe__add(position, fe__mul(rotation, nearest));
    for (int32_t first = 0; first < own->face_count; first += FE_W) {
        uint32_t left = faces_near(own, first, there, best.separation - doubt);
        for (; left; left &= left - 1) {
            int32_t i = first + __builtin_ctz(left);
            float least;
            fe_vec3 normal = fe__hull_normal(own, i), direction = fe__mul_transposed(rotation, normal);
            float beyond = fe__dot(normal, position) - own->distances[i];
            if (fe__dot(nearest, direction) + beyond <= best.separation) continue;
            int32_t deepest = least_along(other, direction, &least);
            float separation = least + beyond;
            if (!(separation > best.separation)) continue;
            best = (fe__hull_axis){.separation = separation, .normal = normal, .a = i, .b = deepest};
            nearest = fe__hull_vertex(other, deepest), there = fe__add(position, fe__mul(rotation, nearest));
        }
    }
    return best;
}

fe__hull_axis fe__hull_axis_of_faces_a(const fe__hull *a, const fe__hull *b, const fe__relative *b_in_a)
{
    fe__hull_axis axis = of_faces(a, b, b_in_a->position, &b_in_a->rotation);
    axis.kind = FE__AXIS_OF_FACE_A;
    return axis;
}

fe__hull_axis fe__hull_axis_of_faces_b(const fe__hull *a, const fe__hull *b, const fe__relative *b_in_a)
{
    const fe__mat3 *r = &b_in_a->rotation;
    fe__mat3 back = {{r->x.x, r->y.x, r->z.x}, {r->x.y, r->y.y, r->z.y}, {r->x.z, r->y.z, r->z.z}};
    fe__hull_axis axis = of_faces(b, a, fe__neg(fe__mul_transposed(r, b_in_a->position)), &back);
    int32_t face = axis.a;
    axis.a = axis.b, axis.b = face;
    axis.normal = fe__neg(fe__mul(r, axis.normal));
    axis.kind = FE__AXIS_OF_FACE_B;
    return axis;
}

// ---- edges ---------------------------------------------------------------------------------------------------------
typedef struct arc {
    fe_vec3 tail, vector, left, right; // A's frame
} arc;

static arc arc_of(const fe__hull *h, int32_t k)
{
    return (arc){fe__hull_lane(&h->tails, k), fe__hull_lane(&h->vectors, k), fe__hull_lane(&h->left, k),
                 fe__hull_lane(&h->right, k)};
}

static arc moved(const arc *b, const fe__relative *b_in_a)
{
    const fe__mat3 *r = &b_in_a->rotation;
    return (arc){fe__add(fe__mul(r, b->tail), b_in_a->position), fe__mul(r, b->vector), fe__mul(r, b->left),
                 fe__mul(r, b->right)};
}

// Does the arc of A cross that of B turned inside out? Each arc's ends are on both sides of the other's plane, and the
// arcs are on one half of the sphere. An edge's vector is normal to the plane of its arc. A bit for each edge of A from
// i on.
static uint32_t arcs_cross(const fe__hull *a, int32_t i, const arc *b)
{
    lanes vector = lanes_at(&a->vectors, i), left = lanes_at(&a->left, i), right = lanes_at(&a->right, i);
    const wide zero = {0.0f, 0.0f, 0.0f, 0.0f};
    wide bl = along(&vector, b->left), br = along(&vector, b->right), al = along(&left, b->vector),
         ar = along(&right, b->vector);
    wide_int cross = (bl * br < zero) & (al * ar < zero) & (bl * ar < zero);
    int32_t rest = a->edge_count - i;
    return w_bits(cross) & (rest < FE_W ? (1u << rest) - 1u : 0xfu);
}

static void try_edges(const fe__hull *a, int32_t i, const arc *eb, int32_t j, fe__hull_axis *best)
{
    arc ea = arc_of(a, i);
    fe_vec3 n = fe__cross(ea.vector, eb->vector);
    float square = fe__dot(n, n), limit = parallel * parallel * fe__dot(ea.vector, ea.vector);
    if (square <= limit * fe__dot(eb->vector, eb->vector)) return;
    float k = 1.0f / sqrtf(square);
    n = fe__scale(fe__dot(n, fe__add(ea.left, ea.right)) < 0.0f ? -k : k, n); // out of A
    float separation = fe__dot(n, fe__sub(eb->tail, ea.tail));
    if (separation > best->separation) *best = (fe__hull_axis){separation, n, FE__AXIS_OF_EDGES, i, j};
}

// Which edges of a hull, four from i on, can part it from a point q of the other by more than `least`, which is 0 or
// less? All axes n of an edge lie on its arc, between the normals l and r of its faces, and separate by no more than
// n . (q - tail). Where  l . (q - tail)  and  r . (q - tail)  are below 0, that is no more than the larger of the two.
static uint32_t edges_near(const fe__hull *hull, int32_t i, fe_vec3 q, float least)
{
    lanes left = lanes_at(&hull->left, i), right = lanes_at(&hull->right, i), tail = lanes_at(&hull->tails, i);
    lanes way = {q.x - tail.x, q.y - tail.y, q.z - tail.z};
    wide over_left = left.x * way.x + left.y * way.y + left.z * way.z,
         over_right = right.x * way.x + right.y * way.y + right.z * way.z;
    int32_t rest = hull->edge_count - i;
    return w_bits((over_left >= least) | (over_right >= least)) & (rest < FE_W ? (1u << rest) - 1u : 0xfu);
}

// Fours of edges of which one or more is near
static int32_t find_fours(const fe__hull *hull, fe_vec3 q, float least, int16_t *out_first)
{
    int32_t count = 0;
    for (int32_t i = 0; i < hull->edge_count; i += FE_W) {
        out_first[count] = (int16_t)i;
        count += edges_near(hull, i, q, least) != 0;
    }
    return count;
}

fe__hull_axis fe__hull_axis_of_edges(const fe__hull *a, const fe__hull *b, const fe__relative *b_in_a, float least,
                                     int32_t vertex_a, int32_t vertex_b)
{
    const float rounding = 1e-5f; // of the sizes
    float apart = fe__minf(least, 0.0f) - rounding * (a->extent + b->extent);
    const fe__mat3 *r = &b_in_a->rotation;
    fe_vec3 p = fe__mul_transposed(r, fe__sub(fe__hull_vertex(a, vertex_a), b_in_a->position)),
            q = fe__add(b_in_a->position, fe__mul(r, fe__hull_vertex(b, vertex_b)));
    int16_t fours[FE__HULL_EDGES / FE_W + 2]; // one is written behind the last
    int32_t count = find_fours(a, q, apart, fours);
    fe__hull_axis best = {.separation = -FLT_MAX, .kind = FE__AXIS_OF_EDGES};
    for (int32_t first = 0; first < b->edge_count; first += FE_W) {
        for (uint32_t near = edges_near(b, first, p, apart); near != 0; near &= near - 1) {
            int32_t j = first + __builtin_ctz(near);
            arc own = arc_of(b, j), eb = moved(&own, b_in_a);
            for (int32_t k = 0; k < count; ++k)
                for (uint32_t left = arcs_cross(a, fours[k], &eb); left != 0; left &= left - 1)
                    try_edges(a, fours[k] + __builtin_ctz(left), &eb, j, &best);
        }
    }
    return best;
}

// ---- hull box -------------------------------------------------------------------------------------------------------
// See hull_hull.h.
//
// Vertex i is at + along x, y, z where bit 0, 1, 2 of i is set. Faces: -x, +x, -y, +y, -z, +z.

enum { VERTICES = 8, FACES = 6, EDGES = 12 };

// a face's corners turn left around its normal
static const uint8_t corners[2 * EDGES] = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
static const fe__hull_face faces[FACES] = {{0, 4, 0, 0},  {4, 4, 0, 0},  {8, 4, 0, 0},
                                           {12, 4, 0, 0}, {16, 4, 0, 0}, {20, 4, 0, 0}};

// In half widths: the vertices; of each edge the vertex with the lower number, and the way from there to the other
_Alignas(64) static const
    float signs[3][FE__HULL_LANES] = {{-1, 1, -1, 1, -1, 1, -1, 1, -1, -1, -1, -1, -1, -1, -1, -1},
                                      {-1, -1, 1, 1, -1, -1, 1, 1, -1, -1, -1, -1, -1, -1, -1, -1},
                                      {-1, -1, -1, -1, 1, 1, 1, 1, -1, -1, -1, -1, -1, -1, -1, -1}};
_Alignas(64) static const
    float tails[3][FE__HULL_LANES] = {{-1, -1, -1, -1, 1, 1, 1, 1, -1, -1, -1, -1, -1, -1, -1, -1},
                                      {-1, -1, 1, -1, -1, 1, -1, -1, -1, -1, 1, 1, -1, -1, -1, -1},
                                      {-1, 1, -1, -1, -1, -1, 1, -1, -1, 1, 1, -1, -1, -1, -1, -1}};
_Alignas(64) static const float vectors[3][FE__HULL_LANES] = {{0, 0, 0, 0, 0, 0, 0, 0, 2, 2, 2, 2},
                                                              {0, 2, 0, 2, 2, 0, 2},
                                                              {2, 0, 2, 0, 0, 2, 0, 2, 0, 0, 0, 0, 2, 2, 2, 2}};

// unit normals, of the faces, and of those left and right of each edge; lanes past the count repeat the first
_Alignas(64) static const
    float normals[3][FE__HULL_LANES] = {{-1, 1, 0, 0, 0, 0, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1},
                                        {0, 0, -1, 1, 0, 0},
                                        {0, 0, 0, 0, -1, 1}};
_Alignas(64) static const float left[3][FE__HULL_LANES] = {{-1, -1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, -1, -1, -1, -1},
                                                           {0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 1, 0},
                                                           {0, 0, 0, -1, 0, 0, 1, 0, 0, 1, 0, -1}};
_Alignas(64) static const float right[3][FE__HULL_LANES] = {{0, 0, -1, -1, 0, 0, 1, 1, 0, 0, 0, 0},
                                                            {-1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 0, 1, -1, -1, -1, -1},
                                                            {0, 1, 0, 0, -1, 0, 0, 0, -1, 0, 1, 0}};

const fe__hull fe__unit_box = {.vertex_count = VERTICES,
                               .face_count = FACES,
                               .edge_count = EDGES,
                               .thickness = 2.0f,
                               .inner_radius = 1.0f,
                               .extent = 2.0f,
                               .vertices = {signs[0], signs[1], signs[2]},
                               .normals = {normals[0], normals[1], normals[2]},
                               .tails = {tails[0], tails[1], tails[2]},
                               .vectors = {vectors[0], vectors[1], vectors[2]},
                               .left = {left[0], left[1], left[2]},
                               .right = {right[0], right[1], right[2]},
                               .faces = faces,
                               .corners = corners};

static void scale(float half, const float from[FE__HULL_LANES], float to[FE__HULL_LANES])
{
    for (int32_t i = 0; i < FE__HULL_LANES; i += 4) *(fe__quad *)(to + i) = half * *(const fe__quad *)(from + i);
}

void fe__box_as_hull(const fe__form *box, fe__box_hull *out)
{
    const float half[3] = {box->half.x, box->half.y, box->half.z};
    float least = fe__minf(half[0], fe__minf(half[1], half[2])), most = fe__maxf(half[0], fe__maxf(half[1], half[2]));
    for (int32_t k = 0; k < 3; ++k) {
        scale(half[k], signs[k], out->vertices[k]);
        scale(half[k], tails[k], out->tails[k]);
        scale(half[k], vectors[k], out->vectors[k]);
    }
    const fe__quad x_y = {half[0], half[0], half[1], half[1]}, z = {half[2], half[2], half[0], half[0]},
                   x = fe__quad_set(half[0]); // lanes past the count repeat the first
    fe__quad *distances = (fe__quad *)out->distances;
    distances[0] = x_y, distances[1] = z, distances[2] = distances[3] = x;
    out->hull = (fe__hull){.vertex_count = VERTICES,
                           .face_count = FACES,
                           .edge_count = EDGES,
                           .low = fe__neg(box->half),
                           .high = box->half,
                           .thickness = 2.0f * least,
                           .inner_radius = least,
                           .extent = 2.0f * most,
                           .vertices = {out->vertices[0], out->vertices[1], out->vertices[2]},
                           .normals = {normals[0], normals[1], normals[2]},
                           .distances = out->distances,
                           .tails = {out->tails[0], out->tails[1], out->tails[2]},
                           .vectors = {out->vectors[0], out->vectors[1], out->vectors[2]},
                           .left = {left[0], left[1], left[2]},
                           .right = {right[0], right[1], right[2]},
                           .faces = faces,
                           .corners = corners};
}
