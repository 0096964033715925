-- Recordings on every Lua: bytes in memory and in files, flight recorders, notes, and what goes wrong.
local lu = require("luaunit")
local feather = require("feather")
local core = feather._core
local STEP = 1 / 60

local function fails(text, call, ...)
    local ok, told = pcall(call, ...)
    lu.assertFalse(ok)
    lu.assertStrContains(tostring(told), text)
end
local function steps(world, count)
    for _ = 1, count do world:update(STEP) end
end
local function scene()
    local world = feather.newWorld()
    world:newBody({ type = "static" }):newPlane(0, 1, 0, 0)
    local ball = world:newBody({ position = { 0, 2, 0 } })
    ball:newSphere(0.5)
    return world, ball
end
local function contents(path)
    local file = assert(io.open(path, "rb"))
    local bytes = file:read("*a")
    file:close()
    return bytes
end

TestRecordings = {}

-- The same calls give the same bytes, read at once, in pieces, or through a file.
function TestRecordings.testBytesAreThoseOfTheCalls()
    local function record(how)
        local world, ball = scene()
        local path = os.tmpname()
        local recorder = how == "file" and world:record(path) or world:newRecorder()
        local pieces = {}
        recorder:note("the ball", ball)
        for step = 1, 60 do
            if step == 30 then ball:applyImpulse(100, 0, 0) end
            world:update(STEP)
            if how == "pieces" then pieces[#pieces + 1] = recorder:read() end
            if how == "file" and step == 20 then recorder:flush() end
        end
        if how ~= "file" then pieces[#pieces + 1] = recorder:read() end
        if how ~= "file" then lu.assertEquals(recorder:read(), "") end
        recorder:close()
        recorder:close()
        local bytes = how == "file" and contents(path) or table.concat(pieces)
        os.remove(path)
        return bytes, world:getHash()
    end
    local whole, hash = record("once")
    local pieces, hash_of_pieces = record("pieces")
    local file, hash_of_file = record("file")
    lu.assertEquals(whole:sub(1, 4), file:sub(1, 4))
    lu.assertStrContains(whole, "the ball")
    lu.assertStrContains(pieces, "the ball")
    lu.assertStrContains(file, "the ball")
    lu.assertEquals({ hash_of_pieces, hash_of_file }, { hash, hash })
    lu.assertTrue(#whole > 500 and #pieces >= #whole and #file >= #whole)
    for _, bytes in ipairs({ whole, pieces, file }) do
        local path = os.tmpname()
        local out = assert(io.open(path, "wb"))
        out:write(bytes)
        out:close()
        -- a program in C that plays it, and prints the hash at its end
        local play = assert(io.popen(os.getenv("FEATHER_PLAY") .. " " .. path))
        lu.assertEquals(play:read("*a"), "60 " .. hash .. "\n")
        play:close()
        os.remove(path)
    end
end

function TestRecordings.testAFileGrowsWithTheSteps()
    local world = scene()
    local path = os.tmpname()
    local recording = world:record(path, { fine = true, keyframeSteps = 0 })
    steps(world, 30)
    recording:flush()
    local size = #contents(path)
    steps(world, 30)
    recording:close()
    lu.assertTrue(size > 500 and #contents(path) > size)
    steps(world, 10)
    os.remove(path)
end

function TestRecordings.testAnUpdateDoesNotFail()
    local world = scene()
    fails("no/such", world.record, world, "/no/such/folder/run.feather")
    local recording = world:record(os.tmpname())
    recording.file:close() -- as if the disk were gone
    recording.file = { write = function() return nil, "the disk is full" end, close = function() return true end }
    steps(world, 40)
    fails("disk is full", recording.flush, recording)
    fails("disk is full", recording.close, recording)
    recording:close()
    world:newRecorder():close() -- another begins
    if io.open("/dev/full", "wb") then
        recording = world:record("/dev/full")
        steps(world, 40)
        fails("", recording.close, recording)
    end
end

function TestRecordings.testAFlightRecorderKeepsWhatFits()
    local world = scene()
    local recorder = world:newRecorder({ last = true, keyframeSteps = 10, bufferBytes = 65536 })
    for _ = 1, 50 do
        world:newBody({ position = { 0, 3, 0 } }):newBox(0.1, 0.1, 0.1)
        steps(world, 10)
    end
    local bytes = recorder:read()
    lu.assertTrue(#bytes > 0 and #bytes <= 65536)
    lu.assertEquals(recorder:read(), bytes)
    fails("flight recorder", world.record, world, os.tmpname(), { last = true })
    recorder:close()
end

function TestRecordings.testARecorderOutlivesItsWorld()
    local world = scene()
    local recorder = world:newRecorder()
    steps(world, 10)
    world:destroy()
    lu.assertTrue(#recorder:read() > 0)
    lu.assertEquals(recorder:read(), "")
    fails("ended", recorder.note, recorder, "late")
    fails("destroyed", world.newRecorder, world)
    recorder:close()
    fails("closed", recorder.read, recorder)
    fails("closed", recorder.note, recorder, "late")
end

function TestRecordings.testALostRecorderEnds()
    local world = scene()
    for _ = 1, 20 do
        world:newRecorder()
        collectgarbage()
        collectgarbage()
    end
    feather.newWorld():newRecorder()
    collectgarbage()
    collectgarbage()
    steps(world, 3)
end

function TestRecordings.testWhatIsRefused()
    local world, ball = scene()
    local other, foreign = scene()
    local recorder = world:newRecorder()
    fails("recorder already", world.newRecorder, world)
    fails("string", recorder.note, recorder, 7)
    fails("string", recorder.note, recorder, nil)
    fails("zero", recorder.note, recorder, "a\0b")
    fails("length", recorder.note, recorder, ("x"):rep(4097))
    fails("another world", recorder.note, recorder, "x", foreign)
    fails("body", recorder.note, recorder, "x", world)
    fails("body", recorder.note, recorder, "x", 5)
    recorder:note(("x"):rep(4096), ball:getShapes()[1])
    fails("true or false", other.newRecorder, other, { fine = "yes" })
    fails("speed", other.newRecorder, other, { speed = 1 })
    fails("buffer_bytes", other.newRecorder, other, { bufferBytes = 1 })
    fails("keyframe_steps", other.newRecorder, other, { keyframeSteps = -1 })
    fails("path", other.record, other, 7)
    for _, wrong in ipairs({ 0, "x", {}, io.stdout, true }) do
        fails("feather", core.recorder_read, wrong)
        fails("feather", core.recorder_note, wrong, 0, "x")
        fails("feather", core.recorder_destroy, wrong)
        fails("feather", core.recorder_create, wrong, nil)
    end
end

os.exit(lu.LuaUnit.run(), true)
