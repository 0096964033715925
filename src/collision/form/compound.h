// compound.h - what a compound is made of. It lives in the store; a shape that has it owns a shape for each part
// (world/shape.h), so that nothing collides with a compound as such.
#ifndef FE_COLLISION_FORM_COMPOUND_H
#define FE_COLLISION_FORM_COMPOUND_H
#include "collision/form/form.h"

// A part's number has 16 bits, of which 0 says that a shape is none (form.h)
enum { FE__MOST_PARTS = 65535 };

typedef struct fe__compound_part {
    fe__form form; // of one with an asset: the compound keeps the record alive
    fe_vec3 position;
    fe_quat rotation;
    float density;        // kg/m3; below 0: the shape's
    int32_t own_material; // 0: the shape's
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
