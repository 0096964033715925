// heightfield.h - a grid of heights: two triangles a cell, of which only the top side counts.
//
// Sample (row, column) stands at x = column * cell_x, z = row * cell_z, with its height along y, in the field's frame.
// Cell (row, column) lies between the samples (row, column) and (row + 1, column + 1), which its diagonal joins. Its
// triangles, 2 (row * (columns - 1) + column) + k:
//
//   row       p00 --- p01     k = 0: p00 p10 p11, where (z - row) >= (x - column), in cells
//              |  \  1 |      k = 1: p00 p11 p01
//              | 0  \  |      both turn left around their upper side
//   row + 1   p10 --- p11
//
// A store owns the records; narrow phase and queries read them, on any thread.
#ifndef FE_COLLISION_FORM_HEIGHTFIELD_H
#define FE_COLLISION_FORM_HEIGHTFIELD_H
#include "collision/form/form.h"

enum {
    FE__CELL_HOLE = 255,         // in fe__heightfield.cells; else the index of a material
    FE__FIELD_LINES = 32768,     // rows, or columns, at most
    FE__FIELD_SAMPLES = 1 << 28, // likewise
    FE__FIELD_MATERIALS = FE__CELL_HOLE
};

typedef struct fe__heightfield {
    int32_t rows, columns; // of samples, >= 2
    double cell_x, cell_z; // m
    float *heights;        // rows x columns, m
    uint8_t *cells;        // (rows - 1) x (columns - 1), NULL: no holes and one material
    float (*ranges)[2];    // lowest and highest sample of each row
    float low, high;       // of all
} fe__heightfield;

// The form of a shape that has it; `index` is its record's.
fe__form fe__heightfield_form(const fe__heightfield *field, int32_t index);
void fe__heightfield_measure(fe__heightfield *field, int32_t row,
                             int32_t rows); // after rows got new heights: ranges, low, high

static inline int32_t fe__heightfield_is_hole(const fe__heightfield *field, int32_t cell)
{
    return field->cells && field->cells[cell] == FE__CELL_HOLE;
}

// The triangle with its vertices relative to `origin` (field's frame), so that floats hold it exactly enough wherever
// it is. Weights of the triangle's second and third vertex at a point of it, in the field's frame
void fe__heightfield_weights(const fe__heightfield *field, int32_t triangle, fe_dvec3 point, float *out_weights);
fe__form fe__heightfield_triangle(const fe__heightfield *field, int32_t triangle, fe_dvec3 origin);
// Its vertices as they are, in the field's frame.
void fe__heightfield_corners(const fe__heightfield *field, int32_t triangle, fe_dvec3 corner[3]);
// Unit normal of its upper side.
fe_dvec3 fe__heightfield_normal(const fe__heightfield *field, int32_t triangle);

// The triangles over or under the x and z of a box whose cell's heights meet the box: by row, column, k. Holes are left
// out. All in the field's frame; the box may reach anywhere.
//
//   fe__triangle_walk walk = fe__heightfield_walk(field, &box, origin);
//   for (int32_t i; (i = fe__next_triangle(&walk, &triangle)) >= 0;) ...
typedef struct fe__triangle_walk {
    const fe__heightfield *field;
    fe_dvec3 origin;
    double low, high; // of the box, along y
    int32_t first_column, end_column, end_row;
    int32_t row, column, half; // next
} fe__triangle_walk;

fe__triangle_walk fe__heightfield_walk(const fe__heightfield *field, const fe__bounds *box, fe_dvec3 origin);
// Index of the next triangle, its vertices relative to the walk's origin; -1: no more.
int32_t fe__next_triangle(fe__triangle_walk *walk, fe__form *triangle);

// A ray from above the surface through it, as fe__form_ray; 1: hit. There is no inside: a start below the surface hits
// nothing before it came out.
int32_t fe__heightfield_ray(const fe__heightfield *field, fe_dvec3 origin, fe_dvec3 translation, double limit,
                            fe__ray_hit *hit);

#endif
