// test_picture.c - pictures (tools/picture) have the same bytes on every machine, with every compiler, number of
// workers and SIMD set, and are what they say they are.
//
// pictures.txt holds hashes of the scenes as they begin, so that no change of the solver concerns it. It is written by
// `build/feather-picture --hash`, after a change of the renderer, of a scene or of the draw calls.
#include "fe_test.h"

#include "../../tools/picture/scenes.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 160, HEIGHT = 100 };

static const picture_scene *scene_named(const char *name)
{
    for (int32_t i = 0; i < picture_scene_count; ++i)
        if (strcmp(picture_scenes[i].name, name) == 0) return picture_scenes + i;
    return NULL;
}

static void pictures_have_the_recorded_hashes(void **state)
{
    (void)state;
    FILE *file = fopen("tests/determinism/pictures.txt", "r");
    assert_non_null(file);
    char name[32];
    uint64_t hash;
    int32_t count = 0;
    for (; fscanf(file, "%31s %" SCNx64, name, &hash) == 2; ++count) {
        const picture_scene *scene = scene_named(name);
        assert_non_null(scene);
        uint64_t found = picture_hash(scene);
        if (found != hash) fail_msg("%s: %016" PRIx64 ", recorded is %016" PRIx64, name, found, hash);
    }
    fclose(file);
    assert_int_equal(count, picture_scene_count);
}

// ---- workers and kernels -------------------------------------------------------------------------------------------
static void workers_and_kernels_do_not_show(void **state)
{
    (void)state;
    enum { STEPS = 20 };
    const int32_t workers[] = {1, 8, 1, 8}, simd[] = {FE_SIMD_PLAIN, FE_SIMD_PLAIN, FE_SIMD_AUTO, FE_SIMD_AUTO};
    const picture_scene *scene = scene_named("bridge");
    uint8_t *first = NULL;
    size_t first_size = 0;
    for (int32_t i = 0; i < 4; ++i) {
        fe_world_def def;
        fe_world_def_init(&def, sizeof def);
        def.worker_count = workers[i], def.simd = simd[i];
        fe_world *world = picture_play(scene, &def, STEPS);
        size_t size = 0;
        uint8_t *png = picture_take(world, &scene->view, WIDTH, HEIGHT, &size);
        assert_non_null(png);
        if (!first) {
            first = png, first_size = size;
        } else {
            assert_int_equal(size, first_size);
            assert_memory_equal(png, first, size);
            free(png);
        }
        FE_TRUE(fe_world_destroy(world) == FE_OK);
    }
    free(first);
}

// ---- what is in a picture ------------------------------------------------------------------------------------------
typedef struct pixel {
    int32_t red, green, blue;
} pixel;

static pixel pixel_at(const uint8_t *rgb, int32_t x, int32_t y)
{
    const uint8_t *p = rgb + 3 * (y * WIDTH + x);
    return (pixel){p[0], p[1], p[2]};
}

static fe_body put_box(fe_world *world, int32_t type, double y, float half)
{
    fe_body_def def;
    fe_geometry form;
    fe_body body;
    fe_shape shape;
    fe_body_def_init(&def, sizeof def);
    def.type = type, def.transform = fe_make_transform(0, y, 0);
    fe_geometry_box(&form, half, type == FE_BODY_STATIC ? 0.1f : half, half);
    FE_TRUE(fe_body_create(world, &def, &body) == FE_OK);
    FE_TRUE(fe_shape_create(world, body, NULL, &form, &shape) == FE_OK);
    return body;
}

// A box of 2 m on a floor, from 10 m, 20 degrees above: sun from the upper left, so that its shadow falls to the right.
// In the middle is its front; to its right the floor, darker near the box than far to the left, where no shadow is.
// The colour of awake bodies has more red than blue by far, floor and sky have not.
static void a_box_on_a_floor_is_seen_with_its_shadow(void **state)
{
    (void)state;
    static uint8_t rgb[3 * WIDTH * HEIGHT];
    const picture_view view = {{0, 4.4, 9.4}, {0, 1, 0}, 1.0, 20.0, {-1, 1, 0.5f}, FE_DRAW_SHAPES, 0.5f};
    fe_world *world;
    FE_TRUE(fe_world_create(NULL, &world) == FE_OK);
    put_box(world, FE_BODY_STATIC, -0.1, 15.0f);
    put_box(world, FE_BODY_DYNAMIC, 1.0, 1.0f);
    FE_TRUE(picture_render(world, &view, WIDTH, HEIGHT, rgb) == FE_OK);
    pixel front = pixel_at(rgb, WIDTH / 2, HEIGHT / 2), shade = pixel_at(rgb, WIDTH / 2 + 22, HEIGHT / 2 + 8);
    pixel floor = pixel_at(rgb, WIDTH / 2 - 40, HEIGHT / 2 + 8), sky = pixel_at(rgb, WIDTH / 2, 1);
    assert_true(front.red > front.blue + 60);
    assert_true(floor.red - floor.blue < 20 && floor.blue - floor.red < 20);
    assert_true(shade.green + 30 < floor.green);
    assert_true(sky.blue > sky.red);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// Orange is what is awake, as above
static int32_t is_awake(const uint8_t *rgb, int32_t x, int32_t y)
{
    pixel p = pixel_at(rgb, x, y);
    return p.red > p.blue + 40;
}

// Rows of boxes along every axis, from above and from below, and one that fell for a minute
static void a_fitted_view_shows_all_that_moves(void **state)
{
    (void)state;
    static uint8_t rgb[3 * WIDTH * HEIGHT];
    const fe_vec3 from[] = {{0.6f, 0.45f, 1.0f}, {1, 0, 0}, {-0.2f, 3, 0.1f}, {0, -1, 2}};
    for (int32_t i = 0; i < 4; ++i) {
        picture_view view = {.focal = 0.5 + 0.5 * i, .sun = {-1, 1, 0.5f}, .parts = FE_DRAW_SHAPES, .scale = 1};
        fe_world *world;
        FE_TRUE(fe_world_create(NULL, &world) == FE_OK);
        for (int32_t k = 0; k < 20; ++k) put_box(world, FE_BODY_DYNAMIC, 3.0 * k, 1.0f);
        put_box(world, FE_BODY_DYNAMIC, -18000, 1.0f);
        FE_TRUE(picture_fit(world, from[i], WIDTH, HEIGHT, &view) == FE_OK);
        FE_TRUE(picture_render(world, &view, WIDTH, HEIGHT, rgb) == FE_OK);
        int32_t seen = 0, at_the_edge = 0;
        for (int32_t y = 0; y < HEIGHT; ++y)
            for (int32_t x = 0; x < WIDTH; ++x) {
                seen += is_awake(rgb, x, y);
                at_the_edge += is_awake(rgb, x, y) && (x == 0 || y == 0 || x == WIDTH - 1 || y == HEIGHT - 1);
            }
        assert_int_equal(at_the_edge, 0);
        assert_true(seen > HEIGHT); // it fills the picture's height, 60 m of it with boxes of 2 m
        FE_TRUE(fe_world_destroy(world) == FE_OK);
    }
}

static void sizes_out_of_range_are_refused(void **state)
{
    (void)state;
    const int32_t sizes[][2] = {{PICTURE_LEAST - 1, 100}, {100, PICTURE_MOST + 1}, {0, 0}, {-5, 100}};
    uint8_t rgb[3];
    size_t size;
    fe_world *world;
    FE_TRUE(fe_world_create(NULL, &world) == FE_OK);
    for (int32_t i = 0; i < 4; ++i) {
        const picture_view *view = &picture_scenes[0].view;
        FE_TRUE(picture_render(world, view, sizes[i][0], sizes[i][1], rgb) == FE_ERROR_ARGUMENT);
        FE_TRUE(picture_take(world, view, sizes[i][0], sizes[i][1], &size) == NULL);
    }
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// ---- a reader of PNG, for what is written here: fixed codes, a palette, no filter ----------------------------------
typedef struct reader {
    const uint8_t *data;
    size_t bit;
} reader;

static uint32_t bits(reader *r, int32_t count)
{
    uint32_t value = 0;
    for (int32_t i = 0; i < count; ++i, ++r->bit) value |= (uint32_t)(r->data[r->bit / 8] >> r->bit % 8 & 1) << i;
    return value;
}

static uint32_t code(reader *r, int32_t count) // greatest bit first
{
    uint32_t value = 0;
    for (int32_t i = 0; i < count; ++i) value = value << 1 | bits(r, 1);
    return value;
}

// RFC 1951, 3.2.6
static uint32_t symbol(reader *r)
{
    uint32_t value = code(r, 7);
    if (value < 24) return 256 + value;
    value = value << 1 | bits(r, 1);
    if (value < 0xc0) return value - 0x30;
    if (value < 0xc8) return 280 + value - 0xc0;
    return 144 + (value << 1 | bits(r, 1)) - 0x190;
}

static uint32_t match_length(reader *r, uint32_t s)
{
    static const uint16_t base[29] = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                      31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
    assert_in_range(s, 257, 285);
    int32_t extra = s < 265 || s == 285 ? 0 : (int32_t)(s - 261) / 4;
    return base[s - 257] + bits(r, extra);
}

static uint32_t match_distance(reader *r)
{
    uint32_t s = code(r, 5);
    assert_in_range(s, 0, 29);
    if (s < 4) return s + 1;
    int32_t extra = (int32_t)s / 2 - 1;
    return ((2 + s % 2) << extra) + 1 + bits(r, extra);
}

static size_t inflate(const uint8_t *data, uint8_t *out, size_t room)
{
    reader r = {data, 0};
    size_t count = 0;
    assert_int_equal(bits(&r, 3), 3); // the last block, fixed codes
    for (uint32_t s = symbol(&r); s != 256; s = symbol(&r)) {
        if (s < 256) {
            assert_true(count < room);
            out[count++] = (uint8_t)s;
            continue;
        }
        uint32_t length = match_length(&r, s), distance = match_distance(&r);
        assert_true(distance <= count && count + length <= room);
        for (; length; --length, ++count) out[count] = out[count - distance];
    }
    return count;
}

static uint32_t number_at(const uint8_t *p)
{
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

static const uint8_t *find_chunk(const uint8_t *png, size_t size, const char *name)
{
    for (size_t at = 8; at + 12 <= size; at += 12 + number_at(png + at))
        if (memcmp(png + at + 4, name, 4) == 0) return png + at + 8;
    fail_msg("no %s", name);
    return NULL;
}

// Stripes of fewer colours than the palette has come back as they were, with runs of every length up to 300 (a match
// holds 258) and what repeats from far away; of noise every index is one of the palette's.
static void what_is_packed_comes_back(void **state)
{
    (void)state;
    static uint8_t rgb[3 * WIDTH * HEIGHT], rows[(WIDTH + 1) * HEIGHT];
    for (int32_t noise = 0; noise < 2; ++noise) {
        uint32_t seed = 1;
        for (int32_t i = 0, run = 0, length = 1; i < WIDTH * HEIGHT; ++i, ++run) {
            if (run == length || noise)
                run = 0, length = length % 300 + 1, seed = seed * UINT32_C(1664525) + 1013904223;
            for (int32_t k = 0; k < 3; ++k) rgb[3 * i + k] = (uint8_t)(seed >> (noise ? 8 * k + 8 : 24 + k));
        }
        size_t size;
        uint8_t *png = picture_png(rgb, WIDTH, HEIGHT, &size);
        assert_non_null(png);
        const uint8_t *colours = find_chunk(png, size, "PLTE"), *packed = find_chunk(png, size, "IDAT");
        uint32_t colour_count = number_at(colours - 8) / 3;
        assert_int_equal(number_at(find_chunk(png, size, "IHDR")), WIDTH);
        assert_int_equal(inflate(packed + 2, rows, sizeof rows), sizeof rows);
        for (int32_t i = 0; i < WIDTH * HEIGHT; ++i) {
            uint8_t index = rows[i / WIDTH * (WIDTH + 1) + 1 + i % WIDTH];
            assert_true(index < colour_count);
            if (!noise) assert_memory_equal(colours + 3 * index, rgb + 3 * i, 3);
        }
        free(png);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_have_the_recorded_hashes),
        cmocka_unit_test(workers_and_kernels_do_not_show),
        cmocka_unit_test(a_box_on_a_floor_is_seen_with_its_shadow),
        cmocka_unit_test(a_fitted_view_shows_all_that_moves),
        cmocka_unit_test(sizes_out_of_range_are_refused),
        cmocka_unit_test(what_is_packed_comes_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
