// light.c - see light.h.
#include "light.h"

static const vec SKY = {0.86, 0.93, 1.03}, EARTH = {0.58, 0.55, 0.51}, SUN = {2.30, 2.20, 2.02};
static const vec UPPER = {0.66, 0.735, 0.815}, LOWER = {0.80, 0.80, 0.795};
#define WHITE 2.6 // light that is white
#define SHOULDER 0.8
#define TINTS 5 // bodies of one hue differ by as many shades
#define TINT 0.045
#define PALE 0.07 // white in every colour

static vec times(vec a, vec b) { return make_vec(a.x * b.x, a.y * b.y, a.z * b.z); }

static double smooth_step(double from, double to, double x)
{
    double t = clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

vec light_of_bytes(uint32_t rgba)
{
    vec c = scale(1.0 / 255.0, make_vec(rgba & 255, rgba >> 8 & 255, rgba >> 16 & 255));
    return times(c, c);
}

void light_make_bytes(light_bytes *out)
{
    for (int32_t i = 0; i <= LIGHT_STEPS; ++i) out->bytes[i] = (uint8_t)(255.0 * sqrt((double)i / LIGHT_STEPS) + 0.5);
}

vec light_background(double down) { return mix(UPPER, LOWER, smooth_step(0.0, 0.75, down)); }

// As Reinhard et al., Photographic tone reproduction, SIGGRAPH 2002, eq. 4, with a weaker shoulder: WHITE becomes 1
static double expose(double x)
{
    const double rise = (1.0 / WHITE + SHOULDER - 1.0) / WHITE;
    return x * (1.0 + rise * x) / (1.0 + SHOULDER * x);
}

// p = t ray on the plane of the face; b are the volumes that p's barycentric coordinates are proportional to
static vec normal_at(const triangle *t, vec ray)
{
    const vec *c = t->corners;
    double b0 = dot(ray, cross(c[1], c[2])), b1 = dot(ray, cross(c[2], c[0])), b2 = dot(ray, cross(c[0], c[1]));
    if (b0 + b1 + b2 < 0.0) b0 = -b0, b1 = -b1, b2 = -b2;
    b0 = b0 > 0.0 ? b0 : 0.0, b1 = b1 > 0.0 ? b1 : 0.0, b2 = b2 > 0.0 ? b2 : 0.0;
    vec n = unit(add(add(scale(b0, t->normals[0]), scale(b1, t->normals[1])), scale(b2, t->normals[2])));
    return dot(n, n) > 0.0 ? n : t->normal;
}

vec light_own(const triangle *t)
{
    vec pale = mix(light_of_bytes(t->rgba), make_vec(1.0, 1.0, 1.0), PALE);
    return scale(1.0 + TINT * (t->body * 2 % TINTS - TINTS / 2), pale);
}

lit light_triangle(const light *l, const triangle *t, vec ray, double down)
{
    vec point = scale(dot(t->normal, t->corners[0]) / dot(t->normal, ray), ray);
    vec face = t->normal, normal = t->flat ? face : normal_at(t, ray);
    if (dot(face, ray) > 0.0) face = scale(-1.0, face), normal = scale(-1.0, normal);
    vec off = sub(point, l->target);
    double far = dot(off, off), r = l->radius;
    lit out = {.haze = far > r * r ? smooth_step(r, 3.0 * r, sqrt(far)) : 0.0};
    if (out.haze >= 1.0) return out.colour = light_background(down), out;
    double slant = dot(normal, l->shadow->sun), open = slant > 0.0 ? shadow_light(l->shadow, point, face) : 0.0;
    vec sky = mix(EARTH, SKY, 0.5 + 0.5 * dot(normal, l->up));
    vec c = times(t->own, slant > 0.0 ? add(sky, scale(slant * open, SUN)) : sky);
    c = make_vec(expose(c.x), expose(c.y), expose(c.z));
    out.half = open > 0.0 && open < 1.0;
    out.colour = out.haze > 0.0 ? mix(c, light_background(down), out.haze) : c;
    return out;
}
