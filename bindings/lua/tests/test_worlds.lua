-- What worlds share and measure, who collides with whom, and joints with the world; on every Lua, as test_feather.lua.
local lu = require("luaunit")
local feather = require("feather")
local core = feather._core
local STEP, G = 1 / 60, 9.81

local function ball_at(world, x, y, z, options)
    local body = world:newBody({ position = { x, y, z } })
    return body, body:newSphere(0.5, options)
end

local function ground_of(world, options)
    local ground = world:newBody({ type = "static" })
    return ground, ground:newPlane(0, 1, 0, 0, options)
end

local function fails(text, call, ...)
    local ok, message = pcall(call, ...)
    lu.assertFalse(ok)
    lu.assertStrContains(tostring(message), text)
    return message
end

-- ---- numbers, user data, stores -------------------------------------------------------------------------------------

TestSharing = {}

function TestSharing.testAHandleOfAnotherWorldIsRefused()
    local a, b = feather.newWorld({ number = 7 }), feather.newWorld({ number = 8 })
    lu.assertEquals({ a:getNumber(), b:getNumber() }, { 7, 8 })
    local body = a:newBody()
    lu.assertEquals(core.body_is_valid(b.native, body.id), 0)
    fails("fe_body_destroy", core.body_destroy, b.native, body.id)
    lu.assertNotEquals(feather.newWorld():getNumber(), feather.newWorld():getNumber())
    local clone = feather.newWorld({ number = 7 })
    lu.assertEquals(clone:newBody().id, body.id)
end

-- 2^64 - 1 and its neighbours come back as they went, where the language can hold them.
function TestSharing.testUserDataOf64Bits()
    local world = feather.newWorld()
    local body, shape = ball_at(world, 0, 0, 0)
    local joint = world:newFixedJoint({ bodyB = body, point = { 0, 0, 0 } })
    local values = { 0, 1, 2 ^ 53 - 1, 2 ^ 53 }
    if core.ffi then
        local whole = (loadstring("return { 18446744073709551615ULL, 9223372036854775808ULL, 9007199254740993ULL }"))()
        for _, value in ipairs(whole) do values[#values + 1] = value end
    elseif math.type then
        for _, value in ipairs({ -1, math.mininteger, math.maxinteger, math.tointeger(2 ^ 53) + 1 }) do
            values[#values + 1] = value
        end
    end
    for _, value in ipairs(values) do
        for _, thing in ipairs({ world, body, shape, joint }) do
            thing:setTag(value)
            lu.assertTrue(thing:getTag() == value)
        end
        shape:setMaterial({ userId = value })
        lu.assertTrue(shape:getMaterial().userId == value)
        lu.assertTrue(world:newBody({ tag = value }):getTag() == value)
        joint:set({ tag = value })
        lu.assertTrue(joint:getDefinition().tag == value)
        lu.assertTrue(world:rayCast(0, 9, 0, 0, -20, 0).material == value)
        lu.assertTrue(select(2, core.world_raycast_all(world.native, { 0, 9, 0 }, { 0, -20, 0 }, nil))[7] == value)
    end
    for _, wrong in ipairs({ -1.5, 0.5, 2 ^ 64, 0 / 0, "1", true }) do lu.assertFalse(pcall(body.setTag, body, wrong)) end
end

function TestSharing.testUserDataOfAnyValue()
    local world, value = feather.newWorld({ userData = "level 3" }), {}
    local body = world:newBody({ userData = value })
    local shape = body:newSphere(1, { userData = print })
    local joint = world:newBallJoint({ bodyA = body, point = { 0, 0, 0 }, userData = false })
    lu.assertEquals(world:getUserData(), "level 3")
    lu.assertIs(body:getUserData(), value)
    lu.assertIs(shape:getUserData(), print)
    lu.assertIs(joint:getUserData(), false)
    world:setUserData(nil)
    lu.assertNil(world:getUserData())
end

local function hill(store)
    return store:newHeightfield({ rows = 2, columns = 2, cellX = 4, cellZ = 4, heights = { 1, 1, 1, 1 } })
end

function TestSharing.testWorldsShareAStore()
    local store = feather.newStore({ number = 9 })
    local field = hill(store)
    local bytes = store:getBytes()
    lu.assertTrue(bytes > 0)
    local worlds = {}
    for i = 1, 3 do
        worlds[i] = feather.newWorld({ store = store })
        local shape = worlds[i]:newBody({ type = "static" }):newHeightfield(field)
        lu.assertIs(worlds[i]:getStore(), store)
        lu.assertIs(shape:getForm()[2], field)
        lu.assertAlmostEquals(worlds[i]:rayCast(2, 9, 2, 0, -20, 0).y, 1, 1e-6)
    end
    field:setHeights(0, 0, 2, 2, { 2, 2, 2, 2 })
    for i = 1, 3 do lu.assertAlmostEquals(worlds[i]:rayCast(2, 9, 2, 0, -20, 0).y, 2, 1e-6) end
    lu.assertEquals(store:getBytes(), bytes)
    fails("fe_store_destroy", store.destroy, store)
    for i = 1, 3 do worlds[i]:destroy() end
    store:destroy()
    store:destroy()
    lu.assertTrue(store:isDestroyed() and field:isDestroyed())
    fails("the store is destroyed", store.getBytes, store)
    fails("the store is destroyed", field.setHeights, field, 0, 0, 1, 1, { 0 })
    fails("the store is destroyed", feather.newWorld, { store = store })
end

function TestSharing.testAForeignStoresHeightfieldIsRefused()
    local field = hill(feather.newStore())
    local ground = feather.newWorld():newBody({ type = "static" })
    fails("fe_shape_create", ground.newHeightfield, ground, field)
end

function TestSharing.testAWorldsOwnStoreDiesWithIt()
    local world = feather.newWorld()
    local store = world:getStore()
    local field = hill(store)
    lu.assertIs(store, world:getStore())
    fails("fe_store_destroy", store.destroy, store)
    world:destroy()
    lu.assertTrue(store:isDestroyed() and field:isDestroyed())
    fails("the store is destroyed", store.getBytes, store)
    fails("the store is destroyed", field.getHeights, field, 0, 0, 1, 1)
end

-- Whatever the collector takes first.
function TestSharing.testAStoreLivesAsLongAsItsWorlds()
    local function made()
        local store = feather.newStore()
        local field = hill(store)
        local world = feather.newWorld({ store = store, pool = feather.newPool(2) })
        world:newBody({ type = "static" }):newHeightfield(field)
        return world.native, store.native
    end
    local natives = {}
    for i = 1, 20 do natives[i] = made() end
    for _ = 1, 3 do collectgarbage() end
    for i = 1, 20 do lu.assertEquals((select(4, core.world_raycast(natives[i], { 2, 9, 2 }, { 0, -20, 0 }, nil))), 1) end
    local own = feather.newWorld():getStore()
    for _ = 1, 3 do collectgarbage() end
    lu.assertTrue(own:getBytes() >= 0)
end

-- ---- measures -------------------------------------------------------------------------------------------------------

TestMeasures = {}

-- A free flight keeps the energy of the discrete flight to rounding, and its momentum grows by m g t.
function TestMeasures.testEnergyAndMomentumOfAFlight()
    local world = feather.newWorld()
    local body = ball_at(world, 3, 50, 0)
    body:setMass(2)
    body:setLinearVelocity(1, 0, 0)
    local kinetic, potential = world:getEnergy()
    local before = kinetic + potential
    lu.assertAlmostEquals(kinetic, 1, 1e-6) -- m v^2 / 2
    for _ = 1, 60 do world:update(STEP) end
    kinetic, potential = world:getEnergy()
    lu.assertAlmostEquals(kinetic + potential, before, before * 1e-5)
    lu.assertTrue(kinetic > 90) -- 2 g^2 / 2 after a second
    local px, py, pz, _, _, lz = world:getMomentum(0, 0, 0)
    lu.assertAlmostEquals(px, 2, 1e-5)
    lu.assertAlmostEquals(py, -2 * G, 1e-3)
    lu.assertAlmostEquals(pz, 0, 1e-6)
    local x, y = body:getCentre()
    lu.assertAlmostEquals(lz, x * py - y * px, 1e-2)
end

function TestMeasures.testBounds()
    local world = feather.newWorld()
    fails("fe_world_get_bounds", world.getBounds, world)
    local ground, plane = ground_of(world)
    local body, shape = ball_at(world, 1, 2, 3)
    body:newBox(0.25, 1, 0.25)
    for _, thing in ipairs({ { shape:getBounds() }, { body:getBounds() }, { world:getBounds() } }) do
        lu.assertEquals(#thing, 6)
        for i = 1, 3 do lu.assertTrue(thing[i] <= i - 0.5 + 1e-6 and thing[i + 3] >= i + 0.5 - 1e-6) end
        for i = 1, 6 do lu.assertTrue(math.abs(thing[i] - (i - 1) % 3 - 1) < 1.2) end
    end
    fails("fe_shape_get_bounds", plane.getBounds, plane)
    fails("fe_body_get_bounds", ground.getBounds, ground)
    lu.assertEquals(#world:overlapBounds(shape:getBounds()), 2)
    lu.assertEquals(#world:overlapBounds(9, 9, 9, 10, 10, 10), 0)
    lu.assertIs(world:overlapBounds(-9, -9, -9, 9, -8, 9)[1], plane)
end

-- A ball of 0.5 m at a depth of 0.2 m in the ground.
function TestMeasures.testOverlapShapes()
    local world = feather.newWorld()
    local ground, plane = ground_of(world, { material = { userId = 77 } })
    local found = world:overlapShapes({ "sphere", 0.5 }, { 0, 0.3, 0 })
    lu.assertEquals(#found, 1)
    local o = found[1]
    lu.assertIs(o.body, ground)
    lu.assertIs(o.shape, plane)
    lu.assertEquals({ o.material, o.part, o.triangle }, { 77, -1, -1 })
    lu.assertAlmostEquals(o.depth, 0.2, 1e-5)
    lu.assertAlmostEquals(o.dy, 1, 1e-6)
    lu.assertEquals(world:overlapShapes({ "sphere", 0.5 }, { 0, 0.6, 0 }), {})
end

function TestMeasures.testWhoIsInATrigger()
    local world = feather.newWorld({ gravity = { 0, 0, 0 } })
    local zone = world:newBody({ type = "static" }):newBox(2, 2, 2, { trigger = true })
    local _, inside = ball_at(world, 0, 0, 0)
    ball_at(world, 9, 0, 0)
    lu.assertEquals(zone:getOverlaps(), {})
    world:update(STEP)
    lu.assertEquals(#zone:getOverlaps(), 1)
    lu.assertIs(zone:getOverlaps()[1], inside)
end

function TestMeasures.testHitsReportMaterialsAndTriangles()
    local world = feather.newWorld()
    local field = world:newHeightfield({ rows = 2, columns = 2, heights = { 0, 0, 0, 0 } })
    world:newBody({ type = "static" }):newHeightfield(field, { material = { userId = 41 } })
    -- sample (0, 0), (1, 1) and the z side: triangle 0 of cell 0
    local hit = world:rayCast(0.25, 5, 0.75, 0, -10, 0)
    lu.assertEquals({ hit.material, hit.triangle, hit.part }, { 41, 0, -1 })
    lu.assertTrue(hit.u >= 0 and hit.v >= 0 and hit.u + hit.v <= 1 and hit.u + hit.v > 0)
    lu.assertEquals(world:closestPoint(0.75, 1, 0.25, 5).triangle, 1)
    local body = ball_at(world, 0.25, 2, 0.75, { events = { "touch", "hit" }, material = { userId = 42 } })
    local hits, begins = {}, {}
    for _ = 1, 60 do
        world:update(STEP)
        for _, e in ipairs(world:getHitEvents()) do hits[#hits + 1] = e end
        for _, e in ipairs(world:getContactEvents()) do begins[#begins + 1] = e end
    end
    lu.assertEquals({ hits[1].triangleA, hits[1].triangleB, hits[1].partA, hits[1].partB }, { 0, -1, -1, -1 })
    lu.assertNotNil(hits[1].materialA and hits[1].materialB)
    lu.assertEquals({ begins[1].kind, begins[1].triangleA, begins[1].partB }, { "enter", 0, -1 })
    local contact = body:getContacts()[1]
    lu.assertEquals({ contact.triangleA, contact.triangleB, contact.partA }, { 0, -1, -1 })
    lu.assertNotNil(contact.materialA and contact.materialB)
    lu.assertAlmostEquals(contact.points[1].y, 0, 0.01)
    lu.assertEquals(#contact.friction, 3)
end

-- ---- who collides with whom -----------------------------------------------------------------------------------------

TestFilters = {}

-- Where a ball is that fell on the ground for a second, by what the two are made with: on it, or 4 m below.
local function lands(ball_options, ground_options, prepare)
    local world = feather.newWorld()
    ground_of(world, ground_options)
    local body, shape = ball_at(world, 0, 0.5, 0, ball_options)
    if prepare then prepare(world, body, shape) end
    for _ = 1, 60 do world:update(STEP) end
    local _, y = body:getPosition()
    return math.abs(y - 0.5) < 0.01
end

function TestFilters.testGroups()
    lu.assertTrue(lands({}, {}))
    lu.assertFalse(lands({ mask = 2 }, {}))
    lu.assertTrue(lands({ mask = 2, group = 3 }, { group = 3 }))
    lu.assertFalse(lands({ group = -3 }, { group = -3 }))
    lu.assertTrue(lands({ group = -3 }, { group = -4 }))
    lu.assertFalse(lands({}, { group = -5 }, function(_, body)
        body:setFilter(1, 0xffffffff, -5)
        lu.assertEquals({ body:getFilter() }, { 1, 0xffffffff, -5 })
    end))
end

function TestFilters.testIgnoredPairs()
    local world = feather.newWorld()
    local a, b = ball_at(world, 0, 0, 0), ball_at(world, 5, 0, 0)
    lu.assertFalse(world:isIgnored(a, b))
    world:ignoreCollision(a, b)
    lu.assertTrue(world:isIgnored(b, a))
    world:ignoreCollision(a, b, false)
    lu.assertFalse(world:isIgnored(a, b))
end

function TestFilters.testPairFilter()
    local asked = {}
    local function judge(answer)
        return lands({ pairFilter = true, tag = 5 }, { tag = 6 }, function(world, body, shape)
            body:setTag(7)
            lu.assertTrue(shape:getPairFilter())
            world:setPairFilter(function(a, b, shape_a, shape_b, body_tag_a, body_tag_b, shape_tag_a, shape_tag_b)
                asked[#asked + 1] = { body_tag_a, body_tag_b, shape_tag_a, shape_tag_b }
                lu.assertIs(b, body)
                lu.assertIs(shape_b, shape)
                lu.assertIs(a:getWorld(), world)
                fails("in a step", a.getPosition, a)
                return answer
            end)
        end)
    end
    lu.assertTrue(judge(true))
    lu.assertFalse(judge(false))
    lu.assertEquals(asked, { { 0, 7, 6, 5 }, { 0, 7, 6, 5 } })
    -- nobody asks for it; it is taken away
    lu.assertTrue(lands({}, {}, function(world) world:setPairFilter(function() return false end) end))
    lu.assertTrue(lands({ pairFilter = true }, {}, function(world)
        world:setPairFilter(function() return false end)
        world:setPairFilter(nil)
    end))
    lu.assertTrue(lands({ pairFilter = true }, {}, function(world, _, shape)
        world:setPairFilter(function() return false end)
        shape:setPairFilter(false)
    end))
end

-- The step goes on as if the filter had said true; then its first error is raised, and the callbacks have been called.
function TestFilters.testErrorsOfThePairFilter()
    local thrown, calls, begun = {}, 0, 0
    local world = feather.newWorld()
    ground_of(world)
    for i = 0, 2 do ball_at(world, 3 * i, 0.49, 0, { pairFilter = true }) end
    world:setCallbacks({ beginContact = function() begun = begun + 1 end })
    world:setPairFilter(function()
        calls = calls + 1
        error(calls == 1 and thrown or "a later one")
    end)
    local ok, message = pcall(world.update, world, STEP)
    lu.assertFalse(ok)
    lu.assertIs(message, thrown)
    lu.assertEquals({ calls, begun }, { 3, 3 })
    world:update(STEP)
    lu.assertEquals(calls, 3)
end

function TestFilters.testWhatAPairFilterMayNotDo()
    local function first_error(filter)
        local world = feather.newWorld()
        ground_of(world)
        local body = ball_at(world, 0, 0.49, 0, { pairFilter = true })
        world:setPairFilter(function() return filter(world, body) end)
        local ok, message = pcall(world.update, world, STEP)
        lu.assertFalse(ok)
        for _ = 1, 30 do world:update(STEP) end
        lu.assertAlmostEquals(select(2, body:getPosition()), 0.5, 0.02)
        return tostring(message)
    end
    lu.assertStrContains(first_error(function() end), "returned a nil, not true or false")
    lu.assertStrContains(first_error(function() return 0 end), "returned a number")
    lu.assertStrContains(first_error(function(world) world:destroy() end), "fe_world_destroy")
    lu.assertStrContains(first_error(function(world) world:update(STEP) end), "fe_world_step")
    lu.assertStrContains(first_error(function(_, body) body:destroy() end), "fe_body_destroy")
    lu.assertStrContains(first_error(function(world) world:setPairFilter(nil) end), "fe_world_set_pair_filter")
    lu.assertStrContains(first_error(function() coroutine.yield() end), "yield")
    lu.assertStrContains(first_error(function() local function f() return 1 + f() end return f() end), "overflow")
    -- another world may step in it, with a filter of its own
    local other, asked = feather.newWorld(), 0
    ground_of(other)
    ball_at(other, 0, 0.49, 0, { pairFilter = true })
    other:setPairFilter(function()
        asked = asked + 1
        error("inner")
    end)
    lu.assertStrContains(first_error(function()
        lu.assertStrContains(select(2, pcall(other.update, other, STEP)), "inner")
        collectgarbage()
        error("outer")
    end), "outer")
    lu.assertEquals(asked, 1)
end

-- The flat function does so by itself, from a coroutine too, and a filter that knows its world keeps it no longer.
function TestFilters.testThePairFilterOfTheCore()
    local native = core.world_create(nil)
    local ground, ball = core.body_def(), core.body_def()
    ground.type, ball.transform.position.y = 0, 0.49
    local shape = core.shape_def()
    shape.pair_filter = 1
    core.shape_create(native, core.body_create(native, ground), nil, core.geometry_plane(0, 1, 0, 0))
    core.shape_create(native, core.body_create(native, ball), shape, core.geometry_sphere(0.5))
    core.world_set_pair_filter(native, function(...)
        lu.assertEquals(select("#", ...), 8)
        error("no")
    end)
    local co = coroutine.create(function() return pcall(core.world_step, native, STEP) end)
    local _, ok, message = coroutine.resume(co)
    lu.assertFalse(ok)
    lu.assertStrContains(message, "no")
    lu.assertEquals((core.world_get_pair_events(native)), 1)
    fails("a function is needed", core.world_set_pair_filter, native, 5)
    core.world_set_pair_filter(native, nil)
    core.world_step(native, STEP)

    local kept = setmetatable({}, { __mode = "k" })
    local function make()
        local world = feather.newWorld()
        world:setPairFilter(function() return world ~= nil end)
        kept[world] = true
    end
    make()
    for _ = 1, 3 do collectgarbage() end
    lu.assertNil(next(kept))
end

-- A ball passes a one-way floor from below and lands on it from above.
function TestFilters.testOneWay()
    local world = feather.newWorld()
    local floor = world:newBody({ type = "static", position = { 0, 2, 0 } }):newBox(4, 0.25, 4, { oneWay = true })
    lu.assertEquals({ floor:getOneWay() }, { true, 0, 1, 0 })
    local body = ball_at(world, 0, 0, 0)
    body:setLinearVelocity(0, 10, 0)
    local highest = 0
    for _ = 1, 240 do
        world:update(STEP)
        highest = math.max(highest, (select(2, body:getPosition())))
    end
    lu.assertTrue(highest > 4) -- v^2 / (2 g) = 5.1 m
    lu.assertAlmostEquals(select(2, body:getPosition()), 2.75, 0.01)
    floor:setOneWay(true, 0, -1, 0)
    lu.assertEquals({ floor:getOneWay() }, { true, 0, -1, 0 })
    floor:setOneWay(false)
    lu.assertEquals({ floor:getOneWay() }, { false, 0, -1, 0 })
end

-- Two surfaces of 0.9 and 0.1: a box on a slope of 0.5 slides unless the mode makes their friction larger.
function TestFilters.testCombineModes()
    local function moved(mode)
        local world = feather.newWorld()
        world:newBody({ type = "static" }):newPlane(0.5, 1, 0, 0, { friction = 0.9 })
        local angle = math.atan(0.5)
        local box = world:newBody({
            position = { 0.51 * math.sin(angle), 0.51 * math.cos(angle), 0 },
            rotation = { 0, 0, -math.sin(angle / 2), math.cos(angle / 2) },
        })
        box:newBox(0.5, 0.5, 0.5, { friction = 0.1, material = { frictionCombine = mode } })
        for _ = 1, 60 do world:update(STEP) end
        return (box:getPosition()) > 1
    end
    lu.assertTrue(moved("default")) -- sqrt(0.09) = 0.3
    lu.assertTrue(moved("minimum"))
    lu.assertTrue(moved("multiply"))
    lu.assertFalse(moved("maximum"))
    fails("frictionCombine: one of average, default, maximum, minimum, multiply is needed, not big", function() moved("big") end)
end

-- ---- joints ---------------------------------------------------------------------------------------------------------

TestJoints = {}

-- nil is the world: a pendulum of 1 m, 1e8 m away from the origin, where floats are 8 m apart.
function TestJoints.testAnEndIsTheWorld()
    local world, far = feather.newWorld(), 1e8
    local body = ball_at(world, far + 1, 0, 0)
    local joint = world:newBallJoint({ bodyB = body, point = { far, 0, 0 } })
    local a, b = joint:getBodies()
    lu.assertNil(a)
    lu.assertIs(b, body)
    lu.assertNil(joint:getDefinition().bodyA)
    for _ = 1, 60 do
        world:update(STEP)
        local x, y = body:getPosition()
        lu.assertAlmostEquals(math.sqrt((x - far) ^ 2 + y ^ 2), 1, 1e-3)
    end
    fails("fe_ball_joint", world.newBallJoint, world, { point = { 0, 0, 0 } })
    local weak = world:newFixedJoint({ bodyB = body, point = { far, 0, 0 }, breakForce = 0.001 })
    local broken
    world:setCallbacks({ jointBreak = function(...) broken = { n = select("#", ...), ... } end })
    for _ = 1, 5 do world:update(STEP) end
    lu.assertIs(broken[1], weak)
    lu.assertNil(broken[2])
    lu.assertIs(broken[3], body)
end

function TestJoints.testMotorSpeedAndTarget()
    local world = feather.newWorld({ gravity = { 0, 0, 0 } })
    local body = ball_at(world, 0, 0, 0)
    local o, z = { 0, 0, 0 }, { 0, 0, 1 }
    local hinge = world:newHingeJoint({ bodyB = body, point = o, axis = z, motorMax = 1000 })
    hinge:setMotorSpeed(2)
    lu.assertEquals(hinge:getDefinition().motorSpeed, 2)
    for _ = 1, 30 do world:update(STEP) end
    lu.assertAlmostEquals(select(3, body:getAngularVelocity()), 2, 0.02)
    hinge:set({ motorMax = 0, springHertz = 10, springMax = 1e6 })
    hinge:setTarget(0.5)
    for _ = 1, 120 do world:update(STEP) end
    lu.assertAlmostEquals(hinge:getAngle(), 0.5, 0.01)
    hinge:destroy()
    local ball = world:newBallJoint({ bodyB = body, point = o, springHertz = 10 })
    ball:setTarget(0, 0, math.sin(0.25), math.cos(0.25))
    lu.assertAlmostEquals(ball:getDefinition().target[3], math.sin(0.25), 1e-6)
    fails("fe_joint_set_target", ball.setTarget, ball, 1, "angularX")
    ball:destroy()
    local slider = world:newSliderJoint({ bodyB = body, point = o, axis = z, linearX = { motorMax = 10 } })
    slider:setMotorSpeed(1, "linearX")
    lu.assertEquals(slider:getDefinition().linearX.motorSpeed, 1)
    fails("one of angularX", slider.setMotorSpeed, slider, 1)
    fails("one of angularX", slider.setMotorSpeed, slider, 1, "alongX")
    slider:destroy()
    local rod = world:newDistanceJoint({ bodyB = body, pointA = o, pointB = { 2, 0, 0 }, lower = 1, upper = 3, springHertz = 2 })
    rod:setTarget(3)
    lu.assertEquals(rod:getDefinition().target, 3)
end

-- What getDefinition returns is what set and the constructors take.
function TestJoints.testDefinitionsGoRound()
    local world = feather.newWorld()
    local a, b = ball_at(world, 0, 0, 0), ball_at(world, 2, 0, 0)
    local o, z = { 1, 0, 0 }, { 0, 0, 1 }
    local made = {
        Distance = world:newDistanceJoint({ bodyA = a, bodyB = b, pointA = { 0, 0, 0 }, pointB = { 2, 0, 0 } }),
        Ball = world:newBallJoint({ bodyA = a, bodyB = b, point = o, coneEnabled = true, coneY = 0.5, coneZ = 0.25 }),
        Hinge = world:newHingeJoint({ bodyA = a, bodyB = b, point = o, axis = z, limitEnabled = true, lower = -1, upper = 0.5 }),
        Fixed = world:newFixedJoint({ bodyB = b, point = o, angularHertz = 3 }),
        Configurable = world:newConfigurableJoint({
            bodyA = a, bodyB = b, point = o, linearY = { motion = "limited", lower = -1, upper = 2, spring = "stiffness", springStiffness = 5 },
        }),
    }
    for name, joint in pairs(made) do
        local definition = joint:getDefinition()
        lu.assertEquals({ definition.enabled, definition.collideConnected }, { true, false })
        joint:set(definition)
        lu.assertEquals(joint:getDefinition(), definition)
        local twin = world["new" .. name .. "Joint"](world, definition)
        lu.assertEquals(twin:getDefinition(), definition)
    end
    fails("keeps its bodies", made.Hinge.set, made.Hinge, { bodyA = b })
end

-- ---- settings and options -------------------------------------------------------------------------------------------

TestOptions = {}

function TestOptions.testTuning()
    local world = feather.newWorld()
    lu.assertTrue(world:getTuning().sleepEnabled and world:getTuning().continuousEnabled)
    world:setTuning({ sleepEnabled = false, warmStartEnabled = false })
    lu.assertFalse(world:getTuning().sleepEnabled or world:getTuning().warmStartEnabled)
    world:setTuning(world:getTuning())
    ground_of(world)
    local body = ball_at(world, 0, 0.5, 0)
    for _ = 1, 120 do world:update(STEP) end
    lu.assertTrue(body:isAwake())
    world:setTuning({ sleepEnabled = true })
    for _ = 1, 120 do world:update(STEP) end
    lu.assertFalse(body:isAwake())
    -- contacts: an eighth of the substep rate, 8 * 60 / 8 = 60 1/s; joints: 0.225 of it
    world:setTuning({ contactHertz = 1000, jointHertz = 1000 })
    local contact, joint = world:getHertz(STEP)
    lu.assertAlmostEquals(contact, 60, 0.01)
    lu.assertAlmostEquals(joint, 108, 0.01)
    world:optimize()
    lu.assertTrue(world:getCounters().bytes > 0)
end

-- What nobody knows is an error that names it, and the line of the caller.
function TestOptions.testUnknownOptions()
    local world = feather.newWorld()
    local body, shape = ball_at(world, 0, 0, 0)
    local joint = world:newHingeJoint({ bodyB = body, point = { 0, 0, 0 }, axis = { 0, 0, 1 } })
    for option, call in pairs({
        gravty = function() feather.newWorld({ gravty = { 0, 0, 0 } }) end,
        nummer = function() feather.newStore({ nummer = 1 }) end,
        typ = function() world:newBody({ typ = "static" }) end,
        user_data = function() world:newBody({ user_data = 1 }) end,
        frction = function() body:newSphere(1, { frction = 1 }) end,
        colour = function() shape:setMaterial({ colour = 1 }) end,
        minAngle = function() joint:set({ minAngle = 1 }) end,
        travel = function() world:newHingeJoint({ bodyB = body, point = { 0, 0, 0 }, axis = { 0, 0, 1 }, travel = 1 }) end,
        mode = function() world:newConfigurableJoint({ bodyB = body, point = { 0, 0, 0 }, linearX = { mode = "free" } }) end,
        excluded = function() world:rayCast(0, 9, 0, 0, -20, 0, { excluded = { body } }) end,
        Mask = function() world:overlapAny({ "sphere", 1 }, { 0, 0, 0 }, { Mask = 1 }) end,
        beginContct = function() world:setCallbacks({ beginContct = print }) end,
        hertz = function() world:setTuning({ hertz = 1 }) end,
        columms = function() world:newHeightfield({ rows = 2, columms = 2, heights = { 0, 0, 0, 0 } }) end,
        struct_size = function() world:newBody({ struct_size = 4 }) end,
    }) do
        local message = fails(option, call)
        lu.assertStrContains(message, "test_worlds.lua:")
    end
    lu.assertNil(world:rayCast(0, 9, 0, 0, -20, 0, { exclude = body }))
    lu.assertNil(world:rayCast(0, 9, 0, 0, -20, 0, { exclude = { body } }))
end

function TestOptions.testWrongTypes()
    local world = feather.newWorld()
    local body = ball_at(world, 0, 0, 0)
    local joint = world:newHingeJoint({ bodyB = body, point = { 0, 0, 0 }, axis = { 0, 0, 1 } })
    fails("motorSpeed: a number is needed, not a boolean", joint.set, joint, { motorSpeed = true })
    fails("enabled: true or false is needed, not a string", joint.set, joint, { enabled = "yes" })
    fails("lower: a number is needed, not a table", joint.set, joint, { lower = {} })
    fails("gravity: a table of numbers is needed, not a number", feather.newWorld, { gravity = -9.8 })
    fails("gravity: number 3 is missing", feather.newWorld, { gravity = { 0, 1 } })
    fails("substeps: 2.5 is no integer", feather.newWorld, { substeps = 2.5 })
    fails("group: 1e+20 is no integer", body.newSphere, body, 1, { group = 1e20 })
    fails("store: what newStore returns", feather.newWorld, { store = world })
    fails("pool: what newPool returns", feather.newWorld, { pool = {} })
    fails("filter: a table is needed, not a string", world.rayCast, world, 0, 9, 0, 0, -20, 0, "triggers")
    fails("hit: a function is needed", world.setCallbacks, world, { hit = 5 })
    fails("linearX: a table", world.newConfigurableJoint, world, { bodyB = body, point = { 0, 0, 0 }, linearX = 3 })
end

-- Errors of the library name the caller's line too.
function TestOptions.testErrorsNameTheCaller()
    local world = feather.newWorld()
    local body = ball_at(world, 0, 0, 0)
    local ok, message = pcall(function() body:setMass(-1) end)
    lu.assertFalse(ok)
    lu.assertStrMatches(message, ".*test_worlds%.lua:%d+: fe_body_set_mass.*")
    lu.assertStrMatches(select(2, pcall(function() body:setPosition("x") end)), ".*test_worlds%.lua:%d+: feather: .*")
end

-- All callbacks run; then the first error is raised.
function TestOptions.testACallbackThatFails()
    local world, calls = feather.newWorld(), 0
    ground_of(world)
    for i = 0, 4 do ball_at(world, 3 * i, 0.49, 0) end
    world:setCallbacks({
        beginContact = function()
            calls = calls + 1
            error("call " .. calls, 0)
        end,
    })
    local ok, message = pcall(world.update, world, STEP)
    lu.assertEquals({ ok, message, calls }, { false, "call 1", 5 })
end

-- As games reload their scripts: the package is required anew, what the old one made goes on.
function TestOptions.testThePackageMayBeReloaded()
    local world, loaded = feather.newWorld(), {}
    local body = ball_at(world, 0, 5, 0)
    for name, module in pairs(package.loaded) do
        if name:find("^feather") then loaded[name] = module end
    end
    for name in pairs(loaded) do package.loaded[name] = nil end
    local done, again = pcall(require, "feather")
    for name, module in pairs(loaded) do package.loaded[name] = module end
    lu.assertTrue(done, again)
    lu.assertNotIs(again, feather)
    local other = again.newWorld()
    other:newBody({ type = "static" }):newPlane(0, 1, 0, 0)
    lu.assertAlmostEquals(other:rayCast(0, 1, 0, 0, -2, 0).fraction, 0.5, 1e-6)
    other:update(STEP)
    world:update(STEP)
    lu.assertTrue(select(2, body:getPosition()) < 5)
end

os.exit(lu.LuaUnit.run(), true)
