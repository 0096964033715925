// rim.c - what cylinder and cone share: a circle about the y axis.
#include "collision/form/kinds.h"

#define C1 0.92387953f // cosines of 22.5, 45 and 67.5 degrees
#define C2 0.70710678f
#define C3 0.38268343f
// Those of an aimed rim: 0 and 6 degrees, seven sectors of 174 / 7 degrees to 180 and 186, and as many back.
const float fe__rim_points[2][FE_RIM_POINTS][2] = {{{1, 0},
                                                    {C1, C3},
                                                    {C2, C2},
                                                    {C3, C1},
                                                    {0, 1},
                                                    {-C3, C1},
                                                    {-C2, C2},
                                                    {-C1, C3},
                                                    {-1, 0},
                                                    {-C1, -C3},
                                                    {-C2, -C2},
                                                    {-C3, -C1},
                                                    {0, -1},
                                                    {C3, -C1},
                                                    {C2, -C2},
                                                    {C1, -C3}},
                                                   {{1, 0},
                                                    {0.99452190f, 0.10452846f},
                                                    {0.85844879f, 0.51289928f},
                                                    {0.56332006f, 0.82623877f},
                                                    {0.16381791f, 0.98649059f},
                                                    {-0.26603685f, 0.96396286f},
                                                    {-0.64659960f, 0.76282957f},
                                                    {-0.90735869f, 0.42035723f},
                                                    {-1, 0},
                                                    {-0.99452190f, -0.10452846f},
                                                    {-0.85844879f, -0.51289928f},
                                                    {-0.56332006f, -0.82623877f},
                                                    {-0.16381791f, -0.98649059f},
                                                    {0.26603685f, -0.96396286f},
                                                    {0.64659960f, -0.76282957f},
                                                    {0.90735869f, -0.42035723f}}};
#define AIMED_COS 0.99862953f // of 3 degrees, by which the first point stands beside the aim
#define AIMED_SIN 0.05233596f

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

// An angle about y, from x to z
typedef struct angle {
    float cosine, sine;
} angle;

// Does the load lean over half of the radius or more, and that way alone? The square of the points that stay with the
// body holds what leans less. `drop`: how far the rim's lowest point, at `low`, is below its centre, m
static int32_t is_aimed(float radius, float drop, angle low, const fe_vec3 *foot, angle *aim)
{
    const float leans = 0.5f, same_way = 0.9f; // of the radius; cosine
    if (!foot) return 0;
    float away = sqrtf(foot->x * foot->x + foot->z * foot->z);
    if (!(away > leans * radius)) return 0;
    *aim = (angle){foot->x / away, foot->z / away};
    if (!(drop > fe__minf(LEVEL, LEVEL_SHARE * radius))) return 1;
    return drop <= fe__most_lean(radius) && aim->cosine * low.cosine + aim->sine * low.sine > same_way;
}

// A face gives some points of its rim. At equal angles, the first along x, they stay with the body, so that what stands
// keeps its contacts; but where the face leans, one of them is the deepest point. All turn left around the normal:
// against the sense from x to z where it looks up.
void fe__rim_face(float radius, float y, fe_vec3 direction, fe__face *face)
{
    float across = sqrtf(direction.x * direction.x + direction.z * direction.z),
          drop = radius * across / fe__length(direction), left = y > 0.0f ? -1.0f : 1.0f;
    const float(*points)[2] = fe__rim_points[0];
    angle low = {0.0f, 0.0f}, first = {1.0f, 0.0f}, aim;
    int32_t nearest = 0;
    face->pattern = FE_RIM_LIES;
    if (drop > fe__minf(LEVEL, LEVEL_SHARE * radius)) {
        face->pattern = FE_RIM_LEANS;
        low = (angle){direction.x / across, direction.z / across};
        float most = -2.0f;
        for (int32_t i = 0; i < FE_RIM_POINTS; ++i) {
            float along = low.cosine * points[i][0] + left * low.sine * points[i][1];
            if (along > most) most = along, nearest = i;
        }
        const float *p = points[nearest];
        first = (angle){low.cosine * p[0] + left * low.sine * p[1], low.sine * p[0] - left * low.cosine * p[1]};
    }
    if (is_aimed(radius, drop, low, face->foot, &aim)) {
        face->pattern = FE_RIM_AIMED, points = fe__rim_points[1], nearest = 0;
        first = (angle){aim.cosine * AIMED_COS + left * aim.sine * AIMED_SIN,
                        aim.sine * AIMED_COS - left * aim.cosine * AIMED_SIN};
    }
    face->count = FE_RIM_POINTS;
    face->normal = fe__vec3(0.0f, -left, 0.0f);
    face->id = y > 0.0f ? 2u : 1u;
    face->rim = radius;
    face->low = nearest;
    for (int32_t i = 0; i < FE_RIM_POINTS; ++i) {
        float c = points[i][0], s = left * points[i][1];
        face->vertex[i] =
            fe__vec3(radius * (first.cosine * c - first.sine * s), y, radius * (first.cosine * s + first.sine * c));
    }
}
