// hello.c - a box falls on the ground: the smallest whole program.
//
//     cc hello.c -lfeather -lm -o hello && ./hello
#include "feather.h"

#include <stdio.h>

int main(void)
{
    fe_world *world;
    if (fe_world_create(NULL, &world) != FE_OK) {
        printf("%s\n", fe_last_error());
        return 1;
    }

    // the ground: a static body with a half space, y <= 0
    fe_body_def still;
    fe_body_def_init(&still, sizeof still);
    still.type = FE_BODY_STATIC;
    fe_body ground, box;
    fe_shape shape;
    fe_geometry plane, cube;
    fe_geometry_plane(&plane, 0, 1, 0, 0);
    fe_body_create(world, &still, &ground);
    fe_shape_create(world, ground, NULL, &plane, &shape);

    // a cube of 1 m, 4 m above it
    fe_body_def falling;
    fe_body_def_init(&falling, sizeof falling);
    falling.transform = fe_make_transform(0, 4, 0);
    fe_geometry_box(&cube, 0.5f, 0.5f, 0.5f);
    fe_body_create(world, &falling, &box);
    fe_shape_create(world, box, NULL, &cube, &shape);

    for (int step = 0; step <= 90; ++step) {
        fe_transform at;
        if (fe_body_get_transform(world, box, &at) == FE_OK && step % 15 == 0)
            printf("%4.2f s  y = %6.4f m\n", step / 60.0, at.position.y);
        if (fe_world_step(world, 1.0f / 60.0f) != FE_OK) {
            printf("%s\n", fe_last_error());
            return 1;
        }
    }
    return fe_world_destroy(world) == FE_OK ? 0 : 1;
}
