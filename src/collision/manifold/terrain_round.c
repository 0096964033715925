// terrain_round.c - a sphere or a capsule on a triangle of a heightfield.
//
// The core (a point, a segment) over the face gives points along the face's normal; near a convex side the nearest
// points of core and side give one along the line between them, where the surface allows it.
#include "collision/manifold/pair_kernels.h"
#include "collision/manifold/terrain_kernels.h"

enum { END_ID = 1, SIDE_ID = 4 };

// the part from..to of the core
typedef struct stretch {
    float from, to;
} stretch;

static fe_vec3 core_point(const fe_vec3 ends[2], float s)
{
    return fe__add_scaled(ends[0], s, fe__sub(ends[1], ends[0]));
}

// cuts away where  a + s (b - a) > most
static void cut(stretch *part, float a, float b, float most)
{
    if (a > most && b > most) {
        part->from = 1.0f, part->to = 0.0f;
    } else if (a > most) {
        part->from = fe__maxf(part->from, (a - most) / (a - b));
    } else if (b > most) {
        part->to = fe__minf(part->to, (most - a) / (b - a));
    }
}

// halfway between the surfaces of the core's point and the triangle
static void gather(fe__gathering *g, const fe__tile *tile, fe_vec3 normal, fe_vec3 core, float height, float radius,
                   uint32_t id)
{
    float separation = height - radius;
    if (separation > g->margin || !fe__tile_feels(g, tile, separation)) return;
    fe__gather(g, tile, normal, fe__add_scaled(core, -0.5f * (height + radius), normal), separation, id);
}

// Returns the sides that the core reaches beyond, a bit each.
static uint32_t touch_face(fe__gathering *g, const fe__tile *tile, const fe_vec3 ends[2], float radius, float slack)
{
    uint32_t beyond = 0;
    const fe_vec3 *v = tile->form.vertex, n = tile->normal;
    stretch part = {0.0f, 1.0f};
    for (int32_t k = 0; k < 3; ++k) {
        fe_vec3 side = fe__sub(v[(k + 1) % 3], v[k]), out = fe__cross(side, n);
        float a = fe__dot(out, fe__sub(ends[0], v[k])), b = fe__dot(out, fe__sub(ends[1], v[k])),
              most = slack * fe__length(side);
        cut(&part, a, b, most);
        if (fe__maxf(a, b) > -most) beyond |= 1u << k;
    }
    if (part.from > part.to) return beyond;
    const float at[2] = {part.from, part.to};
    for (int32_t i = 0; i < 2; ++i) {
        fe_vec3 p = core_point(ends, at[i]);
        int32_t is_end = at[i] == (float)i;
        gather(g, tile, n, p, fe__dot(n, fe__sub(p, v[0])), radius,
               is_end ? (uint32_t)(END_ID + i) : fe__tile_id(tile, (uint32_t)i));
        if (g->single) break;
    }
    return beyond;
}

// Nearest points of the core and a side: s of the core, u of the side (Eberly; Ericson, Real-Time Collision
// Detection, 5.1.9)
static void nearest_of(const fe_vec3 ends[2], fe_vec3 start, fe_vec3 side, float *s, float *u)
{
    fe_vec3 d = fe__sub(ends[1], ends[0]), r = fe__sub(ends[0], start);
    float a = fe__dot(d, d), e = fe__dot(side, side), f = fe__dot(side, r), b = fe__dot(d, side), c = fe__dot(d, r),
          det = a * e - b * b;
    *s = det > 1e-6f * a * e ? fe__clampf((b * f - c * e) / det, 0.0f, 1.0f) : 0.0f;
    *u = fe__clampf((b * *s + f) / e, 0.0f, 1.0f);
    *s = a > 0.0f ? fe__clampf((b * *u - c) / a, 0.0f, 1.0f) : 0.0f;
}

// Is the core's point beyond no side by more than the surface goes on across? Then it may be over no triangle at all
static int32_t is_over_seam(const fe__tile *tile, fe_vec3 core)
{
    const fe_vec3 *v = tile->form.vertex;
    for (int32_t k = 0; k < 3; ++k) {
        fe_vec3 side = fe__sub(v[(k + 1) % 3], v[k]), out = fe__cross(side, tile->normal);
        if (fe__dot(out, fe__sub(core, v[k])) > fe__tile_goes_on(tile) * fe__length(side)) return 0;
    }
    return 1;
}

static void touch_side(fe__gathering *g, const fe__tile *tile, int32_t k, const fe_vec3 ends[2], float radius)
{
    const fe_vec3 start = tile->form.vertex[k], side = fe__sub(tile->form.vertex[(k + 1) % 3], start);
    float s, u;
    nearest_of(ends, start, side, &s, &u);
    fe_vec3 q = fe__add_scaled(start, u, side), away = fe__sub(core_point(ends, s), q);
    float distance = fe__length(away);
    if (distance - radius > g->margin || distance < 1e-6f * tile->size) return;
    fe_vec3 m = fe__scale(1.0f / distance, away), lean = fe__sub(m, tile->normal);
    const float flat = 1e-3f; // rad. Only rounding knows the difference to the face's direction
    if (fe__dot(lean, lean) <= flat * flat) m = tile->normal;
    // Where core and side nearly run alike, rounding shifts their nearest points: what leans inwards is over the face
    if (fe__dot(m, fe__sub(tile->form.vertex[(k + 2) % 3], start)) > flat * tile->size) return;
    if (fe__dot(m, tile->normal) < -flat) return;
    int32_t is_seam = g->terrain->ground.mesh && is_over_seam(tile, core_point(ends, s));
    if (is_seam && !fe__tile_allows(g->terrain, tile, m))
        m = tile->normal;
    else if (!fe__tile_feels_along(g, tile, m, &q, distance - radius))
        return;

    // along the side the core has two points, else the nearest
    fe_vec3 d = fe__sub(ends[1], ends[0]);
    float across = fe__dot(d, m), length = fe__dot(d, d), cosine = fe__dot(d, side);
    stretch part = {s, s};
    if (length > 0.0f && across * across < 1e-4f * length &&
        cosine * cosine > FE_FACE_COS * FE_FACE_COS * length * fe__dot(side, side)) {
        part = (stretch){0.0f, 1.0f};
        float most = fe__dot(side, side), a = fe__dot(side, fe__sub(ends[0], start)),
              b = fe__dot(side, fe__sub(ends[1], start));
        cut(&part, a, b, most);
        cut(&part, -a, -b, 0.0f);
    }
    const float at[2] = {part.from, part.to};
    for (int32_t i = 0; i < 2; ++i) {
        fe_vec3 p = core_point(ends, at[i]);
        int32_t is_end = at[i] == (float)i;
        gather(g, tile, m, p, fe__dot(m, fe__sub(p, q)), radius,
               is_end ? (uint32_t)(END_ID + i) : fe__tile_id(tile, (uint32_t)(SIDE_ID * (k + 1) + i)));
        if (part.from >= part.to) return;
    }
}

// All points of a patch are in one line. Where several surfaces are touched, none may have both ends of the core. The
// two that carry are named as the core's ends are: so they keep their impulses from triangle to triangle.
void fe__keep_core_ends(fe__raw_patch *patch, fe_vec3 axis, float tie)
{
    int32_t from = 0, to = 0;
    for (int32_t i = 1; i < patch->count; ++i) {
        float at = fe__dot(axis, patch->points[i].point);
        if (at < fe__dot(axis, patch->points[from].point)) from = i;
        if (at > fe__dot(axis, patch->points[to].point)) to = i;
    }
    if (from == to) return;
    patch->points[from].id = END_ID, patch->points[to].id = END_ID + 1;
    fe__keep_line_ends(patch, from, to, tie);
}

void fe__tile_touch_round(fe__gathering *g, const fe__tile *tile, const fe_vec3 ends[2], float radius)
{
    const float slack = 1e-5f; // of the triangle's size: what lies over a seam lies over both its sides
    const fe_vec3 v = tile->form.vertex[0], n = tile->normal;
    float a = fe__dot(n, fe__sub(ends[0], v)), b = fe__dot(n, fe__sub(ends[1], v));
    if (fe__minf(a, b) - radius > g->margin || !fe__tile_feels(g, tile, fe__maxf(a, b) - radius)) return;
    uint32_t beyond = touch_face(g, tile, ends, radius, slack * tile->size);
    for (int32_t k = 0; k < 3; ++k) {
        if (!(beyond >> k & 1)) continue; // what is nearest to the core is not there
        int32_t other = fe__tile_beyond(g->terrain, tile, k);
        if (other < 0 || other > tile->index)
            touch_side(g, tile, k, ends, radius); // of the two at a side the first has it
    }
}
