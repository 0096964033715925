-- Drawing as tables of numbers, and with LuaJIT as arrays; on every Lua, as test_feather.lua.
local lu = require("luaunit")
local feather = require("feather")
local core = feather._core

local function fails(text, call, ...)
    local ok, message = pcall(call, ...)
    lu.assertFalse(ok)
    lu.assertStrContains(tostring(message), text)
end

local function world_with_box()
    local world = feather.newWorld()
    local body = world:newBody({ position = { 10, 2, 0 } })
    return world, body, body:newBox(0.5, 1, 1.5)
end

TestDrawing = {}

function TestDrawing.testABoxAsTriangles()
    local world, _, shape = world_with_box()
    local n = world:drawTriangles()
    lu.assertEquals(#n, 36 * 5)
    local volume = 0
    for i = 1, #n, 15 do
        local ax, ay, az, bx, by, bz = n[i], n[i + 1], n[i + 2], n[i + 5], n[i + 6], n[i + 7]
        local cx, cy, cz = n[i + 10], n[i + 11], n[i + 12]
        volume = volume + ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        lu.assertEquals(n[i + 4], shape.id)
    end
    lu.assertAlmostEquals(volume / 6, 6, 1e-3)
end

function TestDrawing.testOptions()
    local world, body = world_with_box()
    world:newBody({ position = { 50, 0, 0 } }):newSphere(1)
    local n = world:drawLines({ parts = { "shapes", "bounds" }, only = body, origin = { 10, 2, 0 } })
    lu.assertEquals(#n, 48 * 5)
    for i = 1, #n, 5 do lu.assertTrue(math.abs(n[i]) <= 0.5 + 1e-6) end
    lu.assertEquals(#world:drawPoints({ parts = "centres" }), 2 * 5)
    lu.assertEquals(#world:drawPoints({ parts = "centres", lower = { 0, 0, -1 }, upper = { 20, 5, 1 } }), 5)
    fails("parts", world.drawLines, world, { parts = { "shape" } })
    fails("segments", world.drawLines, world, { segments = 2 })
    fails("colour", world.drawLines, world, { colour = 3 })
    body:destroy()
    fails("", world.drawLines, world, { only = body })
end

function TestDrawing.testInstances()
    local world, body, shape = world_with_box()
    local n = world:drawInstances({ origin = { 10, 0, 0 } })
    lu.assertEquals(#n, 16)
    lu.assertEquals({ n[3], n[4], n[5], n[6], n[7], n[8] }, { shape.id, body.id, 0, 0, 2, 0 })
    lu.assertEquals({ n[12], n[13], n[14], n[15], n[16] }, { 1, 0.5, 1, 1.5, -1 })
end

if core.ffi then
    function TestDrawing.testArrays()
        local world = world_with_box()
        local array, count = world:drawArray("lines")
        lu.assertEquals(count, 24)
        local numbers = world:drawLines()
        for i = 0, count - 1 do
            lu.assertEquals(array[i].x, numbers[5 * i + 1])
            lu.assertEquals(tonumber(array[i].owner), numbers[5 * i + 5])
        end
        lu.assertTrue(rawequal(world:drawArray("lines", nil, array), array))
        world:newBody():newBox(1, 1, 1)
        local larger, more = world:drawArray("lines", nil, array)
        lu.assertEquals(more, 48)
        lu.assertFalse(rawequal(larger, array))
        local instances, two = world:drawArray("instances")
        lu.assertEquals({ two, tonumber(instances[0].half_extents.z) }, { 2, 1.5 })
        fails("kind", world.drawArray, world, "line")
        fails("array", world.drawArray, world, "points", nil, instances)
    end
end

os.exit(lu.LuaUnit.run(), true)
