// heightfield.c - triangles of a heightfield, a walk over the triangles near a box, and a ray; see heightfield.h.
#include "collision/form/heightfield.h"

#include "collision/form/form_kinds.h"

static float height_of(const fe__heightfield *f, int32_t row, int32_t column)
{
    return f->heights[(int64_t)row * f->columns + column];
}

void fe__heightfield_measure(fe__heightfield *f, int32_t row, int32_t rows)
{
    for (int32_t r = row; r < row + rows; ++r) {
        const float *h = f->heights + (int64_t)r * f->columns;
        float low = h[0], high = h[0];
        for (int32_t c = 1; c < f->columns; ++c) low = fe__minf(low, h[c]), high = fe__maxf(high, h[c]);
        f->ranges[r][0] = low, f->ranges[r][1] = high;
    }
    f->low = f->ranges[0][0], f->high = f->ranges[0][1];
    for (int32_t r = 1; r < f->rows; ++r)
        f->low = fe__minf(f->low, f->ranges[r][0]), f->high = fe__maxf(f->high, f->ranges[r][1]);
}

// The far corner is rounded outwards.
fe__form fe__heightfield_form(const fe__heightfield *f, int32_t index)
{
    const double up = 1.0 + 1e-7;
    float x = (float)(up * (double)(f->columns - 1) * f->cell_x), z = (float)(up * (double)(f->rows - 1) * f->cell_z);
    fe_vec3 low = {0.0f, f->low, 0.0f}, high = {x, f->high, z};
    return (fe__form){.type = FE__FORM_HEIGHTFIELD, .field = index, .low = low, .high = high};
}

// The bounds of the form's own bounding box, rotated.
fe__bounds fe__heightfield_bounds(const fe__form *form, const fe__pose *pose)
{
    fe_dvec3 low = fe__widen(form->low), high = fe__widen(form->high), half = fe__dscale(0.5, fe__dsub(high, low));
    fe_dvec3 centre = fe__dadd(pose->position, fe__drotate(pose->rotation, fe__dscale(0.5, fe__dadd(low, high))));
    half = fe__rotated_widths(pose->rotation, half);
    return (fe__bounds){fe__dsub(centre, half), fe__dadd(centre, half)};
}

static fe_dvec3 sample_of(const fe__heightfield *f, int32_t row, int32_t column)
{
    return (fe_dvec3){(double)column * f->cell_x, (double)height_of(f, row, column), (double)row * f->cell_z};
}

static fe__form triangle_of(const fe__heightfield *f, int32_t row, int32_t column, int32_t half, fe_dvec3 origin)
{
    fe_dvec3 p00 = sample_of(f, row, column), p11 = sample_of(f, row + 1, column + 1),
             side = half ? sample_of(f, row, column + 1) : sample_of(f, row + 1, column);
    fe__form triangle = {.type = FE__FORM_TRIANGLE};
    triangle.vertex[0] = fe__narrow(fe__dsub(p00, origin));
    triangle.vertex[1] = fe__narrow(fe__dsub(half ? p11 : side, origin));
    triangle.vertex[2] = fe__narrow(fe__dsub(half ? side : p11, origin));
    return triangle;
}

// In a cell u runs along x and v along z, both 0..1. Half 0 has the corners (0,0) (0,1) (1,1), half 1 (0,0) (1,1)
// (1,0).
void fe__heightfield_weights(const fe__heightfield *f, int32_t triangle, fe_dvec3 point, float *out_weights)
{
    int32_t cell = triangle / 2, row = cell / (f->columns - 1), column = cell % (f->columns - 1);
    double u = fe__clampd(point.x / f->cell_x - (double)column, 0.0, 1.0),
           v = fe__clampd(point.z / f->cell_z - (double)row, 0.0, 1.0);
    double second = triangle % 2 ? v : fe__maxd(v - u, 0.0), third = triangle % 2 ? fe__maxd(u - v, 0.0) : u;
    out_weights[0] = (float)second;
    out_weights[1] = (float)third;
}

fe__form fe__heightfield_triangle(const fe__heightfield *f, int32_t triangle, fe_dvec3 origin)
{
    int32_t cell = triangle >> 1;
    return triangle_of(f, cell / (f->columns - 1), cell % (f->columns - 1), triangle & 1, origin);
}

void fe__heightfield_corners(const fe__heightfield *f, int32_t triangle, fe_dvec3 corner[3])
{
    int32_t cell = triangle >> 1, row = cell / (f->columns - 1), column = cell % (f->columns - 1), half = triangle & 1;
    corner[0] = sample_of(f, row, column);
    corner[1] = half ? sample_of(f, row + 1, column + 1) : sample_of(f, row + 1, column);
    corner[2] = half ? sample_of(f, row, column + 1) : sample_of(f, row + 1, column + 1);
}

fe_dvec3 fe__heightfield_normal(const fe__heightfield *f, int32_t triangle)
{
    int32_t cell = triangle >> 1, row = cell / (f->columns - 1), column = cell % (f->columns - 1), half = triangle & 1;
    double h00 = (double)height_of(f, row, column), h11 = (double)height_of(f, row + 1, column + 1);
    double side = (double)(half ? height_of(f, row, column + 1) : height_of(f, row + 1, column));
    double rise_x = (half ? side - h00 : h11 - side) * f->cell_z, rise_z = (half ? h11 - side : side - h00) * f->cell_x,
           area = f->cell_x * f->cell_z;
    double k = 1.0 / sqrt(area * area + rise_x * rise_x + rise_z * rise_z);
    return (fe_dvec3){-k * rise_x, k * area, -k * rise_z};
}

// ---- the walk ------------------------------------------------------------------------------------------------------
// The number of the cell, of `count`, in which a coordinate (in cells) lies; the nearest one if it is outside.
static int32_t cell_of(double x, int32_t count)
{
    double last = (double)(count - 1);
    return x > 0.0 ? (int32_t)fe__mind(x, last) : 0;
}

fe__triangle_walk fe__heightfield_walk(const fe__heightfield *f, const fe__bounds *box, fe_dvec3 origin)
{
    int32_t columns = f->columns - 1, rows = f->rows - 1;
    double x0 = box->low.x / f->cell_x, x1 = box->high.x / f->cell_x, z0 = box->low.z / f->cell_z,
           z1 = box->high.z / f->cell_z;
    fe__triangle_walk walk = {.field = f, .origin = origin, .low = box->low.y, .high = box->high.y};
    if (!(x1 >= 0.0 && x0 <= (double)columns && z1 >= 0.0 && z0 <= (double)rows))
        return walk; // The walk is empty: row == end_row.
    walk.first_column = walk.column = cell_of(x0, columns);
    walk.end_column = cell_of(x1, columns) + 1;
    walk.row = cell_of(z0, rows);
    walk.end_row = cell_of(z1, rows) + 1;
    return walk;
}

static int32_t cell_meets(const fe__triangle_walk *walk)
{
    const fe__heightfield *f = walk->field;
    if (fe__heightfield_is_hole(f, walk->row * (f->columns - 1) + walk->column)) return 0;
    const float *h = f->heights + (int64_t)walk->row * f->columns + walk->column, *below = h + f->columns;
    float low = fe__minf(fe__minf(h[0], h[1]), fe__minf(below[0], below[1])),
          high = fe__maxf(fe__maxf(h[0], h[1]), fe__maxf(below[0], below[1]));
    return (double)low <= walk->high && (double)high >= walk->low;
}

int32_t fe__next_triangle(fe__triangle_walk *walk, fe__form *triangle)
{
    for (; walk->row < walk->end_row; ++walk->row, walk->column = walk->first_column) {
        for (; walk->column < walk->end_column; ++walk->column, walk->half = 0) {
            if (walk->half > 1 || (!walk->half && !cell_meets(walk))) continue;
            *triangle = triangle_of(walk->field, walk->row, walk->column, walk->half, walk->origin);
            return 2 * (walk->row * (walk->field->columns - 1) + walk->column) + walk->half++;
        }
    }
    return -1;
}

// ---- the ray -------------------------------------------------------------------------------------------------------
// The ray walks from cell to cell (Amanatides and Woo, A Fast Voxel Traversal Algorithm for Ray Tracing, 1987). Its
// height over the surface, g, is linear between borders and diagonals. Each g there belongs to both neighbours, so that
// no ray slips through an edge.
typedef struct traverse {
    const fe__heightfield *field;
    fe_dvec3 origin, way; // x and z in cells
    double t, end;
    int32_t row, column;
    int32_t g_is_known; // 0: the ray passed over all corners of the last cell, so that g > 0
    double g;           // height at t
} traverse;

// The height g of the ray at t over the plane of a triangle of the cell. Both halves agree on the diagonal, and
// neighbours on their border.
static double height_over(const traverse *r, double t, int32_t half)
{
    const float *h = r->field->heights + (int64_t)r->row * r->field->columns + r->column, *next = h + r->field->columns;
    double u = r->origin.x + t * r->way.x - (double)r->column, v = r->origin.z + t * r->way.z - (double)r->row;
    double h00 = (double)h[0], h11 = (double)next[1], side = (double)(half ? h[1] : next[0]);
    double ground = half ? h00 + u * (side - h00) + v * (h11 - side) : h00 + v * (side - h00) + u * (h11 - side);
    return r->origin.y + t * r->way.y - ground;
}

// Goes over one triangle, from r->t with the height r->g to `to` with the height `g`. 1: hit
static int32_t cross_triangle(traverse *r, double to, double g, int32_t half, fe__ray_hit *hit)
{
    double from = r->t, before = r->g;
    r->t = to, r->g = g;
    if (!(before >= 0.0 && g <= 0.0) || before == g) return 0;
    int32_t cell = r->row * (r->field->columns - 1) + r->column;
    if (fe__heightfield_is_hole(r->field, cell)) return 0;
    int32_t number = 2 * cell + half;
    *hit = (fe__ray_hit){.t = from + (to - from) * (before / (before - g)), .triangle = number, .index = number};
    hit->normal = fe__heightfield_normal(r->field, hit->triangle);
    // At a corner, or along the surface, rounding makes the signs of g.
    fe_dvec3 n = hit->normal, way = {r->way.x * r->field->cell_x, r->way.y, r->way.z * r->field->cell_z};
    return fe__ddot(n, way) < 0.0;
}

// Goes from r->t to `to` within a cell. The sign of u - v tells the side of the diagonal. 1: hit
static int32_t cross_cell(traverse *r, double to, fe__ray_hit *hit)
{
    double offset = (r->origin.x - (double)r->column) - (r->origin.z - (double)r->row), rate = r->way.x - r->way.z;
    double side = offset + r->t * rate, side_after = offset + to * rate;
    int32_t half = side > 0.0 || (side == 0.0 && side_after > 0.0);
    if (!r->g_is_known) r->g = fe__maxd(height_over(r, r->t, half), 0.0), r->g_is_known = 1;
    if ((side > 0.0 && side_after < 0.0) || (side < 0.0 && side_after > 0.0)) {
        double middle = fe__mind(r->t + (to - r->t) * (side / (side - side_after)), to);
        if (cross_triangle(r, middle, height_over(r, middle, half), half, hit)) return 1;
        half = !half;
    }
    return cross_triangle(r, to, height_over(r, to, half), half, hit);
}

// A ray that moves less than this along an axis does not move along it, m.
#define STILL 1e-200

static double inverse(double way) { return fe__absd(way) < STILL ? 0.0 : 1.0 / way; }

// The part of the ray over the field, no farther above or below the heights than a cell. `per` is 1 / way, or 0 along
// an axis on which the ray does not move.
static int32_t clip(const fe__heightfield *f, fe_dvec3 o, fe_dvec3 per, double limit, double *from, double *to)
{
    // The last term is far above rounding.
    double spare = f->cell_x + f->cell_z + 1e-6 * (fe__absd((double)f->low) + fe__absd((double)f->high));
    const double low[3] = {0.0, (double)f->low - spare, 0.0}, origin[3] = {o.x, o.y, o.z},
                 slope[3] = {per.x, per.y, per.z};
    const double high[3] = {(double)(f->columns - 1) * f->cell_x, (double)f->high + spare,
                            (double)(f->rows - 1) * f->cell_z};
    double enter = 0.0, leave = limit;
    for (int32_t k = 0; k < 3; ++k) {
        if (slope[k] == 0.0) {
            if (origin[k] < low[k] || origin[k] > high[k]) return 0;
            continue;
        }
        double a = (low[k] - origin[k]) * slope[k], b = (high[k] - origin[k]) * slope[k];
        enter = fe__maxd(enter, fe__mind(a, b));
        leave = fe__mind(leave, fe__maxd(a, b));
    }
    *from = enter, *to = leave;
    return enter <= leave;
}

int32_t fe__heightfield_ray(const fe__heightfield *f, fe_dvec3 origin, fe_dvec3 translation, double limit,
                            fe__ray_hit *hit)
{
    traverse r = {.field = f};
    fe_dvec3 per = {inverse(translation.x), inverse(translation.y), inverse(translation.z)};
    // The clip is not by the limit: the last bit of t would depend on it.
    if (!clip(f, origin, per, 1.0, &r.t, &r.end)) return 0;
    r.origin = (fe_dvec3){origin.x / f->cell_x, origin.y, origin.z / f->cell_z};
    r.way = (fe_dvec3){translation.x / f->cell_x, translation.y, translation.z / f->cell_z};
    r.column = cell_of(r.origin.x + r.t * r.way.x, f->columns - 1);
    r.row = cell_of(r.origin.z + r.t * r.way.z, f->rows - 1);
    double side = (r.origin.x + r.t * r.way.x - (double)r.column) - (r.origin.z + r.t * r.way.z - (double)r.row);
    r.g = height_over(&r, r.t, side > 0.0), r.g_is_known = 1;

    int32_t step_x = r.way.x < 0.0 ? -1 : 1, step_z = r.way.z < 0.0 ? -1 : 1;
    const double never = (double)INFINITY;
    double per_x = per.x * f->cell_x, per_z = per.z * f->cell_z;
    double t_x = per_x == 0.0 ? never : ((double)(r.column + (step_x > 0)) - r.origin.x) * per_x;
    double t_z = per_z == 0.0 ? never : ((double)(r.row + (step_z > 0)) - r.origin.z) * per_z;
    for (;;) {
        const float *h = f->heights + (int64_t)r.row * f->columns + r.column, *next = h + f->columns;
        float top = fe__maxf(fe__maxf(h[0], h[1]), fe__maxf(next[0], next[1]));
        double to = fe__maxd(fe__mind(fe__mind(t_x, t_z), r.end), r.t);
        if (fe__mind(r.origin.y + r.t * r.way.y, r.origin.y + to * r.way.y) > (double)top)
            r.t = to, r.g_is_known = 0; // The ray passes over all four corners.
        else if (cross_cell(&r, to, hit))
            return hit->t <= limit;
        if (to >= r.end || to > limit) return 0;
        if (t_x <= t_z) {
            r.column += step_x;
            if (r.column < 0 || r.column >= f->columns - 1) return 0;
            t_x = ((double)(r.column + (step_x > 0)) - r.origin.x) * per_x;
        } else {
            r.row += step_z;
            if (r.row < 0 || r.row >= f->rows - 1) return 0;
            t_z = ((double)(r.row + (step_z > 0)) - r.origin.z) * per_z;
        }
    }
}
