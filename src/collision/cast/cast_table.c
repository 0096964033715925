// cast_table.c - the table of casts: ray, nearest point and core of every kind of form. Heightfields and meshes have
// functions of their own (heightfield.h, mesh_ray.h, cast_kinds.h, sweep.h), and so has a plane that a form moves
// against (sweep.c).
#include "collision/cast/approach.h"
#include "collision/cast/cast_kinds.h"

const fe__cast_traits fe__casts[FE__FORM_TYPES] = {
    [FE__FORM_SPHERE] = {fe__ray_sphere, fe__nearest_on_sphere, FE_CORE_POINT},
    [FE__FORM_CAPSULE] = {fe__ray_capsule, fe__nearest_on_capsule, FE_CORE_SEGMENT},
    [FE__FORM_BOX] = {fe__ray_box, fe__nearest_on_box, FE_CORE_BOX},
    [FE__FORM_CYLINDER] = {fe__ray_cylinder, fe__nearest_on_cylinder, FE_CORE_CURVED},
    [FE__FORM_CONE] = {fe__ray_cone, fe__nearest_on_cone, FE_CORE_CURVED},
    [FE__FORM_HULL] = {fe__ray_hull, fe__nearest_on_hull, FE_CORE_CURVED},
    [FE__FORM_PLANE] = {fe__ray_plane, fe__nearest_on_plane, FE_CORE_POINT},
    [FE__FORM_TRIANGLE] = {fe__ray_triangle, NULL, FE_CORE_TRIANGLE},
};
