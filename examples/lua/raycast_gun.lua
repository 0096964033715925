-- A gun that hits at once: rays find what is shot at, an impulse pushes it. The shooter's own body does not count.
local feather = require("feather")

local world = feather.newWorld()
world:newBody({ type = "static" }):newPlane(0, 1, 0, 0)
local shooter = world:newBody({ type = "static", position = { 0, 1, 0 } })
shooter:newCapsule(0.5, 0.4)
for i = 0, 7 do
    local angle = i * 0.3 - 1
    local can = world:newBody({ position = { 6 * math.cos(angle), 0.3, 6 * math.sin(angle) }, userData = "can " .. i })
    can:newCapsule(0.1, 0.2, { density = 100 })
end

for step = 0, 239 do
    if step % 20 == 10 then
        local angle = step / 240 * 2.4 - 1
        local dx, dy, dz = 50 * math.cos(angle), -5, 50 * math.sin(angle)
        local hit = world:rayCast(0, 1, 0, dx, dy, dz, { exclude = { shooter } })
        if hit and hit.body:getType() == "dynamic" then
            hit.body:applyImpulse(dx * 0.2, 5, dz * 0.2, hit.x, hit.y, hit.z)
            print(string.format("%4.2f s  %s hit at %5.2f m", step / 60, hit.body:getUserData(), hit.fraction * 50))
        else
            print(string.format("%4.2f s  missed", step / 60))
        end
    end
    world:update(1 / 60)
end
