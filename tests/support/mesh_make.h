// mesh_make.h - meshes without a store, and meshes to try.
#ifndef FE_TESTS_MESH_MAKE_H
#define FE_TESTS_MESH_MAKE_H
#include "collision/cast/mesh_ray.h"
#include "collision/mesh_build/mesh_build.h"
#include "core/memory.h"
#include "solver/solver.h"

#include <stdlib.h>
#include <string.h>

typedef struct soup { // what a caller has
    float (*vertices)[3];
    uint32_t (*triangles)[3];
    int32_t vertex_count, triangle_count, vertex_room, triangle_room;
} soup;

typedef struct made_mesh {
    fe__mesh mesh;
    fe__mesh_refusal refusal;
    int64_t room, scratch; // bytes
} made_mesh;

static inline void *mesh_memory(int64_t size)
{
    size_t whole = (size_t)(size + 63) / 64 * 64;
    void *memory = fe__aligned_allocate(whole, 64);
    if (!memory) abort();
    memset(memory, 0, whole);
    return memory;
}

static inline fe__mesh_source soup_source(const soup *s)
{
    return (fe__mesh_source){.vertices = (const unsigned char *)s->vertices,
                             .indices = (const unsigned char *)s->triangles,
                             .vertex_stride = 12,
                             .index_stride = 12,
                             .vertex_count = s->vertex_count,
                             .triangle_count = s->triangle_count,
                             .edge_angle = 0.0349};
}

// 0: refused
static inline int32_t make_mesh_of(const fe__mesh_source *source, made_mesh *out)
{
    memset(out, 0, sizeof *out);
    out->room = fe__mesh_room_size(source), out->scratch = fe__mesh_scratch_size(source);
    fe__mesh_builder *room = mesh_memory(out->room);
    void *scratch = mesh_memory(out->scratch);
    int32_t is_made = fe__mesh_build(room, scratch, source);
    fe__aligned_free(scratch);
    out->refusal = room->refusal;
    if (is_made) {
        int64_t size = fe__mesh_block_size(room);
        fe__mesh_write(room, mesh_memory(size), &out->mesh);
    }
    fe__aligned_free(room);
    return is_made;
}

// The ray, cast by each SIMD set that this machine has: all give the same bits
static inline int32_t mesh_ray(const fe__mesh *mesh, fe_dvec3 origin, fe_dvec3 translation, double limit,
                               fe__mesh_hit *hit)
{
    int32_t is_hit = fe__mesh_casts_plain.ray(mesh, origin, translation, limit, hit);
    for (int32_t simd = FE_SIMD_PLAIN + 1; simd <= FE_SIMD_NEON; ++simd) {
        if (!fe__kernels_of(simd)) continue;
        fe__mesh_hit other;
        assert_int_equal(fe__mesh_casts_of(simd)->ray(mesh, origin, translation, limit, &other), is_hit);
        if (!is_hit) continue;
        assert_int_equal(other.hit.index, hit->hit.index);
        assert_int_equal(other.is_back, hit->is_back);
        assert_memory_equal(&other.hit.t, &hit->hit.t, sizeof hit->hit.t);
        assert_memory_equal(&other.hit.normal, &hit->hit.normal, sizeof hit->hit.normal);
        assert_memory_equal(other.weights, hit->weights, sizeof hit->weights);
    }
    return is_hit;
}

static inline int32_t make_mesh(const soup *s, made_mesh *out)
{
    fe__mesh_source source = soup_source(s);
    return make_mesh_of(&source, out);
}

static inline void free_mesh(made_mesh *made)
{
    fe__aligned_free(made->mesh.block);
    made->mesh.block = NULL;
}

// ---- soups ---------------------------------------------------------------------------------------------------------
static inline uint32_t soup_vertex(soup *s, double x, double y, double z)
{
    if (s->vertex_count == s->vertex_room) {
        s->vertex_room = 2 * s->vertex_room + 64;
        s->vertices = realloc(s->vertices, (size_t)s->vertex_room * sizeof *s->vertices);
        if (!s->vertices) abort();
    }
    float *v = s->vertices[s->vertex_count];
    v[0] = (float)x, v[1] = (float)y, v[2] = (float)z;
    return (uint32_t)s->vertex_count++;
}

static inline void soup_triangle(soup *s, uint32_t a, uint32_t b, uint32_t c)
{
    if (s->triangle_count == s->triangle_room) {
        s->triangle_room = 2 * s->triangle_room + 64;
        s->triangles = realloc(s->triangles, (size_t)s->triangle_room * sizeof *s->triangles);
        if (!s->triangles) abort();
    }
    uint32_t *t = s->triangles[s->triangle_count++];
    t[0] = a, t[1] = b, t[2] = c;
}

static inline void free_soup(soup *s)
{
    free(s->vertices);
    free(s->triangles);
    memset(s, 0, sizeof *s);
}

static inline double soup_random(uint64_t *state) // [-1, 1)
{
    *state = *state * 0x5851f42d4c957f2du + 0x14057b7ef767814fu;
    return (double)(*state >> 11) * 0x1p-52 - 1.0;
}

// count x count cells in x and z, y up; heights within +-bump, other diagonals in turn
static inline void soup_terrain(soup *s, int32_t count, double cell, double bump, uint64_t *state)
{
    uint32_t first = (uint32_t)s->vertex_count, row = (uint32_t)count + 1;
    for (int32_t z = 0; z <= count; ++z)
        for (int32_t x = 0; x <= count; ++x)
            soup_vertex(s, cell * (x - 0.5 * count), bump * soup_random(state), cell * (z - 0.5 * count));
    for (uint32_t z = 0; z < (uint32_t)count; ++z) {
        for (uint32_t x = 0; x < (uint32_t)count; ++x) {
            uint32_t a = first + z * row + x, b = a + row, c = b + 1, d = a + 1; // left turn seen from above
            if ((x + z) % 2)
                soup_triangle(s, a, b, c), soup_triangle(s, a, c, d);
            else
                soup_triangle(s, b, c, d), soup_triangle(s, b, d, a);
        }
    }
}

// A closed ball of 8 x 4^levels triangles, its vertices moved by up to bump
static inline uint32_t soup_middle(soup *s, uint32_t a, uint32_t b)
{
    double v[3], k = 0.0;
    for (int32_t i = 0; i < 3; ++i) {
        v[i] = (double)s->vertices[a][i] + (double)s->vertices[b][i];
        k += v[i] * v[i];
    }
    k = 1.0 / sqrt(k);
    return soup_vertex(s, k * v[0], k * v[1], k * v[2]); // once for each of its triangles: they are to be welded
}

static inline void soup_patch(soup *s, uint32_t a, uint32_t b, uint32_t c, int32_t levels)
{
    if (levels == 0) {
        soup_triangle(s, a, b, c);
        return;
    }
    uint32_t d = soup_middle(s, a, b), e = soup_middle(s, b, c), f = soup_middle(s, c, a);
    soup_patch(s, a, d, f, levels - 1);
    soup_patch(s, d, b, e, levels - 1);
    soup_patch(s, f, e, c, levels - 1);
    soup_patch(s, d, e, f, levels - 1);
}

static inline void soup_ball(soup *s, int32_t levels)
{
    uint32_t v[6];
    for (uint32_t k = 0; k < 6; ++k) {
        double side = k % 2 ? -1.0 : 1.0;
        v[k] = soup_vertex(s, k / 2 == 0 ? side : 0.0, k / 2 == 1 ? side : 0.0, k / 2 == 2 ? side : 0.0);
    }
    for (uint32_t k = 0; k < 8; ++k) {
        uint32_t x = v[k & 1], y = v[2 + (k >> 1 & 1)], z = v[4 + (k >> 2 & 1)];
        int32_t turns = (k & 1) ^ (k >> 1 & 1) ^ (k >> 2 & 1);
        if (turns)
            soup_patch(s, x, z, y, levels);
        else
            soup_patch(s, x, y, z, levels);
    }
}

// Triangles anywhere within +-1, of a size
static inline void soup_scatter(soup *s, int32_t count, double size, uint64_t *state)
{
    for (int32_t i = 0; i < count; ++i) {
        double at[3], r[3]; // filled one after the other: the same dice for every compiler
        uint32_t v[3];
        for (int32_t k = 0; k < 3; ++k) at[k] = soup_random(state);
        for (int32_t corner = 0; corner < 3; ++corner) {
            for (int32_t k = 0; k < 3; ++k) r[k] = at[k] + size * soup_random(state);
            v[corner] = soup_vertex(s, r[0], r[1], r[2]);
        }
        soup_triangle(s, v[0], v[1], v[2]);
    }
}

// ---- of one test case ----------------------------------------------------------------------------------------------
static soup made;
static uint64_t dice = 1;

// cmocka's setup, and the teardown of the group
static inline int reset(void **state)
{
    (void)state;
    free_soup(&made);
    dice = 1;
    return 0;
}

static inline fe_dvec3 random_point(double size)
{
    fe_dvec3 p;
    p.x = soup_random(&dice), p.y = soup_random(&dice), p.z = soup_random(&dice);
    return fe__dscale(size, p);
}

#endif
