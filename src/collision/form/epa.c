// epa.c - depth of two cores that overlap; see gjk.h.
//
// The expanding polytope algorithm of van den Bergen (2001): a polytope inside the cores' difference, with the origin
// in it, grows where its surface is nearest the origin, until the nearest face is one of the difference itself.
// Differences without volume (points, lines and plane figures, as of two segments, or of a segment and a point) have
// depth 0; the normal is across them.
#include "collision/form/gjk.h"

#include <string.h>

enum { MAX_VERTICES = 64, MAX_FACES = 2 * MAX_VERTICES, MAX_HORIZON = 3 * MAX_VERTICES };
// These are shares of the cores' size.
#define FLAT 1e-9   // A difference that is thinner than this is flat.
#define CURVED 1e-8 // The depth of curved cores is found to this precision.
#define EXACT 1e-11 // Two faces lie in one plane, and two supports are equally far, if they differ by no more.

typedef struct face {
    fe_dvec3 normal; // unit, outwards
    double distance; // distance of the face's plane from the origin
    int16_t corner[3];
    int16_t alive;
} face;

typedef struct polytope {
    fe__vertex vertex[MAX_VERTICES];
    face face[MAX_FACES];
    int32_t vertex_count, face_count;
    double size;
} polytope;

static fe_dvec3 difference(const polytope *p, int32_t k) { return p->vertex[k].difference; }

static fe_dvec3 unit(fe_dvec3 a) { return fe__dscale(1.0 / sqrt(fe__ddot(a, a)), a); }

// A unit vector perpendicular to d: the axis that is least along d, less its part along d.
static fe_dvec3 perpendicular(fe_dvec3 d)
{
    double x = fe__absd(d.x), y = fe__absd(d.y), z = fe__absd(d.z);
    fe_dvec3 axis = x <= y && x <= z ? (fe_dvec3){1.0, 0.0, 0.0}
                    : y <= z         ? (fe_dvec3){0.0, 1.0, 0.0}
                                     : (fe_dvec3){0.0, 0.0, 1.0};
    return unit(fe__dsub(axis, fe__dscale(fe__ddot(axis, d) / fe__ddot(d, d), d)));
}

static void add_face(polytope *p, int32_t i, int32_t j, int32_t k)
{
    face *f = &p->face[p->face_count++];
    fe_dvec3 a = difference(p, i), normal = fe__dcross(fe__dsub(difference(p, j), a), fe__dsub(difference(p, k), a));
    double length = sqrt(fe__ddot(normal, normal));
    // A sliver without an area has no plane; its neighbours stand for it.
    double inverse = length > 0.0 ? 1.0 / length : 0.0;
    f->normal = fe__dscale(inverse, normal);
    f->distance = length > 0.0 ? fe__ddot(f->normal, a) : (double)INFINITY;
    f->corner[0] = (int16_t)i, f->corner[1] = (int16_t)j, f->corner[2] = (int16_t)k;
    f->alive = 1;
}

// ---- the first tetrahedron ------------------------------------------------------------------------------------------
// Adds the farthest vertex along one of the directions, if it is off the point, line or plane that the vertices span.
// The size grows with each vertex that is met: if the cores touch where GJK began, GJK has met none yet.
static int32_t add_off_span(polytope *p, const fe__cores *cores, const fe_dvec3 *directions, int32_t count)
{
    for (int32_t i = 0; i < 2 * count; ++i) {
        fe_dvec3 d = fe__dscale(i & 1 ? -1.0 : 1.0, directions[i >> 1]);
        fe__vertex w = fe__cores_support(cores, d);
        p->size = fe__maxd(p->size, sqrt(fe__ddot(w.difference, w.difference)));
        if (fe__ddot(d, fe__dsub(w.difference, difference(p, 0))) <= FLAT * p->size) continue;
        p->vertex[p->vertex_count++] = w;
        return 1;
    }
    return 0;
}

static fe_dvec3 triangle_normal(const polytope *p)
{
    return fe__dcross(fe__dsub(difference(p, 1), difference(p, 0)), fe__dsub(difference(p, 2), difference(p, 0)));
}

// GJK's simplex may be less than a tetrahedron, or flat: only the vertices that span something are kept.
static void take_simplex(polytope *p, const fe__gjk *g)
{
    p->vertex_count = 1, p->face_count = 0, p->size = g->size;
    p->vertex[0] = g->vertex[0];
    for (int32_t i = 1; i < g->count; ++i) {
        p->vertex[p->vertex_count] = g->vertex[i];
        fe_dvec3 d = fe__dsub(g->vertex[i].difference, difference(p, 0));
        double span = sqrt(fe__ddot(d, d)), least = FLAT * p->size;
        if (p->vertex_count >= 2 && span > least) {
            fe_dvec3 line = unit(fe__dsub(difference(p, 1), difference(p, 0))), across = fe__dcross(line, d);
            span = sqrt(fe__ddot(across, across));
        }
        if (p->vertex_count == 3 && span > least) span = fe__absd(fe__ddot(unit(triangle_normal(p)), d));
        if (span > least) ++p->vertex_count;
    }
}

// Makes the first tetrahedron, which holds the origin. Returns the dimension of the difference, 0..3. Below 3 there is
// no tetrahedron, and `across` is a unit vector across the difference.
static int32_t enclose_origin(polytope *p, const fe__cores *cores, fe_dvec3 *across)
{
    static const fe_dvec3 axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    *across = axes[0];
    if (p->vertex_count == 1 && !add_off_span(p, cores, axes, 3)) return 0;
    if (p->vertex_count == 2) {
        fe_dvec3 line = unit(fe__dsub(difference(p, 1), difference(p, 0))), sides[2] = {perpendicular(line)};
        sides[1] = fe__dcross(line, sides[0]);
        *across = sides[0];
        if (!add_off_span(p, cores, sides, 2)) return 1;
    }
    if (p->vertex_count == 3) {
        *across = unit(triangle_normal(p));
        if (!add_off_span(p, cores, across, 1)) return 2;
    }
    fe_dvec3 apex = fe__dsub(difference(p, 3), difference(p, 0));
    int32_t is_inward = fe__ddot(triangle_normal(p), apex) > 0.0; // Then the face 0 1 2 must be turned.
    int32_t b = is_inward ? 2 : 1, c = is_inward ? 1 : 2;
    add_face(p, 0, b, c);
    add_face(p, 0, c, 3);
    add_face(p, c, b, 3);
    add_face(p, b, 0, 3);
    return 3;
}

// ---- growing -------------------------------------------------------------------------------------------------------
static int32_t nearest_face(const polytope *p)
{
    int32_t best = -1;
    for (int32_t i = 0; i < p->face_count; ++i) {
        if (p->face[i].alive && (best < 0 || p->face[i].distance < p->face[best].distance)) best = i;
    }
    return best;
}

typedef struct horizon {
    int16_t edge[MAX_HORIZON][2];
    int32_t count;
} horizon;

// The horizon is the rim of the faces that are removed. An edge that comes twice lies between two of them: it goes too.
static void toggle_edge(horizon *h, int16_t from, int16_t to)
{
    for (int32_t i = 0; i < h->count; ++i) {
        if (h->edge[i][0] != to || h->edge[i][1] != from) continue;
        for (int32_t k = i; k + 1 < h->count; ++k) memcpy(h->edge[k], h->edge[k + 1], sizeof h->edge[k]);
        --h->count;
        return;
    }
    h->edge[h->count][0] = from, h->edge[h->count][1] = to;
    ++h->count;
}

// Removes the faces that the last vertex sees, those in one plane with it included, and adds faces from their rim to
// it. 0: the capacity does not suffice
static int32_t grow(polytope *p, int32_t nearest)
{
    int32_t apex = p->vertex_count - 1;
    horizon h = {.count = 0};
    for (int32_t i = 0; i < p->face_count; ++i) {
        face *f = &p->face[i];
        double above = fe__ddot(f->normal, fe__dsub(difference(p, apex), difference(p, f->corner[0])));
        if (!f->alive || (i != nearest && above <= -EXACT * p->size)) continue;
        if (h.count + 3 > MAX_HORIZON) return 0;
        f->alive = 0;
        for (int32_t k = 0; k < 3; ++k) toggle_edge(&h, f->corner[k], f->corner[(k + 1) % 3]);
    }
    int32_t kept = 0;
    for (int32_t i = 0; i < p->face_count; ++i) {
        if (p->face[i].alive) p->face[kept++] = p->face[i];
    }
    p->face_count = kept;
    if (kept + h.count > MAX_FACES) return 0;
    for (int32_t i = 0; i < h.count; ++i) add_face(p, h.edge[i][0], h.edge[i][1], apex);
    return 1;
}

// ---- the depth -----------------------------------------------------------------------------------------------------
static fe__penetration flat_answer(const fe__cores *cores, const fe__gjk *g, fe_dvec3 across)
{
    if (fe__ddot(across, cores->position) < 0.0) across = fe__dscale(-1.0, across);
    return (fe__penetration){across, 0.0, g->on_a, g->on_b};
}

// The point of the face nearest to `foot`; its difference counts from there.
static fe__vertex nearest_point(const polytope *p, const face *f, fe_dvec3 foot)
{
    fe__vertex corner[3], sum = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    double weight[3];
    for (int32_t k = 0; k < 3; ++k) {
        corner[k] = p->vertex[f->corner[k]];
        corner[k].difference = fe__dsub(corner[k].difference, foot);
    }
    int32_t count = fe__nearest_in_simplex(corner, weight, 3);
    for (int32_t k = 0; k < count; ++k) {
        sum.difference = fe__dadd(sum.difference, fe__dscale(weight[k], corner[k].difference));
        sum.on_a = fe__dadd(sum.on_a, fe__dscale(weight[k], corner[k].on_a));
    }
    return sum;
}

// The origin's foot on the face lies in that face or, if several triangles make up one face of the difference, in one
// of the others.
static fe__penetration face_answer(const polytope *p, const face *f)
{
    fe_dvec3 foot = fe__dscale(f->distance, f->normal), on_a = {0.0, 0.0, 0.0};
    double nearest = (double)INFINITY;
    for (int32_t i = 0; i < p->face_count && nearest > 0.0; ++i) {
        const face *other = &p->face[i];
        if (!other->alive || other->distance > f->distance + EXACT * p->size) continue;
        fe__vertex point = nearest_point(p, other, foot);
        double square = fe__ddot(point.difference, point.difference);
        if (square < nearest) nearest = square, on_a = point.on_a;
    }
    return (fe__penetration){f->normal, fe__maxd(f->distance, 0.0), on_a, fe__dsub(on_a, foot)};
}

// A curved difference has no last face. The answer is the direction with the least depth of all that were tried: the
// two part along it. In time faces become slivers that lose their normal; the first sign of that, which ends the
// search, is a nearest face that is nearer than the one before.
static fe__penetration curved_depth(polytope *p, const fe__cores *cores)
{
    fe__penetration found = {.depth = (double)INFINITY};
    double last = -(double)INFINITY;
    while (p->vertex_count < MAX_VERTICES) {
        int32_t nearest = nearest_face(p);
        if (nearest < 0 || !(p->face[nearest].distance >= last - CURVED * p->size)) break;
        const face *f = &p->face[nearest];
        if (!(f->distance < (double)INFINITY)) break; // Only slivers are left.
        last = f->distance;
        fe__vertex w = fe__cores_support(cores, f->normal);
        double depth = fe__ddot(f->normal, w.difference);
        if (depth < found.depth) {
            fe_dvec3 on_a = nearest_point(p, f, fe__dscale(f->distance, f->normal)).on_a;
            found = (fe__penetration){f->normal, depth, on_a, fe__dsub(on_a, fe__dscale(depth, f->normal))};
        }
        if (depth - last <= CURVED * p->size) break;
        p->vertex[p->vertex_count++] = w;
        if (!grow(p, nearest)) break;
    }
    found.depth = fe__maxd(found.depth, 0.0);
    return found;
}

fe__penetration fe__epa_depth(const fe__cores *cores, const fe__gjk *overlap)
{
    polytope p;
    fe_dvec3 across;
    take_simplex(&p, overlap);
    if (enclose_origin(&p, cores, &across) < 3) return flat_answer(cores, overlap, across);
    if ((!cores->corners && fe__form_is_curved(cores->a)) || fe__form_is_curved(cores->b)) {
        fe__penetration found = curved_depth(&p, cores);
        return found.depth < (double)INFINITY ? found : flat_answer(cores, overlap, across);
    }
    face best = p.face[nearest_face(&p)];
    while (p.vertex_count < MAX_VERTICES) {
        int32_t nearest = nearest_face(&p);
        if (nearest < 0) break;
        best = p.face[nearest];
        fe__vertex w = fe__cores_support(cores, best.normal);
        if (fe__ddot(best.normal, w.difference) - best.distance <= EXACT * p.size) break;
        p.vertex[p.vertex_count++] = w;
        if (!grow(&p, nearest)) break;
    }
    return face_answer(&p, &best);
}
