// rim.c - what cylinder and cone share: a circle about the y axis.
#include "collision/form/kinds.h"

// A face gives as many points of its rim, the first along x, each a sector on. They stay with the body, so that what
// stands keeps its contacts; but where the face leans, one of them is the deepest point.
enum { SECTORS = FE_FACE_VERTICES };
#define C1 0.92387953f // cosines of 22.5, 45 and 67.5 degrees
#define C2 0.70710678f
#define C3 0.38268343f
static const float sector[SECTORS][2] = {{1, 0},    {C1, C3},  {C2, C2},  {C3, C1},   {0, 1},     {-C3, C1},
                                         {-C2, C2}, {-C1, C3}, {-1, 0},   {-C1, -C3}, {-C2, -C2}, {-C3, -C1},
                                         {0, -1},   {C3, -C1}, {C2, -C2}, {C1, -C3}};
// A rim whose lowest point is no farther below its centre than this, m, and this share of the radius, lies flat: a
// twentieth of the solver's slop of 5 mm
#define LEVEL 0.00025f
#define LEVEL_SHARE 0.005f

fe_dvec3 fe__rim_support(float radius, double y, fe_dvec3 direction)
{
    double square = direction.x * direction.x + direction.z * direction.z;
    if (!(square > 0.0)) return (fe_dvec3){0.0, y, 0.0};
    double scale = (double)radius / sqrt(square);
    return (fe_dvec3){scale * direction.x, y, scale * direction.z};
}

void fe__rim_face(float radius, float y, fe_vec3 direction, fe__face *face)
{
    float across = sqrtf(direction.x * direction.x + direction.z * direction.z), turn_cos = 1.0f, turn_sin = 0.0f;
    int32_t nearest = 0, up = y > 0.0f;
    if (radius * across > fe__minf(LEVEL, LEVEL_SHARE * radius) * fe__length(direction)) {
        float x = direction.x / across, z = direction.z / across;
        for (int32_t i = 1; i < SECTORS; ++i)
            if (x * sector[i][0] + z * sector[i][1] > x * sector[nearest][0] + z * sector[nearest][1]) nearest = i;
        turn_cos = x * sector[nearest][0] + z * sector[nearest][1];
        turn_sin = z * sector[nearest][0] - x * sector[nearest][1];
    }
    face->count = SECTORS;
    face->normal = fe__vec3(0.0f, up ? 1.0f : -1.0f, 0.0f);
    face->id = 1u + (uint32_t)up;
    face->rim = radius;
    face->low = up ? (SECTORS - nearest) % SECTORS : nearest;
    for (int32_t i = 0; i < SECTORS; ++i) { // left around the normal: against the sense from x to z where it looks up
        const float *s = sector[up ? (SECTORS - i) % SECTORS : i];
        face->vertex[i] =
            fe__vec3(radius * (turn_cos * s[0] - turn_sin * s[1]), y, radius * (turn_cos * s[1] + turn_sin * s[0]));
    }
}
