// colour.c - see colour.h.
#include "solver/graph/colour.h"

#include "core/hash.h"

#include <assert.h>

// ---- the constraint graph -------------------------------------------------------------------------------------------
static int32_t first_colour(uint64_t used_low, uint64_t used_high, int32_t first, int32_t end)
{
    for (int32_t word = first / 64; word <= (end - 1) / 64; ++word) {
        uint64_t free = ~(word ? used_high : used_low);
        if (word == first / 64) free &= UINT64_MAX << first % 64;
        if (!free) continue;
        int32_t colour = 64 * word + __builtin_ctzll(free);
        if (colour < end) return colour;
    }
    return FE__OVERFLOW_COLOUR;
}

static void take_colour(fe__body *body, int32_t colour) { body->colours[colour / 64] |= UINT64_C(1) << colour % 64; }

static void return_colour(fe__body *body, int32_t colour)
{
    body->colours[colour / 64] &= ~(UINT64_C(1) << colour % 64);
}

// Contacts of a pile come in an order, left before right. The first free colour would be another name for it: the
// solver would take left before right everywhere, and what a sweep gets wrong would add up (the top of 100 rows went
// 0.15 m aside). So it is drawn which of a colour and its mate (0 and 1, 2 and 3, ...) is taken; layers still follow
// each other as their colours come. The draw hangs on the meetings of the two bodies and of those that they met, not on
// serials, which strangers shift.
static int32_t draw_colour(fe__body *a, fe__body *b)
{
    uint64_t used[2] = {a->colours[0] | b->colours[0], a->colours[1] | b->colours[1]};
    uint64_t mixed = (((uint64_t)a->drawn << 32 | b->drawn) + 1) * FE_HASH_FACTOR;
    a->drawn = b->drawn = (uint32_t)(mixed >> 32);
    int32_t colour = first_colour(used[0], used[1], 0, FE__PAIR_COLOURS), mate = colour ^ 1;
    if (colour == FE__OVERFLOW_COLOUR || used[mate / 64] >> mate % 64 & 1) return colour;
    return a->drawn >> 31 ? mate : colour;
}

// Counted in pairs, fours and bytes side by side (Knuth 7.1.3, (62)), both words together from the fours on: without an
// instruction for it, which not every machine has, the compiler calls a function for each word
int32_t fe__colours_of(const fe__body *body)
{
    const uint64_t pairs = UINT64_MAX / 3, fours = UINT64_MAX / 5, bytes = UINT64_MAX / 17, ones = UINT64_MAX / 255;
    uint64_t low = body->colours[0], high = body->colours[1];
    low -= low >> 1 & pairs, high -= high >> 1 & pairs;
    low = (low & fours) + (low >> 2 & fours) + (high & fours) + (high >> 2 & fours);
    return (int32_t)(((low & bytes) + (low >> 4 & bytes)) * ones >> 56);
}

void fe__colour_contact(fe__body *bodies, fe__contact *m)
{
    assert(m->colour < 0);
    fe__body *a = bodies + m->body_a, *b = bodies + m->body_b;
    int32_t both = m->kind & FE__ROW_PAIR;
    m->colour =
        both ? draw_colour(a, b)
             : first_colour(b->colours[0], b->colours[1], FE__PAIR_COLOURS, FE__PAIR_COLOURS + FE__STATIC_COLOURS);
    if (m->colour == FE__OVERFLOW_COLOUR) return;
    take_colour(b, m->colour);
    if (both) take_colour(a, m->colour);
}

static int32_t claim_colour(fe__body *body, int32_t colour)
{
    if (body->colours[colour / 64] >> colour % 64 & 1) return 0;
    take_colour(body, colour);
    return 1;
}

int32_t fe__recolour_contact(fe__body *bodies, const fe__contact *m)
{
    int32_t both = m->kind & FE__ROW_PAIR;
    if (m->colour == FE__OVERFLOW_COLOUR) return 1;
    if (both != (m->colour < FE__PAIR_COLOURS ? FE__ROW_PAIR : 0)) return 0;
    return claim_colour(bodies + m->body_b, m->colour) && (!both || claim_colour(bodies + m->body_a, m->colour));
}

void fe__uncolour_contact(fe__body *bodies, fe__contact *m)
{
    if (m->colour != FE__OVERFLOW_COLOUR) {
        return_colour(bodies + m->body_b, m->colour);
        if (m->kind & FE__ROW_PAIR) return_colour(bodies + m->body_a, m->colour);
    }
    m->colour = -1;
}
