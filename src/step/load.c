// load.c - see load.h.
#include "step/load.h"

#include "world/contact.h"

fe__load fe__tell_pair_load(const fe__load_asked *asked)
{
    const fe__pair_load *question = (const fe__pair_load *)asked;
    const fe_world *world = question->world;
    const fe__view *v = question->v;
    const fe__places *at = question->at;
    const fe__contact *contact = world->contacts + question->pair;
    const fe__body *a = world->bodies + contact->body_a, *b = world->bodies + contact->body_b;
    int32_t a_is_above = 0; // gravity would move it towards the other
    if (a->type == FE_BODY_DYNAMIC)
        a_is_above = fe__ddot(fe__dsub(at->centre_b, at->centre_a), fe__widen(world->gravity)) > 0.0;
    const fe__body *above = a_is_above ? a : b;

    // Force and torque about the centre of mass are the force alone along a line beside it, at (F x T) / F^2 from it.
    fe_vec3 force = fe__add_scaled(fe__quad_vector(above->force), above->mass * above->gravity_scale, world->gravity);
    fe_dvec3 on_line = a_is_above ? at->centre_a : at->centre_b;
    float square = fe__dot(force, force);
    if (square > 0.0f)
        on_line =
            fe__dadd(on_line, fe__widen(fe__scale(1.0f / square, fe__cross(force, fe__quad_vector(above->torque)))));

    // several patches with points have no common choice of corners
    int32_t left_out = FE_LEFT_NONE, has_choice = contact->points != 0;
    for (int32_t pair = question->pair; pair >= 0; pair = world->pairs[pair].next_patch) {
        left_out = fe__maxi(left_out, world->pairs[pair].left_out);
        if (pair != question->pair && world->contacts[pair].point_count > 0.0f) has_choice = 0;
    }
    fe__choice last = {.count = 0};
    if (left_out && has_choice)
        last = (fe__choice){world->features[contact->points].ids, (int32_t)contact->point_count, left_out};
    return (fe__load){fe__mul_transposed(&v->rotation, fe__narrow(fe__dsub(on_line, v->origin))),
                      fe__mul_transposed(&v->rotation, force), last};
}

int32_t fe__load_outgrows(const fe_world *world, int32_t pair)
{
    // If two of the points bear all but a tenth of the load, it lies beyond FE__FOOT_MOST of the way from the middle
    // of four to the line through the two. `corner` is a share of what the edge bears.
    const float edge = 0.5f * (1.0f - FE__FOOT_MOST), corner = 0.1f;
    const fe__contact *contact = world->contacts + pair;
    const float *bears = fe__points_of(world, contact)->total_impulse; // 0 behind the last point
    if (contact->point_count < 3.0f) return 0;
    float front = bears[0] + bears[1], others = bears[2] + bears[3],
          least = fe__minf(bears[0], bears[1]) + fe__minf(bears[2], bears[3]);
    float low = fe__minf(front, others), load = front + others;
    if (!(fe__minf(low, least) < edge * load)) return 0;
    if (world->pairs[pair].left_out >= FE_LEFT_SIDES && others < edge * load &&
        fe__minf(bears[0], bears[1]) >= corner * front)
        return 0;
    return 1;
}
