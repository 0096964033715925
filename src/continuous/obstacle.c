// obstacle.c - see obstacle.h.
#include "continuous/obstacle.h"

#include "collision/cast/distance.h"
#include "world/filter.h"
#include "world/pose.h"

// Share of its thickness by which a shape may dip into another as it moves. What stays out of the other by more than
// three quarters of its half width is pushed out on the side it came from.
#define DIP 0.25f
// A search for impacts goes on so much beyond the first one found, as a share of it: of two at once the one created
// first counts.
#define BEYOND 1e-9
// More than the distance at which two forms count as touching, and than the roundings of a plane, m
#define FAR 0.001

// A leg of a body, as it is carried through the trees
typedef struct search {
    const fe__step *step;
    int32_t body, against;
    fe_dvec3 base;
    double begin, end;
    fe__motion motion;
    int32_t has_motion; // 0: it is found when the first obstacle needs it
    // the first so far
    double s; // of the leg, 1 and more: none
    uint64_t serial;
    fe__obstacle first;
    int32_t blocked; // fe__path_is_blocked
} search;

static fe__form dipped(const fe__form *form) { return fe__form_shrunk(form, DIP * fe__form_thickness(form)); }

static void note(search *s, const fe__impact *deep, const fe__impact *touch, const fe__shape *obstacle, fe_dvec3 normal)
{
    s->s = deep->s;
    s->serial = obstacle->serial;
    s->first = (fe__obstacle){s->begin + touch->s * (s->end - s->begin), normal, fe__dadd(s->base, touch->on_b),
                              obstacle->body};
}

// The dipped form decides whether there is an impact, the whole one when.
static void try_form(search *s, const fe__shape *own, const fe__shape *obstacle, const fe__mobile *other)
{
    fe__form thin = dipped(&own->form);
    fe__mobile mover = fe__mobile_of_shape(s->step, own, &s->motion);
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

// Does any leg close the gap at its start? If not, the plane across the shortest distance separates them for the whole
// step.
static int32_t may_close(const search *s, const fe__shape *own, const fe__mobile *other)
{
    const fe__step *step = s->step;
    const fe__body *body = step->world->bodies + s->body;
    fe__form thin = dipped(&own->form);
    fe__mobile mover = fe__mobile_of_shape(step, own, &s->motion);
    mover.form = &thin;
    fe__gap gap;
    fe__pose a = fe__mobile_at(&mover, 0.0), b = fe__mobile_at(other, 0.0);
    fe__form_gap(&thin, &a, other->form, &b, &gap);
    if (gap.overlap || gap.distance <= FE_TOUCH) return 0;
    int32_t legs = fe__path_legs(step, s->body);
    for (int32_t leg = 1; leg <= legs; ++leg) {
        fe__shift at = fe__path_place(step, s->body, leg);
        fe_dvec3 axis = {(double)at.rotation.x, (double)at.rotation.y, (double)at.rotation.z},
                 across = fe__dcross(gap.normal, axis);
        double turning = (double)FE_PI * sqrt(fe__ddot(across, across)) * (double)body->reach;
        if (fe__ddot(gap.normal, at.centre) + turning + 2.0 * FE_TOUCH > gap.distance) return 1;
    }
    return 0;
}

static void try_obstacle(search *s, const fe__shape *own, const fe__shape *obstacle, const fe__mobile *other)
{
    if (s->blocked < 0) {
        try_form(s, own, obstacle, other);
        return;
    }
    int32_t stands = s->step->world->bodies[obstacle->body].type == FE_BODY_STATIC;
    s->blocked |= !stands || may_close(s, own, other);
}

// How far a surface that turns moves past the body beside its own translation, m: the angle, twice its half's sine and
// more, times the distance of the two centres at most.
static double turning_past(const fe__motion *own, const fe__mobile *surface)
{
    fe_quat q = surface->motion.angular_displacement;
    fe_dvec3 axis = {(double)q.x, (double)q.y, (double)q.z};
    double sine = sqrt(fe__ddot(axis, axis));
    if (!(sine > 0.0)) return 0.0;
    fe_dvec3 apart = fe__dsub(own->centre, surface->motion.centre);
    return (double)FE_PI * sine *
           (sqrt(fe__ddot(apart, apart)) + sqrt(fe__ddot(own->translation, own->translation)) +
            sqrt(fe__ddot(surface->motion.translation, surface->motion.translation)));
}

// The triangle's plane, with its normal `up` of any length, through v in the frame of the body's centre: does the
// centre stay farther than `reach` over it, on its way by `travel`? What is that far off is met by nothing of the body.
static int32_t stays_off(fe_dvec3 up, fe_dvec3 v, fe_dvec3 travel, double reach)
{
    double length = sqrt(fe__ddot(up, up)), height = -fe__ddot(up, v), after = height + fe__ddot(up, travel);
    return fe__mind(fe__absd(height), fe__absd(after)) > (reach + FAR) * length && height * after > 0.0;
}

// The triangles under the leg that look at the body's centre: the other side does not count.
static void try_field(search *s, const fe__shape *own, const fe__shape *obstacle, const fe__mobile *other)
{
    const fe_world *w = s->step->world;
    fe__ground surface = fe__store_ground(w->store, &obstacle->form);
    fe__pose pose = fe__mobile_at(other, 0.0);
    fe_dvec3 travel = fe__dsub(s->motion.translation, other->motion.translation);
    fe_dvec3 from = fe__drotate_back(pose.rotation, fe__dsub(s->motion.centre, pose.position));
    fe_dvec3 to = fe__dadd(from, fe__drotate_back(pose.rotation, travel));
    double reach = (double)w->bodies[s->body].reach + turning_past(&s->motion, other);
    fe_dvec3 low = {fe__mind(from.x, to.x) - reach, fe__mind(from.y, to.y) - reach, fe__mind(from.z, to.z) - reach};
    fe_dvec3 high = {fe__maxd(from.x, to.x) + reach, fe__maxd(from.y, to.y) + reach, fe__maxd(from.z, to.z) + reach};
    fe__bounds box = {low, high};
    fe_dvec3 way = fe__dsub(to, from);
    fe__form triangle;
    fe__mobile part = *other;
    part.form = &triangle;
    part.arm = fe__dadd(other->arm, fe__drotate(other->rotation, from));
    fe__ground_walk walk;
    fe__ground_begin(&walk, &surface, &box, from);
    while (fe__ground_next(&walk, &triangle) >= 0 && s->blocked <= 0) {
        const fe_vec3 *v = triangle.vertex;
        fe_vec3 up = fe__cross(fe__sub(v[1], v[0]), fe__sub(v[2], v[0]));
        if (s->blocked < 0 && stays_off(fe__widen(up), fe__widen(v[0]), way, reach)) continue;
        if (fe__dot(up, v[0]) < 0.0f || fe__ground_is_two_sided(&surface))
            try_obstacle(s, own, obstacle, &part); // the centre is at the walk's origin
    }
}

// The pair filter refused the two, or one is on its way through the other
static int32_t lets_pass(const fe_world *w, int32_t shape_a, int32_t shape_b)
{
    if (!((w->shapes[shape_a].flags | w->shapes[shape_b].flags) & (FE__SHAPE_JUDGED | FE__SHAPE_ONE_WAY))) return 0;
    int32_t pair = fe__pair_set_find(&w->pair_set, shape_a, shape_b);
    return pair >= 0 && w->pairs[pair].flags & (FE__PAIR_DENIED | FE__PAIR_PASSING);
}

// Meshes that a kinematic body carries are not, and of a compound its parts are
static int32_t is_swept(const fe__form *form) { return !fe__form_is_static_only(form) && !fe__form_is_of_parts(form); }

static void try_shape(search *s, int32_t shape)
{
    const fe_world *w = s->step->world;
    const fe__shape *obstacle = w->shapes + shape;
    fe__motion motion = fe__path_motion(s->step, obstacle->body, s->begin, s->end, s->base);
    fe__mobile other = fe__mobile_of_shape(s->step, obstacle, &motion);
    for (int32_t i = w->bodies[s->body].first_shape; i >= 0; i = w->shapes[i].next) {
        const fe__shape *own = w->shapes + i;
        if (own->flags & FE__SHAPE_TRIGGER || !is_swept(&own->form) || !fe__may_collide(w, i, shape) ||
            lets_pass(w, i, shape))
            continue;
        if (fe__form_is_field(&obstacle->form))
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
    if (!s->has_motion) s->motion = fe__path_motion(s->step, s->body, s->begin, s->end, s->base), s->has_motion = 1;
    try_shape(s, shape);
    return s->blocked <= 0;
}

static void add_place(fe__bounds *box, fe_dvec3 p, double reach)
{
    box->low = (fe_dvec3){fe__mind(box->low.x, p.x - reach), fe__mind(box->low.y, p.y - reach),
                          fe__mind(box->low.z, p.z - reach)};
    box->high = (fe_dvec3){fe__maxd(box->high.x, p.x + reach), fe__maxd(box->high.y, p.y + reach),
                           fe__maxd(box->high.z, p.z + reach)};
}

// In the tree of what moves, kinematic bodies alone are fixed
static void ask(search *s, const fe__bounds *box)
{
    const fe_world *w = s->step->world;
    int32_t fixed = s->against == FE__AGAINST_FIXED;
    if (!fixed || w->kinematic_count) fe__tree_query(&w->moving_tree, box, visit, s);
    if (!fixed || s->blocked > 0) return;
    fe__tree_query(&w->static_tree, box, visit, s);
    for (int32_t i = 0; i < w->plane_count && s->blocked <= 0; ++i) visit(s, w->planes[i]);
}

static search begin(const fe__step *step, int32_t body, int32_t against)
{
    return (search){.step = step,
                    .body = body,
                    .against = against,
                    .base = fe__centre_of(step->world->bodies + body),
                    .end = 1.0,
                    .s = 2.0,
                    .first = {.body = -1},
                    .blocked = -1};
}

static int32_t anything_fixed(const fe_world *w)
{
    return w->static_tree.proxy_count || w->plane_count || w->kinematic_count;
}

int32_t fe__path_is_blocked(const fe__step *step, int32_t body, int32_t against)
{
    if (against == FE__AGAINST_FIXED && !anything_fixed(step->world)) return 0;
    const fe__body *b = step->world->bodies + body;
    search s = begin(step, body, against);
    int32_t legs = fe__path_legs(step, body);
    double reach = (double)b->reach;
    fe__bounds box = {fe__centre_of(b), fe__centre_of(b)};
    for (int32_t leg = 0; leg <= legs; ++leg)
        add_place(&box, fe__dadd(s.base, fe__path_place(step, body, leg).centre), reach);
    s.blocked = 0;
    ask(&s, &box);
    return s.blocked;
}

fe__obstacle fe__first_obstacle(const fe__step *step, int32_t body, int32_t against, const fe__shift *from,
                                const fe__shift *to, double begins, double ends)
{
    const fe__body *b = step->world->bodies + body;
    search s = begin(step, body, against);
    double reach = (double)b->reach;
    s.motion = fe__motion_of_shifts(b, from, to, s.base);
    s.has_motion = 1;
    s.begin = begins, s.end = ends;
    fe_dvec3 at = fe__dadd(s.base, from->centre);
    fe__bounds box = {at, at};
    add_place(&box, at, reach);
    add_place(&box, fe__dadd(s.base, to->centre), reach);
    ask(&s, &box);
    return s.first;
}

int32_t fe__paths_cross(const fe__step *step, int32_t shape_a, int32_t shape_b)
{
    const fe_world *w = step->world;
    const fe__shape *a = w->shapes + shape_a, *b = w->shapes + shape_b;
    int32_t body = fe__path_legs(step, a->body) > fe__path_legs(step, b->body) ? a->body : b->body,
            legs = fe__path_legs(step, body);
    fe_dvec3 base = fe__centre_of(w->bodies + body);
    for (int32_t leg = 0; leg < legs; ++leg) {
        double begins = fe__path_time(step, body, leg), ends = fe__path_time(step, body, leg + 1);
        fe__motion motion_a = fe__path_motion(step, a->body, begins, ends, base),
                   motion_b = fe__path_motion(step, b->body, begins, ends, base);
        fe__mobile mobile_a = fe__mobile_of_shape(step, a, &motion_a),
                   mobile_b = fe__mobile_of_shape(step, b, &motion_b);
        fe__impact impact;
        if (fe__time_of_impact(&mobile_a, &mobile_b, 1.0, &impact) != FE_MEET_NEVER) return 1;
    }
    return 0;
}
