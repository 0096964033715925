// A stranger's program: built in every way that the library can be found. One second of free fall ends near g / 2.
#include <feather.h>
#include <stddef.h>

int main(void)
{
    fe_world *world;
    fe_body ball;
    int step;
    double fallen;
    fe_transform now;
    if (fe_world_create(NULL, &world) != FE_OK || fe_body_create(world, NULL, &ball) != FE_OK) return 1;
    for (step = 0; step < 60; ++step)
        if (fe_world_step(world, 1.0f / 60.0f) != FE_OK) return 2;
    if (fe_body_get_transform(world, ball, &now) != FE_OK) return 5;
    fallen = -now.position.y;
    if (fe_world_destroy(world) != FE_OK) return 3;
    return fallen > 4.8 && fallen < 5.0 ? 0 : 4;
}
