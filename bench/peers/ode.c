// ODE as a measuring stick (peer.h): dWorldQuickStep with 20 iterations, hash space, up to 8 contacts a pair, one
// thread, no sleeping.
#include "peer.h"

#ifdef FE_BENCH_ODE

#include "../memory.h"

#include <math.h>
#include <ode/ode.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    ITERATIONS = 20,
    CONTACTS_A_PAIR = 8,
    DIRECTION_Y = 2, // ODE's number of the y axis for a capsule's mass
};

struct bench_world {
    dWorldID world;
    dSpaceID space;
    dJointGroupID contact_joints; // of the present step
    dGeomID *geoms;               // in the scene's order
    const bench_scene *scene;
    struct form_data *data; // of the scene's shapes
    int32_t count;
};

static void set_mass(dBodyID body, const bench_shape *shape)
{
    const double density = (double)shape->density, radius = (double)shape->radius;
    dMass mass;
    switch (shape->form) {
    case BENCH_SPHERE:
        dMassSetSphere(&mass, density, radius);
        break;
    case BENCH_CAPSULE:
        dMassSetCapsule(&mass, density, DIRECTION_Y, radius, 2.0 * (double)shape->half_height);
        break;
    case BENCH_CYLINDER:
        dMassSetCylinder(&mass, density, DIRECTION_Y, radius, 2.0 * (double)shape->half_height);
        break;
    case BENCH_HULL:
    case BENCH_COMPOUND: {
        double i[6];
        bench_shape_inertia(shape, i);
        for (int k = 0; k < 6; k++) i[k] *= density;
        dMassSetParameters(&mass, density * bench_shape_volume(shape), 0.0, 0.0, 0.0, i[0], i[1], i[2], i[3], i[5],
                           i[4]);
        break;
    }
    case BENCH_BOX:
    default:
        dMassSetBox(&mass, density, 2.0 * (double)shape->half[0], 2.0 * (double)shape->half[1],
                    2.0 * (double)shape->half[2]);
        break;
    }
    dBodySetMass(body, &mass);
}

// About its middle, like the scene's. The engine keeps a copy of the heights; its record of them lives as long as the
// program.
static dGeomID make_terrain(dSpaceID space, const bench_shape *shape)
{
    const size_t side = (size_t)shape->side;
    const double extent = (double)shape->cell * (shape->side - 1);
    float *heights = bench_allocate(side * side, sizeof *heights);
    for (size_t i = 0; i < side * side; i++)
        heights[i] = bench_terrain_height(shape, (int32_t)(i / side), (int32_t)(i % side));
    dHeightfieldDataID data = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildSingle(data, heights, 1, extent, extent, shape->side, shape->side, 1.0, 0.0, 1.0, 0);
    free(heights);
    return dCreateHeightfield(space, data, 1);
}

// What the engine refers to and does not copy
typedef struct form_data {
    double *planes, *points; // of a hull
    unsigned int *polygons;
    dTriMeshDataID triangles; // of a mesh
    bench_mesh mesh;
} form_data;

static void make_hull_data(form_data *data, const bench_solid *solid)
{
    int32_t length = 0;
    for (int32_t f = 0; f < solid->face_count; f++) length += 1 + solid->loops[length];
    data->planes = bench_allocate((size_t)solid->face_count, 4 * sizeof *data->planes);
    data->points = bench_allocate((size_t)solid->point_count, 3 * sizeof *data->points);
    data->polygons = bench_allocate((size_t)length, sizeof *data->polygons);
    for (int32_t f = 0; f < solid->face_count; f++) {
        for (int k = 0; k < 3; k++) data->planes[4 * f + k] = solid->normals[f][k];
        data->planes[4 * f + 3] = solid->offsets[f];
    }
    for (int32_t p = 0; p < 3 * solid->point_count; p++) data->points[p] = solid->points[p / 3][p % 3];
    for (int32_t i = 0; i < length; i++) data->polygons[i] = (unsigned int)solid->loops[i];
}

static void make_mesh_data(form_data *data, int32_t cells)
{
    data->mesh = bench_hills(cells);
    data->triangles = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildSingle(data->triangles, data->mesh.vertices, 3 * sizeof(float), data->mesh.vertex_count,
                                data->mesh.indices, 3 * data->mesh.triangle_count, 3 * sizeof(int32_t));
    dGeomTriMeshDataPreprocess2(data->triangles, 1u << dTRIDATAPREPROCESS_BUILD_FACE_ANGLES, NULL); // hulls ask for it
}

static void free_data(form_data *data)
{
    free(data->planes);
    free(data->points);
    free(data->polygons);
    if (data->triangles != NULL) dGeomTriMeshDataDestroy(data->triangles);
    bench_mesh_free(&data->mesh);
}

static dGeomID make_geom(dSpaceID space, const bench_shape *shape, const form_data *data)
{
    switch (shape->form) {
    case BENCH_HULL:
        return dCreateConvex(space, data->planes, (unsigned int)shape->solid->face_count, data->points,
                             (unsigned int)shape->solid->point_count, data->polygons);
    case BENCH_MESH:
        return dCreateTriMesh(space, data->triangles, NULL, NULL, NULL);
    case BENCH_CYLINDER:
        return dCreateCylinder(space, (double)shape->radius, 2.0 * (double)shape->half_height);
    case BENCH_SPHERE:
        return dCreateSphere(space, (double)shape->radius);
    case BENCH_TERRAIN:
        return make_terrain(space, shape);
    case BENCH_CAPSULE:
        return dCreateCapsule(space, (double)shape->radius, 2.0 * (double)shape->half_height);
    case BENCH_COMPOUND:
        return dCreateBox(space, 2.0 * (double)shape->parts[0].half[0], 2.0 * (double)shape->parts[0].half[1],
                          2.0 * (double)shape->parts[0].half[2]);
    case BENCH_BOX:
    default:
        return dCreateBox(space, 2.0 * (double)shape->half[0], 2.0 * (double)shape->half[1],
                          2.0 * (double)shape->half[2]);
    }
}

// The first box of a compound is the body's geom; the others join it, each at its place.
static void add_parts(bench_world *w, const bench_body *body, dBodyID rigid, const bench_shape *shape, dGeomID first)
{
    for (int32_t i = 0; i < shape->part_count; i++) {
        const bench_part *part = &shape->parts[i];
        dGeomID geom = first;
        if (i > 0) {
            geom = dCreateBox(w->space, 2.0 * (double)part->half[0], 2.0 * (double)part->half[1],
                              2.0 * (double)part->half[2]);
            dGeomSetData(geom, (void *)(uintptr_t)body);
            dGeomSetBody(geom, rigid);
        }
        dGeomSetOffsetPosition(geom, part->at[0], part->at[1], part->at[2]);
    }
}

// A body kept in the plane z = 0; ODE has no locks of single axes. The engine's own way: dPlane2D keeps a body in x and
// y, turning about z.
static void lock_body(bench_world *w, const bench_body *body, dBodyID rigid)
{
    if (body->linear_locks == 4 && body->angular_locks == 3)
        dJointAttach(dJointCreatePlane2D(w->world, NULL), rigid, NULL);
}

// A static body is a geom alone: it has no body, and the pose is the geom's.
static void add_body(bench_world *w, const bench_scene *scene, const bench_body *body)
{
    const bench_shape *shape = &scene->shapes[body->shape];
    const double *p = body->start.position, *q = body->start.rotation;
    const dQuaternion rotation = {q[3], q[0], q[1], q[2]};
    dGeomID geom = make_geom(w->space, shape, &w->data[body->shape]);
    dGeomSetData(geom, (void *)(uintptr_t)body);
    if (body->dynamic) {
        dBodyID rigid = dBodyCreate(w->world);
        set_mass(rigid, shape);
        dGeomSetBody(geom, rigid);
        add_parts(w, body, rigid, shape, geom);
        if (shape->form == BENCH_CAPSULE || shape->form == BENCH_CYLINDER) { // ODE's lie along z
            dMatrix3 turn;
            dRFromAxisAndAngle(turn, 1.0, 0.0, 0.0, -M_PI / 2.0);
            dGeomSetOffsetRotation(geom, turn);
        }
        const float *v = body->linear_velocity, *u = body->angular_velocity;
        dBodySetLinearVel(rigid, (double)v[0], (double)v[1], (double)v[2]);
        dBodySetAngularVel(rigid, (double)u[0], (double)u[1], (double)u[2]);
        dBodySetPosition(rigid, p[0], p[1], p[2]);
        dBodySetQuaternion(rigid, rotation);
        dBodySetLinearDamping(rigid,
                              (double)body->linear_damping * (double)scene->dt); // ODE's is the share lost in a step
        dBodySetAngularDamping(rigid, (double)body->angular_damping * (double)scene->dt);
        dBodySetGravityMode(rigid, body->gravity_scale == 1.0f); // of other scales: see add_scaled_gravity
        lock_body(w, body, rigid);
    } else {
        dGeomSetPosition(geom, p[0], p[1], p[2]);
        dGeomSetQuaternion(geom, rotation);
    }
    if (!body->collides) {
        dGeomSetCategoryBits(geom, 0);
        dGeomSetCollideBits(geom, 0);
    }
    w->geoms[w->count++] = geom;
}

// A hinge's angle grows with body 1 turning about the axis against body 2; the scene's, with B against A.
static dJointID make_hinge(bench_world *w, const bench_joint *joint, dBodyID a, dBodyID b)
{
    dJointID hinge = dJointCreateHinge(w->world, NULL);
    dJointAttach(hinge, b, a);
    dJointSetHingeAnchor(hinge, joint->anchor[0], joint->anchor[1], joint->anchor[2]);
    dJointSetHingeAxis(hinge, joint->axis[0], joint->axis[1], joint->axis[2]);
    if (joint->has_limits) {
        dJointSetHingeParam(hinge, dParamLoStop, joint->limits[0]);
        dJointSetHingeParam(hinge, dParamHiStop, joint->limits[1]);
    }
    dJointSetHingeParam(hinge, dParamVel, joint->motor_speed);
    dJointSetHingeParam(hinge, dParamFMax, joint->motor_max);
    return hinge;
}

static dJointID make_slider(bench_world *w, const bench_joint *joint, dBodyID a, dBodyID b)
{
    dJointID slider = dJointCreateSlider(w->world, NULL);
    dJointAttach(slider, b, a);
    dJointSetSliderAxis(slider, joint->axis[0], joint->axis[1], joint->axis[2]);
    if (joint->has_limits) {
        dJointSetSliderParam(slider, dParamLoStop, joint->limits[0]);
        dJointSetSliderParam(slider, dParamHiStop, joint->limits[1]);
    }
    dJointSetSliderParam(slider, dParamVel, joint->motor_speed);
    dJointSetSliderParam(slider, dParamFMax, joint->motor_max);
    return slider;
}

// ODE's ball joint has no cone and no friction.
static int add_joint(bench_world *w, const bench_joint *joint)
{
    dBodyID a = dGeomGetBody(w->geoms[joint->body_a]), b = dGeomGetBody(w->geoms[joint->body_b]);
    if (joint->hertz > 0.0 || joint->is_open) return -1;
    switch (joint->kind) {
    case BENCH_BALL: {
        dJointID ball = dJointCreateBall(w->world, NULL);
        dJointAttach(ball, a, b);
        dJointSetBallAnchor(ball, joint->anchor[0], joint->anchor[1], joint->anchor[2]);
        return 0;
    }
    case BENCH_HINGE:
        return make_hinge(w, joint, a, b) != NULL ? 0 : -1;
    case BENCH_SLIDER:
        return make_slider(w, joint, a, b) != NULL ? 0 : -1;
    case BENCH_FIXED: {
        dJointID fixed = dJointCreateFixed(w->world, NULL);
        dJointAttach(fixed, a, b);
        dJointSetFixed(fixed);
        return 0;
    }
    case BENCH_DISTANCE:
        break;
    }
    return -1;
}

static void destroy(bench_world *w)
{
    dJointGroupDestroy(w->contact_joints);
    dSpaceDestroy(w->space);
    dWorldDestroy(w->world);
    for (int32_t i = 0; i < w->scene->shape_count; i++) free_data(&w->data[i]);
    free(w->data);
    free(w->geoms);
    free(w);
}

static int can_build(const bench_scene *scene)
{
    const char *stacked = "hullpyramid-";
    if (strncmp(scene->name, stacked, strlen(stacked)) == 0) {
        fprintf(stderr, "ode: %s: an assertion on hulls that lie on each other ends the program\n", scene->name);
        return 0;
    }
    for (int32_t i = 0; i < scene->body_count; i++) {
        const bench_body *body = &scene->bodies[i];
        if (body->dynamic || scene->shapes[body->shape].form != BENCH_CAPSULE) continue;
        fprintf(stderr, "ode: %s has a static capsule, which a geom along z without a body cannot be\n", scene->name);
        return 0;
    }
    return 1;
}

static bench_world *create(const bench_scene *scene, int32_t workers, int32_t substeps)
{
    (void)workers, (void)substeps;
    static int initialised;
    if (!initialised) initialised = dInitODE2(0);
    if (!can_build(scene)) return NULL;
    bench_world *w = bench_allocate(1, sizeof *w);
    w->geoms = bench_allocate((size_t)scene->body_count, sizeof *w->geoms);
    w->scene = scene;
    w->data = bench_allocate((size_t)scene->shape_count, sizeof *w->data);
    for (int32_t i = 0; i < scene->shape_count; i++) {
        if (scene->shapes[i].form == BENCH_HULL) make_hull_data(&w->data[i], scene->shapes[i].solid);
        if (scene->shapes[i].form == BENCH_MESH) make_mesh_data(&w->data[i], scene->shapes[i].side);
    }
    w->world = dWorldCreate();
    w->space = dHashSpaceCreate(NULL);
    w->contact_joints = dJointGroupCreate(0);
    dWorldSetGravity(w->world, scene->gravity[0], scene->gravity[1], scene->gravity[2]);
    dWorldSetQuickStepNumIterations(w->world, ITERATIONS);
    dWorldSetAutoDisableFlag(w->world, 0);
    dRandSetSeed(0); // QuickStep shuffles its rows: the same way in each run
    for (int32_t i = 0; i < scene->body_count; i++) add_body(w, scene, &scene->bodies[i]);
    for (int32_t i = 0; i < scene->joint_count; i++) {
        if (add_joint(w, &scene->joints[i]) == 0) continue;
        fprintf(stderr, "ode: %s has joints that it lacks\n", scene->name);
        destroy(w);
        return NULL;
    }
    return w;
}

static void set_gravity(bench_world *w, const double *gravity)
{
    dWorldSetGravity(w->world, gravity[0], gravity[1], gravity[2]);
}

static int can_touch(dGeomID a, dGeomID b)
{
    const bench_body *bench_a = dGeomGetData(a), *bench_b = dGeomGetData(b);
    if (bench_a->group != 0 && bench_a->group == bench_b->group) return 0;
    dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
    if (body_a == NULL && body_b == NULL) return 0;
    return body_a == NULL || body_b == NULL || !dAreConnectedExcluding(body_a, body_b, dJointTypeContact);
}

static void make_contacts(void *user, dGeomID a, dGeomID b)
{
    bench_world *w = user;
    if (!can_touch(a, b)) return;
    dContact contacts[CONTACTS_A_PAIR];
    int count = dCollide(a, b, CONTACTS_A_PAIR, &contacts[0].geom, sizeof contacts[0]);
    const bench_body *bench_a = dGeomGetData(a), *bench_b = dGeomGetData(b);
    const bench_shape *shape_a = &w->scene->shapes[bench_a->shape], *shape_b = &w->scene->shapes[bench_b->shape];
    for (int i = 0; i < count; i++) {
        dSurfaceParameters *surface = &contacts[i].surface;
        surface->mode = dContactApprox1; // friction in proportion to the normal force, not a fixed force
        surface->mu = sqrt((double)shape_a->friction * (double)shape_b->friction);
        surface->bounce =
            (double)(shape_a->restitution > shape_b->restitution ? shape_a->restitution : shape_b->restitution);
        surface->bounce_vel = w->scene->always_bounce ? 0.0 : 1.0; // m/s, Feather's default threshold
        if (surface->bounce > 0.0) surface->mode |= dContactBounce;
        dJointAttach(dJointCreateContact(w->world, w->contact_joints, &contacts[i]), dGeomGetBody(a), dGeomGetBody(b));
    }
}

static void add_scaled_gravity(bench_world *w)
{
    for (int32_t i = 0; i < w->count; i++) {
        const double scale = (double)w->scene->bodies[i].gravity_scale, *g = w->scene->gravity;
        dBodyID body = dGeomGetBody(w->geoms[i]);
        if (body == NULL || scale == 1.0 || scale == 0.0) continue;
        dMass mass;
        dBodyGetMass(body, &mass);
        dBodyAddForce(body, scale * mass.mass * g[0], scale * mass.mass * g[1], scale * mass.mass * g[2]);
    }
}

static int32_t step(bench_world *w, float dt)
{
    add_scaled_gravity(w);
    dSpaceCollide(w->space, w, make_contacts);
    int ok = dWorldQuickStep(w->world, (double)dt);
    dJointGroupEmpty(w->contact_joints);
    if (!ok) fprintf(stderr, "ode: the step found no memory\n");
    return ok ? 0 : -1;
}

static int32_t count_bodies(bench_world *w) { return w->count; }

static double read_mass(bench_world *w)
{
    double sum = 0.0;
    for (int32_t i = 0; i < w->count; i++) {
        dBodyID body = dGeomGetBody(w->geoms[i]);
        dMass mass;
        if (body == NULL) continue;
        dBodyGetMass(body, &mass);
        sum += mass.mass;
    }
    return sum;
}

static void read_poses(bench_world *w, bench_pose *out_poses)
{
    for (int32_t i = 0; i < w->count; i++) {
        dBodyID body = dGeomGetBody(w->geoms[i]);
        const dReal *p = body != NULL ? dBodyGetPosition(body) : dGeomGetPosition(w->geoms[i]);
        dQuaternion q;
        if (body != NULL) {
            dBodyCopyQuaternion(body, q);
        } else {
            dGeomGetQuaternion(w->geoms[i], q);
        }
        out_poses[i] = (bench_pose){{p[0], p[1], p[2]}, {q[1], q[2], q[3], q[0]}};
    }
}

static void read_motions(bench_world *w, bench_motion *out_motions)
{
    for (int32_t i = 0; i < w->count; i++) {
        dBodyID body = dGeomGetBody(w->geoms[i]);
        out_motions[i] = (bench_motion){{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
        if (body == NULL) continue;
        const dReal *v = dBodyGetLinearVel(body), *u = dBodyGetAngularVel(body);
        for (int k = 0; k < 3; k++) out_motions[i].linear[k] = v[k], out_motions[i].angular[k] = u[k];
    }
}

static void add_force(bench_world *w, int32_t body, const double *force)
{
    dBodyAddForce(dGeomGetBody(w->geoms[body]), force[0], force[1], force[2]);
}

static void add_impulse(bench_world *w, int32_t body, const double *impulse, const double *point)
{
    const double rate = 1.0 / (double)w->scene->dt; // a force during one step
    dBodyAddForceAtPos(dGeomGetBody(w->geoms[body]), rate * impulse[0], rate * impulse[1], rate * impulse[2], point[0],
                       point[1], point[2]);
}

static void take_away(bench_world *w, int32_t body)
{
    dGeomDisable(w->geoms[body]);
    dBodyDisable(dGeomGetBody(w->geoms[body]));
}

static void bring_back(bench_world *w, int32_t body, const bench_pose *pose)
{
    const double *p = pose->position, *q = pose->rotation;
    const dQuaternion rotation = {q[3], q[0], q[1], q[2]};
    const dBodyID rigid = dGeomGetBody(w->geoms[body]);
    dGeomEnable(w->geoms[body]);
    dBodyEnable(rigid);
    dBodySetPosition(rigid, p[0], p[1], p[2]);
    dBodySetQuaternion(rigid, rotation);
    dBodySetLinearVel(rigid, 0.0, 0.0, 0.0);
    dBodySetAngularVel(rigid, 0.0, 0.0, 0.0);
}

static void measure_pair(void *user, dGeomID a, dGeomID b)
{
    bench_contacts *sum = user;
    if (!can_touch(a, b)) return;
    dContactGeom points[CONTACTS_A_PAIR];
    int count = dCollide(a, b, CONTACTS_A_PAIR, points, sizeof points[0]);
    sum->pairs += count > 0;
    sum->points += count;
    for (int i = 0; i < count; i++) {
        if (points[i].depth > sum->deepest) sum->deepest = points[i].depth;
    }
}

static void measure_contacts(bench_world *w, bench_contacts *out_contacts)
{
    *out_contacts = (bench_contacts){0, 0, 0.0, 0.0};
    dSpaceCollide(w->space, out_contacts, measure_pair);
}

static void keep_nearest(void *user, dGeomID a, dGeomID b)
{
    double *nearest = user;
    dContactGeom point;
    if (dCollide(a, b, 1, &point, sizeof point) > 0 && point.depth < *nearest) *nearest = point.depth;
}

static int32_t raycast(bench_world *w, const bench_ray *ray, double *out_fraction)
{
    const double *p = ray->origin, *d = ray->translation;
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    double nearest = HUGE_VAL; // a ray's depth is the distance of its hit
    dGeomID geom = dCreateRay(NULL, length);
    dGeomRaySet(geom, p[0], p[1], p[2], d[0], d[1], d[2]);
    dSpaceCollide2(geom, (dGeomID)w->space, &nearest, keep_nearest);
    dGeomDestroy(geom);
    if (nearest > length) return 0;
    *out_fraction = length > 0.0 ? nearest / length : 0.0;
    return 1;
}

const bench_engine bench_ode = {
    .name = "ode",
    .settings = "QuickStep, 20 iterations",
    .body_steps = 3.1e6, // some minutes
    .create = create,
    .destroy = destroy,
    .step = step,
    .count_bodies = count_bodies,
    .read_mass = read_mass,
    .read_poses = read_poses,
    .read_motions = read_motions,
    .add_force = add_force,
    .add_impulse = add_impulse,
    .set_gravity = set_gravity,
    .take_away = take_away,
    .bring_back = bring_back,
    .measure_contacts = measure_contacts,
    .raycast = raycast,
};

#endif
