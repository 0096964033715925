// cooked.c - refusals and single numbers; see cooked.h.
#include "collision/cooked/cooked.h"

#include <stdarg.h>
#include <stdio.h>

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
    if (*out >= low && *out <= high) return 1; // no NaN
    return fe__cooked_refuse(c, at, "%s is %.9g, must be %.9g..%.9g", name, (double)*out, (double)low, (double)high);
}
