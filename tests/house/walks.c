// walks.c - one act of the library between two marks of gcov's: tests/house/walks counts what ran.
//
//     walks contact|hinge|ray|body|snapshot
#include "feather.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void __gcov_reset(void);
void __gcov_dump(void);

#define STEPS 60
#define DT (1.0f / 60.0f)

static void must(fe_result result)
{
    if (result == FE_OK) return;
    printf("%s\n", fe_last_error());
    exit(1);
}

static fe_body add_box(fe_world *world, fe_body_type type, double y, float half_width)
{
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.type = type;
    def.transform = fe_make_transform(0, y, 0);
    fe_geometry box;
    fe_geometry_box(&box, half_width, 0.5f, half_width);
    fe_body body;
    fe_shape shape;
    must(fe_body_create(world, &def, &body));
    must(fe_shape_create(world, body, NULL, &box, &shape));
    return body;
}

static fe_world *create_world(int workers)
{
    fe_world_def def;
    fe_world_def_init(&def, sizeof def);
    def.worker_count = workers;
    fe_world *world;
    must(fe_world_create(&def, &world));
    return world;
}

// A box lands on a box, and the event of their touch is read.
static void walk_contact(void)
{
    fe_world *world = create_world(1);
    add_box(world, FE_BODY_STATIC, 0, 5.0f);
    add_box(world, FE_BODY_DYNAMIC, 1.5, 0.5f);
    __gcov_reset();
    int32_t touches = 0;
    for (int step = 0; step < STEPS; ++step) {
        must(fe_world_step(world, DT));
        fe_pair_event events[8];
        int32_t found = fe_world_get_pair_events(world, events, sizeof *events, 8);
        for (int32_t i = 0; i < found; ++i) touches += events[i].kind == FE_EVENT_ENTER;
    }
    __gcov_dump();
    if (touches != 1) printf("%d touches\n", (int)touches), exit(1);
}

// A bar swings between the limits of its hinge.
static void walk_hinge(void)
{
    fe_world *world = create_world(1);
    fe_body wall = add_box(world, FE_BODY_STATIC, 0, 0.5f), bar = add_box(world, FE_BODY_DYNAMIC, 2, 0.5f);
    __gcov_reset();
    fe_hinge_joint_def def;
    fe_hinge_joint_def_init(&def, sizeof def);
    fe_dvec3 point = { 0, 1, 0 };
    fe_vec3 axis = { 0, 0, 1 };
    must(fe_hinge_joint_def_at(world, &def, wall, bar, &point, &axis));
    def.limit_enabled = 1, def.lower = -0.5f, def.upper = 0.5f;
    fe_joint joint;
    must(fe_hinge_joint_create(world, &def, &joint));
    for (int step = 0; step < STEPS; ++step) must(fe_world_step(world, DT));
    __gcov_dump();
}

static void walk_ray(void)
{
    fe_world *world = create_world(1);
    add_box(world, FE_BODY_STATIC, 0, 5.0f);
    fe_dvec3 origin = { 0, 5, 0 }, translation = { 0, -10, 0 };
    fe_hit hit;
    __gcov_reset();
    int32_t found = fe_world_raycast(world, &origin, &translation, NULL, &hit);
    __gcov_dump();
    if (found != 1) printf("the ray gave %d\n", (int)found), exit(1);
}

static void walk_body(void)
{
    fe_world *world = create_world(1);
    __gcov_reset();
    add_box(world, FE_BODY_DYNAMIC, 0, 0.5f);
    __gcov_dump();
}

static void walk_snapshot(void)
{
    fe_world *world = create_world(1);
    add_box(world, FE_BODY_STATIC, 0, 5.0f);
    add_box(world, FE_BODY_DYNAMIC, 1.5, 0.5f);
    for (int step = 0; step < STEPS; ++step) must(fe_world_step(world, DT));
    static char bytes[1 << 20];
    __gcov_reset();
    int64_t size = fe_world_save(world, NULL, bytes, sizeof bytes);
    __gcov_dump();
    if (size <= 0) printf("%s\n", fe_last_error()), exit(1);
}

int main(int count, char **arguments)
{
    static const struct {
        const char *name;
        void (*walk)(void);
    } walks[] = {
        { "contact", walk_contact }, { "hinge", walk_hinge }, { "ray", walk_ray }, { "body", walk_body }, { "snapshot", walk_snapshot },
    };
    for (size_t i = 0; i < sizeof walks / sizeof *walks; ++i)
        if (count == 2 && strcmp(arguments[1], walks[i].name) == 0) {
            walks[i].walk();
            _Exit(0);
        }
    printf("walks contact|hinge|ray|body|snapshot\n");
    return 2;
}
