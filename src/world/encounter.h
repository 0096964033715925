// encounter.h - two whole shapes, of which one is a compound at least, while boxes of their parts meet.
//
// Pairs are of parts, but the caller is told of whole shapes. So an encounter counts its pairs, and those that touch:
// it begins with the first pair and ends with the last (step/events.c). It also keeps the answer of the pair filter.
#ifndef FE_WORLD_ENCOUNTER_H
#define FE_WORLD_ENCOUNTER_H
#include "world/contact.h"
#include "world/world.h"

typedef struct fe__encounter {
    int32_t shape_a, shape_b; // whole ones; A was created first
    int32_t pairs, touching;  // pairs of parts, and how many of them touch
    int32_t held, passing;    // how many are contacts, and how many pass a one-way shape, as the last step left them
    int32_t lead;             // the pair that answers for all when a caller asks which shapes touch; 0: none touches
    uint16_t denied;          // 1: the pair filter refused it
    uint16_t entered;         // 1: an exit is owed
    // list of the encounters that the step reports
    int32_t listed, next, previous; // next, previous: 0: none
    // results of the step: the pair with the deepest point, and the impacts of all
    int32_t deepest;
    float depth;
    int32_t hit_pair, hit_point;
    float impulse, largest, approach;
} fe__encounter;

int32_t fe__reserve_encounters(fe_world *world, int32_t extra); // 0: no memory
// The encounter of two shapes or of parts of them; NULL: none
fe__encounter *fe__find_encounter(const fe_world *world, int32_t shape_a, int32_t shape_b);
static inline fe__encounter *fe__encounter_of(const fe_world *world, int32_t pair)
{
    return fe__find_encounter(world, world->pairs[pair].shape_a, world->pairs[pair].shape_b);
}
// Adds a new pair of parts. Memory for its encounter was reserved.
void fe__encounter_gain(fe_world *world, int32_t pair);
// Removes a pair of parts. 1: the encounter ends with it, and owes an exit
int32_t fe__encounter_lose(fe_world *world, int32_t pair);
// A pair begins or ceases to be a contact, or to pass a one-way shape. Never called while workers look at pairs: they
// read both counts, see step/narrowphase.c.
void fe__encounter_hold(fe_world *world, int32_t pair, int32_t holds);
void fe__encounter_pass(fe_world *world, int32_t pair, int32_t passes);
void fe__encounter_touch(fe_world *world, int32_t pair, int32_t touches); // a pair begins or ceases to touch
void fe__encounter_note(fe_world *world, fe__encounter *encounter);       // the step shall report it
void fe__encounter_reported(fe_world *world, fe__encounter *encounter);

#endif
