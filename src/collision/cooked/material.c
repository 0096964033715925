// material.c - materials as bytes; see cooked.h.
#include "collision/cooked/cooked.h"
#include "core/ranges.h"

#include <stdio.h>

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
    char why[FE__COOKED_SENTENCE];
    memcpy(why, c->sentence, sizeof why);
    snprintf(c->sentence, sizeof c->sentence, "material %d, %.120s", (int)index, why);
    return 0;
}
