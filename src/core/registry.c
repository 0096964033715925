// registry.c - see registry.h.
#include "core/registry.h"

#include <stddef.h>

static int32_t is_listed(const fe__registry *registry, const fe__entry *entry)
{
    for (const fe__entry *at = registry->first; at; at = at->next)
        if (at == entry) return 1;
    return 0;
}

static void unlink_entry(fe__registry *registry, fe__entry *entry)
{
    if (entry->previous)
        entry->previous->next = entry->next;
    else
        registry->first = entry->next;
    if (entry->next) entry->next->previous = entry->previous;
}

void fe__registry_add(fe__registry *registry, fe__entry *entry)
{
    fe__mutex_lock(&registry->lock);
    entry->previous = NULL;
    entry->next = registry->first;
    if (entry->next) entry->next->previous = entry;
    registry->first = entry;
    fe__mutex_unlock(&registry->lock);
}

void fe__registry_remove(fe__registry *registry, fe__entry *entry)
{
    fe__mutex_lock(&registry->lock);
    unlink_entry(registry, entry);
    fe__mutex_unlock(&registry->lock);
}

fe_result fe__registry_retain(fe__registry *registry, fe__entry *entry)
{
    fe__mutex_lock(&registry->lock);
    fe_result result = !is_listed(registry, entry) ? FE_ERROR_STALE : entry->owned ? FE_ERROR_ARGUMENT : FE_OK;
    if (result == FE_OK) entry->users += 1;
    fe__mutex_unlock(&registry->lock);
    return result;
}

void fe__registry_share(fe__registry *registry, fe__entry *entry)
{
    fe__mutex_lock(&registry->lock);
    entry->users += 1;
    fe__mutex_unlock(&registry->lock);
}

int32_t fe__registry_release(fe__registry *registry, fe__entry *entry)
{
    fe__mutex_lock(&registry->lock);
    int32_t left = entry->users -= 1;
    if (entry->owned && left == 0) unlink_entry(registry, entry);
    fe__mutex_unlock(&registry->lock);
    return left;
}

fe_result fe__registry_withdraw(fe__registry *registry, fe__entry *entry, int32_t *out_users)
{
    *out_users = 0;
    fe__mutex_lock(&registry->lock);
    fe_result result = FE_ERROR_STALE;
    if (is_listed(registry, entry)) {
        *out_users = entry->owned ? 0 : entry->users;
        result = entry->owned || entry->users > 0 ? FE_ERROR_STATE : FE_OK;
        if (result == FE_OK) unlink_entry(registry, entry);
    }
    fe__mutex_unlock(&registry->lock);
    return result;
}

int32_t fe__registry_has(fe__registry *registry, const fe__entry *entry)
{
    fe__mutex_lock(&registry->lock);
    int32_t listed = is_listed(registry, entry);
    fe__mutex_unlock(&registry->lock);
    return listed;
}
