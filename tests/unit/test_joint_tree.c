// The tree solver by itself: what it locks against differences of its errors, its elimination against a dense solution
// of the same system J M^-1 J^T l = -J v in this file. No sweep: the locks are scalars in an array. Its kernel is
// compiled into this file, so that what it holds can be read; the tree is in its first lane.
#include "../fe_test.h"

#define FE_PLAIN_C 1
#define FE_W 4
#define FE_SIMD_SET unit
#include "solver/tree/tree_solver.simd.c"

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

enum { MOST_LINKS = 32, MOST_ROWS = 6 * MOST_LINKS, DOFS = 6 * MOST_LINKS };

// ---- a tree of locks in an array -----------------------------------------------------------------------------------
// with what a row of points keeps of a lane, as the trees reach for it
typedef struct lock_row {
    fe__lock lock;
    float impulse[3][FE_W], total[3][FE_W];
} lock_row;

typedef struct rig {
    fe__solver solver;
    fe__velocity_line velocity[MOST_LINKS + 1]; // line 0 is the world
    fe__motion_line motion[MOST_LINKS + 1];
    fe__start_line start[MOST_LINKS + 1];
    fe__inertia_line inertia_line[MOST_LINKS + 1];
    fe__joints joints;
    fe__joint_tree tree;
    fe__tree_link links[MOST_LINKS];
    fe__tree_place places[MOST_LINKS];
    fe__body bodies[MOST_LINKS + 1]; // by line
    lock_row locks[MOST_LINKS];
    fe__sym3 inertia[MOST_LINKS + 1];
    int32_t opens; // what is said of every lock
    fe__tree_name trees[1];
    fe__records records; // 0
    bundle head;         // and, right behind it, the nodes
    tree_node nodes[MOST_LINKS];
    fe__tree_job job;
    uint32_t random;
} rig;

static rig the; // one at a time: large, and its lanes find it here

static void read_scalar(int32_t part, const void *row, int32_t lane, fe__lock *out_lock)
{
    (void)part, (void)lane;
    memcpy(out_lock, row, sizeof *out_lock);
}

static int32_t rows_of(int32_t part) { return part == FE__PART_DISTANCE ? 1 : part == FE__PART_HINGE ? 2 : 3; }

static int32_t add_scalar(int32_t part, void *row, int32_t lane, const double *impulse, int32_t total)
{
    (void)row, (void)lane, (void)impulse, (void)total;
    return rows_of(part);
}

static int32_t take_scalar(int32_t part, void *row, int32_t lane, double *impulse)
{
    (void)row, (void)lane;
    for (int32_t k = 0; k < rows_of(part); ++k) impulse[k] = 0.0;
    return rows_of(part);
}

static float wide_open(int32_t part, const void *row, int32_t lane)
{
    (void)part, (void)row, (void)lane;
    return the.opens ? FLT_MAX : 0.0f;
}

static float opening(int32_t part, const void *row, int32_t lane, const fe__velocity_line *a,
                     const fe__velocity_line *b)
{
    (void)a, (void)b;
    return wide_open(part, row, lane);
}

static const fe__lock_lanes lanes = {FE_W,
                                     offsetof(lock_row, impulse) / sizeof(float),
                                     (offsetof(lock_row, total) - offsetof(lock_row, impulse)) / sizeof(float),
                                     read_scalar,
                                     add_scalar,
                                     take_scalar,
                                     wide_open,
                                     opening};

static double any(double low, double high)
{
    the.random = the.random * 1664525u + 1013904223u;
    return low + (high - low) * (double)(the.random >> 8) / 16777216.0;
}

static fe_vec3 any_vector(double most)
{
    float x = (float)any(-most, most), y = (float)any(-most, most), z = (float)any(-most, most);
    return fe__vec3(x, y, z);
}

static fe_quat any_rotation(void)
{
    return fe__normalized((fe_quat){(float)any(-1, 1), (float)any(-1, 1), (float)any(-1, 1), (float)any(-1, 1)});
}

static void begin(uint32_t seed)
{
    memset(&the, 0, sizeof the);
    the.random = seed;
    the.solver.velocity = the.velocity, the.solver.motion = the.motion, the.solver.start = the.start;
    the.solver.inertia = the.inertia_line, the.solver.places = the.places;
    for (int32_t i = 0; i <= MOST_LINKS; ++i) the.motion[i].rotation[3] = 1.0f;
    the.joints.forest = (fe__forest){.trees = &the.tree, .links = the.links, .tree_count = 1};
    the.tree.kind = FE__TREE_HEAVY;
    the.records = (fe__records){.bodies = the.bodies, .joints = the.joints, .engaged = &the.solver.engaged};
    the.job = (fe__tree_job){.solver = &the.solver,
                             .of = &the.records,
                             .trees = the.trees,
                             .count = 1,
                             .rows = (unsigned char *)the.locks,
                             .nodes = (unsigned char *)&the.head,
                             .h = 1.0 / 240.0,
                             .rate = 0.1,
                             .mean = 60.0};
}

// as the world says it
static int32_t form_of(int32_t part)
{
    switch (part) {
    case FE__PART_POINT:
        return FE__TREE_BALL;
    case FE__PART_SLIDE:
        return FE__TREE_ABOUT;
    case FE__PART_HINGE:
        return FE__TREE_ALONG | 8;
    case FE__PART_FIXED:
        return FE__TREE_ALONG;
    default:
        return 6 | FE__TREE_ABOUT | FE__TREE_ROD;
    }
}

// the next link, of a body of that mass and inertia, held by a part to a parent or, -1, to the world
static fe__lock *add_link(int32_t parent, int32_t holds_b, int32_t part, float mass, fe__sym3 inverse_inertia)
{
    int32_t i = the.tree.count++, line = i + 1, above = parent + 1;
    fe__lock *lock = &the.locks[i].lock;
    the.velocity[line].inverse_mass = 1.0f / mass;
    the.inertia[line] = the.inertia_line[line].inverse = inverse_inertia;
    the.links[i] =
        (fe__tree_link){.body = line, .joint = line, .parent = parent, .holds_b = holds_b, .form = form_of(part)};
    the.places[i] = (fe__tree_place){.line = line, .parent_line = above, .locks = 1};
    the.places[i].lock[0].of = &lanes;
    the.places[i].lock[0].part = part;
    the.places[i].lock[0].row = (int64_t)((unsigned char *)lock - (unsigned char *)the.locks);
    lock->line_a = holds_b ? above : line, lock->line_b = holds_b ? line : above;
    lock->frame = fe__identity();
    return lock;
}

// R diag R^T of moments between 0.2 and 1 of the mass
static fe__sym3 any_inertia(float mass)
{
    fe__mat3 r = fe__matrix(any_rotation());
    float x = 1.0f / (mass * (float)any(0.2, 1.0)), y = 1.0f / (mass * (float)any(0.2, 1.0)),
          z = 1.0f / (mass * (float)any(0.2, 1.0));
    const float *c[3] = {&r.x.x, &r.y.x, &r.z.x};
    float m[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) m[i][j] = x * c[0][i] * c[0][j] + y * c[1][i] * c[1][j] + z * c[2][i] * c[2][j];
    return (fe__sym3){m[0][0], m[0][1], m[0][2], m[1][1], m[1][2], m[2][2]};
}

static void set_velocity(int32_t line, fe_vec3 v, fe_vec3 w)
{
    fe__velocity_line *l = the.velocity + line;
    l->v[0] = v.x, l->v[1] = v.y, l->v[2] = v.z, l->w[0] = w.x, l->w[1] = w.y, l->w[2] = w.z;
}

// a ball joint with arms of up to half a metre; velocities of a metre a second
static void add_ball(int32_t parent, float mass)
{
    fe__lock *lock = add_link(parent, any(0, 1) < 0.5, FE__PART_POINT, mass, any_inertia(mass));
    lock->arm_a = any_vector(0.5), lock->arm_b = any_vector(0.5);
    set_velocity(the.tree.count, any_vector(1.0), any_vector(1.0));
}

// the root of a tree that hangs on nothing
static void add_free_root(float mass)
{
    add_link(-1, 1, FE__PART_POINT, mass, any_inertia(mass));
    the.places[0].locks = 0, the.links[0].joint = 0, the.links[0].form = FE__TREE_ALONG | FE__TREE_ABOUT;
    set_velocity(1, any_vector(1.0), any_vector(1.0));
}

// ---- the dense system ----------------------------------------------------------------------------------------------
typedef struct dense {
    int32_t rows;
    double j[MOST_ROWS][DOFS], mj[MOST_ROWS][DOFS]; // J, M^-1 J^T by row
    double a[MOST_ROWS][MOST_ROWS], b[MOST_ROWS], l[MOST_ROWS], u[DOFS];
    double condition; // of A, in the sum norm
} dense;

static dense by_hand;

static double norm(double (*a)[MOST_ROWS], int32_t n)
{
    double most = 0.0;
    for (int32_t i = 0; i < n; ++i) {
        double sum = 0.0;
        for (int32_t k = 0; k < n; ++k) sum += fabs(a[i][k]);
        most = fmax(most, sum);
    }
    return most;
}

// the inverse of a, by Gauss and Jordan with pivots
static void invert_densely(double (*a)[MOST_ROWS], int32_t n, double (*out)[MOST_ROWS])
{
    for (int32_t i = 0; i < n; ++i)
        for (int32_t k = 0; k < n; ++k) out[i][k] = i == k;
    for (int32_t c = 0; c < n; ++c) {
        int32_t pivot = c;
        for (int32_t r = c; r < n; ++r)
            if (fabs(a[r][c]) > fabs(a[pivot][c])) pivot = r;
        for (int32_t k = 0; k < n; ++k) {
            double x = a[c][k], y = out[c][k];
            a[c][k] = a[pivot][k], a[pivot][k] = x, out[c][k] = out[pivot][k], out[pivot][k] = y;
        }
        double inverse = 1.0 / a[c][c];
        for (int32_t k = 0; k < n; ++k) a[c][k] *= inverse, out[c][k] *= inverse;
        for (int32_t r = 0; r < n; ++r) {
            double f = r == c ? 0.0 : a[r][c];
            for (int32_t k = 0; k < n && f != 0.0; ++k) a[r][k] -= f * a[c][k], out[r][k] -= f * out[c][k];
        }
    }
}

// M^-1 of a body times a row, without what it has locked
static void respond(int32_t line, const double *row, double *out)
{
    const fe__sym3 *i = the.inertia + line;
    const int32_t locks = (int32_t)the.velocity[line].lock_bits;
    const double m = (double)the.velocity[line].inverse_mass;
    for (int k = 0; k < 3; ++k) out[k] = locks >> k & 1 ? 0.0 : m * row[k];
    out[3] = (double)i->xx * row[3] + (double)i->xy * row[4] + (double)i->xz * row[5];
    out[4] = (double)i->xy * row[3] + (double)i->yy * row[4] + (double)i->yz * row[5];
    out[5] = (double)i->xz * row[3] + (double)i->yz * row[4] + (double)i->zz * row[5];
}

// J (v + M^-1 J^T l) = 0 of the rows that are there
static void solve_rows(void)
{
    static double scratch[MOST_ROWS][MOST_ROWS], inverse[MOST_ROWS][MOST_ROWS];
    dense *d = &by_hand;
    for (int32_t r = 0; r < d->rows; ++r)
        for (int32_t i = 0; i < the.tree.count; ++i) {
            const fe__velocity_line *line = the.velocity + i + 1;
            respond(i + 1, d->j[r] + 6 * i, d->mj[r] + 6 * i);
            for (int k = 0; k < 3; ++k)
                d->b[r] -= d->j[r][6 * i + k] * (double)line->v[k] + d->j[r][6 * i + 3 + k] * (double)line->w[k];
        }
    for (int32_t r = 0; r < d->rows; ++r)
        for (int32_t c = 0; c < d->rows; ++c)
            for (int32_t k = 0; k < 6 * the.tree.count; ++k) d->a[r][c] += d->j[r][k] * d->mj[c][k];
    memcpy(scratch, d->a, sizeof scratch);
    invert_densely(scratch, d->rows, inverse);
    d->condition = norm(d->a, d->rows) * norm(inverse, d->rows);
    for (int32_t r = 0; r < d->rows; ++r)
        for (int32_t c = 0; c < d->rows; ++c) d->l[r] += inverse[r][c] * d->b[c];
    for (int32_t r = 0; r < d->rows; ++r)
        for (int32_t k = 0; k < 6 * the.tree.count; ++k) d->u[k] += d->mj[r][k] * d->l[r];
}

// Rows of ball joints along the axes of `axes` (bits)
static void solve_densely(int32_t axes)
{
    dense *d = &by_hand;
    memset(d, 0, sizeof *d);
    for (int32_t i = 0; i < the.tree.count; ++i) {
        const fe__lock *lock = &the.locks[i].lock;
        for (int k = 0; k < 3 && the.places[i].locks; ++k) {
            if (!(axes >> k & 1)) continue;
            const fe_dvec3 e = {k == 0, k == 1, k == 2}, ma = fe__dcross(fe__widen(lock->arm_a), e),
                           mb = fe__dcross(fe__widen(lock->arm_b), e);
            const double a[6] = {-e.x, -e.y, -e.z, -ma.x, -ma.y, -ma.z}, b[6] = {e.x, e.y, e.z, mb.x, mb.y, mb.z};
            if (lock->line_a) memcpy(d->j[d->rows] + 6 * (lock->line_a - 1), a, sizeof a);
            if (lock->line_b) memcpy(d->j[d->rows] + 6 * (lock->line_b - 1), b, sizeof b);
            ++d->rows;
        }
    }
    solve_rows();
}

// ---- comparison ----------------------------------------------------------------------------------------------------
// masses and axes where the bodies are now
static pass read_now(void)
{
    pass t = pass_of(&the.job);
    the.head.loaded = 0;
    load_bundle(&t);
    for (int32_t i = 0; i < t.count; ++i) read_node(&t, i, ALL_LANES, t.lanes), lay_masses(&t, i);
    return t;
}

static void solve_tree(void)
{
    const pass t = read_now();
    for (int32_t i = 0; i < t.count; ++i) the.nodes[i].damping = r_set(0.0);
    for (int32_t i = t.count - 1; i >= 0; --i) eliminate_joint(&t, i);
    for (int32_t i = 0; i < t.count; ++i) request_rest(&t, i);
    meet_requests(&t, SPEEDS);
}

// of a body's centre, and of its rotation
static void change_of(int32_t i, double out[6])
{
    const tree_node *n = the.nodes + i;
    const real3 v = centre_change(n, SPEEDS);
    for (int k = 0; k < 3; ++k) out[k] = get_lane(&v.x + k, 0), out[3 + k] = get_lane(&n->of[SPEEDS].change_w.x + k, 0);
}

// on B of a joint
static double impulse_of(int32_t i, int32_t k)
{
    return (the.links[i].holds_b ? 1.0 : -1.0) * get_lane(&the.nodes[i].impulse_v.x + k, 0);
}

// An elimination of n rows whose pivots do not grow errs by some n eps, times the condition of the matrix. The inverse
// inertias are inverted and back, by 6 x 6 matrices of a condition below 100, which the arms carry over.
static double allowed(void) { return 1000.0 * by_hand.rows * DBL_EPSILON * by_hand.condition; }

static double largest(const double *a, int32_t n)
{
    double most = 0.0;
    for (int32_t k = 0; k < n; ++k) most = fmax(most, fabs(a[k]));
    return most;
}

// u and l of the tree are those of the dense solution of those axes, and J (v + u) is 0
static void compare(int32_t axes)
{
    const dense *d = &by_hand;
    double most_u = largest(d->u, 6 * the.tree.count), most_l = largest(d->l, d->rows);
    static double u[DOFS];
    FE_TRUE(allowed() < 1e-3 && most_u > 0.0);
    for (int32_t i = 0, row = 0; i < the.tree.count; ++i) {
        change_of(i, u + 6 * i);
        for (int k = 0; k < 6; ++k) FE_NEAR(u[6 * i + k], d->u[6 * i + k], allowed() * most_u);
        for (int k = 0; k < 3 && the.places[i].locks; ++k)
            if (axes >> k & 1) FE_NEAR(impulse_of(i, k), d->l[row++], allowed() * most_l);
    }
    for (int32_t r = 0; r < d->rows; ++r) {
        double left = -d->b[r], of = fabs(d->b[r]);
        for (int32_t k = 0; k < 6 * the.tree.count; ++k) left += d->j[r][k] * u[k], of += fabs(d->j[r][k] * u[k]);
        FE_NEAR(left, 0.0, 1e4 * d->rows * DBL_EPSILON * (of + most_u));
    }
}

// Two thin rods of 1 m and 1 kg, end to end and level, fall from rest. Lagrange's equations of the double pendulum give
// the angular accelerations 9/7 g/L and -3/7 g/L downwards.
static void two_level_rods_begin_to_fall_as_lagrange_says(void **state)
{
    (void)state;
    const float g = 10.0f, h = 1.0f / 240.0f;
    const fe__sym3 rod = {1000.0f, 0.0f, 0.0f, 12.0f, 0.0f, 12.0f};
    begin(1);
    for (int32_t i = 0; i < 2; ++i) {
        fe__lock *lock = add_link(i - 1, 1, FE__PART_POINT, 1.0f, rod);
        lock->arm_a = fe__vec3(i ? 0.5f : 0.0f, 0.0f, 0.0f), lock->arm_b = fe__vec3(-0.5f, 0.0f, 0.0f);
        set_velocity(i + 1, fe__vec3(0.0f, -g * h, 0.0f), fe__vec3(0.0f, 0.0f, 0.0f));
    }
    solve_tree();
    // the velocities -g h are floats
    FE_NEAR(get_lane(&the.nodes[0].of[SPEEDS].change_w.z, 0), -9.0 / 7.0 * (double)(g * h), 1e-7 * (double)(g * h));
    FE_NEAR(get_lane(&the.nodes[1].of[SPEEDS].change_w.z, 0), 3.0 / 7.0 * (double)(g * h), 1e-7 * (double)(g * h));
}

static void chains_and_trees_are_solved_as_by_gauss(void **state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 60; ++seed) {
        const int32_t is_chain = seed % 2 != 0, is_free = seed % 3 == 0, links = 1 + (int32_t)(seed % 30);
        begin(seed);
        if (is_free) add_free_root(1.0f);
        for (int32_t i = is_free; i < links + is_free; ++i)
            add_ball(is_chain || i == 0 ? i - 1 : (int32_t)any(0, i - 0.01), (float)any(0.5, 2.0));
        solve_densely(7);
        solve_tree();
        compare(7);
    }
}

// The end weighs ten thousand links
static void chains_with_a_heavy_end_are_solved_as_by_gauss(void **state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 20; ++seed) {
        const int32_t is_free = seed % 2 == 0;
        begin(seed);
        if (is_free) add_free_root(1.0f);
        for (int32_t i = is_free; i < 20; ++i) add_ball(i - 1, i == 19 ? 1e4f : 1.0f);
        solve_densely(7);
        solve_tree();
        compare(7);
    }
}

// ---- locks ---------------------------------------------------------------------------------------------------------
// What a lock leaves of an inverse inertia: the inverse of the block of R I R^T over the free axes. With one axis k
// locked that is I^-1 less its part through k.
static fe__sym3 lock_axis(fe__sym3 i, int k)
{
    float m[3][3] = {{i.xx, i.xy, i.xz}, {i.xy, i.yy, i.yz}, {i.xz, i.yz, i.zz}}, out[3][3];
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) out[r][c] = r == k || c == k ? 0.0f : m[r][c] - m[r][k] * m[k][c] / m[k][k];
    return (fe__sym3){out[0][0], out[0][1], out[0][2], out[1][1], out[1][2], out[2][2]};
}

// Bodies that may not turn, or in a plane only, or along some axes: the freedoms that the world lets a tree lock
static void locked_bodies_are_solved_as_by_gauss(void **state)
{
    static const struct {
        int32_t locks, axes; // of the joints' rows, those that respond
    } cases[] = {{1 << 3 | 1 << 4 | 1 << 5, 7},
                 {1 << 3 | 1 << 4, 7},
                 {1 << 2 | 1 << 3 | 1 << 4, 3},
                 {1 << 1 | 1 << 3 | 1 << 4 | 1 << 5, 5},
                 {1 << 0 | 1 << 1 | 1 << 3 | 1 << 4 | 1 << 5, 4}};
    (void)state;
    for (uint32_t seed = 1; seed <= 20; ++seed) {
        const int32_t locks = cases[seed % 5].locks, axes = cases[seed % 5].axes;
        begin(seed);
        the.tree.locks = (uint32_t)locks;
        for (int32_t i = 0; i < 12; ++i) {
            const float mass = (float)any(0.5, 2.0);
            fe__sym3 inertia = any_inertia(mass);
            for (int k = 0; k < 3; ++k)
                if (locks >> (3 + k) & 1) inertia = lock_axis(inertia, k);
            fe__lock *joint = add_link(i - 1, i % 2, FE__PART_SLIDE, mass, inertia);
            for (int k = 0; k < 3; ++k) joint->keeps[k] = 1.0f;
            joint->arm_a = any_vector(0.5), joint->arm_b = any_vector(0.5);
            set_velocity(i + 1, any_vector(1.0), any_vector(1.0));
            fe__velocity_line *line = the.velocity + i + 1;
            line->lock_bits = (float)locks;
            for (int k = 0; k < 6; ++k)
                if (locks >> k & 1) (k < 3 ? line->v : line->w)[k % 3] = 0.0f;
        }
        solve_densely(axes);
        solve_tree();
        compare(axes);
        for (int32_t i = 0; i < the.tree.count; ++i) {
            double u[6];
            change_of(i, u);
            for (int k = 0; k < 6; ++k)
                if (locks >> k & 1) FE_TRUE(u[k] == 0.0);
            for (int k = 0; k < 3; ++k)
                if (!(axes >> k & 1)) FE_TRUE(impulse_of(i, k) == 0.0);
        }
    }
}

// ---- rows ----------------------------------------------------------------------------------------------------------
static void nudge(int32_t line, int32_t k, float by)
{
    fe__motion_line *m = the.motion + line;
    if (k < 3) {
        m->shift[k] += by;
        return;
    }
    fe_quat turn = {k == 3 ? 0.5f * by : 0.0f, k == 4 ? 0.5f * by : 0.0f, k == 5 ? 0.5f * by : 0.0f, 1.0f};
    turn = fe__normalized(fe__product(turn, fe__quat_of(m->rotation)));
    m->rotation[0] = turn.x, m->rotation[1] = turn.y, m->rotation[2] = turn.z, m->rotation[3] = turn.w;
}

// where the errors of angular locks are 0: their rows are gradients there
static void aim(fe__lock *lock, int32_t part)
{
    const fe_quat a = any_rotation();
    const fe_vec3 zero = {0.0f, 0.0f, 0.0f};
    lock->frame = part == FE__PART_FIXED ? fe__identity() : a;
    lock->arm_a = any_vector(0.5), lock->arm_b = any_vector(0.5),
    lock->gap = part == FE__PART_DISTANCE ? any_vector(1.0) : zero;
    lock->length = 0.3f;
    lock->axis_b = fe__rotate(a, fe__vec3(1.0f, 0.0f, 0.0f));
    lock->t1 = fe__rotate(a, fe__vec3(0.0f, 1.0f, 0.0f)), lock->t2 = fe__rotate(a, fe__vec3(0.0f, 0.0f, 1.0f));
    lock->keeps[0] = 1.0f, lock->keeps[1] = 0.0f, lock->keeps[2] = 1.0f;
    if (part == FE__PART_SLIDE) lock->gap = fe__scale(0.4f, lock->t1); // along the free axis
}

// what a joint locks: the velocity along u, or the spin about it, of the body below against the one above
typedef struct row {
    fe_dvec3 u;
    int32_t turns;
} row;

static int32_t rows_of_link(int32_t i, row out[6])
{
    const tree_node *n = the.nodes + i;
    const int32_t form = the.links[i].form;
    int32_t count = 0;
    for (int k = 0; k < 3; ++k)
        if (!(form >> k & 1)) out[count++] = (row){form == FE__TREE_BALL ? unit(k) : get_lane3(n->lin + k, 0), 0};
    for (int k = 0; k < 3; ++k)
        if (!(form >> (3 + k) & 1) && form != FE__TREE_BALL) out[count++] = (row){get_lane3(n->ang + k, 0), 1};
    return count;
}

static double error_of(const row *r)
{
    return fe__ddot(r->u, get_lane3(r->turns ? &the.nodes[1].swing : &the.nodes[1].gap, 0));
}

// its derivative by the motion along axis k of the body below, or of the one above
static double slope_of(int32_t i, const row *r, int32_t k, int32_t below)
{
    const fe_dvec3 arm = get_lane3(below ? &the.nodes[i].below : &the.nodes[i].above, 0);
    const fe_dvec3 by = k < 3 ? unit(k) : fe__dcross(unit(k - 3), arm);
    const double slope = r->turns ? (k < 3 ? 0.0 : fe__ddot(r->u, unit(k - 3))) : fe__ddot(r->u, by);
    return below ? slope : -slope;
}

// Each row is the gradient of its error. Differences over 2 e err by e^2 times third derivatives, at most of 1 / 0.3^2
// for a rod, and by what a float of a position loses, 1e-7, over e.
static void rows_are_gradients_of_their_errors(void **state)
{
    static const int32_t parts[] = {FE__PART_POINT, FE__PART_SLIDE, FE__PART_HINGE, FE__PART_FIXED, FE__PART_DISTANCE};
    const float e = 0.01f;
    (void)state;
    for (uint32_t seed = 1; seed <= 10; ++seed)
        for (size_t p = 0; p < sizeof parts / sizeof *parts; ++p) {
            begin(seed);
            add_free_root(1.0f);
            aim(add_link(0, seed % 2 != 0, parts[p], 1.0f, any_inertia(1.0f)), parts[p]);
            if (parts[p] == FE__PART_SLIDE) the.links[1].form |= 1 << 1; // as `aim` says
            row rows[6], turned[6];
            (void)read_now();
            const int32_t count = rows_of_link(1, rows);
            const tree_node there = the.nodes[1];
            FE_TRUE(count == (parts[p] == FE__PART_SLIDE ? 2 : rows_of(parts[p])));
            for (int32_t k = 0; k < 12; ++k) {
                double before[6];
                const int32_t line = k < 6 ? 2 : 1; // of the body below, above
                const fe__motion_line was = the.motion[line];
                nudge(line, k % 6, -e);
                (void)read_now();
                (void)rows_of_link(1, turned);
                for (int32_t r = 0; r < count; ++r) before[r] = error_of(turned + r);
                the.motion[line] = was;
                nudge(line, k % 6, e);
                (void)read_now();
                (void)rows_of_link(1, turned);
                the.motion[line] = was;
                double slope[6];
                for (int32_t r = 0; r < count; ++r) slope[r] = (error_of(turned + r) - before[r]) / (2.0 * (double)e);
                the.nodes[1] = there;
                for (int32_t r = 0; r < count; ++r)
                    FE_NEAR(slope_of(1, rows + r, k % 6, k < 6), slope[r], 11.0 * (double)(e * e) + 2e-7 / (double)e);
            }
        }
}

// Trees of all kinds of joints, by those rows
static void all_kinds_are_solved_as_by_gauss(void **state)
{
    static const int32_t parts[] = {FE__PART_POINT, FE__PART_SLIDE, FE__PART_HINGE, FE__PART_FIXED, FE__PART_DISTANCE};
    (void)state;
    for (uint32_t seed = 1; seed <= 40; ++seed) {
        const int32_t is_free = seed % 2 != 0;
        begin(seed);
        if (is_free) add_free_root(1.0f);
        for (int32_t i = is_free; i < 16; ++i) {
            const float mass = (float)any(0.5, 2.0);
            const int32_t part = parts[(uint32_t)i * seed % 5],
                          parent = seed % 4 < 2 ? i - 1 : (int32_t)any(-0.99, i - 0.01);
            aim(add_link(i == 0                 ? -1
                         : parent < is_free - 1 ? 0
                                                : parent,
                         any(0, 1) < 0.5, part, mass, any_inertia(mass)),
                part);
            if (part == FE__PART_SLIDE) the.links[i].form |= 1 << 1; // as `aim` says
            set_velocity(i + 1, any_vector(1.0), any_vector(1.0));
        }
        solve_tree();
        dense *d = &by_hand;
        memset(d, 0, sizeof *d);
        for (int32_t i = is_free; i < the.tree.count; ++i) {
            row rows[6];
            const int32_t count = rows_of_link(i, rows), above = the.links[i].parent;
            for (int32_t r = 0; r < count; ++r, ++d->rows)
                for (int32_t k = 0; k < 6; ++k) {
                    d->j[d->rows][6 * i + k] = slope_of(i, rows + r, k, 1);
                    if (above >= 0) d->j[d->rows][6 * above + k] = slope_of(i, rows + r, k, 0);
                }
        }
        solve_rows();
        const double most = largest(d->u, 6 * the.tree.count);
        FE_TRUE(allowed() < 1e-3 && most > 0.0);
        for (int32_t i = 0; i < the.tree.count; ++i) {
            double u[6];
            change_of(i, u);
            for (int k = 0; k < 6; ++k) FE_NEAR(u[k], d->u[6 * i + k], allowed() * most);
        }
    }
}

// ---- passes --------------------------------------------------------------------------------------------------------
// Relaxed chains have no velocity along their joints, no gap, and the momentum that they had. A light tree is left
// alone until it opens. Closing the last gap, of 4 mm or less, leaves its square over the length of an arm.
static void relax_leaves_no_speed_and_no_gap(void **state)
{
    (void)state;
    for (int32_t heavy = 0; heavy < 2; ++heavy) {
        begin(3);
        the.tree.kind = heavy ? FE__TREE_HEAVY : FE__TREE_LIGHT;
        add_free_root(1.0f);
        for (int32_t i = 1; i < 10; ++i) {
            add_ball(i - 1, 1.0f);
            the.locks[i].lock.gap = any_vector(0.003);
        }
        fe_dvec3 before = {0.0, 0.0, 0.0}, after = before;
        for (int32_t i = 1; i <= 10; ++i) before = fe__dadd(before, fe__widen(fe__quad_vector(the.velocity[i].v)));
        prepare_trees(&the.job);
        const fe__velocity_line first = the.velocity[1];
        relax_trees(&the.job);
        if (!heavy) {
            FE_TRUE(memcmp(&first, the.velocity + 1, sizeof first) == 0 && the.solver.engaged == 0);
            the.opens = 1;
            relax_trees(&the.job);
            FE_TRUE(the.solver.engaged == 1);
        }
        for (int32_t i = 1; i <= 10; ++i) after = fe__dadd(after, fe__widen(fe__quad_vector(the.velocity[i].v)));
        FE_NEAR(after.x, before.x, 10.0 * FLT_EPSILON), FE_NEAR(after.y, before.y, 10.0 * FLT_EPSILON);
        // The rows along which velocities vanish are those from before the gaps closed
        solve_densely(7);
        for (int32_t r = 0; r < by_hand.rows; ++r) FE_NEAR(by_hand.b[r], 0.0, 20.0 * FLT_EPSILON);
        (void)read_now();
        for (int32_t i = 1; i < 10; ++i) {
            const fe_dvec3 gap = get_lane3(&the.nodes[i].gap, 0);
            FE_NEAR(sqrt(fe__ddot(gap, gap)), 0.0, 1e-4);
        }
    }
}

// ---- what contacts see ----------------------------------------------------------------------------------------------
// A heavy root on light bodies that joints hold at their centres, as axles hold wheels; contacts touch some links
static void add_cart(int32_t wheels, int32_t touches_root)
{
    add_free_root(1000.0f);
    the.bodies[1].colours[0] = touches_root ? 1 : 0;
    for (int32_t i = 1; i <= wheels; ++i) {
        add_link(0, 1, FE__PART_POINT, 1.0f, any_inertia(1.0f))->arm_a = any_vector(0.5);
        the.bodies[i + 1].colours[0] = 1;
    }
}

// Forces x on the touched links, and what bodies alone make of them as the velocities of the lines
static void push_alone(double (*x)[6])
{
    for (int32_t i = 0; i < the.tree.count; ++i) {
        double v[6];
        if (!the.bodies[i + 1].colours[0]) memset(x[i], 0, sizeof x[i]);
        respond(i + 1, x[i], v);
        set_velocity(i + 1, fe__vec3((float)v[0], (float)v[1], (float)v[2]),
                     fe__vec3((float)v[3], (float)v[4], (float)v[5]));
    }
}

// What contacts count with, D x, and D^-1 of an answer
static void seen_by_contacts(int32_t i, const double x[6], const double answer[6], double *seen, double *load)
{
    const tree_node *n = the.nodes + i;
    const double share = get_lane(&n->light, 0) / get_lane(&n->mass, 0);
    const real_sym d = {r_widen(n->seen[0]), r_widen(n->seen[1]), r_widen(n->seen[2]),
                        r_widen(n->seen[3]), r_widen(n->seen[4]), r_widen(n->seen[5])};
    const real3 w = r_mul_sym(&d, (real3){r_set(x[3]), r_set(x[4]), r_set(x[5])}),
                torque = r_mul_sym(&n->resists, (real3){r_set(answer[3]), r_set(answer[4]), r_set(answer[5])});
    for (int k = 0; k < 3; ++k) {
        seen[k] = share * x[k], load[k] = answer[k] / share;
        seen[3 + k] = get_lane(&w.x + k, 0), load[3 + k] = get_lane(&torque.x + k, 0);
    }
}

// x.G x / x.D x: the tree's answer against the one that contacts count with. x becomes D^-1 G x: such powers end in the
// direction in which the ratio is largest.
static double share_of_answer(double (*x)[6])
{
    double by_tree = 0.0, by_shares = 0.0;
    push_alone(x);
    solve_densely(7);
    for (int32_t i = 0; i < the.tree.count; ++i) {
        const fe__velocity_line *l = the.velocity + i + 1;
        double answer[6], seen[6], load[6];
        if (!the.bodies[i + 1].colours[0]) continue;
        for (int k = 0; k < 6; ++k) answer[k] = (double)(k < 3 ? l->v[k] : l->w[k - 3]) + by_hand.u[6 * i + k];
        seen_by_contacts(i, x[i], answer, seen, load);
        for (int k = 0; k < 6; ++k) by_tree += x[i][k] * answer[k], by_shares += x[i][k] * seen[k];
        memcpy(x[i], load, sizeof load);
    }
    return by_tree / by_shares;
}

// Impulses found with the masses that contacts see give the tree no more energy than the contacts know of
static void contacts_know_of_all_that_a_tree_answers(void **state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 24; ++seed) {
        double x[MOST_LINKS][6], most = 0.0;
        begin(seed);
        add_cart(1 + (int32_t)(seed % 8), seed % 3 == 0);
        prepare_trees(&the.job);
        FE_TRUE(the.head.lends & 1);
        for (int32_t i = 1; i < the.tree.count; ++i) // far heavier than alone
            FE_WITHIN(get_lane(&the.nodes[i].light, 0), 0.0, 0.25);
        restore_trees(&the.job);
        for (int32_t i = 0; i < the.tree.count; ++i)
            for (int k = 0; k < 6; ++k) x[i][k] = any(-1, 1);
        for (int32_t power = 0; power < 40; ++power) most = fmax(most, share_of_answer(x));
        FE_WITHIN(most, 0.1, 1.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_level_rods_begin_to_fall_as_lagrange_says),
        cmocka_unit_test(chains_and_trees_are_solved_as_by_gauss),
        cmocka_unit_test(chains_with_a_heavy_end_are_solved_as_by_gauss),
        cmocka_unit_test(locked_bodies_are_solved_as_by_gauss),
        cmocka_unit_test(rows_are_gradients_of_their_errors),
        cmocka_unit_test(all_kinds_are_solved_as_by_gauss),
        cmocka_unit_test(relax_leaves_no_speed_and_no_gap),
        cmocka_unit_test(contacts_know_of_all_that_a_tree_answers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
