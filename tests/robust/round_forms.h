// round_forms.h - the forms with something round, by number, for tests that draw forms.
#ifndef ROUND_FORMS_H
#define ROUND_FORMS_H
#include "feather.h"

enum { ROUND_FORMS = 4 };

// About as large as a ball of radius r
static inline fe_geometry round_form(int32_t number, float r)
{
    fe_geometry g;
    switch (number) {
    case 1:
        fe_geometry_capsule(&g, r, 0.7f * r);
        break;
    case 2:
        fe_geometry_cylinder(&g, r, r);
        break;
    case 3:
        fe_geometry_cone(&g, 2.0f * r, r);
        break;
    default:
        fe_geometry_sphere(&g, r);
    }
    return g;
}

#endif
