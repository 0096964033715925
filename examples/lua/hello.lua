-- A box falls on the ground: the smallest whole program.
local feather = require("feather")

local world = feather.newWorld({ gravity = { 0, -9.81, 0 } })
world:newBody({ type = "static" }):newPlane(0, 1, 0, 0) -- the ground: y <= 0
local box = world:newBody({ position = { 0, 4, 0 } })
box:newBox(0.5, 0.5, 0.5) -- a cube of 1 m

for step = 0, 90 do
    if step % 15 == 0 then
        local _, y = box:getPosition()
        print(string.format("%4.2f s  y = %6.4f m", step / 60, y))
    end
    world:update(1 / 60)
end
