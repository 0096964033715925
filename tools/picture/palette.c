// palette.c - see palette.h. The box of colours that has the greatest squared error is cut in two at its mean, across
// the axis on which it is widest, until there are
// PALETTE_MOST (Wan, Prusinkiewicz and Wong, 1990). All in integers.
#include "palette.h"

#include <stdlib.h>
#include <string.h>

enum { EMPTY = -1 };

typedef struct colour {
    int32_t rgb[3], pixels, number;
} colour;

typedef struct box {
    int32_t first, count; // of colours
    int64_t pixels, sum[3];
    int64_t error; // on its widest axis
    int32_t axis;
} box;

// pixels * variance of an axis, rounded down
static void measure(const colour *colours, box *b)
{
    int64_t squares[3] = {0, 0, 0};
    b->pixels = b->sum[0] = b->sum[1] = b->sum[2] = 0, b->error = 0, b->axis = 0;
    for (int32_t i = b->first; i < b->first + b->count; ++i) {
        const colour *c = colours + i;
        b->pixels += c->pixels;
        for (int k = 0; k < 3; ++k)
            b->sum[k] += (int64_t)c->rgb[k] * c->pixels, squares[k] += (int64_t)c->rgb[k] * c->rgb[k] * c->pixels;
    }
    for (int k = 0; k < 3; ++k) {
        uint64_t square = (uint64_t)b->sum[k] * (uint64_t)b->sum[k]; // fits: of 2^24 pixels at most
        int64_t error = squares[k] - (int64_t)(square / (uint64_t)b->pixels);
        if (error > b->error && b->count > 1) b->error = error, b->axis = k;
    }
}

// What is above the mean of the axis goes to the back. 0: all are equal there
static int split(colour *colours, box *b, box *other)
{
    int64_t mean = b->sum[b->axis] / b->pixels;
    int32_t front = b->first, back = b->first + b->count;
    while (front < back) {
        if (colours[front].rgb[b->axis] <= mean) {
            ++front;
            continue;
        }
        colour c = colours[front];
        colours[front] = colours[--back], colours[back] = c;
    }
    if (front == b->first || front == b->first + b->count) return 0;
    *other = (box){.first = front, .count = b->first + b->count - front};
    b->count = front - b->first;
    measure(colours, b), measure(colours, other);
    return 1;
}

static int32_t make_boxes(colour *colours, int32_t count, box *boxes)
{
    int32_t box_count = 1;
    boxes[0] = (box){.count = count};
    measure(colours, boxes);
    while (box_count < PALETTE_MOST) {
        box *worst = boxes;
        for (int32_t i = 1; i < box_count; ++i)
            if (boxes[i].error > worst->error) worst = boxes + i;
        if (worst->error <= 0) break;
        if (split(colours, worst, boxes + box_count))
            ++box_count;
        else
            worst->error = 0;
    }
    return box_count;
}

// ---- the colours that there are ------------------------------------------------------------------------------------
typedef struct counter {
    colour *colours;
    int32_t count;
    int32_t *slots; // numbers of colours, by hash
    uint32_t slot_mask;
} counter;

static int32_t *slot_of(const counter *c, const uint8_t *rgb)
{
    uint32_t key = (uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | rgb[2], hash = key * UINT32_C(0x9e3779b1);
    uint32_t at = (hash ^ hash >> 15) & c->slot_mask;
    for (; c->slots[at] != EMPTY; at = (at + 1) & c->slot_mask) {
        const int32_t *there = c->colours[c->slots[at]].rgb;
        if (there[0] == rgb[0] && there[1] == rgb[1] && there[2] == rgb[2]) break;
    }
    return c->slots + at;
}

static void count_colours(counter *c, const uint8_t *rgb, int32_t pixels, int32_t *of_pixel)
{
    for (int32_t i = 0; i < pixels; ++i, rgb += 3) {
        if (i && memcmp(rgb, rgb - 3, 3) == 0) {
            of_pixel[i] = of_pixel[i - 1];
        } else {
            int32_t *slot = slot_of(c, rgb);
            if (*slot == EMPTY) {
                c->colours[c->count] = (colour){{rgb[0], rgb[1], rgb[2]}, 0, c->count};
                *slot = c->count++;
            }
            of_pixel[i] = *slot;
        }
        ++c->colours[of_pixel[i]].pixels;
    }
}

// The mean of each box; of_colour[number] is its index
static void fill_palette(const colour *colours, const box *boxes, palette *out, uint8_t *of_colour)
{
    for (int32_t i = 0; i < out->count; ++i) {
        const box *b = boxes + i;
        for (int k = 0; k < 3; ++k) out->rgb[3 * i + k] = (uint8_t)((b->sum[k] + b->pixels / 2) / b->pixels);
        for (int32_t k = b->first; k < b->first + b->count; ++k) of_colour[colours[k].number] = (uint8_t)i;
    }
}

int palette_make(const uint8_t *rgb, int32_t pixels, palette *out, uint8_t *out_indices)
{
    box boxes[PALETTE_MOST];
    size_t slots = 256;
    while (slots < 2 * (size_t)pixels) slots *= 2;
    counter c = {malloc((size_t)pixels * sizeof *c.colours), 0, malloc(slots * sizeof *c.slots), (uint32_t)slots - 1};
    int32_t *of_pixel = malloc((size_t)pixels * sizeof *of_pixel);
    uint8_t *of_colour = malloc((size_t)pixels);
    int done = c.colours && c.slots && of_pixel && of_colour;
    if (done) {
        memset(c.slots, 0xff, slots * sizeof *c.slots); // EMPTY
        count_colours(&c, rgb, pixels, of_pixel);
        out->count = make_boxes(c.colours, c.count, boxes);
        fill_palette(c.colours, boxes, out, of_colour);
        for (int32_t i = 0; i < pixels; ++i) out_indices[i] = of_colour[of_pixel[i]];
    }
    free(c.colours), free(c.slots), free(of_pixel), free(of_colour);
    return done;
}
