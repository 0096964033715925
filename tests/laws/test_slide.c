// Friction opposes the slip: what slides without turning goes straight on, whatever its form and heading, and stops
// after v^2 / (2 mu g).
#include "laws/law.h"

// A form that stands on a face at y = 0
typedef struct stander {
    fe_geometry form;
    double up;    // of its origin, m
    double high;  // its greatest height, m
    double least; // from its centre to the nearest edge of the face, m
    const char *name;
} stander;

// A prism on a base of n corners anywhere round an ellipse a x b; its centre of mass is over no point of its contact
static fe_geometry odd_prism(scene *s, dice *d, int n, double a, double b, double half)
{
    float points[6 * 12];
    for (int i = 0; i < n; ++i) {
        double angle = 2 * PI * (i + uniform(d, 0, 0.5)) / n;
        for (int side = 0; side < 2; ++side) {
            float *p = points + 3 * (2 * i + side);
            p[0] = (float)(a * cos(angle)), p[2] = (float)(b * sin(angle)), p[1] = (float)(side ? half : -half);
        }
    }
    return hull(s, points, 2 * n);
}

// Its ratio of sides is 10 : 1 at most; with friction mu it slides and does not tip: mu (its height) < `least`
static stander any_stander(scene *s, dice *d, double mu)
{
    double a = spread(d, 0.2, 2), b = a * spread(d, 0.1, 1), share = uniform(d, 0.2, 0.8);
    int sides = 5 + pick(d, 8);
    stander f = {.least = b};
    switch (pick(d, 6)) {
    case 0:
        f.up = 0.5 * share * fmin(b / mu, a), f.form = box(a, f.up, b), f.name = "box";
        break;
    case 1:
        f.up = 0.5 * share * fmin(b / mu, a), f.form = hull_box(s, a, f.up, b), f.name = "hull box";
        break;
    case 2:
        f.up = 0.5 * share * fmin(a / mu, a), f.form = cylinder(f.up, a), f.name = "cylinder", f.least = a;
        break;
    case 3:
        f.up = 0.5 * share * fmin(a / mu, a), f.form = cone(f.up, a), f.name = "cone", f.least = a;
        break;
    case 4:
        b = a * uniform(d, 0.5, 1), f.least = 0.2 * b;
        f.up = 0.25 * share * fmin(f.least / mu, b), f.form = odd_prism(s, d, sides, a, b, f.up), f.name = "odd prism";
        break;
    default:
        f.up = 0.5 * share * fmin(0.8 * a / mu, a), f.form = hull_prism(s, sides, f.up, a), f.name = "prism";
    }
    return f;
}

// What stands on the cap of a cylinder is asked for by the laws of caps
static ground_kind any_flat_ground(dice *d)
{
    ground_kind kind = any_ground(d);
    return kind == GROUND_CAP ? GROUND_PLANE : kind;
}

static vec centre_of(const scene *s, fe_body body)
{
    fe_dvec3 centre;
    MUST(fe_body_get_centre(s->world, body, &centre));
    return from_world(s, centre);
}

// 1 mm in 5 m beside its line. The way from v is v^2 / (2 mu g) of continuous time; a substep more or less is v h.
static double a_slide_is_straight(dice *d, char *told)
{
    rate r = any_rate(d);
    scene s = law_scene(r);
    ground_kind kind = any_flat_ground(d);
    double mu = uniform(d, 0.2, 1), v = sqrt(2 * mu * G * spread(d, 0.3, 5)), heading = uniform(d, -PI, PI);
    add_level_ground(&s, kind, 8, friction(mu));
    stander f = any_stander(&s, d, mu);
    vec along = v3(cos(heading), 0, sin(heading)), from = plus(times(-2.5, along), v3(0, f.up, 0));
    fe_body body = add_dynamic(&s, f.form, from, turned(v3(0, 1, 0), uniform(d, -PI, PI)), friction(mu),
                               (float)spread(d, 100, 10000));
    law_run(&s, r, 0.5);
    from = centre_of(&s, body);
    set_velocity(&s, body, times(v, along), v3(0, 0, 0));
    law_run(&s, r, v / (mu * G) + 0.2);
    vec way = minus(centre_of(&s, body), from);
    double gone = dot(way, along), beside = fabs(way.x * along.z - way.z * along.x), exact = v * v / (2 * mu * G);
    double length_error = fabs(gone - exact) / (0.005 * exact + v * s.h);
    snprintf(told, LAW_TOLD, "%d Hz, %d substeps, %s on a %s, mu %.3g, %.3g m/s: %.4g m, not %.4g; %.3g mm beside",
             r.hertz, r.substeps, f.name, ground_names[kind], mu, v, gone, exact, 1e3 * beside);
    scene_end(&s);
    return fmax(beside / (0.001 * fmax(exact, 1) / 5), length_error);
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(a_slide_is_straight), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
