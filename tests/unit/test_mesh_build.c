// The builder of meshes: welding, what is dropped, edges, the tree's invariants, numbers, and the API of the asset.
#include "core/memory.h"
#include "core/bytes.h"
#include "fe_test.h"
#include "support/mesh_make.h"
#include "support/values.h"

static made_mesh mesh_of_soup(void)
{
    made_mesh m;
    FE_TRUE(make_mesh(&made, &m));
    return m;
}

// ---- the tree ------------------------------------------------------------------------------------------------------
typedef struct walk {
    const fe__mesh *mesh;
    int32_t leaves, nodes, depth;
    uint8_t *is_seen; // leaves
} walk;

static void check_inside(const fe__mesh *m, int32_t leaf, const double low[3], const double high[3])
{
    for (int32_t slot = 4 * leaf; slot < 4 * leaf + 4 && slot < m->triangle_count; ++slot) {
        for (int32_t k = 0; k < 9; ++k) {
            double x = (double)fe__mesh_vertex(m, slot, k / 3)[k % 3];
            FE_WITHIN(x, low[k % 3], high[k % 3]);
        }
    }
}

// Every vertex below is inside of every box above: each is compared with the boxes on its way, met in one number
static void check_node(walk *w, uint32_t index, const double low[3], const double high[3], int32_t depth)
{
    const fe__mesh_node *node = w->mesh->nodes + index;
    FE_TRUE(index < (uint32_t)w->mesh->node_count);
    w->nodes += 1;
    w->depth = depth > w->depth ? depth : w->depth;
    FE_WITHIN(node->count, 1, FE__MESH_WIDTH);
    for (uint32_t lane = 0; lane < node->count; ++lane) {
        double l[3], h[3];
        for (int32_t k = 0; k < 3; ++k) {
            double origin = (double)node->origin[k], step = fe__mesh_step(node, k);
            l[k] = fe__maxd(low[k], origin + node->low[k][lane] * step);
            h[k] = fe__mind(high[k], origin + node->high[k][lane] * step);
        }
        uint32_t child = node->first + lane;
        if (!(child & FE__MESH_LEAVES)) {
            FE_TRUE(child > index); // no cycles
            check_node(w, child, l, h, depth + 1);
            continue;
        }
        int32_t leaf = (int32_t)(child & ~FE__MESH_LEAVES);
        FE_TRUE(leaf < fe__mesh_leaf_count(w->mesh->triangle_count) && !w->is_seen[leaf]);
        w->is_seen[leaf] = 1;
        w->leaves += 1;
        check_inside(w->mesh, leaf, l, h);
    }
}

static void check_tree(const fe__mesh *m)
{
    const double far = 1e9, low[3] = {-far, -far, -far}, high[3] = {far, far, far};
    int32_t leaves = fe__mesh_leaf_count(m->triangle_count);
    walk w = {.mesh = m, .is_seen = calloc((size_t)leaves, 1)};
    check_node(&w, 0, low, high, 1);
    assert_int_equal(w.leaves, leaves);
    assert_int_equal(w.nodes, m->node_count);
    assert_int_equal(w.depth, m->depth);
    FE_WITHIN(m->depth, 1, FE__MESH_DEPTH);
    free(w.is_seen);
}

// Numbers are a permutation, its inverse finds each, and a slot holds the caller's corners in the caller's order
static void check_numbers(const fe__mesh *m, const soup *s)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < s->triangle_count; ++i) {
        int32_t slot = fe__mesh_slot(m, i);
        FE_WITHIN(slot, 0, m->given_count - 1);
        assert_int_equal(fe__mesh_number(m, slot), i);
        if (slot >= m->triangle_count) continue;
        kept += 1;
        for (int32_t k = 0; k < 3; ++k)
            for (int32_t axis = 0; axis < 3; ++axis)
                FE_NEAR(fe__mesh_vertex(m, slot, k)[axis], s->vertices[s->triangles[i][k]][axis], 0.0);
    }
    assert_int_equal(kept, m->triangle_count);
}

static void check_whole(const fe__mesh *m)
{
    check_tree(m);
    check_numbers(m, &made);
}

static void trees_hold_all_triangles(void **state)
{
    (void)state;
    for (int32_t count = 1; count <= 200; ++count) {
        free_soup(&made);
        soup_scatter(&made, count, 0.3, &dice);
        made_mesh m = mesh_of_soup();
        assert_int_equal(m.mesh.triangle_count, count);
        check_whole(&m.mesh);
        free_mesh(&m);
    }
}

static void trees_of_awkward_triangles(void **state)
{
    (void)state;
    // all centres in one place; sizes over many powers of two; far away; slivers of 1:1000; a fan of many
    for (int32_t kind = 0; kind < 5; ++kind) {
        free_soup(&made);
        double size = 1.0;
        for (int32_t i = 0; i < 1000; ++i) {
            double away = kind == 2 ? 9e4 : 0.0, r[3];
            for (int32_t k = 0; k < 3; ++k) r[k] = soup_random(&dice);
            if (kind == 1) size = i % 20 == 0 ? 1e3 : size * 0.7;
            uint32_t a = soup_vertex(&made, away + size * r[0], size * r[1], size * r[2]);
            uint32_t b = soup_vertex(&made, away - size * r[1], size * (kind == 3 ? 1.0 : -0.5) * r[0], size * r[2]);
            uint32_t c = kind == 0   ? soup_vertex(&made, -r[0] + r[1], -r[1] + 0.5 * r[0], -2.0 * r[2])
                         : kind == 3 ? soup_vertex(&made, r[0] + 1e-3, r[1], r[2])
                                     : soup_vertex(&made, away + 0.1 * size, size * r[2], size * r[0]);
            if (kind == 4) a = 0;
            soup_triangle(&made, a, b, c);
        }
        made_mesh m = mesh_of_soup();
        FE_TRUE(m.mesh.triangle_count >= 900);
        check_whole(&m.mesh);
        free_mesh(&m);
    }
}

// Sizes in a geometric row: the surface area heuristic alone would peel one after the other
static void a_row_that_shrinks_makes_no_deep_tree(void **state)
{
    (void)state;
    double at = 0.0, size = 5e4;
    for (int32_t i = 0; i < 4000; ++i) {
        uint32_t a = soup_vertex(&made, at, 0, 0), b = soup_vertex(&made, at + size, 0, 0),
                 c = soup_vertex(&made, at, 0, size);
        soup_triangle(&made, a, b, c);
        at += size, size *= size > 1e-1 ? 0.7 : 1.0;
    }
    made_mesh m = mesh_of_soup();
    check_tree(&m.mesh);
    free_mesh(&m);
}

// 20 bytes a triangle of a welded closed mesh; 50 while it is built, of a mesh with half as many vertices
static void a_closed_mesh_is_small(void **state)
{
    (void)state;
    soup_ball(&made, 6);
    made_mesh m = mesh_of_soup();
    check_whole(&m.mesh);
    FE_WITHIN((double)m.mesh.size / m.mesh.triangle_count, 0.0, 20.0);
    free_mesh(&m);
    free_soup(&made);
    soup_terrain(&made, 200, 1.0, 0.3, &dice);
    m = mesh_of_soup();
    FE_WITHIN((double)m.mesh.size / m.mesh.triangle_count, 0.0, 20.0);
    FE_WITHIN((double)(m.room + m.scratch) / m.mesh.triangle_count, 0.0, 50.0);
    FE_WITHIN((double)(m.room + m.mesh.size) / m.mesh.triangle_count, 0.0, 50.0);
    free_mesh(&m);
}

// ---- welding and dropping ------------------------------------------------------------------------------------------
static void equal_vertices_are_one(void **state)
{
    (void)state;
    soup_ball(&made, 3); // whose middles are made for each triangle
    made_mesh m = mesh_of_soup();
    assert_int_equal(m.mesh.triangle_count, 512);
    assert_int_equal(m.mesh.welded_count, 512 / 2 + 2); // Euler: V = T / 2 + 2
    assert_int_equal(m.mesh.open_count + m.mesh.odd_count + m.mesh.flipped_count, 0);
    // an inscribed polyhedron: smaller than the ball by the order of (edge / 2)^2 = 2 %, edge 0.2
    FE_WITHIN(m.mesh.volume, 4.18879 * 0.94, 4.18879);
    FE_WITHIN(m.mesh.area, 12.56637 * 0.96, 12.56637);
    free_mesh(&m);
}

static void zeros_of_both_signs_are_one(void **state)
{
    (void)state;
    uint32_t a = soup_vertex(&made, 0.0, 0, 0), b = soup_vertex(&made, 1, 0, 0), c = soup_vertex(&made, 0, 1, 0),
             d = soup_vertex(&made, -0.0, -0.0, -0.0), e = soup_vertex(&made, 0, -1, 0);
    soup_triangle(&made, a, b, c);
    soup_triangle(&made, b, d, e);
    made_mesh m = mesh_of_soup();
    assert_int_equal(m.mesh.welded_count, 4);
    assert_int_equal(m.mesh.open_count, 4);
    free_mesh(&m);
}

// Vertices moved by up to 0.4 of the distance, each within it of all others of its place: the ball closes
static void near_vertices_are_one(void **state)
{
    (void)state;
    soup_ball(&made, 3);
    for (int32_t i = 0; i < made.vertex_count; ++i)
        for (int32_t k = 0; k < 3; ++k) made.vertices[i][k] += (float)(0.28e-3 * soup_random(&dice));
    fe__mesh_source source = soup_source(&made);
    made_mesh m;
    FE_TRUE(make_mesh_of(&source, &m));
    FE_TRUE(m.mesh.open_count > 0);
    free_mesh(&m);
    source.weld_distance = 1e-3;
    FE_TRUE(make_mesh_of(&source, &m));
    assert_int_equal(m.mesh.open_count, 0);
    assert_int_equal(m.mesh.welded_count, 258);
    check_tree(&m.mesh);
    free_mesh(&m);
}

// A triangle is judged by itself: neither what is far from it counts, nor how small it is. Its height must be more than
// 2^-25 of its largest coordinate.
static void small_triangles_stay_whatever_else_there_is(void **state)
{
    (void)state;
    const double sizes[] = {1e-6, 1e-3, 0.1, 10.0}; // m
    for (int32_t i = 0; i < 4; ++i) {
        double x = sizes[i];
        uint32_t a = soup_vertex(&made, 0, 0, 0), b = soup_vertex(&made, x, 0, 0), c = soup_vertex(&made, 0, 0, x);
        soup_triangle(&made, a, c, b);
    }
    soup_triangle(&made, soup_vertex(&made, 1, 5, 0), soup_vertex(&made, 1.1, 5, 0),
                  soup_vertex(&made, 99999, 99999, 0));
    uint32_t first = soup_vertex(&made, 1, 1, 0), second = soup_vertex(&made, 2, 1, 0);
    soup_triangle(&made, first, second, soup_vertex(&made, 1.5, 1, 2.1 * 0x1p-25));
    soup_triangle(&made, first, second, soup_vertex(&made, 1.5, 1, -1.9 * 0x1p-25)); // lower than a share of 2 m
    made_mesh m = mesh_of_soup();
    assert_int_equal(m.mesh.triangle_count, 6);
    assert_int_equal(m.mesh.degenerate_count, 1);
    FE_TRUE(fe__mesh_slot(&m.mesh, 6) == 6); // after those that are kept
    check_whole(&m.mesh);
    free_mesh(&m);
}

static void triangles_without_area_and_repeated_ones_are_dropped(void **state)
{
    (void)state;
    uint32_t v[4] = {soup_vertex(&made, 0, 0, 0), soup_vertex(&made, 1, 0, 0), soup_vertex(&made, 0, 0, 1),
                     soup_vertex(&made, 2, 0, 0)};
    soup_triangle(&made, v[0], v[0], v[1]); // 0: two corners in one place
    soup_triangle(&made, v[0], v[2], v[1]); // 1
    soup_triangle(&made, v[0], v[1], v[3]); // 2: straight
    soup_triangle(&made, v[2], v[1], v[0]); // 3: 1 again
    soup_triangle(&made, v[0], v[1], v[2]); // 4: its other side
    soup_triangle(&made, v[1], v[0], v[2]); // 5: 1 again
    made_mesh m = mesh_of_soup();
    assert_int_equal(m.mesh.triangle_count, 2);
    assert_int_equal(m.mesh.degenerate_count, 2);
    assert_int_equal(m.mesh.duplicate_count, 2);
    check_whole(&m.mesh);
    FE_TRUE(fe__mesh_slot(&m.mesh, 1) < 2 && fe__mesh_slot(&m.mesh, 4) < 2);
    for (int32_t k = 0; k < 3; ++k) // back to back
        assert_int_equal(fe__mesh_edge_of(&m.mesh, fe__mesh_slot(&m.mesh, 4), k), FE__MESH_EDGE_CONVEX);
    free_mesh(&m);

    fe__mesh_source source = soup_source(&made);
    source.is_strict = 1;
    FE_TRUE(!make_mesh_of(&source, &m));
    assert_int_equal(m.refusal.triangle, 0);
    source.indices += 12, source.triangle_count = 1;
    FE_TRUE(make_mesh_of(&source, &m));
    free_mesh(&m);
    source.indices += 12;
    source.is_strict = 0;
    FE_TRUE(!make_mesh_of(&source, &m));
    assert_int_equal(m.refusal.triangle, -1);
}

// The threshold is relative: a mesh of micrometres keeps its triangles, and slivers of 1:1000 count
static void small_and_thin_triangles_are_kept(void **state)
{
    (void)state;
    static const double scale[3] = {1e-5, 1.0, 1e4};
    for (int32_t i = 0; i < 3; ++i) {
        free_soup(&made);
        for (int32_t k = 0; k < 100; ++k) {
            uint32_t a = soup_vertex(&made, scale[i] * k * 1e-3, 0, 0),
                     b = soup_vertex(&made, scale[i] * (k + 1) * 1e-3, 0, 0),
                     c = soup_vertex(&made, scale[i] * k * 1e-3, 0, scale[i]);
            soup_triangle(&made, a, b, c);
        }
        made_mesh m = mesh_of_soup();
        assert_int_equal(m.mesh.triangle_count, 100);
        check_tree(&m.mesh);
        free_mesh(&m);
    }
}

// ---- edges ---------------------------------------------------------------------------------------------------------
// A roof: two triangles along x, whose outer corners hang by `drop`
static fe__mesh_edge roof_edge(double drop, int32_t is_flipped, int32_t extra)
{
    free_soup(&made);
    uint32_t a = soup_vertex(&made, 0, 0, 0), b = soup_vertex(&made, 1, 0, 0), c = soup_vertex(&made, 0.5, -drop, 1),
             d = soup_vertex(&made, 0.5, -drop, -1), e = soup_vertex(&made, 0.5, 3, 0);
    soup_triangle(&made, b, a, c); // normals up
    if (is_flipped)
        soup_triangle(&made, b, a, d);
    else
        soup_triangle(&made, a, b, d);
    if (extra) soup_triangle(&made, a, b, e);
    made_mesh m = mesh_of_soup();
    fe__mesh_edge edge = fe__mesh_edge_of(&m.mesh, fe__mesh_slot(&m.mesh, 0), 0);
    assert_int_equal(edge, fe__mesh_edge_of(&m.mesh, fe__mesh_slot(&m.mesh, 1), 0));
    assert_int_equal(fe__mesh_edge_of(&m.mesh, fe__mesh_slot(&m.mesh, 0), 1), FE__MESH_EDGE_OPEN);
    assert_int_equal(m.mesh.flipped_count, is_flipped && !extra);
    assert_int_equal(m.mesh.odd_count, extra);
    free_mesh(&m);
    return edge;
}

// Each side falls by drop over 1 m: the normals turn by 2 atan(drop). Felt above 0.0349 = 2 x 0.01745
static void edges_are_what_meets_there(void **state)
{
    (void)state;
    assert_int_equal(roof_edge(0.0, 0, 0), FE__MESH_EDGE_SMOOTH);
    assert_int_equal(roof_edge(-0.5, 0, 0), FE__MESH_EDGE_SMOOTH);
    assert_int_equal(roof_edge(0.5, 0, 0), FE__MESH_EDGE_CONVEX);
    assert_int_equal(roof_edge(50.0, 0, 0), FE__MESH_EDGE_CONVEX);
    assert_int_equal(roof_edge(0.0170, 0, 0), FE__MESH_EDGE_BENT);
    assert_int_equal(roof_edge(0.0179, 0, 0), FE__MESH_EDGE_CONVEX);
    assert_int_equal(roof_edge(0.1, 1, 0), FE__MESH_EDGE_ODD);
    assert_int_equal(roof_edge(0.1, 0, 1), FE__MESH_EDGE_ODD);
}

static void a_box_feels_its_twelve_edges(void **state)
{
    (void)state;
    static const uint8_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int32_t i = 0; i < 8; ++i) soup_vertex(&made, i & 1, i >> 1 & 1, i >> 2 & 1);
    for (int32_t i = 0; i < 6; ++i) {
        soup_triangle(&made, quads[i][0], quads[i][1], quads[i][2]);
        soup_triangle(&made, quads[i][0], quads[i][2], quads[i][3]);
    }
    made_mesh m = mesh_of_soup();
    FE_NEAR(m.mesh.volume, 1.0, 1e-12);
    FE_NEAR(m.mesh.area, 6.0, 1e-12);
    int32_t convex = 0, smooth = 0;
    for (int32_t i = 0; i < 36; ++i) {
        fe__mesh_edge edge = fe__mesh_edge_of(&m.mesh, i / 3, i % 3);
        convex += edge == FE__MESH_EDGE_CONVEX, smooth += edge == FE__MESH_EDGE_SMOOTH;
    }
    assert_int_equal(convex, 24);
    assert_int_equal(smooth, 12);
    free_mesh(&m);
    for (int32_t i = 0; i < made.triangle_count; ++i) { // inside out
        uint32_t kept = made.triangles[i][0];
        made.triangles[i][0] = made.triangles[i][1], made.triangles[i][1] = kept;
    }
    m = mesh_of_soup();
    FE_NEAR(m.mesh.volume, -1.0, 1e-12);
    free_mesh(&m);
}

// A T: one long edge against two short ones. All are open
static void edges_at_a_t_are_open(void **state)
{
    (void)state;
    uint32_t a = soup_vertex(&made, 0, 0, 0), b = soup_vertex(&made, 2, 0, 0), c = soup_vertex(&made, 1, 0, -1),
             d = soup_vertex(&made, 1, 0, 0), e = soup_vertex(&made, 1, 0, 1);
    soup_triangle(&made, a, b, c);
    soup_triangle(&made, d, a, e);
    soup_triangle(&made, b, d, e);
    made_mesh m = mesh_of_soup();
    assert_int_equal(m.mesh.open_count, 3 + 2 * 2);
    free_mesh(&m);
}

// ---- the same bytes ------------------------------------------------------------------------------------------------
static uint64_t fingerprint(const fe__mesh *m)
{
    fe__hash h = fe__hash_begin();
    const unsigned char *bytes = m->block;
    for (int64_t i = 0; i + 4 <= m->size; i += 4) {
        uint32_t word;
        memcpy(&word, bytes + i, sizeof word);
        fe__hash_u32(&h, word);
    }
    return fe__hash_end(&h);
}

static void the_same_input_makes_the_same_bytes(void **state)
{
    (void)state;
    soup_terrain(&made, 60, 0.7, 0.3, &dice);
    soup_scatter(&made, 500, 5.0, &dice);
    made_mesh a = mesh_of_soup(), b = mesh_of_soup();
    assert_int_equal(a.mesh.size, b.mesh.size);
    assert_memory_equal(a.mesh.block, b.mesh.block, (size_t)a.mesh.size);
    // of every compiler and machine that has a word's low byte first
    if (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__) FE_TRUE(fingerprint(&a.mesh) == UINT64_C(0xfe40ec91bfabff6a));
    free_mesh(&a);
    free_mesh(&b);
}

// ---- the API -------------------------------------------------------------------------------------------------------
static fe_store *open_store(const fe_allocator *allocator)
{
    fe_store *store;
    fe_store_def def;
    fe_store_def_init(&def, sizeof def);
    def.allocator = allocator;
    value_must(fe_store_create(&def, &store));
    return store;
}

static fe_mesh_def def_of_soup(void)
{
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = &made.vertices[0][0], def.vertex_count = made.vertex_count;
    def.indices = made.triangles, def.triangle_count = made.triangle_count;
    return def;
}

static void check_error(fe_store *store, const fe_mesh_def *def, fe_result expected, const char *words)
{
    fe_asset asset = 7;
    int64_t before, after;
    fe_store_get_bytes(store, &before);
    assert_int_equal(fe_mesh_create(store, def, &asset), expected);
    fe_store_get_bytes(store, &after);
    assert_int_equal(before, after);
    assert_int_equal(asset, 0);
    if (!strstr(fe_last_error(), words)) print_error("%s\n", fe_last_error());
    FE_TRUE(strstr(fe_last_error(), words) != NULL);
}

static void errors_name_the_place(void **state)
{
    (void)state;
    soup_terrain(&made, 4, 1.0, 0.1, &dice);
    fe_store *store = open_store(NULL);
    fe_mesh_def def = def_of_soup();
    made.triangles[5][2] = (uint32_t)made.vertex_count;
    check_error(store, &def, FE_ERROR_ARGUMENT, "index 2 of triangle 5 is 25");
    made.triangles[5][2] = UINT32_MAX;
    check_error(store, &def, FE_ERROR_ARGUMENT, "4294967295");
    made.triangles[5][2] = made.triangles[5][0];
    def.flags = FE_MESH_STRICT;
    check_error(store, &def, FE_ERROR_DEGENERATE, "triangle 5 has no area");
    memcpy(made.triangles[5], made.triangles[3], sizeof made.triangles[5]);
    check_error(store, &def, FE_ERROR_DEGENERATE, "triangle 5 repeats");
    static const float wrong[4] = {NAN, INFINITY, -INFINITY, 1.1e5f};
    float kept = made.vertices[7][1];
    for (int32_t i = 0; i < 4; ++i) {
        made.vertices[7][1] = wrong[i];
        check_error(store, &def, FE_ERROR_ARGUMENT, "vertices[7].y");
    }
    made.vertices[7][1] = kept;
    def = def_of_soup();
    def.triangle_count = (1 << 27) + 1;
    check_error(store, &def, FE_ERROR_LIMIT, "triangle_count");
    def = def_of_soup();
    def.triangle_count = 0;
    check_error(store, &def, FE_ERROR_ARGUMENT, "triangle_count");
    def.triangle_count = 1;
    memset(made.triangles, 0, 12);
    check_error(store, &def, FE_ERROR_DEGENERATE, "no triangle");
    uint8_t materials[64] = {[9] = 2};
    fe_material material[2];
    def = def_of_soup();
    def.triangle_materials = materials, def.materials = material, def.material_count = 2;
    fe_material_init(material), fe_material_init(material + 1);
    check_error(store, &def, FE_ERROR_ARGUMENT, "triangle_materials[9] is 2");
    value_must(fe_store_destroy(store));
}

static void triangles_are_read_by_the_callers_numbers(void **state)
{
    (void)state;
    soup_terrain(&made, 20, 1.0, 0.3, &dice);
    uint8_t materials[800];
    uint32_t data[800];
    for (uint32_t i = 0; i < 800; ++i) materials[i] = (uint8_t)(i % 3), data[i] = 0xffffffffu - i;
    fe_material material[3];
    for (int32_t i = 0; i < 3; ++i) fe_material_init(material + i);
    made.triangles[17][1] = made.triangles[17][0];
    fe_mesh_def def = def_of_soup();
    def.triangle_materials = materials, def.triangle_data = data, def.materials = material, def.material_count = 3;
    fe_store *store = open_store(NULL);
    fe_asset mesh;
    value_must(fe_mesh_create(store, &def, &mesh));
    fe_mesh_info info = {.struct_size = sizeof info};
    value_must(fe_mesh_get_info(store, mesh, &info));
    assert_int_equal(info.triangle_count, 799);
    assert_int_equal(info.degenerate_triangles, 1);
    assert_int_equal(info.material_count, 3);
    int64_t bytes;
    value_must(fe_store_get_bytes(store, &bytes));
    FE_TRUE(info.bytes <= bytes);
    for (int32_t i = 0; i < 800; ++i) {
        fe_mesh_triangle t = {.struct_size = sizeof t};
        value_must(fe_mesh_get_triangle(store, mesh, i, &t));
        assert_int_equal(t.kept, i != 17);
        if (!t.kept) continue;
        assert_int_equal(t.material, i % 3);
        assert_int_equal(t.data, data[i]);
        for (int32_t k = 0; k < 3; ++k) assert_memory_equal(t.corners + k, made.vertices[made.triangles[i][k]], 12);
    }
    fe_mesh_triangle t = {.struct_size = sizeof t};
    assert_int_equal(fe_mesh_get_triangle(store, mesh, 800, &t), FE_ERROR_ARGUMENT);
    assert_int_equal(fe_mesh_set_materials(store, mesh, material, 0, 3), FE_OK);
    assert_int_equal(fe_mesh_set_materials(store, mesh, material, 0, 2), FE_ERROR_ARGUMENT);
    value_must(fe_asset_destroy(store, mesh));
    assert_int_equal(fe_mesh_get_info(store, mesh, &info), FE_ERROR_STALE);
    value_must(fe_store_destroy(store));
}

static void short_indices_and_strides(void **state)
{
    (void)state;
    soup_terrain(&made, 10, 1.0, 0.3, &dice);
    float wide[121][5];
    uint16_t triangles[200][4];
    for (int32_t i = 0; i < 121; ++i) memcpy(wide[i], made.vertices[i], 12);
    for (int32_t i = 0; i < 600; ++i) triangles[i / 3][i % 3] = (uint16_t)made.triangles[i / 3][i % 3];
    fe_store *store = open_store(NULL);
    fe_asset a, b;
    fe_mesh_def def = def_of_soup();
    value_must(fe_mesh_create(store, &def, &a));
    def.vertices = wide[0], def.vertex_stride = sizeof wide[0];
    def.indices = triangles, def.index_stride = sizeof triangles[0], def.index_type = FE_INDEX_U16;
    value_must(fe_mesh_create(store, &def, &b));
    for (int32_t i = 0; i < 200; ++i) {
        fe_mesh_triangle t = {.struct_size = sizeof t}, u = {.struct_size = sizeof u};
        value_must(fe_mesh_get_triangle(store, a, i, &t));
        value_must(fe_mesh_get_triangle(store, b, i, &u));
        assert_memory_equal(&t, &u, sizeof t);
    }
    value_must(fe_store_destroy(store));
}

static int32_t allowed;
static void *allocate_some(void *user, uint64_t size, uint64_t alignment)
{
    (void)user;
    return allowed-- > 0 ? fe__aligned_allocate((size_t)size, (size_t)alignment) : NULL;
}
static void release_some(void *user, void *memory, uint64_t size)
{
    (void)user, (void)size;
    fe__aligned_free(memory);
}

static void no_memory_loses_nothing(void **state)
{
    (void)state;
    soup_terrain(&made, 10, 1.0, 0.3, &dice);
    uint8_t materials[200] = {0};
    fe_material material;
    fe_material_init(&material);
    fe_allocator allocator;
    fe_allocator_init(&allocator, sizeof allocator);
    allocator.allocate = allocate_some, allocator.release = release_some;
    int32_t failures = 0;
    fe_result result = FE_ERROR_MEMORY;
    for (; result == FE_ERROR_MEMORY; ++failures) {
        allowed = 1000;
        fe_store *store = open_store(&allocator);
        fe_mesh_def def = def_of_soup();
        def.triangle_materials = materials, def.materials = &material, def.material_count = 1;
        fe_asset mesh;
        int64_t before, after;
        fe_store_get_bytes(store, &before);
        allowed = failures;
        result = fe_mesh_create(store, &def, &mesh);
        fe_store_get_bytes(store, &after);
        if (result == FE_ERROR_MEMORY) {
            FE_WITHIN(after - before, 0, 4096); // the store's own table may have grown
            assert_int_equal(mesh, 0);
            allowed = 1000;
            value_must(fe_mesh_create(store, &def, &mesh));
        }
        value_must(fe_store_destroy(store));
    }
    value_must(result);
    FE_WITHIN(failures, 5, 10); // room, scratch, block, materials, and the store's table
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(trees_hold_all_triangles, reset),
        cmocka_unit_test_setup(trees_of_awkward_triangles, reset),
        cmocka_unit_test_setup(a_row_that_shrinks_makes_no_deep_tree, reset),
        cmocka_unit_test_setup(a_closed_mesh_is_small, reset),
        cmocka_unit_test_setup(equal_vertices_are_one, reset),
        cmocka_unit_test_setup(zeros_of_both_signs_are_one, reset),
        cmocka_unit_test_setup(near_vertices_are_one, reset),
        cmocka_unit_test_setup(small_triangles_stay_whatever_else_there_is, reset),
        cmocka_unit_test_setup(triangles_without_area_and_repeated_ones_are_dropped, reset),
        cmocka_unit_test_setup(small_and_thin_triangles_are_kept, reset),
        cmocka_unit_test_setup(edges_are_what_meets_there, reset),
        cmocka_unit_test_setup(a_box_feels_its_twelve_edges, reset),
        cmocka_unit_test_setup(edges_at_a_t_are_open, reset),
        cmocka_unit_test_setup(the_same_input_makes_the_same_bytes, reset),
        cmocka_unit_test_setup(errors_name_the_place, reset),
        cmocka_unit_test_setup(triangles_are_read_by_the_callers_numbers, reset),
        cmocka_unit_test_setup(short_indices_and_strides, reset),
        cmocka_unit_test_setup(no_memory_loses_nothing, reset),
    };
    return cmocka_run_group_tests_name("builder of meshes", tests, NULL, reset);
}
