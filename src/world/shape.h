// shape.h - the life of shapes and of the parts of compounds.
#ifndef FE_WORLD_SHAPE_H
#define FE_WORLD_SHAPE_H
#include "world/world.h"

// ---- shapes ---------------------------------------------------------------------------------------------------------

// Returns the index, or a negative fe_result. A sleeping body goes on sleeping: a level may be built asleep.
int32_t fe__shape_create(fe_world *world, int32_t body, const fe_shape_def *def, const fe__form *form);
void fe__shape_destroy(fe_world *world, int32_t shape);
// Releases one record, without pairs and without care for its body's list or for other parts: all of them go.
void fe__shape_forget(fe_world *world, int32_t shape);
fe_result fe__shape_set_form(fe_world *world, int32_t shape, const fe__form *form);
void fe__shape_set_local_pose(fe_world *world, int32_t shape, fe_vec3 position, fe_quat rotation);
void fe__shape_set_filter(fe_world *world, int32_t shape, uint32_t layer, uint32_t mask, int32_t group);
int32_t fe__accept_pair(void *user, const fe_filter_pair *pair); // a pair filter that lets all collide
void fe__world_judge_anew(fe_world *world); // the pairs that the pair filter refused are found anew
// judged: 1: the pair filter judges the shape's pairs, which are found anew
void fe__shape_set_judged(fe_world *world, int32_t shape, int32_t judged);
// direction: NULL: as it is
void fe__shape_set_one_way(fe_world *world, int32_t shape, int32_t one_way, const fe_vec3 *direction);
void fe__shape_set_trigger(fe_world *world, int32_t shape, int32_t trigger);
void fe__shape_set_density(fe_world *world, int32_t shape, float density);
void fe__shape_set_material(fe_world *world, int32_t shape, const fe_material *material);
void fe__shape_set_surface_velocity(fe_world *world, int32_t shape, fe_vec3 velocity);
void fe__shape_set_events(fe_world *world, int32_t shape, uint32_t events);
// Mixes the shape's pairs anew, after a change of material, events or surface velocity.
void fe__shape_material_changed(fe_world *world, int32_t shape);

// ---- parts ----------------------------------------------------------------------------------------------------------
// Each part of a compound is a shape of the world, right behind the compound's in the list of the body.
//
// Parts collide, weigh and answer queries; their slots are hidden, so that no handle names them. Reports to the caller
// name the whole shape (fe__whole_shape) and the part's number (fe__part_of_serial). Settings of the whole are set on
// its parts.

// The number of a form's parts; 0 for any but a compound
int32_t fe__part_count(const fe_world *world, const fe__form *form);
// Makes the shapes of a compound's parts. Their records were reserved; they are in no tree and no list of users yet.
void fe__parts_create(fe_world *world, int32_t whole);
// Copies all that is set on the whole to its parts: place, density, material and the rest.
void fe__parts_follow(fe_world *world, int32_t whole);

// Puts a shape behind another in the list of its body, -1: behind the last
void fe__shape_list(fe_world *world, int32_t shape, int32_t behind);
void fe__shape_unlist(fe_world *world, int32_t shape);

#endif
