// solver.h - TGS Soft: what a step solves, and the kernels that solve it.
//
// The graph (graph.c) sorts awake bodies and linked contacts into batches: small islands, several to a batch, each
// solved whole by one worker; an island above FE__ISLAND_LARGE contacts is a batch of its own, spread over the workers
// colour by colour. Which of the two an island gets changes its result only where small ones are strained, see solve.c.
// In a batch, contacts lie in groups by (colour, kind of row); a group's contacts share no dynamic body, W of them make
// a row.
//
// The kernels (*.simd.c) are compiled once per SIMD set into a table; the world picks one at its creation.
#ifndef FE_SOLVER_SOLVER_H
#define FE_SOLVER_SOLVER_H
#include "collision/manifold/terrain_course.h"
#include "core/sort.h"
#include "core/math.h"
#include "core/memory.h"
#include "core/threads.h"
#include "solver/contact/contact_solver.h"
#include "solver/contact/skip_test.h"
#include "solver/solver_body.h"
#include "solver/joint/joint_solver.h"
#include "solver/tree/lock.h"

enum {
    FE__LINE = 8,        // floats in a line: two quads, 32 bytes
    FE__MAX_WIDTH = 16,  // lanes of the widest kernel: blocks of lines are padded to it
    FE__THIN_WIDTH = 4,  // lanes of the narrowest
    FE__STATIC_LINE = 0, // all zeros: what static bodies read
    FE__TRAIL = 8,       // most places on the path of a fast body
    FE__NO_TRAIL = -1,

    // kinds of rows, bits
    FE__ROW_PAIR = 1,    // both bodies are dynamic; otherwise A is static or kinematic and only B is written
    FE__ROW_SINGLE = 2,  // one point: a sphere is in it
    FE__ROW_SPECIAL = 4, // locks, restitution, rolling or spinning resistance, surface velocity, a kinematic body
    FE__ROW_KINDS = 8,

    FE__PAIR_COLOURS = 96,     // of contacts between dynamic bodies: 0..95, in mates: an even number
    FE__STATIC_COLOURS = 31,   // of contacts with static and kinematic ones: 96..126, solved last
    FE__OVERFLOW_COLOUR = 127, // one contact a row, in order of creation
    FE__COLOURS = 128,

    // contacts above which an island is spread over the workers, and up to which smaller ones are batched, so that the
    // rows of a batch stay in a second-level cache and fill their lanes. Constants, not the machine's: they decide who
    // executes an island, never what comes out
    FE__ISLAND_LARGE = 1024,
    FE__BATCH_CONTACTS = 512
};

// What decays (a residual speed, an impulse that is needed no more) would end among the denormals, below 1.2e-38, whose
// arithmetic takes some 150 cycles an operation on many processors. So it ends sooner, by a comparison, the same on
// every machine: a magnitude below these is 0. They are far below what shows, and far enough above the denormals that
// products of two, by inverse masses, are normal.
#define FE__LEAST_SPEED 1e-15f   // m/s, rad/s: a micrometre in 30 years. Also of a rotation's x y z w
#define FE__LEAST_IMPULSE 1e-18f // N s: 1e-9 m/s of the lightest body, 1e-9 kg
#define FE__LEAST_TWIST 1e-24f   // N m s: 1e-6 rad/s of the least moment of inertia, 1e-18 kg m2
#define FE__LEAST_SHIFT 1e-12f   // m, of what slid since its contact was found
// Of unit vectors, rotations and inertias against the world's axes: what leans less lies along them. A sixtieth of a
// unit of a float's last place
#define FE__LEAST_LEAN 1e-9f

// An implicitly integrated spring and damper (Catto, Soft Constraints, GDC 2011)
typedef struct fe__softness {
    float bias_rate, mass_scale, impulse_scale;
} fe__softness;

// The substeps of an island, see solve.c
enum { FE__USUAL, FE__STRAINED, FE__STRETCHED, FE__PACES };

// Hertz are limited to what the substeps can follow, as shares of their rate (step/solve_stage.c says why)
#define FE__MOST_CONTACT_HERTZ 0.125f
#define FE__MOST_JOINT_HERTZ 0.225f

typedef struct fe__step_constants {
    float h, inverse_h;       // of a substep, s
    float bias_speed;         // overlap is corrected no faster, m/s
    float threshold;          // of restitution, m/s
    float impact;             // m/s; what stops more in a substep was an impact
    float warm_scale;         // h now / h of the stored impulses
    float contact_warm_scale; // that, or 0: contacts begin without them
    float max_speed;          // m/s
    float speculative;        // m
    // m/s; what a load of one step could do to its two bodies, from which on it strains their island
    float strain;
    float open; // m2; square of a joint's gap from which on its island is stretched
    int32_t substeps;
    int32_t division;     // substeps to one of the world's: 1, more in strained and stretched islands
    int32_t sweeps;       // relax passes over the contacts in a substep
    int32_t more;         // 1: this is not the last of them
    int32_t finds_strain; // 1: this is the last pass of a step
    fe_vec3 gravity;
    fe__softness between_dynamic, against_static, joint;
    float joint_hertz; // at most, 1/s
} fe__step_constants;

// What the kernels know of a body: a line of each kind, two quads, which they load and store whole
typedef struct fe__velocity_line {
    _Alignas(16) float v[3]; // m/s
    float inverse_mass;      // 1/kg
    float w[3];              // rad/s
    float lock_bits;
} fe__velocity_line;

// Since the step began
typedef struct fe__motion_line {
    _Alignas(16) float shift[3]; // of the centre, m
    float gyroscopic;            // FE__GYROSCOPIC_*
    float rotation[4];           // x y z w
} fe__motion_line;

// Velocities before the constraint impulses of this substep
typedef struct fe__start_line {
    _Alignas(16) float v[3];
    float inverse_mass;
    float w[3];
    float gyroscopic;
} fe__start_line;

typedef struct fe__inertia_line {
    _Alignas(16) fe__sym3 inverse; // world
    float gyroscopic;
    float mark; // FE__STRAINED, FE__STRETCHED when the body turned out to be
} fe__inertia_line;

// Changes of velocity that no constraint makes; c: the damping, 1/s
typedef struct fe__drive_line {
    _Alignas(16) float linear[3]; // acceleration by gravity and forces, m/s2
    float linear_damping;         // 1/(1 + h c)
    float angular[3];             // by torques, rad/s2
    float angular_damping;
} fe__drive_line;

// Of the principal inertia, when the step began
typedef struct fe__axes_line {
    _Alignas(16) float rotation[4]; // x y z w, world
    float principal[3];             // moments, kg m2
    float zero;
} fe__axes_line;

#define FE__IS_LINE(type) _Static_assert(sizeof(type) == sizeof(float) * FE__LINE, #type)
FE__IS_LINE(fe__velocity_line);
FE__IS_LINE(fe__motion_line);
FE__IS_LINE(fe__start_line);
FE__IS_LINE(fe__inertia_line);
FE__IS_LINE(fe__drive_line);
FE__IS_LINE(fe__axes_line);

// How the gyroscopic torque acts on a body. Most bodies have none, and their moments are never read.
enum {
    FE__GYROSCOPIC_NONE,
    FE__GYROSCOPIC_FREE,  // while it rotates, see turn_freely
    FE__GYROSCOPIC_JOINED // before the constraints are solved, see joined_change
};

// Lanes of one group: `count` rows of one kind at `row` (bytes into the batch's row memory), lanes from `lane`
typedef struct fe__group {
    int32_t lane; // first
    int32_t rows;
    int32_t width;  // lanes of a row: W, or FE__THIN_WIDTH; W of a tree, which is work for several
    int32_t kind;   // FE__ROW_*, or FE__ROW_KINDS + part of joints, or FE__TREE_KIND: see `trees`
    int32_t colour; // rises; groups of one share no dynamic body
    int32_t sides;  // FE__MOVES_*, of joints
    int32_t trees;  // side by side, of fe__solver.trees from `lane` on
    int32_t alone;  // 1: overflow, one row after another
    int32_t block;  // of a large batch: first one, of all blocks of its groups, see solve.c
    int64_t offset; // of the first row, bytes
} fe__group;

typedef struct fe__batch {
    int32_t first_line, line_count;    // a multiple of FE__MAX_WIDTH
    int32_t first_group, group_count;  // joints' first
    int32_t joint_groups, tree_groups; // the trees' are the last of the joints'
    int32_t contact_count, joint_count, body_count, island_count;
    int32_t lane_count; // contacts and parts of joints
    int32_t bounces;    // special rows are in it
    int32_t pace;       // of its islands, FE__USUAL...
    int64_t row_bytes;
} fe__batch;

typedef struct fe__lane {
    int32_t contact;        // or joint. 0 is none: record 0 is zeros
    int32_t points;         // of the contact
    int32_t line_a, line_b; // FE__STATIC_LINE for static
    int32_t home;           // among the fe__records
} fe__lane;

// What lanes name: records of one world. Worlds that are solved together have one each
typedef struct fe__records {
    const fe__contact *contacts;
    fe__points *points;
    fe__extra *extras;       // NULL while no row is special
    const uint64_t *serials; // of the pairs, two for each record of points
    fe__body *bodies;
    fe__joints joints;        // its arrays and its forest
    int32_t first_place;      // among fe__solver.places: of the forest's first link
    _Atomic int32_t *engaged; // fe__solver.engaged of the world
} fe__records;

// A tree of the forest of such a world; a body of it, -1: none
typedef struct fe__tree_name {
    int32_t home, tree;
} fe__tree_name;
typedef struct fe__body_name {
    int32_t home, body;
} fe__body_name;

enum {
    FE__JOINT_KEYS = FE__PARTS * (FE__JOINT_COLOURS + 1), // colours of joints' groups: part, then colour
    FE__TREE_KIND = FE__ROW_KINDS + FE__PARTS,
    FE__TREE_COLOUR = FE__JOINT_KEYS, // trees share no dynamic body
    FE__CONTACT_COLOURS               // contacts' come after them
};

typedef struct fe__row_block {
    _Alignas(64) unsigned char bytes[64];
} fe__row_block;

// One pass of all workers over part of a large batch, see solve.c
typedef struct fe__pass {
    int32_t verb;
    int32_t first_group, group_count; // of consecutive colours
    int32_t blocks;
    int32_t serial; // one block, groups in order
} fe__pass;

enum {
    FE__NO_TOUCH = -1,
    FE__TOUCHES_CHAINED = 4 // beside the count of a line's touches: it is in a chain of impacts
};

// In the ring of a line's touches
typedef struct fe__touch_link {
    int32_t next, previous;
} fe__touch_link;

// A contact with restitution of a chain of impacts, see impact_chain.c
typedef struct fe__touch {
    float when;      // s into the substep
    float change[2]; // of the velocities of A and B in it, m/s
    int32_t lane;    // of the solver's
    int32_t line[2]; // FE__STATIC_LINE for what is not dynamic
    fe__touch_link link[2];
    int32_t listed; // an entry of a list of touches
    int32_t fast;   // than the threshold of restitution
    int32_t flags;
    int32_t impacts; // that it had in this substep
} fe__touch;

// What the last graph was made of, by kind of row
typedef struct fe__built {
    int32_t contacts[FE__ROW_KINDS]; // that have a colour
    int32_t colours[FE__ROW_KINDS];  // of them
    int32_t overflow;                // contacts that have none
} fe__built;

typedef struct fe__solver {
    // lines of bodies, W at a time. The block of FE__STATIC_LINE is zeros and read only
    fe__velocity_line *velocity;
    fe__motion_line *motion;
    fe__start_line *start;
    fe__inertia_line *inertia;
    fe__drive_line *drive;
    fe__axes_line *axes;
    float (*moved_spin)[4]; // by line of FE__GYROSCOPIC_JOINED: by what it rotated in the last substep, rad/s, 0
    int32_t line_count, line_capacity[7];
    fe__body_name *body_of_line; // by index: a graph lives on when the world's bodies move to a larger array
    int32_t body_of_line_capacity;

    // Where bodies that are fast when the step begins went: `motion` after each fe__trail_stride substeps
    int16_t *trail_count;                // by line: substeps so far; FE__NO_TRAIL: a slow one
    int32_t *trail_of;                   // by line of a fast one: its trail
    fe__motion_line (*trail)[FE__TRAIL]; // in no order that matters; behind the rows
    _Atomic int32_t trails;              // taken in this step
    int32_t trail_capacity[2];

    uint8_t *touches_of; // by line: contacts with restitution that touched in this substep, as far as two
    int32_t *touch_of;   // by line: the first of its touches in a chain
    fe__touch *touches;  // of a batch: from its first lane, see impact_chain.c
    int32_t touch_capacity[3];
    _Atomic int32_t chained; // 1: two of them shared a body, in this step

    _Atomic int32_t strained; // 1: a line is strained or stretched, in this step
    int32_t burdened;         // 1: some body is FE__BODY_BURDENED
    _Atomic int32_t engaged;  // light trees that were solved in this step
    _Atomic int32_t mixed;    // rows of this step with loose contacts, see graph.h, and others

    // the graph (graph.c), kept while nothing links, unlinks, wakes or sleeps
    int32_t graph_changed;
    int32_t graph_age; // steps
    fe__built built;
    int32_t unbuilt;    // contacts that were linked, or woke, or go to another kind of row since: at most
    fe__batch *batches; // large islands first, kinematic bodies last
    int32_t batch_count, batch_capacity, large_count;
    fe__group *groups; // of a batch: by rising colour
    int32_t group_count, group_capacity;
    fe__lane *lanes;
    int32_t lane_count, lane_capacity;
    fe__tree_place *places; // by link of the forest; of trees that are awake
    int32_t place_capacity;
    fe__tree_name *trees; // that are awake, those of a group one after another
    int32_t tree_count, tree_capacity;
    fe__pass *passes; // of the large batch at hand
    int32_t pass_capacity;
    int32_t island_count;
    fe__sort_item *sort_items;
    int32_t sort_capacity;

    // of the large batch at hand, or one stretch of worker_row_bytes for each worker; scratch of the graph's build, and
    // of whoever sorts while neither builds nor solves
    fe__row_block *rows;
    int32_t row_capacity; // blocks
    int64_t worker_row_bytes;
} fe__solver;

// NULL: padding
static inline fe__body *fe__body_of_line(const fe__solver *s, const fe__records *of, int32_t line)
{
    const fe__body_name name = s->body_of_line[line];
    return name.body < 0 ? NULL : of[name.home].bodies + name.body;
}

static inline int32_t fe__trail_stride(int32_t substeps) { return (substeps + FE__TRAIL - 1) / FE__TRAIL; }

// What is done with touches of a chain of impacts, see impact_chain.c
typedef enum fe__touch_act {
    FE__TOUCH_TAKE,    // what it gave in this substep leaves the velocities
    FE__TOUCH_RETURN,  // and returns
    FE__TOUCH_FORGET,  // the impulses that were taken
    FE__TOUCH_PASS_ON, // it, one alone, bounces if it closes; did it?
    FE__TOUCH_BOUNCE   // as if it were alone
} fe__touch_act;

// Passes over the rows of a group: `rows` is its first row, `lanes` its first lane, `count` rows. One entry for each
// kind of row.
typedef struct fe__contact_kernels {
    int32_t row_size[FE__ROW_KINDS]; // bytes of a row of W contacts
    // contacts to rows; the stored impulses go to the bodies. Rows of contacts without any are put off: solve and relax
    // prepare those that turn out to be needed
    void (*prepare[FE__ROW_KINDS])(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows,
                                   int32_t count, const fe__step_constants *c);
    void (*solve[FE__ROW_KINDS])(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows, int32_t count,
                                 const fe__step_constants *c);
    void (*relax[FE__ROW_KINDS])(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows, int32_t count,
                                 const fe__step_constants *c);
    void (*bounce[FE__ROW_KINDS])(fe__solver *s, void *rows, int32_t count, const fe__step_constants *c);
    // touches whose bodies have another one, to `out`; `near`: contacts without impulse of bodies in a chain. `lane`:
    // the first. How many
    int32_t (*touches[FE__ROW_KINDS])(const fe__solver *s, const void *rows, int32_t count, int32_t lane, int32_t near,
                                      const fe__step_constants *c, fe__touch *out);
    int32_t (*act[FE__ROW_KINDS])(fe__solver *s, void *row, uint32_t lanes, fe__touch_act act,
                                  const fe__step_constants *c); // lanes of the row
    // returns how many rows have loose contacts and others
    int32_t (*store[FE__ROW_KINDS])(const fe__records *of, const fe__lane *lanes, const void *rows, int32_t count);
} fe__contact_kernels;

// The same for one kind of part of joints. `sides`: FE__MOVES_* of all lanes
typedef struct fe__joint_kernel {
    int32_t row_size;
    void (*prepare)(fe__solver *s, const fe__records *of, const fe__lane *lanes, void *rows, int32_t count,
                    int32_t sides, const fe__step_constants *c);
    void (*solve)(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c);
    void (*relax)(fe__solver *s, void *rows, int32_t count, int32_t sides, const fe__step_constants *c);
    void (*store)(fe__solver *s, const fe__records *of, const fe__lane *lanes, const void *rows, int32_t count,
                  const fe__step_constants *c);
} fe__joint_kernel;

// Passes over trees of one form side by side, each after the same pass over the rows of the joints. `follow` comes
// after the contacts of a soft pass, which know nothing of the joints: what was struck or pinched would fly off.
struct fe__tree_job;
enum { FE__FOREST_WIDTHS = 3 };
typedef struct fe__forest_kernels {
    int32_t lanes;                  // trees side by side
    int32_t head_bytes, link_bytes; // of row memory for so many links of such trees
    void (*prepare)(const struct fe__tree_job *job);
    void (*restore)(const struct fe__tree_job *job); // after the contacts' own, see tree/articulated_mass.inl
    void (*solve)(const struct fe__tree_job *job);
    void (*follow)(const struct fe__tree_job *job);
    void (*relax)(const struct fe__tree_job *job);
    void (*receive)(const struct fe__tree_job *job); // after the contacts' relax and bounces
    void (*store)(const struct fe__tree_job *job);   // of ropes, whose joints have no rows
} fe__forest_kernels;

typedef struct fe__joint_kernels {
    fe__joint_kernel of[FE__PARTS];
    fe__lock_lanes locks; // for the trees
} fe__joint_kernels;

// Passes over lines first..first + count - 1, both multiples of FE__MAX_WIDTH
typedef struct fe__body_kernels {
    void (*load)(fe__solver *s, const fe__records *of, int32_t first, int32_t count, const fe__step_constants *c);
    void (*begin_velocities)(fe__solver *s, int32_t first, int32_t count, const fe__step_constants *c);
    void (*balance_spins)(fe__solver *s, int32_t first, int32_t count, const fe__step_constants *c);
    void (*carry_velocities)(fe__solver *s, int32_t first, int32_t count, const fe__step_constants *c);
    void (*integrate_positions)(fe__solver *s, int32_t first, int32_t count, const fe__step_constants *c);
} fe__body_kernels;

// What recycling says of a contact
enum { FE__STAYS, FE__MOVED, FE__STAYS_APART };

// Separations at the start of the step, of length dt, of contacts that moved little; `fall`: what gravity may add to
// their motion in it, m. Of contact index[i], out[i] is FE__MOVED when it needs a new manifold; FE__STAYS_APART when it
// needs none and has no points: it may move on by out_slack[i], m.
typedef void fe__recycle_kernel(const fe__contact *contacts, fe__points *points, const fe__body *bodies,
                                const int32_t *index, int32_t count, float dt, float fall, uint8_t *out,
                                float *out_slack);

// Of the deferred pairs at `places`, those that may meet in a step of dt seconds, by the bound of skip_test.h: they are
// brought to the front in their order. Returns how many.
typedef int32_t fe__due_kernel(const fe__deferral *deferrals, const fe__odometer *odometers, int32_t *places,
                               int32_t count, float dt);

typedef struct fe__kernels {
    int32_t simd, width; // fe_simd, W
    const fe__contact_kernels *contact;
    const fe__joint_kernels *joint;
    // those of 2, 4 and 8 trees side by side that this set has, narrowest first, then NULL: the same bits from less
    // memory
    const fe__forest_kernels *forest[FE__FOREST_WIDTHS];
    const fe__body_kernels *body;
    fe__recycle_kernel *recycle;
    fe__due_kernel *keep_due;
    fe__course_kernel *meet_course;
    // of FE__THIN_WIDTH lanes, for groups of no more contacts or joints: the same bits from less memory
    const fe__contact_kernels *thin_contact;
    const fe__joint_kernels *thin_joint;
} fe__kernels;

// of a group's width
static inline const fe__contact_kernels *fe__contact_kernels_of(const fe__kernels *kernels, int32_t width)
{
    return width == kernels->width ? kernels->contact : kernels->thin_contact;
}
static inline const fe__joint_kernels *fe__joint_kernels_of(const fe__kernels *kernels, int32_t width)
{
    return width == kernels->width ? kernels->joint : kernels->thin_joint;
}

// the narrowest for so many trees, or the widest there is
static inline const fe__forest_kernels *fe__forest_kernels_of(const fe__kernels *kernels, int32_t trees)
{
    int32_t i = 0;
    while (i + 1 < FE__FOREST_WIDTHS && kernels->forest[i + 1] && kernels->forest[i]->lanes < trees) ++i;
    return kernels->forest[i];
}

// The table of a set, NULL when it was not built or this CPU lacks it. FE_SIMD_AUTO: the environment's FE_SIMD, else
// the widest.
const fe__kernels *fe__kernels_of(int32_t simd);

#endif
