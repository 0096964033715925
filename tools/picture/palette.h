// palette.h - the few colours of a picture that has many. 144: the fixed codes of deflate are short for so many.
#ifndef PICTURE_PALETTE_H
#define PICTURE_PALETTE_H
#include <stdint.h>

enum { PALETTE_MOST = 144 };

typedef struct palette {
    int32_t count;
    uint8_t rgb[3 * PALETTE_MOST];
} palette;

/// @param out_indices  of each pixel's colour
/// @return 0 without memory
int palette_make(const uint8_t *rgb, int32_t pixels, palette *out, uint8_t *out_indices);

#endif
