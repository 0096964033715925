// terrain_surface.c - normal cones of the ground's faces, edges and vertices; see terrain_surface.h.
//
// A direction m is in the normal cone of a point of a surface when nothing near the point rises along m. For a
// piecewise flat surface it is enough to look at the samples next to it (Connolly; van den Bergen: Voronoi regions of a
// mesh's features). Beyond the border of the grid the neighbouring heightfields are asked for their height a little
// further on, and so are boxes and hulls. A mesh does not know what is next to what: its tree is asked for the
// triangles at the point. So are other meshes', and what only lies there, as at a T-junction, counts too.
#include "collision/manifold/terrain_surface.h"

// Slopes below this count as flat: 0.06 degrees
#define FLAT 1e-3f
// How far over the border a neighbour is asked, and how far beside it may lie, in cells
#define BEYOND 0.01
#define BESIDE 1e-3

static int32_t cell_present(const fe__heightfield *f, int32_t row, int32_t column)
{
    return row >= 0 && row < f->rows - 1 && column >= 0 && column < f->columns - 1 &&
           !fe__heightfield_is_hole(f, row * (f->columns - 1) + column);
}

static fe_vec3 sample(const fe__terrain *t, int32_t row, int32_t column)
{
    const fe__heightfield *f = t->ground.field;
    fe_dvec3 p = {(double)column * f->cell_x, (double)f->heights[(int64_t)row * f->columns + column],
                  (double)row * f->cell_z};
    return fe__narrow(fe__dsub(p, t->origin));
}

// Grid offsets of a triangle's vertices, and beyond each side: the other triangle's cell and half, its third vertex,
// the way out in the grid
typedef struct beyond {
    int8_t row, column, half, third_row, third_column, out_row, out_column;
} beyond;
static const int8_t vertices[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
static const beyond sides[2][3] = {{{0, -1, 1, 0, -1, 0, -1}, {1, 0, 1, 2, 1, 1, 0}, {0, 0, 1, 0, 1, -1, 1}},
                                   {{0, 0, 0, 1, 0, 1, -1}, {0, 1, 0, 1, 2, 0, 1}, {-1, 0, 0, -1, 0, -1, 0}}};

// The edges from a sample: to which one, and the two cells beside it
static const int8_t spokes[6][6] = {{0, 1, 0, 0, -1, 0},    {1, 1, 0, 0, 0, 0},       {1, 0, 0, 0, 0, -1},
                                    {0, -1, 0, -1, -1, -1}, {-1, -1, -1, -1, -1, -1}, {-1, 0, -1, 0, -1, -1}};

static int32_t rises(fe_vec3 m, fe_vec3 way) { return fe__dot(m, way) > FLAT * fe__length(way); }

int32_t fe__tile_beyond(const fe__terrain *t, const fe__tile *tile, int32_t side)
{
    if (t->ground.mesh) return -1;
    const beyond *b = &sides[tile->half][side];
    int32_t row = tile->row + b->row, column = tile->column + b->column;
    return cell_present(t->ground.field, row, column) ? 2 * (row * (t->ground.field->columns - 1) + column) + b->half
                                                      : -1;
}

static fe_vec3 third_of(const fe__terrain *t, const fe__tile *tile, int32_t side)
{
    const beyond *b = &sides[tile->half][side];
    return sample(t, tile->row + b->third_row, tile->column + b->third_column);
}

static float longest_side(const fe_vec3 v[3])
{
    float square = 0.0f;
    for (int32_t k = 0; k < 3; ++k) {
        fe_vec3 side = fe__sub(v[(k + 1) % 3], v[k]);
        square = fe__maxf(square, fe__dot(side, side));
    }
    return sqrtf(square);
}

static void find_place(const fe__heightfield *f, fe__tile *tile)
{
    int32_t cell = tile->index >> 1, columns = f->columns - 1;
    tile->row = cell / columns, tile->column = cell % columns, tile->half = tile->index & 1;
    tile->material = f->cells ? f->cells[cell] : 0;
}

// Seen from its other side, a triangle runs the other way, and what was concave is convex: the tree is asked.
static void turn_round(fe__tile *tile)
{
    fe_vec3 second = tile->form.vertex[1];
    tile->form.vertex[1] = tile->form.vertex[2], tile->form.vertex[2] = second;
    tile->normal = fe__neg(tile->normal);
    for (int32_t k = 0; k < 3; ++k) tile->felt[k] = 1;
}

static void find_sides(const fe__mesh *m, fe__tile *tile)
{
    int32_t digits = m->edges[tile->index]; // as fe__mesh_edge_of, all three at once
    for (int32_t k = 0; k < 3; ++k, digits /= FE__MESH_EDGES)
        tile->felt[m->is_mirrored ? 2 - k : k] = digits % FE__MESH_EDGES != FE__MESH_EDGE_SMOOTH;
    tile->material = m->materials ? m->materials[tile->index] : 0;
    if (m->is_two_sided && fe__dot(tile->normal, tile->form.vertex[0]) > 0.0f) turn_round(tile);
}

// A triangle lower than a hundredth of its longest side would have a normal of roundings: floats hold its corners
// relative to the body. Its own coordinates are exact.
static fe_vec3 normal_of(const fe__terrain *t, const fe__form *triangle, int32_t index, float size)
{
    const float thin = 0.01f;
    const fe_vec3 *v = triangle->vertex;
    fe_vec3 n = fe__cross(fe__sub(v[1], v[0]), fe__sub(v[2], v[0]));
    float length = fe__length(n);
    if (length > thin * size * size) return fe__scale(1.0f / length, n);
    return fe__narrow(fe__ground_normal(&t->ground, index));
}

void fe__tile_place(const fe__terrain *t, int32_t index, fe__tile *tile)
{
    tile->index = index, tile->size = longest_side(tile->form.vertex);
    tile->normal = normal_of(t, &tile->form, index, tile->size);
    if (t->ground.mesh)
        find_sides(t->ground.mesh, tile);
    else
        find_place(t->ground.field, tile);
}

int32_t fe__tile_is_convex(const fe__terrain *t, const fe__tile *tile, int32_t side)
{
    if (t->ground.mesh) return tile->felt[side];
    if (fe__tile_beyond(t, tile, side) < 0) return 1;
    return fe__dot(tile->normal, fe__sub(third_of(t, tile, side), tile->form.vertex[side])) < -FLAT * tile->size;
}

static int32_t goes_on_beyond(const fe__terrain *t, const fe__tile *tile, int32_t side)
{
    const fe__mesh *m = t->ground.mesh;
    if (m) return !m->is_two_sided && fe__mesh_edge_of(m, tile->index, side) < FE__MESH_EDGE_OPEN;
    return fe__tile_beyond(t, tile, side) >= 0;
}

int32_t fe__tile_is_known(const fe__terrain *t, const fe__tile *tile)
{
    int32_t known = 0;
    for (int32_t i = 0; i < t->known_count; ++i) known |= fe__dot(t->known[i], tile->normal) > FE__SAME_NORMAL;
    for (int32_t k = 0; k < 3 && known; ++k) known = goes_on_beyond(t, tile, k);
    return known;
}

// ---- beyond the border ---------------------------------------------------------------------------------------------
static fe_dvec3 into(const fe__neighbour *n, fe_vec3 p)
{
    return fe__dadd(n->position, fe__widen(fe__mul_transposed(&n->axes, p)));
}

// Does a neighbour go on at p and rise along m?
static int32_t goes_on(const fe__neighbour *n, fe_vec3 p, fe_vec3 m, float near)
{
    return fe__ground_rises(&n->ground, into(n, p), fe__widen(fe__mul_transposed(&n->axes, m)),
                            (double)fe__minf(near, FE__GOES_ON));
}

static int32_t solid_rises(const fe__terrain *t, fe_vec3 p, fe_vec3 m)
{
    for (int32_t i = 0; i < t->around->solid_count; ++i)
        if (fe__solid_goes_on(t->around->solids + i, p, m)) return 1;
    return 0;
}

static int32_t is_alone(const fe__terrain *t) { return !(t->around->ground_count | t->around->solid_count); }

int32_t fe__heightfield_height(const fe__heightfield *f, fe_dvec3 p, double *height)
{
    double x = p.x / f->cell_x, z = p.z / f->cell_z, columns = (double)(f->columns - 1), rows = (double)(f->rows - 1);
    if (!(x >= -BESIDE && x <= columns + BESIDE && z >= -BESIDE && z <= rows + BESIDE)) return 0;
    int32_t column = (int32_t)fe__maxd(fe__mind(x, columns - 1.0), 0.0),
            row = (int32_t)fe__maxd(fe__mind(z, rows - 1.0), 0.0);
    if (!cell_present(f, row, column)) return 0;
    const float *h = f->heights + (int64_t)row * f->columns + column, *next = h + f->columns;
    double u = x - (double)column, v = z - (double)row, h00 = (double)h[0], h11 = (double)next[1],
           side = (double)(u > v ? h[1] : next[0]);
    *height = u > v ? h00 + u * (side - h00) + v * (h11 - side) : h00 + v * (side - h00) + u * (h11 - side);
    return 1;
}

// Does a neighbour go on from the point p of the border, and rise along m? `way`: out of this field, x and z.
static int32_t neighbour_rises(const fe__terrain *t, fe_vec3 p, fe_vec3 way, fe_vec3 m)
{
    if (solid_rises(t, p, m)) return 1;
    for (int32_t i = 0; i < t->around->ground_count; ++i) {
        const fe__neighbour *n = t->around->grounds + i;
        if (n->ground.mesh) {
            if (goes_on(n, p, m, FE__GOES_ON_SHARE / (float)BEYOND * fe__length(way))) return 1;
            continue;
        }
        fe_dvec3 here = into(n, p), there = into(n, fe__add(p, way));
        double height, further, apart = 0.1 * (double)fe__length(way);
        if (!fe__heightfield_height(n->ground.field, here, &height) || fe__absd(height - here.y) > apart ||
            !fe__heightfield_height(n->ground.field, there, &further))
            continue;
        fe_dvec3 rise = {there.x - here.x, further - height, there.z - here.z};
        if (rises(m, fe__mul(&n->axes, fe__narrow(rise)))) return 1;
    }
    return 0;
}

static fe_vec3 way_out(const fe__terrain *t, int32_t out_row, int32_t out_column)
{
    return fe__vec3((float)(BEYOND * (double)out_column * t->ground.field->cell_x), 0.0f,
                    (float)(BEYOND * (double)out_row * t->ground.field->cell_z));
}

static int32_t on_border(const fe__heightfield *f, int32_t row, int32_t column)
{
    return row == 0 || row == f->rows - 1 || column == 0 || column == f->columns - 1;
}

// ---- cones ---------------------------------------------------------------------------------------------------------
static int32_t side_allows(const fe__terrain *t, const fe__tile *tile, int32_t side, fe_vec3 m)
{
    const fe_vec3 *v = tile->form.vertex;
    if (!fe__tile_is_convex(t, tile, side)) return 0;
    if (fe__tile_beyond(t, tile, side) >= 0) return !rises(m, fe__sub(third_of(t, tile, side), v[side]));
    if (is_alone(t)) return 1;
    // at the point of the side nearest the body, which is at the origin
    fe_vec3 along = fe__sub(v[(side + 1) % 3], v[side]);
    float s = fe__clampf(-fe__dot(along, v[side]) / fe__dot(along, along), 0.0f, 1.0f);
    const beyond *b = &sides[tile->half][side];
    return !neighbour_rises(t, fe__add_scaled(v[side], s, along), way_out(t, b->out_row, b->out_column), m);
}

static int32_t vertex_allows(const fe__terrain *t, const fe__tile *tile, int32_t vertex, fe_vec3 m)
{
    const fe__heightfield *f = t->ground.field;
    int32_t row = tile->row + vertices[tile->half][vertex][0], column = tile->column + vertices[tile->half][vertex][1];
    fe_vec3 p = tile->form.vertex[vertex];
    for (int32_t i = 0; i < 6; ++i) {
        const int8_t *s = spokes[i];
        if (!cell_present(f, row + s[2], column + s[3]) && !cell_present(f, row + s[4], column + s[5])) continue;
        if (rises(m, fe__sub(sample(t, row + s[0], column + s[1]), p))) return 0;
    }
    if (is_alone(t) || !on_border(f, row, column)) return 1;
    for (int32_t i = 0; i < 9; ++i) {
        if (i != 4 && neighbour_rises(t, p, way_out(t, i / 3 - 1, i % 3 - 1), m)) return 0;
    }
    return 1;
}

// ---- cones of a mesh -----------------------------------------------------------------------------------------------
static int32_t mesh_allows(const fe__terrain *t, const fe__tile *tile, fe_vec3 p, fe_vec3 m)
{
    float near = fe__tile_goes_on(tile);
    if (fe__ground_rises(&t->ground, fe__dadd(t->origin, fe__widen(p)), fe__widen(m), (double)near)) return 0;
    for (int32_t i = 0; i < t->around->ground_count; ++i)
        if (goes_on(t->around->grounds + i, p, m, near)) return 0;
    return !solid_rises(t, p, m);
}

// At the point of the side nearest the body, which is at the origin, but not at its ends: others begin there.
static int32_t mesh_side_allows(const fe__terrain *t, const fe__tile *tile, int32_t side, fe_vec3 m)
{
    const float end = 0.1f; // share of the side
    if (!tile->felt[side]) return 0;
    fe_vec3 v = tile->form.vertex[side], along = fe__sub(tile->form.vertex[(side + 1) % 3], v);
    float s = fe__clampf(-fe__dot(along, v) / fe__dot(along, along), end, 1.0f - end);
    return mesh_allows(t, tile, fe__add_scaled(v, s, along), m);
}

// Where a vertex sticks out, so do sides at it, and their triangles have it.
static int32_t mesh_vertex_allows(const fe__terrain *t, const fe__tile *tile, int32_t vertex, fe_vec3 m)
{
    return (tile->felt[vertex] | tile->felt[(vertex + 2) % 3]) && mesh_allows(t, tile, tile->form.vertex[vertex], m);
}

// The vertices of a triangle, lower than FLAT of its size, that are farthest along m, which is not its normal: a bit
// each. All three are as level at 1 : 1000: without the lowest.
static uint32_t touched_of_sliver(const fe__tile *tile, const float along[3])
{
    int32_t top = along[0] >= along[1] ? (along[0] >= along[2] ? 0 : 2) : (along[1] >= along[2] ? 1 : 2), low = -1;
    uint32_t touched = 1u << top;
    for (int32_t i = 0; i < 3; ++i) {
        fe_vec3 side = fe__sub(tile->form.vertex[i], tile->form.vertex[top]);
        float drop = along[top] - along[i];
        if (i == top || drop * drop > FLAT * FLAT * fe__dot(side, side)) continue;
        touched |= 1u << i;
        if (low < 0 || along[i] < along[low]) low = i;
    }
    return touched == 7 ? touched & ~(1u << low) : touched;
}

int32_t fe__tile_allows(const fe__terrain *t, const fe__tile *tile, fe_vec3 m)
{
    float along[3], most;
    for (int32_t i = 0; i < 3; ++i) along[i] = fe__dot(m, tile->form.vertex[i]);
    most = fe__maxf(along[0], fe__maxf(along[1], along[2])) - FLAT * tile->size;
    uint32_t touched = (along[0] >= most ? 1u : 0u) | (along[1] >= most ? 2u : 0u) | (along[2] >= most ? 4u : 0u);
    if (touched == 7) {
        fe_vec3 lean = fe__sub(m, tile->normal);
        if (fe__dot(lean, lean) <= FLAT * FLAT) return 1; // the face
        touched = touched_of_sliver(tile, along);
    }
    int32_t is_mesh = t->ground.mesh != NULL;
    switch (touched) {
    case 1:
    case 2:
    case 4: {
        int32_t vertex = touched == 4 ? 2 : (int32_t)touched - 1;
        return is_mesh ? mesh_vertex_allows(t, tile, vertex, m) : vertex_allows(t, tile, vertex, m);
    }
    default: {
        int32_t side = touched == 3 ? 0 : touched == 6 ? 1 : 2;
        return is_mesh ? mesh_side_allows(t, tile, side, m) : side_allows(t, tile, side, m);
    }
    }
}
