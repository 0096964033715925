// toi.c - conservative advancement of two moving forms; see toi.h.
#include "collision/cast/toi.h"

#include "collision/cast/cast_kinds.h"

// Forms that come near so slowly that they need more steps count as touching. A stick of length l that turns past a
// wall, with its tip e off, takes pi (2 l / e)^(1/2) steps: 450 at a ten-thousandth of its length.
enum { MOST_ADVANCES = 512 };

fe__pose fe__motion_at(const fe__motion *m, double s)
{
    fe__pose pose = {fe__dadd(m->centre, fe__dscale(s, m->translation)), m->rotation};
    const fe_quat q = m->angular_displacement;
    if (q.x != 0.0f || q.y != 0.0f || q.z != 0.0f) {
        float t = (float)s;
        fe_quat part = {t * q.x, t * q.y, t * q.z, 1.0f + t * (q.w - 1.0f)};
        pose.rotation = fe__normalized(fe__product(part, m->rotation));
    }
    return pose;
}

fe__pose fe__mobile_at(const fe__mobile *mobile, double s)
{
    fe__pose body = fe__motion_at(&mobile->motion, s);
    return (fe__pose){fe__dadd(body.position, fe__drotate(body.rotation, mobile->arm)),
                      fe__normalized(fe__product(body.rotation, mobile->rotation))};
}

// The distance of the core's farthest point from the body's centre. The radius around the core does not count: no turn
// moves it.
static double arm_of(const fe__mobile *mobile)
{
    fe__form core = *mobile->form;
    core.radius = 0.0f;
    return (double)fe__form_reach(&core, fe__narrow(fe__drotate_back(mobile->rotation, fe__dscale(-1.0, mobile->arm))));
}

// The greatest speed along n, m per unit of s, that the rotation gives a point as far as `reach` from the centre. With
// the angular displacement q and its half angle f, normalize(1 + s (q - 1)) rotates fastest at s = 1/2:
// 4 tan(f / 2) = 4 sin f / (1 + cos f), rad. The axis w stands still, so that a point at r moves along n by
// n.(w x r) = (n x w).r.
static double turning_along(const fe__mobile *mobile, double reach, fe_dvec3 n)
{
    fe_quat q = mobile->motion.angular_displacement;
    fe_dvec3 axis = {(double)q.x, (double)q.y, (double)q.z}, across = fe__dcross(n, axis);
    return 4.0 / (1.0 + (double)q.w) * sqrt(fe__ddot(across, across)) * reach;
}

// The speed along n, m per unit of s, of the body's point that is at p at the time s.
static double speed_along(const fe__motion *m, double s, fe_dvec3 p, fe_dvec3 n)
{
    const fe_quat q = m->angular_displacement;
    fe_dvec3 spin = {2.0 * (double)q.x, 2.0 * (double)q.y, 2.0 * (double)q.z};
    fe_dvec3 arm = fe__dsub(p, fe__dadd(m->centre, fe__dscale(s, m->translation)));
    return fe__ddot(n, fe__dadd(m->translation, fe__dcross(spin, arm)));
}

// The gap along n closes no faster than the sum of both bodies' greatest speeds along n, m per unit of s.
fe__meeting fe__time_of_impact(const fe__mobile *a, const fe__mobile *b, double limit, fe__impact *impact)
{
    fe_dvec3 closing = fe__dsub(a->motion.translation, b->motion.translation);
    double arm_a = arm_of(a), arm_b = arm_of(b);
    impact->s = 0.0;
    for (int32_t i = 0; i < MOST_ADVANCES; ++i) {
        fe__pose pose_a = fe__mobile_at(a, impact->s), pose_b = fe__mobile_at(b, impact->s);
        fe__gap gap;
        fe__form_gap(a->form, &pose_a, b->form, &pose_b, &gap);
        impact->normal = gap.normal, impact->on_b = gap.on_b, impact->overlap = gap.overlap;
        if (gap.overlap || gap.distance <= 0.0) return i > 0 ? FE_MEET_LATER : FE_MEET_NOW;
        // The motion before this one may have ended all but touching: only bodies that come nearer touch.
        if (gap.distance <= FE_TOUCH && speed_along(&a->motion, impact->s, gap.on_b, gap.normal) >
                                            speed_along(&b->motion, impact->s, gap.on_b, gap.normal))
            return FE_MEET_LATER;
        double speed =
            fe__ddot(gap.normal, closing) + turning_along(a, arm_a, gap.normal) + turning_along(b, arm_b, gap.normal);
        // Half of the touching distance is left, so that the next step finds a normal.
        double way = fe__maxd(gap.distance - 0.5 * FE_TOUCH, 0.25 * FE_TOUCH);
        if (!(speed * (limit - impact->s) > way)) return FE_MEET_NEVER;
        impact->s += way / speed;
    }
    return FE_MEET_LATER;
}
