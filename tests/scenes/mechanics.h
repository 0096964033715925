// mechanics.h - what a scene's bodies have together: energy, momentum, angular momentum, and how far float arithmetic
// lets them drift.
//
// Everything in double, in the frame of the scene, from what the API tells. Sums are in the order of the given bodies.
#ifndef MECHANICS_H
#define MECHANICS_H

#include "scenes/scene.h"

// Velocities are floats: momentum keeps 1e-5 of what the bodies carry through many collisions, angular momentum 1e-4
// (arms stay while the bodies shift by less than half a millimetre in a step)
#define MOMENTUM_DRIFT 1e-5
#define ANGULAR_DRIFT 1e-4
// of the energy: what no step may gain
#define ENERGY_GAIN 1e-5

// A law that the engine does not hold yet in this scene (CHANGELOG.md, "Known limits"): by how much it is missed is
// printed, and the case counts as skipped, not as passed. A gross miss fails all the same.
typedef struct shortfall {
    const char *what;
    double worst; // value over its bound, 1 and less: held
} shortfall;

static inline void measure(shortfall *f, double value, double bound, double gross)
{
    FE_WITHIN(value, -1e30, gross);
    f->worst = fmax(f->worst, value / bound);
}

static inline void report_shortfall(const shortfall *f)
{
    if (f->worst <= 1) return;
    print_message("known limit: %s, %.3g times the bound\n", f->what, f->worst);
    skip();
}

typedef struct totals {
    double energy;      // J, kinetic and of the height, exact for the discrete flight
    double kinetic;     // J
    vec momentum;       // N s
    vec angular;        // N m s, about the origin
    double momenta;     // sum of the bodies' |m v|, N s: the scale of rounding
    double angular_all; // sum of the bodies' own |L|, N m s
} totals;

// R I R^T w in the scene's frame
static inline vec own_angular_momentum(const scene *s, fe_body body, const fe_mass_data *mass)
{
    vec w = spin(s, body), sum = v3(0, 0, 0);
    const double moment[3] = {mass->inertia.x, mass->inertia.y, mass->inertia.z};
    const vec unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int k = 0; k < 3; ++k) {
        vec axis = axis_of(s, body, rotate(mass->inertia_rotation, unit[k]));
        sum = plus(sum, times(moment[k] * dot(axis, w), axis));
    }
    return sum;
}

// The scheme v += h a; x += h v keeps  v^2/2 - a.x + h a.v/2  bit by bit of its flight: that is the energy here
// (gravity only).
static inline totals totals_of(const scene *s, const fe_body *bodies, int count)
{
    totals t = {0};
    fe_vec3 gravity;
    MUST(fe_world_get_gravity(s->world, &gravity));
    vec g = from_world(s, widen(gravity));
    for (int i = 0; i < count; ++i) {
        fe_mass_data mass = mass_data_of(s, bodies[i]);
        fe_dvec3 centre;
        MUST(fe_body_get_centre(s->world, bodies[i], &centre));
        vec x = from_world(s, centre), v = velocity(s, bodies[i]), own = own_angular_momentum(s, bodies[i], &mass);
        vec p = times((double)mass.mass, v), orbit = cross(x, p);
        t.kinetic += 0.5 * dot(p, v) + 0.5 * dot(own, spin(s, bodies[i]));
        t.energy += (double)mass.mass * (0.5 * s->h * dot(g, v) - dot(g, x));
        t.momentum = plus(t.momentum, p);
        t.angular = plus(t.angular, plus(own, orbit));
        t.momenta += length(p);
        t.angular_all += length(own) + length(orbit);
    }
    t.energy += t.kinetic;
    return t;
}

// ---- random scenes -------------------------------------------------------------------------------------------------

typedef struct dice {
    uint64_t state;
} dice;

static inline double uniform(dice *d, double low, double high)
{
    d->state = d->state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * (double)(d->state >> 11) * 0x1p-53;
}

static inline int pick(dice *d, int count) { return (int)uniform(d, 0, count); }

static inline vec somewhere(dice *d, double half)
{
    double x = uniform(d, -half, half), y = uniform(d, -half, half), z = uniform(d, -half, half);
    return v3(x, y, z);
}

// uniform over the directions is not needed: any rotation at all
static inline fe_quat any_rotation(dice *d)
{
    vec axis = somewhere(d, 1);
    return length(axis) > 1e-3 ? turned(axis, uniform(d, -PI, PI)) : UNTURNED;
}

// a sphere, a box or a capsule of about `size` m
static inline fe_geometry any_form(dice *d, double size)
{
    double a = uniform(d, 0.6, 1), b = uniform(d, 0.6, 1), c = uniform(d, 0.6, 1);
    switch (pick(d, 3)) {
    case 0:
        return sphere(0.5 * size * a);
    case 1:
        return box(0.4 * size * a, 0.4 * size * b, 0.4 * size * c);
    default:
        return capsule(0.25 * size * a, 0.25 * size * b);
    }
}

// ---- what the machine allows ---------------------------------------------------------------------------------------

// Builds with sanitizers are some ten times slower: they get smaller scenes.
#if defined(FE_SANITIZED) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SLOW_BUILD 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define SLOW_BUILD 1
#endif
#endif
#ifndef SLOW_BUILD
#define SLOW_BUILD 0
#endif

#endif
