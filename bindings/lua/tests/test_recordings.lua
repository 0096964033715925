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

-- ---- players ---------------------------------------------------------------------------------------------------------

TestPlayers = {}

local function recorded(count, given)
    local world, ball = scene()
    world:setUserData("level")
    local recorder, hashes = world:newRecorder(given), {}
    recorder:note("the ball", ball)
    for step = 1, count do
        if step == 30 then ball:applyImpulse(100, 0, 0) end
        if step == 40 then world:newBody({ position = { 3, 4, 0 } }):newBox(0.5, 0.5, 0.5) end
        world:update(STEP)
        hashes[step] = world:getHash()
    end
    return recorder:read(), hashes, ball.id
end

-- Forwards, backwards, from a file and in pieces; and the world is read as any other.
function TestPlayers.testARecordingIsPlayed()
    local bytes, hashes, ball = recorded(60)
    local path = os.tmpname()
    local file = assert(io.open(path, "wb"))
    file:write(bytes)
    file:close()
    local from_pieces = feather.newPlayer()
    for at = 1, #bytes, 1000 do from_pieces:feed(bytes:sub(at, at + 999)) end
    for _, player in ipairs({ feather.newPlayer({ bytes = bytes, workers = 2, simd = "auto" }),
        feather.newPlayer({ file = path }), from_pieces }) do
        fails("no world", player.getWorld, player)
        local step = 0
        for world in player:steps() do
            step = step + 1
            lu.assertEquals(world:getHash(), hashes[step])
        end
        lu.assertEquals(step, 60)
        lu.assertFalse(player:step())
        lu.assertEquals(#player:getWorld():getBodies(), 3)
        lu.assertTrue(player:seek(20))
        lu.assertEquals(player:getWorld():getHash(), hashes[20])
        lu.assertEquals(#player:getWorld():getBodies(), 2)
        lu.assertTrue(player:getWorld():rayCast(0, 9, 0, 0, -20, 0) ~= nil)
        lu.assertFalse(player:seek(99))
        local info = player:getInfo()
        lu.assertEquals({ info.step, info.firstStep, info.notes, info.hasDiverged }, { 60, 0, 1, false })
        lu.assertEquals(player:getNotes(), { { step = 0, about = ball, text = "the ball" } })
        lu.assertNil(player:getDivergence())
        fails("player's", player:getWorld().update, player:getWorld(), STEP)
        fails("player's", player:getWorld().destroy, player:getWorld())
        local world = player:getWorld()
        player:close()
        player:close()
        lu.assertTrue(world:isDestroyed())
        fails("destroyed", world.getHash, world)
        fails("closed", player.step, player)
    end
    os.remove(path)
end

-- It goes on from there, and outlives the player; a seek makes the player another one.
function TestPlayers.testItsWorldIsHandedOver()
    local bytes, hashes = recorded(60)
    local player = feather.newPlayer({ bytes = bytes, pool = feather.newPool(2), store = feather.newStore() })
    player:seek(50)
    local clone, world = player:getWorld():clone(), player:release()
    fails("", player.getWorld, player)
    for step = 51, 60 do
        world:update(STEP)
        clone:update(STEP)
        lu.assertEquals({ world:getHash(), clone:getHash() }, { hashes[step], hashes[step] })
    end
    player:seek(10)
    lu.assertEquals(player:getWorld():getHash(), hashes[10])
    player:close()
    player = nil
    collectgarbage()
    collectgarbage()
    world:update(STEP)
    world:newBody():newSphere(1)
    world:destroy()
    for _ = 1, 30 do -- players that are lost, with and without their worlds
        local lost = feather.newPlayer({ bytes = bytes })
        lost:seek(5)
        world = lost:getWorld()
    end
    collectgarbage()
    collectgarbage()
    lu.assertEquals(world:getHash(), hashes[5]) -- it keeps its player
end

-- The first keyframe of one flight, and the steps of another.
function TestPlayers.testADivergenceIsNamed()
    local function flight(speed, fine)
        local world = feather.newWorld({ number = 7 })
        local body = world:newBody({ linearVelocity = { 0, 0, speed } })
        body:newSphere(0.5)
        local recorder = world:newRecorder({ fine = fine })
        local first = recorder:read()
        steps(world, 60)
        return first, recorder:read(), body.id
    end
    for _, fine in ipairs({ false, true }) do
        local first, _, body = flight(1, fine)
        local player = feather.newPlayer({ bytes = first })
        player:feed((select(2, flight(2, fine))))
        fails("1", player.step, player)
        local found = player:getDivergence()
        lu.assertEquals({ found.type, found.step, player:getInfo().hasDiverged }, { "step", 1, true })
        lu.assertEquals({ found.body, found.component }, fine and { body, 2 } or { 0, -1 })
        if fine then lu.assertStrContains(found.field, "velocity") end
        while player:step() do end -- once
        lu.assertEquals(player:getDivergence(), found)
        lu.assertEquals(player:getInfo().step, 60)
    end
    local bytes = recorded(5)
    local broken = bytes:sub(1, 200) .. string.char((bytes:byte(201) + 1) % 256) .. bytes:sub(202)
    fails("", function()
        local player = feather.newPlayer({ bytes = broken })
        while player:step() do end
    end)
end

function TestPlayers.testWrongArgumentsAreNamed()
    fails("worker_count", feather.newPlayer, { workers = 100 })
    fails("simd", feather.newPlayer, { simd = "wide" })
    fails("newPool", feather.newPlayer, { pool = 5 })
    fails("newStore", feather.newPlayer, { store = {} })
    fails("speed", feather.newPlayer, { speed = 5 })
    fails("path", feather.newPlayer, { file = 5 })
    fails("no/such", feather.newPlayer, { file = "no/such" })
    fails("string", feather.newPlayer, { bytes = 5 })
    fails("", feather.newPlayer, { bytes = ("this is no recording"):rep(100) })
    local player = feather.newPlayer()
    lu.assertFalse(player:step())
    fails("step", player.seek, player, "x")
    fails("step", player.seek, player, 0.5)
    fails("player", core.player_step, scene().native)
end

os.exit(lu.LuaUnit.run(), true)
