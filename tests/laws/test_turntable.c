// What lies on a kinematic body that rotates, and has the friction for it, stays where it is on it.
#include "laws/law.h"

typedef enum table_kind {
    TABLE_BOX,
    TABLE_HULL,
    TABLE_PRISM,
    TABLE_COMPOUND,
    TABLE_MESH,
    TABLE_CYLINDER,
    TABLE_CONE,
    TABLE_KINDS
} table_kind;
static const char *const table_names[TABLE_KINDS] = {"box", "hull", "prism", "compound", "mesh", "cylinder", "cone"};

// Its top is y = 0 and reaches 8 m from the axis, in the body's own frame
static fe_body add_table(scene *s, table_kind kind, vec at, fe_material m)
{
    fe_body table;
    switch (kind) {
    case TABLE_HULL:
        return add_body(s, FE_BODY_KINEMATIC, hull_box(s, 8, 0.5, 8), plus(at, v3(0, -0.5, 0)), UNTURNED, m, WATER);
    case TABLE_PRISM:
        return add_body(s, FE_BODY_KINEMATIC, hull_prism(s, 16, 0.5, 8.2), plus(at, v3(0, -0.5, 0)), UNTURNED, m,
                        WATER);
    case TABLE_COMPOUND:
        return add_body(s, FE_BODY_KINEMATIC, tiles(s, 8), at, UNTURNED, m, WATER);
    case TABLE_MESH:
        table = add_mesh(s, 8, 2, -8, -8, 0.3, level, m);
        MUST(fe_body_set_type(s->world, table, FE_BODY_KINEMATIC));
        return table;
    case TABLE_CYLINDER:
        return add_body(s, FE_BODY_KINEMATIC, cylinder(0.5, 8), plus(at, v3(0, -0.5, 0)), UNTURNED, m, WATER);
    case TABLE_CONE: // on its tip
        return add_body(s, FE_BODY_KINEMATIC, cone(0.5, 8), plus(at, v3(0, -0.5, 0)), turned(v3(1, 0, 0), PI), m,
                        WATER);
    default:
        return add_body(s, FE_BODY_KINEMATIC, box(8, 0.5, 8), plus(at, v3(0, -0.5, 0)), UNTURNED, m, WATER);
    }
}

static fe_geometry any_rider(scene *s, dice *d, double half, double up, const char **name)
{
    switch (pick(d, 5)) {
    case 0:
        return *name = "box", box(half, up, half * uniform(d, 0.5, 1));
    case 1:
        return *name = "hull box", hull_box(s, half, up, half * uniform(d, 0.5, 1));
    case 2:
        return *name = "cylinder", cylinder(up, half);
    case 3:
        return *name = "cone", cone(up, half);
    default:
        return *name = "prism", hull_prism(s, 3 + pick(d, 14), up, half);
    }
}

// It needs w^2 r of its mu g: at most 0.7 of it, and as little as a ten thousandth. Radius within 1 mm in 60 s.
static double a_rider_keeps_its_radius(dice *d, char *told)
{
    rate r = any_rate(d);
    scene s = law_scene(r);
    table_kind kind = (table_kind)pick(d, TABLE_KINDS);
    const char *name;
    double mu = uniform(d, 0.5, 1), radius = uniform(d, 0.3, 6);
    double w = sqrt(spread(d, 1e-4, 0.7) * mu * G / radius) * (chance(d, 0.5) ? 1 : -1), angle = uniform(d, -PI, PI);
    double half = spread(d, 0.1, 0.6), up = half * uniform(d, 0.1, 0.3);
    fe_body table = add_table(&s, kind, v3(0, 0, 0), friction(mu));
    set_velocity(&s, table, v3(0, 0, 0), v3(0, w, 0));
    vec at = v3(radius * cos(angle), up, radius * sin(angle));
    fe_body rider = add_dynamic(&s, any_rider(&s, d, half, up, &name), at, turned(v3(0, 1, 0), uniform(d, -PI, PI)),
                                friction(mu), (float)spread(d, 100, 10000));
    set_velocity(&s, rider, cross(v3(0, w, 0), at), v3(0, w, 0));
    law_run(&s, r, 1);
    vec first = position(&s, rider);
    law_run(&s, r, 60);
    vec last = position(&s, rider);
    double change = hypot(last.x, last.z) - hypot(first.x, first.z);
    snprintf(told, LAW_TOLD, "%d Hz, %d substeps, %s on a %s, %.3g rad/s at %.3g m: %.3g mm out", r.hertz, r.substeps,
             name, table_names[kind], w, radius, 1e3 * change);
    scene_end(&s);
    return fabs(change) / 1e-3;
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(a_rider_keeps_its_radius), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
