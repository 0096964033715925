// shape.h - the life of shapes.
#ifndef FE_WORLD_SHAPE_H
#define FE_WORLD_SHAPE_H
#include "world/world.h"

// ---- shapes ---------------------------------------------------------------------------------------------------------

int32_t fe__shape_create(fe_world *world, int32_t body, const fe_shape_def *def,
                         const fe__form *form); // index, or negative: fe_result
void fe__shape_destroy(fe_world *world, int32_t shape);
// Its record goes, with those of its parts by itself: it must be without pairs, and its body's list goes too
void fe__shape_forget(fe_world *world, int32_t shape);
fe_result fe__shape_set_form(fe_world *world, int32_t shape, const fe__form *form);
void fe__shape_set_local_pose(fe_world *world, int32_t shape, fe_vec3 position, fe_quat rotation);
void fe__shape_set_filter(fe_world *world, int32_t shape, uint32_t layer, uint32_t mask, int32_t group);
int32_t fe__accept_pair(void *user, const fe_filter_pair *pair); // a pair filter that lets all collide
void fe__world_judge_anew(fe_world *world); // the pairs that the pair filter refused are new again
// Does the pair filter judge its pairs? They are found anew
void fe__shape_set_judged(fe_world *world, int32_t shape, int32_t judged);
void fe__shape_set_one_way(fe_world *world, int32_t shape, int32_t one_way,
                           const fe_vec3 *direction); // NULL: the direction as it is
void fe__shape_set_trigger(fe_world *world, int32_t shape, int32_t trigger);
void fe__shape_set_density(fe_world *world, int32_t shape, float density);
void fe__shape_set_material(fe_world *world, int32_t shape, const fe_material *material);
void fe__shape_set_surface_velocity(fe_world *world, int32_t shape, fe_vec3 velocity);
void fe__shape_set_events(fe_world *world, int32_t shape, uint32_t events);
void fe__shape_material_changed(fe_world *world,
                                int32_t shape); // material, events, surface velocity: its pairs mix anew

// ---- parts ----------------------------------------------------------------------------------------------------------
// The parts of a compound in a world: a shape each, right behind the compound's in the list of the body.
//
// They are what collides, weighs and answers queries; their slots are hidden, so that no handle names them. Whoever
// tells the caller of a shape tells of the whole (fe__whole_shape) and the part's number (fe__part_of_serial). What is
// set on the whole is set on its parts.

// How many a form has; 0 of any but a compound
int32_t fe__part_count(const fe_world *world, const fe__form *form);
// Makes the shapes of the parts of a compound's: reserved, no users of their assets and in no tree yet
void fe__parts_create(fe_world *world, int32_t whole);
// What they take over from the whole: place, density, material and all else that is set on it
void fe__parts_follow(fe_world *world, int32_t whole);

// Puts a shape behind another in the list of its body, -1: behind the last
void fe__shape_list(fe_world *world, int32_t shape, int32_t behind);
void fe__shape_unlist(fe_world *world, int32_t shape);

#endif
