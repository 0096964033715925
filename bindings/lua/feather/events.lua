-- Events of the last step, as tables and as callbacks.
local native = require("feather.native")
local objects = require("feather.objects")
local fail = require("feather.where").fail
local core, of = native.core, objects.of
local World, Body, Shape, Joint = objects.World, objects.Body, objects.Shape, objects.Joint
local PAIR_KINDS = { "enter", "stay", "exit" }
local BODY_KINDS = { [4] = "sleep", [5] = "wake" }
local JOINT_TYPES = { "distance", "ball", "hinge", "fixed", "configurable" }
local events = {}

function World:getContactEvents()
    local _, n = core.world_get_pair_events(self.native)
    local found = {}
    for i = 1, #n, 10 do
        found[#found + 1] = {
            bodyA = of(self, Body, n[i]), bodyB = of(self, Body, n[i + 1]), shapeA = of(self, Shape, n[i + 2]),
            shapeB = of(self, Shape, n[i + 3]), kind = PAIR_KINDS[n[i + 4]], isTrigger = n[i + 5] ~= 0,
            partA = n[i + 6], partB = n[i + 7], triangleA = n[i + 8], triangleB = n[i + 9],
        }
    end
    return found
end

function World:getBodyEvents()
    local _, n = core.world_get_body_events(self.native)
    local found = {}
    for i = 1, #n, 2 do found[#found + 1] = { body = of(self, Body, n[i]), kind = BODY_KINDS[n[i + 1]] } end
    return found
end

function World:getHitEvents()
    local _, n = core.world_get_hit_events(self.native)
    local found = {}
    for i = 1, #n, 18 do
        found[#found + 1] = {
            bodyA = of(self, Body, n[i]), bodyB = of(self, Body, n[i + 1]), shapeA = of(self, Shape, n[i + 2]),
            shapeB = of(self, Shape, n[i + 3]), materialA = n[i + 4], materialB = n[i + 5],
            x = n[i + 6], y = n[i + 7], z = n[i + 8], nx = n[i + 9], ny = n[i + 10], nz = n[i + 11],
            speed = n[i + 12], impulse = n[i + 13],
            partA = n[i + 14], partB = n[i + 15], triangleA = n[i + 16], triangleB = n[i + 17],
        }
    end
    return found
end

-- A body of nil is the world.
function World:getJointEvents()
    local _, n = core.world_get_joint_events(self.native)
    local found = {}
    for i = 1, #n, 12 do
        found[#found + 1] = {
            joint = of(self, Joint, n[i]), bodyA = of(self, Body, n[i + 1]), bodyB = of(self, Body, n[i + 2]),
            tag = n[i + 3], type = JOINT_TYPES[n[i + 5]],
            force = { n[i + 6], n[i + 7], n[i + 8] }, torque = { n[i + 9], n[i + 10], n[i + 11] },
        }
    end
    return found
end

-- ---- callbacks ------------------------------------------------------------------------------------------------------

local KNOWN = {
    beginContact = true, stayContact = true, endContact = true, hit = true, sleep = true, wake = true,
    jointBreak = true,
}
-- beginContact, stayContact, endContact(bodyA, bodyB, shapeA, shapeB, isTrigger);
-- hit(bodyA, bodyB, x, y, z, nx, ny, nz, speed, impulse, materialA, materialB);
-- sleep(body), wake(body); jointBreak(joint, bodyA, bodyB)
function World:setCallbacks(callbacks)
    if type(callbacks) ~= "table" then fail("a table of functions is needed, not a %s", type(callbacks)) end
    for name, callback in pairs(callbacks) do
        if not KNOWN[name] then fail("there is no callback %s", tostring(name)) end
        if type(callback) ~= "function" then fail("%s: a function is needed, not a %s", name, type(callback)) end
    end
    self.callbacks = callbacks
end

-- Calls them all with what the last step reported. Returns the first error, in a table, when one failed. All events are
-- read before the first call: a callback may destroy what later ones are about.
function events.fire(world)
    local c, first = world.callbacks, nil
    local pair_events = (c.beginContact or c.stayContact or c.endContact) and world:getContactEvents() or {}
    local body_events = (c.sleep or c.wake) and world:getBodyEvents() or {}
    local hit_events = c.hit and world:getHitEvents() or {}
    local joint_events = c.jointBreak and world:getJointEvents() or {}
    local function call(callback, ...)
        if not callback then return end
        local done, message = pcall(callback, ...)
        if not done and not first then first = { message } end
    end
    local on_pair = { enter = c.beginContact, stay = c.stayContact, exit = c.endContact }
    for _, e in ipairs(pair_events) do call(on_pair[e.kind], e.bodyA, e.bodyB, e.shapeA, e.shapeB, e.isTrigger) end
    for _, e in ipairs(hit_events) do
        call(c.hit, e.bodyA, e.bodyB, e.x, e.y, e.z, e.nx, e.ny, e.nz, e.speed, e.impulse, e.materialA, e.materialB)
    end
    for _, e in ipairs(body_events) do call(c[e.kind], e.body) end
    for _, e in ipairs(joint_events) do call(c.jointBreak, e.joint, e.bodyA, e.bodyB) end
    return first
end

return events
