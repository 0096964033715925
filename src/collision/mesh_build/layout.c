// layout.c - the block of a mesh, see build.h and form/mesh.h.
//
// Leaves are filled in their order. Their vertices go into a group until the next leaf would bring its 257th; then a
// new group begins. Neighbouring leaves are neighbours in space: half of the vertices are met in the same group again.
#include "collision/mesh_build/build.h"

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
