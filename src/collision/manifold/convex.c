// convex.c - any two convex forms: the general path.
//
// Called by collide.c for pairs without a kernel, and by kernels for the cases they leave (a capsule whose core cuts a
// box, boxes corner to rim). Knows forms by support points and faces only (form.h). The nearest points of the cores
// (gjk.c), or the deepest (epa.c), give normal and separation; where a face lies along that normal it is cut with what
// faces it (clip.c), else the one point is the contact.
#include "collision/form/gjk.h"
#include "collision/manifold/pair_kernels.h"
#include "collision/form/form.h"

#include <assert.h>
#include <float.h>

static fe__cores make_cores(const fe__form *a, const fe__form *b, const fe__relative *b_in_a)
{
    return (fe__cores){a,
                       b,
                       fe__widen(b_in_a->position),
                       fe__widen(b_in_a->rotation.x),
                       fe__widen(b_in_a->rotation.y),
                       fe__widen(b_in_a->rotation.z),
                       NULL};
}

// A plane between the two, as far as a search that ended early knows one
static void note_gap(const fe__gjk *gjk, double radii, fe__manifold *manifold)
{
    manifold->axis_separation = 0.0f;
    if (!(gjk->apart_by > radii)) return;
    double length = sqrt(fe__ddot(gjk->across, gjk->across));
    fe_vec3 normal = fe__narrow(fe__dscale(-1.0 / length, gjk->across));
    fe__stay_apart(manifold, (float)(gjk->apart_by - radii), normal);
}

// 0: farther apart than the margin
static int32_t find_nearest(const fe__cores *cores, float margin, fe__manifold *manifold, fe__core_touch *found)
{
    double radii = (double)cores->a->radius + (double)cores->b->radius, limit = radii + (double)margin;
    fe__gjk gjk;
    fe__gjk_distance_or_gap(cores, limit, &gjk);
    if (gjk.distance > limit) {
        note_gap(&gjk, radii, manifold);
        return 0;
    }
    if (gjk.overlap) {
        fe__penetration p = fe__epa_depth(cores, &gjk);
        *found = (fe__core_touch){
            fe__narrow(p.normal), (float)(-p.depth - radii), fe__narrow(p.on_a), fe__narrow(p.on_b), 1, -1};
    } else {
        fe_dvec3 normal = fe__dscale(1.0 / gjk.distance, fe__dsub(gjk.on_b, gjk.on_a));
        *found = (fe__core_touch){
            fe__narrow(normal), (float)(gjk.distance - radii), fe__narrow(gjk.on_a), fe__narrow(gjk.on_b), 0, -1};
    }
    return 1;
}

// Moves a face of B into A's frame.
static void move_face(fe__face *face, const fe__relative *b_in_a)
{
    face->normal = fe__mul(&b_in_a->rotation, face->normal);
    for (int32_t i = 0; i < face->count; ++i)
        face->vertex[i] = fe__add(b_in_a->position, fe__mul(&b_in_a->rotation, face->vertex[i]));
}

// A frame in a polygon: origin at its first vertex, u along its first edge, n its normal.
typedef struct plane_frame {
    fe_vec3 origin, u, v, n;
} plane_frame;

static plane_frame frame_of(const fe__face *face)
{
    fe_vec3 edge = fe__sub(face->vertex[1], face->vertex[0]), u = fe__scale(1.0f / fe__length(edge), edge);
    return (plane_frame){face->vertex[0], u, fe__cross(face->normal, u), face->normal};
}

static void project(const plane_frame *frame, const fe__face *face, fe__clip_vertex *out)
{
    for (int32_t i = 0; i < face->count; ++i) {
        fe_vec3 d = fe__sub(face->vertex[i], frame->origin);
        uint32_t id = fe__clip_id(i > 0 ? i - 1 : face->count - 1, i);
        out[i] = (fe__clip_vertex){fe__dot(d, frame->u), fe__dot(d, frame->v), fe__dot(d, frame->n), id};
    }
}

static float lowest(const fe__clip_vertex *vertex, int32_t count)
{
    float low = FLT_MAX;
    for (int32_t i = 0; i < count; ++i) low = fe__minf(low, vertex[i].height);
    return low;
}

static float extent(const fe__face *face)
{
    float most = 0.0f;
    for (int32_t i = 0; i < face->count; ++i) {
        fe_vec3 p = face->vertex[i];
        most = fe__maxf(most, fe__maxf(fe__absf(p.x), fe__maxf(fe__absf(p.y), fe__absf(p.z))));
    }
    return most;
}

// Cuts `incident` by `reference` (a polygon whose normal is near the contact's) and gives the vertices below the
// margin, when the deepest of them says the same as the nearest points do; else nothing. Where the cores overlap, what
// hangs over the rim has to come out too. `flip` is 1 when the reference is B's.
static int32_t clip_faces(const fe__face *reference, const fe__face *incident, float reference_radius,
                          float incident_radius, int32_t flip, const fe__core_touch *found, const fe__load *load,
                          float margin, fe__manifold *manifold)
{
    float radii = reference_radius + incident_radius, rounding = 1e-6f * fe__maxf(extent(reference), extent(incident));
    fe__clip_vertex side[FE_FACE_VERTICES], vertex[FE_CLIP_VERTICES];
    plane_frame frame = frame_of(reference);
    project(&frame, reference, side);
    project(&frame, incident, vertex);
    fe_vec3 diagonal = fe__sub(reference->vertex[2], reference->vertex[0]);
    float tie = fe__tie(0.25f * fe__length(diagonal));
    float least = found->separation - tie - rounding, most = found->separation + tie + rounding;
    if (found->overlap && lowest(vertex, incident->count) - radii < least) return 0;
    int32_t count = fe__clip_polygon(side, reference->count, vertex, incident->count, 0.1f * tie + rounding);
    float deepest = lowest(vertex, count) - radii;
    if (deepest < least || deepest > fe__minf(most, margin)) return 0;
    fe__foot foot = {.is_known = 0};
    uint32_t faces = (uint32_t)flip << 31 | (reference->id & 0x7f) << 24 | (incident->id & 0xff) << 16, last[4];
    if (count > 4) {
        foot = fe__foot_in_plane(load, frame.origin, frame.u, frame.v, frame.n);
        fe__names_of_vertices(&foot.last, ~(uint32_t)0xffff, faces, last);
    }
    int32_t near = fe__keep_near(vertex, count, radii, margin, 0.1f * tie, &foot, &manifold->left_out);
    manifold->normal = flip ? fe__neg(frame.n) : frame.n;
    for (int32_t i = 0; i < near; ++i) {
        fe_vec3 p = fe__add_scaled(fe__add_scaled(frame.origin, vertex[i].u, frame.u), vertex[i].v, frame.v);
        // from the reference core out to its surface, and half the way on
        fe__add_point(manifold, fe__add_scaled(p, reference_radius + 0.5f * vertex[i].height, frame.n),
                      vertex[i].height, faces | vertex[i].id);
    }
    return near;
}

// midway between the surfaces
static fe_vec3 middle_of(const fe__core_touch *found, const fe__form *a, const fe__form *b)
{
    return fe__scale(0.5f, fe__add(fe__add_scaled(found->on_a, a->radius, found->normal),
                                   fe__add_scaled(found->on_b, -b->radius, found->normal)));
}

// What two forms turn to each other, in A's frame
typedef struct facing {
    const fe__form *form[2];
    const fe__relative *b_in_a;
    fe__face face[2];
    float cosine[2]; // of polygons' normals and that found; else 0
    fe__load load;   // frame of A
    int32_t has_foot;
    fe_vec3 foot[2]; // where the load presses, each in its own frame
} facing;

static void face_towards(facing *f, int32_t k, fe_vec3 direction)
{
    const fe_vec3 *foot = f->has_foot ? &f->foot[k] : NULL;
    if (k == 0) {
        fe__form_face_under(f->form[0], direction, foot, &f->face[0]);
        return;
    }
    fe__form_face_under(f->form[1], fe__mul_transposed(&f->b_in_a->rotation, direction), foot, &f->face[1]);
    move_face(&f->face[1], f->b_in_a);
}

// The polygon of A (0) or B (1) as the reference. A curved form shows it the line on its side, or the lowest point of
// its rim, that is next to it, as the nearest points' normal may lean from the polygon's: else a corner beside the line
// would seem to lie under it.
static int32_t cut_by(facing *f, int32_t k, const fe__core_touch *found, float margin, fe__manifold *manifold)
{
    const fe__form *own = f->form[k], *other = f->form[1 - k];
    const fe__face *reference = &f->face[k], *incident = &f->face[1 - k];
    if (!(f->cosine[k] > FE_FACE_COS)) return 0;
    if (fe__form_is_curved(other) && (incident->count == 2 || f->cosine[k] < 1.0f))
        face_towards(f, 1 - k, fe__neg(reference->normal));
    if (!(reference->rim > 0.0f || incident->rim > 0.0f))
        return clip_faces(reference, incident, own->radius, other->radius, k, found, &f->load, margin, manifold);
    float tie = fe__tie(fe__minf(fe__form_thickness(own), fe__form_thickness(other)));
    return fe__cut_disc(reference, incident, own->radius + other->radius, k, found, tie, margin, manifold);
}

// The reference is the polygon whose normal was found; of equal ones that which is no disc, or A's. What hangs over its
// rim may be deep under it where the other face's is not: then that.
static int32_t touch_faces(facing *f, const fe__core_touch *found, float margin, fe__manifold *manifold)
{
    const float rounding = 1e-6f, prefer_a = 1e-3f; // equal faces: A's
    int32_t has_rim = f->face[0].rim > 0.0f || f->face[1].rim > 0.0f;
    float equal = has_rim ? rounding : prefer_a, more = f->cosine[1] - f->cosine[0];
    int32_t yields = f->face[0].rim > 0.0f && f->face[1].count > 2 && f->face[1].rim == 0.0f && more >= -equal;
    int32_t first = more > equal || yields;
    if (cut_by(f, first, found, margin, manifold) > 0) return 1;
    return has_rim && cut_by(f, 1 - first, found, margin, manifold) > 0;
}

// Cylinders, capsules and segments: cores with a radius
static int32_t touch_segments(const facing *f, const fe__core_touch *found, float margin, fe__manifold *manifold)
{
    fe__segment segments[2];
    const fe_vec3 axes[2] = {fe__vec3(0.0f, 1.0f, 0.0f), f->b_in_a->rotation.y};
    for (int32_t i = 0; i < 2; ++i) {
        const fe__form *form = f->form[i];
        const fe_vec3 *end = f->face[i].vertex;
        if (f->face[i].count != 2 || form->type == FE__FORM_CONE) return 0;
        if (fe__form_is_curved(form)) {
            const float across = 1e-4f; // the normal's part along the axis: else its rim is touched
            if (fe__absf(fe__dot(axes[i], found->normal)) > across) return 0;
            segments[i].centre = i == 0 ? fe__vec3(0.0f, 0.0f, 0.0f) : f->b_in_a->position;
            segments[i].half = fe__scale(form->half.y, axes[i]);
            segments[i].radius = form->half.x;
            continue;
        }
        segments[i].centre = fe__scale(0.5f, fe__add(end[0], end[1]));
        segments[i].half = fe__scale(0.5f, fe__sub(end[1], end[0]));
        segments[i].radius = form->radius;
    }
    return fe__lay_segments(&segments[0], &segments[1], found->normal, middle_of(found, f->form[0], f->form[1]),
                            found->separation, margin, manifold);
}

// Sides along each other. An edge of a box or a hull is left to its nearest point: it may be a seam, which is not felt.
static int32_t touch_lines(const facing *f, const fe__core_touch *found, float margin, fe__manifold *manifold)
{
    const fe__form *a = f->form[0], *b = f->form[1];
    if (touch_segments(f, found, margin, manifold) > 0) return 1;
    if (f->face[0].count != 2 || f->face[1].count != 2 || !(fe__form_is_curved(a) || fe__form_is_curved(b))) return 0;
    float tie = fe__tie(fe__minf(fe__form_thickness(a), fe__form_thickness(b)));
    return fe__lay_lines(a, b, &f->face[0], &f->face[1], found, middle_of(found, a, b), tie, margin, manifold);
}

static void find_feet(facing *f, const fe__core_touch *found)
{
    f->has_foot = fe__find_foot(&f->load, found->on_a, found->normal, &f->foot[0]);
    if (!f->has_foot) return;
    f->foot[1] = fe__mul_transposed(&f->b_in_a->rotation, fe__sub(f->foot[0], f->b_in_a->position));
}

static int32_t touch_along_features(const fe__form *a, const fe__form *b, const fe__relative *b_in_a,
                                    const fe__core_touch *found, float margin, fe__manifold *manifold)
{
    facing f = {.form = {a, b}, .b_in_a = b_in_a, .load = fe__tell_load(manifold->load)};
    find_feet(&f, found);
    face_towards(&f, 0, found->normal);
    face_towards(&f, 1, fe__neg(found->normal));
    int32_t is_point = f.face[0].count == 1 || f.face[1].count == 1,
            has_rim = f.face[0].rim > 0.0f || f.face[1].rim > 0.0f;
    if (is_point && !has_rim) return 0; // nothing but the nearest points; of a ball on a disc they are less exact
    for (int32_t k = 0; k < 2; ++k)
        if (f.face[k].count > 2) f.cosine[k] = (k ? -1.0f : 1.0f) * fe__dot(f.face[k].normal, found->normal);
    if (fe__maxf(f.cosine[0], f.cosine[1]) > FE_FACE_COS) return touch_faces(&f, found, margin, manifold);
    return touch_lines(&f, found, margin, manifold);
}

// A half space has no support point against itself, but the other's is all it takes: B's deepest point and the face
// around it.
static void touch_plane(const fe__form *plane, const fe__form *b, const fe__relative *b_in_a, float margin,
                        fe__manifold *manifold)
{
    fe__face face;
    fe__form_face(b, fe__neg(fe__mul_transposed(&b_in_a->rotation, plane->normal)), &face);
    move_face(&face, b_in_a);
    fe__clip_vertex vertex[FE_FACE_VERTICES];
    fe_vec3 u = fe__absf(plane->normal.x) < 0.7f ? fe__vec3(1.0f, 0.0f, 0.0f) : fe__vec3(0.0f, 1.0f, 0.0f);
    u = fe__cross(plane->normal, u);
    u = fe__scale(1.0f / fe__length(u), u);
    plane_frame frame = {fe__scale(plane->distance, plane->normal), u, fe__cross(plane->normal, u), plane->normal};
    project(&frame, &face, vertex);
    int32_t near = fe__keep_near(vertex, face.count, b->radius, margin, 0.0f, NULL, NULL);
    if (near > 0) manifold->normal = plane->normal;
    for (int32_t i = 0; i < near; ++i) {
        fe_vec3 p = fe__add_scaled(fe__add_scaled(frame.origin, vertex[i].u, frame.u), vertex[i].v, frame.v);
        fe__add_point(manifold, fe__add_scaled(p, 0.5f * vertex[i].height, frame.n), vertex[i].height,
                      face.id << 16 | vertex[i].id);
    }
}

static void touch_point(const fe__cores *cores, const fe__core_touch *found, fe__manifold *manifold)
{
    enum { SINGLE_ID = 0xffff };
    manifold->normal = found->normal;
    fe__add_point(manifold, middle_of(found, cores->a, cores->b), found->separation, SINGLE_ID);
}

// A direction is kept while the separation along it is within this many ties (1 mm) of what the last search found, and
// no deeper. With 10, as of hulls, single overlaps in a heap of 1000 cylinders grew to twice the depth.
#define KEEP_TIES 2.0f

// Of a pair with a rim. 1: the answer is that along the direction of the last search
static int32_t touch_again(const fe__cores *cores, const fe__relative *b_in_a, float margin, fe__manifold *manifold)
{
    fe__core_touch found;
    if (manifold->axis < 0 || !fe__look_again(cores, manifold->axis, manifold->last, &found)) return 0;
    if (found.separation > margin) {
        fe__stay_apart(manifold, found.separation, found.normal);
        return 1;
    }
    float tied = KEEP_TIES * fe__tie(fe__minf(fe__form_thickness(cores->a), fe__form_thickness(cores->b)));
    if (!(fe__absf(found.separation - manifold->axis_separation) < tied && found.separation > -tied)) return 0;
    if (touch_along_features(cores->a, cores->b, b_in_a, &found, margin, manifold) > 0) return 1;
    if (fe__axis_is_of_face(manifold->axis)) return 0; // beside it
    touch_point(cores, &found, manifold);
    return 1;
}

void fe__collide_convex(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin,
                        fe__manifold *manifold)
{
    assert(b->type != FE__FORM_PLANE);
    manifold->normal = fe__vec3(0.0f, 0.0f, 0.0f);
    manifold->count = 0;
    if (a->type == FE__FORM_PLANE) {
        touch_plane(a, b, b_in_a, margin, manifold);
        return;
    }
    fe__cores cores = make_cores(a, b, b_in_a);
    int32_t curved = fe__form_is_curved(a) || fe__form_is_curved(b);
    if (curved && touch_again(&cores, b_in_a, margin, manifold)) return;
    fe__core_touch found, nearest;
    if (!find_nearest(&cores, margin, manifold, &found)) return;
    nearest = found;
    int32_t on_face = curved && fe__sharpen(&cores, &found);
    if (curved) manifold->axis = found.axis, manifold->axis_separation = found.separation;
    if (touch_along_features(a, b, b_in_a, &found, margin, manifold) > 0) return;
    if (on_face) found = nearest; // beside the face: its normal is not that of the point, which would be felt to sink
    touch_point(&cores, &found, manifold);
}
