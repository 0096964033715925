-- The scene that every language plays, see tests/bindings/scenario.c: prints the same two lines.
--   lua scenario.lua [workers]
local feather = require("feather")

local BODIES, STEPS, SAMPLES = 300, 600, 17
local FORMS = { { "sphere", 0.5 }, { "box", 0.5, 0.375, 0.5 }, { "capsule", 0.25, 0.375 } }

local function place(i)
    return { i % 10 * 1.5 - 6.75, 2.0 + math.floor(i / 60) * 1.5, math.floor(i / 10) % 6 * 1.5 - 3.75 }
end

local function add_terrain(world)
    local heights = {}
    for row = 0, SAMPLES - 1 do
        for column = 0, SAMPLES - 1 do heights[#heights + 1] = (row * 7 + column * 3) % 5 * 0.125 end
    end
    local terrain = world:newHeightfield({ rows = SAMPLES, columns = SAMPLES, cellX = 2, cellZ = 2, heights = heights })
    world:newBody({ type = "static" }):newHeightfield(terrain, { position = { -16, 0, -16 } })
    return terrain
end

-- Ties body i to its neighbour i + 1, in the middle between the two.
local function add_joint(world, bodies, i)
    local a, b, from, to = bodies[i], bodies[i + 1], place(i), place(i + 1)
    local middle = { from[1] + 0.75, from[2], from[3] }
    if i % 10 == 0 then
        world:newBallJoint({ bodyA = a, bodyB = b, point = middle, axis = { 1, 0, 0 } })
    elseif i % 10 == 4 then
        world:newHingeJoint({ bodyA = a, bodyB = b, point = middle, axis = { 0, 0, 1 }, limitEnabled = true, lower = -0.5, upper = 0.5 })
    elseif i % 10 == 7 then
        world:newDistanceJoint({ bodyA = a, bodyB = b, pointA = from, pointB = to })
    elseif i % 10 == 2 then
        world:newFixedJoint({ bodyA = a, bodyB = b, point = middle, breakForce = 8192 })
    end
end

-- What a player would do: shoot, lift, dig, remove.
local function act(world, terrain, bodies, step, told)
    if step % 10 == 0 then
        local hit = world:rayCast(math.floor(step / 10) % 16 - 7.5, 20, 0.25, 0, -40, 0)
        if hit and hit.body:getType() == "dynamic" then
            told.rays = told.rays + 1
            hit.body:applyImpulse(0, 512, 64, hit.x, hit.y, hit.z)
        end
        told.overlaps = told.overlaps + #world:overlap({ "sphere", 3 }, { 0, 1, 0 })
    end
    if step == 200 then terrain:setHeights(7, 7, 3, 3, { 1, 1, 1, 1, 2, 1, 1, 1, 1 }) end
    if step == 400 then
        for i = 60, 69 do bodies[i]:destroy() end
    end
end

local function play(workers)
    local told = { enter = 0, exit = 0, hit = 0, sleep = 0, wake = 0, ["break"] = 0, rays = 0, overlaps = 0 }
    local function count(name)
        return function() told[name] = told[name] + 1 end
    end
    local world, bodies = feather.newWorld({ workers = workers }), {}
    local terrain = add_terrain(world)
    for i = 0, BODIES - 1 do
        bodies[i] = world:newBody({ position = place(i) })
        bodies[i]:newShape(FORMS[i % 3 + 1], { events = i % 5 == 0 and { "touch", "hit" } or { "touch" } })
    end
    world:newBody({ type = "kinematic", position = { -10, 1, 0 }, linearVelocity = { 0.5, 0, 0 } }):newBox(0.5, 1, 4)
    for i = 0, BODIES - 2 do add_joint(world, bodies, i) end
    world:setCallbacks({
        beginContact = count("enter"), endContact = count("exit"), hit = count("hit"), sleep = count("sleep"), wake = count("wake"),
        jointBreak = count("break"),
    })
    for step = 0, STEPS - 1 do
        act(world, terrain, bodies, step, told)
        world:update(1 / 60)
    end
    print("hash " .. world:getHash())
    local line = {}
    for _, name in ipairs({ "enter", "exit", "hit", "sleep", "wake", "break", "rays", "overlaps" }) do
        line[#line + 1] = string.format("%s %d", name, told[name])
    end
    print(table.concat(line, " "))
    world:destroy()
end

play(tonumber((...)) or 1)
