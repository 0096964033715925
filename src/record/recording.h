// recording.h - a recording from its first keyframe to its end, and who reads it.
#ifndef FE_RECORD_RECORDING_H
#define FE_RECORD_RECORDING_H
#include "record/recorder.h"

// A recorder that has written its first keyframe. NULL: *out_result is FE_ERROR_MEMORY or FE_ERROR_LIMIT
fe_recorder *fe__recorder_create(fe_world *world, uint32_t flags, int32_t keyframe_steps, int64_t capacity,
                                 fe_result *out_result);
void fe__recorder_destroy(fe_recorder *recorder); // the world's, or of no world
// The world ends, or its recorder: what is there can be read
void fe__recorder_detach(fe_recorder *recorder, fe_result end);
// As many whole chunks as the capacity takes; with FE_RECORD_LAST all of them, or none. From any thread
fe_result fe__recorder_read(fe_recorder *recorder, unsigned char *out, int64_t capacity, int64_t *out_size);
fe_result fe__recorder_note(fe_recorder *recorder, fe_handle about, const char *text);

#endif
