// toi.c - see toi.h.
#include "collision/cast/toi.h"

#include "collision/cast/cast_kinds.h"

// What comes this near so slowly is taken for a touch. A stick of length l that turns past a wall, its tip e off, takes
// pi (2 l / e)^(1/2) steps: 450 at a ten-thousandth of its length.
enum { MOST_ADVANCES = 512 };

static fe_quat part_of(fe_quat rotation, double s)
{
    float t = (float)s;
    return (fe_quat){t * rotation.x, t * rotation.y, t * rotation.z, 1.0f + t * (rotation.w - 1.0f)};
}

fe__pose fe__motion_at(const fe__motion *m, double s)
{
    fe__pose pose = {fe__dadd(m->centre, fe__dscale(s, m->translation)), m->rotation};
    const fe_quat q = m->angular_displacement;
    if (q.x != 0.0f || q.y != 0.0f || q.z != 0.0f)
        pose.rotation = fe__normalized(fe__product(part_of(q, s), m->rotation));
    return pose;
}

fe__pose fe__mobile_at(const fe__mobile *mobile, double s)
{
    fe__pose body = fe__motion_at(&mobile->motion, s);
    return (fe__pose){fe__dadd(body.position, fe__drotate(body.rotation, mobile->arm)),
                      fe__normalized(fe__product(body.rotation, mobile->rotation))};
}

// The core's farthest point from the body's centre; a radius turns without moving anything.
static double reach_of(const fe__mobile *mobile)
{
    fe__form core = *mobile->form;
    core.radius = 0.0f;
    return (double)fe__form_reach(&core, fe__narrow(fe__drotate_back(mobile->rotation, fe__dscale(-1.0, mobile->arm))));
}

// With the angular displacement q and its half angle f, normalize(1 + s (q - 1)) rotates fastest at s = 1/2:
// 4 tan(f / 2) = 4 sin f / (1 + cos f), rad. The axis stands still, so that a point at r moves along n by
// n.(w x r) = (n x w).r.
static double turning_along(const fe__mobile *mobile, double reach, fe_dvec3 n)
{
    fe_quat q = mobile->motion.angular_displacement;
    fe_dvec3 axis = {(double)q.x, (double)q.y, (double)q.z}, across = fe__dcross(n, axis);
    return 4.0 / (1.0 + (double)q.w) * sqrt(fe__ddot(across, across)) * reach;
}

// Speed along n, m per unit of s, of a point at p on the body as it is at s
static double speed_there(const fe__motion *m, double s, fe_dvec3 p, fe_dvec3 n)
{
    const fe_quat q = m->angular_displacement;
    fe_dvec3 spin = {2.0 * (double)q.x, 2.0 * (double)q.y, 2.0 * (double)q.z};
    fe_dvec3 arm = fe__dsub(p, fe__dadd(m->centre, fe__dscale(s, m->translation)));
    return fe__ddot(n, fe__dadd(m->translation, fe__dcross(spin, arm)));
}

// What all but touches, as the leg before may have ended, touches if it comes nearer.
static int32_t comes_nearer(const fe__mobile *a, const fe__mobile *b, double s, const fe__gap *gap)
{
    return speed_there(&a->motion, s, gap->on_b, gap->normal) > speed_there(&b->motion, s, gap->on_b, gap->normal);
}

// The plane that separates A and B across n is closed no faster than that, m per unit of s.
fe__meeting fe__time_of_impact(const fe__mobile *a, const fe__mobile *b, double limit, fe__impact *impact)
{
    fe_dvec3 closing = fe__dsub(a->motion.translation, b->motion.translation);
    double reach_a = reach_of(a), reach_b = reach_of(b);
    impact->s = 0.0;
    for (int32_t i = 0; i < MOST_ADVANCES; ++i) {
        fe__pose pose_a = fe__mobile_at(a, impact->s), pose_b = fe__mobile_at(b, impact->s);
        fe__gap gap;
        fe__form_gap(a->form, &pose_a, b->form, &pose_b, &gap);
        impact->normal = gap.normal, impact->on_b = gap.on_b, impact->overlap = gap.overlap;
        if (gap.overlap || gap.distance <= 0.0) return i > 0 ? FE_MEET_LATER : FE_MEET_NOW;
        if (gap.distance <= FE_TOUCH && comes_nearer(a, b, impact->s, &gap)) return FE_MEET_LATER;
        double speed = fe__ddot(gap.normal, closing) + turning_along(a, reach_a, gap.normal) +
                       turning_along(b, reach_b, gap.normal);
        // half of the touching distance is left, so that the next look finds a normal
        double way = fe__maxd(gap.distance - 0.5 * FE_TOUCH, 0.25 * FE_TOUCH);
        if (!(speed * (limit - impact->s) > way)) return FE_MEET_NEVER;
        impact->s += way / speed;
    }
    return FE_MEET_LATER;
}
