// ray_gun.c - a gun that hits at once: rays find what is shot at, an impulse pushes it.
//
//     cc ray_gun.c -lfeather -lm -o ray_gun && ./ray_gun
//
// Shows a ray with a filter (the shooter does not count), materials named by user_id, an impulse at a point, and the
// hit events of what falls. The tower falls the same way on every machine: the last line is a hash of the world.
#include "feather.h"

#include <stdio.h>
#include <stdlib.h>

#define DT (1.0f / 60)
#define IMPULSE 600.0f // N s

enum { BOXES = 6, MOST_EVENTS = 16 };

enum { STONE = 1, WOOD = 2 };
static const char *const material_names[] = {"nothing", "stone", "wood"};

static int32_t must(int32_t result)
{
    if (result >= 0) return result;
    printf("%s\n", fe_last_error());
    exit(1);
}

static fe_body add_body(fe_world *world, int32_t type, fe_transform at, uint64_t name, uint64_t material,
                        const fe_geometry *form)
{
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.type = type;
    def.transform = at;
    def.user_data = name;
    fe_shape_def shape_def;
    fe_shape_def_init(&shape_def, sizeof shape_def);
    shape_def.density = 100;
    shape_def.material.user_id = material;
    shape_def.events = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_HIT;
    fe_body body;
    fe_shape shape;
    must(fe_body_create(world, &def, &body));
    must(fe_shape_create(world, body, &shape_def, form, &shape));
    return body;
}

static uint64_t name_of(const fe_world *world, fe_body body)
{
    uint64_t name;
    must(fe_body_get_user_data(world, body, &name));
    return name;
}

// Shoots from the eye along a direction of 30 m. The shooter's own body does not count.
static void shoot(fe_world *world, fe_body shooter, fe_dvec3 eye, fe_vec3 direction)
{
    fe_query_filter filter;
    fe_query_filter_init(&filter, sizeof filter);
    filter.excluded = &shooter;
    filter.excluded_count = 1;
    fe_dvec3 translation = {30.0 * (double)direction.x, 30.0 * (double)direction.y, 30.0 * (double)direction.z};
    fe_hit hit;
    if (!must(fe_world_raycast(world, &eye, &translation, &filter, &hit))) {
        printf("  missed\n");
        return;
    }
    int32_t type;
    must(fe_body_get_type(world, hit.body, &type));
    printf("  hit %s at %.3f m", material_names[hit.material], 30 * hit.fraction);
    if (type == FE_BODY_DYNAMIC) {
        fe_vec3 impulse = fe_make_vec3(IMPULSE * direction.x, IMPULSE * direction.y, IMPULSE * direction.z);
        must(fe_body_add_impulse_at(world, hit.body, &impulse, &hit.point));
        printf(", box %d", (int)name_of(world, hit.body));
    }
    printf("\n");
}

static void report_hits(const fe_world *world)
{
    fe_hit_event events[MOST_EVENTS];
    int32_t count = must(fe_world_get_hit_events(world, events, sizeof *events, MOST_EVENTS));
    for (int32_t i = 0; i < count && i < MOST_EVENTS; ++i)
        if (events[i].speed > 4)
            printf("  %s meets %s at %.2f m/s\n", material_names[events[i].material_a],
                   material_names[events[i].material_b], (double)events[i].speed);
}

int main(void)
{
    fe_world *world;
    must(fe_world_create(NULL, &world));
    fe_geometry plane, cube, capsule;
    fe_geometry_plane(&plane, 0, 1, 0, 0);
    fe_geometry_box(&cube, 0.5f, 0.5f, 0.5f);
    fe_geometry_capsule(&capsule, 0.6f, 0.3f);
    add_body(world, FE_BODY_STATIC, fe_make_transform(0, 0, 0), 0, STONE, &plane);
    fe_body shooter = add_body(world, FE_BODY_STATIC, fe_make_transform(-10, 0.9, 0), 0, STONE, &capsule);
    for (int i = 0; i < BOXES; ++i)
        add_body(world, FE_BODY_DYNAMIC, fe_make_transform(0, 0.5 + i, 0), 1 + (uint64_t)i, WOOD, &cube);

    fe_dvec3 eye = fe_make_dvec3(-10, 1.6, 0);
    for (int step = 0; step < 300; ++step) {
        if (step % 60 == 30) {
            float rise = 0.05f * (float)(step / 60); // each shot goes higher
            printf("%4.2f s  shot\n", step / 60.0);
            shoot(world, shooter, eye, fe_make_vec3(1, rise, 0));
        }
        must(fe_world_step(world, DT));
        report_hits(world);
    }
    uint32_t hash[2];
    must(fe_world_hash(world, hash));
    printf("hash %08x%08x\n", (unsigned)hash[1], (unsigned)hash[0]);
    return fe_world_destroy(world) == FE_OK ? 0 : 1;
}
