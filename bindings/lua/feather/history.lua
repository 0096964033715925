-- Histories: the last frames of a world, in memory, for rollback.
local native = require("feather.native")
local objects = require("feather.objects")
local options = require("feather.options")
local core, World, History = native.core, objects.World, objects.History

-- { frames = 16, bytes = 0 }: how many are kept, and what they may hold together, 0 is as much as they need. It ends
-- with close() or with its world.
function World:newHistory(given)
    local def = core.history_def()
    for name, value in pairs(given or {}) do options.put(def, "fe_history_def", name, value) end
    return setmetatable({ native = core.history_create(self.native, def), world = self }, History)
end

-- The world as it is, under a number above the last one kept. The oldest go.
function History:keep(frame) core.history_keep(self.native, frame) end

-- Puts the world back; the frames behind go. Objects that are gone are forgotten, with their user data.
function History:restore(frame)
    core.history_restore(self.native, frame)
    objects.forget_ended(self.world)
end

-- { frame = 3, bytes = 5000 } for each, the oldest first: its number, and what it holds that the one before has not.
function History:getFrames()
    local count, numbers = core.history_get_frames(self.native)
    local frames = {}
    for i = 1, count do frames[i] = { frame = numbers[2 * i - 1], bytes = numbers[2 * i] } end
    return frames
end

-- Ends it and gives its memory back.
function History:close() core.history_destroy(self.native) end
