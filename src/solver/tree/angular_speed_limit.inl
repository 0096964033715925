// angular_speed_limit.inl - trees whose links turn too fast for a substep lose energy, but no momentum. Part of
// tree_solver.simd.c.
//
// After an impact a light link between heavy ones may turn by several turns in a substep. No elimination says where its
// arms lead then, and what it finds holds energy that nobody gave. So the motion is parted in two. The first part is
// that of one rigid body: it has all the momentum and angular momentum, with the least energy. The rest has none. It is
// scaled until no arm turns farther than MOST_TURN. Velocities along locks are scaled with it: what moved as the joints
// allow still does. If the tree hangs on a body, the first part is that body's motion.

// of an arm in a substep, rad: the tangent leaves the circle by an eighth of the arm. A crank that turns so fast by
// itself loses its spin to the positions anyway
#define MOST_TURN 0.5
// A wheel turns as fast as it will about the middle of its hub: shorter arms are none, m
#define LEAST_ARM 0.01

// Velocities as they are, and places of the centres: from the first, or from that of what the tree hangs on, m
static void place_links(const pass *t)
{
    for (int32_t i = 0; i < t->count; ++i) {
        tree_node *n = t->nodes + i;
        const tree_node *above = above_of(t, i);
        const velocity now = read_velocity(t, &n->line);
        n->v = now.v, n->w = now.w;
        n->place = is_root(t, i) ? r_zero3() : r_add(r_sub(n->above, n->below), n->gap);
        if (above) n->place = r_add(n->place, above->place);
    }
}

// The motion of a rigid body: of the point at `centre`
typedef struct rigid_motion {
    velocity of;
    real3 centre;
} rigid_motion;

// With the momentum and the angular momentum of the tree: v = p / m, w = I^-1 L about the centre of mass
static rigid_motion motion_as_one(const pass *t)
{
    real all = r_set(0.0);
    rigid_motion m = {{r_zero3(), r_zero3()}, r_zero3()};
    for (const tree_node *n = t->nodes, *end = n + t->count; n < end; ++n) {
        all += n->mass;
        m.of.v = r_add_scaled(m.of.v, n->mass, n->v), m.centre = r_add_scaled(m.centre, n->mass, n->place);
    }
    m.of.v = r_scale(1.0 / all, m.of.v), m.centre = r_scale(1.0 / all, m.centre);
    real_sym inertia = {r_set(0.0), r_set(0.0), r_set(0.0), r_set(0.0), r_set(0.0), r_set(0.0)};
    real3 momentum = r_zero3();
    for (const tree_node *n = t->nodes, *end = n + t->count; n < end; ++n) {
        const real3 r = r_sub(n->place, m.centre);
        const mass at_centre = mass_at(n->mass, &n->inertia, r);
        add_sym(&inertia, &at_centre.d);
        momentum = r_add(momentum, r_mul_sym(&n->inertia, n->w));
        momentum = r_add_scaled(momentum, n->mass, r_cross(r, r_sub(n->v, m.of.v)));
    }
    const real_sym inverse = inverse_sym(&inertia);
    m.of.w = r_mul_sym(&inverse, momentum);
    return m;
}

// h |w x r| / (r + LEAST_ARM), squared
FE_INLINE real turn_of(real3 r, real3 w, real h)
{
    const real3 way = r_scale(h, r_cross(w, r));
    const real arm = r_sqrt(r_dot(r, r)) + LEAST_ARM;
    return r_dot(way, way) / (arm * arm);
}

// The farthest that an arm turns against the rigid motion, squared
static real farthest_turn(const pass *t, const rigid_motion *m)
{
    real most = r_set(0.0);
    for (int32_t i = 0; i < t->count; ++i) {
        const tree_node *n = t->nodes + i, *above = above_of(t, i);
        if (is_root(t, i)) continue;
        most = r_max(most, turn_of(n->below, r_sub(n->w, m->of.w), t->h));
        if (above) most = r_max(most, turn_of(n->above, r_sub(above->w, m->of.w), t->h));
    }
    return most;
}

FE_INLINE void add_to_line(void *of, const line_names *line, int32_t lanes, velocity change)
{
    lines l = read_lines(of, line);
    narrow3(l.a, r_add(widen3(l.a), change.v)), narrow3(l.a + 4, r_add(widen3(l.a + 4), change.w));
    write_lines(of, line, lanes, &l);
}

// In lanes that turn fast. `start` changes as much, so that no warm start repeats it. Bodies of which something is
// locked have no such motion as one.
static void calm(const pass *t, int32_t lanes)
{
    if (!lanes || t->locks) return;
    place_links(t);
    const rigid_motion m =
        is_root(t, 0) ? motion_as_one(t) : (rigid_motion){read_velocity(t, &t->nodes[0].line_above), r_zero3()};
    const real most = farthest_turn(t, &m);
    lanes &= r_bits(r_greater(most, r_set(MOST_TURN * MOST_TURN)));
    if (!lanes) return;
    const real share = MOST_TURN / r_sqrt(r_max(most, r_set(DBL_MIN))) - 1.0;
    for (int32_t i = 0; i < t->count; ++i) {
        const tree_node *n = t->nodes + i;
        const real3 as_one = r_add(m.of.v, r_cross(m.of.w, r_sub(n->place, m.centre)));
        const velocity change = {r_scale(share, r_sub(n->v, as_one)), r_scale(share, r_sub(n->w, m.of.w))};
        add_to_line(t->solver->velocity, &n->line, lanes, change);
        add_to_line(t->solver->start, &n->line, lanes, change);
    }
}
