// node.inl - a link of the trees that are solved side by side. Part of tree_solver.simd.c.
//
// A joint lets the body below move against the one above along some axes and about some: its freedoms s. All that is
// said of a body is said at the point c of the joint above it, in world axes: velocities (v of c, w), forces (f, torque
// about c). In these P is the mass of a body with all that hangs on it, p the load that hangs on it, r what its joint
// asks for, q how fast the joint gives along its freedoms, k its damping, l the impulse of the joint. With u the change
// of the body's velocity, X u that of the body above at c:
//     P u = p + l,   u = X u_above + r + sum s q,   s.l = -k (q + s.slip)
// The freedoms are eliminated one by one, from the leaves upwards, and met from the root downwards (R. Featherstone,
// "Robot Dynamics Algorithms", 1987: articulated bodies):
//     up     U = P s,  g = 1 / (s.U + k),  P -= g U U^T,  e = g (s.p - k s.slip),  p -= e U
//            P_above += X^T P X,  p_above += X^T (p - P r)
//     down   x = X u_above + r,  l = P x - p,  q = e - g U.x,  x += s q,  u = x in the end
// The points of a joint come together to the last digit, as no row says so: there is no other velocity. The matrices
// follow from positions: they are found once a substep.

// A mass at c: f = a v + b w, torque = b^T v + d w
typedef struct mass {
    real_sym a;
    real_mat b;
    real_sym d;
} mass;

enum { FREEDOMS = 6 };

typedef struct freedom {
    real3 v, w; // U; of a ball joint see eliminate.inl
    real g;
} freedom;

// What is asked for, and what comes of it
typedef struct solution {
    real3 ask_v, ask_w;   // r
    real3 slip;           // of the rotations, rad/s
    real3 load_v, load_w; // p
    real e[FREEDOMS];
    real3 change_v, change_w; // u
} solution;

// of a node: of the velocities, of the positions
enum { SPEEDS, PLACES, SOLUTIONS };

// Translation and rotation
typedef struct six {
    real a[6];
} six;

typedef struct tree_node {
    // Of the step
    line_names line, line_above; // of the bodies below and above
    // Of a ball joint, in each lane: to the x of its impulse in the rows, bytes
    _Alignas(8 * LANES) int64_t point[LANES];
    int32_t width[LANES], sum[LANES];          // floats from there to its y, and to the x of its sum over the step
    half inverse_mass, locks;                  // as the lines of the velocities have them
    real3 first_below, first_above, first_gap; // arms from the centres to a ball joint's point, m
    real_sym first_inertia, first_inverse;     // about the centre, kg m2 and its inverse
    real side;                                 // 1: the body below is B of the joint, -1: A
    real mass;                                 // kg
    // where the bodies are now
    real_mat turn;      // since the step began
    real3 shift;        // m
    real3 below, above; // from the centres of the body below, above to the point, m
    real3 gap, swing;   // what the joint has to bring back to zero, m, rad
    // impulse on the body below at the point when the matrices were found, N s; of a rope, with what came since
    real3 pull;
    real_sym inertia;                          // about the centre, world axes
    real tension, expected, damping, heaviest; // see damping.inl; the largest moment about an axis that is not locked
    // found by the elimination
    real3 from_above; // from the point of the body above to this one, m
    mass p;
    // of one solution
    real3 v, w; // velocities as they are
    real3 rest; // what the points lack to move as one, m/s
    solution of[SOLUTIONS];
    real3 impulse_v, impulse_w; // l
    // of a rope
    real3 given_v, given_w; // by what it changed the velocities in this substep
    real3 total, last;      // impulses of the step, of its last substep on the body below, N s
    freedom free[FREEDOMS]; // found by the elimination, too; of a ball joint the first three
    // seldom read
    real_mat principal;   // turn, but of what the joints' inertia has followed: see FE__ROTATED
    real3 lin[3], ang[3]; // axes of the joint, of which some are freedoms. A ball joint has none: its are the world's
    real rod;             // length of a distance joint, m; else 0
    // of a link that contacts touch, see response.inl
    int32_t touched, heavier; // lanes; those in which the tree makes it heavier
    real light, gives;        // shares of its inverse mass: what contacts see of it, and the mean of all directions
    half part;                // of what contacts see, that of the link alone: 0..1
    real_sym turns, root;     // A of its rotations, and L of L L^T = A
    half seen[6];             // what contacts see of its rotations, xx xy xz yy yz zz, for as long as the step lasts
    real_sym resists;         // the inverse of that
    six x;                    // of the powers
    real3 place;              // of the centre, m: see angular_speed_limit.inl
    lines held, held_start;   // of the velocities when contacts took over
} tree_node;

// A light tree is solved from the substep on in which it opens, but left to the sweep where it was open before
typedef enum tree_state { READY, SOLVED, SWEPT } tree_state;

// In front of the nodes
typedef struct bundle {
    _Alignas(64) int32_t state[LANES]; // tree_state
    int32_t loaded;                    // 1: the nodes have what they keep for the step
    int32_t touched;                   // lanes in which contacts touch a rope
    int32_t lends;                     // lanes in which contacts see the mass of the tree
    int32_t lent;                      // of them, while contacts do
} bundle;

// What a pass over the nodes knows of its trees. Idle lanes do as the first tree does, and write nothing.
typedef struct pass {
    const fe__tree_job *job;
    fe__solver *solver;
    const fe__tree_link *links; // of the first tree: all have one form
    const fe__tree_place *places[LANES];
    const fe__tree_link *links_of[LANES];
    const fe__records *of[LANES];
    int32_t count;  // links
    int32_t kind;   // fe__tree_kind
    int32_t lanes;  // bits of those in use
    uint32_t locks; // of all bodies
    bundle *head;
    tree_node *nodes;
    real h;
    double rate;
} pass;

FE_INLINE tree_node *above_of(const pass *t, int32_t i)
{
    return t->links[i].parent < 0 ? NULL : t->nodes + t->links[i].parent;
}
FE_INLINE int32_t is_ball(const pass *t, int32_t i) { return t->links[i].form & FE__TREE_BALL; }
FE_INLINE int32_t is_root(const pass *t, int32_t i) { return !t->links[i].joint; } // of a tree that hangs on nothing
// x of the impulse of a ball joint, in the rows
FE_INLINE float *point_of(const pass *t, const tree_node *n, int lane)
{
    return (float *)(void *)(t->job->rows + n->point[lane]);
}
