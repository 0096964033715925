// What feather.h's types become in Lua. Vectors go in as tables {x, y, z} and come out as values; definitions and
// results are objects with the header's fields; arrays are flat tables of numbers; handles are integers below 2^53;
// errors are Lua errors with the library's sentence. lua/feather/ffi.lua does the same for LuaJIT. One C module for
// each Lua is made from this one source.
%{
#include "rows.h"

#include "lua/arrays.h"
#include "lua/assets.h"
#include "lua/batch.h"
#include "lua/boxes.h"
#include "lua/errors.h"
#include "lua/objects.h"
#include "lua/pair_filter.h"
#include "lua/player.h"
#include "lua/values.h"
%}
%init %{
    add_types(L);
    add_type(L, batch_type, collect_batch);
    add_type(L, player_type, collect_player);
    hide_helpers(L, &swig_module);
%}
%native(hide_lines) int hide_lines(lua_State *L);
%typemap(out) SWIGTYPE * %{
    SWIG_NewPointerObj(L, $1, $1_descriptor, $owner);
    SWIG_arg++;
    keep_alive(L, 1);
%}
%include "records.i"

// ---- worlds, pools and stores ---------------------------------------------------------------------------------------

%typemap(in) fe_world * (call_state call) "$1 = to_world(L, $input); call = (call_state){0};"
%typemap(in) const fe_world * = fe_world *;
// again, when all arguments are converted: a filter's __index may have destroyed the world
%typemap(check) fe_world *, const fe_world * "$1 = check_world(L, lua_touserdata(L, 1));"
%typemap(argout) fe_world *world %{
    if (result == FE_OK && strcmp("$symname", "world_destroy") == 0) ((world_box *)lua_touserdata(L, 1))->world = NULL;
%}
%typemap(argout) const fe_world * ""
%typemap(in, numinputs=0) fe_world **out_world (fe_world *made = 0) "$1 = &made;"
// a clone's definition is behind its source
%typemap(argout) fe_world **out_world %{
    push_world(L, *$1, strcmp("$symname", "world_clone") == 0 ? 2 : 1);
    SWIG_arg++;
%}
%exception fe_world_step %{ result = step(L, arg1, arg2); %}

%typemap(in) (fe_pair_filter filter, void *user) "$1 = to_pair_filter(L, $input); $2 = lua_touserdata(L, 1);"
%typemap(argout) (fe_pair_filter filter, void *user) "keep_pair_filter(L);"
%ignore fe_filter_pair;

%typemap(in, numinputs=0) fe_pool **out_pool (fe_pool *made = 0) "$1 = &made;"
%typemap(argout) fe_pool **out_pool %{ push_pool(L, *$1); SWIG_arg++; %}
%typemap(in) fe_pool *pool "$1 = to_pool(L, $input);"
%typemap(argout) fe_pool *pool %{
    if (strcmp("$symname", "pool_destroy") == 0) {
        ((pool_box *)lua_touserdata(L, 1))->pool = NULL;
    } else { // of a world's definition
        lua_pushvalue(L, 2);
        keep_as(L, 1, "pool");
        lua_pop(L, 1);
    }
%}
%typemap(out) fe_pool *, fe_store * "lua_pushnil(L); SWIG_arg++;"

%typemap(in, numinputs=0) fe_store **out_store (fe_store *made = 0) "$1 = &made;"
%typemap(argout) fe_store **out_store %{
    push_store(L, *$1, strcmp("$symname", "world_get_store") == 0 ? 1 : 0);
    SWIG_arg++;
%}
%typemap(in) fe_store * (call_state call) "$1 = to_store(L, $input); call = (call_state){0}; (void)call;"
%typemap(in) const fe_store * = fe_store *;
%typemap(check) fe_store *, const fe_store * "$1 = to_store(L, $argnum);"
%typemap(argout) fe_store *store %{
    if (strcmp("$symname", "store_destroy") == 0) {
        ((store_box *)lua_touserdata(L, 1))->store = NULL;
    } else if (strcmp("$symname", "world_def_store_set") == 0) {
        lua_pushvalue(L, 2);
        keep_as(L, 1, "store");
        lua_pop(L, 1);
    }
%}
%typemap(argout) const fe_store * ""

%typemap(in, numinputs=0) fe_history **out_history (fe_history *made = 0) "$1 = &made;"
%typemap(argout) fe_history **out_history %{ push_history(L, *$1); SWIG_arg++; %}
%typemap(in) fe_history * (call_state call) "$1 = to_history(L, $input); call = (call_state){0}; (void)call;"
%typemap(in) const fe_history * = fe_history *;
%typemap(check) fe_history *, const fe_history * "$1 = to_history(L, $argnum);"
%typemap(argout) fe_history *history %{
    if (strcmp("$symname", "history_destroy") == 0) ((history_box *)lua_touserdata(L, 1))->history = NULL;
%}
%typemap(argout) const fe_history * ""

%typemap(in, numinputs=0) const fe_allocator *allocator "$1 = NULL;"
%typemap(in, numinputs=0) fe_state **out_state (fe_state *made = 0) "$1 = &made;"
%typemap(argout) fe_state **out_state %{ push_state(L, *$1); SWIG_arg++; %}
%typemap(in) fe_state * "$1 = to_state(L, $input);"
%typemap(in) const fe_state * = fe_state *;
%typemap(check) fe_state *, const fe_state * "$1 = to_state(L, $argnum);"
%typemap(argout) fe_state *state %{ ((state_box *)lua_touserdata(L, 1))->state = NULL; %}
%typemap(argout) const fe_state * ""

%typemap(in, numinputs=0) fe_recorder **out_recorder (fe_recorder *made = 0) "$1 = &made;"
%typemap(argout) fe_recorder **out_recorder %{ push_recorder(L, *$1); SWIG_arg++; %}
%typemap(in) fe_recorder * (call_state call) "$1 = to_recorder(L, $input); call = (call_state){0}; (void)call;"
%typemap(check) fe_recorder * "$1 = to_recorder(L, $argnum);"
%typemap(argout) fe_recorder *recorder %{
    if (strcmp("$symname", "recorder_destroy") == 0) ((recorder_box *)lua_touserdata(L, 1))->recorder = NULL;
%}
%typemap(in) const char *text "$1 = (char *)to_text(L, $input, \"$1_name\");"
%native(batch_create) int batch_create(lua_State *L);
%native(batch_destroy) int batch_destroy(lua_State *L);
%native(batch_step) int batch_step(lua_State *L);
%native(batch_reset) int batch_reset(lua_State *L);
%native(batch_read) int batch_read(lua_State *L);
%native(batch_write) int batch_write(lua_State *L);
%native(batch_hash) int batch_hash(lua_State *L);

%native(player_create) int player_create(lua_State *L);
%native(player_destroy) int player_destroy(lua_State *L);
%native(player_feed) int player_feed(lua_State *L);
%native(player_step) int player_step(lua_State *L);
%native(player_seek) int player_seek(lua_State *L);
%native(player_get_world) int player_get_world(lua_State *L);
%native(player_release) int player_release(lua_State *L);
%native(player_get_info) int player_get_info(lua_State *L);
%native(player_get_notes) int player_get_notes(lua_State *L);
%native(player_get_divergence) int player_get_divergence(lua_State *L);

%native(recorder_read) int recorder_read(lua_State *L);
%ignore fe_recorder_read;

// ---- results and numbers --------------------------------------------------------------------------------------------

%typemap(out) fe_result %{
    if ($1 < 0) raise_last(L);
%}
// counts; a field that is read may be negative
%typemap(out) int32_t %{
    if ($1 < 0 && !ends_with("$symname", "_get")) raise_last(L);
    push_integer(L, (long long)$1);
    SWIG_arg++;
%}
%typemap(out) FE_ANY %{
    if ($1 < 0) raise_last(L);
    lua_pushboolean(L, $1 > 0);
    SWIG_arg++;
%}
%typemap(out) FE_FOUND %{
    if ($1 < 0) raise_last(L);
%}
%typemap(out) uint32_t, int64_t, fe_handle %{ push_integer(L, (long long)$1); SWIG_arg++; %}
%typemap(out) uint64_t %{ push_u64(L, $1); SWIG_arg++; %}
%typemap(in) int32_t "$1 = (int32_t)to_integer(L, $input, INT32_MIN, INT32_MAX, \"$1_name\");"
%typemap(in) uint32_t "$1 = (uint32_t)to_integer(L, $input, 0, UINT32_MAX, \"$1_name\");"
%typemap(in) fe_handle "$1 = (fe_handle)to_integer(L, $input, 0, 1LL << 53, \"$1_name\");"
%typemap(in) int64_t "$1 = to_integer(L, $input, -(1LL << 53), 1LL << 53, \"$1_name\");"
%typemap(in) uint64_t "$1 = to_u64(L, $input, \"$1_name\");"
%typemap(in) float "$1 = (float)to_number(L, $input, \"$1_name\");"
%typemap(in) double "$1 = to_number(L, $input, \"$1_name\");"

%define FE_OUT(TYPE, PUSH)
%typemap(in, numinputs=0) TYPE ($*1_ltype value) "$1 = &value;"
%typemap(argout) TYPE { PUSH; }
%enddef
FE_OUT(fe_handle *, push_integer(L, (long long)*$1); SWIG_arg++)
FE_OUT(int32_t *, push_integer(L, (long long)*$1); SWIG_arg++)
FE_OUT(uint32_t *, push_integer(L, (long long)*$1); SWIG_arg++)
FE_OUT(int64_t *, push_integer(L, (long long)*$1); SWIG_arg++)
FE_OUT(uint64_t *, push_u64(L, *$1); SWIG_arg++)
FE_OUT(float *, lua_pushnumber(L, (lua_Number)*$1); SWIG_arg++)
%typemap(in, numinputs=0) uint32_t *out_words (uint32_t words[2]) "$1 = words;"
%typemap(argout) uint32_t *out_words %{ push_words(L, $1); SWIG_arg++; %}

%typemap(in) const fe_vec3 * (fe_vec3 value) "to_vec3(L, $input, &value, \"$1_name\"); $1 = &value;"
%typemap(in) const fe_vec3 *direction (fe_vec3 value) %{
    $1 = NULL;
    if (!lua_isnoneornil(L, $input)) to_vec3(L, $input, &value, "$1_name"), $1 = &value;
%}
%typemap(in) const fe_dvec3 * (fe_dvec3 value) "to_dvec3(L, $input, &value, \"$1_name\"); $1 = &value;"
%typemap(in) const fe_quat * (fe_quat value) "to_quat(L, $input, &value, \"$1_name\"); $1 = &value;"
%typemap(in) const fe_transform * (fe_transform value) "to_transform(L, $input, &value, \"$1_name\"); $1 = &value;"
%typemap(in) const fe_frame * (fe_frame value) "to_frame(L, $input, &value, \"$1_name\"); $1 = &value;"
%typemap(in) const fe_bounds * (fe_bounds value) "to_bounds(L, $input, &value, \"$1_name\"); $1 = &value;"
%typemap(in) const fe_material * (fe_material value) "to_material(L, $input, &value, \"$1_name\"); $1 = &value;"
FE_OUT(fe_vec3 *out_gravity, SWIG_arg += push_vec3(L, $1))
FE_OUT(fe_vec3 *out_velocity, SWIG_arg += push_vec3(L, $1))
FE_OUT(fe_vec3 *out_direction, SWIG_arg += push_vec3(L, $1))
FE_OUT(fe_vec3 *out_force, SWIG_arg += push_vec3(L, $1))
FE_OUT(fe_vec3 *out_torque, SWIG_arg += push_vec3(L, $1))
FE_OUT(fe_dvec3 *out_position, SWIG_arg += push_dvec3(L, $1))
FE_OUT(fe_dvec3 *out_centre, SWIG_arg += push_dvec3(L, $1))
FE_OUT(fe_dvec3 *out_linear, SWIG_arg += push_dvec3(L, $1))
FE_OUT(fe_dvec3 *out_angular, SWIG_arg += push_dvec3(L, $1))
FE_OUT(fe_quat *out_rotation, SWIG_arg += push_quat(L, $1))
FE_OUT(fe_transform *out_transform, SWIG_arg += push_transform(L, $1))
FE_OUT(fe_transform *out_frame_a, SWIG_arg += push_transform(L, $1))
FE_OUT(fe_transform *out_frame_b, SWIG_arg += push_transform(L, $1))
FE_OUT(fe_frame *out_frame, SWIG_arg += push_frame(L, $1))
FE_OUT(fe_bounds *out_bounds, SWIG_arg += push_bounds(L, $1))
FE_OUT(fe_material *out_material, SWIG_arg += push_material(L, $1))

// of a triangle of a mesh: tables
%typemap(out) fe_vec3 corners[3] "push_vertices(L, $1, 3); SWIG_arg++;"
%typemap(out) uint32_t edges[3] "push_corners(L, (const int32_t *)$1, 3); SWIG_arg++;"

// ---- records --------------------------------------------------------------------------------------------------------

%typemap(in, numinputs=0) SWIGTYPE *OUT_RECORD "$1 = NULL;"
%typemap(check) SWIGTYPE *OUT_RECORD {
    $1 = ($1_ltype)calloc(1, sizeof *$1);
    if (!$1) fail(L, "feather: out of memory");
    *(uint32_t *)(void *)$1 = (uint32_t)sizeof *$1;
    SWIG_NewPointerObj(L, $1, $1_descriptor, 1);
    call_record = lua_gettop(L);
}
%typemap(argout) SWIGTYPE *OUT_RECORD %{ lua_pushvalue(L, call_record); SWIG_arg++; %}
%typemap(arginit) SWIGTYPE *OUT_RECORD "int call_record = 0;"
FE_OUT_RECORDS
// a query's record: its values, or nil on a miss
%typemap(in, numinputs=0) fe_hit *out_hit (fe_hit value) "$1 = &value;"
%typemap(in, numinputs=0) fe_closest *out_closest (fe_closest value) "$1 = &value;"
%typemap(argout) fe_hit *out_hit { SWIG_arg += result > 0 ? push_hit(L, $1) : push_nil(L); }
%typemap(argout) fe_closest *out_closest { SWIG_arg += result > 0 ? push_closest(L, $1) : push_nil(L); }
%apply SWIGTYPE *OUT_RECORD { fe_difference *out_difference };
%typemap(argout) fe_difference *out_difference %{
    if (result > 0) lua_pushvalue(L, call_record);
    else lua_pushnil(L);
    SWIG_arg++;
%}

// ---- arrays ---------------------------------------------------------------------------------------------------------

%typemap(in) const fe_handle * "$1 = to_handles(L, $input, &call1, \"$1_name\");"
%typemap(in) const float *floats "$1 = to_floats(L, $input, 6, &call1, \"$1_name\");"
%typemap(in) const float *values "$1 = to_floats(L, $input, 1, &call1, \"$1_name\");"
%typemap(in) const float *heights "$1 = to_floats(L, $input, 1, &call1, \"$1_name\");"
%typemap(check) const float *heights "heights_fit(L, call1.count, arg5, arg6);"
%typemap(in) const fe_transform *transforms "$1 = to_transforms(L, $input, &call1, \"$1_name\");"
%typemap(in) const fe_ray *rays "$1 = to_rays(L, $input, &call1, \"$1_name\");"
%typemap(in) const fe_path *paths "$1 = to_paths(L, $input, &call1, \"$1_name\");"
%typemap(in, numinputs=0) int32_t count, int32_t capacity, uint32_t stride "$1 = 0;"
%typemap(in, numinputs=0) uint32_t ray_stride "$1 = (uint32_t)sizeof(fe_ray);"
%typemap(in, numinputs=0) uint32_t path_stride "$1 = (uint32_t)sizeof(fe_path);"
%typemap(check) int32_t count "$1 = call1.count;"

%typemap(argout) const fe_handle *, const float * ""

// one record for each that goes in; of these, hits may grow and have their stride stated
%typemap(in, numinputs=0) float *out_floats, fe_transform *out_transforms, fe_hit *out_hits,
    float *out_heights "$1 = NULL;"
%typemap(check) float *out_floats "$1 = ($1_ltype)new_array(L, call1.count, 7 * sizeof *$1);"
%typemap(check) fe_transform *out_transforms "$1 = ($1_ltype)new_array(L, call1.count, sizeof *$1);"
%typemap(check) fe_hit *out_hits "$1 = ($1_ltype)new_array(L, call1.count, sizeof *$1);"
%typemap(check) float *out_heights "$1 = ($1_ltype)new_heights(L, arg5, arg6);"
%typemap(argout) float *out_floats {
    push_floats(L, $1, call1.count * floats_of("$symname"));
    SWIG_arg++;
}
%typemap(argout) float *out_heights { push_floats(L, $1, arg5 * arg6); SWIG_arg++; }
%exception fe_world_raycast_many {
    arg8 = (uint32_t)sizeof(fe_hit);
    $action
}
%exception fe_world_sweep_many {
    arg9 = (uint32_t)sizeof(fe_hit);
    $action
}

// all there are: asked for their number first
%typemap(in, numinputs=0) fe_handle *out_bodies, fe_handle *out_shapes, fe_handle *out_joints, fe_overlap *out_overlaps,
    fe_pair_event *out_events, fe_body_event *out_events, fe_hit_event *out_events, fe_joint_event *out_events,
    fe_contact *out_contacts, fe_draw_vertex *out_vertices, fe_draw_instance *out_instances, fe_vec3 *out_vertices,
    fe_hull_face *out_faces, int32_t *out_corners, fe_history_frame *out_frames "$1 = NULL;"
%define FE_ALL(FUNCTION, OUT, STATE_STRIDE, CAPACITY)
%exception FUNCTION {
    $action
    if (result > 0) {
        OUT = new_array(L, result, sizeof *OUT);
        STATE_STRIDE;
        CAPACITY = result;
        $action
    }
}
%enddef
%define FE_ALL_HANDLES(FUNCTION, OUT, CAPACITY) FE_ALL(FUNCTION, OUT, (void)0, CAPACITY) %enddef
%define FE_ALL_RECORDS(FUNCTION, OUT, STRIDE, CAPACITY)
FE_ALL(FUNCTION, OUT, STRIDE = (uint32_t)sizeof *OUT, CAPACITY)
%enddef
FE_ALL_HANDLES(fe_world_get_bodies, arg2, arg3)
FE_ALL_HANDLES(fe_world_get_joints, arg2, arg3)
FE_ALL_HANDLES(fe_body_get_shapes, arg3, arg4)
FE_ALL_HANDLES(fe_body_get_joints, arg3, arg4)
FE_ALL_HANDLES(fe_shape_get_overlaps, arg3, arg4)
FE_ALL_HANDLES(fe_world_overlap, arg5, arg6)
FE_ALL_HANDLES(fe_world_overlap_bounds, arg4, arg5)
FE_ALL_RECORDS(fe_hull_get_vertices, arg3, arg4, arg5)
FE_ALL_RECORDS(fe_hull_get_faces, arg3, arg4, arg5)
FE_ALL_RECORDS(fe_hull_get_corners, arg3, arg4, arg5)
FE_ALL_RECORDS(fe_history_get_frames, arg2, arg3, arg4)
FE_ALL_RECORDS(fe_world_overlap_shapes, arg5, arg6, arg7)
FE_ALL_RECORDS(fe_world_raycast_all, arg5, arg6, arg7)
FE_ALL_RECORDS(fe_world_sweep_all, arg6, arg7, arg8)
FE_ALL_RECORDS(fe_world_sweep_turning_all, arg7, arg8, arg9)
FE_ALL_RECORDS(fe_world_get_pair_events, arg2, arg3, arg4)
FE_ALL_RECORDS(fe_world_get_body_events, arg2, arg3, arg4)
FE_ALL_RECORDS(fe_world_get_hit_events, arg2, arg3, arg4)
FE_ALL_RECORDS(fe_world_get_joint_events, arg2, arg3, arg4)
FE_ALL_RECORDS(fe_body_get_contacts, arg3, arg4, arg5)
FE_ALL_RECORDS(fe_shape_get_contacts, arg3, arg4, arg5)
FE_ALL_RECORDS(fe_world_draw_lines, arg3, arg4, arg5)
FE_ALL_RECORDS(fe_world_draw_triangles, arg3, arg4, arg5)
FE_ALL_RECORDS(fe_world_draw_points, arg3, arg4, arg5)
FE_ALL_RECORDS(fe_world_draw_instances, arg3, arg4, arg5)
%exception fe_world_get_moved {
    $action
    if (result > 0) {
        arg2 = new_array(L, result, sizeof *arg2);
        arg3 = new_array(L, result, sizeof *arg3);
        arg5 = result;
        $action
    }
}
%define FE_PUSH_ALL(TYPE, PUSH)
%typemap(argout) TYPE { PUSH(L, $1, array_length(result, call1.count)); SWIG_arg++; }
%enddef
FE_PUSH_ALL(fe_handle *out_bodies, push_handles)
FE_PUSH_ALL(fe_handle *out_shapes, push_handles)
FE_PUSH_ALL(fe_handle *out_joints, push_handles)
FE_PUSH_ALL(fe_vec3 *out_vertices, push_vertices)
FE_PUSH_ALL(fe_hull_face *out_faces, push_faces)
FE_PUSH_ALL(int32_t *out_corners, push_corners)
FE_PUSH_ALL(fe_history_frame *out_frames, push_frames)
%ignore fe_history_frame;
FE_PUSH_ALL(fe_transform *out_transforms, push_transforms)
FE_PUSH_ALL(fe_hit *out_hits, push_hits)
FE_PUSH_ALL(fe_overlap *out_overlaps, push_overlaps)
FE_PUSH_ALL(fe_pair_event *out_events, push_pair_events)
FE_PUSH_ALL(fe_body_event *out_events, push_body_events)
FE_PUSH_ALL(fe_hit_event *out_events, push_hit_events)
FE_PUSH_ALL(fe_joint_event *out_events, push_joint_events)
FE_PUSH_ALL(fe_contact *out_contacts, push_contacts)
FE_PUSH_ALL(fe_draw_vertex *out_vertices, push_draw_vertices)
FE_PUSH_ALL(fe_draw_instance *out_instances, push_draw_instances)

// bytes of an asset or of a world: a string, whose size is asked for first
%typemap(in, numinputs=0) (void *out, int64_t capacity) "$1 = NULL; $2 = 0;"
%define FE_BYTES(FUNCTION)
%exception FUNCTION {
    $action
    if (result > 0) {
        arg3 = lua_newuserdata(L, (size_t)result);
        arg4 = result;
        $action
    }
    if (result < 0) raise_last(L);
}
%enddef
FE_BYTES(fe_asset_save)
FE_BYTES(fe_world_save)
%typemap(argout) (void *out, int64_t capacity) %{ lua_pushlstring(L, $1, (size_t)result); SWIG_arg++; %}
%typemap(in) (const void *bytes, int64_t size) {
    size_t size = 0;
    if (lua_type(L, $input) != LUA_TSTRING)
        fail(L, "feather: $1_name: a string is needed, not a %s", luaL_typename(L, $input));
    $1 = ($1_ltype)lua_tolstring(L, $input, &size);
    $2 = (int64_t)size;
}
%apply (const void *bytes, int64_t size) { (const void *a, int64_t a_size), (const void *b, int64_t b_size) };
// is the result FE_FOREIGN?
%typemap(out) fe_result fe_world_restore, fe_result fe_world_load %{
    if ($1 < 0) raise_last(L);
    lua_pushboolean(L, $1 == FE_FOREIGN);
    SWIG_arg++;
%}
FE_OUT(fe_asset_key *out_key, push_key(L, $1); SWIG_arg++)
%typemap(in, numinputs=0) fe_asset_key *out_keys "$1 = NULL;"
FE_ALL_RECORDS(fe_snapshot_get_assets, arg3, arg4, arg5)
%typemap(argout) fe_asset_key *out_keys { push_keys(L, $1, result); SWIG_arg++; }
%ignore fe_asset_key;
// Arrays of assets that stand for others: what lies in the world's store is found without them.
%ignore fe_restore_options::keys;
%ignore fe_restore_options::assets;
%ignore fe_restore_options::asset_count;

%typemap(in) const fe_query_filter *filter (fe_query_filter value) "$1 = to_filter(L, $input, &value);"
%typemap(in) const fe_heightfield_def *def (fe_heightfield_def value) "to_heightfield(L, $input, &value); $1 = &value;"
%ignore fe_query_filter;
%ignore fe_query_filter_init;
%typemap(in) const fe_hull_def *def (fe_hull_def value) "to_hull(L, $input, &value); $1 = &value;"
%typemap(in) const fe_mesh_def *def (fe_mesh_def value) "to_mesh(L, $input, &value); $1 = &value;"
%typemap(in) const fe_material *materials %{
    check_table(L, $input, "materials");
    $1 = ($1_ltype)to_materials(L, $input, &call1.count);
%}
%typemap(in) const fe_compound_part *parts %{
    $1 = ($1_ltype)new_array(L, records_in(L, $input, 1, &call1, "$1_name"), sizeof *$1);
    for (int i = 0; i < call1.count; ++i) {
        void *part = NULL;
        lua_rawgeti(L, $input, i + 1);
        if (!SWIG_IsOK(SWIG_ConvertPtr(L, -1, &part, $1_descriptor, 0)) || !part)
            fail(L, "feather: $1_name: parts of a compound are needed, not a %s", luaL_typename(L, -1));
        (($*1_ltype *)$1)[i] = *($1_ltype)part;
        lua_pop(L, 1);
    }
%}
%exception fe_compound_create {
    arg3 = (uint32_t)sizeof *arg2;
    $action
}
%ignore fe_heightfield_def;
%ignore fe_heightfield_def_init;
%ignore fe_hull_def;
%ignore fe_hull_def_init;
%ignore fe_hull_face;
%ignore fe_mesh_def;
%ignore fe_mesh_def_init;
// a loop over body_create costs the same
%ignore fe_body_create_many;
%ignore fe_ray;
%ignore fe_path;
%ignore fe_hit;
%ignore fe_closest;
%ignore fe_overlap;
%ignore fe_pair_event;
%ignore fe_body_event;
%ignore fe_hit_event;
%ignore fe_joint_event;
%ignore fe_contact;
%ignore fe_contact_point;
%ignore fe_draw_vertex;
%ignore fe_draw_instance;
%ignore fe_bounds;
