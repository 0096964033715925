// MuJoCo as a measuring stick for many small worlds (mujoco.h): Newton's solver, in steps of 5 ms at most. Its worlds
// are trees of bodies: the scene is told as MJCF, each body inside the one that its joint hangs it on.
#include "mujoco.h"

#ifdef FE_BENCH_MUJOCO

#include "../memory.h"

#include <math.h>
#include <mujoco/mujoco.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LONGEST 0.005                    // s, of a step: as its documentation recommends for contacts
#define DRIVE 1000.0                     // N m s/rad: how hard a motor holds its speed, before it is at its largest
enum { GROUND_BITS = 1, FREE_BITS = 2 }; // what collides with what: all with the ground, ungrouped bodies with all

struct bench_world {
    mjModel *model; // of the scene, which all worlds of it share
    mjData *data;
    int32_t substeps, bodies;
};

// ---- MJCF ----------------------------------------------------------------------------------------------------------
typedef struct text {
    char *bytes;
    size_t length, capacity;
} text;

static void put(text *t, const char *format, ...)
{
    enum { LONGEST_LINE = 512 };
    if (t->capacity - t->length < LONGEST_LINE) {
        t->capacity = 2 * t->capacity + LONGEST_LINE;
        t->bytes = bench_resize(t->bytes, t->capacity, 1);
    }
    va_list arguments;
    va_start(arguments, format);
    t->length += (size_t)vsnprintf(t->bytes + t->length, t->capacity - t->length, format, arguments);
    va_end(arguments);
}

// w first, as the engine has them
static void rotation_of(const bench_body *body, double *out)
{
    const double *q = body->start.rotation;
    out[0] = q[3], out[1] = q[0], out[2] = q[1], out[3] = q[2];
}

// What a point or, without a position, a direction of the world is in a body's frame
static void into(const bench_body *body, const double *v, int is_point, double *out)
{
    double q[4], back[4], d[3];
    rotation_of(body, q);
    mju_negQuat(back, q);
    for (int k = 0; k < 3; k++) d[k] = is_point ? v[k] - body->start.position[k] : v[k];
    mju_rotVecQuat(out, d, back);
}

static void put_pose(text *t, const bench_scene *scene, const bench_body *body, const bench_body *parent)
{
    double p[3], q[4], of_parent[4], back[4], relative[4];
    rotation_of(body, q);
    mju_copy3(p, body->start.position);
    mju_copy4(relative, q);
    if (parent != NULL) {
        into(parent, body->start.position, 1, p);
        rotation_of(parent, of_parent);
        mju_negQuat(back, of_parent);
        mju_mulQuat(relative, back, q);
    }
    put(t, "<body name=\"b%d\" pos=\"%.17g %.17g %.17g\" quat=\"%.17g %.17g %.17g %.17g\">\n",
        (int)(body - scene->bodies), p[0], p[1], p[2], relative[0], relative[1], relative[2], relative[3]);
}

static void put_geom(text *t, const bench_shape *shape, const bench_body *body)
{
    const int grouped = body->group != 0;
    put(t, "<geom density=\"%g\" friction=\"%g\" contype=\"%d\" conaffinity=\"%d\" ", (double)shape->density,
        (double)shape->friction, grouped ? GROUND_BITS : GROUND_BITS | FREE_BITS,
        body->dynamic && grouped ? 0
        : body->dynamic          ? FREE_BITS
                                 : GROUND_BITS);
    if (shape->form == BENCH_CAPSULE)
        put(t, "type=\"capsule\" size=\"%g\" fromto=\"0 %g 0 0 %g 0\"/>\n", (double)shape->radius,
            -(double)shape->half_height, (double)shape->half_height);
    else if (shape->form == BENCH_SPHERE)
        put(t, "type=\"sphere\" size=\"%g\"/>\n", (double)shape->radius);
    else
        put(t, "type=\"box\" size=\"%g %g %g\"/>\n", (double)shape->half[0], (double)shape->half[1],
            (double)shape->half[2]);
}

// A ball's limits are those of the angle of its whole turn: the larger of the cone's and the twist's
static void put_joint(text *t, const bench_joint *joint, int32_t index, const bench_body *child)
{
    static const char *const kinds[] = {"ball", "hinge", "slide"};
    double at[3], axis[3];
    into(child, joint->anchor, 1, at);
    into(child, joint->axis, 0, axis);
    put(t, "<joint name=\"j%d\" type=\"%s\" pos=\"%.17g %.17g %.17g\" ", (int)index, kinds[joint->kind], at[0], at[1],
        at[2]);
    if (joint->kind != BENCH_BALL) put(t, "axis=\"%.17g %.17g %.17g\" ", axis[0], axis[1], axis[2]);
    if (joint->has_limits && joint->kind != BENCH_BALL)
        put(t, "limited=\"true\" range=\"%g %g\" ", joint->limits[0], joint->limits[1]);
    if (joint->has_limits && joint->kind == BENCH_BALL)
        put(t, "limited=\"true\" range=\"0 %g\" ", fmax(joint->cone, fmax(-joint->limits[0], joint->limits[1])));
    if (joint->motor_speed == 0.0 && joint->motor_max > 0.0) put(t, "frictionloss=\"%g\" ", joint->motor_max);
    put(t, "/>\n");
}

static void put_freedom(text *t, const bench_body *body)
{
    const char *planar = "<joint type=\"slide\" axis=\"1 0 0\"/><joint type=\"slide\" axis=\"0 1 0\"/>"
                         "<joint type=\"hinge\" axis=\"0 0 1\"/>\n";
    put(t, body->linear_locks ? planar : "<freejoint/>\n");
}

// The joint that hangs a body on another one; -1: it is free
static int32_t joint_above(const bench_scene *scene, int32_t body)
{
    for (int32_t i = 0; i < scene->joint_count; i++)
        if (scene->joints[i].body_b == body) return i;
    return -1;
}

static void put_body(text *t, const bench_scene *scene, int32_t index, const bench_body *parent)
{
    const bench_body *body = &scene->bodies[index];
    const int32_t above = joint_above(scene, index);
    put_pose(t, scene, body, parent);
    if (above >= 0)
        put_joint(t, &scene->joints[above], above, body);
    else if (body->dynamic)
        put_freedom(t, body);
    put_geom(t, &scene->shapes[body->shape], body);
    for (int32_t i = 0; i < scene->joint_count; i++)
        if (scene->joints[i].body_a == index) put_body(t, scene, scene->joints[i].body_b, body);
    put(t, "</body>\n");
}

static void put_scene(text *t, const bench_scene *scene, double dt)
{
    const double *g = scene->gravity;
    put(t, "<mujoco><compiler angle=\"radian\"/><option timestep=\"%.17g\" gravity=\"%g %g %g\"/>\n", dt, g[0], g[1],
        g[2]);
    put(t, "<size njmax=\"500\" nconmax=\"100\" nstack=\"60000\"/><worldbody>\n");
    for (int32_t i = 0; i < scene->body_count; i++)
        if (joint_above(scene, i) < 0) put_body(t, scene, i, NULL);
    put(t, "</worldbody><actuator>\n");
    for (int32_t i = 0; i < scene->joint_count; i++) {
        const bench_joint *joint = &scene->joints[i];
        if (joint->motor_speed == 0.0) continue;
        put(t, "<velocity joint=\"j%d\" kv=\"%g\" forcelimited=\"true\" forcerange=\"%g %g\"/>\n", (int)i, DRIVE,
            -joint->motor_max, joint->motor_max);
    }
    put(t, "</actuator></mujoco>\n");
}

// ---- worlds --------------------------------------------------------------------------------------------------------
static mjModel *load(const bench_scene *scene, double dt)
{
    text t = {NULL, 0, 0};
    char error[1000] = "";
    put_scene(&t, scene, dt);
    mjVFS *files = bench_allocate(1, sizeof *files);
    mj_defaultVFS(files);
    mjModel *model = NULL;
    if (mj_makeEmptyFileVFS(files, "scene.xml", (int)t.length) == 0) {
        memcpy(files->filedata[0], t.bytes, t.length);
        model = mj_loadXML("scene.xml", files, error, sizeof error);
    }
    if (model == NULL) fprintf(stderr, "mujoco: %s: %s\n", scene->name, error);
    mj_deleteVFS(files);
    free(files);
    free(t.bytes);
    return model;
}

bench_world *bench_mujoco_create(const bench_scene *scene, const bench_world *like)
{
    bench_world *w = bench_allocate(1, sizeof *w);
    w->substeps = (int32_t)ceil((double)scene->dt / LONGEST);
    w->bodies = scene->body_count;
    w->model = like != NULL ? like->model : load(scene, (double)scene->dt / w->substeps);
    w->data = w->model != NULL ? mj_makeData(w->model) : NULL;
    if (w->data == NULL) {
        free(w);
        return NULL;
    }
    for (int32_t i = 0, motor = 0; i < scene->joint_count; i++)
        if (scene->joints[i].motor_speed != 0.0) w->data->ctrl[motor++] = scene->joints[i].motor_speed;
    return w;
}

void bench_mujoco_destroy(bench_world *w, int owns_model)
{
    mj_deleteData(w->data);
    if (owns_model) mj_deleteModel(w->model);
    free(w);
}

void bench_mujoco_step(bench_world *w)
{
    for (int32_t i = 0; i < w->substeps; i++) mj_step(w->model, w->data);
}

void bench_mujoco_reset(bench_world *w)
{
    double ctrl[64];
    const int count = w->model->nu < 64 ? w->model->nu : 64;
    mju_copy(ctrl, w->data->ctrl, count);
    mj_resetData(w->model, w->data);
    mju_copy(w->data->ctrl, ctrl, count);
}

void bench_mujoco_place(const bench_world *w, int32_t body, double *out)
{
    char name[16];
    snprintf(name, sizeof name, "b%d", (int)body);
    const int id = mj_name2id(w->model, mjOBJ_BODY, name);
    for (int k = 0; k < 3; k++) out[k] = w->data->xpos[3 * id + k];
}

#endif
