// view.c - picture_fit: from where all that may move is seen.
#include "triangles.h"

#include <float.h>
#include <stdlib.h>

#define ROOM 1.08      // of the distance from which what is seen just fits
#define STRAY 8.0      // times as far as the median is a body that fell off: nobody wants the picture for it
#define ALONE 0.5      // m, the half side of a world without a box
#define NEAR_SHADOW 2. // of the distance of the farthest body: long shadows are seen as well

typedef struct ball {
    vec centre;    // m, in the world
    double radius; // m, around its bounds
    double away;   // m, from the middle of all
} ball;

static ball ball_around(const fe_bounds *b)
{
    vec low = make_vec(b->lower.x, b->lower.y, b->lower.z), high = make_vec(b->upper.x, b->upper.y, b->upper.z);
    return (ball){mix(low, high, 0.5), 0.5 * length(sub(high, low)), 0.0};
}

static int compare_numbers(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static double median(double *numbers, int32_t count)
{
    qsort(numbers, (size_t)count, sizeof *numbers, compare_numbers);
    return numbers[count / 2];
}

// The median of each coordinate: a stray body does not move it
static vec middle_of(const ball *balls, int32_t count, double *room)
{
    vec middle = {0, 0, 0};
    for (int32_t i = 0; i < count; ++i) room[i] = balls[i].centre.x;
    middle.x = median(room, count);
    for (int32_t i = 0; i < count; ++i) room[i] = balls[i].centre.y;
    middle.y = median(room, count);
    for (int32_t i = 0; i < count; ++i) room[i] = balls[i].centre.z;
    middle.z = median(room, count);
    return middle;
}

// Keeps those that are near the middle; of few bodies it keeps all. @return how many
static int32_t leave_strays(ball *balls, int32_t count, vec middle, double *room)
{
    enum { FEW = 8 };
    if (count < FEW) return count;
    for (int32_t i = 0; i < count; ++i) {
        balls[i].away = length(sub(balls[i].centre, middle));
        room[i] = balls[i].away + balls[i].radius;
    }
    double most = STRAY * median(room, count);
    int32_t kept = 0;
    for (int32_t i = 0; i < count; ++i)
        if (balls[i].away <= most) balls[kept++] = balls[i];
    return kept;
}

// The bodies that may move. @return how many, or an error
static int32_t gather_balls(const fe_world *world, const fe_body *bodies, int32_t count, ball *out)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < count; ++i) {
        int32_t type = FE_BODY_STATIC;
        fe_bounds bounds;
        if (fe_body_get_type(world, bodies[i], &type) != FE_OK || type == FE_BODY_STATIC) continue;
        if (fe_body_get_bounds(world, bodies[i], &bounds) != FE_OK) continue; // it has no shape, or a plane
        out[kept++] = ball_around(&bounds);
    }
    if (kept > 0) return kept;
    fe_bounds all = {{-ALONE, -ALONE, -ALONE}, {ALONE, ALONE, ALONE}};
    (void)fe_world_get_bounds(world, &all); // where there is none, that stays
    out[0] = ball_around(&all);
    return 1;
}

// A ball at p in the camera's space, as wide as r, is inside the picture from `back` where
// (|p.x| + r) / (p.z + back) <= half the width over the focal distance, and likewise of its height
static double distance_for(const ball *balls, int32_t count, const picture_view *view, double high, vec target)
{
    const camera axes = make_camera(view);
    const double across = view->focal / 0.5, along = view->focal / (0.5 * high);
    double back = 0.0;
    for (int32_t i = 0; i < count; ++i) {
        vec p = into_camera(&axes, sub(balls[i].centre, target));
        double x = (fabs(p.x) + balls[i].radius) * across - p.z, y = (fabs(p.y) + balls[i].radius) * along - p.z;
        back = x > back ? x : back, back = y > back ? y : back;
    }
    return back;
}

// The middle of what is seen, as the eye sees it
static vec centred(const ball *balls, int32_t count, const picture_view *view)
{
    const camera axes = make_camera(view);
    vec low = {DBL_MAX, DBL_MAX, DBL_MAX}, high = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
    for (int32_t i = 0; i < count; ++i) {
        const vec p = into_camera(&axes, balls[i].centre);
        const double r = balls[i].radius;
        low = make_vec(fmin(low.x, p.x - r), fmin(low.y, p.y - r), fmin(low.z, p.z - r));
        high = make_vec(fmax(high.x, p.x + r), fmax(high.y, p.y + r), fmax(high.z, p.z + r));
    }
    const vec p = mix(low, high, 0.5);
    return add(scale(p.x, axes.right), add(scale(p.y, axes.up), scale(p.z, axes.forward)));
}

static void aim(const ball *balls, int32_t count, vec direction, double high, picture_view *out)
{
    out->target = (fe_dvec3){0, 0, 0}, out->eye = (fe_dvec3){direction.x, direction.y, direction.z};
    const vec target = centred(balls, count, out);
    const vec eye = add(target, scale(ROOM * distance_for(balls, count, out, high, target), direction));
    double farthest = 0.0;
    for (int32_t i = 0; i < count; ++i) {
        const double far = length(sub(balls[i].centre, target)) + balls[i].radius;
        farthest = far > farthest ? far : farthest;
    }
    out->target = (fe_dvec3){target.x, target.y, target.z}, out->eye = (fe_dvec3){eye.x, eye.y, eye.z};
    out->radius = NEAR_SHADOW * farthest;
}

int32_t picture_fit(const fe_world *world, fe_vec3 toward_eye, int32_t width, int32_t height, picture_view *out)
{
    const vec direction = unit(make_vec((double)toward_eye.x, (double)toward_eye.y, (double)toward_eye.z));
    const int32_t count = fe_world_get_bodies(world, NULL, 0);
    if (count < 0) return count;
    const size_t room = (size_t)count + 1;
    fe_body *bodies = malloc(room * sizeof *bodies);
    ball *balls = malloc(room * sizeof *balls);
    double *numbers = malloc(room * sizeof *numbers);
    const int32_t result = bodies && balls && numbers ? FE_OK : FE_ERROR_MEMORY;
    if (result == FE_OK) {
        int32_t kept = gather_balls(world, bodies, fe_world_get_bodies(world, bodies, count), balls);
        kept = leave_strays(balls, kept, middle_of(balls, kept, numbers), numbers);
        aim(balls, kept, direction, (double)height / width, out);
    }
    free(bodies), free(balls), free(numbers);
    return result;
}
