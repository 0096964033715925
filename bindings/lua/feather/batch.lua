-- Batches: many clones of a world that step together.
local native = require("feather.native")
local objects = require("feather.objects")
local options = require("feather.options")
local fail = require("feather.where").fail
local core, World, Batch, Pool = native.core, objects.World, objects.Batch, objects.Pool
local Body, Shape, Joint = objects.Body, objects.Shape, objects.Joint

-- name: fe_field, what its rows are of, numbers in a row
local FIELDS = {
    transform = { 1, Body, 7 }, velocity = { 2, Body, 6 }, force = { 3, Body, 6 }, awake = { 4, Body, 1 },
    joint = { 5, Joint, 2 }, jointForce = { 6, Joint, 1 }, jointSpeed = { 7, Joint, 1 },
    jointTarget = { 8, Joint, 1 }, reaction = { 9, Joint, 6 }, gravity = { 10, nil, 3 },
    contactForce = { 11, Body, 3 }, mass = { 12, Body, 1 }, friction = { 13, Shape, 2 },
}
local KNOWN = { workers = true, block = true, simd = true, pool = true }

-- So many clones of this world, which stays the caller's: its bodies, shapes and joints name those of each of them.
-- { workers = 1, pool = a pool, block = 0, simd = "auto" }: who steps them; worlds that a worker takes at once, 0 is
-- chosen.
function World:newBatch(count, given)
    given = given and options.check(given, KNOWN, "options of newBatch") or {}
    if given.pool ~= nil and (type(given.pool) ~= "table" or getmetatable(given.pool) ~= Pool) then
        fail("pool: what newPool returns is needed, not a %s", type(given.pool))
    end
    local def = core.world_def() -- knows the words of SIMD sets
    if given.simd ~= nil then options.put(def, "fe_world_def", "simd", given.simd) end
    local made = core.batch_create(self.native, count, given.workers or 1, given.block or 0, tonumber(def.simd),
        given.pool and given.pool.native)
    return setmetatable({ native = made, world = self, pool = given.pool, store = self.store }, Batch)
end

-- What a field is of, and the handles of its items.
local function field_of(batch, name, items)
    local field = FIELDS[name]
    if not field then fail("field: there is none called %s", tostring(name)) end
    if not field[2] then
        if items ~= nil then fail("%s: the field has no items", name) end
        return field
    end
    if type(items) ~= "table" or #items == 0 then fail("%s: a table of items is needed", name) end
    local ids = {}
    for i = 1, #items do ids[i] = objects.handle(batch.world, items[i], field[2]) end
    return field, ids
end

-- All of these return how many worlds failed, and where some did a table with a result for each, 0 where all went well.
-- A mask is a boolean a world.

-- Each world as world:update does, so many steps (1); what was written acts in the first of them.
function Batch:step(dt, steps, mask) return core.batch_step(self.native, dt, steps or 1, mask) end
-- Back to what the world was when the batch was made, or states[i] of each.
function Batch:reset(mask, states)
    local natives
    if states ~= nil then
        if type(states) ~= "table" then fail("states: a table is needed, not a %s", type(states)) end
        natives = {}
        for i, state in pairs(states) do natives[i] = type(state) == "table" and state.native or state end
    end
    return core.batch_reset(self.native, mask, natives)
end
-- Numbers as of read, world by world, into a field.
function Batch:write(name, items, numbers, mask)
    local field, ids = field_of(self, name, items)
    return core.batch_write(self.native, field[1], ids, field[3], numbers, mask)
end
-- The numbers of a field in a flat table, world by world, and then what the others return.
function Batch:read(name, items)
    local field, ids = field_of(self, name, items)
    return core.batch_read(self.native, field[1], ids, field[3])
end

-- world:getHash() of each.
function Batch:getHashes() return core.batch_hash(self.native) end

-- Closing again does nothing.
function Batch:close()
    if self.closed then return end
    core.batch_destroy(self.native)
    self.closed = true
end
