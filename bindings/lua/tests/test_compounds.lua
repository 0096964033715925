-- Compounds on every Lua: one form of several parts, whose places hits, contacts and events tell.
local lu = require("luaunit")
local feather = require("feather")
local core = feather._core
local STEP = 1 / 60
local CUBE = { -1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1, 1 }
local unpack = unpack or table.unpack

local function fails(text, call, ...)
    local ok, told = pcall(call, ...)
    lu.assertFalse(ok)
    lu.assertStrContains(tostring(told), text)
end

-- Balls of 0.5 m at x = -1 and 1, the second of ice and heavy, and a rod between them
local function dumbbell(world)
    return world:newCompound({
        { "sphere", 0.5, position = { -1, 0, 0 } },
        { "sphere", 0.5, position = { 1, 0, 0 }, density = 3000, material = { friction = 0, userId = 5 }, tag = 77 },
        { "cylinder", 0.5, 0.1, rotation = { 0, 0, 2, 2 } },
    })
end

TestCompounds = {}

function TestCompounds.testPartsAndMass()
    local world = feather.newWorld()
    local compound = dumbbell(world)
    local info = compound:getInfo()
    lu.assertEquals(info.partCount, 3)
    lu.assertTrue(info.bytes > 0)
    lu.assertAlmostEquals(info.lower[1], -1.5, 1e-6)
    lu.assertAlmostEquals(info.upper[2], 0.5, 1e-6)
    local part = compound:getPart(0)
    lu.assertEquals(part, { "sphere", 0.5, position = { -1, 0, 0 }, rotation = { 0, 0, 0, 1 }, tag = 0 })
    part = compound:getPart(1)
    lu.assertEquals({ part.density, part.tag, part.material.userId, part.material.staticFriction }, { 3000, 77, 5, 0 })
    lu.assertEquals(part.position, { 1, 0, 0 })
    lu.assertAlmostEquals(compound:getPart(2).rotation[4], math.sqrt(0.5), 1e-6)
    lu.assertEquals(dumbbell(world):getPart(1), world:newCompound({ part }):getPart(0))

    local body = world:newBody()
    local shape = body:newCompound(compound, { density = 2000 })
    local ball, rod = math.pi / 6, math.pi * 0.01
    lu.assertAlmostEquals(body:getMass(), 2000 * (ball + rod) + 3000 * ball, 0.01)
    lu.assertIs(shape:getForm()[2], compound)
    lu.assertEquals(#shape:getForm(), 2)
    local hull = world:newHull({ points = CUBE })
    local second = world:newCompound({ { "hull", hull, 1, -2, 1 }, { "hull", hull, position = { 5, 0, 0 } } })
    lu.assertEquals({ unpack(second:getPart(0), 1, 5) }, { "hull", hull, 1, -2, 1 })
    lu.assertIs(second:getPart(1)[2], hull)
    shape:setForm({ "compound", second })
    lu.assertAlmostEquals(body:getMass(), 2000 * 24, 0.1)
    hull:destroy()
    second:destroy()
    lu.assertTrue(second:isDestroyed())
    lu.assertEquals(shape:rayCast(5, 0, 9, 0, 0, -20).part, 1)
    fails("destroyed", second.getInfo, second)
    fails("destroyed", body.newCompound, body, second)
end

function TestCompounds.testQueriesTellThePart()
    local world = feather.newWorld()
    local shape = world:newBody({ type = "static" }):newCompound(dumbbell(world))
    for part, x in ipairs({ -1, 1, 0 }) do
        part = part - 1
        local material = part == 1 and 5 or 0
        local hit = world:rayCast(x, 5, 0, 0, -10, 0)
        lu.assertIs(hit.shape, shape)
        lu.assertEquals({ hit.part, hit.material, hit.triangle }, { part, material, -1 })
        lu.assertEquals(shape:rayCast(x, 5, 0, 0, -10, 0).part, part)
        lu.assertEquals(shape:getBody():rayCast(x, 5, 0, 0, -10, 0).part, part)
        lu.assertEquals(world:sweep({ "sphere", 0.05 }, { x, 5, 0 }, { 0, -10, 0 }).part, part)
        local closest = world:closestPoint(x, 1, 0, 2)
        lu.assertEquals({ closest.part, closest.material }, { part, material })
        lu.assertEquals(shape:closestPoint(x, 1, 0).part, part)
        local _, many = world:rayCastMany({ x, 5, 0, 0, -10, 0 })
        lu.assertEquals(many[12], part)
    end
    local overlaps = world:overlapShapes({ "sphere", 0.25 }, { 1, 0.5, 0 })
    lu.assertEquals({ #overlaps, overlaps[1].part, overlaps[1].material }, { 1, 1, 5 })
    lu.assertIs(overlaps[1].shape, shape)
end

function TestCompounds.testEventsAndContactsTellThePart()
    local world = feather.newWorld()
    world:newBody({ type = "static" }):newPlane(0, 1, 0, 0)
    local body = world:newBody({ position = { 0, 0.51, 0 } })
    local shape = body:newCompound(dumbbell(world), { density = 3000, events = { "touch", "hit" } })
    body:setLinearVelocity(0, -4, 0)
    local touched, hits = {}, {}
    for _ = 1, 30 do
        world:update(STEP)
        for _, e in ipairs(world:getContactEvents()) do touched[#touched + 1] = e end
        for _, e in ipairs(world:getHitEvents()) do hits[#hits + 1] = e end
    end
    lu.assertEquals({ #touched, touched[1].kind, touched[1].partA }, { 1, "enter", -1 })
    lu.assertIs(touched[1].shapeB, shape)
    lu.assertTrue(touched[1].partB == 0 or touched[1].partB == 1)
    lu.assertTrue(#hits > 0)
    for _, e in ipairs(hits) do lu.assertTrue(e.partA == -1 and (e.partB == 0 or e.partB == 1)) end
    local contacts, seen = shape:getContacts(), {}
    lu.assertEquals({ #contacts, #body:getContacts() }, { 2, 2 })
    for _, c in ipairs(contacts) do
        lu.assertEquals(c.partA, -1)
        lu.assertEquals(c.materialB, c.partB == 1 and 5 or 0)
        seen[c.partB] = true
    end
    lu.assertTrue(seen[0] and seen[1])
    body:setPosition(0, 9, 0)
    world:update(STEP)
    local last = world:getContactEvents()[1]
    lu.assertEquals({ last.kind, last.partA, last.partB }, { "exit", -1, -1 })
end

function TestCompounds.testACompoundMovesAsSingleShapesDo()
    local parts = {
        { "box", 1, 0.05, 0.6, position = { 0, 0.4, 0 }, density = 600 },
        { "cylinder", 0.35, 0.05, position = { -0.9, 0, -0.5 } },
        { "sphere", 0.35, position = { 0.9, 0, 0 }, material = { friction = 0.1 } },
        { "box", 0.2, 0.2, 0.2, position = { 0.9, 0, 0.5 }, rotation = { 0, 0.1, 0, 1 } },
    }
    local function run(give)
        local world = feather.newWorld()
        world:newBody({ type = "static" }):newPlane(0, 1, 0, 0)
        for i = 0, 3 do
            local body = world:newBody({ position = { 0.1 * i, 1 + 2 * i, 0 } })
            body:setRotation(0.1, 0.2, 0.3, 1)
            give(world, body)
        end
        for _ = 1, 100 do world:update(STEP) end
        return world:getExactTransforms(world:getBodies())
    end
    local one = run(function(world, body) body:newCompound(world:newCompound(parts)) end)
    local many = run(function(_, body)
        for _, part in ipairs(parts) do
            body:newShape({ unpack(part, 1, 4) }, {
                position = part.position, rotation = part.rotation, density = part.density, material = part.material,
            })
        end
    end)
    lu.assertEquals(one, many)
end

function TestCompounds.testSavedWithTheAssetsOfTheirParts()
    local world, other = feather.newWorld(), feather.newWorld()
    local hull = world:newHull({ points = CUBE })
    local compound = world:newCompound({ { "sphere", 0.5, tag = 7 }, { "hull", hull, position = { 1, 0, 0 } } })
    local saved = compound:save()
    local loaded = other:load(saved)
    lu.assertEquals(loaded:save(), saved)
    lu.assertEquals(loaded:getKey(), compound:getKey())
    lu.assertEquals(loaded:getPart(0).tag, 7)
    other:newBody():newCompound(loaded)
    other:update(STEP)
end

function TestCompounds.testWrongPartsAreNamed()
    local world = feather.newWorld()
    local body, other = world:newBody(), feather.newStore()
    local function wrong(text, part) fails(text, world.newCompound, world, { { "sphere", 0.5 }, part }) end
    wrong("parts[1]: density", { "sphere", 0.5, density = -2 })
    wrong("position.y", { "sphere", 0.5, position = { 0, 0 / 0, 0 } })
    wrong("rotation", { "sphere", 0.5, rotation = { 0, 0, 0, 0 } })
    wrong("static_friction", { "sphere", 0.5, material = { friction = -1 } })
    wrong("radius", { "sphere", -1 })
    wrong("plane", { "plane", 0, 1, 0, 0 })
    wrong("there is no colour", { "sphere", 0.5, colour = 1 })
    wrong("form: one of", { "ball", 0.5 })
    wrong("material: a table", { "sphere", 0.5, material = 3 })
    wrong("position: a table", { "sphere", 0.5, position = 3 })
    wrong("a number is needed", { "sphere", 0.5, tag = "x" })
    wrong("parts: a table is needed, not a number", 5)
    wrong("parts[1]", { "hull", other:newHull({ points = CUBE }) })
    local compound = world:newCompound({ { "sphere", 0.5 } })
    wrong("compound", { "compound", compound })
    local hull = world:newHull({ points = CUBE })
    hull:destroy()
    wrong("destroyed", { "hull", hull })
    fails("count", world.newCompound, world, {})
    fails("table", world.newCompound, world)
    fails("part", compound.getPart, compound, 1)
    fails("part", compound.getPart, compound, -1)
    fails("compound", body.newShape, body, { "compound", compound, 2, 2, 2 })
    fails("feather.Compound is needed", body.newCompound, body, hull)
    local mesh = world:newMesh({ vertices = { -1, 0, -1, 1, 0, -1, -1, 0, 1 }, triangles = { 0, 2, 1 } })
    local floor = world:newCompound({ { "sphere", 0.5 }, { "mesh", mesh } })
    fails("mesh", body.newCompound, body, floor)
    lu.assertEquals(#body:getShapes(), 0)
    world:newBody({ type = "static" }):newCompound(floor)
    local store = core.store_create(nil)
    for _, parts in ipairs({ { 5 }, { {} }, { core.body_def() }, { core.compound_part(), "x" } }) do
        fails("parts", core.compound_create, store, parts)
    end
    fails("table", core.compound_create, store, core.compound_part())
    fails("parts[0]", core.compound_create, store, { core.compound_part() })
end

os.exit(lu.LuaUnit.run(), true) -- closes the state, so that valgrind sees what is left
