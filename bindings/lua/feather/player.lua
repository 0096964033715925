-- Players: what was recorded is played, and compared at each step.
local native = require("feather.native")
local objects = require("feather.objects")
local options = require("feather.options")
local fail = require("feather.where").fail
local core, World, Player, Pool, Store = native.core, objects.World, objects.Player, objects.Pool, objects.Store
local players = {}

local KNOWN = { workers = true, simd = true, pool = true, store = true, file = true, bytes = true }
local DIVERGENCES = { "call", "step", "keyframe" }
local PIECE = 1048576 -- bytes of a file that are read at once

local function native_of(value, class, what)
    if value == nil then return nil end
    if type(value) ~= "table" or getmetatable(value) ~= class then
        fail("%s: what new%s returns is needed, not a %s", what, class.__name:sub(9), type(value))
    end
    return value.native
end

local function feed_file(player, path)
    local file, why = io.open(path, "rb")
    if not file then fail("%s", why) end
    local done, told = true, nil
    for bytes in function() return done and file:read(PIECE) end do done, told = pcall(player.feed, player, bytes) end
    file:close()
    if not done then error(told, 0) end
end

-- { file = "run.feather" } or { bytes = a string }, or feed() it; workers, simd, pool; store: where assets are found
-- that the recording does not hold.
function players.new(given)
    given = given and options.check(given, KNOWN, "options of newPlayer") or {}
    local pool, store = native_of(given.pool, Pool, "pool"), native_of(given.store, Store, "store")
    if given.file ~= nil and type(given.file) ~= "string" then fail("file: a path is needed, not a %s", type(given.file)) end
    local def = core.world_def() -- knows the words of SIMD sets
    if given.simd ~= nil then options.put(def, "fe_world_def", "simd", given.simd) end
    local made = core.player_create(given.workers or 1, tonumber(def.simd), pool, store)
    local player = setmetatable({ native = made, pool = given.pool, store = given.store }, Player)
    if given.file ~= nil then feed_file(player, given.file) end
    if given.bytes ~= nil then player:feed(given.bytes) end
    return player
end

-- Adds bytes of a recording, in pieces of any size. An error for what is no recording or was altered: what stood before
-- it plays.
function Player:feed(bytes) core.player_feed(self.native, bytes) end

-- Makes the recorded calls up to the end of the next step. false: there is no more yet. An error, once, when the world
-- went another way: getDivergence tells, and the next call goes on.
function Player:step() return core.player_step(self.native) end

-- Goes to the end of a step, forwards or backwards, as getInfo counts them. false: the recording ends before it.
-- Objects of what is not there at that step mean something else, or nothing: they are not to be kept.
function Player:seek(step)
    local found = core.player_seek(self.native, step)
    if self.seen then objects.forget_ended(self.seen) end
    return found
end

-- The world as it is now, to be read: what changes it is an error, and so is this before the first step.
function Player:getWorld()
    local view = core.player_get_world(self.native)
    if not self.seen then
        self.seen = setmetatable({
            native = view, store = self.store, data = {}, callbacks = {}, objects = objects.weak(), player = self,
        }, World)
    end
    return self.seen
end

-- for world in player:steps() do ... end: steps to the end.
function Player:steps()
    return function()
        if self:step() then return self:getWorld() end
    end
end

-- Hands the world over: it may be changed and updated from here on, and outlives the player. A pair filter of the
-- recorded world lets all pairs collide. A seek makes the player another world.
function Player:release()
    local world = self:getWorld()
    core.player_release(self.native)
    self.seen, world.player = nil, nil
    return world
end

-- { step, firstStep, lastStep, calls, bytes, keyframes, notes, library, flags, foreign, hasDiverged }
function Player:getInfo() return core.player_get_info(self.native) end
-- { step, about, text } of the words that were left in what it was fed: about is a handle, or 0.
function Player:getNotes() return core.player_get_notes(self.native) end
-- nil, or { type = "call", "step" or "keyframe", step, body, field, component, text }
function Player:getDivergence()
    if not self:getInfo().hasDiverged then return nil end
    local found = core.player_get_divergence(self.native)
    found.type = DIVERGENCES[found.type]
    return found
end

-- Ends it, and its world unless that was released. Closing again does nothing.
function Player:close()
    if self.closed then return end
    core.player_destroy(self.native)
    self.closed = true
    if self.seen then self.seen.destroyed, self.seen.data = true, {} end
    self.seen = nil
end

return players
