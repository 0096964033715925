-- Bodies.
local native = require("feather.native")
local objects = require("feather.objects")
local options = require("feather.options")
local core, xyz = native.core, objects.xyz
local World, Body, Shape, Joint = objects.World, objects.Body, objects.Shape, objects.Joint

objects.life(Body, "body")
objects.accessors(Body, "body", {
    Position = "position", Rotation = "rotation", Transform = "transform", LinearVelocity = "linear_velocity",
    AngularVelocity = "angular_velocity", Mass = "mass", GravityScale = "gravity_scale",
    SleepThreshold = "sleep_threshold", Damping = "damping", Tag = "user_data", Centre = "centre", Filter = "filter",
    Bounds = "bounds",
})
objects.switches(Body, "body", {
    Awake = "awake", SleepAllowed = "sleep_allowed", Enabled = "enabled", Bullet = "bullet",
})

function World:newBody(given)
    local def, data = core.body_def(), nil
    for name, value in pairs(given or {}) do
        if name == "position" then options.put_numbers(def.transform.position, "fe_dvec3", value, name)
        elseif name == "rotation" then options.put_numbers(def.transform.rotation, "fe_quat", value, name)
        elseif name == "locks" then
            def.linear_locks, def.angular_locks = options.axis_bits(value[1]), options.axis_bits(value[2])
        elseif name == "userData" then data = value
        else options.put(def, "fe_body_def", name, value) end
    end
    local body = objects.of(self, Body, core.body_create(self.native, def))
    self.data[body.id] = data
    return body
end
function World:destroyBodies(bodies)
    local ids = objects.handles(self, bodies)
    core.body_destroy_many(self.native, ids)
    for i = 1, #ids do self.data[ids[i]] = nil end
end

-- ---- where it is and how it moves -----------------------------------------------------------------------------------

local rotation = { 0, 0, 0, 1 }
-- Of its origin, m. Moves it at once, through whatever is between, and wakes it.
function Body:setPosition(x, y, z) core.body_set_position(self.native, self.id, xyz(x, y, z)) end
-- x, y, z, w, any length but zero. Turns it at once, and wakes it.
function Body:setRotation(x, y, z, w)
    rotation[1], rotation[2], rotation[3], rotation[4] = x, y, z, w
    core.body_set_rotation(self.native, self.id, rotation)
end
function Body:setTransform(...) core.body_set_transform(self.native, self.id, { ... }) end
function Body:setLinearVelocity(x, y, z) core.body_set_linear_velocity(self.native, self.id, xyz(x, y, z)) end
function Body:setAngularVelocity(x, y, z) core.body_set_angular_velocity(self.native, self.id, xyz(x, y, z)) end
function Body:getVelocityAt(x, y, z) return core.body_get_point_velocity(self.native, self.id, xyz(x, y, z)) end
function Body:moveTo(transform, seconds) core.body_set_target(self.native, self.id, transform, seconds) end

-- Forces at the centre of mass, or at a point of the world.
local function push(name)
    local at_centre, at_point = core["body_add_" .. name], core["body_add_" .. name .. "_at"]
    return function(self, x, y, z, px, py, pz)
        if px == nil then return at_centre(self.native, self.id, xyz(x, y, z)) end
        return at_point(self.native, self.id, xyz(x, y, z), objects.xyz2(px, py, pz))
    end
end
Body.applyForce, Body.applyImpulse = push("force"), push("impulse")
function Body:applyTorque(x, y, z) core.body_add_torque(self.native, self.id, xyz(x, y, z)) end
function Body:applyAngularImpulse(x, y, z) core.body_add_angular_impulse(self.native, self.id, xyz(x, y, z)) end

-- ---- what it is -----------------------------------------------------------------------------------------------------

-- "static", "kinematic" or "dynamic".
function Body:getType() return options.name_of(options.BODY_TYPES, core.body_get_type(self.native, self.id)) end
function Body:setType(text) core.body_set_type(self.native, self.id, options.word(options.BODY_TYPES, text, "type")) end
function Body:getLocks()
    local linear, angular = core.body_get_locks(self.native, self.id)
    return options.axis_text(linear), options.axis_text(angular)
end
function Body:setLocks(linear, angular)
    core.body_set_locks(self.native, self.id, options.axis_bits(linear), options.axis_bits(angular))
end
function Body:setFilter(layer, mask, group) core.body_set_filter(self.native, self.id, layer, mask, group or 0) end
function Body:resetMass() core.body_reset_mass(self.native, self.id) end
function Body:getMassData() return options.read(core.body_get_mass_data(self.native, self.id), "fe_mass_data") end
function Body:setMassData(data)
    local record = core.body_get_mass_data(self.native, self.id)
    for name, value in pairs(data) do options.put(record, "fe_mass_data", name, value) end
    core.body_set_mass_data(self.native, self.id, record)
end

function Body:getShapes()
    return objects.all(self.world, Shape, (select(2, core.body_get_shapes(self.native, self.id))))
end
function Body:getJoints()
    return objects.all(self.world, Joint, (select(2, core.body_get_joints(self.native, self.id))))
end
