// contact_creation.h - the life of pairs, and what they report.
#ifndef FE_WORLD_CONTACT_CREATION_H
#define FE_WORLD_CONTACT_CREATION_H
#include "world/contact.h"
#include "world/world.h"

// ---- creation and destruction ---------------------------------------------------------------------------------------

int32_t fe__reserve_pairs(fe_world *world, int32_t extra); // for so many records more. 0: no memory
// After fe__reserve_pairs; A was created first. `denied`: 1: the pair filter refused the pair
int32_t fe__pair_create(fe_world *world, int32_t shape_a, int32_t shape_b, int32_t denied);
void fe__pair_destroy(fe_world *world, int32_t pair);    // unlinks, owes the exit of a pair that touched
void fe__body_drop_pairs(fe_world *world, int32_t body); // destroys all of its pairs
void fe__body_refilter(fe_world *world, int32_t body);   // destroys the pairs that may no longer collide

// 1: one of them is a heightfield or a mesh. Such a pair has patches.
static inline int32_t fe__is_field_pair(const fe_world *world, int32_t shape_a, int32_t shape_b)
{
    return fe__form_is_field(&world->shapes[shape_a].form) || fe__form_is_field(&world->shapes[shape_b].form);
}

// The flags that follow from the shapes and the number of a record alone
uint32_t fe__pair_nature(const fe_world *world, int32_t shape_a, int32_t shape_b, int32_t number);
fe__pair_event_record fe__pair_event_of(const fe_world *world, int32_t pair, int32_t kind);
// Moves the exits of pairs that touched and ended since the last step into the events of this one.
void fe__report_owed_exits(fe_world *world);
// A point of contact, m, world. Its arm counts from the centre of the solver's A, or of B when A is static, and is as
// old as the manifold.
static inline fe_dvec3 fe__contact_point(const fe_world *world, int32_t pair, int32_t point)
{
    const fe__contact *contact = world->contacts + pair;
    const fe__body *a = world->bodies + contact->body_a,
                   *from = a->type == FE_BODY_STATIC ? world->bodies + contact->body_b : a;
    const float *r = fe__points_of(world, contact)->point[point].arm;
    return (fe_dvec3){from->centre[0] + (double)r[0], from->centre[1] + (double)r[1], from->centre[2] + (double)r[2]};
}

// ---- links ----------------------------------------------------------------------------------------------------------
// Pairs with points enter the constraint graph, and leave it.

// Links a pair, with a colour of its own for each dynamic body. `dt`: length of the step, s
void fe__pair_link(fe_world *world, int32_t pair, float dt);
void fe__pair_note_colour(fe_world *world, const fe__contact *contact); // if it has one
void fe__pair_unlink(fe_world *world, int32_t pair);                    // also releases its points
void fe__pair_forget_impulses(fe_world *world, int32_t pair);           // the contact's, and those of rolling
void fe__patch_leave(fe_world *world, int32_t patch);                   // an unlinked patch leaves the lists

#endif
