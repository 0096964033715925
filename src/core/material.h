// material.h - the material of what says nothing of its own.
#ifndef FE_CORE_MATERIAL_H
#define FE_CORE_MATERIAL_H
#include "feather.h"

static inline fe_material fe__default_material(void)
{
    return (fe_material){.static_friction = 0.6f, .dynamic_friction = 0.5f};
}

#endif
