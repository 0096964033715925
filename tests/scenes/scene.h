// scene.h - what the tests of scenes share: building a world, moving it on, reading it.
//
// A test describes its scene with +y up, in the frame of the scene. The scene's `turn` brings that frame into the
// world, so that one test runs with gravity along any axis: an engine that knows what is up would show. All that comes
// in and goes out here is in the scene's frame and in double. Bodies do not sleep unless a test lets them: a body that
// creeps must be seen to creep.
//
//   static void ball_falls(void **state) { scene s = scene_begin(state); ... scene_end(&s); }
//   const struct CMUnitTest tests[] = {EVERY_WAY_UP(ball_falls), WITH_4_SUBSTEPS(ball_falls)};
#ifndef SCENE_H
#define SCENE_H

#include "fe_test.h"
#include "feather.h"
#include "support/values.h"

#include <math.h>

#define DT (1.0f / 60.0f)
#define STEP ((double)DT) // s, as the engine has it
#define G ((double)9.81f) // m/s2, as the engine has it
#define LINEAR_SLOP 0.005 // m: what a contact may give
#define PI 3.14159265358979323846
#define DEGREES (PI / 180)
#define WATER 1000.0f // kg/m3
#define UNTURNED ((fe_quat){0, 0, 0, 1})

// ---- vectors -------------------------------------------------------------------------------------------------------

typedef fe_dvec3 vec;

static inline vec v3(double x, double y, double z) { return fe_make_dvec3(x, y, z); }
static inline vec widen(fe_vec3 a) { return v3(a.x, a.y, a.z); }
static inline fe_vec3 narrow(vec a) { return fe_make_vec3((float)a.x, (float)a.y, (float)a.z); }
static inline vec plus(vec a, vec b) { return v3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline vec minus(vec a, vec b) { return v3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline vec times(double k, vec a) { return v3(k * a.x, k * a.y, k * a.z); }
static inline double dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline vec cross(vec a, vec b)
{
    return v3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline double length(vec a) { return sqrt(dot(a, a)); }
static inline double between(vec a, vec b) { return atan2(length(cross(a, b)), dot(a, b)); } // angle, rad

// q/|q| applied to a
static inline vec rotate(fe_quat q, vec a)
{
    vec u = v3(q.x, q.y, q.z);
    double w = q.w, k = 2 / (dot(u, u) + w * w);
    vec t = cross(u, a);
    return plus(a, times(k, plus(times(w, t), cross(u, t))));
}

static inline fe_quat inverse(fe_quat q) { return (fe_quat){-q.x, -q.y, -q.z, q.w}; }

// first b, then a; unit
static inline fe_quat compose(fe_quat a, fe_quat b)
{
    vec u = v3(a.x, a.y, a.z), v = v3(b.x, b.y, b.z);
    double p = a.w, q = b.w, w = p * q - dot(u, v);
    vec t = plus(plus(times(p, v), times(q, u)), cross(u, v));
    double k = 1 / sqrt(dot(t, t) + w * w);
    return (fe_quat){(float)(k * t.x), (float)(k * t.y), (float)(k * t.z), (float)(k * w)};
}

// by `angle` rad about `axis`
static inline fe_quat turned(vec axis, double angle)
{
    double k = sin(angle / 2) / length(axis);
    return (fe_quat){(float)(k * axis.x), (float)(k * axis.y), (float)(k * axis.z), (float)cos(angle / 2)};
}

// ---- worlds --------------------------------------------------------------------------------------------------------

typedef struct setup {
    fe_quat turn;
    int substeps;
} setup;

typedef struct scene {
    fe_world *world;
    fe_quat turn; // scene frame to world
    int substeps;
    double h; // s, of a substep
} scene;

// the cyclic turns are exact in float; the last one is nobody's axis
#define SETUP static __attribute__((unused)) setup
SETUP upright = {{0, 0, 0, 1}, 8};
SETUP upright_4 = {{0, 0, 0, 1}, 4};
SETUP up_along_z = {{0.5f, 0.5f, 0.5f, 0.5f}, 8};
SETUP up_along_x = {{-0.5f, -0.5f, -0.5f, 0.5f}, 8};
SETUP upside_down = {{1, 0, 0, 0}, 8};
SETUP askew = {{0.35f, -0.61f, 0.27f, 0.66f}, 8};

#define TEST_WITH(f, how_it_is, how)                                \
    {                                                               \
        .name = #f how_it_is, .test_func = f, .initial_state = &how \
    }
#define TEST(f) TEST_WITH(f, "", upright)
#define WITH_4_SUBSTEPS(f) TEST_WITH(f, ", 4 substeps", upright_4)
#define EVERY_WAY_UP(f)                                                              \
    TEST(f), TEST_WITH(f, ", z up", up_along_z), TEST_WITH(f, ", x up", up_along_x), \
        TEST_WITH(f, ", -y up", upside_down), TEST_WITH(f, ", askew", askew)

// a call that must succeed
#define MUST(call) FE_TRUE((call) >= 0)

static inline vec to_world(const scene *s, vec a) { return rotate(s->turn, a); }
static inline vec from_world(const scene *s, vec a) { return rotate(inverse(s->turn), a); }

static inline void set_gravity(scene *s, vec gravity)
{
    fe_vec3 g = narrow(to_world(s, gravity));
    MUST(fe_world_set_gravity(s->world, &g));
}

// A world at 60 Hz with 9.81 m/s2 downwards. `state` is cmocka's, from one of the macros above; NULL, or pointing to
// NULL: upright, 8 substeps.
static inline scene scene_begin(void **state)
{
    const setup *how = state && *state ? (const setup *)*state : &upright;
    scene s = {NULL, how->turn, how->substeps, STEP / how->substeps};
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.substeps = how->substeps;
    MUST(fe_world_create(&def, &s.world));
    set_gravity(&s, v3(0, -G, 0));
    return s;
}

static inline void scene_end(scene *s) { MUST(fe_world_destroy(s->world)); }

static inline void run(scene *s, int steps)
{
    for (int i = 0; i < steps; ++i) MUST(fe_world_step(s->world, DT));
}

// ---- bodies --------------------------------------------------------------------------------------------------------

static inline fe_geometry sphere(double radius)
{
    fe_geometry form;
    fe_geometry_sphere(&form, (float)radius);
    return form;
}

static inline fe_geometry box(double half_x, double half_y, double half_z)
{
    fe_geometry form;
    fe_geometry_box(&form, (float)half_x, (float)half_y, (float)half_z);
    return form;
}

static inline fe_geometry capsule(double half_height, double radius)
{
    fe_geometry form;
    fe_geometry_capsule(&form, (float)half_height, (float)radius);
    return form;
}

// static and dynamic friction alike
static inline fe_material friction(double mu) { return (fe_material)SURFACE((float)mu, (float)mu, 0, 0, 0); }

static inline fe_material bouncy(double mu, double restitution)
{
    return (fe_material)SURFACE((float)mu, (float)mu, (float)restitution, 0, 0);
}

static inline fe_body add_body(scene *s, int32_t type, fe_geometry form, vec position, fe_quat rotation,
                               fe_material material, float density)
{
    fe_body_def body_def;
    fe_shape_def shape_def;
    fe_body body;
    fe_shape shape;
    fe_body_def_init(&body_def, sizeof body_def);
    body_def.type = type;
    body_def.transform.position = to_world(s, position);
    body_def.transform.rotation = compose(s->turn, rotation);
    body_def.sleep_allowed = 0;
    MUST(fe_body_create(s->world, &body_def, &body));
    fe_shape_def_init(&shape_def, sizeof shape_def);
    shape_def.density = density;
    shape_def.material = material;
    MUST(fe_shape_create(s->world, body, &shape_def, &form, &shape));
    return body;
}

static inline fe_body add_dynamic(scene *s, fe_geometry form, vec position, fe_quat rotation, fe_material material,
                                  float density)
{
    return add_body(s, FE_BODY_DYNAMIC, form, position, rotation, material, density);
}

static inline fe_body add_static(scene *s, fe_geometry form, vec position, fe_quat rotation, fe_material material)
{
    return add_body(s, FE_BODY_STATIC, form, position, rotation, material, WATER);
}

// the half space normal . p <= distance
static inline fe_body add_plane(scene *s, vec normal, double distance, fe_material material)
{
    fe_geometry form;
    vec n = to_world(s, times(1 / length(normal), normal));
    fe_geometry_plane(&form, (float)n.x, (float)n.y, (float)n.z, (float)distance);
    return add_body(s, FE_BODY_STATIC, form, v3(0, 0, 0), inverse(s->turn), material, WATER);
}

static inline fe_body add_ground(scene *s, fe_material material) { return add_plane(s, v3(0, 1, 0), 0, material); }

// A plane through the origin that rises by `angle` towards +x
static inline vec slope_normal(double angle) { return v3(-sin(angle), cos(angle), 0); }
static inline vec downhill(double angle) { return v3(-cos(angle), -sin(angle), 0); }
static inline fe_quat slope_turn(double angle) { return turned(v3(0, 0, 1), angle); }
static inline fe_body add_slope(scene *s, double angle, fe_material material)
{
    return add_plane(s, slope_normal(angle), 0, material);
}

static inline void set_velocity(scene *s, fe_body body, vec linear, vec angular)
{
    fe_vec3 v = narrow(to_world(s, linear)), w = narrow(to_world(s, angular));
    MUST(fe_body_set_linear_velocity(s->world, body, &v));
    MUST(fe_body_set_angular_velocity(s->world, body, &w));
}

// N, during the next step
static inline void add_force(scene *s, fe_body body, vec force)
{
    fe_vec3 f = narrow(to_world(s, force));
    MUST(fe_body_add_force(s->world, body, &f));
}

static inline void add_force_at(scene *s, fe_body body, vec force, vec point)
{
    fe_vec3 f = narrow(to_world(s, force));
    vec p = to_world(s, point);
    MUST(fe_body_add_force_at(s->world, body, &f, &p));
}

static inline void add_torque(scene *s, fe_body body, vec torque)
{
    fe_vec3 t = narrow(to_world(s, torque));
    MUST(fe_body_add_torque(s->world, body, &t));
}

// ---- reading -------------------------------------------------------------------------------------------------------

static inline vec position(const scene *s, fe_body body)
{
    return from_world(s, body_transform(s->world, body).position);
}

// where the body's own axis `local` points to
static inline vec axis_of(const scene *s, fe_body body, vec local)
{
    return from_world(s, rotate(body_transform(s->world, body).rotation, local));
}

// between the body's y axis and up, rad
static inline double tilt(const scene *s, fe_body body) { return between(axis_of(s, body, v3(0, 1, 0)), v3(0, 1, 0)); }

static inline vec velocity(const scene *s, fe_body body)
{
    return from_world(s, widen(body_linear_velocity(s->world, body)));
}
static inline vec spin(const scene *s, fe_body body)
{
    return from_world(s, widen(body_angular_velocity(s->world, body)));
}

static inline double mass_of(const scene *s, fe_body body)
{
    float mass = 0;
    MUST(fe_body_get_mass(s->world, body, &mass));
    return (double)mass;
}

static inline fe_mass_data mass_data_of(const scene *s, fe_body body)
{
    fe_mass_data data = {.struct_size = sizeof data};
    MUST(fe_body_get_mass_data(s->world, body, &data));
    return data;
}

enum { MOST_CONTACTS = 32 };

// Along the normal, between two bodies, over the whole last step, N s; 0 when they do not touch.
static inline double normal_impulse(const scene *s, fe_body a, fe_body b)
{
    fe_contact contacts[MOST_CONTACTS];
    int32_t count = fe_body_get_contacts(s->world, a, contacts, sizeof *contacts, MOST_CONTACTS);
    double sum = 0;
    FE_WITHIN(count, 0, MOST_CONTACTS);
    for (int32_t i = 0; i < count; ++i)
        if (contacts[i].body_a == b || contacts[i].body_b == b)
            for (int32_t k = 0; k < contacts[i].point_count; ++k) sum += (double)contacts[i].points[k].total_impulse;
    return sum;
}

// ---- what to expect ------------------------------------------------------------------------------------------------

// Relative error of a velocity after n additions in float: half a unit in the last place each, 3e-8 on average.
static inline double rounding(double additions) { return fmax(1e-6, 3e-8 * additions); }

// P1: a soft contact at rest gives by load / (effective mass w^2), m; w is twice as high against a static body.
static inline double sink(double load, double effective_mass, int on_static)
{
    double w = 2 * PI * 30 * (on_static ? 2 : 1);
    return load / (effective_mass * w * w);
}

// P3: the way of v += h a; x += h v from rest, after t s.
static inline double discrete_way(double a, double t, double h) { return a * t * (t + h) / 2; }

#endif
