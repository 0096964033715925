// ranges.h - the largest and least numbers that the library takes, from callers and from bytes.
//
// Squares and products of them stay far inside a float, so that no argument can make an infinity.
#ifndef FE_CORE_RANGES_H
#define FE_CORE_RANGES_H

#define FE_MAX_POSITION 1e9     // m, each coordinate: a double resolves 0.1 um there
#define FE_MAX_TRANSLATION 1e10 // m, of a query
#define FE_MAX_TURN 64.0f       // rad, of a query: ten turns. What a sweep costs grows with them
#define FE_MAX_LOCAL 1e6f       // m, in a body's frame
#define FE_MAX_SPEED 1e6f       // m/s, rad/s, m/s2
#define FE_MOST_SPEED 1e7f      // m/s, rad/s: a body that a step leaves faster has overflowed
#define FE_MAX_FORCE 1e15f      // N, N m, N s, N m s
#define FE_MAX_VALUE 1e6f       // dampings, hertz, ratios, frictions...
#define FE_LEAST_VALUE 1e-6f    // of what must be above 0
#define FE_MAX_DENSITY 1e7f     // kg/m3
#define FE_LEAST_MASS 1e-9f     // kg
#define FE_MAX_MASS 1e18f
#define FE_LEAST_INERTIA 1e-18f // kg m2
#define FE_MAX_INERTIA 1e30f
#define FE_LEAST_LENGTH 1e-3f // m, of a form
#define FE_MAX_LENGTH 1e5f
#define FE_LEAST_SCALE 1e-3f // of an asset, its magnitude along an axis
#define FE_MAX_SCALE 1e3f
#define FE_MAX_DT 1.0f // s
// s. A float's last digit of a speed of 16 m/s, over so short a time, is 0.1 m/s2, a hundredth of gravity: what
// impulses over shorter times would tell of forces is rounding
#define FE_LEAST_DT 1e-5f

#endif
