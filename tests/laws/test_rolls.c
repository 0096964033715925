// Nothing that lies or rolls on a ground at rest gains energy.
#include "laws/law.h"

static double energy_of(const scene *s)
{
    fe_energy e;
    fe_energy_init(&e, sizeof e);
    MUST(fe_world_get_energy(s->world, &e));
    return e.kinetic + e.potential;
}

// A cone lies on its side and rolls without slipping about its tip. Static friction does no work: it may lose energy,
// but gains none. What crosses a seam has more points there or fewer, and either end of its line rises by what it sinks
// less: m / m_n g / w^2 at most, w = 2 pi min(2 contact_hertz, a quarter of the rate of substeps). At the rim, a
// quarter of the height from the centre of mass, m / m_n is 8/3 for a slender cone: 4 g / w^2 for both ends.
static double a_cone_that_rolls_on_its_side_does_not_drive_itself(dice *d, char *told)
{
    rate r = any_rate(d);
    ground_kind kind = any_ground(d);
    double radius = spread(d, 0.05, 0.5), height = radius * uniform(d, 1.5, 4), lean = atan(radius / height);
    double slow = sqrt(G * radius) * uniform(d, 0.05, 0.2), turn = slow / (0.75 * height * cos(lean)); // rad/s
    double heading = uniform(d, -PI, PI), way = 0.75 * height, spin = -turn / tan(lean);
    scene s = law_scene(r);
    add_level_ground(&s, kind, 8, friction(0.9));
    fe_quat about = turned(v3(0, 1, 0), heading);
    fe_quat over = turned(v3(0, 0, 1), atan2(-sin(lean), -cos(lean)) - PI / 2);
    vec middle = v3(height / 2 * cos(lean), height / 2 * sin(lean), 0);
    fe_body body =
        add_dynamic(&s, cone(height / 2, radius), rotate(about, middle), compose(about, over), friction(0.9), WATER);
    set_velocity(&s, body, rotate(about, v3(0, 0, spin * way * sin(lean))), rotate(about, v3(spin, 0, 0)));
    law_run(&s, r, 0.5);
    double scale = mass_of(&s, body) * G * radius, least = energy_of(&s), gain = 0;
    for (int32_t i = 0; i < 40; ++i) {
        law_run(&s, r, 0.25);
        double now = energy_of(&s);
        gain = fmax(gain, now - least);
        least = fmin(least, now);
    }
    snprintf(told, LAW_TOLD, "%d Hz, %d substeps, a cone of %.3g m, %.3g m high, at %.3g rad/s on a %s: %.3g m g r",
             r.hertz, r.substeps, radius, height, turn, ground_names[kind], gain / scale);
    scene_end(&s);
    double w = 2 * PI * fmin(60, 0.25 * r.hertz * r.substeps);
    return gain / scale / (1e-3 + 4 * G / (w * w) / radius);
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(a_cone_that_rolls_on_its_side_does_not_drive_itself), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
