// check.c - see check.h.
#include "api/check.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- check ----------------------------------------------------------------------------------------------------------

enum {
    LARGEST_STRUCT = 4096, // bytes: no version of any struct will be larger, so that more is garbage
    LEAST_STRIDE = 4       // all records are made of words
};

static const char *const kind_names[] = {"nothing", "body", "shape", "joint", "asset"};

fe_result fe__refuse(const char *function, const fe_world *world)
{
    if (!world) return fe__fail(function, FE_ERROR_ARGUMENT, "world is NULL");
    if (!fe__reader_of_thread()) return fe__report(function, FE_ERROR_MEMORY);
    switch (atomic_load_explicit(&world->owner.occupation, memory_order_acquire)) {
    case FE__SHOWN:
        return fe__fail(function, FE_ERROR_STATE,
                        "the world is a player's, to be read; clone it, or take it by fe_player_release");
    case FE__STEP:
        return fe__fail(function, FE_ERROR_STEPPING, "the world is in a step; call it when fe_world_step has returned");
    case FE__CLOSING:
        return fe__fail(function, FE_ERROR_BUSY, "the world is being destroyed");
    default:
        return fe__fail(function, FE_ERROR_BUSY,
                        "another call is changing this world now; one world needs one writer at a time");
    }
}

fe_result fe__refuse_writer(const char *function)
{
    return fe__fail(function, FE_ERROR_BUSY,
                    "another thread is reading this world; call it when its calls have returned");
}

// ---- handles -------------------------------------------------------------------------------------------------------

static fe_result find(const char *function, const char *name, const fe__id_pool *pool, fe_handle handle,
                      int32_t *out_slot)
{
    fe_result result = fe__id_pool_find(pool, handle, out_slot);
    if (result == FE_OK) return FE_OK;
    const char *kind = kind_names[pool->kind];
    if (handle == 0) return fe__fail(function, result, "%s is 0, the handle of nothing", name);
    if (result == FE_ERROR_KIND) {
        return fe__fail(function, result, "%s 0x%llx is a %s, not a %s", name, handle,
                        kind_names[fe__id_kind_of(handle)], kind);
    }
    if (fe__id_kind_of(handle) != 0 && fe__id_number_of(handle) != pool->number) {
        const char *home = pool->kind == FE_KIND_ASSET ? "store" : "world";
        return fe__fail(function, result, "%s 0x%llx is a %s of %s %" PRId32 ", this is %s %" PRId32, name, handle,
                        kind, home, fe__id_number_of(handle), home, pool->number);
    }
    int32_t slot = fe__id_slot_of(handle), now = fe__id_pool_generation(pool, slot),
            then = fe__id_generation_of(handle);
    if (fe__id_kind_of(handle) != 0 && then > 0 && then < now) {
        return fe__fail(function, result,
                        "%s 0x%llx was destroyed (slot %" PRId32 " is at generation %" PRId32
                        ", the handle has %" PRId32 ")",
                        kind, handle, slot, now, then);
    }
    return fe__fail(function, result, "%s 0x%llx was never the handle of a %s in this world", name, handle, kind);
}

fe_result fe__find_body(const char *function, const char *name, const fe_world *world, fe_body handle,
                        int32_t *out_index)
{
    return find(function, name, &world->body_ids, handle, out_index);
}

fe_result fe__find_shape(const char *function, const char *name, const fe_world *world, fe_shape handle,
                         int32_t *out_index)
{
    return find(function, name, &world->shape_ids, handle, out_index);
}

// A joint's record is one above its slot: record 0 is no joint
fe_result fe__find_joint(const char *function, const char *name, const fe_world *world, fe_joint handle,
                         int32_t *out_index)
{
    int32_t slot;
    FE_TRY(find(function, name, &world->joint_ids, handle, &slot));
    *out_index = slot + 1;
    return FE_OK;
}

fe_result fe__find_asset(const char *function, const char *name, const fe_store *store, fe_asset handle,
                         int32_t *out_index)
{
    FE_TRY(find(function, name, &store->ids, handle, out_index));
    if (!fe__store_asset(store, *out_index)->destroyed) return FE_OK;
    return fe__fail(function, FE_ERROR_STALE, "asset 0x%llx was destroyed; it lives on for its shapes only", handle);
}

fe_result fe__find_asset_of(const char *function, const char *name, const fe_store *store, int32_t kind,
                            fe_asset handle, int32_t *out_index)
{
    static const char *const kinds[] = {[FE__ASSET_HEIGHTFIELD] = "heightfield",
                                        [FE__ASSET_HULL] = "hull",
                                        [FE__ASSET_MESH] = "mesh",
                                        [FE__ASSET_COMPOUND] = "compound"};
    FE_TRY(fe__find_asset(function, name, store, handle, out_index));
    int32_t own = fe__store_asset(store, *out_index)->kind;
    if (own == kind) return FE_OK;
    return fe__fail(function, FE_ERROR_KIND, "%s 0x%llx is a %s, not a %s", name, handle, kinds[own], kinds[kind]);
}

// ---- words of a sentence -------------------------------------------------------------------------------------------

// The checks' arguments are expressions of the code, such as &full->frame.position. The caller knows what is behind the
// last arrow.
static const char *callers_name(const char *expression)
{
    const char *name = expression;
    for (const char *c = expression; *c; ++c)
        if (c[0] == '-' && c[1] == '>') name = c + 2;
    while (*name == '&' || *name == '*') ++name;
    return name;
}

typedef struct number_text {
    char text[32];
} number_text;

// As short as tells the float, or else the double, from its neighbours
static number_text text_of(double value)
{
    static const int digits[] = {6, 9, 17};
    number_text t;
    if (value != value) {
        memcpy(t.text, "NaN", sizeof "NaN");
        return t;
    }
    for (size_t i = 0; i < sizeof digits / sizeof *digits; ++i) {
        snprintf(t.text, sizeof t.text, "%.*g", digits[i], value);
        double back = strtod(t.text, NULL);
        if (back == value || (float)back == (float)value) break;
    }
    return t;
}

// ---- values --------------------------------------------------------------------------------------------------------

fe_result fe__check_pointer(const char *function, const char *name, int32_t there)
{
    return there ? FE_OK : fe__fail(function, FE_ERROR_ARGUMENT, "%s is NULL", callers_name(name));
}

// The sentence is made out of line: what every argument passes stays short.
static __attribute__((noinline, cold)) fe_result fail_number(const char *function, const char *name, const char *part,
                                                             double value, double low, double high)
{
    return fe__fail(function, FE_ERROR_ARGUMENT, "%s%s is %s, must be %s..%s", callers_name(name), part,
                    text_of(value).text, text_of(low).text, text_of(high).text);
}

// Finite first, by a comparison that raises nothing: a host may have unmasked the exceptions of NaNs.
fe_result fe__check_number(const char *function, const char *name, const char *part, double value, double low,
                           double high)
{
    if (__builtin_isfinite(value) && value >= low && value <= high) return FE_OK;
    return fail_number(function, name, part, value, low, high);
}

fe_result fe__check_int(const char *function, const char *name, int64_t value, int64_t low, int64_t high)
{
    if (value >= low && value <= high) return FE_OK;
    return fe__fail(function, FE_ERROR_ARGUMENT, "%s is %" PRId64 ", must be %" PRId64 "..%" PRId64, callers_name(name),
                    value, low, high);
}

fe_result fe__check_bits(const char *function, const char *name, uint32_t value, uint32_t allowed)
{
    if (!(value & ~allowed)) return FE_OK;
    return fe__fail(function, FE_ERROR_ARGUMENT, "%s is 0x%" PRIx32 ", only the bits of 0x%" PRIx32 " have a meaning",
                    callers_name(name), value, allowed);
}

fe_result fe__check_layer(const char *function, const char *name, uint32_t layer)
{
    if (layer != 0 && !(layer & (layer - 1))) return FE_OK;
    return fe__fail(function, FE_ERROR_ARGUMENT, "%s is 0x%" PRIx32 ", must be exactly one bit", callers_name(name),
                    layer);
}

fe_result fe__check_vec3(const char *function, const char *name, const fe_vec3 *v, float most)
{
    double limit = (double)most;
    FE_TRY(fe__check_pointer(function, name, v != NULL));
    FE_TRY(fe__check_number(function, name, ".x", (double)v->x, -limit, limit));
    FE_TRY(fe__check_number(function, name, ".y", (double)v->y, -limit, limit));
    return fe__check_number(function, name, ".z", (double)v->z, -limit, limit);
}

fe_result fe__check_direction(const char *function, const char *name, const fe_vec3 *v)
{
    FE_TRY(fe__check_pointer(function, name, v != NULL));
    int32_t finite = __builtin_isfinite(v->x) && __builtin_isfinite(v->y) && __builtin_isfinite(v->z);
    if (finite && (v->x != 0.0f || v->y != 0.0f || v->z != 0.0f)) return FE_OK;
    return fe__fail(function, FE_ERROR_ARGUMENT, "%s is (%s, %s, %s), must be finite and not zero", callers_name(name),
                    text_of((double)v->x).text, text_of((double)v->y).text, text_of((double)v->z).text);
}

fe_result fe__check_dvec3(const char *function, const char *name, const fe_dvec3 *v, double most)
{
    FE_TRY(fe__check_pointer(function, name, v != NULL));
    FE_TRY(fe__check_number(function, name, ".x", v->x, -most, most));
    FE_TRY(fe__check_number(function, name, ".y", v->y, -most, most));
    return fe__check_number(function, name, ".z", v->z, -most, most);
}

// Any float will do: their squares stay inside a double.
fe_result fe__check_quat(const char *function, const char *name, const fe_quat *q)
{
    FE_TRY(fe__check_pointer(function, name, q != NULL));
    int32_t finite =
        __builtin_isfinite(q->x) && __builtin_isfinite(q->y) && __builtin_isfinite(q->z) && __builtin_isfinite(q->w);
    if (finite && (q->x != 0.0f || q->y != 0.0f || q->z != 0.0f || q->w != 0.0f)) return FE_OK;
    return fe__fail(function, FE_ERROR_ARGUMENT, "%s is (%s, %s, %s, %s), a rotation must be finite and not zero",
                    callers_name(name), text_of((double)q->x).text, text_of((double)q->y).text,
                    text_of((double)q->z).text, text_of((double)q->w).text);
}

fe_result fe__check_transform(const char *function, const char *name, const fe_transform *transform)
{
    FE_TRY(fe__check_pointer(function, name, transform != NULL));
    FE_TRY(fe__check_dvec3(function, name, &transform->position, FE_MAX_POSITION));
    return fe__check_quat(function, name, &transform->rotation);
}

// ---- arrays --------------------------------------------------------------------------------------------------------

fe_result fe__check_array(const char *function, const char *name, const char *count_name, const void *array,
                          int32_t count)
{
    name = callers_name(name), count_name = callers_name(count_name);
    if (count < 0)
        return fe__fail(function, FE_ERROR_ARGUMENT, "%s is %" PRId32 ", must not be negative", count_name, count);
    if (!array && count > 0)
        return fe__fail(function, FE_ERROR_ARGUMENT, "%s is NULL, but %s is %" PRId32, name, count_name, count);
    return FE_OK;
}

fe_result fe__check_stride(const char *function, const char *name, uint32_t *stride, uint32_t packed, uint32_t least)
{
    if (*stride == 0 && packed != 0) {
        *stride = packed;
        return FE_OK;
    }
    if (*stride >= least && *stride % LEAST_STRIDE == 0) return FE_OK;
    return fe__fail(function, FE_ERROR_ARGUMENT, "%s is %" PRIu32 ", must be %sa multiple of %d of at least %" PRIu32,
                    callers_name(name), *stride,
                    packed ? "0 (packed) or " : "the size of the caller's record: ", LEAST_STRIDE, least);
}

fe_result fe__check_reserved(const char *function, const void *words, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        uint32_t word;
        memcpy(&word, (const unsigned char *)words + sizeof word * (size_t)i, sizeof word);
        if (word != 0) return fe__fail(function, FE_ERROR_ARGUMENT, "reserved holds 0x%" PRIx32 ", must be 0", word);
    }
    return FE_OK;
}

// ---- structs that grow ---------------------------------------------------------------------------------------------

static uint32_t size_of(const void *given)
{
    uint32_t size;
    memcpy(&size, given, sizeof size);
    return size;
}

// After a field of this version, or beyond all of them
static int32_t ends_with_a_field(uint32_t size, const fe__fields *fields)
{
    if (size >= fields->size) return size <= LARGEST_STRUCT && size % sizeof size == 0;
    for (uint32_t i = 0; i < fields->count; ++i)
        if (fields->ends[i] == size) return 1;
    return 0;
}

fe_result fe__check_struct_size(const char *function, const char *name, const void *given, const fe__fields *fields)
{
    name = callers_name(name);
    FE_TRY(fe__check_pointer(function, name, given != NULL));
    uint32_t size = size_of(given);
    if (ends_with_a_field(size, fields)) return FE_OK;
    const char *cause =
        size >= sizeof size && size < fields->size ? "which ends inside a field" : "which is no size of any version";
    return fe__fail(function, FE_ERROR_ARGUMENT,
                    "%s.struct_size is %" PRIu32 ", %s (%" PRIu32 " in this one): is it filled by its _init?", name,
                    size, cause, fields->size);
}

// The front that both sides know is taken. What an older client does not have keeps its default; what a newer one has
// beyond must be zero, because this version cannot honour it.
fe_result fe__read_struct(const char *function, const char *name, const void *given, void *copy,
                          const fe__fields *fields)
{
    FE_TRY(fe__check_struct_size(function, name, given, fields));
    uint32_t given_size = size_of(given), size = fields->size;
    const unsigned char *bytes = given;
    for (uint32_t i = size; i < given_size; ++i) {
        if (bytes[i] == 0) continue;
        return fe__fail(function, FE_ERROR_ARGUMENT,
                        "%s has a value at byte %" PRIu32 ", this version knows %" PRIu32 " bytes of it",
                        callers_name(name), i, size);
    }
    memcpy(copy, given, given_size < size ? given_size : size);
    memcpy(copy, &size, sizeof size);
    return FE_OK;
}

void fe__write_struct(void *out, const void *full, uint32_t size)
{
    uint32_t given_size = size_of(out), shared = given_size < size ? given_size : size;
    memcpy((unsigned char *)out + sizeof size, (const unsigned char *)full + sizeof size, shared - sizeof size);
}

void fe__init_struct(void *out, const void *defaults, uint32_t size, uint32_t struct_size)
{
    if (!out || struct_size < sizeof struct_size || struct_size > LARGEST_STRUCT) return;
    memset(out, 0, struct_size);
    memcpy(out, defaults, struct_size < size ? struct_size : size);
    memcpy(out, &struct_size, sizeof struct_size);
}

fe_result fe__check_material(const char *function, const fe_material *material)
{
    FE_CHECK_POINTER(material);
    FE_CHECK_FLOAT(material->static_friction, 0.0f, FE_MAX_VALUE);
    FE_CHECK_FLOAT(material->dynamic_friction, 0.0f, FE_MAX_VALUE);
    FE_CHECK_FLOAT(material->restitution, 0.0f, 1.0f);
    FE_CHECK_FLOAT(material->rolling_resistance, 0.0f, FE_MAX_VALUE);
    FE_CHECK_FLOAT(material->spinning_resistance, 0.0f, FE_MAX_VALUE);
    FE_CHECK_INT(material->friction_combine, FE_COMBINE_DEFAULT, FE_COMBINE_MAXIMUM);
    FE_CHECK_INT(material->restitution_combine, FE_COMBINE_DEFAULT, FE_COMBINE_MAXIMUM);
    FE_CHECK_RESERVED(material->reserved);
    return FE_OK;
}

fe_result fe__check_materials(const char *function, const fe_material *materials, uint32_t stride, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        fe_material copy;
        memcpy(&copy, fe__at_const(materials, stride, i), sizeof copy);
        FE_TRY(fe__check_material(function, &copy));
    }
    return FE_OK;
}

fe_result fe__read_allocator(const char *function, const fe_allocator *allocator, fe_allocator *copy)
{
    FE_READ_STRUCT(allocator, copy);
    FE_CHECK_POINTER(copy->allocate);
    FE_CHECK_POINTER(copy->release);
    FE_CHECK_INT(copy->reserved, 0, 0);
    return FE_OK;
}

// ---- error ----------------------------------------------------------------------------------------------------------

enum { SENTENCE_SIZE = 320 }; // longer ones are cut

static _Thread_local char sentence[SENTENCE_SIZE] = "no failure so far";

const char *fe_last_error(void) { return sentence; }

fe_result fe__fail(const char *function, fe_result result, const char *format, ...)
{
    int used = snprintf(sentence, sizeof sentence, "%s: ", function);
    if (used < 0 || used >= SENTENCE_SIZE) return result;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence + used, sizeof sentence - (size_t)used, format, arguments);
    va_end(arguments);
    return result;
}

fe_result fe__report(const char *function, fe_result result)
{
    switch ((int)result) {
    case FE_OK:
        return FE_OK;
    case FE_ERROR_MEMORY:
        return fe__fail(function, result, "the allocator gave no memory; nothing was changed");
    case FE_ERROR_LIMIT:
        return fe__fail(function, result, "more than a world or a store can hold; nothing was changed");
    default:
        return fe__fail(function, result, "%s", fe_result_name(result));
    }
}

const char *fe_result_name(int32_t result)
{
    switch (result) {
    case FE_OK:
        return "FE_OK";
    case FE_FOREIGN:
        return "FE_FOREIGN";
    case FE_END:
        return "FE_END";
    case FE_ERROR_ARGUMENT:
        return "FE_ERROR_ARGUMENT";
    case FE_ERROR_STALE:
        return "FE_ERROR_STALE";
    case FE_ERROR_KIND:
        return "FE_ERROR_KIND";
    case FE_ERROR_STEPPING:
        return "FE_ERROR_STEPPING";
    case FE_ERROR_MEMORY:
        return "FE_ERROR_MEMORY";
    case FE_ERROR_LIMIT:
        return "FE_ERROR_LIMIT";
    case FE_ERROR_UNSUPPORTED:
        return "FE_ERROR_UNSUPPORTED";
    case FE_ERROR_STATE:
        return "FE_ERROR_STATE";
    case FE_ERROR_BUSY:
        return "FE_ERROR_BUSY";
    case FE_ERROR_DEGENERATE:
        return "FE_ERROR_DEGENERATE";
    case FE_ERROR_DATA:
        return "FE_ERROR_DATA";
    case FE_ERROR_VERSION:
        return "FE_ERROR_VERSION";
    case FE_ERROR_DIVERGED:
        return "FE_ERROR_DIVERGED";
    default:
        return "unknown";
    }
}
