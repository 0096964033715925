// bodies.c - see bodies.h.
#include "draw/bodies.h"

#include "draw/colours.h"
#include "draw/contacts.h"
#include "draw/shapes.h"
#include "world/handles.h"
#include "world/pose.h"

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
