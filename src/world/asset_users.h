// asset_users.h - the shapes of a world that have assets of its store, and edits of assets in all worlds that use them.
#ifndef FE_WORLD_ASSET_USERS_H
#define FE_WORLD_ASSET_USERS_H
#include "store/asset.h"
#include "world/world.h"

// Joins the store of the source, if there is one, or of the definition, or makes one of the world's own.
// FE_ERROR_STALE, FE_ERROR_ARGUMENT: see fe__store_join.
fe_result fe__world_open_store(fe_world *world, const fe_world_def *def, const fe_world *source);
void fe__world_close_store(fe_world *world); // releases all assets

// Reserves uses for the assets of a shape of that form and of its parts: the next fe__shape_take_asset of each cannot
// fail. 0: no memory
int32_t fe__reserve_asset_use(fe_world *world, const fe__form *form);
void fe__shape_take_asset(fe_world *world, int32_t shape);    // becomes a user of its form's asset, if it has one
void fe__shape_release_asset(fe_world *world, int32_t shape); // the last user of a destroyed asset frees it

void fe__world_release_assets(fe_world *world); // all of them; under the store's lock
// The use of an asset, under the store's lock. NULL: no shape has it
fe__asset_use *fe__find_asset_use(const fe_world *world, int32_t asset);
// 1: a shape of the world has the asset, under whatever scale.
int32_t fe__uses_asset(const fe_world *world, int32_t asset);

// ---- edits, under the store's lock ----------------------------------------------------------------------------------
typedef struct fe__assets_entered {
    const int32_t *assets;
    int32_t count;
    const fe_world *but; // a world that the caller is inside already; or NULL
} fe__assets_entered;
// Every other world that uses one of the assets is entered for writing, or none: FE_ERROR_STEPPING, FE_ERROR_BUSY.
fe_result fe__assets_enter_worlds(fe_store *store, const fe__assets_entered *entered);
void fe__assets_leave_worlds(fe_store *store, const fe__assets_entered *entered);
// The worlds were entered. New heights reach the shapes' bounds and trees at once, the contacts in the next step;
// bodies near them wake.
void fe__heightfield_edit(fe_store *store, int32_t asset, const fe__samples *part, const float *heights);
// New materials of a mesh, as many as it has. Bodies that touch it wake.
void fe__mesh_edit_materials(fe_store *store, int32_t asset, const void *materials, uint32_t stride);
// Does in one world what both edits do: for shapes of a heightfield or mesh whose contents changed since their boxes
// and pairs were made.
void fe__asset_renew(fe_world *world, const fe__asset_use *use);

#endif
