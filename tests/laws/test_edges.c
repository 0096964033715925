// What stands on an edge, or lies on a side, along any level ground at rest has both ends of the line.
#include "laws/law.h"

// A wedge of 6 points: its edge along x, `half` m to each side, is its lowest, the rectangle above it is wider or not
static fe_geometry wedge(scene *s, double half, double high, double top, double thick)
{
    float points[18];
    for (int i = 0; i < 6; ++i) {
        double x = i < 4 ? top : half;
        points[3 * i] = (float)(i & 1 ? x : -x);
        points[3 * i + 1] = (float)(i < 4 ? high : 0);
        points[3 * i + 2] = (float)(i >= 4 ? 0 : i & 2 ? thick : -thick);
    }
    return hull(s, points, 6);
}

typedef struct edged {
    fe_geometry form;
    double under; // how far the line is under the form's origin, m
    fe_quat turn;
    const char *name;
} edged;

static edged any_edged(scene *s, dice *d, double half)
{
    double high = half * uniform(d, 0.3, 1), top = half * uniform(d, 0.5, 2), thick = half * uniform(d, 0.1, 0.5);
    fe_quat on_edge = turned(v3(1, 0, 0), atan2(thick, high));
    double diagonal = sqrt(high * high + thick * thick);
    switch (pick(d, 4)) {
    case 0:
        return (edged){wedge(s, half, high, top, thick), 0, UNTURNED, "wedge"};
    case 1:
        return (edged){box(half, high, thick), diagonal, on_edge, "box"};
    case 2:
        return (edged){hull_box(s, half, high, thick), diagonal, on_edge, "hull of 8 points"};
    default:
        return (edged){cylinder(half, thick), thick, turned(v3(0, 0, 1), PI / 2), "cylinder"};
    }
}

// A body that stands on its line in balance, set down at touch, has two points or more there (a triangle's side may add
// some) and sinks by no more than on two: with m / m_n = 1 + half^2 / k^2, k the least radius of gyration,
// m g / (2 m_n w^2), w = 2 pi min(2 contact_hertz, a quarter of the rate of substeps). The balance on an edge is
// unstable: it is looked at within a time constant of its fall, and as soon as it has sunk.
static double a_line_along_a_ground_has_both_its_ends(dice *d, char *told)
{
    rate r = any_rate(d);
    ground_kind kind = any_ground(d);
    scene s = law_scene(r);
    double half = spread(d, 0.1, 1), heading = uniform(d, -PI, PI);
    add_level_ground(&s, kind, 8, friction(0.6));
    edged k = any_edged(&s, d, half);
    vec place = v3(uniform(d, -2, 2), k.under, uniform(d, -2, 2));
    fe_body body = add_dynamic(&s, k.form, place, compose(turned(v3(0, 1, 0), heading), k.turn), friction(0.6), WATER);
    fe_mass_data m = mass_data_of(&s, body);
    double inertia = fmin((double)m.inertia.x, fmin((double)m.inertia.y, (double)m.inertia.z));
    double w = 2 * PI * fmin(60, 0.25 * r.hertz * r.substeps), start = position(&s, body).y;
    double most = G * (1 + half * half * (double)m.mass / inertia) / (2 * w * w), way = 0;
    int32_t least = 99;
    law_run(&s, r, 0.25);
    for (int32_t i = 0; i < 8; ++i) {
        law_run(&s, r, 1.0 / r.hertz);
        fe_contact c[MOST_CONTACTS];
        int32_t n = fe_body_get_contacts(s.world, body, c, sizeof *c, MOST_CONTACTS), points = 0;
        for (int32_t j = 0; j < n; ++j) points += c[j].point_count;
        if (points < least) least = points;
        way = fmax(way, start - position(&s, body).y);
    }
    snprintf(told, LAW_TOLD, "%d Hz, %d substeps, a %s of %.3g m on a %s: %d points, %.4g mm, at most %.4g", r.hertz,
             r.substeps, k.name, half, ground_names[kind], (int)least, 1e3 * way, 1e3 * most);
    scene_end(&s);
    return least < 2 ? 2 : way / (1.05 * most);
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(a_line_along_a_ground_has_both_its_ends), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
