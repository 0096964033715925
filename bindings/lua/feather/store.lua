-- Stores, their heightfields, and pools: what several worlds may share.
local native = require("feather.native")
local objects = require("feather.objects")
local options = require("feather.options")
local core = native.core
local World, Store, Heightfield, Pool = objects.World, objects.Store, objects.Heightfield, objects.Pool
local shared = {}

function shared.new_pool(workers) return setmetatable({ native = core.pool_create(workers) }, Pool) end
function Pool:close() core.pool_destroy(self.native) end

function shared.new_store(given)
    local def = core.store_def()
    for name, value in pairs(given or {}) do options.put(def, "fe_store_def", name, value) end
    return setmetatable({ native = core.store_create(def), objects = objects.weak() }, Store)
end

-- The one it was made with, or its own.
function World:getStore()
    if not self.store then
        local store = { native = core.world_get_store(self.native), world = self, objects = objects.weak() }
        self.store = setmetatable(store, Store)
    end
    return self.store
end

function Store:destroy()
    if self.destroyed then return end
    core.store_destroy(self.native)
    self.destroyed = true
end
function Store:isDestroyed() return self.destroyed == true or (self.world ~= nil and self.world:isDestroyed()) end
function Store:getBytes() return core.store_get_bytes(self.native) end

-- ---- heightfields ---------------------------------------------------------------------------------------------------

-- The object of a handle that the core told. No method: a script could pass NaN, and LuaJIT 2.1 crashes where a trace
-- stores with a key of NaN.
function shared.heightfield_of(store, id)
    local found = store.objects[id]
    if not found then
        found = setmetatable({ store = store, native = store.native, id = id }, Heightfield)
        store.objects[id] = found
    end
    return found
end

local KNOWN = {
    rows = true, columns = true, cellX = true, cellZ = true, heights = true, holes = true, cellMaterials = true,
    materials = true,
}
-- { rows = , columns = , cellX = , cellZ = , heights = {...}, holes = {...}, cellMaterials = {...},
-- materials = { { friction = 0.8, userId = 3 }... } }
function Store:newHeightfield(given)
    options.check(given, KNOWN, "heightfield")
    local materials
    if given.materials ~= nil then
        materials = {}
        for i, material in ipairs(given.materials) do
            materials[i] = options.material_numbers(material, options.default_material())
        end
    end
    return shared.heightfield_of(self, core.heightfield_create(self.native, {
        rows = given.rows, columns = given.columns, cell_x = given.cellX or 1, cell_z = given.cellZ or 1,
        heights = given.heights, holes = given.holes, cell_materials = given.cellMaterials, materials = materials,
    }))
end
function World:newHeightfield(given) return self:getStore():newHeightfield(given) end

function Heightfield:destroy() core.asset_destroy(self.native, self.id) end
function Heightfield:isDestroyed() return self.store:isDestroyed() or core.asset_is_valid(self.native, self.id) == 0 end
function Heightfield:getStore() return self.store end
function Heightfield:setHeights(row, column, rows, columns, heights)
    core.heightfield_set_heights(self.native, self.id, row, column, rows, columns, heights)
end
function Heightfield:getHeights(row, column, rows, columns)
    return core.heightfield_get_heights(self.native, self.id, row, column, rows, columns)
end

return shared
