// Runs a case in an engine and keeps what judges ask for (trial.h).
#include "trial.h"

#include "memory.h"
#include "random.h"
#include "start.h"
#include "stats.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- geometry of poses ---------------------------------------------------------------------------------------------

static void rotate(const double *q, const double *v, double *out)
{
    double t[3];
    for (int k = 0; k < 3; k++) t[k] = 2.0 * (q[(k + 1) % 3] * v[(k + 2) % 3] - q[(k + 2) % 3] * v[(k + 1) % 3]);
    for (int k = 0; k < 3; k++)
        out[k] = v[k] + q[3] * t[k] + q[(k + 1) % 3] * t[(k + 2) % 3] - q[(k + 2) % 3] * t[(k + 1) % 3];
}

static void point_in_body(const bench_pose *pose, const double *point, double *out)
{
    const double back[4] = {-pose->rotation[0], -pose->rotation[1], -pose->rotation[2], pose->rotation[3]};
    double d[3];
    for (int k = 0; k < 3; k++) d[k] = point[k] - pose->position[k];
    rotate(back, d, out);
}

static void point_in_world(const bench_pose *pose, const double *arm, double *out)
{
    rotate(pose->rotation, arm, out);
    for (int k = 0; k < 3; k++) out[k] += pose->position[k];
}

static double length(const double *v) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static double horizontal_distance(const bench_pose *a, const bench_pose *b)
{
    return hypot(a->position[0] - b->position[0], a->position[2] - b->position[2]);
}

static double angle_of_y_axes(const bench_pose *a, const bench_pose *b)
{
    const double y[3] = {0.0, 1.0, 0.0};
    double u[3], v[3], cross[3], dot = 0.0;
    rotate(a->rotation, y, u);
    rotate(b->rotation, y, v);
    for (int k = 0; k < 3; k++) {
        cross[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
        dot += u[k] * v[k];
    }
    return atan2(length(cross), dot);
}

// ---- energy --------------------------------------------------------------------------------------------------------

// Principal moments in the body's frame, kg m2
static void inertia_of(const bench_shape *s, double mass, double *out)
{
    const double r = (double)s->radius, h = (double)s->half_height;
    if (s->form == BENCH_SPHERE) {
        out[0] = out[1] = out[2] = 0.4 * mass * r * r;
    } else if (s->form == BENCH_BOX) {
        for (int k = 0; k < 3; k++) {
            const double a = (double)s->half[(k + 1) % 3], b = (double)s->half[(k + 2) % 3];
            out[k] = mass * (a * a + b * b) / 3.0;
        }
    } else { // a cylinder of height 2 h and two half balls, whose centres of mass are 3/8 r beyond its ends
        const double cylinder = 2.0 * BENCH_PI * r * r * h, balls = 4.0 / 3.0 * BENCH_PI * r * r * r,
                     density = mass / (cylinder + balls);
        out[1] = density * (cylinder * 0.5 * r * r + balls * 0.4 * r * r);
        out[0] = out[2] =
            density * (cylinder * (0.25 * r * r + h * h / 3.0) + balls * (0.4 * r * r + h * h + 0.75 * h * r));
    }
}

static double kinetic_of(const bench_trial *t, int32_t i)
{
    const bench_body *body = &t->scene.bodies[i];
    const double mass = t->masses[i], *v = t->motions[i].linear, *q = t->poses[i].rotation;
    const double back[4] = {-q[0], -q[1], -q[2], q[3]};
    double inertia[3], w[3], sum = mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    inertia_of(&t->scene.shapes[body->shape], mass, inertia);
    rotate(back, t->motions[i].angular, w);
    for (int k = 0; k < 3; k++) sum += inertia[k] * w[k] * w[k];
    return 0.5 * sum;
}

static double potential_of(const bench_trial *t, int32_t i)
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) sum -= t->scene.gravity[k] * t->poses[i].position[k];
    return t->masses[i] * (double)t->scene.bodies[i].gravity_scale * sum;
}

// ---- records -------------------------------------------------------------------------------------------------------

static void note_track(bench_trial *t, int32_t i)
{
    bench_track *track = &t->tracks[i];
    const double y = t->poses[i].position[1];
    track->lowest = fmin(track->lowest, y);
    track->highest = fmax(track->highest, y);
    track->drift = fmax(track->drift, bench_drift(t, i));
    track->tilt = fmax(track->tilt, bench_tilt(t, i));
    track->speed = fmax(track->speed, bench_speed(t, i));
}

static double distance(const bench_pose *pose_a, const double *arm_a, const bench_pose *pose_b, const double *arm_b)
{
    double a[3], b[3], d[3];
    point_in_world(pose_a, arm_a, a);
    point_in_world(pose_b, arm_b, b);
    for (int k = 0; k < 3; k++) d[k] = a[k] - b[k];
    return length(d);
}

static void find_arms(const bench_scene *s, const bench_joint *j, double arms[2][3])
{
    point_in_body(&s->bodies[j->body_a].start, j->anchor, arms[0]);
    point_in_body(&s->bodies[j->body_b].start, j->is_open ? j->anchor_b : j->anchor, arms[1]);
}

static double gap_of(const bench_trial *t, int32_t joint)
{
    const bench_joint *j = &t->scene.joints[joint];
    if (t->away[j->body_a] || t->away[j->body_b]) return 0.0;
    if (j->kind == BENCH_SLIDER || j->kind == BENCH_DISTANCE) return 0.0; // their anchors may part
    return distance(&t->poses[j->body_a], t->arms[joint][0], &t->poses[j->body_b], t->arms[joint][1]);
}

double bench_joint_gap(const bench_scene *scene, const bench_pose *poses, int32_t joint)
{
    const bench_joint *j = &scene->joints[joint];
    double arms[2][3];
    find_arms(scene, j, arms);
    return distance(&poses[j->body_a], arms[0], &poses[j->body_b], arms[1]);
}

// Twice the energy over the gap's square, at most: the mass that moves when the anchors do, times the square of the
// joints' frequency
static double spring_of(const bench_trial *t, int32_t joint)
{
    const bench_joint *j = &t->scene.joints[joint];
    const double a = t->masses[j->body_a], b = t->masses[j->body_b],
                 w = 2.0 * BENCH_PI * fmax(60.0, j->stiffness_hertz);
    const double mass = a > 0.0 && b > 0.0 ? a * b / (a + b) : a + b;
    return mass * w * w;
}

static int all_finite(const bench_trial *t)
{
    for (int32_t i = 0; i < t->scene.body_count; i++) {
        const double *p = t->poses[i].position, *q = t->poses[i].rotation;
        if (t->away[i]) continue;
        if (!isfinite(p[0] + p[1] + p[2]) || !isfinite(q[0] + q[1] + q[2] + q[3])) return 0;
    }
    return 1;
}

static void record(bench_trial *t)
{
    t->engine->read_poses(t->world, t->poses);
    t->engine->read_motions(t->world, t->motions);
    t->finite = all_finite(t);
    double kinetic = 0.0, potential = 0.0, fastest = 0.0, gap = 0.0, gaps = 0.0, held = 0.0;
    for (int32_t i = 0; i < t->scene.body_count; i++) {
        if (!t->scene.bodies[i].dynamic || t->away[i]) continue;
        note_track(t, i);
        kinetic += kinetic_of(t, i);
        potential += potential_of(t, i);
        fastest = fmax(fastest, bench_speed(t, i));
    }
    for (int32_t i = 0; i < t->scene.joint_count; i++) {
        const double open = gap_of(t, i);
        gap = fmax(gap, open);
        gaps += open;
        held += 0.5 * spring_of(t, i) * open * open;
    }
    t->kinetic[t->step] = kinetic;
    t->energy[t->step] = kinetic + potential;
    t->held[t->step] = held;
    if (t->ruler_every > 0 && t->step % t->ruler_every != 0) t->held[t->step] = HUGE_VAL;
    if (t->ruler_every > 0 && t->step % t->ruler_every == 0 && t->finite) {
        bench_contacts contacts;
        bench_measure_contacts(t, &contacts);
        t->held[t->step] += contacts.held;
    }
    t->gap[t->step] = gap;
    t->gaps[t->step] = gaps;
    t->fastest[t->step] = fastest;
}

void bench_trial_forget(bench_trial *t)
{
    for (int32_t i = 0; i < t->scene.body_count; i++) t->tracks[i] = (bench_track){HUGE_VAL, -HUGE_VAL, 0.0, 0.0, 0.0};
}

// Motors drive to the end
static void note_drive(bench_trial *t)
{
    if (t->driven_until <= t->step) t->driven_until = t->step + 1;
}

void bench_trial_take_away(bench_trial *t, int32_t body)
{
    t->engine->take_away(t->world, body);
    t->away[body] = 1;
    note_drive(t); // what it had is gone
}

void bench_trial_bring_back(bench_trial *t, int32_t body)
{
    t->engine->bring_back(t->world, body, &t->scene.bodies[body].start);
    t->away[body] = 0;
    note_drive(t);
}

void bench_trial_push(bench_trial *t, int32_t body, const double *force)
{
    t->engine->add_force(t->world, body, force);
    note_drive(t);
}

void bench_trial_hit(bench_trial *t, int32_t body, const double *impulse, const double *point)
{
    t->engine->add_impulse(t->world, body, impulse, point);
    note_drive(t);
}

void bench_trial_set_gravity(bench_trial *t, const double *gravity)
{
    t->engine->set_gravity(t->world, gravity);
    note_drive(t);
}

// ---- a run ---------------------------------------------------------------------------------------------------------

const bench_case *bench_case_find(const char *name, int32_t *out_planar)
{
    for (int32_t i = 0; i < bench_case_count(); i++) {
        const bench_case *rule = bench_case_at(i);
        const size_t size = strlen(rule->name);
        if (strncmp(rule->name, name, size) != 0) continue;
        *out_planar = rule->planar && strcmp(name + size, "-2d") == 0;
        if ((name[size] == '\0' && rule->planar != BENCH_PLANAR_ONLY) || *out_planar) return rule;
    }
    return NULL;
}

static void prepare(bench_trial *t)
{
    const bench_scene *s = &t->scene;
    const size_t bodies = (size_t)s->body_count, steps = (size_t)t->step_count + 1;
    t->poses = bench_allocate(bodies, sizeof *t->poses);
    t->motions = bench_allocate(bodies, sizeof *t->motions);
    t->tracks = bench_allocate(bodies, sizeof *t->tracks);
    t->away = bench_allocate(bodies, sizeof *t->away);
    t->masses = bench_allocate(bodies, sizeof *t->masses);
    t->arms = bench_allocate((size_t)s->joint_count, sizeof *t->arms);
    t->energy = bench_allocate(steps, sizeof *t->energy);
    t->kinetic = bench_allocate(steps, sizeof *t->kinetic);
    t->held = bench_allocate(steps, sizeof *t->held);
    t->gap = bench_allocate(steps, sizeof *t->gap);
    t->gaps = bench_allocate(steps, sizeof *t->gaps);
    t->fastest = bench_allocate(steps, sizeof *t->fastest);
    for (int32_t i = 0; i < s->body_count; i++) {
        const bench_shape *shape = &s->shapes[s->bodies[i].shape];
        if (s->bodies[i].dynamic) t->masses[i] = (double)shape->density * bench_shape_volume(shape);
    }
    for (int32_t i = 0; i < s->joint_count; i++) {
        find_arms(s, &s->joints[i], t->arms[i]);
        if (s->joints[i].motor_speed != 0.0) t->driven_until = t->step_count;
    }
    bench_trial_forget(t);
}

void bench_trial_build(bench_scene *scene, const bench_case *rule, int32_t planar)
{
    memset(scene, 0, sizeof *scene);
    snprintf(scene->name, sizeof scene->name, "%s%s", rule->name, planar ? "-2d" : "");
    scene->gravity[1] = -10.0;
    scene->dt = 1.0f / 60.0f;
    rule->build(scene);
    if (planar) bench_make_planar(scene);
}

static int make_steps(bench_trial *t)
{
    record(t);
    while (t->step < t->step_count && t->finite) {
        if (t->rule->act != NULL) t->rule->act(t);
        const double start = bench_wall_ms();
        if (t->engine->step(t->world, t->scene.dt) != 0) return -1;
        t->ms += bench_wall_ms() - start;
        t->step++;
        t->time = t->step * (double)t->scene.dt;
        record(t);
        if (t->rule->watch != NULL) t->rule->watch(t);
    }
    return 0;
}

static double body_steps(const bench_trial *t)
{
    int32_t dynamic = 0;
    for (int32_t i = 0; i < t->scene.body_count; i++) dynamic += t->scene.bodies[i].dynamic != 0;
    return (double)t->step_count * dynamic;
}

static const double RULED = 2e5; // bodies times steps whose contacts are measured

// By a micrometre at most, along what is not locked
static void nudge(bench_scene *s, int32_t variant)
{
    const double most = 1e-6; // m
    uint64_t state = 0x9e3779b97f4a7c15u * (uint64_t)variant;
    for (int32_t i = 0; i < s->body_count && variant > 0; i++) {
        for (int k = 0; k < 3; k++) {
            const double way = most * (2.0 * bench_random(&state) - 1.0);
            if (s->bodies[i].dynamic && !(s->bodies[i].linear_locks >> k & 1)) s->bodies[i].start.position[k] += way;
        }
    }
}

int bench_trial_run(bench_trial *t, const bench_setup *setup)
{
    const bench_case *rule = setup->rule;
    const bench_engine *engine = setup->engine;
    memset(t, 0, sizeof *t);
    t->rule = rule;
    t->engine = engine;
    t->workers = setup->workers;
    t->substeps = setup->substeps;
    t->variants = 1;
    for (int32_t i = 0; i < BENCH_MEASURES; i++) t->measures[i] = (double)NAN;
    bench_trial_build(&t->scene, rule, setup->planar);
    nudge(&t->scene, setup->variant);
    t->step_count = (int32_t)lround(rule->seconds / (double)t->scene.dt);
    prepare(t);
    if (engine->body_steps > 0.0 && body_steps(t) > engine->body_steps) {
        bench_expect(t, BENCH_TOO_LONG, body_steps(t), 0.0, engine->body_steps);
        t->is_too_long = 1;
        return 0;
    }
    if (setup->measured) t->ruler_every = 1 + (int32_t)((double)t->step_count * t->scene.body_count / RULED);
    t->world = engine->create(&t->scene, setup->workers, setup->substeps);
    if (t->world == NULL || bench_check_start(engine, t->world, &t->scene) != 0 || make_steps(t) != 0) return -1;
    if (t->finite)
        rule->judge(t);
    else
        bench_expect(t, "steps until a pose was NaN or infinite", t->step, t->step_count, t->step_count);
    if (setup->measured) bench_measure(t);
    if (engine->read_hash != NULL) t->hash = engine->read_hash(t->world);
    return 0;
}

void bench_trial_free(bench_trial *t)
{
    void *owned[] = {t->poses,  t->motions, t->tracks, t->away, t->masses, t->arms,
                     t->energy, t->kinetic, t->held,   t->gap,  t->gaps,   t->fastest};
    if (t->world != NULL) t->engine->destroy(t->world);
    for (size_t i = 0; i < sizeof owned / sizeof owned[0]; i++) free(owned[i]);
    bench_scene_destroy(&t->scene);
    memset(t, 0, sizeof *t);
}

int32_t bench_check_passed(const bench_trial *t, const bench_check *c)
{
    if ((c->kind == BENCH_OWN || c->kind == BENCH_OWN_OPEN) && !t->engine->has_workers) return 1;
    return c->value >= c->low && c->value <= c->high;
}

int32_t bench_trial_passed(const bench_trial *t)
{
    for (int32_t i = 0; i < t->check_count; i++) {
        if (!bench_check_passed(t, &t->checks[i])) return 0;
    }
    return 1;
}

// ---- for judges ----------------------------------------------------------------------------------------------------

const char *const bench_kind_names[] = {"law", "own", "stray", "open", "own open"};

static void add_check(bench_trial *t, bench_check check)
{
    if (t->check_count == BENCH_MAX_CHECKS) {
        fprintf(stderr, "feather-bench: %s has more than %d checks\n", t->scene.name, BENCH_MAX_CHECKS);
        exit(1);
    }
    t->checks[t->check_count++] = check;
}

void bench_expect(bench_trial *t, const char *what, double value, double low, double high)
{
    add_check(t, (bench_check){what, value, low, high, BENCH_LAW, value, value});
}

void bench_expect_own(bench_trial *t, const char *what, double value, double low, double high)
{
    add_check(t, (bench_check){what, value, low, high, BENCH_OWN, value, value});
}

void bench_expect_stray(bench_trial *t, const char *what, double value, double most)
{
    add_check(t, (bench_check){what, value, 0.0, most, BENCH_STRAY, value, value});
}

void bench_expect_open(bench_trial *t, const char *what, double value, double most)
{
    add_check(t, (bench_check){what, value, 0.0, most, BENCH_OPEN, value, value});
}

void bench_expect_own_open(bench_trial *t, const char *what, double value, double most)
{
    add_check(t, (bench_check){what, value, 0.0, most, BENCH_OWN_OPEN, value, value});
}

double bench_tilt(const bench_trial *t, int32_t i) { return angle_of_y_axes(&t->poses[i], &t->scene.bodies[i].start); }

double bench_drift(const bench_trial *t, int32_t i)
{
    return horizontal_distance(&t->poses[i], &t->scene.bodies[i].start);
}

double bench_speed(const bench_trial *t, int32_t i) { return length(t->motions[i].linear); }

static double largest(const bench_trial *t, double (*of)(const bench_trial *, int32_t))
{
    double most = 0.0;
    for (int32_t i = 0; i < t->scene.body_count; i++) {
        if (t->scene.bodies[i].dynamic && !t->away[i]) most = fmax(most, of(t, i));
    }
    return most;
}

double bench_largest_tilt(const bench_trial *t) { return largest(t, bench_tilt); }

double bench_largest_drift(const bench_trial *t) { return largest(t, bench_drift); }

double bench_largest_speed(const bench_trial *t) { return largest(t, bench_speed); }

double bench_highest(const double *series, int32_t from, int32_t to)
{
    double most = -HUGE_VAL;
    for (int32_t i = from; i <= to; i++) most = fmax(most, series[i]);
    return most;
}

double bench_rms(const double *series, int32_t from, int32_t to)
{
    double sum = 0.0;
    for (int32_t i = from; i <= to; i++) sum += series[i] * series[i];
    return sqrt(sum / (to - from + 1));
}

double bench_rise(const double *series, int32_t from, int32_t to)
{
    double low = series[from], rise = 0.0;
    for (int32_t i = from; i <= to; i++) {
        rise = fmax(rise, series[i] - low);
        low = fmin(low, series[i]);
    }
    return rise;
}

int32_t bench_step_at(const bench_trial *t, double seconds)
{
    const int32_t step = (int32_t)lround(seconds / (double)t->scene.dt);
    return step < t->step ? step : t->step;
}

// The same ruler for all engines: Feather's narrow phase on the poses, which moves nothing in a step of no time.
void bench_measure_contacts(const bench_trial *t, bench_contacts *out_contacts)
{
    bench_scene copy = t->scene;
    *out_contacts = (bench_contacts){0, 0, 0.0, 0.0};
    copy.joint_count = 0;
    copy.bodies = bench_allocate((size_t)copy.body_count, sizeof *copy.bodies);
    for (int32_t i = 0; i < copy.body_count; i++) {
        copy.bodies[i] = t->scene.bodies[i];
        copy.bodies[i].start = t->poses[i];
        copy.bodies[i].collides &= !t->away[i];
    }
    bench_world *ruler = bench_feather.create(&copy, 1, 1);
    if (ruler != NULL) {
        bench_feather.measure_contacts(ruler, out_contacts);
        bench_feather.destroy(ruler);
    }
    free(copy.bodies);
}

double bench_deepest(const bench_trial *t)
{
    bench_contacts contacts;
    bench_measure_contacts(t, &contacts);
    return contacts.deepest;
}

static double stiffness(double hertz, double share, const bench_trial *t)
{
    const double rate = t->substeps / (double)t->scene.dt, w = 2.0 * BENCH_PI * fmin(hertz, share * rate);
    return w * w;
}

double bench_contact_stiffness(const bench_trial *t, int32_t against_static)
{
    return stiffness(30.0, 0.125, t) * (against_static ? 4.0 : 1.0);
}

double bench_joint_stiffness(const bench_trial *t) { return stiffness(60.0, 0.225, t); }

double bench_face_factor(const bench_trial *t) { return t->scene.planar ? 0.625 : 1.0; }
