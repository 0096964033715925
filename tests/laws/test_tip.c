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

// A stander on ground of a kind, with what its softness allows
typedef struct trial {
    rate r;
    scene s;
    ground_kind kind;
    stander f;
    fe_body body;
    double heading, exact;     // rad
    double t;                  // s, in which a lean grows by a factor e:  T^2 = I / (m g sqrt(rho^2 + c^2))
    double lean, roll, nearer; // rad, see below
} trial;

// Soft contacts: at the angle one point of the edge may bear all. It sinks by m g / (m_n w^2), with its effective mass
// 1/m_n < (1/m) (1 + rho^2 m / I_c), and what stands on it leans by half of that over rho. A corner that bears alone
// sinks beside the other end of its side, of length w: the body rolls by sink / w, twice as far at once, and its centre
// moves by 2 c sink / w along the side. Past the side's end the next turns away by w / r: it is nearer by 2 c sink / r,
// as if what stands there leaned by 2 sink / r more. Not on several parts: there it has points of its own on each, and
// none knows where the load of the others is.
static trial any_trial(dice *d)
{
    trial t = {.r = any_rate(d)};
    t.s = law_scene(t.r);
    while ((t.kind = any_ground(d)) == GROUND_COMPOUND) continue;
    t.heading = uniform(d, -PI, PI);
    t.f = any_stander(&t.s, d, t.heading);
    const stander *f = &t.f;
    t.exact = atan(f->rho / f->c);
    double size = fmax(6, 6 * f->r), mu = 3 + 2 * tan(t.exact), square = f->rho * f->rho + f->c * f->c;
    add_level_ground(&t.s, t.kind, size, friction(mu));
    vec at = v3(uniform(d, -0.1, 0.1) * size, f->half, uniform(d, -0.1, 0.1) * size);
    t.body = add_dynamic(&t.s, f->form, at, turned(v3(0, 1, 0), t.heading), friction(mu), WATER);
    t.t = sqrt(f->inertia / (G * sqrt(square)));
    double w = 2 * PI * fmin(60, 0.25 * t.r.hertz * t.r.substeps);
    double sink = G * (1 + f->rho * f->rho / (f->inertia - square)) / (w * w);
    t.lean = 0.5 * sink / f->rho;
    t.roll = f->sides ? sink / (f->r * sin(PI / f->sides)) : 0, t.nearer = f->sides ? 2 * sink / f->r : 0;
    return t;
}

static int32_t has_tipped(const trial *t) { return tilt(&t->s, t->body) > 1 * DEGREES + 2 * t->lean + t->roll; }

static void tell(char *told, const trial *t, double push, double fallen)
{
    snprintf(
        told, LAW_TOLD,
        "%d Hz, %d substeps, %s of %d sides, r %.3g, c %.3g, heading %.3g on a %s, pushed at %.3g: %.2f, not %.2f deg",
        t->r.hertz, t->r.substeps, t->f.name, t->f.sides, t->f.r, t->f.c, t->heading, ground_names[t->kind], push,
        fallen / DEGREES, t->exact / DEGREES);
}

// The slope or the push grows, ever so slowly, from level to the angle and beyond. What passes the angle at a rate of
// 0.02 degrees in T leans by 1 degree more some 6 T later: 0.12 degrees late. The load passes from one end of an edge
// to the other at once, and a spring that is loaded at once gives twice as far: it tips earlier by as much. Besides, a
// substep moves what is free by g h^2, and no face is met better than that, on either side: 2 g h^2 / rho.
static double it_tips_over_the_edge_of_its_base(dice *d, char *told)
{
    trial t = any_trial(d);
    double below = 0.3 * DEGREES + 2 * t.lean + t.nearer + 2 * G * t.s.h * t.s.h / t.f.rho, above = 0.3 * DEGREES;
    double push = chance(d, 0.3) ? uniform(d, 0.5, 1.5) * t.f.c : 0;
    double dt = 1.0 / t.r.hertz, angle = 0, from = fmax(0, t.exact - below - 1 * DEGREES), fallen = -1;
    while (fallen < 0 && angle < t.exact + 3 * above) {
        angle += (angle < from ? from / (40 * t.t) : 0.02 * DEGREES / t.t) * dt;
        load(&t.s, t.body, &t.f, push, angle);
        law_run(&t.s, t.r, dt);
        if (has_tipped(&t)) fallen = angle;
    }
    if (fallen < 0) fallen = angle;
    double error = fallen - t.exact, share = error < 0 ? -error / below : error / above;
    tell(told, &t, push, fallen);
    scene_end(&t.s);
    return share;
}

// What is put down flush and let go has all of its load at once. Its first substep gives it the speed g h, and may
// leave a seventh of that where it should have stopped: it turns about its edge by g h / (7 rho), and passes what is
// left of the way to the angle if that is no more than T times as much. 9 T later it would lie.
static double what_is_put_down_stands(dice *d, char *told)
{
    trial t = any_trial(d);
    double below = 0.3 * DEGREES + 2 * t.lean + t.nearer + 2 * G * t.s.h * t.s.h / t.f.rho;
    double angle = t.exact - below - G * t.s.h * t.t / (7 * t.f.rho);
    if (angle < 0) angle = 0;
    load(&t.s, t.body, &t.f, 0, angle);
    int32_t stands = 1;
    double dt = 1.0 / t.r.hertz;
    for (double time = 0; stands && time < fmax(2, 9 * t.t); time += dt) {
        law_run(&t.s, t.r, dt);
        stands = !has_tipped(&t);
    }
    tell(told, &t, 0, angle);
    scene_end(&t.s);
    return stands ? 0 : 2;
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(it_tips_over_the_edge_of_its_base), 300}, {LAW(what_is_put_down_stands), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
