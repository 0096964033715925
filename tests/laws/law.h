// law.h - tests of laws: what must hold for every shape, size, mass, ground, heading and rate.
//
// A law is a function that draws one case from dice, plays it and says by how much it exceeds what physics allows. The
// main function asks it for many draws, each from a number of its own, so that one draw can be played again alone.
//
//   static double a_box_stands(dice *d, char *told) { ... snprintf(told, LAW_TOLD, ...); return fall / allowed; }
//   int main(int argc, char **argv) { return law_main(argc, argv, (law[]){{LAW(a_box_stands), 300}}, 1); }
//
//   test_x [draws [seed]]     so many draws of each law, from `seed` on; a law's own count without arguments
#ifndef FE_LAWS_LAW_H
#define FE_LAWS_LAW_H
#include "scenes/mechanics.h"
#include "scenes/meshes.h"

#include <string.h>

enum { LAW_TOLD = 400, LAW_SHOWN = 20, LAW_SEED = 20261128 };

typedef struct law {
    const char *name;
    // Plays the case that d gives: what was found over what is allowed, so that up to 1 the law holds. `told` takes a
    // line with the case's numbers.
    double (*play)(dice *d, char *told);
    int32_t draws; // of `make test`
} law;

#define LAW(f) #f, f

static int32_t law_draws;
static uint64_t law_seed = LAW_SEED;

// The dice of one draw: neighbouring numbers give unlike dice (Steele, Lea and Flood, SplitMix, 2014).
static inline dice law_dice(uint64_t number)
{
    uint64_t z = number * UINT64_C(0x9E3779B97F4A7C15) + UINT64_C(0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return (dice){z ^ (z >> 31)};
}

static inline void law_holds(void **state)
{
    const law *l = *state;
    int32_t draws = law_draws ? law_draws : SLOW_BUILD ? (l->draws + 19) / 20 : l->draws, broken = 0;
    double worst = 0;
    for (int32_t i = 0; i < draws; ++i) {
        char told[LAW_TOLD] = "";
        dice d = law_dice(law_seed + (uint64_t)i);
        double share = l->play(&d, told);
        if (share > worst) worst = share;
        if (share <= 1) continue; // a NaN is broken
        if (++broken <= LAW_SHOWN)
            print_error("seed %llu: %.3g of what is allowed: %s\n", (unsigned long long)(law_seed + (uint64_t)i), share,
                        told);
    }
    print_message("%s: %d of %d draws from seed %llu broken; worst %.3g of what is allowed\n", l->name, (int)broken,
                  (int)draws, (unsigned long long)law_seed, worst);
    FE_NEAR(broken, 0, 0);
}

static inline int law_main(int argc, char **argv, const law *laws, size_t count)
{
    struct CMUnitTest tests[16] = {{0}};
    assert_true(count <= sizeof tests / sizeof *tests);
    if (argc > 1) law_draws = (int32_t)strtol(argv[1], NULL, 10);
    if (argc > 2) law_seed = strtoull(argv[2], NULL, 10);
    for (size_t i = 0; i < count; ++i)
        tests[i] = (struct CMUnitTest){.name = laws[i].name,
                                       .test_func = law_holds,
                                       .initial_state = (void *)(uintptr_t)&laws[i]};
    return _cmocka_run_group_tests("laws", tests, count, NULL, NULL);
}

static inline int chance(dice *d, double share) { return uniform(d, 0, 1) < share; }
// Every order of magnitude is as likely.
static inline double spread(dice *d, double low, double high) { return low * pow(high / low, uniform(d, 0, 1)); }

// ---- worlds --------------------------------------------------------------------------------------------------------

typedef struct rate {
    int32_t hertz, substeps;
} rate;

static inline rate any_rate(dice *d)
{
    static const int32_t hertz[] = {30, 60, 120};
    int32_t steps = hertz[pick(d, 3)];
    return (rate){steps, chance(d, 0.5) ? 4 : 8};
}

// An upright scene at that rate; its h is a substep
static inline scene law_scene(rate r)
{
    setup how = {UNTURNED, r.substeps};
    void *state = &how;
    scene s = scene_begin(&state);
    s.h = 1.0 / r.hertz / r.substeps;
    return s;
}

static inline void law_run(scene *s, rate r, double seconds)
{
    for (int i = 0, steps = (int)(seconds * r.hertz + 0.5); i < steps; ++i)
        MUST(fe_world_step(s->world, 1.0f / (float)r.hertz));
}

static inline void let_sleep(scene *s, fe_body body) { MUST(fe_body_set_sleep_allowed(s->world, body, 1)); }

static inline int32_t is_awake(const scene *s, fe_body body)
{
    int32_t awake = 0;
    MUST(fe_body_get_awake(s->world, body, &awake));
    return awake;
}

// ---- forms ---------------------------------------------------------------------------------------------------------

static inline fe_geometry cylinder(double half_height, double radius)
{
    fe_geometry form;
    fe_geometry_cylinder(&form, (float)half_height, (float)radius);
    return form;
}

static inline fe_geometry cone(double half_height, double radius)
{
    fe_geometry form;
    fe_geometry_cone(&form, (float)half_height, (float)radius);
    return form;
}

static inline fe_geometry hull(scene *s, const float *points, int32_t count)
{
    fe_hull_def def;
    fe_asset asset;
    fe_geometry form;
    fe_hull_def_init(&def, sizeof def);
    def.points = points, def.point_count = count;
    MUST(fe_hull_create(world_store(s->world), &def, &asset));
    fe_geometry_hull(&form, asset);
    return form;
}

static inline fe_geometry hull_box(scene *s, double x, double y, double z)
{
    float points[24];
    for (int i = 0; i < 8; ++i) {
        points[3 * i] = (float)(i & 1 ? x : -x);
        points[3 * i + 1] = (float)(i & 2 ? y : -y);
        points[3 * i + 2] = (float)(i & 4 ? z : -z);
    }
    return hull(s, points, 8);
}

// A prism of n sides about y; the first side's middle points along x
static inline fe_geometry hull_prism(scene *s, int32_t n, double half_height, double radius)
{
    float points[6 * 64];
    for (int32_t i = 0; i < n; ++i) {
        double angle = 2 * PI * (i + 0.5) / n;
        for (int32_t side = 0; side < 2; ++side) {
            float *p = points + 3 * (2 * i + side);
            p[0] = (float)(radius * cos(angle)), p[2] = (float)(radius * sin(angle));
            p[1] = (float)(side ? half_height : -half_height);
        }
    }
    return hull(s, points, 2 * n);
}

// ---- grounds -------------------------------------------------------------------------------------------------------

typedef enum ground_kind {
    GROUND_PLANE,
    GROUND_BOX,
    GROUND_HULL,
    GROUND_MESH,
    GROUND_FIELD,
    GROUND_CAP, // of a cylinder
    GROUND_COMPOUND,
    GROUND_KINEMATIC, // a box
    GROUND_KINDS
} ground_kind;

static const char *const ground_names[GROUND_KINDS] = {"plane", "box",      "hull",     "mesh",
                                                       "field", "cylinder", "compound", "kinematic box"};

// A compound of 4 x 4 level boxes under y = 0, `half` m to each side
static inline fe_geometry tiles(scene *s, double half)
{
    fe_compound_part parts[16];
    fe_asset asset;
    fe_geometry form;
    for (int i = 0; i < 16; ++i) {
        fe_compound_part_init(&parts[i], sizeof parts[i]);
        parts[i].geometry = box(half / 4, half / 4, half / 4);
        parts[i].frame.position = narrow(v3(half * (i % 4 - 1.5) / 2, -half / 4, half * (i / 4 - 1.5) / 2));
    }
    MUST(fe_compound_create(world_store(s->world), parts, sizeof *parts, 16, &asset));
    fe_geometry_compound(&form, asset);
    return form;
}

// A ground whose top is y = 0, level, `half` m to each side of the origin or more
static inline fe_body add_level_ground(scene *s, ground_kind kind, double half, fe_material m)
{
    vec under = v3(0, -half, 0);
    switch (kind) {
    case GROUND_BOX:
        return add_static(s, box(half, half, half), under, UNTURNED, m);
    case GROUND_HULL:
        return add_static(s, hull_box(s, half, half, half), under, UNTURNED, m);
    case GROUND_MESH:
        return add_mesh(s, 8, half / 4, -half, -half, 0.3, level, m);
    case GROUND_FIELD:
        return add_field(s, 8, half / 4, -half, -half, level, m);
    case GROUND_CAP:
        return add_static(s, cylinder(half, 1.5 * half), under, UNTURNED, m);
    case GROUND_COMPOUND:
        return add_static(s, tiles(s, half), v3(0, 0, 0), UNTURNED, m);
    case GROUND_KINEMATIC:
        return add_body(s, FE_BODY_KINEMATIC, box(half, half, half), under, UNTURNED, m, WATER);
    default:
        return add_ground(s, m);
    }
}

static inline ground_kind any_ground(dice *d) { return (ground_kind)pick(d, GROUND_KINDS); }

#endif
