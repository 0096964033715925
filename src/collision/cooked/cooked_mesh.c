// cooked_mesh.c - meshes as bytes; see cooked.h.
#include "collision/cooked/cooked.h"
#include "collision/mesh_build/mesh_build.h"
#include "core/bytes.h"

enum { EDGES_END = FE__MESH_EDGES * FE__MESH_EDGES * FE__MESH_EDGES };
#define NOWHERE UINT32_MAX

// ---- writing -------------------------------------------------------------------------------------------------------
static int64_t leaf_bytes(const fe__mesh *m)
{
    return (int64_t)sizeof(fe__mesh_leaf) * fe__mesh_leaf_count(m->triangle_count);
}

static int64_t array_bytes(const fe__mesh *m, int32_t has_data, int32_t has_materials)
{
    return 12 * (int64_t)m->vertex_count + leaf_bytes(m) + 4 * (int64_t)m->given_count +
           (has_data ? 4 * (int64_t)m->triangle_count : 0) + m->triangle_count + m->node_count +
           (has_materials ? m->triangle_count : 0);
}

int64_t fe__cooked_mesh_size(const fe__mesh *m)
{
    return FE__COOKED_MESH_COUNTS + array_bytes(m, m->data != NULL, m->materials != NULL);
}

static unsigned char *write_leaf(const fe__mesh_leaf *leaf, unsigned char *out)
{
    return fe__put_bytes(fe__put_u32(out, leaf->first_vertex), &leaf->corner[0][0], sizeof leaf->corner);
}

// Behind a node's children stand theirs: as they were numbered, so in the order of their indices
static unsigned char *write_tree(const fe__mesh *m, unsigned char *out)
{
    for (int32_t i = 0; i < m->node_count; ++i)
        *out++ = (unsigned char)(m->nodes[i].count | (m->nodes[i].first & FE__MESH_LEAVES ? FE__COOKED_BOTTOM : 0));
    return out;
}

unsigned char *fe__cooked_mesh_write(const fe__mesh *m, unsigned char *out)
{
    const int32_t counts[] = {m->triangle_count,   m->given_count,    m->vertex_count,
                              m->node_count,       m->shortcut_count, m->welded_count,
                              m->degenerate_count, m->odd_count,      m->flipped_count};
    _Static_assert(sizeof counts == FE__COOKED_MESH_COUNTS, "as many as are read");
    for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i) out = fe__put_i32(out, counts[i]);
    for (int64_t i = 0; i < 3 * (int64_t)m->vertex_count; ++i) out = fe__put_float(out, m->vertices[i]);
    for (int32_t i = 0; i < fe__mesh_leaf_count(m->triangle_count); ++i) out = write_leaf(m->leaves + i, out);
    for (int32_t i = 0; i < m->given_count; ++i) out = fe__put_i32(out, fe__mesh_number(m, i));
    for (int32_t i = 0; m->data && i < m->triangle_count; ++i) out = fe__put_u32(out, m->data[i]);
    out = write_tree(m, fe__put_bytes(out, m->edges, m->triangle_count));
    return m->materials ? fe__put_bytes(out, m->materials, m->triangle_count) : out;
}

// ---- counts --------------------------------------------------------------------------------------------------------
static int32_t check_counts(fe__cooked *c, const unsigned char *start, fe__mesh *m)
{
    int32_t dropped = m->given_count - m->triangle_count;
    if (dropped < m->degenerate_count)
        return fe__cooked_refuse(c, start, "%d of %d triangles are kept, but %d have no height", (int)m->triangle_count,
                                 (int)m->given_count, (int)m->degenerate_count);
    m->duplicate_count = dropped - m->degenerate_count;
    return 1;
}

// Nodes over leaves have one at least, all others two children: fewer than twice as many as leaves
int32_t fe__cooked_mesh_counts(fe__cooked *c, fe__mesh *m)
{
    const unsigned char *start = c->at;
    return fe__cooked_int(c, "the number of triangles", 1, FE__MESH_TRIANGLES, &m->triangle_count) &&
           fe__cooked_int(c, "the number of triangles given", 1, FE__MESH_TRIANGLES, &m->given_count) &&
           fe__cooked_int(c, "the number of vertices", 3, 3 * FE__MESH_TRIANGLES, &m->vertex_count) &&
           fe__cooked_int(c, "the number of nodes", 1, 2 * fe__mesh_leaf_count(m->triangle_count), &m->node_count) &&
           fe__cooked_int(c, "the number of shortcuts", 0, m->given_count, &m->shortcut_count) &&
           fe__cooked_int(c, "the number of places", 3, FE__MESH_VERTICES, &m->welded_count) &&
           fe__cooked_int(c, "the number of triangles without height", 0, m->given_count, &m->degenerate_count) &&
           fe__cooked_int(c, "the number of crowded edges", 0, m->triangle_count, &m->odd_count) &&
           fe__cooked_int(c, "the number of flipped edges", 0, INT32_MAX, &m->flipped_count) &&
           check_counts(c, start, m);
}

int64_t fe__cooked_mesh_arrays(const fe__mesh *m, const fe__cooked_mesh *header)
{
    return array_bytes(m, header->has_data, header->material_count > 0);
}

// ---- room ----------------------------------------------------------------------------------------------------------
int64_t fe__cooked_mesh_block(const fe__mesh *m, const fe__cooked_mesh *header)
{
    fe__mesh counted = *m;
    return fe__mesh_share(&counted, NULL, header->has_data, header->material_count > 0);
}

static int64_t slots_size(const fe__mesh *m) { return (4 * (int64_t)m->given_count + 63) / 64 * 64; }

int64_t fe__cooked_mesh_scratch(const fe__mesh *m)
{
    return slots_size(m) + fe__mesh_seen_size(m->given_count) + fe__mesh_shortcuts_size(m->given_count);
}

typedef struct making {
    fe__cooked *cooked;
    const fe__cooked_mesh *header;
    fe__mesh *mesh;
    fe__mesh_arrays own;
    uint32_t *slots; // of each number
    uint8_t *seen;
    fe__mesh_shortcut *shortcuts;
    int32_t node_end, leaf_end; // of the tree, so far
    const unsigned char *tree;
} making;

static making share_room(fe__cooked *c, const fe__cooked_mesh *header, fe__mesh *m, void *scratch)
{
    unsigned char *room = scratch;
    making g = {.cooked = c, .header = header, .mesh = m, .own = fe__mesh_own_arrays(m), .slots = scratch};
    g.seen = room + slots_size(m);
    g.shortcuts = (fe__mesh_shortcut *)(void *)(g.seen + fe__mesh_seen_size(m->given_count));
    return g;
}

// ---- arrays --------------------------------------------------------------------------------------------------------
// -0 is 0 in a mesh: the bounds of a tree do not depend on how a machine compares the two
static int32_t read_vertices(making *g)
{
    fe__cooked *c = g->cooked;
    for (int64_t i = 0; i < 3 * (int64_t)g->mesh->vertex_count; ++i) {
        const unsigned char *at = c->at;
        float x = g->own.vertices[i] = fe__take_float(&c->at);
        if (x >= -FE_MAX_LENGTH && x <= FE_MAX_LENGTH && (fe__float_word){.value = x}.bits != 0x80000000u) continue;
        return fe__cooked_refuse(c, at, "vertex %lld has %.9g as its %c, must be %.9g..%.9g, and not -0",
                                 (long long)(i / 3), (double)x, "xyz"[i % 3], (double)-FE_MAX_LENGTH,
                                 (double)FE_MAX_LENGTH);
    }
    return 1;
}

static int32_t read_leaf(making *g, int32_t index)
{
    fe__cooked *c = g->cooked;
    const unsigned char *at = c->at;
    fe__mesh_leaf *leaf = g->own.leaves + index;
    leaf->first_vertex = fe__take_u32(&c->at);
    fe__take_bytes(&c->at, &leaf->corner[0][0], sizeof leaf->corner);
    int32_t count = fe__mini(g->mesh->triangle_count - FE__MESH_LEAF * index, FE__MESH_LEAF);
    for (int32_t i = 0; i < FE__MESH_LEAF; ++i) {
        for (int32_t k = 0; k < 3; ++k) {
            int64_t vertex = (int64_t)leaf->first_vertex + leaf->corner[i][k];
            if (i < count ? vertex < g->mesh->vertex_count : leaf->corner[i][k] == 0) continue;
            return fe__cooked_refuse(c, at, "corner %d of triangle %d of leaf %d is vertex %lld of %d", (int)k, (int)i,
                                     (int)index, (long long)vertex, (int)g->mesh->vertex_count);
        }
    }
    return 1;
}

static int32_t read_leaves(making *g)
{
    for (int32_t i = 0; i < fe__mesh_leaf_count(g->mesh->triangle_count); ++i)
        if (!read_leaf(g, i)) return 0;
    return 1;
}

// A permutation, which cycles and their shortcuts rest on
static int32_t read_numbers(making *g)
{
    fe__cooked *c = g->cooked;
    fe__mesh *m = g->mesh;
    const unsigned char *start = c->at;
    memset(g->slots, 0xff, 4 * (size_t)m->given_count);
    for (int32_t i = 0; i < m->given_count; ++i) {
        uint32_t number = g->own.numbers[i] = fe__take_u32(&c->at);
        if (number >= (uint32_t)m->given_count)
            return fe__cooked_refuse(c, c->at - 4, "slot %d has triangle %lld of %d", (int)i, (long long)number,
                                     (int)m->given_count);
        if (g->slots[number] != NOWHERE)
            return fe__cooked_refuse(c, c->at - 4, "slots %lld and %d both have triangle %lld",
                                     (long long)g->slots[number], (int)i, (long long)number);
        g->slots[number] = (uint32_t)i;
    }
    int32_t count = fe__mesh_shortcuts(g->own.numbers, m->given_count, g->seen, g->shortcuts);
    if (count != m->shortcut_count)
        return fe__cooked_refuse(c, start, "the triangles' numbers need %d shortcuts, not %d", (int)count,
                                 (int)m->shortcut_count);
    if (count) memcpy(g->own.shortcuts, g->shortcuts, (size_t)count * sizeof *g->shortcuts);
    return 1;
}

static void read_data(making *g)
{
    for (int32_t i = 0; g->own.data && i < g->mesh->triangle_count; ++i) g->own.data[i] = fe__take_u32(&g->cooked->at);
}

static int32_t read_edges(making *g)
{
    fe__cooked *c = g->cooked;
    fe__mesh *m = g->mesh;
    const unsigned char *start = c->at;
    int64_t open = 0, odd = 0;
    fe__take_bytes(&c->at, g->own.edges, m->triangle_count);
    for (int32_t i = 0; i < m->triangle_count; ++i) {
        if (m->edges[i] >= EDGES_END)
            return fe__cooked_refuse(c, start + i, "triangle in slot %d has edges %d, must be below %d", (int)i,
                                     m->edges[i], EDGES_END);
        for (int32_t k = 0; k < 3; ++k) {
            fe__mesh_edge edge = fe__mesh_edge_of(m, i, k);
            open += edge == FE__MESH_EDGE_OPEN, odd += edge == FE__MESH_EDGE_ODD;
        }
    }
    // a crowded edge has three triangles or more, a flipped one has two
    int64_t least = 3 * (int64_t)m->odd_count + 2 * (int64_t)m->flipped_count;
    if (least > odd || (least == 0) != (odd == 0))
        return fe__cooked_refuse(c, start, "%d crowded and %d flipped edges are not those of %lld sides",
                                 (int)m->odd_count, (int)m->flipped_count, (long long)odd);
    m->open_count = (int32_t)open;
    return 1;
}

static int32_t read_materials(making *g)
{
    fe__cooked *c = g->cooked;
    const unsigned char *start = c->at;
    if (!g->own.materials) return 1;
    fe__take_bytes(&c->at, g->own.materials, g->mesh->triangle_count);
    for (int32_t i = 0; i < g->mesh->triangle_count; ++i) {
        if (g->own.materials[i] < g->header->material_count) continue;
        return fe__cooked_refuse(c, start + i, "triangle in slot %d has material %d of %d", (int)i, g->own.materials[i],
                                 (int)g->header->material_count);
    }
    return 1;
}

// ---- the tree ------------------------------------------------------------------------------------------------------
static fe__mesh_box empty_box(void)
{
    return (fe__mesh_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static void swell(fe__mesh_box *box, const float low[3], const float high[3])
{
    for (int32_t k = 0; k < 3; ++k)
        box->low[k] = fe__minf(box->low[k], low[k]), box->high[k] = fe__maxf(box->high[k], high[k]);
}

static fe__mesh_box leaf_box(const fe__mesh *m, int32_t leaf)
{
    fe__mesh_box box = empty_box();
    int32_t end = fe__mini(FE__MESH_LEAF * leaf + FE__MESH_LEAF, m->triangle_count);
    for (int32_t slot = FE__MESH_LEAF * leaf; slot < end; ++slot)
        for (int32_t k = 0; k < 3; ++k) swell(&box, fe__mesh_vertex(m, slot, k), fe__mesh_vertex(m, slot, k));
    return box;
}

// Children follow what was numbered so far: no link leads back, and all leaves are met in their order.
static int32_t number_children(making *g, int32_t index)
{
    const fe__mesh *m = g->mesh;
    fe__mesh_node *node = g->own.nodes + index;
    int32_t byte = g->tree[index], is_bottom = byte & FE__COOKED_BOTTOM, count = byte & ~FE__COOKED_BOTTOM;
    int32_t *end = is_bottom ? &g->leaf_end : &g->node_end,
            most = is_bottom ? fe__mesh_leaf_count(m->triangle_count) : m->node_count;
    if (count < (is_bottom ? 1 : 2) || count > FE__MESH_WIDTH || count > most - *end)
        return fe__cooked_refuse(g->cooked, g->tree + index, "node %d has %d children of the %d %s left", (int)index,
                                 (int)count, (int)(most - *end), is_bottom ? "leaves" : "nodes");
    node->count = (uint8_t)count;
    node->first = (uint32_t)*end | (is_bottom ? FE__MESH_LEAVES : 0);
    *end += count;
    return 1;
}

static int32_t make_node(making *g, int32_t index, int32_t depth, fe__mesh_box *out)
{
    if (depth == FE__MESH_DEPTH)
        return fe__cooked_refuse(g->cooked, g->tree + index, "node %d is deeper than %d", (int)index, FE__MESH_DEPTH);
    if (!number_children(g, index)) return 0;
    fe__mesh_node *node = g->own.nodes + index;
    fe__mesh_box boxes[FE__MESH_WIDTH];
    int32_t is_bottom = (node->first & FE__MESH_LEAVES) != 0, first = (int32_t)(node->first & ~FE__MESH_LEAVES);
    g->mesh->depth = fe__maxi(g->mesh->depth, depth + 1);
    *out = empty_box();
    for (int32_t k = 0; k < node->count; ++k) {
        if (is_bottom)
            boxes[k] = leaf_box(g->mesh, first + k);
        else if (!make_node(g, first + k, depth + 1, boxes + k))
            return 0;
        swell(out, boxes[k].low, boxes[k].high);
    }
    fe__mesh_set_boxes(node, out, boxes);
    return 1;
}

static int32_t read_tree(making *g)
{
    fe__cooked *c = g->cooked;
    fe__mesh *m = g->mesh;
    fe__mesh_box all;
    g->tree = c->at;
    c->at += m->node_count;
    g->node_end = 1;
    if (!make_node(g, 0, 0, &all)) return 0;
    if (g->node_end != m->node_count || g->leaf_end != fe__mesh_leaf_count(m->triangle_count))
        return fe__cooked_refuse(c, g->tree, "the tree has %d nodes and %d leaves, must have %d and %d",
                                 (int)g->node_end, (int)g->leaf_end, (int)m->node_count,
                                 (int)fe__mesh_leaf_count(m->triangle_count));
    m->low = fe__vec3(all.low[0], all.low[1], all.low[2]);
    m->high = fe__vec3(all.high[0], all.high[1], all.high[2]);
    return 1;
}

// ---- triangles -----------------------------------------------------------------------------------------------------
static int32_t check_heights(making *g, const unsigned char *leaves)
{
    for (int32_t slot = 0; slot < g->mesh->triangle_count; ++slot) {
        fe_dvec3 corner[3];
        fe__mesh_corners(g->mesh, slot, corner);
        if (!fe__mesh_is_flat(corner)) continue;
        return fe__cooked_refuse(g->cooked, leaves + sizeof(fe__mesh_leaf) * (size_t)(slot / FE__MESH_LEAF),
                                 "the triangle in slot %d has no height", (int)slot);
    }
    return 1;
}

static void measure(making *g)
{
    const fe__mesh *m = g->mesh;
    fe__mesh_measures sum = fe__mesh_measures_begin(m);
    for (int32_t i = 0; i < m->given_count; ++i) {
        if (g->slots[i] >= (uint32_t)m->triangle_count) continue;
        fe_vec3 corner[3];
        for (int32_t k = 0; k < 3; ++k) memcpy(corner + k, fe__mesh_vertex(m, (int32_t)g->slots[i], k), sizeof *corner);
        fe__mesh_measures_add(&sum, corner);
    }
    fe__mesh_measures_end(&sum, g->mesh);
}

int32_t fe__cooked_mesh_read(fe__cooked *c, const fe__cooked_mesh *header, fe__mesh *m, void *block, void *scratch)
{
    m->is_two_sided = header->is_two_sided;
    fe__mesh_share(m, block, header->has_data, header->material_count > 0);
    making g = share_room(c, header, m, scratch);
    if (!read_vertices(&g)) return 0;
    const unsigned char *leaves = c->at;
    if (!read_leaves(&g) || !read_numbers(&g)) return 0;
    read_data(&g);
    if (!read_edges(&g) || !read_tree(&g) || !read_materials(&g) || !check_heights(&g, leaves)) return 0;
    measure(&g);
    return 1;
}
