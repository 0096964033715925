// registry.h - what lives now of one kind (pools, stores), and how many worlds use it.
//
// A definition holds a raw pointer that may outlive its target. The registry compares addresses and reads nothing
// behind a pointer that it does not know. It is locked at creation and destruction only: searching a list is enough.
#ifndef FE_CORE_REGISTRY_H
#define FE_CORE_REGISTRY_H
#include "core/mutex.h"
#include "feather.h"

#include <stdint.h>

// Inside of what is registered.
typedef struct fe__entry {
    struct fe__entry *next, *previous;
    int32_t users; // worlds
    int32_t owned; // by a world and those that share what it has: nobody else may use or destroy it
} fe__entry;

typedef struct fe__registry {
    fe__mutex lock;
    fe__entry *first;
} fe__registry;

void fe__registry_add(fe__registry *registry, fe__entry *entry);
void fe__registry_remove(fe__registry *registry, fe__entry *entry); // by its owner: nobody uses it
// FE_OK: one user more. FE_ERROR_STALE: it is gone. FE_ERROR_ARGUMENT: a world owns it.
fe_result fe__registry_retain(fe__registry *registry, fe__entry *entry);
void fe__registry_share(fe__registry *registry, fe__entry *entry); // by a user of it: one more, of an owned one too
// Returns how many users are left. Of an owned one the last one removes it
int32_t fe__registry_release(fe__registry *registry, fe__entry *entry);
// FE_OK: removed, nobody uses it or will. FE_ERROR_STALE: it was gone. FE_ERROR_STATE: so many use it, or a world owns
// it (0).
fe_result fe__registry_withdraw(fe__registry *registry, fe__entry *entry, int32_t *out_users);
int32_t fe__registry_has(fe__registry *registry, const fe__entry *entry);

#endif
