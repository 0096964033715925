// cooked.c - refusals, single numbers, materials and heightfields as bytes; see cooked.h.
#include "collision/cooked/cooked.h"

#include "core/bytes.h"

#include <stdarg.h>
#include <stdio.h>

// ---- refusals and numbers -------------------------------------------------------------------------------------------
int32_t fe__cooked_refuse(fe__cooked *c, const unsigned char *at, const char *format, ...)
{
    c->result = FE_ERROR_DATA;
    int used = snprintf(c->sentence, sizeof c->sentence, "at byte %lld: ", (long long)(at - c->begin));
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(c->sentence + used, sizeof c->sentence - (size_t)used, format, arguments);
    va_end(arguments);
    return 0;
}

int32_t fe__cooked_int(fe__cooked *c, const char *name, int32_t low, int32_t high, int32_t *out)
{
    const unsigned char *at = c->at;
    *out = fe__take_i32(&c->at);
    if (*out >= low && *out <= high) return 1;
    return fe__cooked_refuse(c, at, "%s is %d, must be %d..%d", name, (int)*out, (int)low, (int)high);
}

int32_t fe__cooked_float(fe__cooked *c, const char *name, float low, float high, float *out)
{
    const unsigned char *at = c->at;
    *out = fe__take_float(&c->at);
    if (*out >= low && *out <= high) return 1; // A NaN is refused, too.
    return fe__cooked_refuse(c, at, "%s is %.9g, must be %.9g..%.9g", name, (double)*out, (double)low, (double)high);
}

// ---- materials ------------------------------------------------------------------------------------------------------

unsigned char *fe__cooked_material_write(const fe_material *m, unsigned char *out)
{
    out = fe__put_float(fe__put_float(out, m->static_friction), m->dynamic_friction);
    out = fe__put_float(out, m->restitution);
    out = fe__put_float(fe__put_float(out, m->rolling_resistance), m->spinning_resistance);
    out = fe__put_i32(fe__put_i32(out, m->friction_combine), m->restitution_combine);
    for (int32_t k = 0; k < 3; ++k) out = fe__put_u32(out, m->reserved[k]);
    return fe__put_u64(out, m->user_id);
}

static int32_t read_fields(fe__cooked *c, fe_material *out)
{
    int32_t reserved;
    if (!fe__cooked_float(c, "static_friction", 0.0f, FE_MAX_VALUE, &out->static_friction) ||
        !fe__cooked_float(c, "dynamic_friction", 0.0f, FE_MAX_VALUE, &out->dynamic_friction) ||
        !fe__cooked_float(c, "restitution", 0.0f, 1.0f, &out->restitution) ||
        !fe__cooked_float(c, "rolling_resistance", 0.0f, FE_MAX_VALUE, &out->rolling_resistance) ||
        !fe__cooked_float(c, "spinning_resistance", 0.0f, FE_MAX_VALUE, &out->spinning_resistance) ||
        !fe__cooked_int(c, "friction_combine", FE_COMBINE_DEFAULT, FE_COMBINE_MAXIMUM, &out->friction_combine) ||
        !fe__cooked_int(c, "restitution_combine", FE_COMBINE_DEFAULT, FE_COMBINE_MAXIMUM, &out->restitution_combine))
        return 0;
    for (int32_t k = 0; k < 3; ++k)
        if (!fe__cooked_int(c, "reserved", 0, 0, &reserved)) return 0;
    out->user_id = fe__take_u64(&c->at);
    return 1;
}

int32_t fe__cooked_material_read(fe__cooked *c, int32_t index, fe_material *out)
{
    *out = (fe_material){0};
    if (read_fields(c, out)) return 1;
    // The sentence names the material, too.
    char why[FE__COOKED_SENTENCE];
    memcpy(why, c->sentence, sizeof why);
    snprintf(c->sentence, sizeof c->sentence, "material %d, %.120s", (int)index, why);
    return 0;
}

// ---- heightfields ---------------------------------------------------------------------------------------------------

static int64_t sample_count(const fe__heightfield *f) { return (int64_t)f->rows * f->columns; }
static int64_t cell_count(const fe__heightfield *f) { return (int64_t)(f->rows - 1) * (f->columns - 1); }

int64_t fe__cooked_field_size(const fe__heightfield *f)
{
    return FE__COOKED_FIELD_COUNTS + 4 * sample_count(f) + (f->cells ? cell_count(f) : 0);
}

unsigned char *fe__cooked_field_write(const fe__heightfield *f, unsigned char *out)
{
    out = fe__put_i32(fe__put_i32(out, f->rows), f->columns);
    out = fe__put_float(fe__put_float(out, (float)f->cell_x), (float)f->cell_z); // The caller gave them as floats.
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

int32_t fe__cooked_field_read(fe__cooked *c, fe__heightfield *f, int32_t material_count)
{
    for (int64_t i = 0; i < sample_count(f); ++i) {
        const unsigned char *at = c->at;
        float height = f->heights[i] = fe__take_float(&c->at);
        if (height >= -FE_MAX_LOCAL && height <= FE_MAX_LOCAL) continue;
        return fe__cooked_refuse(c, at, "height %lld is %.9g, must be %.9g..%.9g", (long long)i, (double)height,
                                 (double)-FE_MAX_LOCAL, (double)FE_MAX_LOCAL);
    }
    fe__heightfield_measure(f, 0, f->rows);
    if (!f->cells) return 1;
    int32_t most = material_count ? material_count : 1; // An asset without materials has number 0 alone: the shape's.
    const unsigned char *start = c->at;
    fe__take_bytes(&c->at, f->cells, cell_count(f));
    for (int64_t i = 0; i < cell_count(f); ++i) {
        if (f->cells[i] < most || f->cells[i] == FE__CELL_HOLE) continue;
        return fe__cooked_refuse(c, start + i, "cell %lld has material %d of %d", (long long)i, f->cells[i],
                                 (int)material_count);
    }
    return 1;
}
