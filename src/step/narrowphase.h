// narrowphase.h - the narrow phases of plain pairs (narrowphase.c) and of pairs with a heightfield or a mesh
// (narrowphase_mesh.c), and what they share.
//
// Called by the collide stage (update_contacts.c) and by the skip test of deferred pairs (reserve.c), on any thread.
#ifndef FE_STEP_NARROWPHASE_H
#define FE_STEP_NARROWPHASE_H
#include "collision/form/hull.h"
#include "collision/manifold/patch.h"
#include "step/stages.h"
#include "world/contact.h"
#include "world/world_memory.h"

static inline void fe__copy3(float *out, fe_vec3 a) { out[0] = a.x, out[1] = a.y, out[2] = a.z; }

// How far a pair without points, `gap` apart, may move before it is looked at again, m. It may come a little nearer
// than the margin within which points are made, so that a pair that hovers at the margin is not looked at in each step.
static inline float fe__slack(float gap, float margin)
{
    const float least = 0.875f; // share of the margin
    return fe__maxf(gap - least * margin, 0.0f);
}

// ---- narrow phase ---------------------------------------------------------------------------------------------------

// The narrow phase of one pair. Only the pair is written, but for its flags. 1: it begins or ceases to pass a one-way
// shape
int32_t fe__collide_pair(const fe__step *step, int32_t pair);

// The narrow phase of one pair with a heightfield or a mesh. Only the pair and its patches are written.
void fe__collide_field_pair(const fe__step *step, int32_t head);

// Result of the narrow phase for a pair that gets no points
typedef struct fe__apart {
    float axis_separation; // becomes the pair's
    float slack;           // m: not looked at again until the bodies may have closed so much of their gap
    fe_vec3 normal;        // unit, of a plane between the two, world, from the contact's A; or 0
} fe__apart;

// The narrow phase without writing the pair. 1: no points are found, and fe__write_apart writes what fe__collide_pair
// would. 0: points may be found, or others could see what fe__collide_pair writes (one-way shapes, fast bodies)
int32_t fe__collide_apart(const fe__step *step, int32_t pair, fe__apart *out_apart);
void fe__write_apart(fe_world *world, int32_t pair, const fe__apart *apart);

// ---- prefetches -----------------------------------------------------------------------------------------------------
// Records of pairs that the narrow phase will look at lie anywhere in memory. They are fetched while it looks at
// earlier pairs: a pair's own records first, then those that they name, then hulls, and last the arrays of the hulls.

FE_FETCHES fe__fetch_own(const fe_world *world, int32_t pair)
{
    fe__fetch(world->pairs + pair, sizeof *world->pairs);
    fe__fetch(world->contacts + pair, sizeof *world->contacts);
}

FE_FETCHES fe__fetch_named(const fe_world *world, int32_t pair)
{
    const fe__pair *p = world->pairs + pair;
    const fe__contact *contact = world->contacts + pair;
    fe__fetch(world->shapes + p->shape_a, sizeof *world->shapes);
    fe__fetch(world->shapes + p->shape_b, sizeof *world->shapes);
    fe__fetch(world->bodies[p->body_a].centre, sizeof world->bodies->centre);
    fe__fetch(world->bodies[p->body_b].centre, sizeof world->bodies->centre);
    fe__fetch(world->bodies[p->body_a].velocity, sizeof world->bodies->velocity);
    fe__fetch(world->bodies[p->body_b].velocity, sizeof world->bodies->velocity);
    if (p->next_patch >= 0) fe__fetch_own(world, p->next_patch);
    if (contact->points) {
        fe__fetch(world->points + contact->points, sizeof *world->points);
        fe__fetch(world->features + contact->points, sizeof *world->features);
        return;
    }
    fe__tree_fetch(&world->moving_tree, p->shape_a); // a pair without points may have parted: its boxes are asked
    fe__tree_fetch(&world->moving_tree, p->shape_b);
    fe__fetch(world->odometers + p->body_a, sizeof *world->odometers);
    fe__fetch(world->odometers + p->body_b, sizeof *world->odometers);
    if (p->awake_index >= 0) fe__fetch(world->deferrals + p->awake_index, sizeof *world->deferrals);
}

// Also fetches the patch after the next, and the points of the next.
FE_FETCHES fe__fetch_hulls(const fe_world *world, int32_t pair)
{
    const fe__pair *p = world->pairs + pair;
    fe__hull_form_fetch(&world->shapes[p->shape_a].form);
    fe__hull_form_fetch(&world->shapes[p->shape_b].form);
    if (p->next_patch < 0) return;
    fe__fetch(world->points + world->contacts[p->next_patch].points, sizeof *world->points);
    int32_t second = world->pairs[p->next_patch].next_patch;
    if (second >= 0) fe__fetch_own(world, second);
}

FE_FETCHES fe__fetch_of_hulls(const fe_world *world, int32_t pair)
{
    const fe__pair *p = world->pairs + pair;
    const fe__form *a = &world->shapes[p->shape_a].form, *b = &world->shapes[p->shape_b].form;
    fe__hull_form_fetch_vertices(a), fe__hull_form_fetch_faces(a);
    fe__hull_form_fetch_vertices(b), fe__hull_form_fetch_faces(b);
}

// ---- parts of both narrow phases ------------------------------------------------------------------------------------

// Takes a pair's points away; the next step looks for them again.
void fe__drop_points(fe_world *world, int32_t pair);
// How far the pair can close in the step, m
float fe__reach_in_step(const fe__step *step, const fe__body *a, const fe__body *b);
// How far a manifold with points may slide or turn before it is looked for anew, m
float fe__recycle_tolerance(const fe__view *v, int32_t left_out);
// Writes all of a contact but its tolerance and impulses. `ahead`: 1 where `at` is not where the bodies are now
void fe__write_manifold(const fe_world *world, fe__contact *contact, const fe__view *v, const fe__places *at,
                        const fe__manifold *found, int32_t ahead);

// Finds the static boxes, hulls, meshes and heightfields near a body that touches one of them, `self`: in the view's
// frame, the nearest where there are many. `centre`: middle of `other` there (fe__form_middle)
void fe__find_surroundings(const fe_world *world, const fe__view *v, const fe__shape *self, const fe__shape *other,
                           fe_vec3 centre, fe__surroundings *found);

#endif
