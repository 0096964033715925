// step_op.c - see step_op.h.
#include "record/step_op.h"

#include "core/hash.h"
#include "world/hash.h"
#include "world/pair_list.h"

// Position and velocity side by side: the multiplications of one need not wait for those of the other
static uint64_t hash_of(const fe__body *b)
{
    fe__hash pose = fe__hash_begin(), motion = fe__hash_begin();
    fe__hash_u64(&pose, b->serial);
    for (int k = 0; k < 3; ++k) fe__hash_double(&pose, b->origin[k]);
    fe__hash_floats2(&motion, b->rotation[0], b->rotation[1]);
    fe__hash_floats2(&motion, b->rotation[2], b->rotation[3]);
    fe__hash_floats2(&motion, b->velocity[0], b->velocity[1]);
    fe__hash_floats2(&motion, b->velocity[2], b->spin[0]);
    fe__hash_floats2(&motion, b->spin[1], b->spin[2]);
    fe__hash_u64(&pose, motion.state);
    return pose.state;
}

uint64_t fe__awake_hash(const fe_world *w)
{
    uint64_t sum = 0;
    for (int32_t i = 0; i < w->awake_body_count; ++i) sum += hash_of(w->bodies + w->awake_bodies[i]);
    return sum;
}

static uint64_t rest_of(const fe__body *b)
{
    fe__hash h = fe__hash_begin();
    fe__hash_u64(&h, b->serial);
    fe__hash_float(&h, b->sleep_timer);
    for (int k = 0; k < 3; ++k) fe__hash_floats2(&h, b->force[k], b->torque[k]);
    return h.state;
}

uint64_t fe__deep_hash(const fe_world *w)
{
    uint64_t sum = fe__hash_of_events(w);
    for (int32_t i = 0; i < w->awake_body_count; ++i) sum += rest_of(w->bodies + w->awake_bodies[i]);
    for (int32_t i = 0; i < w->awake_pair_count; ++i) {
        int32_t pair = w->awake_pairs[i]; // deferred ones are below 0
        if (pair >= 0 && w->pairs[pair].flags & FE__PAIR_LINKED) sum += fe__hash_of_contact(w, pair);
    }
    for (int32_t i = 0; i < w->awake_joint_count; ++i) sum += fe__hash_of_impulses(w, w->awake_joints[i]);
    return sum;
}

// ---- traces --------------------------------------------------------------------------------------------------------
// The factor is odd: the next float, or double, always has another byte
static uint8_t byte_of(uint64_t bits) { return (uint8_t)(bits * FE_HASH_FACTOR >> 56); }

void fe__trace_of(const fe_world *w, int32_t body, uint8_t *t)
{
    const fe__body *b = w->bodies + body;
    for (int k = 0; k < 3; ++k) {
        t[FE__TRACE_POSITION + k] = byte_of(fe__double_bits(b->origin[k]));
        t[FE__TRACE_VELOCITY + k] = byte_of(fe__float_bits(b->velocity[k]));
        t[FE__TRACE_SPIN + k] = byte_of(fe__float_bits(b->spin[k]));
    }
    for (int k = 0; k < 4; ++k) t[FE__TRACE_ROTATION + k] = byte_of(fe__float_bits(b->rotation[k]));
    fe__hash forces = fe__hash_begin(), sleep = fe__hash_begin();
    for (int k = 0; k < 3; ++k) fe__hash_floats2(&forces, b->force[k], b->torque[k]);
    fe__hash_float(&sleep, b->sleep_timer);
    uint64_t contacts = 0;
    for (int32_t pair = b->first_contact; pair >= 0; pair = fe__next_pair(w, pair, body))
        if (w->pairs[pair].flags & FE__PAIR_LINKED) contacts += fe__hash_of_contact(w, pair);
    t[FE__TRACE_FORCES] = byte_of(forces.state);
    t[FE__TRACE_SLEEP] = byte_of(sleep.state);
    t[FE__TRACE_CONTACTS] = byte_of(contacts);
}
