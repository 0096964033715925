// fuzz.c - see fuzz.h: the stream, the checks, and the loop over calls. The calls themselves are in fuzz_calls.c.
//
// What must always hold: nothing crashes; a call that returns an error, or only reads, leaves every byte of a snapshot;
// an accepted call leaves numbers only; a call that found no memory can be repeated; the fingerprint can be computed;
// what the world saves at the end is accepted.
#include "core/memory.h"
#include "support/fuzz_state.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CALLS = 4000 };

void fuzz_fail(const fuzz *f, const char *what)
{
    fprintf(stderr, "call %d (%s): %s\nlast error: %s\n", (int)f->call_count, f->call_name, what, fe_last_error());
    abort();
}

// ---- the stream ----------------------------------------------------------------------------------------------------

uint8_t fuzz_byte(fuzz *f)
{
    if (f->at >= f->size) return 0;
    return f->bytes[f->at++];
}

uint32_t fuzz_word(fuzz *f)
{
    uint32_t word = 0;
    for (int i = 0; i < 4; ++i) word = word << 8 | fuzz_byte(f);
    return word;
}

// Mostly what a game would give; now and then what no one should. A sane stream has no accepted value that a game could
// not mean.
float fuzz_float(fuzz *f)
{
    static const float wild[16] = {NAN,  INFINITY, -INFINITY, 3.4e38f, -3.4e38f, 1e-40f, -1e-45f, -0.0f,
                                   1e6f, -1e6f,    1e9f,      1e15f,   1e-6f,    1e-3f,  1e5f,    1e20f};
    static const float sane[16] = {NAN,    INFINITY, -INFINITY, 3.4e38f, -3.4e38f, 1e-40f, -1e-45f, -0.0f,
                                   100.0f, -100.0f,  30.0f,     1e20f,   -20.0f,   1e-3f,  50.0f,   0.0f};
    uint8_t kind = fuzz_byte(f);
    if (kind < 16) return f->is_wild ? wild[kind] : sane[kind];
    if (kind < 20 && f->is_wild) {
        uint32_t bits = fuzz_word(f);
        float value;
        memcpy(&value, &bits, sizeof value);
        return value;
    }
    if (kind < 60) return (float)(kind - 40) * 0.1f;
    return ((float)fuzz_byte(f) + (float)kind / 256.0f) / 16.0f - (kind % 2 ? 8.0f : 0.0f);
}

// most of the time above 0 and moderate
float fuzz_size(fuzz *f)
{
    uint8_t kind = fuzz_byte(f);
    return kind < 12 ? fuzz_float(f) : 0.05f + (float)kind / 200.0f;
}

fe_vec3 fuzz_vec3(fuzz *f)
{
    fe_vec3 v;
    v.x = fuzz_float(f);
    v.y = fuzz_float(f);
    v.z = fuzz_float(f);
    return v;
}

fe_dvec3 fuzz_dvec3(fuzz *f)
{
    fe_vec3 v = fuzz_vec3(f);
    fe_dvec3 d = {(double)v.x, (double)v.y, (double)v.z};
    if (fuzz_byte(f) == 7) d.x *= f->is_wild ? 1e9 : 1e4;
    return d;
}

fe_quat fuzz_quat(fuzz *f)
{
    fe_quat q = {0.0f, 0.0f, 0.0f, 1.0f};
    if (fuzz_byte(f) % 2) return q;
    q.x = fuzz_float(f);
    q.y = fuzz_float(f);
    q.z = fuzz_float(f);
    q.w = fuzz_float(f);
    return q;
}

fe_transform fuzz_transform(fuzz *f)
{
    fe_transform t;
    t.position = fuzz_dvec3(f);
    t.rotation = fuzz_quat(f);
    return t;
}

// living, dead, of the other kind, made up
fe_handle fuzz_handle(fuzz *f, const fe_handle *known, const fe_handle *other)
{
    uint8_t kind = fuzz_byte(f);
    if (kind < 4) return 0;
    if (kind < 8) return other[kind % FUZZ_HANDLES];
    if (kind < 12) return known[kind] ^ (fe_handle)1 << (fuzz_byte(f) % 64);
    if (kind < 14) return (fe_handle)fuzz_word(f) << 32 | fuzz_word(f);
    return known[kind % FUZZ_HANDLES];
}

fe_body fuzz_body(fuzz *f) { return fuzz_handle(f, f->bodies, f->shapes); }
fe_shape fuzz_shape(fuzz *f) { return fuzz_handle(f, f->shapes, f->bodies); }

// the right size, an older client's, a newer one's, rubbish
uint32_t fuzz_struct_size(fuzz *f, uint32_t right)
{
    uint8_t kind = fuzz_byte(f);
    if (kind >= 8) return right;
    if (kind == 0) return 0;
    if (kind == 1) return fuzz_word(f) | 0x10000; // beyond all that is read
    if (kind < 5) return right - 4u * kind;
    return right + 4u * kind; // callers leave FUZZ_TAIL bytes behind their structs
}

void fuzz_array(fuzz *f, uint32_t packed, fuzz_span *out)
{
    static const uint32_t strides[] = {0, 0, 0, 1, 4, 7, 8, 12, 24, 100, 128, 3, 0x7fffffff, 0xfffffffc};
    uint8_t kind = fuzz_byte(f), how_many = fuzz_byte(f);
    out->stride = kind < 100 ? packed : kind < 200 ? 0 : strides[kind % 14];
    uint32_t step = out->stride ? out->stride : packed;
    int32_t room = (int32_t)(FUZZ_ROOM / step);
    out->count = how_many < 8 ? -how_many : how_many % 40;
    if (out->count > room) out->count = room;
    out->data = how_many == 200 ? NULL : f->room;
}

// ---- the checks ----------------------------------------------------------------------------------------------------

static uint64_t world_hash(const fuzz *f)
{
    uint32_t words[2];
    if (fe_world_hash(f->world, words) != FE_OK) fuzz_fail(f, "no fingerprint");
    return words[0] | (uint64_t)words[1] << 32;
}

static void take_snapshot(const fuzz *f, fuzz_snapshot *s)
{
    s->size = fe_world_save(f->world, NULL, NULL, 0);
    if (s->size > s->capacity) {
        free(s->bytes);
        s->bytes = malloc((size_t)(s->capacity = 2 * s->size));
    }
    if (!s->bytes || fe_world_save(f->world, NULL, s->bytes, s->capacity) != s->size) fuzz_fail(f, "no snapshot");
}

// With the sentence of where the two differ
static void check_unchanged(fuzz *f, const char *what)
{
    const fuzz_snapshot *a = &f->before, *b = &f->after;
    take_snapshot(f, &f->after);
    if (a->size == b->size && memcmp(a->bytes, b->bytes, (size_t)a->size) == 0) return;
    fe_difference d;
    fe_difference_init(&d, sizeof d);
    if (fe_snapshot_compare(a->bytes, a->size, b->bytes, b->size, &d) > 0)
        fprintf(stderr, "%s 0x%llx %s[%d]: %s, now %s\n", d.kind, d.handle, d.field, (int)d.element, d.a, d.b);
    fuzz_fail(f, what);
}

static void check_numbers(const fuzz *f, const float *numbers, int32_t count, const char *what)
{
    for (int32_t i = 0; i < count; ++i)
        if (!isfinite(numbers[i]) && !f->is_wild) fuzz_fail(f, what);
}

static void check_position(const fuzz *f, fe_dvec3 p, const char *what)
{
    if ((!isfinite(p.x) || !isfinite(p.y) || !isfinite(p.z)) && !f->is_wild) fuzz_fail(f, what);
}

static void check_contacts(const fuzz *f, fe_body body)
{
    fe_contact contacts[8];
    int32_t count = fe_body_get_contacts(f->world, body, contacts, sizeof *contacts, 8);
    if (count < 0) fuzz_fail(f, "no contacts of a living body");
    for (int32_t i = 0; i < count && i < 8; ++i) {
        const fe_contact *c = contacts + i;
        if (c->point_count < 1 || c->point_count > 4) fuzz_fail(f, "a contact without points");
        check_numbers(f, &c->normal.x, 3, "normal");
        check_numbers(f, &c->friction_impulse.x, 3, "friction impulse");
        for (int32_t k = 0; k < c->point_count; ++k) {
            check_position(f, c->points[k].point, "contact point");
            check_numbers(f, &c->points[k].separation, 3, "separation and impulses of a contact");
        }
    }
}

// everything of one body; also fed to the fingerprint
static void check_body(fuzz *f, fe_body body)
{
    const fe_world *w = f->world;
    fe_transform t;
    fe_dvec3 centre;
    fe_mass_data mass = {.struct_size = sizeof mass};
    fe_vec3 v, spin;
    int32_t awake;
    if (fe_body_get_transform(w, body, &t) || fe_body_get_centre(w, body, &centre) ||
        fe_body_get_linear_velocity(w, body, &v) || fe_body_get_angular_velocity(w, body, &spin) ||
        fe_body_get_mass_data(w, body, &mass) || fe_body_get_awake(w, body, &awake))
        fuzz_fail(f, "a living body cannot be read");
    check_position(f, t.position, "position");
    check_position(f, centre, "centre");
    check_numbers(f, &t.rotation.x, 4, "rotation");
    check_numbers(f, &v.x, 3, "velocity");
    check_numbers(f, &spin.x, 3, "angular velocity");
    check_numbers(f, &mass.mass, 1, "mass");
    check_numbers(f, &mass.centre.x, 3, "centre of mass");
    check_numbers(f, &mass.inertia.x, 3, "inertia");
    float square = t.rotation.x * t.rotation.x + t.rotation.y * t.rotation.y + t.rotation.z * t.rotation.z +
                   t.rotation.w * t.rotation.w;
    if (!(square > 0.999f && square < 1.001f) && !f->is_wild) fuzz_fail(f, "a rotation that is no unit quaternion");
    check_contacts(f, body);
    fe__hash_dvec3(&f->told, centre);
    fe__hash_vec3(&f->told, mass.inertia);
}

void fuzz_check(fuzz *f)
{
    fe_body bodies[FUZZ_HANDLES];
    int32_t count = fe_world_get_bodies(f->world, bodies, FUZZ_HANDLES);
    if (count < 0) fuzz_fail(f, "the bodies cannot be listed");
    for (int32_t i = 0; i < count && i < FUZZ_HANDLES; ++i) check_body(f, bodies[i]);
}

// ---- memory that fails ---------------------------------------------------------------------------------------------

static int32_t fails(fuzz *f)
{
    if (f->fail_after > 0) return --f->fail_after == 0;
    if (!f->is_stepping || f->failures < 2) return 0;
    f->chance ^= f->chance << 13, f->chance ^= f->chance >> 7, f->chance ^= f->chance << 17;
    return (int32_t)(f->chance >> 63);
}

static void *allocate(void *user, uint64_t size, uint64_t alignment)
{
    fuzz *f = user;
    if (fails(f)) return NULL;
    f->blocks += 1;
    return fe__aligned_allocate((size_t)size, (size_t)alignment);
}

static void release(void *user, void *memory, uint64_t size)
{
    fuzz *f = user;
    (void)size;
    f->blocks -= 1;
    fe__aligned_free(memory);
}

#define SHORTEST_STEP 1e-5f // s; a shorter one moves nothing

// Whatever the masses, and whatever holds them: `max_linear_speed`, to rounding
static void check_speeds(const fuzz *f)
{
    fe_body bodies[FUZZ_HANDLES];
    fe_world_tuning tuning = {.struct_size = sizeof tuning};
    int32_t count = fe_world_get_bodies(f->world, bodies, FUZZ_HANDLES), awake;
    if (fe_world_get_tuning(f->world, &tuning)) fuzz_fail(f, "no tuning");
    for (int32_t i = 0; i < count && i < FUZZ_HANDLES; ++i) {
        fe_vec3 v;
        if (fe_body_get_linear_velocity(f->world, bodies[i], &v) || fe_body_get_awake(f->world, bodies[i], &awake))
            fuzz_fail(f, "a living body cannot be read");
        double x = (double)v.x, y = (double)v.y, z = (double)v.z;
        if (awake && sqrt(x * x + y * y + z * z) > 1.000001 * (double)tuning.max_linear_speed)
            fuzz_fail(f, "a body faster than the limit");
    }
}

fe_result fuzz_step(fuzz *f, float dt)
{
    for (;;) {
        if (f->failures != 1) take_snapshot(f, &f->before);
        f->is_stepping = 1;
        fe_result result = fe_world_step(f->world, dt);
        f->is_stepping = 0;
        if (result == FE_ERROR_MEMORY) check_unchanged(f, "a failed step changed the world");
        if (result == FE_OK && dt >= SHORTEST_STEP) check_speeds(f);
        if (result != FE_ERROR_MEMORY || f->failures < 2) return result;
    }
}

// ---- worlds --------------------------------------------------------------------------------------------------------

// every third task first: an order that no loop has
static void run_tasks(void *user, fe_task task, void *argument, int32_t count)
{
    (void)user;
    for (int32_t first = 0; first < 3; ++first)
        for (int32_t i = count - 1 - first; i >= 0; i -= 3) task(argument, i);
}

static void run_tasks_reversed(void *user, fe_task task, void *argument, int32_t count)
{
    (void)user;
    for (int32_t i = count - 1; i >= 0; --i) task(argument, i);
}

static void open_world(fuzz *f, const fuzz_setting *setting)
{
    fe_world_def def;
    fe_allocator allocator = {sizeof allocator, 0, allocate, release, f};
    fe_task_system tasks = {sizeof tasks, setting->workers, setting->is_reversed ? run_tasks_reversed : run_tasks,
                            NULL};
    fe_world_def_init(&def, sizeof def);
    def.allocator = &allocator;
    if (setting->workers > 1) def.tasks = &tasks;
    def.simd = setting->simd;
    def.number = 1; // the handles are told
    def.substeps = 1 + fuzz_byte(f) % 8;
    if (fe_world_create(&def, &f->world) != FE_OK) fuzz_fail(f, "no world");
}

// One call: when it fails, nothing has changed; when memory failed, it is repeated
static void call(fuzz *f, const fuzz_call *c)
{
    size_t at = f->at;
    int32_t result;
    f->call_name = c->name;
    for (int32_t attempt = 0;; ++attempt) {
        take_snapshot(f, &f->before);
        f->at = at; // the same arguments
        result = c->run(f);
        if (c->effect == FUZZ_READS) check_unchanged(f, "a call that reads changed the world");
        if (result >= 0) break;
        if (result < FE_ERROR_DIVERGED) fuzz_fail(f, "a result that has no name");
        if (c->effect < FUZZ_READS) check_unchanged(f, "an error changed the world");
        if (f->refused) ++*f->refused;
        if (result != FE_ERROR_MEMORY) break;
        if (attempt > 0) fuzz_fail(f, "no memory, though the allocator has some");
    }
    if (f->tells)
        fprintf(stderr, "call %d: %s: %d, bodies %d, shapes %d\n", (int)f->call_count, c->name, (int)result,
                (int)f->body_count, (int)f->shape_count);
    fe__hash_i32(&f->told, result);
    fe__hash_u64(&f->told, world_hash(f));
}

uint64_t fuzz_run(const uint8_t *bytes, size_t size, const fuzz_setting *setting)
{
    fuzz *f = calloc(1, sizeof *f);
    if (!f) abort();
    f->bytes = bytes;
    f->size = size;
    f->is_wild = setting->is_wild;
    f->failures = setting->failures;
    f->chance = UINT64_C(0x9E3779B97F4A7C15) * setting->failures;
    f->refused = setting->refused;
    f->told = fe__hash_begin();
    f->call_name = "fe_world_create";
    f->tells = getenv("FE_FUZZ_TELL") != NULL;
    open_world(f, setting);
    if (setting->begins) setting->begins(f->world, setting->user);
    while (f->at < f->size && f->call_count++ < MOST_CALLS) {
        const fuzz_call *c = fuzz_calls + fuzz_byte(f) % fuzz_call_count;
        call(f, c);
        if (c->effect == FUZZ_MOVES || c->effect == FUZZ_SEVERAL) fuzz_check(f);
    }
    f->call_name = "the end";
    fuzz_check(f);
    take_snapshot(f, &f->after);
    if (fe_snapshot_check(f->after.bytes, f->after.size, NULL) != FE_OK) fuzz_fail(f, "what it saves is refused");
    if (setting->ends) setting->ends(f->world, setting->user);
    uint64_t told = fe__hash_end(&f->told);
    if (fe_world_destroy(f->world) != FE_OK) fuzz_fail(f, "the world cannot be destroyed");
    if (f->blocks != 0) fuzz_fail(f, "memory was not given back");
    free(f->before.bytes);
    free(f->after.bytes);
    free(f);
    return told;
}
