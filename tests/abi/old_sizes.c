// Every struct of version 1.0 as an older and as a newer client has it: cut after each of its fields it runs or is
// refused by a sentence, cut inside a field it is refused, longer by zeros it runs, longer by anything else it is
// refused. Nothing is written behind the caller's size. The fields come from tests/abi/record, so that none is
// forgotten.
#include "feather_1_0.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CANARY = 0xA5, LONGER = 64, MOST_BYTES = 1024 };

#define CHECK(condition, ...)                              \
    do {                                                   \
        if (!(condition)) {                                \
            printf("line %d: %s; ", __LINE__, #condition); \
            printf(__VA_ARGS__);                           \
            printf("; last error: %s\n", fe_last_error()); \
            exit(1);                                       \
        }                                                  \
    } while (0)
#define MUST(call) CHECK((call) >= 0, "a call of the scene")

// ---- the structs, as recorded --------------------------------------------------------------------------------------
typedef struct field {
    const char *type, *name; // name NULL: the struct itself
    uint32_t at, end;
} field;

#define FE_SIZE(type, bytes) {#type, NULL, 0, sizeof(type)},
#define FE_OFFSET(type, name, bytes) {#type, #name, bytes, bytes + sizeof(((type *)0)->name)},
#define FE_VALUE(name, value)
static const field fields[] = {
#include "layout_1_0.h"
};
enum { FIELDS = sizeof fields / sizeof *fields };

static int ends_a_field(const char *type, uint32_t size)
{
    for (int i = 0; i < FIELDS; ++i)
        if (fields[i].name && fields[i].end == size && strcmp(fields[i].type, type) == 0) return 1;
    return 0;
}

// Where today's header may have fields: nobody's struct ended there
static int is_reserved_room(const char *type, uint32_t size)
{
    for (int i = 0; i < FIELDS; ++i)
        if (fields[i].name && fields[i].at < size && size < fields[i].end && strcmp(fields[i].type, type) == 0)
            return strncmp(fields[i].name, "reserved", 8) == 0;
    return 0;
}

// ---- a world to use them in ----------------------------------------------------------------------------------------
static fe_world *world;
static fe_body ground, ball, arm;
static fe_shape ground_shape, ball_shape;
static fe_joint joints[6]; // by fe_joint_type
static float heights[4];

static void make_scene(void)
{
    static const fe_dvec3 at = {0.0, 5.0, 0.0};
    static const fe_vec3 axis = {1.0f, 0.0f, 0.0f};
    fe_body_def body;
    fe_geometry box, sphere;
    fe_shape_def shape;
    MUST(fe_world_create(NULL, &world));
    fe_body_def_init(&body, sizeof body);
    body.transform = fe_make_transform(0.0, 0.5, 0.0);
    MUST(fe_body_create(world, &body, &ball));
    body.transform = fe_make_transform(0.0, 5.0, 0.0);
    MUST(fe_body_create(world, &body, &arm));
    body.type = FE_BODY_STATIC;
    body.transform = fe_make_transform(0.0, -1.0, 0.0);
    MUST(fe_body_create(world, &body, &ground));
    fe_shape_def_init(&shape, sizeof shape);
    fe_geometry_sphere(&sphere, 0.5f);
    fe_geometry_box(&box, 10.0f, 1.0f, 10.0f);
    MUST(fe_shape_create(world, ball, &shape, &sphere, &ball_shape));
    MUST(fe_shape_create(world, ground, &shape, &box, &ground_shape));
    fe_distance_joint_def rod;
    fe_ball_joint_def socket;
    fe_hinge_joint_def hinge;
    fe_fixed_joint_def weld;
    fe_configurable_joint_def six;
    fe_distance_joint_def_init(&rod, sizeof rod);
    fe_ball_joint_def_init(&socket, sizeof socket);
    fe_hinge_joint_def_init(&hinge, sizeof hinge);
    fe_fixed_joint_def_init(&weld, sizeof weld);
    fe_configurable_joint_def_init(&six, sizeof six);
    MUST(fe_distance_joint_def_at(world, &rod, ground, arm, &at, &(fe_dvec3){1.0, 5.0, 0.0}));
    MUST(fe_ball_joint_def_at(world, &socket, ground, arm, &at, &axis));
    MUST(fe_hinge_joint_def_at(world, &hinge, ground, arm, &at, &axis));
    MUST(fe_fixed_joint_def_at(world, &weld, ground, arm, &at));
    MUST(fe_configurable_joint_def_at(world, &six, ground, arm, &at, &axis));
    MUST(fe_distance_joint_create(world, &rod, &joints[FE_JOINT_DISTANCE]));
    MUST(fe_ball_joint_create(world, &socket, &joints[FE_JOINT_BALL]));
    MUST(fe_hinge_joint_create(world, &hinge, &joints[FE_JOINT_HINGE]));
    MUST(fe_fixed_joint_create(world, &weld, &joints[FE_JOINT_FIXED]));
    MUST(fe_configurable_joint_create(world, &six, &joints[FE_JOINT_CONFIGURABLE]));
    for (int i = 0; i < 30; ++i) MUST(fe_world_step(world, 1.0f / 60.0f));
}

// ---- each struct in use --------------------------------------------------------------------------------------------
static void *allocate(void *user, uint64_t size, uint64_t alignment)
{
    (void)user;
    return aligned_alloc((size_t)alignment, (size_t)((size + alignment - 1) / alignment * alignment));
}

static void release(void *user, void *memory, uint64_t size)
{
    (void)user, (void)size;
    free(memory);
}

static void run_tasks(void *user, fe_task task, void *argument, int32_t count)
{
    (void)user;
    for (int32_t i = 0; i < count; ++i) task(argument, i);
}

static int32_t make_world(const fe_world_def *def)
{
    fe_world *made;
    const int32_t result = fe_world_create(def, &made);
    if (result == FE_OK) MUST(fe_world_destroy(made));
    return result;
}

static void fill_allocator(void *s)
{
    fe_allocator *a = s;
    a->allocate = allocate, a->release = release;
}
static int32_t use_allocator(void *s)
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.allocator = s;
    return make_world(&def);
}
static void fill_tasks(void *s)
{
    fe_task_system *t = s;
    t->worker_count = 2, t->run = run_tasks;
}
static int32_t use_tasks(void *s)
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.tasks = s;
    return make_world(&def);
}
static int32_t use_world(void *s) { return make_world(s); }
static int32_t use_store(void *s)
{
    fe_store *made;
    const int32_t result = fe_store_create(s, &made);
    if (result == FE_OK) MUST(fe_store_destroy(made));
    return result;
}
static void fill_field(void *s)
{
    fe_heightfield_def *d = s;
    d->rows = d->columns = 2, d->cell_x = d->cell_z = 1.0f, d->heights = heights;
}
static int32_t use_field(void *s)
{
    fe_store *store;
    fe_asset made;
    MUST(fe_world_get_store(world, &store));
    const int32_t result = fe_heightfield_create(store, s, &made);
    if (result == FE_OK) MUST(fe_asset_destroy(store, made));
    return result;
}
static int32_t use_body(void *s)
{
    fe_body made;
    const int32_t result = fe_body_create(world, s, &made);
    if (result == FE_OK) MUST(fe_body_destroy(world, made));
    return result;
}
static int32_t use_shape(void *s)
{
    fe_shape made;
    fe_geometry sphere;
    fe_geometry_sphere(&sphere, 0.5f);
    const int32_t result = fe_shape_create(world, arm, s, &sphere, &made);
    if (result == FE_OK) MUST(fe_shape_destroy(world, made));
    return result;
}
static void fill_geometry(void *s) { fe_geometry_sphere(s, 0.5f); }
static int32_t use_geometry(void *s)
{
    static const fe_transform at = {{0.0, 50.0, 0.0}, {0.0f, 0.0f, 0.0f, 1.0f}};
    fe_shape made;
    const int32_t result = fe_shape_create(world, arm, NULL, s, &made);
    if (result == FE_OK) MUST(fe_shape_destroy(world, made));
    const int32_t overlap = fe_world_overlap(world, s, &at, NULL, NULL, 0);
    CHECK(result < 0 || overlap >= 0, "what makes a shape can be asked with");
    return result;
}
static int32_t get_geometry(void *s) { return fe_shape_get_geometry(world, ball_shape, s); }
static int32_t use_tuning(void *s) { return fe_world_set_tuning(world, s); }
static int32_t get_tuning(void *s) { return fe_world_get_tuning(world, s); }
static void fill_mass(void *s)
{
    fe_mass_data *m = s;
    m->mass = 1.0f, m->inertia.x = m->inertia.y = m->inertia.z = 1.0f, m->inertia_rotation.w = 1.0f;
}
static int32_t use_mass(void *s) { return fe_body_set_mass_data(world, ball, s); }
static int32_t get_mass(void *s) { return fe_body_get_mass_data(world, ball, s); }
static int32_t get_profile(void *s) { return fe_world_get_profile(world, s); }
static int32_t get_counters(void *s) { return fe_world_get_counters(world, s); }
static int32_t get_energy(void *s) { return fe_world_get_energy(world, s); }
static int32_t use_filter(void *s)
{
    static const fe_dvec3 from = {0.0, 9.0, 0.0}, down = {0.0, -20.0, 0.0};
    fe_hit hit;
    return fe_world_raycast(world, &from, &down, s, &hit);
}
static int32_t get_state(void *s) { return fe_joint_get_state(world, joints[FE_JOINT_HINGE], s); }
static int32_t use_joint(void *s) { return fe_joint_set(world, joints[FE_JOINT_HINGE], s); }
static int32_t get_joint(void *s) { return fe_joint_get(world, joints[FE_JOINT_HINGE], s); }

// A joint's definition is read by _create and by _set, and written by _get
#define JOINT(type, number)                                                  \
    static void fill_##type(void *s)                                         \
    {                                                                        \
        fe_##type##_joint_def *d = s;                                        \
        d->body_a = ground, d->body_b = arm;                                 \
    }                                                                        \
    static int32_t use_##type(void *s)                                       \
    {                                                                        \
        fe_joint made;                                                       \
        const int32_t result = fe_##type##_joint_create(world, s, &made);    \
        if (result == FE_OK) MUST(fe_joint_destroy(world, made));            \
        const int32_t set = fe_##type##_joint_set(world, joints[number], s); \
        CHECK(result < 0 || set >= 0, "what makes a joint changes one");     \
        return result;                                                       \
    }                                                                        \
    static int32_t get_##type(void *s) { return fe_##type##_joint_get(world, joints[number], s); }
JOINT(distance, FE_JOINT_DISTANCE)
JOINT(ball, FE_JOINT_BALL)
JOINT(hinge, FE_JOINT_HINGE)
JOINT(fixed, FE_JOINT_FIXED)
JOINT(configurable, FE_JOINT_CONFIGURABLE)

typedef struct sized {
    const char *type;
    uint32_t size;
    void (*init)(void *s, uint32_t size);
    void (*fill)(void *s);    // NULL: its defaults will do
    int32_t (*read)(void *s); // by the library; NULL: it only writes
    int32_t (*write)(void *s);
} sized;

#define INIT(type) \
    static void init_##type(void *s, uint32_t size) { type##_init(s, size); }
#define SIZED(type, fill, read, write)                      \
    {                                                       \
#type, sizeof(type), init_##type, fill, read, write \
    }
INIT(fe_allocator)
INIT(fe_store_def)
INIT(fe_heightfield_def)
INIT(fe_task_system)
INIT(fe_world_def)
INIT(fe_world_tuning)
INIT(fe_profile)
INIT(fe_counters)
INIT(fe_energy)
INIT(fe_body_def)
INIT(fe_mass_data)
INIT(fe_geometry)
INIT(fe_shape_def)
INIT(fe_joint_def)
INIT(fe_distance_joint_def)
INIT(fe_ball_joint_def)
INIT(fe_hinge_joint_def)
INIT(fe_fixed_joint_def)
INIT(fe_configurable_joint_def)
INIT(fe_joint_state)
INIT(fe_query_filter)
static const sized structs[] = {
    SIZED(fe_allocator, fill_allocator, use_allocator, NULL),
    SIZED(fe_store_def, NULL, use_store, NULL),
    SIZED(fe_heightfield_def, fill_field, use_field, NULL),
    SIZED(fe_task_system, fill_tasks, use_tasks, NULL),
    SIZED(fe_world_def, NULL, use_world, NULL),
    SIZED(fe_world_tuning, NULL, use_tuning, get_tuning),
    SIZED(fe_profile, NULL, NULL, get_profile),
    SIZED(fe_counters, NULL, NULL, get_counters),
    SIZED(fe_energy, NULL, NULL, get_energy),
    SIZED(fe_body_def, NULL, use_body, NULL),
    SIZED(fe_mass_data, fill_mass, use_mass, get_mass),
    SIZED(fe_geometry, fill_geometry, use_geometry, get_geometry),
    SIZED(fe_shape_def, NULL, use_shape, NULL),
    SIZED(fe_joint_def, NULL, use_joint, get_joint),
    SIZED(fe_distance_joint_def, fill_distance, use_distance, get_distance),
    SIZED(fe_ball_joint_def, fill_ball, use_ball, get_ball),
    SIZED(fe_hinge_joint_def, fill_hinge, use_hinge, get_hinge),
    SIZED(fe_fixed_joint_def, fill_fixed, use_fixed, get_fixed),
    SIZED(fe_configurable_joint_def, fill_configurable, use_configurable, get_configurable),
    SIZED(fe_joint_state, NULL, NULL, get_state),
    SIZED(fe_query_filter, NULL, use_filter, NULL),
};
enum { STRUCTS = sizeof structs / sizeof *structs };

// ---- structs with a size -------------------------------------------------------------------------------------------

// As an init of that size leaves it, with the canary behind
static void prepare(const sized *t, unsigned char *s, uint32_t size)
{
    unsigned char whole[MOST_BYTES];
    memset(whole, 0, sizeof whole);
    t->init(whole, t->size);
    if (t->fill) t->fill(whole);
    memset(s, CANARY, MOST_BYTES);
    memcpy(s, whole, size < t->size ? size : t->size);
    if (size > t->size) memset(s + t->size, 0, size - t->size);
    memcpy(s, &size, sizeof size);
}

static void check_canary(const sized *t, const unsigned char *s, uint32_t size)
{
    for (uint32_t i = size < 4 ? 4 : size; i < MOST_BYTES; ++i)
        CHECK(s[i] == CANARY, "%s of %u bytes: byte %u is changed", t->type, size, i);
}

static int says(const char *words) { return strstr(fe_last_error(), words) != NULL; }

static void try_sizes(const sized *t, int32_t (*use)(void *s), int writes)
{
    _Alignas(16) unsigned char s[MOST_BYTES];
    for (uint32_t size = 0; size < t->size + LONGER; ++size) {
        const int is_older = size < t->size && ends_a_field(t->type, size), is_newer = size >= t->size && size % 4 == 0;
        if (is_newer && (size - t->size) % 8) continue; // a field of 8 bytes may have come, which it would cut
        if (size < t->size && is_reserved_room(t->type, size)) continue;
        prepare(t, s, size);
        const int32_t result = use(s);
        check_canary(t, s, size);
        if (is_newer || (is_older && writes))
            CHECK(result >= 0, "%s of %u bytes", t->type, size);
        else if (is_older)
            CHECK(result >= 0 || (strncmp(fe_last_error(), "fe_", 3) == 0 && !says("struct_size")), "%s of %u bytes",
                  t->type, size);
        else
            CHECK(result == FE_ERROR_ARGUMENT && says("struct_size"), "%s of %u bytes gave %d", t->type, size,
                  (int)result);
    }
    if (writes) return;
    for (uint32_t i = 0; i < LONGER; ++i) {
        prepare(t, s, t->size + LONGER);
        s[t->size + i] = 1;
        CHECK(use(s) == FE_ERROR_ARGUMENT && says("this version knows"), "%s with something at byte %u", t->type,
              t->size + i);
    }
}

static void try_init(const sized *t)
{
    unsigned char s[MOST_BYTES];
    t->init(NULL, t->size);
    for (uint32_t size = 4; size <= t->size + LONGER; ++size) {
        uint32_t told;
        memset(s, CANARY, sizeof s);
        t->init(s, size);
        memcpy(&told, s, sizeof told);
        CHECK(told == size, "%s_init of %u bytes", t->type, size);
        check_canary(t, s, size);
        for (uint32_t i = t->size; i < size; ++i) CHECK(s[i] == 0, "%s_init of %u bytes: byte %u", t->type, size, i);
    }
}

// ---- records with a stride -----------------------------------------------------------------------------------------
static const fe_dvec3 above = {0.0, 2.0, 0.0}, downwards = {0.0, -4.0, 0.0};

static int32_t read_hits(void *out, uint32_t stride)
{
    return fe_world_raycast_all(world, &above, &downwards, NULL, out, stride, 2);
}
static int32_t read_many_hits(void *out, uint32_t stride)
{
    const fe_ray rays[2] = {{above, downwards, {0}}, {above, downwards, {0}}};
    return fe_world_raycast_many(world, rays, sizeof *rays, 2, NULL, 0, out, stride);
}
static int32_t read_pair_events(void *out, uint32_t stride) { return fe_world_get_pair_events(world, out, stride, 2); }
static int32_t read_body_events(void *out, uint32_t stride) { return fe_world_get_body_events(world, out, stride, 2); }
static int32_t read_hit_events(void *out, uint32_t stride) { return fe_world_get_hit_events(world, out, stride, 2); }
static int32_t read_joint_events(void *out, uint32_t stride)
{
    return fe_world_get_joint_events(world, out, stride, 2);
}
static int32_t read_contacts(void *out, uint32_t stride) { return fe_body_get_contacts(world, ball, out, stride, 2); }
static int32_t read_shape_contacts(void *out, uint32_t stride)
{
    return fe_shape_get_contacts(world, ball_shape, out, stride, 2);
}
static int32_t read_overlaps(void *out, uint32_t stride)
{
    static const fe_transform at = {{0.0, 0.4, 0.0}, {0.0f, 0.0f, 0.0f, 1.0f}};
    fe_geometry sphere;
    fe_geometry_sphere(&sphere, 1.0f);
    return fe_world_overlap_shapes(world, &sphere, &at, NULL, out, stride, 2);
}

typedef struct record {
    const char *type;
    uint32_t size, least; // the shortest stride
    int32_t (*read)(void *out, uint32_t stride);
} record;
static const record records[] = {
    {"fe_hit", sizeof(fe_hit), offsetof(fe_hit, reserved), read_hits},
    {"fe_hit", sizeof(fe_hit), 8, read_many_hits},
    {"fe_overlap", sizeof(fe_overlap), offsetof(fe_overlap, material), read_overlaps},
    {"fe_pair_event", sizeof(fe_pair_event), 8, read_pair_events},
    {"fe_body_event", sizeof(fe_body_event), 8, read_body_events},
    {"fe_hit_event", sizeof(fe_hit_event), 8, read_hit_events},
    {"fe_joint_event", sizeof(fe_joint_event), 8, read_joint_events},
    {"fe_contact", sizeof(fe_contact), 8, read_contacts},
    {"fe_contact", sizeof(fe_contact), 8, read_shape_contacts},
};
enum { RECORDS = sizeof records / sizeof *records };

// Of each record as much is written as the stride and the library's own record have room for
static void try_strides(const record *r)
{
    _Alignas(16) unsigned char whole[2 * MOST_BYTES], s[2 * MOST_BYTES];
    memset(whole, CANARY, sizeof whole);
    const int32_t count = r->read(whole, r->size);
    CHECK(count >= 0, "%s", r->type);
    for (uint32_t stride = 0; stride <= r->size + LONGER; stride += 4) {
        memset(s, CANARY, sizeof s);
        const int32_t result = r->read(s, stride);
        if (stride < r->least) {
            CHECK(result == FE_ERROR_ARGUMENT && says("stride"), "%s %u bytes apart", r->type, stride);
            continue;
        }
        CHECK(result == count, "%s %u bytes apart", r->type, stride);
        const uint32_t shared = stride < r->size ? stride : r->size, written = (uint32_t)(count < 2 ? count : 2);
        for (uint32_t i = 0; i < written; ++i) {
            CHECK(memcmp(s + i * stride, whole + i * r->size, shared) == 0, "%s %u bytes apart", r->type, stride);
            for (uint32_t k = shared; k < stride; ++k)
                CHECK(s[i * stride + k] == CANARY, "%s %u bytes apart: byte %u", r->type, stride, k);
        }
        for (uint32_t k = written * stride; k < sizeof s; ++k)
            CHECK(s[k] == CANARY, "%s %u bytes apart: byte %u", r->type, stride, k);
    }
}

// Segments and paths of an older client end before their reserved words; those of a newer one are longer
static void try_inputs(void)
{
    _Alignas(16) unsigned char rays[2 * MOST_BYTES], paths[2 * MOST_BYTES];
    fe_hit hits[2];
    fe_geometry sphere;
    fe_geometry_sphere(&sphere, 0.1f);
    const fe_path path = {.start = {above, {0.0f, 0.0f, 0.0f, 1.0f}}, .translation = downwards};
    const fe_ray ray = {above, downwards, {0}};
    for (uint32_t stride = 0; stride <= sizeof path + LONGER; stride += 8) {
        memset(rays, 0, sizeof rays), memset(paths, 0, sizeof paths);
        for (uint32_t i = 0; i < 2; ++i) {
            memcpy(rays + i * stride, &ray, stride < sizeof ray ? stride : sizeof ray);
            memcpy(paths + i * stride, &path, stride < sizeof path ? stride : sizeof path);
        }
        const int32_t of_rays =
            fe_world_raycast_many(world, (const fe_ray *)(const void *)rays, stride, 2, NULL, 0, hits, sizeof *hits);
        CHECK(of_rays == (stride < 48 ? FE_ERROR_ARGUMENT : 2), "rays %u bytes apart: %d", stride, (int)of_rays);
        const int32_t of_paths = fe_world_sweep_many(world, &sphere, (const fe_path *)(const void *)paths, stride, 2,
                                                     NULL, 0, hits, sizeof *hits);
        CHECK(of_paths == (stride < 64 ? FE_ERROR_ARGUMENT : 2), "paths %u bytes apart: %d", stride, (int)of_paths);
    }
}

// fe_body_create_many takes definitions by stride and by size
static void try_definitions(void)
{
    struct {
        fe_body_def def;
        unsigned char newer[LONGER];
    } defs[2];
    fe_body made[2];
    memset(defs, 0, sizeof defs);
    for (int i = 0; i < 2; ++i) fe_body_def_init(&defs[i].def, sizeof defs[i]);
    MUST(fe_body_create_many(world, &defs[0].def, sizeof *defs, 2, made));
    MUST(fe_body_destroy_many(world, made, 2));
    defs[1].newer[7] = 1;
    CHECK(fe_body_create_many(world, &defs[0].def, sizeof *defs, 2, made) == FE_ERROR_ARGUMENT,
          "a value of a newer client");
    defs[1].newer[7] = 0;
    CHECK(fe_body_create_many(world, &defs[0].def, sizeof(fe_body_def), 2, made) == FE_ERROR_ARGUMENT,
          "definitions longer than their stride");
}

// ---- is any forgotten? ---------------------------------------------------------------------------------------------

// These never grow, or have reserved room that the library writes
static const char *const fixed[] = {"fe_vec3",    "fe_dvec3",       "fe_quat",          "fe_transform",
                                    "fe_frame",   "fe_bounds",      "fe_material",      "fe_joint_axis",
                                    "fe_closest", "fe_filter_pair", "fe_contact_point", "fe_ray",
                                    "fe_path"};

static int is_fixed(const char *type)
{
    for (size_t i = 0; i < sizeof fixed / sizeof *fixed; ++i)
        if (strcmp(fixed[i], type) == 0) return 1;
    return 0;
}

static void check_that_none_is_forgotten(void)
{
    for (int i = 0; i + 1 < FIELDS; ++i) {
        if (fields[i].name) continue;
        int found = 0;
        if (strcmp(fields[i + 1].name, "struct_size") == 0) {
            for (int k = 0; k < STRUCTS; ++k) found |= strcmp(structs[k].type, fields[i].type) == 0;
        } else {
            for (int k = 0; k < RECORDS; ++k) found |= strcmp(records[k].type, fields[i].type) == 0;
            found |= is_fixed(fields[i].type);
        }
        CHECK(found, "%s is not tried", fields[i].type);
    }
}

int main(void)
{
    check_that_none_is_forgotten();
    make_scene();
    for (int i = 0; i < STRUCTS; ++i) {
        try_init(&structs[i]);
        if (structs[i].read) try_sizes(&structs[i], structs[i].read, 0);
        if (structs[i].write) try_sizes(&structs[i], structs[i].write, 1);
    }
    for (int i = 0; i < RECORDS; ++i) try_strides(&records[i]);
    try_inputs();
    try_definitions();
    CHECK(fe_world_destroy(world) == FE_OK, "the end");
    return 0;
}
