// What a form touches on its way past a mesh is what it touches when all triangles are looked at: none that it meets is
// left out, wherever on its way it is looked at, and all SIMD sets leave out the same.
#include "collision/form/hull.h"
#include "collision/manifold/collide.h"
#include "collision/manifold/terrain_course.h"
#include "fe_test.h"
#include "support/hull_make.h"
#include "support/mesh_make.h"

#include <math.h>

#ifdef FE_SANITIZED
enum { WAYS = 1500 };
#else
enum { WAYS = 12000 };
#endif
static const float margin = 0.02f;

static float between(float low, float high) { return low + 0.5f * (high - low) * (float)(soup_random(&dice) + 1.0); }
static fe_vec3 vector(float size) { return fe__narrow(random_point((double)size)); }

static fe__form form_of(int32_t kind, const fe__hull *hull)
{
    float a = between(0.2f, 0.6f), b = between(0.2f, 0.6f), c = between(0.2f, 0.6f);
    switch (kind) {
    case 0:
        return (fe__form){.type = FE__FORM_SPHERE, .radius = a};
    case 1:
        return (fe__form){.type = FE__FORM_CAPSULE, .radius = a, .half_height = b};
    case 2:
        return (fe__form){.type = FE__FORM_BOX, .half = {a, b, c}};
    case 3:
        return (fe__form){.type = FE__FORM_CYLINDER, .half = {a, b, a}};
    case 4:
        return (fe__form){.type = FE__FORM_CONE, .half = {a, b, a}};
    default:
        break;
    }
    fe__form form = fe__hull_form(hull, 0);
    form.scale = a;
    return form;
}

// A body whose centre of mass goes along a parabola and which turns about it, as fe__advance has it
typedef struct flight {
    fe__form form;
    fe_dvec3 centre; // at the start
    fe_vec3 local;   // the centre in the form's frame
    fe_vec3 way, fall, turn;
    fe_quat rotation;
} flight;

typedef struct place {
    fe_dvec3 origin;
    fe__mat3 rotation;
} place;

static place place_at(const flight *f, float t)
{
    fe_vec3 w = fe__scale(0.5f * t, f->turn), shift = fe__add_scaled(fe__scale(t, f->way), t * t, f->fall);
    fe_quat q = f->rotation, turned = fe__product((fe_quat){w.x, w.y, w.z, 0.0f}, q);
    q = fe__normalized((fe_quat){q.x + turned.x, q.y + turned.y, q.z + turned.z, q.w + turned.w});
    fe__mat3 r = fe__matrix(q);
    fe_dvec3 centre = fe__dadd(f->centre, fe__widen(shift));
    return (place){fe__dsub(centre, fe__widen(fe__mul(&r, f->local))), r};
}

static flight random_flight(int32_t kind, const fe__hull *hull)
{
    flight f;
    f.form = form_of(kind, hull);
    f.local = vector(kind % 2 ? 0.2f : 0.0f);
    f.centre = (fe_dvec3){(double)between(-4.0f, 4.0f), (double)between(0.0f, 1.0f), (double)between(-4.0f, 4.0f)};
    f.way = vector(between(0.0f, 0.3f)), f.fall = fe__vec3(0.0f, -0.003f, 0.0f);
    f.turn = vector(between(0.0f, 0.5f));
    fe_vec3 q = vector(1.0f);
    f.rotation = fe__normalized((fe_quat){q.x, q.y, q.z, between(-1.0f, 1.0f)});
    return f;
}

static fe__course course_of(const flight *f)
{
    place start = place_at(f, 0.0f), end = place_at(f, 1.0f);
    return (fe__course){{start.rotation, end.rotation},
                        fe__narrow(fe__dsub(end.origin, start.origin)),
                        fe__narrow(fe__dsub(f->centre, start.origin)),
                        fe__form_reach(&f->form, f->local),
                        fe__length(f->turn),
                        fe__length(f->fall)};
}

static void touches_the_same(const fe__mesh *mesh, const fe__mesh_near *near, const flight *f, float t)
{
    static const fe__surroundings nothing;
    place at = place_at(f, t);
    fe__terrain all = {.ground = {.mesh = mesh}, .origin = at.origin, .around = &nothing}, some = all;
    some.ground.near = near, some.is_last = t == 1.0f;
    fe__patch a[FE__PATCHES], b[FE__PATCHES];
    int32_t count = fe__collide_terrain(&all, &f->form, &at.rotation, margin, a, NULL);
    assert_int_equal(fe__collide_terrain(&some, &f->form, &at.rotation, margin, b, NULL), count);
    for (int32_t i = 0; i < count; ++i) {
        assert_int_equal(a[i].count, b[i].count);
        assert_int_equal(a[i].triangle, b[i].triangle);
        assert_memory_equal(&a[i].normal, &b[i].normal, sizeof a[i].normal);
        assert_memory_equal(a[i].points, b[i].points, (size_t)a[i].count * sizeof *a[i].points);
    }
}

static void find(const fe__mesh *mesh, const flight *f, const fe__course *course, fe__course_kernel *kernel,
                 fe__mesh_near *near)
{
    fe__terrain t = {.ground = {.mesh = mesh}, .origin = place_at(f, 0.0f).origin};
    fe__find_triangles_on_course(&t, &f->form, course, margin, kernel, near);
}

static void every_set_leaves_out_the_same(const fe__mesh *mesh, const flight *f, const fe__course *course,
                                          const fe__mesh_near *near)
{
    for (int32_t simd = FE_SIMD_PLAIN + 1; simd <= FE_SIMD_NEON; ++simd) {
        const fe__kernels *kernels = fe__kernels_of(simd);
        if (!kernels) continue;
        fe__mesh_near other;
        find(mesh, f, course, kernels->meet_course, &other);
        assert_int_equal(other.count, near->count);
        assert_true(other.among == near->among && other.among_last == near->among_last);
    }
}

static void nothing_that_is_met_is_left_out(void **state)
{
    (void)state;
    enum { KINDS = 6, POINTS = 24, LOOKS = 4 };
    soup_terrain(&made, 12, 0.8, 0.2, &dice);
    soup_terrain(&made, 3, 3.1, 0.3, &dice); // large ones that cross them
    made_mesh m;
    FE_TRUE(make_mesh(&made, &m));
    float points[POINTS][3];
    for (int32_t i = 0; i < POINTS; ++i) {
        fe_vec3 v = vector(1.0f);
        points[i][0] = v.x, points[i][1] = v.y, points[i][2] = v.z;
    }
    made_hull hull;
    FE_TRUE(make_hull(&points[0][0], POINTS, 64, 0.0, &hull));
    int64_t listed = 0, left = 0;
    for (int32_t i = 0; i < WAYS; ++i) {
        flight f = random_flight(i % KINDS, &hull.hull);
        fe__course course = course_of(&f);
        fe__mesh_near near;
        find(&m.mesh, &f, &course, fe__kernels_of(FE_SIMD_PLAIN)->meet_course, &near);
        if (near.count < 0) continue;
        listed += near.count, left += __builtin_popcountll(near.among);
        every_set_leaves_out_the_same(&m.mesh, &f, &course, &near);
        for (int32_t k = 0; k <= LOOKS; ++k) touches_the_same(&m.mesh, &near, &f, (float)k / (float)LOOKS);
    }
    FE_WITHIN((double)left, 0.0, 0.6 * (double)listed);
    free_hull(&hull);
    free_mesh(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup(nothing_that_is_met_is_left_out, reset)};
    return cmocka_run_group_tests(tests, NULL, reset);
}
