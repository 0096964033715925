-- Batches on every Lua: worlds that step together are what each would be alone.
local lu = require("luaunit")
local feather = require("feather")
local core = feather._core
local STEP, COUNT = 1 / 60, 5

local function fails(text, call, ...)
    local ok, told = pcall(call, ...)
    lu.assertFalse(ok)
    lu.assertStrContains(tostring(told), text)
end

-- A ball and a box on the ground, and an arm on a hinge.
local function scene(given)
    local world = feather.newWorld(given)
    world:newBody({ type = "static" }):newPlane(0, 1, 0, 0)
    local ball, box = world:newBody({ position = { 0, 3, 0 } }), world:newBody({ position = { 3, 0.5, 0 } })
    local shape = ball:newSphere(0.5)
    box:newBox(0.5, 0.5, 0.5)
    local arm = world:newBody({ position = { -3, 4, 0 } })
    arm:newBox(1, 0.1, 0.1)
    local hinge = world:newHingeJoint({ bodyB = arm, point = { -4, 4, 0 }, axis = { 0, 0, 1 }, motorMax = 50 })
    return world, ball, box, shape, hinge
end

TestBatches = {}

function TestBatches.testABatchIsALoop()
    local world, ball, box, _, hinge = scene()
    local batch = world:newBatch(COUNT, { workers = 2, block = 1, simd = "auto" })
    local forces, speeds = {}, {}
    for w = 1, COUNT do
        for k = 1, 6 do forces[6 * (w - 1) + k] = k == 1 and 100 * w or 0 end
        speeds[w] = 0.5 * w
    end
    local alone = {}
    for w = 1, COUNT do alone[w] = world:clone() end
    lu.assertEquals(batch:write("jointSpeed", { hinge }, speeds), 0)
    for _ = 1, 20 do
        lu.assertEquals(batch:write("force", { ball }, forces), 0)
        lu.assertEquals(batch:step(STEP), 0)
    end
    for w = 1, COUNT do
        local one = alone[w]
        one:getJoints()[1]:setMotorSpeed(speeds[w])
        for _ = 1, 20 do
            one:getBodies()[2]:applyForce(100 * w, 0, 0)
            one:update(STEP)
        end
        lu.assertEquals(batch:getHashes()[w], one:getHash())
    end
    local poses = batch:read("transform", { ball, box })
    lu.assertEquals(#poses, 14 * COUNT)
    local x, y, z = alone[3]:getBodies()[2]:getPosition()
    for k, exact in ipairs({ x, y, z }) do lu.assertAlmostEquals(poses[28 + k], exact, 1e-6) end -- floats
end

function TestBatches.testWorldsGoBackAndSomeStay()
    local world, ball = scene()
    local batch = world:newBatch(COUNT)
    local first = batch:getHashes()
    local later = world:clone()
    for _ = 1, 7 do later:update(STEP) end
    lu.assertEquals(batch:step(STEP, 7, { true, true, false, true, true }), 0)
    local hashes = batch:getHashes()
    lu.assertEquals({ hashes[1], hashes[3], hashes[5] }, { later:getHash(), first[1], later:getHash() })
    lu.assertEquals(batch:reset({ true, false, false, false, false }), 0)
    lu.assertEquals({ batch:getHashes()[1], batch:getHashes()[2] }, { first[1], later:getHash() })
    lu.assertEquals(batch:reset(nil, { [3] = later:newState() }), 0)
    hashes = batch:getHashes()
    lu.assertEquals({ hashes[2], hashes[3] }, { first[1], later:getHash() })
    local masses = batch:read("mass", { ball })
    for w = 1, COUNT do masses[w] = masses[w] + w end
    lu.assertEquals(batch:write("mass", { ball }, masses), 0)
    lu.assertEquals(batch:read("mass", { ball }), masses)
    lu.assertEquals(batch:write("gravity", nil, { 0, -1, 0, 0, -2, 0, 0, -3, 0, 0, -4, 0, 0, -5, 0 }), 0)
    lu.assertEquals(batch:read("gravity")[14], -5)
end

function TestBatches.testWhatFailsFailsAlone()
    local world, ball, _, shape = scene()
    local batch = world:newBatch(3)
    local rows = {}
    for i = 1, 18 do rows[i] = 0 end
    rows[7] = 0 / 0
    local failed, results = batch:write("force", { ball }, rows)
    lu.assertEquals(failed, 1)
    lu.assertEquals({ results[1], results[3] }, { 0, 0 })
    lu.assertTrue(results[2] < 0)
    local numbers, none = batch:read("friction", { shape })
    lu.assertEquals({ #numbers, none }, { 6, 0 })
    world:setPairFilter(function() error("never") end) -- of the template; a batch made now has none
    local other = world:newBatch(2)
    lu.assertEquals(other:step(STEP, 60), 0)
    ball:destroy()
    lu.assertEquals(batch:step(STEP), 0) -- those of the batch live
    batch:close()
    batch:close()
    fails("closed", batch.step, batch, STEP)
    fails("closed", core.batch_hash, batch.native)
end

function TestBatches.testWrongArgumentsAreNamed()
    local world, ball, _, shape = scene()
    local batch, hash = world:newBatch(2), world:getHash()
    fails("colour", batch.read, batch, "colour")
    fails("items", batch.read, batch, "transform")
    fails("no items", batch.read, batch, "gravity", { ball })
    fails("Body", batch.read, batch, "transform", { shape })
    fails("another world", batch.read, batch, "transform", { select(2, scene()) })
    fails("12 are needed", batch.write, batch, "force", { ball }, { 1 })
    fails("numbers", batch.write, batch, "force", { ball }, "x")
    fails("mask", batch.step, batch, STEP, 1, { true })
    fails("steps", batch.step, batch, STEP, 0)
    fails("dt", batch.step, batch, 0 / 0)
    fails("states", batch.reset, batch, nil, 7)
    fails("state", batch.reset, batch, nil, { 7 })
    fails("world_count", world.newBatch, world, 0)
    fails("number", world.newBatch, world, "many")
    fails("worker_count", world.newBatch, world, 1, { workers = 100 })
    fails("speed", world.newBatch, world, 1, { speed = 1 })
    fails("newPool", world.newBatch, world, 1, { pool = 5 })
    fails("batch", core.batch_step, world.native, STEP, 1)
    lu.assertEquals(batch:getHashes(), { hash, hash })
end

function TestBatches.testABatchKeepsItsPoolAndItsStore()
    local function make()
        local store = feather.newStore()
        return (scene({ store = store })):newBatch(2, { pool = feather.newPool(2) })
    end
    local batch = make()
    for _ = 1, 3 do
        collectgarbage()
        lu.assertEquals(batch:step(STEP, 10), 0)
    end
    for _ = 1, 20 do make():step(STEP) end
    collectgarbage()
end

os.exit(lu.LuaUnit.run(), true)
