// A heavy body on light wheels stands as one solid body would on the same contacts, wherever it stands.
#include "laws/law.h"
#include "scenes/joint_scene.h"

enum { WHEELS = 8 };
// A second leaves of what still sinks e^-5 at 30 Hz and 4 substeps: a soft contact closes w / (2 zeta) of it a second
#define SETTLED 1.0

typedef struct cart {
    fe_geometry body, wheel;
    const char *name;
    vec at[WHEELS], centre; // of the wheels and of the chassis from the middle between the axles, on the ground
    int32_t count;
    int32_t sides; // of wheels that are prisms
    int32_t braked;
    double half_width, mass, wheel_mass, heading;
    fe_quat lay; // of a wheel
} cart;

// Round about y, or a prism that stands on its lowest side
static fe_geometry any_wheel(scene *s, dice *d, double radius, cart *c)
{
    static const char *const names[] = {"spheres", "cylinders", "capsules", "prisms"};
    int kind = pick(d, 4);
    c->name = names[kind], c->sides = 8 + 4 * pick(d, 5);
    if (kind == 0) return sphere(radius);
    if (kind == 1) return cylinder(c->half_width, radius);
    if (kind == 2) return capsule(c->half_width, radius);
    return hull_prism(s, c->sides, c->half_width, radius / cos(PI / c->sides));
}

// Pairs of wheels, the first alone where their number is odd. A cart of two hangs below its axle, others stand over it
static cart any_cart(scene *s, dice *d)
{
    cart c = {.count = 2 + pick(d, WHEELS - 1), .heading = uniform(d, -PI, PI)};
    double radius = spread(d, 0.05, 0.8), track = radius * uniform(d, 2, 5);
    int32_t axles = (c.count + 1) / 2;
    double base = axles < 2 ? 0 : (double)(axles - 1) * radius * uniform(d, 2.2, 4), off = base * uniform(d, -0.1, 0.1);
    c.half_width = radius * uniform(d, 0.1, 0.7), c.braked = chance(d, 0.3);
    c.wheel = any_wheel(s, d, radius, &c);
    for (int32_t i = 0, odd = c.count % 2; i < c.count; ++i) {
        int32_t axle = (i + odd) / 2, alone = odd && i == 0;
        c.at[i] = v3(off + (axles < 2 ? 0 : base * ((double)axle / (axles - 1) - 0.5)), radius,
                     alone ? 0 : ((i + odd) % 2 ? 0.5 : -0.5) * track);
    }
    double high = radius * uniform(d, 0.2, 0.6), up = uniform(d, 0, 2) * radius;
    c.centre = v3(c.count % 2 ? 0.1 * base : 0, c.count < 3 ? 0.75 * radius : radius + up, 0);
    if (c.count < 3) high = 0.3 * radius;
    c.body = box(0.5 * base + radius * uniform(d, 0.3, 1), high, 0.5 * track + radius * uniform(d, -0.3, 0.3));
    c.wheel_mass = spread(d, 0.1, 50), c.mass = c.wheel_mass * spread(d, 1, 2000);
    c.lay = turned(v3(1, 0, 0), PI / 2);
    return c;
}

static vec place_of(const cart *c, vec at, vec start)
{
    return plus(start, rotate(turned(v3(0, 1, 0), c->heading), at));
}

static void add_wheel_shape(scene *s, fe_body body, const cart *c, vec at, fe_material m)
{
    fe_shape_def def;
    fe_shape shape;
    fe_shape_def_init(&def, sizeof def);
    def.density = 0, def.material = m;
    def.frame.position = narrow(minus(at, c->centre)), def.frame.rotation = c->lay;
    MUST(fe_shape_create(s->world, body, &def, &c->wheel, &shape));
}

// `solid`: wheels are shapes of the chassis, which weighs as much as all
static fe_body add_cart(scene *s, const cart *c, vec start, fe_material m, int32_t solid)
{
    fe_quat turn = turned(v3(0, 1, 0), c->heading), lay = compose(turn, c->lay);
    fe_body chassis = add_dynamic(s, c->body, place_of(c, c->centre, start), turn, m, WATER);
    let_sleep(s, chassis);
    for (int32_t i = 0; i < c->count; ++i) {
        vec at = place_of(c, c->at[i], start);
        if (solid) {
            add_wheel_shape(s, chassis, c, c->at[i], m);
            continue;
        }
        fe_body wheel = add_dynamic(s, c->wheel, at, lay, m, WATER);
        MUST(fe_body_set_mass(s->world, wheel, (float)c->wheel_mass));
        let_sleep(s, wheel);
        fe_hinge_joint_def def = hinge_def();
        if (c->braked) def.motor_max = (float)(0.1 * c->mass * G * c->at[0].y);
        add_hinge(s, def, chassis, wheel, at, rotate(turn, v3(0, 0, 1)));
    }
    MUST(fe_body_set_mass(s->world, chassis, (float)(c->mass + (solid ? c->count * c->wheel_mass : 0))));
    return chassis;
}

static int32_t is_prism(const cart *c) { return c->name[0] == 'p'; }

// The rate at which the load N of a wheel of moment I turns it off its flat side, sqrt(N r / I), I = m r^2 / 2, 1/s
static double turning_rate(const cart *c) { return sqrt(2 * c->mass * G / (c->count * c->wheel_mass * c->at[0].y)); }

// A chassis of 1 to 2000 times a wheel's mass on 2 to 8 wheels on hinges, set down at touch: it sinks by at most half a
// millimetre more than as one solid body of that weight on those shapes. Contacts that begin without impulses let it
// dip, by g dt^2 at most, 1 cm, and it may shift by as much; from then on it keeps its place to half a millimetre, and
// sleeps. Prisms rock on kinematic bodies and caps (see the known
// limits), and where their load turns them faster than substeps see.
static double a_cart_stands_as_a_solid_body_would(dice *d, char *told)
{
    rate r = any_rate(d);
    ground_kind kind = any_ground(d);
    scene s = law_scene(r);
    fe_material m = friction(uniform(d, 0.4, 1));
    cart c = any_cart(&s, d);
    if (is_prism(&c) && turning_rate(&c) * s.h > 1) c.wheel = cylinder(c.half_width, c.at[0].y), c.name = "cylinders";
    if (is_prism(&c) && (kind == GROUND_KINEMATIC || kind == GROUND_CAP)) kind = GROUND_BOX;
    double half = 12;
    add_level_ground(&s, kind, half, m);
    vec start = v3(uniform(d, -3, 3), 0, uniform(d, -3, 3));
    fe_body chassis = add_cart(&s, &c, start, m, 0);
    vec from = position(&s, chassis);
    law_run(&s, r, 1);
    vec settled = position(&s, chassis);
    law_run(&s, r, 4);
    vec way = minus(position(&s, chassis), from), crept = minus(position(&s, chassis), settled);
    int32_t awake = is_awake(&s, chassis);
    fe_body_destroy(s.world, chassis);
    scene_end(&s);
    s = law_scene(r);
    add_level_ground(&s, GROUND_PLANE, half, m);
    cart solid = c;
    if (is_prism(&c)) solid.wheel = hull_prism(&s, c.sides, c.half_width, c.at[0].y / cos(PI / c.sides));
    chassis = add_cart(&s, &solid, start, m, 1);
    law_run(&s, r, SETTLED);
    double sunk = -way.y, alone = from.y - position(&s, chassis).y, drift = hypot(way.x, way.z),
           creeps = hypot(crept.x, crept.z);
    scene_end(&s);
    snprintf(
        told, LAW_TOLD,
        "%d Hz, %d substeps, %.4g kg on %d %s of %.3g kg, radius %.3g, %s on a %s: sinks by %.4g mm, a solid body by "
        "%.4g; settles by %.3g mm aside, creeps by %.3g%s",
        r.hertz, r.substeps, c.mass, (int)c.count, c.name, c.wheel_mass, c.at[0].y, c.braked ? "braked " : "",
        ground_names[kind], 1e3 * sunk, 1e3 * alone, 1e3 * drift, 1e3 * creeps, awake ? ", AWAKE" : "");
    double score = fmax((sunk - alone) / 5e-4, fmax(drift / 1e-2, creeps / 5e-4));
    if (score != score) return score;
    return awake ? fmax(score, 10) : score;
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(a_cart_stands_as_a_solid_body_would), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
