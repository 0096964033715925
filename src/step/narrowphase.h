// narrowphase.h - what the narrow phases of plain pairs (narrowphase.c) and of pairs with a heightfield
// (narrowphase_mesh.c) share.
#ifndef FE_STEP_NARROWPHASE_H
#define FE_STEP_NARROWPHASE_H
#include "collision/form/hull.h"
#include "collision/manifold/patch.h"
#include "step/stages.h"
#include "world/contact.h"
#include "world/world_memory.h"

// ---- narrow ---------------------------------------------------------------------------------------------------------

static inline void fe__copy3(float *out, fe_vec3 a) { out[0] = a.x, out[1] = a.y, out[2] = a.z; }

// How far a pair without points, a gap of `gap` apart, may move before it is looked at again, m. It comes a little
// nearer than the margin within which points are made, so that a pair that hovers at the margin is not looked at in
// each step.
static inline float fe__slack(float gap, float margin)
{
    const float least = 0.875f; // of the margin
    return fe__maxf(gap - least * margin, 0.0f);
}

// The narrow phase of one pair. Only the pair is written, and of it not the flags. Returns whether it begins or ends to
// pass a one-way shape
int32_t fe__collide_pair(const fe__step *step, int32_t pair);
// What the narrow phase finds of a pair that gets no points
typedef struct fe__apart {
    float axis_separation; // of the pair
    float slack;           // m: not looked at again until the bodies may have closed so much of their gap
    fe_vec3 normal;        // of a plane between the two, world, from the contact's A; or 0
} fe__apart;
// Writes nothing. 1: no points are found. 0: they may be, or others could tell what fe__collide_pair writes (one-way
// shapes, fast bodies)
int32_t fe__collide_apart(const fe__step *step, int32_t pair, fe__apart *out_apart);
void fe__write_apart(fe_world *world, int32_t pair, const fe__apart *apart); // what fe__collide_pair writes then

// Records of pairs that the narrow phase will look at lie anywhere: they are asked for while it looks at others, a
// pair's own first, then those that they name
FE_FETCHES fe__fetch_own(const fe_world *w, int32_t pair)
{
    fe__fetch(w->pairs + pair, sizeof *w->pairs);
    fe__fetch(w->contacts + pair, sizeof *w->contacts);
}

FE_FETCHES fe__fetch_named(const fe_world *w, int32_t pair)
{
    const fe__pair *p = w->pairs + pair;
    const fe__contact *m = w->contacts + pair;
    fe__fetch(w->shapes + p->shape_a, sizeof *w->shapes);
    fe__fetch(w->shapes + p->shape_b, sizeof *w->shapes);
    fe__fetch(w->bodies[p->body_a].centre, sizeof w->bodies->centre);
    fe__fetch(w->bodies[p->body_b].centre, sizeof w->bodies->centre);
    fe__fetch(w->bodies[p->body_a].velocity, sizeof w->bodies->velocity);
    fe__fetch(w->bodies[p->body_b].velocity, sizeof w->bodies->velocity);
    if (p->next_patch >= 0) fe__fetch_own(w, p->next_patch);
    if (m->points) {
        fe__fetch(w->points + m->points, sizeof *w->points);
        fe__fetch(w->features + m->points, sizeof *w->features);
        return;
    }
    fe__tree_fetch(&w->moving_tree, p->shape_a); // without points, the boxes may have parted
    fe__tree_fetch(&w->moving_tree, p->shape_b);
    fe__fetch(w->odometers + p->body_a, sizeof *w->odometers);
    fe__fetch(w->odometers + p->body_b, sizeof *w->odometers);
    if (p->awake_index >= 0) fe__fetch(w->deferrals + p->awake_index, sizeof *w->deferrals);
}

// Where the records that it names are there: hulls; the next but one of the patches, and the points of the next
FE_FETCHES fe__fetch_hulls(const fe_world *w, int32_t pair)
{
    const fe__pair *p = w->pairs + pair;
    fe__hull_form_fetch(&w->shapes[p->shape_a].form);
    fe__hull_form_fetch(&w->shapes[p->shape_b].form);
    if (p->next_patch < 0) return;
    fe__fetch(w->points + w->contacts[p->next_patch].points, sizeof *w->points);
    int32_t second = w->pairs[p->next_patch].next_patch;
    if (second >= 0) fe__fetch_own(w, second);
}

// Where the hulls are there: their arrays
FE_FETCHES fe__fetch_of_hulls(const fe_world *w, int32_t pair)
{
    const fe__pair *p = w->pairs + pair;
    const fe__form *a = &w->shapes[p->shape_a].form, *b = &w->shapes[p->shape_b].form;
    fe__hull_form_fetch_vertices(a), fe__hull_form_fetch_faces(a);
    fe__hull_form_fetch_vertices(b), fe__hull_form_fetch_faces(b);
}

// Takes a pair's points away; the next step looks for them again.
void fe__drop_points(fe_world *world, int32_t pair);
// how far the pair can close in the step, m
float fe__reach_in_step(const fe__step *step, const fe__body *a, const fe__body *b);
// how far a manifold with points may slide or turn before it is looked for anew, m
float fe__recycle_tolerance(const fe__view *v, int32_t left_out);
// Everything of a contact but its tolerance and impulses. `ahead`: `at` is not where the bodies are now.
void fe__write_manifold(const fe_world *world, fe__contact *m, const fe__view *v, const fe__places *at,
                        const fe__manifold *found, int32_t ahead);

// ---- surroundings ---------------------------------------------------------------------------------------------------
// What static boxes, hulls, meshes and heightfields lie near a body that touches one of them.

// What lies near `other` beside `self`, in the view's frame; of much the nearest. `centre`: of the other there
// (fe__form_middle)
void fe__find_surroundings(const fe_world *world, const fe__view *v, const fe__shape *self, const fe__shape *other,
                           fe_vec3 centre, fe__surroundings *found);

// ---- narrowphase mesh -----------------------------------------------------------------------------------------------
// The narrow phase of one pair with a heightfield. Only the pair and its patches are written.

void fe__collide_field_pair(const fe__step *step, int32_t head);

#endif
