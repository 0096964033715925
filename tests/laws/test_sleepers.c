// What sleeps is woken by a touch alone.
#include "laws/law.h"

enum { MESH = 5 }; // of kinematic bodies alone
static const char *const names[] = {"sphere", "capsule", "box", "cylinder", "hull", "mesh"};

typedef struct stander {
    fe_geometry form;
    double height, half; // m: of its centre over the ground; its half width along x
    int lies;            // along z
} stander;

// The faces of a box, turned outwards
static fe_geometry box_of_triangles(scene *s, double x, double y, double z)
{
    static const uint32_t indices[] = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                       2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    float vertices[24];
    fe_mesh_def def;
    fe_asset mesh;
    fe_geometry form;
    for (int i = 0; i < 8; ++i) {
        vertices[3 * i] = (float)(i & 1 ? x : -x);
        vertices[3 * i + 1] = (float)(i & 2 ? y : -y);
        vertices[3 * i + 2] = (float)(i & 4 ? z : -z);
    }
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = vertices, def.vertex_count = 8, def.indices = indices, def.triangle_count = 12;
    MUST(fe_mesh_create(world_store(s->world), &def, &mesh));
    fe_geometry_mesh(&form, mesh);
    return form;
}

static stander any_stander(scene *s, dice *d, int kind)
{
    double a = spread(d, 0.05, 1), h = a * uniform(d, 0.4, 1);
    switch (kind) {
    case 0:
        return (stander){sphere(a), (float)a, (float)a, 0};
    case 1:
        return (stander){capsule(h, a), (float)a, (float)a, 1};
    case 2:
        return (stander){box(a, h, a), (float)h, (float)a, 0};
    case 3:
        return (stander){cylinder(h, a), (float)h, (float)a, 0};
    case MESH:
        return (stander){box_of_triangles(s, a, h, a), (float)h, (float)a, 0};
    default:
        return (stander){hull_box(s, a, h, a), (float)h, (float)a, 0};
    }
}

static int is_same_pose(const scene *s, fe_body body, const fe_transform *before)
{
    fe_transform now;
    MUST(fe_body_get_transform(s->world, body, &now));
    return !memcmp(&now.position, &before->position, sizeof now.position) &&
           !memcmp(&now.rotation, &before->rotation, sizeof now.rotation);
}

static int32_t count_touches(const scene *s, fe_body a, fe_body b)
{
    fe_pair_event events[8];
    int32_t count = fe_world_get_pair_events(s->world, events, sizeof *events, 8), found = 0;
    for (int32_t i = 0; i < count && i < 8; ++i)
        found += events[i].kind != FE_EVENT_EXIT &&
                 ((events[i].body_a == a && events[i].body_b == b) || (events[i].body_a == b && events[i].body_b == a));
    return found;
}

// Bodies as high as each other stand on a floor; one of them slides by, or is moved by, at a gap of 0.1 to 20 mm: the
// other sleeps on, in the same pose. One that comes straight at it wakes it in the step of its touch, which an event
// tells.
static double a_touch_alone_wakes(dice *d, char *told)
{
    rate r = any_rate(d);
    scene s = law_scene(r);
    add_ground(&s, friction(0.6));
    int32_t type = chance(d, 0.3) ? FE_BODY_KINEMATIC : FE_BODY_DYNAMIC;
    int kind_a = pick(d, 5), kind_b = pick(d, type == FE_BODY_KINEMATIC ? 6 : 5);
    int hits = chance(d, 0.3);
    stander a = any_stander(&s, d, kind_a), b = any_stander(&s, d, kind_b);
    fe_quat flat = turned(v3(1, 0, 0), PI / 2);
    fe_body sleeper = add_dynamic(&s, a.form, v3(0, a.height, 0), a.lies ? flat : UNTURNED, friction(0.6), WATER);
    let_sleep(&s, sleeper);
    law_run(&s, r, 2);
    double gap = spread(d, 1e-4, 0.02), speed = spread(d, 0.5, 20);
    // what outruns the two within a step may pass through, unless it is a bullet
    if (hits) speed = fmin(speed, (a.half + b.half) * r.hertz);
    double way = 2 * (a.half + b.half) + 0.1 + speed / r.hertz;
    vec at = hits ? v3(0, b.height, -way) : v3(a.half + b.half + gap, b.height, -way);
    fe_body passer = add_body(&s, type, b.form, at, b.lies ? flat : UNTURNED, friction(0), WATER);
    fe_transform before;
    MUST(fe_body_get_transform(s.world, sleeper, &before));
    set_velocity(&s, passer, v3(0, 0, speed), v3(0, 0, 0));
    int slept = !is_awake(&s, sleeper), woke = 0, touched = 0, late = 0;
    for (int i = 0, steps = (int)(2 * way / speed * r.hertz) + 2; i < steps; ++i) {
        law_run(&s, r, 1.0 / r.hertz);
        touched |= count_touches(&s, sleeper, passer) > 0;
        woke |= is_awake(&s, sleeper);
        late |= touched && !woke;
    }
    int same = is_same_pose(&s, sleeper, &before);
    snprintf(told, LAW_TOLD, "%d Hz, %d substeps, %s %s (%.3g m) %s %s (%.3g m), gap %.3g mm, %.3g m/s: %s, %s, %s",
             r.hertz, r.substeps, type == FE_BODY_KINEMATIC ? "kinematic" : "dynamic", names[kind_b], b.half,
             hits ? "hits" : "passes", names[kind_a], a.half, 1e3 * gap, speed, slept ? "slept" : "did not sleep",
             woke ? "woke" : "slept on", touched ? "touched" : "untouched");
    scene_end(&s);
    if (!slept) return 2;
    return hits ? !(touched && woke && !late) * 2 : (touched || woke || !same) * 2;
}

// A kinematic box, made of triangles or not, spins about the vertical beside a body that sleeps: its corners pass at a
// gap of 1 to 20 mm. The other sleeps on, in the same pose. Where they reach 1 to 5 cm into an upright side, they wake
// it.
static double what_spins_beside_a_sleeper_lets_it_sleep(dice *d, char *told)
{
    rate r = any_rate(d);
    scene s = law_scene(r);
    add_ground(&s, friction(0.6));
    int kind_a = pick(d, 5), kind_b = chance(d, 0.7) ? MESH : 2, hits = kind_a >= 2 && chance(d, 0.4);
    stander a = any_stander(&s, d, kind_a), b = any_stander(&s, d, kind_b);
    fe_body sleeper = add_dynamic(&s, a.form, v3(0, a.height, 0), a.lies ? turned(v3(1, 0, 0), PI / 2) : UNTURNED,
                                  friction(0.6), WATER);
    let_sleep(&s, sleeper);
    double reach = sqrt(2) * b.half, gap = hits ? -fmin(uniform(d, 0.01, 0.05), 0.2 * b.half) : spread(d, 1e-3, 0.02);
    fe_body spinner =
        add_body(&s, FE_BODY_KINEMATIC, b.form, v3(a.half + reach + gap, b.height, 0), UNTURNED, friction(0), WATER);
    law_run(&s, r, 2);
    fe_transform before;
    MUST(fe_body_get_transform(s.world, sleeper, &before));
    double spin = spread(d, 0.5, 5) * (chance(d, 0.5) ? 1 : -1);
    int slept = !is_awake(&s, sleeper), woke = 0;
    set_velocity(&s, spinner, v3(0, 0, 0), v3(0, spin, 0));
    for (int i = 0, steps = (int)(PI / 2 / fabs(spin) * r.hertz) + 2; i < steps; ++i) {
        law_run(&s, r, 1.0 / r.hertz);
        woke |= is_awake(&s, sleeper);
    }
    int same = is_same_pose(&s, sleeper, &before);
    snprintf(told, LAW_TOLD,
             "%d Hz, %d substeps, %s (%.3g m) spins at %.3g rad/s beside %s (%.3g m), gap %.3g mm: %s, %s", r.hertz,
             r.substeps, names[kind_b], b.half, spin, names[kind_a], a.half, 1e3 * gap,
             slept ? "slept" : "did not sleep", woke ? "woke" : "slept on");
    scene_end(&s);
    if (!slept) return 2;
    return (hits ? !woke : woke || !same) * 2;
}

static double far_below(double x, double z) { return x - x + z - z - 1; }

// A body sleeps on a pedestal whose top is y = 0. A heightfield far below rises by new heights into its lower half: it
// wakes at once, and comes up to no deeper than the solver's slop.
static double a_ground_that_rises_into_a_sleeper_wakes_it(dice *d, char *told)
{
    enum { CELLS = 8, SIDE = CELLS + 1 };
    rate r = any_rate(d);
    scene s = law_scene(r);
    int kind = pick(d, 5);
    stander a = any_stander(&s, d, kind);
    double cell = fmax(a.half, 0.1), rise = a.height * uniform(d, 0.05, 0.5);
    add_static(&s, box(0.3 * a.half, 0.4, 0.3 * a.half), v3(0, -0.4, 0), UNTURNED, friction(0.6));
    fe_asset field = make_field(&s, CELLS, cell, -4 * cell, -4 * cell, far_below);
    place_field(&s, field, v3(-4 * cell, 0, -4 * cell), UNTURNED, friction(0.6));
    fe_quat turn = a.lies ? turned(v3(1, 0, 0), PI / 2) : UNTURNED;
    fe_body sleeper = add_dynamic(&s, a.form, v3(0, a.height, 0), turn, friction(0.6), WATER);
    let_sleep(&s, sleeper);
    law_run(&s, r, 2);
    int slept = !is_awake(&s, sleeper);
    float heights[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; ++i) heights[i] = (float)rise;
    MUST(fe_heightfield_set_heights(world_store(s.world), field, 0, 0, SIDE, SIDE, heights));
    law_run(&s, r, 1.0 / r.hertz);
    int woke = is_awake(&s, sleeper);
    law_run(&s, r, 2);
    double sunk = a.height + rise - position(&s, sleeper).y;
    snprintf(told, LAW_TOLD, "%d Hz, %d substeps, %s (%.3g m), raised by %.3g m: %s, %s, %.3g mm deep", r.hertz,
             r.substeps, names[kind], a.half, rise, slept ? "slept" : "did not sleep", woke ? "woke" : "slept on",
             1e3 * sunk);
    scene_end(&s);
    return slept && woke ? sunk / LINEAR_SLOP : 2;
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(a_touch_alone_wakes), 300},
                               {LAW(what_spins_beside_a_sleeper_lets_it_sleep), 300},
                               {LAW(a_ground_that_rises_into_a_sleeper_wakes_it), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
