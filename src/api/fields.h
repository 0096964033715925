// fields.h - where the fields of the API's structs end: a struct_size may end after any of them, and nowhere inside.
//
// Each struct that states its size has a list of its fields here. A static assertion sees that none is missing: the
// structs have no padding.
#ifndef FE_API_FIELDS_H
#define FE_API_FIELDS_H
#include "feather.h"

typedef struct fe__fields {
    uint32_t size; // of the struct in this version
    uint32_t count;
    const uint16_t *ends; // offset behind each field, rising
} fe__fields;

#define FE_FIELDS_fe_allocator(FIELD) FIELD(struct_size) FIELD(reserved) FIELD(allocate) FIELD(release) FIELD(user)
#define FE_FIELDS_fe_store_def(FIELD) FIELD(struct_size) FIELD(number) FIELD(allocator)
#define FE_FIELDS_fe_heightfield_def(FIELD) \
    FIELD(struct_size)                      \
    FIELD(rows)                             \
    FIELD(columns)                          \
    FIELD(material_count)                   \
    FIELD(cell_x)                           \
    FIELD(cell_z)                           \
    FIELD(material_stride) FIELD(reserved) FIELD(heights) FIELD(holes) FIELD(cell_materials) FIELD(materials)
#define FE_FIELDS_fe_hull_def(FIELD) \
    FIELD(struct_size)               \
    FIELD(point_count) FIELD(max_vertices) FIELD(point_stride) FIELD(tolerance) FIELD(reserved) FIELD(points)
#define FE_FIELDS_fe_hull_info(FIELD)                                                                     \
    FIELD(struct_size)                                                                                    \
    FIELD(vertex_count)                                                                                   \
    FIELD(edge_count)                                                                                     \
    FIELD(face_count)                                                                                     \
    FIELD(volume)                                                                                         \
    FIELD(area)                                                                                           \
    FIELD(centre)                                                                                         \
    FIELD(inertia) FIELD(inertia_rotation) FIELD(lower) FIELD(upper) FIELD(thickness) FIELD(inner_radius) \
        FIELD(tolerance) FIELD(error) FIELD(bytes)
#define FE_FIELDS_fe_mesh_def(FIELD)                                                                    \
    FIELD(struct_size)                                                                                  \
    FIELD(flags)                                                                                        \
    FIELD(vertex_count)                                                                                 \
    FIELD(triangle_count)                                                                               \
    FIELD(vertex_stride)                                                                                \
    FIELD(index_stride)                                                                                 \
    FIELD(index_type)                                                                                   \
    FIELD(weld_distance) FIELD(edge_angle) FIELD(material_count) FIELD(material_stride) FIELD(reserved) \
        FIELD(vertices) FIELD(indices) FIELD(triangle_materials) FIELD(materials) FIELD(triangle_data)
#define FE_FIELDS_fe_mesh_info(FIELD)                                                                                 \
    FIELD(struct_size)                                                                                                \
    FIELD(triangle_count)                                                                                             \
    FIELD(degenerate_triangles)                                                                                       \
    FIELD(duplicate_triangles)                                                                                        \
    FIELD(vertex_count)                                                                                               \
    FIELD(open_edges)                                                                                                 \
    FIELD(crowded_edges)                                                                                              \
    FIELD(flipped_edges) FIELD(tree_height) FIELD(material_count) FIELD(lower) FIELD(upper) FIELD(area) FIELD(volume) \
        FIELD(bytes)
#define FE_FIELDS_fe_mesh_triangle(FIELD) \
    FIELD(struct_size) FIELD(material) FIELD(corners) FIELD(edges) FIELD(data) FIELD(kept)
#define FE_FIELDS_fe_compound_part(FIELD) \
    FIELD(struct_size)                    \
    FIELD(density) FIELD(frame) FIELD(own_material) FIELD(geometry) FIELD(material) FIELD(user_data)
#define FE_FIELDS_fe_compound_info(FIELD) FIELD(struct_size) FIELD(part_count) FIELD(lower) FIELD(upper) FIELD(bytes)
#define FE_FIELDS_fe_task_system(FIELD) FIELD(struct_size) FIELD(worker_count) FIELD(run) FIELD(user)
#define FE_FIELDS_fe_world_def(FIELD) \
    FIELD(struct_size)                \
    FIELD(worker_count)               \
    FIELD(gravity)                    \
    FIELD(substeps) FIELD(simd) FIELD(number) FIELD(pool) FIELD(store) FIELD(allocator) FIELD(tasks) FIELD(user_data)
#define FE_FIELDS_fe_world_tuning(FIELD)                                                       \
    FIELD(struct_size)                                                                         \
    FIELD(contact_hertz)                                                                       \
    FIELD(contact_damping_ratio)                                                               \
    FIELD(contact_push_speed)                                                                  \
    FIELD(joint_hertz)                                                                         \
    FIELD(joint_damping_ratio)                                                                 \
    FIELD(restitution_threshold)                                                               \
    FIELD(hit_event_threshold)                                                                 \
    FIELD(sleep_time) FIELD(speculative_distance) FIELD(max_linear_speed) FIELD(sleep_enabled) \
        FIELD(continuous_enabled) FIELD(warm_start_enabled)
#define FE_FIELDS_fe_profile(FIELD) \
    FIELD(struct_size)              \
    FIELD(step)                     \
    FIELD(pairs) FIELD(collide) FIELD(islands) FIELD(solve) FIELD(continuous) FIELD(finalize) FIELD(events) FIELD(sleep)
#define FE_FIELDS_fe_counters(FIELD)                                                                       \
    FIELD(struct_size)                                                                                     \
    FIELD(bodies)                                                                                          \
    FIELD(shapes)                                                                                          \
    FIELD(joints)                                                                                          \
    FIELD(awake_bodies)                                                                                    \
    FIELD(pairs)                                                                                           \
    FIELD(contacts)                                                                                        \
    FIELD(recycled)                                                                                        \
    FIELD(islands) FIELD(colours) FIELD(rows) FIELD(rows_whole) FIELD(lanes) FIELD(simd) FIELD(simd_width) \
        FIELD(workers) FIELD(bytes) FIELD(allocations) FIELD(trees) FIELD(reserved) FIELD(contacts_left_out)
#define FE_FIELDS_fe_energy(FIELD) FIELD(struct_size) FIELD(reserved) FIELD(kinetic) FIELD(potential)
#define FE_FIELDS_fe_body_def(FIELD)                                                                                 \
    FIELD(struct_size)                                                                                               \
    FIELD(type)                                                                                                      \
    FIELD(transform)                                                                                                 \
    FIELD(linear_velocity)                                                                                           \
    FIELD(angular_velocity)                                                                                          \
    FIELD(linear_damping)                                                                                            \
    FIELD(angular_damping)                                                                                           \
    FIELD(gravity_scale)                                                                                             \
    FIELD(sleep_threshold) FIELD(linear_locks) FIELD(angular_locks) FIELD(awake) FIELD(sleep_allowed) FIELD(enabled) \
        FIELD(bullet) FIELD(user_data)
#define FE_FIELDS_fe_mass_data(FIELD) \
    FIELD(struct_size) FIELD(mass) FIELD(centre) FIELD(inertia) FIELD(inertia_rotation)
#define FE_FIELDS_fe_geometry(FIELD) \
    FIELD(struct_size)               \
    FIELD(type)                      \
    FIELD(radius)                    \
    FIELD(half_height)               \
    FIELD(half_extents) FIELD(normal) FIELD(distance) FIELD(scale) FIELD(reserved) FIELD(asset) FIELD(reserved_end)
#define FE_FIELDS_fe_shape_def(FIELD) \
    FIELD(struct_size)                \
    FIELD(density)                    \
    FIELD(frame)                      \
    FIELD(trigger)                    \
    FIELD(material)                   \
    FIELD(layer)                      \
    FIELD(mask)                       \
    FIELD(group)                      \
    FIELD(events) FIELD(pair_filter) FIELD(one_way) FIELD(one_way_direction) FIELD(surface_velocity) FIELD(user_data)
#define FE_FIELDS_fe_joint_def(FIELD) \
    FIELD(struct_size)                \
    FIELD(enabled)                    \
    FIELD(body_a)                     \
    FIELD(body_b)                     \
    FIELD(user_data)                  \
    FIELD(world_origin)               \
    FIELD(frame_a)                    \
    FIELD(frame_b)                    \
    FIELD(collide_connected) FIELD(hertz) FIELD(damping_ratio) FIELD(break_force) FIELD(break_torque) FIELD(reserved)
#define FE_FIELDS_fe_distance_joint_def(FIELD)                                                                        \
    FIELD(struct_size)                                                                                                \
    FIELD(enabled)                                                                                                    \
    FIELD(body_a)                                                                                                     \
    FIELD(body_b)                                                                                                     \
    FIELD(user_data)                                                                                                  \
    FIELD(world_origin)                                                                                               \
    FIELD(frame_a)                                                                                                    \
    FIELD(frame_b)                                                                                                    \
    FIELD(collide_connected) FIELD(hertz) FIELD(damping_ratio) FIELD(break_force) FIELD(break_torque) FIELD(reserved) \
        FIELD(limit_enabled) FIELD(lower) FIELD(upper) FIELD(spring_hertz) FIELD(spring_damping_ratio)                \
            FIELD(spring_max) FIELD(target) FIELD(motor_speed) FIELD(motor_max) FIELD(reserved_end)
#define FE_FIELDS_fe_ball_joint_def(FIELD)                                                                            \
    FIELD(struct_size)                                                                                                \
    FIELD(enabled)                                                                                                    \
    FIELD(body_a)                                                                                                     \
    FIELD(body_b)                                                                                                     \
    FIELD(user_data)                                                                                                  \
    FIELD(world_origin)                                                                                               \
    FIELD(frame_a)                                                                                                    \
    FIELD(frame_b)                                                                                                    \
    FIELD(collide_connected) FIELD(hertz) FIELD(damping_ratio) FIELD(break_force) FIELD(break_torque) FIELD(reserved) \
        FIELD(cone_enabled) FIELD(cone_y) FIELD(cone_z) FIELD(limit_enabled) FIELD(lower) FIELD(upper)                \
            FIELD(limit_hertz) FIELD(limit_damping_ratio) FIELD(spring_hertz) FIELD(spring_damping_ratio)             \
                FIELD(spring_max) FIELD(target) FIELD(motor_velocity) FIELD(motor_max) FIELD(reserved_end)
#define FE_FIELDS_fe_hinge_joint_def(FIELD)                                                                           \
    FIELD(struct_size)                                                                                                \
    FIELD(enabled)                                                                                                    \
    FIELD(body_a)                                                                                                     \
    FIELD(body_b)                                                                                                     \
    FIELD(user_data)                                                                                                  \
    FIELD(world_origin)                                                                                               \
    FIELD(frame_a)                                                                                                    \
    FIELD(frame_b)                                                                                                    \
    FIELD(collide_connected) FIELD(hertz) FIELD(damping_ratio) FIELD(break_force) FIELD(break_torque) FIELD(reserved) \
        FIELD(limit_enabled) FIELD(lower) FIELD(upper) FIELD(limit_hertz) FIELD(limit_damping_ratio)                  \
            FIELD(spring_hertz) FIELD(spring_damping_ratio) FIELD(spring_max) FIELD(target) FIELD(motor_speed)        \
                FIELD(motor_max) FIELD(reserved_end)
#define FE_FIELDS_fe_fixed_joint_def(FIELD)                                                                           \
    FIELD(struct_size)                                                                                                \
    FIELD(enabled)                                                                                                    \
    FIELD(body_a)                                                                                                     \
    FIELD(body_b)                                                                                                     \
    FIELD(user_data)                                                                                                  \
    FIELD(world_origin)                                                                                               \
    FIELD(frame_a)                                                                                                    \
    FIELD(frame_b)                                                                                                    \
    FIELD(collide_connected) FIELD(hertz) FIELD(damping_ratio) FIELD(break_force) FIELD(break_torque) FIELD(reserved) \
        FIELD(angular_hertz) FIELD(angular_damping_ratio)
#define FE_FIELDS_fe_configurable_joint_def(FIELD)                                                                    \
    FIELD(struct_size)                                                                                                \
    FIELD(enabled)                                                                                                    \
    FIELD(body_a)                                                                                                     \
    FIELD(body_b)                                                                                                     \
    FIELD(user_data)                                                                                                  \
    FIELD(world_origin)                                                                                               \
    FIELD(frame_a)                                                                                                    \
    FIELD(frame_b)                                                                                                    \
    FIELD(collide_connected) FIELD(hertz) FIELD(damping_ratio) FIELD(break_force) FIELD(break_torque) FIELD(reserved) \
        FIELD(axes)
#define FE_FIELDS_fe_joint_state(FIELD) \
    FIELD(struct_size)                  \
    FIELD(angle)                        \
    FIELD(swing_y)                      \
    FIELD(swing_z)                      \
    FIELD(angular_velocity)             \
    FIELD(translation) FIELD(linear_velocity) FIELD(length) FIELD(speed) FIELD(linear_error) FIELD(angular_error)
#define FE_FIELDS_fe_query_filter(FIELD) \
    FIELD(struct_size) FIELD(mask) FIELD(flags) FIELD(excluded_count) FIELD(excluded)
#define FE_FIELDS_fe_save_options(FIELD) FIELD(struct_size) FIELD(flags) FIELD(base) FIELD(base_size)
#define FE_FIELDS_fe_restore_options(FIELD) \
    FIELD(struct_size)                      \
    FIELD(new_number) FIELD(asset_count) FIELD(reserved) FIELD(keys) FIELD(assets) FIELD(base) FIELD(base_size)
#define FE_FIELDS_fe_difference(FIELD) \
    FIELD(struct_size)                 \
    FIELD(index) FIELD(element) FIELD(reserved) FIELD(handle) FIELD(other) FIELD(kind) FIELD(field) FIELD(a) FIELD(b)
#define FE_FIELDS_fe_snapshot_info(FIELD) \
    FIELD(struct_size)                    \
    FIELD(library)                        \
    FIELD(foreign)                        \
    FIELD(number) FIELD(step) FIELD(bodies) FIELD(shapes) FIELD(joints) FIELD(assets) FIELD(inside) FIELD(filter)
#define FE_FIELDS_fe_history_def(FIELD) FIELD(struct_size) FIELD(frames) FIELD(bytes)
#define FE_FIELDS_fe_batch_def(FIELD) \
    FIELD(struct_size)                \
    FIELD(world_count)                \
    FIELD(worker_count) FIELD(block) FIELD(simd) FIELD(reserved) FIELD(pool) FIELD(tasks) FIELD(allocator)
#define FE_FIELDS_fe_array(FIELD) \
    FIELD(struct_size)            \
    FIELD(field)                  \
    FIELD(item_count) FIELD(is_double) FIELD(relative_to) FIELD(origin) FIELD(items) FIELD(data) FIELD(bytes)
#define FE_FIELDS_fe_draw_options(FIELD) \
    FIELD(struct_size)                   \
    FIELD(parts) FIELD(origin) FIELD(lower) FIELD(upper) FIELD(only) FIELD(scale) FIELD(segments)
#define FE_FIELDS_fe_recorder_def(FIELD) \
    FIELD(struct_size) FIELD(flags) FIELD(keyframe_steps) FIELD(reserved) FIELD(buffer_bytes)
#define FE_FIELDS_fe_player_def(FIELD) \
    FIELD(struct_size) FIELD(worker_count) FIELD(simd) FIELD(reserved) FIELD(pool) FIELD(store) FIELD(allocator)
#define FE_FIELDS_fe_player_info(FIELD) \
    FIELD(struct_size)                  \
    FIELD(library)                      \
    FIELD(flags)                        \
    FIELD(foreign)                      \
    FIELD(first_step)                   \
    FIELD(last_step)                    \
    FIELD(step) FIELD(calls) FIELD(bytes) FIELD(keyframes) FIELD(notes) FIELD(has_diverged) FIELD(reserved)
#define FE_FIELDS_fe_divergence(FIELD) \
    FIELD(struct_size)                 \
    FIELD(type) FIELD(step) FIELD(body) FIELD(component) FIELD(reserved) FIELD(field) FIELD(text)

#define FE_EACH_STRUCT(STRUCT)                                                                                         \
    STRUCT(fe_allocator)                                                                                               \
    STRUCT(fe_store_def)                                                                                               \
    STRUCT(fe_hull_def)                                                                                                \
    STRUCT(fe_hull_info)                                                                                               \
    STRUCT(fe_mesh_def)                                                                                                \
    STRUCT(fe_mesh_info)                                                                                               \
    STRUCT(fe_mesh_triangle) STRUCT(fe_compound_part) STRUCT(fe_compound_info) STRUCT(fe_heightfield_def)              \
        STRUCT(fe_task_system) STRUCT(fe_world_def) STRUCT(fe_world_tuning) STRUCT(fe_profile) STRUCT(fe_counters)     \
            STRUCT(fe_energy) STRUCT(fe_body_def) STRUCT(fe_mass_data) STRUCT(fe_geometry) STRUCT(fe_shape_def)        \
                STRUCT(fe_joint_def) STRUCT(fe_distance_joint_def) STRUCT(fe_ball_joint_def)                           \
                    STRUCT(fe_hinge_joint_def) STRUCT(fe_fixed_joint_def) STRUCT(fe_configurable_joint_def)            \
                        STRUCT(fe_joint_state) STRUCT(fe_query_filter) STRUCT(fe_draw_options) STRUCT(fe_save_options) \
                            STRUCT(fe_restore_options) STRUCT(fe_snapshot_info) STRUCT(fe_recorder_def)                \
                                STRUCT(fe_player_def) STRUCT(fe_player_info) STRUCT(fe_divergence)                     \
                                    STRUCT(fe_history_def) STRUCT(fe_difference) STRUCT(fe_batch_def) STRUCT(fe_array)

#define FE_DECLARE_FIELDS(type) extern const fe__fields fe__fields_of_##type;
FE_EACH_STRUCT(FE_DECLARE_FIELDS)
#undef FE_DECLARE_FIELDS

#define FE_CHOOSE_FIELDS(type) \
    type:                      \
    &fe__fields_of_##type,
// The table of the struct that `pointer` points to
#define FE_FIELDS_OF(pointer) _Generic(*(pointer), FE_EACH_STRUCT(FE_CHOOSE_FIELDS) int : (const fe__fields *)0)

#endif
