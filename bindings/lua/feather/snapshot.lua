-- Snapshots: worlds as strings of bytes, and what the strings tell.
local native = require("feather.native")
local objects = require("feather.objects")
local options = require("feather.options")
local worlds = require("feather.world")
local core, World = native.core, objects.World
local snapshots = {}

local SAVES = { assets = 1, base = 2 } -- bits of fe_save
-- A string; equal worlds have equal ones. { assets = true } writes what its hulls, meshes and heightfields hold, too:
-- where it is loaded, none need be there. { base = string }, of a save without one: what differs from it alone.
function World:save(given)
    local record
    if given ~= nil then
        options.check(given, SAVES, "options of save")
        record = core.save_options()
        record.flags = given.assets ~= nil and options.switch(given.assets, "assets") * SAVES.assets or 0
        if given.base ~= nil then
            record.flags = record.flags + SAVES.base
            native.set_base(record, given.base)
        end
    end
    return (select(2, core.world_save(self.native, record)))
end

-- ---- back -----------------------------------------------------------------------------------------------------------

local function restore_options(new_number, base)
    if new_number == nil and base == nil then return nil end
    local record = core.restore_options()
    if new_number ~= nil then options.put(record, "fe_restore_options", "newNumber", new_number) end
    if base ~= nil then native.set_base(record, base) end
    return record
end

local KNOWN = { newNumber = true, base = true }
-- Makes the world the saved one. Returns "foreign" when the string is from a library whose results differ: then it goes
-- on, not bit for bit. Objects that are gone are forgotten, with their user data. { newNumber = true }: handles have
-- this world's number, not that of the saved one. { base = string }: what a difference was saved against.
function World:restore(bytes, given)
    local known = given ~= nil and options.check(given, KNOWN, "options of restore") or {}
    local foreign = core.world_restore(self.native, restore_options(known.newNumber, known.base), bytes)
    objects.forget_ended(self)
    if foreign then return "foreign" end
end

-- A new world, made of a string and of newWorld's table, in which workers, pool, store, simd and userData count, and
-- with newNumber = true the number; all else is the saved world's. Behind it "foreign", as of restore.
function snapshots.load(bytes, given)
    local rest, new_number = {}, nil
    for name, value in pairs(given or {}) do
        if name == "newNumber" then new_number = value else rest[name] = value end
    end
    local def, world = worlds.definition(rest)
    local foreign
    foreign, world.native = core.world_load(def, restore_options(new_number), bytes)
    setmetatable(world, World)
    if foreign then return world, "foreign" end
    return world
end

-- ---- without a world ------------------------------------------------------------------------------------------------

-- What a string is, after every check of a restore but for assets that are not in it; or an error.
function snapshots.check(bytes) return options.read(core.snapshot_check(bytes), "fe_snapshot_info") end
-- The keys of the assets that it needs, as asset:getKey() has them.
function snapshots.get_assets(bytes) return (select(2, core.snapshot_get_assets(bytes))) end

-- A text of a record, which is an array of characters in LuaJIT
local text = core.text or tostring

-- Where two worlds first differ, of their strings: nil, or { kind, field, a, b, handle, other, index, element }, the
-- values as texts. Elements and entries of lists count from 1.
function snapshots.compare(a, b)
    local found = core.snapshot_compare(a, b)
    if not found then return nil end
    return {
        kind = text(found.kind), field = text(found.field), a = text(found.a), b = text(found.b),
        handle = tonumber(found.handle), other = tonumber(found.other), index = found.index + 1,
        element = found.element + 1,
    }
end

return snapshots
