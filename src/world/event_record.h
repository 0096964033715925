// event_record.h - an event as the step writes it. Serials order it; handles name it also after a destruction.
#ifndef FE_WORLD_EVENT_RECORD_H
#define FE_WORLD_EVENT_RECORD_H
#include "feather.h"

// Room for one of each contact is kept: what an event has of its own, and no more
typedef struct fe__pair_event_record {
    uint64_t serial_a, serial_b;
    fe_body body_a, body_b;
    fe_shape shape_a, shape_b;
    int16_t kind;
    uint8_t is_trigger;
    uint8_t field_a;  // 1: the triangle is A's
    int32_t triangle; // -1: none
} fe__pair_event_record;
_Static_assert(sizeof(fe__pair_event_record) == 56, "kept for each contact");

typedef struct fe__body_event_record {
    uint64_t serial;
    fe_body_event event;
} fe__body_event_record;

typedef struct fe__hit_event_record {
    uint64_t serial_a, serial_b;
    fe_hit_event event;
} fe__hit_event_record;

typedef struct fe__joint_event_record {
    uint64_t serial;
    fe_joint_event event;
} fe__joint_event_record;

#endif
