// parts.h - the parts of a compound in a world: a shape each, right behind the compound's in the list of the body.
//
// They are what collides, weighs and answers queries; their slots are hidden, so that no handle names them. Whoever
// tells the caller of a shape tells of the whole (fe__whole_shape) and the part's number (fe__part_of_serial). What is
// set on the whole is set on its parts.
#ifndef FE_WORLD_PARTS_H
#define FE_WORLD_PARTS_H
#include "world/world.h"

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
