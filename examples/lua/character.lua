-- A character walks over hills: a capsule that sweeps move, no rigid body. It slides along what it meets and stays on
-- the ground.
local feather = require("feather")

local FORM, SKIN, STEP_DOWN = { "capsule", 0.5, 0.4 }, 0.01, 0.4
local world = feather.newWorld()
local size, hills = 41, {}
for row = 0, size - 1 do
    for column = 0, size - 1 do hills[#hills + 1] = 0.5 * math.sin(column * 0.5) * math.sin(row * 0.4) end
end
local field = world:newHeightfield({ rows = size, columns = size, heights = hills })
world:newBody({ type = "static" }):newHeightfield(field, { position = { -20, 0, -20 } })
world:newBody({ type = "static", position = { 4, 1, 0 } }):newBox(0.5, 2, 2) -- a wall in the way

-- Moves along a translation. What is left of it after a hit goes on along the surface.
local function slide(x, y, z, dx, dy, dz)
    for _ = 1, 4 do
        local hit = world:sweep(FORM, { x, y, z }, { dx, dy, dz })
        if not hit then return x + dx, y + dy, z + dz end
        x = x + dx * hit.fraction + hit.nx * SKIN
        y = y + dy * hit.fraction + hit.ny * SKIN
        z = z + dz * hit.fraction + hit.nz * SKIN
        local rest = 1 - hit.fraction
        local into = rest * (dx * hit.nx + dy * hit.ny + dz * hit.nz)
        dx, dy, dz = rest * dx - into * hit.nx, rest * dy - into * hit.ny, rest * dz - into * hit.nz
    end
    return x, y, z
end

local x, y, z = 0, 3, 0
for step = 0, 239 do
    x, y, z = slide(x, y, z, 2 / 60, 0, 1 / 60)
    local ground = world:sweep(FORM, { x, y, z }, { 0, -STEP_DOWN, 0 })
    y = y - STEP_DOWN * (ground and ground.fraction or 1)
    if ground then x, y, z = x + ground.nx * SKIN, y + ground.ny * SKIN, z + ground.nz * SKIN end
    if step % 40 == 0 then
        local state = ground and "on the ground" or "falling"
        print(string.format("%4.2f s  at %6.2f %6.2f %6.2f m  %s", step / 60, x, y, z, state))
    end
end
