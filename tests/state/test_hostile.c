// test_hostile.c - bytes that nobody saved: cut, flipped, random numbers under right sums. They are refused, and
// nothing changed; or the world lives: it steps, it is saved, and what is read of it is a number.
#include "collision/form/clip.h"
#include "snapshot/format.h"
#include "state/snapshot_bytes.h"
#include "support/play.h"

#include <math.h>

enum { NUMBER = 7 };

// With the contents of its assets, where it may be
static bytes save_whole(const fe_world *world)
{
    bytes b = save_with_assets(world);
    return b.data ? b : save(world);
}

static fe_world *new_world(void)
{
    fe_world_def def;
    fe_world *world;
    fe_world_def_init(&def, sizeof def);
    def.number = NUMBER;
    FE_TRUE(fe_world_create(&def, &world) == FE_OK);
    return world;
}

// ---- the scene: each form, joints, trees, sleep, events, what is free and what is ignored ---------------------------
static fe_world *make_scene(const script *s, int32_t steps)
{
    static play p;
    fe_world *world = new_world();
    play_begin(&p, world);
    play_until(&p, s, steps);
    return world;
}

static void read_all(const fe_world *world)
{
    uint32_t words[2];
    fe_contact contacts[64];
    fe_pair_event pairs[64];
    fe_body bodies[64];
    FE_TRUE(fe_world_hash(world, words) == FE_OK);
    (void)fe_world_get_pair_events(world, pairs, sizeof *pairs, 64);
    int32_t count = fe_world_get_bodies(world, bodies, 64);
    for (int32_t i = 0; i < (count < 64 ? count : 64); ++i) {
        fe_transform transform;
        FE_TRUE(fe_body_get_transform(world, bodies[i], &transform) == FE_OK);
        (void)fe_body_get_contacts(world, bodies[i], contacts, sizeof *contacts, 64);
    }
}

// It is destroyed at last, body by body
static void live(fe_world *world)
{
    enum { STEPS = 10 };
    for (int32_t i = 0; i < STEPS; ++i) {
        FE_TRUE(fe_world_step(world, i == 4 ? 0.0f : 1.0f / 60.0f) == FE_OK);
        read_all(world);
    }
    bytes again = save(world);
    FE_TRUE(fe_snapshot_check(again.data, again.size, NULL) == FE_OK || fe_last_error() != NULL);
    free(again.data);
    fe_body bodies[256];
    for (int32_t count = fe_world_get_bodies(world, bodies, 256); count > 0;
         count = fe_world_get_bodies(world, bodies, 256))
        for (int32_t i = 0; i < (count < 256 ? count : 256); ++i)
            if (fe_body_is_valid(world, bodies[i])) FE_TRUE(fe_body_destroy(world, bodies[i]) == FE_OK);
    FE_TRUE(fe_world_step(world, 1.0f / 60.0f) == FE_OK);
}

// ---- laws -----------------------------------------------------------------------------------------------------------
static void bytes_that_are_cut_are_refused_and_change_nothing(void **state)
{
    (void)state;
    fe_world *world = make_scene(&script_brief, 40);
    bytes whole = save(world);
    for (int64_t size = 0; size < whole.size; ++size) {
        unsigned char *cut = malloc((size_t)size + 1); // so that a sanitizer sees a byte too far
        memcpy(cut, whole.data, (size_t)size);
        fe_result result = fe_world_restore(world, NULL, cut, size);
        free(cut);
        if (result != FE_ERROR_DATA) fail_msg("cut at %lld: %d", (long long)size, (int)result);
    }
    bytes after = save(world);
    FE_TRUE(after.size == whole.size && memcmp(after.data, whole.data, (size_t)whole.size) == 0);
    free(whole.data);
    free(after.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

static fe_result restore_with_bit(fe_world *world, bytes b, int64_t byte, int32_t bit)
{
    b.data[byte] ^= (unsigned char)(1 << bit);
    fe_result result = fe_world_restore(world, NULL, b.data, b.size);
    b.data[byte] ^= (unsigned char)(1 << bit);
    return result;
}

// The number of the world is in no sum: worlds differ in it alone.
static void each_bit_of_the_headers_counts(void **state)
{
    (void)state;
    fe_world *world = make_scene(&script_brief, 40);
    bytes b = save(world);
    for (int32_t i = 0; i < 8 * HEADER; ++i) {
        if (i / 8 >= AT_NUMBER && i / 8 < AT_NUMBER + 4) continue;
        if (restore_with_bit(world, b, i / 8, i % 8) >= 0) fail_msg("bit %d of the header tells nothing", (int)i);
    }
    for (int64_t at = HEADER; at < b.size; at += SECTION + (int64_t)take(b.data + at + 8, 8))
        for (int32_t i = 0; i < 8 * SECTION; ++i)
            if (restore_with_bit(world, b, at + i / 8, i % 8) >= 0)
                fail_msg("bit %d of the section at %lld tells nothing", (int)i, (long long)at);
    free(b.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// A later minor version may write sections that this one does not know, behind those that it does
static fe_result restore_with_section(fe_world *world, bytes b, uint32_t type, uint32_t flags)
{
    enum { CONTENT = 16, MAY_SKIP_SHIFT = 16 };
    bytes more = {calloc(1, (size_t)b.size + SECTION + CONTENT), b.size + SECTION + CONTENT};
    memcpy(more.data, b.data, (size_t)b.size);
    unsigned char *section = more.data + b.size;
    put(section, (uint64_t)type | (uint64_t)(1 | flags << MAY_SKIP_SHIFT) << 32);
    put(section + 8, CONTENT);
    put(section + SECTION, UINT64_C(0x123456789abcdef0));
    put(more.data + AT_SIZE, (uint64_t)more.size);
    put(more.data + AT_SECTIONS, take(b.data + AT_SECTIONS, 8) + 1);
    mend(more);
    fe_result result = fe_world_restore(world, NULL, more.data, more.size);
    free(more.data);
    return result;
}

static void only_what_says_so_is_skipped(void **state)
{
    (void)state;
    enum { UNKNOWN = 4999 };
    fe_world *world = make_scene(&script_brief, 40);
    bytes before = save(world);
    assert_int_equal(restore_with_section(world, before, UNKNOWN, 0), FE_ERROR_DATA);
    FE_TRUE(strstr(fe_last_error(), "section 4999 is unknown") != NULL);
    assert_int_equal(restore_with_section(world, before, UNKNOWN, 1), FE_OK);
    bytes after = save(world);
    FE_TRUE(after.size == before.size && memcmp(after.data, before.data, (size_t)after.size) == 0);
    free(before.data);
    free(after.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// It is not counted among the assets, so nobody has room for it
static void an_asset_that_may_be_skipped_is_skipped(void **state)
{
    (void)state;
    fe_world *world = make_scene(&script_solids, 30);
    bytes before = save_whole(world);
    FE_TRUE(take(before.data + AT_SECTIONS, 4) > FE__TABLES);
    assert_int_equal(restore_with_section(world, before, FE__SECTION_ASSET, 1), FE_OK);
    free(before.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// ---- numbers that agree with each other, and with nothing else
// --------------------------------------------------------
static unsigned char *row_of(bytes b, fe__table_number table, int32_t row)
{
    return b.data + section_at(b, (int32_t)table) + SECTION + ROWS + (int64_t)row * fe__tables[table].row_size;
}

static void expect_refused(fe_world *world, bytes b, const char *sentence)
{
    mend(b);
    assert_int_equal(fe_world_restore(world, NULL, b.data, b.size), FE_ERROR_DATA);
    if (!strstr(fe_last_error(), sentence)) fail_msg("%s", fe_last_error());
    assert_int_equal(fe_snapshot_check(b.data, b.size, NULL), FE_ERROR_DATA);
    free(b.data);
}

// A body that has it, a tetrahedron
static void add_hull(fe_world *world, float width)
{
    const float points[4][3] = {{0, 0, 0}, {width, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    fe_hull_def def;
    fe_body_def at;
    fe_geometry geometry;
    fe_store *store;
    fe_body body;
    fe_shape shape;
    fe_hull_def_init(&def, sizeof def);
    def.points = points[0], def.point_count = 4;
    fe_geometry_init(&geometry, sizeof geometry);
    geometry.type = FE_GEOMETRY_HULL;
    fe_body_def_init(&at, sizeof at);
    at.transform.position.x = 10.0 * (double)width;
    FE_TRUE(fe_world_get_store(world, &store) == FE_OK);
    FE_TRUE(fe_hull_create(store, &def, &geometry.asset) == FE_OK);
    FE_TRUE(fe_body_create(world, &at, &body) == FE_OK);
    FE_TRUE(fe_shape_create(world, body, NULL, &geometry, &shape) == FE_OK);
}

// Two rows of assets that begin with one shape would leave another without its hull, though as many users are counted
// as there are; two of one asset would make a list of users that goes round
static void each_shape_gets_its_asset_once(void **state)
{
    (void)state;
    enum { KEY = 16, AT_SHAPE = 28 };
    fe_world *world = new_world();
    add_hull(world, 1.0f), add_hull(world, 2.0f);
    for (int32_t same_key = 0; same_key < 2; ++same_key) {
        bytes b = save_whole(world);
        const unsigned char *first = row_of(b, FE__TABLE_ASSETS, 0);
        unsigned char *second = row_of(b, FE__TABLE_ASSETS, 1);
        assert_int_equal(take(first - ROWS, 8), 2);
        memcpy(second + AT_SHAPE, first + AT_SHAPE, sizeof(int32_t));
        if (same_key) memcpy(second, first, KEY);
        expect_refused(world, b, "assets: ");
    }
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// Faster than a step leaves any body, it would be nowhere within the next
static void a_speed_beyond_all_bounds_is_refused(void **state)
{
    (void)state;
    enum { AT_VELOCITY = 36, AT_SPIN = 52 };
    const float least_refused = 1.0001e7f;
    fe_world *world = make_scene(&script_brief, 40);
    for (int32_t at = AT_VELOCITY; at <= AT_SPIN; at += AT_SPIN - AT_VELOCITY) {
        for (int32_t k = 0; k < 6; ++k) {
            bytes b = save(world);
            float speed = k < 3 ? least_refused : -3e36f;
            memcpy(row_of(b, FE__TABLE_BODIES, 1) + at + 4 * (k % 3), &speed, sizeof speed);
            expect_refused(world, b, at == AT_SPIN ? "spin is " : "velocity is ");
        }
    }
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

enum { AT_NODES = 0, AT_CAPACITY = 4, AT_DEAD = 8, AT_PROMISED = 16 }; // in a tree's row

// Nodes behind the others, with a parent and eight shapes each, which are counted as dead: building anew would take
// their shapes, for which there is no room
static void nodes_that_nobody_meets_are_refused(void **state)
{
    (void)state;
    const fe__table_number last = FE__TABLE_MOVING_NODES;
    enum { MORE = 3, CAPACITY = 64, LANES = 8, AT_CHILD = 192, AT_PARENT = 224 };
    FE_TRUE(last == FE__TABLES - 1 && fe__tables[last].row_size == AT_PARENT + 8);
    fe_world *world = make_scene(&script_brief, 40);
    bytes b = save(world), more = {calloc(1, (size_t)(b.size + MORE * (AT_PARENT + 8))), b.size};
    memcpy(more.data, b.data, (size_t)b.size);
    int64_t section = section_at(b, (int32_t)last), nodes = (int64_t)take(b.data + section + SECTION, 8);
    for (int32_t i = 0; i < MORE; ++i, more.size += AT_PARENT + 8) {
        unsigned char *node = more.data + more.size;
        memcpy(node, row_of(b, last, 0), AT_PARENT + 8);
        for (int32_t k = 0; k < LANES; ++k) put_u32(node + AT_CHILD + 4 * k, UINT32_MAX); // shape 0
        put_u32(node + AT_PARENT, 0);
    }
    put(more.data + section + 8, (uint64_t)(more.size - section - SECTION));
    put(more.data + section + SECTION, (uint64_t)(nodes + MORE));
    unsigned char *tree = row_of(more, FE__TABLE_TREES, 1);
    put_u32(tree + AT_NODES, (uint32_t)(nodes + MORE));
    put_u32(tree + AT_DEAD, (uint32_t)take(tree + AT_DEAD, 4) + MORE);
    put_u32(tree + AT_CAPACITY, CAPACITY);
    put(more.data + AT_SIZE, (uint64_t)more.size);
    free(b.data);
    expect_refused(world, more, "does not hang together");
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// A few bytes may not ask for a gigabyte
static void a_tree_has_no_room_for_millions(void **state)
{
    (void)state;
    enum { PROMISED = (1 << 21) - 1, FREE_NODES = 4096 };
    fe_world *world = make_scene(&script_brief, 40);
    bytes b = save(world);
    unsigned char *tree = row_of(b, FE__TABLE_TREES, 0);
    put_u32(tree + AT_PROMISED, PROMISED);
    put_u32(tree + AT_CAPACITY, (uint32_t)take(tree + AT_NODES, 4) + PROMISED + FREE_NODES);
    expect_refused(world, b, "promised");
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// ---- floats of any size ---------------------------------------------------------------------------------------------
// A table that has rows in the snapshot, and one of its fields that is a float or a double
static const fe__field *pick_number(bytes b, uint32_t *seed, fe__table_number *out_table)
{
    for (;;) {
        static const fe__table_number often[] = {FE__TABLE_BODIES, FE__TABLE_POINTS, FE__TABLE_FOUND,
                                                 FE__TABLE_JOINT_ANCHORS}; // what the solver multiplies
        const fe__table_number table =
            draw(seed) % 2 ? often[draw(seed) % 4] : (fe__table_number)(draw(seed) % FE__TABLES);
        const fe__field *field = fe__tables[table].fields + draw(seed) % (uint32_t)fe__tables[table].field_count;
        if (field->kind != FE__F32 && field->kind != FE__F64) continue;
        if (take(b.data + section_at(b, (int32_t)table) + SECTION, 8) == 0) continue;
        *out_table = table;
        return field;
    }
}

// Where the field stands in a row: behind all fields before it
static int64_t place_in_row(fe__table_number table, const fe__field *field)
{
    int64_t at = 0;
    for (const fe__field *f = fe__tables[table].fields; f < field; ++f) at += fe__field_size(f);
    return at;
}

// Every order of magnitude is as likely, those of denormals and zero too
static double any_number(uint32_t *seed, int32_t least, int32_t most)
{
    double x =
        ldexp(1.0 + (double)(draw(seed) % 4096) / 4096.0, least + (int32_t)(draw(seed) % (uint32_t)(most - least)));
    return draw(seed) % 32 == 0 ? 0.0 : draw(seed) % 2 ? x : -x;
}

static void alter_number(bytes b, uint32_t *seed, char *told, size_t room)
{
    fe__table_number table;
    const fe__field *field = pick_number(b, seed, &table);
    uint64_t rows = take(b.data + section_at(b, (int32_t)table) + SECTION, 8);
    int32_t row = (int32_t)(draw(seed) % rows), element = (int32_t)(draw(seed) % field->count);
    unsigned char *at =
        row_of(b, table, row) + place_in_row(table, field) + element * (int32_t)fe__kind_size(field->kind);
    if (field->kind == FE__F64) {
        double x = any_number(seed, -300, 300);
        memcpy(at, &x, sizeof x);
        snprintf(told, room, "%s %d: %s[%d] = %g", fe__tables[table].name, (int)row, field->name, (int)element, x);
        return;
    }
    float x = (float)any_number(seed, -149, 127);
    memcpy(at, &x, sizeof x);
    snprintf(told, room, "%s %d: %s[%d] = %g", fe__tables[table].name, (int)row, field->name, (int)element, (double)x);
}

static int32_t are_finite(const float *numbers, int32_t count)
{
    for (int32_t i = 0; i < count; ++i)
        if (!isfinite(numbers[i])) return 0;
    return 1;
}

// What a caller reads of a world: the sentence of what is no number, or NULL
static const char *no_number_in(const fe_world *world)
{
    enum { MOST = 256 };
    fe_body bodies[MOST];
    fe_joint joints[MOST];
    fe_contact contacts[16];
    int32_t count = fe_world_get_bodies(world, bodies, MOST);
    for (int32_t i = 0; i < count && i < MOST; ++i) {
        fe_vec3 v = body_linear_velocity(world, bodies[i]), w = body_angular_velocity(world, bodies[i]);
        fe_transform t = body_transform(world, bodies[i]);
        if (!are_finite(&v.x, 3) || !are_finite(&w.x, 3) || !are_finite(&t.rotation.x, 4)) return "a body's motion";
        if (!isfinite(t.position.x) || !isfinite(t.position.y) || !isfinite(t.position.z)) return "a body's place";
        int32_t touching = fe_body_get_contacts(world, bodies[i], contacts, sizeof *contacts, 16);
        for (int32_t k = 0; k < touching && k < 16; ++k)
            if (!are_finite(&contacts[k].normal.x, 3) || !are_finite(&contacts[k].friction_impulse.x, 3))
                return "a contact";
    }
    count = fe_world_get_joints(world, joints, MOST);
    for (int32_t i = 0; i < count && i < MOST; ++i) {
        fe_vec3 force, torque;
        FE_TRUE(fe_joint_get_reaction(world, joints[i], &force, &torque) == FE_OK);
        if (!are_finite(&force.x, 3) || !are_finite(&torque.x, 3)) return "a joint's reaction";
    }
    return NULL;
}

// The solver multiplies by a body's inverse mass and by quotients of its mass and its moments: they follow from each
// other, or are none that a body has. Of a body with a mass all numbers but its own are refused
static void an_inverse_mass_is_that_of_the_mass(void **state)
{
    (void)state;
    enum { DRAWS = 200 };
    fe_world *world = make_scene(&script_joints, 40);
    bytes whole = save(world);
    uint32_t seed = 20261128;
    const fe__field *fields = fe__tables[FE__TABLE_BODIES].fields, *inverse = fields, *mass = fields;
    while (strcmp(inverse->name, "inverse_mass") != 0) ++inverse;
    while (strcmp(mass->name, "mass") != 0) ++mass;
    int32_t rows = (int32_t)take(whole.data + section_at(whole, FE__TABLE_BODIES) + SECTION, 8);
    for (int32_t i = 0; i < DRAWS; ++i) {
        bytes b = {malloc((size_t)whole.size), whole.size};
        memcpy(b.data, whole.data, (size_t)whole.size);
        float old, x = (float)any_number(&seed, -149, 127);
        const fe__field *field = i % 2 ? inverse : mass;
        unsigned char *row = row_of(b, FE__TABLE_BODIES, (int32_t)(draw(&seed) % (uint32_t)rows));
        memcpy(&old, row + place_in_row(FE__TABLE_BODIES, inverse), sizeof old);
        memcpy(row + place_in_row(FE__TABLE_BODIES, field), &x, sizeof x);
        mend(b);
        if (old > 0.0f && fe_world_restore(world, NULL, b.data, b.size) != FE_ERROR_DATA)
            fail_msg("body with the inverse mass %g: its %s may be %g", (double)old, field->name, (double)x);
        free(b.data);
    }
    free(whole.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// What a choice left out of a pair's faces is one of four; wider numbers than its byte holds count as they are. Any of
// the four is taken for any pair: it says only whether the points are looked at again
static void what_is_left_out_is_one_of_four(void **state)
{
    (void)state;
    static const int32_t numbers[] = {-1, FE_LEFT_REST + 1, 256, 256 + FE_LEFT_SOME, INT32_MIN};
    fe_world *world = make_scene(&script_solids, 120);
    bytes whole = save_whole(world);
    const fe__field *field = fe__tables[FE__TABLE_TOUCHING].fields;
    while (strcmp(field->name, "left_out") != 0) ++field;
    int64_t place = place_in_row(FE__TABLE_TOUCHING, field);
    int32_t rows = (int32_t)take(whole.data + section_at(whole, FE__TABLE_TOUCHING) + SECTION, 8), leaves_out = 0;
    for (int32_t row = 0; row < rows; ++row) {
        leaves_out += take(row_of(whole, FE__TABLE_TOUCHING, row) + place, 4) != FE_LEFT_NONE;
        for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) {
            bytes b = {malloc((size_t)whole.size), whole.size};
            memcpy(b.data, whole.data, (size_t)whole.size);
            put_u32(row_of(b, FE__TABLE_TOUCHING, row) + place, (uint32_t)numbers[k]);
            expect_refused(world, b, "left_out is ");
        }
    }
    FE_TRUE(leaves_out > 0);
    for (uint32_t left_out = FE_LEFT_NONE; left_out <= FE_LEFT_REST; ++left_out) {
        bytes b = {malloc((size_t)whole.size), whole.size};
        memcpy(b.data, whole.data, (size_t)whole.size);
        for (int32_t row = 0; row < rows; ++row) put_u32(row_of(b, FE__TABLE_TOUCHING, row) + place, left_out);
        mend(b);
        FE_TRUE(fe_world_restore(world, NULL, b.data, b.size) == FE_OK);
        free(b.data);
        live(world);
    }
    free(whole.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

// A number of any size in one place is refused, or the world steps, and all that is read of it and all that it saves
// are numbers that it takes itself
static void a_number_of_any_size_is_refused_or_sound(const script *s, int32_t steps, int32_t count, uint32_t *seed)
{
    fe_world *world = make_scene(s, steps);
    bytes whole = save(world), back = save_whole(world), b = {malloc((size_t)whole.size), whole.size};
    int32_t accepted = 0, broken = 0;
    for (int32_t i = 0; i < count; ++i) {
        char told[160];
        const char *wrong = NULL;
        memcpy(b.data, whole.data, (size_t)whole.size);
        alter_number(b, seed, told, sizeof told);
        mend(b);
        if (fe_world_restore(world, NULL, b.data, b.size) < 0) continue;
        accepted += 1;
        for (int32_t k = 0; k < 3 && !wrong; ++k) {
            FE_TRUE(fe_world_step(world, k == 1 ? 0.0f : 1.0f / 60.0f) == FE_OK);
            wrong = no_number_in(world);
        }
        bytes again = save(world);
        fe_result checked = fe_snapshot_check(again.data, again.size, NULL);
        free(again.data);
        if (wrong || checked != FE_OK) {
            if (broken++ < 20) print_error("%s: %s: %s\n", s->name, told, wrong ? wrong : fe_last_error());
        }
        FE_TRUE(fe_world_restore(world, NULL, back.data, back.size) == FE_OK);
    }
    print_message("%s: %d of %d accepted, %d of them not sound\n", s->name, (int)accepted, (int)count, (int)broken);
    free(back.data), free(b.data), free(whole.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
    assert_int_equal(broken, 0);
}

static void random_numbers_are_refused_or_live_in(const script *s, int32_t steps, int32_t rounds)
{
    fe_world *world = make_scene(s, steps);
    bytes whole = save(world), back = save_whole(world), b = {malloc((size_t)whole.size), whole.size};
    int32_t accepted = 0;
    uint32_t seed = 12345u + (uint32_t)steps;
    const char *tells = getenv("FE_STATE_TELL");
    for (int32_t i = 0; i < rounds; ++i) {
        memcpy(b.data, whole.data, (size_t)whole.size);
        for (uint32_t changes = 1 + draw(&seed) % 3; changes > 0; --changes) alter(b, &seed);
        mend(b);
        if (tells) printf("%s %d\n", s->name, (int)i), fflush(stdout);
        fe_result result = fe_world_restore(world, NULL, b.data, b.size);
        if (result >= 0) ++accepted, live(world);
        if (fe_world_restore(world, NULL, back.data, back.size) != FE_OK) fail_msg("%s", fe_last_error());
    }
    free(back.data);
    FE_TRUE(accepted > 0 && accepted < rounds);
    free(b.data);
    free(whole.data);
    FE_TRUE(fe_world_destroy(world) == FE_OK);
}

#if defined(FE_SANITIZED)
enum { ROUNDS = 50 };
#else
enum { ROUNDS = 150 };
#endif

static int32_t rounds(void)
{
    const char *long_run = getenv("FE_STATE_ROUNDS");
    return long_run ? atoi(long_run) : ROUNDS;
}

static void numbers_of_any_size_are_refused_or_sound(void **state)
{
    (void)state;
    static const struct {
        const script *script;
        int32_t steps;
    } cases[] = {{&script_brief, 60},  {&script_joints, 40}, {&script_terrain, 60},   {&script_solids, 60},
                 {&script_meshes, 60}, {&script_scales, 90}, {&script_compounds, 67}, {&script_fast, 30}};
    const char *given = getenv("FE_STATE_SEED");
    uint32_t seed = given ? (uint32_t)strtoul(given, NULL, 0) : 20261128u;
    print_message("seed %u\n", (unsigned)seed);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
        a_number_of_any_size_is_refused_or_sound(cases[i].script, cases[i].steps, 2 * rounds(), &seed);
}

#define CASE(name, steps)                                                       \
    static void name##_under_random_numbers(void **state)                       \
    {                                                                           \
        (void)state;                                                            \
        random_numbers_are_refused_or_live_in(&script_##name, steps, rounds()); \
    }
CASE(brief, 60)
CASE(crowd, 45)
CASE(terrain, 60)
CASE(joints, 40)
CASE(solids, 60)
CASE(meshes, 60)
CASE(scales, 90)
CASE(compounds, 67)
CASE(fast, 30)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bytes_that_are_cut_are_refused_and_change_nothing),
        cmocka_unit_test(each_bit_of_the_headers_counts),
        cmocka_unit_test(only_what_says_so_is_skipped),
        cmocka_unit_test(an_asset_that_may_be_skipped_is_skipped),
        cmocka_unit_test(each_shape_gets_its_asset_once),
        cmocka_unit_test(a_speed_beyond_all_bounds_is_refused),
        cmocka_unit_test(nodes_that_nobody_meets_are_refused),
        cmocka_unit_test(a_tree_has_no_room_for_millions),
        cmocka_unit_test(an_inverse_mass_is_that_of_the_mass),
        cmocka_unit_test(what_is_left_out_is_one_of_four),
        cmocka_unit_test(numbers_of_any_size_are_refused_or_sound),
        cmocka_unit_test(brief_under_random_numbers),
        cmocka_unit_test(crowd_under_random_numbers),
        cmocka_unit_test(terrain_under_random_numbers),
        cmocka_unit_test(joints_under_random_numbers),
        cmocka_unit_test(solids_under_random_numbers),
        cmocka_unit_test(meshes_under_random_numbers),
        cmocka_unit_test(scales_under_random_numbers),
        cmocka_unit_test(compounds_under_random_numbers),
        cmocka_unit_test(fast_under_random_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
