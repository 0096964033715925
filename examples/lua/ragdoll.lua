-- A ragdoll falls on a slope: capsules tied by ball joints with cones and by hinges with limits.
local feather = require("feather")

local world = feather.newWorld()
world:newBody({ type = "static" }):newPlane(0.2, 1, 0, 0)
local H, DOWN, UP, X = 3, { 0, -1, 0 }, { 0, 1, 0 }, { 1, 0, 0 }

local function limb(x, y, half_height, radius)
    local body = world:newBody({ position = { x, H + y, 0 }, angularDamping = 0.1 })
    body:newCapsule(half_height, radius, { friction = 0.8 })
    return body
end
local function ball(a, b, x, y, axis, cone)
    local point = { x, H + y, 0 }
    return world:newBallJoint({
        bodyA = a, bodyB = b, point = point, axis = axis, coneEnabled = true, coneY = cone, coneZ = cone,
    })
end
local function hinge(a, b, x, y, lower, upper)
    local point = { x, H + y, 0 }
    return world:newHingeJoint({
        bodyA = a, bodyB = b, point = point, axis = X, limitEnabled = true, lower = lower, upper = upper,
    })
end

local pelvis, chest, head = limb(0, 0, 0.05, 0.15), limb(0, 0.4, 0.12, 0.17), limb(0, 0.8, 0.04, 0.11)
local joints = { ball(pelvis, chest, 0, 0.2, UP, 0.4), ball(chest, head, 0, 0.65, UP, 0.7) }
for side = -1, 1, 2 do
    local arm, fore_arm = limb(side * 0.26, 0.35, 0.12, 0.05), limb(side * 0.26, -0.02, 0.12, 0.045)
    local thigh, shin = limb(side * 0.1, -0.35, 0.16, 0.07), limb(side * 0.1, -0.8, 0.16, 0.06)
    joints[#joints + 1] = ball(chest, arm, side * 0.26, 0.52, DOWN, 1.5)
    joints[#joints + 1] = hinge(arm, fore_arm, side * 0.26, 0.17, -2.4, 0)
    joints[#joints + 1] = ball(pelvis, thigh, side * 0.1, -0.12, DOWN, 1)
    joints[#joints + 1] = hinge(thigh, shin, side * 0.1, -0.58, 0, 2.4)
end

for step = 0, 240 do
    if step % 60 == 0 then
        local apart = 0
        for _, joint in ipairs(joints) do apart = math.max(apart, joint:getState().linearError) end
        local x, y, z = head:getPosition()
        local line = "%3.1f s  head at %5.2f %5.2f %5.2f m, joints apart by at most %4.2f mm"
        print(string.format(line, step / 60, x, y, z, 1000 * apart))
    end
    world:update(1 / 60)
end
