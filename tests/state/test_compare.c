// test_compare.c - where two worlds first differ: each kind of record, one bit of a velocity, what is missing, what
// does not count; and bytes that nobody saved.
#include "state/snapshot_bytes.h"
#include "snapshot/format.h"
#include "support/play.h"

#include <math.h>

static fe_world *make(const script *s, int32_t steps)
{
    static play p;
    fe_world_def def;
    fe_world *world;
    fe_world_def_init(&def, sizeof def);
    def.number = 7;
    FE_TRUE(fe_world_create(&def, &world) == FE_OK);
    play_begin(&p, world);
    play_until(&p, s, steps);
    return world;
}

static fe_world *load(bytes b, int32_t new_number)
{
    fe_restore_options options;
    fe_world *world;
    fe_restore_options_init(&options, sizeof options);
    options.new_number = new_number;
    if (fe_world_load(NULL, &options, b.data, b.size, &world) < 0) fail_msg("%s", fe_last_error());
    return world;
}

static fe_difference compare(bytes a, bytes b, int32_t expected)
{
    fe_difference d;
    fe_difference_init(&d, sizeof d);
    int32_t found = fe_snapshot_compare(a.data, a.size, b.data, b.size, &d);
    if (found != expected) fail_msg("%d: %s %s, %s and %s", (int)found, d.kind, d.field, d.a, d.b);
    assert_int_equal(fe_snapshot_compare(a.data, a.size, b.data, b.size, NULL), expected);
    return d;
}

static fe_difference difference_of_worlds(const fe_world *a, const fe_world *b)
{
    bytes x = save(a), y = save(b);
    fe_difference d = compare(x, y, 1);
    free(x.data), free(y.data);
    return d;
}

static void expect(fe_difference d, const char *kind, const char *field, fe_handle handle, int32_t element)
{
    if (strcmp(d.kind, kind) || strcmp(d.field, field) || d.handle != handle || d.element != element)
        fail_msg("%s %llx %s[%d], not %s %llx %s[%d]: %s, %s", d.kind, (unsigned long long)d.handle, d.field,
                 (int)d.element, kind, (unsigned long long)handle, field, (int)element, d.a, d.b);
    FE_TRUE(strcmp(d.a, d.b) != 0);
}

// ---- what is the same
// ------------------------------------------------------------------------------------------------
static void the_same_state_has_no_difference(void **state)
{
    (void)state;
    fe_world *world = make(&script_crowd, 45); // with events: their handles have the world's number
    bytes a = save(world);
    fe_world *twin = load(a, 0), *other = load(a, 1);
    bytes b = save(twin), c = save(other);
    fe_difference d = compare(a, b, 0);
    FE_TRUE(d.struct_size == sizeof d && d.kind[0] == 0 && d.handle == 0);
    compare(a, c, 0); // the number alone
    free(a.data), free(b.data), free(c.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK && fe_world_destroy(twin) == FE_OK && fe_world_destroy(other) == FE_OK);
}

// ---- what differs
// ----------------------------------------------------------------------------------------------------
static void a_bit_of_a_velocity_is_named(void **state)
{
    (void)state;
    fe_world *world = make(&script_crowd, 45);
    bytes a = save(world);
    fe_world *twin = load(a, 0);
    fe_body bodies[2048];
    int32_t count = fe_world_get_bodies(world, bodies, 2048);
    FE_TRUE(count > 100 && count <= 2048);
    for (int32_t i = count - 1, changed = 0; i >= 0 && changed < 3; i -= 7) {
        fe_vec3 v, w;
        FE_TRUE(fe_body_get_linear_velocity(twin, bodies[i], &v) == FE_OK);
        if (v.z == 0.0f) continue;
        v = w = (fe_vec3){1.0f, 2.0f, 1e-6f}; // whose length, which is saved too, does not feel a bit of z
        w.z = nextafterf(v.z, 1e9f);
        FE_TRUE(fe_body_set_linear_velocity(world, bodies[i], &v) == FE_OK);
        FE_TRUE(fe_body_set_linear_velocity(twin, bodies[i], &w) == FE_OK);
        fe_difference d = difference_of_worlds(world, twin);
        expect(d, "body", "velocity", bodies[i], 2);
        FE_TRUE(strtof(d.a, NULL) == v.z && strtof(d.b, NULL) == w.z && d.other == 0);
        ++changed; // the one before it in the order of creation is named from now on
        FE_TRUE(i - 7 >= 0 || changed == 3);
    }
    free(a.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK && fe_world_destroy(twin) == FE_OK);
}

static void what_is_missing_is_named(void **state)
{
    (void)state;
    fe_world *world = make(&script_joints, 40);
    bytes a = save(world);
    fe_world *twin = load(a, 0);
    fe_body bodies[8], made;
    FE_TRUE(fe_world_get_bodies(world, bodies, 8) >= 8);
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    FE_TRUE(fe_body_create(twin, &def, &made) == FE_OK);
    fe_difference d = difference_of_worlds(world, twin);
    expect(d, "body", "there", made, 0);
    FE_TRUE(strcmp(d.a, "no") == 0 && strcmp(d.b, "yes") == 0);
    fe_world *other = load(a, 1); // what only the second world has goes by the first one's number too
    fe_body as_other;
    FE_TRUE(fe_body_create(other, &def, &as_other) == FE_OK && as_other != made);
    expect(difference_of_worlds(world, other), "body", "there", made, 0);
    FE_TRUE(fe_world_destroy(other) == FE_OK);
    FE_TRUE(fe_body_destroy(twin, bodies[5]) == FE_OK);
    d = difference_of_worlds(world, twin);
    FE_TRUE(strcmp(d.kind, "body") == 0); // one that it touched is another now, or it is gone itself
    free(a.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK && fe_world_destroy(twin) == FE_OK);
}

static void shapes_joints_and_settings_are_named(void **state)
{
    (void)state;
    fe_world *world = make(&script_joints, 40);
    bytes a = save(world);
    fe_world *twin = load(a, 0);
    fe_body bodies[8];
    fe_shape shape = 0;
    FE_TRUE(fe_world_get_bodies(world, bodies, 8) >= 8);
    fe_body with_joint = 0;
    fe_joint joint = 0;
    for (int i = 0; i < 8 && !joint; ++i)
        if (fe_body_get_joints(world, bodies[i], &joint, 1) > 0) with_joint = bodies[i];
    FE_TRUE(with_joint && fe_body_get_shapes(world, with_joint, &shape, 1) > 0);
    FE_TRUE(fe_joint_set_user_data(twin, joint, 77) == FE_OK);
    expect(difference_of_worlds(world, twin), "joint", "user_data", joint, 0);
    FE_TRUE(fe_shape_set_user_data(twin, shape, UINT64_MAX) == FE_OK);
    fe_difference d = difference_of_worlds(world, twin);
    expect(d, "shape", "user_data", shape, 0);
    FE_TRUE(strcmp(d.b, "18446744073709551615") == 0);
    fe_vec3 gravity = {0.0f, -1.5f, 0.0f};
    FE_TRUE(fe_world_set_gravity(twin, &gravity) == FE_OK);
    d = difference_of_worlds(world, twin);
    expect(d, "world", "gravity", 0, 1);
    FE_TRUE(strcmp(d.b, "-1.5") == 0);
    free(a.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK && fe_world_destroy(twin) == FE_OK);
}

// Whatever is in a row counts, but for trees, the last three tables
static void each_table_counts(const script *s, int32_t steps)
{
    enum { FIRST_TREE = FE__TABLE_TREES, TABLES = FE__TABLES, FIRST_EVENT = FE__TABLE_PAIR_EVENTS, STRIDE = 401 };
    fe_world *world = make(s, steps);
    bytes a = save(world), b = {malloc((size_t)a.size), a.size};
    int32_t seen[TABLES] = {0}, table = 0;
    for (int64_t at = HEADER; at < a.size; at += SECTION + (int64_t)take(a.data + at + 8, 8), ++table) {
        int64_t size = (int64_t)take(a.data + at + 8, 8);
        for (int64_t i = ROWS; i < size - 7; i += STRIDE) {
            memcpy(b.data, a.data, (size_t)a.size);
            b.data[at + SECTION + i] ^= 1;
            mend(b);
            int32_t found = fe_snapshot_compare(a.data, a.size, b.data, b.size, NULL);
            // out of its range; or of an event the number in a handle, which is the world's
            if (found == FE_ERROR_DATA || (found == 0 && table >= FIRST_EVENT && table < FIRST_TREE)) continue;
            if (found != (table < FIRST_TREE))
                fail_msg("%s, table %d, byte %d: %d", s->name, (int)table, (int)i, (int)found);
            ++seen[table];
        }
        if (size > 4096 && !seen[table]) fail_msg("%s: nothing of table %d counts", s->name, (int)table);
    }
    free(a.data), free(b.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

static void each_kind_of_record_counts(void **state)
{
    (void)state;
    each_table_counts(&script_brief, 60);
    each_table_counts(&script_brief, 120);
    each_table_counts(&script_compounds, 20);
}

// ---- bytes from anywhere
// ----------------------------------------------------------------------------------------------
static void arguments_are_checked(void **state)
{
    (void)state;
    fe_world *world = make(&script_brief, 30);
    bytes a = save(world);
    fe_difference d;
    fe_difference_init(&d, sizeof d);
    FE_TRUE(fe_snapshot_compare(NULL, 0, a.data, a.size, &d) == FE_ERROR_ARGUMENT);
    FE_TRUE(fe_snapshot_compare(a.data, a.size, NULL, 0, &d) == FE_ERROR_ARGUMENT);
    FE_TRUE(strstr(fe_last_error(), "b is NULL") != NULL);
    FE_TRUE(fe_snapshot_compare(a.data, -1, a.data, a.size, &d) == FE_ERROR_ARGUMENT);
    d.struct_size = 3;
    FE_TRUE(fe_snapshot_compare(a.data, a.size, a.data, a.size, &d) == FE_ERROR_ARGUMENT);
    d.struct_size = sizeof d;
    for (int64_t size = 0; size < a.size; size += 13) {
        unsigned char *cut = malloc((size_t)size + 1); // so that a sanitizer sees a byte too far
        memcpy(cut, a.data, (size_t)size);
        FE_TRUE(fe_snapshot_compare(a.data, a.size, cut, size, &d) == FE_ERROR_DATA);
        FE_TRUE(strstr(fe_last_error(), "b: ") != NULL);
        FE_TRUE(fe_snapshot_compare(cut, size, a.data, a.size, &d) == FE_ERROR_DATA && d.kind[0] == 0);
        free(cut);
    }
    a.data[8] = 9; // the major number
    FE_TRUE(fe_snapshot_compare(a.data, a.size, a.data, a.size, &d) == FE_ERROR_VERSION);
    free(a.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

static void any_numbers_are_compared(const script *s, int32_t steps)
{
    enum { TIMES = 400 };
    fe_world *world = make(s, steps);
    bytes a = save(world), b = {malloc((size_t)a.size), a.size};
    uint32_t seed = 5u + (uint32_t)steps;
    int32_t named = 0;
    memcpy(b.data, a.data, (size_t)a.size);
    for (int32_t i = 0; i < TIMES; ++i) {
        if (i % 8 == 0) memcpy(b.data, a.data, (size_t)a.size); // up to eight changes
        alter(b, &seed);
        mend(b);
        int32_t found = fe_snapshot_compare(a.data, a.size, b.data, b.size, NULL);
        FE_TRUE(found == 0 || found == 1 || found == FE_ERROR_DATA);
        FE_TRUE(fe_snapshot_compare(b.data, b.size, a.data, a.size, NULL) == found);
        named += found == 1;
    }
    FE_TRUE(named > 0);
    free(a.data), free(b.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

static void numbers_that_nobody_saved_are_compared(void **state)
{
    (void)state;
    any_numbers_are_compared(&script_brief, 60);
    any_numbers_are_compared(&script_terrain, 60);
    any_numbers_are_compared(&script_joints, 40);
    any_numbers_are_compared(&script_compounds, 67);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_state_has_no_difference),
        cmocka_unit_test(a_bit_of_a_velocity_is_named),
        cmocka_unit_test(what_is_missing_is_named),
        cmocka_unit_test(shapes_joints_and_settings_are_named),
        cmocka_unit_test(each_kind_of_record_counts),
        cmocka_unit_test(arguments_are_checked),
        cmocka_unit_test(numbers_that_nobody_saved_are_compared),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
