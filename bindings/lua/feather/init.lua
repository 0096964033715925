-- Feather: 3D rigid-body physics, in the style of love.physics: world:update(dt), body:getPosition() returns x, y, z,
-- definitions are tables, callbacks run after the step on the caller's thread. For Lua 5.1 to 5.4 it stands on the C
-- module feather.core, for LuaJIT on feather.ffi. Both have the functions of feather.h, see docs/lua.md. Metres,
-- kilograms, seconds, radians; rotations are x, y, z, w.
local core = require("feather.native").core
local options = require("feather.options")
local players = require("feather.player")
local shared = require("feather.store")
local snapshots = require("feather.snapshot")
local worlds = require("feather.world")
require("feather.history")
require("feather.state")
require("feather.batch")
require("feather.recording")
require("feather.body")
require("feather.shape")
require("feather.compound")
require("feather.joint")
require("feather.query")
require("feather.draw")

return {
    _core = core,
    VERSION = options.version_text(core.version()),
    newWorld = worlds.new,
    newPool = shared.new_pool,
    newStore = shared.new_store,
    newPlayer = players.new,
    loadWorld = snapshots.load,
    checkSnapshot = snapshots.check,
    getSnapshotAssets = snapshots.get_assets,
    compareSnapshots = snapshots.compare,
}
