// eliminate.c - the constraints of a tree eliminated from its leaves upwards and met from its root downwards, see
// node.h.
#include "solver/tree/eliminate.h"

#include <string.h>

// ---- matrices, lower triangles --------------------------------------------------------------------------------------
// a = L L^T in place. Where no more than `least` would be left in the diagonal, the row is left out: its column is
// zeros.
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
static inline void forward(const double *l, int n, int stride, double *x)
{
    for (int k = 0; k < n; ++k) {
        double sum = x[k];
        for (int i = 0; i < k; ++i) sum -= l[k * stride + i] * x[i];
        x[k] = sum * l[k * stride + k];
    }
}

// x = L^-T x
static inline void backward(const double *l, int n, int stride, double *x)
{
    for (int k = n - 1; k >= 0; --k) {
        double sum = x[k];
        for (int i = k + 1; i < n; ++i) sum -= l[i * stride + k] * x[i];
        x[k] = sum * l[k * stride + k];
    }
}

// ---- from the leaves upwards ----------------------------------------------------------------------------------------
static void reduce(fe__tree_node *n)
{
    static const double nothing[6] = {0};
    factorise(n->mass[0], 6, 6, nothing);
    for (int r = 0; r < n->rows.count; ++r) {
        memcpy(n->reach[r], n->rows.below[r], sizeof n->reach[r]);
        forward(n->mass[0], 6, 6, n->reach[r]);
        for (int c = 0; c <= r; ++c) {
            double sum = r == c && r >= n->locks ? 1.0 / n->damping : 0.0;
            for (int k = 0; k < 6; ++k) sum += n->reach[r][k] * n->reach[c][k];
            n->own[r][c] = sum;
        }
    }
    factorise(n->own[0], n->rows.count, FE__TREE_ROWS, n->least);
}

static void hang_on(fe__tree_node *n, fe__tree_node *parent)
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

void fe__tree_eliminate(const fe__tree_job *t)
{
    for (int32_t i = t->count - 1; i >= 0; --i) {
        reduce(t->nodes + i);
        if (fe__tree_parent(t, i)) hang_on(t->nodes + i, fe__tree_parent(t, i));
    }
}

// ---- requests up, changes down --------------------------------------------------------------------------------------
static void hand_up(const fe__tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) memset(t->nodes[i].load, 0, sizeof t->nodes[i].load);
    for (int32_t i = t->count - 1; i >= 0; --i) {
        fe__tree_node *n = t->nodes + i, *parent = fe__tree_parent(t, i);
        forward(n->mass[0], 6, 6, n->load);
        for (int r = 0; r < n->rows.count; ++r) {
            double sum = n->request[r];
            for (int k = 0; k < 6; ++k) sum -= n->reach[r][k] * n->load[k];
            n->request[r] = sum;
        }
        forward(n->own[0], n->rows.count, FE__TREE_ROWS, n->request);
        for (int r = 0; r < n->rows.count && parent; ++r)
            for (int k = 0; k < 6; ++k) parent->load[k] += n->hold[r][k] * n->request[r];
    }
}

static void hand_down(const fe__tree_job *t)
{
    for (int32_t i = 0; i < t->count; ++i) {
        fe__tree_node *n = t->nodes + i, *parent = fe__tree_parent(t, i);
        memcpy(n->impulse, n->request, sizeof n->impulse);
        for (int r = 0; r < n->rows.count && parent; ++r) {
            double sum = n->impulse[r];
            for (int k = 0; k < 6; ++k) sum -= n->hold[r][k] * parent->change[k];
            n->impulse[r] = sum;
        }
        backward(n->own[0], n->rows.count, FE__TREE_ROWS, n->impulse);
        memcpy(n->change, n->load, sizeof n->change);
        for (int r = 0; r < n->rows.count; ++r)
            for (int k = 0; k < 6; ++k) n->change[k] += n->reach[r][k] * n->impulse[r];
        backward(n->mass[0], 6, 6, n->change);
    }
}

void fe__tree_substitute(const fe__tree_job *t)
{
    hand_up(t);
    hand_down(t);
}
