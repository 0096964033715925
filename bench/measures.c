// What every run tells whatever its case asks (trial.h): read from the series that trial.c recorded; the comparison of
// engines (worse.c) and people read it.
#include "trial.h"

#include <math.h>

const char *const bench_measure_names[BENCH_MEASURES] = {"drift, m",
                                                         "tilt, rad",
                                                         "settled after, s",
                                                         "energy gained, share of what was turned over",
                                                         "joint gap in the last second, m",
                                                         "overlap at the end, m"};

static const double AT_REST = 0.05; // m/s, the speed below which bodies may fall asleep

// s, or NaN
static double settled(const bench_trial *t)
{
    int32_t step = t->step;
    while (step >= 0 && t->fastest[step] <= AT_REST) step--;
    return step == t->step ? (double)NAN : (step + 1) * (double)t->scene.dt;
}

// J, that bodies have by a height of a linear slop
static double within_slop(const bench_trial *t)
{
    double weight = 0.0, square = 0.0;
    for (int k = 0; k < 3; k++) square += t->scene.gravity[k] * t->scene.gravity[k];
    for (int32_t i = 0; i < t->scene.body_count; i++)
        weight += t->masses[i] * (double)t->scene.bodies[i].gravity_scale * sqrt(square);
    return weight * BENCH_LINEAR_SLOP;
}

// What was turned over: the largest kinetic energy and the range of the potential one. Springs give back what they
// hold, so that only what rises above an earlier energy with its springs counts, and of that only what is more than the
// slop makes of it.
static double energy_gained(const bench_trial *t)
{
    if (t->driven_until >= t->step) return (double)NAN;
    double least = HUGE_VAL, gained = 0.0, kinetic = 0.0, low = HUGE_VAL, high = -HUGE_VAL;
    for (int32_t i = t->driven_until; i <= t->step; i++) {
        const double potential = t->energy[i] - t->kinetic[i];
        gained = fmax(gained, t->energy[i] - least);
        least = fmin(least, t->energy[i] + t->held[i]);
        kinetic = fmax(kinetic, t->kinetic[i]);
        low = fmin(low, potential), high = fmax(high, potential);
    }
    const double slop = within_slop(t), all = kinetic + (high - low) + slop;
    return all > 0.0 ? fmax(0.0, gained - slop) / all : 0.0;
}

void bench_measure(bench_trial *t)
{
    const int32_t a_second = (int32_t)lround(1.0 / (double)t->scene.dt);
    for (int32_t i = 0; i < BENCH_MEASURES; i++) t->measures[i] = (double)NAN;
    if (!t->finite) return;
    t->measures[BENCH_M_DRIFT] = bench_largest_drift(t);
    t->measures[BENCH_M_TILT] = bench_largest_tilt(t);
    t->measures[BENCH_M_SETTLED] = settled(t);
    t->measures[BENCH_M_ENERGY] = energy_gained(t);
    if (t->scene.joint_count > 0)
        t->measures[BENCH_M_GAP] = bench_highest(t->gap, t->step > a_second ? t->step - a_second : 0, t->step);
    t->measures[BENCH_M_DEEPEST] = bench_deepest(t);
}
