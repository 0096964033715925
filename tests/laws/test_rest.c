// What stands level on any level ground sinks into it by the law of soft contacts, and by no more.
#include "laws/law.h"

// Each of the four points at the corners (+-a, +-c) of a base is a spring of stiffness m_n w^2. With the effective mass
// m_n of its point, 1/m_n = 1/m + c^2/Ix + a^2/Iz, the box sinks by m g / (4 m_n w^2), where
// w = 2 pi min(2 contact_hertz, a quarter of the rate of substeps) against what cannot move (P1).
static double a_box_rests_at_the_predicted_overlap(dice *d, char *told)
{
    rate r = any_rate(d);
    scene s = law_scene(r);
    ground_kind kind = any_ground(d);
    double a = spread(d, 0.05, 2), b = a * uniform(d, 0.3, 1), c = a * uniform(d, 0.3, 1);
    double ground = spread(d, 8, 500);
    add_level_ground(&s, kind, ground, friction(uniform(d, 0.3, 1)));
    fe_geometry form = chance(d, 0.5) ? box(a, b, c) : hull_box(&s, a, b, c);
    double x = uniform(d, -2, 2), z = uniform(d, -2, 2), heading = uniform(d, -PI, PI);
    fe_body body =
        add_dynamic(&s, form, v3(x, b, z), turned(v3(0, 1, 0), heading), friction(0.6), (float)spread(d, 100, 10000));
    law_run(&s, r, 3);
    double w = 2 * PI * fmin(60, 0.25 * r.hertz * r.substeps);
    double share = 1 + 3 * c * c / (b * b + c * c) + 3 * a * a / (a * a + b * b); // m / m_n
    double way = b - position(&s, body).y, expected = G * share / (4 * w * w);
    snprintf(told, LAW_TOLD, "%d Hz, %d substeps, half %.3g %.3g %.3g on a %s: %.4g mm, not %.4g", r.hertz, r.substeps,
             a, b, c, ground_names[kind], 1e3 * way, 1e3 * expected);
    scene_end(&s);
    // A box across several tiles has four points on each: it sinks less.
    double error = kind == GROUND_COMPOUND ? fmax(0, way - expected) : fabs(way - expected);
    // The narrow phase computes in float in the ground's frame: a corner has a unit in the last place of its size.
    return error / (0.05 * expected + ldexp(ground, -23));
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(a_box_rests_at_the_predicted_overlap), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
