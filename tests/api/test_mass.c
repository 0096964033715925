// Mass, centre and inertia: from shapes against the textbook, as given, and what moves when they change.
#include "api/api_test.h"

static fe_mass_data mass_of(const fe_world *world, fe_body body)
{
    fe_mass_data data = {.struct_size = sizeof data};
    OK(fe_body_get_mass_data(world, body, &data));
    return data;
}

static fe_shape add_at(fe_world *world, fe_body body, const fe_geometry *geometry, float density, float x, float y,
                       float z)
{
    fe_shape_def def;
    fe_shape_def_init(&def, sizeof def);
    def.density = density;
    def.frame.position = fe_make_vec3(x, y, z);
    fe_shape shape;
    OK(fe_shape_create(world, body, &def, geometry, &shape));
    return shape;
}

// 1 kg and the inertia of a sphere of 1 m: 2/5
static void assert_weightless(const fe_world *world, fe_body body)
{
    fe_mass_data data = mass_of(world, body);
    FE_NEAR(data.mass, 1, 0);
    FE_NEAR(data.inertia.x, 0.4, 1e-7), FE_NEAR(data.inertia.y, 0.4, 1e-7), FE_NEAR(data.inertia.z, 0.4, 1e-7);
    FE_NEAR(data.centre.x, 0, 0);
}

static void a_body_without_weight_has_a_kilogram(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    assert_weightless(world, body);
    fe_geometry sphere;
    fe_geometry_sphere(&sphere, 2);
    fe_shape shape = add_at(world, body, &sphere, 0, 1, 2, 3);
    assert_weightless(world, body);
    OK(fe_shape_set_density(world, shape, 1));
    FE_NEAR(mass_of(world, body).mass, 4.0 / 3 * 3.14159265358979 * 8, 1e-5);
    OK(fe_shape_destroy(world, shape));
    assert_weightless(world, body);
    OK(fe_world_destroy(world));
}

// A single shape gives its own figures: mass 8 abc rho, moments m (b^2 + c^2) / 3
static void one_shape_weighs_what_the_textbook_says(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    fe_geometry box;
    fe_geometry_box(&box, 0.5f, 1, 2);
    add_at(world, body, &box, 500, 0, 0, 0);
    fe_mass_data data = mass_of(world, body);
    FE_NEAR(data.mass, 4000, 0);
    FE_NEAR(data.inertia.x, 4000 * (1 + 4) / 3.0, 1e-3);
    FE_NEAR(data.inertia.y, 4000 * (0.25 + 4) / 3, 1e-3);
    FE_NEAR(data.inertia.z, 4000 * (0.25 + 1) / 3, 1e-3);
    FE_NEAR(data.inertia_rotation.w, 1, 0);
    float mass;
    OK(fe_body_get_mass(world, body, &mass));
    FE_NEAR(mass, 4000, 0);
    OK(fe_world_destroy(world));
}

// The moments of a whole do not depend on how it was cut: a 2 x 2 x 4 m box from two halves, from eight cubes, from
// shapes turned by 90 degrees.
static void a_body_of_parts_weighs_like_the_whole(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_geometry cube, half;
    fe_geometry_box(&cube, 0.5f, 0.5f, 0.5f);
    fe_geometry_box(&half, 1, 1, 1);
    for (int parts = 2; parts <= 16; parts += 14) {
        fe_body body = new_body(world, FE_BODY_DYNAMIC, 5, 5, 5);
        for (int i = 0; i < parts; ++i) {
            if (parts == 2)
                add_at(world, body, &half, 1000, 0, 0, 10.0f + (i ? 1.0f : -1.0f));
            else
                add_at(world, body, &cube, 1000, i & 1 ? 0.5f : -0.5f, i & 2 ? 0.5f : -0.5f,
                       10 + (float)(i >> 2) - 1.5f);
        }
        fe_mass_data data = mass_of(world, body);
        FE_NEAR(data.mass, 16000, 0);
        FE_NEAR(data.centre.x, 0, 1e-6), FE_NEAR(data.centre.z, 10, 1e-5);
        // rounding to floats: 6e-8 of 26667
        FE_NEAR(data.inertia.x, 16000 * (1 + 4) / 3.0, 0.01);
        FE_NEAR(data.inertia.y, 16000 * (1 + 4) / 3.0, 0.01);
        FE_NEAR(data.inertia.z, 16000 * (1 + 1) / 3.0, 0.01);
        fe_dvec3 centre;
        OK(fe_body_get_centre(world, body, &centre));
        FE_NEAR(centre.z, 15, 1e-5);
    }
    OK(fe_world_destroy(world));
}

// Principal axes: a dumbbell along (1, 1, 0) of two 1 m spheres, d from the middle. Its long axis has 2 (2/5 m r^2),
// the others m d^2 more each; the tensor in the body's axes must come out of R diag R^T.
static void principal_axes_are_found(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0, 0);
    fe_geometry sphere;
    fe_geometry_sphere(&sphere, 1);
    add_at(world, body, &sphere, 1, 3, 3, 0);
    add_at(world, body, &sphere, 1, -3, -3, 0);
    fe_mass_data data = mass_of(world, body);
    double m = 4.0 / 3 * 3.14159265358979, small = 2 * 0.4 * m, large = small + 2 * m * 18;
    double moments[3] = {(double)data.inertia.x, (double)data.inertia.y, (double)data.inertia.z};
    double sum = moments[0] + moments[1] + moments[2], least = fmin(fmin(moments[0], moments[1]), moments[2]);
    FE_NEAR(least, small, 1e-4);
    FE_NEAR(sum, small + 2 * large, 1e-3);
    // the long axis, the one of the least moment, lies along (1, 1, 0): its image by the rotation
    fe_quat q = data.inertia_rotation;
    double x = (double)q.x, y = (double)q.y, z = (double)q.z, w = (double)q.w, axis[3];
    if (moments[0] == least)
        axis[0] = 1 - 2 * (y * y + z * z), axis[1] = 2 * (x * y + w * z), axis[2] = 2 * (x * z - w * y);
    else if (moments[1] == least)
        axis[0] = 2 * (x * y - w * z), axis[1] = 1 - 2 * (x * x + z * z), axis[2] = 2 * (y * z + w * x);
    else
        axis[0] = 2 * (x * z + w * y), axis[1] = 2 * (y * z - w * x), axis[2] = 1 - 2 * (x * x + y * y);
    FE_NEAR(fabs(axis[0] + axis[1]), sqrt(2), 1e-6);
    FE_NEAR(axis[2], 0, 1e-6);
    OK(fe_world_destroy(world));
}

// The velocity is the centre's. When the centre moves within the body, no material point changes its motion.
static void material_points_keep_their_motion(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_box(world, 1, 2, 3);
    fe_vec3 v = {1, 2, 3}, w = {-1, 0.5f, 2}, before, after;
    fe_dvec3 point = {1.3, 1.8, 3.4}, old_centre, centre;
    OK(fe_body_set_linear_velocity(world, body, &v));
    OK(fe_body_set_angular_velocity(world, body, &w));
    OK(fe_body_get_point_velocity(world, body, &point, &before));
    OK(fe_body_get_centre(world, body, &old_centre));
    fe_geometry sphere;
    fe_geometry_sphere(&sphere, 1);
    add_at(world, body, &sphere, 1000, 3, 0, 0);
    OK(fe_body_get_centre(world, body, &centre));
    FE_TRUE(centre.x - old_centre.x > 1);
    OK(fe_body_get_point_velocity(world, body, &point, &after));
    FE_NEAR(after.x, before.x, 2e-6), FE_NEAR(after.y, before.y, 2e-6), FE_NEAR(after.z, before.z, 2e-6);
    FE_NEAR(body_transform(world, body).position.x, 1, 0); // the origin stays where it was set
    OK(fe_world_destroy(world));
}

static void given_mass_stays_until_reset(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_box(world, 0, 0, 0);
    fe_mass_data set = {sizeof set, 10, {0, -0.25f, 0}, {1, 2, 2.5f}, {0, 0, 0, 2}}, got;
    OK(fe_body_set_mass_data(world, body, &set));
    add_sphere(world, body, 1); // no longer counts
    got = mass_of(world, body);
    FE_NEAR(got.mass, 10, 0), FE_NEAR(got.centre.y, -0.25, 0), FE_NEAR(got.inertia.z, 2.5, 0),
        FE_NEAR(got.inertia_rotation.w, 1, 0);
    OK(fe_body_set_mass(world, body, 20)); // scales the inertia
    got = mass_of(world, body);
    FE_NEAR(got.mass, 20, 0), FE_NEAR(got.inertia.x, 2, 1e-6), FE_NEAR(got.inertia.z, 5, 1e-6),
        FE_NEAR(got.centre.y, -0.25, 0);
    OK(fe_body_reset_mass(world, body));
    FE_NEAR(mass_of(world, body).mass, 1000 + 4000 / 3.0 * 3.14159265358979, 1e-3);
    OK(fe_world_destroy(world));
}

static void bad_mass_is_refused(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_box(world, 0, 0, 0), ground = new_ground(world),
            lift = new_body(world, FE_BODY_KINEMATIC, 9, 9, 9);
    fe_mass_data good = {sizeof good, 10, {0, 0, 0}, {1, 1, 1}, {0, 0, 0, 1}}, bad;
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_mass(world, body, 0));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_mass(world, body, -1));
    SAYS("fe_body_set_mass: mass is -1, must be 1e-09..");
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_mass(world, body, NOT_A_NUMBER));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_mass(world, body, INFINITE));
    REFUSES(world, FE_ERROR_STATE, fe_body_set_mass(world, ground, 1));
    REFUSES(world, FE_ERROR_STATE, fe_body_set_mass_data(world, lift, &good));
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_mass_data(world, body, NULL));
#define REFUSED_WITH(change) \
    bad = good;              \
    change;                  \
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_set_mass_data(world, body, &bad))
    REFUSED_WITH(bad.mass = 0);
    REFUSED_WITH(bad.mass = NOT_A_NUMBER);
    REFUSED_WITH(bad.centre.x = INFINITE);
    REFUSED_WITH(bad.inertia.x = 0);
    REFUSED_WITH(bad.inertia.y = -1);
    REFUSED_WITH(bad.inertia.z = NOT_A_NUMBER);
    REFUSED_WITH(bad.inertia.z = 2.5f); // above the sum of the others: no such body
    SAYS("no body has a moment above the sum of the other two");
    REFUSED_WITH(bad.inertia_rotation = ((fe_quat){0, 0, 0, 0}));
    REFUSED_WITH(bad.struct_size = 2);
#undef REFUSED_WITH
    good.inertia.z = 2; // a flat plate reaches the sum
    OK(fe_body_set_mass_data(world, body, &good));
    fe_mass_data out = {.struct_size = 0, .mass = 77};
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_mass_data(world, body, &out));
    FE_NEAR(out.mass, 77, 0);
    REFUSES(world, FE_ERROR_ARGUMENT, fe_body_get_mass(world, body, NULL));
    float mass = 5;
    OK(fe_body_get_mass(world, ground, &mass));
    FE_NEAR(mass, 0, 0);
    OK(fe_world_destroy(world));
}

// An older client's struct gets its front, and nothing is written behind it.
static void mass_data_of_an_older_client_is_not_overrun(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body body = new_box(world, 0, 0, 0);
    fe_mass_data out;
    memset(&out, 0x5A, sizeof out);
    out.struct_size = offsetof(fe_mass_data, centre);
    OK(fe_body_get_mass_data(world, body, &out));
    FE_NEAR(out.mass, 1000, 0);
    assert_int_equal(out.struct_size, offsetof(fe_mass_data, centre));
    const unsigned char *tail = (const unsigned char *)&out.centre;
    for (size_t i = 0; i < sizeof out - offsetof(fe_mass_data, centre); ++i) assert_int_equal(tail[i], 0x5A);
    OK(fe_world_destroy(world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_without_weight_has_a_kilogram),
        cmocka_unit_test(one_shape_weighs_what_the_textbook_says),
        cmocka_unit_test(a_body_of_parts_weighs_like_the_whole),
        cmocka_unit_test(principal_axes_are_found),
        cmocka_unit_test(material_points_keep_their_motion),
        cmocka_unit_test(given_mass_stays_until_reset),
        cmocka_unit_test(bad_mass_is_refused),
        cmocka_unit_test(mass_data_of_an_older_client_is_not_overrun),
    };
    return cmocka_run_group_tests_name("mass", tests, NULL, NULL);
}
