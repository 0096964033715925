// bridge.c - see bridge.h.
#include "collision/manifold/bridge.h"

#include "collision/form/form.h"

#include <float.h>

// What lies deeper below the face is not carried by anything level with it, m, and as a share of the body's thickness:
// a step that is not felt, and what the body has sunk into what carries it
#define BELOW 0.004f
#define BELOW_SHARE 0.1f
// What touches the rim is held beyond the gap where another rim is nearer than this share of the distance to it: loads
// that differ shift what rests on both
#define NEARER 0.5f

// Points of the face's plane at which something else may go on
enum { PLACES_MOST = 4 * FE_FACE_VERTICES + 1 };
typedef struct places {
    fe_vec3 at[PLACES_MOST];
    int32_t count;
} places;

static int32_t solid_goes_on(const fe__crossing *c, const places *p, fe_vec3 f)
{
    for (int32_t i = 0; i < c->around->solid_count; ++i)
        for (int32_t k = 0; k < p->count; ++k)
            if (fe__solid_is_level_at(c->around->solids + i, p->at[k], f)) return 1;
    return 0;
}

static int32_t ground_goes_on(const fe__neighbour *n, const fe__crossing *c, const places *p, fe_vec3 f)
{
    int32_t beyond_alone = n == c->own && fe__dot(c->out, c->out) > 0.0f, count = 0;
    fe_dvec3 at[PLACES_MOST];
    for (int32_t k = 0; k < p->count; ++k) {
        if (beyond_alone && fe__dot(c->out, fe__sub(p->at[k], c->edge)) <= 0.0f) continue;
        at[count++] = fe__dadd(n->position, fe__widen(fe__mul_transposed(&n->axes, p->at[k])));
    }
    return count && fe__ground_is_level_at_any(&n->ground, at, count, fe__widen(fe__mul_transposed(&n->axes, f)));
}

static int32_t goes_on(const fe__crossing *c, const places *p, fe_vec3 f)
{
    if (solid_goes_on(c, p, f) || (c->own && ground_goes_on(c->own, c, p, f))) return 1;
    for (int32_t i = 0; i < c->around->ground_count; ++i)
        if (ground_goes_on(c->around->grounds + i, c, p, f)) return 1;
    return 0;
}

// The feature that looks against f, with its heights over the plane through q, and the lowest of them
static float find_feature(const fe__crossing *c, fe_vec3 q, fe_vec3 f, fe__face *face, float *height)
{
    const fe__solid *b = &c->body;
    float low = FLT_MAX;
    fe__form_face(b->form, fe__mul_transposed(&b->axes, fe__neg(f)), face);
    for (int32_t i = 0; i < face->count; ++i) {
        face->vertex[i] = fe__add(b->centre, fe__mul(&b->axes, face->vertex[i]));
        height[i] = fe__dot(f, fe__sub(face->vertex[i], q)) - b->form->radius;
        low = fe__minf(low, height[i]);
    }
    return low;
}

// What lies over the gap at p of the face's plane: is it nearer to another rim? Asked as far from p as this one is, on
// the other side and at 45 degrees to it: where corners meet, a gap may run on straight there
static void add_beyond(places *to, fe_vec3 p, fe_vec3 f, fe_vec3 rim, float separation)
{
    fe_vec3 away = fe__sub(p, rim);
    away = fe__scale(separation > 0.0f ? 1.0f : NEARER, fe__add_scaled(away, -fe__dot(f, away), f));
    fe_vec3 beyond = fe__add(p, away), aside = fe__cross(f, away);
    to->at[to->count++] = beyond;
    to->at[to->count++] = fe__add(beyond, aside);
    to->at[to->count++] = fe__sub(beyond, aside);
}

float fe__most_below(const fe__crossing *c)
{
    return c->fall + fe__minf(BELOW, BELOW_SHARE * fe__form_thickness(c->body.form));
}

int32_t fe__is_carried_over(const fe__crossing *c, fe_vec3 q, fe_vec3 f, const fe_vec3 *rim, float separation)
{
    fe__face face;
    float height[FE_FACE_VERTICES], below = fe__most_below(c), low = find_feature(c, q, f, &face, height);
    if (low < -below) return 0;
    fe_vec3 sum = {0.0f, 0.0f, 0.0f};
    places places; // its points stay unwritten
    places.count = 0;
    int32_t count = 0;
    for (int32_t i = 0; i < face.count; ++i) {
        if (height[i] > fe__maxf(low, 0.0f) + below) continue;
        fe_vec3 p = fe__add_scaled(face.vertex[i], -height[i] - c->body.form->radius, f);
        places.at[places.count++] = p;
        if (rim) add_beyond(&places, p, f, *rim, separation);
        sum = fe__add(sum, p), ++count;
    }
    if (count > 1) places.at[places.count++] = fe__scale(1.0f / (float)count, sum);
    return places.count && goes_on(c, &places, f);
}
