// What slides over level tiles with narrow gaps between them, or with steps of up to a millimetre, goes on.
#include "laws/law.h"

typedef enum tile_kind { BOXES, HULLS, PARTS, CELLS, CLOSED, MESHES, FIELDS, TILE_KINDS } tile_kind;
static const char *const tile_names[TILE_KINDS] = {"boxes",           "hulls",           "parts of a compound",
                                                   "cells of a mesh", "boxes of a mesh", "meshes",
                                                   "heightfields"};

enum { TILES = 16 };
typedef struct floor_of_tiles {
    tile_kind kind;
    double width, gap, step;     // m
    double turn;                 // rad, of the whole floor about the vertical
    double height[TILES][TILES]; // of their tops, m
} floor_of_tiles;

static double tile_start(const floor_of_tiles *f, int i) { return (i - TILES / 2) * (f->width + f->gap) + f->gap / 2; }
static fe_quat turn_of(const floor_of_tiles *f) { return turned(v3(0, 1, 0), f->turn); }
static vec along(double heading) { return v3(cos(heading), 0, sin(heading)); }

static void add_quad(soup *m, const floor_of_tiles *f, int i, int k)
{
    uint32_t at = (uint32_t)m->vertex_count;
    for (int corner = 0; corner < 4; ++corner) {
        float *v = m->vertices + 3 * m->vertex_count++;
        v[0] = (float)(tile_start(f, i) + f->width * (corner & 1));
        v[2] = (float)(tile_start(f, k) + f->width * (corner / 2));
        v[1] = (float)f->height[i][k];
    }
    const uint32_t side[6] = {at, at + 2, at + 3, at, at + 3, at + 1};
    memcpy(m->indices + 3 * m->triangle_count, side, sizeof side);
    m->triangle_count += 2;
}

// The sides of the quad that was added last, and its underside
static void close_below(soup *m, double deep)
{
    static const int around[4] = {0, 1, 3, 2};
    uint32_t at = (uint32_t)m->vertex_count, top = at - 4;
    for (int corner = 0; corner < 4; ++corner) {
        float *v = m->vertices + 3 * m->vertex_count++;
        memcpy(v, v - 12, 3 * sizeof *v);
        v[1] -= (float)deep;
    }
    for (int k = 0; k < 4; ++k) {
        uint32_t a = (uint32_t)around[k], b = (uint32_t)around[(k + 1) % 4];
        const uint32_t side[6] = {at + a, top + a, top + b, at + a, top + b, at + b};
        memcpy(m->indices + 3 * m->triangle_count, side, sizeof side);
        m->triangle_count += 2;
    }
    const uint32_t under[6] = {at, at + 1, at + 3, at, at + 3, at + 2};
    memcpy(m->indices + 3 * m->triangle_count, under, sizeof under);
    m->triangle_count += 2;
}

static void lay_meshes(scene *s, const floor_of_tiles *f, fe_material m)
{
    static float vertices[TILES * TILES * 24];
    static uint32_t indices[TILES * TILES * 36];
    soup all = {vertices, indices, 0, 0};
    for (int i = 0; i < TILES * TILES; ++i) {
        add_quad(&all, f, i / TILES, i % TILES);
        if (f->kind == CLOSED) close_below(&all, 0.4);
        if (f->kind != MESHES && i < TILES * TILES - 1) continue;
        place_mesh(s, FE_BODY_STATIC, make_mesh(s, &all, 0), v3(0, 0, 0), turn_of(f), m);
        all.vertex_count = all.triangle_count = 0;
    }
}

static void lay_compound(scene *s, const floor_of_tiles *f, fe_material m)
{
    static fe_compound_part parts[TILES * TILES];
    fe_asset asset;
    fe_geometry form;
    double half = f->width / 2;
    for (int i = 0; i < TILES * TILES; ++i) {
        int x = i / TILES, z = i % TILES;
        fe_compound_part_init(&parts[i], sizeof parts[i]);
        parts[i].geometry = box(half, 0.5, half);
        parts[i].frame.position = narrow(v3(tile_start(f, x) + half, f->height[x][z] - 0.5, tile_start(f, z) + half));
    }
    MUST(fe_compound_create(world_store(s->world), parts, sizeof *parts, TILES * TILES, &asset));
    fe_geometry_compound(&form, asset);
    add_static(s, form, v3(0, 0, 0), turn_of(f), m);
}

static void lay(scene *s, const floor_of_tiles *f, fe_material m)
{
    if (f->kind == CELLS || f->kind == CLOSED || f->kind == MESHES) {
        lay_meshes(s, f, m);
        return;
    }
    if (f->kind == PARTS) {
        lay_compound(s, f, m);
        return;
    }
    double half = f->width / 2;
    fe_geometry form = f->kind == BOXES   ? box(half, 0.5, half)
                       : f->kind == HULLS ? hull_box(s, half, 0.5, half)
                                          : sphere(1);
    fe_asset field = f->kind == FIELDS ? make_field(s, 2, half, 0, 0, level) : 0;
    for (int i = 0; i < TILES * TILES; ++i) {
        vec corner = v3(tile_start(f, i / TILES), f->height[i / TILES][i % TILES], tile_start(f, i % TILES));
        if (f->kind == FIELDS)
            place_field(s, field, rotate(turn_of(f), corner), turn_of(f), m);
        else
            add_static(s, form, rotate(turn_of(f), plus(corner, v3(half, -0.5, half))), turn_of(f), m);
    }
}

static floor_of_tiles any_floor(dice *d)
{
    floor_of_tiles f = {.kind = (tile_kind)pick(d, TILE_KINDS), .width = uniform(d, 0.3, 1.2)};
    f.gap = chance(d, 0.1) ? 0 : spread(d, 1e-4, 0.02);
    f.step = chance(d, 0.4) ? 0 : uniform(d, 0, 0.001);
    f.turn = chance(d, 0.2) ? 0 : uniform(d, -PI, PI);
    for (int i = 0; i < TILES * TILES; ++i) f.height[i / TILES][i % TILES] = chance(d, 0.5) ? f.step : 0;
    return f;
}

#define WAY 2.4 // m, through the middle of the floor, whose half is at least as long
typedef struct ride {
    double kept;         // share of the speed
    double higher, most; // m, over the start, at most; what it crossed of tiles
} ride;

static ride slide(scene *s, rate r, fe_body body, double heading, double speed)
{
    set_velocity(s, body, times(speed, along(heading)), v3(0, 0, 0));
    double height = position(s, body).y, time = fmin(3, WAY / speed);
    ride result = {.most = speed * time};
    for (int i = 0, steps = (int)(time * r.hertz + 0.5); i < steps; ++i) {
        law_run(s, r, 1.0 / r.hertz);
        result.higher = fmax(result.higher, position(s, body).y - height);
    }
    vec v = velocity(s, body);
    result.kept = (v.x * cos(heading) + v.z * sin(heading)) / speed;
    return result;
}

typedef struct slider {
    fe_geometry form;
    fe_quat rotation;
    double height; // of its origin over the floor, m
} slider;

enum { SLIDERS = 7 };
static const char *const slider_names[SLIDERS] = {"box", "hull", "cylinder", "cone", "prism", "wedge", "capsule"};

// A prism of three sides on its base, whose sides lean
static fe_geometry wedge(scene *s, double a, double b, double c)
{
    float points[18];
    for (int i = 0; i < 6; ++i) {
        points[3 * i] = (float)(i % 3 == 2 ? 0 : i % 3 ? a : -a);
        points[3 * i + 1] = (float)(i % 3 == 2 ? b : -b);
        points[3 * i + 2] = (float)(i / 3 ? c : -c);
    }
    return hull(s, points, 6);
}

static slider any_slider(scene *s, dice *d, int kind, double a)
{
    double b = a * uniform(d, 0.3, 1), c = a * uniform(d, 0.4, 1), turn = uniform(d, -PI, PI);
    if (kind == SLIDERS - 1) { // across the gaps of a floor that is not turned
        turn = PI / 4 + PI / 2 * pick(d, 4) + uniform(d, -0.4, 0.4);
        fe_quat lying = compose(turned(v3(0, 1, 0), turn), turned(v3(1, 0, 0), PI / 2));
        return (slider){capsule(a, 0.5 * a), lying, 0.5 * a};
    }
    fe_geometry form = kind == 0   ? box(a, b, c)
                       : kind == 1 ? hull_box(s, a, b, c)
                       : kind == 2 ? cylinder(b, a)
                       : kind == 3 ? cone(b, a)
                       : kind == 4 ? hull_prism(s, 3 + pick(d, 10), b, a)
                                   : wedge(s, a, b, c);
    return (slider){form, turned(v3(0, 1, 0), turn), b};
}

// What has a flat base, or a line that lies across the gaps, spans them: without friction it keeps 99 % of its speed,
// and comes no higher than the steps and the solver's slop.
static double what_spans_a_gap_slides_on(dice *d, char *told)
{
    rate r = any_rate(d);
    scene s = law_scene(r);
    floor_of_tiles f = any_floor(d);
    lay(&s, &f, friction(0));
    int kind = pick(d, SLIDERS);
    double a = spread(d, 0.1, 0.6), heading = uniform(d, -PI, PI), speed = spread(d, 0.5, 10);
    if (chance(d, 0.1)) heading = PI / 2 * pick(d, 4);
    slider x = any_slider(&s, d, kind, a);
    vec start = times(-0.5 * WAY, along(heading - f.turn));
    fe_body body = add_dynamic(&s, x.form, plus(start, v3(0, x.height + f.step, 0)), compose(turn_of(&f), x.rotation),
                               friction(0), WATER);
    law_run(&s, r, 0.2);
    ride way = slide(&s, r, body, heading - f.turn, speed);
    snprintf(told, LAW_TOLD,
             "%d Hz, %d substeps, %s of %.3g m over %s of %.3g m, gap %.3g mm, step %.3g mm, %.3g m/s, heading %.3g: "
             "keeps %.4f, %.3g mm up",
             r.hertz, r.substeps, slider_names[kind], a, tile_names[f.kind], f.width, 1e3 * f.gap, 1e3 * f.step, speed,
             heading, way.kept, 1e3 * way.higher);
    scene_end(&s);
    return fmax(fabs(way.kept - 1) / 0.01, way.higher / (f.step + LINEAR_SLOP));
}

// A ball of radius r dips into a gap g by r - sqrt(r^2 - g^2/4) and meets its other side at an angle of asin(g/2r): it
// is thrown up at v g/2r, where it meets it dead. Corners of four tiles are sqrt(2) g wide. Allowed is twice that
// height, and the solver's slop.
static double a_ball_feels_the_dip_alone(dice *d, char *told)
{
    rate r = any_rate(d);
    scene s = law_scene(r);
    floor_of_tiles f = any_floor(d);
    for (int i = 0; i < TILES * TILES; ++i) f.height[i / TILES][i % TILES] = 0;
    lay(&s, &f, friction(0));
    double radius = spread(d, 0.05, 0.4), heading = uniform(d, -PI, PI), speed = spread(d, 0.5, 10);
    vec start = plus(times(-0.5 * WAY, along(heading)), v3(0, radius, 0));
    fe_body body = add_dynamic(&s, sphere(radius), start, UNTURNED, friction(0), WATER);
    ride way = slide(&s, r, body, heading, speed);
    double angle = asin(sqrt(2) * f.gap / 2 / radius), up = speed * sin(angle);
    double most = LINEAR_SLOP + up * up / G, crossed = 2 * way.most / f.width + 2;
    // it loses its speed across the normal at each side, and may be caught when it cannot climb out
    double dip = radius * (1 - cos(angle)), least = pow(cos(2 * angle), crossed);
    if (speed * speed * least * least < 4 * G * dip) least = -1;
    snprintf(
        told, LAW_TOLD,
        "%d Hz, %d substeps, ball of %.3g m over %s, gap %.3g mm, %.3g m/s, heading %.3g: keeps %.4f, not %.4f, %.3g "
        "mm up, not %.3g",
        r.hertz, r.substeps, radius, tile_names[f.kind], 1e3 * f.gap, speed, heading, way.kept, least, 1e3 * way.higher,
        1e3 * most);
    scene_end(&s);
    return fmax((1 - way.kept) / (1 - least + 0.01), way.higher / most);
}

// What rises above the middle of a body, behind a gap of any width, stops it: it comes no nearer than the solver's
// slop. Solid tiles make the floor and the wall, which has seams.
static double a_wall_behind_a_gap_stops(dice *d, char *told)
{
    static const tile_kind solids[] = {BOXES, HULLS, PARTS}; // of a mesh see CHANGELOG.md
    rate r = any_rate(d);
    scene s = law_scene(r);
    floor_of_tiles f = any_floor(d);
    f.kind = solids[pick(d, 3)];
    int kind = pick(d, 4);
    double a = spread(d, 0.1, 0.4), b = a * uniform(d, 0.3, 1), height = kind == 3 ? a : b,
           wall = height * uniform(d, 1.05, 3), speed = spread(d, 0.5, 10);
    for (int i = 0; i < TILES * TILES; ++i) f.height[i / TILES][i % TILES] = i / TILES >= TILES / 2 ? wall : 0;
    lay(&s, &f, friction(0));
    fe_geometry form = kind == 0   ? box(a, b, a)
                       : kind == 1 ? hull_box(&s, a, b, a)
                       : kind == 2 ? cylinder(b, a)
                                   : sphere(a);
    // a ball comes straight at a seam: for a cylinder that does see CHANGELOG.md
    double aside = kind == 3 ? 0 : f.width * uniform(d, 0.2, 0.8);
    vec at = v3(-uniform(d, 1.5, 2) * a, height, aside);
    fe_body body =
        add_dynamic(&s, form, rotate(turn_of(&f), at), turned(v3(0, 1, 0), uniform(d, -PI, PI)), friction(0), WATER);
    slide(&s, r, body, -f.turn, speed);
    // of any heading the body reaches as far as `a`
    double nearest = rotate(inverse(turn_of(&f)), position(&s, body)).x + a - f.gap / 2;
    snprintf(
        told, LAW_TOLD,
        "%d Hz, %d substeps, form %d of %.3g %.3g m, %s of %.3g m, gap %.3g mm, wall %.3g m, %.3g m/s: %.3g m into "
        "it",
        r.hertz, r.substeps, kind, a, b, tile_names[f.kind], f.width, 1e3 * f.gap, wall, speed, nearest);
    scene_end(&s);
    return nearest / LINEAR_SLOP;
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(what_spans_a_gap_slides_on), 300},
                               {LAW(a_ball_feels_the_dip_alone), 300},
                               {LAW(a_wall_behind_a_gap_stops), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
