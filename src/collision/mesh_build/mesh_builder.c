// mesh_builder.c - the block of a mesh, see mesh_build.h and form/mesh.h.
//
// Leaves are filled in their order. Their vertices go into a group until the next leaf would bring its 257th; then a
// new group begins. Neighbouring leaves are neighbours in space: half of the vertices are met in the same group again.
#include "collision/mesh_build/mesh_build.h"

// ---- layout ---------------------------------------------------------------------------------------------------------

static int64_t padded(int64_t size) { return (size + 63) / 64 * 64; }

// ---- rooms ---------------------------------------------------------------------------------------------------------
enum { PLACE_BITS = 8, NO_GROUP = 0 }; // fe__mesh_builder.place: group << 8 | which vertex of it; groups from 1 on

static int64_t words(int64_t count) { return padded(count * (int64_t)sizeof(uint32_t)); }

int64_t fe__mesh_seen_size(int32_t count) { return padded((int64_t)count / 8 + 1); }

// Two in a cycle of FE__MESH_SHORTCUT + 1, one more for each further FE__MESH_SHORTCUT
int64_t fe__mesh_shortcuts_size(int32_t count)
{
    return padded((int64_t)sizeof(fe__mesh_shortcut) * (2 * (int64_t)count / (FE__MESH_SHORTCUT + 1) + 1));
}

int64_t fe__mesh_room_size(const fe__mesh_source *s)
{
    return padded(sizeof(fe__mesh_builder)) + 2 * words(s->vertex_count) + words(s->triangle_count) +
           padded((int64_t)sizeof(fe__mesh_node) * fe__mesh_node_room(s->triangle_count)) + padded(s->triangle_count) +
           fe__mesh_seen_size(s->triangle_count) + fe__mesh_shortcuts_size(s->triangle_count);
}

static void *take(unsigned char **at, int64_t size)
{
    void *taken = *at;
    *at += padded(size);
    return taken;
}

static void share_room(fe__mesh_builder *b, const fe__mesh_source *s)
{
    unsigned char *at = (unsigned char *)b;
    take(&at, sizeof *b);
    b->weld = take(&at, words(s->vertex_count));
    b->place = take(&at, words(s->vertex_count));
    b->order = take(&at, words(s->triangle_count));
    b->node_room = fe__mesh_node_room(s->triangle_count);
    b->nodes = take(&at, (int64_t)sizeof *b->nodes * b->node_room);
    b->edges = take(&at, s->triangle_count);
    b->seen = take(&at, fe__mesh_seen_size(s->triangle_count));
    b->shortcuts = take(&at, fe__mesh_shortcuts_size(s->triangle_count));
}

int64_t fe__mesh_scratch_size(const fe__mesh_source *s)
{
    return padded(fe__maxl(fe__mesh_weld_size(s), fe__maxl(fe__mesh_edges_size(s), fe__mesh_tree_size(s))));
}

// ---- measures ------------------------------------------------------------------------------------------------------
static void measure(fe__mesh_builder *b)
{
    fe__mesh_measures sum = fe__mesh_measures_begin(&b->mesh);
    for (int32_t i = 0; i < b->source->triangle_count; ++i) {
        if (b->edges[i] == FE__MESH_DROPPED) continue;
        fe_vec3 corner[3];
        fe__mesh_welded_corners(b, i, corner);
        fe__mesh_measures_add(&sum, corner);
    }
    fe__mesh_measures_end(&sum, &b->mesh);
}

int32_t fe__mesh_build(fe__mesh_builder *b, void *scratch, const fe__mesh_source *source)
{
    share_room(b, source);
    b->source = source;
    b->scratch = scratch;
    b->refusal.triangle = -1;
    b->mesh.given_count = source->triangle_count;
    b->mesh.is_two_sided = source->is_two_sided;
    fe__mesh_weld(b);
    fe__mesh_find_edges(b);
    if (b->mesh.triangle_count == 0) b->refusal.triangle = -1;
    if (b->mesh.triangle_count == 0 || (source->is_strict && b->refusal.triangle >= 0)) return 0;
    fe__mesh_build_tree(b);
    measure(b);
    b->scratch = NULL;
    return 1;
}

// ---- groups --------------------------------------------------------------------------------------------------------
typedef struct grouping {
    fe__mesh_builder *builder;
    uint32_t group;        // from 1 on
    uint32_t first, count; // vertices before it, and of it
} grouping;

static int32_t slot_number(const fe__mesh_builder *b, int32_t slot)
{
    return (int32_t)(b->order[slot] & ~FE__MESH_HAS_SHORTCUT);
}

enum { CORNERS = 3 * FE__MESH_LEAF };

// Of a leaf, corner by corner; returns how many
static int32_t read_vertices(const fe__mesh_builder *b, int32_t leaf, uint32_t vertex[CORNERS])
{
    int32_t end = fe__mini(FE__MESH_LEAF * leaf + FE__MESH_LEAF, b->mesh.triangle_count), count = 0;
    for (int32_t slot = FE__MESH_LEAF * leaf; slot < end; ++slot)
        for (int32_t k = 0; k < 3; ++k) vertex[count++] = fe__mesh_welded(b, slot_number(b, slot), k);
    return count;
}

// Vertices that are new to the group come behind those it has. 0: they are too many. What was placed then is of no
// group that goes on
static int32_t place_vertices(grouping *g, const uint32_t *vertex, int32_t vertex_count)
{
    uint32_t *places = g->builder->place;
    for (int32_t k = 0; k < vertex_count; ++k) {
        if (places[vertex[k]] >> PLACE_BITS == g->group) continue;
        if (g->count == FE__MESH_GROUP) return 0;
        places[vertex[k]] = g->group << PLACE_BITS | g->count++;
    }
    return 1;
}

// The group had `known` vertices before.
static void write_leaf(const grouping *g, const uint32_t *vertex, int32_t vertex_count, uint32_t known, float *vertices,
                       fe__mesh_leaf *out)
{
    const fe__mesh_builder *b = g->builder;
    out->first_vertex = g->first;
    for (int32_t k = 0; k < vertex_count; ++k) {
        uint32_t at = b->place[vertex[k]] & (FE__MESH_GROUP - 1);
        out->corner[k / 3][k % 3] = (uint8_t)at;
        if (at < known) continue;
        fe_vec3 v = fe__mesh_source_vertex(b->source, vertex[k]);
        memcpy(vertices + 3 * ((size_t)g->first + at), &v, sizeof v);
    }
}

// Groups fit in what PLACE_BITS leave: each but the last has more than FE__MESH_GROUP - 12 vertices, of 3 x 2^27 at
// most
static void add_leaf(grouping *g, int32_t leaf, float *vertices, fe__mesh_leaf *out)
{
    uint32_t vertex[CORNERS], known = g->count;
    int32_t corners = read_vertices(g->builder, leaf, vertex);
    if (!place_vertices(g, vertex, corners)) {
        g->first += known;
        g->group += 1;
        g->count = known = 0;
        (void)place_vertices(g, vertex, corners); // of a leaf all fit
    }
    if (out) write_leaf(g, vertex, corners, known, vertices, out);
}

static int32_t make_groups(fe__mesh_builder *b, float *vertices, fe__mesh_leaf *leaves)
{
    grouping g = {.builder = b, .group = NO_GROUP + 1};
    memset(b->place, 0, (size_t)b->source->vertex_count * sizeof *b->place);
    for (int32_t i = 0; i < fe__mesh_leaf_count(b->mesh.triangle_count); ++i)
        add_leaf(&g, i, vertices, leaves ? leaves + i : NULL);
    return (int32_t)(g.first + g.count);
}

// ---- the block -----------------------------------------------------------------------------------------------------
typedef struct places {
    unsigned char *block;
    int64_t end;
} places;

static void *place(places *p, int64_t bytes)
{
    void *at = p->block ? p->block + p->end : NULL;
    p->end += (bytes + 15) / 16 * 16;
    return at;
}

int64_t fe__mesh_share(fe__mesh *m, void *block, int32_t has_data, int32_t has_materials)
{
    places p = {block, 0};
    int64_t count = m->triangle_count;
    // the last vertex and the last node may be read 16 bytes wide
    m->vertices = place(&p, 12 * (int64_t)m->vertex_count + 4);
    m->leaves = place(&p, (int64_t)sizeof(fe__mesh_leaf) * fe__mesh_leaf_count(m->triangle_count));
    m->nodes = place(&p, (int64_t)sizeof(fe__mesh_node) * m->node_count);
    m->numbers = place(&p, 4 * (int64_t)m->given_count);
    m->shortcuts = place(&p, (int64_t)sizeof(fe__mesh_shortcut) * m->shortcut_count);
    m->data = has_data ? place(&p, 4 * count) : NULL;
    m->edges = place(&p, count);
    m->materials = has_materials ? place(&p, count) : NULL;
    m->scale[0] = m->scale[1] = m->scale[2] = 1.0;
    m->block = block;
    m->size = p.end;
    return p.end;
}

static int64_t share(const fe__mesh_builder *b, fe__mesh *m, void *block)
{
    return fe__mesh_share(m, block, b->source->data != NULL, b->source->materials != NULL);
}

int64_t fe__mesh_block_size(fe__mesh_builder *b)
{
    b->mesh.vertex_count = make_groups(b, NULL, NULL);
    b->mesh.shortcut_count = fe__mesh_shortcuts(b->order, b->mesh.given_count, b->seen, b->shortcuts);
    fe__mesh counted = b->mesh;
    return share(b, &counted, NULL);
}

static void fill_slots(const fe__mesh_builder *b, const fe__mesh_arrays *out)
{
    for (int32_t slot = 0; slot < b->mesh.triangle_count; ++slot) {
        int32_t number = slot_number(b, slot);
        out->edges[slot] = b->edges[number];
        if (out->data) out->data[slot] = b->source->data[number];
        if (out->materials) out->materials[slot] = b->source->materials[number];
    }
}

void fe__mesh_write(fe__mesh_builder *b, void *block, fe__mesh *out)
{
    fe__mesh *m = &b->mesh;
    *out = *m;
    share(b, out, block);
    fe__mesh_arrays own = fe__mesh_own_arrays(out);
    make_groups(b, own.vertices, own.leaves);
    memcpy(own.nodes, b->nodes, (size_t)m->node_count * sizeof *b->nodes);
    if (m->shortcut_count) memcpy(own.shortcuts, b->shortcuts, (size_t)m->shortcut_count * sizeof *b->shortcuts);
    memcpy(own.numbers, b->order, (size_t)m->given_count * sizeof *b->order);
    fill_slots(b, &own);
}

// ---- weld -----------------------------------------------------------------------------------------------------------
// Vertices that are one.
//
// Vertices are looked at in the caller's order. One that lies where an earlier one stays, or nearer than the weld
// distance to it, becomes it; of several the first. Those that stay hang in a table by the cell of space that they are
// in: a cell is one point when only equal ones are welded, else as wide as the distance, so that 27 cells hold whatever
// is near.

#define NONE UINT32_MAX

static uint32_t table_size(int32_t vertices)
{
    uint32_t size = 64;
    while (size < (uint32_t)vertices) size *= 2;
    return size;
}

int64_t fe__mesh_weld_size(const fe__mesh_source *s)
{
    return (int64_t)sizeof(uint32_t) * ((int64_t)table_size(s->vertex_count) + s->vertex_count);
}

typedef struct cell {
    int64_t x, y, z;
} cell;

typedef struct table {
    const fe__mesh_source *source;
    uint32_t *heads, *next;
    uint32_t mask;
    double distance, per_cell;
} table;

static uint32_t slot_of(const table *t, cell c)
{
    uint64_t h = (uint64_t)c.x * 0x9e3779b97f4a7c15u;
    h = (h ^ h >> 32 ^ (uint64_t)c.y) * 0xbf58476d1ce4e5b9u;
    h = (h ^ h >> 32 ^ (uint64_t)c.z) * 0x94d049bb133111ebu;
    return (uint32_t)(h >> 32) & t->mask;
}

static int64_t bits_of(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static int64_t floor_of(double x)
{
    int64_t whole = (int64_t)x;
    return whole - ((double)whole > x);
}

static cell cell_of(const table *t, fe_vec3 v)
{
    if (t->per_cell == 0.0) return (cell){bits_of(v.x), bits_of(v.y), bits_of(v.z)};
    return (cell){floor_of((double)v.x * t->per_cell), floor_of((double)v.y * t->per_cell),
                  floor_of((double)v.z * t->per_cell)};
}

static int32_t is_one(const table *t, fe_vec3 a, fe_vec3 b)
{
    fe_dvec3 d = fe__dsub(fe__widen(a), fe__widen(b));
    return fe__ddot(d, d) <= t->distance * t->distance;
}

// The first vertex of a cell, before `best`, that is one with v
static uint32_t first_in(const table *t, cell c, fe_vec3 v, uint32_t best)
{
    for (uint32_t i = t->heads[slot_of(t, c)]; i != NONE; i = t->next[i])
        if (i < best && is_one(t, fe__mesh_source_vertex(t->source, i), v)) best = i;
    return best;
}

static uint32_t first_near(const table *t, cell c, fe_vec3 v)
{
    uint32_t best = first_in(t, c, v, NONE);
    if (t->per_cell == 0.0) return best;
    for (int64_t z = c.z - 1; z <= c.z + 1; ++z)
        for (int64_t y = c.y - 1; y <= c.y + 1; ++y)
            for (int64_t x = c.x - 1; x <= c.x + 1; ++x) best = first_in(t, (cell){x, y, z}, v, best);
    return best;
}

void fe__mesh_weld(fe__mesh_builder *b)
{
    const fe__mesh_source *s = b->source;
    uint32_t size = table_size(s->vertex_count);
    table t = {.source = s, .heads = b->scratch, .mask = size - 1, .distance = s->weld_distance};
    t.next = t.heads + size;
    t.per_cell = s->weld_distance > 0.0 ? 1.0 / s->weld_distance : 0.0;
    memset(t.heads, 0xff, size * sizeof *t.heads);
    for (uint32_t i = 0; i < (uint32_t)s->vertex_count; ++i) {
        fe_vec3 v = fe__mesh_source_vertex(s, i);
        cell c = cell_of(&t, v);
        b->weld[i] = first_near(&t, c, v);
        if (b->weld[i] != NONE) continue;
        b->weld[i] = i;
        b->mesh.welded_count += 1;
        uint32_t *head = t.heads + slot_of(&t, c);
        t.next[i] = *head;
        *head = i;
    }
}

// ---- numbers --------------------------------------------------------------------------------------------------------
// Shortcuts through the cycles of the triangles' numbers, see fe__mesh_slot.

static int32_t is_seen(const uint8_t *seen, int32_t i) { return seen[i >> 3] >> (i & 7) & 1; }

// From `start` around its cycle. Every FE__MESH_SHORTCUT-th element gets a shortcut to the one so many before it; the
// first one's leads to the last but one that has any.
static int32_t walk_cycle(uint32_t *numbers, int32_t start, uint8_t *seen, int32_t count, fe__mesh_shortcut *out)
{
    int32_t length = 0, at = start, last = start, first_count = count;
    do {
        seen[at >> 3] |= (uint8_t)(1 << (at & 7));
        if (length > 0 && length % FE__MESH_SHORTCUT == 0) {
            out[count] = (fe__mesh_shortcut){at, last};
            numbers[at] |= FE__MESH_HAS_SHORTCUT;
            last = at;
            count += 1;
        }
        at = (int32_t)(numbers[at] & ~FE__MESH_HAS_SHORTCUT);
        length += 1;
    } while (at != start);
    if (count == first_count) return count;
    out[count] = (fe__mesh_shortcut){start, last}; // over the end of the cycle
    numbers[start] |= FE__MESH_HAS_SHORTCUT;
    return count + 1;
}

static void sift(fe__mesh_shortcut *heap, int32_t at, int32_t count)
{
    fe__mesh_shortcut moved = heap[at];
    for (int32_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && heap[child].from < heap[child + 1].from) child += 1;
        if (heap[child].from <= moved.from) break;
        heap[at] = heap[child];
    }
    heap[at] = moved;
}

static void sort(fe__mesh_shortcut *shortcuts, int32_t count)
{
    for (int32_t i = count / 2; i-- > 0;) sift(shortcuts, i, count);
    for (int32_t end = count - 1; end > 0; --end) {
        fe__mesh_shortcut largest = shortcuts[0];
        shortcuts[0] = shortcuts[end], shortcuts[end] = largest;
        sift(shortcuts, 0, end);
    }
}

int32_t fe__mesh_shortcuts(uint32_t *numbers, int32_t count, uint8_t *seen, fe__mesh_shortcut *out)
{
    int32_t made = 0;
    memset(seen, 0, (size_t)count / 8 + 1);
    for (int32_t i = 0; i < count; ++i)
        if (!is_seen(seen, i)) made = walk_cycle(numbers, i, seen, made, out);
    sort(out, made);
    return made;
}

// ---- scale ----------------------------------------------------------------------------------------------------------
// A mesh under a scale: its bounds, its area, and whether each triangle keeps its height; see mesh_build.h.

static int32_t is_uniform(fe_vec3 s) { return fe__absf(s.x) == fe__absf(s.y) && fe__absf(s.y) == fe__absf(s.z); }

// The float next to a product of two floats, outwards: a double holds it exactly
static float below(double x) { return (float)x - 0x1p-23f * fe__absf((float)x); }
static float above(double x) { return (float)x + 0x1p-23f * fe__absf((float)x); }

static void scale_bounds(float scale, float *low, float *high)
{
    double a = (double)scale * (double)*low, b = (double)scale * (double)*high;
    *low = below(fe__mind(a, b)), *high = above(fe__maxd(a, b));
}

// Of the triangles that become too flat the one with the lowest number, -1: none does. A likeness of the mesh has none.
static int32_t measure_scaled(fe__mesh *m, fe_vec3 scale)
{
    double area = 0.0;
    int32_t flattest = -1;
    for (int32_t slot = 0; slot < m->triangle_count; ++slot) {
        fe_dvec3 v[3];
        fe__mesh_corners(m, slot, v);
        fe_dvec3 n = fe__dcross(fe__dsub(v[1], v[0]), fe__dsub(v[2], v[0]));
        area += 0.5 * sqrt(fe__ddot(n, n));
        int32_t number = fe__mesh_number(m, slot);
        if (!is_uniform(scale) && fe__mesh_is_flat(v) && (flattest < 0 || number < flattest)) flattest = number;
    }
    m->area = area;
    return flattest;
}

int32_t fe__mesh_scale(const fe__mesh *mesh, fe_vec3 scale, fe__mesh *out)
{
    *out = *mesh;
    out->scale[0] = (double)scale.x, out->scale[1] = (double)scale.y, out->scale[2] = (double)scale.z;
    out->is_mirrored = scale.x * scale.y * scale.z < 0.0f;
    out->is_scaled = 1;
    out->block = NULL, out->size = 0;
    scale_bounds(scale.x, &out->low.x, &out->high.x);
    scale_bounds(scale.y, &out->low.y, &out->high.y);
    scale_bounds(scale.z, &out->low.z, &out->high.z);
    return measure_scaled(out, scale);
}
