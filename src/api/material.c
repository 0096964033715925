// material.c - the API of materials.
#include "api/check.h"

void fe_material_init(fe_material *material)
{
    if (material) *material = fe__default_material();
}
