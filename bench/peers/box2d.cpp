// Box2D 2.4 as a measuring stick (peer.h): planar scenes only, 8 velocity and 3 position iterations, no sleeping.
//
// Its polygons have a skin: at rest two of them stay 15 mm apart at their cores, so heights of stacks are not those of
// other engines.
#include "peer.h"

#ifdef FE_BENCH_BOX2D

#include <box2d/box2d.h>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

struct bench_world {
    const bench_scene *scene = nullptr;
    std::unique_ptr<b2World> world;
    std::vector<b2Body *> bodies; // in the scene's order
};

namespace
{

constexpr int32 VELOCITY_ITERATIONS = 8, POSITION_ITERATIONS = 3;

b2Vec2 vector(const double *v) { return b2Vec2(float(v[0]), float(v[1])); }

double angle_of(const double *q) { return 2.0 * std::atan2(q[2], q[3]); }

void add_fixture(b2Body *body, const b2Shape &form, const bench_shape &shape, const bench_body &from)
{
    b2FixtureDef def;
    def.shape = &form;
    def.density = 1.0f; // the mass is set below
    def.friction = shape.friction;
    def.restitution = shape.restitution;
    if (!from.collides) def.filter.maskBits = 0;
    def.filter.groupIndex = int16(-from.group);
    body->CreateFixture(&def);
}

// A capsule, whose axis is the body's y, is a box and two circles.
void add_capsule(b2Body *body, const bench_shape &shape, const bench_body &from)
{
    b2PolygonShape middle;
    middle.SetAsBox(shape.radius - b2_polygonRadius, shape.half_height);
    add_fixture(body, middle, shape, from);
    for (float end : {-shape.half_height, shape.half_height}) {
        b2CircleShape cap;
        cap.m_p.Set(0.0f, end);
        cap.m_radius = shape.radius;
        add_fixture(body, cap, shape, from);
    }
}

void add_form(b2Body *body, const bench_shape &shape, const bench_body &from)
{
    if (shape.form == BENCH_SPHERE) {
        b2CircleShape circle;
        circle.m_radius = shape.radius;
        add_fixture(body, circle, shape, from);
    } else if (shape.form == BENCH_CAPSULE) {
        add_capsule(body, shape, from);
    } else {
        b2PolygonShape box;
        box.SetAsBox(shape.half[0], shape.half[1]);
        add_fixture(body, box, shape, from);
    }
}

// The mass of the scene's body, spread as the outline's is.
void set_mass(b2Body *body, const bench_shape &shape)
{
    const float mass = float(double(shape.density) * bench_shape_volume(&shape)), r = shape.radius,
                h = shape.half_height;
    b2MassData data{mass, b2Vec2_zero, 0.5f * mass * r * r};
    if (shape.form == BENCH_BOX) data.I = mass * (shape.half[0] * shape.half[0] + shape.half[1] * shape.half[1]) / 3.0f;
    if (shape.form ==
        BENCH_CAPSULE) { // a rectangle and two half discs, whose centres of mass are 4 r / (3 pi) beyond its ends
        const float rectangle = 4.0f * r * h, discs = b2_pi * r * r, per_area = mass / (rectangle + discs),
                    beyond = 4.0f * r / (3.0f * b2_pi);
        data.I = per_area * (rectangle * (r * r + h * h) / 3.0f + discs * (0.5f * r * r + h * h + 2.0f * h * beyond));
    }
    body->SetMassData(&data);
}

void add_body(bench_world *w, const bench_body &from)
{
    const bench_shape &shape = w->scene->shapes[from.shape];
    b2BodyDef def;
    def.type = from.dynamic ? b2_dynamicBody : b2_staticBody;
    def.position = vector(from.start.position);
    def.angle = float(angle_of(from.start.rotation));
    def.linearVelocity.Set(from.linear_velocity[0], from.linear_velocity[1]);
    def.angularVelocity = from.angular_velocity[2];
    def.linearDamping = from.linear_damping;
    def.angularDamping = from.angular_damping;
    def.gravityScale = from.gravity_scale;
    def.allowSleep = false;
    b2Body *body = w->world->CreateBody(&def);
    add_form(body, shape, from);
    if (from.dynamic) set_mass(body, shape);
    w->bodies.push_back(body);
}

void add_revolute(bench_world *w, const bench_joint &joint, b2Body *a, b2Body *b)
{
    b2RevoluteJointDef def;
    def.Initialize(a, b, vector(joint.anchor));
    if (joint.is_open) def.localAnchorB = b->GetLocalPoint(vector(joint.anchor_b));
    const bool flipped = joint.kind == BENCH_HINGE && joint.axis[2] < 0.0; // about -z
    if (joint.kind == BENCH_HINGE && joint.has_limits) {
        def.enableLimit = true;
        def.lowerAngle = float(flipped ? -joint.limits[1] : joint.limits[0]);
        def.upperAngle = float(flipped ? -joint.limits[0] : joint.limits[1]);
    }
    def.enableMotor = joint.motor_max > 0.0;
    def.motorSpeed = float(flipped ? -joint.motor_speed : joint.motor_speed);
    def.maxMotorTorque = float(joint.motor_max);
    w->world->CreateJoint(&def);
}

void add_prismatic(bench_world *w, const bench_joint &joint, b2Body *a, b2Body *b)
{
    b2PrismaticJointDef def;
    def.Initialize(a, b, vector(joint.anchor), vector(joint.axis));
    def.enableLimit = joint.has_limits != 0;
    def.lowerTranslation = float(joint.limits[0]);
    def.upperTranslation = float(joint.limits[1]);
    def.enableMotor = joint.motor_max > 0.0;
    def.motorSpeed = float(joint.motor_speed);
    def.maxMotorForce = float(joint.motor_max);
    w->world->CreateJoint(&def);
}

void add_distance(bench_world *w, const bench_joint &joint, b2Body *a, b2Body *b)
{
    b2DistanceJointDef def;
    def.Initialize(a, b, vector(joint.anchor), vector(joint.is_open ? joint.anchor_b : joint.anchor));
    if (joint.hertz > 0.0)
        b2LinearStiffness(def.stiffness, def.damping, float(joint.hertz), float(joint.damping), a, b);
    w->world->CreateJoint(&def);
}

bool add_joint(bench_world *w, const bench_joint &joint)
{
    b2Body *a = w->bodies[size_t(joint.body_a)], *b = w->bodies[size_t(joint.body_b)];
    if (joint.hertz > 0.0 && joint.kind != BENCH_DISTANCE) return false;
    switch (joint.kind) {
    case BENCH_BALL:
    case BENCH_HINGE:
        return add_revolute(w, joint, a, b), true;
    case BENCH_SLIDER:
        return add_prismatic(w, joint, a, b), true;
    case BENCH_DISTANCE:
        return add_distance(w, joint, a, b), true;
    case BENCH_FIXED:
        break;
    }
    b2WeldJointDef def;
    def.Initialize(a, b, vector(joint.anchor));
    w->world->CreateJoint(&def);
    return true;
}

void destroy(bench_world *w) { delete w; }

bench_world *create(const bench_scene *scene, int32_t, int32_t)
{
    if (!scene->planar) {
        std::fprintf(stderr, "box2d: %s is not planar\n", scene->name);
        return nullptr;
    }
    auto w = std::make_unique<bench_world>();
    w->scene = scene;
    w->world = std::make_unique<b2World>(vector(scene->gravity));
    for (int32_t i = 0; i < scene->body_count; i++) add_body(w.get(), scene->bodies[i]);
    for (int32_t i = 0; i < scene->joint_count; i++) {
        if (add_joint(w.get(), scene->joints[i])) continue;
        std::fprintf(stderr, "box2d: %s has joints that it lacks\n", scene->name);
        return nullptr;
    }
    return w.release();
}

int32_t step(bench_world *w, float dt)
{
    w->world->Step(dt, VELOCITY_ITERATIONS, POSITION_ITERATIONS);
    return 0;
}

void set_gravity(bench_world *w, const double *gravity) { w->world->SetGravity(vector(gravity)); }

int32_t count_bodies(bench_world *w) { return w->world->GetBodyCount(); }

double read_mass(bench_world *w)
{
    double sum = 0.0;
    for (const b2Body *body : w->bodies) sum += double(body->GetMass());
    return sum;
}

void read_poses(bench_world *w, bench_pose *out_poses)
{
    for (size_t i = 0; i < w->bodies.size(); i++) {
        const b2Vec2 p = w->bodies[i]->GetPosition();
        const double half = 0.5 * double(w->bodies[i]->GetAngle());
        out_poses[i] = bench_pose{{double(p.x), double(p.y), 0.0}, {0.0, 0.0, std::sin(half), std::cos(half)}};
    }
}

void read_motions(bench_world *w, bench_motion *out_motions)
{
    for (size_t i = 0; i < w->bodies.size(); i++) {
        const b2Vec2 v = w->bodies[i]->GetLinearVelocity();
        out_motions[i] =
            bench_motion{{double(v.x), double(v.y), 0.0}, {0.0, 0.0, double(w->bodies[i]->GetAngularVelocity())}};
    }
}

void add_force(bench_world *w, int32_t body, const double *force)
{
    w->bodies[size_t(body)]->ApplyForceToCenter(vector(force), true);
}

void add_impulse(bench_world *w, int32_t body, const double *impulse, const double *point)
{
    w->bodies[size_t(body)]->ApplyLinearImpulse(vector(impulse), vector(point), true);
}

void take_away(bench_world *w, int32_t body) { w->bodies[size_t(body)]->SetEnabled(false); }

void bring_back(bench_world *w, int32_t body, const bench_pose *pose)
{
    b2Body *back = w->bodies[size_t(body)];
    back->SetTransform(vector(pose->position), float(angle_of(pose->rotation)));
    back->SetLinearVelocity(b2Vec2(0.0f, 0.0f));
    back->SetAngularVelocity(0.0f);
    back->SetEnabled(true);
}

void measure_contacts(bench_world *w, bench_contacts *out_contacts)
{
    *out_contacts = bench_contacts{0, 0, 0.0, 0.0};
    for (const b2Contact *contact = w->world->GetContactList(); contact != nullptr; contact = contact->GetNext()) {
        const int32 points = contact->GetManifold()->pointCount;
        if (points == 0) continue;
        b2WorldManifold manifold;
        contact->GetWorldManifold(&manifold);
        out_contacts->pairs++;
        out_contacts->points += points;
        for (int32 p = 0; p < points; p++)
            out_contacts->deepest = std::fmax(out_contacts->deepest, -double(manifold.separations[p]));
    }
}

struct nearest_ray final : b2RayCastCallback {
    float nearest = 2.0f;
    float ReportFixture(b2Fixture *, const b2Vec2 &, const b2Vec2 &, float fraction) override
    {
        return nearest = fraction;
    }
};

int32_t raycast(bench_world *w, const bench_ray *ray, double *out_fraction)
{
    nearest_ray callback;
    const b2Vec2 from = vector(ray->origin), to = from + vector(ray->translation);
    w->world->RayCast(&callback, from, to);
    *out_fraction = double(callback.nearest);
    return callback.nearest <= 1.0f;
}

} // namespace

const bench_engine bench_box2d = {
    "box2d",
    "8 velocity, 3 position iterations",
    1,
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
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
};

#endif
