// What stands on the flat cap of a cylinder, or on the base of a cone, stands as on a box.
#include "laws/law.h"

typedef struct stander {
    fe_geometry form;
    double height, reach; // of its middle over the ground; from its axis to the farthest point of its sole
    fe_quat lies;         // its rotation when it rests
    double breadth;       // of the sole, the least: a radius or a half width
    const char *name;
} stander;

static stander any_stander(scene *s, dice *d, double a)
{
    double b = a * uniform(d, 0.3, 1), c = a * uniform(d, 0.3, 1);
    int32_t sides = 4 + pick(d, 29);
    fe_quat on_side = turned(v3(0, 0, 1), PI / 2);
    switch (pick(d, 7)) {
    case 0:
        return (stander){box(a, b, c), b, sqrt(a * a + c * c), UNTURNED, c, "box"};
    case 1:
        return (stander){hull_box(s, a, b, c), b, sqrt(a * a + c * c), UNTURNED, c, "hull of 8 points"};
    case 2:
        return (stander){hull_prism(s, sides, b, a), b, a, UNTURNED, a * cos(PI / sides), "prism"};
    case 3:
        return (stander){cylinder(b, a), b, a, UNTURNED, a, "cylinder"};
    case 4:
        return (stander){cone(b, a), b, a, UNTURNED, a, "cone"};
    case 5:
        return (stander){capsule(a - b / 2, b / 2), b / 2, a, on_side, 0, "capsule"};
    default:
        return (stander){sphere(a), a, 0, UNTURNED, 0, "sphere"};
    }
}

// A table whose top is y = 0: a cylinder, a cone on its tip, which is held, or a box as wide
typedef enum table { CYLINDER, CONE, BOX } table;
static const char *const table_names[] = {"cylinder", "cone"};

typedef struct place {
    table kind;
    int32_t type;
    double radius, thick, turn;
} place;

static place any_place(dice *d)
{
    static const int32_t types[] = {FE_BODY_STATIC, FE_BODY_KINEMATIC, FE_BODY_DYNAMIC};
    place p = {CYLINDER, types[pick(d, 3)], spread(d, 0.5, 12), 0, uniform(d, -PI, PI)};
    if (p.type != FE_BODY_DYNAMIC && chance(d, 0.4)) p.kind = CONE;
    p.thick = p.radius * uniform(d, 0.2, 1);
    return p;
}

static fe_body add_table(scene *s, const place *p, table kind, double mu)
{
    double half = p->thick / 2;
    fe_geometry form = kind == CYLINDER ? cylinder(half, p->radius)
                       : kind == CONE   ? cone(half, p->radius)
                                        : box(p->radius, half, p->radius);
    fe_quat turn = turned(v3(0, 1, 0), p->turn), over = turned(v3(1, 0, 0), kind == CONE ? PI : 0);
    if (p->type == FE_BODY_DYNAMIC) add_plane(s, v3(0, 1, 0), -p->thick, friction(mu));
    return add_body(s, p->type, form, v3(0, -half, 0), compose(turn, over), friction(mu), WATER);
}

// What a stander's rest is, 3 s after it was let down
typedef struct rest {
    double sunk, tilt; // m, rad
    int32_t points, awake;
} rest;

static rest find_rest(scene *s, fe_body table, fe_body body, const stander *k, rate r)
{
    double before = position(s, table).y;
    let_sleep(s, body), let_sleep(s, table);
    law_run(s, r, 3);
    rest rest = {.awake = is_awake(s, body)};
    rest.sunk = k->height - position(s, body).y - (before - position(s, table).y);
    if (k->breadth > 0)
        rest.tilt = tilt(s, body);
    else if (k->reach > 0)
        rest.tilt = fabs(axis_of(s, body, v3(0, 1, 0)).y); // of a capsule that lies
    else
        rest.tilt = between(axis_of(s, body, v3(0, 1, 0)), v3(0, 1, 0)); // a ball must not roll
    fe_contact contacts[MOST_CONTACTS];
    int32_t n = fe_body_get_contacts(s->world, body, contacts, sizeof *contacts, MOST_CONTACTS);
    for (int32_t i = 0; i < n; ++i) rest.points += contacts[i].point_count;
    return rest;
}

// The same body is let down on a round table and on a square one, wholly over either. It rests as deep on both, with as
// many points, and level: neither side of it is deeper by more than the sink. Which four of a prism's corners bear, and
// what a table that gives weighs, are worth a quarter of the sink.
static double a_body_rests_on_a_cap_as_on_a_box(dice *d, char *told)
{
    rate r = any_rate(d);
    place p = any_place(d);
    double a = p.radius * spread(d, 0.04, 0.4);
    uint64_t form = d->state;
    rest found[2];
    const char *name = "";
    for (int32_t square = 0; square < 2; ++square) {
        scene s = law_scene(r);
        dice same = {form};
        stander k = any_stander(&s, &same, a);
        double drop = chance(&same, 0.5) ? fmin(0.02, 0.1 * a) : 0, heading = uniform(&same, -PI, PI), mu = 0.6;
        double way = uniform(&same, 0, 0.97) * (p.radius - k.reach), angle = uniform(&same, -PI, PI);
        fe_body table = add_table(&s, &p, square ? BOX : p.kind, mu);
        fe_body body = add_dynamic(&s, k.form, v3(way * cos(angle), k.height + drop, way * sin(angle)),
                                   compose(turned(v3(0, 1, 0), heading), k.lies), friction(mu), WATER);
        if (k.breadth > 0)
            set_velocity(&s, body, v3(uniform(&same, -0.1, 0.1) * a, 0, uniform(&same, -0.1, 0.1) * a),
                         v3(0, uniform(&same, -0.3, 0.3), 0));
        found[square] = find_rest(&s, table, body, &k, r);
        name = k.name;
        scene_end(&s);
    }
    rest cap = found[0], box = found[1];
    snprintf(told, LAW_TOLD,
             "%d Hz, %d substeps, a %s of %.3g m on a %s %s of %.3g m: %.4g mm, not %.4g, tilt %.3g (%.3g), %d "
             "points, not %d%s",
             r.hertz, r.substeps, name, a,
             p.type == FE_BODY_DYNAMIC  ? "dynamic"
             : p.type == FE_BODY_STATIC ? "static"
                                        : "kinematic",
             table_names[p.kind], p.radius, 1e3 * cap.sunk, 1e3 * box.sunk, cap.tilt, box.tilt, (int)cap.points,
             (int)box.points, cap.awake ? ", awake" : "");
    if ((cap.awake && !box.awake) || cap.points < box.points) return 2;
    double rounding = 2e-6 + 2e-6 * p.radius; // m, of floats
    return fmax(fabs(cap.sunk - box.sunk) / (0.25 * fabs(box.sunk) + rounding),
                cap.tilt * a / (1.05 * box.tilt * a + fmax(box.sunk, 0) + rounding));
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(a_body_rests_on_a_cap_as_on_a_box), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
