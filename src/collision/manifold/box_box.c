// box_box.c - box against box: the separating axis test (Gottschalk, Lin, Manocha, 1996), then a face cut by a face or
// two crossing edges.
//
// A kernel of collide.c's table. All is in the frame of A: half extents a; B has half extents b, centre t and axes R,
// R_ij = A_i . B_j. Axes are numbered  0..2 face of A,  3..5 face of B,  6..14 edges A_i x B_j as 6 + 3 i + j;  a
// separation below 0 is a depth. Rows of R serve four lanes.
//
// Ties: a face of A beats a face of B beats an edge unless the later is better by fe__tie, and within a class the
// lowest number wins, so that equal axes never alternate. manifold->axis is the axis of the last full test and
// axis_separation what that test found along it: a face that has hardly moved since is cut again without another test.
#define FE_W 4
#include "collision/form/clip.h"
#include "collision/manifold/facing_edges.h"
#include "collision/manifold/hull_hull.h"
#include "collision/manifold/pair_kernels.h"

#include "core/simd.h"

#include <float.h>

enum { FACE_A = 0, FACE_B = 3, EDGE = 6, AXES = 15, FACING_EDGES = AXES };

typedef struct box_pair {
    wide a, b, t;
    wide column[3]; // R_0j R_1j R_2j: B_j in A's frame
    wide row[3];    // R_i0 R_i1 R_i2: A_i in B's frame
    wide abs_row[3];
    float tie;
    float slack; // by which a face reaches beyond its rim: 1e-4 of the smallest half extent, and the rounding of the
                 // largest
} box_pair;

static inline wide absolute(wide x) { return (wide)((wide_int)x & 0x7fffffff); }
static inline wide pack(fe_vec3 v) { return (wide){v.x, v.y, v.z, 0.0f}; }
static inline wide turn1(wide x) { return __builtin_shufflevector(x, x, 1, 2, 0, 3); } // y z x
static inline wide turn2(wide x) { return __builtin_shufflevector(x, x, 2, 0, 1, 3); } // z x y
static inline float least(fe_vec3 v) { return fe__minf(v.x, fe__minf(v.y, v.z)); }
static inline float greatest(fe_vec3 v) { return fe__maxf(v.x, fe__maxf(v.y, v.z)); }

static inline box_pair make_pair(const fe__form *a, const fe__form *b, const fe__relative *b_in_a)
{
    const fe_vec3 x = b_in_a->rotation.x, y = b_in_a->rotation.y, z = b_in_a->rotation.z;
    box_pair q;
    q.a = pack(a->half), q.b = pack(b->half), q.t = pack(b_in_a->position);
    q.column[0] = pack(x), q.column[1] = pack(y), q.column[2] = pack(z);
    q.row[0] = (wide){x.x, y.x, z.x, 0.0f}, q.row[1] = (wide){x.y, y.y, z.y, 0.0f},
    q.row[2] = (wide){x.z, y.z, z.z, 0.0f};
    for (int32_t i = 0; i < 3; ++i) q.abs_row[i] = absolute(q.row[i]);
    float smallest = fe__minf(least(a->half), least(b->half)), largest = fe__maxf(greatest(a->half), greatest(b->half));
    q.tie = fe__tie(smallest);
    q.slack = 1e-4f * smallest + 2e-7f * largest;
    return q;
}

// ---- the axes ------------------------------------------------------------------------------------------------------
// A_i: |t_i| - a_i - sum_j |R_ij| b_j
static inline wide faces_of_a(const box_pair *q)
{
    wide reach = absolute(q->column[0]) * q->b[0] + absolute(q->column[1]) * q->b[1] + absolute(q->column[2]) * q->b[2];
    return absolute(q->t) - (q->a + reach);
}

// B_j: |sum_i t_i R_ij| - b_j - sum_i a_i |R_ij|
static inline wide faces_of_b(const box_pair *q)
{
    wide reach = q->abs_row[0] * q->a[0] + q->abs_row[1] * q->a[1] + q->abs_row[2] * q->a[2];
    return absolute(q->row[0] * q->t[0] + q->row[1] * q->t[1] + q->row[2] * q->t[2]) - (q->b + reach);
}

// Below this sin^2 (1.8 degrees) two edges count as parallel: their cross product is noise, and a face says the same.
#define PARALLEL 1e-3f

// A_i x B_j for j = 0, 1, 2, with (i, u, v) and (j, k, l) cyclic:
//   (|t_v R_uj - t_u R_vj| - a_u |R_vj| - a_v |R_uj| - b_k |R_il| - b_l |R_ik|) / sqrt(R_uj^2 + R_vj^2)
static inline wide edges_of(const box_pair *q, int32_t i, int32_t u, int32_t v)
{
    wide square = q->row[u] * q->row[u] + q->row[v] * q->row[v];
    wide reach_a = q->abs_row[v] * q->a[u] + q->abs_row[u] * q->a[v];
    wide reach_b = turn1(q->b) * turn2(q->abs_row[i]) + turn2(q->b) * turn1(q->abs_row[i]);
    wide gap = absolute(q->row[u] * q->t[v] - q->row[v] * q->t[u]) - reach_a - reach_b;
    return w_choose(square < w_set(PARALLEL), w_set(-FLT_MAX), gap / w_sqrt(w_max(square, w_set(PARALLEL))));
}

static inline wide edge_row(const box_pair *q, int32_t i)
{
    return i == 0 ? edges_of(q, 0, 1, 2) : i == 1 ? edges_of(q, 1, 2, 0) : edges_of(q, 2, 0, 1);
}

static inline void keep_best(wide lanes, int32_t first, int32_t *axis, float *separation)
{
    for (int32_t k = 0; k < 3; ++k) {
        if (lanes[k] > *separation) *separation = lanes[k], *axis = first + k;
    }
}

// The best axis; stops at the first class that separates by more than the margin. A face of B is better by `tie`.
static int32_t find_axis(const box_pair *q, float tie, float margin, float *separation)
{
    int32_t axis = FACE_A;
    float best = -FLT_MAX;
    keep_best(faces_of_a(q), FACE_A, &axis, &best);
    if (best <= margin) {
        float better = best + tie;
        int32_t found = -1;
        keep_best(faces_of_b(q), FACE_B, &found, &better);
        if (found >= 0) axis = found, best = better;
    }
    if (best <= margin) {
        float better = best + q->tie;
        int32_t found = -1;
        for (int32_t i = 0; i < 3; ++i) keep_best(edge_row(q, i), EDGE + 3 * i, &found, &better);
        if (found >= 0) axis = found, best = better;
    }
    *separation = best;
    return axis;
}

static float separation_along(const box_pair *q, int32_t axis)
{
    if (axis < FACE_B) return faces_of_a(q)[axis];
    if (axis < EDGE) return faces_of_b(q)[axis - FACE_B];
    return edge_row(q, (axis - EDGE) / 3)[(axis - EDGE) % 3];
}

// sin^2 of the angle between A_i and B_j, and the parts along A_u and A_v of the unit normal A_i x B_j, from A to B
typedef struct edge_normal {
    float square, u, v;
} edge_normal;

static edge_normal edge_normal_of(const box_pair *q, int32_t u, int32_t v, int32_t j)
{
    float nu = -q->row[v][j], nv = q->row[u][j], square = nu * nu + nv * nv, inverse = 1.0f / sqrtf(square);
    if (nu * q->t[u] + nv * q->t[v] < 0.0f) inverse = -inverse;
    return (edge_normal){square, nu * inverse, nv * inverse};
}

static const int8_t next[5] = {0, 1, 2, 0, 1};

// unit, from A to B, of boxes that the axis separates
static fe_vec3 normal_along(const box_pair *q, int32_t axis)
{
    float n[3] = {0.0f, 0.0f, 0.0f};
    if (axis < FACE_B) {
        n[axis] = q->t[axis] < 0.0f ? -1.0f : 1.0f;
    } else if (axis < EDGE) {
        wide b = q->column[axis - FACE_B], along = b * q->t;
        float sign = along[0] + along[1] + along[2] < 0.0f ? -1.0f : 1.0f;
        for (int32_t k = 0; k < 3; ++k) n[k] = sign * b[k];
    } else {
        int32_t i = (axis - EDGE) / 3, u = next[i + 1], v = next[i + 2];
        edge_normal e = edge_normal_of(q, u, v, (axis - EDGE) % 3);
        n[u] = e.u, n[v] = e.v;
    }
    return fe__vec3(n[0], n[1], n[2]);
}

// ---- a face against a face ------------------------------------------------------------------------------------------
// Two boxes seen from the one whose face is the reference.
typedef struct face_view {
    float half[3], other[3]; // half extents of the reference box and of the other
    float centre[3];         // of the other
    float axis[3][3];        // axis[i][j]: component i of the other's axis j
} face_view;

static face_view view_from_a(const box_pair *q)
{
    face_view view;
    for (int32_t i = 0; i < 3; ++i) {
        view.half[i] = q->a[i], view.other[i] = q->b[i], view.centre[i] = q->t[i];
        for (int32_t j = 0; j < 3; ++j) view.axis[i][j] = q->row[i][j];
    }
    return view;
}

static face_view view_from_b(const box_pair *q)
{
    wide centre = q->row[0] * q->t[0] + q->row[1] * q->t[1] + q->row[2] * q->t[2];
    face_view view;
    for (int32_t i = 0; i < 3; ++i) {
        view.half[i] = q->b[i], view.other[i] = q->a[i], view.centre[i] = -centre[i];
        for (int32_t j = 0; j < 3; ++j) view.axis[i][j] = q->column[i][j];
    }
    return view;
}

// The face of the other box that looks most against the reference face f, in the frame (u, v, height over f).
static fe__parallelogram incident_face(const face_view *q, int32_t f, int32_t u, int32_t v, float side)
{
    int32_t k = 0;
    for (int32_t j = 1; j < 3; ++j) {
        if (fe__absf(q->axis[f][j]) > fe__absf(q->axis[f][k])) k = j;
    }
    int32_t x = next[k + 1], y = next[k + 2];
    float out = side * q->axis[f][k] > 0.0f ? -q->other[k] : q->other[k], gx = q->other[x], gy = q->other[y];
    fe_vec3 centre = {q->centre[u] + out * q->axis[u][k], q->centre[v] + out * q->axis[v][k],
                      side * (q->centre[f] + out * q->axis[f][k]) - q->half[f]};
    return (fe__parallelogram){centre,
                               {gx * q->axis[u][x], gx * q->axis[v][x], side * gx * q->axis[f][x]},
                               {gy * q->axis[u][y], gy * q->axis[v][y], side * gy * q->axis[f][y]}};
}

// The points of face f of the reference box, in the reference box's frame, midway between the surfaces.
static float clip_faces(const box_pair *pair, const face_view *q, int32_t axis, int32_t f, float margin,
                        fe__manifold *manifold)
{
    int32_t u = next[f + 1], v = next[f + 2];
    float side = q->centre[f] < 0.0f ? -1.0f : 1.0f;
    fe__parallelogram incident = incident_face(q, f, u, v, side);
    fe__clip_vertex vertex[12];
    int32_t count = fe__clip_rectangle(&incident, q->half[u], q->half[v], pair->slack, margin, vertex);
    count = fe__reduce_to_four(vertex, count, 0.1f * pair->tie, NULL, NULL);
    for (int32_t i = 0; i < count; ++i) {
        float p[3];
        p[f] = side * (q->half[f] + 0.5f * vertex[i].height), p[u] = vertex[i].u, p[v] = vertex[i].v;
        fe__add_point(manifold, fe__vec3(p[0], p[1], p[2]), vertex[i].height, (uint32_t)axis << 16 | vertex[i].id);
    }
    return side;
}

static fe_vec3 unpack(wide x) { return fe__vec3(x[0], x[1], x[2]); }

static void touch_faces(const box_pair *q, int32_t axis, float margin, fe__manifold *manifold)
{
    if (axis < FACE_B) {
        face_view view = view_from_a(q);
        float side = clip_faces(q, &view, axis, axis, margin, manifold);
        manifold->normal = fe__vec3(axis == 0 ? side : 0.0f, axis == 1 ? side : 0.0f, axis == 2 ? side : 0.0f);
        return;
    }
    face_view view = view_from_b(q);
    float side = clip_faces(q, &view, axis, axis - FACE_B, margin, manifold);
    manifold->normal = fe__scale(-side, unpack(q->column[axis - FACE_B]));
    for (int32_t i = 0; i < manifold->count; ++i) {
        fe_vec3 p = manifold->points[i].point;
        manifold->points[i].point = unpack(q->t + q->column[0] * p.x + q->column[1] * p.y + q->column[2] * p.z);
    }
}

// ---- an edge against an edge ----------------------------------------------------------------------------------------
// The face of either box whose normal n is, but for 5 degrees; -1: none.
static int32_t face_along(const box_pair *q, fe_vec3 n)
{
    float most = FE_FACE_COS, of_a[3] = {n.x, n.y, n.z};
    int32_t face = -1;
    for (int32_t k = 0; k < 3; ++k) {
        if (fe__absf(of_a[k]) > most) most = fe__absf(of_a[k]), face = FACE_A + k;
    }
    for (int32_t k = 0; k < 3; ++k) {
        float of_b = fe__absf(fe__dot(n, unpack(q->column[k])));
        if (of_b > most) most = of_b, face = FACE_B + k;
    }
    return face;
}

// An edge that lies across a face crosses two of its rims. Which of the two is deeper changes with the least turn, and
// one point that jumps from rim to rim swings the boxes for ever; so both rims get their points, if the face says as
// deep an overlap as the edges do.
static int32_t lay_on_face(const box_pair *q, fe_vec3 n, float separation, float margin, fe__manifold *manifold)
{
    int32_t face = face_along(q, n);
    if (face < 0) return 0;
    touch_faces(q, face, margin, manifold);
    float deepest = FLT_MAX;
    for (int32_t i = 0; i < manifold->count; ++i) deepest = fe__minf(deepest, manifold->points[i].separation);
    if (fe__absf(deepest - separation) <= q->tie && fe__dot(manifold->normal, n) > 0.0f) {
        manifold->axis = face;
        manifold->axis_separation = separation_along(q, face);
        return 1;
    }
    manifold->count = 0;
    return 0;
}

// The support edges along n: pa + s A_i and pb + r B_j, and their nearest points. Lines that meet outside their edges
// while the boxes are apart say nothing: something else of the boxes is nearest.
static void touch_edges(const box_pair *q, int32_t axis, float separation, float margin, fe__manifold *manifold)
{
    int32_t i = (axis - EDGE) / 3, j = (axis - EDGE) % 3, u = next[i + 1], v = next[i + 2], k = next[j + 1],
            l = next[j + 2];
    edge_normal e = edge_normal_of(q, u, v, j);
    float nu = e.u, nv = e.v, square = e.square, n[3], pa[3];
    n[i] = 0.0f, n[u] = nu, n[v] = nv;
    pa[i] = 0.0f, pa[u] = nu > 0.0f ? q->a[u] : -q->a[u], pa[v] = nv > 0.0f ? q->a[v] : -q->a[v];

    fe_vec3 normal = {n[0], n[1], n[2]}, edge_b = unpack(q->column[j]);
    float nk = fe__dot(normal, unpack(q->column[k])), nl = fe__dot(normal, unpack(q->column[l]));
    fe_vec3 on_b = unpack(q->t + q->column[k] * (nk > 0.0f ? -q->b[k] : q->b[k]) +
                          q->column[l] * (nl > 0.0f ? -q->b[l] : q->b[l]));
    fe_vec3 d = fe__sub(on_b, fe__vec3(pa[0], pa[1], pa[2]));
    float along_a = i == 0 ? d.x : i == 1 ? d.y : d.z, along_b = fe__dot(d, edge_b), cosine = q->row[i][j];
    float s = fe__clampf((along_a - cosine * along_b) / square, -q->a[i], q->a[i]);
    float r = fe__clampf((cosine * along_a - along_b) / square, -q->b[j], q->b[j]);
    pa[i] = s;
    fe_vec3 on_a = {pa[0], pa[1], pa[2]};
    on_b = fe__add_scaled(on_b, r, edge_b);
    d = fe__sub(on_b, on_a);
    float most = separation + q->tie;
    if (separation > 0.0f && fe__dot(d, d) > most * most) return;
    if (lay_on_face(q, normal, separation, margin, manifold)) return;
    manifold->normal = normal;
    uint32_t signs =
        (uint32_t)(nu > 0.0f) | (uint32_t)(nv > 0.0f) << 1 | (uint32_t)(nk > 0.0f) << 2 | (uint32_t)(nl > 0.0f) << 3;
    fe__add_point(manifold, fe__scale(0.5f, fe__add(on_a, on_b)), separation, (uint32_t)axis << 16 | signs);
}

// ---- the kernel ----------------------------------------------------------------------------------------------------
// A face is kept while the separation along it is within this many ties (5 mm) of what the last full test found, and no
// deeper: what a full test would give differs from it by no more than that depth.
#define KEEP_TIES 10.0f

// Has the other box a face along this one, but for 5 degrees? Then faces meet, and no edges.
static int32_t has_face_along(const box_pair *q, int32_t face)
{
    wide across = absolute(face < FACE_B ? q->row[face] : q->column[face - FACE_B]);
    return fe__maxf(across[0], fe__maxf(across[1], across[2])) > FE_FACE_COS;
}

// They have one axis in common but for 5 degrees, and no face meets another.
static int32_t may_have_facing_edges(const box_pair *q, int32_t axis)
{
    if (axis < EDGE && has_face_along(q, axis)) return 0;
    const wide across = w_max(q->abs_row[0], w_max(q->abs_row[1], q->abs_row[2]));
    return fe__maxf(across[0], fe__maxf(across[1], across[2])) > FE_FACE_COS;
}

static int32_t touch_facing_edges(const box_pair *q, const fe__form *a, const fe__form *b, const fe__relative *b_in_a,
                                  int32_t axis, float separation, float margin, fe__manifold *manifold)
{
    if (!may_have_facing_edges(q, axis)) return 0;
    const fe__scaled_hull of_a = {&fe__unit_box, a->half, fe__form_thickness(a)},
                          of_b = {&fe__unit_box, b->half, fe__form_thickness(b)};
    fe__least_overlap least = {normal_along(q, axis), separation};
    int32_t name;
    if (!fe__touch_facing_edges(&of_a, &of_b, b_in_a, &least, margin, manifold, &name)) return 0;
    manifold->axis = FACING_EDGES + name;
    return 1;
}

static int32_t is_kept(const box_pair *q, int32_t axis, float now, float before)
{
    return axis < EDGE && fe__absf(now - before) < KEEP_TIES * q->tie && now > -KEEP_TIES * q->tie;
}

void fe__collide_box_box(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                         fe__manifold *manifold)
{
    box_pair q = make_pair(a, b, b_in_a);
    if (manifold->axis >= 0 && manifold->axis < AXES) {
        float now = separation_along(&q, manifold->axis);
        if (now > margin) {
            fe__stay_apart(manifold, now, normal_along(&q, manifold->axis));
            return;
        }
        if (is_kept(&q, manifold->axis, now, manifold->axis_separation)) {
            if (touch_facing_edges(&q, a, b, b_in_a, manifold->axis, now, margin, manifold)) return;
            touch_faces(&q, manifold->axis, margin, manifold);
            if (manifold->count > 0) return;
        }
    }
    // edges side by side are followed by the face that their normal has turned to
    float separation, tie = manifold->axis < AXES ? q.tie : 0.0f;
    int32_t axis = find_axis(&q, tie, margin, &separation);
    manifold->axis = axis;
    manifold->axis_separation = separation;
    if (separation > margin) {
        manifold->normal = normal_along(&q, axis);
        return;
    }
    if (touch_facing_edges(&q, a, b, b_in_a, axis, separation, margin, manifold)) return;
    if (axis < EDGE)
        touch_faces(&q, axis, margin, manifold);
    else
        touch_edges(&q, axis, separation, margin, manifold);
    // no axis separates them by more than the margin, yet neither faces nor edges meet: a corner near a rim
    if (manifold->count == 0) fe__collide_convex(a, b, b_in_a, margin, manifold);
}
