// terrain_gather.c - see terrain_gather.h.
#include "collision/manifold/terrain_gather.h"

#include "collision/form/clip.h"
#include "collision/manifold/bridge.h"

#include <float.h>

// ---- gaps ----------------------------------------------------------------------------------------------------------
static int32_t ends_at_a_side(const fe__ground *s, int32_t index)
{
    return fe__ground_is_rim(s, index, 0) || fe__ground_is_rim(s, index, 1) || fe__ground_is_rim(s, index, 2);
}

static int32_t is_carried_over(const fe__gathering *g, const fe__tile *tile, fe_vec3 m, const fe_vec3 *rim,
                               float separation)
{
    const fe__terrain *t = g->terrain;
    if (fe__is_along_face(m, tile->normal) || !ends_at_a_side(&t->ground, tile->index)) return 0;
    const fe__neighbour own = {t->ground, t->origin, {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}}};
    const fe__crossing crossing = {{g->form, {0.0f, 0.0f, 0.0f}, *g->rotation}, t->around, &own, t->fall};
    return fe__is_carried_over(&crossing, tile->form.vertex[0], tile->normal, rim, separation);
}

int32_t fe__tile_feels_along(const fe__gathering *g, const fe__tile *tile, fe_vec3 m, const fe_vec3 *rim,
                             float separation)
{
    return fe__tile_allows(g->terrain, tile, m) && !is_carried_over(g, tile, m, rim, separation);
}

// ---- patches -------------------------------------------------------------------------------------------------------
// Leaves at most four of the first `count` points; a point's index goes through the clipper's id.
static int32_t widest_four(fe__raw_patch *p, int32_t count, float tie)
{
    fe_vec3 n = p->normal, a = fe__absf(n.x) < 0.7f ? fe__vec3(1.0f, 0.0f, 0.0f) : fe__vec3(0.0f, 1.0f, 0.0f),
            u = fe__cross(n, a);
    u = fe__scale(1.0f / fe__length(u), u);
    fe_vec3 v = fe__cross(n, u);
    fe__clip_vertex vertex[FE__RAW_POINTS];
    fe__manifold_point kept[FE_MAX_POINTS];
    for (int32_t i = 0; i < count; ++i)
        vertex[i] = (fe__clip_vertex){fe__dot(u, p->points[i].point), fe__dot(v, p->points[i].point),
                                      p->points[i].separation, (uint32_t)i};
    count = fe__reduce_to_four(vertex, count, tie);
    for (int32_t i = 0; i < count; ++i) kept[i] = p->points[vertex[i].id];
    for (int32_t i = 0; i < count; ++i) p->points[i] = kept[i];
    return count;
}

static void swap(fe__raw_patch *p, int32_t i, int32_t j)
{
    fe__manifold_point here = p->points[i];
    p->points[i] = p->points[j];
    p->points[j] = here;
}

// The point beyond the first `chosen` that is farthest from all of them comes next.
static void choose_farthest(fe__raw_patch *p, int32_t chosen)
{
    int32_t best = chosen;
    float most = -1.0f;
    for (int32_t i = chosen; i < p->count; ++i) {
        float least = FLT_MAX;
        for (int32_t k = 0; k < chosen; ++k) {
            fe_vec3 away = fe__sub(p->points[i].point, p->points[k].point);
            least = fe__minf(least, fe__dot(away, away));
        }
        if (least > most) most = least, best = i;
    }
    swap(p, chosen, best);
}

// At most four points. Those that touch span the patch; what stands off comes after them: on uneven ground the widest
// four of all would leave out what carries.
void fe__reduce_patch(fe__raw_patch *p, float tie)
{
    const float touching = 0.001f; // m, a few overlaps of a body at rest
    if (p->count <= FE_MAX_POINTS) return;
    int32_t near = 0;
    for (int32_t i = 0; i < p->count; ++i)
        if (p->points[i].separation <= fe__maxf(p->deepest, 0.0f) + touching) swap(p, i, near++);
    if (near >= FE_MAX_POINTS) {
        p->count = widest_four(p, near, tie);
        return;
    }
    for (; near < FE_MAX_POINTS; ++near) choose_farthest(p, near);
    p->count = FE_MAX_POINTS;
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

static void add_point(const fe__gathering *g, fe__raw_patch *p, const fe__manifold_point *point, int32_t triangle)
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
    if (p->count == FE__RAW_POINTS) fe__reduce_patch(p, g->tie);
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
    if (from->deepest < into->deepest) into->normal = from->normal, into->material = from->material;
    for (int32_t i = 0; i < from->count; ++i) add_point(g, into, from->points + i, from->triangle);
    *from = g->patches[--g->count];
}

void fe__gather(fe__gathering *g, const fe__tile *tile, fe_vec3 normal, fe_vec3 point, float separation, uint32_t id)
{
    int32_t material = tile->material;
    fe__manifold_point p = {point, separation, id};
    for (int32_t i = 0; i < g->count; ++i) {
        fe__raw_patch *patch = g->patches + i;
        if (patch->material != material || fe__dot(patch->normal, normal) < FE__SAME_NORMAL) continue;
        if (separation < patch->deepest) patch->normal = normal;
        add_point(g, patch, &p, tile->index);
        return;
    }
    g->patches[g->count++] =
        (fe__raw_patch){.normal = normal, .triangle = tile->index, .material = material, .deepest = FLT_MAX};
    add_point(g, g->patches + g->count - 1, &p, tile->index);
    if (g->count > FE__PATCHES) merge_most_similar(g);
}
