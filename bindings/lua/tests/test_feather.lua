-- The same tests on every Lua: lua5.1, lua5.3, lua5.4, LuaJIT with the C module and with its ffi.
local lu = require("luaunit")
local feather = require("feather")
local core = feather._core
local STEP = 1 / 60

local function scene()
    local world = feather.newWorld()
    local ground = world:newBody({ type = "static" })
    ground:newPlane(0, 1, 0, 0)
    local ball = world:newBody({ position = { 0, 5, 0 } })
    ball:newSphere(0.5, { events = { "touch", "hit" } })
    return world, ground, ball
end

local function fails(text, call, ...)
    local ok, told = pcall(call, ...)
    lu.assertFalse(ok)
    lu.assertStrContains(tostring(told), text)
end

TestPhysics = {}

function TestPhysics.testFreeFall()
    local world, _, ball = scene()
    for _ = 1, 30 do world:update(STEP) end
    local x, y, z = ball:getPosition()
    lu.assertAlmostEquals(y, 5 - 9.81 * 0.5 * (0.5 + STEP / 8) / 2, 1e-4)
    lu.assertEquals({ x, z }, { 0, 0 })
end

function TestPhysics.testCallbacks()
    local world, ground, ball = scene()
    local told = {}
    world:setCallbacks({
        beginContact = function(a, b, shapeA, shapeB, trigger)
            told[#told + 1] = "begin"
            lu.assertIs(a, ground)
            lu.assertIs(b, ball)
            lu.assertIs(shapeB, ball:getShapes()[1])
            lu.assertFalse(trigger)
        end,
        hit = function(a, b, x, y, z, nx, ny, nz, speed)
            told[#told + 1] = "hit"
            lu.assertAlmostEquals(ny, 1, 1e-6)
            lu.assertAlmostEquals(speed, math.sqrt(2 * 9.81 * 4.5), 0.2)
        end,
        sleep = function(body)
            told[#told + 1] = "sleep"
            body:destroy() -- allowed: the step is over
        end,
    })
    for _ = 1, 180 do world:update(STEP) end
    lu.assertEquals(told, { "begin", "hit", "sleep" })
    lu.assertTrue(ball:isDestroyed())
end

function TestPhysics.testPropertiesAreReadAsTheyWereWritten()
    local world, _, ball = scene()
    local values = {
        Position = { 1, 2, 3 }, Rotation = { 0, 1, 0, 0 }, Transform = { 1, 2, 3, 0, 0, 1, 0 }, LinearVelocity = { 1, 2, 3 },
        AngularVelocity = { 4, 5, 6 }, Mass = { 2 }, GravityScale = { 0.5 }, SleepThreshold = { 0.25 }, Damping = { 0.5, 0.25 },
        Tag = { 2 ^ 53 - 1 }, Locks = { "", "xz" }, Type = { "dynamic" },
    }
    local unpack = unpack or table.unpack
    for name, value in pairs(values) do
        ball["set" .. name](ball, unpack(value))
        if name ~= "AngularVelocity" then lu.assertEquals({ ball["get" .. name](ball) }, value) end
    end
    for _, name in ipairs({ "SleepAllowed", "Bullet", "Enabled" }) do
        ball["set" .. name](ball, false)
        lu.assertFalse(ball["is" .. name](ball))
        ball["set" .. name](ball, true)
        lu.assertTrue(ball["is" .. name](ball))
    end
    local shape = ball:getShapes()[1]
    for _, form in ipairs({ { "sphere", 0.5 }, { "box", 0.5, 0.25, 0.125 }, { "capsule", 0.5, 0.25 } }) do
        shape:setForm(form)
        lu.assertEquals(shape:getForm(), form)
    end
    shape:setMaterial({ friction = 0.5, restitution = 0.125 })
    shape:setMaterial({ dynamicFriction = 0.25, frictionCombine = "minimum", userId = 9 })
    lu.assertEquals(shape:getMaterial(), {
        staticFriction = 0.5, dynamicFriction = 0.25, restitution = 0.125, rollingResistance = 0, spinningResistance = 0,
        frictionCombine = "minimum", restitutionCombine = "default", userId = 9,
    })
    lu.assertEquals(shape:getEvents(), { "touch", "hit" })
    shape:setFilter(2, 6, -3)
    lu.assertEquals({ shape:getFilter() }, { 2, 6, -3 })
    shape:setFrame(1, 2, 3, 0, 1, 0, 0)
    lu.assertEquals({ shape:getFrame() }, { 1, 2, 3, 0, 1, 0, 0 })
    lu.assertIs(shape:getBody(), ball)
    shape:setTrigger(true)
    lu.assertTrue(shape:isTrigger())
end

function TestPhysics.testQueries()
    local world, ground, ball = scene()
    local hit = world:rayCast(0, 10, 0, 0, -20, 0)
    lu.assertIs(hit.body, ball)
    lu.assertAlmostEquals(hit.y, 5.5, 1e-6)
    lu.assertAlmostEquals(hit.ny, 1, 1e-6)
    lu.assertEquals(hit.triangle, -1)
    lu.assertIs(world:rayCast(0, 10, 0, 0, -20, 0, { exclude = { ball } }).body, ground)
    lu.assertNil(world:rayCast(0, 10, 0, 0, -1, 0))
    lu.assertTrue(world:rayCastAny(0, 10, 0, 0, -20, 0))
    lu.assertFalse(world:rayCastAny(0, 10, 0, 0, -1, 0))
    lu.assertEquals(#world:rayCastAll(0, 10, 0, 0, -20, 0), 2)
    lu.assertIs(world:sweep({ "sphere", 0.5 }, { 0, 10, 0 }, { 0, -20, 0 }).body, ball)
    lu.assertTrue(world:sweepAny({ "box", 1, 1, 1 }, { 0, 10, 0 }, { 0, -20, 0 }))
    lu.assertEquals(#world:sweepAll({ "capsule", 1, 0.5 }, { 0, 10, 0 }, { 0, -20, 0 }), 2)
    local rod, at, turning = { "box", 7, 0.1, 0.1 }, { 0, 12, 0 }, { turn = { 0, 0, 2 * math.pi } }
    lu.assertNil(world:sweep(rod, at, { 0, 0, 0 }))
    local turned = world:sweep(rod, at, { 0, 0, 0 }, turning)
    lu.assertIs(turned.body, ball)
    lu.assertTrue(turned.fraction > 0 and turned.fraction < 0.25)
    lu.assertTrue(world:sweepAny(rod, at, { 0, 0, 0 }, turning))
    lu.assertEquals(#world:sweepAll(rod, at, { 0, -8, 0 }, turning), 2)
    lu.assertErrorMsgContains("turn", world.sweep, world, rod, at, { 0, 0, 0 }, { turn = { 0, 65, 0 } })
    lu.assertErrorMsgContains("turn", world.rayCast, world, 0, 10, 0, 0, -20, 0, turning)
    lu.assertIs(world:overlap({ "sphere", 1 }, { 0, 4, 0 })[1], ball)
    lu.assertTrue(world:overlapAny({ "sphere", 1 }, { 0, 4, 0 }))
    local near = world:closestPoint(0, 7, 0, 10)
    lu.assertAlmostEquals(near.distance, 1.5, 1e-6)
    lu.assertIs(near.body, ball)
    lu.assertEquals(ball:rayCast(0, 10, 0, 0, -20, 0).fraction, hit.fraction)
    lu.assertAlmostEquals(ball:getShapes()[1]:closestPoint(0, 7, 0).distance, 1.5, 1e-6)
    local count, numbers = world:rayCastMany({ 0, 10, 0, 0, -20, 0, 9, 10, 0, 0, -1, 0 })
    lu.assertEquals(count, 1)
    lu.assertEquals({ #numbers, numbers[1], numbers[17] }, { 32, ball.id, 0 })
    lu.assertEquals((world:sweepMany({ "sphere", 0.5 }, { 0, 10, 0, 0, 0, 0, 1, 0, -20, 0 })), 1)
end

function TestPhysics.testJoints()
    local world = feather.newWorld()
    local a, b = world:newBody({ type = "static" }), world:newBody({ position = { 1, 0, 0 } })
    b:newSphere(0.25)
    local o, x, z = { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 }
    local made = {
        world:newDistanceJoint({ bodyA = a, bodyB = b, pointA = o, pointB = x }),
        world:newBallJoint({ bodyA = a, bodyB = b, point = o, coneEnabled = true, coneY = 0.5, coneZ = 0.5 }),
        world:newHingeJoint({ bodyA = a, bodyB = b, point = o, axis = z, limitEnabled = true, lower = -1, upper = 1, tag = 4 }),
        world:newFixedJoint({ bodyA = a, bodyB = b, point = x }),
        world:newConfigurableJoint({ bodyA = a, bodyB = b, point = x, linearX = { motion = "limited", lower = -1, upper = 1 } }),
        world:newRopeJoint({ bodyA = a, bodyB = b, pointA = o, pointB = x, maxLength = 3 }),
        world:newSliderJoint({ bodyA = a, bodyB = b, point = x, axis = x }),
        world:newWheelJoint({ bodyA = a, bodyB = b, point = x, axis = z, up = { 0, 1, 0 }, hertz = 4, dampingRatio = 0.7, travel = 0.2 }),
        world:newMotorJoint({ bodyA = a, bodyB = b, hertz = 5, dampingRatio = 1, maxForce = 100, maxTorque = 100 }),
    }
    lu.assertEquals(#world:getJoints(), 9)
    lu.assertEquals(#b:getJoints(), 9)
    local hinge = made[3]
    lu.assertEquals({ hinge:getType(), hinge:getTag() }, { "hinge", 4 })
    hinge:set({ motorSpeed = 2, motorMax = 10 })
    local told = hinge:getDefinition()
    lu.assertEquals({ told.motorSpeed, told.limitEnabled, told.lower, told.tag, #told.frameA }, { 2, true, -1, 4, 7 })
    lu.assertNil(told.structSize)
    lu.assertIs(told.bodyB, b)
    lu.assertEquals(made[2]:getDefinition().target, { 0, 0, 0, 1 })
    local axes = made[5]:getDefinition()
    lu.assertEquals({ axes.linearX.motion, axes.linearX.lower, axes.angularZ.spring }, { "limited", -1, "none" })
    lu.assertIs(hinge:getBodies(), a)
    for i, joint in ipairs(made) do
        if i ~= 3 then joint:destroy() end
    end
    for _ = 1, 300 do world:update(STEP) end
    lu.assertTrue(hinge:getAngle() > -1.05)
    lu.assertEquals(hinge:getState().angle, hinge:getAngle())
    fails("no field colour", hinge.set, hinge, { colour = 1 })
    local weak = world:newFixedJoint({ bodyA = a, bodyB = b, point = o, breakForce = 0.001 })
    local broken
    world:setCallbacks({ jointBreak = function(joint) broken = joint end })
    for _ = 1, 10 do world:update(STEP) end
    lu.assertIs(broken, weak)
end

local CUBE = { -1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1, 1 }

function TestPhysics.testHull()
    local world = feather.newWorld()
    world:newBody({ type = "static" }):newPlane(0, 1, 0, 0)
    local hull = world:newHull({ points = CUBE })
    local info = hull:getInfo()
    lu.assertEquals({ info.vertexCount, info.edgeCount, info.faceCount }, { 8, 12, 6 })
    lu.assertAlmostEquals(info.volume, 8, 1e-5)
    lu.assertEquals(hull:getVertices(), CUBE)
    local faces = hull:getFaces()
    lu.assertEquals(#faces, 6)
    lu.assertEquals(#faces[6].corners, 4)
    lu.assertAlmostEquals(faces[1].distance, 1, 1e-6)
    local body = world:newBody({ position = { 0, 2, 0 } })
    local shape = body:newHull(hull)
    lu.assertIs(shape:getForm()[2], hull)
    local wheel, cone = world:newBody({ position = { 4, 1, 0 } }), world:newBody({ position = { 8, 1, 0 } })
    lu.assertEquals(wheel:newCylinder(0.25, 0.5):getForm(), { "cylinder", 0.25, 0.5 })
    lu.assertEquals(cone:newCone(0.5, 0.5):getForm(), { "cone", 0.5, 0.5 })
    for _ = 1, 120 do world:update(STEP) end
    for thing, height in pairs({ [body] = 1, [wheel] = 0.25, [cone] = 0.5 }) do
        lu.assertAlmostEquals(select(2, thing:getPosition()), height, 5e-3)
    end
    local small = world:newBody({ position = { 12, 1, 0 } })
    local scaled = small:newShape({ "hull", hull, -1, 0.25, 0.5 })
    lu.assertEquals(scaled:getForm(), { "hull", hull, -1, 0.25, 0.5 })
    lu.assertAlmostEquals(small:getMass(), 1000, 0.01)
    for _ = 1, 120 do world:update(STEP) end
    lu.assertAlmostEquals(select(2, small:getPosition()), 0.25, 5e-3)
    scaled:setForm({ "hull", hull, 1, 1, 1 })
    lu.assertEquals(scaled:getForm(), { "hull", hull })
    fails("scale.y", small.newShape, small, { "hull", hull, 1, 0, 1 })
    fails("scale.z", scaled.setForm, scaled, { "hull", hull, 1, 1, 0 / 0 })
    fails("scale.x", world.sweep, world, { "hull", hull, 1e4, 1, 1 }, { 0, 9, 0 }, { 0, -1, 0 })
    fails("number", small.newShape, small, { "hull", hull, 1, 2 })
    fails("flat", world.newHull, world, { points = { 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1 } })
    fails("max_vertices", world.newHull, world, { points = CUBE, maxVertices = 3 })
    fails("whole records", world.newHull, world, { points = { 1, 2 } })
    fails("points", world.newHull, world, {})
    fails("no", world.newHull, world, { point = CUBE })
    hull:destroy()
    lu.assertTrue(hull:isDestroyed())
    fails("destroyed", hull.getInfo, hull)
end

function TestPhysics.testMesh()
    local world = feather.newWorld()
    local vertices, triangles = { -4, 0, -4, 4, 0, -4, -4, 0, 4, 4, 0, 4 }, { 0, 2, 3, 0, 3, 1, 0, 0, 1 }
    local mesh = world:newMesh({ vertices = vertices, triangles = triangles, triangleMaterials = { 0, 1, 0 },
        materials = { { friction = 1, userId = 5 }, { userId = 6 } }, triangleData = { 7, 8, 4294967295 } })
    local info = mesh:getInfo()
    lu.assertEquals({ info.triangleCount, info.degenerateTriangles, info.openEdges }, { 2, 1, 4 })
    lu.assertAlmostEquals(info.area, 64, 1e-9)
    local triangle = mesh:getTriangle(1)
    lu.assertEquals(triangle.corners, { -4, 0, -4, 4, 0, 4, 4, 0, -4 })
    lu.assertEquals({ triangle.material, triangle.data }, { 1, 8 })
    lu.assertEquals(triangle.edges, { { felt = false, convex = false, open = false },
        { felt = true, convex = false, open = true }, { felt = true, convex = false, open = true } })
    lu.assertNil(mesh:getTriangle(2))
    local shape = world:newBody({ type = "static" }):newMesh(mesh)
    lu.assertIs(shape:getForm()[2], mesh)
    local ball = world:newBody({ position = { 0.3, 2, 0.1 } })
    ball:newSphere(0.5)
    for _ = 1, 120 do world:update(STEP) end
    lu.assertAlmostEquals(select(2, ball:getPosition()), 0.5, 5e-3)
    local hit = world:rayCast(3, 3, -3, 0, -10, 0)
    lu.assertEquals({ hit.triangle, hit.material }, { 1, 6 })
    lu.assertFalse(hit.back)
    local both = feather.newWorld()
    both:newBody({ type = "static" }):newMesh(both:newMesh({ vertices = { -1, 0, -1, -1, 0, 1, 1, 0, -1 },
        triangles = { 0, 1, 2 }, twoSided = true }))
    for _, height in ipairs({ 1, -1 }) do
        local met = both:rayCast(-0.5, height, -0.5, 0, -2 * height, 0)
        lu.assertEquals({ met.ny, met.back }, { height, height < 0 })
    end
    mesh:setMaterials({ {}, { userId = 11 } })
    lu.assertEquals(world:rayCast(3, 3, -3, 0, -10, 0).material, 11)
    local half = world:newBody({ type = "static", position = { 20, 0, 0 } }):newShape({ "mesh", mesh, -0.5, 1, 0.5 })
    lu.assertEquals(half:getForm(), { "mesh", mesh, -0.5, 1, 0.5 })
    hit = world:rayCast(18.5, 3, -1.5, 0, -10, 0)
    lu.assertIs(hit.shape, half)
    lu.assertEquals({ hit.triangle, hit.ny > 0.999 }, { 1, true })
    lu.assertNil(world:rayCast(23, 3, 0, 0, -10, 0))
    fails("dynamic", ball.newMesh, ball, mesh)
    fails("triangle 0", world.newMesh, world, { vertices = vertices, triangles = { 0, 1, 4 } })
    fails("triangle 2", world.newMesh, world, { vertices = vertices, triangles = triangles, strict = true, twoSided = true })
    fails("triangles", world.newMesh, world, { vertices = vertices, triangles = { 0, 1, -1 } })
    fails("triangle_materials", world.newMesh, world, { vertices = vertices, triangles = triangles, triangleMaterials = { 0 } })
    fails("triangle_data", world.newMesh, world, { vertices = vertices, triangles = triangles, triangleData = { 1 } })
    fails("materials", mesh.setMaterials, mesh, {})
    fails("materials", mesh.setMaterials, mesh)
    mesh:destroy()
    lu.assertTrue(mesh:isDestroyed())
end

function TestPhysics.testSavedAssets()
    local world, store = feather.newWorld(), feather.newStore()
    local vertices = { -4, 0, -4, 4, 0, -4, -4, 0, 4, 4, 0, 4 }
    local hull = world:newHull({ points = CUBE })
    for _, asset in ipairs({ hull, world:newMesh({ vertices = vertices, triangles = { 0, 2, 3, 0, 3, 1 } }),
        world:newHeightfield({ rows = 2, columns = 2, heights = { 0, 1, 2, 3 } }) }) do
        local saved = asset:save()
        local loaded = store:load(saved)
        lu.assertEquals(loaded:save(), saved)
        lu.assertIs(getmetatable(loaded), getmetatable(asset))
        lu.assertIs(loaded:getStore(), store)
        fails("at byte", store.load, store, "")
        fails("at byte", store.load, store, saved:sub(1, -9))
        fails("hash", store.load, store, saved:sub(1, -2) .. "\1")
    end
    local body = world:newBody({ position = { 0, 2, 0 } })
    lu.assertEquals(body:newHull(world:load(hull:save())):getForm()[1], "hull")
    fails("a string is needed", store.load, store, 5)
    fails("a string is needed", store.load, store)
    hull:destroy()
    fails("destroyed", hull.save, hull)
end

function TestPhysics.testHeightfield()
    local world = feather.newWorld()
    local field = world:newHeightfield({ rows = 2, columns = 3, heights = { 0, 0, 0, 0, 0, 0 }, holes = { 1, 0 }, materials = { { friction = 1, userId = 5 } },
        cellMaterials = { 0, 0 } })
    local shape = world:newBody({ type = "static" }):newHeightfield(field)
    lu.assertIs(shape:getForm()[2], field)
    field:setHeights(1, 1, 1, 1, { 2 })
    lu.assertEquals(field:getHeights(0, 0, 2, 3), { 0, 0, 0, 0, 2, 0 })
    fails("heights", world.newHeightfield, world, { rows = 4, columns = 4, heights = { 0 } })
    fails("heights", field.setHeights, field, 0, 0, 2, 3, { 0 })
    field:destroy()
    lu.assertTrue(field:isDestroyed())
end

function TestPhysics.testBulk()
    local world, _, ball = scene()
    local ids = world:getBodyIds()
    lu.assertEquals(#ids, 2)
    lu.assertEquals(world:getTransforms({ ball }, { 1, 0, 0 }), { -1, 5, 0, 0, 0, 0, 1 })
    world:setTransforms({ ball }, { 1, 2, 3, 0, 0, 0, 1 })
    lu.assertEquals(world:getExactTransforms({ ball }), { 1, 2, 3, 0, 0, 0, 1 })
    world:setVelocities({ ball.id }, { 1, 2, 3, 0, 0, 0 })
    lu.assertEquals(world:getVelocities({ ball }), { 1, 2, 3, 0, 0, 0 })
    world:addForces({ ball }, { 0, 0, 0, 0, 0, 0 })
    lu.assertErrorMsgContains("1 records where the other table has 0", world.addForces, world, {}, { 0, 0, 0, 0, 0, 0 })
    world:update(STEP)
    local moved, numbers = world:getMoved()
    lu.assertIs(moved[1], ball)
    lu.assertEquals(#numbers, 7)
    world:destroyBodies({ ball })
    lu.assertEquals(#world:getBodies(), 1)
end

function TestPhysics.testManyJoints()
    local world, floor, ball = scene()
    local hinge = world:newHingeJoint({
        bodyA = floor, bodyB = ball, point = { 0, 4, 0 }, axis = { 0, 0, 1 }, motorMax = 1e6, springHertz = 1,
    })
    world:setJointMotorSpeeds({ hinge }, { 2 })
    world:setJointTargets({ hinge.id }, { 0.5 })
    world:addJointForces({ hinge }, { 3 })
    local made = hinge:getDefinition()
    lu.assertEquals({ made.motorSpeed, made.target }, { 2, 0.5 })
    world:update(STEP)
    local state = hinge:getState()
    local numbers = world:getJointCoordinates({ hinge })
    lu.assertEquals(numbers, { state.angle, state.angularVelocity[1] })
    lu.assertTrue(numbers[1] > 0)
    lu.assertEquals(#world:getJointReactions({ hinge, hinge }), 12)
    lu.assertErrorMsgContains("fe_world_set_joint_targets", world.setJointTargets, world, { hinge }, { 4 })
    lu.assertErrorMsgContains("a table of joints", world.setJointTargets, world, 3, { 4 })
end

function TestPhysics.testSettings()
    local world = feather.newWorld({ gravity = { 0, 0, -1 }, substeps = 4, workers = 2, simd = "plain", tag = 7, pool = feather.newPool(2) })
    lu.assertEquals({ world:getGravity() }, { 0, 0, -1 })
    lu.assertEquals({ world:getSubsteps(), world:getTag() }, { 4, 7 })
    world:setTuning({ contactHertz = 20 })
    lu.assertEquals(world:getTuning().contactHertz, 20)
    world:update(STEP)
    lu.assertEquals(world:getCounters().bodies, 0)
    lu.assertTrue(world:getProfile().step > 0)
    lu.assertStrMatches(world:getHash(), "%x%x%x%x%x%x%x%x%x%x%x%x%x%x%x%x")
    lu.assertStrMatches(feather.VERSION, "%d+%.%d+%.%d+")
end

TestErrors = {}

function TestErrors.testDestroyedThings()
    local world, _, ball = scene()
    local shape = ball:getShapes()[1]
    ball:destroy()
    fails("was destroyed", ball.getPosition, ball)
    fails("fe_shape_get_density", shape.getDensity, shape)
    fails("fe_body_destroy", ball.destroy, ball)
    world:destroy()
    world:destroy()
    fails("the world is destroyed", world.update, world, STEP)
    fails("the world is destroyed", ball.getPosition, ball)
    lu.assertTrue(ball:isDestroyed())
end

function TestErrors.testABodyKeepsItsWorldAlive()
    local body = feather.newWorld():newBody({ position = { 1, 2, 3 } })
    collectgarbage()
    collectgarbage()
    lu.assertEquals({ body:getPosition() }, { 1, 2, 3 })
end

-- How many threads are left, or nil where nobody tells. One that is joined is counted until the kernel has cleared it away: for a second at most.
local THREADS = [[
    local function threads(most)
        local latest, count = os.clock() + 1, nil
        repeat
            local file = io.open('/proc/self/status')
            count = file and tonumber(file:read('*a'):match('Threads:%s*(%d+)'))
            if file then file:close() end
        until not count or count <= most or os.clock() > latest
        return count
    end ]]
local threads = (loadstring or load)(THREADS .. "return threads")()
local function collect() for _ = 1, 3 do collectgarbage() end end

function TestErrors.testNoThreadOutlivesItsPool()
    collect() -- what other tests left
    local before = threads(1)
    for _ = 1, 20 do feather.newWorld({ pool = feather.newPool(3) }) end
    collect()
    lu.assertEquals(threads(before), before)
end

function TestErrors.testAWorldKeepsThePoolOfItsDefinition()
    local function made()
        local desc, pool = core.world_def(), core.pool_create(3)
        if core.set_pool then core.set_pool(desc, pool) else desc.pool = pool end
        return core.world_create(desc)
    end
    collect()
    local before, worlds = threads(1), {}
    for i = 1, 5 do worlds[i] = made() end
    collect()
    for i = 1, 5 do core.world_step(worlds[i], STEP) end
    worlds = nil
    collect()
    lu.assertEquals(threads(before), before)
end

function TestErrors.testAnArgumentThatDestroysTheWorld()
    local world = core.world_create(nil)
    local filter = setmetatable({}, { __index = function() pcall(core.world_destroy, world) end })
    lu.assertErrorMsgContains("destroyed", core.world_raycast, world, { 0, 1, 0 }, { 0, -1, 0 }, filter)
end

-- There finalizers run in no order, and after them the library is unloaded: a thread that is left would run into nothing. What is made first is
-- finalized last.
function TestErrors.testNoThreadOutlivesTheState()
    local text = THREADS .. [[
        local function last() io.write(threads(1)) end
        local told = newproxy and newproxy(true) or setmetatable({}, { __gc = last })
        if newproxy then getmetatable(told).__gc = last end
        local feather, kept = require('feather'), {}
        for i = 1, 20 do kept[i] = feather.newWorld({ pool = feather.newPool(3) }) end]]
    if threads(1) then lu.assertEquals(io.popen(arg[-1] .. ' -e "' .. text:gsub("\n", " ") .. '"'):read("*a"), "1") end
end

-- A pool and a store whose finalizers come before that of their world wait for it: the sentence of a call that is
-- refused would stand where the script's own error stood.
function TestErrors.testFinalizersLeaveTheError()
    local _, _, ball = scene()
    local pause = collectgarbage("setpause", 50) -- the collector never rests
    local natives = {}
    for i = 1, 100 do
        natives[i] = feather.newWorld({ pool = feather.newPool(1), store = feather.newStore() }).native
        for _ = 1, 20 do fails("fe_body_set_mass", ball.setMass, ball, -1) end
    end
    collectgarbage("setpause", pause)
end

function TestErrors.testForeignObjects()
    local world, _, ball = scene()
    local _, _, other = scene()
    fails("another world", world.newFixedJoint, world, { bodyA = ball, bodyB = other, point = { 0, 0, 0 } })
    fails("another world", world.ignoreCollision, world, ball, other)
    fails("another world", world.getTransforms, world, { other })
    lu.assertNotIs(ball, other)
end

function TestErrors.testWrongValues()
    local world, _, ball = scene()
    local hash = world:getHash()
    for _, wrong in ipairs({ 0 / 0, 1 / 0, -1 / 0, 1e300, "x", {}, true, print }) do
        lu.assertFalse(pcall(ball.setPosition, ball, wrong, 0, 0))
        lu.assertFalse(pcall(ball.setMass, ball, wrong))
        lu.assertFalse(pcall(ball.setTag, ball, wrong))
        lu.assertFalse(pcall(world.update, world, wrong))
        lu.assertFalse(pcall(world.newBody, world, { position = { 0, wrong, 0 } }))
        lu.assertFalse(pcall(ball.newSphere, ball, wrong))
        lu.assertFalse(pcall(world.rayCast, world, 0, wrong, 0, 1, 0, 0))
        lu.assertFalse(pcall(core.body_get_position, world.native, wrong))
        lu.assertFalse(pcall(core.world_step, wrong, 0.1))
    end
    lu.assertFalse(pcall(core.world_step, nil, 0.1))
    -- userdata that are not the library's, or of another kind of its own
    local desc, form = core.body_def(), core.geometry_sphere(0.5)
    for _, foreign in ipairs({ io.stdout, world.native, form, coroutine.create(function() end) }) do
        lu.assertFalse(pcall(core.body_create, world.native, foreign))
        lu.assertFalse(pcall(core.shape_create, world.native, ball.id, nil, foreign ~= form and foreign or desc))
        lu.assertFalse(pcall(core.world_create, foreign))
        lu.assertFalse(pcall(function() desc.transform = foreign end))
        if foreign ~= world.native then lu.assertFalse(pcall(core.world_step, foreign, 0.1)) end
        lu.assertFalse(pcall(feather.newWorld, { pool = foreign }))
        lu.assertFalse(pcall(ball.getPosition, foreign))
    end
    lu.assertFalse(pcall(ball.destroy, { native = world.native, id = 0 / 0, world = world }))
    if not core.ffi then
        lu.assertFalse(pcall(function() core.world_def().pool = io.stdout end))
        lu.assertNil(core.swig_type)
        lu.assertEquals(getmetatable(desc), "feather")
        -- a part keeps the object that it is of
        local position = core.body_def().transform.position
        for _ = 1, 3 do
            collectgarbage()
            for _ = 1, 20 do core.body_def().transform.position.x = 7 end
        end
        lu.assertEquals({ position.x, position.y, position.z }, { 0, 0, 0 })
    end
    lu.assertFalse(pcall(ball.setPosition, ball))
    fails("static", world.newBody, world, { type = "fluid" })
    fails("no field colour", world.newBody, world, { colour = 1 })
    lu.assertEquals(world:getHash(), hash)
end

TestCore = {}

-- every function of the header, or why not
local ELSEWHERE = {
    fe_query_filter_init = "filters are tables", fe_heightfield_def_init = "heightfields are tables",
    fe_hull_def_init = "hulls are tables", fe_mesh_def_init = "meshes are tables",
    fe_body_create_many = "a loop costs the same", fe_last_error = "the text of the error",
    fe_result_name = "the text of the error", fe_allocator_init = "for hosts in C", fe_task_system_init = "for hosts in C",
    fe_array_init = "for hosts in C", fe_batch_def_init = "options of newBatch",
    fe_player_def_init = "options of newPlayer", fe_player_info_init = "a table", fe_divergence_init = "a table",
    fe_batch_bind = "tables are read and written", fe_batch_get_world = "for hosts in C",
}

function TestCore.testEveryFunctionOfTheHeader()
    local header, count = assert(io.open("include/feather.h")):read("*a"), 0
    for name in header:gmatch("FE_API [%w_ ]-%*?(fe_[%w_]+)%(") do
        count = count + 1
        local record = name:match("^fe_([%w_]+)_init$")
        if not ELSEWHERE[name] then lu.assertNotNil(core[record or name:sub(4)], name) end
    end
    lu.assertTrue(count > 170)
end

-- The table of docs/lua.md has a row for each, and the methods it names exist.
function TestCore.testTheTableOfTheDocument()
    local document = assert(io.open("docs/lua.md")):read("*a")
    for name in assert(io.open("include/feather.h")):read("*a"):gmatch("FE_API [%w_ ]-%*?(fe_[%w_]+)%(") do
        lu.assertStrContains(document, "| `" .. name .. "` | ")
    end
    local world, _, ball = scene()
    local things = {
        feather = feather, world = world, body = ball, shape = ball:getShapes()[1], store = world:getStore(),
        hull = world:newHull({ points = CUBE }),
        mesh = world:newMesh({ vertices = CUBE, triangles = { 0, 2, 3 } }),
        compound = world:newCompound({ { "sphere", 1 } }),
        heightfield = world:newHeightfield({ rows = 2, columns = 2, heights = { 0, 0, 0, 0 } }), pool = feather.newPool(1),
        history = world:newHistory(), state = world:newState(), batch = world:newBatch(1), player = feather.newPlayer(), recorder = world:newRecorder(), recording = scene():record(os.tmpname()),
        joint = world:newBallJoint({ bodyA = ball, bodyB = world:newBody(), point = { 0, 5, 0 } }),
    }
    local count = 0
    for thing, method in document:gmatch("`(%l+)[:%.](%w+)%(%)`") do
        count = count + 1
        lu.assertEquals(type(things[thing][method]), "function", method)
    end
    lu.assertTrue(count > 180)
end

function TestCore.testNoNativeCallGoesPastTheCore()
    for name in assert(io.open("feather-scm-1.rockspec")):read("*a"):gmatch('"(bindings/lua/[%w_/]+%.lua)"') do
        local text = assert(io.open(name)):read("*a")
        if not name:find("ffi") then
            lu.assertNil(text:find("ffi%.C") or text:find("ffi%.load") or text:find("ffi%.cdef") or text:find("loadlib"))
        end
    end
end

-- Draws of 1..n: the same on every Lua.
local function dice(seed)
    return function(n)
        seed = (seed * 16807) % 2147483647
        return seed % n + 1
    end
end

-- Random calls with random values of every type: no crash, no hang. FUZZ_SECONDS=60 for a full run.
function TestCore.testRandomCalls()
    local names, seconds = {}, tonumber(os.getenv("FUZZ_SECONDS") or "1")
    for name in assert(io.open("include/feather.h")):read("*a"):gmatch("FE_API [%w_ ]-%*?fe_([%w_]+)%(") do
        name = name:match("^([%w_]+)_init$") or name
        if type(core[name]) == "function" and not name:find("pool") then names[#names + 1] = name end
    end
    lu.assertTrue(#names > 150)
    local random = dice(1)
    local kept = {}
    local function value()
        local kind = random(16)
        if kind <= 6 and #kept > 0 then return kept[random(#kept)] end
        if kind <= 8 then return (random(2000) - 1000) / 300 end
        if kind <= 11 then
            local t = {}
            for i = 1, ({ 3, 3, 4, 7, 1, 0, 6, 9 })[random(8)] do t[i] = (random(2000) - 1000) / 300 end
            return t
        end
        local others = { 0, 1, 2, -1, 0 / 0, 1 / 0, 1e300, "x", true, {}, { "x" }, 2 ^ 31, 2 ^ 53, print, io.stdout }
        return others[random(#others + 1)]
    end
    local unpack = unpack or table.unpack
    local done, calls, good = os.clock() + seconds, 0, 0
    while os.clock() < done or calls < 1000 do
        local world = core.world_create(nil)
        local body = core.body_create(world, nil)
        kept = {
            body, core.shape_create(world, body, nil, core.geometry_sphere(0.5)), core.body_create(world, nil), { body },
            core.store_create(nil), core.world_get_store(world), core.world_def(), { core.compound_part() },
        }
        for _ = 1, 300 do
            local arguments = { random(10) == 1 and value() or world }
            local count = random(6)
            for i = 2, count do arguments[i] = value() end
            local name = names[random(#names)]
            if name ~= "world_destroy" or random(20) == 1 then
                calls = calls + 1
                local ok, result = pcall(core[name], unpack(arguments, 1, count))
                if ok then
                    good = good + 1
                    if result ~= nil and #kept < 50 then kept[#kept + 1] = result end
                end
            end
        end
        pcall(core.world_step, world, STEP)
    end
    lu.assertTrue(good > calls / 100)
end

-- The same with the methods of objects that live, lived or are another world's; what comes back is called again.
function TestCore.testRandomMethods()
    local seconds, random = tonumber(os.getenv("FUZZ_SECONDS") or "1"), dice(7)
    local function number() return (random(2000) - 1000) / 300 end
    local kept, saved = {}, nil
    local function value()
        local kind = random(12)
        if kind <= 3 then return kept[random(#kept)] end
        if kind <= 7 then return number() end
        if kind == 8 then return { number(), number(), number() } end
        local others = {
            0, 1, 2, -1, 0 / 0, 1 / 0, 2 ^ 53, "x", "dynamic", "static", "xz", true, false, {}, { "sphere", 0.5 }, { "box", 1, 1, 1 }, { "capsule", 1, number() },
            { "heightfield", kept[random(#kept)] }, { mask = 1, triggers = true, exclude = { kept[random(#kept)] } }, { kept[random(#kept)] },
            { "touch", "hit" }, { density = number(), colour = 1 }, { pairFilter = true, oneWay = true },
            function(...) return random(2) == 1 or error(...) end, { type = "kinematic", position = { 0, number(), 0 } }, print, io.stdout,
            { rows = 2, columns = 2, heights = { 0, 0, 0, number() } }, { "compound", kept[random(#kept)] }, saved, { assets = true },
            { { "sphere", 0.5, density = number() }, { "box", 1, 1, 1, position = { 0, number(), 0 }, material = { friction = number() } } },
            { rows = 2, columns = 2, heights = { 0, 0, 0, 0 }, materials = { { userId = number(), frictionCombine = "minimum" } } }, { linearX = { motion = "free", lower = number() } }, { motorSpeed = number() },
            { bodyA = kept[random(#kept)], bodyB = kept[random(#kept)], point = { 0, 0, 0 }, axis = { 0, 0, 1 }, pointA = { 0, 0, 0 },
                pointB = { 1, 0, 0 }, up = { 0, 1, 0 }, hertz = 1, dampingRatio = 1, travel = 1, maxLength = 2, maxForce = 1, maxTorque = number() },
        }
        return others[random(#others + 1)]
    end
    local unpack = unpack or table.unpack
    local done, calls, good, path = os.clock() + seconds, 0, 0, os.tmpname()
    while os.clock() < done or calls < 1000 do
        local world, _, ball = scene()
        local other, _, theirs = scene()
        local store = feather.newStore()
        kept, saved = { world, ball, ball:getShapes()[1], other, theirs, store, world:getStore() }, world:save({ assets = true })
        for i = 6, 7 do kept[i + 2] = kept[i]:newHeightfield({ rows = 2, columns = 2, heights = { 0, 0, 0, 0 } }) end
        kept[#kept + 1] = world:newBallJoint({ bodyA = ball, bodyB = world:newBody(), point = { 0, 5, 0 } })
        for _ = 1, 300 do
            local target, names = kept[random(#kept)], {}
            for name, method in pairs(getmetatable(target)) do
                if type(method) == "function" and not name:find("^__") then names[#names + 1] = name end
            end
            table.sort(names)
            local name = names[random(#names)]
            if not (name == "destroy" and target.update and random(10) > 1) then
                local count, arguments = random(7) - 1, { target }
                for i = 1, count do arguments[i + 1] = value() end
                if name == "record" and type(arguments[2]) == "string" then arguments[2] = path end -- nowhere else
                local told = { pcall(target[name], unpack(arguments, 1, count + 1)) }
                calls = calls + 1
                if told[1] then good = good + 1 end
                for i = 2, #told do
                    local class = type(told[i]) == "table" and getmetatable(told[i])
                    if told[1] and class and class.__name and #kept < 50 then kept[#kept + 1] = told[i] end
                end
            end
        end
        pcall(world.update, world, STEP)
    end
    os.remove(path)
    lu.assertTrue(good > calls / 10)
end

os.exit(lu.LuaUnit.run(), true) -- closes the state, so that valgrind sees what is left
