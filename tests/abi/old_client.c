// A program written for version 1.0, compiled with that version's header and linked with today's library. Each struct
// has its old size; what lies behind it must stay as it was.
#include "feather_1_0.h"
#include <stdio.h>
#include <string.h>

enum { STEPS = 120, CANARY = 0xA5 };

#define CHECK(condition)                                                                    \
    do {                                                                                    \
        if (!(condition)) {                                                                 \
            printf("line %d: %s; last error: %s\n", __LINE__, #condition, fe_last_error()); \
            return 1;                                                                       \
        }                                                                                   \
    } while (0)

// Room behind the old struct, where a library that thinks it is longer would write.
#define GUARDED(type, name)       \
    struct {                      \
        type value;               \
        unsigned char canary[64]; \
    } name;                       \
    memset(&name, CANARY, sizeof name)

static int intact(const unsigned char *canary)
{
    for (int i = 0; i < 64; ++i)
        if (canary[i] != CANARY) return 0;
    return 1;
}

static int make_scene(fe_world *world, fe_body *out_ball)
{
    GUARDED(fe_body_def, body);
    fe_body_def_init(&body.value, sizeof body.value);
    CHECK(intact(body.canary) && body.value.type == FE_BODY_DYNAMIC);
    body.value.transform = fe_make_transform(0.0, 1.0, 0.0);
    CHECK(fe_body_create(world, &body.value, out_ball) == FE_OK);
    body.value.type = FE_BODY_STATIC;
    body.value.transform = fe_make_transform(0.0, -1.0, 0.0);
    fe_body floor;
    CHECK(fe_body_create(world, &body.value, &floor) == FE_OK);

    GUARDED(fe_shape_def, shape);
    fe_shape_def_init(&shape.value, sizeof shape.value);
    CHECK(intact(shape.canary));
    fe_geometry sphere, box;
    fe_geometry_sphere(&sphere, 0.5f);
    fe_geometry_box(&box, 10.0f, 1.0f, 10.0f);
    fe_shape made;
    CHECK(fe_shape_create(world, *out_ball, &shape.value, &sphere, &made) == FE_OK);
    CHECK(fe_shape_create(world, floor, &shape.value, &box, &made) == FE_OK);
    return 0;
}

static int read_back(const fe_world *world, fe_body ball)
{
    GUARDED(fe_contact, contact);
    CHECK(fe_body_get_contacts(world, ball, &contact.value, sizeof contact.value, 1) == 1);
    CHECK(intact(contact.canary) && contact.value.point_count == 1);
    GUARDED(fe_counters, counters);
    counters.value.struct_size = sizeof counters.value;
    CHECK(fe_world_get_counters(world, &counters.value) == FE_OK);
    CHECK(intact(counters.canary) && counters.value.bodies == 2 && counters.value.shapes == 2);
    GUARDED(fe_profile, profile);
    profile.value.struct_size = sizeof profile.value;
    CHECK(fe_world_get_profile(world, &profile.value) == FE_OK && intact(profile.canary));
    GUARDED(fe_mass_data, mass);
    mass.value.struct_size = sizeof mass.value;
    CHECK(fe_body_get_mass_data(world, ball, &mass.value) == FE_OK && intact(mass.canary));
    GUARDED(fe_hit, hit);
    fe_dvec3 origin = {0.0, 5.0, 0.0}, translation = {0.0, -10.0, 0.0};
    CHECK(fe_world_raycast(world, &origin, &translation, NULL, &hit.value) == 1);
    CHECK(intact(hit.canary) && hit.value.body == ball);
    return 0;
}

int main(void)
{
    CHECK(fe_version() >> 16 == FE_VERSION_MAJOR && fe_version() >= (FE_VERSION_MAJOR << 16 | FE_VERSION_MINOR << 8));
    GUARDED(fe_world_def, def);
    fe_world_def_init(&def.value, sizeof def.value);
    CHECK(intact(def.canary));
    fe_world *world;
    CHECK(fe_world_create(&def.value, &world) == FE_OK);
    GUARDED(fe_world_tuning, tuning);
    fe_world_tuning_init(&tuning.value, sizeof tuning.value);
    CHECK(intact(tuning.canary) && fe_world_set_tuning(world, &tuning.value) == FE_OK);
    fe_body ball;
    if (make_scene(world, &ball)) return 1;
    for (int step = 0; step < STEPS; ++step) CHECK(fe_world_step(world, 1.0f / 60.0f) == FE_OK);
    if (read_back(world, ball)) return 1;
    CHECK(fe_world_destroy(world) == FE_OK);
    return 0;
}
