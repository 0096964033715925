// cooked_mesh.c - meshes as bytes, and the checks of each array that is read; see cooked.h.
#include "collision/cooked/cooked.h"
#include "collision/mesh_build/mesh_build.h"
#include "core/bytes.h"

enum { EDGES_END = FE__MESH_EDGES * FE__MESH_EDGES * FE__MESH_EDGES };
#define NOWHERE UINT32_MAX

// ---- writing -------------------------------------------------------------------------------------------------------
static int64_t array_bytes(const fe__mesh *m, int32_t has_data, int32_t has_materials)
{
    int64_t leaves = (int64_t)sizeof(fe__mesh_leaf) * fe__mesh_leaf_count(m->triangle_count);
    return 12 * (int64_t)m->vertex_count + leaves + 4 * (int64_t)m->given_count +
           (has_data ? 4 * (int64_t)m->triangle_count : 0) + m->triangle_count + m->node_count +
           (has_materials ? m->triangle_count : 0);
}

int64_t fe__cooked_mesh_size(const fe__mesh *m)
{
    return FE__COOKED_MESH_COUNTS + array_bytes(m, m->data != NULL, m->materials != NULL);
}

unsigned char *fe__cooked_mesh_write(const fe__mesh *m, unsigned char *out)
{
    const int32_t counts[] = {m->triangle_count,   m->given_count,    m->vertex_count,
                              m->node_count,       m->shortcut_count, m->welded_count,
                              m->degenerate_count, m->odd_count,      m->flipped_count};
    _Static_assert(sizeof counts == FE__COOKED_MESH_COUNTS, "as many as are read");
    for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i) out = fe__put_i32(out, counts[i]);
    for (int64_t i = 0; i < 3 * (int64_t)m->vertex_count; ++i) out = fe__put_float(out, m->vertices[i]);
    for (int32_t i = 0; i < fe__mesh_leaf_count(m->triangle_count); ++i) {
        out = fe__put_u32(out, m->leaves[i].first_vertex);
        out = fe__put_bytes(out, &m->leaves[i].corner[0][0], sizeof m->leaves[i].corner);
    }
    for (int32_t i = 0; i < m->given_count; ++i) out = fe__put_i32(out, fe__mesh_number(m, i));
    for (int32_t i = 0; m->data && i < m->triangle_count; ++i) out = fe__put_u32(out, m->data[i]);
    out = fe__put_bytes(out, m->edges, m->triangle_count);
    // The nodes are numbered so that the children of a node's children stand behind these: their order is kept.
    for (int32_t i = 0; i < m->node_count; ++i)
        *out++ = (unsigned char)(m->nodes[i].count | (m->nodes[i].first & FE__MESH_LEAVES ? FE__COOKED_BOTTOM : 0));
    return m->materials ? fe__put_bytes(out, m->materials, m->triangle_count) : out;
}

// ---- counts --------------------------------------------------------------------------------------------------------
// A node over leaves has at least one child, any other node at least two: there are fewer than twice as many nodes as
// leaves.
int32_t fe__cooked_mesh_counts(fe__cooked *c, fe__mesh *m)
{
    const unsigned char *start = c->at;
    if (!fe__cooked_int(c, "the number of triangles", 1, FE__MESH_TRIANGLES, &m->triangle_count) ||
        !fe__cooked_int(c, "the number of triangles given", 1, FE__MESH_TRIANGLES, &m->given_count) ||
        !fe__cooked_int(c, "the number of vertices", 3, 3 * FE__MESH_TRIANGLES, &m->vertex_count) ||
        !fe__cooked_int(c, "the number of nodes", 1, 2 * fe__mesh_leaf_count(m->triangle_count), &m->node_count) ||
        !fe__cooked_int(c, "the number of shortcuts", 0, m->given_count, &m->shortcut_count) ||
        !fe__cooked_int(c, "the number of places", 3, FE__MESH_VERTICES, &m->welded_count) ||
        !fe__cooked_int(c, "the number of triangles without height", 0, m->given_count, &m->degenerate_count) ||
        !fe__cooked_int(c, "the number of crowded edges", 0, m->triangle_count, &m->odd_count) ||
        !fe__cooked_int(c, "the number of flipped edges", 0, INT32_MAX, &m->flipped_count))
        return 0;
    int32_t dropped = m->given_count - m->triangle_count;
    if (dropped < m->degenerate_count)
        return fe__cooked_refuse(c, start, "%d of %d triangles are kept, but %d have no height", (int)m->triangle_count,
                                 (int)m->given_count, (int)m->degenerate_count);
    m->duplicate_count = dropped - m->degenerate_count;
    return 1;
}

int64_t fe__cooked_mesh_arrays(const fe__mesh *m, const fe__cooked_mesh *header)
{
    return array_bytes(m, header->has_data, header->material_count > 0);
}

// ---- memory --------------------------------------------------------------------------------------------------------
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

typedef struct mesh_reader {
    fe__cooked *cooked;
    const fe__cooked_mesh *header;
    fe__mesh *mesh;
    fe__mesh_arrays own; // the mesh's arrays, which may be written here
    uint32_t *slots;     // slot of each number
    uint8_t *seen;
    fe__mesh_shortcut *shortcuts;
    int32_t node_end, leaf_end; // numbers of the tree's nodes and leaves so far
    const unsigned char *tree;
} mesh_reader;

// ---- arrays --------------------------------------------------------------------------------------------------------
// A mesh has no -0, so that the bounds of a tree do not depend on how a machine compares it with 0.
static int32_t read_vertices(mesh_reader *reader)
{
    fe__cooked *c = reader->cooked;
    for (int64_t i = 0; i < 3 * (int64_t)reader->mesh->vertex_count; ++i) {
        const unsigned char *at = c->at;
        float x = reader->own.vertices[i] = fe__take_float(&c->at);
        if (x >= -FE_MAX_LENGTH && x <= FE_MAX_LENGTH && (fe__float_word){.value = x}.bits != 0x80000000u) continue;
        return fe__cooked_refuse(c, at, "vertex %lld has %.9g as its %c, must be %.9g..%.9g, and not -0",
                                 (long long)(i / 3), (double)x, "xyz"[i % 3], (double)-FE_MAX_LENGTH,
                                 (double)FE_MAX_LENGTH);
    }
    return 1;
}

static int32_t read_leaves(mesh_reader *reader)
{
    fe__cooked *c = reader->cooked;
    for (int32_t index = 0; index < fe__mesh_leaf_count(reader->mesh->triangle_count); ++index) {
        const unsigned char *at = c->at;
        fe__mesh_leaf *leaf = reader->own.leaves + index;
        leaf->first_vertex = fe__take_u32(&c->at);
        fe__take_bytes(&c->at, &leaf->corner[0][0], sizeof leaf->corner);
        int32_t count = fe__mini(reader->mesh->triangle_count - FE__MESH_LEAF * index, FE__MESH_LEAF);
        for (int32_t corner = 0; corner < 3 * FE__MESH_LEAF; ++corner) {
            int32_t i = corner / 3, k = corner % 3;
            int64_t vertex = (int64_t)leaf->first_vertex + leaf->corner[i][k];
            if (i < count ? vertex < reader->mesh->vertex_count : leaf->corner[i][k] == 0) continue;
            return fe__cooked_refuse(c, at, "corner %d of triangle %d of leaf %d is vertex %lld of %d", (int)k, (int)i,
                                     (int)index, (long long)vertex, (int)reader->mesh->vertex_count);
        }
    }
    return 1;
}

// The numbers must be a permutation: its cycles and their shortcuts rest on that.
static int32_t read_numbers(mesh_reader *reader)
{
    fe__cooked *c = reader->cooked;
    fe__mesh *m = reader->mesh;
    const unsigned char *start = c->at;
    memset(reader->slots, 0xff, 4 * (size_t)m->given_count);
    for (int32_t i = 0; i < m->given_count; ++i) {
        uint32_t number = reader->own.numbers[i] = fe__take_u32(&c->at);
        if (number >= (uint32_t)m->given_count)
            return fe__cooked_refuse(c, c->at - 4, "slot %d has triangle %lld of %d", (int)i, (long long)number,
                                     (int)m->given_count);
        if (reader->slots[number] != NOWHERE)
            return fe__cooked_refuse(c, c->at - 4, "slots %lld and %d both have triangle %lld",
                                     (long long)reader->slots[number], (int)i, (long long)number);
        reader->slots[number] = (uint32_t)i;
    }
    int32_t count = fe__mesh_shortcuts(reader->own.numbers, m->given_count, reader->seen, reader->shortcuts);
    if (count != m->shortcut_count)
        return fe__cooked_refuse(c, start, "the triangles' numbers need %d shortcuts, not %d", (int)count,
                                 (int)m->shortcut_count);
    if (count) memcpy(reader->own.shortcuts, reader->shortcuts, (size_t)count * sizeof *reader->shortcuts);
    return 1;
}

static int32_t read_edges(mesh_reader *reader)
{
    fe__cooked *c = reader->cooked;
    fe__mesh *m = reader->mesh;
    const unsigned char *start = c->at;
    int64_t open = 0, odd = 0;
    fe__take_bytes(&c->at, reader->own.edges, m->triangle_count);
    for (int32_t i = 0; i < m->triangle_count; ++i) {
        if (m->edges[i] >= EDGES_END)
            return fe__cooked_refuse(c, start + i, "triangle in slot %d has edges %d, must be below %d", (int)i,
                                     m->edges[i], EDGES_END);
        for (int32_t k = 0; k < 3; ++k) {
            fe__mesh_edge edge = fe__mesh_edge_of(m, i, k);
            open += edge == FE__MESH_EDGE_OPEN, odd += edge == FE__MESH_EDGE_ODD;
        }
    }
    // A crowded edge has three triangles or more, a flipped one has two.
    int64_t least = 3 * (int64_t)m->odd_count + 2 * (int64_t)m->flipped_count;
    if (least > odd || (least == 0) != (odd == 0))
        return fe__cooked_refuse(c, start, "%d crowded and %d flipped edges are not those of %lld sides",
                                 (int)m->odd_count, (int)m->flipped_count, (long long)odd);
    m->open_count = (int32_t)open;
    return 1;
}

static int32_t read_materials(mesh_reader *reader)
{
    fe__cooked *c = reader->cooked;
    const unsigned char *start = c->at;
    if (!reader->own.materials) return 1;
    fe__take_bytes(&c->at, reader->own.materials, reader->mesh->triangle_count);
    for (int32_t i = 0; i < reader->mesh->triangle_count; ++i) {
        if (reader->own.materials[i] < reader->header->material_count) continue;
        return fe__cooked_refuse(c, start + i, "triangle in slot %d has material %d of %d", (int)i,
                                 reader->own.materials[i], (int)reader->header->material_count);
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

// Children follow the nodes and leaves that were numbered so far: no link leads back, and all leaves are met in their
// order.
static int32_t number_children(mesh_reader *reader, int32_t index)
{
    const fe__mesh *m = reader->mesh;
    fe__mesh_node *node = reader->own.nodes + index;
    int32_t byte = reader->tree[index], is_bottom = byte & FE__COOKED_BOTTOM, count = byte & ~FE__COOKED_BOTTOM;
    int32_t *end = is_bottom ? &reader->leaf_end : &reader->node_end,
            most = is_bottom ? fe__mesh_leaf_count(m->triangle_count) : m->node_count;
    if (count < (is_bottom ? 1 : 2) || count > FE__MESH_WIDTH || count > most - *end)
        return fe__cooked_refuse(reader->cooked, reader->tree + index, "node %d has %d children of the %d %s left",
                                 (int)index, (int)count, (int)(most - *end), is_bottom ? "leaves" : "nodes");
    node->count = (uint8_t)count;
    node->first = (uint32_t)*end | (is_bottom ? FE__MESH_LEAVES : 0);
    *end += count;
    return 1;
}

static int32_t make_node(mesh_reader *reader, int32_t index, int32_t depth, fe__mesh_box *out)
{
    if (depth == FE__MESH_DEPTH)
        return fe__cooked_refuse(reader->cooked, reader->tree + index, "node %d is deeper than %d", (int)index,
                                 FE__MESH_DEPTH);
    if (!number_children(reader, index)) return 0;
    fe__mesh_node *node = reader->own.nodes + index;
    fe__mesh_box boxes[FE__MESH_WIDTH];
    int32_t is_bottom = (node->first & FE__MESH_LEAVES) != 0, first = (int32_t)(node->first & ~FE__MESH_LEAVES);
    reader->mesh->depth = fe__maxi(reader->mesh->depth, depth + 1);
    *out = empty_box();
    for (int32_t k = 0; k < node->count; ++k) {
        if (is_bottom)
            boxes[k] = leaf_box(reader->mesh, first + k);
        else if (!make_node(reader, first + k, depth + 1, boxes + k))
            return 0;
        swell(out, boxes[k].low, boxes[k].high);
    }
    fe__mesh_set_boxes(node, out, boxes);
    return 1;
}

static int32_t read_tree(mesh_reader *reader)
{
    fe__cooked *c = reader->cooked;
    fe__mesh *m = reader->mesh;
    fe__mesh_box all;
    reader->tree = c->at;
    c->at += m->node_count;
    reader->node_end = 1;
    if (!make_node(reader, 0, 0, &all)) return 0;
    if (reader->node_end != m->node_count || reader->leaf_end != fe__mesh_leaf_count(m->triangle_count))
        return fe__cooked_refuse(c, reader->tree, "the tree has %d nodes and %d leaves, must have %d and %d",
                                 (int)reader->node_end, (int)reader->leaf_end, (int)m->node_count,
                                 (int)fe__mesh_leaf_count(m->triangle_count));
    m->low = fe__vec3(all.low[0], all.low[1], all.low[2]);
    m->high = fe__vec3(all.high[0], all.high[1], all.high[2]);
    return 1;
}

// ---- triangles -----------------------------------------------------------------------------------------------------
static int32_t check_heights(mesh_reader *reader, const unsigned char *leaves)
{
    for (int32_t slot = 0; slot < reader->mesh->triangle_count; ++slot) {
        fe_dvec3 corner[3];
        fe__mesh_corners(reader->mesh, slot, corner);
        if (!fe__mesh_is_flat(corner)) continue;
        return fe__cooked_refuse(reader->cooked, leaves + sizeof(fe__mesh_leaf) * (size_t)(slot / FE__MESH_LEAF),
                                 "the triangle in slot %d has no height", (int)slot);
    }
    return 1;
}

// The sums run in the order of the definition's triangles, as the builder's do.
static void measure(mesh_reader *reader)
{
    const fe__mesh *m = reader->mesh;
    fe__mesh_measures sum = fe__mesh_measures_begin(m);
    for (int32_t i = 0; i < m->given_count; ++i) {
        if (reader->slots[i] >= (uint32_t)m->triangle_count) continue;
        fe_vec3 corner[3];
        for (int32_t k = 0; k < 3; ++k)
            memcpy(corner + k, fe__mesh_vertex(m, (int32_t)reader->slots[i], k), sizeof *corner);
        fe__mesh_measures_add(&sum, corner);
    }
    fe__mesh_measures_end(&sum, reader->mesh);
}

int32_t fe__cooked_mesh_read(fe__cooked *c, const fe__cooked_mesh *header, fe__mesh *m, void *block, void *scratch)
{
    m->is_two_sided = header->is_two_sided;
    fe__mesh_share(m, block, header->has_data, header->material_count > 0);
    mesh_reader reader = {.cooked = c, .header = header, .mesh = m, .own = fe__mesh_own_arrays(m), .slots = scratch};
    reader.seen = (uint8_t *)scratch + slots_size(m);
    reader.shortcuts = (fe__mesh_shortcut *)(void *)(reader.seen + fe__mesh_seen_size(m->given_count));
    if (!read_vertices(&reader)) return 0;
    const unsigned char *leaves = c->at;
    if (!read_leaves(&reader) || !read_numbers(&reader)) return 0;
    for (int32_t i = 0; reader.own.data && i < m->triangle_count; ++i) reader.own.data[i] = fe__take_u32(&c->at);
    if (!read_edges(&reader) || !read_tree(&reader) || !read_materials(&reader) || !check_heights(&reader, leaves))
        return 0;
    measure(&reader);
    return 1;
}
