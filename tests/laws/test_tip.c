// What stands on a slope tips over the edge of its base: a disc, or a polygon of up to 64 corners, at any heading.
#include "laws/law.h"

// A body stands on its base until its centre of mass, c above it, is no longer over it:  tan(slope) = rho / c,  rho the
// distance from the centre to the edge of the base down the slope: r of a disc, of a polygon whose nearest side looks
// phi from there r cos(pi / n) / cos(phi).
typedef struct stander {
    fe_geometry form;
    double r, c, rho, half; // m; half of the height
    double inertia;         // about the edge, over the mass, m2
    int32_t sides;          // 0: a disc
    const char *name;
} stander;

static stander any_stander(scene *s, dice *d, double heading)
{
    stander f = {.r = spread(d, 0.02, 2)};
    double slope = uniform(d, 8, 55) * PI / 180, rr = f.r * f.r;
    int32_t kind = pick(d, 3);
    f.rho = f.r;
    if (kind == 2) {
        f.sides = 8 + pick(d, 57);
        double sector = 2 * PI / f.sides, phi = remainder(heading, sector); // of a side's normal
        f.rho = f.r * cos(0.5 * sector) / cos(phi);
    }
    f.c = f.rho / tan(slope);
    f.half = kind == 1 ? 2 * f.c : f.c;
    double across = kind == 1 ? 0.15 * (rr + f.half * f.half) : 0.25 * rr + f.half * f.half / 3;
    f.inertia = across + f.rho * f.rho + f.c * f.c;
    f.form = kind == 0 ? cylinder(f.half, f.r) : kind == 1 ? cone(f.half, f.r) : hull_prism(s, f.sides, f.half, f.r);
    f.name = kind == 0 ? "cylinder" : kind == 1 ? "cone" : "prism";
    return f;
}

// Gravity as on ground that slopes by `angle` down along x; or a push along x on level ground, with the moment about
// the base that gravity has on the slope, at the height y above the base: F = m g (c / y) tan(angle).
static void load(scene *s, fe_body body, const stander *f, double push_height, double angle)
{
    if (push_height <= 0) {
        set_gravity(s, v3(G * sin(angle), -G * cos(angle), 0));
        return;
    }
    double force = mass_data_of(s, body).mass * G * f->c / push_height * tan(angle);
    add_force_at(s, body, v3(force, 0, 0), plus(position(s, body), v3(0, push_height - f->half, 0)));
}

// The slope or the push grows, ever so slowly, from level to the angle and beyond. The time in which a lean grows by a
// factor e is T,  T^2 = I / (m g sqrt(rho^2 + c^2)).  What passes the angle at a rate of 0.02 degrees in T leans by 1
// degree more some 6 T later: 0.12 degrees late. Soft contacts: at the angle one point of the edge may bear all. It
// sinks by m g / (m_n w^2), with its effective mass 1/m_n < (1/m) (1 + rho^2 m / I_c), and what stands on it leans by
// half of that over rho. The load passes from one end of an edge to the other at once, and a spring that is loaded at
// once gives twice as far: it tips earlier by as much. Besides, a substep moves what is free by g h^2, and no face is
// met better than that, on either side: 2 g h^2 / rho. A corner that bears alone sinks beside the other end of its
// side, of length w: the body rolls by sink / w, twice as far at once, and its centre moves by 2 c sink / w along the
// side. Past the side's end the next turns away by w / r: it is nearer by 2 c sink / r, as if what stands there leaned
// by 2 sink / r more. Not on several parts: there it has points of its own on each, and none knows where the load of
// the others is.
static double it_tips_over_the_edge_of_its_base(dice *d, char *told)
{
    rate r = any_rate(d);
    scene s = law_scene(r);
    ground_kind kind;
    while ((kind = any_ground(d)) == GROUND_COMPOUND) continue;
    double heading = uniform(d, -PI, PI);
    stander f = any_stander(&s, d, heading);
    double exact = atan(f.rho / f.c), size = fmax(6, 6 * f.r), mu = 3 + 2 * tan(exact);
    add_level_ground(&s, kind, size, friction(mu));
    vec at = v3(uniform(d, -0.1, 0.1) * size, f.half, uniform(d, -0.1, 0.1) * size);
    fe_body body = add_dynamic(&s, f.form, at, turned(v3(0, 1, 0), heading), friction(mu), WATER);
    double degree = PI / 180, t = sqrt(f.inertia / (G * sqrt(f.rho * f.rho + f.c * f.c)));
    double w = 2 * PI * fmin(60, 0.25 * r.hertz * r.substeps), least = f.inertia - f.rho * f.rho - f.c * f.c;
    double sink = G * (1 + f.rho * f.rho / least) / (w * w), lean = 0.5 * sink / f.rho;
    double roll = f.sides ? sink / (f.r * sin(PI / f.sides)) : 0, nearer = f.sides ? 2 * sink / f.r : 0;
    double below = 0.3 * degree + 2 * lean + nearer + 2 * G * s.h * s.h / f.rho, above = 0.3 * degree;
    double push = chance(d, 0.3) ? uniform(d, 0.5, 1.5) * f.c : 0;
    double dt = 1.0 / r.hertz, angle = 0, from = fmax(0, exact - below - 1 * degree), fallen = -1;
    for (double time = 0; fallen < 0 && angle < exact + 3 * above; time += dt) {
        angle += (angle < from ? from / (40 * t) : 0.02 * degree / t) * dt;
        load(&s, body, &f, push, angle);
        law_run(&s, r, dt);
        if (tilt(&s, body) > 1 * degree + 2 * lean + roll) fallen = angle;
    }
    if (fallen < 0) fallen = angle;
    double error = fallen - exact, share = error < 0 ? -error / below : error / above;
    snprintf(
        told, LAW_TOLD,
        "%d Hz, %d substeps, %s of %d sides, r %.3g, c %.3g, heading %.3g on a %s, pushed at %.3g: %.2f, not %.2f deg",
        r.hertz, r.substeps, f.name, f.sides, f.r, f.c, heading, ground_names[kind], push, fallen / degree,
        exact / degree);
    scene_end(&s);
    return share;
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(it_tips_over_the_edge_of_its_base), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
