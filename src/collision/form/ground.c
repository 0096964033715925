// ground.c - see ground.h.
#include "collision/form/ground.h"

#include "collision/form/flat.h"

void fe__ground_corners(const fe__ground *s, int32_t index, fe_dvec3 corner[3])
{
    if (s->mesh)
        fe__mesh_corners(s->mesh, index, corner);
    else
        fe__heightfield_corners(s->field, index, corner);
}

static fe_dvec3 normal_of(const fe_dvec3 v[3])
{
    fe_dvec3 n = fe__dcross(fe__dsub(v[1], v[0]), fe__dsub(v[2], v[0]));
    return fe__dscale(1.0 / sqrt(fe__ddot(n, n)), n);
}

fe_dvec3 fe__ground_normal(const fe__ground *s, int32_t index)
{
    if (!s->mesh) return fe__heightfield_normal(s->field, index);
    fe_dvec3 v[3];
    fe__mesh_corners(s->mesh, index, v);
    return normal_of(v);
}

// A heightfield's side is a rim if the neighbouring cell is outside the field, or a hole; the diagonal never is one.
// Sides are numbered as fe__heightfield_corners gives the corners.
int32_t fe__ground_is_rim(const fe__ground *s, int32_t index, int32_t side)
{
    static const int32_t step_row[2][3] = {{0, 1, 0}, {0, 0, -1}}, step_column[2][3] = {{-1, 0, 0}, {0, 1, 0}};
    if (s->mesh) return fe__mesh_edge_of(s->mesh, index, side) == FE__MESH_EDGE_OPEN;
    int32_t cell = index >> 1, half = index & 1, columns = s->field->columns - 1, diagonal = half ? 0 : 2;
    if (side == diagonal) return 0;
    int32_t row = cell / columns + step_row[half][side], column = cell % columns + step_column[half][side];
    if (row < 0 || row >= s->field->rows - 1 || column < 0 || column >= columns) return 1;
    return fe__heightfield_is_hole(s->field, row * columns + column);
}

fe__bounds fe__ground_bounds(const fe__ground *s)
{
    if (s->mesh) return (fe__bounds){fe__widen(s->mesh->low), fe__widen(s->mesh->high)};
    const fe__heightfield *f = s->field;
    return (fe__bounds){{0.0, (double)f->low, 0.0},
                        {(double)(f->columns - 1) * f->cell_x, (double)f->high, (double)(f->rows - 1) * f->cell_z}};
}

fe_dvec3 fe__ground_cell(const fe__ground *s)
{
    if (!s->mesh) return (fe_dvec3){s->field->cell_x, (double)INFINITY, s->field->cell_z};
    double width = 2.0 * sqrt(s->mesh->area / (double)s->mesh->triangle_count);
    return (fe_dvec3){width, width, width};
}

// A corner's weight is the share of the triangle's area that the point cuts off across from it.
void fe__ground_weights(const fe__ground *s, int32_t index, fe_dvec3 point, float *out_weights)
{
    if (!s->mesh) {
        fe__heightfield_weights(s->field, index, point, out_weights);
        return;
    }
    fe_dvec3 v[3];
    fe__mesh_corners(s->mesh, index, v);
    fe_dvec3 a = fe__dsub(v[1], v[0]), b = fe__dsub(v[2], v[0]), p = fe__dsub(point, v[0]), n = fe__dcross(a, b);
    double per_square = 1.0 / fe__ddot(n, n);
    double second = fe__clampd(fe__ddot(fe__dcross(p, b), n) * per_square, 0.0, 1.0);
    double third = fe__clampd(fe__ddot(fe__dcross(a, p), n) * per_square, 0.0, 1.0 - second);
    int32_t is_mirrored = s->mesh->is_mirrored; // The weights belong to the asset's corners.
    out_weights[is_mirrored] = (float)second;
    out_weights[!is_mirrored] = (float)third;
}

// ---- questions at internal edges -----------------------------------------------------------------------------------
// A triangle that slopes less than this, 0.06 degrees, is flat.
#define FLAT 1e-3

// Is p over or under the triangle, or less than `near` beside it?
static int32_t is_over(const fe_dvec3 v[3], fe_dvec3 n, fe_dvec3 p, double near)
{
    for (int32_t k = 0; k < 3; ++k) {
        fe_dvec3 side = fe__dsub(v[(k + 1) % 3], v[k]), out = fe__dcross(side, n);
        if (fe__ddot(out, fe__dsub(p, v[k])) > near * sqrt(fe__ddot(side, side))) return 0;
    }
    return 1;
}

// Does the face rise over the triangle from its rim?
static int32_t is_under(const fe__ground *s, const fe_dvec3 v[3], fe_dvec3 n, const fe__solid_rim *rim)
{
    const double least = 1e-4; // above the rounding of a face that is a kilometre wide
    double up = fe__ddot(n, rim->inward);
    if (fe__ground_is_two_sided(s) && fe__ddot(n, fe__dsub(rim->from, v[0])) < 0.0) up = -up;
    return up > least;
}

// How far the triangle rises along m from p, which is near it, m: to its farthest point up its plane from p. 0: it is
// flat
static double length_of_rise(const fe_dvec3 v[3], fe_dvec3 p, fe_dvec3 m)
{
    fe_dvec3 n = normal_of(v), way = fe__dsub(m, fe__dscale(fe__ddot(n, m), n));
    double slope = sqrt(fe__ddot(way, way)), most = (double)INFINITY;
    if (slope < FLAT) return 0.0;
    for (int32_t k = 0; k < 3; ++k) {
        fe_dvec3 out = fe__dcross(fe__dsub(v[(k + 1) % 3], v[k]), n);
        double speed = fe__ddot(out, way), left = -fe__ddot(out, fe__dsub(p, v[k]));
        if (speed > 0.0) most = fe__mind(most, left / speed);
    }
    return most * slope;
}

// `rim` may be NULL: then all triangles count.
static int32_t rises(const fe__ground *s, fe_dvec3 p, fe_dvec3 m, double near, const fe__solid_rim *rim)
{
    fe__bounds box = {{p.x - near, p.y - near, p.z - near}, {p.x + near, p.y + near, p.z + near}};
    fe__ground_walk walk;
    fe__ground_begin(&walk, s, &box, p);
    for (int32_t i; (i = fe__ground_next_index(&walk)) >= 0;) {
        fe_dvec3 v[3];
        int32_t is_higher = 0, may_rise = 0;
        fe__ground_corners(s, i, v);
        for (int32_t k = 0; k < 3; ++k) {
            fe_dvec3 way = fe__dsub(v[k], p);
            double rise = fe__ddot(m, way);
            may_rise |= rise > FLAT * near;
            if (rise > near) is_higher |= rise > FLAT * sqrt(fe__ddot(way, way)) + near;
        }
        // The corners of a sliver may all be far off to the sides, so that none shows its rise.
        if (!is_higher && may_rise) is_higher = length_of_rise(v, p, m) > near;
        if (!is_higher) continue;
        fe_dvec3 n = normal_of(v);
        int32_t is_near = fe__absd(fe__ddot(n, fe__dsub(p, v[0]))) <= near && is_over(v, n, p, near);
        if (is_near && !(rim && is_under(s, v, n, rim))) return 1;
    }
    return 0;
}

int32_t fe__ground_rises(const fe__ground *s, fe_dvec3 p, fe_dvec3 m, double near)
{
    return rises(s, p, m, near, NULL);
}

int32_t fe__ground_rises_at(const fe__ground *s, const fe__solid_rim *rim, fe_dvec3 m, double near)
{
    return rises(s, rim->p, m, near, rim);
}

// Is a triangle level with any of the points? (ground.h)
static int32_t is_level(const fe__ground *s, const fe_dvec3 *p, int32_t count, fe_dvec3 f, double level, double beside)
{
    double margin = fe__maxd(level, beside);
    fe__bounds box = {p[0], p[0]};
    for (int32_t k = 1; k < count; ++k) fe__bounds_add(&box, &(fe__bounds){p[k], p[k]});
    box.low = (fe_dvec3){box.low.x - margin, box.low.y - margin, box.low.z - margin};
    box.high = (fe_dvec3){box.high.x + margin, box.high.y + margin, box.high.z + margin};
    fe__ground_walk walk;
    fe__ground_begin(&walk, s, &box, p[0]);
    for (int32_t i; (i = fe__ground_next_index(&walk)) >= 0;) {
        fe_dvec3 v[3];
        fe__ground_corners(s, i, v);
        fe_dvec3 n = normal_of(v);
        double cosine = fe__ddot(n, f);
        if (fe__ground_is_two_sided(s)) cosine = fe__absd(cosine);
        if (!(cosine > (double)FE__LEVEL_COS)) continue;
        for (int32_t k = 0; k < count; ++k)
            if (fe__absd(fe__ddot(n, fe__dsub(p[k], v[0]))) <= level && is_over(v, n, p[k], beside)) return 1;
    }
    return 0;
}

int32_t fe__ground_is_level_about(const fe__ground *s, fe_dvec3 p, fe_dvec3 f, double level, double beside)
{
    return is_level(s, &p, 1, f, level, beside);
}

int32_t fe__ground_is_level_at_any(const fe__ground *s, const fe_dvec3 *p, int32_t count, fe_dvec3 f)
{
    return is_level(s, p, count, f, (double)FE__LEVEL, 0.0);
}
