// assemble.c - see assemble.h: the members of the world, then the parts in their order.
#include "state/assemble.h"

#include "solver/solver.h"
#include "world/encounter.h"
#include "world/ignore.h"

#include <string.h>

// ---- the world -----------------------------------------------------------------------------------------------------
static int32_t take_world(fe__build *b, fe__world_row *row)
{
    fe_world *w = b->world;
    if (fe__rows_of(b->snapshot, FE__TABLE_WORLD) != 1)
        return fe__snapshot_refuse(b->snapshot, "there is not one world");
    fe__take_row(b->snapshot, FE__TABLE_WORLD, 0, row);
    row->tuning.struct_size = sizeof row->tuning;
    if (row->next_serial == 0 || row->next_serial >> (64 - FE__PART_BITS) != 0 || row->step_number < 0)
        return fe__snapshot_refuse(b->snapshot, "the next serial is %llu, the step %lld",
                                   (unsigned long long)row->next_serial, (long long)row->step_number);
    if (row->row_kinds >> FE__ROW_KINDS << FE__ROW_KINDS || row->joint_row_kinds >> FE__PARTS ||
        row->pair_colours > FE__PAIR_COLOURS || row->static_colours > FE__STATIC_COLOURS ||
        row->most_joints > FE_ID_MAX_SLOTS)
        return fe__snapshot_refuse(b->snapshot, "there are no such rows or colours");
    if (row->has_extras && !(row->row_kinds >> FE__ROW_SPECIAL))
        return fe__snapshot_refuse(b->snapshot, "there are extras, but no special rows");
    w->user_data = row->user_data;
    w->next_serial = row->next_serial;
    w->step_number = row->step_number;
    w->gravity = row->gravity;
    w->substeps = row->substeps;
    w->last_h = row->last_h, w->last_dt = row->last_dt;
    w->row_kinds = row->row_kinds;
    w->tuning = row->tuning;
    w->first_body = w->last_body = w->first_free_pair = -1;
    w->pair_limit = 1;
    atomic_store(&w->point_count, 1);
    w->pair_colours = row->pair_colours, w->static_colours = row->static_colours;
    w->joints.row_kinds = row->joint_row_kinds;
    w->joints.most = row->most_joints;
    w->joints.forest.changed = 1;
    fe__record_pool_init(&w->ignores, sizeof(fe__ignore));
    fe__record_pool_init(&w->encounters, sizeof(fe__encounter));
    return 1;
}

static int32_t build_with_assets(fe__build *b)
{
    if (!fe__rows_of(b->snapshot, FE__TABLE_ASSETS)) return 1;
    fe__store_lock(b->world->store);
    int32_t built = fe__build_assets(b);
    fe__store_unlock(b->world->store);
    return built;
}

int32_t fe__build_world(fe__build *b)
{
    fe__world_row row;
    memset(&row, 0, sizeof row);
    return take_world(b, &row) && fe__build_slots(b, &row) && fe__build_bodies(b) && fe__build_shapes(b) &&
           build_with_assets(b) && fe__build_parts(b) && fe__build_joints(b) && fe__build_trees(b) &&
           fe__build_ignores(b, &row) && fe__build_pairs(b, &row) && fe__build_encounters(b, &row) &&
           fe__build_awake(b) && fe__build_events(b);
}
