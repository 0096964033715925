// load.c - see load.h.
#include "step/load.h"

#include "world/contact.h"

typedef struct line {
    fe_dvec3 at; // world
    fe_vec3 along;
} line;

// Force and torque about the centre of mass are the force alone along a line beside it, at (F x T) / F^2 from it.
static line line_of_forces(const fe_world *world, const fe__body *body, fe_dvec3 centre)
{
    fe_vec3 force = fe__add_scaled(fe__quad_vector(body->force), body->mass * body->gravity_scale, world->gravity);
    float square = fe__dot(force, force);
    if (!(square > 0.0f)) return (line){centre, force};
    fe_vec3 aside = fe__scale(1.0f / square, fe__cross(force, fe__quad_vector(body->torque)));
    return (line){fe__dadd(centre, fe__widen(aside)), force};
}

// Of two that move, the one above
static const fe__body *body_above(const fe_world *world, const fe__body *a, const fe__body *b, const fe__places *at)
{
    if (a->type != FE_BODY_DYNAMIC) return b;
    fe_dvec3 from_a = fe__dsub(at->centre_b, at->centre_a);
    return fe__ddot(from_a, fe__widen(world->gravity)) > 0.0 ? a : b;
}

static int32_t most_left_out(const fe_world *world, int32_t head)
{
    int32_t most = FE_LEFT_NONE;
    for (int32_t pair = head; pair >= 0; pair = world->pairs[pair].next_patch)
        most = fe__maxi(most, world->pairs[pair].left_out);
    return most;
}

// None of a pair with several patches that have points
static fe__choice last_choice(const fe_world *world, int32_t head, int32_t left_out)
{
    const fe__contact *m = world->contacts + head;
    if (!left_out || !m->points) return (fe__choice){.count = 0};
    for (int32_t pair = world->pairs[head].next_patch; pair >= 0; pair = world->pairs[pair].next_patch)
        if (world->contacts[pair].point_count > 0.0f) return (fe__choice){.count = 0};
    return (fe__choice){world->features[m->points].ids, (int32_t)m->point_count, left_out};
}

fe__load fe__load_on_corners(const fe_world *world, int32_t pair, const fe__places *at, const fe__view *v)
{
    const fe__contact *m = world->contacts + pair;
    const fe__body *a = world->bodies + m->body_a, *b = world->bodies + m->body_b;
    const fe__body *above = body_above(world, a, b, at);
    fe_dvec3 centre = above == a ? at->centre_a : at->centre_b;
    line l = line_of_forces(world, above, centre);
    int32_t left_out = most_left_out(world, pair);
    return (fe__load){fe__mul_transposed(&v->rotation, fe__narrow(fe__dsub(l.at, v->origin))),
                      fe__mul_transposed(&v->rotation, l.along), last_choice(world, pair, left_out)};
}

fe__load fe__tell_pair_load(const fe__load_asked *asked)
{
    const fe__pair_load *l = (const fe__pair_load *)asked;
    return fe__load_on_corners(l->world, l->pair, l->at, l->v);
}

int32_t fe__load_outgrows(const fe_world *world, int32_t pair)
{
    // Where all but a tenth of the load is borne by two of the points, it lies beyond
    // FE__FOOT_MOST of the way from the middle of four to the line through the two. `corner`: of what the edge bears
    const float edge = 0.5f * (1.0f - FE__FOOT_MOST), corner = 0.1f;
    const fe__contact *m = world->contacts + pair;
    const float *bears = fe__points_of(world, m)->total_impulse; // 0 behind the last point
    if (m->point_count < 3.0f) return 0;
    float front = bears[0] + bears[1], others = bears[2] + bears[3],
          least = fe__minf(bears[0], bears[1]) + fe__minf(bears[2], bears[3]);
    float low = fe__minf(front, others), load = front + others;
    if (!(fe__minf(low, least) < edge * load)) return 0;
    if (world->pairs[pair].left_out >= FE_LEFT_SIDES && others < edge * load &&
        fe__minf(bears[0], bears[1]) >= corner * front)
        return 0;
    return 1;
}
