-- With a number or "scenario" as argument the game runs without a window, as the tests do.
function love.conf(t)
    local headless = (arg or {})[2] ~= nil
    t.identity = "feather"
    t.modules.physics = false
    t.modules.audio = false
    t.modules.window = not headless
    t.modules.graphics = not headless
end
