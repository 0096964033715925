// field.c - see field.h. The table of fields is at the end.
#include "batch/field.h"

#include "core/bytes.h"
#include "world/body_creation.h"
#include "world/joint.h"
#include "world/joint_parts.h"
#include "world/joint_creation.h"
#include "world/mass.h"
#include "world/body_motion.h"
#include "world/contact.h"
#include "world/body.h"
#include "world/shape.h"
#include "world/sleep.h"

#include <float.h>
#include <math.h>
#include <string.h>

const fe__id_pool *fe__field_ids(const fe_world *world, int32_t kind)
{
    if (kind == FE_KIND_SHAPE) return &world->shape_ids;
    return kind == FE_KIND_BODY ? &world->body_ids : &world->joint_ids;
}

fe_result fe__field_find(const fe_world *world, const fe__batch_field *field, fe_handle item, int32_t *out_index)
{
    *out_index = 0;
    if (!field->kind) return FE_OK;
    fe_result result = fe__id_pool_find(fe__field_ids(world, field->kind), item, out_index);
    if (field->kind == FE_KIND_JOINT) *out_index += 1; // joint 0 is none
    return result;
}

// ---- rows ----------------------------------------------------------------------------------------------------------
static double *put_vec3(double *out, fe_vec3 v)
{
    out[0] = (double)v.x, out[1] = (double)v.y, out[2] = (double)v.z;
    return out + 3;
}
static fe_vec3 vec3_at(const double *row) { return fe__vec3((float)row[0], (float)row[1], (float)row[2]); }

// All `count` numbers: |x| <= most, which NaN is not
static int32_t are_within(const double *row, int32_t count, double most)
{
    int32_t within = 1;
    for (int32_t i = 0; i < count; ++i) within &= fe__absd(row[i]) <= most;
    return within;
}
static fe_result in_range(int32_t within) { return within ? FE_OK : FE_ERROR_ARGUMENT; }

// ---- bodies --------------------------------------------------------------------------------------------------------
static void read_transform(const fe_world *w, int32_t body, const fe__field_frame *frame, double *out)
{
    const fe__body *b = w->bodies + body;
    fe_dvec3 p = fe__drotate_back(frame->rotation, fe__dsub(fe__origin_of(b), frame->origin));
    fe_quat q = fe__product(fe__conjugate(frame->rotation), fe__rotation_of(b));
    out[0] = p.x, out[1] = p.y, out[2] = p.z;
    out[3] = (double)q.x, out[4] = (double)q.y, out[5] = (double)q.z, out[6] = (double)q.w;
}

// Any rotation but none: as floats, so that it is what a caller of floats gave
static fe_result takes_transform(const fe_world *w, int32_t body, const double *row)
{
    (void)w, (void)body;
    float any = 0.0f;
    for (int32_t i = 3; i < 7; ++i) any = fe__maxf(any, fe__absf((float)row[i]));
    return in_range(are_within(row, 3, FE_MAX_POSITION) && are_within(row + 3, 4, (double)FLT_MAX) && any > 0.0f);
}

static fe_result write_transform(fe_world *w, int32_t body, const double *row)
{
    fe_transform t = {{row[0], row[1], row[2]}, {(float)row[3], (float)row[4], (float)row[5], (float)row[6]}};
    fe__body_set_transform(w, body, &t);
    return FE_OK;
}

static void read_velocity(const fe_world *w, int32_t body, const fe__field_frame *frame, double *out)
{
    const fe__body *b = w->bodies + body;
    out = put_vec3(out, fe__rotate_back(frame->rotation, fe__quad_vector(b->velocity)));
    put_vec3(out, fe__rotate_back(frame->rotation, fe__quad_vector(b->spin)));
}

static fe_result takes_velocity(const fe_world *w, int32_t body, const double *row)
{
    if (w->bodies[body].type == FE_BODY_STATIC) return FE_ERROR_STATE;
    return in_range(are_within(row, 6, (double)FE_MAX_SPEED));
}

static fe_result write_velocity(fe_world *w, int32_t body, const double *row)
{
    fe_vec3 linear = vec3_at(row), angular = vec3_at(row + 3);
    fe__body_set_velocity(w, body, &linear, &angular);
    return FE_OK;
}

static fe_result takes_force(const fe_world *w, int32_t body, const double *row)
{
    (void)w, (void)body;
    return in_range(are_within(row, 6, (double)FE_MAX_FORCE));
}

static fe_result write_force(fe_world *w, int32_t body, const double *row)
{
    if (fe__body_feels_forces(w->bodies + body)) fe__body_add_force(w, body, vec3_at(row), vec3_at(row + 3));
    return FE_OK;
}

static void read_awake(const fe_world *w, int32_t body, const fe__field_frame *frame, double *out)
{
    (void)frame;
    *out = w->bodies[body].awake_index >= 0;
}

static fe_vec3 force_of_contact(const fe_world *w, int32_t pair)
{
    const fe__contact *c = w->contacts + pair;
    const fe__points *q = fe__points_of(w, c);
    float along = 0.0f;
    for (int32_t i = 0; i < (int32_t)c->point_count; ++i) along += q->total_impulse[i];
    fe_vec3 normal = fe__vec3(c->normal[0], c->normal[1], c->normal[2]);
    fe_vec3 friction = fe__vec3(q->friction_impulse[0], q->friction_impulse[1], q->friction_impulse[2]);
    return fe__add(fe__scale(along / w->last_dt, normal), fe__scale(1.0f / w->last_h, friction));
}

static void read_contact_force(const fe_world *w, int32_t body, const fe__field_frame *frame, double *out)
{
    fe_vec3 sum = fe__vec3(0.0f, 0.0f, 0.0f);
    for (int32_t pair = w->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(w, pair, body)) {
        const fe__pair *p = w->pairs + pair;
        if (p->flags & FE__PAIR_SENSOR || (int32_t)w->contacts[pair].point_count == 0 || !(w->last_h > 0.0f)) continue;
        // The solver's B, whom its impulses push, is A where the pair is flipped
        int32_t pushed = p->flags & FE__PAIR_FLIPPED ? p->body_a : p->body_b;
        fe_vec3 force = force_of_contact(w, pair);
        sum = fe__add(sum, pushed == body ? force : fe__neg(force));
    }
    put_vec3(out, fe__rotate_back(frame->rotation, sum));
}

static void read_mass(const fe_world *w, int32_t body, const fe__field_frame *frame, double *out)
{
    (void)frame;
    *out = (double)w->bodies[body].mass;
}

static fe_result takes_mass(const fe_world *w, int32_t body, const double *row)
{
    if (w->bodies[body].type != FE_BODY_DYNAMIC) return FE_ERROR_STATE;
    if (!(*row >= (double)FE_LEAST_MASS && *row <= (double)FE_MAX_MASS)) return FE_ERROR_ARGUMENT;
    fe_vec3 i = fe__body_scaled_mass(w, body, (float)*row).inertia;
    float least = fe__minf(i.x, fe__minf(i.y, i.z)), most = fe__maxf(i.x, fe__maxf(i.y, i.z));
    return in_range(least >= FE_LEAST_INERTIA && most <= FE_MAX_INERTIA);
}

static fe_result write_mass(fe_world *w, int32_t body, const double *row)
{
    fe_mass_data scaled = fe__body_scaled_mass(w, body, (float)*row);
    fe__body_set_mass(w, body, &scaled);
    return FE_OK;
}

// ---- shapes --------------------------------------------------------------------------------------------------------
static void read_friction(const fe_world *w, int32_t shape, const fe__field_frame *frame, double *out)
{
    (void)frame;
    const fe_material *m = &w->shapes[shape].material;
    out[0] = (double)m->static_friction, out[1] = (double)m->dynamic_friction;
}

static fe_result takes_friction(const fe_world *w, int32_t shape, const double *row)
{
    (void)w, (void)shape;
    return in_range(are_within(row, 2, (double)FE_MAX_VALUE) && row[0] >= 0.0 && row[1] >= 0.0);
}

static fe_result write_friction(fe_world *w, int32_t shape, const double *row)
{
    fe_material material = w->shapes[shape].material;
    material.static_friction = (float)row[0], material.dynamic_friction = (float)row[1];
    fe__shape_set_material(w, shape, &material);
    return FE_OK;
}

// ---- the world -----------------------------------------------------------------------------------------------------
static void read_gravity(const fe_world *w, int32_t none, const fe__field_frame *frame, double *out)
{
    (void)none;
    put_vec3(out, fe__rotate_back(frame->rotation, w->gravity));
}

static fe_result takes_gravity(const fe_world *w, int32_t none, const double *row)
{
    (void)w, (void)none;
    return in_range(are_within(row, 3, (double)FE_MAX_SPEED));
}

static fe_result write_gravity(fe_world *w, int32_t none, const double *row)
{
    (void)none;
    fe__world_set_gravity(w, vec3_at(row));
    return FE_OK;
}

// ---- joints, along the degree of freedom that they have ------------------------------------------------------------
static int32_t free_dof(const fe_world *w, int32_t joint, fe__joint_any *def)
{
    fe__joint_describe(w, joint, def);
    return fe__joint_free_dof(def, w->joint_records[joint].type);
}

static void read_joint(const fe_world *w, int32_t joint, const fe__field_frame *frame, double *out)
{
    (void)frame;
    fe__joint_any def;
    fe_joint_state s;
    int32_t dof = free_dof(w, joint, &def);
    out[0] = out[1] = 0.0;
    if (dof < 0) return;
    fe__joint_state_of(w, joint, &s);
    const float at[] = {s.translation.x, s.translation.y, s.translation.z, s.angle, s.swing_y, s.swing_z};
    const float rate[] = {s.linear_velocity.x,  s.linear_velocity.y,  s.linear_velocity.z,
                          s.angular_velocity.x, s.angular_velocity.y, s.angular_velocity.z};
    int32_t is_distance = w->joint_records[joint].type == FE_JOINT_DISTANCE;
    out[0] = (double)(is_distance ? s.length : at[dof]);
    out[1] = (double)(is_distance ? s.speed : rate[dof]);
}

static fe_result takes_force_of_joint(const fe_world *w, int32_t joint, const double *row)
{
    fe__joint_any def;
    if (free_dof(w, joint, &def) < 0) return FE_ERROR_STATE;
    return in_range(are_within(row, 1, (double)FE_MAX_FORCE));
}

// Of a distance joint from A's point to B's; else an axis of frame A. World axes
static fe_vec3 axis_of(const fe_world *w, int32_t joint, int32_t dof, fe_dvec3 point_b)
{
    fe_transform a = fe__joint_frame_now(w, joint, 0);
    fe__mat3 r = fe__matrix(a.rotation);
    if (w->joint_records[joint].type != FE_JOINT_DISTANCE) return dof % 3 == 0 ? r.x : dof % 3 == 1 ? r.y : r.z;
    fe_dvec3 d = fe__dsub(point_b, a.position);
    double length = sqrt(fe__ddot(d, d));
    return length > 0.0 ? fe__narrow(fe__dscale(1.0 / length, d)) : fe__vec3(0.0f, 0.0f, 0.0f);
}

// On a body at a point, and about it
static void push(fe_world *w, int32_t body, fe_dvec3 point, fe_vec3 force, fe_vec3 torque)
{
    const fe__body *b = w->bodies + body;
    if (!fe__body_feels_forces(b)) return;
    fe_vec3 arm = fe__narrow(fe__dsub(point, fe__centre_of(b)));
    fe__body_add_force(w, body, force, fe__add(torque, fe__cross(arm, force)));
}

static fe_result write_force_of_joint(fe_world *w, int32_t joint, const double *row)
{
    fe__joint_any def;
    const fe__joint_record *r = w->joint_records + joint;
    int32_t dof = free_dof(w, joint, &def), is_linear = dof < FE_DOF_ANGULAR_X;
    fe_dvec3 point = fe__joint_frame_now(w, joint, 1).position;
    fe_vec3 pull = fe__scale((float)row[0], axis_of(w, joint, dof, point)), none = fe__vec3(0.0f, 0.0f, 0.0f);
    push(w, r->body[1], point, is_linear ? pull : none, is_linear ? none : pull);
    pull = fe__neg(pull);
    push(w, r->body[0], point, is_linear ? pull : none, is_linear ? none : pull);
    return FE_OK;
}

int32_t fe__field_pushed(const fe__batch_field *field) { return field->kind == FE_KIND_JOINT ? 2 : 1; }

int32_t fe__field_keep_forces(const fe_world *w, const fe__batch_field *field, int32_t index, fe__kept_force *out)
{
    const int32_t *bodies = field->kind == FE_KIND_JOINT ? w->joint_records[index].body : &index;
    int32_t count = fe__field_pushed(field);
    for (int32_t i = 0; i < count; ++i) {
        out[i].body = bodies[i];
        memcpy(out[i].force, w->bodies[bodies[i]].force, sizeof out[i].force);
        memcpy(out[i].torque, w->bodies[bodies[i]].torque, sizeof out[i].torque);
    }
    return count;
}

void fe__field_put_back(fe_world *w, const fe__kept_force *kept)
{
    memcpy(w->bodies[kept->body].force, kept->force, sizeof kept->force);
    memcpy(w->bodies[kept->body].torque, kept->torque, sizeof kept->torque);
}

typedef float *(*drive_of)(fe__joint_any *def, int32_t type, int32_t dof);
static float *find_drive(const fe_world *w, int32_t joint, drive_of find, fe__joint_any *def)
{
    int32_t dof = free_dof(w, joint, def);
    return dof < 0 ? NULL : find(def, w->joint_records[joint].type, dof);
}

static fe_result write_drive(fe_world *w, int32_t joint, drive_of find, const double *row)
{
    fe__joint_any def;
    float *drive = find_drive(w, joint, find, &def), value = (float)row[0];
    if (*drive == value) return FE_OK;
    *drive = value;
    return fe__joint_change(w, joint, &def);
}

static fe_result takes_speed(const fe_world *w, int32_t joint, const double *row)
{
    fe__joint_any def;
    if (!find_drive(w, joint, fe__joint_motor_speed, &def)) return FE_ERROR_STATE;
    return in_range(are_within(row, 1, (double)FE_MAX_SPEED));
}
static fe_result write_speed(fe_world *w, int32_t joint, const double *row)
{
    return write_drive(w, joint, fe__joint_motor_speed, row);
}
static fe_result takes_target(const fe_world *w, int32_t joint, const double *row)
{
    fe__joint_any def;
    float least, most;
    if (!find_drive(w, joint, fe__joint_target, &def)) return FE_ERROR_STATE;
    fe__joint_target_range(w->joint_records[joint].type, free_dof(w, joint, &def), &least, &most);
    return in_range(*row >= (double)least && *row <= (double)most);
}
static fe_result write_target(fe_world *w, int32_t joint, const double *row)
{
    return write_drive(w, joint, fe__joint_target, row);
}

static void read_reaction(const fe_world *w, int32_t joint, const fe__field_frame *frame, double *out)
{
    fe_vec3 force, torque;
    fe__joint_reaction_of(&w->joints, w->bodies, joint, &force, &torque);
    out = put_vec3(out, fe__rotate_back(frame->rotation, force));
    put_vec3(out, fe__rotate_back(frame->rotation, torque));
}

// ---- the table -----------------------------------------------------------------------------------------------------
const fe__batch_field *fe__field_of(int32_t field)
{
    static const fe__batch_field fields[] = {
        [FE_FIELD_TRANSFORM] = {7, FE_KIND_BODY, read_transform, takes_transform, write_transform, 0},
        [FE_FIELD_VELOCITY] = {6, FE_KIND_BODY, read_velocity, takes_velocity, write_velocity, 0},
        [FE_FIELD_FORCE] = {6, FE_KIND_BODY, NULL, takes_force, write_force, 1},
        [FE_FIELD_AWAKE] = {1, FE_KIND_BODY, read_awake, NULL, NULL, 0},
        [FE_FIELD_JOINT] = {2, FE_KIND_JOINT, read_joint, NULL, NULL, 0},
        [FE_FIELD_JOINT_FORCE] = {1, FE_KIND_JOINT, NULL, takes_force_of_joint, write_force_of_joint, 1},
        [FE_FIELD_JOINT_SPEED] = {1, FE_KIND_JOINT, NULL, takes_speed, write_speed, 0},
        [FE_FIELD_JOINT_TARGET] = {1, FE_KIND_JOINT, NULL, takes_target, write_target, 0},
        [FE_FIELD_REACTION] = {6, FE_KIND_JOINT, read_reaction, NULL, NULL, 0},
        [FE_FIELD_GRAVITY] = {3, 0, read_gravity, takes_gravity, write_gravity, 0},
        [FE_FIELD_CONTACT_FORCE] = {3, FE_KIND_BODY, read_contact_force, NULL, NULL, 0},
        [FE_FIELD_MASS] = {1, FE_KIND_BODY, read_mass, takes_mass, write_mass, 0},
        [FE_FIELD_FRICTION] = {2, FE_KIND_SHAPE, read_friction, takes_friction, write_friction, 0},
    };
    int32_t count = (int32_t)(sizeof fields / sizeof *fields);
    return field > 0 && field < count && fields[field].components ? fields + field : NULL;
}
