// pair_rows.c - see rows.h: pairs, their contacts and points, ignored bodies, encounters.
#include "state/rows.h"

#include "world/encounter.h"
#include "world/ignore.h"
#include "world/pairs.h"

#include <string.h>

#define ROWS(rows, length, following)                                  \
    int32_t fe__count_##rows(const fe_world *world) { return length; } \
    static int32_t next_##rows(const fe_world *world, int32_t place) { return following; }
#define RECORDS(rows, record)                                                      \
    static const void *rows##_at(const fe_world *world, int32_t place, void *room) \
    {                                                                              \
        (void)world, (void)room;                                                   \
        return record;                                                             \
    }

// ---- pairs: contact 0 is no contact ---------------------------------------------------------------------------------
static int32_t live_pairs(const fe_world *w) { return w->pair_count + w->field_pair_count * (FE__PATCHES - 1); }

static int32_t next_pair(const fe_world *w, int32_t place)
{
    for (place = fe__maxi(place, 0) + 1; place < w->pair_limit && w->pairs[place].flags & FE__PAIR_FREE;) ++place;
    return place;
}

static int32_t next_with_points(const fe_world *w, int32_t place)
{
    do place = next_pair(w, place);
    while (place < w->pair_limit && !w->contacts[place].points);
    return place;
}

// A pair that has patches, or one of them
static int32_t next_patched(const fe_world *w, int32_t place)
{
    do place = next_pair(w, place);
    while (place < w->pair_limit && w->pairs[place].next_patch < 0 && w->pairs[place].head < 0);
    return place;
}

static int32_t next_awake(const fe_world *w, int32_t place)
{
    do place = next_pair(w, place);
    while (place < w->pair_limit && w->pairs[place].awake_index < 0);
    return place;
}

static int32_t points_in_use(const fe_world *w)
{
    return atomic_load_explicit(&w->point_count, memory_order_relaxed) - 1;
}

ROWS(pairs, live_pairs(world), next_pair(world, place))
RECORDS(pairs, world->pairs + place)
ROWS(found, live_pairs(world), next_pair(world, place))
RECORDS(found, world->contacts + place)

ROWS(patches, world->field_pair_count *FE__PATCHES, next_patched(world, place))
static const void *patches_at(const fe_world *world, int32_t place, void *room)
{
    const fe__pair *p = world->pairs + place;
    *(fe__patch_row *)room = (fe__patch_row){place, p->next_patch, p->head, p->triangle};
    return room;
}

ROWS(touching, points_in_use(world), next_with_points(world, place))
static const void *touching_at(const fe_world *world, int32_t place, void *room)
{
    const fe__contact *m = world->contacts + place;
    *(fe__touching_row *)room = (fe__touching_row){
        place, m->colour, m->point_count, {m->span[0], m->span[1], m->span[2]}, world->pairs[place].left_out};
    return room;
}
ROWS(points, points_in_use(world), next_with_points(world, place))
RECORDS(points, world->points + world->contacts[place].points)
ROWS(features, points_in_use(world), next_with_points(world, place))
RECORDS(features, world->features + world->contacts[place].points)
ROWS(extras, world->extra_capacity ? points_in_use(world) : 0, next_with_points(world, place))
RECORDS(extras, world->extras + world->contacts[place].points)
ROWS(awake_pairs, world->awake_pair_count, next_awake(world, place))
RECORDS(awake_pairs, fe__slot_in(room, place))

// ---- deferred pairs -------------------------------------------------------------------------------------------------
static int32_t is_deferred(const fe_world *w, int32_t pair) { return w->awake_pairs[w->pairs[pair].awake_index] < 0; }

// The one count that is not kept: the list is short against all that is written
int32_t fe__count_deferrals(const fe_world *world)
{
    int32_t count = 0;
    for (int32_t i = 0; i < world->awake_pair_count; ++i) count += world->awake_pairs[i] < 0;
    return count;
}

static int32_t next_deferrals(const fe_world *world, int32_t place)
{
    do place = next_awake(world, place);
    while (place < world->pair_limit && !is_deferred(world, place));
    return place;
}

static const void *deferrals_at(const fe_world *world, int32_t place, void *room)
{
    const fe__deferral *d = world->deferrals + world->pairs[place].awake_index;
    *(fe__deferral_row *)room = (fe__deferral_row){place,
                                                   d->gap,
                                                   d->most,
                                                   {d->apart[0], d->apart[1], d->apart[2]},
                                                   {world->odometers[d->body_a].turned - d->turned_a,
                                                    world->odometers[d->body_b].turned - d->turned_b}};
    return room;
}

// ---- slots without a pair -------------------------------------------------------------------------------------------
ROWS(free_pairs, world->pair_limit - 1 - live_pairs(world) - world->owed_count,
     place < 0 ? world->first_free_pair : world->pairs[place].links[0].next)
RECORDS(free_pairs, fe__slot_in(room, place))

ROWS(owed, world->owed_count, place < 0 ? world->first_owed : world->pairs[place].links[0].next)
static const void *owed_at(const fe_world *world, int32_t place, void *room)
{
    fe__owed_row *row = room;
    row->slot = place;
    memcpy(&row->exit, world->contacts + place, sizeof row->exit);
    return room;
}

// ---- record pools ---------------------------------------------------------------------------------------------------
static int32_t next_free(const fe__record_pool *pool, int32_t place)
{
    int32_t next;
    if (place < 0) return pool->first_free;
    memcpy(&next, fe__record(pool, place), sizeof next);
    return next;
}

// A record that is given back holds the next free one where the first body or shape stood: what is found by its own
// bodies or shapes is in use
static int32_t is_known(const fe__pair_set *set, int32_t a, int32_t b, int32_t index)
{
    return a != b && a >= 0 && b >= 0 && fe__pair_set_find(set, a, b) == index;
}

static int32_t next_ignore(const fe_world *w, int32_t place)
{
    for (place = fe__maxi(place, 0) + 1; place < w->ignores.limit; ++place) {
        const fe__ignore *i = fe__record(&w->ignores, place);
        if (is_known(&w->ignored, i->body[0], i->body[1], place)) break;
    }
    return place;
}

static int32_t next_encounter(const fe_world *w, int32_t place)
{
    for (place = fe__maxi(place, 0) + 1; place < w->encounters.limit; ++place) {
        const fe__encounter *e = fe__record(&w->encounters, place);
        if (is_known(&w->encounter_set, e->shape_a, e->shape_b, place)) break;
    }
    return place;
}

ROWS(free_ignores, world->ignores.free_count, next_free(&world->ignores, place))
RECORDS(free_ignores, fe__slot_in(room, place))
ROWS(ignores, fe__live_records(&world->ignores), next_ignore(world, place))
static const void *ignores_at(const fe_world *world, int32_t place, void *room)
{
    const fe__ignore *i = fe__record(&world->ignores, place);
    *(fe__ignore_row *)room = (fe__ignore_row){place, {i->body[0], i->body[1]}, {i->links[0].next, i->links[1].next}};
    return room;
}

ROWS(free_encounters, world->encounters.free_count, next_free(&world->encounters, place))
RECORDS(free_encounters, fe__slot_in(room, place))
ROWS(encounters, fe__live_records(&world->encounters), next_encounter(world, place))
static const void *encounters_at(const fe_world *world, int32_t place, void *room)
{
    const fe__encounter *e = fe__record(&world->encounters, place);
    *(fe__encounter_row *)room =
        (fe__encounter_row){place, e->shape_a, e->shape_b, e->lead, e->denied, e->entered, e->listed};
    return room;
}

// ---- blocks of rows
// ---------------------------------------------------------------------------------------------------
FE__GATHER(pairs)
FE__GATHER(found)
FE__GATHER(patches)
FE__GATHER(touching)
FE__GATHER(points)
FE__GATHER(features)
FE__GATHER(extras)
FE__GATHER(free_pairs)
FE__GATHER(owed)
FE__GATHER(awake_pairs)
FE__GATHER(deferrals)
FE__GATHER(ignores)
FE__GATHER(free_ignores)
FE__GATHER(encounters)
FE__GATHER(free_encounters)
