// weld.c - vertices that are one.
//
// Vertices are looked at in the caller's order. One that lies where an earlier one stays, or nearer than the weld
// distance to it, becomes it; of several the first. Those that stay hang in a table by the cell of space that they are
// in: a cell is one point when only equal ones are welded, else as wide as the distance, so that 27 cells hold whatever
// is near.
#include "collision/mesh_build/build.h"

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
