// Heaps of bodies of every form fall asleep.
#include "laws/law.h"

// How many bodies; of `make test-long`, the third argument
static int32_t heap_bodies = 500;

static fe_geometry heaped_form(scene *s, int32_t kind, double r)
{
    switch (kind) {
    case 0:
        return box(r, 0.7 * r, r);
    case 1:
        return sphere(r);
    case 2:
        return capsule(r, 0.6 * r);
    case 3:
        return cylinder(r, 0.8 * r);
    case 4:
        return cone(r, r);
    default:
        return hull_box(s, r, 0.5 * r, 0.8 * r);
    }
}

// A pit `half` m to each side with walls as high as what is let fall into it
static void add_pit(scene *s, double half, double high)
{
    double thick = half / 8;
    fe_material m = friction(0.6);
    add_static(s, box(half, thick, half), v3(0, -thick, 0), UNTURNED, m);
    for (int32_t k = 0; k < 4; ++k) {
        double side = k & 1 ? half : -half;
        vec middle = k < 2 ? v3(side, high / 2, 0) : v3(0, high / 2, side);
        add_static(s, k < 2 ? box(thick, high / 2, half) : box(half, high / 2, thick), middle, UNTURNED, m);
    }
}

// A heap rests on contacts of every pair of forms, with three or more of them on most bodies, and rolling resistance
// ends what rolls. Nothing drives it: it lies still in 20 s, though it may fall for 2 s.
static double a_heap_of_every_form_falls_asleep(dice *d, char *told)
{
    static const double scales[] = {0.3, 1, 3};
    rate r = {60, chance(d, 0.5) ? 4 : 8};
    double scale = scales[pick(d, 3)], each = 0.02 * scale;
    scene s = law_scene(r);
    fe_material m = SURFACE(0.6f, 0.6f, 0, (float)(0.1 * scale), (float)(0.01 * scale));
    add_pit(&s, 4 * scale, (2 + 0.02 * heap_bodies) * scale);
    for (int32_t i = 0; i < heap_bodies; ++i) {
        vec p = v3(uniform(d, -3, 3) * scale, scale + each * i, uniform(d, -3, 3) * scale);
        fe_quat q = any_rotation(d);
        let_sleep(&s, add_dynamic(&s, heaped_form(&s, i % 6, uniform(d, 0.15, 0.3) * scale), p, q, m, WATER));
    }
    fe_counters c;
    double t = 0;
    do {
        law_run(&s, r, 0.25);
        t += 0.25;
        fe_counters_init(&c, sizeof c);
        MUST(fe_world_get_counters(s.world, &c));
    } while (c.awake_bodies > 0 && t < 20);
    snprintf(told, LAW_TOLD, "%d substeps, %d bodies, scale %g: %d awake after %g s", r.substeps, (int)heap_bodies,
             scale, (int)c.awake_bodies, t);
    scene_end(&s);
    return c.awake_bodies > 0 ? 2 : t / 20;
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(a_heap_of_every_form_falls_asleep), 6}};
    if (argc > 3) heap_bodies = (int32_t)strtol(argv[3], NULL, 10);
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
