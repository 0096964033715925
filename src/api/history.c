// history.c - the API of histories: frames of a world to go back to.
#include "state/history.h"
#include "api/record.h"
#include "api/world.h"
#include "core/fp_state.h"

#include <string.h>

enum { MOST_FRAMES = 1 << 16 }; // 18 minutes at 60 Hz
enum { LEAST_RECORD = 8 };      // bytes of a record that a caller may ask for

static fe_history_def default_history(void)
{
    return (fe_history_def){.struct_size = sizeof(fe_history_def), .frames = 16};
}

void fe_history_def_init(fe_history_def *def, uint32_t struct_size)
{
    fe_history_def defaults = default_history();
    fe__init_struct(def, &defaults, sizeof defaults, struct_size);
}

// Declares `world`, which is entered. It is no harm to ask a history that is gone: nothing behind the pointer is read
#define FE_ENTER_HISTORY(history)                                                                  \
    const char *function = __func__;                                                               \
    FE_CHECK_POINTER(history);                                                                     \
    fe_world *world = fe__world_of_history(history);                                               \
    if (!world) return fe__fail(function, FE_ERROR_STALE, "the history is gone, or its world is"); \
    FE_WRITE_AS(function, world)

fe_result fe_history_create(fe_world *world, const fe_history_def *def, fe_history **out_history)
{
    FE_WRITE(world);
    FE_CHECK_POINTER(out_history);
    fe_history_def full = default_history();
    if (def) FE_READ_STRUCT(def, &full);
    FE_CHECK_INT(full.frames, 1, MOST_FRAMES);
    FE_CHECK_INT(full.bytes, 0, INT64_MAX);
    return fe__report(function, fe__history_create(world, full.frames, full.bytes, out_history));
}

fe_result fe_history_destroy(fe_history *history)
{
    FE_ENTER_HISTORY(history);
    fe__history_destroy(history);
    return FE_OK;
}

fe_result fe_history_keep(fe_history *history, int64_t frame)
{
    FE_ENTER_HISTORY(history);
    if (history->count) {
        int64_t last = fe__history_frame(history, history->count - 1)->number;
        if (frame <= last)
            return fe__fail(function, FE_ERROR_ARGUMENT, "frame is %lld, must be above %lld, the last one kept",
                            (long long)frame, (long long)last);
    }
    fe_result result = fe__history_keep(history, frame);
    if (result == FE_ERROR_LIMIT)
        return fe__fail(function, result, "the frame alone needs more than the %lld bytes of the history",
                        (long long)history->most_bytes);
    return fe__report(function, result);
}

fe_result fe__report_return(const char *function, fe_result result)
{
    if (result == FE_ERROR_STEPPING || result == FE_ERROR_BUSY) {
        const char *why = result == FE_ERROR_STEPPING ? "is in a step" : "has another thread inside";
        return fe__fail(function, result, "a world that uses an asset edited since %s; nothing was changed", why);
    }
    return fe__report(function, result);
}

fe_result fe_history_restore(fe_history *history, int64_t frame)
{
    FE_ENTER_HISTORY(history);
    if (!fe__owner_be_alone(inside, FE__WRITER)) return fe__refuse_writer(function);
    fe__fp_state fp = fe__fp_enter();
    fe_result result = fe__history_restore(history, frame);
    fe__fp_leave(fp);
    if (result == FE_OK && world->recorder) fe__record_jump(world->recorder);
    if (result == FE_ERROR_STALE)
        return fe__fail(function, result, "frame %lld is not kept, or no longer", (long long)frame);
    return fe__report_return(function, result);
}

int32_t fe_history_get_frames(const fe_history *history, fe_history_frame *out_frames, uint32_t stride,
                              int32_t capacity)
{
    FE_ENTER_HISTORY(history);
    --inside->entries; // it writes nothing
    FE_CHECK_ARRAY(out_frames, capacity);
    FE_CHECK_RECORD_STRIDE(stride, LEAST_RECORD, capacity);
    for (int32_t i = 0; i < fe__mini(history->count, capacity); ++i) {
        fe_history_frame frame = {fe__history_frame(history, i)->number, fe__history_bytes(history, i)};
        memcpy(fe__at(out_frames, stride, i), &frame, sizeof frame < stride ? sizeof frame : stride);
    }
    return history->count;
}
