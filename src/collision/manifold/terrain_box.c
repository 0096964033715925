// terrain_box.c - a box on a triangle of a heightfield: separating axes (Gottschalk, Lin, Manocha, 1996), of those that
// the surface allows the one with the least overlap; then faces cut by faces, or two crossing edges.
//
// The box is centred at the origin. A direction m points out of the surface: separation(m) = -R(m) - max_i m.v_i, with
// R(m) = sum_j half_j |m.x_j|. The face's normal is always allowed, and taken unless another is better by more than a
// tie.
#define FE_W 4
#include "collision/manifold/pair_kernels.h"
#include "collision/form/form.h"
#include "collision/manifold/terrain_kernels.h"
#include "core/simd.h"

enum { ON_FACE, ON_BOX_FACE, ON_EDGES };

typedef struct axis {
    int32_t kind;
    int32_t box_axis, side; // of the edges that cross; box_axis also of a box's face
    fe_vec3 m;
    float separation;
} axis;

typedef struct contest {
    fe__gathering *g;
    const fe__tile *tile;
    const fe__form *box;
    const fe__mat3 *rotation;
    float half[3];
    fe_vec3 axes[3];
    float tie;
    axis best;
} contest;

static float reach(const contest *c, fe_vec3 m)
{
    return c->half[0] * fe__absf(fe__dot(m, c->axes[0])) + c->half[1] * fe__absf(fe__dot(m, c->axes[1])) +
           c->half[2] * fe__absf(fe__dot(m, c->axes[2]));
}

// ---- all axes, a lane each -----------------------------------------------------------------------------------------
// The box's, then the crosses of the triangle's sides with them: all three of a side before the next side's
enum { AXES = 12, BOX_AXES = 3 };

typedef struct axes {
    _Alignas(16) float x[AXES], y[AXES], z[AXES]; // unit
    _Alignas(16) float forth[AXES], back[AXES];   // separations, both ways along each
    _Alignas(16) float upward[AXES];
    uint32_t valid; // a bit each: edges that are all but parallel have no cross product
} axes;

static void put(axes *a, int32_t i, fe_vec3 m) { a->x[i] = m.x, a->y[i] = m.y, a->z[i] = m.z; }
static inline wide3 spread(fe_vec3 a) { return (wide3){w_set(a.x), w_set(a.y), w_set(a.z)}; }

static void set_directions(const contest *c, axes *a)
{
    const float parallel = 1e-3f; // sin^2 of edges whose cross product says nothing
    const fe_vec3 *v = c->tile->form.vertex;
    _Alignas(16) float least[AXES] = {0.0f, 0.0f, 0.0f};
    for (int32_t j = 0; j < BOX_AXES; ++j) put(a, j, c->axes[j]);
    for (int32_t k = 0; k < 3; ++k) {
        fe_vec3 side = fe__sub(v[(k + 1) % 3], v[k]);
        for (int32_t j = 0; j < BOX_AXES; ++j) {
            int32_t i = BOX_AXES * (k + 1) + j;
            put(a, i, fe__cross(side, c->axes[j]));
            least[i] = parallel * fe__dot(side, side);
        }
    }
    a->valid = 0;
    for (int32_t i = 0; i < AXES; i += FE_W) {
        wide3 m = {*(const wide *)(a->x + i), *(const wide *)(a->y + i), *(const wide *)(a->z + i)};
        wide sine = w_dot(m, m);
        wide_mask is_cross = {i + 0 >= BOX_AXES ? -1 : 0, i + 1 >= BOX_AXES ? -1 : 0, i + 2 >= BOX_AXES ? -1 : 0, -1};
        a->valid |= w_bits(w_or(w_not(is_cross), w_greater(sine, *(const wide *)(least + i)))) << i;
        m = w_choose3(is_cross, w_scale(w_set(1.0f) / w_sqrt(sine), m), m);
        *(wide *)(a->x + i) = m.x, *(wide *)(a->y + i) = m.y, *(wide *)(a->z + i) = m.z;
    }
}

// 0: along one of them the two are farther apart than the margin
static int32_t set_separations(const contest *c, axes *a)
{
    const fe_vec3 *v = c->tile->form.vertex;
    uint32_t apart = 0;
    for (int32_t i = 0; i < AXES; i += FE_W) {
        wide3 m = {*(const wide *)(a->x + i), *(const wide *)(a->y + i), *(const wide *)(a->z + i)};
        wide p = w_dot(m, spread(v[0])), q = w_dot(m, spread(v[1])), r = w_dot(m, spread(v[2])),
             reach = w_set(c->half[0]) * w_abs(w_dot(m, spread(c->axes[0]))) +
                     w_set(c->half[1]) * w_abs(w_dot(m, spread(c->axes[1]))) +
                     w_set(c->half[2]) * w_abs(w_dot(m, spread(c->axes[2]))),
             forth = -reach - w_max(p, w_max(q, r)), back = w_min(p, w_min(q, r)) - reach;
        *(wide *)(a->forth + i) = forth, *(wide *)(a->back + i) = back;
        *(wide *)(a->upward + i) = w_dot(m, spread(c->tile->normal));
        apart |= w_bits(w_greater(w_max(forth, back), w_set(c->g->margin))) << i;
    }
    return !(apart & a->valid);
}

// Of an axis that is no side's the triangle touches with a corner beyond that side: the two edges do not meet there.
static int32_t is_of_side(const contest *c, int32_t side, fe_vec3 way)
{
    const float flat = 1e-3f; // of the triangle's size
    const fe_vec3 *v = c->tile->form.vertex;
    return fe__dot(way, fe__sub(v[(side + 2) % 3], v[side])) <= flat * c->tile->size;
}

// Both ways along an axis
static void try_axis(contest *c, const axes *a, int32_t i)
{
    const float level = 1e-3f; // sine: along the face both ways are out of the surface
    const int32_t is_cross = i >= BOX_AXES, side = is_cross ? i / BOX_AXES - 1 : 0;
    for (int32_t back = 0; back < 2; ++back) {
        float separation = back ? a->back[i] : a->forth[i], up = back ? -a->upward[i] : a->upward[i];
        if (up < -level || separation <= c->best.separation + c->tie) continue;
        fe_vec3 m = {a->x[i], a->y[i], a->z[i]}, way = back ? fe__neg(m) : m;
        if (is_cross && !is_of_side(c, side, way)) continue;
        if (!fe__tile_feels_along(c->g, c->tile, way, NULL, separation)) continue;
        c->best = (axis){is_cross ? ON_EDGES : ON_BOX_FACE, i % BOX_AXES, side, way, separation};
    }
}

// 0: apart
static int32_t find_axis(contest *c)
{
    axes a;
    set_directions(c, &a);
    if (!set_separations(c, &a)) return 0;
    for (int32_t i = 0; i < AXES; ++i)
        if (a.valid >> i & 1) try_axis(c, &a, i);
    return 1;
}

// A direction that is nearly a face's: the face, so that a box lying on a ridge has all its points. The triangle's
// first: its normal does not turn with the box, and is the same in the next step.
static void prefer_face(contest *c)
{
    fe_vec3 m = c->best.m;
    if (fe__dot(m, c->tile->normal) > FE_FACE_COS) {
        c->best = (axis){.kind = ON_FACE, .m = c->tile->normal};
        return;
    }
    if (c->best.kind != ON_EDGES) return;
    for (int32_t j = 0; j < 3; ++j) {
        float along = fe__dot(m, c->axes[j]);
        if (fe__absf(along) > FE_FACE_COS)
            c->best = (axis){.kind = ON_BOX_FACE, .box_axis = j, .m = along > 0.0f ? c->axes[j] : fe__neg(c->axes[j])};
    }
}

// ---- faces ---------------------------------------------------------------------------------------------------------
typedef struct face_cut {
    fe__face face;
    fe__cut cut;
    fe__cut_piece piece;
} face_cut;

static void cut_face(const contest *c, face_cut *f)
{
    fe__tile_body_face(c->box, c->rotation, fe__neg(c->tile->normal), -1, NULL, &f->face);
    f->cut = (fe__cut){c->tile->form.vertex, f->face.vertex, 3,     f->face.count, c->tile->normal,
                       c->tile->normal,      f->face.id + 1, c->tie};
    fe__tile_cut_piece(c->tile, &f->cut, &f->piece);
}

static void touch_box_face(contest *c)
{
    fe__face face;
    fe__tile_body_face(c->box, c->rotation, fe__neg(c->best.m), -1, NULL, &face);
    fe__cut cut = {face.vertex, c->tile->form.vertex, face.count, 3, fe__neg(c->best.m), c->best.m, 0, c->tie};
    fe__tile_cut_faces(c->g, c->tile, &cut);
}

// ---- edges ---------------------------------------------------------------------------------------------------------
// The box's edge along x_j that is deepest against m, and the triangle's side: the point between the nearest points of
// their lines. 0: the two do not cross, because what they would say better is not allowed here.
static int32_t touch_edges(contest *c)
{
    int32_t j = c->best.box_axis, k = c->best.side;
    fe_vec3 m = c->best.m, p = {0.0f, 0.0f, 0.0f}, d = c->axes[j];
    for (int32_t i = 0; i < 3; ++i)
        if (i != j) p = fe__add_scaled(p, fe__dot(m, c->axes[i]) > 0.0f ? -c->half[i] : c->half[i], c->axes[i]);
    fe_vec3 q = c->tile->form.vertex[k], e = fe__sub(c->tile->form.vertex[(k + 1) % 3], q), r = fe__sub(p, q);
    float ee = fe__dot(e, e), de = fe__dot(d, e), dr = fe__dot(d, r), er = fe__dot(e, r), det = ee - de * de;
    float u = (er - de * dr) / det, s = (de * er - ee * dr) / det;
    if (!(fe__absf(s) <= c->half[j] + c->tie && u * u * ee <= ee && u >= 0.0f)) return 0;
    fe_vec3 on_side = fe__add_scaled(q, u, e);
    fe__gather(c->g, c->tile, m, fe__add_scaled(on_side, 0.5f * c->best.separation, m), c->best.separation,
               fe__tile_id(c->tile, (uint32_t)(1 + 4 * j + k)));
    return 1;
}

void fe__tile_touch_box(fe__gathering *g, const fe__tile *tile, const fe__form *box, const fe__mat3 *rotation)
{
    contest c = {
        .g = g, .tile = tile, .box = box, .rotation = rotation, .half = {box->half.x, box->half.y, box->half.z}};
    c.axes[0] = rotation->x, c.axes[1] = rotation->y, c.axes[2] = rotation->z;
    c.tie = fe__tie(fe__form_thickness(box));
    fe_vec3 n = tile->normal;
    float centre = -fe__dot(n, tile->form.vertex[0]), r = reach(&c, n);
    c.best = (axis){.kind = ON_FACE, .m = n, .separation = centre - r};
    if (c.best.separation > g->margin || !fe__tile_feels(g, tile, centre + r)) return;
    int32_t convex = 0;
    for (int32_t k = 0; k < 3; ++k) convex |= fe__tile_is_convex(g->terrain, tile, k);
    face_cut f;
    cut_face(&c, &f);
    if (convex && !fe__tile_settles(&f.cut, &f.piece, c.best.separation)) {
        if (!find_axis(&c)) return;
        prefer_face(&c);
        if (c.best.kind == ON_BOX_FACE) {
            touch_box_face(&c);
            return;
        }
        if (c.best.kind == ON_EDGES && touch_edges(&c)) return;
    }
    fe__tile_gather_piece(g, tile, &f.cut, &f.piece);
}
