// encounter.h - two shapes of which one is a compound at least, while boxes of their parts meet.
//
// Pairs are of parts; the caller is told of whole shapes. So an encounter counts its pairs and those that touch: it
// begins with the first and ends with the last of them (step/events.c). It knows what the pair filter said, too.
#ifndef FE_WORLD_ENCOUNTER_H
#define FE_WORLD_ENCOUNTER_H
#include "world/contact.h"
#include "world/world.h"

typedef struct fe__encounter {
    int32_t shape_a, shape_b; // whole ones; A was created first
    int32_t pairs, touching;  // of parts; so many of these touch
    int32_t held, passing;    // so many are contacts; so many pass a one-way shape, as the last step left them
    int32_t lead;             // one that touches, 0: none does. Who asks which shapes touch hears of it alone
    uint16_t denied;          // the pair filter refused it
    uint16_t entered;         // an exit is owed
    // In the list of those that the step reports of
    int32_t listed, next, previous; // 0: none
    // What the step found: the pair with the deepest point, and the impacts of all
    int32_t deepest;
    float depth;
    int32_t hit_pair, hit_point;
    float impulse, largest, approach;
} fe__encounter;

int32_t fe__reserve_encounters(fe_world *world, int32_t extra);                             // 0: no memory
fe__encounter *fe__find_encounter(const fe_world *world, int32_t shape_a, int32_t shape_b); // or of parts; NULL: none
static inline fe__encounter *fe__encounter_of(const fe_world *world, int32_t pair)
{
    return fe__find_encounter(world, world->pairs[pair].shape_a, world->pairs[pair].shape_b);
}
// A new pair of parts, with room for its encounter
void fe__encounter_gain(fe_world *world, int32_t pair);
// A pair of parts goes. 1: with it goes the encounter, which owes an exit
int32_t fe__encounter_lose(fe_world *world, int32_t pair);
// A pair begins or ceases to be a contact, or to pass a one-way shape. Never while workers look at pairs: they read
// both counts, see step/narrowphase.c
void fe__encounter_hold(fe_world *world, int32_t pair, int32_t holds);
void fe__encounter_pass(fe_world *world, int32_t pair, int32_t passes);
// A pair begins or ceases to touch
void fe__encounter_touch(fe_world *world, int32_t pair, int32_t touches);
void fe__encounter_note(fe_world *world, fe__encounter *encounter); // the step shall report of it
void fe__encounter_reported(fe_world *world, fe__encounter *encounter);

#endif
