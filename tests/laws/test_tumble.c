// A body that tumbles freely keeps its energy and its angular momentum.
#include "laws/law.h"

// 0.1 % in 10 minutes, in proportion to the time: 100 s are asked. The energies of velocities in float know 1e-6.
static double a_tumbling_body_keeps_its_energy(dice *d, char *told)
{
    enum { SECONDS = 100 };
    rate r = any_rate(d);
    scene s = law_scene(r);
    set_gravity(&s, v3(0, 0, 0));
    double size = spread(d, 0.05, 5), a = size * uniform(d, 0.2, 1), b = size * uniform(d, 0.2, 1);
    fe_geometry form = chance(d, 0.7) ? box(size, a, b) : cylinder(a, size);
    fe_body body = add_dynamic(&s, form, v3(0, 0, 0), any_rotation(d), friction(0.5), (float)spread(d, 100, 10000));
    vec axis = somewhere(d, 1);
    set_velocity(&s, body, v3(0, 0, 0), times(spread(d, 0.3, 20) / fmax(length(axis), 0.1), axis));
    totals before = totals_of(&s, &body, 1);
    double energy = 0, angular = 0;
    for (int i = 0; i < SECONDS; ++i) {
        law_run(&s, r, 1);
        totals now = totals_of(&s, &body, 1);
        energy = fmax(energy, fabs(now.energy / before.energy - 1));
        angular = fmax(angular, fabs(length(now.angular) / length(before.angular) - 1));
    }
    snprintf(told, LAW_TOLD, "%d Hz, %d substeps, half %.3g %.3g %.3g: energy off by %.3g, angular momentum by %.3g",
             r.hertz, r.substeps, size, a, b, energy, angular);
    scene_end(&s);
    return fmax(energy, angular) / (1e-3 * SECONDS / 600 + 1e-6);
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(a_tumbling_body_keeps_its_energy), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
