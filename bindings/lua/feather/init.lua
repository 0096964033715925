-- Feather: 3D rigid-body physics, in the style of love.physics: world:update(dt), body:getPosition() returns x, y, z, definitions are tables,
-- callbacks run after the step on the caller's thread. For Lua 5.1 to 5.4 it stands on the C module feather.core, for LuaJIT on feather.ffi;
-- both have the functions of feather.h, see docs/lua.md. Metres, kilograms, seconds, radians; rotations are x, y, z, w.

local core, axis_of, set_pool, number
if type(jit) == "table" and not os.getenv("FEATHER_NO_FFI") then
    core = require("feather.ffi")
    axis_of, set_pool, number = core.axis_of, core.set_pool, tonumber
else
    core = require("feather.core")
    axis_of = function(desc, i) return desc:axis(i) end
    set_pool = function(desc, pool) desc.pool = pool end
    number = function(value) return value end
end

local feather = { _core = core }

local BODY_TYPES = { static = 0, kinematic = 1, dynamic = 2 }
local JOINT_TYPES = { "distance", "ball", "hinge", "fixed", "configurable" }
local EVENTS = { touch = 1, stay = 2, hit = 4 }
local MOTIONS = { locked = 0, limited = 1, free = 2 }
local DRIVES = { none = 0, hertz = 1, stiffness = 2 }
local SIMD = { auto = 0, plain = 1, sse2 = 2, avx2 = 3, avx512 = 4, neon = 5 }
local COORDINATES = { alongX = 0, alongY = 1, alongZ = 2, aboutX = 3, aboutY = 4, aboutZ = 5 }
local SLEEP = 4

-- ---- words and tables for numbers ------------------------------------------------------------------------------------------------

local function fail(...)
    error("feather: " .. string.format(...), 3)
end

local function word(words, text, what)
    local found = words[text]
    if found == nil then
        local known = {}
        for name in pairs(words) do known[#known + 1] = name end
        table.sort(known)
        fail("%s: one of %s is needed, not %s", what, table.concat(known, ", "), tostring(text))
    end
    return found
end

local function name_of(words, number)
    for name, value in pairs(words) do
        if value == number then return name end
    end
end

local function event_bits(events)
    if type(events) == "string" then events = { events } end
    if type(events) ~= "table" then fail("events: a table of words is needed") end
    local bits, seen = 0, {}
    for _, name in ipairs(events) do
        if not seen[name] then bits = bits + word(EVENTS, name, "events") end
        seen[name] = true
    end
    return bits
end

local function axis_bits(text)
    local bits = 0
    for letter in tostring(text):gmatch(".") do bits = bits + word({ x = 1, y = 2, z = 4 }, letter, "axes") end
    return bits
end

local function axis_text(bits)
    return (bits % 2 >= 1 and "x" or "") .. (bits % 4 >= 2 and "y" or "") .. (bits >= 4 and "z" or "")
end

local function switch(value) return (value and value ~= 0) and 1 or 0 end

-- Field names are the header's, in camelCase or as they are: minAngle is min_angle.
local function field_name(name)
    return (name:gsub("%u", function(letter) return "_" .. letter:lower() end))
end

local function put_vector(target, value, what)
    if type(value) ~= "table" then fail("%s: a table of numbers is needed", what) end
    for i = 1, 3 do
        if type(value[i]) ~= "number" then fail("%s: a number is needed, not a %s", what, type(value[i])) end
    end
    target.x, target.y, target.z = value[1], value[2], value[3]
    if value[4] ~= nil then target.w = value[4] end
end

local function put_field(target, name, value)
    local field = field_name(name)
    if name == "tag" then field = "user_data" end
    local known, old = pcall(function() return target[field] end)
    if not known or old == nil then fail("there is no field %s", tostring(name)) end
    if type(value) == "table" then
        put_vector(old, value, name)
    elseif type(value) == "boolean" then
        target[field] = value and 1 or 0
    else
        target[field] = value
    end
end

local function copy(record, names)
    local made = {}
    for name in names:gmatch("%S+") do
        local value = record[field_name(name)]
        made[name] = type(value) == "number" and value or { value.x, value.y, value.z }
    end
    return made
end

-- ---- objects: a world and a handle, one object for each handle ---------------------------------------------------------------------------

local World, Body, Shape, Joint, Heightfield = {}, {}, {}, {}, {}
for name, class in pairs({ World = World, Body = Body, Shape = Shape, Joint = Joint, Heightfield = Heightfield }) do
    class.__index = class
    class.__name = "feather." .. name
    class.__tostring = function(self) return self.id and string.format("%s %.0f", class.__name, self.id) or class.__name end
end

local function object(world, class, id)
    local found = world.objects[id]
    if not found then
        found = setmetatable({ world = world, native = world.native, id = id }, class)
        world.objects[id] = found
    end
    return found
end

local function objects(world, class, ids)
    local made = {}
    for i = 1, #ids do made[i] = object(world, class, ids[i]) end
    return made
end

local function handle(world, thing, class)
    if type(thing) ~= "table" or getmetatable(thing) ~= class then fail("a %s is needed, not a %s", class.__name, type(thing)) end
    if thing.world ~= world then fail("%s belongs to another world", tostring(thing)) end
    return thing.id
end

local function handles(world, bodies)
    if type(bodies) ~= "table" then fail("a table of bodies is needed, not a %s", type(bodies)) end
    if type(bodies[1]) == "number" then return bodies end
    local ids = {}
    for i = 1, #bodies do ids[i] = handle(world, bodies[i], Body) end
    return ids
end

-- Vectors go to the core in tables that are used again and again.
local v, p, q = { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0, 1 }
local function xyz(x, y, z)
    v[1], v[2], v[3] = x, y, z
    return v
end

-- Getters and setters that hand their numbers through.
local function accessors(class, prefix, list)
    for method, name in pairs(list) do
        local get, set = core[prefix .. "_get_" .. name], core[prefix .. "_set_" .. name]
        if get then class["get" .. method] = function(self) return get(self.native, self.id) end end
        if set then class["set" .. method] = function(self, ...) return set(self.native, self.id, ...) end end
    end
end

local function switches(class, prefix, list)
    for method, name in pairs(list) do
        local get, set = core[prefix .. "_get_" .. name], core[prefix .. "_set_" .. name]
        class["is" .. method] = function(self) return get(self.native, self.id) ~= 0 end
        class["set" .. method] = function(self, value) return set(self.native, self.id, switch(value)) end
    end
end

local function life(class, prefix)
    local valid, destroy = core[prefix .. "_is_valid"], core[prefix .. "_destroy"]
    function class:isDestroyed() return self.world.destroyed or valid(self.native, self.id) == 0 end
    function class:destroy()
        destroy(self.native, self.id)
        self.world.data[self.id] = nil
    end
    function class:getWorld() return self.world end
    function class:setUserData(value) self.world.data[self.id] = value end
    function class:getUserData() return self.world.data[self.id] end
end

-- ---- bodies ---------------------------------------------------------------------------------------------------------------------

life(Body, "body")
accessors(Body, "body", {
    Position = "position", Rotation = "rotation", Transform = "transform", LinearVelocity = "linear_velocity",
    AngularVelocity = "angular_velocity", Mass = "mass", GravityScale = "gravity_scale", SleepThreshold = "sleep_threshold", Damping = "damping",
    Tag = "user_data", Centre = "centre",
})
switches(Body, "body", { Awake = "awake", SleepAllowed = "sleep_allowed", Enabled = "enabled", Bullet = "bullet" })

function Body:setPosition(x, y, z) core.body_set_position(self.native, self.id, xyz(x, y, z)) end
function Body:setRotation(x, y, z, w)
    q[1], q[2], q[3], q[4] = x, y, z, w
    core.body_set_rotation(self.native, self.id, q)
end
function Body:setTransform(...) core.body_set_transform(self.native, self.id, { ... }) end
function Body:setLinearVelocity(x, y, z) core.body_set_linear_velocity(self.native, self.id, xyz(x, y, z)) end
function Body:setAngularVelocity(x, y, z) core.body_set_angular_velocity(self.native, self.id, xyz(x, y, z)) end
function Body:getVelocityAt(x, y, z) return core.body_get_point_velocity(self.native, self.id, xyz(x, y, z)) end
function Body:getType() return name_of(BODY_TYPES, core.body_get_type(self.native, self.id)) end
function Body:setType(text) core.body_set_type(self.native, self.id, word(BODY_TYPES, text, "type")) end
function Body:getLocks()
    local linear, angular = core.body_get_locks(self.native, self.id)
    return axis_text(linear), axis_text(angular)
end
function Body:setLocks(linear, angular) core.body_set_locks(self.native, self.id, axis_bits(linear), axis_bits(angular)) end
function Body:setFilter(layer, mask) core.body_set_filter(self.native, self.id, layer, mask) end
function Body:moveTo(transform, seconds) core.body_set_target(self.native, self.id, transform, seconds) end
function Body:resetMass() core.body_reset_mass(self.native, self.id) end
function Body:getMassData() return copy(core.body_get_mass_data(self.native, self.id), "mass centre inertia") end
function Body:setMassData(data)
    local record = core.body_get_mass_data(self.native, self.id)
    for name, value in pairs(data) do put_field(record, name, value) end
    core.body_set_mass_data(self.native, self.id, record)
end

-- Forces at the centre of mass, or at a point of the world.
local function push(name)
    local at_centre, at_point = core["body_add_" .. name], core["body_add_" .. name .. "_at"]
    return function(self, x, y, z, px, py, pz)
        if px == nil then return at_centre(self.native, self.id, xyz(x, y, z)) end
        p[1], p[2], p[3] = px, py, pz
        return at_point(self.native, self.id, xyz(x, y, z), p)
    end
end
Body.applyForce, Body.applyImpulse = push("force"), push("impulse")
function Body:applyTorque(x, y, z) core.body_add_torque(self.native, self.id, xyz(x, y, z)) end
function Body:applyAngularImpulse(x, y, z) core.body_add_angular_impulse(self.native, self.id, xyz(x, y, z)) end

function Body:getShapes() return objects(self.world, Shape, (select(2, core.body_get_shapes(self.native, self.id)))) end
function Body:getJoints() return objects(self.world, Joint, (select(2, core.body_get_joints(self.native, self.id)))) end

-- ---- shapes ---------------------------------------------------------------------------------------------------------------------

life(Shape, "shape")
accessors(Shape, "shape", {
    Density = "density", Tag = "user_data", Material = "material", Filter = "filter", LocalPose = "local_pose", SurfaceVelocity = "surface_velocity",
})
switches(Shape, "shape", { Trigger = "trigger" })
function Shape:setMaterial(...) core.shape_set_material(self.native, self.id, { ... }) end
function Shape:setLocalPose(x, y, z, qx, qy, qz, qw) core.shape_set_local_pose(self.native, self.id, { x, y, z }, { qx, qy, qz, qw }) end
function Shape:setSurfaceVelocity(x, y, z) core.shape_set_surface_velocity(self.native, self.id, xyz(x, y, z)) end
function Shape:getBody() return object(self.world, Body, core.shape_get_body(self.native, self.id)) end
function Shape:setEvents(events) core.shape_set_events(self.native, self.id, event_bits(events)) end
function Shape:getEvents()
    local bits, found = core.shape_get_events(self.native, self.id), {}
    for _, name in ipairs({ "touch", "stay", "hit" }) do
        if bits % (2 * EVENTS[name]) >= EVENTS[name] then found[#found + 1] = name end
    end
    return found
end

-- { "sphere", radius }, { "capsule", half_height, radius }, { "box", x, y, z }, { "plane", nx, ny, nz, distance }, { "heightfield", heightfield }
local FORMS = { sphere = 1, capsule = 2, box = 3, plane = 4, heightfield = 1 }
local unpack = unpack or table.unpack
local function geometry(world, form)
    if type(form) ~= "table" then fail("a form is needed: { \"sphere\", 0.5 }...") end
    local count = word(FORMS, form[1], "form")
    if form[1] == "heightfield" then return core.geometry_heightfield(handle(world, form[2], Heightfield)) end
    return core["geometry_" .. form[1]](unpack(form, 2, 1 + count))
end

local function shape_def(options)
    local desc, material = core.shape_def(), nil
    for name, value in pairs(options) do
        if name == "position" then put_vector(desc.local_position, value, name)
        elseif name == "rotation" then put_vector(desc.local_rotation, value, name)
        elseif name == "events" then desc.events = event_bits(value)
        elseif name == "friction" then
            desc.material.static_friction = value
            desc.material.dynamic_friction = value
        elseif name == "material" then
            material = value
        elseif name == "restitution" then desc.material.restitution = value
        else put_field(desc, name, value) end
    end
    for name, value in pairs(material or {}) do put_field(desc.material, name, value) end
    return desc
end

function Body:newShape(form, options)
    local desc = shape_def(options or {})
    return object(self.world, Shape, core.shape_create(self.native, self.id, desc, geometry(self.world, form)))
end
function Body:newSphere(radius, options) return self:newShape({ "sphere", radius }, options) end
function Body:newCapsule(half_height, radius, options) return self:newShape({ "capsule", half_height, radius }, options) end
function Body:newBox(x, y, z, options) return self:newShape({ "box", x, y, z }, options) end
function Body:newPlane(nx, ny, nz, distance, options) return self:newShape({ "plane", nx, ny, nz, distance }, options) end
function Body:newHeightfield(field, options) return self:newShape({ "heightfield", field }, options) end
function Shape:setForm(form) core.shape_set_geometry(self.native, self.id, geometry(self.world, form)) end
function Shape:getForm()
    local g = core.shape_get_geometry(self.native, self.id)
    if g.type == 0 then return { "sphere", g.radius } end
    if g.type == 1 then return { "capsule", g.half_height, g.radius } end
    if g.type == 2 then return { "box", g.half_extents.x, g.half_extents.y, g.half_extents.z } end
    if g.type == 3 then return { "plane", g.normal.x, g.normal.y, g.normal.z, g.distance } end
    return { "heightfield", object(self.world, Heightfield, number(g.asset)) }
end

life(Heightfield, "asset")
Heightfield.destroy = function(self) core.asset_destroy(self.native, self.id) end
function Heightfield:setHeights(row, column, rows, columns, heights)
    core.heightfield_set_heights(self.native, self.id, row, column, rows, columns, heights)
end
function Heightfield:getHeights(row, column, rows, columns) return core.heightfield_get_heights(self.native, self.id, row, column, rows, columns) end

-- ---- joints ---------------------------------------------------------------------------------------------------------------------

life(Joint, "joint")
accessors(Joint, "joint", { Tag = "user_data", Frames = "frames", Reaction = "reaction" })
switches(Joint, "joint", { Enabled = "enabled" })
function Joint:getType() return JOINT_TYPES[core.joint_get_type(self.native, self.id)] end
function Joint:getBodies()
    local a, b = core.joint_get_bodies(self.native, self.id)
    return object(self.world, Body, a), object(self.world, Body, b)
end
function Joint:getState()
    return copy(core.joint_get_state(self.native, self.id), "angle swingY swingZ angularVelocity translation linearVelocity length speed linearError angularError")
end
function Joint:getAngle() return core.joint_get_state(self.native, self.id).angle end

-- The fields of a struct, as feather.h has them.
local function fields_of(struct)
    local body, fields = require("feather.header"):match("typedef struct fe_" .. struct .. " (%b{})"), {}
    for names in body:gmatch("[%w_]+ ([%w_, ]+);") do
        for name in names:gmatch("[%w_]+") do
            if not name:find("reserved") and name ~= "struct_size" then fields[#fields + 1] = name end
        end
    end
    return fields
end

-- A record as a table of numbers and flat tables, under the names that set() takes.
local function plain(record, struct)
    local made = {}
    for _, field in ipairs(fields_of(struct)) do
        local value, name = record[field], field:gsub("_(%l)", string.upper)
        if field == "frame_a" or field == "frame_b" then
            local at, turn = value.position, value.rotation
            value = { at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w }
        elseif number(value) == nil or type(number(value)) ~= "number" then
            value = field == "target" and { value.x, value.y, value.z, value.w } or { value.x, value.y, value.z }
        end
        made[field == "user_data" and "tag" or name] = type(value) == "table" and value or number(value)
    end
    return made
end

function Joint:getDefinition()
    local kind = self:getType()
    local record = core[kind .. "_get"](self.native, self.id)
    local made = plain(record, kind .. "_def")
    made.bodyA, made.bodyB = self:getBodies()
    for name, i in pairs(kind == "configurable" and COORDINATES or {}) do
        local axis = plain(axis_of(record, i), "joint_axis")
        axis.mode, axis.drive = name_of(MOTIONS, axis.mode), name_of(DRIVES, axis.drive)
        made[name] = axis
    end
    return made
end

local PLACES = { bodyA = true, bodyB = true, pointA = true, pointB = true, point = true, axis = true, maxLength = true, up = true, travel = true }
local function fill(desc, options, skipped)
    for name, value in pairs(options) do
        if COORDINATES[name] then
            local axis = axis_of(desc, COORDINATES[name])
            for part, number in pairs(value) do
                if part == "mode" then number = word(MOTIONS, number, part) elseif part == "drive" then number = word(DRIVES, number, part) end
                put_field(axis, part, number)
            end
        elseif not skipped[name] then
            put_field(desc, name, value)
        end
    end
end

function Joint:set(options)
    local kind = self:getType()
    local desc = core[kind .. "_get"](self.native, self.id)
    fill(desc, options, {})
    core[kind .. "_set"](self.native, self.id, desc)
end

local function joint(kind, place, extra)
    return function(self, options)
        if type(options) ~= "table" then fail("a table is needed: bodyA, bodyB, point...") end
        local desc = core[kind .. "_def"]()
        local skipped = setmetatable({}, { __index = PLACES })
        local a, b = handle(self, options.bodyA, Body), handle(self, options.bodyB, Body)
        place(self.native, desc, a, b, options)
        for _, name in ipairs(extra or {}) do skipped[name] = true end
        fill(desc, options, skipped)
        return object(self, Joint, core[kind .. "_create"](self.native, desc))
    end
end
local X = { 1, 0, 0 }
World.newDistanceJoint = joint("distance", function(w, d, a, b, o) core.distance_def_at(w, d, a, b, o.pointA, o.pointB) end)
World.newBallJoint = joint("ball", function(w, d, a, b, o) core.ball_def_at(w, d, a, b, o.point, o.axis or X) end)
World.newHingeJoint = joint("hinge", function(w, d, a, b, o) core.hinge_def_at(w, d, a, b, o.point, o.axis) end)
World.newFixedJoint = joint("fixed", function(w, d, a, b, o) core.fixed_def_at(w, d, a, b, o.point) end)
World.newConfigurableJoint = joint("configurable", function(w, d, a, b, o) core.configurable_def_at(w, d, a, b, o.point, o.axis or X) end)
World.newRopeJoint = joint("distance", function(w, d, a, b, o) core.rope_def_at(w, d, a, b, o.pointA, o.pointB, o.maxLength) end)
World.newSliderJoint = joint("configurable", function(w, d, a, b, o) core.slider_def_at(w, d, a, b, o.point, o.axis) end)
World.newWheelJoint = joint("configurable", function(w, d, a, b, o)
    core.wheel_def_at(w, d, a, b, o.point, o.axis, o.up, o.hertz, o.dampingRatio, o.travel)
end, { "hertz", "dampingRatio" })
World.newMotorJoint = joint("configurable", function(w, d, a, b, o)
    core.motor_def_at(w, d, a, b, o.hertz, o.dampingRatio, o.maxForce, o.maxTorque)
end, { "hertz", "dampingRatio", "maxForce", "maxTorque" })

-- ---- worlds ---------------------------------------------------------------------------------------------------------------------

local Pool = {}
Pool.__index, Pool.__name = Pool, "feather.Pool"
function Pool:close() core.pool_destroy(self.native) end
function feather.newPool(workers) return setmetatable({ native = core.pool_create(workers) }, Pool) end

function feather.newWorld(options)
    local desc, pool = core.world_def(), nil
    for name, value in pairs(options or {}) do
        if name == "workers" then desc.worker_count = value
        elseif name == "simd" then desc.simd = word(SIMD, value, name)
        elseif name == "pool" then pool = value
        else put_field(desc, name, value) end
    end
    if pool then
        if getmetatable(pool) ~= Pool then fail("pool: what newPool returns is needed, not a %s", type(pool)) end
        set_pool(desc, pool.native)
    end
    local world = { native = core.world_create(desc), pool = pool, data = {}, callbacks = {}, objects = setmetatable({}, { __mode = "v" }) }
    return setmetatable(world, World)
end

function World:destroy()
    if self.destroyed then return end
    core.world_destroy(self.native)
    self.destroyed, self.data = true, {}
end
function World:isDestroyed() return self.destroyed == true end

-- Steps, then calls what was set with setCallbacks. There everything is allowed, destroying bodies too.
function World:update(dt)
    core.world_step(self.native, dt)
    if next(self.callbacks) then self:fire() end
end

-- beginContact, stayContact, endContact(bodyA, bodyB, shapeA, shapeB, isTrigger); hit(bodyA, bodyB, x, y, z, nx, ny, nz, speed, impulse);
-- sleep(body), wake(body); jointBreak(joint, bodyA, bodyB)
function World:setCallbacks(callbacks)
    if type(callbacks) ~= "table" then fail("a table of functions is needed") end
    self.callbacks = callbacks
end

function World:fire()
    local c = self.callbacks
    local pairs_told = (c.beginContact or c.stayContact or c.endContact) and self:getContactEvents() or {}
    local bodies_told = (c.sleep or c.wake) and self:getBodyEvents() or {}
    local hits_told, breaks_told = c.hit and self:getHitEvents() or {}, c.jointBreak and self:getJointEvents() or {}
    local names = { enter = c.beginContact, stay = c.stayContact, exit = c.endContact }
    for _, e in ipairs(pairs_told) do
        if names[e.kind] then names[e.kind](e.bodyA, e.bodyB, e.shapeA, e.shapeB, e.isTrigger) end
    end
    for _, e in ipairs(hits_told) do c.hit(e.bodyA, e.bodyB, e.x, e.y, e.z, e.nx, e.ny, e.nz, e.speed, e.impulse) end
    for _, e in ipairs(bodies_told) do
        if c[e.kind] then c[e.kind](e.body) end
    end
    for _, e in ipairs(breaks_told) do c.jointBreak(e.joint, e.bodyA, e.bodyB) end
end

function World:setGravity(x, y, z) core.world_set_gravity(self.native, xyz(x, y, z)) end
function World:getGravity() return core.world_get_gravity(self.native) end
function World:setSubsteps(count) core.world_set_substeps(self.native, count) end
function World:getSubsteps() return core.world_get_substeps(self.native) end
function World:getTag() return core.world_get_user_data(self.native) end
function World:getHash() return core.world_hash(self.native) end
function World:syncQueries() core.world_sync_queries(self.native) end
function World:ignoreCollision(a, b, ignore)
    core.world_ignore_collision(self.native, handle(self, a, Body), handle(self, b, Body), ignore == nil and 1 or switch(ignore))
end
function World:getTuning()
    return copy(core.world_get_tuning(self.native), "contactHertz contactDampingRatio contactPushSpeed jointHertz jointDampingRatio "
        .. "restitutionThreshold hitEventThreshold sleepTime speculativeDistance maxLinearSpeed")
end
function World:setTuning(options)
    local tuning = core.world_get_tuning(self.native)
    for name, value in pairs(options) do put_field(tuning, name, value) end
    core.world_set_tuning(self.native, tuning)
end
function World:getProfile() return copy(core.world_get_profile(self.native), "step pairs collide islands solve continuous finalize events sleep") end
function World:getCounters()
    return copy(core.world_get_counters(self.native), "bodies shapes joints awakeBodies pairs contacts recycled islands colours rows rowsWhole lanes simd simdWidth workers trees")
end

function World:newBody(options)
    local desc, data = core.body_def(), nil
    for name, value in pairs(options or {}) do
        if name == "type" then desc.type = word(BODY_TYPES, value, name)
        elseif name == "position" then put_vector(desc.transform.position, value, name)
        elseif name == "rotation" then put_vector(desc.transform.rotation, value, name)
        elseif name == "locks" then desc.linear_locks, desc.angular_locks = axis_bits(value[1]), axis_bits(value[2])
        elseif name == "userData" then data = value
        else put_field(desc, name, value) end
    end
    local body = object(self, Body, core.body_create(self.native, desc))
    self.data[body.id] = data
    return body
end
function World:destroyBodies(bodies) core.body_destroy_many(self.native, handles(self, bodies)) end
function World:getBodies() return objects(self, Body, (select(2, core.world_get_bodies(self.native)))) end
function World:getJoints() return objects(self, Joint, (select(2, core.world_get_joints(self.native)))) end

-- { rows = , columns = , cellX = , cellZ = , heights = {...}, holes = , cellMaterials = , materials = {{static, dynamic, restitution, 0, 0}...} }
function World:newHeightfield(o)
    if type(o) ~= "table" then fail("a table is needed: rows, columns, heights...") end
    return object(self, Heightfield, core.heightfield_create(self.native, {
        rows = o.rows, columns = o.columns, cell_x = o.cellX or 1, cell_z = o.cellZ or 1, heights = o.heights, holes = o.holes,
        cell_materials = o.cellMaterials, materials = o.materials,
    }))
end

-- ---- queries: the last argument says who counts, { mask = , triggers = true, exclude = {bodies} }, or nothing --------------------------------------

local function filter(world, options)
    if options == nil then return nil end
    return { mask = options.mask, flags = options.triggers and 1 or 0, excluded = options.exclude and handles(world, options.exclude) or nil }
end

local function hit_of(world, h)
    if h == nil then return nil end
    return {
        body = object(world, Body, number(h.body)), shape = object(world, Shape, number(h.shape)), x = h.point.x, y = h.point.y, z = h.point.z,
        nx = h.normal.x, ny = h.normal.y, nz = h.normal.z, fraction = h.fraction, triangle = h.triangle, depth = h.depth,
        startedInside = h.flags % 2 == 1,
    }
end

local function hits_of(world, n)
    local hits = {}
    for i = 1, #n, 12 do
        hits[#hits + 1] = {
            body = object(world, Body, n[i]), shape = object(world, Shape, n[i + 1]), x = n[i + 2], y = n[i + 3], z = n[i + 4], fraction = n[i + 5],
            nx = n[i + 6], ny = n[i + 7], nz = n[i + 8], triangle = n[i + 9], depth = n[i + 10], startedInside = n[i + 11] % 2 == 1,
        }
    end
    return hits
end

local function closest_of(world, c)
    if c == nil then return nil end
    return {
        body = object(world, Body, number(c.body)), shape = object(world, Shape, number(c.shape)), x = c.point.x, y = c.point.y, z = c.point.z,
        distance = c.distance, nx = c.normal.x, ny = c.normal.y, nz = c.normal.z, triangle = c.triangle,
    }
end

function World:rayCast(x, y, z, dx, dy, dz, options)
    p[1], p[2], p[3] = dx, dy, dz
    return hit_of(self, (core.world_raycast(self.native, xyz(x, y, z), p, filter(self, options))))
end
function World:rayCastAny(x, y, z, dx, dy, dz, options)
    p[1], p[2], p[3] = dx, dy, dz
    return core.world_raycast_any(self.native, xyz(x, y, z), p, filter(self, options))
end
function World:rayCastAll(x, y, z, dx, dy, dz, options)
    return hits_of(self, (select(2, core.world_raycast_all(self.native, { x, y, z }, { dx, dy, dz }, filter(self, options)))))
end
-- Sweeps and overlaps: the form as for newShape, its place { x, y, z } or { x, y, z, qx, qy, qz, qw }, the way { x, y, z }.
local function pose(place)
    if type(place) ~= "table" then fail("a place is needed: { x, y, z }") end
    return { place[1], place[2], place[3], place[4] or 0, place[5] or 0, place[6] or 0, place[7] or 1 }
end
function World:sweep(form, place, way, options)
    return hit_of(self, (core.world_sweep(self.native, geometry(self, form), pose(place), way, filter(self, options))))
end
function World:sweepAny(form, place, way, options) return core.world_sweep_any(self.native, geometry(self, form), pose(place), way, filter(self, options)) end
function World:sweepAll(form, place, way, options)
    return hits_of(self, (select(2, core.world_sweep_all(self.native, geometry(self, form), pose(place), way, filter(self, options)))))
end
function World:overlap(form, place, options)
    return objects(self, Body, (select(2, core.world_overlap(self.native, geometry(self, form), pose(place), filter(self, options)))))
end
function World:overlapAny(form, place, options) return core.world_overlap_any(self.native, geometry(self, form), pose(place), filter(self, options)) end
function World:closestPoint(x, y, z, distance, options)
    return closest_of(self, (core.world_closest_point(self.native, { x, y, z }, distance, filter(self, options))))
end
for name, class in pairs({ body = Body, shape = Shape }) do
    local cast, closest, contacts = core[name .. "_raycast"], core[name .. "_closest_point"], core[name .. "_get_contacts"]
    function class:rayCast(x, y, z, dx, dy, dz) return hit_of(self.world, (cast(self.native, self.id, { x, y, z }, { dx, dy, dz }))) end
    function class:closestPoint(x, y, z) return closest_of(self.world, (closest(self.native, self.id, { x, y, z }))) end
    function class:getContacts()
        local _, n = contacts(self.native, self.id)
        local found, world = {}, self.world
        for i = 1, #n, 42 do
            local contact = {
                bodyA = object(world, Body, n[i]), bodyB = object(world, Body, n[i + 1]), shapeA = object(world, Shape, n[i + 2]),
                shapeB = object(world, Shape, n[i + 3]), nx = n[i + 4], ny = n[i + 5], nz = n[i + 6], points = {},
                friction = { n[i + 36], n[i + 37], n[i + 38] }, twist = n[i + 39], triangle = n[i + 40],
            }
            for k = 1, n[i + 7] do
                local j = i + 1 + 7 * k
                contact.points[k] = {
                    x = n[j], y = n[j + 1], z = n[j + 2], separation = n[j + 3], normalImpulse = n[j + 4], totalImpulse = n[j + 5], id = n[j + 6],
                }
            end
            found[#found + 1] = contact
        end
        return found
    end
end

-- ---- events of the last step ------------------------------------------------------------------------------------------------------

local PAIR_KINDS = { "enter", "stay", "exit" }
function World:getContactEvents()
    local _, n = core.world_get_pair_events(self.native)
    local events = {}
    for i = 1, #n, 6 do
        events[#events + 1] = {
            kind = PAIR_KINDS[n[i + 4]], bodyA = object(self, Body, n[i]), bodyB = object(self, Body, n[i + 1]),
            shapeA = object(self, Shape, n[i + 2]), shapeB = object(self, Shape, n[i + 3]), isTrigger = n[i + 5] ~= 0,
        }
    end
    return events
end
function World:getBodyEvents()
    local _, n = core.world_get_body_events(self.native)
    local events = {}
    for i = 1, #n, 3 do events[#events + 1] = { kind = n[i + 1] == SLEEP and "sleep" or "wake", body = object(self, Body, n[i]) } end
    return events
end
function World:getHitEvents()
    local _, n = core.world_get_hit_events(self.native)
    local events = {}
    for i = 1, #n, 13 do
        events[#events + 1] = {
            bodyA = object(self, Body, n[i]), bodyB = object(self, Body, n[i + 1]), shapeA = object(self, Shape, n[i + 2]),
            shapeB = object(self, Shape, n[i + 3]), x = n[i + 4], y = n[i + 5], z = n[i + 6], nx = n[i + 7], ny = n[i + 8], nz = n[i + 9],
            speed = n[i + 10], impulse = n[i + 11],
        }
    end
    return events
end
function World:getJointEvents()
    local _, n = core.world_get_joint_events(self.native)
    local events = {}
    for i = 1, #n, 12 do
        events[#events + 1] = {
            joint = object(self, Joint, n[i]), bodyA = object(self, Body, n[i + 1]), bodyB = object(self, Body, n[i + 2]), tag = n[i + 3],
            type = JOINT_TYPES[n[i + 5]], force = { n[i + 6], n[i + 7], n[i + 8] }, torque = { n[i + 9], n[i + 10], n[i + 11] },
        }
    end
    return events
end

-- ---- bulk: bodies are a table of bodies or of their ids (getBodyIds); numbers are flat tables ---------------------------------------------------

local ZERO = { 0, 0, 0 }
function World:getBodyIds() return (select(2, core.world_get_bodies(self.native))) end
-- x, y, z relative to an origin, and the rotation: 7 numbers a body
function World:getTransforms(bodies, origin)
    return core.world_get_transforms_f32(self.native, bodies and handles(self, bodies) or self:getBodyIds(), origin or ZERO)
end
function World:getExactTransforms(bodies) return core.world_get_transforms(self.native, handles(self, bodies)) end
function World:setTransforms(bodies, numbers) core.world_set_transforms(self.native, handles(self, bodies), numbers) end
-- linear and angular: 6 numbers a body
function World:getVelocities(bodies) return core.world_get_velocities(self.native, bodies and handles(self, bodies) or self:getBodyIds()) end
function World:setVelocities(bodies, numbers) core.world_set_velocities(self.native, handles(self, bodies), numbers) end
function World:addForces(bodies, numbers) core.world_add_forces(self.native, handles(self, bodies), numbers) end
-- bodies that the last step moved, and 7 numbers for each
function World:getMoved()
    local _, ids, numbers = core.world_get_moved(self.native)
    return objects(self, Body, ids), numbers
end
-- rays are 6 numbers each; returns how many hit and 12 numbers for each: body, shape, point, fraction, normal, triangle, depth, flags
function World:rayCastMany(rays, options) return core.world_raycast_many(self.native, rays, filter(self, options), 1) end
-- paths are 10 numbers each: place, rotation, way
function World:sweepMany(form, paths, options) return core.world_sweep_many(self.native, geometry(self, form), paths, filter(self, options), 1) end

local version = core.version()
feather.VERSION = string.format("%d.%d.%d", math.floor(version / 65536), math.floor(version / 256) % 256, version % 256)
return feather
