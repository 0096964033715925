// api_test.h - what the tests of the API share: worlds with something in them, and the law of errors.
//
// The law: a refused call says why (the sentence begins with the function's name) and changes nothing (the world's
// fingerprint stays).
#ifndef FE_API_TEST_H
#define FE_API_TEST_H
#include "fe_test.h"

#include "feather.h"
#include "support/values.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define NOT_A_NUMBER ((float)NAN)
#define INFINITE ((float)INFINITY)

static inline uint64_t hash_of(const fe_world *world)
{
    uint32_t words[2] = {0, 0};
    if (world) assert_int_equal(fe_world_hash(world, words), FE_OK);
    return (uint64_t)words[1] << 32 | words[0];
}

static inline void check_refusal(int32_t result, int32_t expected, const char *call, const char *file, int line)
{
    size_t name = strcspn(call, "(");
    if (result != expected) {
        print_error("%s gave %s, not %s\n", call, fe_result_name(result), fe_result_name(expected));
        _fail(file, line);
    }
    if (strncmp(fe_last_error(), call, name) != 0 || fe_last_error()[name] != ':') {
        print_error("%s failed with the sentence of another function: %s\n", call, fe_last_error());
        _fail(file, line);
    }
}

// `call` fails with `expected`, says so, and leaves the world as it was
#define REFUSES(world, expected, call)                                       \
    do {                                                                     \
        uint64_t before_call = hash_of(world);                               \
        check_refusal((int32_t)(call), expected, #call, __FILE__, __LINE__); \
        FE_TRUE(hash_of(world) == before_call);                              \
    } while (0)

#define OK(call) assert_int_equal(call, FE_OK)
// A query finds one
#define HIT(call) assert_int_equal(call, 1)
// The sentence of the last failure contains the words
#define SAYS(words)                                                              \
    do {                                                                         \
        if (!strstr(fe_last_error(), words)) {                                   \
            print_error("\"%s\" does not say \"%s\"\n", fe_last_error(), words); \
            _fail(__FILE__, __LINE__);                                           \
        }                                                                        \
    } while (0)

static inline fe_world *new_world(void)
{
    fe_world *world = NULL;
    OK(fe_world_create(NULL, &world));
    assert_non_null(world);
    return world;
}

// Worlds with the same number give the same handles for the same calls
static inline fe_world *new_world_of(uint32_t number)
{
    fe_world_def def;
    fe_world *world = NULL;
    fe_world_def_init(&def, sizeof def);
    def.number = number;
    OK(fe_world_create(&def, &world));
    assert_non_null(world);
    return world;
}

static inline fe_body new_body(fe_world *world, int32_t type, double x, double y, double z)
{
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.type = type;
    def.transform.position = fe_make_dvec3(x, y, z);
    fe_body body = 0;
    OK(fe_body_create(world, &def, &body));
    assert_true(body != 0);
    return body;
}

static inline fe_shape add_shape(fe_world *world, fe_body body, const fe_geometry *geometry)
{
    fe_shape shape = 0;
    OK(fe_shape_create(world, body, NULL, geometry, &shape));
    assert_true(shape != 0);
    return shape;
}

static inline fe_shape add_box(fe_world *world, fe_body body, float half)
{
    fe_geometry geometry;
    fe_geometry_box(&geometry, half, half, half);
    return add_shape(world, body, &geometry);
}

static inline fe_shape add_sphere(fe_world *world, fe_body body, float radius)
{
    fe_geometry geometry;
    fe_geometry_sphere(&geometry, radius);
    return add_shape(world, body, &geometry);
}

// The half space y <= 0
static inline fe_body new_ground(fe_world *world)
{
    fe_body ground = new_body(world, FE_BODY_STATIC, 0, 0, 0);
    fe_geometry geometry;
    fe_geometry_plane(&geometry, 0, 1, 0, 0);
    add_shape(world, ground, &geometry);
    return ground;
}

static inline fe_body new_box(fe_world *world, double x, double y, double z)
{
    fe_body body = new_body(world, FE_BODY_DYNAMIC, x, y, z);
    add_box(world, body, 0.5f);
    return body;
}

static inline void step(fe_world *world, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) OK(fe_world_step(world, 1.0f / 60.0f));
}

static inline int32_t is_awake(const fe_world *world, fe_body body)
{
    int32_t awake = -1;
    OK(fe_body_get_awake(world, body, &awake));
    return awake;
}

#endif
