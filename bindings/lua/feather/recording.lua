-- Recordings: what a world was, and each call that changed it since, as bytes of docs/RECORDING.md.
local native = require("feather.native")
local objects = require("feather.objects")
local options = require("feather.options")
local fail = require("feather.where").fail
local core, World, Recorder, Recording = native.core, objects.World, objects.Recorder, objects.Recording

local FLAGS = { assets = 1, fine = 2, last = 4 } -- bits of fe_record_flags
local DRAIN_STEPS = 15 -- between two writes to a file: a quarter of a second is lost by a crash

local function begin(world, given)
    local def, set = core.recorder_def(), { assets = true }
    for name, value in pairs(given or {}) do
        if FLAGS[name] then set[name] = options.switch(value, name) ~= 0
        else options.put(def, "fe_recorder_def", name, value) end
    end
    local bits = 0
    for name, bit in pairs(FLAGS) do bits = bits + (set[name] and bit or 0) end
    def.flags = bits
    return core.recorder_create(world.native, def)
end

-- ---- bytes in memory ------------------------------------------------------------------------------------------------

-- { assets = true, fine = false, last = false, keyframeSteps = 600, bufferBytes = 64 MB }: what its assets hold is in
-- the recording; more traces, so that the first body that differs is named; a flight recorder of what fits into
-- bufferBytes; steps between keyframes. It ends with close(), when it is lost, or with its world.
function World:newRecorder(given) return setmetatable({ native = begin(self, given), world = self }, Recorder) end

-- A string of what was recorded since the last read, to be appended to a file; "" when nothing waits. Of a flight
-- recorder all that it keeps.
function Recorder:read() return core.recorder_read(self.native) end

local NOTED = { [objects.Body] = true, [objects.Shape] = true, [objects.Joint] = true }
-- Leaves words at this moment, about a body, a shape, a joint of the world, or nothing.
function Recorder:note(text, about)
    local id = 0
    if about ~= nil then
        local class = type(about) == "table" and getmetatable(about)
        if not NOTED[class] then fail("about: a body, a shape or a joint is needed, not a %s", type(about)) end
        id = objects.handle(self.world, about, class)
    end
    core.recorder_note(self.native, id, text)
end

-- What nobody read is lost. Closing again does nothing.
function Recorder:close()
    if self.closed then return end
    core.recorder_destroy(self.native)
    self.closed = true
end

-- ---- a file ---------------------------------------------------------------------------------------------------------

-- Writes a file while the world is updated, each 15 steps or, with fine = true, each one. close() writes the rest. The
-- table is that of newRecorder without last.
function World:record(path, given)
    if type(path) ~= "string" then fail("path: a string is needed, not a %s", type(path)) end
    if given and given.last then fail("last: a flight recorder is read as a whole, see newRecorder") end
    local recorder = self:newRecorder(given)
    local file, why = io.open(path, "wb") -- a file that was there stays, when the world cannot be recorded
    if not file then
        recorder:close()
        fail("%s", why)
    end
    local interval = given and given.fine and 1 or DRAIN_STEPS
    self.recording = setmetatable({
        world = self, recorder = recorder, file = file, interval = interval, steps = 0,
    }, Recording)
    return self.recording
end

-- A step does not fail because somebody records: flush and close tell. Nothing is written behind a gap.
local function drain(self)
    if self.failure or self.closed then return end
    local done, bytes = pcall(self.recorder.read, self.recorder)
    local written, why = done, bytes
    if done then written, why = self.file:write(bytes) end
    if not written then self.failure = tostring(why) end
end

-- World:update calls it: it writes what is new, now and then.
function Recording:afterStep()
    self.steps = self.steps + 1
    if self.steps < self.interval then return end
    self.steps = 0
    drain(self)
end

-- Leaves words at this moment, about a body, a shape, a joint or nothing.
function Recording:note(text, about) self.recorder:note(text, about) end

-- Writes all that was recorded until now. An error for what went wrong since it began.
function Recording:flush()
    drain(self)
    if not self.failure and not self.closed then
        local done, why = self.file:flush()
        if not done then self.failure = tostring(why) end
    end
    if self.failure then fail("%s", self.failure) end
end

-- Writes the rest, and closes the file. An error as of flush. Closing again does nothing.
function Recording:close()
    if self.closed then return end
    drain(self)
    self.closed = true
    if self.world.recording == self then self.world.recording = nil end
    self.recorder:close()
    local done, why = self.file:close()
    if not done then self.failure = self.failure or tostring(why) end
    if self.failure then fail("%s", self.failure) end
end
