// fe_joint_def.h - definitions of joints, by type: defaults, checks, between the caller's structs and the world's.
#ifndef FE_API_FE_JOINT_DEF_H
#define FE_API_FE_JOINT_DEF_H
#include "api/check.h"
#include "world/joint.h"

// The defaults of a type; struct_size is that of its definition
void fe__joint_defaults(int32_t type, fe__joint_any *out_def);
// What a definition of that type says, but for its bodies and its struct_size
fe_result fe__check_joint_def(const char *function, int32_t type, const fe__joint_any *full);
fe_result fe__check_joint_common(const char *function, const fe_joint_def *full);

// The bodies of a joint's ends; -1 is the world, which one of them may be
fe_result fe__find_joint_ends(const char *function, const fe_world *world, fe_body body_a, fe_body body_b,
                              int32_t *out_bodies);
// Makes the joint what a checked definition says (fe_joint.c)
fe_result fe__change_joint(const char *function, fe_world *world, int32_t index, const fe__joint_any *full);
// Of the definition of a type
const fe__fields *fe__joint_fields(int32_t type);

#endif
