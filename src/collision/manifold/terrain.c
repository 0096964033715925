// terrain.c - the triangles under a form, one by one; see collide.h.
#include "collision/manifold/collide.h"

#include "collision/form/hull.h"
#include "collision/form/form.h"
#include "collision/manifold/pair_kernels.h"
#include "collision/manifold/terrain_kernels.h"

#include <float.h>

// of half the smallest width: a form's centre below, but less than a quarter of that width deep. Half would lose what
// is pressed hard, all would let a thin ridge push out what leans on its other side
#define FELT 1.5f

// How deep the centre of B is under the ground, but no deeper than B reaches: a body that was pressed or spun into the
// ground comes up again, one far below is left alone. Else 0, as for a mesh, which has no below.
static double sunk(const fe__terrain *t, const fe__form *b)
{
    double height;
    if (!t->ground.field || !fe__heightfield_height(t->ground.field, t->origin, &height)) return 0.0;
    double depth = height - t->origin.y;
    return depth > 0.0 && depth <= (double)fe__form_reach(b, fe__vec3(0.0f, 0.0f, 0.0f)) ? depth : 0.0;
}

static fe__bounds bounds_around_hull(const fe__terrain *t, const fe__form *b, const fe__mat3 *r, double margin)
{
    const fe_dvec3 axes[3] = {{(double)r->x.x, (double)r->y.x, (double)r->z.x},
                              {(double)r->x.y, (double)r->y.y, (double)r->z.y},
                              {(double)r->x.z, (double)r->y.z, (double)r->z.z}};
    double low[3], high[3];
    for (int32_t k = 0; k < 3; ++k) {
        fe__hull_ends ends = fe__hull_ends_along(b->hull, axes[k]);
        low[k] = fe__ddot(axes[k], fe__hull_form_vertex(b, ends.against)) - margin;
        high[k] = fe__ddot(axes[k], fe__hull_form_vertex(b, ends.along)) + margin;
    }
    return (fe__bounds){fe__dadd(t->origin, (fe_dvec3){low[0], low[1], low[2]}),
                        fe__dadd(t->origin, (fe_dvec3){high[0], high[1], high[2]})};
}

static fe__bounds bounds_around(const fe__terrain *t, const fe__form *b, const fe__mat3 *r, float margin)
{
    if (fe__form_is_hull(b)) return bounds_around_hull(t, b, r, (double)margin);
    fe_vec3 half = b->half;
    half.y += b->half_height;
    float grow = b->radius + margin;
    fe_vec3 w = {fe__absf(r->x.x) * half.x + fe__absf(r->y.x) * half.y + fe__absf(r->z.x) * half.z + grow,
                 fe__absf(r->x.y) * half.x + fe__absf(r->y.y) * half.y + fe__absf(r->z.y) * half.z + grow,
                 fe__absf(r->x.z) * half.x + fe__absf(r->y.z) * half.y + fe__absf(r->z.z) * half.z + grow};
    return (fe__bounds){fe__dsub(t->origin, fe__widen(w)), fe__dadd(t->origin, fe__widen(w))};
}

int32_t fe__find_near_triangles(const fe__terrain *t, const fe__form *b, const fe__mat3 *rotation, float margin,
                                fe__mesh_near *near)
{
    const float more = 0.002f; // m: what is asked for at the rim of a look's box lies inside
    if (!t->ground.mesh) return 0;
    fe__bounds box = bounds_around(t, b, rotation, margin + more);
    fe__mesh_find_near(t->ground.mesh, &box, near);
    return 1;
}

// Is a triangle farther than `reach` from a round form's core, whose box has the half widths `core`? Then it has no
// point of it.
static int32_t is_beyond(const fe_vec3 v[3], fe_vec3 core, float reach)
{
    float x =
        fe__maxf(fe__minf(fe__minf(v[0].x, v[1].x), v[2].x), -fe__maxf(fe__maxf(v[0].x, v[1].x), v[2].x)) - core.x;
    float y =
        fe__maxf(fe__minf(fe__minf(v[0].y, v[1].y), v[2].y), -fe__maxf(fe__maxf(v[0].y, v[1].y), v[2].y)) - core.y;
    float z =
        fe__maxf(fe__minf(fe__minf(v[0].z, v[1].z), v[2].z), -fe__maxf(fe__maxf(v[0].z, v[1].z), v[2].z)) - core.z;
    x = fe__maxf(x, 0.0f), y = fe__maxf(y, 0.0f), z = fe__maxf(z, 0.0f);
    return x * x + y * y + z * z > reach * reach;
}

typedef struct mover {
    const fe__form *b;
    const fe__mat3 *rotation;
    fe_vec3 ends[2], core; // of what is round: of its core, and that core's box
    int32_t is_box, is_curved, culls;
} mover;

static mover mover_of(const fe__form *b, const fe__mat3 *rotation)
{
    fe_vec3 axis = fe__scale(fe__form_is_hull(b) ? 0.0f : b->half_height, rotation->y);
    return (mover){b,
                   rotation,
                   {fe__neg(axis), axis},
                   {fe__absf(axis.x), fe__absf(axis.y), fe__absf(axis.z)},
                   fe__form_has_flat_faces(b),
                   fe__form_is_curved(b) || fe__form_is_hull(b),
                   0};
}

// of which the form is there
static void touch_triangle(fe__gathering *g, const mover *m, fe__tile *tile, int32_t index)
{
    const fe__terrain *t = g->terrain;
    const float rounding = 1.0001f;
    if (m->culls && is_beyond(tile->form.vertex, m->core, rounding * (m->b->radius + g->margin))) return;
    fe__tile_place(t, index, tile);
    if (t->known_count && (t->ground.mesh || m->is_box || m->is_curved) && fe__tile_is_known(t, tile)) return;
    if (m->is_box)
        fe__tile_touch_box(g, tile, m->b, m->rotation);
    else if (m->is_curved)
        fe__tile_touch_curved(g, tile, m->b, m->rotation);
    else
        fe__tile_touch_round(g, tile, m->ends, m->b->radius);
}

static void gather_all(fe__gathering *g, const fe__form *b, const fe__mat3 *rotation)
{
    const fe__terrain *t = g->terrain;
    const fe__mesh_near *near = t->ground.near;
    mover m = mover_of(b, rotation);
    fe__tile tile;
    if (near && near->is_all) {
        m.culls = !(m.is_box || m.is_curved);
        for (uint64_t left = t->is_last ? near->among_last : near->among; left; left &= left - 1) {
            int32_t slot = near->slots[__builtin_ctzll(left)];
            fe__mesh_triangle(t->ground.mesh, slot, t->origin, &tile.form);
            touch_triangle(g, &m, &tile, slot);
        }
        return;
    }
    fe__bounds box = bounds_around(t, b, rotation, g->margin);
    double depth = sunk(t, b);
    box.high.y += depth;
    if (depth > 0.0) g->felt = FLT_MAX;
    m.culls = !(m.is_box || m.is_curved) && !(depth > 0.0);
    fe__ground_walk walk;
    fe__ground_begin(&walk, &t->ground, &box, t->origin);
    for (int32_t i; (i = fe__ground_next(&walk, &tile.form)) >= 0;) touch_triangle(g, &m, &tile, i);
}

static float gap_around(const fe__terrain *t, const fe__form *b, const fe__mat3 *rotation, float margin)
{
    float wide = margin + fe__form_reach(b, fe__vec3(0.0f, 0.0f, 0.0f));
    fe__bounds box = bounds_around(t, b, rotation, wide);
    fe__ground_walk walk;
    fe__ground_begin(&walk, &t->ground, &box, t->origin);
    fe__form triangle;
    if (fe__ground_next(&walk, &triangle) < 0) return wide;
    // what does not come nearer than it may be left out
    return t->ground.near && t->ground.near->is_all ? fe__minf(margin, t->ground.near->margin) : margin;
}

// What rolls, or rocks, on a rim has its lowest point; a rim that lies is held at points of its body, not where the
// load leans
static int32_t left_out_of(const fe__gathering *g, const fe__raw_patch *raw)
{
    if (g->rims >> FE_RIM_LEANS & 1) return FE_LEFT_NONE;
    if (raw->left_out != FE_LEFT_SIDES || !g->rims) return raw->left_out;
    return g->rims >> FE_RIM_LIES & 1 ? FE_LEFT_SOME : FE_LEFT_REST;
}

// `away`: of the form's centre in the caller's frame
static int32_t collide_centred(const fe__terrain *t, const fe__form *b, const fe__mat3 *rotation, fe_vec3 away,
                               float margin, fe__patch patches[FE__PATCHES], float *gap)
{
    fe__gathering g;
    g.terrain = t, g.form = b, g.rotation = rotation, g.margin = margin, g.felt = FELT * fe__form_thickness(b),
    g.single = fe__form_is_ball(b), g.rims = 0, g.away = away, g.has_load = 0, g.count = 0;
    g.tie = 0.1f * fe__tie(fe__form_thickness(b)), g.same_place = fe__minf(0.002f, 0.02f * fe__form_thickness(b));
    gather_all(&g, b, rotation);
    fe__leave_carried(&g);
    if (!g.count && gap) *gap = gap_around(t, b, rotation, margin);
    for (int32_t i = 0; i < g.count; ++i) {
        fe__raw_patch *raw = g.patches + i;
        if (fe__form_is_curved(b)) fe__keep_side_ends(raw, g.tie);
        if (b->radius > 0.0f && !g.single) fe__keep_core_ends(raw, rotation->y, g.tie);
        fe__reduce_patch(&g, raw, g.rims >> FE_RIM_AIMED & 1);
        patches[i] = (fe__patch){.normal = raw->normal,
                                 .face = raw->face,
                                 .count = raw->count,
                                 .left_out = left_out_of(&g, raw),
                                 .triangle = fe__ground_number(&t->ground, raw->triangle)};
        for (int32_t k = 0; k < raw->count; ++k) patches[i].points[k] = raw->points[k];
    }
    return g.count;
}

// into a frame whose origin is at `away`
static void move_surroundings(const fe__surroundings *from, fe_vec3 away, fe__surroundings *to)
{
    to->ground_count = from->ground_count, to->solid_count = from->solid_count;
    for (int32_t i = 0; i < from->ground_count; ++i) {
        fe__neighbour *n = to->grounds + i;
        *n = from->grounds[i];
        n->position = fe__dadd(n->position, fe__widen(fe__mul_transposed(&n->axes, away)));
    }
    for (int32_t i = 0; i < from->solid_count; ++i) {
        to->solids[i] = from->solids[i];
        to->solids[i].centre = fe__sub(from->solids[i].centre, away);
    }
}

// A hull's own origin may be anywhere: what is felt of a surface is decided by its centre.
int32_t fe__collide_terrain(const fe__terrain *t, const fe__form *b, const fe__mat3 *rotation, float margin,
                            fe__patch patches[FE__PATCHES], float *gap)
{
    if (!fe__form_is_hull(b)) return collide_centred(t, b, rotation, fe__vec3(0.0f, 0.0f, 0.0f), margin, patches, gap);
    fe_vec3 centre = fe__hull_form_centre(b), away = fe__mul(rotation, centre);
    fe__form centred = *b;
    centred.offset = fe__sub(b->offset, centre);
    fe__surroundings around; // their numbers say how many are written
    move_surroundings(t->around, away, &around);
    fe__terrain there = *t;
    there.origin = fe__dadd(t->origin, fe__widen(away)), there.around = &around;
    int32_t count = collide_centred(&there, &centred, rotation, away, margin, patches, gap);
    for (int32_t i = 0; i < count; ++i)
        for (int32_t k = 0; k < patches[i].count; ++k)
            patches[i].points[k].point = fe__add(patches[i].points[k].point, away);
    return count;
}
