// event_record.h - an event as the step writes it. Serials order it; handles name it also after a destruction.
#ifndef FE_WORLD_EVENT_RECORD_H
#define FE_WORLD_EVENT_RECORD_H
#include "feather.h"

typedef struct fe__pair_event_record {
    uint64_t serial_a, serial_b;
    fe_pair_event event;
} fe__pair_event_record;

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
