-- Joints. Their definitions are tables with the fields of feather.h's.
local native = require("feather.native")
local objects = require("feather.objects")
local options = require("feather.options")
local fail = require("feather.where").fail
local core, number = native.core, native.number
local World, Body, Joint = objects.World, objects.Body, objects.Joint
local TYPES = { "distance", "ball", "hinge", "fixed", "configurable" }

objects.life(Joint, "joint")
objects.accessors(Joint, "joint", { Tag = "user_data", Frames = "frames", Reaction = "reaction" })
objects.switches(Joint, "joint", { Enabled = "enabled" })
-- "distance", "ball", "hinge", "fixed" or "configurable".
function Joint:getType() return TYPES[core.joint_get_type(self.native, self.id)] end
-- nil for the end that is the world
function Joint:getBodies()
    local a, b = core.joint_get_bodies(self.native, self.id)
    return objects.of(self.world, Body, a), objects.of(self.world, Body, b)
end
function Joint:getState() return options.read(core.joint_get_state(self.native, self.id), "fe_joint_state") end
function Joint:getAngle() return number(core.joint_get_state(self.native, self.id).angle) end

-- ---- definitions ----------------------------------------------------------------------------------------------------

local function put_axis(def, name, axis)
    if type(axis) ~= "table" then fail("%s: a table is needed, not a %s", name, type(axis)) end
    local record = native.axis_of(def, options.DOFS[name])
    for part, value in pairs(axis) do options.put(record, "fe_joint_axis", part, value) end
end

local function fill(def, kind, given, elsewhere)
    for name, value in pairs(given) do
        if options.DOFS[name] and kind == "configurable" then put_axis(def, name, value)
        elseif not elsewhere[name] then options.put(def, "fe_" .. kind .. "_joint_def", name, value) end
    end
end

-- What newBallJoint and its like were given, as it is now: a table of the same names.
function Joint:getDefinition()
    local kind = self:getType()
    local record = core[kind .. "_joint_get"](self.native, self.id)
    local made = options.read(record, "fe_" .. kind .. "_joint_def")
    made.bodyA, made.bodyB = self:getBodies()
    for name, dof in pairs(kind == "configurable" and options.DOFS or {}) do
        made[name] = options.read(native.axis_of(record, dof), "fe_joint_axis")
    end
    return made
end

local BODIES = { bodyA = true, bodyB = true, userData = true }
-- Changes what the table names. A joint keeps its bodies.
function Joint:set(given)
    if type(given) ~= "table" then fail("a table is needed, not a %s", type(given)) end
    local kind, a, b = self:getType(), self:getBodies()
    if (given.bodyA or a) ~= a or (given.bodyB or b) ~= b then fail("a joint keeps its bodies") end
    local def = core[kind .. "_joint_get"](self.native, self.id)
    fill(def, kind, given, BODIES)
    core[kind .. "_joint_set"](self.native, self.id, def)
    if given.userData ~= nil then self:setUserData(given.userData) end
end

-- ---- motors and springs alone ---------------------------------------------------------------------------------------

local ONLY = { distance = "linearX", hinge = "angularX" } -- the degree of freedom of a joint that has one
local function dof_of(joint, dof)
    return options.word(options.DOFS, dof or ONLY[joint:getType()], "degree of freedom")
end

function Joint:setMotorSpeed(speed, dof) core.joint_set_motor_speed(self.native, self.id, dof_of(self, dof), speed) end
-- A ball joint's target is a rotation, x, y, z, w.
function Joint:setTarget(target, dof, z, w)
    if z ~= nil then return core.ball_joint_set_target(self.native, self.id, { target, dof, z, w }) end
    core.joint_set_target(self.native, self.id, dof_of(self, dof), target)
end

-- ---- making them ----------------------------------------------------------------------------------------------------

-- The body of an end; nil is the world.
local function end_of(world, body) return body == nil and 0 or objects.handle(world, body, Body) end

-- A constructor: `place` makes frames out of the options that `places` names. Without them frameA, frameB and
-- worldOrigin count, as getDefinition has them.
local function constructor(kind, places, place)
    local elsewhere, first = { bodyA = true, bodyB = true, userData = true }, places:match("%w+")
    for name in places:gmatch("%w+") do elsewhere[name] = true end
    return function(self, given)
        if type(given) ~= "table" then fail("a table is needed: bodyA, bodyB, %s...", first) end
        local def = core[kind .. "_joint_def"]()
        local a, b = end_of(self, given.bodyA), end_of(self, given.bodyB)
        if given[first] == nil and (given.frameA or given.frameB) then
            def.body_a, def.body_b = a, b
        else
            place(self.native, def, a, b, given)
        end
        fill(def, kind, given, elsewhere)
        local id = core[kind .. "_joint_create"](self.native, def)
        self.data[id] = given.userData
        return objects.of(self, Joint, id)
    end
end

local X = { 1, 0, 0 }
World.newDistanceJoint = constructor("distance", "pointA pointB", function(w, d, a, b, o)
    core.distance_joint_def_at(w, d, a, b, o.pointA, o.pointB)
end)
World.newBallJoint = constructor("ball", "point axis", function(w, d, a, b, o)
    core.ball_joint_def_at(w, d, a, b, o.point, o.axis or X)
end)
World.newHingeJoint = constructor("hinge", "point axis", function(w, d, a, b, o)
    core.hinge_joint_def_at(w, d, a, b, o.point, o.axis)
end)
World.newFixedJoint = constructor("fixed", "point", function(w, d, a, b, o)
    core.fixed_joint_def_at(w, d, a, b, o.point)
end)
World.newConfigurableJoint = constructor("configurable", "point axis", function(w, d, a, b, o)
    core.configurable_joint_def_at(w, d, a, b, o.point, o.axis or X)
end)
World.newRopeJoint = constructor("distance", "pointA pointB maxLength", function(w, d, a, b, o)
    core.rope_joint_def_at(w, d, a, b, o.pointA, o.pointB, o.maxLength)
end)
World.newSliderJoint = constructor("configurable", "point axis", function(w, d, a, b, o)
    core.slider_joint_def_at(w, d, a, b, o.point, o.axis)
end)
World.newWheelJoint = constructor("configurable", "point axis up hertz dampingRatio travel", function(w, d, a, b, o)
    core.wheel_joint_def_at(w, d, a, b, o.point, o.axis, o.up, o.hertz, o.dampingRatio, o.travel)
end)
World.newMotorJoint = constructor("configurable", "hertz dampingRatio maxForce maxTorque", function(w, d, a, b, o)
    core.motor_joint_def_at(w, d, a, b, o.hertz, o.dampingRatio, o.maxForce, o.maxTorque)
end)

function World:getJoints() return objects.all(self, Joint, (select(2, core.world_get_joints(self.native)))) end
