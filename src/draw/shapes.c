// shapes.c - see shapes.h.
#include "draw/shapes.h"

#include "draw/colours.h"
#include "world/handles.h"

fe__shape_walk fe__shapes_begin(const fe__drawing *d)
{
    return (fe__shape_walk){.next_body = d->world->first_body, .next_shape = -1};
}

static int32_t meets(const fe__bounds *a, const fe__bounds *b)
{
    return a->low.x <= b->high.x && b->low.x <= a->high.x && a->low.y <= b->high.y && b->low.y <= a->high.y &&
           a->low.z <= b->high.z && b->low.z <= a->high.z;
}

static int32_t holds(const fe__bounds *a, const fe__bounds *b)
{
    return a->low.x <= b->low.x && a->low.y <= b->low.y && a->low.z <= b->low.z && a->high.x >= b->high.x &&
           a->high.y >= b->high.y && a->high.z >= b->high.z;
}

// 0: it is not drawn
static int32_t look_at(fe__drawing *d, fe__shape_walk *walk)
{
    const fe__shape *shape = d->world->shapes + walk->shape;
    if (fe__form_is_of_parts(&shape->form)) return 0; // its parts follow
    walk->rgba = fe__shape_colour(walk->body_colour, shape);
    walk->is_cut = 0;
    if (!d->has_box || fe__form_is_unbounded(&shape->form)) return 1; // a plane is cut as it is drawn
    fe__bounds bounds = fe__form_bounds(&shape->form, &shape->pose);
    walk->is_cut = !holds(&d->box, &bounds);
    return !walk->is_cut || meets(&d->box, &bounds);
}

// Bodies and shapes mostly lie in the order of their creation: records ahead of the walk are likely to be its next
// ones. Where they are not, nothing is lost
static inline void fetch_ahead(const fe_world *w, int32_t body, int32_t shape)
{
    enum { BODIES_AHEAD = 6, SHAPES_AHEAD = 4 };
    const unsigned tail = sizeof *w->bodies - (unsigned)offsetof(fe__body, line);
    if (body + BODIES_AHEAD < w->body_capacity) fe__fetch(&w->bodies[body + BODIES_AHEAD].line, tail);
    if (shape >= 0 && shape + SHAPES_AHEAD < w->shape_capacity)
        fe__fetch(w->shapes + shape + SHAPES_AHEAD, sizeof *w->shapes);
}

// Every body is met, drawn or not: the first of an island decides its colour
static int32_t open_next_body(fe__drawing *d, fe__shape_walk *walk)
{
    const fe_world *w = d->world;
    if (walk->next_body < 0) return 0;
    walk->body = walk->next_body;
    const fe__body *body = w->bodies + walk->body;
    fetch_ahead(w, walk->body, body->first_shape);
    walk->next_body = body->order_next;
    walk->body_colour = fe__body_colour(d, walk->body);
    walk->next_shape = fe__is_drawn(d, walk->body) ? body->first_shape : -1;
    return 1;
}

int32_t fe__shapes_next(fe__drawing *d, fe__shape_walk *walk)
{
    for (;;) {
        while (walk->next_shape < 0)
            if (!open_next_body(d, walk)) return 0;
        walk->shape = walk->next_shape;
        walk->next_shape = d->world->shapes[walk->shape].next;
        if (look_at(d, walk)) return 1;
    }
}

fe__drawn fe__shape_surface(const fe__drawing *d, const fe__shape_walk *walk)
{
    const fe__shape *shape = d->world->shapes + walk->shape;
    fe__drawn s = {.form = &shape->form,
                   .pose = shape->pose,
                   .circle = &d->circle,
                   .origin = d->origin,
                   .box = &d->box,
                   .is_cut = walk->is_cut};
    if (fe__form_is_field(s.form)) s.ground = fe__store_ground(d->world->store, s.form);
    return s;
}

void fe__draw_shapes(fe__drawing *d, fe__pen *pen, void draw(const fe__drawn *surface, fe__pen *pen))
{
    fe__shape_walk walk = fe__shapes_begin(d);
    while (fe__shapes_next(d, &walk)) {
        fe__drawn s = fe__shape_surface(d, &walk);
        fe__surface_place(&s);
        pen->rgba = walk.rgba, pen->owner = fe__shape_handle(d->world, walk.shape);
        draw(&s, pen);
    }
}

// ---- instances -----------------------------------------------------------------------------------------------------
static fe_draw_instance describe(const fe__drawing *d, const fe__shape_walk *walk, const fe__stance *stance)
{
    const fe_world *w = d->world;
    const fe__shape *shape = w->shapes + walk->shape;
    const fe__form *form = &shape->form;
    fe_draw_instance i = {.type = fe__traits_of(form)->geometry,
                          .rgba = walk->rgba,
                          .shape = fe__shape_handle(w, walk->shape),
                          .body = fe__body_handle(w, walk->body),
                          .position = stance->position,
                          .rotation = stance->rotation,
                          .half_extents = stance->half_extents,
                          .part = fe__part_of_serial(shape->serial)};
    if (!fe__form_has_asset(form)) return i;
    i.asset = fe__store_parent(w->store, form->field)->handle;
    i.half_extents = fe__store_asset(w->store, form->field)->scale;
    return i;
}

// 0: nothing of it is in the box
static int32_t stance_of(const fe__drawing *d, const fe__shape_walk *walk, fe__stance *out)
{
    const fe__shape *shape = d->world->shapes + walk->shape;
    if (fe__form_is_unbounded(&shape->form)) {
        fe__drawn plane = fe__shape_surface(d, walk);
        fe__surface_place(&plane);
        return fe__plane_stance(&plane, out);
    }
    *out = (fe__stance){fe__in_drawing(d, shape->pose.position), shape->pose.rotation,
                        fe__surface_half_extents(&shape->form)};
    return 1;
}

int32_t fe__draw_instances(fe__drawing *d, void *out, uint32_t stride, uint32_t size, int32_t capacity)
{
    if (!(d->parts & FE_DRAW_SHAPES)) return 0;
    int32_t count = 0;
    fe__shape_walk walk = fe__shapes_begin(d);
    while (fe__shapes_next(d, &walk)) {
        fe__stance stance;
        if (!stance_of(d, &walk, &stance)) continue;
        if (count < capacity) {
            fe_draw_instance instance = describe(d, &walk, &stance);
            void *at = (unsigned char *)out + (size_t)stride * (size_t)count;
            if (size == sizeof instance)
                memcpy(at, &instance, sizeof instance);
            else
                memcpy(at, &instance, size);
        }
        count += 1;
    }
    return count;
}
