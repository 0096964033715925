// Structs that Python and Lua have as objects with the header's fields: made with their defaults, and by functions that
// return one.

%define FE_RECORD(TYPE)
%extend TYPE {
    TYPE()
    {
        TYPE *made = calloc(1, sizeof *made);
        if (made) TYPE##_init(made, (uint32_t)sizeof *made);
        return made;
    }
}
%enddef
FE_RECORD(fe_world_def)
FE_RECORD(fe_store_def)
FE_RECORD(fe_world_tuning)
FE_RECORD(fe_body_def)
FE_RECORD(fe_shape_def)
FE_RECORD(fe_joint_def)
FE_RECORD(fe_distance_joint_def)
FE_RECORD(fe_ball_joint_def)
FE_RECORD(fe_hinge_joint_def)
FE_RECORD(fe_fixed_joint_def)
FE_RECORD(fe_configurable_joint_def)
FE_RECORD(fe_mass_data)
FE_RECORD(fe_geometry)
FE_RECORD(fe_compound_part)
FE_RECORD(fe_draw_options)
FE_RECORD(fe_save_options)
FE_RECORD(fe_restore_options)
// The bytes belong to the caller, who keeps them until the call that reads the record.
%define FE_BASE(TYPE)
%ignore TYPE::base;
%ignore TYPE::base_size;
%extend TYPE {
    /// The snapshot that a difference is to.
    void set_base(const void *bytes, int64_t size) { $self->base = bytes, $self->base_size = size; }
}
%enddef
FE_BASE(fe_save_options)
FE_BASE(fe_restore_options)
FE_RECORD(fe_history_def)
FE_RECORD(fe_recorder_def)
FE_RECORD(fe_player_def)
// A definition's own init writes as much as the object holds.
%typemap(in, numinputs=0) uint32_t struct_size "$1 = 0;"
%typemap(check) uint32_t struct_size "$1 = arg1 ? (uint32_t)sizeof *arg1 : 0;"
%immutable struct_size;

%ignore fe_configurable_joint_def::axes;
%extend fe_configurable_joint_def {
    /// The axis of a degree of freedom (fe_dof). It lives as long as this object.
    fe_joint_axis *axis(int32_t dof) { return dof < 0 || dof > 5 ? NULL : &$self->axes[dof]; }
}

// Each language states what SWIGTYPE *OUT_RECORD becomes: a record that a function with an fe_result fills.
%define FE_OUT_RECORD(TYPE, PARAMETER) %apply SWIGTYPE *OUT_RECORD { TYPE *PARAMETER }; %enddef
%define FE_OUT_RECORDS
FE_OUT_RECORD(fe_world_tuning, out_tuning)
FE_OUT_RECORD(fe_profile, out_profile)
FE_OUT_RECORD(fe_counters, out_counters)
FE_OUT_RECORD(fe_energy, out_energy)
FE_OUT_RECORD(fe_hull_info, out_info)
FE_OUT_RECORD(fe_mesh_info, out_info)
FE_OUT_RECORD(fe_compound_info, out_info)
FE_OUT_RECORD(fe_compound_part, out_part)
FE_OUT_RECORD(fe_mesh_triangle, out_triangle)
FE_OUT_RECORD(fe_mass_data, out_data)
FE_OUT_RECORD(fe_geometry, out_geometry)
FE_OUT_RECORD(fe_joint_def, out_def)
FE_OUT_RECORD(fe_distance_joint_def, out_def)
FE_OUT_RECORD(fe_ball_joint_def, out_def)
FE_OUT_RECORD(fe_hinge_joint_def, out_def)
FE_OUT_RECORD(fe_fixed_joint_def, out_def)
FE_OUT_RECORD(fe_configurable_joint_def, out_def)
FE_OUT_RECORD(fe_joint_state, out_state)
FE_OUT_RECORD(fe_snapshot_info, out_info)
FE_OUT_RECORD(fe_player_info, out_info)
%enddef

// Likewise SWIGTYPE *OUT_HIT: a record that a query fills when it returns 1, and that is nothing when it returns 0. The
// count of these queries is FE_FOUND's, that of the `_any` queries, which is true or false, FE_ANY's.
%define FE_OUT_HITS
%apply SWIGTYPE *OUT_HIT { fe_hit *out_hit };
%apply SWIGTYPE *OUT_HIT { fe_closest *out_closest };
%apply SWIGTYPE *OUT_HIT { fe_difference *out_difference };
%enddef
#define FE_FOUND int32_t fe_world_raycast, int32_t fe_world_sweep, int32_t fe_world_sweep_turning, \
    int32_t fe_world_closest_point, \
    int32_t fe_shape_raycast, int32_t fe_body_raycast, int32_t fe_shape_closest_point, int32_t fe_body_closest_point, \
    int32_t fe_snapshot_compare
#define FE_ANY int32_t fe_world_raycast_any, int32_t fe_world_sweep_any, int32_t fe_world_sweep_turning_any, \
    int32_t fe_world_overlap_any
