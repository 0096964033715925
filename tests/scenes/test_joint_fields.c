// Every field of every joint's definition: worlds that differ in it alone come to outcomes that differ as mechanics
// foretells.
//
// The rig: an anchor at the origin holds a block there without gravity, which is pushed along or about one axis. A row
// of a table says which field takes two values, what else the definition needs, how long it is pushed, what is read,
// and what the reading should be. The rows of a type must cover every byte of its definition but the few of
// `elsewhere`: a new field without a row fails.
#include "scenes/joint_scene.h"
#include "support/any_joint.h"

#include <string.h>

static const char *const kind_names[ANY_KINDS] = {"distance", "ball", "hinge", "fixed", "configurable"};

typedef struct row row;
typedef struct rig {
    scene s;
    fe_body anchor, elsewhere, block, other; // `elsewhere`: a second anchor; `other`: a second block
    fe_joint joint;
    double mass, moment[3];
    int kind;
    const row *row;
} rig;

struct row {
    const char *name;
    size_t offset, size;
    double values[2];
    double (*outcome)(const rig *r, double value); // foretold
    double (*read)(const rig *r);
    int axis;       // fe_dof: of the push and of the reading
    double push;    // N or N m
    double seconds; // of it
    void (*prepare)(any_def *d);
    void (*put)(rig *r, any_def *d, const row *row, double value); // NULL: a float
};

#define FIELD(member) #member, offsetof(any_def, member), sizeof(((any_def *)NULL)->member)

// Of the difference of the two outcomes. Springs that creep are told by their slow root alone, which is off by a few
// per cent
#define TOLERANCE 0.1

// ---- laws ----------------------------------------------------------------------------------------------------------

static double inertia_of(const rig *r)
{
    return r->row->axis < FE_DOF_ANGULAR_X ? r->mass : r->moment[r->row->axis - FE_DOF_ANGULAR_X];
}
static double spring_of(double hertz, double inertia)
{
    return inertia * 4 * PI * PI * hertz * hertz;
} // N/m or N m/rad

static double as_set(const rig *r, double value)
{
    (void)r;
    return value;
}
static double reversed(const rig *r, double value)
{
    (void)r;
    return -value;
}
static double beyond_rest(const rig *r, double length) // the block rests 2 m from the anchor's point
{
    (void)r;
    return length - 2;
}
static double with_the_anchor(const rig *r, double x)
{
    (void)r;
    return x + 2;
}
// a rod of 2 m that started askew pulls along its line: from (-2, y) to (0, 0)
static double askew_of(double y) { return y * (1 - 2 / sqrt(4 + y * y)); }
static double along_the_rod(const rig *r, double y)
{
    (void)r;
    return askew_of(y);
}
static double against_the_rod(const rig *r, double y)
{
    (void)r;
    return -askew_of(y);
}

static double flight(const rig *r) { return discrete_way(r->row->push / inertia_of(r), r->row->seconds, r->s.h); }
static double held_if(const rig *r, double value) { return value > 0.5 ? 0 : flight(r); }
static double flies_if(const rig *r, double value) { return value > 0.5 ? flight(r) : 0; }
static double stopped_if(const rig *r, double value) { return value > 0.5 ? 0.25 : flight(r); } // at limits of 0.25
static double motion_decides(const rig *r, double motion) { return motion < 0.5 ? 0 : motion < 1.5 ? 0.25 : flight(r); }

static double gives(const rig *r, double hertz) { return r->row->push / spring_of(hertz, inertia_of(r)); }
static double gives_by_stiffness(const rig *r, double stiffness) { return r->row->push / stiffness; }
// far above critical damping: C x' = push - K x
static double creeps(const rig *r, double ratio)
{
    double hertz = 2, rate = 2 * PI * hertz / (2 * ratio);
    return gives(r, hertz) * (1 - exp(-rate * r->row->seconds));
}
// C x' = push - 200 x, for masses that the damper holds at once
static double creeps_by_damping(const rig *r, double damping)
{
    return gives_by_stiffness(r, 200) * (1 - exp(-200 / damping * r->row->seconds));
}
static double kind_of_spring(const rig *r, double spring)
{
    return spring < 0.5 ? flight(r) : spring < 1.5 ? gives(r, 200) : gives_by_stiffness(r, 200);
}
static double no_more_than_cap(const rig *r, double cap) { return fmin(r->row->push, cap); }
static double spun_up(const rig *r, double force) { return force * r->row->seconds / inertia_of(r); }
static double whole_if_stronger(const rig *r, double strength) { return strength > r->row->push; }

// ---- readings ------------------------------------------------------------------------------------------------------

static double component(vec a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }

// How far the block is moved along, or turned about, the axis
static double way(const rig *r)
{
    int axis = r->row->axis;
    if (axis < FE_DOF_ANGULAR_X) return component(position(&r->s, r->block), axis);
    fe_quat q = compose(inverse(r->s.turn), body_transform(r->s.world, r->block).rotation);
    return 2 * atan2(component(v3(q.x, q.y, q.z), axis - FE_DOF_ANGULAR_X), q.w);
}

static double pace(const rig *r)
{
    int axis = r->row->axis;
    return axis < FE_DOF_ANGULAR_X ? component(velocity(&r->s, r->block), axis)
                                   : component(spin(&r->s, r->block), axis - FE_DOF_ANGULAR_X);
}

static double resistance(const rig *r)
{
    int axis = r->row->axis;
    return axis < FE_DOF_ANGULAR_X ? -component(force_of(&r->s, r->joint), axis)
                                   : -component(torque_of(&r->s, r->joint), axis - FE_DOF_ANGULAR_X);
}

static double told_angle(const rig *r)
{
    fe_joint_state at = state_of(&r->s, r->joint);
    return component(v3(at.angle, at.swing_y, at.swing_z), r->row->axis - FE_DOF_ANGULAR_X);
}

static double is_whole(const rig *r) { return fe_joint_is_valid(r->s.world, r->joint); }
static double touches(const rig *r) { return fe_body_get_contacts(r->s.world, r->block, NULL, 0, 0); }
static double told_data(const rig *r)
{
    uint64_t data = 0;
    MUST(fe_joint_get_user_data(r->s.world, r->joint, &data));
    return (double)data;
}

// ---- values --------------------------------------------------------------------------------------------------------

static void put_int(rig *r, any_def *d, const row *row, double value)
{
    int32_t number = (int32_t)value;
    (void)r;
    memcpy((char *)d + row->offset, &number, sizeof number);
}

static void put_float(rig *r, any_def *d, const row *row, double value)
{
    float number = (float)value;
    (void)r;
    memcpy((char *)d + row->offset, &number, sizeof number);
}

// a rotation about the row's axis
static void put_turn(rig *r, any_def *d, const row *row, double value)
{
    int k = row->axis - FE_DOF_ANGULAR_X;
    fe_quat q = turned(v3(k == 0, k == 1, k == 2), value);
    (void)r;
    memcpy((char *)d + row->offset, &q, sizeof q);
}

static void put_data(rig *r, any_def *d, const row *row, double value)
{
    (void)r, (void)row;
    d->common.user_data = (uint64_t)value;
}

static void put_end_a(rig *r, any_def *d, const row *row, double value)
{
    (void)row;
    if (value > 0) d->common.body_a = r->elsewhere;
}

// The world in the anchor's place, with its frame so far along the axis
static void put_world_origin(rig *r, any_def *d, const row *row, double value)
{
    vec at = v3(value * (row->axis == 0) - (r->kind == ANY_DISTANCE ? 2 : 0), value * (row->axis == 1),
                value * (row->axis == 2));
    d->common.body_a = 0;
    d->common.world_origin = to_world(&r->s, at);
    d->common.frame_a.position = fe_make_vec3(0, 0, 0);
    d->common.frame_a.rotation = r->s.turn;
}

static void put_end_b(rig *r, any_def *d, const row *row, double value)
{
    (void)row;
    if (value > 0) d->common.body_b = r->other;
}

// the anchor gets a shape, in which the block stands
static void put_collide(rig *r, any_def *d, const row *row, double value)
{
    fe_geometry ball = sphere(0.1);
    fe_shape shape;
    MUST(fe_shape_create(r->s.world, r->anchor, NULL, &ball, &shape));
    put_int(r, d, row, value);
}

// ---- what else a definition needs ----------------------------------------------------------------------------------

#define PREPARE(name, ...) \
    static void name(any_def *d) { __VA_ARGS__; }

PREPARE(damped, d->common.damping_ratio = 5)
PREPARE(at_2_hertz, d->common.hertz = 2)
PREPARE(any_length, d->distance.lower = 0, d->distance.upper = 100, d->distance.target = 2)
PREPARE(no_least_length, d->distance.lower = 0, d->distance.upper = 2)
PREPARE(no_longest_length, d->distance.lower = 2, d->distance.upper = 100)
PREPARE(length_range, d->distance.lower = 1.75f, d->distance.upper = 2.25f)
PREPARE(length_spring, any_length(d), d->distance.spring_hertz = 2)
PREPARE(length_motor, any_length(d), d->distance.motor_max = 1e6f)
PREPARE(length_racer, any_length(d), d->distance.motor_speed = 1000)
PREPARE(cone_set, d->ball.cone_y = d->ball.cone_z = 0.25f)
PREPARE(cone, d->ball.cone_enabled = 1, cone_set(d))
PREPARE(twist_set, d->ball.lower = -0.25f, d->ball.upper = 0.25f)
PREPARE(twist, d->ball.limit_enabled = 1, twist_set(d))
PREPARE(soft_twist, d->ball.limit_enabled = 1, d->ball.upper = 0, d->ball.limit_hertz = 2,
        d->ball.limit_damping_ratio = 5)
PREPARE(ball_drive, d->ball.spring_hertz = 2)
PREPARE(ball_motor, d->ball.motor_max = 1e6f)
PREPARE(ball_racer, d->ball.motor_velocity = fe_make_vec3(1000, 0, 0))
PREPARE(range_set, d->hinge.lower = -0.25f, d->hinge.upper = 0.25f)
PREPARE(range, d->hinge.limit_enabled = 1, range_set(d))
PREPARE(soft_range, d->hinge.limit_enabled = 1, d->hinge.upper = 0, d->hinge.limit_hertz = 2,
        d->hinge.limit_damping_ratio = 5)
PREPARE(hinge_spring, d->hinge.spring_hertz = 2)
PREPARE(hinge_motor, d->hinge.motor_max = 1e6f)
PREPARE(hinge_racer, d->hinge.motor_speed = 1000)
PREPARE(angular_spring, d->fixed.angular_hertz = 2, d->fixed.angular_damping_ratio = 5)

// ---- rows of what all types have -----------------------------------------------------------------------------------

static const row common_rows[] = {
    {FIELD(common.enabled), {1, 0}, held_if, way, 0, 100, 0.5, NULL, put_int},
    {FIELD(common.body_b), {0, 1}, flies_if, way, 0, 100, 0.5, NULL, put_end_b},
    {FIELD(common.user_data), {7, 8}, as_set, told_data, 0, 0, 0, NULL, put_data},
    {FIELD(common.collide_connected), {0, 1}, as_set, touches, 0, 0, 0.02, NULL, put_collide},
    {FIELD(common.hertz), {2, 4}, gives, way, 0, 100, 5, damped, NULL},
    {FIELD(common.damping_ratio), {5, 20}, creeps, way, 0, 100, 1, at_2_hertz, NULL},
    {FIELD(common.break_force), {50, 150}, whole_if_stronger, is_whole, 0, 100, 0.5, NULL, NULL},
};

// of all but the distance joint, which knows no rotations
static const row solid_rows[] = {
    {FIELD(common.body_a), {0, 1}, as_set, way, 1, 0, 2, NULL, put_end_a},
    {FIELD(common.frame_a.position.x), {0, 0.5}, as_set, way, 0, 0, 2, NULL, NULL},
    {FIELD(common.frame_a.position.y), {0, 0.5}, as_set, way, 1, 0, 2, NULL, NULL},
    {FIELD(common.frame_a.position.z), {0, 0.5}, as_set, way, 2, 0, 2, NULL, NULL},
    {FIELD(common.frame_b.position.x), {0, 0.5}, reversed, way, 0, 0, 2, NULL, NULL},
    {FIELD(common.frame_b.position.y), {0, 0.5}, reversed, way, 1, 0, 2, NULL, NULL},
    {FIELD(common.frame_b.position.z), {0, 0.5}, reversed, way, 2, 0, 2, NULL, NULL},
    {FIELD(common.world_origin), {0, 0.5}, as_set, way, 0, 0, 2, NULL, put_world_origin},
    {FIELD(common.world_origin), {0, 0.5}, as_set, way, 1, 0, 2, NULL, put_world_origin},
    {FIELD(common.world_origin), {0, 0.5}, as_set, way, 2, 0, 2, NULL, put_world_origin},
};

#define TURN_ROWS(prepare_x, prepare_yz)                                                                         \
    {FIELD(common.frame_a.rotation), {0, 0.5}, as_set, way, FE_DOF_ANGULAR_X, 0, 3, prepare_x, put_turn},        \
        {FIELD(common.frame_a.rotation), {0, 0.5}, as_set, way, FE_DOF_ANGULAR_Y, 0, 3, prepare_yz, put_turn},   \
        {FIELD(common.frame_a.rotation), {0, 0.5}, as_set, way, FE_DOF_ANGULAR_Z, 0, 3, prepare_yz, put_turn},   \
        {FIELD(common.frame_b.rotation), {0, 0.5}, reversed, way, FE_DOF_ANGULAR_X, 0, 3, prepare_x, put_turn},  \
        {FIELD(common.frame_b.rotation), {0, 0.5}, reversed, way, FE_DOF_ANGULAR_Y, 0, 3, prepare_yz, put_turn}, \
    {                                                                                                            \
        FIELD(common.frame_b.rotation), {0, 0.5}, reversed, way, FE_DOF_ANGULAR_Z, 0, 3, prepare_yz, put_turn    \
    }

// ---- rows of each type ---------------------------------------------------------------------------------------------

static const row distance_rows[] = {
    {FIELD(common.body_a), {0, 1}, along_the_rod, way, 1, 0, 2, NULL, put_end_a},
    {FIELD(common.frame_a.position.x), {-2, -1.5}, with_the_anchor, way, 0, 0, 2, NULL, NULL},
    {FIELD(common.world_origin), {0, 0.5}, as_set, way, 0, 0, 2, NULL, put_world_origin},
    {FIELD(common.frame_a.position.y), {0, 1}, along_the_rod, way, 1, 0, 2, NULL, NULL},
    {FIELD(common.frame_a.position.z), {0, 1}, along_the_rod, way, 2, 0, 2, NULL, NULL},
    {FIELD(common.frame_b.position.x), {0, 0.5}, reversed, way, 0, 0, 2, NULL, NULL},
    {FIELD(common.frame_b.position.y), {0, 1}, against_the_rod, way, 1, 0, 2, NULL, NULL},
    {FIELD(common.frame_b.position.z), {0, 1}, against_the_rod, way, 2, 0, 2, NULL, NULL},
    // only the positions of the frames count: rotations change what is told
    {FIELD(common.frame_a.rotation), {0, 0.5}, reversed, told_angle, FE_DOF_ANGULAR_X, 0, 0, NULL, put_turn},
    {FIELD(common.frame_a.rotation), {0, 0.5}, reversed, told_angle, FE_DOF_ANGULAR_Y, 0, 0, NULL, put_turn},
    {FIELD(common.frame_b.rotation), {0, 0.5}, as_set, told_angle, FE_DOF_ANGULAR_Z, 0, 0, NULL, put_turn},
    {FIELD(distance.limit_enabled), {0, 1}, stopped_if, way, 0, 200, 0.5, length_range, put_int},
    {FIELD(distance.lower), {1.5, 1.75}, beyond_rest, way, 0, -100, 3, no_least_length, NULL},
    {FIELD(distance.upper), {2.25, 2.5}, beyond_rest, way, 0, 100, 3, no_longest_length, NULL},
    {FIELD(distance.target), {1.5, 2.5}, beyond_rest, way, 0, 0, 3, length_spring, NULL},
    {FIELD(distance.spring_hertz), {1, 2}, gives, way, 0, 100, 3, any_length, NULL},
    {FIELD(distance.spring_damping_ratio), {5, 20}, creeps, way, 0, 100, 1, length_spring, NULL},
    {FIELD(distance.spring_max), {60, 150}, no_more_than_cap, resistance, 0, 100, 3, length_spring, NULL},
    {FIELD(distance.motor_speed), {-0.5, 0.5}, as_set, pace, 0, 0, 1, length_motor, NULL},
    {FIELD(distance.motor_max), {50, 100}, spun_up, pace, 0, 0, 0.5, length_racer, NULL},
};

static const row ball_rows[] = {
    TURN_ROWS(ball_drive, ball_drive),
    {FIELD(common.break_torque), {5, 15}, whole_if_stronger, is_whole, FE_DOF_ANGULAR_X, 10, 0.5, ball_motor, NULL},
    {FIELD(ball.cone_enabled), {0, 1}, stopped_if, way, FE_DOF_ANGULAR_Y, 10, 0.5, cone_set, put_int},
    {FIELD(ball.cone_enabled), {0, 1}, stopped_if, way, FE_DOF_ANGULAR_Z, 10, 0.5, cone_set, put_int},
    {FIELD(ball.cone_y), {0.5, 0.75}, as_set, way, FE_DOF_ANGULAR_Y, 10, 2, cone, NULL},
    {FIELD(ball.cone_z), {0.5, 0.75}, as_set, way, FE_DOF_ANGULAR_Z, 10, 2, cone, NULL},
    {FIELD(ball.limit_enabled), {0, 1}, stopped_if, way, FE_DOF_ANGULAR_X, 10, 0.5, twist_set, put_int},
    {FIELD(ball.lower), {-0.5, -0.75}, as_set, way, FE_DOF_ANGULAR_X, -10, 2, twist, NULL},
    {FIELD(ball.upper), {0.5, 0.75}, as_set, way, FE_DOF_ANGULAR_X, 10, 2, twist, NULL},
    {FIELD(ball.limit_hertz), {2, 4}, gives, way, FE_DOF_ANGULAR_X, 10, 5, soft_twist, NULL},
    {FIELD(ball.limit_damping_ratio), {5, 20}, creeps, way, FE_DOF_ANGULAR_X, 10, 1, soft_twist, NULL},
    {FIELD(ball.spring_hertz), {2, 4}, gives, way, FE_DOF_ANGULAR_X, 10, 3, ball_drive, NULL},
    {FIELD(ball.spring_damping_ratio), {5, 20}, creeps, way, FE_DOF_ANGULAR_X, 10, 1, ball_drive, NULL},
    {FIELD(ball.spring_max), {6, 15}, no_more_than_cap, resistance, FE_DOF_ANGULAR_X, 10, 1, ball_drive, NULL},
    {FIELD(ball.target), {0.25, -0.5}, as_set, way, FE_DOF_ANGULAR_X, 0, 3, ball_drive, put_turn},
    {FIELD(ball.target), {0.25, -0.5}, as_set, way, FE_DOF_ANGULAR_Y, 0, 3, ball_drive, put_turn},
    {FIELD(ball.target), {0.25, -0.5}, as_set, way, FE_DOF_ANGULAR_Z, 0, 3, ball_drive, put_turn},
    {FIELD(ball.motor_velocity.x), {0.5, -1}, as_set, pace, FE_DOF_ANGULAR_X, 0, 1, ball_motor, NULL},
    {FIELD(ball.motor_velocity.y), {0.5, -1}, as_set, pace, FE_DOF_ANGULAR_Y, 0, 1, ball_motor, NULL},
    {FIELD(ball.motor_velocity.z), {0.5, -1}, as_set, pace, FE_DOF_ANGULAR_Z, 0, 1, ball_motor, NULL},
    {FIELD(ball.motor_max), {1, 3}, spun_up, pace, FE_DOF_ANGULAR_X, 0, 0.5, ball_racer, NULL},
};

static const row hinge_rows[] = {
    TURN_ROWS(hinge_spring, NULL),
    {FIELD(common.break_torque), {5, 15}, whole_if_stronger, is_whole, FE_DOF_ANGULAR_Y, 10, 0.5, NULL, NULL},
    {FIELD(hinge.limit_enabled), {0, 1}, stopped_if, way, FE_DOF_ANGULAR_X, 10, 0.5, range_set, put_int},
    {FIELD(hinge.lower), {-0.5, -0.75}, as_set, way, FE_DOF_ANGULAR_X, -10, 2, range, NULL},
    {FIELD(hinge.upper), {0.5, 0.75}, as_set, way, FE_DOF_ANGULAR_X, 10, 2, range, NULL},
    {FIELD(hinge.limit_hertz), {2, 4}, gives, way, FE_DOF_ANGULAR_X, 10, 5, soft_range, NULL},
    {FIELD(hinge.limit_damping_ratio), {5, 20}, creeps, way, FE_DOF_ANGULAR_X, 10, 1, soft_range, NULL},
    {FIELD(hinge.spring_hertz), {2, 4}, gives, way, FE_DOF_ANGULAR_X, 10, 3, hinge_spring, NULL},
    {FIELD(hinge.spring_damping_ratio), {5, 20}, creeps, way, FE_DOF_ANGULAR_X, 10, 1, hinge_spring, NULL},
    {FIELD(hinge.spring_max), {6, 15}, no_more_than_cap, resistance, FE_DOF_ANGULAR_X, 10, 1, hinge_spring, NULL},
    {FIELD(hinge.target), {0.25, -0.5}, as_set, way, FE_DOF_ANGULAR_X, 0, 3, hinge_spring, NULL},
    {FIELD(hinge.motor_speed), {0.5, -1}, as_set, pace, FE_DOF_ANGULAR_X, 0, 1, hinge_motor, NULL},
    {FIELD(hinge.motor_max), {1, 3}, spun_up, pace, FE_DOF_ANGULAR_X, 0, 0.5, hinge_racer, NULL},
};

static const row fixed_rows[] = {
    TURN_ROWS(NULL, NULL),
    {FIELD(common.break_torque), {5, 15}, whole_if_stronger, is_whole, FE_DOF_ANGULAR_Y, 10, 0.5, NULL, NULL},
    {FIELD(fixed.angular_hertz), {2, 4}, gives, way, FE_DOF_ANGULAR_Y, 10, 5, angular_spring, NULL},
    {FIELD(fixed.angular_damping_ratio), {5, 20}, creeps, way, FE_DOF_ANGULAR_Z, 10, 1, angular_spring, NULL},
};

static const row six_rows[] = {
    TURN_ROWS(NULL, NULL),
    {FIELD(common.break_torque), {5, 15}, whole_if_stronger, is_whole, FE_DOF_ANGULAR_Y, 10, 0.5, NULL, NULL},
};

// ---- rows of an axis, for each of the six --------------------------------------------------------------------------

typedef struct axis_row {
    const char *name;
    size_t offset, size; // in fe_joint_axis
    double values[2];
    double (*outcome)(const rig *r, double value);
    double (*read)(const rig *r);
    double push, seconds;
    fe_joint_axis axis; // what else it needs
    int is_int;
} axis_row;

#define OF_AXIS(member) #member, offsetof(fe_joint_axis, member), sizeof(((fe_joint_axis *)NULL)->member)
#define RANGE .motion = FE_MOTION_LIMITED, .lower = -0.25f, .upper = 0.25f, .limit_damping_ratio = 1
#define SOFT_RANGE .motion = FE_MOTION_LIMITED, .lower = -0.25f, .limit_hertz = 2, .limit_damping_ratio = 5
#define SPRING                                                                                         \
    .motion = FE_MOTION_FREE, .spring = FE_SPRING_HERTZ, .spring_hertz = 2, .spring_damping_ratio = 1, \
    .spring_max = 1e15f
#define STIFF                                                                                                  \
    .motion = FE_MOTION_FREE, .spring = FE_SPRING_STIFFNESS, .spring_hertz = 200, .spring_damping_ratio = 200, \
    .spring_stiffness = 200, .spring_damping = 200, .spring_max = 1e15f

static const axis_row axis_rows[] = {
    {OF_AXIS(motion), {FE_MOTION_LOCKED, FE_MOTION_LIMITED}, motion_decides, way, 10, 2, {RANGE}, 1},
    {OF_AXIS(motion),
     {FE_MOTION_LIMITED, FE_MOTION_FREE},
     motion_decides,
     way,
     40,
     0.25,
     {.lower = 0.25f, .upper = 0.25f, .limit_damping_ratio = 1},
     1},
    {OF_AXIS(lower), {-0.5, -0.75}, as_set, way, -100, 2, {RANGE}, 0},
    {OF_AXIS(upper), {0.5, 0.75}, as_set, way, 100, 2, {RANGE}, 0},
    {OF_AXIS(limit_hertz), {2, 4}, gives, way, 10, 5, {SOFT_RANGE}, 0},
    {OF_AXIS(limit_damping_ratio), {5, 20}, creeps, way, 10, 1, {SOFT_RANGE}, 0},
    {OF_AXIS(spring), {FE_SPRING_NONE, FE_SPRING_HERTZ}, kind_of_spring, way, 1, 1, {STIFF}, 1},
    {OF_AXIS(spring), {FE_SPRING_HERTZ, FE_SPRING_STIFFNESS}, kind_of_spring, way, 10, 5, {STIFF}, 1},
    {OF_AXIS(target), {0.25, -0.5}, as_set, way, 0, 3, {SPRING}, 0},
    {OF_AXIS(spring_hertz), {2, 4}, gives, way, 10, 3, {SPRING}, 0},
    {OF_AXIS(spring_stiffness), {100, 200}, gives_by_stiffness, way, 10, 8, {STIFF}, 0},
    {OF_AXIS(spring_damping_ratio), {5, 20}, creeps, way, 10, 1, {SPRING}, 0},
    {OF_AXIS(spring_damping), {2000, 8000}, creeps_by_damping, way, 10, 1, {STIFF}, 0},
    {OF_AXIS(spring_max), {6, 15}, no_more_than_cap, resistance, 10, 1, {SPRING}, 0},
    {OF_AXIS(motor_speed), {0.5, -1}, as_set, pace, 0, 1, {.motion = FE_MOTION_FREE, .motor_max = 1e6f}, 0},
    {OF_AXIS(motor_max), {1, 3}, spun_up, pace, 0, 0.5, {.motion = FE_MOTION_FREE, .motor_speed = 1000}, 0},
};

// ---- the rig -------------------------------------------------------------------------------------------------------

static void init(int kind, any_def *d)
{
    memset(d, 0, sizeof *d);
    any_init(kind, d);
    if (kind == ANY_DISTANCE) {
        d->common.frame_a.position.x = -2;
        d->distance.lower = d->distance.upper = 2;
    }
}

static fe_joint create(const rig *r, const any_def *d)
{
    fe_joint joint = 0;
    MUST(any_create(r->kind, r->s.world, d, &joint));
    return joint;
}

static rig begin(void **state, int kind, const row *row)
{
    rig r = {.s = scene_begin(state), .kind = kind, .row = row};
    set_gravity(&r.s, v3(0, 0, 0));
    r.anchor = add_anchor(&r.s, v3(0, 0, 0));
    r.elsewhere = add_anchor(&r.s, v3(0, 1, 0));
    r.block = add_plain(&r.s, box(0.2, 0.25, 0.15), v3(0, 0, 0));
    r.other = add_plain(&r.s, sphere(0.1), v3(0, 5, 0));
    MUST(fe_body_set_filter(r.s.world, r.other, 2, 0, 0)); // when it is drawn to the anchor, it passes the block
    r.mass = mass_of(&r.s, r.block);
    for (int k = 0; k < 3; ++k) r.moment[k] = moment_of(&r.s, r.block, k, 0);
    // a rod that pulls at a point off the centre would turn the block
    if (kind == ANY_DISTANCE) MUST(fe_body_set_locks(r.s.world, r.block, 0, FE_AXIS_ALL));
    return r;
}

static void push_block(rig *r, double push)
{
    int k = r->row->axis % 3;
    vec along = v3(push * (k == 0), push * (k == 1), push * (k == 2));
    if (r->row->axis < FE_DOF_ANGULAR_X)
        add_force(&r->s, r->block, along);
    else
        add_torque(&r->s, r->block, along);
}

// The world in which the field has the value: what is read, and in `*out_expected` what was foretold
static double play(void **state, int kind, const row *row, const fe_joint_axis *axis, double value,
                   double *out_expected)
{
    rig r = begin(state, kind, row);
    any_def d;
    init(kind, &d);
    d.common.body_a = r.anchor, d.common.body_b = r.block;
    if (axis) d.configurable.axes[row->axis] = *axis;
    if (row->prepare) row->prepare(&d);
    (row->put ? row->put : put_float)(&r, &d, row, value);
    r.joint = create(&r, &d);
    int steps = (int)(row->seconds / STEP + 0.5);
    for (int i = 0; i < steps; ++i) {
        if (row->push != 0) push_block(&r, row->push);
        run(&r.s, 1);
    }
    double reading = row->read(&r);
    *out_expected = row->outcome(&r, value);
    scene_end(&r.s);
    return reading;
}

static int differs_as_foretold(void **state, int kind, const row *row, const fe_joint_axis *axis)
{
    double expected[2], reading[2];
    for (int i = 0; i < 2; ++i) reading[i] = play(state, kind, row, axis, row->values[i], &expected[i]);
    double room = TOLERANCE * fabs(expected[1] - expected[0]);
    if (room > 0 && fabs(reading[0] - expected[0]) <= room && fabs(reading[1] - expected[1]) <= room) return 1;
    print_error("%s, %s, axis %d: %g gives %.6g, expected %.6g; %g gives %.6g, expected %.6g\n", kind_names[kind],
                row->name, row->axis, row->values[0], reading[0], expected[0], row->values[1], reading[1], expected[1]);
    return 0;
}

// ---- all rows ------------------------------------------------------------------------------------------------------

typedef struct table {
    const row *rows;
    size_t count;
} table;

#define ROWS(array)                         \
    {                                       \
        array, sizeof array / sizeof *array \
    }
static const table common_table = ROWS(common_rows), solid_table = ROWS(solid_rows);
static const table own_tables[ANY_KINDS] = {ROWS(distance_rows), ROWS(ball_rows), ROWS(hinge_rows), ROWS(fixed_rows),
                                            ROWS(six_rows)};
enum { AXIS_ROWS = sizeof axis_rows / sizeof *axis_rows };

static row row_of_axis(const axis_row *a, int axis)
{
    size_t start = offsetof(any_def, configurable.axes) + (size_t)axis * sizeof(fe_joint_axis);
    return (row){a->name, start + a->offset, a->size, {a->values[0], a->values[1]}, a->outcome, a->read, axis,
                 a->push, a->seconds,        NULL,    a->is_int ? put_int : NULL};
}

static int try_table(void **state, int kind, const table *t)
{
    int misses = 0;
    for (size_t i = 0; i < t->count; ++i) misses += !differs_as_foretold(state, kind, &t->rows[i], NULL);
    return misses;
}

static void each_field_alone_decides_what_mechanics_foretells(void **state)
{
    int misses = 0;
    for (int kind = 0; kind < ANY_KINDS; ++kind) {
        misses += try_table(state, kind, &common_table);
        if (kind != ANY_DISTANCE) misses += try_table(state, kind, &solid_table);
        misses += try_table(state, kind, &own_tables[kind]);
    }
    FE_TRUE(misses == 0);
}

static void each_field_of_each_axis_alone_decides_too(void **state)
{
    int misses = 0;
    for (int axis = 0; axis < 6; ++axis)
        for (int i = 0; i < AXIS_ROWS; ++i) {
            row made = row_of_axis(&axis_rows[i], axis);
            misses += !differs_as_foretold(state, ANY_CONFIGURABLE, &made, &axis_rows[i].axis);
        }
    FE_TRUE(misses == 0);
}

// ---- no field is left out ------------------------------------------------------------------------------------------

typedef struct exception {
    int kind; // -1: all
    size_t offset, size;
} exception;

#define AWAY(member) offsetof(any_def, member), sizeof(((any_def *)NULL)->member)
// tests/api/test_joint.c has these: sizes, and what must be 0
static const exception elsewhere[] = {
    {-1, AWAY(common.struct_size)},
    {-1, AWAY(common.reserved)},
    {ANY_DISTANCE, AWAY(distance.reserved_end)},
    {ANY_BALL, AWAY(ball.reserved_end)},
    {ANY_HINGE, AWAY(hinge.reserved_end)},
    {ANY_DISTANCE, AWAY(common.break_torque)}, // a force along a line through the points has no torque about them
};

static void mark(unsigned char *covered, size_t offset, size_t size) { memset(covered + offset, 1, size); }

static void every_field_of_every_type_has_a_row(void **state)
{
    (void)state;
    for (int kind = 0; kind < ANY_KINDS; ++kind) {
        unsigned char covered[sizeof(any_def)] = {0};
        const table tables[3] = {common_table, own_tables[kind], kind == ANY_DISTANCE ? common_table : solid_table};
        for (int t = 0; t < 3; ++t)
            for (size_t i = 0; i < tables[t].count; ++i)
                mark(covered, tables[t].rows[i].offset, tables[t].rows[i].size);
        for (int axis = 0; axis < 6 && kind == ANY_CONFIGURABLE; ++axis)
            for (int i = 0; i < AXIS_ROWS; ++i) {
                row made = row_of_axis(&axis_rows[i], axis);
                mark(covered, made.offset, made.size);
                mark(covered, made.offset - axis_rows[i].offset + offsetof(fe_joint_axis, reserved),
                     sizeof axis_rows[i].axis.reserved);
            }
        for (size_t i = 0; i < sizeof elsewhere / sizeof *elsewhere; ++i)
            if (elsewhere[i].kind < 0 || elsewhere[i].kind == kind)
                mark(covered, elsewhere[i].offset, elsewhere[i].size);
        for (size_t i = 0; i < any_sizes[kind]; ++i)
            if (!covered[i])
                fail_msg("byte %zu of a %s joint's definition belongs to a field without a row", i, kind_names[kind]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_field_of_every_type_has_a_row),
        TEST(each_field_alone_decides_what_mechanics_foretells),
        TEST_WITH(each_field_alone_decides_what_mechanics_foretells, ", askew", askew),
        TEST(each_field_of_each_axis_alone_decides_too),
        TEST_WITH(each_field_of_each_axis_alone_decides_too, ", askew", askew),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
