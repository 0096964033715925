-- Worlds: making them, the step, the pair filter, settings and sums.
local native = require("feather.native")
local events = require("feather.events")
local objects = require("feather.objects")
local options = require("feather.options")
local fail = require("feather.where").fail
local core, of, xyz = native.core, objects.of, objects.xyz
local World, Body, Shape, Store, Pool = objects.World, objects.Body, objects.Shape, objects.Store, objects.Pool
local worlds = {}

local function check_class(value, class, what)
    if type(value) ~= "table" or getmetatable(value) ~= class then
        fail("%s: what new%s returns is needed, not a %s", what, class.__name:sub(9), type(value))
    end
    return value
end

-- A world's definition, and the world without its native.
function worlds.definition(given)
    local def, pool, store, data = core.world_def(), nil, nil, nil
    for name, value in pairs(given or {}) do
        if name == "workers" then options.put(def, "fe_world_def", "workerCount", value)
        elseif name == "pool" then pool = check_class(value, Pool, name)
        elseif name == "store" then store = check_class(value, Store, name)
        elseif name == "userData" then data = value
        else options.put(def, "fe_world_def", name, value) end
    end
    if pool then native.set_pool(def, pool.native) end
    if store then native.set_store(def, store.native) end
    return def, { pool = pool, store = store, data = { [0] = data }, callbacks = {}, objects = objects.weak() }
end

function worlds.new(given)
    local def, world = worlds.definition(given)
    world.native = core.world_create(def)
    return setmetatable(world, World)
end

function World:destroy()
    if self.destroyed then return end
    core.world_destroy(self.native)
    self.destroyed, self.data = true, {}
end
-- True after destroy().
function World:isDestroyed() return self.destroyed == true end
-- Any value of yours; getUserData returns it.
function World:setUserData(value) self.data[0] = value end
-- What setUserData or newWorld's table gave; nil at first.
function World:getUserData() return self.data[0] end

-- ---- the step -------------------------------------------------------------------------------------------------------

-- Steps, then calls what was set with setCallbacks. There everything is allowed, destroying bodies too. An error of the
-- pair filter or of a callback is raised when all are done: the first one.
function World:update(dt)
    core.world_step(self.native, dt)
    if self.recording then self.recording:afterStep() end
    local failed = self.filterError
    self.filterError = nil
    if next(self.callbacks) then
        local first = events.fire(self)
        failed = failed or first
    end
    if failed then error(failed[1], 0) end
end

local function ask(world, filter, a, b, shape_a, shape_b, ...)
    local may = filter(of(world, Body, a), of(world, Body, b),
        of(world, Shape, shape_a), of(world, Shape, shape_b), ...)
    if type(may) ~= "boolean" then fail("the pair filter returned a %s, not true or false", type(may)) end
    return may
end

-- filter(bodyA, bodyB, shapeA, shapeB, bodyTagA, bodyTagB, shapeTagA, shapeTagB) returns true when the two may collide.
-- The step calls it for new pairs of which one shape has pairFilter = true. A filter that fails counts as true.
function World:setPairFilter(filter)
    if filter ~= nil and type(filter) ~= "function" then fail("a function is needed, not a %s", type(filter)) end
    local weak = setmetatable({ world = self }, { __mode = "v" }) -- the core must not keep the world alive
    core.world_set_pair_filter(self.native, filter and function(...)
        local world = weak.world
        local done, may = pcall(ask, world, world.pairFilter, ...)
        if done then return may end
        world.filterError = world.filterError or { may }
        return true
    end)
    self.pairFilter = filter
end

-- ---- settings -------------------------------------------------------------------------------------------------------

function World:setGravity(x, y, z) core.world_set_gravity(self.native, xyz(x, y, z)) end
function World:getGravity() return core.world_get_gravity(self.native) end
function World:setSubsteps(count) core.world_set_substeps(self.native, count) end
function World:getSubsteps() return core.world_get_substeps(self.native) end
function World:setTag(tag) core.world_set_user_data(self.native, tag) end
function World:getTag() return core.world_get_user_data(self.native) end
function World:getNumber() return core.world_get_number(self.native) end
function World:getTuning() return options.read(core.world_get_tuning(self.native), "fe_world_tuning") end
-- Changes what the table names.
function World:setTuning(given)
    local tuning = core.world_get_tuning(self.native)
    for name, value in pairs(given) do options.put(tuning, "fe_world_tuning", name, value) end
    core.world_set_tuning(self.native, tuning)
end
-- Stiffness of contacts and of joints in a step of dt.
function World:getHertz(dt) return core.world_get_hertz(self.native, dt) end
function World:ignoreCollision(a, b, ignore)
    a, b = objects.handle(self, a, Body), objects.handle(self, b, Body)
    core.world_ignore_collision(self.native, a, b, ignore == nil and 1 or options.switch(ignore, "ignore"))
end
function World:isIgnored(a, b)
    a, b = objects.handle(self, a, Body), objects.handle(self, b, Body)
    return core.world_get_ignored(self.native, a, b) ~= 0
end
function World:optimize() core.world_optimize(self.native) end

-- ---- sums and measures ----------------------------------------------------------------------------------------------

function World:getHash() return core.world_hash(self.native) end
-- lower x, y, z, upper x, y, z
function World:getBounds() return core.world_get_bounds(self.native) end
-- kinetic, potential
function World:getEnergy()
    local energy = core.world_get_energy(self.native)
    return energy.kinetic, energy.potential
end
-- linear x, y, z, and angular x, y, z about a point
function World:getMomentum(x, y, z) return core.world_get_momentum(self.native, xyz(x or 0, y or 0, z or 0)) end
function World:getProfile() return options.read(core.world_get_profile(self.native), "fe_profile") end
function World:getCounters() return options.read(core.world_get_counters(self.native), "fe_counters") end

return worlds
