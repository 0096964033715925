// What the C# package's native library does, asked through its own exports as C# asks: worlds are made, step, and are
// gone, in memory that the shell takes and gives (bindings/csharp/shell.h). What a world took is free for the next one.
#include "feather.h"

#include <stdio.h>
#ifdef _WIN32
#include <windows.h>
#else
#include <malloc.h>
#endif

void CSharp_FeatherPhysics_world_def_init(void *def, unsigned int size);
int CSharp_FeatherPhysics_shell_create_world(void *def, void *out_world, void *out_shell);
void CSharp_FeatherPhysics_shell_leave(void *shell);
int CSharp_FeatherPhysics_world_step(void *world, float dt);
int CSharp_FeatherPhysics_world_destroy(void *world);

// Bytes of the heap that are in use.
static long long taken(void)
{
#ifdef _WIN32
    HANDLE heaps[64];
    long long sum = 0;
    DWORD count = GetProcessHeaps(64, heaps);
    for (DWORD i = 0; i < count && i < 64; ++i) {
        PROCESS_HEAP_ENTRY entry = {0};
        while (HeapWalk(heaps[i], &entry))
            if (entry.wFlags & PROCESS_HEAP_ENTRY_BUSY) sum += (long long)entry.cbData;
    }
    return sum;
#else
    struct mallinfo2 info = mallinfo2();
    return (long long)(info.uordblks + info.hblkhd);
#endif
}

static int play(void)
{
    fe_world_def def;
    void *world = NULL, *shell = NULL;
    CSharp_FeatherPhysics_world_def_init(&def, sizeof def);
    int made = CSharp_FeatherPhysics_shell_create_world(&def, &world, &shell);
    int stepped = CSharp_FeatherPhysics_world_step(world, 1.0f / 60);
    int destroyed = CSharp_FeatherPhysics_world_destroy(world);
    CSharp_FeatherPhysics_shell_leave(shell);
    return made | stepped | destroyed;
}

int main(void)
{
    int failed = play();
    long long before = taken();
    for (int i = 0; i < 100; ++i) failed |= play();
    long long left = (taken() - before) / 100;
    printf("failed %d, %lld bytes left by a world\n", failed, left);
    return failed || left > 1024; // the block that the shell keeps has several kilobytes
}
