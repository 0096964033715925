// What the C# package's native library does, asked through its own exports as C# asks: a world is made, steps, and is
// gone, in memory that the shell takes and gives (bindings/csharp/shell.h).
#include "feather.h"

#include <stdio.h>

void CSharp_FeatherPhysics_world_def_init(void *def, unsigned int size);
int CSharp_FeatherPhysics_shell_create_world(void *def, void *out_world, void *out_shell);
void CSharp_FeatherPhysics_shell_leave(void *shell);
int CSharp_FeatherPhysics_world_step(void *world, float dt);
int CSharp_FeatherPhysics_world_destroy(void *world);

int main(void)
{
    fe_world_def def;
    CSharp_FeatherPhysics_world_def_init(&def, sizeof def);
    void *world = NULL, *shell = NULL;
    int made = CSharp_FeatherPhysics_shell_create_world(&def, &world, &shell);
    int stepped = CSharp_FeatherPhysics_world_step(world, 1.0f / 60);
    int destroyed = CSharp_FeatherPhysics_world_destroy(world);
    CSharp_FeatherPhysics_shell_leave(shell);
    printf("made %d, stepped %d, destroyed %d\n", made, stepped, destroyed);
    return made | stepped | destroyed;
}
