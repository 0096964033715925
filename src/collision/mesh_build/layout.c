// layout.c - the block of a mesh, see build.h and form/mesh.h.
//
// Leaves are filled in their order. Their vertices go into a group until the next leaf would bring its 257th; then a
// new group begins. Neighbouring leaves are neighbours in space: half of the vertices are met in the same group again.
#include "collision/mesh_build/build.h"

static int64_t padded(int64_t size) { return (size + 63) / 64 * 64; }

// ---- rooms ---------------------------------------------------------------------------------------------------------
enum { PLACE_BITS = 8, NO_GROUP = 0 }; // fe__mesh_builder.place: group << 8 | which vertex of it; groups from 1 on

static int64_t words(int64_t count) { return padded(count * (int64_t)sizeof(uint32_t)); }

static int64_t seen_size(const fe__mesh_source *s) { return padded(s->triangle_count / 8 + 1); }

// Two in a cycle of FE__MESH_SHORTCUT + 1, one more for each further FE__MESH_SHORTCUT
static int64_t shortcut_size(const fe__mesh_source *s)
{
    return padded((int64_t)sizeof(fe__mesh_shortcut) * (2 * (int64_t)s->triangle_count / (FE__MESH_SHORTCUT + 1) + 1));
}

int64_t fe__mesh_room_size(const fe__mesh_source *s)
{
    return padded(sizeof(fe__mesh_builder)) + 2 * words(s->vertex_count) + words(s->triangle_count) +
           padded((int64_t)sizeof(fe__mesh_node) * fe__mesh_node_room(s->triangle_count)) + padded(s->triangle_count) +
           seen_size(s) + shortcut_size(s);
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
    b->seen = take(&at, seen_size(s));
    b->shortcuts = take(&at, shortcut_size(s));
}

int64_t fe__mesh_scratch_size(const fe__mesh_source *s)
{
    return padded(fe__maxl(fe__mesh_weld_size(s), fe__maxl(fe__mesh_edges_size(s), fe__mesh_tree_size(s))));
}

// ---- measures ------------------------------------------------------------------------------------------------------
// Tetrahedra from the middle of the bounds; in the caller's order
static void measure(fe__mesh_builder *b)
{
    fe__mesh *m = &b->mesh;
    fe_dvec3 middle = fe__dscale(0.5, fe__dadd(fe__widen(m->low), fe__widen(m->high)));
    double area = 0.0, volume = 0.0;
    for (int32_t i = 0; i < b->source->triangle_count; ++i) {
        if (b->edges[i] == FE__MESH_DROPPED) continue;
        fe_vec3 corner[3];
        fe_dvec3 v[3];
        fe__mesh_welded_corners(b, i, corner);
        for (int32_t k = 0; k < 3; ++k) v[k] = fe__dsub(fe__widen(corner[k]), middle);
        fe_dvec3 n = fe__dcross(fe__dsub(v[1], v[0]), fe__dsub(v[2], v[0]));
        area += 0.5 * sqrt(fe__ddot(n, n));
        volume += fe__ddot(v[0], n) / 6.0;
    }
    m->area = area;
    m->volume = m->open_count + m->odd_count + m->flipped_count == 0 ? volume : 0.0;
}

int32_t fe__mesh_build(fe__mesh_builder *b, void *scratch, const fe__mesh_source *source)
{
    share_room(b, source);
    b->source = source;
    b->scratch = scratch;
    b->refusal.triangle = -1;
    b->mesh.given_count = source->triangle_count;
    b->mesh.is_two_sided = source->is_two_sided;
    b->mesh.scale[0] = b->mesh.scale[1] = b->mesh.scale[2] = 1.0;
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

// Vertices that a leaf would bring to the group
static uint32_t count_new(const grouping *g, int32_t leaf, int32_t end)
{
    const fe__mesh_builder *b = g->builder;
    uint32_t seen[3 * FE__MESH_LEAF], count = 0;
    for (int32_t slot = FE__MESH_LEAF * leaf; slot < end; ++slot) {
        for (int32_t k = 0; k < 3; ++k) {
            uint32_t vertex = fe__mesh_welded(b, slot_number(b, slot), k), i = 0;
            if (b->place[vertex] >> PLACE_BITS == g->group) continue;
            while (i < count && seen[i] != vertex) ++i;
            if (i == count) seen[count++] = vertex;
        }
    }
    return count;
}

// Groups fit in what PLACE_BITS leave: each but the last has more than FE__MESH_GROUP - 12 vertices, of 3 x 2^27 at
// most
static void add_leaf(grouping *g, int32_t leaf, float *vertices, fe__mesh_leaf *out)
{
    fe__mesh_builder *b = g->builder;
    int32_t end = fe__mini(FE__MESH_LEAF * leaf + FE__MESH_LEAF, b->mesh.triangle_count);
    if (g->count + count_new(g, leaf, end) > FE__MESH_GROUP) {
        g->first += g->count;
        g->group += 1;
        g->count = 0;
    }
    if (out) out->first_vertex = g->first;
    for (int32_t slot = FE__MESH_LEAF * leaf; slot < end; ++slot) {
        for (int32_t k = 0; k < 3; ++k) {
            uint32_t vertex = fe__mesh_welded(b, slot_number(b, slot), k), *place = b->place + vertex;
            if (*place >> PLACE_BITS != g->group) {
                fe_vec3 v = fe__mesh_source_vertex(b->source, vertex);
                if (vertices) memcpy(vertices + 3 * ((size_t)g->first + g->count), &v, sizeof v);
                *place = g->group << PLACE_BITS | g->count++;
            }
            if (out) out->corner[slot % FE__MESH_LEAF][k] = (uint8_t)(*place & (FE__MESH_GROUP - 1));
        }
    }
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
    int64_t vertices, leaves, nodes, numbers, shortcuts, data, edges, materials, size;
} places;

static int64_t put(int64_t *size, int64_t bytes)
{
    int64_t at = *size;
    *size += (bytes + 15) / 16 * 16;
    return at;
}

static places find_places(const fe__mesh_builder *b)
{
    const fe__mesh *m = &b->mesh;
    int64_t count = m->triangle_count;
    places p = {0};
    // the last vertex and the last node may be read 16 bytes wide
    p.vertices = put(&p.size, 12 * (int64_t)m->vertex_count + 4);
    p.leaves = put(&p.size, (int64_t)sizeof(fe__mesh_leaf) * fe__mesh_leaf_count(m->triangle_count));
    p.nodes = put(&p.size, (int64_t)sizeof(fe__mesh_node) * m->node_count);
    p.numbers = put(&p.size, 4 * (int64_t)m->given_count);
    p.shortcuts = put(&p.size, (int64_t)sizeof(fe__mesh_shortcut) * m->shortcut_count);
    p.data = put(&p.size, b->source->data ? 4 * count : 0);
    p.edges = put(&p.size, count);
    p.materials = put(&p.size, b->source->materials ? count : 0);
    return p;
}

int64_t fe__mesh_block_size(fe__mesh_builder *b)
{
    b->mesh.vertex_count = make_groups(b, NULL, NULL);
    b->mesh.shortcut_count = fe__mesh_shortcuts(b->order, b->mesh.given_count, b->seen, b->shortcuts);
    return find_places(b).size;
}

static void fill_slots(const fe__mesh_builder *b, uint8_t *edges, uint32_t *data, uint8_t *materials)
{
    for (int32_t slot = 0; slot < b->mesh.triangle_count; ++slot) {
        int32_t number = slot_number(b, slot);
        edges[slot] = b->edges[number];
        if (data) data[slot] = b->source->data[number];
        if (materials) materials[slot] = b->source->materials[number];
    }
}

void fe__mesh_write(fe__mesh_builder *b, void *block, fe__mesh *out)
{
    unsigned char *start = block;
    places p = find_places(b);
    fe__mesh *m = &b->mesh;
    float *vertices = (float *)(void *)(start + p.vertices);
    fe__mesh_leaf *leaves = (fe__mesh_leaf *)(void *)(start + p.leaves);
    fe__mesh_shortcut *shortcuts = (fe__mesh_shortcut *)(void *)(start + p.shortcuts);
    uint32_t *data = b->source->data ? (uint32_t *)(void *)(start + p.data) : NULL;
    uint8_t *materials = b->source->materials ? start + p.materials : NULL;

    make_groups(b, vertices, leaves);
    memcpy(start + p.nodes, b->nodes, (size_t)m->node_count * sizeof *b->nodes);
    if (m->shortcut_count) memcpy(shortcuts, b->shortcuts, (size_t)m->shortcut_count * sizeof *shortcuts);
    memcpy(start + p.numbers, b->order, (size_t)m->given_count * sizeof *b->order);
    fill_slots(b, start + p.edges, data, materials);

    *out = *m;
    out->vertices = vertices;
    out->leaves = leaves;
    out->nodes = (const fe__mesh_node *)(const void *)(start + p.nodes);
    out->numbers = (const uint32_t *)(const void *)(start + p.numbers);
    out->shortcuts = shortcuts;
    out->data = data;
    out->edges = start + p.edges;
    out->materials = materials;
    out->block = block;
    out->size = p.size;
}
