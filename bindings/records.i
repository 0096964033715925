// Structs that Python and Lua have as objects with the header's fields: made with their defaults, and by functions that give one.

%define FE_RECORD(TYPE, FILL)
%extend TYPE {
    TYPE()
    {
        TYPE *made = calloc(1, sizeof *made);
        if (made) FILL;
        return made;
    }
}
%enddef
%define FE_SIZED(TYPE) FE_RECORD(TYPE, made->struct_size = (uint32_t)sizeof *made) %enddef
%define FE_DEF(TYPE) FE_RECORD(TYPE, TYPE##_init(made, (uint32_t)sizeof *made)) %enddef
FE_DEF(fe_world_def)
FE_DEF(fe_world_tuning)
FE_DEF(fe_body_def)
FE_DEF(fe_shape_def)
FE_DEF(fe_distance_joint_def)
FE_DEF(fe_ball_joint_def)
FE_DEF(fe_hinge_joint_def)
FE_DEF(fe_fixed_joint_def)
FE_DEF(fe_configurable_joint_def)
FE_SIZED(fe_joint_def)
FE_SIZED(fe_mass_data)
FE_SIZED(fe_geometry)
// A def's own init writes as much as the object holds.
%typemap(in, numinputs=0) uint32_t struct_size "$1 = 0;"
%typemap(check) uint32_t struct_size "$1 = arg1 ? (uint32_t)sizeof *arg1 : 0;"
%immutable struct_size;

%ignore fe_configurable_joint_def::axes;
%extend fe_configurable_joint_def {
    /// The axis of a coordinate: lives as long as this object.
    fe_joint_axis *axis(int32_t coordinate) { return coordinate < 0 || coordinate > 5 ? NULL : &$self->axes[coordinate]; }
}

// Each language says what becomes of SWIGTYPE *OUT_RECORD.
%define FE_OUT_RECORD(TYPE, PARAMETER) %apply SWIGTYPE *OUT_RECORD { TYPE *PARAMETER }; %enddef
%define FE_OUT_RECORDS
FE_OUT_RECORD(fe_world_tuning, out_tuning)
FE_OUT_RECORD(fe_profile, out_profile)
FE_OUT_RECORD(fe_counters, out_counters)
FE_OUT_RECORD(fe_mass_data, out_data)
FE_OUT_RECORD(fe_joint_def, out_desc)
FE_OUT_RECORD(fe_distance_joint_def, out_desc)
FE_OUT_RECORD(fe_ball_joint_def, out_desc)
FE_OUT_RECORD(fe_hinge_joint_def, out_desc)
FE_OUT_RECORD(fe_fixed_joint_def, out_desc)
FE_OUT_RECORD(fe_configurable_joint_def, out_desc)
FE_OUT_RECORD(fe_joint_state, out_state)
FE_OUT_RECORD(fe_hit, out_hit)
FE_OUT_RECORD(fe_closest, out_closest)
FE_OUT_RECORD(fe_geometry, out_geometry)
%enddef
