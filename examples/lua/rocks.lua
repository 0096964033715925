-- Rocks, which are convex hulls, roll down a valley, which is a mesh of triangles.
local feather = require("feather")

local CELLS = 16
local vertices, triangles = {}, {}
for z = -CELLS / 2, CELLS / 2 do
    for x = -CELLS / 2, CELLS / 2 do
        local y = (x * x + z * z) / 16 + (x * 5 + z * 7) % 4 / 8 -- a bowl with bumps
        for _, number in ipairs({ x, y, z }) do vertices[#vertices + 1] = number end
    end
end
for row = 0, CELLS - 1 do
    for column = 0, CELLS - 1 do
        local a = row * (CELLS + 1) + column
        local b, c, d = a + 1, a + CELLS + 1, a + CELLS + 2
        -- counterclockwise seen from above: only that side counts; the first vertex is 0
        for _, index in ipairs({ a, c, d, a, d, b }) do triangles[#triangles + 1] = index end
    end
end

local world = feather.newWorld()
world:newBody({ type = "static" }):newMesh(world:newMesh({ vertices = vertices, triangles = triangles }))
local seed = 1
local function draw(half)
    seed = (seed * 16807) % 2147483647
    return (seed / 2147483647 * 2 - 1) * half
end
local kinds = {}
for i = 1, 3 do
    local points = {}
    for k = 1, 24 do points[3 * k - 2], points[3 * k - 1], points[3 * k] = draw(0.6), draw(0.4), draw(0.5) end
    kinds[i] = world:newHull({ points = points })
    local info = kinds[i]:getInfo()
    print(string.format("a rock of %d vertices and %d faces, %.3f m3", info.vertexCount, info.faceCount, info.volume))
end
local rocks = {}
for i = 0, 23 do
    rocks[i + 1] = world:newBody({ position = { 5 - 2 * (i % 6), 8 + 0.5 * i, 4 - 2.5 * math.floor(i / 6) } })
    rocks[i + 1]:newHull(kinds[i % 3 + 1])
end
for _ = 1, 360 do world:update(1 / 60) end
local hit, lowest = world:rayCast(7.25, 20, 0.5, 0, -30, 0), math.huge
print(string.format("triangle %d of the valley at %.3f m", hit.triangle, hit.y))
for _, rock in ipairs(rocks) do lowest = math.min(lowest, (select(2, rock:getPosition()))) end
print(string.format("the lowest rock lies at %.2f m", lowest))
