// pair_link.c - see pair_link.h.
#include "world/pair_link.h"

#include "solver/graph/colour.h"
#include "world/encounter.h"
#include "world/pair_list.h"
#include "world/points.h"

// A patch stands before its head in the bodies' lists, so that who walks them may destroy heads on the way.
static void enter_lists(fe_world *world, int32_t patch)
{
    const fe__pair *p = world->pairs + patch;
    fe__pair_add_to_list(world, patch, p->body_a);
    fe__pair_add_to_list(world, patch, p->body_b);
    if (world->pairs[p->head].awake_index >= 0) fe__pair_awaken(world, patch);
}

// A body that falls on one so many times lighter, which lies on the ground, is stopped in many passes: the light one
// hands its impulse on and comes back at rest, so that each pass takes one part in 1 + ratio of the speed u. There are
// two passes in a substep h; until they have stopped it the body sinks by u (h / 2) (1 + ratio). From ten times the
// linear slop on that strains the light one, at once: the impact is not to find its island unprepared, see solve.c. Of
// u only what is vertical counts, as what is struck sideways is held by nothing and moves on.
#define UNEVEN 5.0f
#define MOST_SINK 0.05f // m

// m/s, of the vertical motions along the normal; without gravity of all. 0 or less: the heavy one is below
static float falling_speed(const fe__body *heavy, const fe__body *light, fe_vec3 to_light, fe_vec3 gravity)
{
    fe_vec3 v = fe__sub(fe__quad_vector(heavy->velocity), fe__quad_vector(light->velocity));
    float square = fe__dot(gravity, gravity), down = fe__dot(to_light, gravity);
    if (!(square > 0.0f)) return fe__dot(to_light, v);
    return down > 0.0f ? fe__dot(v, gravity) * down / square : 0.0f;
}

static void note_uneven(fe_world *world, const fe__contact *m, float dt)
{
    fe__body *heavy = world->bodies + m->body_a, *light = world->bodies + m->body_b;
    fe_vec3 n = fe__quad_vector(m->normal);
    if (heavy->inverse_mass > light->inverse_mass) {
        fe__body *lighter = heavy;
        heavy = light, light = lighter, n = fe__scale(-1.0f, n);
    }
    if (light->inverse_mass <= UNEVEN * heavy->inverse_mass) return;
    float ratio = light->inverse_mass / heavy->inverse_mass, between_passes = 0.5f * dt / (float)world->substeps;
    float sink = falling_speed(heavy, light, n, world->gravity) * between_passes * (1.0f + ratio);
    if (sink > MOST_SINK) light->flags |= FE__BODY_STRAINED;
}

void fe__pair_note_colour(fe_world *world, const fe__contact *m)
{
    if (m->colour < 0) return;
    if (m->colour == FE__OVERFLOW_COLOUR) // it found all of its kind taken
        *(m->kind & FE__ROW_PAIR ? &world->pair_colours : &world->static_colours) =
            m->kind & FE__ROW_PAIR ? FE__PAIR_COLOURS : FE__STATIC_COLOURS;
    else if (m->colour < FE__PAIR_COLOURS)
        world->pair_colours = fe__maxi(world->pair_colours, m->colour + 1);
    else
        world->static_colours = fe__maxi(world->static_colours, m->colour - FE__PAIR_COLOURS + 1);
}

// Patches are their head's
static int32_t has_encounter(const fe__pair *p)
{
    return (p->flags & (FE__PAIR_OF_PARTS | FE__PAIR_PATCH)) == FE__PAIR_OF_PARTS;
}

void fe__pair_link(fe_world *world, int32_t pair, float dt)
{
    fe__contact *m = world->contacts + pair;
    fe__colour_contact(world->bodies, m);
    if (m->kind & FE__ROW_PAIR) note_uneven(world, m, dt);
    world->pairs[pair].flags |= FE__PAIR_LINKED;
    world->solver.graph_changed = 1;
    ++world->linked_count;
    fe__pair_note_colour(world, m);
    if (world->pairs[pair].awake_index >= 0) ++world->awake_linked_count, ++world->solver.unbuilt;
    if (has_encounter(world->pairs + pair)) fe__encounter_hold(world, pair, 1);
    if (world->pairs[pair].flags & FE__PAIR_PATCH) enter_lists(world, pair);
}

void fe__pair_forget_impulses(fe_world *world, int32_t pair)
{
    const fe__contact *m = world->contacts + pair;
    if (!m->points) return;
    fe__points_forget_impulses(fe__points_of(world, m));
    fe__extra *e = fe__extra_of(world, m);
    for (int k = 0; k < 3 && e; ++k) e->rolling_impulse[k] = 0.0f;
}

void fe__pair_unlink(fe_world *world, int32_t pair)
{
    fe__contact *m = world->contacts + pair;
    if (m->colour < 0) return;
    fe__uncolour_contact(world->bodies, m);
    fe__points_release(world, pair);
    world->pairs[pair].flags &= ~(uint32_t)FE__PAIR_LINKED;
    if (has_encounter(world->pairs + pair)) fe__encounter_hold(world, pair, 0);
    if (world->pairs[pair].awake_index >= 0) --world->awake_linked_count;
    world->solver.graph_changed = 1;
    --world->linked_count;
}

void fe__patch_leave(fe_world *world, int32_t patch)
{
    const fe__pair *p = world->pairs + patch;
    fe__pair_retire(world, patch);
    fe__pair_remove_from_list(world, patch, p->body_a);
    fe__pair_remove_from_list(world, patch, p->body_b);
}
