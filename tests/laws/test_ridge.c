// What lies across the ridge of a heightfield is at rest, however flat the ridge.
#include "laws/law.h"
#include "scenes/terrain.h"

enum { CELLS = 20 };
static double left_slope, right_slope; // of the field that is made

static double ridge(double x, double z)
{
    (void)z;
    return x < 0 ? left_slope * x : -right_slope * x;
}

// A box, a hull or a cylinder on its cap is set down across a ridge whose sides fall by up to 2 degrees, with its centre
// over the ridge, but for a tenth of its width. No side of the ridge bears it alone: it leans to one or the other, or
// stands on the crest, and rests there. It sleeps within 5 s, and until then it has come down by no more than leaning
// may take it: its half diagonal times the steeper slope, beside the sink of soft contacts.
static double what_lies_across_a_ridge_rests(dice *d, char *told)
{
    static const char *const names[] = {"box", "hull", "cylinder"};
    rate r = any_rate(d);
    scene s = law_scene(r);
    int kind = pick(d, 3);
    double size = spread(d, 0.2, 2), wide = size * uniform(d, 0.5, 1), high = size * uniform(d, 0.2, 0.6);
    double cell = size * uniform(d, 0.5, 2), corner = -cell * CELLS / 2;
    left_slope = uniform(d, 0, 0.035), right_slope = uniform(d, 0, 0.035);
    double yaw = uniform(d, 0, 2 * PI), x = size * uniform(d, -0.1, 0.1);
    fe_geometry form = kind == 0 ? box(size, high, wide) : kind == 1 ? hull_box(&s, size, high, wide) : cylinder(high, size);
    add_field(&s, CELLS, cell, corner, corner, ridge, friction(0.6));
    fe_body body = add_dynamic(&s, form, v3(x, high, 0), turned(v3(0, 1, 0), yaw), friction(0.6), WATER);
    let_sleep(&s, body);
    double before = position(&s, body).y;
    int asleep_at = -1;
    for (int step = 0; step < 5 * r.hertz && asleep_at < 0; ++step) {
        law_run(&s, r, 1.0 / r.hertz);
        if (!is_awake(&s, body)) asleep_at = step;
    }
    double fell = before - position(&s, body).y;
    double allowed = hypot(size, wide) * fmax(left_slope, right_slope) + 4 * sink(G, 1, 1);
    snprintf(told, LAW_TOLD, "%d Hz, %d substeps, %s %.3g x %.3g x %.3g m, cells of %.3g m, slopes %.3g %.3g, yaw %.3g, x %.3g: "
                             "asleep after %.3g s, %.3g of %.3g mm",
             r.hertz, r.substeps, names[kind], size, high, wide, cell, left_slope, right_slope, yaw, x,
             (double)asleep_at / r.hertz, 1e3 * fell, 1e3 * allowed);
    scene_end(&s);
    return asleep_at < 0 ? 2 : fell / allowed;
}

int main(int argc, char **argv)
{
    return law_main(argc, argv, (law[]){{LAW(what_lies_across_a_ridge_rests), 200}}, 1);
}
