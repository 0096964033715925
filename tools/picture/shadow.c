// shadow.c - see shadow.h.
//
// A face does not shade itself (Isidoro, Shadow mapping: GPU-based tips and techniques, GDC 2006, receiver plane depth
// bias): each texel is compared with the depth that the face's own plane has at that texel's centre, exactly where the
// map's depth was taken. What is left is rounding and the bend to the next face.
#include "shadow.h"

#include <stdlib.h>
#include <string.h>

#define STEEPEST 0.06 // cosine: flatter rays light nothing
#define MARGIN 1.8    // texels that a caster must be nearer: hollows that bend a little do not shade themselves
enum { TAPS = 4 };    // texels of a side that are asked

static raster_point texel_of(const shadow *s, vec point)
{
    vec p = sub(point, s->centre);
    double middle = 0.5 * s->map.area.width;
    raster_point at = {middle + s->texels * dot(p, s->across), middle + s->texels * dot(p, s->along)};
    return at;
}

// In texels, > 0 for what is within reach
static double depth_of(const shadow *s, vec point)
{
    return s->texels * dot(sub(point, s->centre), s->sun) + 100.0 * s->map.area.width;
}

// depth changes by a and b from texel to texel
static void slope_of(const shadow *s, vec normal, double *a, double *b)
{
    double n = dot(normal, s->sun);
    *a = -dot(normal, s->across) / n, *b = -dot(normal, s->along) / n;
}

static void cast(shadow *s, const triangle *t)
{
    raster_point corners[3];
    layer_plane plane = {.least = 1e30, .most = 0.0};
    double n = dot(t->normal, s->sun);
    if ((!t->two_sided && n <= 0.0) || (n < 1e-6 && n > -1e-6)) return; // what is closed is drawn by its lit side
    for (int i = 0; i < 3; ++i) {
        double d = depth_of(s, t->corners[i]);
        corners[i] = texel_of(s, t->corners[i]);
        plane.least = d < plane.least ? d : plane.least, plane.most = d > plane.most ? d : plane.most;
    }
    slope_of(s, t->normal, &plane.a, &plane.b);
    plane.c = depth_of(s, t->corners[0]) - plane.a * corners[0].x - plane.b * corners[0].y;
    layer_draw(&s->map, corners, &plane, 0);
}

int32_t shadow_make(const picture_view *view, const camera *camera, const triangle *triangles, int32_t count,
                    int32_t size, shadow *out)
{
    shadow s = {.map = {{size, 0, size}, calloc((size_t)size * (size_t)size, sizeof(float)), NULL}};
    vec sun = make_vec((double)view->sun.x, (double)view->sun.y, (double)view->sun.z);
    vec target = make_vec(view->target.x - view->eye.x, view->target.y - view->eye.y, view->target.z - view->eye.z);
    *out = s;
    if (!s.map.near) return FE_ERROR_MEMORY;
    s.sun = unit(into_camera(camera, sun)), s.centre = into_camera(camera, target);
    // Edges along the world's axes cross the map's rows at a good angle: their steps are short, and are smoothed away
    vec aside = into_camera(camera, make_vec(0.9, 0.1, 0.4)), up = into_camera(camera, make_vec(0.0, 1.0, 0.0));
    if (dot(aside, s.sun) > 0.97 * length(aside)) aside = up;
    s.across = unit(cross(aside, s.sun)), s.along = cross(s.sun, s.across);
    s.texels = 0.5 * size / view->radius;
    for (int32_t i = 0; i < count; ++i)
        if (triangles[i].rgba >> 24 == 255) cast(&s, triangles + i);
    *out = s;
    return FE_OK;
}

void shadow_free(shadow *s) { free(s->map.near); }

// Four texels side by side. Each of the four is rounded as a float alone would be
typedef float four __attribute__((vector_size(16)));
typedef int32_t mask __attribute__((vector_size(16)));

// Of a cubic B-spline: shadows have no steps where their edges cross rows of texels
static four weigh(double t)
{
    double u = 1.0 - t;
    return (four){(float)(u * u * u / 6.0), (float)(2.0 / 3.0 - t * t * (1.0 - 0.5 * t)),
                  (float)(2.0 / 3.0 - u * u * (1.0 - 0.5 * u)), (float)(t * t * t / 6.0)};
}

double shadow_light(const shadow *s, vec point, vec normal)
{
    if (!(dot(normal, s->sun) > STEEPEST)) return 0.0;
    raster_point at = texel_of(s, point);
    double left = at.x - 1.5, top = at.y - 1.5, a, b;
    if (!(left >= 0.0 && top >= 0.0 && left < s->map.area.width - TAPS && top < s->map.area.end - TAPS)) return 1.0;
    int32_t x = (int32_t)left, y = (int32_t)top;
    four across = weigh(left - x), along = weigh(top - y), open = {0, 0, 0, 0};
    slope_of(s, normal, &a, &b);
    float first = (float)(depth_of(s, point) + MARGIN + b * (y + 0.5 - at.y) + a * (x + 0.5 - at.x));
    four least = first + (float)a * (four){0, 1, 2, 3};
    for (int32_t j = 0; j < TAPS; ++j, least += (float)b) {
        four near;
        memcpy(&near, s->map.near + area_at(&s->map.area, x, y + j), sizeof near);
        open += (four)((near <= least) & (mask)(across * along[j]));
    }
    float sum = open[0] + open[1] + (open[2] + open[3]);
    return sum < 0.9999f ? (double)sum : 1.0; // weights add up to 1 but for rounding
}
