// Worlds for C#, where a thread may read a world's pointer and be halted there while another thread disposes of the
// world. The call then begins with a world that is destroyed. It must find the word that refuses it (src/core/owner.h)
// instead of freed memory.
//
// So the memory of the fe_world itself, a few kilobytes, stays until the managed World cannot be reached any more. No
// call with its pointer can begin after that. fe_world_destroy leaves the world closed for all time. Everything else of
// the world is freed there. The shell is the allocator that knows that one block.
#ifndef FE_BINDINGS_CSHARP_SHELL_H
#define FE_BINDINGS_CSHARP_SHELL_H
#include "feather.h"

#include <stdatomic.h>
#include <stdlib.h>

typedef struct fe_shell {
    void *world;      // the block that stays; NULL until the world is there
    atomic_int users; // the world, its managed object, and recorders, whose memory is of the world's allocator
} fe_shell;

#ifdef _WIN32 // has no aligned_alloc, and its free takes no aligned block
#include <malloc.h>
static void *take_block(size_t size, size_t alignment) { return _aligned_malloc(size, alignment); }
static void give_block(void *memory) { _aligned_free(memory); }
#else
static void *take_block(size_t size, size_t alignment) { return aligned_alloc(alignment, size); }
static void give_block(void *memory) { free(memory); }
#endif

static void fe_shell_enter(fe_shell *shell) { (void)atomic_fetch_add(&shell->users, 1); }

static void fe_shell_leave(fe_shell *shell)
{
    if (!shell || atomic_fetch_sub(&shell->users, 1) != 1) return;
    give_block(shell->world);
    free(shell);
}

static void *shell_allocate(void *user, uint64_t size, uint64_t alignment)
{
    (void)user;
    if (size > SIZE_MAX - alignment) return NULL;
    return take_block((size_t)((size + alignment - 1) / alignment * alignment), (size_t)alignment);
}

static void shell_release(void *user, void *memory, uint64_t size)
{
    fe_shell *shell = user;
    (void)size;
    if (memory == shell->world) fe_shell_leave(shell);
    else give_block(memory);
}

// With a source its clone, with bytes the world that they are of, else an empty one.
static fe_result make_world(const fe_world *source, fe_world_def *def, const fe_restore_options *options,
                            const void *bytes, int64_t size, fe_world **out_world, fe_shell **out_shell)
{
    fe_shell *shell = calloc(1, sizeof *shell);
    if (!shell) return FE_ERROR_MEMORY;
    fe_allocator allocator = {
        .struct_size = sizeof allocator, .allocate = shell_allocate, .release = shell_release, .user = shell};
    def->allocator = &allocator;
    fe_result result = source  ? fe_world_clone(source, def, out_world)
                       : bytes ? fe_world_load(def, options, bytes, size, out_world)
                               : fe_world_create(def, out_world);
    def->allocator = NULL;
    if (result < 0) {
        free(shell);
        return result;
    }
    atomic_init(&shell->users, 2);
    shell->world = *out_world;
    *out_shell = shell;
    return result;
}

static fe_result fe_shell_create_world(fe_world_def *def, fe_world **out_world, fe_shell **out_shell)
{
    return make_world(NULL, def, NULL, NULL, 0, out_world, out_shell);
}

static fe_result fe_shell_load_world(fe_world_def *def, const fe_restore_options *options, const void *bytes,
                                     int64_t size, fe_world **out_world, fe_shell **out_shell)
{
    return make_world(NULL, def, options, bytes, size, out_world, out_shell);
}

static fe_result fe_shell_clone_world(const fe_world *source, fe_world_def *def, fe_world **out_world,
                                      fe_shell **out_shell)
{
    return make_world(source, def, NULL, NULL, 0, out_world, out_shell);
}

#endif
