// way.c - see way.h.
#include "continuous/motion_path.h"

#include "collision/cast/distance.h"

// Share of its thickness by which a shape may dip into another on its way. What stays out of the other by more than three quarters of its
// half width is pushed out on the side it came from.
#define DIP 0.25f
// A search for impacts goes on so much beyond the first one found, as a share of it: of two at once the one created first counts.
#define BEYOND 1e-9

// ---- where ----------------------------------------------------------------------------------------------------------------------
static const fe__shift no_shift = {.turn = {0.0f, 0.0f, 0.0f, 1.0f}};

static fe_quat forwards(fe_quat q) { return q.w < 0.0f ? (fe_quat){-q.x, -q.y, -q.z, -q.w} : q; }

static fe__shift shift_of(const fe__motion_line *motion)
{
    return (fe__shift){fe__widen(fe__quad_vector(motion->shift)), forwards(fe__quat_of(motion->rotation))};
}

static int32_t moves(const fe__body *body) { return body->awake_index >= 0 && body->line >= 0; }

int32_t fe__way_legs(const fe__step *step, int32_t body)
{
    const fe__body *b = step->world->bodies + body;
    int32_t stride = fe__trail_stride(step->constants.substeps),
            trail = moves(b) && step->world->solver.trail_count[b->line] != FE__NO_TRAIL;
    return trail ? (step->constants.substeps + stride - 1) / stride : 1;
}

double fe__way_time(const fe__step *step, int32_t body, int32_t leg)
{
    int32_t legs = fe__way_legs(step, body), stride = fe__trail_stride(step->constants.substeps);
    return leg >= legs ? 1.0 : (double)(leg * stride) / (double)step->constants.substeps;
}

// where a leg begins
static fe__shift place(const fe__step *step, int32_t body, int32_t leg)
{
    const fe__solver *s = &step->world->solver;
    int32_t line = step->world->bodies[body].line;
    if (leg == 0) return no_shift;
    return shift_of(leg == fe__way_legs(step, body) ? s->motion + line : s->trail[s->trail_of[line]] + leg - 1);
}

static fe_quat between(fe_quat a, fe_quat b, float t)
{
    float side = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w < 0.0f ? -t : t, u = 1.0f - t;
    return fe__normalized((fe_quat){u * a.x + side * b.x, u * a.y + side * b.y, u * a.z + side * b.z, u * a.w + side * b.w});
}

fe__shift fe__shift_between(const fe__shift *a, const fe__shift *b, double t)
{
    if (t <= 0.0) return *a;
    if (t >= 1.0) return *b;
    return (fe__shift){fe__dadd(a->centre, fe__dscale(t, fe__dsub(b->centre, a->centre))), forwards(between(a->turn, b->turn, (float)t))};
}

fe__shift fe__way_at(const fe__step *step, int32_t body, double time)
{
    if (!moves(step->world->bodies + body)) return no_shift;
    int32_t legs = fe__way_legs(step, body), leg = 0;
    while (leg + 1 < legs && fe__way_time(step, body, leg + 1) <= time) ++leg;
    double begin = fe__way_time(step, body, leg), t = (time - begin) / (fe__way_time(step, body, leg + 1) - begin);
    fe__shift a = place(step, body, leg), b = place(step, body, leg + 1);
    return fe__shift_between(&a, &b, t);
}

static fe_quat rotation_of(const fe__body *b) { return (fe_quat){b->rotation[0], b->rotation[1], b->rotation[2], b->rotation[3]}; }
static fe_dvec3 centre_of(const fe__body *b) { return (fe_dvec3){b->centre[0], b->centre[1], b->centre[2]}; }

static int32_t is_still(fe_quat q) { return q.x == 0.0f && q.y == 0.0f && q.z == 0.0f; }

fe__motion fe__way_from(const fe__body *body, const fe__shift *from, const fe__shift *to, fe_dvec3 base)
{
    fe__motion m = {fe__dadd(fe__dsub(centre_of(body), base), from->centre), rotation_of(body), fe__dsub(to->centre, from->centre),
                    fe__identity()};
    if (!is_still(from->turn)) m.rotation = fe__normalized(fe__product(from->turn, m.rotation));
    if (!is_still(from->turn) || !is_still(to->turn)) m.turn = forwards(fe__normalized(fe__product(to->turn, fe__conjugate(from->turn))));
    return m;
}

fe__motion fe__way_between(const fe__step *step, int32_t body, double from, double until, fe_dvec3 base)
{
    fe__shift a = fe__way_at(step, body, from), b = fe__way_at(step, body, until);
    return fe__way_from(step->world->bodies + body, &a, &b, base);
}

fe__mobile fe__way_of_shape(const fe__step *step, const fe__shape *shape, const fe__motion *motion)
{
    const float *c = step->world->bodies[shape->body].local_centre;
    fe_dvec3 centre = {(double)c[0], (double)c[1], (double)c[2]};
    return (fe__mobile){&shape->form, fe__dsub(fe__widen(shape->local_position), centre), shape->local_rotation, *motion};
}

// An angle is no more than pi times the sine of its half
static float length_of(const fe__shift *shift, float reach)
{
    const fe_quat q = shift->turn;
    return (float)sqrt(fe__ddot(shift->centre, shift->centre)) + FE_PI * sqrtf(q.x * q.x + q.y * q.y + q.z * q.z) * reach;
}

float fe__way_length(const fe__step *step, int32_t body)
{
    const fe__body *b = step->world->bodies + body;
    if (!moves(b)) return 0.0f;
    fe__shift end = shift_of(step->world->solver.motion + b->line);
    return length_of(&end, b->reach);
}

// ---- what stands there ------------------------------------------------------------------------------------------------------------
// A leg of a body, on the way through the trees
typedef struct search {
    const fe__step *step;
    int32_t body, against;
    fe_dvec3 base;
    double begin, end;
    fe__motion motion;
    // the first so far
    double s; // of the leg, 1 and more: none
    uint64_t serial;
    fe__obstacle first;
    int32_t barred; // fe__way_is_barred
} search;

static fe__form dipped(const fe__form *form)
{
    fe__form thin = *form;
    float dip = DIP * fe__form_thickness(form);
    if (form->type == FE_GEOMETRY_BOX)
        thin.half = fe__sub(form->half, fe__vec3(dip, dip, dip));
    else
        thin.radius -= dip;
    return thin;
}

static void note(search *s, const fe__impact *deep, const fe__impact *touch, const fe__shape *obstacle, fe_dvec3 normal)
{
    s->s = deep->s;
    s->serial = obstacle->serial;
    s->first = (fe__obstacle){s->begin + touch->s * (s->end - s->begin), normal, fe__dadd(s->base, touch->on_b), obstacle->body};
}

// The dipped form decides whether there is an impact, the whole one when.
static void try_form(search *s, const fe__shape *own, const fe__shape *obstacle, const fe__mobile *other)
{
    fe__form thin = dipped(&own->form);
    fe__mobile mover = fe__way_of_shape(s->step, own, &s->motion);
    fe__impact deep, touch;
    mover.form = &thin;
    double limit = fe__mind(1.0, s->s * (1.0 + BEYOND));
    if (fe__time_of_impact(&mover, other, limit, &deep) != FE_MEET_LATER) return;
    if (deep.s > s->s || (deep.s == s->s && s->serial < obstacle->serial)) return;
    mover.form = &own->form;
    fe__meeting meeting = fe__time_of_impact(&mover, other, deep.s, &touch);
    if (meeting == FE_MEET_NEVER) touch = deep;
    if (touch.overlap) { // boxes that overlapped a little when the leg began
        fe__gap gap;
        fe__pose a = fe__mobile_at(&mover, 0.0), b = fe__mobile_at(other, 0.0);
        fe__form_gap(&thin, &a, other->form, &b, &gap);
        touch.normal = gap.normal, touch.on_b = gap.on_b;
    }
    note(s, &deep, &touch, obstacle, touch.normal);
}

// Does any leg of the way close the gap at its start? The plane across the shortest distance then separates them all the way.
static int32_t may_close(const search *s, const fe__shape *own, const fe__mobile *other)
{
    const fe__step *step = s->step;
    const fe__body *body = step->world->bodies + s->body;
    fe__form thin = dipped(&own->form);
    fe__mobile mover = fe__way_of_shape(step, own, &s->motion);
    mover.form = &thin;
    fe__gap gap;
    fe__pose a = fe__mobile_at(&mover, 0.0), b = fe__mobile_at(other, 0.0);
    fe__form_gap(&thin, &a, other->form, &b, &gap);
    if (gap.overlap || gap.distance <= FE_TOUCH) return 0;
    int32_t legs = fe__way_legs(step, s->body);
    for (int32_t leg = 1; leg <= legs; ++leg) {
        fe__shift at = place(step, s->body, leg);
        fe_dvec3 axis = {(double)at.turn.x, (double)at.turn.y, (double)at.turn.z}, across = fe__dcross(gap.normal, axis);
        double turning = (double)FE_PI * sqrt(fe__ddot(across, across)) * (double)body->reach;
        if (fe__ddot(gap.normal, at.centre) + turning + 2.0 * FE_TOUCH > gap.distance) return 1;
    }
    return 0;
}

static void try_obstacle(search *s, const fe__shape *own, const fe__shape *obstacle, const fe__mobile *other)
{
    if (s->barred < 0) {
        try_form(s, own, obstacle, other);
        return;
    }
    int32_t stands = s->step->world->bodies[obstacle->body].type == FE_BODY_STATIC;
    s->barred |= !stands || may_close(s, own, other);
}

// The triangles under the leg that look at the body's centre: the other side does not count.
static void try_field(search *s, const fe__shape *own, const fe__shape *obstacle, const fe__mobile *other)
{
    const fe_world *w = s->step->world;
    const fe__heightfield *field = w->fields + obstacle->form.field;
    fe__pose pose = fe__mobile_at(other, 0.0);
    fe_dvec3 way = fe__dsub(s->motion.translation, other->motion.translation);
    fe_dvec3 from = fe__drotate_back(pose.rotation, fe__dsub(s->motion.centre, pose.position));
    fe_dvec3 to = fe__dadd(from, fe__drotate_back(pose.rotation, way));
    double reach = (double)w->bodies[s->body].reach;
    fe_dvec3 low = {fe__mind(from.x, to.x) - reach, fe__mind(from.y, to.y) - reach, fe__mind(from.z, to.z) - reach};
    fe_dvec3 high = {fe__maxd(from.x, to.x) + reach, fe__maxd(from.y, to.y) + reach, fe__maxd(from.z, to.z) + reach};
    fe__bounds box = {low, high};
    fe__form triangle;
    fe__mobile part = *other;
    part.form = &triangle;
    part.arm = fe__dadd(other->arm, fe__drotate(other->rotation, from));
    fe__triangle_walk walk = fe__heightfield_walk(field, &box, from);
    while (fe__next_triangle(&walk, &triangle) >= 0 && s->barred <= 0) {
        const fe_vec3 *v = triangle.vertex;
        fe_vec3 up = fe__cross(fe__sub(v[1], v[0]), fe__sub(v[2], v[0]));
        if (fe__dot(up, v[0]) < 0.0f) try_obstacle(s, own, obstacle, &part); // the centre is at the walk's origin
    }
}

static void try_shape(search *s, int32_t shape)
{
    const fe_world *w = s->step->world;
    const fe__shape *obstacle = w->shapes + shape;
    fe__motion motion = fe__way_between(s->step, obstacle->body, s->begin, s->end, s->base);
    fe__mobile other = fe__way_of_shape(s->step, obstacle, &motion);
    for (int32_t i = w->bodies[s->body].first_shape; i >= 0; i = w->shapes[i].next) {
        const fe__shape *own = w->shapes + i;
        if (own->flags & FE__SHAPE_TRIGGER || own->form.type >= FE_GEOMETRY_PLANE || !fe__may_collide(w, i, shape)) continue;
        if (obstacle->form.type == FE_GEOMETRY_HEIGHTFIELD)
            try_field(s, own, obstacle, &other);
        else
            try_obstacle(s, own, obstacle, &other);
    }
}

static int32_t visit(void *context, int32_t shape)
{
    search *s = context;
    const fe_world *w = s->step->world;
    const fe__shape *obstacle = w->shapes + shape;
    int32_t dynamic = w->bodies[obstacle->body].type == FE_BODY_DYNAMIC, wanted = s->against == FE__AGAINST_DYNAMIC;
    if (dynamic != wanted || obstacle->body == s->body || obstacle->flags & FE__SHAPE_TRIGGER) return 1;
    try_shape(s, shape);
    return s->barred <= 0;
}

static void add_place(fe__bounds *box, fe_dvec3 p, double reach)
{
    box->low = (fe_dvec3){fe__mind(box->low.x, p.x - reach), fe__mind(box->low.y, p.y - reach), fe__mind(box->low.z, p.z - reach)};
    box->high = (fe_dvec3){fe__maxd(box->high.x, p.x + reach), fe__maxd(box->high.y, p.y + reach), fe__maxd(box->high.z, p.z + reach)};
}

static void ask(search *s, const fe__bounds *box)
{
    const fe_world *w = s->step->world;
    fe__tree_query(&w->moving_tree, box, visit, s);
    if (s->against == FE__AGAINST_DYNAMIC || s->barred > 0) return;
    fe__tree_query(&w->static_tree, box, visit, s);
    for (int32_t i = 0; i < w->plane_count && s->barred <= 0; ++i) visit(s, w->planes[i]);
}

static search begin(const fe__step *step, int32_t body, int32_t against)
{
    return (search){.step = step,
                    .body = body,
                    .against = against,
                    .base = centre_of(step->world->bodies + body),
                    .end = 1.0,
                    .s = 2.0,
                    .first = {.body = -1},
                    .barred = -1};
}

int32_t fe__way_is_barred(const fe__step *step, int32_t body, int32_t against)
{
    const fe__body *b = step->world->bodies + body;
    search s = begin(step, body, against);
    int32_t legs = fe__way_legs(step, body);
    double reach = (double)b->reach;
    fe__bounds box = {centre_of(b), centre_of(b)};
    for (int32_t leg = 0; leg <= legs; ++leg) add_place(&box, fe__dadd(s.base, place(step, body, leg).centre), reach);
    s.motion = fe__way_between(step, body, 0.0, 1.0, s.base);
    s.barred = 0;
    ask(&s, &box);
    return s.barred;
}

fe__obstacle fe__way_meets(const fe__step *step, int32_t body, int32_t against, const fe__shift *from, const fe__shift *to, double begins,
                           double ends)
{
    const fe__body *b = step->world->bodies + body;
    search s = begin(step, body, against);
    double reach = (double)b->reach;
    s.motion = fe__way_from(b, from, to, s.base);
    s.begin = begins, s.end = ends;
    fe_dvec3 at = fe__dadd(s.base, from->centre);
    fe__bounds box = {at, at};
    add_place(&box, at, reach);
    add_place(&box, fe__dadd(s.base, to->centre), reach);
    ask(&s, &box);
    return s.first;
}

int32_t fe__ways_cross(const fe__step *step, int32_t shape_a, int32_t shape_b)
{
    const fe_world *w = step->world;
    const fe__shape *a = w->shapes + shape_a, *b = w->shapes + shape_b;
    int32_t body = fe__way_legs(step, a->body) > fe__way_legs(step, b->body) ? a->body : b->body, legs = fe__way_legs(step, body);
    fe_dvec3 base = centre_of(w->bodies + body);
    for (int32_t leg = 0; leg < legs; ++leg) {
        double begins = fe__way_time(step, body, leg), ends = fe__way_time(step, body, leg + 1);
        fe__motion motion_a = fe__way_between(step, a->body, begins, ends, base),
                   motion_b = fe__way_between(step, b->body, begins, ends, base);
        fe__mobile mobile_a = fe__way_of_shape(step, a, &motion_a), mobile_b = fe__way_of_shape(step, b, &motion_b);
        fe__impact impact;
        if (fe__time_of_impact(&mobile_a, &mobile_b, 1.0, &impact) != FE_MEET_NEVER) return 1;
    }
    return 0;
}
