-- The classes, and their objects: one for each handle. An object keeps its world, or its store, alive. User data is any
-- Lua value, kept by the world.
local native = require("feather.native")
local options = require("feather.options")
local fail = require("feather.where").fail
local core = native.core
local objects = {
    World = {}, Body = {}, Shape = {}, Joint = {}, Store = {}, Heightfield = {}, Hull = {}, Mesh = {}, Compound = {},
    Pool = {}, History = {}, Recorder = {}, Recording = {}, State = {}, Batch = {}, Player = {},
}

for name, class in pairs(objects) do
    class.__index = class
    class.__name = "feather." .. name
    class.__tostring = function(self)
        return self.id and string.format("%s %.0f", class.__name, self.id) or class.__name
    end
end
local Body, Joint = objects.Body, objects.Joint

-- The object of a handle; nil for 0, which is the world's end of a joint.
function objects.of(world, class, id)
    if id == 0 then return nil end
    local found = world.objects[id]
    if not found then
        found = setmetatable({ world = world, native = world.native, id = id }, class)
        world.objects[id] = found
    end
    return found
end
local of = objects.of

function objects.all(world, class, ids)
    local made = {}
    for i = 1, #ids do made[i] = of(world, class, ids[i]) end
    return made
end

function objects.weak() return setmetatable({}, { __mode = "v" }) end

local function is_alive(world, id)
    return core.body_is_valid(world, id) ~= 0 or core.shape_is_valid(world, id) ~= 0 or
        core.joint_is_valid(world, id) ~= 0
end
-- After a restore: what is no more. Its handle may be given again, to something without its user data.
function objects.forget_ended(world)
    for _, kept in ipairs({ world.objects, world.data }) do
        for id in pairs(kept) do
            if id ~= 0 and not is_alive(world.native, id) then kept[id] = nil end
        end
    end
end

-- The handle of an object of this world.
function objects.handle(world, thing, class)
    if type(thing) ~= "table" or getmetatable(thing) ~= class then
        fail("a %s is needed, not a %s", class.__name, type(thing))
    end
    if thing.world ~= world then fail("%s belongs to another world", tostring(thing)) end
    return thing.id
end

-- Those of a table of things of a class; a table of handles is one already.
local function ids_of(world, things, class, words)
    if type(things) ~= "table" then fail("a table of %s is needed, not a %s", words, type(things)) end
    if type(things[1]) == "number" then return things end
    local ids = {}
    for i = 1, #things do ids[i] = objects.handle(world, things[i], class) end
    return ids
end
function objects.handles(world, bodies) return ids_of(world, bodies, Body, "bodies") end
function objects.joint_handles(world, joints) return ids_of(world, joints, Joint, "joints") end

-- Vectors go to the core in tables that are used again and again.
local vector = { 0, 0, 0 }
function objects.xyz(x, y, z)
    vector[1], vector[2], vector[3] = x, y, z
    return vector
end
local second = { 0, 0, 0 }
function objects.xyz2(x, y, z)
    second[1], second[2], second[3] = x, y, z
    return second
end

-- { x, y, z }, or with a rotation { x, y, z, qx, qy, qz, qw }
function objects.pose(place)
    if type(place) ~= "table" then fail("a place is needed: { x, y, z }") end
    return { place[1], place[2], place[3], place[4] or 0, place[5] or 0, place[6] or 0, place[7] or 1 }
end

-- ---- methods that many classes have ---------------------------------------------------------------------------------

-- Getters and setters that hand their numbers through.
function objects.accessors(class, prefix, list)
    for method, name in pairs(list) do
        local get, set = core[prefix .. "_get_" .. name], core[prefix .. "_set_" .. name]
        if get then class["get" .. method] = function(self) return get(self.native, self.id) end end
        if set then class["set" .. method] = function(self, ...) return set(self.native, self.id, ...) end end
    end
end

function objects.switches(class, prefix, list)
    for method, name in pairs(list) do
        local get, set = core[prefix .. "_get_" .. name], core[prefix .. "_set_" .. name]
        class["is" .. method] = function(self) return get(self.native, self.id) ~= 0 end
        class["set" .. method] = function(self, value) set(self.native, self.id, options.switch(value, name)) end
    end
end

function objects.life(class, prefix)
    local valid, destroy = core[prefix .. "_is_valid"], core[prefix .. "_destroy"]
    function class:isDestroyed() return self.world.destroyed or valid(self.native, self.id) == 0 end
    function class:destroy()
        destroy(self.native, self.id)
        self.world.data[self.id] = nil
    end
    function class:getWorld() return self.world end
    function class:setUserData(value) self.world.data[self.id] = value end
    function class:getUserData() return self.world.data[self.id] end
end

return objects
