// form_kinds.h - the functions that each kind of form puts into the table of traits (form.h, form_table.c).
#ifndef FE_COLLISION_FORM_FORM_KINDS_H
#define FE_COLLISION_FORM_FORM_KINDS_H
#include "collision/form/form.h"

// sphere (round.c)
fe__mass fe__sphere_mass(const fe__form *form, double density);
fe__bounds fe__sphere_bounds(const fe__form *form, const fe__pose *pose);

// capsule (round.c)
fe__mass fe__capsule_mass(const fe__form *form, double density);
fe_dvec3 fe__capsule_support(const fe__form *form, fe_dvec3 direction);
void fe__capsule_face(const fe__form *form, fe_vec3 direction, fe__face *face);

// box (flat.c)
fe__mass fe__box_mass(const fe__form *form, double density);
float fe__box_thickness(const fe__form *form);
fe__form fe__box_shrunk(const fe__form *form, float by);
fe_dvec3 fe__box_support(const fe__form *form, fe_dvec3 direction);
void fe__box_face(const fe__form *form, fe_vec3 direction, fe__face *face);

// cylinder (round.c)
fe__mass fe__cylinder_mass(const fe__form *form, double density);
fe__bounds fe__cylinder_bounds(const fe__form *form, const fe__pose *pose);
float fe__cylinder_reach(const fe__form *form, fe_vec3 centre);
float fe__cylinder_thickness(const fe__form *form);
fe_dvec3 fe__cylinder_support(const fe__form *form, fe_dvec3 direction);
void fe__cylinder_face(const fe__form *form, fe_vec3 direction, fe__face *face);

// cone (round.c)
fe__mass fe__cone_mass(const fe__form *form, double density);
fe__bounds fe__cone_bounds(const fe__form *form, const fe__pose *pose);
float fe__cone_reach(const fe__form *form, fe_vec3 centre);
float fe__cone_thickness(const fe__form *form);
fe__form fe__cone_shrunk(const fe__form *form, float by);
fe_dvec3 fe__cone_support(const fe__form *form, fe_dvec3 direction);
void fe__cone_face(const fe__form *form, fe_vec3 direction, fe__face *face);

// hull (hull.c)
fe__mass fe__hull_form_mass(const fe__form *form, double density);
fe__bounds fe__hull_form_bounds(const fe__form *form, const fe__pose *pose);
float fe__hull_form_reach(const fe__form *form, fe_vec3 centre);
float fe__hull_form_thickness(const fe__form *form);
fe__form fe__hull_form_shrunk(const fe__form *form, float by);
fe_dvec3 fe__hull_form_support(const fe__form *form, fe_dvec3 direction);
void fe__hull_form_face(const fe__form *form, fe_vec3 direction, fe__face *face);

// circle of a cylinder or a cone about the y axis, at height y (round.c)
fe_dvec3 fe__rim_support(float radius, double y, fe_dvec3 direction);
void fe__rim_face(float radius, float y, fe_vec3 direction, fe__face *face);

// plane (flat.c)
fe__bounds fe__plane_bounds(const fe__form *form, const fe__pose *pose);

// Meshes and compounds have the heightfield's bounds (heightfield.c): those of low and high.
fe__bounds fe__heightfield_bounds(const fe__form *form, const fe__pose *pose);

// The bounding radius of a mesh reaches to the farthest corner of its bounds (mesh.c).
float fe__mesh_reach(const fe__form *form, fe_vec3 centre);

// triangle (flat.c)
float fe__triangle_reach(const fe__form *form, fe_vec3 centre);
fe__bounds fe__triangle_bounds(const fe__form *form, const fe__pose *pose);
fe_dvec3 fe__triangle_support(const fe__form *form, fe_dvec3 direction);
void fe__triangle_face(const fe__form *form, fe_vec3 direction, fe__face *face);

// Several kinds share these (form.c).
fe__mass fe__no_mass(const fe__form *form, double density);
float fe__no_reach(const fe__form *form, fe_vec3 centre);
float fe__core_reach(const fe__form *form, fe_vec3 centre);             // sphere, capsule or box
fe__bounds fe__core_bounds(const fe__form *form, const fe__pose *pose); // capsule or box
float fe__radius_of(const fe__form *form);                              // The radius is the thickness.
float fe__no_thickness(const fe__form *form);                           // FLT_MAX: no motion is too fast for it.
fe__form fe__less_radius(const fe__form *form, float by);               // The radius alone shrinks.
fe_dvec3 fe__point_support(const fe__form *form, fe_dvec3 direction);   // The core is the origin.
void fe__point_face(const fe__form *form, fe_vec3 direction, fe__face *face);
// The half widths, along the world's axes, of a rotated box's bounds.
fe_dvec3 fe__rotated_widths(fe_quat rotation, fe_dvec3 half);

#endif
