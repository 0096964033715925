// fields.c - see fields.h.
#include "api/fields.h"

#include <stddef.h>

#define END_OF(field) (uint16_t)(offsetof(THIS, field) + sizeof(((THIS *)0)->field)),
#define SIZE_OF(field) +sizeof(((THIS *)0)->field)

// Pointers of 4 bytes may leave a gap before a field of 8
#define HAS_NO_PADDING(type) (sizeof(void *) < 8 || sizeof(type) == 0 FE_FIELDS_##type(SIZE_OF))

#define DEFINE(type)                                                                                       \
    static const uint16_t ends_of_##type[] = {FE_FIELDS_##type(END_OF)};                                   \
    _Static_assert(HAS_NO_PADDING(type), "a field of " #type " is missing in fields.h");                   \
    const fe__fields fe__fields_of_##type = {sizeof(type), sizeof ends_of_##type / sizeof *ends_of_##type, \
                                             ends_of_##type};

#define THIS fe_allocator
DEFINE(fe_allocator)
#undef THIS
#define THIS fe_store_def
DEFINE(fe_store_def)
#undef THIS
#define THIS fe_heightfield_def
DEFINE(fe_heightfield_def)
#undef THIS
#define THIS fe_hull_def
DEFINE(fe_hull_def)
#undef THIS
#define THIS fe_hull_info
DEFINE(fe_hull_info)
#undef THIS
#define THIS fe_mesh_def
DEFINE(fe_mesh_def)
#undef THIS
#define THIS fe_mesh_info
DEFINE(fe_mesh_info)
#undef THIS
#define THIS fe_mesh_triangle
DEFINE(fe_mesh_triangle)
#undef THIS
#define THIS fe_compound_part
DEFINE(fe_compound_part)
#undef THIS
#define THIS fe_compound_info
DEFINE(fe_compound_info)
#undef THIS
#define THIS fe_task_system
DEFINE(fe_task_system)
#undef THIS
#define THIS fe_world_def
DEFINE(fe_world_def)
#undef THIS
#define THIS fe_world_tuning
DEFINE(fe_world_tuning)
#undef THIS
#define THIS fe_profile
DEFINE(fe_profile)
#undef THIS
#define THIS fe_counters
DEFINE(fe_counters)
#undef THIS
#define THIS fe_energy
DEFINE(fe_energy)
#undef THIS
#define THIS fe_body_def
DEFINE(fe_body_def)
#undef THIS
#define THIS fe_mass_data
DEFINE(fe_mass_data)
#undef THIS
#define THIS fe_geometry
DEFINE(fe_geometry)
#undef THIS
#define THIS fe_shape_def
DEFINE(fe_shape_def)
#undef THIS
#define THIS fe_joint_def
DEFINE(fe_joint_def)
#undef THIS
#define THIS fe_distance_joint_def
DEFINE(fe_distance_joint_def)
#undef THIS
#define THIS fe_ball_joint_def
DEFINE(fe_ball_joint_def)
#undef THIS
#define THIS fe_hinge_joint_def
DEFINE(fe_hinge_joint_def)
#undef THIS
#define THIS fe_fixed_joint_def
DEFINE(fe_fixed_joint_def)
#undef THIS
#define THIS fe_configurable_joint_def
DEFINE(fe_configurable_joint_def)
#undef THIS
#define THIS fe_joint_state
DEFINE(fe_joint_state)
#undef THIS
#define THIS fe_query_filter
DEFINE(fe_query_filter)
#undef THIS
#define THIS fe_save_options
DEFINE(fe_save_options)
#undef THIS
#define THIS fe_restore_options
DEFINE(fe_restore_options)
#undef THIS
#define THIS fe_snapshot_info
DEFINE(fe_snapshot_info)
#undef THIS
#define THIS fe_difference
DEFINE(fe_difference)
#undef THIS
#define THIS fe_history_def
DEFINE(fe_history_def)
#undef THIS
#define THIS fe_batch_def
DEFINE(fe_batch_def)
#undef THIS
#define THIS fe_array
DEFINE(fe_array)
#undef THIS
#define THIS fe_draw_options
DEFINE(fe_draw_options)
#undef THIS
#define THIS fe_recorder_def
DEFINE(fe_recorder_def)
#undef THIS
#define THIS fe_player_def
DEFINE(fe_player_def)
#undef THIS
#define THIS fe_player_info
DEFINE(fe_player_info)
#undef THIS
#define THIS fe_divergence
DEFINE(fe_divergence)
#undef THIS
