// graph_islands.c - islands by union-find, batches of islands, what is in a batch.
//
// In whatever order the awake lists are: islands share no dynamic body, so that who is solved first does not show.
#include "solver/graph/graph_build.h"

#include "core/disjoint.h"
#include "solver/pace.h"

#include <string.h>

enum { AHEAD = 16 }; // contacts come from the whole of memory: each is fetched so many rounds before it is read, twice

static void join(int32_t *parent, int32_t a, int32_t b)
{
    int32_t x = fe__root_of(parent, a), y = fe__root_of(parent, b);
    if (x < y)
        parent[y] = x;
    else
        parent[x] = y;
}

int32_t fe__graph_is_loose(const fe__contact *m, const fe__points *q)
{
    if (!(m->kind & FE__ROW_PAIR) || m->kind & FE__ROW_SPECIAL) return 0;
    for (int k = 0; k < FE__POINTS; ++k)
        if (q->total_impulse[k] > 0.0f || (k < (int32_t)m->point_count && !(q->separation[k] > 0.0f))) return 0;
    return 1;
}

// of the i-th contact: first its own lines, then its points', which the second names
FE_FETCHES fetch_ahead(const fe__graph_input *in, int32_t i)
{
    if (i + 2 * AHEAD < in->contact_count)
        fe__fetch(in->contacts + in->awake_contacts[i + 2 * AHEAD], sizeof *in->contacts);
    if (i + AHEAD < in->contact_count)
        __builtin_prefetch(in->points + in->contacts[in->awake_contacts[i + AHEAD]].points);
}

// B is dynamic in every contact; A may be anything
static void join_contacts(fe__builder *b)
{
    const fe__graph_input *in = b->in;
    b->linked_count = 0;
    for (int32_t i = 0; i < in->contact_count; ++i) {
        int32_t contact = in->awake_contacts[i];
        const fe__contact *m = in->contacts + contact;
        fetch_ahead(in, i);
        if (m->colour < 0) continue;
        int32_t awake_a = in->bodies[m->body_a].awake_index, awake_b = in->bodies[m->body_b].awake_index;
        b->linked[b->linked_count++] = (fe__linked){contact, m->points, m->colour * FE__ROW_KINDS + m->kind,
                                                    awake_a, awake_b,   fe__graph_is_loose(m, in->points + m->points)};
        if (m->kind & FE__ROW_PAIR) join(b->parent, awake_a, awake_b);
    }
}

static const fe__joint *joint_at(const fe__builder *b, int32_t i)
{
    return b->in->joints->joints + b->in->awake_joints[i];
}

static void join_joints(fe__builder *b)
{
    const fe__body *bodies = b->in->bodies;
    for (int32_t i = 0; i < b->in->joint_count; ++i) {
        const fe__joint *j = joint_at(b, i);
        if (j->colour >= 0 && fe__sides_of(j) == (FE__MOVES_A | FE__MOVES_B))
            join(b->parent, bodies[j->body_a].awake_index, bodies[j->body_b].awake_index);
    }
}

static int32_t island_of_joint(const fe__builder *b, const fe__joint *j)
{
    return b->island_of[b->in->bodies[fe__sides_of(j) & FE__MOVES_B ? j->body_b : j->body_a].awake_index];
}

static void count_constraints(fe__builder *b)
{
    for (int32_t i = 0; i < b->linked_count; ++i) ++b->island_contacts[b->island_of[b->linked[i].awake_b]];
    for (int32_t i = 0; i < b->s->island_count; ++i) b->island_lanes[i] = b->island_contacts[i];
    for (int32_t i = 0; i < b->in->joint_count; ++i) {
        const fe__joint *j = joint_at(b, i);
        if (j->colour < 0) continue;
        ++b->island_joints[island_of_joint(b, j)];
        b->island_lanes[island_of_joint(b, j)] += __builtin_popcount(j->rows & ((1u << FE__PARTS) - 1u));
    }
}

static void find_islands(fe__builder *b)
{
    const fe__graph_input *in = b->in;
    for (int32_t i = 0; i < in->body_count; ++i) b->parent[i] = i;
    join_contacts(b);
    join_joints(b);
    int32_t count = 0;
    for (int32_t i = 0; i < in->body_count; ++i) {
        int32_t is_root = b->parent[i] == i; // else its parent came before it
        if (fe__is_kinematic(fe__awake_body(b, i))) {
            b->island_of[i] = b->kinematic_line[i] = FE__NONE; // no copy in any batch yet
            continue;
        }
        if (is_root) {
            b->island_contacts[count] = b->island_joints[count] = b->island_bodies[count] = b->island_pace[count] = 0;
            b->island_of[i] = count++;
        } else
            b->island_of[i] = b->island_of[b->parent[i]];
        ++b->island_bodies[b->island_of[i]];
        b->island_pace[b->island_of[i]] |=
            (int32_t)(fe__awake_body(b, i)->flags & (FE__BODY_STRAINED | FE__BODY_STRETCHED));
    }
    b->s->island_count = count;
    count_constraints(b);
}

// ---- batches --------------------------------------------------------------------------------------------------------
static fe__batch *open_batch(fe__solver *s)
{
    fe__batch *batch = s->batches + s->batch_count++;
    *batch = (fe__batch){0};
    return batch;
}

static void add_island(fe__builder *b, int32_t island)
{
    fe__batch *batch = b->s->batches + b->s->batch_count - 1;
    batch->contact_count += b->island_contacts[island];
    batch->joint_count += b->island_joints[island];
    batch->lane_count += b->island_lanes[island];
    batch->body_count += b->island_bodies[island];
    ++batch->island_count;
    b->batch_of[island] = b->s->batch_count - 1;
}

static int32_t pace_of(const fe__builder *b, int32_t island)
{
    return fe__pace_of((uint32_t)b->island_pace[island], b->island_joints[island] > 0);
}

// small islands, in order
static void batch_small(fe__builder *b, int32_t pace)
{
    fe__batch *open = NULL;
    for (int32_t i = 0; i < b->s->island_count; ++i) {
        if (b->island_lanes[i] > FE__ISLAND_LARGE || pace_of(b, i) != pace) continue;
        if (!open || open->lane_count + b->island_lanes[i] > FE__BATCH_CONTACTS ||
            open->body_count + b->island_bodies[i] > FE__BATCH_BODIES) {
            open = open_batch(b->s);
            open->pace = pace;
        }
        add_island(b, i);
    }
}

// large islands first, each a batch of its own; then those that take longest
static void make_batches(fe__builder *b)
{
    fe__solver *s = b->s;
    s->batch_count = 0;
    for (int32_t i = 0; i < s->island_count; ++i) {
        if (b->island_lanes[i] <= FE__ISLAND_LARGE) continue;
        fe__batch *large = open_batch(s);
        large->pace = b->island_joints[i] ? pace_of(b, i) : FE__USUAL;
        add_island(b, i);
    }
    s->large_count = s->batch_count;
    for (int32_t pace = FE__PACES - 1; pace >= FE__USUAL; --pace) batch_small(b, pace);
    open_batch(s); // of the kinematic bodies
}

static int32_t batch_of_body(const fe__builder *b, int32_t i)
{
    return b->island_of[i] < 0 ? b->s->batch_count - 1 : b->batch_of[b->island_of[i]];
}

// counts in start[k + 1] become first places; places are then taken by start[k]++ and put right by unwind
static void sum_up(int32_t *start, int32_t count)
{
    for (int32_t k = 0; k < count; ++k) start[k + 1] += start[k];
}

static void unwind(int32_t *start, int32_t count)
{
    for (int32_t k = count; k > 0; --k) start[k] = start[k - 1];
    start[0] = 0;
}

static void sort_by_batch(fe__builder *b)
{
    const fe__graph_input *in = b->in;
    int32_t batches = b->s->batch_count;
    memset(b->body_start, 0, sizeof(int32_t) * (size_t)(batches + 1));
    memset(b->contact_start, 0, sizeof(int32_t) * (size_t)(batches + 1));
    for (int32_t i = 0; i < in->body_count; ++i) ++b->body_start[batch_of_body(b, i) + 1];
    sum_up(b->body_start, batches);
    for (int32_t i = 0; i < in->body_count; ++i) b->body_order[b->body_start[batch_of_body(b, i)]++] = i;
    unwind(b->body_start, batches);
    for (int32_t k = 0; k < batches; ++k)
        b->contact_start[k + 1] = b->contact_start[k] + b->s->batches[k].contact_count;
    for (int32_t i = 0; i < b->linked_count; ++i)
        b->contact_order[b->contact_start[batch_of_body(b, b->linked[i].awake_b)]++] = i;
    unwind(b->contact_start, batches);
    b->joint_start[0] = 0;
    for (int32_t k = 0; k < batches; ++k) b->joint_start[k + 1] = b->joint_start[k] + b->s->batches[k].joint_count;
    for (int32_t i = 0; i < in->joint_count; ++i) {
        const fe__joint *j = joint_at(b, i);
        if (j->colour >= 0) b->joint_order[b->joint_start[b->batch_of[island_of_joint(b, j)]]++] = in->awake_joints[i];
    }
    unwind(b->joint_start, batches);
}

void fe__graph_find_batches(fe__builder *b)
{
    find_islands(b);
    make_batches(b);
    sort_by_batch(b);
}
