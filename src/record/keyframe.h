// keyframe.h - the whole state in a recording, and the assets that it and the calls rest on.
#ifndef FE_RECORD_KEYFRAME_H
#define FE_RECORD_KEYFRAME_H
#include "record/recorder.h"

// FE__CHUNK_JUMP: the world became this
void fe__record_keyframe(fe_recorder *recorder, uint32_t flags);
void fe__record_jump(fe_recorder *recorder);
// Of a step that was noted: is a keyframe due?
void fe__record_due_keyframe(fe_recorder *recorder);
// A shape is given a form of an asset
void fe__record_form(fe_recorder *recorder, const fe__form *form);
// Edits, under the store's lock: of every world that uses the asset, after the edit
void fe__record_heights(fe_store *store, int32_t asset, int32_t row, int32_t column, int32_t rows, int32_t columns,
                        const float *heights);
void fe__record_materials(fe_store *store, int32_t asset);

#endif
