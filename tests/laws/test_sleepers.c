// What sleeps is woken by a touch alone.
#include "laws/law.h"

static const char *const names[] = {"sphere", "capsule", "box", "cylinder", "hull"};

typedef struct stander {
    fe_geometry form;
    double height, half; // m: of its centre over the ground; its half width along x
    int lies;            // along z
} stander;

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

// Bodies as high as each other stand on a floor; one of them slides by at a gap of 0.1 to 20 mm: the other sleeps on,
// in the same pose. One that comes straight at it wakes it in the step of its touch, which an event tells.
static double a_touch_alone_wakes(dice *d, char *told)
{
    rate r = any_rate(d);
    scene s = law_scene(r);
    add_ground(&s, friction(0.6));
    int kind_a = pick(d, 5), kind_b = pick(d, 5), hits = chance(d, 0.3);
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
    fe_body passer = add_dynamic(&s, b.form, at, b.lies ? flat : UNTURNED, friction(0), WATER);
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
    snprintf(told, LAW_TOLD, "%d Hz, %d substeps, %s (%.3g m) %s %s (%.3g m), gap %.3g mm, %.3g m/s: %s, %s, %s",
             r.hertz, r.substeps, names[kind_b], b.half, hits ? "hits" : "passes", names[kind_a], a.half, 1e3 * gap,
             speed, slept ? "slept" : "did not sleep", woke ? "woke" : "slept on", touched ? "touched" : "untouched");
    scene_end(&s);
    if (!slept) return 2;
    return hits ? !(touched && woke && !late) * 2 : (touched || woke || !same) * 2;
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(a_touch_alone_wakes), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
