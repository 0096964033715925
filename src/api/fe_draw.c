// fe_draw.c - the API of drawing. It only reads: any number of threads may draw while none writes.
#include "api/check.h"
#include "core/fp_state.h"
#include "draw/drawing.h"

enum { LEAST_RECORD = 16 }; // bytes: where a vertex is, and its colour

static fe_draw_options default_options(void)
{
    return (fe_draw_options){.struct_size = sizeof(fe_draw_options),
                             .parts = FE_DRAW_SHAPES | FE_DRAW_ISLANDS | FE_DRAW_SLEEP,
                             .lower = {-FE_MAX_POSITION, -FE_MAX_POSITION, -FE_MAX_POSITION},
                             .upper = {FE_MAX_POSITION, FE_MAX_POSITION, FE_MAX_POSITION},
                             .scale = 0.5f,
                             .segments = 16};
}

void fe_draw_options_init(fe_draw_options *options, uint32_t struct_size)
{
    fe_draw_options defaults = default_options();
    fe__init_struct(options, &defaults, sizeof defaults, struct_size);
}

static fe_result check_options(const char *function, const fe_draw_options *options)
{
    FE_CHECK_BITS(options->parts, FE__DRAW_ALL);
    FE_CHECK_DVEC3(&options->origin, FE_MAX_POSITION);
    FE_CHECK_DVEC3(&options->lower, FE_MAX_POSITION);
    FE_CHECK_DVEC3(&options->upper, FE_MAX_POSITION);
    FE_CHECK_FLOAT(options->upper.x, options->lower.x, FE_MAX_POSITION);
    FE_CHECK_FLOAT(options->upper.y, options->lower.y, FE_MAX_POSITION);
    FE_CHECK_FLOAT(options->upper.z, options->lower.z, FE_MAX_POSITION);
    FE_CHECK_FLOAT(options->scale, FE_LEAST_VALUE, FE_MAX_VALUE);
    FE_CHECK_INT(options->segments, FE__LEAST_SEGMENTS, FE__SEGMENTS);
    return FE_OK;
}

static fe_result read_options(const char *function, const fe_world *world, const fe_draw_options *options,
                              fe__drawing *drawing)
{
    fe_draw_options copy = default_options();
    if (options) FE_READ_STRUCT(options, &copy);
    options = &copy;
    FE_TRY(check_options(function, options));
    drawing->only = -1;
    if (options->only) FE_TRY(fe__find_body(function, "options->only", world, options->only, &drawing->only));
    drawing->world = world;
    drawing->parts = options->parts;
    drawing->origin = options->origin;
    drawing->box = (fe__bounds){options->lower, options->upper};
    drawing->scale = options->scale;
    fe__drawing_begin(drawing, options->segments);
    return FE_OK;
}

// Declares `drawing`: what all functions check
#define FE_READ_DRAWING(out, stride, capacity)              \
    FE_CHECK_ARRAY(out, capacity);                          \
    FE_CHECK_RECORD_STRIDE(stride, LEAST_RECORD, capacity); \
    fe__drawing drawing;                                    \
    FE_CLEANUP(leave) fe__fp_state fp = fe__fp_enter();     \
    (void)fp;                                               \
    FE_TRY(read_options(function, world, options, &drawing))

static inline void leave(fe__fp_state *fp) { fe__fp_leave(*fp); }

// What fe_world_draw_lines, _triangles and _points share: `draw` is theirs
static int32_t draw_vertices(const char *function, const fe_world *world, const fe_draw_options *options,
                             fe_draw_vertex *out_vertices, uint32_t stride, int32_t capacity,
                             void (*draw)(fe__drawing *drawing, fe__pen *pen))
{
    FE_READ_DRAWING(out_vertices, stride, capacity);
    const uint32_t whole = (uint32_t)sizeof *out_vertices;
    fe__pen pen = {.out = (unsigned char *)out_vertices,
                   .stride = stride,
                   .size = stride < whole ? stride : whole,
                   .capacity = capacity};
    draw(&drawing, &pen);
    if (pen.count <= INT32_MAX) return (int32_t)pen.count;
    return fe__fail(function, FE_ERROR_LIMIT, "%lld vertices are more than 2^31 - 1: draw less, within lower and upper",
                    (long long)pen.count);
}

int32_t fe_world_draw_lines(const fe_world *world, const fe_draw_options *options, fe_draw_vertex *out_vertices,
                            uint32_t stride, int32_t capacity)
{
    FE_READ(world);
    return draw_vertices(function, world, options, out_vertices, stride, capacity, fe__draw_lines);
}

int32_t fe_world_draw_triangles(const fe_world *world, const fe_draw_options *options, fe_draw_vertex *out_vertices,
                                uint32_t stride, int32_t capacity)
{
    FE_READ(world);
    return draw_vertices(function, world, options, out_vertices, stride, capacity, fe__draw_triangles);
}

int32_t fe_world_draw_points(const fe_world *world, const fe_draw_options *options, fe_draw_vertex *out_vertices,
                             uint32_t stride, int32_t capacity)
{
    FE_READ(world);
    return draw_vertices(function, world, options, out_vertices, stride, capacity, fe__draw_points);
}

int32_t fe_world_draw_instances(const fe_world *world, const fe_draw_options *options, fe_draw_instance *out_instances,
                                uint32_t stride, int32_t capacity)
{
    FE_READ(world);
    FE_READ_DRAWING(out_instances, stride, capacity);
    const uint32_t whole = (uint32_t)sizeof *out_instances;
    return fe__draw_instances(&drawing, out_instances, stride, stride < whole ? stride : whole, capacity);
}
