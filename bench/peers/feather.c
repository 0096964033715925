// Feather as one of the measured engines (peer.h), through its public interface only and with its default tuning.
#include "peer.h"

#include "../memory.h"
#include "../stats.h"
#include "feather.h"

#include <stdio.h>
#include <stdlib.h>

struct bench_world {
    fe_world *world;
    fe_body *bodies; // in the scene's order
    int32_t count;
    fe_asset *assets;         // of the scene's shapes, in their order: hulls and meshes
    fe_transform *transforms; // scratch of read_poses
    float (*velocities)[6];   // scratch of read_motions
};

static void complain(const char *what) { fprintf(stderr, "feather: %s: %s\n", what, fe_last_error()); }

// ---- shapes --------------------------------------------------------------------------------------------------------

static fe_geometry geometry_of(const bench_shape *shape, fe_asset asset)
{
    fe_geometry geometry;
    switch (shape->form) {
    case BENCH_HULL:
        fe_geometry_hull(&geometry, asset);
        break;
    case BENCH_MESH:
        fe_geometry_mesh(&geometry, asset);
        break;
    case BENCH_CYLINDER:
        fe_geometry_cylinder(&geometry, shape->half_height, shape->radius);
        break;
    case BENCH_SPHERE:
        fe_geometry_sphere(&geometry, shape->radius);
        break;
    case BENCH_CAPSULE:
        fe_geometry_capsule(&geometry, shape->half_height, shape->radius);
        break;
    case BENCH_BOX:
    default:
        fe_geometry_box(&geometry, shape->half[0], shape->half[1], shape->half[2]);
        break;
    }
    return geometry;
}

static fe_result make_hull(fe_store *store, const float *points, int32_t count, fe_asset *out)
{
    fe_hull_def def;
    fe_hull_def_init(&def, sizeof def);
    def.points = points, def.point_count = count;
    return fe_hull_create(store, &def, out);
}

static fe_result make_mesh(fe_store *store, const bench_mesh *mesh, fe_asset *out)
{
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = mesh->vertices, def.vertex_count = mesh->vertex_count;
    def.indices = mesh->indices, def.triangle_count = mesh->triangle_count;
    return fe_mesh_create(store, &def, out);
}

static fe_result make_asset(fe_store *store, const bench_shape *shape, fe_asset *out)
{
    fe_result result = FE_OK;
    if (shape->form == BENCH_MESH) {
        bench_mesh mesh = bench_hills(shape->side);
        result = make_mesh(store, &mesh, out);
        bench_mesh_free(&mesh);
    } else if (shape->form == BENCH_HULL) {
        const bench_solid *solid = shape->solid;
        float *points = bench_allocate((size_t)solid->point_count, 3 * sizeof *points);
        for (int32_t i = 0; i < 3 * solid->point_count; i++) points[i] = (float)solid->points[i / 3][i % 3];
        result = make_hull(store, points, solid->point_count, out);
        free(points);
    }
    return result;
}

static fe_result make_assets(bench_world *w, const bench_scene *scene)
{
    fe_store *store;
    fe_result result = fe_world_get_store(w->world, &store);
    for (int32_t i = 0; i < scene->shape_count && result == FE_OK; i++)
        result = make_asset(store, &scene->shapes[i], &w->assets[i]);
    return result;
}

// Its middle is the body's position.
static fe_result add_terrain(fe_world *world, fe_body body, const bench_shape *shape)
{
    const size_t side = (size_t)shape->side;
    float *heights = bench_allocate(side * side, sizeof *heights);
    for (size_t i = 0; i < side * side; i++)
        heights[i] = bench_terrain_height(shape, (int32_t)(i / side), (int32_t)(i % side));
    fe_heightfield_def field;
    fe_heightfield_def_init(&field, sizeof field);
    field.rows = field.columns = shape->side, field.cell_x = field.cell_z = shape->cell, field.heights = heights;
    fe_store *store;
    fe_asset asset;
    fe_result result = fe_world_get_store(world, &store);
    if (result == FE_OK) result = fe_heightfield_create(store, &field, &asset);
    free(heights);
    if (result != FE_OK) return result;
    fe_shape_def def;
    fe_shape_def_init(&def, sizeof def);
    def.material.static_friction = def.material.dynamic_friction = shape->friction;
    def.material.rolling_resistance = shape->rolling;
    def.frame.position.x = def.frame.position.z = -0.5f * shape->cell * (float)(shape->side - 1);
    fe_geometry geometry;
    fe_geometry_heightfield(&geometry, asset);
    fe_shape created;
    return fe_shape_create(world, body, &def, &geometry, &created);
}

static fe_result add_parts(fe_world *world, fe_body body, fe_shape_def *def, const bench_shape *shape)
{
    fe_result result = FE_OK;
    for (int32_t i = 0; i < shape->part_count && result == FE_OK; i++) {
        const bench_part *part = &shape->parts[i];
        fe_geometry box;
        fe_shape created;
        fe_geometry_box(&box, part->half[0], part->half[1], part->half[2]);
        def->frame.position = fe_make_vec3((float)part->at[0], (float)part->at[1], (float)part->at[2]);
        result = fe_shape_create(world, body, def, &box, &created);
    }
    return result;
}

static fe_result add_body(bench_world *w, const bench_scene *scene, const bench_body *body, fe_body *out_body)
{
    fe_world *world = w->world;
    const bench_shape *shape = &scene->shapes[body->shape];
    const double *p = body->start.position, *q = body->start.rotation;
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.type = body->dynamic ? FE_BODY_DYNAMIC : FE_BODY_STATIC;
    def.transform.position = fe_make_dvec3(p[0], p[1], p[2]);
    def.transform.rotation = (fe_quat){(float)q[0], (float)q[1], (float)q[2], (float)q[3]};
    def.linear_velocity = fe_make_vec3(body->linear_velocity[0], body->linear_velocity[1], body->linear_velocity[2]);
    def.angular_velocity =
        fe_make_vec3(body->angular_velocity[0], body->angular_velocity[1], body->angular_velocity[2]);
    def.linear_damping = body->linear_damping, def.angular_damping = body->angular_damping;
    def.gravity_scale = body->gravity_scale;
    def.linear_locks = (uint32_t)body->linear_locks, def.angular_locks = (uint32_t)body->angular_locks;
    def.sleep_allowed = 0;
    fe_result result = fe_body_create(world, &def, out_body);
    if (result != FE_OK) return result;
    if (shape->form == BENCH_TERRAIN) return add_terrain(world, *out_body, shape);

    fe_shape_def form;
    fe_shape_def_init(&form, sizeof form);
    form.density = shape->density;
    form.material.static_friction = form.material.dynamic_friction = shape->friction;
    form.material.restitution = shape->restitution;
    form.material.rolling_resistance = shape->rolling;
    if (!body->collides) form.mask = 0;
    form.group = -body->group; // negative: shapes of one group never collide
    if (shape->form == BENCH_COMPOUND) return add_parts(world, *out_body, &form, shape);
    fe_geometry geometry = geometry_of(shape, w->assets[body->shape]);
    fe_shape created;
    return fe_shape_create(world, *out_body, &form, &geometry, &created);
}

fe_world *bench_feather_world(bench_world *w) { return w->world; }

static void destroy(bench_world *w)
{
    if (w->world != NULL) (void)fe_world_destroy(w->world);
    free(w->bodies);
    free(w->assets);
    free(w->transforms);
    free(w->velocities);
    free(w);
}

// ---- joints --------------------------------------------------------------------------------------------------------
// Stiffness of joints that other engines set one by one: here it is the world's, as one joint's own would make it a
// spring that swings.
static fe_result set_tuning(fe_world *world, const bench_scene *scene)
{
    fe_world_tuning tuning = {.struct_size = sizeof tuning};
    fe_result result = fe_world_get_tuning(world, &tuning);
    for (int32_t i = 0; i < scene->joint_count; i++) {
        if (scene->joints[i].stiffness_hertz > (double)tuning.joint_hertz)
            tuning.joint_hertz = (float)scene->joints[i].stiffness_hertz;
    }
    if (scene->always_bounce) tuning.restitution_threshold = 0.0f;
    return result == FE_OK ? fe_world_set_tuning(world, &tuning) : result;
}

static fe_result add_ball(bench_world *w, const bench_joint *joint, const fe_dvec3 *anchor, const fe_vec3 *axis)
{
    fe_ball_joint_def def, open;
    fe_ball_joint_def_init(&def, sizeof def);
    fe_body a = w->bodies[joint->body_a], b = w->bodies[joint->body_b];
    fe_result result = fe_ball_joint_def_at(w->world, &def, a, b, anchor, axis);
    if (result == FE_OK && joint->is_open) {
        const fe_dvec3 other = {joint->anchor_b[0], joint->anchor_b[1], joint->anchor_b[2]};
        fe_ball_joint_def_init(&open, sizeof open);
        result = fe_ball_joint_def_at(w->world, &open, a, b, &other, axis);
        def.frame_b = open.frame_b;
    }
    def.cone_enabled = joint->cone > 0.0;
    if (joint->cone > 0.0) def.cone_y = def.cone_z = (float)joint->cone;
    def.limit_enabled = joint->has_limits;
    if (joint->has_limits) def.lower = (float)joint->limits[0], def.upper = (float)joint->limits[1];
    def.spring_hertz = (float)joint->hertz, def.spring_damping_ratio = (float)joint->damping;
    def.motor_max = (float)joint->motor_max;
    fe_joint created;
    return result == FE_OK ? fe_ball_joint_create(w->world, &def, &created) : result;
}

static fe_result add_hinge(bench_world *w, const bench_joint *joint, const fe_dvec3 *anchor, const fe_vec3 *axis)
{
    fe_hinge_joint_def def, open;
    fe_hinge_joint_def_init(&def, sizeof def);
    fe_body a = w->bodies[joint->body_a], b = w->bodies[joint->body_b];
    fe_result result = fe_hinge_joint_def_at(w->world, &def, a, b, anchor, axis);
    if (result == FE_OK && joint->is_open) {
        const fe_dvec3 other = {joint->anchor_b[0], joint->anchor_b[1], joint->anchor_b[2]};
        fe_hinge_joint_def_init(&open, sizeof open);
        result = fe_hinge_joint_def_at(w->world, &open, a, b, &other, axis);
        def.frame_b = open.frame_b;
    }
    def.limit_enabled = joint->has_limits;
    if (joint->has_limits) def.lower = (float)joint->limits[0], def.upper = (float)joint->limits[1];
    def.spring_hertz = (float)joint->hertz, def.spring_damping_ratio = (float)joint->damping;
    def.motor_speed = (float)joint->motor_speed, def.motor_max = (float)joint->motor_max;
    fe_joint created;
    return result == FE_OK ? fe_hinge_joint_create(w->world, &def, &created) : result;
}

static fe_result add_slider(bench_world *w, const bench_joint *joint, const fe_dvec3 *anchor, const fe_vec3 *axis)
{
    fe_configurable_joint_def def;
    fe_configurable_joint_def_init(&def, sizeof def);
    fe_result result =
        fe_slider_joint_def_at(w->world, &def, w->bodies[joint->body_a], w->bodies[joint->body_b], anchor, axis);
    fe_joint_axis *along = &def.axes[FE_DOF_LINEAR_X];
    if (joint->has_limits)
        along->motion = FE_MOTION_LIMITED, along->lower = (float)joint->limits[0],
        along->upper = (float)joint->limits[1];
    if (joint->hertz > 0.0)
        along->spring = FE_SPRING_HERTZ, along->spring_hertz = (float)joint->hertz,
        along->spring_damping_ratio = (float)joint->damping;
    along->motor_speed = (float)joint->motor_speed, along->motor_max = (float)joint->motor_max;
    fe_joint created;
    return result == FE_OK ? fe_configurable_joint_create(w->world, &def, &created) : result;
}

static fe_result add_fixed(bench_world *w, const bench_joint *joint, const fe_dvec3 *anchor)
{
    fe_fixed_joint_def def;
    fe_fixed_joint_def_init(&def, sizeof def);
    fe_result result =
        fe_fixed_joint_def_at(w->world, &def, w->bodies[joint->body_a], w->bodies[joint->body_b], anchor);
    fe_joint created;
    return result == FE_OK ? fe_fixed_joint_create(w->world, &def, &created) : result;
}

static fe_result add_distance(bench_world *w, const bench_joint *joint, const fe_dvec3 *anchor)
{
    fe_distance_joint_def def;
    fe_distance_joint_def_init(&def, sizeof def);
    const fe_dvec3 other = {joint->anchor_b[0], joint->anchor_b[1], joint->anchor_b[2]};
    fe_result result =
        fe_distance_joint_def_at(w->world, &def, w->bodies[joint->body_a], w->bodies[joint->body_b], anchor, &other);
    if (joint->hertz > 0.0) {
        def.lower = 0.0f, def.upper = 1e6f; // only the spring
        def.spring_hertz = (float)joint->hertz, def.spring_damping_ratio = (float)joint->damping;
    }
    if (joint->has_limits) def.lower = (float)joint->limits[0], def.upper = (float)joint->limits[1];
    fe_joint created;
    return result == FE_OK ? fe_distance_joint_create(w->world, &def, &created) : result;
}

static fe_result add_joint(bench_world *w, const bench_joint *joint)
{
    const fe_dvec3 anchor = {joint->anchor[0], joint->anchor[1], joint->anchor[2]};
    fe_vec3 axis = {(float)joint->axis[0], (float)joint->axis[1], (float)joint->axis[2]};
    if (axis.x == 0.0f && axis.y == 0.0f && axis.z == 0.0f) axis.x = 1.0f;
    switch (joint->kind) {
    case BENCH_BALL:
        return add_ball(w, joint, &anchor, &axis);
    case BENCH_HINGE:
        return add_hinge(w, joint, &anchor, &axis);
    case BENCH_SLIDER:
        return add_slider(w, joint, &anchor, &axis);
    case BENCH_FIXED:
        return add_fixed(w, joint, &anchor);
    case BENCH_DISTANCE:
    default:
        return add_distance(w, joint, &anchor);
    }
}

static bench_world *create(const bench_scene *scene, int32_t workers, int32_t substeps)
{
    bench_world *w = bench_allocate(1, sizeof *w);
    w->count = scene->body_count;
    w->bodies = bench_allocate((size_t)w->count, sizeof *w->bodies);
    w->assets = bench_allocate((size_t)scene->shape_count, sizeof *w->assets);
    w->transforms = bench_allocate((size_t)w->count, sizeof *w->transforms);
    w->velocities = bench_allocate((size_t)w->count, sizeof *w->velocities);

    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.worker_count = workers;
    def.substeps = substeps;
    def.gravity = fe_make_vec3((float)scene->gravity[0], (float)scene->gravity[1], (float)scene->gravity[2]);
    fe_result result = fe_world_create(&def, &w->world);
    if (result == FE_OK) result = make_assets(w, scene);
    for (int32_t i = 0; i < w->count && result == FE_OK; i++)
        result = add_body(w, scene, &scene->bodies[i], &w->bodies[i]);
    if (result == FE_OK) result = set_tuning(w->world, scene);
    for (int32_t i = 0; i < scene->joint_count && result == FE_OK; i++) result = add_joint(w, &scene->joints[i]);
    if (result != FE_OK) {
        complain(scene->name);
        destroy(w);
        return NULL;
    }
    return w;
}

static int32_t step(bench_world *w, float dt)
{
    fe_result result = fe_world_step(w->world, dt);
    if (result != FE_OK) complain("step");
    return result;
}

static int32_t count_bodies(bench_world *w) { return fe_world_get_bodies(w->world, NULL, 0); }

static double read_mass(bench_world *w)
{
    double sum = 0.0;
    for (int32_t i = 0; i < w->count; i++) {
        float mass = 0.0f;
        if (fe_body_get_mass(w->world, w->bodies[i], &mass) != FE_OK) complain("mass");
        sum += (double)mass;
    }
    return sum;
}

static void read_poses(bench_world *w, bench_pose *out_poses)
{
    if (fe_world_get_transforms(w->world, w->bodies, w->transforms, 0, w->count) != FE_OK) complain("poses");
    for (int32_t i = 0; i < w->count; i++) {
        const fe_transform *t = &w->transforms[i];
        out_poses[i] = (bench_pose){
            {t->position.x, t->position.y, t->position.z},
            {(double)t->rotation.x, (double)t->rotation.y, (double)t->rotation.z, (double)t->rotation.w},
        };
    }
}

static void read_motions(bench_world *w, bench_motion *out_motions)
{
    if (fe_world_get_velocities(w->world, w->bodies, w->velocities[0], 0, w->count) != FE_OK) complain("velocities");
    for (int32_t i = 0; i < w->count; i++) {
        for (int k = 0; k < 3; k++) {
            out_motions[i].linear[k] = (double)w->velocities[i][k];
            out_motions[i].angular[k] = (double)w->velocities[i][3 + k];
        }
    }
}

static fe_vec3 narrow(const double *v) { return fe_make_vec3((float)v[0], (float)v[1], (float)v[2]); }

static void add_force(bench_world *w, int32_t body, const double *force)
{
    const fe_vec3 f = narrow(force);
    if (fe_body_add_force(w->world, w->bodies[body], &f) != FE_OK) complain("force");
}

static void add_impulse(bench_world *w, int32_t body, const double *impulse, const double *point)
{
    const fe_vec3 j = narrow(impulse);
    const fe_dvec3 p = fe_make_dvec3(point[0], point[1], point[2]);
    if (fe_body_add_impulse_at(w->world, w->bodies[body], &j, &p) != FE_OK) complain("impulse");
}

static void set_gravity(bench_world *w, const double *gravity)
{
    const fe_vec3 g = narrow(gravity);
    if (fe_world_set_gravity(w->world, &g) != FE_OK) complain("gravity");
}

// It stays in the list of bodies, disabled.
static void take_away(bench_world *w, int32_t body)
{
    if (fe_body_set_enabled(w->world, w->bodies[body], 0) != FE_OK) complain("take away");
}

static void bring_back(bench_world *w, int32_t body, const bench_pose *pose)
{
    const fe_body back = w->bodies[body];
    const double *p = pose->position, *q = pose->rotation;
    const fe_transform at = {fe_make_dvec3(p[0], p[1], p[2]), {(float)q[0], (float)q[1], (float)q[2], (float)q[3]}};
    const fe_vec3 rest = {0.0f, 0.0f, 0.0f};
    if (fe_body_set_transform(w->world, back, &at) != FE_OK ||
        fe_body_set_linear_velocity(w->world, back, &rest) != FE_OK ||
        fe_body_set_angular_velocity(w->world, back, &rest) != FE_OK || fe_body_set_enabled(w->world, back, 1) != FE_OK)
        complain("bring back");
}

static double mass_of(const bench_world *w, fe_body body)
{
    float mass;
    if (fe_body_get_mass(w->world, body, &mass) != FE_OK) complain("mass");
    return (double)mass;
}

// The four corners of a cube on a cube weigh together what the pair does: a pair is one spring on the mass of both, of
// 30 Hz, against what is static of 60.
static double held_by(const bench_world *w, const fe_contact *contact, double overlap)
{
    const double a = mass_of(w, contact->body_a), b = mass_of(w, contact->body_b),
                 rate = 2.0 * BENCH_PI * 30.0 * overlap;
    return a > 0.0 && b > 0.0 ? 0.5 * a * b / (a + b) * rate * rate : 2.0 * (a + b) * rate * rate;
}

static void add_contact(const bench_world *w, bench_contacts *sum, const fe_contact *contact)
{
    double deepest = 0.0;
    sum->pairs++;
    sum->points += contact->point_count;
    for (int32_t p = 0; p < contact->point_count; p++) {
        double overlap = -(double)contact->points[p].separation;
        if (overlap > deepest) deepest = overlap;
    }
    sum->held += held_by(w, contact, deepest);
    if (deepest > sum->deepest) sum->deepest = deepest;
}

static void measure_contacts(bench_world *w, bench_contacts *out_contacts)
{
    *out_contacts = (bench_contacts){0, 0, 0.0, 0.0};
    if (fe_world_step(w->world, 0.0f) != FE_OK)
        complain("contacts"); // brings separations up to the final poses, moves nothing
    fe_contact *contacts = NULL;
    int32_t capacity = 0;
    for (int32_t i = 0; i < w->count; i++) {
        int32_t count = fe_body_get_contacts(w->world, w->bodies[i], NULL, 0, 0);
        if (count > capacity) {
            capacity = 2 * count;
            contacts = bench_resize(contacts, (size_t)capacity, sizeof *contacts);
        }
        if (count > 0) count = fe_body_get_contacts(w->world, w->bodies[i], contacts, sizeof *contacts, capacity);
        if (count < 0) complain("contacts");
        for (int32_t k = 0; k < count; k++) {
            if (contacts[k].body_a == w->bodies[i]) add_contact(w, out_contacts, &contacts[k]); // each pair once
        }
    }
    free(contacts);
}

static int32_t raycast(bench_world *w, const bench_ray *ray, double *out_fraction)
{
    fe_dvec3 origin = fe_make_dvec3(ray->origin[0], ray->origin[1], ray->origin[2]);
    fe_dvec3 translation = fe_make_dvec3(ray->translation[0], ray->translation[1], ray->translation[2]);
    fe_hit hit;
    const int32_t hits = fe_world_raycast(w->world, &origin, &translation, NULL, &hit);
    if (hits < 0) complain("raycast");
    if (hits < 1) return 0;
    *out_fraction = hit.fraction;
    return 1;
}

static fe_transform start_of(const bench_probe *probe)
{
    const double *p = probe->way.origin, *q = probe->rotation;
    fe_transform t = fe_make_transform(p[0], p[1], p[2]);
    t.rotation = (fe_quat){(float)q[0], (float)q[1], (float)q[2], (float)q[3]};
    return t;
}

static int32_t sweep(bench_world *w, const bench_probe *probe, double *out_fraction)
{
    fe_geometry geometry = geometry_of(&probe->shape, 0);
    fe_transform start = start_of(probe);
    const double *d = probe->way.translation;
    fe_dvec3 translation = fe_make_dvec3(d[0], d[1], d[2]);
    fe_hit hit;
    const int32_t hits = fe_world_sweep(w->world, &geometry, &start, &translation, NULL, &hit);
    if (hits < 0) complain("sweep");
    if (hits < 1) return 0;
    *out_fraction = hit.fraction;
    return 1;
}

static int32_t overlap(bench_world *w, const bench_probe *probe)
{
    enum { MOST = 256 };
    fe_body bodies[MOST];
    fe_geometry geometry = geometry_of(&probe->shape, 0);
    fe_transform at = start_of(probe);
    int32_t count = fe_world_overlap(w->world, &geometry, &at, NULL, bodies, MOST);
    if (count < 0) complain("overlap");
    return count;
}

// ---- building ------------------------------------------------------------------------------------------------------

static double build_mesh(const bench_mesh *mesh, int64_t *out_bytes)
{
    fe_store *store = NULL;
    fe_asset asset;
    fe_mesh_info info;
    fe_mesh_info_init(&info, sizeof info);
    fe_result result = fe_store_create(NULL, &store);
    const double start = bench_cpu_ms();
    if (result == FE_OK) result = make_mesh(store, mesh, &asset);
    const double ms = bench_cpu_ms() - start;
    if (result == FE_OK) result = fe_mesh_get_info(store, asset, &info);
    if (result != FE_OK) complain("mesh");
    *out_bytes = info.bytes;
    (void)fe_store_destroy(store);
    return ms;
}

static double build_hull(const float *points, int32_t count, int64_t *out_bytes)
{
    fe_store *store = NULL;
    fe_asset asset;
    fe_hull_info info;
    fe_hull_info_init(&info, sizeof info);
    fe_result result = fe_store_create(NULL, &store);
    const double start = bench_cpu_ms();
    if (result == FE_OK) result = make_hull(store, points, count, &asset);
    const double ms = bench_cpu_ms() - start;
    if (result == FE_OK) result = fe_hull_get_info(store, asset, &info);
    if (result != FE_OK) complain("hull");
    *out_bytes = info.bytes;
    (void)fe_store_destroy(store);
    return ms;
}

static const char *const phase_names[] = {"step",       "pairs",    "collide", "islands", "solve",
                                          "continuous", "finalize", "events",  "sleep",   NULL};

static void read_phases(bench_world *w, double *out_ms)
{
    fe_profile p = {.struct_size = sizeof p};
    if (fe_world_get_profile(w->world, &p) != FE_OK) complain("profile");
    const float ms[] = {p.step, p.pairs, p.collide, p.islands, p.solve, p.continuous, p.finalize, p.events, p.sleep};
    _Static_assert(sizeof ms / sizeof ms[0] + 1 == sizeof phase_names / sizeof phase_names[0], "a name for each phase");
    for (size_t i = 0; i < sizeof ms / sizeof ms[0]; i++) out_ms[i] = (double)ms[i];
}

static void read_counters(bench_world *w, bench_counters *out_counters)
{
    fe_counters c = {.struct_size = sizeof c};
    if (fe_world_get_counters(w->world, &c) != FE_OK) complain("counters");
    double lanes = (double)c.rows * c.simd_width;
    *out_counters = (bench_counters){
        .islands = c.islands,
        .colours = c.colours,
        .rows = c.rows,
        .whole_share = c.rows > 0 ? (double)c.rows_whole / c.rows : 0.0,
        .fill = lanes > 0.0 ? c.lanes / lanes : 0.0,
        .contacts = c.contacts,
        .recycled = c.recycled,
        .bytes = c.bytes,
    };
}

// What a moving kinematic body drives stays awake, and static bodies never were
static void fall_asleep(bench_world *w)
{
    for (int32_t i = 0; i < w->count; i++) (void)fe_body_set_sleep_allowed(w->world, w->bodies[i], 1);
    for (int32_t i = 0; i < w->count; i++) (void)fe_body_set_awake(w->world, w->bodies[i], 0);
}

static uint64_t read_hash(bench_world *w)
{
    uint32_t words[2] = {0, 0};
    if (fe_world_hash(w->world, words) != FE_OK) complain("hash");
    return (uint64_t)words[1] << 32 | words[0];
}

const bench_engine bench_feather = {
    .name = "feather",
    .settings = "TGS Soft",
    .has_workers = 1,
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
    .phase_names = phase_names,
    .read_phases = read_phases,
    .read_counters = read_counters,
    .read_hash = read_hash,
    .fall_asleep = fall_asleep,
    .sweep = sweep,
    .overlap = overlap,
    .build_mesh = build_mesh,
    .build_hull = build_hull,
};
