// bodies.simd.c - velocities and positions of bodies, W consecutive lines at a time. Compiled once per SIMD set.
//
// Within a step J, M and l at the end of a substep are those that warm-start the next, so the warm start's effect on a
// body is v_end - start: one pass over bodies replaces a pass over rows. It holds as long as everything that is no
// constraint acts on `start` too; see carry_velocities.
#include "core/simd.h"
#include "solver/solver.h"
#include "solver/wide_body.h"

// of W bodies from line i on
FE_INLINE void load_line(const void *lines, int32_t i, wide4 *low, wide4 *high)
{
    gather_line((const float *)lines + (int64_t)i * FE__LINE, w_in_order, low, high);
}
FE_INLINE wide4 load_low(const void *lines, int32_t i)
{
    return gather_low((const float *)lines + (int64_t)i * FE__LINE, w_in_order);
}
FE_INLINE wide4 load_high(const void *lines, int32_t i)
{
    return gather_high((const float *)lines + (int64_t)i * FE__LINE, w_in_order);
}
FE_INLINE void store_line(void *lines, int32_t i, wide4 low, wide4 high)
{
    w_scatter_both((float *)lines + (int64_t)i * FE__LINE, FE__LINE, w_in_order, low, high);
}

FE_INLINE void store_high(void *lines, int32_t i, wide4 high)
{
    scatter_high((float *)lines + (int64_t)i * FE__LINE, w_in_order, high);
}

FE_INLINE void store_moved(fe__solver *s, int32_t i, wide3 spin)
{
    w_scatter(s->moved_spin[i], 4, w_in_order, (wide4){spin.x, spin.y, spin.z, w_set(0.0f)});
}

// ---- records to lines, once per step --------------------------------------------------------------------------------
#define BODY_QUAD(field) w_gather_from(body, offsetof(fe__body, field))

static const fe__body nobody; // what padding reads

// world axes of the principal inertia, and its inverse R I^-1 R^T
FE_INLINE wide_sym world_inverse_inertia(wide4 axes, wide3 inverse)
{
    wide3 x = {w_set(1.0f), w_set(0.0f), w_set(0.0f)}, y = {x.y, x.x, x.y}, z = {x.y, x.y, x.x};
    x = w_add(x, w_turn(axes, x)), y = w_add(y, w_turn(axes, y)), z = w_add(z, w_turn(axes, z));
    wide3 ix = w_scale(inverse.x, x), iy = w_scale(inverse.y, y), iz = w_scale(inverse.z, z);
    wide least = FE__LEAST_LEAN * (inverse.x + inverse.y + inverse.z);
    return (wide_sym){ix.x * x.x + iy.x * y.x + iz.x * z.x,
                      w_flush(ix.x * x.y + iy.x * y.y + iz.x * z.y, least),
                      w_flush(ix.x * x.z + iy.x * y.z + iz.x * z.z, least),
                      ix.y * x.y + iy.y * y.y + iz.y * z.y,
                      w_flush(ix.y * x.z + iy.y * y.z + iz.y * z.z, least),
                      ix.z * x.z + iy.z * y.z + iz.z * z.z};
}

// A locked body's inverse inertia is the inverse of the sub-block of R I R^T over its free axes, zero elsewhere: what a
// body on an axle has.
static void lock_line(fe__solver *s, const fe__body *body, int32_t line, fe_quat axes)
{
    int locks = (int)body->lock_bits, n = 0, free_axis[3];
    const fe__mat3 r = fe__matrix(axes);
    const float *m = body->inertia;
    float i[3][3] = {{0}}, inverse[3][3] = {{0}};
    const float column[3][3] = {{r.x.x, r.x.y, r.x.z}, {r.y.x, r.y.y, r.y.z}, {r.z.x, r.z.y, r.z.z}};
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            for (int k = 0; k < 3; ++k) i[a][b] += m[k] * column[k][a] * column[k][b];
    for (int k = 0; k < 3; ++k)
        if (!(locks >> (3 + k) & 1)) free_axis[n++] = k;
    if (n == 1) inverse[free_axis[0]][free_axis[0]] = 1.0f / i[free_axis[0]][free_axis[0]];
    if (n == 2) {
        int a = free_axis[0], b = free_axis[1];
        float k = 1.0f / (i[a][a] * i[b][b] - i[a][b] * i[a][b]);
        inverse[a][a] = k * i[b][b], inverse[b][b] = k * i[a][a], inverse[a][b] = inverse[b][a] = -(k * i[a][b]);
    }
    fe__sym3 *out = &s->inertia[line].inverse;
    fe__drive_line *drive = s->drive + line;
    if (n < 3) {
        *out = (fe__sym3){inverse[0][0], inverse[0][1], inverse[0][2], inverse[1][1], inverse[1][2], inverse[2][2]};
        const fe_vec3 angular = fe__mul_sym(out, fe__quad_vector(body->torque));
        drive->angular[0] = angular.x, drive->angular[1] = angular.y, drive->angular[2] = angular.z;
    }
    for (int k = 0; k < 3; ++k)
        if (locks >> k & 1) drive->linear[k] = 0.0f;
}

static float gyroscopic_kind(const fe__body *body)
{
    if (body->flags & FE__BODY_ISOTROPIC || body->type != FE_BODY_DYNAMIC) return FE__GYROSCOPIC_NONE;
    return body->joint_count ? FE__GYROSCOPIC_JOINED : FE__GYROSCOPIC_FREE;
}

FE_INLINE void load_block(fe__solver *s, const fe__records *of, int32_t line, const fe__step_constants *c)
{
    void *body[FE_W];
    _Alignas(64) float scale[FE_W], gyroscopic[FE_W], is_there[FE_W];
    int locked = 0, joined = 0;
    for (int i = 0; i < FE_W; ++i) {
        fe__body *b = fe__body_of_line(s, of, line + i);
        is_there[i] = b ? 1.0f : 0.0f;
        if (!b) b = (fe__body *)(uintptr_t)&nobody;
        body[i] = b;
        scale[i] = b->type == FE_BODY_DYNAMIC ? b->gravity_scale : 0.0f;
        gyroscopic[i] = gyroscopic_kind(b);
        joined |= gyroscopic[i] == FE__GYROSCOPIC_JOINED;
        locked |= b->lock_bits != 0.0f && b->type == FE_BODY_DYNAMIC;
    }
    wide zero = w_set(0.0f), one = w_set(1.0f), there = *(wide *)is_there;
    wide4 v = BODY_QUAD(velocity), w = BODY_QUAD(spin), force = BODY_QUAD(force), torque = BODY_QUAD(torque);
    wide4 inertia = BODY_QUAD(inertia), axes = w_product(BODY_QUAD(rotation), BODY_QUAD(inertia_axes));
    axes = w_with(w_flush3(w_xyz(axes), w_set(FE__LEAST_LEAN)), w_flush(axes.w, w_set(FE__LEAST_LEAN)));
    wide_mask moves = w_greater(v.w * there, zero);
    wide3 inverse = {w_choose(moves, one / inertia.x, zero), w_choose(moves, one / inertia.y, zero),
                     w_choose(moves, one / inertia.z, zero)};
    wide_sym i = world_inverse_inertia(axes, inverse);
    wide mass = w_choose(moves, v.w, zero), g = w_choose(moves, *(wide *)scale, zero);
    wide3 linear = {g * c->gravity.x + mass * force.x, g * c->gravity.y + mass * force.y,
                    g * c->gravity.z + mass * force.z};
    wide damping = w_choose(moves, one / (1.0f + c->h * force.w), one),
         spin_damping = w_choose(moves, one / (1.0f + c->h * torque.w), one);
    store_line(s->velocity, line, (wide4){v.x * there, v.y * there, v.z * there, mass},
               (wide4){w.x * there, w.y * there, w.z * there, w.w * there});
    store_line(s->motion, line, (wide4){zero, zero, zero, *(wide *)gyroscopic * there}, (wide4){zero, zero, zero, one});
    store_line(s->inertia, line, (wide4){i.xx, i.xy, i.xz, i.yy},
               (wide4){i.yz, i.zz, *(wide *)gyroscopic * there, zero});
    store_line(s->drive, line, w_with(linear, damping), w_with(w_mul(&i, w_xyz(torque)), spin_damping));
    store_line(s->axes, line, axes, (wide4){inertia.x, inertia.y, inertia.z, zero});
    if (joined) store_moved(s, line, w_sub(w_xyz(w), w_xyz(BODY_QUAD(relaxed))));
    for (int k = 0; k < FE_W && locked; ++k) {
        const fe__body *b = body[k];
        const float *a = s->axes[line + k].rotation;
        if (b->locked && b->type == FE_BODY_DYNAMIC) lock_line(s, b, line + k, (fe_quat){a[0], a[1], a[2], a[3]});
    }
}

static void load(fe__solver *s, const fe__records *of, int32_t first, int32_t count, const fe__step_constants *c)
{
    for (int32_t i = first; i < first + count; i += FE_W) load_block(s, of, i, c);
}

// ---- gyroscopic torque ----------------------------------------------------------------------------------------------
// In principal axes  I w' + w x I w = 0.  Implicit midpoint, I (m - w) + h/2 m x I m = 0, w2 = 2 m - w, keeps the
// energy and |I w|; two Newton steps from m = w solve it. The result is brought to the energy before: two steps leave
// some of it open, and rounding would take a share in each substep.

// rad/s about a principal axis, two centuries a turn; also of the axes, what they lean. The torque is quadratic in both
#define LEAST_SPIN 1e-9f

// m - J^-1 f, J = I + h/2 ([m] I - [I m]), by cofactors; m itself where J is not safe to invert
FE_INLINE wide3 newton(wide3 m, wide3 w, wide3 in, wide3 d)
{
    wide3 f = {in.x * (m.x - w.x) + d.x * m.y * m.z, in.y * (m.y - w.y) + d.y * m.z * m.x,
               in.z * (m.z - w.z) + d.z * m.x * m.y};
    wide xy = d.x * m.z, xz = d.x * m.y, yx = d.y * m.z, yz = d.y * m.x, zx = d.z * m.y, zy = d.z * m.x;
    wide3 c0 = {in.y * in.z - yz * zy, yz * zx - yx * in.z, yx * zy - in.y * zx};
    wide3 c1 = {xz * zy - xy * in.z, in.x * in.z - xz * zx, xy * zx - in.x * zy};
    wide3 c2 = {xy * yz - xz * in.y, xz * yx - in.x * yz, in.x * in.y - xy * yx};
    wide det = in.x * c0.x + xy * c0.y + xz * c0.z, safe = in.x * in.y * in.z * 0.25f;
    wide k = w_choose(w_greater(det, safe), 1.0f / det, w_set(0.0f));
    wide3 e = w_add_scaled(w_add_scaled(w_scale(f.x, c0), f.y, c1), f.z, c2);
    return w_sub_scaled(m, k, e);
}

FE_INLINE wide twice_energy(wide3 w, wide3 in) { return in.x * w.x * w.x + in.y * w.y * w.y + in.z * w.z * w.z; }

// what the spin changes by in h, world axes of before
FE_INLINE wide3 free_change(wide3 world, wide4 axes, wide3 in, wide half_h)
{
    wide least = w_set(LEAST_SPIN);
    axes = w_with(w_flush3(w_xyz(axes), least), axes.w);
    wide3 w = w_flush3(w_add(world, w_turn_back(axes, world)), least);
    wide3 d = {half_h * (in.z - in.y), half_h * (in.x - in.z), half_h * (in.y - in.x)};
    wide3 m = newton(w_flush3(newton(w, w, in, d), least), w, in, d);
    wide3 w2 = w_flush3(w_sub(w_add(m, m), w), w_set(FE__LEAST_SPEED));
    // k = sqrt(before / after) is 1 but for rounding, whose root is more often below 1 than above: so k - 1, of the
    // difference of the energies, in.(w - w2) (w + w2)
    wide3 change = w_sub(w2, w), sum = w_add(w2, w);
    wide before = twice_energy(w, in), after = twice_energy(w2, in);
    wide gained = in.x * change.x * sum.x + in.y * change.y * sum.y + in.z * change.z * sum.z;
    wide excess = gained * w_inverse_or_zero(after + w_sqrt(before) * w_sqrt(after));
    change = w_sub_scaled(change, excess, w2);
    return w_add(change, w_turn(axes, change)); // only the change is turned: w keeps its digits
}

// ---- velocities -----------------------------------------------------------------------------------------------------
FE_INLINE wide_mask is_joined(wide kind) { return w_greater(kind, w_set(FE__GYROSCOPIC_FREE)); }

// The gyroscopic torque of joined bodies. Of free ones it acts while they rotate; a joint must have balanced it before
// its bodies move, or they move apart. Spins hold for the move from pose to pose, like the v of a leapfrog; the torque
// is that of the pose between two moves, by spins w1 and w2. The midpoint rule keeps energy and momentum with the mean
//     (w1 + w2) / 2 = w1 + (d + c) / 2,
// d what the constraints add from move to move, c the change by the torque. Without d a heavy top tilts by some
// h/2 w x w' per second, and a disc that a hinge holds askew slows down: there d and c are nearly opposite, and each is
// far larger than their sum. Of d the warm start is known; what the solution will change about it is about what relax
// changed last, back: it leads the velocities half a substep ahead. So w1, `moved`, is taken before relax.
// A blow is no d that goes on: what is more than STEADY of the spin is left out. Nor is there a d to go by where the
// locks' warm start was taken back (tree/warm_start.inl): what relax changed is then more than what is left of it.
#define STEADY 0.1f
FE_INLINE wide3 joined_change(const fe__solver *s, int32_t i, wide kind, wide3 w, wide3 warm, wide half_h)
{
    wide3 moved = w_xyz(w_gather(s->moved_spin[i], 4, w_in_order));
    wide4 axes = w_product(load_high(s->motion, i), load_low(s->axes, i)), principal = load_high(s->axes, i);
    wide3 relaxed = w_sub(w, moved), ahead = w_sub(w_scale(w_set(0.5f), warm), relaxed);
    wide_mask blow = w_greater(w_dot(ahead, ahead), STEADY * STEADY * w_dot(w, w));
    wide_mask steady = w_and(w_greater(w_dot(warm, warm), w_dot(relaxed, relaxed)), w_not(blow));
    wide3 base = w_choose3(steady, w_add(w, ahead), w);
    wide3 change = free_change(base, axes, w_xyz(principal), half_h);
    return w_choose3(is_joined(kind), change, (wide3){w_set(0.0f), w_set(0.0f), w_set(0.0f)});
}

FE_INLINE wide3 within(wide3 v, float speed)
{
    wide square = w_dot(v, v), most = w_set(speed);
    wide_mask fast = w_greater(square, most * most);
    return w_any(fast) ? w_scale(w_choose(fast, most / w_sqrt(square), w_set(1.0f)), v) : v;
}

// f(v): all that changes a velocity and is no constraint and no gyroscopic torque: gravity and forces, damping
// 1 / (1 + h c), the speed limit
FE_INLINE void advance(const fe__solver *s, int32_t i, const fe__step_constants *c, wide3 *v, wide3 *w)
{
    wide4 linear, angular;
    load_line(s->drive, i, &linear, &angular);
    *v = w_scale(linear.w, w_add_scaled(*v, w_set(c->h), w_xyz(linear)));
    *w = w_scale(angular.w, w_add_scaled(*w, w_set(c->h), w_xyz(angular)));
    *v = within(*v, c->max_speed);
    // no -0: then what adds nothing, +0 or -0, leaves each bit as it is, and may be left out (contact/idle.inl)
    *v = w_add(*v, w_zero3()), *w = w_add(*w, w_zero3());
}

// the first substep: v0 = f(v). The rows' warm start adds to v; start keeps v0.
static void begin_velocities(fe__solver *s, int32_t first, int32_t count, const fe__step_constants *c)
{
    for (int32_t i = first; i < first + count; i += FE_W) {
        wide4 v, w;
        load_line(s->velocity, i, &v, &w);
        wide3 v0 = w_xyz(v), w0 = w_xyz(w);
        wide kind = load_low(s->motion, i).w;
        advance(s, i, c, &v0, &w0);
        store_line(s->velocity, i, w_with(v0, v.w), w_with(w0, w.w));
        store_line(s->start, i, w_with(v0, v.w), w_with(w0, kind));
    }
}

// The gyroscopic torque of joined bodies in the first substep, when the rows' warm start is known
static void balance_spins(fe__solver *s, int32_t first, int32_t count, const fe__step_constants *c)
{
    for (int32_t i = first; i < first + count; i += FE_W) {
        wide4 start = load_high(s->start, i);
        if (!w_any(is_joined(start.w))) continue;
        wide4 spin = load_high(s->velocity, i);
        wide3 w = w_xyz(spin), w0 = w_xyz(start);
        wide3 change = joined_change(s, i, start.w, w0, w_sub(w, w0), w_set(0.5f * c->h));
        store_high(s->velocity, i, w_with(w_add(w, change), spin.w));
        store_high(s->start, i, w_with(w_add(w0, change), start.w));
    }
}

// The next substeps. Warm starting adds M^-1 J^T l, summed over a body's constraints; J, M and l are those that the
// last substep ended with, and it began from `start` with no constraint impulse: the sum is d = v - start.
static void carry_velocities(fe__solver *s, int32_t first, int32_t count, const fe__step_constants *c)
{
    for (int32_t i = first; i < first + count; i += FE_W) {
        wide4 v, w, start, spin;
        load_line(s->velocity, i, &v, &w), load_line(s->start, i, &start, &spin);
        wide3 v0 = w_flush3(w_xyz(v), w_set(FE__LEAST_SPEED)), w0 = w_flush3(w_xyz(w), w_set(FE__LEAST_SPEED));
        wide3 dv = w_sub(v0, w_xyz(start)), dw = w_sub(w0, w_xyz(spin));
        if (w_any(is_joined(spin.w))) w0 = w_add(w0, joined_change(s, i, spin.w, w0, dw, w_set(0.5f * c->h)));
        advance(s, i, c, &v0, &w0);
        store_line(s->start, i, w_with(v0, v.w), w_with(w0, spin.w));
        store_line(s->velocity, i, w_with(w_add(v0, dv), v.w), w_with(w_add(w0, dw), w.w));
    }
}

// The spin is the body's own while it rotates: w + c at the end of the substep, in axes that rotated by Q. Returns the
// mean spin w + c/2, by which the body rotates: Q = Cayley(h (w + c/2)) then takes the angular momentum of the midpoint
// rule back to where it was, exactly, and leaves w + c/2 alone. So  w' = Q (w + c) = w + c + (Q - 1) c/2,  and what
// changed leaves the warm start alone: start changes as much.
FE_INLINE wide3 turn_freely(fe__solver *s, int32_t i, wide kind, wide4 turned, const fe__step_constants *c)
{
    wide4 stored = load_high(s->velocity, i);
    wide3 w = w_flush3(w_xyz(stored), w_set(FE__LEAST_SPEED));
    wide_mask gyroscopic = w_and(w_greater(kind, w_set(0.0f)), w_not(w_greater(kind, w_set(FE__GYROSCOPIC_FREE))));
    if (!w_any(gyroscopic)) return w;
    wide4 principal = load_high(s->axes, i), start = load_high(s->start, i);
    wide half_h = w_set(0.5f * c->h);
    wide3 change = free_change(w, w_product(turned, load_low(s->axes, i)), w_xyz(principal), half_h);
    wide3 half = w_scale(w_set(0.5f), change), mean = w_choose3(gyroscopic, w_add(w, half), w),
          u = w_scale(half_h, mean);
    wide k = 1.0f / w_sqrt(1.0f + w_dot(u, u));
    change = w_add(change, w_turn(w_with(w_scale(k, u), k), half));
    store_high(s->velocity, i, w_with(w_choose3(gyroscopic, w_add(w, change), w_xyz(stored)), stored.w));
    store_high(s->start, i, w_with(w_choose3(gyroscopic, w_add(w_xyz(start), change), w_xyz(start)), start.w));
    return mean;
}

// dp += h v, dq = normalize(dq + h/2 (w, 0) dq)
static void integrate_positions(fe__solver *s, int32_t first, int32_t count, const fe__step_constants *c)
{
    for (int32_t i = first; i < first + count; i += FE_W) {
        wide4 p, q;
        load_line(s->motion, i, &p, &q);
        wide3 half = w_scale(w_set(0.5f * c->h), turn_freely(s, i, p.w, q, c));
        if (w_any(is_joined(p.w))) store_moved(s, i, w_xyz(load_high(s->velocity, i)));
        wide3 u = w_add(w_xyz(q), w_add(w_scale(q.w, half), w_cross(half, w_xyz(q))));
        u = w_flush3(u, w_set(FE__LEAST_SPEED));
        wide a = q.w - w_dot(half, w_xyz(q));
        wide k = 1.0f / w_sqrt(w_dot(u, u) + a * a);
        wide3 v = within(w_xyz(load_low(s->velocity, i)), c->max_speed);
        store_line(s->motion, i, w_with(w_add_scaled(w_xyz(p), w_set(c->h), v), p.w), w_with(w_scale(k, u), k * a));
    }
}

const fe__body_kernels FE_NAME(fe__body_kernels) = {.load = load,
                                                    .begin_velocities = begin_velocities,
                                                    .balance_spins = balance_spins,
                                                    .carry_velocities = carry_velocities,
                                                    .integrate_positions = integrate_positions};
