// recycle.simd.c - contacts that keep their manifold: the separations at the beginning of a step from the bodies'
// poses, W contacts at a time.
//
// A pair that moved less than a tolerance since its last full narrow phase keeps normal, arms and ids; only the
// separations follow, exactly for the material points it has. Compared with the last full test, not with the last step,
// so that drift is seen. Compiled once per SIMD set.
#include "core/simd.h"
#include "solver/solver.h"
#include "solver/wide_body.h"

#include <float.h>

// m along the normal, whatever the manifold's tolerance: some overlaps of a deep pile, and no more than the speculative
// distance
#define MOST_ALONG 0.02f

enum { CONTACT_STRIDE = sizeof(fe__contact) / sizeof(float), POINTS_STRIDE = sizeof(fe__points) / sizeof(float) };
enum { BODY_STRIDE = sizeof(fe__body) / sizeof(float) };
#define CONTACT_QUAD(field) w_gather((const float *)&contacts->field, CONTACT_STRIDE, index)

// a - b and what its rounding lost (Knuth's TwoSum): exact together
FE_INLINE wide difference(wide a, wide b, wide *error)
{
    wide d = a - b, bb = a - d, aa = d + bb;
    *error = (a - aa) + (bb - b);
    return d;
}

// centres of mass; the fourth lane of low is the speed
typedef struct {
    wide4 high, low;
} centres;

FE_INLINE centres centres_of(const fe__body *bodies, const int32_t *body)
{
    centres c;
    w_gather_both(bodies->centre_high, BODY_STRIDE, body, &c.high, &c.low);
    return c;
}

// By how much B's centre moved against A's since the contact was found: (cB - cA) + found span. The bodies' and the
// contact's high parts cancel first, so that metres or a thousand kilometres between the centres cost no digit.
FE_INLINE wide3 shift_since_found(const centres *a, const centres *b, wide3 span, wide3 span_low)
{
    wide3 low = w_sub(w_xyz(b->low), w_xyz(a->low)), e;
    wide3 d = {difference(b->high.x, a->high.x, &e.x), difference(b->high.y, a->high.y, &e.y),
               difference(b->high.z, a->high.z, &e.z)};
    return w_add(w_add(d, span), w_add(w_add(e, low), span_low));
}

FE_INLINE wide4 rotation_since_found(const fe__body *bodies, const int32_t *body, wide4 found)
{
    wide4 q = w_product(w_gather(bodies->rotation, BODY_STRIDE, body), w_conjugate(found));
    return w_with(w_flush3(w_xyz(q), w_set(FE__LEAST_LEAN)), q.w);
}

FE_INLINE wide_mask are_of_type(const fe__body *bodies, const int32_t *body, int32_t type)
{
    _Alignas(64) float are[FE_W];
    for (int i = 0; i < FE_W; ++i) are[i] = bodies[body[i]].type == type ? 1.0f : 0.0f;
    return w_greater(*(const wide *)are, w_set(0.5f));
}

FE_INLINE wide length(wide3 a) { return w_sqrt(w_dot(a, a)); }

typedef struct {
    const fe__body *bodies;
    const int32_t *a, *b;
    centres at_a, at_b;
} sides;

// How far the pair may come together in a step, m. Along a normal n between the two, v.n and the turns count: those of
// a body without points by |w x n| arm, others as in narrowphase.c, by speed = |v| + |w| reach. Without a normal all
// does
FE_INLINE wide approach_of(const sides *s, wide3 n, wide_mask has_normal, wide_mask apart, wide4 surface, float dt)
{
    wide4 va, wa, vb, wb;
    w_gather_both(s->bodies->velocity, BODY_STRIDE, s->a, &va, &wa);
    w_gather_both(s->bodies->velocity, BODY_STRIDE, s->b, &vb, &wb);
    wide3 v = w_sub(w_xyz(va), w_xyz(vb));
    wide straight = w_choose(has_normal, w_max(w_dot(n, v), w_set(0.0f)), length(v));
    wide spins = (s->at_a.low.w - length(w_xyz(va))) + (s->at_b.low.w - length(w_xyz(vb)));
    wide turns = surface.y * length(w_cross(w_xyz(wa), n)) + surface.z * length(w_cross(w_xyz(wb), n));
    return dt * (straight + w_choose(w_and(apart, has_normal), turns, spins));
}

// of the points that there are
FE_INLINE wide least_separation(const wide4 *separation, wide count)
{
    wide none = w_set(FLT_MAX),
         one_two = w_min(separation->x, w_choose(w_greater(count, w_set(1.0f)), separation->y, none));
    return w_min(one_two, w_min(w_choose(w_greater(count, w_set(2.0f)), separation->z, none),
                                w_choose(w_greater(count, w_set(3.0f)), separation->w, none)));
}

// How the bodies moved against each other since the contact was found
typedef struct {
    wide3 shift;  // of B's centre, m
    wide along;   // of that, away along the normal
    wide3 na, nb; // by how much the normal turned in the frame of either: R(dq)^T n - n
    wide turned;  // sum over both of sin^2(angle / 2)
    wide carried; // of that, A's where it is kinematic
    wide reach;   // longest arm of the rotations, m
} motion;

// Along the normal the separations follow exactly (a pair that came so far apart, or so deep, has other features); what
// ages a manifold is sliding and rotating. A point slides by at most |slide| + 2 |sin(angle / 2)| reach of either body,
// and (x + y + z)^2 <= 3 (x^2 + y^2 + z^2). A patch of a heightfield goes with its head: its tolerance is below 0.
// What rides on a kinematic body that rotates is found anew each step: friction holds it to the velocity at the arms,
// and with those of t seconds ago it would leave its circle of radius R by w^2 R t / 2 each second, for ever.
FE_INLINE wide_mask is_old(const motion *m, wide3 n, wide tolerance)
{
    wide3 slide = w_flush3(w_sub_scaled(m->shift, m->along, n), w_set(FE__LEAST_SHIFT));
    wide moved = 3.0f * (w_dot(slide, slide) + 4.0f * m->reach * m->reach * m->turned);
    wide most_along = w_choose(w_greater(w_set(0.0f), tolerance), w_set(FLT_MAX), w_set(MOST_ALONG));
    wide_mask far = w_or(w_not(w_greater(tolerance * tolerance, moved)), w_greater(w_abs(m->along), most_along));
    return w_or(far, w_greater(m->carried, w_set(0.0f)));
}

// What is left of the gap of a pair without points, m. Between two planes with the normal n it changes by the shift
// along n, and where a body turned, by how much farther it reaches along n: h(R^T n) - h(n) <= |R^T n - n| arm, h being
// its support function. Without a normal all motion counts
FE_INLINE wide gap_left(const motion *m, wide_mask has_normal, wide4 surface)
{
    wide turns = surface.y * length(m->na) + surface.z * length(m->nb);
    wide moved = w_sqrt(3.0f * (w_dot(m->shift, m->shift) + 4.0f * m->reach * m->reach * m->turned));
    return surface.w + w_choose(has_normal, m->along - turns, -moved);
}

// Whether the boxes parted shows in the narrow phase: what went so far is looked at
FE_INLINE wide_mask went_away(const motion *m, wide tolerance)
{
    wide most = w_max(tolerance, w_min(w_set(FE__MOST_AWAY), FE__AWAY_SHARE * m->reach));
    return w_greater(w_dot(m->shift, m->shift), most * most);
}

FE_INLINE wide separation_now(const wide4 *point, wide constant, wide3 slope)
{
    return point->w + (constant + w_dot(slope, w_xyz(*point)));
}

FE_INLINE void put_lanes(float *out, wide values, int32_t count)
{
    _Alignas(64) float lanes[FE_W];
    *(wide *)lanes = values;
    for (int i = 0; i < count; ++i) out[i] = lanes[i];
}

// As in contact_rows.inl: s = s0 + n.shift + (nB - nA).r + nB.span + rhoA nA.n + rhoB nB.n with nX = R(dqX)^T n - n
static void recycle_block(const fe__contact *contacts, fe__points *points, const fe__body *bodies, const int32_t *index,
                          int32_t count, float dt, float fall, uint8_t *out, float *out_slack)
{
    _Alignas(64) int32_t a[FE_W], b[FE_W], points_of[FE_W];
    for (int i = 0; i < FE_W; ++i) {
        const fe__contact *m = contacts + index[i];
        a[i] = m->body_a, b[i] = m->body_b, points_of[i] = m->points;
    }
    wide4 normal = CONTACT_QUAD(normal), surface = CONTACT_QUAD(surface.dynamic_friction),
          found = CONTACT_QUAD(found_span);
    wide4 found_a, found_b, point[FE__POINTS];
    w_gather_both(contacts->found_a, CONTACT_STRIDE, index, &found_a, &found_b);
    sides s = {bodies, a, b, centres_of(bodies, a), centres_of(bodies, b)};
    wide3 n = w_xyz(normal), shift = shift_since_found(&s.at_a, &s.at_b, w_xyz(found), w_xyz(CONTACT_QUAD(found_low)));
    wide4 rotation_a = rotation_since_found(bodies, a, found_a), rotation_b = rotation_since_found(bodies, b, found_b);
    // a static A has its arms from B's centre: no span between them, and it does not rotate
    wide3 arms_span = w_choose3(are_of_type(bodies, a, FE_BODY_STATIC), w_zero3(), w_xyz(found));
    wide3 na = w_turn_back(rotation_a, n), nb = w_turn_back(rotation_b, n), slope = w_sub(nb, na);
    wide constant = w_dot(n, shift) + w_dot(nb, arms_span) + surface.y * w_dot(na, n) + surface.z * w_dot(nb, n);

    wide turned_a = w_dot(w_xyz(rotation_a), w_xyz(rotation_a)), turned_b = w_dot(w_xyz(rotation_b), w_xyz(rotation_b));
    motion m = {
        .shift = shift,
        .along = w_dot(n, shift),
        .na = na,
        .nb = nb,
        .turned = turned_a + turned_b,
        .carried = w_choose(are_of_type(bodies, a, FE_BODY_KINEMATIC), turned_a, w_set(0.0f)),
        .reach = found.w,
    };
    for (int i = 0; i < FE__POINTS; i += 2)
        w_gather_both(points->point[i].arm, POINTS_STRIDE, points_of, point + i, point + i + 1);
    wide4 separation = {separation_now(point, constant, slope), separation_now(point + 1, constant, slope),
                        separation_now(point + 2, constant, slope), separation_now(point + 3, constant, slope)};

    // Without points the bodies must not be able to meet in this step either. Where a wide gap may close in it, the
    // manifold is to be that of the touch (narrowphase.c)
    wide zero = w_set(0.0f), least = least_separation(&separation, normal.w);
    wide_mask old = is_old(&m, n, surface.w), apart = w_not(w_greater(normal.w, zero)),
              open = w_and(w_greater(least, w_set(FE__TURNS_LITTLE)), w_greater(surface.w, zero));
    if (w_any(w_or(apart, open))) {
        wide_mask has_normal = w_greater(w_dot(n, n), zero);
        wide left = gap_left(&m, has_normal, surface);
        wide approach = approach_of(&s, n, has_normal, apart, surface, dt);
        wide_mask meets = w_not(w_and(w_greater(left, approach), w_greater(surface.w, zero))),
                  closes = w_not(w_greater(least, approach + fall));
        old = w_or(w_and(apart, w_or(meets, went_away(&m, surface.w))),
                   w_and(w_not(apart), w_or(old, w_and(open, closes))));
        put_lanes(out_slack, left, count);
    }
    unsigned far = w_bits(old), without = w_bits(apart);

    _Alignas(64) float now[FE_W][FE__POINTS];
    w_scatter(now[0], FE__POINTS, w_in_order, separation);
    for (int i = 0; i < count; ++i) {
        out[i] = (uint8_t)(far >> i & 1 ? FE__MOVED : without >> i & 1 ? FE__STAYS_APART : FE__STAYS);
        if (out[i] == FE__STAYS) *(quad *)points[points_of[i]].separation = *(const quad *)now[i];
    }
}

fe__recycle_kernel FE_NAME(fe__recycle);

// The lines of a contact come from memory two blocks before it is reckoned, those of its points, which it names, one
void FE_NAME(fe__recycle)(const fe__contact *contacts, fe__points *points, const fe__body *bodies, const int32_t *index,
                          int32_t count, float dt, float fall, uint8_t *out, float *out_slack)
{
    int32_t i = 0;
    for (int32_t k = 0; k < count && k < 2 * FE_W; ++k) fe__fetch(contacts + index[k], sizeof *contacts);
    for (; i + FE_W <= count; i += FE_W) {
        const int32_t *next = index + i + FE_W, *second = next + FE_W;
        for (int k = 0; k < FE_W && i + 3 * FE_W <= count; ++k) fe__fetch(contacts + second[k], sizeof *contacts);
        for (int k = 0; k < FE_W && i + 2 * FE_W <= count; ++k)
            fe__fetch(points + contacts[next[k]].points, sizeof *points);
        recycle_block(contacts, points, bodies, index + i, FE_W, dt, fall, out + i, out_slack + i);
    }
    if (i == count) return;
    int32_t rest[FE_W] = {0};
    for (int32_t k = i; k < count; ++k) rest[k - i] = index[k];
    recycle_block(contacts, points, bodies, rest, count - i, dt, fall, out + i, out_slack + i);
}
