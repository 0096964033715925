// Masses, bounds and sizes of the forms, against sums over slices and over points.
#include "fe_test.h"

#include "collision/form/form.h"

#include "collision_cases.h"

#define PI 3.14159265358979323846
// mass and inertia are computed in double and rounded once to float
#define HALF_ULP 6e-8

static fe_dvec3 radius_out(const fe__form *form, fe_dvec3 p, fe_dvec3 direction)
{
    return fe__dadd(p, fe__dscale((double)form->radius, direction));
}

static void masses_of_sphere_and_box_are_the_textbooks(void **state)
{
    (void)state;
    const fe__form ball = sphere(0.5f), brick = box(0.5f, 1.0f, 1.5f);
    double m = 1000.0 * 4.0 / 3.0 * PI * 0.125;
    fe__mass mass = fe__form_mass(&ball, 1000.0f);
    FE_NEAR(mass.mass, m, 2.0 * HALF_ULP * m); // PI is a float
    FE_NEAR(mass.inertia.x, 0.4 * m * 0.25, 2.0 * HALF_ULP * m);
    FE_TRUE(mass.inertia.x == mass.inertia.y && mass.inertia.y == mass.inertia.z);
    mass = fe__form_mass(&brick, 500.0f);
    FE_NEAR(mass.mass, 3000.0, 0.0);
    FE_NEAR(mass.inertia.x, 3000.0 * (4.0 + 9.0) / 12.0, 1e-3);
    FE_NEAR(mass.inertia.y, 3000.0 * (1.0 + 9.0) / 12.0, 1e-3);
    FE_NEAR(mass.inertia.z, 3000.0 * (1.0 + 4.0) / 12.0, 1e-3);
}

// A body of revolution is a sum of discs: dm = pi r^2 dy, about its axis dm r^2 / 2, across it dm (r^2 / 4 + y^2).
// Simpson over each part of the capsule is exact up to cubic terms; the quartic leaves (1/n)^4 of the whole.
static void masses_of_capsules_are_sums_of_discs(void **state)
{
    (void)state;
    for (int32_t i = 0; i < 20; ++i) {
        fe__form form = random_form(FE__FORM_CAPSULE);
        double h = (double)form.half_height, r = (double)form.radius, sum[3] = {0.0, 0.0, 0.0};
        const double low[3] = {-h - r, -h, h}, high[3] = {-h, h, h + r};
        enum { SLICES = 200 };
        for (int32_t part = 0; part < 3; ++part) {
            double dy = (high[part] - low[part]) / SLICES;
            for (int32_t k = 0; k <= SLICES; ++k) {
                double y = low[part] + dy * k, beyond = fe__maxd(fe__absd(y) - h, 0.0),
                       square = fe__maxd(r * r - beyond * beyond, 0.0);
                double weight = dy / 3.0 *
                                (k == 0 || k == SLICES ? 1.0
                                 : k & 1               ? 4.0
                                                       : 2.0),
                       disc = weight * PI * square;
                sum[0] += disc, sum[1] += disc * 0.5 * square, sum[2] += disc * (0.25 * square + y * y);
            }
        }
        fe__mass mass = fe__form_mass(&form, 1000.0f);
        FE_NEAR(mass.mass, 1000.0 * sum[0], 4.0 * HALF_ULP * 1000.0 * sum[0]);
        FE_NEAR(mass.inertia.y, 1000.0 * sum[1], 4.0 * HALF_ULP * 1000.0 * sum[1]);
        FE_NEAR(mass.inertia.x, 1000.0 * sum[2], 4.0 * HALF_ULP * 1000.0 * sum[2]);
        FE_TRUE(mass.inertia.x == mass.inertia.z);
    }
}

static void a_plane_has_no_mass(void **state)
{
    (void)state;
    const fe__form ground = plane(fe__vec3(0.0f, 1.0f, 0.0f), 0.0f);
    fe__mass mass = fe__form_mass(&ground, 1000.0f);
    FE_TRUE(mass.mass == 0.0f && mass.inertia.x == 0.0f && mass.inertia.y == 0.0f && mass.inertia.z == 0.0f);
}

// Each side of the bounds is touched by the form's farthest point that way, and by none beyond: in double, at any
// distance from the origin.
static void bounds_are_tight(void **state)
{
    (void)state;
    for (int32_t i = 0; i < 20000; ++i) {
        fe__form form = random_form(i % 3);
        double distance = i & 1 ? 1e6 : 1.0;
        fe_vec3 place = random_vector(distance);
        fe__pose pose = {fe__widen(place), random_rotation()};
        fe__bounds bounds = fe__form_bounds(&form, &pose);
        const fe_dvec3 axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
        const double low[3] = {bounds.low.x, bounds.low.y, bounds.low.z},
                     high[3] = {bounds.high.x, bounds.high.y, bounds.high.z};
        for (int32_t k = 0; k < 3; ++k) {
            for (int32_t sign = -1; sign <= 1; sign += 2) {
                fe_dvec3 out = fe__dscale(sign, axes[k]), local = fe__drotate_back(pose.rotation, out);
                fe_dvec3 farthest = radius_out(&form, fe__form_support(&form, local), local);
                double reach = fe__ddot(fe__dadd(pose.position, fe__drotate(pose.rotation, farthest)), axes[k]);
                FE_NEAR(sign < 0 ? low[k] : high[k], reach, 1e-15 * (distance + 4.0) * 4.0);
            }
        }
    }
}

static void a_plane_is_bounded_only_along_an_axis(void **state)
{
    (void)state;
    const fe_vec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    const fe__pose pose = {{10.0, 20.0, 30.0}, {0.0f, 0.0f, 0.0f, 1.0f}};
    for (int32_t i = 0; i < 6; ++i) {
        fe__form form = plane(axes[i], 2.0f);
        fe__bounds bounds = fe__form_bounds(&form, &pose);
        const double low[3] = {bounds.low.x, bounds.low.y, bounds.low.z},
                     high[3] = {bounds.high.x, bounds.high.y, bounds.high.z};
        const double position[3] = {10.0, 20.0, 30.0};
        for (int32_t k = 0; k < 3; ++k) {
            int32_t faces = k == i / 2, negative = i & 1;
            FE_TRUE(high[k] == (faces && !negative ? position[k] + 2.0 : INFINITY));
            FE_TRUE(low[k] == (faces && negative ? position[k] - 2.0 : -INFINITY));
        }
    }
    fe__form slope = plane(fe__vec3(1.0f, 1.0f, 0.0f), 2.0f);
    fe__bounds bounds = fe__form_bounds(&slope, &pose);
    FE_TRUE(bounds.low.x == -INFINITY && bounds.high.x == INFINITY && bounds.low.y == -INFINITY &&
            bounds.high.y == INFINITY);
}

// No corner, swelled by the radius, is farther than the reach, and one is as far.
static void reach_is_the_farthest_point(void **state)
{
    (void)state;
    for (int32_t i = 0; i < 5000; ++i) {
        fe__form form = random_form(i % 3);
        fe_vec3 centre = random_vector(1.0);
        fe_dvec3 corner[8];
        core_corners(&form, corner);
        double far = 0.0;
        for (int32_t k = 0; k < 8; ++k) {
            fe_dvec3 d = fe__dsub(corner[k], fe__widen(centre));
            far = fe__maxd(far, sqrt(fe__ddot(d, d)));
        }
        FE_NEAR(fe__form_reach(&form, centre), far + (double)form.radius, 1e-6);
    }
    const fe__form ground = plane(fe__vec3(0.0f, 1.0f, 0.0f), 0.0f);
    FE_TRUE(fe__form_reach(&ground, fe__vec3(1.0f, 2.0f, 3.0f)) == 0.0f);
}

static void thickness_is_the_smallest_half_width(void **state)
{
    (void)state;
    const fe__form ball = sphere(0.5f), pill = capsule(2.0f, 0.25f), brick = box(0.5f, 0.125f, 1.5f),
                   ground = plane(fe__vec3(0.0f, 1.0f, 0.0f), 0.0f);
    FE_TRUE(fe__form_thickness(&ball) == 0.5f);
    FE_TRUE(fe__form_thickness(&pill) == 0.25f);
    FE_TRUE(fe__form_thickness(&brick) == 0.125f);
    FE_TRUE(fe__form_thickness(&ground) >= 1e30f); // a half space is never outrun
}

// The face in a direction is flat, turns left around its normal, and lies as far out as the support point when the
// direction is its normal.
static void faces_turn_left_around_their_normals(void **state)
{
    (void)state;
    for (int32_t i = 0; i < 5000; ++i) {
        fe__form form = random_form(i % 3);
        fe_vec3 direction = fe__narrow(random_direction());
        fe__face face;
        fe__form_face(&form, direction, &face);
        FE_TRUE(face.count == (form.type == FE__FORM_BOX ? 4 : form.type == FE__FORM_CAPSULE ? 2 : 1));
        if (face.count < 3) continue;
        FE_WITHIN(fe__dot(face.normal, direction), 0.577, 1.0 + 1e-6); // some face of a box is within 54.8 degrees
        double out = fe__ddot(fe__form_support(&form, fe__widen(face.normal)), fe__widen(face.normal));
        for (int32_t k = 0; k < face.count; ++k) {
            fe_vec3 p = face.vertex[k], q = face.vertex[(k + 1) % face.count], r = face.vertex[(k + 2) % face.count];
            FE_NEAR(fe__dot(p, face.normal), out, 1e-6);
            FE_WITHIN(fe__dot(fe__cross(fe__sub(q, p), fe__sub(r, q)), face.normal), 0.01 * 0.01,
                      INFINITY); // half widths are 5 cm at least
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(masses_of_sphere_and_box_are_the_textbooks),
        cmocka_unit_test(masses_of_capsules_are_sums_of_discs),
        cmocka_unit_test(a_plane_has_no_mass),
        cmocka_unit_test(bounds_are_tight),
        cmocka_unit_test(a_plane_is_bounded_only_along_an_axis),
        cmocka_unit_test(reach_is_the_farthest_point),
        cmocka_unit_test(thickness_is_the_smallest_half_width),
        cmocka_unit_test(faces_turn_left_around_their_normals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
