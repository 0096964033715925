// history.c - see history.h: the ring of frames. What a frame holds is in held.c.
#include "state/history.h"

#include "state/held.h"

#include <string.h>

static fe__registry histories = {.lock = FE_MUTEX_INITIAL};

// ---- birth and death -----------------------------------------------------------------------------------------------
fe_result fe__history_create(fe_world *world, int32_t frames, int64_t most_bytes, fe_history **out_history)
{
    fe_history *h = fe__allocate(&world->memory, sizeof *h);
    if (!h) return FE_ERROR_MEMORY;
    *h = (fe_history){.world = world, .limit = frames, .most_bytes = most_bytes, .next = world->first_history};
    h->frames = fe__allocate(&world->memory, (size_t)frames * sizeof *h->frames);
    if (!h->frames) {
        fe__release(&world->memory, h, sizeof *h);
        return FE_ERROR_MEMORY;
    }
    world->first_history = h;
    fe__registry_add(&histories, &h->entry);
    *out_history = h;
    return FE_OK;
}

static void give_up(fe_history *h, fe__frame *frame)
{
    if (--frame->held->users > 0) return;
    fe__held_forget_assets(frame->held, h->world->store, &h->world->memory);
    frame->held->next = h->spare;
    h->spare = frame->held;
}

static fe__frame *frame_at(fe_history *h, int32_t i) { return h->frames + (h->first + i) % h->limit; }

static void drop_oldest(fe_history *h)
{
    give_up(h, frame_at(h, 0));
    h->first = (h->first + 1) % h->limit;
    --h->count;
}

static void drop_after(fe_history *h, int32_t last)
{
    for (; h->count > last + 1; --h->count) give_up(h, frame_at(h, h->count - 1));
}

static void free_spare(fe_history *h)
{
    fe__held *held = h->spare;
    h->spare = held->next;
    fe__release(&h->world->memory, held, (size_t)held->size);
}

void fe__history_destroy(fe_history *h)
{
    fe_world *world = h->world;
    fe_history **at = &world->first_history;
    while (*at != h) at = &(*at)->next;
    *at = h->next;
    fe__registry_remove(&histories, &h->entry);
    drop_after(h, -1);
    while (h->spare) free_spare(h);
    fe__release(&world->memory, h->frames, (size_t)h->limit * sizeof *h->frames);
    fe__release(&world->memory, h, sizeof *h);
}

void fe__histories_end(fe_world *world)
{
    while (world->first_history) fe__history_destroy(world->first_history);
}

fe_world *fe__world_of_history(const fe_history *h)
{
    return fe__registry_has(&histories, &h->entry) ? h->world : NULL;
}

// ---- memory --------------------------------------------------------------------------------------------------------
int64_t fe__history_bytes(const fe_history *h, int32_t i)
{
    const fe__held *held = fe__history_frame(h, i)->held, *before = i > 0 ? fe__history_frame(h, i - 1)->held : NULL;
    return (int64_t)sizeof(fe__frame) + (held == before ? 0 : fe__held_bytes(held, before));
}

static int64_t all_bytes(const fe_history *h)
{
    int64_t bytes = 0;
    for (int32_t i = 0; i < h->count; ++i) bytes += fe__history_bytes(h, i);
    return bytes;
}

// A block of at least that size, a spare one if one is near it. NULL: no memory
static fe__held *find_block(fe_history *h, int64_t size)
{
    enum { ROOM = 8, WASTE = 2 }; // an eighth, for a world that grows; at most as much again for one that shrank
    while (h->spare && (h->spare->size < size || h->spare->size / WASTE > size)) free_spare(h);
    fe__held *found = h->spare;
    if (found) {
        h->spare = found->next;
        return found;
    }
    const int64_t room = size + size / ROOM;
    found = fe__allocate_scratch(&h->world->memory, (size_t)room);
    if (found) found->size = room;
    return found;
}

// ---- frames --------------------------------------------------------------------------------------------------------
// The caller's own entry changes nothing yet
static int32_t is_last_frame(const fe_history *h)
{
    const fe_world *w = h->world;
    if (h->count == 0 || w->owner.entries - 1 != h->entries) return 0;
    return fe__held_is_state(fe__history_frame(h, h->count - 1)->held, w);
}

static fe__held *hold(fe_history *h, fe_result *result)
{
    fe_world *w = h->world;
    const fe__held *before = h->count ? fe__history_frame(h, h->count - 1)->held : NULL;
    fe__held *held = find_block(h, fe__held_size(w));
    *result = FE_ERROR_MEMORY;
    if (!held) return NULL;
    if (fe__held_fill(held, w, &w->memory, before)) {
        *result = h->most_bytes && (int64_t)sizeof(fe__frame) + fe__held_bytes(held, NULL) > h->most_bytes
                      ? FE_ERROR_LIMIT
                      : FE_OK;
        if (*result == FE_OK) return held;
        fe__held_forget_assets(held, w->store, &w->memory);
    }
    held->next = h->spare;
    h->spare = held;
    return NULL;
}

fe_result fe__history_keep(fe_history *h, int64_t number)
{
    fe_world *w = h->world;
    fe_result result = FE_OK;
    fe__held *held = is_last_frame(h) ? fe__history_frame(h, h->count - 1)->held : hold(h, &result);
    if (!held) return result;
    ++held->users;
    if (h->count == h->limit) drop_oldest(h);
    *frame_at(h, h->count++) = (fe__frame){number, w->step_number, w->last_h, w->last_dt, held};
    h->entries = --w->owner.entries; // keeping changes nothing
    while (h->most_bytes && all_bytes(h) > h->most_bytes) drop_oldest(h);
    return FE_OK;
}

static int32_t find_frame(const fe_history *h, int64_t number)
{
    int32_t low = 0, high = h->count;
    while (low < high) {
        int32_t middle = (low + high) / 2;
        if (fe__history_frame(h, middle)->number < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low < h->count && fe__history_frame(h, low)->number == number ? low : -1;
}

fe_result fe__history_restore(fe_history *h, int64_t number)
{
    fe_world *w = h->world;
    int32_t i = find_frame(h, number);
    if (i < 0) return FE_ERROR_STALE;
    const fe__frame *frame = fe__history_frame(h, i);
    if (!is_last_frame(h) || frame->held != fe__history_frame(h, h->count - 1)->held) {
        fe_result result = fe__held_return(frame->held, w);
        if (result != FE_OK) return result;
    }
    w->step_number = frame->step_number;
    w->last_h = frame->last_h, w->last_dt = frame->last_dt;
    drop_after(h, i);
    h->entries = w->owner.entries;
    return FE_OK;
}
