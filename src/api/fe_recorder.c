// fe_recorder.c - the API of recorders: who notes what a world is told.
#include "api/check.h"
#include "core/fp_state.h"
#include "recording/recorder.h"

#include <string.h>

enum { LEAST_BUFFER = 1 << 16, MOST_NOTE = 4096 };

static fe_recorder_def default_recorder(void)
{
    const int64_t buffer = INT64_C(64) << 20;
    return (fe_recorder_def){.struct_size = sizeof(fe_recorder_def),
                             .flags = FE_RECORD_ASSETS,
                             .keyframe_steps = 600,
                             .buffer_bytes = buffer};
}

void fe_recorder_def_init(fe_recorder_def *def, uint32_t struct_size)
{
    fe_recorder_def defaults = default_recorder();
    fe__init_struct(def, &defaults, sizeof defaults, struct_size);
}

static fe_result read_def(const char *function, const fe_recorder_def *def, fe_recorder_def *full)
{
    *full = default_recorder();
    if (!def) return FE_OK;
    FE_READ_STRUCT(def, full);
    FE_CHECK_BITS(full->flags, FE_RECORD_ASSETS | FE_RECORD_FINE | FE_RECORD_LAST);
    FE_CHECK_INT(full->keyframe_steps, 0, INT32_MAX);
    FE_CHECK_INT(full->buffer_bytes, LEAST_BUFFER, INT64_MAX);
    FE_CHECK_INT(full->reserved, 0, 0);
    return FE_OK;
}

fe_result fe_recorder_create(fe_world *world, const fe_recorder_def *def, fe_recorder **out_recorder)
{
    FE_WRITE_ALONE(world);
    FE_CHECK_POINTER(out_recorder);
    fe_recorder_def full;
    FE_TRY(read_def(function, def, &full));
    if (world->recorder)
        return fe__fail(function, FE_ERROR_STATE, "the world has a recorder already: destroy that first");
    if (world->batch)
        return fe__fail(function, FE_ERROR_STATE, "the world is one of a batch: record a clone that makes its calls");
    fe_result result;
    fe__fp_state fp = fe__fp_enter();
    fe_recorder *made = fe__recorder_create(world, full.flags, full.keyframe_steps, full.buffer_bytes, &result);
    fe__fp_leave(fp);
    if (result == FE_ERROR_LIMIT)
        return fe__fail(function, result, "buffer_bytes is %lld, the first keyframe takes more",
                        (long long)full.buffer_bytes);
    FE_TRY(fe__report(function, result));
    *out_recorder = made;
    return FE_OK;
}

static fe_result tell_end(const char *function, fe_result result, int64_t size)
{
    if (result >= 0) return result;
    if (result == FE_ERROR_LIMIT && size > 0)
        return fe__fail(function, result, "capacity is less than the %lld bytes that come next", (long long)size);
    if (result == FE_ERROR_LIMIT)
        return fe__fail(function, result, "the recording ended: buffer_bytes were full, and nobody read");
    return fe__fail(function, result, "the recording ended: there was no memory for it");
}

fe_result fe_recorder_read(fe_recorder *recorder, void *out, int64_t capacity, int64_t *out_size)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(recorder);
    FE_CHECK_POINTER(out_size);
    FE_CHECK_INT(capacity, 0, INT64_MAX);
    if (capacity > 0) FE_CHECK_POINTER(out);
    *out_size = 0;
    fe_result result = fe__recorder_read(recorder, out, capacity, out_size);
    return tell_end(function, result, *out_size);
}

fe_result fe_recorder_note(fe_recorder *recorder, fe_handle about, const char *text)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(recorder);
    FE_CHECK_POINTER(text);
    size_t length = strlen(text);
    FE_CHECK_INT((int64_t)length, 0, MOST_NOTE);
    fe_result result = fe__recorder_note(recorder, about, text);
    if (result == FE_ERROR_STATE) return fe__fail(function, result, "the recording has ended");
    return tell_end(function, result, 0);
}

fe_result fe_recorder_destroy(fe_recorder *recorder)
{
    FE_BEGIN_WITHOUT_WORLD();
    FE_CHECK_POINTER(recorder);
    if (recorder->world) {
        FE_WRITE_ALONE_AS(function, recorder->world);
        fe__recorder_detach(recorder, FE_END);
    }
    fe__recorder_destroy(recorder);
    return FE_OK;
}
