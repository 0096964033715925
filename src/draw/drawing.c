// drawing.c - see drawing.h.
#include "draw/drawing.h"

#include "core/bytes.h"

// ---- drawing --------------------------------------------------------------------------------------------------------

void fe__drawing_begin(fe__drawing *d, int32_t segments)
{
    const double most = FE_MAX_POSITION;
    const fe__bounds *b = &d->box;
    d->has_box = b->low.x > -most || b->low.y > -most || b->low.z > -most || b->high.x < most || b->high.y < most ||
                 b->high.z < most;
    fe__circle_make(&d->circle, segments);
    memset(d->hue_of, 0, sizeof d->hue_of);
}

// ---- colours --------------------------------------------------------------------------------------------------------

const uint32_t fe__colours[FE__NAMED_COLOURS] = {
    [FE__COLOUR_STATIC] = FE__RGB(154, 160, 166), [FE__COLOUR_KINEMATIC] = FE__RGB(0, 114, 178),
    [FE__COLOUR_AWAKE] = FE__RGB(230, 159, 0),    [FE__COLOUR_ASLEEP] = FE__RGB(104, 110, 120),
    [FE__COLOUR_ANCHOR] = FE__RGB(86, 180, 233),  [FE__COLOUR_GAP] = FE__RGB(213, 94, 0),
    [FE__COLOUR_X] = FE__RGB(213, 94, 0),         [FE__COLOUR_Y] = FE__RGB(0, 158, 115),
    [FE__COLOUR_Z] = FE__RGB(0, 114, 178),        [FE__COLOUR_FORCE] = FE__RGB(204, 121, 167),
    [FE__COLOUR_BOUNDS] = FE__RGB(190, 190, 190), [FE__COLOUR_TREE] = FE__RGB(120, 150, 120),
    [FE__COLOUR_CENTRE] = FE__RGB(255, 255, 255),
};

static const uint32_t hues[FE__HUES] = {
    FE__RGB(230, 159, 0), FE__RGB(0, 158, 115),   FE__RGB(204, 121, 167), FE__RGB(240, 228, 66),
    FE__RGB(213, 94, 0),  FE__RGB(136, 204, 238), FE__RGB(153, 153, 51),  FE__RGB(170, 68, 153),
};

// Of triggers and of what is disabled
enum { SEE_THROUGH = 80, OPAQUE = 255, ALPHA_SHIFT = 24 };

static uint32_t with_alpha(uint32_t rgba, uint32_t alpha)
{
    return (rgba & ~((uint32_t)OPAQUE << ALPHA_SHIFT)) | alpha << ALPHA_SHIFT;
}

// Neighbours in time differ: multiples of the golden ratio spread evenly
static uint8_t hue_of_serial(uint64_t serial) { return (uint8_t)(serial * 0x9e3779b97f4a7c15u >> 61); }
_Static_assert(FE__HUES == 8, "three bits of the product");

// The walk over bodies is in the order of creation: who is met first of an island is its oldest
static uint8_t island_hue(fe__drawing *d, const fe__body *body)
{
    if (body->island < 0 || body->island >= FE__DRAWN_ISLANDS) return hue_of_serial(body->serial);
    uint8_t *hue = d->hue_of + body->island;
    if (!*hue) *hue = (uint8_t)(1 + hue_of_serial(body->serial));
    return (uint8_t)(*hue - 1);
}

static uint32_t opaque_colour(fe__drawing *d, const fe__body *body)
{
    if (body->type == FE_BODY_STATIC) return fe__colours[FE__COLOUR_STATIC];
    if (body->type == FE_BODY_KINEMATIC) return fe__colours[FE__COLOUR_KINEMATIC];
    if (body->awake_index < 0 && d->parts & FE_DRAW_SLEEP) return fe__colours[FE__COLOUR_ASLEEP];
    if (!(d->parts & FE_DRAW_ISLANDS)) return fe__colours[FE__COLOUR_AWAKE];
    return hues[island_hue(d, body)];
}

uint32_t fe__body_colour(fe__drawing *d, int32_t index)
{
    const fe__body *body = d->world->bodies + index;
    uint32_t colour = opaque_colour(d, body);
    return body->flags & FE__BODY_ENABLED ? colour : with_alpha(colour, SEE_THROUGH);
}

uint32_t fe__shape_colour(uint32_t body_colour, const fe__shape *shape)
{
    return shape->flags & FE__SHAPE_TRIGGER ? with_alpha(body_colour, SEE_THROUGH) : body_colour;
}

// `load`: the force as a multiple of the lighter body's weight
uint32_t fe__load_colour(double load)
{
    static const double least[FE__LOADS - 1] = {1e-3, 0.1, 1.0, 3.0, 10.0};
    static const uint32_t colours[FE__LOADS] = {FE__RGB(255, 255, 204), FE__RGB(254, 217, 118), FE__RGB(254, 178, 76),
                                                FE__RGB(253, 141, 60),  FE__RGB(227, 26, 28),   FE__RGB(128, 0, 38)};
    int32_t i = 0;
    while (i < FE__LOADS - 1 && load >= least[i]) ++i;
    return colours[i];
}

uint32_t fe__use_colour(double use)
{
    static const double least[FE__USES - 1] = {0.5, 0.75, 0.95, 1.001};
    static const uint32_t colours[FE__USES] = {FE__RGB(0, 158, 115), FE__RGB(170, 190, 70), FE__RGB(230, 159, 0),
                                               FE__RGB(213, 94, 0), FE__RGB(180, 0, 20)};
    int32_t i = 0;
    while (i < FE__USES - 1 && use >= least[i]) ++i;
    return colours[i];
}
