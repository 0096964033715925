// shapes.h - the life of shapes.
#ifndef FE_WORLD_SHAPES_H
#define FE_WORLD_SHAPES_H
#include "world/world.h"

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

#endif
