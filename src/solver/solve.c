// solve.c - runs the substeps: a program of passes for each batch.
//
// A small batch is run whole by one worker, its rows in that worker's stretch of row memory. A large one is run by all
// workers together: they walk the same program, claim blocks of each pass, their own first, and go on when the last
// block of a pass is done. Both walk the same passes over the same groups in the same order of colours, so that who
// executes a batch never shows.
#include "solver/solve.h"

#include "core/memory.h"
#include "solver/pace.h"
#include "solver/tree/tree_solver.h"

#include <assert.h>
#include <string.h>

enum {
    LANES_IN_BLOCK = 64,  // rows of a block, in contacts: a microsecond of work
    LINES_IN_BLOCK = 256, // a multiple of FE__MAX_WIDTH
    // colours are merged into one block while they have no more contacts: a barrier would cost more than they do
    SERIAL_LANES = 128,
    // the graph is built anew when it is so old, in steps, and has more than this part of its rows mixed
    STEPS_OF_GRAPH = 32,
    MIXED_SHARE = 8,
    LANES_PER_WORKER = 128 // a large batch calls a worker for so many contacts of its largest colour
};

// Constants of a substep of a batch; of the last one of a small batch; of all its relax passes but the last
typedef struct paced {
    fe__step_constants usual, last, more;
} paced;

typedef enum verb {
    LOAD,
    PREPARE,
    BALANCE,
    SOLVE,
    FOLLOW,
    INTEGRATE,
    RELAX,
    BOUNCE,
    PASS_ON,
    CARRY,
    STORE,
    RESTORE,
    RECEIVE
} verb;

typedef struct program {
    int32_t rows_in_block;
    fe__pass *passes;
    int32_t room;                        // for so many of them
    int32_t prologue, substep, epilogue; // passes each; the last substep leaves out its last pass
    int32_t substeps;
} program;

typedef struct job {
    fe__solver *s;
    const fe__kernels *k;
    const fe__records *of; // by home
    paced paces[FE__PACES];
    const fe__batch *batch; // large
    program program;
    fe__shares shares;
    _Alignas(FE_CACHE_LINE) _Atomic uint64_t done; // blocks of all passes so far: the only line that they wait on
    _Alignas(FE_CACHE_LINE) _Atomic int32_t next_batch;
} job;

fe__softness fe__make_softness(float hertz, float damping_ratio, float h)
{
    // an implicit spring and damper of that frequency: w / a1, a2 a3, a3
    float omega = 2.0f * FE_PI * hertz, a1 = 2.0f * damping_ratio + h * omega, a2 = h * omega * a1,
          a3 = 1.0f / (1.0f + a2);
    return (fe__softness){omega / a1, a2 * a3, a3};
}

// ---- the program of a batch -----------------------------------------------------------------------------------------
static int32_t blocks_of(int32_t items, int32_t block) { return (items + block - 1) / block; }

static void add_pass(program *p, int32_t *part, verb verb, int32_t first_group, int32_t groups, int32_t blocks,
                     int32_t serial)
{
    int32_t i = p->prologue + p->substep + p->epilogue;
    assert(i < p->room);
    p->passes[i] = (fe__pass){(int32_t)verb, first_group, groups, blocks, serial};
    ++*part;
}

static int32_t colour_end(const fe__solver *s, int32_t group, int32_t end)
{
    int32_t colour = s->groups[group].colour;
    while (group < end && s->groups[group].colour == colour) ++group;
    return group;
}

static void number_blocks(const program *p, fe__solver *s, const fe__batch *b)
{
    int32_t blocks = 0;
    for (fe__group *g = s->groups + b->first_group, *end = g + b->group_count; g < end; ++g) {
        g->block = blocks;
        blocks += blocks_of(g->rows, p->rows_in_block);
    }
}

static int32_t block_count(const program *p, const fe__solver *s, int32_t group, int32_t end)
{
    const fe__group *last = s->groups + end - 1;
    return last->block + blocks_of(last->rows, p->rows_in_block) - s->groups[group].block;
}

// By bisection: the overflow is a group a contact
static const fe__group *group_of_block(const fe__group *g, int32_t count, int32_t block)
{
    while (count > 1) {
        int32_t half = count / 2;
        if (g[half].block <= block)
            g += half, count -= half;
        else
            count = half;
    }
    return g;
}

static int32_t lane_count(const fe__solver *s, int32_t group, int32_t end)
{
    int32_t lanes = 0;
    for (; group < end; ++group) lanes += s->groups[group].rows * s->groups[group].width;
    return lanes;
}

// one pass a colour; neighbouring colours with few rows are one serial pass, as is the overflow
static void add_colours(program *p, int32_t *part, const fe__solver *s, const fe__batch *b, verb verb)
{
    int32_t end = b->first_group + b->group_count;
    for (int32_t g = b->first_group + (verb == BOUNCE ? b->joint_groups : 0); g < end;) {
        int32_t last = colour_end(s, g, end), serial = lane_count(s, g, last) <= SERIAL_LANES || s->groups[g].alone;
        while (serial && last < end) {
            int32_t next = colour_end(s, last, end);
            if (!s->groups[last].alone && lane_count(s, last, next) > SERIAL_LANES) break;
            last = next;
        }
        add_pass(p, part, verb, g, last - g, serial ? 1 : block_count(p, s, g, last), serial);
        g = last;
    }
}

static int32_t first_tree_group(const fe__batch *b) { return b->first_group + b->joint_groups - b->tree_groups; }

static void add_trees(program *p, int32_t *part, const fe__batch *b, verb verb)
{
    if (b->tree_groups) add_pass(p, part, verb, first_tree_group(b), b->tree_groups, b->tree_groups, 0);
}

static void make_program(program *p, fe__solver *s, const fe__batch *b, int32_t substeps, int32_t width)
{
    int32_t line_blocks = blocks_of(b->line_count, LINES_IN_BLOCK), end = b->first_group + b->group_count;
    p->passes = s->passes;
    p->room = s->pass_capacity;
    p->prologue = p->substep = p->epilogue = 0;
    p->substeps = substeps;
    p->rows_in_block = LANES_IN_BLOCK / width;
    number_blocks(p, s, b);
    add_pass(p, &p->prologue, LOAD, 0, 0, line_blocks, 0);
    add_colours(p, &p->prologue, s, b, PREPARE);
    add_trees(p, &p->prologue, b, RESTORE);
    if (b->joint_count) add_pass(p, &p->prologue, BALANCE, 0, 0, line_blocks, 0);
    add_colours(p, &p->substep, s, b, SOLVE);
    add_trees(p, &p->substep, b, FOLLOW);
    add_pass(p, &p->substep, INTEGRATE, 0, 0, line_blocks, 0);
    add_colours(p, &p->substep, s, b, RELAX);
    if (b->bounces) add_colours(p, &p->substep, s, b, BOUNCE);
    if (b->bounces) add_pass(p, &p->substep, PASS_ON, b->first_group, b->group_count, 1, 1);
    add_trees(p, &p->substep, b, RECEIVE);
    add_pass(p, &p->substep, CARRY, 0, 0, line_blocks, 0);
    if (b->group_count)
        add_pass(p, &p->epilogue, STORE, b->first_group, b->group_count, block_count(p, s, b->first_group, end), 0);
}

static int32_t pass_count(const program *p) { return p->prologue + p->substeps * p->substep - 1 + p->epilogue; }

// the i-th pass to run
static const fe__pass *pass_at(const program *p, int32_t i)
{
    int32_t looped = p->substeps * p->substep - 1;
    if (i < p->prologue) return p->passes + i;
    if (i - p->prologue < looped) return p->passes + p->prologue + (i - p->prologue) % p->substep;
    return p->passes + p->prologue + p->substep + (i - p->prologue - looped);
}

// ---- one block of one pass ------------------------------------------------------------------------------------------
// Continuous collision follows the path that fast bodies really took, round a bounce too: the straight line to where
// they ended may cut what they never met.
static void begin_trails(const job *j, int32_t first, int32_t count, const fe__step_constants *c)
{
    float dt = (float)c->substeps * c->h;
    for (int32_t i = first; i < first + count; ++i) {
        const fe__body *body = fe__body_of_line(j->s, j->of, i);
        int32_t fast = body && body->speed * dt > body->thickness;
        j->s->trail_count[i] = fast ? 0 : FE__NO_TRAIL;
        if (fast) j->s->trail_of[i] = atomic_fetch_add_explicit(&j->s->trails, 1, memory_order_relaxed);
    }
}

static void leave_trails(const job *j, int32_t first, int32_t count, const fe__step_constants *c)
{
    // the world's substeps, whatever the batch's
    int32_t stride = c->division * fe__trail_stride(c->substeps / c->division);
    if (!atomic_load_explicit(&j->s->trails, memory_order_relaxed)) return;
    for (int32_t i = first; i < first + count; ++i) {
        if (j->s->trail_count[i] == FE__NO_TRAIL) continue;
        int32_t substeps = ++j->s->trail_count[i];
        if (substeps % stride == 0) j->s->trail[j->s->trail_of[i]][substeps / stride - 1] = j->s->motion[i];
    }
}

static void run_lines(const job *j, const fe__batch *b, verb verb, int32_t block, const fe__step_constants *c)
{
    int32_t first = b->first_line + block * LINES_IN_BLOCK,
            count = fe__mini(LINES_IN_BLOCK, b->first_line + b->line_count - first);
    const fe__body_kernels *k = j->k->body;
    if (verb == LOAD) k->load(j->s, j->of, first, count, c);
    if (verb == LOAD) k->begin_velocities(j->s, first, count, c);
    if (verb == LOAD) begin_trails(j, first, count, c);
    if (verb == BALANCE) k->balance_spins(j->s, first, count, c);
    if (verb == INTEGRATE) k->integrate_positions(j->s, first, count, c);
    if (verb == INTEGRATE) leave_trails(j, first, count, c);
    if (verb == INTEGRATE && b->bounces) memset(j->s->touches_of + first, 0, (size_t)count);
    if (verb == CARRY) k->carry_velocities(j->s, first, count, c);
}

static void run_joints(const job *j, const fe__group *g, verb verb, unsigned char *rows, int32_t first, int32_t count,
                       const fe__step_constants *c)
{
    const fe__joint_kernel *k = fe__joint_kernels_of(j->k, g->width)->of + (g->kind - FE__ROW_KINDS);
    unsigned char *row = rows + g->offset + (int64_t)first * k->row_size;
    const fe__lane *lanes = j->s->lanes + g->lane + first * g->width;
    switch (verb) {
    case PREPARE:
        k->prepare(j->s, j->of, lanes, row, count, g->sides, c);
        break;
    case SOLVE:
        k->solve(j->s, row, count, g->sides, c);
        break;
    case RELAX:
        k->relax(j->s, row, count, g->sides, c);
        break;
    case STORE:
        k->store(j->s, j->of, lanes, row, count, c);
        break;
    case LOAD:
    case BALANCE:
    case FOLLOW:
    case INTEGRATE:
    case BOUNCE:
    case PASS_ON:
    case CARRY:
    case RESTORE:
    case RECEIVE:
        break;
    }
}

static void run_trees(const job *j, const fe__group *g, verb verb, unsigned char *rows, const fe__step_constants *c)
{
    const fe__tree_job trees = {.solver = j->s,
                                .of = j->of,
                                .trees = j->s->trees + g->lane,
                                .count = g->trees,
                                .rows = rows,
                                .nodes = rows + g->offset,
                                .h = (double)c->h,
                                .rate = (double)(c->h * c->joint.bias_rate),
                                .mean = (double)(c->inverse_h / (float)c->substeps),
                                .warm_scale = (double)c->warm_scale,
                                .stored = (double)c->division,
                                .open = (double)c->open};
    const fe__forest_kernels *k = fe__forest_kernels_of(j->k, g->trees);
    if (verb == PREPARE) k->prepare(&trees);
    if (verb == RESTORE) k->restore(&trees);
    if (verb == SOLVE) k->solve(&trees);
    if (verb == FOLLOW) k->follow(&trees);
    if (verb == RELAX) k->relax(&trees);
    if (verb == RECEIVE) k->receive(&trees);
    if (verb == STORE) k->store(&trees);
}

// Stored impulses are those of the world's substeps
static void scale_impulses(const job *j, const fe__group *g, const fe__lane *lanes, int32_t rows, float scale)
{
    for (const fe__lane *lane = lanes, *end = lanes + rows * g->width; lane < end; ++lane) {
        if (!lane->contact) continue;
        const fe__records *of = j->of + lane->home;
        fe__points *q = of->points + lane->points;
        for (int k = 0; k < FE__POINTS; ++k) q->normal_impulse[k] *= scale;
        for (int k = 0; k < 3; ++k) q->friction_impulse[k] *= scale;
        q->twist_impulse *= scale;
        for (int k = 0; k < 3 && g->kind & FE__ROW_SPECIAL; ++k) of->extras[lane->points].rolling_impulse[k] *= scale;
    }
}

static void run_rows(const job *j, const fe__group *g, verb verb, unsigned char *rows, int32_t first, int32_t count,
                     const fe__step_constants *c)
{
    if (g->kind == FE__TREE_KIND) {
        run_trees(j, g, verb, rows, c);
        return;
    }
    if (g->kind >= FE__ROW_KINDS) {
        run_joints(j, g, verb, rows, first, count, c);
        return;
    }
    const fe__contact_kernels *k = fe__contact_kernels_of(j->k, g->width);
    unsigned char *row = rows + g->offset + (int64_t)first * k->row_size[g->kind];
    const fe__lane *lanes = j->s->lanes + g->lane + first * g->width;
    switch (verb) {
    case PREPARE:
        k->prepare[g->kind](j->s, j->of, lanes, row, count, c);
        break;
    case SOLVE:
        k->solve[g->kind](j->s, j->of, lanes, row, count, c);
        break;
    case RELAX:
        k->relax[g->kind](j->s, j->of, lanes, row, count, c);
        break;
    case BOUNCE:
        k->bounce[g->kind](j->s, row, count, c);
        break;
    case STORE:
        atomic_fetch_add_explicit(&j->s->mixed, k->store[g->kind](j->of, lanes, row, count), memory_order_relaxed);
        if (c->division > 1) scale_impulses(j, g, lanes, count, (float)c->division);
        break;
    case LOAD:
    case BALANCE:
    case FOLLOW:
    case INTEGRATE:
    case PASS_ON:
    case CARRY:
    case RESTORE:
    case RECEIVE:
        break;
    }
}

static void run_block(const job *j, const fe__batch *b, const fe__pass *p, unsigned char *rows, int32_t block)
{
    int32_t rows_in_block = j->program.rows_in_block;
    const fe__step_constants *c = &j->paces[b->pace].usual;
    if (!p->group_count) {
        run_lines(j, b, (verb)p->verb, block, c);
        return;
    }
    if (p->verb == PASS_ON) {
        fe__pass_on(j->s, j->k, j->of, b, rows, c);
        return;
    }
    const fe__group *g = j->s->groups + p->first_group;
    if (p->serial) {
        for (int32_t i = 0; i < p->group_count; ++i) run_rows(j, g + i, (verb)p->verb, rows, 0, g[i].rows, c);
        return;
    }
    block += g->block;
    g = group_of_block(g, p->group_count, block);
    int32_t first = (block - g->block) * rows_in_block;
    run_rows(j, g, (verb)p->verb, rows, first, fe__mini(rows_in_block, g->rows - first), c);
}

// ---- a small batch, whole -------------------------------------------------------------------------------------------
static void run_all(const job *j, const fe__batch *b, verb verb, unsigned char *rows, const fe__step_constants *c)
{
    const fe__group *groups = j->s->groups + b->first_group;
    int32_t of_lines = verb == LOAD || verb == BALANCE || verb == INTEGRATE || verb == CARRY,
            line_blocks = blocks_of(b->line_count, LINES_IN_BLOCK);
    for (int32_t i = 0; i < line_blocks && of_lines; ++i) run_lines(j, b, verb, i, c);
    for (int32_t i = 0; i < b->group_count && !of_lines; ++i) run_rows(j, groups + i, verb, rows, 0, groups[i].rows, c);
}

static void run_all_trees(const job *j, const fe__batch *b, verb verb, unsigned char *rows, const fe__step_constants *c)
{
    const fe__group *groups = j->s->groups + first_tree_group(b);
    for (int32_t i = 0; i < b->tree_groups; ++i) run_trees(j, groups + i, verb, rows, c);
}

static void run_batch(const job *j, const fe__batch *b, unsigned char *rows)
{
    const paced *pace = j->paces + b->pace;
    const fe__step_constants *c = &pace->usual;
    run_all(j, b, LOAD, rows, c);
    run_all(j, b, PREPARE, rows, c);
    run_all_trees(j, b, RESTORE, rows, c);
    if (b->joint_count) run_all(j, b, BALANCE, rows, c);
    for (int32_t n = 0; n < c->substeps; ++n) {
        run_all(j, b, SOLVE, rows, c);
        run_all_trees(j, b, FOLLOW, rows, c);
        run_all(j, b, INTEGRATE, rows, c);
        for (int32_t i = 1; i < c->sweeps; ++i) {
            run_all(j, b, RELAX, rows, &pace->more);
            run_all_trees(j, b, RECEIVE, rows, c);
        }
        run_all(j, b, RELAX, rows, n + 1 < c->substeps ? c : &pace->last);
        if (b->bounces) run_all(j, b, BOUNCE, rows, c);
        if (b->bounces) fe__pass_on(j->s, j->k, j->of, b, rows, c);
        run_all_trees(j, b, RECEIVE, rows, c);
        if (n + 1 < c->substeps) run_all(j, b, CARRY, rows, c);
    }
    run_all(j, b, STORE, rows, c);
}

static void run_small_batches(void *argument, int32_t worker)
{
    job *j = argument;
    unsigned char *rows = (unsigned char *)j->s->rows + worker * j->s->worker_row_bytes;
    for (;;) {
        int32_t i = atomic_fetch_add_explicit(&j->next_batch, 1, memory_order_relaxed);
        if (i >= j->s->batch_count) return;
        run_batch(j, j->s->batches + i, rows);
    }
}

// ---- a large batch, together ----------------------------------------------------------------------------------------
typedef struct walk {
    int32_t worker;
    uint32_t pass;  // from 1
    uint64_t after; // blocks that are done when this pass is
} walk;

static void run_blocks(job *j, const fe__pass *p, const walk *w, fe__reach reach)
{
    uint64_t finished = 0;
    fe__claims claims = fe__claims_of(w->worker);
    for (int32_t block; (block = fe__shares_claim(&j->shares, &claims, reach, w->pass, p->blocks)) >= 0; ++finished)
        run_block(j, j->batch, p, (unsigned char *)j->s->rows, block);
    if (finished > 0) atomic_fetch_add_explicit(&j->done, finished, memory_order_acq_rel);
}

// The others are nearly done too, as a rule: who helped them at once would take lines of memory from them for nothing.
// Who has waited helps.
static void finish_pass(job *j, const fe__pass *p, const walk *w)
{
    enum { SPINS_BEFORE_HELP = 32, SPINS_BEFORE_YIELD = 2000 }; // one or two microseconds; a tenth of a millisecond
    for (int32_t spins = 0; atomic_load_explicit(&j->done, memory_order_acquire) < w->after; ++spins) {
        if (spins == SPINS_BEFORE_HELP) run_blocks(j, p, w, FE__ALL_SHARES);
        if (spins < SPINS_BEFORE_YIELD)
            fe__pause();
        else
            fe__yield();
    }
}

static void run_large_batch(void *argument, int32_t index)
{
    job *j = argument;
    int32_t count = pass_count(&j->program);
    walk w = {.worker = fe__shares_join(&j->shares)};
    (void)index;
    for (int32_t i = 0; i < count; ++i) {
        const fe__pass *p = pass_at(&j->program, i);
        w.pass += 1;
        w.after += (uint64_t)p->blocks;
        run_blocks(j, p, &w, FE__OWN_SHARES);
        finish_pass(j, p, &w);
    }
}

static int32_t useful_workers(const fe__solver *s, const fe__batch *b, int32_t workers)
{
    int32_t most = 0, end = b->first_group + b->group_count;
    for (int32_t g = b->first_group; g < end;) {
        int32_t last = colour_end(s, g, end);
        most = fe__maxi(most, lane_count(s, g, last));
        g = last;
    }
    return fe__mini(workers, fe__maxi(1, most / LANES_PER_WORKER));
}

static void clear_static_line(fe__solver *s)
{
    if (s->touches_of) s->touches_of[FE__STATIC_LINE] = 0;
    for (int32_t i = 0; i < FE__MAX_WIDTH; ++i) {
        s->velocity[i] = (fe__velocity_line){0};
        s->motion[i] = (fe__motion_line){.rotation = {0.0f, 0.0f, 0.0f, 1.0f}};
        s->start[i] = (fe__start_line){0};
        s->inertia[i] = (fe__inertia_line){0};
        s->drive[i] = (fe__drive_line){0};
        s->axes[i] = (fe__axes_line){0};
    }
}

// A load strains from its second step on: one that is over within a step was an impact
static uint32_t flag_of_strain(fe__solver *s, const fe__batch *b, const fe__body *body)
{
    if (b->pace == FE__STRAINED || body->flags & FE__BODY_BURDENED) return FE__BODY_STRAINED;
    s->burdened = 1;
    return FE__BODY_BURDENED;
}

// the marks of the lines to the bodies, and all that is true of an island's bodies to `found`
static void note_marks(fe__solver *s, const fe__records *of, const fe__batch *b, uint32_t *found, uint32_t joined)
{
    for (int32_t line = b->first_line; line < b->first_line + b->line_count; ++line) {
        fe__body *body = fe__body_of_line(s, of, line);
        if (!body || body->type != FE_BODY_DYNAMIC) continue;
        float mark = s->inertia[line].mark;
        uint32_t flag = 0;
        if (mark == (float)FE__STRAINED) flag = flag_of_strain(s, b, body);
        if (mark == (float)FE__STRETCHED) flag = FE__BODY_STRETCHED;
        body->flags = (body->flags & ~(uint32_t)(FE__BODY_STRAINED | FE__BODY_BURDENED | FE__BODY_STRETCHED)) | flag;
        found[body->island] |= body->flags & (FE__BODY_STRAINED | FE__BODY_STRETCHED);
        if (body->joint_count) found[body->island] |= joined;
    }
}

static int32_t has_pace(const fe__solver *s, const fe__records *of, const fe__batch *b, const uint32_t *found,
                        uint32_t joined)
{
    for (int32_t line = b->first_line; line < b->first_line + b->line_count; ++line) {
        const fe__body *body = fe__body_of_line(s, of, line);
        if (!body || body->type != FE_BODY_DYNAMIC) continue;
        if (fe__pace_of(found[body->island], (found[body->island] & joined) != 0) != b->pace) return 0;
    }
    return 1;
}

// Strained and stretched islands of the next step are those with a body that was in this one; another set of them is
// another graph.
static void note_strain(fe__solver *s, const fe__records *of)
{
    const uint32_t joined = 1; // a bit that is none of the two flags
    int32_t any = atomic_load_explicit(&s->strained, memory_order_relaxed) | s->burdened;
    uint32_t *found = (uint32_t *)(void *)s->rows; // no longer in use
    for (int32_t i = 0; i < s->batch_count; ++i) any |= s->batches[i].pace;
    if (!any) return;
    s->burdened = 0;
    memset(found, 0, sizeof *found * (size_t)s->island_count);
    for (int32_t i = 0; i < s->batch_count - 1; ++i)
        if (i >= s->large_count || s->batches[i].joint_count) note_marks(s, of, s->batches + i, found, joined);
    for (int32_t i = 0; i < s->batch_count - 1; ++i)
        if (i >= s->large_count || s->batches[i].joint_count)
            s->graph_changed |= !has_pace(s, of, s->batches + i, found, joined);
}

// A group has one row at most in which loose contacts lie beside others, when it is built. As loads come and go there
// are more, and what could be skipped is not.
static void note_mixed(fe__solver *s, int32_t width)
{
    int32_t rows = s->lane_count / width, mixed = atomic_load_explicit(&s->mixed, memory_order_relaxed);
    if (++s->graph_age >= STEPS_OF_GRAPH && mixed > s->group_count + rows / MIXED_SHARE) s->graph_changed = 1;
}

static void set_constants(job *j, const fe__step_constants *constants)
{
    for (int32_t i = 0; i < FE__PACES; ++i) {
        paced *pace = j->paces + i;
        pace->usual = pace->last = pace->more = constants[i];
        pace->last.finds_strain = i != FE__STRETCHED;
        pace->more.more = 1;
    }
}

void fe__solve(fe__solver *s, const fe__kernels *kernels, const fe__workers *workers, const fe__records *of,
               const fe__step_constants constants[FE__PACES])
{
    job j = {.s = s, .k = kernels, .of = of};
    set_constants(&j, constants);
    clear_static_line(s);
    atomic_store(&s->trails, 0);
    atomic_store(&s->strained, 0);
    atomic_store(&s->chained, 0);
    atomic_store(&s->mixed, 0);
    for (int32_t i = 0; i < s->large_count; ++i) {
        j.batch = s->batches + i;
        make_program(&j.program, s, j.batch, constants[j.batch->pace].substeps, kernels->width);
        int32_t useful = useful_workers(s, j.batch, workers->count);
        fe__shares_begin(&j.shares, useful);
        atomic_store(&j.done, 0);
        fe__run(workers, run_large_batch, &j, useful);
    }
    atomic_store(&j.next_batch, s->large_count);
    fe__run(workers, run_small_batches, &j, fe__mini(workers->count, s->batch_count - s->large_count));
}

void fe__note_solved(fe__solver *s, const fe__kernels *kernels, const fe__records *of)
{
    if (!s->batch_count) return;
    note_strain(s, of);
    note_mixed(s, kernels->width);
}
