// compound.h - the parts of a compound. The record is an asset of the store. A shape with a compound owns a shape for
// each part (world/shape.h), and these collide: nothing collides with a compound as such.
#ifndef FE_COLLISION_FORM_COMPOUND_H
#define FE_COLLISION_FORM_COMPOUND_H
#include "collision/form/form.h"

// A part's number + 1 has 16 bits in a shape's serial; 0 there says that the shape is no part (form.h).
enum { FE__MOST_PARTS = 65535 };

typedef struct fe__compound_part {
    fe__form form; // The compound keeps the record of the form's asset alive.
    fe_vec3 position;
    fe_quat rotation;
    float density;        // kg/m3; below 0: the shape's density counts
    int32_t own_material; // 0: the shape's material counts
    fe_material material;
    uint64_t user_data;
} fe__compound_part;

typedef struct fe__compound {
    fe__compound_part *parts;
    int32_t count;
} fe__compound;

static inline fe__form fe__compound_form(int32_t asset)
{
    return (fe__form){.type = FE__FORM_COMPOUND, .field = asset};
}

#endif
