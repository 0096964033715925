// Contacts whose nearest points run along two edges or cores with the least turn: pressed hard, they come to rest all
// the same.
#include "scene.h"

#define AT_REST 0.05 // m/s: slower bodies may sleep (fe_body_def)

// free to rise and, if it rides, to rock about z
static void hold(const scene *s, fe_body body, int rides)
{
    uint32_t turns = FE_AXIS_X | FE_AXIS_Y | (rides ? 0 : FE_AXIS_Z);
    MUST(fe_body_set_locks(s->world, body, FE_AXIS_X | FE_AXIS_Z, turns));
}

static double deepest(const scene *s, fe_body body)
{
    fe_contact contacts[MOST_CONTACTS];
    int32_t count = fe_body_get_contacts(s->world, body, contacts, sizeof *contacts, MOST_CONTACTS);
    double deep = -1;
    for (int32_t i = 0; i < count; ++i)
        for (int32_t k = 0; k < contacts[i].point_count; ++k)
            deep = fmax(deep, -(double)contacts[i].points[k].separation);
    return deep;
}

typedef struct ride {
    fe_geometry support, rider;
    fe_quat turn_support, turn_rider;
    double load;       // in weights of the rider
    double height;     // of the rider's centre above the support's, m
    double foot;       // of the support above the ground, m
    double half;       // of the rider's length, m
    double aside;      // of the rider's centre, m
    double lever;      // from the rider's centre to its outermost point of contact, m
    int32_t is_static; // the support
} ride;

// A support on the ground, a rider on it, pressed: after 2 s it is slow at its farthest point, and where it touches it
// is no deeper than all of the load would press its outermost point (P1).
static void comes_to_rest(void **state, const ride *r)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    int32_t type = r->is_static ? FE_BODY_STATIC : FE_BODY_DYNAMIC;
    fe_body support = add_body(&s, type, r->support, v3(0, r->foot, 0), r->turn_support, friction(0.6), WATER);
    fe_body rider =
        add_dynamic(&s, r->rider, v3(r->aside, r->foot + r->height, 0), r->turn_rider, friction(0.6), WATER);
    if (!r->is_static) hold(&s, support, 0);
    hold(&s, rider, 1);
    double m = mass_of(&s, rider), slack = 1 / m + r->lever * r->lever / (double)mass_data_of(&s, rider).inertia.z;
    if (!r->is_static) slack += 1 / mass_of(&s, support);
    for (int i = 0; i < 180; ++i) {
        add_force(&s, rider, v3(0, -(r->load - 1) * m * G, 0));
        run(&s, 1);
        if (i < 120) continue;
        FE_WITHIN(length(velocity(&s, rider)) + r->half * length(spin(&s, rider)), 0, AT_REST);
        FE_WITHIN(deepest(&s, rider), 0, 1.05 * sink(r->load * m * G, 1 / slack, r->is_static));
    }
    scene_end(&s);
}

static fe_quat along_x(double yaw) { return compose(turned(v3(0, 1, 0), yaw * DEGREES), turned(v3(0, 0, 1), PI / 2)); }

// From within the angle at which they touch along their length to well beyond the one at which a point alone holds
static void capsules_askew_come_to_rest(void **state)
{
    static const double yaw[] = {2, 3, 4, 5, 8, 12, 20, 29, 35};
    for (int i = 0; i < 18; ++i) {
        const double radius = 0.3, half = 0.3;
        ride r = {.support = capsule(half, radius),
                  .rider = capsule(half, radius),
                  .turn_support = along_x(0),
                  .turn_rider = along_x(yaw[i / 2])};
        r.height = 2 * radius, r.foot = radius, r.half = half + radius, r.load = 50, r.aside = 0.05, r.lever = half,
        r.is_static = i % 2;
        comes_to_rest(state, &r);
    }
}

static void a_capsule_askew_on_an_edge_comes_to_rest(void **state)
{
    static const double yaw[] = {2, 3, 4, 5, 8, 12, 20};
    for (int i = 0; i < 14; ++i) {
        const double radius = 0.3, half = 0.6, side = 0.2;
        ride r = {.support = box(0.7, side, side),
                  .rider = capsule(half, radius),
                  .turn_support = turned(v3(1, 0, 0), PI / 4),
                  .turn_rider = along_x(yaw[i / 2])};
        r.height = side * sqrt(2) + radius, r.foot = side * sqrt(2), r.half = half + radius, r.load = 100,
        r.aside = 0.05, r.lever = half, r.is_static = i % 2;
        comes_to_rest(state, &r);
    }
}

// A bar on its edge lies across a bar of 4 to 16 cm: its edge crosses two rims, and beyond them it is deeper than
// either.
static void an_edge_across_a_face_comes_to_rest(void **state)
{
    static const double width[] = {0.02, 0.04, 0.08};
    for (int i = 0; i < 24; ++i) {
        const double side = 0.04, half = 0.2, tilted = 2 * (i / 6) * DEGREES;
        ride r = {.support = box(width[i / 2 % 3], 0.1, 0.2), .rider = box(half, side, side), .turn_support = UNTURNED};
        r.turn_rider = compose(turned(v3(0, 0, 1), tilted), turned(v3(1, 0, 0), PI / 4));
        r.height = 0.1 + side * sqrt(2) / cos(tilted) + width[i / 2 % 3] * tan(tilted), r.foot = 0.1, r.load = 50,
        r.half = half, r.lever = width[i / 2 % 3], r.is_static = i % 2;
        comes_to_rest(state, &r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(capsules_askew_come_to_rest),
        WITH_4_SUBSTEPS(capsules_askew_come_to_rest),
        TEST(a_capsule_askew_on_an_edge_comes_to_rest),
        TEST(an_edge_across_a_face_comes_to_rest),
        WITH_4_SUBSTEPS(an_edge_across_a_face_comes_to_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
