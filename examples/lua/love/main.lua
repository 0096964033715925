-- A pile of balls and boxes for LÖVE: `make package-lua`, then `love build/packages/lua/game.love`. Space drops another
-- body.
--   love . 120         plays 120 steps without a window and prints where the highest body is
local feather = require("feather")

local world, bodies, SCALE = nil, {}, 40
local STEP, MOST = 1 / 60, 0.25 -- s; what is late by more is dropped, so that a slow frame makes no slower one
local late = 0

local function drop(i)
    local body = world:newBody({ position = { (i * 7 % 13 - 6) * 0.5, 2 + i * 0.5, 0 }, locks = { "z", "xy" } })
    if i % 2 == 0 then body:newSphere(0.4) else body:newBox(0.45, 0.3, 0.3) end
    bodies[#bodies + 1] = body
end

function love.load(arguments)
    if arguments[1] == "scenario" then
        assert(loadfile(love.filesystem.getSource() .. "/scenario.lua"))("2")
        love.event.quit()
        return
    end
    world = feather.newWorld()
    world:newBody({ type = "static" }):newPlane(0, 1, 0, 0)
    for side = -1, 1, 2 do world:newBody({ type = "static" }):newPlane(-side, 0, 0, -6) end
    for i = 1, 40 do drop(i) end
    if tonumber(arguments[1]) then
        for _ = 1, tonumber(arguments[1]) do world:update(STEP) end
        local highest = 0
        for _, body in ipairs(bodies) do highest = math.max(highest, (select(2, body:getPosition()))) end
        print(string.format("%d bodies, the highest at %.2f m", #bodies, highest))
        love.event.quit()
    end
end

-- Steps of one length, as many as the time that went by holds: a screen of 144 Hz shows the same fall as one of 60.
function love.update(dt)
    late = math.min(late + dt, MOST)
    while world and late >= STEP do
        world:update(STEP)
        late = late - STEP
    end
end

function love.keypressed(key)
    if key == "space" then drop(#bodies + 1) end
end

function love.draw()
    love.graphics.translate(400, 560)
    love.graphics.scale(SCALE, -SCALE)
    love.graphics.setLineWidth(0.03)
    love.graphics.line(-6, 12, -6, 0, 6, 0, 6, 12)
    for i, body in ipairs(bodies) do
        local x, y, _, _, _, qz, qw = body:getTransform()
        love.graphics.push()
        love.graphics.translate(x, y)
        love.graphics.rotate(2 * math.atan2(qz, qw))
        if i % 2 == 0 then love.graphics.circle("line", 0, 0, 0.4)
        else love.graphics.rectangle("line", -0.45, -0.3, 0.9, 0.6) end
        love.graphics.pop()
    end
end
