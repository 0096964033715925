// field.h - what of a body, a joint or a world goes into an array, and comes out of one: rows of numbers.
#ifndef FE_BATCH_FIELD_H
#define FE_BATCH_FIELD_H
#include "world/world.h"

enum { FE__MOST_COMPONENTS = 7 }; // of a row

// What poses and velocities are read in
typedef struct fe__field_frame {
    fe_dvec3 origin;
    fe_quat rotation;
} fe__field_frame;

typedef struct fe__batch_field {
    int32_t components; // numbers in a row
    int32_t kind;       // FE_KIND_BODY, FE_KIND_SHAPE, FE_KIND_JOINT; 0: the world itself
    // NULL: it is not read
    void (*read)(const fe_world *world, int32_t item, const fe__field_frame *frame, double *out);
    // May a row be written? FE_ERROR_ARGUMENT: a number is out of range or NaN; FE_ERROR_STATE: the item has no such
    // thing. NULL: the field is not written
    fe_result (*takes)(const fe_world *world, int32_t item, const double *row);
    fe_result (*write)(fe_world *world, int32_t item, const double *row); // one that may be; FE_ERROR_MEMORY
    int32_t is_of_a_step;                                                 // 1: what is written acts for one step
} fe__batch_field;

const fe__batch_field *fe__field_of(int32_t field);                    // fe_field; NULL: there is none
const fe__id_pool *fe__field_ids(const fe_world *world, int32_t kind); // not of the world itself
// The record that a handle names, and of what kind it must be. FE_ERROR_STALE, FE_ERROR_KIND
fe_result fe__field_find(const fe_world *world, const fe__batch_field *field, fe_handle item, int32_t *out_index);

// A force acts for one step. One that fails leaves it on the body, so what was there before is kept.
typedef struct fe__kept_force {
    int32_t body;
    float force[3], torque[3];
} fe__kept_force;

int32_t fe__field_pushed(const fe__batch_field *field); // bodies that a row of a field of a step pushes, at most
// Of the bodies that the row of an item pushes. Returns how many
int32_t fe__field_keep_forces(const fe_world *world, const fe__batch_field *field, int32_t index, fe__kept_force *out);
void fe__field_put_back(fe_world *world, const fe__kept_force *kept);

#endif
