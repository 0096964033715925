-- What a call costs from Lua, ns; the best of some rounds. LUA_PATH and LUA_CPATH as in docs/lua.md.
local feather = require("feather")
local core = feather._core
local CALLS, ROUNDS = 200000, 5

local function cost(name, calls, run)
    local best = math.huge
    for _ = 1, ROUNDS do
        local start = os.clock()
        run(calls)
        best = math.min(best, (os.clock() - start) / calls * 1e9)
    end
    print(string.format("%s %.1f", name, best))
end

local world = feather.newWorld()
local body = world:newBody()
body:newSphere(0.5)
local w, b, get, valid = world.native, body.id, core.body_get_position, core.body_is_valid
-- the cheapest foreign call there is: ffi by itself, or a C function that does next to nothing
if core.ffi then
    local ffi = require("ffi")
    local C = ffi.load(package.searchpath("libfeather", package.cpath))
    local pointer, transform = w.p, ffi.new("fe_transform")
    cost("ffi_is_valid", CALLS, function(n) for _ = 1, n do C.fe_body_is_valid(pointer, b) end end)
    cost("ffi_get_transform", CALLS, function(n)
        local sum = 0
        for _ = 1, n do
            C.fe_body_get_transform(pointer, b, transform)
            sum = sum + transform.position.y
        end
    end)
else
    local abs = math.abs
    cost("math.abs", CALLS, function(n) for _ = 1, n do abs(1) end end)
end
cost("flat_is_valid", CALLS, function(n) for _ = 1, n do valid(w, b) end end)
cost("flat_get_position", CALLS, function(n) for _ = 1, n do local x, y, z = get(w, b) end end)
cost("body:getPosition", CALLS, function(n) for _ = 1, n do local x, y, z = body:getPosition() end end)
cost("body:setLinearVelocity", CALLS, function(n) for _ = 1, n do body:setLinearVelocity(0, 0, 0) end end)
cost("world:rayCast", CALLS / 20, function(n) for _ = 1, n do world:rayCast(0, 9, 0, 0, -20, 0) end end)
local but_one = { exclude = world:newBody() }
cost("world:rayCast excluding one", CALLS / 20, function(n)
    for _ = 1, n do world:rayCast(0, 9, 0, 0, -20, 0, but_one) end
end)
for _ = 1, 9998 do world:newBody() end
local ids, bodies = world:getBodyIds(), world:getBodies()
cost("bulk_10000_transforms", 10 * 10000, function(n) for _ = 1, n / 10000 do world:getTransforms(ids) end end)
cost("bulk_10000_transforms of bodies", 10 * 10000, function(n)
    for _ = 1, n / 10000 do world:getTransforms(bodies) end
end)
