// break_joints.c - joints that bore too much in the step, by its reactions, go: their events first, in the order of
// creation.
#include "step/break_joints.h"

#include "core/array_sort.h"
#include "world/handles.h"
#include "world/joints.h"

static int32_t exceeds(fe_vec3 a, float most) { return most > 0.0f && fe__dot(a, a) > most * most; }

// Reads the step's reactions; writes events in the order of creation, then removes the joints in that order
void fe__break_joints(fe__step *step)
{
    fe_world *w = step->world;
    fe__sort_item *items = fe__sort_room(step);
    int32_t count = 0;
    w->joint_event_count = 0;
    if (!w->breakable_count || step->dt == 0.0f) return;
    for (int32_t i = 0; i < w->awake_joint_count; ++i) {
        int32_t joint = w->awake_joints[i];
        const fe__joint_record *r = w->joint_records + joint;
        if (w->joints.joints[joint].colour < 0 || (r->break_force == 0.0f && r->break_torque == 0.0f)) continue;
        fe_vec3 force, torque;
        fe__joint_reaction_of(&w->joints, w->bodies, joint, &force, &torque);
        if (exceeds(force, r->break_force) || exceeds(torque, r->break_torque))
            items[count++] = (fe__sort_item){w->joints.frames[joint].serial, joint, 0};
    }
    fe__sort_keys(items, count, items + count);
    w->joint_event_count = count;
    for (int32_t i = 0; i < count; ++i) {
        int32_t joint = items[i].value;
        const fe__joint_record *r = w->joint_records + joint;
        fe_joint_event e = {fe__joint_handle(w, joint),
                            fe__joint_end_handle(w, joint, 0),
                            fe__joint_end_handle(w, joint, 1),
                            r->user_data,
                            FE_EVENT_BREAK,
                            r->type,
                            {0, 0, 0},
                            {0, 0, 0}};
        fe__joint_reaction_of(&w->joints, w->bodies, joint, &e.force, &e.torque);
        w->joint_events[i] = (fe__joint_event_record){items[i].key, e};
    }
    for (int32_t i = 0; i < count; ++i) fe__joint_remove(w, items[i].value);
}
