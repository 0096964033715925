// form_kinds.h - what each kind of form puts into the table of traits (form.h).
#ifndef FE_COLLISION_FORM_FORM_KINDS_H
#define FE_COLLISION_FORM_FORM_KINDS_H
#include "collision/form/form.h"

// surface.c
fe__mass fe__sphere_mass(const fe__form *form, double density);
fe__bounds fe__sphere_bounds(const fe__form *form, const fe__pose *pose);

// surface.c
fe__mass fe__capsule_mass(const fe__form *form, double density);
fe_dvec3 fe__capsule_support(const fe__form *form, fe_dvec3 direction);
void fe__capsule_face(const fe__form *form, fe_vec3 direction, fe__face *face);

// surface.c
fe__mass fe__box_mass(const fe__form *form, double density);
float fe__box_thickness(const fe__form *form);
fe__form fe__box_shrunk(const fe__form *form, float by);
fe_dvec3 fe__box_support(const fe__form *form, fe_dvec3 direction);
void fe__box_face(const fe__form *form, fe_vec3 direction, fe__face *face);

// surface.c
fe__mass fe__cylinder_mass(const fe__form *form, double density);
fe__bounds fe__cylinder_bounds(const fe__form *form, const fe__pose *pose);
float fe__cylinder_reach(const fe__form *form, fe_vec3 centre);
float fe__cylinder_thickness(const fe__form *form);
fe_dvec3 fe__cylinder_support(const fe__form *form, fe_dvec3 direction);
void fe__cylinder_face(const fe__form *form, fe_vec3 direction, fe__face *face);

// surface.c
fe__mass fe__cone_mass(const fe__form *form, double density);
fe__bounds fe__cone_bounds(const fe__form *form, const fe__pose *pose);
float fe__cone_reach(const fe__form *form, fe_vec3 centre);
float fe__cone_thickness(const fe__form *form);
fe__form fe__cone_shrunk(const fe__form *form, float by);
fe_dvec3 fe__cone_support(const fe__form *form, fe_dvec3 direction);
void fe__cone_face(const fe__form *form, fe_vec3 direction, fe__face *face);

// hull.c
fe__mass fe__hull_form_mass(const fe__form *form, double density);
fe__bounds fe__hull_form_bounds(const fe__form *form, const fe__pose *pose);
float fe__hull_form_reach(const fe__form *form, fe_vec3 centre);
float fe__hull_form_thickness(const fe__form *form);
fe__form fe__hull_form_shrunk(const fe__form *form, float by);
fe_dvec3 fe__hull_form_support(const fe__form *form, fe_dvec3 direction);
void fe__hull_form_face(const fe__form *form, fe_vec3 direction, fe__face *face);

// surface.c
fe_dvec3 fe__rim_support(float radius, double y, fe_dvec3 direction); // the rim's point farthest along it
void fe__rim_face(float radius, float y, fe_vec3 direction, fe__face *face);

// surface.c
fe__bounds fe__plane_bounds(const fe__form *form, const fe__pose *pose);

// heightfield.c
fe__bounds fe__heightfield_bounds(const fe__form *form, const fe__pose *pose); // and of a mesh

// mesh.c
float fe__mesh_reach(const fe__form *form, fe_vec3 centre); // to the farthest corner of its bounds

// surface.c
float fe__triangle_reach(const fe__form *form, fe_vec3 centre);
fe__bounds fe__triangle_bounds(const fe__form *form, const fe__pose *pose);
fe_dvec3 fe__triangle_support(const fe__form *form, fe_dvec3 direction);
void fe__triangle_face(const fe__form *form, fe_vec3 direction, fe__face *face);

// form.c: of several
fe__mass fe__no_mass(const fe__form *form, double density);
float fe__no_reach(const fe__form *form, fe_vec3 centre);
float fe__core_reach(const fe__form *form, fe_vec3 centre);             // of a core and a radius around it
fe__bounds fe__core_bounds(const fe__form *form, const fe__pose *pose); // of the same, of a capsule or a box
float fe__radius_of(const fe__form *form);                              // the thickness of what has a radius alone
float fe__no_thickness(const fe__form *form);                           // nothing outruns it: FLT_MAX
fe__form fe__less_radius(const fe__form *form, float by);               // shrunk
fe_dvec3 fe__point_support(const fe__form *form, fe_dvec3 direction);   // the core is the origin
void fe__point_face(const fe__form *form, fe_vec3 direction, fe__face *face);
fe_dvec3 fe__rotated_widths(fe_quat rotation, fe_dvec3 half); // half widths along the world's axes of a rotated box

#endif
