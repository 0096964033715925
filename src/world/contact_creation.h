// contact_creation.h - the life of pairs, and what they report.
#ifndef FE_WORLD_CONTACT_CREATION_H
#define FE_WORLD_CONTACT_CREATION_H
#include "world/contact.h"
#include "world/world.h"

// ---- pairs ----------------------------------------------------------------------------------------------------------

int32_t fe__reserve_pairs(fe_world *world, int32_t extra);
// Room was reserved; A created first. `denied`: by the pair filter
int32_t fe__pair_create(fe_world *world, int32_t shape_a, int32_t shape_b, int32_t denied);
void fe__pair_destroy(fe_world *world, int32_t pair);    // unlinks, owes the exit of a pair that touched
void fe__body_drop_pairs(fe_world *world, int32_t body); // all of them
void fe__body_refilter(fe_world *world, int32_t body);   // those that may no longer collide

// Is one of them a field? Such a pair has patches.
static inline int32_t fe__is_field_pair(const fe_world *world, int32_t shape_a, int32_t shape_b)
{
    return fe__form_is_field(&world->shapes[shape_a].form) || fe__form_is_field(&world->shapes[shape_b].form);
}

uint32_t fe__pair_nature(const fe_world *world, int32_t shape_a, int32_t shape_b, int32_t number);
fe__pair_event_record fe__pair_event_of(const fe_world *world, int32_t pair, int32_t kind);
// Exits of pairs that touched and ended since the last step: into the events of this one
void fe__report_owed_exits(fe_world *world);
// m, world: arms count from the centre of the solver's A, or of B when A is static; between them lies what the pair
// moved since it was found
static inline fe_dvec3 fe__contact_point(const fe_world *world, int32_t pair, int32_t point)
{
    const fe__contact *m = world->contacts + pair;
    const fe__body *a = world->bodies + m->body_a, *from = a->type == FE_BODY_STATIC ? world->bodies + m->body_b : a;
    const float *r = fe__points_of(world, m)->point[point].arm;
    return (fe_dvec3){from->centre[0] + (double)r[0], from->centre[1] + (double)r[1], from->centre[2] + (double)r[2]};
}

// ---- pair link ------------------------------------------------------------------------------------------------------
// Pairs with points enter the constraint graph, and leave it.

// with a colour of its own for each dynamic body; dt: of the step
void fe__pair_link(fe_world *world, int32_t pair, float dt);
void fe__pair_note_colour(fe_world *world, const fe__contact *contact); // if it has one
void fe__pair_unlink(fe_world *world, int32_t pair);                    // its points are released
void fe__pair_forget_impulses(fe_world *world, int32_t pair);           // the contact's, and those of rolling
void fe__patch_leave(fe_world *world, int32_t patch);                   // an unlinked patch leaves the lists

#endif
