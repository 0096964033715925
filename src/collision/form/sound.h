// sound.h - forms that come from bytes.
#ifndef FE_COLLISION_FORM_SOUND_H
#define FE_COLLISION_FORM_SOUND_H
#include "collision/form/form.h"

// Is it one that the API could have made, of those without an asset?
int32_t fe__form_is_sound(const fe__form *form);
// Have they the same kind and the same numbers, or the same asset?
int32_t fe__forms_are_same(const fe__form *a, const fe__form *b);

#endif
