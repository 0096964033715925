-- Stores, their heightfields, hulls and meshes, and pools: what several worlds may share. Compounds are in
-- feather.compound.
local native = require("feather.native")
local objects = require("feather.objects")
local options = require("feather.options")
local fail = require("feather.where").fail
local core = native.core
local World, Store, Pool = objects.World, objects.Store, objects.Pool
local Heightfield, Hull, Mesh = objects.Heightfield, objects.Hull, objects.Mesh
local shared = {}

function shared.new_pool(workers) return setmetatable({ native = core.pool_create(workers) }, Pool) end
function Pool:close() core.pool_destroy(self.native) end

-- { number = 0 }, or nothing: its number is part of its assets' handles, 0 takes the next free one.
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
-- True after destroy(); of a world's own store, after the world's.
function Store:isDestroyed() return self.destroyed == true or (self.world ~= nil and self.world:isDestroyed()) end
function Store:getBytes() return core.store_get_bytes(self.native) end

-- ---- assets -----------------------------------------------------------------------------------------------------------

-- The object of a handle that the core told. No method: a script could pass NaN, and LuaJIT 2.1 crashes where a trace
-- stores with a key of NaN.
function shared.asset_of(store, class, id)
    local found = store.objects[id]
    if not found then
        found = setmetatable({ store = store, native = store.native, id = id }, class)
        store.objects[id] = found
    end
    return found
end

for _, class in ipairs({ Heightfield, Hull, Mesh, objects.Compound }) do
    function class:destroy() core.asset_destroy(self.native, self.id) end
    function class:isDestroyed() return self.store:isDestroyed() or core.asset_is_valid(self.native, self.id) == 0 end
    function class:getStore() return self.store end
    -- a string for Store:load, the same on every machine; of a compound with the assets of its parts
    function class:save() return (select(2, core.asset_save(self.native, self.id))) end
    -- 32 hexadecimal digits: equal content has equal keys, on every machine
    function class:getKey() return core.asset_get_key(self.native, self.id) end
end

local CLASSES = {
    [tonumber(core.geometry_heightfield(0).type)] = Heightfield, [tonumber(core.geometry_hull(0).type)] = Hull,
    [tonumber(core.geometry_mesh(0).type)] = Mesh, [tonumber(core.geometry_compound(0).type)] = objects.Compound,
}
-- The heightfield, hull, mesh or compound of which save() made the string. Any string may be given: it is sound, or an error.
function Store:load(bytes)
    local id = core.asset_load(self.native, bytes)
    return shared.asset_of(self, CLASSES[core.asset_get_type(self.native, id)], id)
end
-- The same, in the world's store.
function World:load(bytes) return self:getStore():load(bytes) end

local function numbers_of_materials(materials)
    if materials == nil then return nil end
    if type(materials) ~= "table" then fail("materials: a table is needed, not a %s", type(materials)) end
    local numbers = {}
    for i, material in ipairs(materials) do
        numbers[i] = options.material_numbers(material, options.default_material())
    end
    return numbers
end

-- ---- heightfields ---------------------------------------------------------------------------------------------------

local KNOWN = {
    rows = true, columns = true, cellX = true, cellZ = true, heights = true, holes = true, cellMaterials = true,
    materials = true,
}
-- { rows = , columns = , cellX = , cellZ = , heights = {...}, holes = {...}, cellMaterials = {...},
-- materials = { { friction = 0.8, userId = 3 }... } }
function Store:newHeightfield(given)
    options.check(given, KNOWN, "heightfield")
    return shared.asset_of(self, Heightfield, core.heightfield_create(self.native, {
        rows = given.rows, columns = given.columns, cell_x = given.cellX or 1, cell_z = given.cellZ or 1,
        heights = given.heights, holes = given.holes, cell_materials = given.cellMaterials,
        materials = numbers_of_materials(given.materials),
    }))
end
-- In the world's store, as Store:newHeightfield.
function World:newHeightfield(given) return self:getStore():newHeightfield(given) end

function Heightfield:setHeights(row, column, rows, columns, heights)
    core.heightfield_set_heights(self.native, self.id, row, column, rows, columns, heights)
end
function Heightfield:getHeights(row, column, rows, columns)
    return core.heightfield_get_heights(self.native, self.id, row, column, rows, columns)
end

-- ---- hulls ----------------------------------------------------------------------------------------------------------

local HULL = { points = true, maxVertices = true, tolerance = true }
-- { points = { x, y, z... }, maxVertices = 64, tolerance = 0 }
function Store:newHull(given)
    options.check(given, HULL, "hull")
    return shared.asset_of(self, Hull, core.hull_create(self.native, {
        points = given.points, max_vertices = given.maxVertices or 64, tolerance = given.tolerance or 0,
    }))
end
-- In the world's store, as Store:newHull.
function World:newHull(given) return self:getStore():newHull(given) end

function Hull:getInfo() return options.read(core.hull_get_info(self.native, self.id), "fe_hull_info") end
-- { x, y, z... }
function Hull:getVertices() return (select(2, core.hull_get_vertices(self.native, self.id))) end
-- { corners = { 0, 1, 2... }, normal = { x, y, z }, distance = } each: the first vertex is 0
function Hull:getFaces()
    local count, flat = core.hull_get_faces(self.native, self.id)
    local _, all = core.hull_get_corners(self.native, self.id)
    local faces = {}
    for i = 1, count do
        local at, corners = 6 * (i - 1), {}
        for k = 1, flat[at + 2] do corners[k] = all[flat[at + 1] + k] end
        faces[i] = { corners = corners, normal = { flat[at + 3], flat[at + 4], flat[at + 5] }, distance = flat[at + 6] }
    end
    return faces
end

-- ---- meshes ---------------------------------------------------------------------------------------------------------

local MESH = {
    vertices = true, triangles = true, twoSided = true, strict = true, weldDistance = true, edgeAngle = true,
    triangleMaterials = true, materials = true, triangleData = true,
}
-- { vertices = { x, y, z... }, triangles = { a, b, c... }, twoSided = false, strict = false, weldDistance = 0,
-- edgeAngle = 0.035, triangleMaterials = {...}, materials = { { friction = 0.8 }... }, triangleData = {...} }
-- The first vertex is 0, and so is the first triangle, as hits tell it.
function Store:newMesh(given)
    options.check(given, MESH, "mesh")
    local two_sided = given.twoSided ~= nil and options.switch(given.twoSided, "twoSided") or 0
    local strict = given.strict ~= nil and options.switch(given.strict, "strict") or 0
    return shared.asset_of(self, Mesh, core.mesh_create(self.native, {
        vertices = given.vertices, triangles = given.triangles, flags = two_sided + 2 * strict,
        weld_distance = given.weldDistance or 0, edge_angle = given.edgeAngle or 0.035,
        triangle_materials = given.triangleMaterials, materials = numbers_of_materials(given.materials),
        triangle_data = given.triangleData,
    }))
end
-- In the world's store, as Store:newMesh.
function World:newMesh(given) return self:getStore():newMesh(given) end

function Mesh:getInfo() return options.read(core.mesh_get_info(self.native, self.id), "fe_mesh_info") end

-- Arrays of a record: tables of the C module, places in memory of LuaJIT's ffi
local function corners_of(record)
    if not core.ffi then return record.corners end
    local flat, corners = {}, record.corners
    for i = 0, 2 do
        flat[3 * i + 1], flat[3 * i + 2], flat[3 * i + 3] = corners[i].x, corners[i].y, corners[i].z
    end
    return flat
end
local function edge_of(record, i)
    local bits = tonumber(core.ffi and record.edges[i] or not core.ffi and record.edges[i + 1])
    return { felt = bits % 2 >= 1, convex = bits % 4 >= 2, open = bits >= 4 }
end
-- { corners = { x, y, z... }, edges = { { felt = , convex = , open = }... }, material = -1, data = 0 }; nil for one that
-- was dropped
function Mesh:getTriangle(number)
    local record = core.mesh_get_triangle(self.native, self.id, number)
    if record.kept == 0 then return nil end
    return {
        corners = corners_of(record), edges = { edge_of(record, 0), edge_of(record, 1), edge_of(record, 2) },
        material = record.material, data = record.data,
    }
end
-- As many as it has: what touches it wakes.
function Mesh:setMaterials(materials)
    core.mesh_set_materials(self.native, self.id, numbers_of_materials(materials))
end

return shared
