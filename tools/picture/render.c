// render.c - picture_render: triangles into samples, four a pixel; each pixel is lit once for every triangle in it.
// Bands of rows are drawn one after the other, so that their samples stay in the cache.
#include "light.h"

#include <stdlib.h>
#include <string.h>

#define NEAREST 0.1    // m, what is nearer is not seen
#define BEYOND 1.25    // of the picture's half width and height: what is farther out is cut off
#define OUTLINE 0.42   // light that is left where a body ends
#define HIDDEN 100     // opacity of lines behind something, of OPAQUE
enum { OPAQUE = 255 }; // alpha
enum { BAND = 24 };    // rows of pixels
enum { FINE = 2, SAMPLES = FINE * FINE, CUTS = 5, MOST_CORNERS = 3 + CUTS };

typedef struct reach {
    int32_t top, end; // rows of samples that a triangle may cover; none when it is not drawn
} reach;

typedef struct scene {
    camera camera;
    light light;
    shadow shadow;
    int32_t width, height; // samples
    double focal;          // samples
    triangle *triangles;
    reach *reaches; // of the triangles
    int32_t count;
    fe_draw_vertex *lines;
    int32_t line_count; // of their ends
    layer seen;         // numbers of triangles, of the band that is drawn
    uint32_t *overlay;  // lines and what is see-through, likewise; NULL: there is none
} scene;

// ---- into samples --------------------------------------------------------------------------------------------------
static raster_point project(const scene *s, vec p)
{
    raster_point at = {0.5 * s->width + s->focal * p.x / p.z, 0.5 * s->height - s->focal * p.y / p.z};
    return at;
}

static vec ray_through(const scene *s, double x, double y)
{
    return make_vec((x - 0.5 * s->width) / s->focal, (0.5 * s->height - y) / s->focal, 1.0);
}

// 1 / z over the samples of the plane n p = k is n ray / k
static layer_plane plane_of(const scene *s, const triangle *t)
{
    layer_plane plane = {.least = 1.0 / NEAREST, .most = 0.0};
    vec n = scale(1.0 / dot(t->normal, t->corners[0]), t->normal);
    for (int i = 0; i < 3; ++i) {
        double z = t->corners[i].z > NEAREST ? t->corners[i].z : NEAREST;
        plane.least = 1.0 / z < plane.least ? 1.0 / z : plane.least;
        plane.most = 1.0 / z > plane.most ? 1.0 / z : plane.most;
    }
    plane.a = n.x / s->focal, plane.b = -n.y / s->focal;
    plane.c = n.z - 0.5 * (plane.a * s->width + plane.b * s->height);
    return plane;
}

// Distance inside the near plane, or a side of the pyramid that is a bit wider than the picture
static double inside(const scene *s, vec p, int side)
{
    double wide = BEYOND * 0.5 * s->width / s->focal, high = BEYOND * 0.5 * s->height / s->focal;
    switch (side) {
    case 0:
        return p.z - NEAREST;
    case 1:
        return wide * p.z - p.x;
    case 2:
        return wide * p.z + p.x;
    case 3:
        return high * p.z - p.y;
    default:
        return high * p.z + p.y;
    }
}

// A convex polygon, cut by one side (Sutherland and Hodgman, 1974). @return corners that are left
static int cut(const scene *s, int side, const vec *in, int count, vec *out)
{
    int kept = 0;
    for (int i = 0; i < count; ++i) {
        vec a = in[i], b = in[(i + 1) % count];
        double da = inside(s, a, side), db = inside(s, b, side);
        if (da >= 0.0) out[kept++] = a;
        if ((da >= 0.0) != (db >= 0.0)) out[kept++] = mix(a, b, da / (da - db));
    }
    return kept;
}

static reach reach_of(const scene *s, const triangle *t)
{
    reach all = {0, s->height}, out = {s->height, 0};
    for (int i = 0; i < 3; ++i) {
        if (t->corners[i].z < NEAREST) return all;
        double y = clamp(project(s, t->corners[i]).y, 0.0, s->height);
        out.top = (int32_t)y < out.top ? (int32_t)y : out.top,
        out.end = (int32_t)y + 1 > out.end ? (int32_t)y + 1 : out.end;
    }
    return out;
}

typedef void fill(scene *s, const raster_point corners[3], const layer_plane *depth, int32_t number);

static void fill_polygon(scene *s, const vec corners[3], const layer_plane *depth, int32_t number, fill *fill)
{
    vec polygons[2][MOST_CORNERS] = {{corners[0], corners[1], corners[2]}};
    int count = 3, now = 0;
    for (int side = 0; side < CUTS && count > 2; ++side) {
        count = cut(s, side, polygons[now], count, polygons[!now]);
        now = !now;
    }
    for (int i = 2; i < count; ++i) {
        const vec *p = polygons[now];
        raster_point at[3] = {project(s, p[0]), project(s, p[i - 1]), project(s, p[i])};
        fill(s, at, depth, number);
    }
}

static void fill_seen(scene *s, const raster_point corners[3], const layer_plane *depth, int32_t number)
{
    layer_draw(&s->seen, corners, depth, number);
}

// ---- lines and what is see-through: over the picture, paler where something is before them -------------------------
typedef struct glass {
    scene *scene;
    const layer_plane *depth;
    uint32_t before, behind; // rgba
} glass;

static void lay_over(void *user, int32_t row, int32_t begin, int32_t end)
{
    const glass *g = user;
    const scene *s = g->scene;
    const float *near = s->seen.near + area_at(&s->seen.area, 0, row);
    uint32_t *overlay = s->overlay + area_at(&s->seen.area, 0, row);
    for (int32_t x = begin; x < end; ++x) {
        uint32_t rgba = plane_at(g->depth, x + 0.5, row + 0.5) > (double)near[x] ? g->before : g->behind;
        if (rgba >> 24 >= overlay[x] >> 24) overlay[x] = rgba;
    }
}

static void fill_glass(scene *s, const raster_point corners[3], const layer_plane *depth, int32_t number)
{
    glass g = {s, depth, s->triangles[number].rgba, 0};
    raster_triangle(corners, s->seen.area, lay_over, &g);
}

// 1 / z along a line changes evenly from sample to sample; 1 % nearer than it is, a line on a face is seen
static void draw_line(scene *s, vec from, vec to, uint32_t rgba)
{
    if (from.z < NEAREST || to.z < NEAREST) return;
    raster_point a = project(s, from), b = project(s, to);
    double dx = b.x - a.x, dy = b.y - a.y, l = sqrt(dx * dx + dy * dy), width = s->width / 1000.0;
    if (!(l > 0.01) || l > 8.0 * s->width) return;
    double far = 1.01 / from.z, slope = (1.01 / to.z - far) / (l * l), ex = dx / l * width, ey = dy / l * width;
    layer_plane depth = {slope * dx, slope * dy, far - slope * (dx * a.x + dy * a.y), 0.0, 1.0 / NEAREST};
    raster_point c[4] = {{a.x - ex - ey, a.y - ey + ex},
                         {b.x + ex - ey, b.y + ey + ex},
                         {b.x + ex + ey, b.y + ey - ex},
                         {a.x - ex + ey, a.y - ey - ex}};
    raster_point other[3] = {c[0], c[2], c[3]};
    glass g = {s, &depth, rgba, (rgba & 0xffffff) | (uint32_t)HIDDEN << 24};
    raster_triangle(c, s->seen.area, lay_over, &g);
    raster_triangle(other, s->seen.area, lay_over, &g);
}

static vec vertex_at(const scene *s, int32_t i)
{
    const fe_draw_vertex *v = s->lines + i;
    return into_camera(&s->camera, make_vec((double)v->x, (double)v->y, (double)v->z));
}

static void draw_overlay(scene *s)
{
    for (int32_t i = 0; i < s->count; ++i) {
        if (s->triangles[i].rgba >> 24 == OPAQUE) continue;
        layer_plane depth = plane_of(s, s->triangles + i);
        fill_polygon(s, s->triangles[i].corners, &depth, i, fill_glass);
    }
    for (int32_t i = 0; i + 1 < s->line_count; i += 2)
        draw_line(s, vertex_at(s, i), vertex_at(s, i + 1), s->lines[i].rgba);
}

// ---- pixels --------------------------------------------------------------------------------------------------------
static int32_t body_of(const scene *s, int32_t number)
{
    return number == LAYER_NOTHING ? LAYER_NOTHING : s->triangles[number].body;
}

// Is a neighbour of this sample of another body, and farther?
static int ends_here(const scene *s, int32_t x, int32_t y)
{
    const int32_t w = s->width, h = s->height, step[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    int64_t at = area_at(&s->seen.area, x, y);
    for (int i = 0; i < 4; ++i) {
        int32_t u = x + step[i][0], v = y + step[i][1];
        if (u < 0 || v < 0 || u >= w || v >= h) continue;
        int64_t next = area_at(&s->seen.area, u, v);
        if (s->seen.owner[next] == s->seen.owner[at]) continue;
        if (s->seen.near[at] > s->seen.near[next] && body_of(s, s->seen.owner[next]) != body_of(s, s->seen.owner[at]))
            return 1;
    }
    return 0;
}

static lit light_sample(const scene *s, int32_t x, int32_t y, int32_t number)
{
    double down = (y + 0.5) / s->height;
    if (number == LAYER_NOTHING) return (lit){light_background(down), 1.0, 0};
    return light_triangle(&s->light, s->triangles + number, ray_through(s, x + 0.5, y + 0.5), down);
}

typedef int32_t row_of_numbers __attribute__((vector_size(16))); // FINE + 2 of them

// Is there one triangle alone, in the pixel and in the samples around it, and nothing over the pixel?
static int is_plain(const scene *s, int32_t x, int32_t y)
{
    if (x < 1 || y < 1 || x + FINE >= s->width || y + FINE >= s->height) return 0;
    const int32_t *at = s->seen.owner + area_at(&s->seen.area, x - 1, y - 1), number = *at;
    row_of_numbers others = {0, 0, 0, 0};
    for (int32_t j = 0; j < FINE + 2; ++j, at += s->width) {
        row_of_numbers row;
        memcpy(&row, at, sizeof row);
        others |= row ^ number;
    }
    if (others[0] | others[1] | others[2] | others[3]) return 0;
    if (!s->overlay) return 1;
    const uint32_t *over = s->overlay + area_at(&s->seen.area, x, y);
    return !(over[0] | over[1] | over[s->width] | over[s->width + 1]);
}

// Each triangle is lit once, but at the edges of shadows
static vec light_pixel(const scene *s, int32_t px, int32_t py)
{
    int32_t numbers[SAMPLES];
    lit lights[SAMPLES];
    vec sum = {0, 0, 0};
    int plain = is_plain(s, FINE * px, FINE * py);
    for (int32_t i = 0; i < SAMPLES; ++i) {
        int32_t x = FINE * px + i % FINE, y = FINE * py + i / FINE, k = 0;
        int64_t at = area_at(&s->seen.area, x, y);
        numbers[i] = s->seen.owner[at];
        while (numbers[k] != numbers[i]) ++k;
        lights[i] = k < i && !lights[k].half ? lights[k] : light_sample(s, x, y, numbers[i]);
        if (plain && i == 0 && !lights[i].half) return lights[i].colour;
        vec colour = lights[i].colour;
        if (lights[i].haze < 1.0 && ends_here(s, x, y))
            colour = scale(OUTLINE + (1.0 - OUTLINE) * lights[i].haze, colour);
        if (s->overlay && s->overlay[at])
            colour = mix(colour, light_of_bytes(s->overlay[at]), (s->overlay[at] >> 24) / 255.0);
        sum = add(sum, colour);
    }
    return scale(1.0 / SAMPLES, sum);
}

// ---- the whole -----------------------------------------------------------------------------------------------------
// What is closed is seen from outside alone
static int is_seen(const triangle *t)
{
    double facing = dot(t->normal, t->corners[0]);
    return t->rgba >> 24 == OPAQUE && (facing < 0.0 || (t->two_sided && facing > 0.0));
}

static int32_t prepare(scene *s, const fe_world *world, const picture_view *view)
{
    // a band, and a row of samples on either side for outlines
    size_t samples = (size_t)s->width * (FINE * BAND + 2);
    s->count = gather_triangles(world, view, &s->camera, &s->triangles);
    if (s->count < 0) return s->count;
    s->line_count = draw_all(fe_world_draw_lines, world, view, view->parts & ~(uint32_t)FE_DRAW_SHAPES, &s->lines);
    if (s->line_count < 0) return s->line_count;
    s->reaches = malloc((size_t)(s->count + 1) * sizeof *s->reaches);
    s->seen.near = malloc(samples * sizeof *s->seen.near), s->seen.owner = malloc(samples * sizeof *s->seen.owner);
    if (!s->reaches || !s->seen.near || !s->seen.owner) return FE_ERROR_MEMORY;
    int32_t glass = s->line_count > 0;
    for (int32_t i = 0; i < s->count; ++i) {
        s->reaches[i] = is_seen(s->triangles + i) ? reach_of(s, s->triangles + i) : (reach){0, 0};
        s->triangles[i].own = light_own(s->triangles + i);
        glass |= s->triangles[i].rgba >> 24 < OPAQUE;
    }
    if (glass && !(s->overlay = malloc(samples * sizeof *s->overlay))) return FE_ERROR_MEMORY;
    int32_t width = s->width / FINE;
    return shadow_make(view, &s->camera, s->triangles, s->count, width + width / 2, &s->shadow);
}

// Samples of the rows of pixels [row, end)
static void draw_band(scene *s, int32_t row, int32_t end)
{
    raster_area area = {s->width, FINE * row - 1, FINE * end + 1};
    area.top = area.top < 0 ? 0 : area.top, area.end = area.end > s->height ? s->height : area.end;
    size_t samples = (size_t)area.width * (size_t)(area.end - area.top);
    s->seen.area = area;
    memset(s->seen.near, 0, samples * sizeof *s->seen.near);
    memset(s->seen.owner, 0xff, samples * sizeof *s->seen.owner); // LAYER_NOTHING
    for (int32_t i = 0; i < s->count; ++i) {
        if (s->reaches[i].top >= area.end || s->reaches[i].end <= area.top) continue;
        layer_plane depth = plane_of(s, s->triangles + i);
        fill_polygon(s, s->triangles[i].corners, &depth, i, fill_seen);
    }
    if (!s->overlay) return;
    memset(s->overlay, 0, samples * sizeof *s->overlay);
    draw_overlay(s);
}

static void draw_bands(scene *s, uint8_t *out)
{
    int32_t width = s->width / FINE, height = s->height / FINE;
    light_bytes bytes;
    light_make_bytes(&bytes);
    for (int32_t row = 0; row < height; row += BAND) {
        int32_t end = row + BAND < height ? row + BAND : height;
        draw_band(s, row, end);
        for (int32_t y = row; y < end; ++y) {
            for (int32_t x = 0; x < width; ++x, out += 3) {
                vec c = light_pixel(s, x, y);
                out[0] = light_to_byte(&bytes, c.x), out[1] = light_to_byte(&bytes, c.y),
                out[2] = light_to_byte(&bytes, c.z);
            }
        }
    }
}

int32_t picture_render(const fe_world *world, const picture_view *view, int32_t width, int32_t height, uint8_t *out_rgb)
{
    if (width < PICTURE_LEAST || width > PICTURE_MOST || height < PICTURE_LEAST || height > PICTURE_MOST)
        return FE_ERROR_ARGUMENT;
    scene s = {.camera = make_camera(view), .width = FINE * width, .height = FINE * height};
    vec target = make_vec(view->target.x - view->eye.x, view->target.y - view->eye.y, view->target.z - view->eye.z);
    s.light =
        (light){&s.shadow, into_camera(&s.camera, make_vec(0, 1, 0)), into_camera(&s.camera, target), view->radius};
    s.focal = view->focal * s.width;
    int32_t result = prepare(&s, world, view);
    if (result == FE_OK) draw_bands(&s, out_rgb);
    shadow_free(&s.shadow);
    free(s.triangles), free(s.reaches), free(s.lines), free(s.seen.near), free(s.seen.owner), free(s.overlay);
    return result;
}
