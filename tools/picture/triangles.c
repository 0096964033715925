// triangles.c - see triangles.h. Draw calls give corners alone; normals of round forms are found here: corners of one
// body in one place share a normal where their faces bend by less than CREASE.
#include "triangles.h"

#include <stdlib.h>
#include <string.h>

#define CREASE 0.9      // cosine: 26 degrees
#define ALIKE 0.9999999 // of two normals that are one
enum { SEGMENTS = 32, NONE = -1 };

camera make_camera(const picture_view *view)
{
    camera c;
    c.forward =
        unit(make_vec(view->target.x - view->eye.x, view->target.y - view->eye.y, view->target.z - view->eye.z));
    c.right = unit(cross(c.forward, make_vec(0.0, 1.0, 0.0)));
    c.up = cross(c.right, c.forward);
    return c;
}

vec into_camera(const camera *c, vec p) { return make_vec(dot(p, c->right), dot(p, c->up), dot(p, c->forward)); }

int32_t draw_all(draw_call *call, const fe_world *world, const picture_view *view, uint32_t parts, fe_draw_vertex **out)
{
    fe_draw_options options;
    fe_draw_options_init(&options, sizeof options);
    options.parts = parts, options.origin = view->eye, options.segments = SEGMENTS, options.scale = view->scale;
    int32_t count = call(world, &options, NULL, 0, 0);
    *out = NULL;
    if (count <= 0) return count;
    *out = malloc((size_t)count * sizeof **out);
    if (!*out) return FE_ERROR_MEMORY;
    return call(world, &options, *out, sizeof **out, count);
}

// ---- normals -------------------------------------------------------------------------------------------------------
// Corners of one place are a chain: heads[hash] is one of them, next[corner] another
typedef struct places {
    const fe_draw_vertex *at;
    const triangle *of;
    int32_t *heads, *next;
    uint32_t mask;
} places;

static int same_place(const places *p, int32_t a, int32_t b)
{
    const fe_draw_vertex *u = p->at + a, *v = p->at + b;
    return u->x == v->x && u->y == v->y && u->z == v->z && p->of[a / 3].body == p->of[b / 3].body;
}

static uint32_t hash_of(const places *p, int32_t corner)
{
    float at[3] = {p->at[corner].x + 0.0f, p->at[corner].y + 0.0f, p->at[corner].z + 0.0f}; // -0 is 0
    uint32_t words[3], hash = (uint32_t)p->of[corner / 3].body;
    memcpy(words, at, sizeof words);
    for (int i = 0; i < 3; ++i) hash = (hash ^ words[i]) * UINT32_C(0x9e3779b1), hash ^= hash >> 15;
    return hash & p->mask;
}

static int32_t *head_of(places *p, int32_t corner)
{
    uint32_t slot = hash_of(p, corner);
    while (p->heads[slot] != NONE && !same_place(p, p->heads[slot], corner)) slot = (slot + 1) & p->mask;
    return p->heads + slot;
}

static void smooth(places *p, triangle *triangles, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        int32_t *head = head_of(p, i);
        p->next[i] = *head, *head = i;
    }
    for (int32_t i = 0; i < count; ++i) {
        vec sum = {0, 0, 0}, own = triangles[i / 3].normal;
        for (int32_t k = *head_of(p, i); k != NONE; k = p->next[k]) {
            vec other = triangles[k / 3].normal;
            if (dot(own, other) > CREASE) sum = add(sum, other);
        }
        triangles[i / 3].normals[i % 3] = unit(sum);
        triangles[i / 3].flat &= dot(own, unit(sum)) > ALIKE;
    }
}

static int32_t find_normals(const fe_draw_vertex *vertices, triangle *triangles, int32_t count)
{
    size_t slots = 16;
    while (slots < 2 * (size_t)count) slots *= 2;
    places p = {vertices, triangles, malloc(slots * sizeof *p.heads), malloc((size_t)count * sizeof *p.next),
                (uint32_t)(slots - 1)};
    int32_t result = p.heads && p.next ? FE_OK : FE_ERROR_MEMORY;
    if (result == FE_OK) {
        for (size_t i = 0; i < slots; ++i) p.heads[i] = NONE;
        smooth(&p, triangles, count);
    }
    free(p.heads), free(p.next);
    return result;
}

// ---- triangles -----------------------------------------------------------------------------------------------------
typedef struct owners {
    fe_handle shape;
    fe_body body;
    int32_t number, two_sided;
} owners;

static void meet(const fe_world *world, fe_handle shape, owners *last)
{
    fe_geometry form;
    fe_body body = 0;
    fe_geometry_init(&form, sizeof form);
    fe_shape_get_body(world, shape, &body);
    fe_shape_get_geometry(world, shape, &form);
    last->number += body != last->body;
    last->shape = shape, last->body = body;
    last->two_sided = form.type == FE_GEOMETRY_MESH;
}

// Corners nearer to each other than rounding make no triangle. @return how many are kept; their vertices move up too
static int32_t make_triangles(const fe_world *world, const camera *camera, fe_draw_vertex *v, int32_t count,
                              triangle *out)
{
    owners last = {0, 0, NONE, 0};
    int32_t kept = 0;
    for (int32_t i = 0; i + 2 < count; i += 3) {
        triangle *t = out + kept;
        if (v[i].owner != last.shape) meet(world, v[i].owner, &last);
        for (int k = 0; k < 3; ++k)
            t->corners[k] = into_camera(camera, make_vec((double)v[i + k].x, (double)v[i + k].y, (double)v[i + k].z));
        // the camera's axes are left-handed
        vec across = cross(sub(t->corners[2], t->corners[0]), sub(t->corners[1], t->corners[0]));
        if (!(dot(across, across) > 1e-16)) continue;
        t->normal = unit(across);
        t->rgba = v[i].rgba, t->body = last.number, t->two_sided = last.two_sided, t->flat = 1;
        memmove(v + 3 * kept++, v + i, 3 * sizeof *v);
    }
    return kept;
}

int32_t gather_triangles(const fe_world *world, const picture_view *view, const camera *camera, triangle **out)
{
    fe_draw_vertex *vertices;
    const uint32_t colours = FE_DRAW_SHAPES | FE_DRAW_ISLANDS | FE_DRAW_SLEEP;
    *out = NULL;
    int32_t count = draw_all(fe_world_draw_triangles, world, view, view->parts & colours, &vertices);
    if (count > 0) {
        *out = malloc((size_t)count / 3 * sizeof **out);
        int32_t kept = *out ? make_triangles(world, camera, vertices, count, *out) : FE_ERROR_MEMORY;
        int32_t result = kept > 0 ? find_normals(vertices, *out, 3 * kept) : kept;
        count = result < 0 ? result : kept;
    }
    free(vertices);
    return count;
}
