// check.h - the door of the library: what every API function asks of its arguments.
//
// An API function opens with FE_READ(world) or FE_WRITE(world), which enter the world until the function returns
// (core/owner.h). Then comes one line for each argument; each line leaves the function with an error and its sentence
// when the argument is wrong. Past these lines nothing is checked again. The names in the sentences are those of the
// caller's argument or field:
//
//     fe_result fe_body_set_gravity_scale(fe_world *world, fe_body body, float scale)
//     {
//         FE_WRITE(world);
//         FE_FIND_BODY(index, body);
//         FE_CHECK_FLOAT(scale, -FE_MAX_VALUE, FE_MAX_VALUE);
//         ...
#ifndef FE_API_CHECK_H
#define FE_API_CHECK_H
#include "api/fields.h"
#include "core/bytes.h"
#include "core/material.h"
#include "feather.h"
#include "recording/recorder.h"
#include "recording/ops.h"
#include "world/world.h"

// ---- error ----------------------------------------------------------------------------------------------------------
// The sentence of the last failure of each thread.
//
// Written by the API layer alone, read by fe_last_error. A fixed buffer: telling of an error never needs memory.

#ifdef __GNUC__
#define FE_PRINTF_LIKE(text, first) __attribute__((format(printf, text, first)))
#else
#define FE_PRINTF_LIKE(text, first)
#endif

// Keeps "function: sentence" for fe_last_error and returns `result`.
fe_result fe__fail(const char *function, fe_result result, const char *format, ...) FE_PRINTF_LIKE(3, 4);
// The same for what a lower layer gave as a reason: FE_ERROR_MEMORY, FE_ERROR_LIMIT. FE_OK passes.
fe_result fe__report(const char *function, fe_result result);

// ---- check ----------------------------------------------------------------------------------------------------------

enum { FE_MAX_SUBSTEPS = 64 };

// A step that is too short counts as one of no time
static inline float fe__counted_dt(float dt) { return dt < FE_LEAST_DT ? 0.0f : dt; }

// Leaves the function with what `call` returned unless that is FE_OK.
#define FE_TRY(call)                      \
    do {                                  \
        fe_result tried = (call);         \
        if (tried != FE_OK) return tried; \
    } while (0)

#define FE_CLEANUP(function) __attribute__((cleanup(function)))
// Inside the world until the end of the block. `function`: the name of the API function
#define FE_READ_AS(function, world)                                                                   \
    FE_CLEANUP(fe__end_read) fe__reader *inside = (world) ? fe__reader_enter(&(world)->owner) : NULL; \
    if (!inside) return fe__refuse(function, world)
#define FE_WRITE_AS(function, world)                                                          \
    FE_CLEANUP(fe__end_write)                                                                 \
    fe__owner *inside = (world) && fe__owner_enter(&(world)->owner) ? &(world)->owner : NULL; \
    if (!inside) return fe__refuse(function, world)
#define FE_READ(world)               \
    const char *function = __func__; \
    FE_READ_AS(function, world)
#define FE_WRITE(world)              \
    const char *function = __func__; \
    FE_WRITE_AS(function, world)
// Of what makes or removes records: these may move, and no reader may hold on to them
#define FE_WRITE_ALONE_AS(function, world) \
    FE_WRITE_AS(function, world);          \
    if (!fe__owner_be_alone(inside, FE__WRITER)) return fe__refuse_writer(function)
#define FE_WRITE_ALONE(world)        \
    const char *function = __func__; \
    FE_WRITE_ALONE_AS(function, world)
#define FE_BEGIN_WITHOUT_WORLD() const char *function = __func__
// Declares `index`, the record that a handle names.
#define FE_FIND_BODY(index, handle) \
    int32_t index;                  \
    FE_TRY(fe__find_body(function, #handle, world, handle, &index))
#define FE_FIND_SHAPE(index, handle) \
    int32_t index;                   \
    FE_TRY(fe__find_shape(function, #handle, world, handle, &index))
#define FE_FIND_JOINT(index, handle) \
    int32_t index;                   \
    FE_TRY(fe__find_joint(function, #handle, world, handle, &index))
#define FE_CHECK_POINTER(pointer) \
    if (!(pointer)) FE_TRY(fe__check_pointer(function, #pointer, 0))
#define FE_CHECK_FLOAT(value, low, high) \
    FE_TRY(fe__check_number(function, #value, "", (double)(value), (double)(low), (double)(high)))
#define FE_CHECK_INT(value, low, high) FE_TRY(fe__check_int(function, #value, value, low, high))
#define FE_CHECK_BOOL(value) FE_TRY(fe__check_int(function, #value, value, 0, 1))
#define FE_CHECK_BITS(value, allowed) FE_TRY(fe__check_bits(function, #value, value, allowed))
#define FE_CHECK_VEC3(pointer, most) FE_TRY(fe__check_vec3(function, #pointer, pointer, most))
#define FE_CHECK_DVEC3(pointer, most) \
    if (!fe__is_dvec3_within(pointer, most)) FE_TRY(fe__check_dvec3(function, #pointer, pointer, most))
#define FE_CHECK_QUAT(pointer) FE_TRY(fe__check_quat(function, #pointer, pointer))
#define FE_CHECK_TRANSFORM(pointer) FE_TRY(fe__check_transform(function, #pointer, pointer))
// Any length but zero
#define FE_CHECK_DIRECTION(pointer) FE_TRY(fe__check_direction(function, #pointer, pointer))
#define FE_CHECK_FILTER(layer) FE_TRY(fe__check_layer(function, #layer, layer))
// An array of `count` things; NULL only for none
#define FE_CHECK_ARRAY(array, count) FE_TRY(fe__check_array(function, #array, #count, array, count))
// Bytes from one thing to the next. 0 becomes `packed`, where that is not 0; less than `least` is refused
#define FE_CHECK_STRIDE(stride, packed, least) FE_TRY(fe__check_stride(function, #stride, &(stride), packed, least))
// Of records that may grow: the caller states it, unless there are none of them
#define FE_CHECK_RECORD_STRIDE(stride, least, count) \
    if ((stride) != 0 || (count) != 0) FE_CHECK_STRIDE(stride, 0, least)
#define FE_CHECK_RESERVED(words) \
    FE_TRY(fe__check_reserved(function, words, (int32_t)(sizeof(words) / (sizeof(uint32_t)))))
// `copy` holds the defaults; what the caller's struct has replaces them
#define FE_READ_STRUCT(given, copy) FE_TRY(fe__read_struct(function, #given, given, copy, FE_FIELDS_OF(copy)))
#define FE_CHECK_STRUCT_SIZE(given) FE_TRY(fe__check_struct_size(function, #given, given, FE_FIELDS_OF(given)))

static inline void fe__end_read(fe__reader **reader)
{
    if (*reader) fe__reader_leave(*reader);
}
static inline void fe__end_write(fe__owner **owner)
{
    if (*owner) fe__owner_leave(*owner);
}
// Why the world could not be entered
fe_result fe__refuse(const char *function, const fe_world *world);
// A reader is inside
fe_result fe__refuse_writer(const char *function);
fe_result fe__find_body(const char *function, const char *name, const fe_world *world, fe_body handle,
                        int32_t *out_index);
fe_result fe__find_shape(const char *function, const char *name, const fe_world *world, fe_shape handle,
                         int32_t *out_index);
fe_result fe__find_joint(const char *function, const char *name, const fe_world *world, fe_joint handle,
                         int32_t *out_index);
fe_result fe__find_asset(const char *function, const char *name, const fe_store *store, fe_asset handle,
                         int32_t *out_index); // locked
// FE_ERROR_KIND: an asset of another kind than `kind`, fe__asset_kind
fe_result fe__find_asset_of(const char *function, const char *name, const fe_store *store, int32_t kind,
                            fe_asset handle, int32_t *out_index); // locked
fe_result fe__check_pointer(const char *function, const char *name, int32_t there);
fe_result fe__check_number(const char *function, const char *name, const char *part, double value, double low,
                           double high);
fe_result fe__check_int(const char *function, const char *name, int64_t value, int64_t low, int64_t high);
fe_result fe__check_bits(const char *function, const char *name, uint32_t value, uint32_t allowed);
fe_result fe__check_layer(const char *function, const char *name, uint32_t layer);
fe_result fe__check_vec3(const char *function, const char *name, const fe_vec3 *v, float most);
fe_result fe__check_direction(const char *function, const char *name, const fe_vec3 *v);
fe_result fe__check_dvec3(const char *function, const char *name, const fe_dvec3 *v, double most);
fe_result fe__check_quat(const char *function, const char *name, const fe_quat *q);
fe_result fe__check_transform(const char *function, const char *name, const fe_transform *transform);
fe_result fe__check_array(const char *function, const char *name, const char *count_name, const void *array,
                          int32_t count);
fe_result fe__check_stride(const char *function, const char *name, uint32_t *stride, uint32_t packed, uint32_t least);
fe_result fe__check_reserved(const char *function, const void *words, int32_t count); // 32 bits each
fe_result fe__check_material(const char *function, const fe_material *material);
// Each of a caller's array is copied first: a stride of whole words may lay it where no fe_material may lie.
fe_result fe__check_materials(const char *function, const fe_material *materials, uint32_t stride, int32_t count);
fe_result fe__read_allocator(const char *function, const fe_allocator *allocator, fe_allocator *copy);
fe_result fe__check_struct_size(const char *function, const char *name, const void *given, const fe__fields *fields);
fe_result fe__read_struct(const char *function, const char *name, const void *given, void *copy,
                          const fe__fields *fields);

// |x| <= most, for finite most > 0. As integers, so that nothing is raised: the bits of doubles are in their order, and
// those of infinity and NaN above all others.
static inline int32_t fe__is_within(double x, double most)
{
    union {
        double value;
        uint64_t bits;
    } a = {x}, b = {most};
    return (a.bits & INT64_MAX) <= b.bits;
}
static inline int32_t fe__is_dvec3_within(const fe_dvec3 *v, double most)
{
    return v && fe__is_within(v->x, most) && fe__is_within(v->y, most) && fe__is_within(v->z, most);
}

// Fills a caller's struct: as much as both sides know, but for struct_size, which stays the caller's.
void fe__write_struct(void *out, const void *full, uint32_t size);
// Fills a definition with its defaults; a struct_size of an older client gets the front of it, the tail of a longer one
// is zeroed.
void fe__init_struct(void *out, const void *defaults, uint32_t size, uint32_t struct_size);
// Of what has no other default than its size
#define FE_DEFINE_EMPTY_INIT(name, type, argument)                          \
    void name(type *argument, uint32_t struct_size)                         \
    {                                                                       \
        type defaults = {.struct_size = sizeof defaults};                   \
        fe__init_struct(argument, &defaults, sizeof defaults, struct_size); \
    }

static inline fe_transform fe__body_transform(const fe__body *body)
{
    return (fe_transform){{body->origin[0], body->origin[1], body->origin[2]},
                          {body->rotation[0], body->rotation[1], body->rotation[2], body->rotation[3]}};
}
static inline fe_vec3 fe__body_velocity(const fe__body *body)
{
    return (fe_vec3){body->velocity[0], body->velocity[1], body->velocity[2]};
}
static inline fe_vec3 fe__body_spin(const fe__body *body)
{
    return (fe_vec3){body->spin[0], body->spin[1], body->spin[2]};
}
// Record i of a caller's array
static inline void *fe__at(void *array, uint32_t stride, int32_t i)
{
    return (unsigned char *)array + (size_t)stride * (size_t)i;
}
static inline const void *fe__at_const(const void *array, uint32_t stride, int32_t i)
{
    return (const unsigned char *)array + (size_t)stride * (size_t)i;
}

// ---- record ---------------------------------------------------------------------------------------------------------
// The end of a call that changed its world: it is noted, where somebody records.
//
// Calls that fail never come here. Whether anybody records costs a test of one field.

// FE_RECORD(body_set_awake, body, awake): the name without fe_, the arguments without the world
#define FE_RECORD(call, ...)                                                                               \
    do {                                                                                                   \
        if (__builtin_expect(world->recorder != NULL, 0)) fe__record_##call(world->recorder, __VA_ARGS__); \
    } while (0)

#endif
