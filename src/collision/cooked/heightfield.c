// heightfield.c - heightfields as bytes; see cooked.h.
#include "collision/cooked/cooked.h"
#include "core/ranges.h"

static int64_t sample_count(const fe__heightfield *f) { return (int64_t)f->rows * f->columns; }
static int64_t cell_count(const fe__heightfield *f) { return (int64_t)(f->rows - 1) * (f->columns - 1); }

int64_t fe__cooked_field_size(const fe__heightfield *f)
{
    return FE__COOKED_FIELD_COUNTS + 4 * sample_count(f) + (f->cells ? cell_count(f) : 0);
}

unsigned char *fe__cooked_field_write(const fe__heightfield *f, unsigned char *out)
{
    out = fe__put_i32(fe__put_i32(out, f->rows), f->columns);
    out = fe__put_float(fe__put_float(out, (float)f->cell_x), (float)f->cell_z); // as which they were given
    for (int64_t i = 0; i < sample_count(f); ++i) out = fe__put_float(out, f->heights[i]);
    return f->cells ? fe__put_bytes(out, f->cells, cell_count(f)) : out;
}

int32_t fe__cooked_field_counts(fe__cooked *c, fe__heightfield *f)
{
    const unsigned char *start = c->at;
    float cell_x, cell_z;
    if (!fe__cooked_int(c, "rows", 2, FE__FIELD_LINES, &f->rows) ||
        !fe__cooked_int(c, "columns", 2, FE__FIELD_LINES, &f->columns) ||
        !fe__cooked_float(c, "cell_x", FE_LEAST_LENGTH, FE_MAX_LENGTH, &cell_x) ||
        !fe__cooked_float(c, "cell_z", FE_LEAST_LENGTH, FE_MAX_LENGTH, &cell_z))
        return 0;
    if (sample_count(f) > FE__FIELD_SAMPLES)
        return fe__cooked_refuse(c, start, "%d rows of %d columns are too many", (int)f->rows, (int)f->columns);
    if ((float)(f->columns - 1) * cell_x > FE_MAX_LOCAL || (float)(f->rows - 1) * cell_z > FE_MAX_LOCAL)
        return fe__cooked_refuse(c, start, "the field is wider than %.9g m", (double)FE_MAX_LOCAL);
    f->cell_x = (double)cell_x, f->cell_z = (double)cell_z;
    return 1;
}

static int32_t read_heights(fe__cooked *c, fe__heightfield *f)
{
    for (int64_t i = 0; i < sample_count(f); ++i) {
        const unsigned char *at = c->at;
        float height = f->heights[i] = fe__take_float(&c->at);
        if (height >= -FE_MAX_LOCAL && height <= FE_MAX_LOCAL) continue;
        return fe__cooked_refuse(c, at, "height %lld is %.9g, must be %.9g..%.9g", (long long)i, (double)height,
                                 (double)-FE_MAX_LOCAL, (double)FE_MAX_LOCAL);
    }
    return 1;
}

static int32_t read_cells(fe__cooked *c, fe__heightfield *f, int32_t material_count)
{
    int32_t most = material_count ? material_count : 1; // 0: the shape's material
    const unsigned char *start = c->at;
    fe__take_bytes(&c->at, f->cells, cell_count(f));
    for (int64_t i = 0; i < cell_count(f); ++i) {
        if (f->cells[i] < most || f->cells[i] == FE__CELL_HOLE) continue;
        return fe__cooked_refuse(c, start + i, "cell %lld has material %d of %d", (long long)i, f->cells[i],
                                 (int)material_count);
    }
    return 1;
}

int32_t fe__cooked_field_read(fe__cooked *c, fe__heightfield *f, int32_t material_count)
{
    if (!read_heights(c, f)) return 0;
    fe__heightfield_measure(f, 0, f->rows);
    return !f->cells || read_cells(c, f, material_count);
}
