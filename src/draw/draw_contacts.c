// draw_contacts.c - see drawing.h.
//
// Contacts come with their body A, in the order of its creation, and of one A in the order of its list of pairs, which
// is the same in each run.
#include "draw/drawing.h"

#include "world/world.h"
#include "world/contact.h"
#include "world/contact_creation.h"

double fe__drawn_gravity(const fe_world *w)
{
    double g = (double)fe__length(w->gravity);
    return g > 0.0 ? g : 9.80665;
}

double fe__lighter_weight(const fe_world *w, int32_t body_a, int32_t body_b)
{
    const fe__body *a = w->bodies + body_a, *b = w->bodies + body_b;
    double mass_a = a->type == FE_BODY_DYNAMIC ? (double)a->mass : 0.0,
           mass_b = b->type == FE_BODY_DYNAMIC ? (double)b->mass : 0.0;
    double mass = mass_a > 0.0 && (mass_b == 0.0 || mass_a < mass_b) ? mass_a : mass_b;
    return (mass > 0.0 ? mass : 1.0) * fe__drawn_gravity(w);
}

// A contact with points that is drawn
typedef struct touch {
    int32_t pair, count; // of points
    fe_vec3 normal;      // from A to B
    float side;          // -1: the solver has the two sides exchanged
    double weight;       // N
} touch;

static int32_t open_touch(const fe__drawing *d, int32_t pair, touch *t)
{
    const fe_world *w = d->world;
    const fe__pair *p = w->pairs + pair;
    const fe__contact *c = w->contacts + pair;
    if (p->flags & FE__PAIR_SENSOR || !(c->point_count > 0.0f)) return 0;
    t->pair = pair, t->count = (int32_t)c->point_count;
    t->side = p->flags & FE__PAIR_FLIPPED ? -1.0f : 1.0f;
    t->normal = fe__scale(t->side, fe__quad_vector(c->normal));
    t->weight = fe__lighter_weight(w, p->body_a, p->body_b);
    return 1;
}

// N, mean of the last step
static double force_of(const fe_world *w, const touch *t, int32_t point)
{
    if (!(w->last_dt > 0.0f)) return 0.0;
    return (double)fe__points_of(w, w->contacts + t->pair)->total_impulse[point] / (double)w->last_dt;
}

static void draw_arrow(const fe__drawing *d, fe__pen *pen, fe_dvec3 from, fe_vec3 way)
{
    fe__pen_line(pen, fe__in_drawing(d, from), fe__in_drawing(d, fe__dadd(from, fe__widen(way))));
}

// ---- what is drawn of a contact ------------------------------------------------------------------------------------
static void draw_normals(const fe__drawing *d, const touch *t, fe__pen *pen)
{
    for (int32_t i = 0; i < t->count; ++i) {
        fe_dvec3 at = fe__contact_point(d->world, t->pair, i);
        if (!fe__is_in_box(d, at)) continue;
        pen->rgba = fe__load_colour(force_of(d->world, t, i) / t->weight);
        draw_arrow(d, pen, at, fe__scale(d->scale, t->normal));
    }
}

// The normal force on B at each point, and the friction on B, of the last substep, in the middle
static void draw_forces(const fe__drawing *d, const touch *t, fe__pen *pen)
{
    const fe_world *w = d->world;
    const fe__points *q = fe__points_of(w, w->contacts + t->pair);
    double share = 1.0 / (double)t->count, per_weight = (double)d->scale / t->weight;
    fe_dvec3 middle = {0.0, 0.0, 0.0};
    pen->rgba = fe__colours[FE__COLOUR_FORCE];
    for (int32_t i = 0; i < t->count; ++i) {
        fe_dvec3 at = fe__contact_point(w, t->pair, i);
        middle = fe__dadd(middle, fe__dscale(share, at));
        if (fe__is_in_box(d, at)) draw_arrow(d, pen, at, fe__scale((float)(per_weight * force_of(w, t, i)), t->normal));
    }
    if (!(w->last_h > 0.0f) || !fe__is_in_box(d, middle)) return;
    float friction = t->side * (float)(per_weight / (double)w->last_h);
    draw_arrow(d, pen, middle, fe__scale(friction, fe__quad_vector(q->friction_impulse)));
}

static void draw_marks(const fe__drawing *d, const touch *t, fe__pen *pen)
{
    for (int32_t i = 0; i < t->count; ++i) {
        fe_dvec3 at = fe__contact_point(d->world, t->pair, i);
        if (!fe__is_in_box(d, at)) continue;
        pen->rgba = fe__load_colour(force_of(d->world, t, i) / t->weight);
        fe__pen_vertex(pen, fe__in_drawing(d, at));
    }
}

// ---- the walk ------------------------------------------------------------------------------------------------------
typedef void draw_touch(const fe__drawing *d, const touch *t, fe__pen *pen);

static void draw_list(const fe__drawing *d, int32_t body, fe__pen *pen, draw_touch draw)
{
    const fe_world *w = d->world;
    for (int32_t pair = w->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(w, pair, body)) {
        touch t;
        if (d->only < 0 && w->pairs[pair].body_a != body) continue;
        if (!open_touch(d, pair, &t)) continue;
        pen->owner = fe__shape_handle(w, w->pairs[pair].shape_a);
        draw(d, &t, pen);
    }
}

static void draw_touches(const fe__drawing *d, fe__pen *pen, draw_touch draw)
{
    if (d->only >= 0) {
        draw_list(d, d->only, pen, draw);
        return;
    }
    for (int32_t i = d->world->first_body; i >= 0; i = d->world->bodies[i].order_next) draw_list(d, i, pen, draw);
}

void fe__draw_contact_lines(const fe__drawing *d, fe__pen *pen)
{
    if (d->parts & FE_DRAW_CONTACTS) draw_touches(d, pen, draw_normals);
    if (d->parts & FE_DRAW_FORCES) draw_touches(d, pen, draw_forces);
}

void fe__draw_contact_points(const fe__drawing *d, fe__pen *pen)
{
    if (d->parts & FE_DRAW_CONTACTS) draw_touches(d, pen, draw_marks);
}
