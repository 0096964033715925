// Widths of the rows of numbers that bulk functions of feather.h fill.
#ifndef FE_BINDINGS_ROWS_H
#define FE_BINDINGS_ROWS_H

#include <string.h>

/// Floats in a row of a function that fills `out_floats`
static inline int floats_of(const char *function)
{
    if (strstr(function, "transforms_f32")) return 7;
    return strstr(function, "joint_coordinates") ? 2 : 6;
}

#endif
