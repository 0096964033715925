-- Clones of a world, and states to set worlds back to.
local native = require("feather.native")
local objects = require("feather.objects")
local worlds = require("feather.world")
local fail = require("feather.where").fail
local core, World, State = native.core, objects.World, objects.State

-- A second world like this one, of newWorld's table, in which workers, pool and simd count: both go on bit for bit, and
-- share a store. It has the pair filter and the user data, each the same value.
function World:clone(given)
    local def, made = worlds.definition(given)
    made.native = core.world_clone(self.native, def)
    made.store = made.store or self.store
    for id, value in pairs(self.data) do
        if id ~= 0 or made.data[0] == nil then made.data[id] = value end
    end
    setmetatable(made, World)
    if self.pairFilter then made:setPairFilter(self.pairFilter) end
    return made
end

-- What the world is now. It stays when the world is gone, until close() or the collector ends it.
function World:newState() return setmetatable({ native = core.state_create(self.native) }, State) end

-- The world becomes what a state is of, in the time of a copy: that world, a clone of it, or one of the same store.
-- Objects that are gone are forgotten, with their user data.
function World:setState(state)
    if type(state) ~= "table" or getmetatable(state) ~= State then
        fail("state: what newState returns is needed, not a %s", type(state))
    end
    core.world_set_state(self.native, state.native)
    objects.forget_ended(self)
end

-- Closing again does nothing.
function State:close()
    if self.closed then return end
    core.state_destroy(self.native)
    self.closed = true
end
