// terrain_gather.c - see terrain_gather.h.
#include "collision/manifold/terrain_gather.h"

#include "collision/form/clip.h"
#include "collision/manifold/bridge.h"

#include <float.h>
#include <math.h>
#include <string.h>

// ---- gaps ----------------------------------------------------------------------------------------------------------
static int32_t ends_at_a_side(const fe__ground *s, int32_t index)
{
    return fe__ground_is_rim(s, index, 0) || fe__ground_is_rim(s, index, 1) || fe__ground_is_rim(s, index, 2);
}

static fe__neighbour own_ground(const fe__terrain *t)
{
    return (fe__neighbour){t->ground, t->origin, {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}}};
}

static int32_t is_carried_over(const fe__gathering *g, const fe__tile *tile, fe_vec3 m, const fe_vec3 *rim,
                               float separation)
{
    const fe__terrain *t = g->terrain;
    if (fe__is_along_face(m, tile->normal) || !ends_at_a_side(&t->ground, tile->index)) return 0;
    const fe__neighbour own = own_ground(t);
    const fe__crossing crossing = {.body = {g->form, {0.0f, 0.0f, 0.0f}, *g->rotation},
                                   .around = t->around,
                                   .own = &own,
                                   .fall = t->fall};
    return fe__is_carried_over(&crossing, tile->form.vertex[0], tile->normal, rim, separation);
}

int32_t fe__tile_feels_along(const fe__gathering *g, const fe__tile *tile, fe_vec3 m, const fe_vec3 *rim,
                             float separation)
{
    return fe__tile_allows(g->terrain, tile, m) && !is_carried_over(g, tile, m, rim, separation);
}

static fe_vec3 on_surface(const fe__raw_patch *patch, int32_t i)
{
    return fe__add_scaled(patch->points[i].point, -0.5f * patch->points[i].separation, patch->normal);
}

// Of the points of a patch that are cut from a side face, some lie far below what is touched.
static fe_vec3 deepest_on_surface(const fe__raw_patch *patch)
{
    int32_t deepest = 0;
    for (int32_t i = 1; i < patch->count; ++i)
        if (patch->points[i].separation < patch->points[deepest].separation) deepest = i;
    return on_surface(patch, deepest);
}

static int32_t is_level_about(const fe__terrain *t, fe_vec3 p, fe_vec3 n, float level, float beside)
{
    return fe__ground_is_level_about(&t->ground, fe__dadd(t->origin, fe__widen(p)), fe__widen(n), (double)level,
                                     (double)beside);
}

// A plane that carries the body
typedef struct carrier {
    fe_vec3 f, p; // normal, a point
} carrier;

// A point nearer than this to the carrier's plane may lie at an edge that reaches it, m: of a face that is cut at the
// edge, or where what is round touches the edge
#define FACE_NEAR 0.02f
#define EDGE_NEAR 0.002f

static float height_over(const fe__raw_patch *patch, int32_t i, const carrier *by)
{
    return fe__dot(by->f, fe__sub(on_surface(patch, i), by->p));
}

// Is point i of a patch at an edge beyond which the mesh is level with the carrier, and does that carry the body over a
// gap from there? At such an edge what is touched goes no farther along f, as a wall does.
static int32_t is_carried_at(const fe__gathering *g, const fe__raw_patch *patch, int32_t i, const carrier *by)
{
    // m: to each side of the edge, and along it, where at a tile's corner only that is inside; by which the edge may
    // lie higher or lower than the carrier, and a sink; above that
    const float step = 0.001f, uneven = 0.0015f, above = 0.0025f;
    const fe__terrain *t = g->terrain;
    fe_vec3 m = patch->normal, f = by->f, q = on_surface(patch, i);
    fe_vec3 edge = fe__add_scaled(q, -height_over(patch, i, by), f), out = fe__add_scaled(m, -fe__dot(m, f), f);
    out = fe__scale(1.0f / fe__length(out), out);
    if (!is_level_about(t, fe__add_scaled(edge, -step, out), f, uneven, step) ||
        is_level_about(t, fe__add_scaled(edge, above, f), m, FE__LEVEL, step))
        return 0;
    const fe__neighbour own = own_ground(t);
    const fe__crossing crossing = {.body = {g->form, {0.0f, 0.0f, 0.0f}, *g->rotation},
                                   .around = t->around,
                                   .own = &own,
                                   .fall = t->fall,
                                   .edge = fe__add_scaled(edge, above, out),
                                   .out = out};
    return fe__is_carried_over(&crossing, edge, f, &q, patch->points[i].separation);
}

// May the carrier of a face with the normal f hold what touches the patch? A face that leans less than a wall is no
// side of a tile; directions between faces may.
static int32_t may_be_carried(const fe__raw_patch *patch, fe_vec3 f)
{
    const float steepest = -0.01f, wall = 0.5f, flattest = 0.9999f; // cosines
    float cosine = fe__dot(patch->normal, f);
    return cosine >= steepest && cosine <= (patch->is_of_face ? wall : flattest);
}

// The points of a patch near the carrier's plane, if one of them is carried over to it: where tiles meet in corners,
// others lie beside them.
static uint32_t points_carried(const fe__gathering *g, const fe__raw_patch *patch, const carrier *by)
{
    const float touched = 0.001f; // m over the deepest: others are cut from a side face, far below
    float distance = g->form->radius > 0.0f ? EDGE_NEAR : FACE_NEAR;
    uint32_t near = 0, carried = 0;
    for (int32_t i = 0; i < patch->count; ++i) {
        if (fe__absf(height_over(patch, i, by)) > distance) continue;
        near |= 1u << i;
        if (!carried && patch->points[i].separation <= patch->deepest + touched)
            carried = (uint32_t)is_carried_at(g, patch, i, by);
    }
    return carried ? near : 0;
}

static uint32_t points_carried_by_any(const fe__gathering *g, const fe__raw_patch *patch)
{
    const fe__terrain *t = g->terrain;
    uint32_t carried = 0;
    for (int32_t k = 0; k < g->count; ++k) {
        const fe__raw_patch *other = g->patches + k;
        if (other != patch && may_be_carried(patch, other->face))
            carried |= points_carried(g, patch, &(carrier){other->face, deepest_on_surface(other)});
    }
    for (int32_t k = 0; k < t->known_count; ++k) {
        if (!may_be_carried(patch, t->known_face[k])) continue;
        carried |=
            points_carried(g, patch, &(carrier){t->known_face[k], fe__narrow(fe__dsub(t->known_at[k], t->origin))});
    }
    return carried;
}

// The rims on both sides of what is round carry each other: where nothing else is touched, the one stays that is
// nearest to its touch.
static void keep_one_that_carries(const fe__gathering *g, uint32_t *carried)
{
    int32_t best = 0;
    if (g->terrain->known_count) return;
    for (int32_t k = 0; k < g->count; ++k) {
        if (carried[k] != (1u << g->patches[k].count) - 1u) return;
        if (fe__absf(g->patches[k].deepest) < fe__absf(g->patches[best].deepest)) best = k;
    }
    carried[best] = 0;
}

void fe__leave_carried(fe__gathering *g)
{
    uint32_t carried[FE__PATCHES + 1]; // of each patch, a bit for each point
    uint32_t any = 0;
    int32_t count = 0;
    if (g->count + g->terrain->known_count < 2 || !g->count || !g->terrain->ground.mesh) return;
    for (int32_t k = 0; k < g->count; ++k) any |= carried[k] = points_carried_by_any(g, g->patches + k);
    if (!any) return;
    keep_one_that_carries(g, carried);
    for (int32_t k = 0; k < g->count; ++k) {
        fe__raw_patch *p = g->patches + k;
        int32_t kept = 0;
        for (int32_t i = 0; i < p->count; ++i)
            if (!(carried[k] >> i & 1)) p->points[kept++] = p->points[i];
        p->count = kept;
        if (kept && count < k) g->patches[count] = *p;
        count += kept > 0;
    }
    g->count = count;
}

// ---- patches -------------------------------------------------------------------------------------------------------
const fe__load *fe__gathering_load(fe__gathering *g)
{
    if (!g->has_load) {
        g->load = fe__tell_load(g->terrain->load);
        g->load.at = fe__sub(g->load.at, g->away);
        g->has_load = 1;
    }
    return &g->load;
}

// Leaves at most four of the first `count` points, whose ids differ.
static int32_t leave_four(fe__gathering *g, fe__raw_patch *p, int32_t count, int32_t is_aimed)
{
    fe_vec3 n = p->normal, a = fe__absf(n.x) < 0.7f ? fe__vec3(1.0f, 0.0f, 0.0f) : fe__vec3(0.0f, 1.0f, 0.0f),
            u = fe__cross(n, a);
    u = fe__scale(1.0f / fe__length(u), u);
    fe_vec3 v = fe__cross(n, u);
    fe__clip_vertex vertex[FE__RAW_POINTS];
    fe__manifold_point kept[FE_MAX_POINTS];
    for (int32_t i = 0; i < count; ++i)
        vertex[i] = (fe__clip_vertex){fe__dot(u, p->points[i].point), fe__dot(v, p->points[i].point),
                                      p->points[i].separation, p->points[i].id};
    fe_vec3 on_plane = fe__scale(fe__dot(n, p->points[0].point), n); // u and v count from the frame's origin
    fe__foot foot = fe__foot_in_plane(fe__gathering_load(g), on_plane, u, v, n);
    foot.is_aimed = is_aimed, foot.from_origin = 1; // the body's centre
    int32_t left = fe__reduce_to_four(vertex, count, g->tie, &foot, &p->left_out);
    for (int32_t k = 0; k < left; ++k)
        for (int32_t i = 0; i < count; ++i)
            if (p->points[i].id == vertex[k].id) kept[k] = p->points[i];
    for (int32_t k = 0; k < left; ++k) p->points[k] = kept[k];
    return left;
}

static void swap(fe__raw_patch *p, int32_t i, int32_t j)
{
    fe__manifold_point here = p->points[i];
    p->points[i] = p->points[j];
    p->points[j] = here;
}

// The point beyond the first `chosen` that is farthest from all of them comes next: of what rocks over a ridge, where
// it comes down first, were it tilted by `tilt`.
static void choose_farthest(fe__raw_patch *p, int32_t chosen)
{
    const float tilt = 0.05f;
    int32_t best = chosen;
    float most = -FLT_MAX;
    for (int32_t i = chosen; i < p->count; ++i) {
        float least = FLT_MAX;
        for (int32_t k = 0; k < chosen; ++k) {
            fe_vec3 away = fe__sub(p->points[i].point, p->points[k].point);
            least = fe__minf(least, fe__dot(away, away));
        }
        least = sqrtf(least) - p->points[i].separation / tilt;
        if (least > most) most = least, best = i;
    }
    swap(p, chosen, best);
}

static int32_t farthest_from_first(const fe__raw_patch *p, int32_t count)
{
    int32_t farthest = 0;
    float most = 0.0f;
    for (int32_t i = 1; i < count; ++i) {
        fe_vec3 away = fe__sub(p->points[i].point, p->points[0].point);
        if (fe__dot(away, away) > most) most = fe__dot(away, away), farthest = i;
    }
    return farthest;
}

// Of the first `count` points all may lie on a line, the crest of a ridge: its two ends come first, and what lies
// between them is dropped, so that there is room for a point on either side. Returns how many of them are left.
static int32_t leave_crest(fe__raw_patch *p, int32_t count)
{
    const float narrow = 0.02f; // width of a line by its length
    if (count < 3) return count;
    swap(p, 0, farthest_from_first(p, count));
    swap(p, 1, farthest_from_first(p, count));
    fe_vec3 line = fe__sub(p->points[1].point, p->points[0].point);
    float square = fe__dot(line, line), widest = 0.0f;
    for (int32_t i = 2; i < count; ++i) {
        fe_vec3 across = fe__cross(line, fe__sub(p->points[i].point, p->points[0].point));
        widest = fe__maxf(widest, fe__dot(across, across));
    }
    if (widest > narrow * narrow * square * square) return count;
    memmove(p->points + 2, p->points + count, sizeof *p->points * (size_t)(p->count - count));
    p->count -= count - 2;
    return 2;
}

// Brings those that are that near to the front, behind the first `near`: returns how many there are
static int32_t bring_near(fe__raw_patch *p, int32_t near, float separation)
{
    for (int32_t i = near; i < p->count; ++i)
        if (p->points[i].separation <= separation) swap(p, i, near++);
    return near;
}

// At most four points. What stands on a crest, and on nothing else, keeps the two ends of it, and what it comes down on
// where it rocks. Of others those near the surface span the patch, and what stands off comes after them: on uneven
// ground the widest four of all would leave out what carries.
void fe__reduce_patch(fe__gathering *g, fe__raw_patch *p, int32_t is_aimed)
{
    const float touches = 0.1f * FE__CLEAR;
    if (p->count <= FE_MAX_POINTS) return;
    int32_t near = leave_crest(p, bring_near(p, 0, fe__maxf(p->deepest + touches, -touches)));
    if (near > 2) near = bring_near(p, near, fe__maxf(p->deepest, 0.0f) + FE__CLEAR);
    if (near > FE_MAX_POINTS) {
        int32_t left = leave_four(g, p, near, is_aimed), others = p->count - near;
        memmove(p->points + left, p->points + near, sizeof *p->points * (size_t)others);
        near = left, p->count = left + others;
    }
    int32_t most = fe__mini(p->count, FE_MAX_POINTS);
    for (; near < most; ++near) choose_farthest(p, near);
    p->count = most;
}

void fe__keep_line_ends(fe__raw_patch *patch, int32_t from, int32_t to, float tie)
{
    if (patch->count == 2) return;
    fe__manifold_point left[FE__RAW_POINTS] = {patch->points[from], patch->points[to]};
    float most = fe__minf(left[0].separation, left[1].separation) - tie;
    int32_t kept = 2;
    for (int32_t i = 0; i < patch->count; ++i)
        if (i != from && i != to && patch->points[i].separation < most) left[kept++] = patch->points[i];
    for (int32_t i = 0; i < kept; ++i) patch->points[i] = left[i];
    patch->count = kept;
}

static void add_point(fe__gathering *g, fe__raw_patch *p, const fe__manifold_point *point, int32_t triangle)
{
    if (g->single && p->count) {
        if (point->separation >= p->points[0].separation) return;
        p->count = 0;
    }
    // what lies over a seam lies on both triangles
    for (int32_t i = 0; i < p->count; ++i) {
        fe_vec3 away = fe__sub(p->points[i].point, point->point);
        if (p->points[i].id != point->id && fe__dot(away, away) > g->same_place * g->same_place) continue;
        if (point->separation < p->points[i].separation) p->points[i] = *point;
        if (point->separation < p->deepest) p->deepest = point->separation, p->triangle = triangle;
        return;
    }
    // of what comes yet, nobody knows whether it holds the load better than the widest four of these
    if (p->count == FE__RAW_POINTS) fe__reduce_patch(g, p, 1);
    p->points[p->count++] = *point;
    if (point->separation < p->deepest) p->deepest = point->separation, p->triangle = triangle;
}

// Too many directions: the most similar two of one material become one, with the normal of the deeper.
static void merge_most_similar(fe__gathering *g)
{
    int32_t a = 0, b = 1;
    float most = -FLT_MAX;
    for (int32_t i = 0; i < g->count; ++i) {
        for (int32_t j = i + 1; j < g->count; ++j) {
            float alike = fe__dot(g->patches[i].normal, g->patches[j].normal) -
                          (g->patches[i].material != g->patches[j].material ? 2.0f : 0.0f);
            if (alike > most) most = alike, a = i, b = j;
        }
    }
    fe__raw_patch *into = g->patches + a, *from = g->patches + b;
    if (from->deepest < into->deepest)
        into->normal = from->normal, into->is_of_face = from->is_of_face, into->face = from->face,
        into->material = from->material;
    for (int32_t i = 0; i < from->count; ++i) add_point(g, into, from->points + i, from->triangle);
    *from = g->patches[--g->count];
}

// An edge is that of two triangles: the face is the one that looks along the normal.
static void set_face(fe__raw_patch *patch, const fe__tile *tile)
{
    const float same_side = 0.9f; // cosine
    if (fe__dot(patch->normal, tile->normal) > same_side) patch->face = tile->normal;
}

static void set_normal(fe__raw_patch *patch, const fe__tile *tile, fe_vec3 normal)
{
    patch->normal = patch->face = normal;
    patch->is_of_face = fe__is_along_face(normal, tile->normal);
}

void fe__gather(fe__gathering *g, const fe__tile *tile, fe_vec3 normal, fe_vec3 point, float separation, uint32_t id)
{
    int32_t material = tile->material;
    fe__manifold_point p = {point, separation, id};
    for (int32_t i = 0; i < g->count; ++i) {
        fe__raw_patch *patch = g->patches + i;
        if (patch->material != material || fe__dot(patch->normal, normal) < FE__SAME_NORMAL) continue;
        if (separation < patch->deepest) set_normal(patch, tile, normal);
        set_face(patch, tile);
        add_point(g, patch, &p, tile->index);
        return;
    }
    fe__raw_patch *added = g->patches + g->count++;
    *added = (fe__raw_patch){.triangle = tile->index, .material = material, .deepest = FLT_MAX};
    set_normal(added, tile, normal);
    set_face(added, tile);
    add_point(g, added, &p, tile->index);
    if (g->count > FE__PATCHES) merge_most_similar(g);
}
