// mesh.c - a mesh's triangles by number and by slot, and the walk over those near a box; see mesh.h.
#include "collision/form/mesh.h"

#include "core/lanes.h"

#include <string.h>

// ---- mesh -----------------------------------------------------------------------------------------------------------
// Inverts the permutation (Munro, Raman, Raman and Rao, Succinct Representations of Permutations, 2003): it follows the
// cycle of `number` to its end, which is the slot. The first shortcut that is met leads back to before `number`.
int32_t fe__mesh_slot(const fe__mesh *m, int32_t number)
{
    int32_t element = number, is_back = 0;
    while (fe__mesh_number(m, element) != number) {
        if (is_back || !(m->numbers[element] & FE__MESH_HAS_SHORTCUT)) {
            element = fe__mesh_number(m, element);
            continue;
        }
        int32_t low = 0, high = m->shortcut_count - 1;
        while (low < high) { // binary search by `from`
            int32_t middle = low + (high - low) / 2;
            if (m->shortcuts[middle].from < element)
                low = middle + 1;
            else
                high = middle;
        }
        element = m->shortcuts[low].to;
        is_back = 1;
    }
    return element;
}

fe__mesh_edge fe__mesh_edge_of(const fe__mesh *m, int32_t slot, int32_t corner)
{
    static const int32_t digit[3] = {1, FE__MESH_EDGES, FE__MESH_EDGES * FE__MESH_EDGES};
    int32_t side = m->is_mirrored ? 2 - corner : corner;
    return (fe__mesh_edge)(m->edges[slot] / digit[side] % FE__MESH_EDGES);
}

void fe__mesh_corners(const fe__mesh *m, int32_t slot, fe_dvec3 corner[3])
{
    for (int32_t k = 0; k < 3; ++k) {
        const float *v = fe__mesh_vertex(m, slot, fe__mesh_own_corner(m, k));
        corner[k] = (fe_dvec3){m->scale[0] * (double)v[0], m->scale[1] * (double)v[1], m->scale[2] * (double)v[2]};
    }
}

fe__form fe__mesh_form(const fe__mesh *m, int32_t index)
{
    return (fe__form){.type = FE__FORM_MESH, .field = index, .low = m->low, .high = m->high};
}

float fe__mesh_reach(const fe__form *form, fe_vec3 centre)
{
    fe_vec3 a = fe__sub(centre, form->low), b = fe__sub(form->high, centre);
    return fe__length(fe__vec3(fe__maxf(fe__absf(a.x), fe__absf(b.x)), fe__maxf(fe__absf(a.y), fe__absf(b.y)),
                               fe__maxf(fe__absf(a.z), fe__absf(b.z))));
}

// ---- the beginning of a walk ----------------------------------------------------------------------------------------
// Divides an interval by the scale and widens it by more than the rounding of a quotient.
static void unscale(double scale, double *low, double *high)
{
    const double rounding = 0x1p-51;
    double a = *low / scale, b = *high / scale, from = fe__mind(a, b), to = fe__maxd(a, b);
    *low = from - rounding * fe__absd(from), *high = to + rounding * fe__absd(to);
}

void fe__mesh_walk_begin(fe__mesh_walk *walk, const fe__mesh *mesh, const fe__mesh_near *near, const fe__bounds *box,
                         fe_dvec3 origin)
{
    walk->mesh = mesh, walk->box = *box, walk->origin = origin;
    if (mesh->is_scaled) {
        unscale(mesh->scale[0], &walk->box.low.x, &walk->box.high.x);
        unscale(mesh->scale[1], &walk->box.low.y, &walk->box.high.y);
        unscale(mesh->scale[2], &walk->box.low.z, &walk->box.high.z);
    }
    const double low[4] = {walk->box.low.x, walk->box.low.y, walk->box.low.z, 0.0},
                 high[4] = {walk->box.high.x, walk->box.high.y, walk->box.high.z, 0.0};
    for (int32_t k = 0; k < 4; ++k) walk->low[k] = fe__float_above(low[k]), walk->high[k] = -fe__float_above(-high[k]);
    int32_t is_inside = near && near->count >= 0 && box->low.x >= near->box.low.x && box->low.y >= near->box.low.y &&
                        box->low.z >= near->box.low.z && box->high.x <= near->box.high.x &&
                        box->high.y <= near->box.high.y && box->high.z <= near->box.high.z;
    walk->near = is_inside ? near : NULL;
    walk->slot = 0, walk->end = walk->near ? near->count : 0;
    walk->top = !walk->near;
    walk->stack[0] = 0; // the root
}

// ---- nodes ---------------------------------------------------------------------------------------------------------
// A word holds eight bytes. Bit 7 of each byte of the result tells whether the byte of x is at least the byte of y
// (Warren, Hacker's Delight, 2013, 2-18).
#define BYTES 0x0101010101010101u
#define TOPS (0x80 * BYTES)
static inline uint64_t at_least(uint64_t x, uint64_t y)
{
    uint64_t rest = (x | TOPS) - (y & ~TOPS);
    return (x & ~y) | (~(x ^ y) & rest);
}

static inline uint64_t word_of(const uint8_t bytes[FE__MESH_WIDTH])
{
    uint64_t word;
    memcpy(&word, bytes, sizeof word);
    return word;
}

// Bit i of the result is the top bit of byte i in memory. The multiplication adds the bits, each shifted to a place of
// its own.
static inline uint32_t gather_tops(uint64_t tops)
{
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    tops = __builtin_bswap64(tops);
#endif
    return (uint32_t)((tops >> 7) * 0x0102040810204080u >> 56);
}

// Bit i of the result: the box meets the box of child i. Steps are whole; the box is widened by more than rounding.
static uint32_t meet_boxes(const fe__mesh_walk *w, const fe__mesh_node *node)
{
    const double widening = 1e-4; // steps
    const int32_t last = 255;
    const double low[3] = {w->box.low.x, w->box.low.y, w->box.low.z},
                 high[3] = {w->box.high.x, w->box.high.y, w->box.high.z};
    uint64_t met = TOPS;
    for (int32_t k = 0; k < 3; ++k) {
        double per_step = fe__mesh_per_step(node, k), origin = (double)node->origin[k];
        double from = fe__clampd((low[k] - origin) * per_step, -1.0, 256.0) - widening,
               to = fe__clampd((high[k] - origin) * per_step, -1.0, 256.0) + widening;
        int32_t first = (int32_t)(from + 1.0), end = (int32_t)(to + 1.0); // truncated: none is below -1
        if (first > last || end < 1) return 0;
        met &= at_least(word_of(node->high[k]), (uint64_t)first * BYTES) &
               at_least((uint64_t)fe__mini(end - 1, last) * BYTES, word_of(node->low[k]));
    }
    return gather_tops(met & TOPS) & ((1u << node->count) - 1);
}

// Goes down to the next leaf whose box is met; 0: no more
static int32_t find_leaf(fe__mesh_walk *w)
{
    while (w->top) {
        uint32_t child = w->stack[--w->top];
        if (!(child & FE__MESH_LEAVES)) {
            // The first of the children that are met comes on top.
            const fe__mesh_node *node = w->mesh->nodes + child;
            for (uint32_t met = meet_boxes(w, node); met; met &= ~(1u << (31 - __builtin_clz(met))))
                w->stack[w->top++] = node->first + (uint32_t)(31 - __builtin_clz(met));
            continue;
        }
        w->slot = FE__MESH_LEAF * (int32_t)(child & ~FE__MESH_LEAVES);
        w->end = fe__mini(w->slot + FE__MESH_LEAF, w->mesh->triangle_count);
        return 1;
    }
    return 0;
}

// ---- triangles -----------------------------------------------------------------------------------------------------
typedef float loose_quad __attribute__((vector_size(16), aligned(4), may_alias));

// Corner k of a triangle is the three floats at first + 3 corner[k]. A fourth is read behind them; it belongs to
// another vertex.
typedef struct corners {
    const float *first;
    const uint8_t *corner;
} corners;
static inline corners corners_of(const fe__mesh *mesh, int32_t slot)
{
    const fe__mesh_leaf *leaf = mesh->leaves + (uint32_t)slot / FE__MESH_LEAF;
    return (corners){mesh->vertices + 3 * (size_t)leaf->first_vertex, leaf->corner[(uint32_t)slot % FE__MESH_LEAF]};
}
static inline fe__quad load_corner(const corners *c, int32_t k)
{
    return *(const loose_quad *)(c->first + 3 * (size_t)c->corner[k]);
}

static void set_span(const fe__mesh *mesh, int32_t slot, fe__mesh_span *out)
{
    const corners triangle = corners_of(mesh, slot);
    fe__quad a = load_corner(&triangle, 0), b = load_corner(&triangle, 1), c = load_corner(&triangle, 2);
    *(fe__quad *)out->low = fe__quad_min(fe__quad_min(a, b), c);
    *(fe__quad *)out->high = fe__quad_max(fe__quad_max(a, b), c);
}

static int32_t meets(const fe__mesh_walk *w, const fe__mesh_span *s)
{
    enum { THREE = 7 }; // The fourth lane is another vertex's, or no vertex's.
    fe__quad_int met = (*(const fe__quad *)s->low <= *(const fe__quad *)w->high) &
                       (*(const fe__quad *)s->high >= *(const fe__quad *)w->low);
    return (fe__quad_signs(met) & THREE) == THREE;
}

void fe__mesh_triangle(const fe__mesh *mesh, int32_t slot, fe_dvec3 origin, fe__form *triangle)
{
    const corners unscaled = corners_of(mesh, slot);
    const double *s = mesh->scale;
    const fe__doubles scale_xy = {s[0], s[1]}, scale_z = {s[2], s[2]}, xy = {origin.x, origin.y},
                      z = {origin.z, origin.z};
    triangle->type = FE__FORM_TRIANGLE, triangle->radius = 0.0f;
    for (int32_t k = 0; k < 3; ++k) {
        fe__quad p = load_corner(&unscaled, fe__mesh_own_corner(mesh, k));
        fe__quad corner = fe__quad_narrow(scale_xy * fe__doubles_low(p) - xy, scale_z * fe__doubles_high(p) - z);
        memcpy(triangle->vertex + k, &corner, sizeof *triangle->vertex);
    }
}

// ---- the walk ------------------------------------------------------------------------------------------------------
int32_t fe__mesh_walk_next_slot(fe__mesh_walk *w)
{
    if (w->near) {
        while (w->slot < w->end) {
            int32_t place = w->slot++;
            if (meets(w, w->near->spans + place)) return w->near->slots[place];
        }
        return -1;
    }
    do {
        while (w->slot < w->end) {
            fe__mesh_span span;
            int32_t slot = w->slot++;
            set_span(w->mesh, slot, &span);
            if (meets(w, &span)) return slot;
        }
    } while (find_leaf(w));
    return -1;
}

int32_t fe__mesh_walk_next(fe__mesh_walk *w, fe__form *triangle)
{
    int32_t slot = fe__mesh_walk_next_slot(w);
    if (slot >= 0) fe__mesh_triangle(w->mesh, slot, w->origin, triangle);
    return slot;
}

// No branch predictor can guess which triangles meet the box: each is written, and the next one over it if it does not
// count.
void fe__mesh_find_near(const fe__mesh *mesh, const fe__bounds *box, fe__mesh_near *near)
{
    fe__mesh_walk walk;
    near->box = *box, near->count = 0, near->is_all = 0, near->among = near->among_last = 0;
    fe__mesh_walk_begin(&walk, mesh, NULL, box, box->low);
    while (near->count >= 0 && find_leaf(&walk))
        for (int32_t slot = walk.slot; slot < walk.end && near->count >= 0; ++slot) {
            fe__mesh_span span;
            set_span(mesh, slot, &span);
            int32_t is_met = meets(&walk, &span);
            if (near->count < FE__MESH_NEAR) {
                near->spans[near->count] = span;
                near->slots[near->count] = slot;
                near->count += is_met;
            } else if (is_met) {
                near->count = -1;
            }
        }
}
