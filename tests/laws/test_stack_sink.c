// Columns of cubes of every size sink by the law of soft contacts, and the guide's rule for small things keeps each
// overlap below half a percent of the cube.
#include "laws/law.h"

enum { MOST_CUBES = 10 };

typedef struct column {
    double edge;  // m
    double hertz; // contact_hertz
    int count;
    fe_body cubes[MOST_CUBES];
} column;

// w of a contact, 1/s: contact_hertz, twice that against what cannot move, at most an eighth and a quarter of the
// substeps a second
static double frequency(const column *c, rate r, int on_static)
{
    double most = 0.125 * r.hertz * r.substeps;
    return 2 * PI * fmin(c->hertz, most) * (on_static ? 2 : 1);
}

// The overlap of cube i and what is below it. With n - i cubes on it, a contact with what cannot move gives by
// (n - i) g / w^2; between two equal cubes the effective mass is half of that, so that it gives by 2 (n - i) g / w^2.
static double expected_overlap(const column *c, rate r, int i)
{
    double w = frequency(c, r, i == 0);
    return (i ? 2 : 1) * (c->count - i) * G / (w * w);
}

static scene column_at_rest(column *c, rate r, dice *d)
{
    scene s = law_scene(r);
    fe_world_tuning tuning = {.struct_size = sizeof tuning};
    MUST(fe_world_get_tuning(s.world, &tuning));
    tuning.contact_hertz = (float)c->hertz;
    MUST(fe_world_set_tuning(s.world, &tuning));
    add_level_ground(&s, any_ground(d), 10 * c->edge, friction(0.6));
    double half = 0.5 * c->edge, heading = uniform(d, -PI, PI), density = spread(d, 100, 10000);
    fe_geometry form = chance(d, 0.5) ? box(half, half, half) : hull_box(&s, half, half, half);
    // on one tile of the compound, whose tiles end at multiples of 5 edges
    double x = 5 * half, z = -5 * half;
    for (int i = 0; i < c->count; ++i)
        c->cubes[i] = add_dynamic(&s, form, v3(x, (2 * i + 1) * half, z), turned(v3(0, 1, 0), heading), friction(0.6),
                                  (float)density);
    // The springs are 10 times overdamped: the slowest mode of n cubes falls as exp(-w t / 20 (pi / 2 n)^2).
    double slowest = frequency(c, r, 0) / 20 * pow(PI / (2 * c->count), 2);
    law_run(&s, r, fmax(1, 7 / slowest));
    return s;
}

static double overlap(const scene *s, const column *c, int i)
{
    double below = i ? position(s, c->cubes[i - 1]).y : -0.5 * c->edge;
    return c->edge - (position(s, c->cubes[i]).y - below);
}

static void tell(char *told, const column *c, rate r, int i, double found, double allowed)
{
    snprintf(told, LAW_TOLD, "%d Hz, %d substeps, %d cubes of %.3g m, %.3g Hz: cube %d overlaps by %.4g mm, not %.4g",
             r.hertz, r.substeps, c->count, c->edge, c->hertz, i, 1e3 * found, 1e3 * allowed);
}

static double a_column_sinks_by_the_formula(dice *d, char *told)
{
    rate r = any_rate(d);
    column c = {.edge = spread(d, 0.01, 2), .hertz = spread(d, 15, 240), .count = 1 + pick(d, MOST_CUBES)};
    // An overlap beyond a tenth of the cube has other features than the faces that touch.
    double w = frequency(&c, r, 0);
    c.count = (int)fmax(1, fmin(c.count, 0.1 * c.edge * w * w / (2 * G)));
    scene s = column_at_rest(&c, r, d);
    double worst = 0;
    for (int i = 0; i < c.count; ++i) {
        double found = overlap(&s, &c, i), expected = expected_overlap(&c, r, i);
        double share = fabs(found - expected) / (0.05 * expected + ldexp(10 * c.edge, -23));
        if (share > worst) worst = share, tell(told, &c, r, i, found, expected);
    }
    scene_end(&s);
    return worst;
}

// A contact with k cubes on it gives by at most 2 k g / (2 pi f)^2: that is half a percent of the edge L at
// f = sqrt(400 k g / L) / (2 pi) = 10 sqrt(k / L), L in m. The limit of the hertz asks for 8 f / rate substeps.
static double the_rule_for_small_things_holds_them(dice *d, char *told)
{
    rate r = any_rate(d);
    column c = {.edge = spread(d, 0.01, 1), .count = 1 + pick(d, MOST_CUBES)};
    c.hertz = 10 * sqrt(fmax(1, c.count - 1) / c.edge);
    if (8 * c.hertz > 64 * r.hertz) r.hertz = 120; // a step has at most 64 substeps
    r.substeps = (int)fmax(4, ceil(8 * c.hertz / r.hertz));
    scene s = column_at_rest(&c, r, d);
    double worst = 0;
    for (int i = 0; i < c.count; ++i) {
        double found = overlap(&s, &c, i), allowed = 0.005 * c.edge;
        if (!(found / allowed <= worst)) worst = found / allowed, tell(told, &c, r, i, found, allowed);
    }
    scene_end(&s);
    return worst;
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(a_column_sinks_by_the_formula), 300},
                               {LAW(the_rule_for_small_things_holds_them), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
