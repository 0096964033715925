// heightfield.h - a grid of heights: two triangles a cell, of which only the top side counts.
//
// The API and the snapshots fill a record, which is an asset of the store; narrow phase and queries read it, on any
// thread. Sample (row, column) stands at x = column * cell_x, z = row * cell_z, with its height along y, in the field's
// frame.
// Cell (row, column) lies between the samples (row, column) and (row + 1, column + 1), which its diagonal joins. Its
// triangles, 2 (row * (columns - 1) + column) + k:
//
//   row       p00 --- p01     k = 0: p00 p10 p11, where (z - row) >= (x - column), in cells
//              |  \  1 |      k = 1: p00 p11 p01
//              | 0  \  |      both turn left around their upper side
//   row + 1   p10 --- p11
#ifndef FE_COLLISION_FORM_HEIGHTFIELD_H
#define FE_COLLISION_FORM_HEIGHTFIELD_H
#include "collision/form/form.h"

enum {
    FE__CELL_HOLE = 255,                // A cell with this number is a hole; other numbers name a material.
    FE__FIELD_LINES = 32768,            // A field has at most so many rows, and so many columns.
    FE__FIELD_SAMPLES = 1 << 28,        // A field has at most so many samples.
    FE__FIELD_MATERIALS = FE__CELL_HOLE // A field has at most so many materials.
};

typedef struct fe__heightfield {
    int32_t rows, columns; // numbers of samples, >= 2
    double cell_x, cell_z; // m
    float *heights;        // rows x columns, m
    uint8_t *cells;        // (rows - 1) x (columns - 1), NULL: no holes and one material
    float (*ranges)[2];    // lowest and highest sample of each row
    float low, high;       // lowest and highest sample of the field
} fe__heightfield;

// The form of a shape with this heightfield; `index` is the index of its record.
fe__form fe__heightfield_form(const fe__heightfield *field, int32_t index);
// Finds ranges, low and high anew, after `rows` rows from `row` on got new heights.
void fe__heightfield_measure(fe__heightfield *field, int32_t row, int32_t rows);

static inline int32_t fe__heightfield_is_hole(const fe__heightfield *field, int32_t cell)
{
    return field->cells && field->cells[cell] == FE__CELL_HOLE;
}

// Weights of the triangle's second and third vertex at a point of it, in the field's frame.
void fe__heightfield_weights(const fe__heightfield *field, int32_t triangle, fe_dvec3 point, float *out_weights);
// The triangle with its vertices relative to `origin` (field's frame), so that floats hold it exactly enough wherever
// it is.
fe__form fe__heightfield_triangle(const fe__heightfield *field, int32_t triangle, fe_dvec3 origin);
// The triangle's vertices in the field's frame.
void fe__heightfield_corners(const fe__heightfield *field, int32_t triangle, fe_dvec3 corner[3]);
// The unit normal of the triangle's upper side.
fe_dvec3 fe__heightfield_normal(const fe__heightfield *field, int32_t triangle);

// Walks over the triangles of the cells that a box meets in x and z, and in height by the lowest and the highest corner
// of the cell: by row, column, k. Holes are left out. All is in the field's frame; the box may reach anywhere.
//
//   fe__triangle_walk walk = fe__heightfield_walk(field, &box, origin);
//   for (int32_t i; (i = fe__next_triangle(&walk, &triangle)) >= 0;) ...
typedef struct fe__triangle_walk {
    const fe__heightfield *field;
    fe_dvec3 origin;
    double low, high; // bounds of the box along y
    int32_t first_column, end_column, end_row;
    int32_t row, column, half; // the next triangle
} fe__triangle_walk;

fe__triangle_walk fe__heightfield_walk(const fe__heightfield *field, const fe__bounds *box, fe_dvec3 origin);
// Returns the index of the next triangle, whose vertices are relative to the walk's origin; -1: no more
int32_t fe__next_triangle(fe__triangle_walk *walk, fe__form *triangle);

// Casts a ray as fe__form_ray does; 1: hit. The ray hits from above only. There is no inside: a ray that begins below
// the surface hits nothing before it has come out.
int32_t fe__heightfield_ray(const fe__heightfield *field, fe_dvec3 origin, fe_dvec3 translation, double limit,
                            fe__ray_hit *hit);

#endif
