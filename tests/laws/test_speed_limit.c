// No body is faster than max_linear_speed when a step ends, whatever its mass, and whatever it is joined to or hits.
#include "laws/law.h"

static void join(scene *s, fe_body a, fe_body b, vec at)
{
    fe_ball_joint_def def;
    fe_ball_joint_def_init(&def, sizeof def);
    fe_joint joint;
    fe_vec3 axis = fe_make_vec3(1, 0, 0);
    MUST(fe_ball_joint_def_at(s->world, &def, a, b, &at, &axis));
    MUST(fe_ball_joint_create(s->world, &def, &joint));
}

// A heavy body spins and flies at the limit, and flings a light one that hangs on it, or that it hits.
static double nobody_is_faster_than_the_limit(dice *d, char *told)
{
    rate r = any_rate(d);
    scene s = law_scene(r);
    fe_world_tuning tuning;
    fe_world_tuning_init(&tuning, sizeof tuning);
    tuning.max_linear_speed = (float)spread(d, 10, 10000);
    MUST(fe_world_set_tuning(s.world, &tuning));
    add_ground(&s, friction(0.6));
    int joined = chance(d, 0.7);
    double heavy = spread(d, 1, 1e18), light = spread(d, 1e-9, 1), most = (double)tuning.max_linear_speed, fastest = 0;
    fe_body a = add_dynamic(&s, box(0.5, 0.5, 0.5), v3(0, 20, 0), UNTURNED, friction(0.6), WATER);
    fe_body b = add_dynamic(&s, any_form(d, 1), v3(joined ? 6 : 1.2, 20, 0), UNTURNED, friction(0.6), WATER);
    MUST(fe_body_set_mass(s.world, a, (float)heavy));
    MUST(fe_body_set_mass(s.world, b, (float)light));
    if (joined) join(&s, a, b, v3(2, 20, 0));
    set_velocity(&s, a, times(uniform(d, 0, 0.5) * most, somewhere(d, 1)), times(300, somewhere(d, 1)));
    for (int i = 0; i < 2 * r.hertz; ++i) {
        law_run(&s, r, 1.0 / r.hertz);
        fastest = fmax(fastest, fmax(length(velocity(&s, a)), length(velocity(&s, b))));
    }
    snprintf(told, LAW_TOLD, "%d Hz, %d substeps, %.3g kg and %.3g kg, %s: %.6g m/s of %.6g", r.hertz, r.substeps,
             heavy, light, joined ? "joined" : "loose", fastest, most);
    scene_end(&s);
    return fastest / (most * (1 + 1e-6));
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(nobody_is_faster_than_the_limit), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
