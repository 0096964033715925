// draw_shapes.c - see drawing.h.
#include "draw/drawing.h"

#include "world/body.h"
#include "world/world.h"

// ---- bodies ---------------------------------------------------------------------------------------------------------

// ---- centres -------------------------------------------------------------------------------------------------------
static void draw_bodies(const fe__drawing *d, fe__pen *pen,
                        void draw(const fe__drawing *d, const fe__body *body, fe__pen *pen))
{
    const fe_world *w = d->world;
    for (int32_t i = w->first_body; i >= 0; i = w->bodies[i].order_next) {
        if (!fe__is_drawn(d, i) || w->bodies[i].type != FE_BODY_DYNAMIC) continue;
        if (!fe__is_in_box(d, fe__centre_of(w->bodies + i))) continue;
        pen->owner = fe__body_handle(w, i);
        draw(d, w->bodies + i, pen);
    }
}

static void draw_way(const fe__drawing *d, const fe__body *body, fe_dvec3 way, fe__pen *pen)
{
    fe_dvec3 from = fe__centre_of(body);
    fe__pen_line(pen, fe__in_drawing(d, from), fe__in_drawing(d, fe__dadd(from, way)));
}

static void draw_force(const fe__drawing *d, const fe__body *body, fe__pen *pen)
{
    fe_dvec3 force = fe__widen(fe__quad_vector(body->force));
    if (force.x == 0.0 && force.y == 0.0 && force.z == 0.0) return;
    pen->rgba = fe__colours[FE__COLOUR_FORCE];
    draw_way(d, body, fe__dscale((double)d->scale / ((double)body->mass * fe__drawn_gravity(d->world)), force), pen);
}

static void draw_axes(const fe__drawing *d, const fe__body *body, fe__pen *pen)
{
    static const fe__colour colours[3] = {FE__COLOUR_X, FE__COLOUR_Y, FE__COLOUR_Z};
    static const fe_dvec3 axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    fe_quat to_world = fe__product(fe__rotation_of(body), fe__quat_of(body->inertia_axes));
    for (int32_t k = 0; k < 3; ++k) {
        pen->rgba = fe__colours[colours[k]];
        draw_way(d, body, fe__dscale((double)d->scale, fe__drotate(to_world, axes[k])), pen);
    }
}

static void draw_mark(const fe__drawing *d, const fe__body *body, fe__pen *pen)
{
    pen->rgba = fe__colours[FE__COLOUR_CENTRE];
    fe__pen_vertex(pen, fe__in_drawing(d, fe__centre_of(body)));
}

void fe__draw_added_forces(const fe__drawing *d, fe__pen *pen) { draw_bodies(d, pen, draw_force); }
void fe__draw_centre_lines(const fe__drawing *d, fe__pen *pen) { draw_bodies(d, pen, draw_axes); }
void fe__draw_centre_points(const fe__drawing *d, fe__pen *pen) { draw_bodies(d, pen, draw_mark); }

// ---- boxes ---------------------------------------------------------------------------------------------------------
void fe__draw_shape_boxes(fe__drawing *d, fe__pen *pen)
{
    fe__shape_walk walk = fe__shapes_begin(d);
    while (fe__shapes_next(d, &walk)) {
        const fe__shape *shape = d->world->shapes + walk.shape;
        if (fe__form_is_unbounded(&shape->form)) continue;
        fe__bounds bounds = fe__form_bounds(&shape->form, &shape->pose);
        pen->rgba = fe__colours[FE__COLOUR_BOUNDS], pen->owner = fe__shape_handle(d->world, walk.shape);
        fe__pen_box(pen, fe__in_drawing(d, bounds.low), fe__in_drawing(d, bounds.high));
    }
}

// A lane of a node: the box of a shape, or around other nodes
static void draw_lane(const fe__drawing *d, const fe__tree *tree, const fe__tree_node *node, int32_t lane, fe__pen *pen)
{
    const fe_world *w = d->world;
    int32_t child = node->child[lane];
    if (child == FE_TREE_EMPTY) return;
    if (d->only >= 0 && (child >= 0 || w->shapes[~child].body != d->only)) return;
    fe_dvec3 low = {(double)node->box[0][lane], (double)node->box[1][lane], (double)node->box[2][lane]},
             high = {(double)node->box[3][lane], (double)node->box[4][lane], (double)node->box[5][lane]};
    low = fe__dadd(tree->origin, low), high = fe__dadd(tree->origin, high);
    const fe__bounds *b = &d->box;
    if (low.x > b->high.x || low.y > b->high.y || low.z > b->high.z || high.x < b->low.x || high.y < b->low.y ||
        high.z < b->low.z)
        return;
    pen->rgba = fe__colours[FE__COLOUR_TREE], pen->owner = child < 0 ? fe__shape_handle(w, ~child) : 0;
    fe__pen_box(pen, fe__in_drawing(d, low), fe__in_drawing(d, high));
}

static void draw_tree(const fe__drawing *d, const fe__tree *tree, fe__pen *pen)
{
    if (!tree->proxy_count) return;
    for (int32_t i = 0; i < tree->node_count; ++i) {
        const fe__tree_node *node = tree->nodes + i;
        if (i > 0 && node->parent < 0) continue; // dead
        for (int32_t lane = 0; lane < FE_TREE_WIDTH; ++lane) draw_lane(d, tree, node, lane, pen);
    }
}

void fe__draw_trees(const fe__drawing *d, fe__pen *pen)
{
    draw_tree(d, &d->world->static_tree, pen);
    draw_tree(d, &d->world->moving_tree, pen);
}

// ---- shapes ---------------------------------------------------------------------------------------------------------

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
