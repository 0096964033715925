// Bullet as a measuring stick (peer.h): its default sequential impulse world, 10 iterations, dbvt broad phase, one
// thread, no sleeping.
#include "peer.h"

#ifdef FE_BENCH_BULLET

extern "C" {
#include "../stats.h"
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>
#include <LinearMath/btConvexHullComputer.h>
#include <btBulletDynamicsCommon.h>
#pragma GCC diagnostic pop

#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

// A mesh's triangles, which Bullet does not copy
struct mesh_data {
    bench_mesh mesh;
    btTriangleIndexVertexArray triangles;
    explicit mesh_data(bench_mesh own)
        : mesh(own), triangles(own.triangle_count, own.indices, 3 * sizeof(int32_t), own.vertex_count, own.vertices,
                               3 * sizeof(float))
    {
    }
    mesh_data(const mesh_data &) = delete;
    mesh_data &operator=(const mesh_data &) = delete;
    ~mesh_data() { bench_mesh_free(&mesh); }
};

// Members are destroyed from the last to the first: bodies and joints after the world let go of them in its own
// destructor.
struct bench_world {
    std::vector<std::vector<float>> heights;               // of terrains, which do not copy them
    std::vector<std::unique_ptr<mesh_data>> meshes;        // likewise
    std::vector<std::unique_ptr<btCollisionShape>> parts;  // of compounds
    std::vector<std::unique_ptr<btCollisionShape>> shapes; // in the scene's order
    std::vector<std::unique_ptr<btDefaultMotionState>> motions;
    std::vector<std::unique_ptr<btRigidBody>> bodies; // in the scene's order
    std::vector<std::unique_ptr<btTypedConstraint>> joints;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    const bench_scene *scene = nullptr;
};

namespace
{

btVector3 vector(const double *v) { return btVector3(float(v[0]), float(v[1]), float(v[2])); }

btVector3 vector(const float *v) { return btVector3(v[0], v[1], v[2]); }

// 1 where a body may move or turn, 0 where it is locked
btVector3 free_axes(int32_t locks)
{
    return btVector3(locks & 1 ? 0.0f : 1.0f, locks & 2 ? 0.0f : 1.0f, locks & 4 ? 0.0f : 1.0f);
}

// It lies about the middle of its height: the body is moved by as much.
std::unique_ptr<btCollisionShape> make_terrain(bench_world &w, const bench_shape &shape)
{
    const size_t side = size_t(shape.side);
    std::vector<float> heights(side * side);
    for (size_t i = 0; i < side * side; i++)
        heights[i] = bench_terrain_height(&shape, int32_t(i / side), int32_t(i % side));
    w.heights.push_back(std::move(heights));
    const float most = 8.0f; // m, above all heights
    auto terrain = std::make_unique<btHeightfieldTerrainShape>(shape.side, shape.side, w.heights.back().data(), 1.0f,
                                                               -most, most, 1, PHY_FLOAT, false);
    terrain->setLocalScaling(btVector3(shape.cell, 1.0f, shape.cell));
    terrain->buildAccelerator();
    return terrain;
}

std::unique_ptr<btConvexShape> make_convex(const bench_shape &shape)
{
    switch (shape.form) {
    case BENCH_SPHERE:
        return std::make_unique<btSphereShape>(shape.radius);
    case BENCH_CAPSULE:
        return std::make_unique<btCapsuleShape>(shape.radius, 2.0f * shape.half_height);
    case BENCH_CYLINDER:
        return std::make_unique<btCylinderShape>(btVector3(shape.radius, shape.half_height, shape.radius));
    case BENCH_HULL: {
        auto hull = std::make_unique<btConvexHullShape>();
        for (int32_t i = 0; i < shape.solid->point_count; i++) hull->addPoint(vector(shape.solid->points[i]), false);
        hull->recalcLocalAabb();
        return hull;
    }
    case BENCH_BOX:
    case BENCH_TERRAIN:
    case BENCH_MESH:
    case BENCH_COMPOUND:
        break;
    }
    return std::make_unique<btBoxShape>(vector(shape.half));
}

std::unique_ptr<btCollisionShape> make_mesh(bench_world &w, const bench_shape &shape)
{
    w.meshes.push_back(std::make_unique<mesh_data>(bench_hills(shape.side)));
    return std::make_unique<btBvhTriangleMeshShape>(&w.meshes.back()->triangles, true);
}

std::unique_ptr<btCollisionShape> make_compound(bench_world &w, const bench_shape &shape)
{
    auto compound = std::make_unique<btCompoundShape>();
    for (int32_t i = 0; i < shape.part_count; i++) {
        w.parts.push_back(std::make_unique<btBoxShape>(vector(shape.parts[i].half)));
        compound->addChildShape(btTransform(btQuaternion::getIdentity(), vector(shape.parts[i].at)),
                                w.parts.back().get());
    }
    return compound;
}

std::unique_ptr<btCollisionShape> make_shape(bench_world &w, const bench_shape &shape)
{
    if (shape.form == BENCH_TERRAIN) return make_terrain(w, shape);
    if (shape.form == BENCH_MESH) return make_mesh(w, shape);
    if (shape.form == BENCH_COMPOUND) return make_compound(w, shape);
    return make_convex(shape);
}

void add_body(bench_world *w, const bench_scene &scene, const bench_body &body)
{
    const bench_shape &shape = scene.shapes[body.shape];
    btCollisionShape *form = w->shapes[size_t(body.shape)].get();
    const double *q = body.start.rotation;
    const btQuaternion rotation{float(q[0]), float(q[1]), float(q[2]), float(q[3])};
    btTransform start(rotation, vector(body.start.position));
    w->motions.push_back(std::make_unique<btDefaultMotionState>(start));

    btScalar mass = body.dynamic ? btScalar(double(shape.density) * bench_shape_volume(&shape)) : 0.0f;
    btVector3 inertia(0, 0, 0);
    if (body.dynamic) form->calculateLocalInertia(mass, inertia);
    if (body.dynamic && (shape.form == BENCH_HULL || shape.form == BENCH_COMPOUND)) { // Bullet's own is that of a box
        double moments[6];                                                            // it knows no products
        bench_shape_inertia(&shape, moments);
        inertia = shape.density * vector(moments);
    }
    btRigidBody::btRigidBodyConstructionInfo info(mass, w->motions.back().get(), form, inertia);
    info.m_friction = shape.friction;
    info.m_restitution = shape.restitution;
    auto rigid = std::make_unique<btRigidBody>(info);
    rigid->setLinearVelocity(vector(body.linear_velocity));
    rigid->setAngularVelocity(vector(body.angular_velocity));
    rigid->setActivationState(DISABLE_DEACTIVATION);
    rigid->setDamping(1.0f - std::exp(-body.linear_damping),
                      1.0f - std::exp(-body.angular_damping)); // the share lost in a second
    rigid->setRollingFriction(shape.rolling);
    rigid->setLinearFactor(free_axes(body.linear_locks));
    rigid->setAngularFactor(free_axes(body.angular_locks));
    rigid->setUserIndex(body.group);
    if (body.collides) {
        w->world.addRigidBody(rigid.get());
    } else {
        w->world.addRigidBody(rigid.get(), btBroadphaseProxy::DefaultFilter, 0);
    }
    if (body.dynamic)
        rigid->setGravity(body.gravity_scale * vector(scene.gravity)); // after joining the world, which sets its own
    w->bodies.push_back(std::move(rigid));
}

// The joint's frame at the start, in the space of `body`: `turn` takes the engine's axis of the joint (x or z) to the
// scene's.
btTransform frame_in(const btRigidBody &body, const bench_joint &joint, const btQuaternion &turn)
{
    return body.getWorldTransform().inverse() * btTransform(turn, vector(joint.anchor));
}

std::unique_ptr<btTypedConstraint> make_hinge(btRigidBody &a, btRigidBody &b, const bench_joint &joint)
{
    const btQuaternion turn = shortestArcQuat(btVector3(0, 0, 1), vector(joint.axis));
    // the engine's angle grows with its first body turning about the axis, the scene's with B
    auto hinge = std::make_unique<btHingeConstraint>(b, a, frame_in(b, joint, turn), frame_in(a, joint, turn));
    if (joint.has_limits) hinge->setLimit(btScalar(joint.limits[0]), btScalar(joint.limits[1]));
    if (joint.motor_max > 0.0)
        hinge->enableAngularMotor(true, btScalar(joint.motor_speed), btScalar(joint.motor_max / 60.0)); // N m s a step
    return hinge;
}

std::unique_ptr<btTypedConstraint> make_slider(btRigidBody &a, btRigidBody &b, const bench_joint &joint)
{
    const btQuaternion turn = shortestArcQuat(btVector3(1, 0, 0), vector(joint.axis));
    auto slider = std::make_unique<btSliderConstraint>(a, b, frame_in(a, joint, turn), frame_in(b, joint, turn), true);
    slider->setLowerLinLimit(joint.has_limits ? btScalar(joint.limits[0]) : 1.0f); // low above high: none
    slider->setUpperLinLimit(joint.has_limits ? btScalar(joint.limits[1]) : -1.0f);
    slider->setLowerAngLimit(0.0f);
    slider->setUpperAngLimit(0.0f);
    if (joint.motor_max > 0.0) {
        slider->setPoweredLinMotor(true);
        slider->setTargetLinMotorVelocity(btScalar(joint.motor_speed));
        slider->setMaxLinMotorForce(btScalar(joint.motor_max));
    }
    return slider;
}

std::unique_ptr<btTypedConstraint> make_ball(btRigidBody &a, btRigidBody &b, const bench_joint &joint)
{
    const btQuaternion turn = shortestArcQuat(btVector3(1, 0, 0), vector(joint.axis));
    if (joint.cone == 0.0 && !joint.has_limits) {
        const btTransform none(btQuaternion::getIdentity(), btVector3(0, 0, 0));
        return std::make_unique<btPoint2PointConstraint>(a, b, frame_in(a, joint, none.getRotation()).getOrigin(),
                                                         frame_in(b, joint, none.getRotation()).getOrigin());
    }
    auto cone = std::make_unique<btConeTwistConstraint>(a, b, frame_in(a, joint, turn), frame_in(b, joint, turn));
    const btScalar twist = btScalar(0.5 * (joint.limits[1] - joint.limits[0])); // it knows symmetric ranges only
    cone->setLimit(btScalar(joint.cone), btScalar(joint.cone), twist);
    return cone;
}

// nullptr: the engine has nothing of the kind
std::unique_ptr<btTypedConstraint> make_joint(btRigidBody &a, btRigidBody &b, const bench_joint &joint)
{
    if (joint.hertz > 0.0 || joint.is_open) return nullptr;
    switch (joint.kind) {
    case BENCH_BALL:
        return make_ball(a, b, joint);
    case BENCH_HINGE:
        return make_hinge(a, b, joint);
    case BENCH_SLIDER:
        return make_slider(a, b, joint);
    case BENCH_FIXED: {
        const btQuaternion turn = btQuaternion::getIdentity();
        return std::make_unique<btFixedConstraint>(a, b, frame_in(a, joint, turn), frame_in(b, joint, turn));
    }
    case BENCH_DISTANCE:
        break;
    }
    return nullptr;
}

bool add_joint(bench_world *w, const bench_joint &joint)
{
    auto made = make_joint(*w->bodies[size_t(joint.body_a)], *w->bodies[size_t(joint.body_b)], joint);
    if (!made) return false;
    w->world.addConstraint(made.get(), true);
    w->joints.push_back(std::move(made));
    return true;
}

struct group_filter final : btOverlapFilterCallback {
    bool needBroadphaseCollision(btBroadphaseProxy *a, btBroadphaseProxy *b) const override
    {
        const auto *body_a = static_cast<const btCollisionObject *>(a->m_clientObject),
                   *body_b = static_cast<const btCollisionObject *>(b->m_clientObject);
        if (body_a->getUserIndex() > 0 && body_a->getUserIndex() == body_b->getUserIndex()) return false;
        return (a->m_collisionFilterGroup & b->m_collisionFilterMask) != 0 &&
               (b->m_collisionFilterGroup & a->m_collisionFilterMask) != 0;
    }
};

void destroy(bench_world *w)
{
    for (auto &joint : w->joints) w->world.removeConstraint(joint.get());
    for (auto &body : w->bodies) w->world.removeRigidBody(body.get());
    delete w;
}

// The scenes' rule; Bullet's own is the product.
btScalar mix_friction(const btCollisionObject *a, const btCollisionObject *b)
{
    return btSqrt(a->getFriction() * b->getFriction());
}

bench_world *create(const bench_scene *scene, int32_t, int32_t)
{
    auto w = std::make_unique<bench_world>();
    gCalculateCombinedFrictionCallback = mix_friction;
    w->world.setGravity(vector(scene->gravity));
    w->world.getSolverInfo().m_numIterations = 10;
    if (scene->always_bounce) w->world.getSolverInfo().m_restitutionVelocityThreshold = 0.0f;
    w->scene = scene;
    static group_filter groups;
    w->world.getPairCache()->setOverlapFilterCallback(&groups);
    for (int32_t i = 0; i < scene->shape_count; i++) w->shapes.push_back(make_shape(*w, scene->shapes[i]));
    for (int32_t i = 0; i < scene->body_count; i++) add_body(w.get(), *scene, scene->bodies[i]);
    for (int32_t i = 0; i < scene->joint_count; i++) {
        if (add_joint(w.get(), scene->joints[i])) continue;
        std::fprintf(stderr, "bullet: %s has joints that it lacks\n", scene->name);
        destroy(w.release());
        return nullptr;
    }
    return w.release();
}

int32_t step(bench_world *w, float dt)
{
    w->world.stepSimulation(dt, 0); // 0: one step of exactly dt
    return 0;
}

int32_t count_bodies(bench_world *w) { return w->world.getNumCollisionObjects(); }

double read_mass(bench_world *w)
{
    double sum = 0.0;
    for (const auto &body : w->bodies) {
        if (body->getInvMass() > 0.0f) sum += 1.0 / double(body->getInvMass());
    }
    return sum;
}

void read_poses(bench_world *w, bench_pose *out_poses)
{
    for (size_t i = 0; i < w->bodies.size(); i++) {
        const btTransform &t = w->bodies[i]->getWorldTransform();
        const btVector3 p = t.getOrigin();
        const btQuaternion q = t.getRotation();
        out_poses[i] = bench_pose{{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}};
    }
}

void read_motions(bench_world *w, bench_motion *out_motions)
{
    for (size_t i = 0; i < w->bodies.size(); i++) {
        const btVector3 &v = w->bodies[i]->getLinearVelocity(), &u = w->bodies[i]->getAngularVelocity();
        out_motions[i] = bench_motion{{v.x(), v.y(), v.z()}, {u.x(), u.y(), u.z()}};
    }
}

void add_force(bench_world *w, int32_t body, const double *force)
{
    w->bodies[size_t(body)]->applyCentralForce(vector(force));
}

void add_impulse(bench_world *w, int32_t body, const double *impulse, const double *point)
{
    btRigidBody &rigid = *w->bodies[size_t(body)];
    rigid.applyImpulse(vector(impulse), vector(point) - rigid.getCenterOfMassPosition());
}

void set_gravity(bench_world *w, const double *gravity) { w->world.setGravity(vector(gravity)); }

// It stays in the list of bodies, a ghost that nothing touches.
void take_away(bench_world *w, int32_t body)
{
    btRigidBody *rigid = w->bodies[size_t(body)].get();
    w->world.removeRigidBody(rigid);
    w->world.addRigidBody(rigid, 0, 0);
}

void bring_back(bench_world *w, int32_t body, const bench_pose *pose)
{
    btRigidBody *rigid = w->bodies[size_t(body)].get();
    const double *q = pose->rotation;
    const btQuaternion rotation{float(q[0]), float(q[1]), float(q[2]), float(q[3])};
    const btTransform at(rotation, vector(pose->position));
    w->world.removeRigidBody(rigid);
    rigid->setCenterOfMassTransform(at);
    rigid->getMotionState()->setWorldTransform(at);
    rigid->setLinearVelocity(btVector3(0, 0, 0));
    rigid->setAngularVelocity(btVector3(0, 0, 0));
    rigid->clearForces();
    w->world.addRigidBody(rigid);
}

void measure_contacts(bench_world *w, bench_contacts *out_contacts)
{
    *out_contacts = bench_contacts{0, 0, 0.0, 0.0};
    w->world.performDiscreteCollisionDetection(); // manifolds are those of the step's beginning otherwise
    for (int i = 0; i < w->dispatcher.getNumManifolds(); i++) {
        const btPersistentManifold *manifold = w->dispatcher.getManifoldByIndexInternal(i);
        if (manifold->getNumContacts() == 0) continue;
        out_contacts->pairs++;
        out_contacts->points += manifold->getNumContacts();
        for (int p = 0; p < manifold->getNumContacts(); p++) {
            double overlap = -double(manifold->getContactPoint(p).getDistance());
            if (overlap > out_contacts->deepest) out_contacts->deepest = overlap;
        }
    }
}

int32_t raycast(bench_world *w, const bench_ray *ray, double *out_fraction)
{
    btVector3 from = vector(ray->origin), to = from + vector(ray->translation);
    btCollisionWorld::ClosestRayResultCallback closest(from, to);
    closest.m_flags |= btTriangleRaycastCallback::kF_FilterBackfaces; // triangles are of one side, as Feather's
    w->world.rayTest(from, to, closest);
    if (!closest.hasHit()) return 0;
    *out_fraction = double(closest.m_closestHitFraction);
    return 1;
}

btTransform start_of(const bench_probe *probe)
{
    const double *q = probe->rotation;
    return btTransform(btQuaternion(float(q[0]), float(q[1]), float(q[2]), float(q[3])), vector(probe->way.origin));
}

int32_t sweep(bench_world *w, const bench_probe *probe, double *out_fraction)
{
    const std::unique_ptr<btConvexShape> form = make_convex(probe->shape);
    btTransform from = start_of(probe), to = from;
    to.setOrigin(from.getOrigin() + vector(probe->way.translation));
    btCollisionWorld::ClosestConvexResultCallback closest(from.getOrigin(), to.getOrigin());
    w->world.convexSweepTest(form.get(), from, to, closest);
    if (!closest.hasHit()) return 0;
    *out_fraction = double(closest.m_closestHitFraction);
    return 1;
}

// A body of one shape reports its points in a row.
struct body_counter final : btCollisionWorld::ContactResultCallback {
    const btCollisionObject *asks = nullptr, *last = nullptr;
    int32_t count = 0;
    btScalar addSingleResult(btManifoldPoint &point, const btCollisionObjectWrapper *a, int, int,
                             const btCollisionObjectWrapper *b, int, int) override
    {
        const btCollisionObject *other =
            a->getCollisionObject() == asks ? b->getCollisionObject() : a->getCollisionObject();
        if (point.getDistance() <= 0.0f && other != last) count++, last = other;
        return 0.0f;
    }
};

int32_t overlap(bench_world *w, const bench_probe *probe)
{
    const std::unique_ptr<btConvexShape> form = make_convex(probe->shape);
    btCollisionObject object;
    object.setCollisionShape(form.get());
    object.setWorldTransform(start_of(probe));
    body_counter counter;
    counter.asks = &object;
    w->world.contactTest(&object, counter);
    return counter.count;
}

double build_mesh(const bench_mesh *mesh, int64_t *out_bytes)
{
    const double start = bench_cpu_ms();
    btTriangleIndexVertexArray triangles(mesh->triangle_count, mesh->indices, 3 * sizeof(int32_t), mesh->vertex_count,
                                         mesh->vertices, 3 * sizeof(float));
    btBvhTriangleMeshShape shape(&triangles, true);
    const double ms = bench_cpu_ms() - start;
    *out_bytes = int64_t(shape.getOptimizedBvh()->calculateSerializeBufferSize()) +
                 int64_t(mesh->triangle_count) * int64_t(3 * sizeof(int32_t)) +
                 int64_t(mesh->vertex_count) * int64_t(3 * sizeof(float));
    return ms;
}

// All vertices: it has no limit to them
double build_hull(const float *points, int32_t count, int64_t *out_bytes)
{
    btConvexHullComputer hull;
    const double start = bench_cpu_ms();
    hull.compute(points, 3 * sizeof(float), count, 0.0f, 0.0f);
    const double ms = bench_cpu_ms() - start;
    *out_bytes = int64_t(hull.vertices.size()) * int64_t(sizeof(btVector3)) +
                 int64_t(hull.edges.size()) * int64_t(sizeof(btConvexHullComputer::Edge)) +
                 int64_t(hull.faces.size()) * int64_t(sizeof(int));
    return ms;
}

} // namespace

const bench_engine bench_bullet = {
    "bullet",
    "sequential impulses, 10 iterations",
    0,
    0,
    0.0,
    create,
    destroy,
    step,
    count_bodies,
    read_mass,
    read_poses,
    read_motions,
    add_force,
    add_impulse,
    set_gravity,
    take_away,
    bring_back,
    measure_contacts,
    raycast,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    sweep,
    overlap,
    nullptr,
    build_mesh,
    build_hull,
};

#endif
