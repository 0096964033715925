// sound.h - forms as numbers, and forms that come from bytes.
#ifndef FE_COLLISION_FORM_SOUND_H
#define FE_COLLISION_FORM_SOUND_H
#include "collision/form/form.h"

// What is no asset's of a form: all there is of one without an asset, and the kind alone of another
typedef struct fe__form_numbers {
    int32_t kind; // fe__form_type
    float radius, half_height, distance;
    fe_vec3 half, normal;
} fe__form_numbers;
fe__form_numbers fe__numbers_of_form(const fe__form *form);
fe__form fe__form_of_numbers(const fe__form_numbers *numbers);

// Is it one that the API could have made, of those without an asset?
int32_t fe__form_is_sound(const fe__form *form);
static inline int32_t fe__forms_are_alike(const fe__form *a, const fe__form *b)
{
    return a->type == b->type;
} // in kind
// Have they the same kind and the same numbers, or the same asset?
int32_t fe__forms_are_same(const fe__form *a, const fe__form *b);

#endif
