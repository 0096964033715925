// joint_tree.c - finds the trees among the joints, see solver/tree/forest.h. Input: linked joints and masses; output:
// fe__joints.forest.
//
// A sweep is cheaper on large trees. They are solved exactly where it is bad: where some joint bears far more than its
// own bodies weigh.
#include "world/joint_creation.h"

#include "world/joint.h"

// The load on a joint against the effective mass that its stiffness counts with (m w^2), from which on a tree is solved
// at once. Under its own weight such a joint of 60 Hz gives by 32 g / (2 pi 60 Hz)^2 = 2.2 mm: about half the linear
// slop.
#define HEAVY_LOAD 32.0f
// The same for joints that lock rotations: such a row is a beam, which bends with the cube of its length
#define HEAVY_BEAM 4.0f
// A light body may be all that the rest of a tree stands on: a wheel under a cart. Contacts see the mass of a tree that
// is solved at once, which is worth it from this ratio of the parts on that a joint divides a tree into: of its own
// mass, such a body sinks by 128 g / (4 pi 30 Hz)^2 = 9 mm, four of them by 2.2 mm.
#define HEAVY_SUPPORT 128.0f
// The same for a wheel, a body at the end of a tree whose hinge lets it turn all round. It is there to be stood on, and
// light machines have few of them: four of an eighth, of their own masses, sink by 2 g / (2 pi 15 Hz)^2 = 0.5 mm more
// than one solid body at 30 Hz and 4 substeps, where contacts are softest.
#define HEAVY_WHEELED 2.0f

// Levers: the rotation of a body may give way to each of its joints by a share of what the joint's stiffness counts on.
// A sweep meets one joint after the other. Where these shares add up to more than this, it lets a star of joints swing,
// and beyond that gain energy from rounding alone. A chain of spheres or boxes has 0.7, a ragdoll less.
#define HEAVY_LEVERS 1.5f

// A mechanism of locks alone, with nothing that takes energy out of it, keeps its energy and its points where it is
// solved exactly. Up to so many links (a rope, a linkage, a crane) that is worth the cost whatever it bears. A lone
// body is left to the sweep, which has nothing to pass on.
#define SHORTEST_TREE 2
#define SHORT_TREE 32

// 1: rigid, so that it may be met exactly. Springs are not, nor limits
static int32_t is_edge(const fe_world *w, int32_t joint)
{
    const fe__joint *j = w->joints.joints + joint;
    const fe__joint_frame *f = w->joints.frames + joint;
    // a joint with hertz of its own is a spring, unless they are at least those of all rigid joints
    int32_t is_spring = j->hertz > 0.0f && j->hertz < w->tuning.joint_hertz;
    if (j->colour < 0 || is_spring) return 0;
    if (j->rows & FE__LOCKS) return 1;
    if (!(j->rows >> FE__PART_DISTANCE & 1)) return 0;
    const fe__joint_axis *axis = w->joints.axes[f->axes].axis + FE__AXIS_LINEAR;
    return axis->limit.low == axis->limit.high && axis->limit.hertz == 0.0f;
}

static int32_t is_dynamic(const fe_world *w, int32_t body) { return w->bodies[body].type == FE_BODY_DYNAMIC; }

// A door hangs on two hinges. The second of one axis locks what the first does, so that it closes no loop: it is left
// to the sweep.
#define SAME_WAY 0.001f  // m, a fifth of the linear slop
#define SAME_AXIS 0.001f // rad

typedef struct axle {
    fe_vec3 axis, at; // in the frame of one of its bodies
} axle;

static axle axle_of(const float *frame, const float *arm)
{
    const fe_quat q = fe__quat_of(frame);
    return (axle){fe__rotate(q, fe__vec3(1.0f, 0.0f, 0.0f)), fe__vec3(arm[0], arm[1], arm[2])};
}

static int32_t is_hinge(const fe_world *w, int32_t joint)
{
    const uint32_t parts = w->joints.frames[joint].parts, both = 1u << FE__PART_HINGE | 1u << FE__PART_POINT;
    return (parts & both) == both;
}

static int32_t have_one_axle(const fe_world *w, int32_t joint, int32_t other)
{
    const fe__joint *i = w->joints.joints + joint, *j = w->joints.joints + other;
    const fe__joint_frame *f = w->joints.frames + joint, *g = w->joints.frames + other;
    const axle first[2] = {axle_of(f->frame_a, i->arm_a), axle_of(f->frame_b, i->arm_b)};
    const axle second[2] = {axle_of(g->frame_a, j->arm_a), axle_of(g->frame_b, j->arm_b)};
    float along[2], same[2];
    for (int k = 0; k < 2; ++k) {
        fe_vec3 between = fe__sub(second[k].at, first[k].at), across = fe__cross(first[k].axis, between);
        fe_vec3 askew = fe__cross(first[k].axis, second[k].axis);
        if (fe__dot(across, across) > SAME_WAY * SAME_WAY || fe__dot(askew, askew) > SAME_AXIS * SAME_AXIS) return 0;
        along[k] = fe__dot(first[k].axis, between), same[k] = fe__dot(first[k].axis, second[k].axis);
    }
    return same[0] * same[1] > 0.0f && fe__absf(along[1] - along[0]) < SAME_WAY;
}

// 1: an older hinge has the same axis.
static int32_t is_second_hinge(const fe_world *w, int32_t joint)
{
    const int32_t *ends = w->joint_records[joint].body;
    int32_t at = ends[!is_dynamic(w, ends[0])];
    if (is_dynamic(w, ends[1]) && w->bodies[ends[1]].joint_count < w->bodies[at].joint_count)
        at = ends[1]; // the shorter list
    if (!is_hinge(w, joint)) return 0;
    for (int32_t i = w->bodies[at].first_joint; i != joint; i = fe__next_joint(w, i, at)) {
        const int32_t *others = w->joint_records[i].body;
        if (others[0] != ends[0] || others[1] != ends[1] || !is_hinge(w, i) || !is_edge(w, i)) continue;
        if (have_one_axle(w, i, joint)) return 1;
    }
    return 0;
}

// The form of a link, by the translations and rotations that its joint leaves free. Without a joint all are.
static int32_t form_of(const fe_world *w, int32_t joint)
{
    const uint32_t rows = joint ? w->joints.joints[joint].rows : 0;
    const int32_t has_point = (int32_t)(rows >> FE__PART_POINT & 1), has_slide = (int32_t)(rows >> FE__PART_SLIDE & 1),
                  is_rod = (int32_t)(rows >> FE__PART_DISTANCE & 1), has_hinge = (int32_t)(rows >> FE__PART_HINGE & 1),
                  is_fixed = (int32_t)(rows >> FE__PART_FIXED & 1);
    int32_t along = FE__TREE_ALONG, about = FE__TREE_ABOUT;
    if (has_point && !has_hinge && !is_fixed) return FE__TREE_BALL;
    if (is_rod) along = 6;
    if (has_slide && !(w->joints.frames[joint].parts >> FE__PART_POINT & 1))
        along = FE__TREE_ALONG & ~(int32_t)w->joints.frames[joint].locked;
    if (has_point || (has_slide && w->joints.frames[joint].parts >> FE__PART_POINT & 1)) along = 0;
    if (has_hinge) about = 8;
    if (is_fixed) about = 0;
    return along | about | (is_rod ? FE__TREE_ROD : 0);
}

static fe__tree_link link_to(const fe_world *w, int32_t body, int32_t joint, int32_t parent)
{
    return (fe__tree_link){.body = body,
                           .joint = joint,
                           .form = form_of(w, joint),
                           .parent = parent,
                           .holds_b = joint && w->joint_records[joint].body[1] == body};
}

typedef struct component {
    int32_t bodies, edges; // dynamic bodies, joints between them
    int32_t anchors;       // joints to the rest of the world
    int32_t root;          // the anchored body, or else the first that a spring holds, or the first of all
    int32_t anchor;        // the joint that anchors the root, 0: none
    int32_t sprung;        // 1: a spring holds the root
} component;

// Makes a body the root if it was created before the others that may be.
static void offer_root(const fe_world *w, component *c, int32_t body, int32_t sprung)
{
    if (c->anchors || sprung < c->sprung) return;
    if (sprung > c->sprung || w->bodies[body].serial < w->bodies[c->root].serial) c->root = body;
    c->sprung = sprung;
}

// Marks all bodies that hang together with `body`, and writes them to `links`.
static component explore(fe_world *w, int32_t body, fe__tree_link *links)
{
    component c = {.bodies = 1, .root = body};
    links[0].body = body;
    w->bodies[body].flags |= FE__BODY_STARTED;
    for (int32_t i = 0; i < c.bodies; ++i) {
        int32_t at = links[i].body;
        offer_root(w, &c, at, 0);
        for (int32_t joint = w->bodies[at].first_joint; joint; joint = fe__next_joint(w, joint, at)) {
            if (!is_edge(w, joint)) {
                if (w->joints.joints[joint].colour >= 0) offer_root(w, &c, at, 1);
                continue;
            }
            int32_t other = fe__joint_other(w, joint, at);
            if (is_second_hinge(w, joint)) continue;
            if (!is_dynamic(w, other)) {
                ++c.anchors, c.root = at, c.anchor = joint;
                continue;
            }
            c.edges += w->joint_records[joint].body[0] == at; // once, from A
            if (w->bodies[other].flags & FE__BODY_STARTED) continue;
            w->bodies[other].flags |= FE__BODY_STARTED;
            links[c.bodies++].body = other;
        }
    }
    return c;
}

// Writes the links, parents before children, joints of a body in the order of creation.
static void arrange(const fe_world *w, const component *c, fe__tree_link *links)
{
    int32_t count = 1;
    links[0] = link_to(w, c->root, c->anchor, -1);
    for (int32_t i = 0; i < count; ++i) {
        int32_t body = links[i].body;
        for (int32_t joint = w->bodies[body].first_joint; joint; joint = fe__next_joint(w, joint, body))
            if (joint != links[i].joint && is_edge(w, joint) && !is_second_hinge(w, joint))
                links[count++] = link_to(w, fe__joint_other(w, joint, body), joint, i);
    }
}

static int32_t is_wheel(const fe_world *w, int32_t joint, int32_t body)
{
    const fe__joint *j = w->joints.joints + joint;
    if (!is_hinge(w, joint) || w->bodies[body].joint_count != 1) return 0;
    if (!(j->rows >> FE__PART_TWIST & 1)) return 1;
    const fe__joint_axis *twist = w->joints.axes[w->joints.frames[joint].axes].axis + FE__AXIS_TWIST;
    return !(twist->limit.high < FE__UNLIMITED);
}

// The largest load on a joint in its own effective masses, as a share of the load that is heavy for it
static float heaviest_load(const fe_world *w, const component *c, fe__tree_link *links)
{
    const int32_t count = c->bodies, held = c->anchors || c->sprung;
    float most = 0.0f;
    for (int32_t i = 0; i < count; ++i) links[i].carried = w->bodies[links[i].body].mass;
    for (int32_t i = count - 1; i > 0; --i) links[links[i].parent].carried += links[i].carried;
    float total = links[0].carried;
    for (int32_t i = 1; i < count && !held; ++i) {
        const fe__tree_link *l = links + i;
        int32_t on_wheel = is_wheel(w, l->joint, l->body) || is_wheel(w, l->joint, links[l->parent].body);
        float part = fe__minf(l->carried, total - l->carried), heavy = on_wheel ? HEAVY_WHEELED : HEAVY_SUPPORT;
        most = fe__maxf(most, (total - part) / (heavy * part));
    }
    for (int32_t i = 0; i < count; ++i) {
        const fe__tree_link *l = links + i;
        if (!l->joint) continue;
        // masses m and n that pull on each other: 1 / (1/m + 1/n); the world's is infinite
        float inverse = w->bodies[l->body].inverse_mass, load = l->carried;
        if (l->parent >= 0) inverse += w->bodies[links[l->parent].body].inverse_mass;
        if (!held) load = l->carried * ((total - l->carried) / total);
        int32_t is_beam = (w->joints.joints[l->joint].rows & (1u << FE__PART_HINGE | 1u << FE__PART_FIXED)) != 0;
        most = fe__maxf(most, load * inverse / (is_beam ? HEAVY_BEAM : HEAVY_LOAD));
    }
    return most;
}

// trace of K_w = -[r] I^-1 [r], what the body's rotation adds to a point's inverse effective mass, 1/kg:
//     tr K_w = |r|^2 tr I^-1 - r.I^-1 r
static float give_of_rotation(const fe__body *b, const float *arm)
{
    fe_vec3 r = fe__rotate(fe__conjugate(fe__quat_of(b->inertia_axes)), fe__vec3(arm[0], arm[1], arm[2]));
    float x = 1.0f / b->inertia[0], y = 1.0f / b->inertia[1], z = 1.0f / b->inertia[2];
    return r.x * r.x * (y + z) + r.y * r.y * (x + z) + r.z * r.z * (x + y);
}

// Sum over the points that a body is joined at: the part of a point's inverse effective mass (as traces) that is this
// body's rotation
static float levers_of(const fe_world *w, int32_t body)
{
    const uint32_t points = 1u << FE__PART_POINT | 1u << FE__PART_SLIDE;
    float sum = 0.0f;
    for (int32_t i = w->bodies[body].first_joint; i; i = fe__next_joint(w, i, body)) {
        const fe__joint *j = w->joints.joints + i;
        float own = 0.0f, all = 0.0f;
        if (!is_edge(w, i) || !(j->rows & points) || is_second_hinge(w, i)) continue;
        for (int k = 0; k < 2; ++k) {
            int32_t end = w->joint_records[i].body[k];
            if (!is_dynamic(w, end)) continue;
            float give = give_of_rotation(w->bodies + end, k ? j->arm_b : j->arm_a);
            all += 3.0f * w->bodies[end].inverse_mass + give;
            own += end == body ? give : 0.0f;
        }
        sum += own / all;
    }
    return sum;
}

static void keep_tree(fe__forest *f, int32_t count, fe__tree_kind kind, uint32_t locks)
{
    for (int32_t i = f->link_count; i < f->link_count + count; ++i) {
        f->links[i].tree = f->tree_count;
        if (f->links[i].joint) f->link_of[f->links[i].joint] = i;
    }
    f->trees[f->tree_count++] =
        (fe__joint_tree){.first = f->link_count,
                         .count = count,
                         .kind = (int32_t)kind,
                         .locks = locks,
                         .form = fe__form_of_tree(f->links + f->link_count, count, kind, locks)};
    f->link_count += count;
}

// A rotation that needs a response along a locked axis has singular poses. Near them forces have no bound: a spring
// gives there, an exact solution does not. None needs one where all rotations are locked, or two and no translation
// across the third axis (a plane, whose bodies rotate about its normal), or nothing. A lock of one rotation alone is
// nonholonomic: no pose records what it allowed.
static int32_t is_never_singular(uint32_t locks)
{
    const uint32_t linear = locks & FE_AXIS_ALL, angular = locks >> 3;
    const int32_t rotations = __builtin_popcount(~angular & FE_AXIS_ALL); // that are free
    return rotations == 0 || (rotations == 1 && !(linear & angular)) || (rotations == 3 && !linear);
}

// 1: each joint of the body is a lock of the tree: no limit, spring, motor or second hinge, which the sweep meets
static int32_t is_only_locked(const fe_world *w, int32_t body)
{
    const uint32_t others = ((1u << FE__PARTS) - 1) & ~(FE__LOCKS | 1u << FE__PART_DISTANCE);
    for (int32_t i = w->bodies[body].first_joint; i; i = fe__next_joint(w, i, body)) {
        const fe__joint *j = w->joints.joints + i;
        if (j->colour >= 0 && (j->rows & others || !is_edge(w, i) || is_second_hinge(w, i))) return 0;
    }
    return w->bodies[body].lock_bits == 0.0f;
}

// A heavy tree that hangs on nothing lends its mass to contacts (tree/articulated_mass.inl), which a rope does not.
static fe__tree_kind kind_of(const fe_world *w, const component *c, fe__tree_link *links)
{
    const int32_t is_short = c->bodies >= SHORTEST_TREE && c->bodies <= SHORT_TREE;
    int32_t heavy = heaviest_load(w, c, links) >= 1.0f, has_balls_alone = 1;
    for (int32_t i = 0; i < c->bodies && !heavy; ++i) heavy = levers_of(w, links[i].body) > HEAVY_LEVERS;
    int32_t is_mechanism = heavy || is_short;
    for (int32_t i = 0; i < c->bodies && is_mechanism; ++i) is_mechanism = is_only_locked(w, links[i].body);
    for (int32_t i = 0; i < c->bodies; ++i)
        if (links[i].joint && !(links[i].form & FE__TREE_BALL)) has_balls_alone = 0;
    if (is_mechanism && !(heavy && !c->anchors) && has_balls_alone) return FE__TREE_ROPE;
    if (heavy) return FE__TREE_HEAVY;
    return is_mechanism ? FE__TREE_SHORT : FE__TREE_LIGHT;
}

// Finds the component of a body, and keeps it if it is a tree that may be solved exactly.
static void plant(fe_world *w, int32_t body)
{
    fe__forest *f = &w->joints.forest;
    fe__tree_link *links = f->links + f->link_count;
    component c = explore(w, body, links);
    if (c.edges != c.bodies - 1 || c.anchors > 1) return;
    arrange(w, &c, links);
    const float locks = w->bodies[links[0].body].lock_bits;
    for (int32_t i = 1; i < c.bodies; ++i)
        if (w->bodies[links[i].body].lock_bits != locks) return; // bodies that are locked in different ways
    if (is_never_singular((uint32_t)locks)) keep_tree(f, c.bodies, kind_of(w, &c, links), (uint32_t)locks);
}

int32_t fe__find_joint_trees(fe_world *w)
{
    fe__forest *f = &w->joints.forest;
    if (!f->changed) return 1;
    int64_t records = 1 + (int64_t)w->joint_ids.slot_count, bodies = 2 * (int64_t)w->joints.linked;
    if (!FE_RESERVE(&w->memory, f->trees, f->capacity[0], w->joints.linked) ||
        !FE_RESERVE(&w->memory, f->links, f->capacity[1], bodies + (bodies > 0)) ||
        !FE_RESERVE(&w->memory, f->link_of, f->capacity[2], records))
        return 0;
    f->tree_count = f->link_count = 0;
    for (int32_t i = 0; i < (int32_t)records; ++i) f->link_of[i] = -1;
    for (int32_t joint = w->first_joint; joint; joint = w->joint_records[joint].order_next) {
        if (!is_edge(w, joint)) continue;
        const int32_t *ends = w->joint_records[joint].body;
        int32_t body = ends[!is_dynamic(w, ends[0])];
        if (!(w->bodies[body].flags & FE__BODY_STARTED)) plant(w, body);
    }
    for (int32_t joint = w->first_joint; joint; joint = w->joint_records[joint].order_next)
        for (int k = 0; k < 2; ++k) w->bodies[w->joint_records[joint].body[k]].flags &= ~(uint32_t)FE__BODY_STARTED;
    f->changed = 0;
    return 1;
}

void fe__forest_free(fe__forest *forest, fe__memory *memory)
{
    FE_FREE(memory, forest->trees, forest->capacity[0]);
    FE_FREE(memory, forest->links, forest->capacity[1]);
    FE_FREE(memory, forest->link_of, forest->capacity[2]);
}
