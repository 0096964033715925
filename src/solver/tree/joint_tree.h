// joint_tree.h - all locks of a tree of joints, met at once. Part of joint.simd.c.
//
// Runs after the sweep over the joints, whose rows hold arms, errors and impulses, and ends what the sweep began: the change l of all
// impulses and the change u of all velocities with
//     M u = J^T l,   J (v + u) = -d
// On a tree that matrix is eliminated from the leaves upwards without a new entry (Baraff, "Linear-Time Dynamics using Lagrange
// Multipliers", SIGGRAPH 1996; its masses are Featherstone's articulated inertias). With Jc, Jp a joint's rows for the body below and
// above, P the mass matrix of the body below with all that hangs on it, f what hangs on it asks for:
//     up     P = L L^T,  Y = L^-1 Jc^T,  Y^T Y + G = C C^T,  H = C^-1 Jp,  P_parent += H^T H
//            e = C^-1 (wish - Y^T L^-1 f),                                 f_parent += H^T e
//     down   l = C^-T (e - H u_parent),                                    u = L^-T (L^-1 f + Y l)
// Positions decide P, Y, C and H: they are found once a substep, in double, as a chain may bear a million times its own mass.
//
// A substep is RATTLE's (Andersen 1983): first velocities that bring the points together at its end (d: the way that a turn takes them off
// their tangents), then positions, put right by what is left, then velocities along the locks as they now are (d = 0). So no spring is in
// it and none is needed: a chain under a load of a thousand links is as long as its links, and the energy that this kind of integrator
// keeps is kept.

// Of a tree, in this step: a light one is solved from the substep on in which it opens, but left to the sweep where it was open before
typedef enum { READY, SOLVED, SWEPT } tree_state;

typedef struct {
    _Alignas(64) tree_rows rows;          // locks, then what calms the joint
    int32_t locks;                        // rows of locks
    int32_t weighed;                      // 1: masses are there
    tree_state state;                     // of the first node
    double mass[6][6];                    // P, then L below the diagonal and 1 / L_kk on it
    double turn[6];                       // inverse inertia: xx xy xz yy yz zz
    double inertia;                       // about the heaviest of the world's axes that are not locked, kg m2
    double tension, expected, calm;       // see joint_tree_calm.h
    double least[TREE_ROWS];              // of a row's response that counts
    double reach[TREE_ROWS][6];           // columns of Y
    double own[TREE_ROWS][TREE_ROWS];     // C, as L
    double hold[TREE_ROWS][6];            // H
    double wish[TREE_ROWS], asked[6];     // what a row lacks, then e; f, then L^-1 f
    double impulse[TREE_ROWS], change[6]; // l, u
} tree_node;

typedef struct {
    fe__solver *s;
    const fe__tree_link *links;
    const fe__tree_place *places;
    int32_t count;
    unsigned char *rows;
    tree_node *nodes;
    double h; // of the substep
} tree_job;

static tree_job tree_of(fe__solver *s, const fe__joints *joints, int32_t tree, unsigned char *rows, int64_t nodes,
                        const fe__step_constants *c)
{
    const fe__joint_tree *t = joints->forest.trees + tree;
    return (tree_job){.s = s,
                      .links = joints->forest.links + t->first,
                      .places = s->places + t->first,
                      .count = t->count,
                      .rows = rows,
                      .nodes = (tree_node *)(void *)(rows + nodes),
                      .h = (double)c->h};
}

static tree_node *parent_of(const tree_job *t, int32_t i) { return t->links[i].parent < 0 ? NULL : t->nodes + t->links[i].parent; }
static const fe__velocity_line *below_of(const tree_job *t, int32_t i) { return t->s->velocity + t->places[i].line; }
static const fe__velocity_line *above_of(const tree_job *t, int32_t i) { return t->s->velocity + t->places[i].parent_line; }
static int locks_of(const fe__velocity_line *line) { return (int)line->lock_bits; }

// A turn within a substep that is no small correction any more
#define SLOW_TURN 0.05 // rad

static void add_spin(float w[3], const double i[6], fe_dvec3 l)
{
    w[0] = (float)((double)w[0] + (i[0] * l.x + i[1] * l.y + i[2] * l.z));
    w[1] = (float)((double)w[1] + (i[1] * l.x + i[3] * l.y + i[4] * l.z));
    w[2] = (float)((double)w[2] + (i[2] * l.x + i[4] * l.y + i[5] * l.z));
}

// ---- matrices, lower triangles --------------------------------------------------------------------------------------------------------
// a = L L^T in place. Where no more than `least` would be left in the diagonal, the row is left out: its column is zeros.
static void factorise(double *a, int n, int stride, const double *least)
{
    for (int k = 0; k < n; ++k) {
        double *row = a + k * stride, d = row[k];
        for (int i = 0; i < k; ++i) d -= row[i] * row[i];
        double inverse = d > least[k] ? 1.0 / sqrt(d) : 0.0;
        row[k] = inverse;
        for (int r = k + 1; r < n; ++r) {
            double *other = a + r * stride, sum = other[k];
            for (int i = 0; i < k; ++i) sum -= other[i] * row[i];
            other[k] = inverse * sum;
        }
    }
}

// x = L^-1 x
FE_INLINE void forward(const double *l, int n, int stride, double *x)
{
    for (int k = 0; k < n; ++k) {
        for (int i = 0; i < k; ++i) x[k] -= l[k * stride + i] * x[i];
        x[k] *= l[k * stride + k];
    }
}

// x = L^-T x
FE_INLINE void backward(const double *l, int n, int stride, double *x)
{
    for (int k = n - 1; k >= 0; --k) {
        for (int i = k + 1; i < n; ++i) x[k] -= l[i * stride + k] * x[i];
        x[k] *= l[k * stride + k];
    }
}

// of a symmetric matrix xx xy xz yy yz zz, 0 where it has none
static void invert(const double i[6], double out[3][3])
{
    double xx = i[3] * i[5] - i[4] * i[4], xy = i[2] * i[4] - i[1] * i[5], xz = i[1] * i[4] - i[2] * i[3];
    double yy = i[0] * i[5] - i[2] * i[2], yz = i[1] * i[2] - i[0] * i[4], zz = i[0] * i[3] - i[1] * i[1];
    double d = i[0] * xx + i[1] * xy + i[2] * xz, k = d > 0.0 ? 1.0 / d : 0.0;
    out[0][0] = k * xx, out[1][1] = k * yy, out[2][2] = k * zz;
    out[0][1] = out[1][0] = k * xy, out[0][2] = out[2][0] = k * xz, out[1][2] = out[2][1] = k * yz;
}

// ---- rows and masses from the sweep ---------------------------------------------------------------------------------------------------
// A locked way of moving gets some mass, but no row sees it (hide_locked)
static void weigh(tree_node *n, const fe__velocity_line *velocity, const wide_sym *inertia, int32_t lane)
{
    const wide *in[6] = {&inertia->xx, &inertia->xy, &inertia->xz, &inertia->yy, &inertia->yz, &inertia->zz};
    static const int diagonal[3] = {0, 3, 5};
    double inverse[6], turn[3][3], mass = 1.0 / (double)velocity->inverse_mass;
    for (int k = 0; k < 6; ++k) inverse[k] = n->turn[k] = (double)(*in[k])[lane];
    for (int k = 0; k < 3; ++k)
        if (locks_of(velocity) >> (3 + k) & 1) inverse[diagonal[k]] = 1.0;
    invert(inverse, turn);
    memset(n->mass, 0, sizeof n->mass);
    for (int i = 0; i < 3; ++i) {
        n->mass[i][i] = mass;
        memcpy(n->mass[3 + i] + 3, turn[i], sizeof turn[i]);
    }
    n->inertia = 0.0;
    for (int k = 0; k < 3; ++k)
        if (!(locks_of(velocity) >> (3 + k) & 1)) n->inertia = fe__maxd(n->inertia, turn[k][k]);
    n->weighed = 1;
}

// Rows of which less is left are met by the others already, or see only locked ways: a share of what the body below would answer if it
// were free and bore nothing. Some digits above the rounding of a row, squared; a load takes its ratio of masses off the answer.
#define TREE_REDUNDANT 1e-10

static void find_least(tree_node *n, double inverse_mass)
{
    double turn = n->turn[0] + n->turn[3] + n->turn[5];
    for (int r = 0; r < n->locks; ++r) {
        fe_dvec3 u = vec_of(n->rows.below[r]), m = vec_of(n->rows.below[r] + 3);
        n->least[r] = TREE_REDUNDANT * (inverse_mass * fe__ddot(u, u) + turn * fe__ddot(m, m));
    }
}

static void hide_locked(tree_rows *rows, int from, int below, int above)
{
    for (int r = from; r < rows->count; ++r)
        for (int k = 0; k < 6; ++k) {
            if (below >> k & 1) rows->below[r][k] = 0.0;
            if (above >> k & 1) rows->above[r][k] = 0.0;
        }
}

static void read_link(const tree_job *t, int32_t i)
{
    tree_node *n = t->nodes + i, *parent = parent_of(t, i);
    const fe__tree_place *p = t->places + i;
    const int holds_b = t->links[i].holds_b;
    memset(&n->rows, 0, sizeof n->rows);
    for (int32_t k = 0; k < p->locks; ++k) {
        int32_t lane = p->lock[k].lane;
        end_inertias e = read_lock(&n->rows, holds_b, p->lock[k].part, t->rows + p->lock[k].row, lane, t->s);
        if (!n->weighed) weigh(n, below_of(t, i), holds_b ? e.b : e.a, lane);
        if (parent && !parent->weighed) weigh(parent, above_of(t, i), holds_b ? e.a : e.b, lane);
    }
    n->locks = n->rows.count;
    find_least(n, (double)below_of(t, i)->inverse_mass);
    hide_locked(&n->rows, 0, locks_of(below_of(t, i)), locks_of(above_of(t, i)));
}

static void read_tree(const tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) t->nodes[i].weighed = 0;
    for (int32_t i = 0; i < t->count; ++i) read_link(t, i);
}

// ---- elimination ----------------------------------------------------------------------------------------------------------------------
static void reduce(tree_node *n)
{
    static const double nothing[6] = {0};
    factorise(n->mass[0], 6, 6, nothing);
    for (int r = 0; r < n->rows.count; ++r) {
        memcpy(n->reach[r], n->rows.below[r], sizeof n->reach[r]);
        forward(n->mass[0], 6, 6, n->reach[r]);
        for (int c = 0; c <= r; ++c) {
            n->own[r][c] = r == c && r >= n->locks ? 1.0 / n->calm : 0.0;
            for (int k = 0; k < 6; ++k) n->own[r][c] += n->reach[r][k] * n->reach[c][k];
        }
    }
    factorise(n->own[0], n->rows.count, TREE_ROWS, n->least);
}

static void hang_on(tree_node *n, tree_node *parent)
{
    for (int r = 0; r < n->rows.count; ++r) {
        for (int k = 0; k < 6; ++k) {
            double sum = n->rows.above[r][k];
            for (int c = 0; c < r; ++c) sum -= n->own[r][c] * n->hold[c][k];
            n->hold[r][k] = n->own[r][r] * sum;
        }
        for (int k = 0; k < 6; ++k)
            for (int c = 0; c <= k; ++c) parent->mass[k][c] += n->hold[r][k] * n->hold[r][c];
    }
}

static void eliminate(const tree_job *t)
{
    for (int32_t i = t->count - 1; i >= 0; --i) {
        reduce(t->nodes + i);
        if (parent_of(t, i)) hang_on(t->nodes + i, parent_of(t, i));
    }
}

static void hand_up(const tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) memset(t->nodes[i].asked, 0, sizeof t->nodes[i].asked);
    for (int32_t i = t->count - 1; i >= 0; --i) {
        tree_node *n = t->nodes + i, *parent = parent_of(t, i);
        forward(n->mass[0], 6, 6, n->asked);
        for (int r = 0; r < n->rows.count; ++r)
            for (int k = 0; k < 6; ++k) n->wish[r] -= n->reach[r][k] * n->asked[k];
        forward(n->own[0], n->rows.count, TREE_ROWS, n->wish);
        for (int r = 0; r < n->rows.count && parent; ++r)
            for (int k = 0; k < 6; ++k) parent->asked[k] += n->hold[r][k] * n->wish[r];
    }
}

static void hand_down(const tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i, *parent = parent_of(t, i);
        memcpy(n->impulse, n->wish, sizeof n->impulse);
        for (int r = 0; r < n->rows.count && parent; ++r)
            for (int k = 0; k < 6; ++k) n->impulse[r] -= n->hold[r][k] * parent->change[k];
        backward(n->own[0], n->rows.count, TREE_ROWS, n->impulse);
        memcpy(n->change, n->asked, sizeof n->change);
        for (int r = 0; r < n->rows.count; ++r)
            for (int k = 0; k < 6; ++k) n->change[k] += n->reach[r][k] * n->impulse[r];
        backward(n->mass[0], 6, 6, n->change);
    }
}

// from wishes to impulses and changes
static void meet(const tree_job *t)
{
    hand_up(t);
    hand_down(t);
}
