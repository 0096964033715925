// Bullet as a measuring stick (peer.h): its default sequential impulse world, 10 iterations, dbvt broad phase, one thread, no sleeping.
#include "peer.h"

#ifdef FE_BENCH_BULLET

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <btBulletDynamicsCommon.h>
#pragma GCC diagnostic pop

#include <memory>
#include <vector>

// Members are destroyed from the last to the first: bodies and joints after the world let go of them in its own destructor.
struct bench_world {
    std::vector<std::unique_ptr<btCollisionShape>> shapes; // in the scene's order
    std::vector<std::unique_ptr<btDefaultMotionState>> motions;
    std::vector<std::unique_ptr<btRigidBody>> bodies; // in the scene's order
    std::vector<std::unique_ptr<btTypedConstraint>> joints;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
};

namespace
{

btVector3 vector(const double *v) { return btVector3(float(v[0]), float(v[1]), float(v[2])); }

btVector3 vector(const float *v) { return btVector3(v[0], v[1], v[2]); }

std::unique_ptr<btCollisionShape> make_shape(const bench_shape &shape)
{
    switch (shape.form) {
    case BENCH_SPHERE:
        return std::make_unique<btSphereShape>(shape.radius);
    case BENCH_CAPSULE:
        return std::make_unique<btCapsuleShape>(shape.radius, 2.0f * shape.half_height);
    case BENCH_BOX:
        break;
    }
    return std::make_unique<btBoxShape>(vector(shape.half));
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
    btRigidBody::btRigidBodyConstructionInfo info(mass, w->motions.back().get(), form, inertia);
    info.m_friction = shape.friction;
    info.m_restitution = shape.restitution;
    auto rigid = std::make_unique<btRigidBody>(info);
    rigid->setLinearVelocity(vector(body.linear_velocity));
    rigid->setAngularVelocity(vector(body.angular_velocity));
    rigid->setActivationState(DISABLE_DEACTIVATION);
    if (body.collides) {
        w->world.addRigidBody(rigid.get());
    } else {
        w->world.addRigidBody(rigid.get(), btBroadphaseProxy::DefaultFilter, 0);
    }
    w->bodies.push_back(std::move(rigid));
}

void add_joint(bench_world *w, const bench_joint &joint)
{
    btRigidBody &a = *w->bodies[size_t(joint.body_a)], &b = *w->bodies[size_t(joint.body_b)];
    btVector3 anchor = vector(joint.anchor);
    btVector3 in_a = a.getWorldTransform().inverse() * anchor, in_b = b.getWorldTransform().inverse() * anchor;
    w->joints.push_back(std::make_unique<btPoint2PointConstraint>(a, b, in_a, in_b));
    w->world.addConstraint(w->joints.back().get(), true);
}

// The scenes' rule; Bullet's own is the product.
btScalar mix_friction(const btCollisionObject *a, const btCollisionObject *b) { return btSqrt(a->getFriction() * b->getFriction()); }

bench_world *create(const bench_scene *scene, int32_t, int32_t)
{
    auto w = std::make_unique<bench_world>();
    gCalculateCombinedFrictionCallback = mix_friction;
    w->world.setGravity(vector(scene->gravity));
    w->world.getSolverInfo().m_numIterations = 10;
    for (int32_t i = 0; i < scene->shape_count; i++) w->shapes.push_back(make_shape(scene->shapes[i]));
    for (int32_t i = 0; i < scene->body_count; i++) add_body(w.get(), *scene, scene->bodies[i]);
    for (int32_t i = 0; i < scene->joint_count; i++) add_joint(w.get(), scene->joints[i]);
    return w.release();
}

void destroy(bench_world *w)
{
    for (auto &joint : w->joints) w->world.removeConstraint(joint.get());
    for (auto &body : w->bodies) w->world.removeRigidBody(body.get());
    delete w;
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

void measure_contacts(bench_world *w, bench_contacts *out_contacts)
{
    *out_contacts = bench_contacts{0, 0, 0.0};
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
    w->world.rayTest(from, to, closest);
    if (!closest.hasHit()) return 0;
    *out_fraction = double(closest.m_closestHitFraction);
    return 1;
}

} // namespace

const bench_engine bench_bullet = {
    "bullet", 0, create, destroy, step, count_bodies, read_mass, read_poses, measure_contacts, raycast, nullptr, nullptr, nullptr, nullptr,
};

#endif
