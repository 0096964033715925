-- Queries, contacts and bulk calls. The last argument of a query says who counts: { mask = , triggers = true,
-- exclude = body or { bodies } }, or nothing.
local native = require("feather.native")
local objects = require("feather.objects")
local options = require("feather.options")
local shapes = require("feather.shape")
local core, of, all, handle, handles = native.core, objects.of, objects.all, objects.handle, objects.handles
local joint_handles = objects.joint_handles
local geometry, pose, xyz, xyz2 = shapes.geometry, objects.pose, objects.xyz, objects.xyz2
local World, Body, Shape = objects.World, objects.Body, objects.Shape

local KNOWN = { mask = true, triggers = true, exclude = true }
local OF_SWEEPS = { mask = true, triggers = true, exclude = true, turn = true }
-- Filters go to the core in tables that are used again and again.
local used, single = {}, {}
local function filter(world, given, known)
    if given == nil then return nil end
    options.check(given, known or KNOWN, "filter")
    local mask, triggers, excluded = given.mask, given.triggers, given.exclude
    if getmetatable(excluded) == Body then
        single[1] = handle(world, excluded, Body)
        excluded = single
    elseif excluded ~= nil then
        excluded = handles(world, excluded)
    end
    used.mask, used.excluded = mask, excluded
    used.flags = triggers ~= nil and options.switch(triggers, "triggers") or 0
    return used
end

-- Takes the values of an fe_hit; nil for a miss.
local function hit_of(world, body, shape, x, y, z, fraction, material, nx, ny, nz, depth, part, triangle, u, v, flags)
    if body == nil then return nil end
    return {
        body = of(world, Body, body), shape = of(world, Shape, shape), x = x, y = y, z = z, fraction = fraction,
        material = material, nx = nx, ny = ny, nz = nz, depth = depth, part = part, triangle = triangle, u = u, v = v,
        startedInside = flags % 2 == 1, back = flags >= 2,
    }
end

local function hits_of(world, n)
    local hits = {}
    for i = 1, #n, 16 do
        hits[#hits + 1] = hit_of(world, n[i], n[i + 1], n[i + 2], n[i + 3], n[i + 4], n[i + 5], n[i + 6], n[i + 7],
            n[i + 8], n[i + 9], n[i + 10], n[i + 11], n[i + 12], n[i + 13], n[i + 14], n[i + 15])
    end
    return hits
end

local function closest_of(world, body, shape, x, y, z, distance, material, nx, ny, nz, part, triangle, u, v)
    if body == nil then return nil end
    return {
        body = of(world, Body, body), shape = of(world, Shape, shape), x = x, y = y, z = z, distance = distance,
        material = material, nx = nx, ny = ny, nz = nz, part = part, triangle = triangle, u = u, v = v,
    }
end

-- ---- rays, from x, y, z along dx, dy, dz ----------------------------------------------------------------------------

function World:rayCast(x, y, z, dx, dy, dz, given)
    return hit_of(self, core.world_raycast(self.native, xyz(x, y, z), xyz2(dx, dy, dz), filter(self, given)))
end
function World:rayCastAny(x, y, z, dx, dy, dz, given)
    return core.world_raycast_any(self.native, xyz(x, y, z), xyz2(dx, dy, dz), filter(self, given))
end
function World:rayCastAll(x, y, z, dx, dy, dz, given)
    local _, n = core.world_raycast_all(self.native, xyz(x, y, z), xyz2(dx, dy, dz), filter(self, given))
    return hits_of(self, n)
end
-- Rays are 6 numbers each. Returns how many hit, and 16 numbers for each: see fe_hit.
function World:rayCastMany(rays, given) return core.world_raycast_many(self.native, rays, filter(self, given), 1) end

-- ---- sweeps and overlaps: a form as for newShape, its place { x, y, z } or { x, y, z, qx, qy, qz, qw } --------------

-- `given` may have turn = { x, y, z }, rad: the form turns so far about it on its way
local function sweep(call, turning, self, form, place, translation, given)
    if given and given.turn then
        return turning(self.native, geometry(form), pose(place), translation, given.turn, filter(self, given, OF_SWEEPS))
    end
    return call(self.native, geometry(form), pose(place), translation, filter(self, given))
end
function World:sweep(...) return hit_of(self, sweep(core.world_sweep, core.world_sweep_turning, self, ...)) end
function World:sweepAny(...) return sweep(core.world_sweep_any, core.world_sweep_turning_any, self, ...) end
function World:sweepAll(...)
    local _, n = sweep(core.world_sweep_all, core.world_sweep_turning_all, self, ...)
    return hits_of(self, n)
end
-- Paths are 10 numbers each: place, rotation, translation.
function World:sweepMany(form, paths, given)
    return core.world_sweep_many(self.native, geometry(form), paths, filter(self, given), 1)
end

function World:overlap(form, place, given)
    local _, ids = core.world_overlap(self.native, geometry(form), pose(place), filter(self, given))
    return all(self, Body, ids)
end
function World:overlapAny(form, place, given)
    return core.world_overlap_any(self.native, geometry(form), pose(place), filter(self, given))
end
-- A translation of the form by depth along dx, dy, dz parts the two.
function World:overlapShapes(form, place, given)
    local _, n = core.world_overlap_shapes(self.native, geometry(form), pose(place), filter(self, given))
    local found = {}
    for i = 1, #n, 9 do
        found[#found + 1] = {
            body = of(self, Body, n[i]), shape = of(self, Shape, n[i + 1]), material = n[i + 2],
            dx = n[i + 3], dy = n[i + 4], dz = n[i + 5], depth = n[i + 6], part = n[i + 7], triangle = n[i + 8],
        }
    end
    return found
end
-- From one corner of a box to the other: what getBounds returns.
function World:overlapBounds(lower_x, lower_y, lower_z, upper_x, upper_y, upper_z, given)
    local bounds = { lower_x, lower_y, lower_z, upper_x, upper_y, upper_z }
    local _, ids = core.world_overlap_bounds(self.native, bounds, filter(self, given))
    return all(self, Shape, ids)
end
function World:closestPoint(x, y, z, distance, given)
    return closest_of(self, core.world_closest_point(self.native, xyz(x, y, z), distance, filter(self, given)))
end

-- ---- of one body or shape -------------------------------------------------------------------------------------------

local function contact_of(world, n, i)
    local contact = {
        bodyA = of(world, Body, n[i]), bodyB = of(world, Body, n[i + 1]),
        shapeA = of(world, Shape, n[i + 2]), shapeB = of(world, Shape, n[i + 3]),
        materialA = n[i + 4], materialB = n[i + 5], nx = n[i + 6], ny = n[i + 7], nz = n[i + 8], points = {},
        friction = { n[i + 38], n[i + 39], n[i + 40] }, twist = n[i + 41],
        partA = n[i + 42], partB = n[i + 43], triangleA = n[i + 44], triangleB = n[i + 45],
    }
    for k = 1, n[i + 9] do
        local j = i + 3 + 7 * k
        contact.points[k] = {
            x = n[j], y = n[j + 1], z = n[j + 2], separation = n[j + 3], normalImpulse = n[j + 4],
            totalImpulse = n[j + 5], id = n[j + 6],
        }
    end
    return contact
end

for name, class in pairs({ body = Body, shape = Shape }) do
    local cast, closest = core[name .. "_raycast"], core[name .. "_closest_point"]
    local contacts = core[name .. "_get_contacts"]
    function class:rayCast(x, y, z, dx, dy, dz)
        return hit_of(self.world, cast(self.native, self.id, xyz(x, y, z), xyz2(dx, dy, dz)))
    end
    function class:closestPoint(x, y, z) return closest_of(self.world, closest(self.native, self.id, xyz(x, y, z))) end
    function class:getContacts()
        local _, n = contacts(self.native, self.id)
        local found = {}
        for i = 1, #n, 46 do found[#found + 1] = contact_of(self.world, n, i) end
        return found
    end
end

-- ---- bulk: bodies are a table of bodies or of their handles (getBodyIds); numbers are flat tables -------------------

local ZERO = { 0, 0, 0 }
function World:getBodies() return all(self, Body, (select(2, core.world_get_bodies(self.native)))) end
function World:getBodyIds() return (select(2, core.world_get_bodies(self.native))) end
-- x, y, z relative to an origin, and the rotation: 7 numbers a body
function World:getTransforms(bodies, origin)
    local ids = bodies and handles(self, bodies) or self:getBodyIds()
    return core.world_get_transforms_f32(self.native, ids, origin or ZERO)
end
function World:getExactTransforms(bodies) return core.world_get_transforms(self.native, handles(self, bodies)) end
function World:setTransforms(bodies, numbers) core.world_set_transforms(self.native, handles(self, bodies), numbers) end
-- linear and angular: 6 numbers a body
function World:getVelocities(bodies)
    return core.world_get_velocities(self.native, bodies and handles(self, bodies) or self:getBodyIds())
end
function World:setVelocities(bodies, numbers) core.world_set_velocities(self.native, handles(self, bodies), numbers) end
function World:addForces(bodies, numbers) core.world_add_forces(self.native, handles(self, bodies), numbers) end
-- ---- many joints, a table of them or of their handles, along the free axis of each ---------------------------------

-- angle or translation, and its rate: 2 numbers a joint
function World:getJointCoordinates(joints)
    return core.world_get_joint_coordinates(self.native, joint_handles(self, joints))
end
-- force and torque: 6 numbers a joint
function World:getJointReactions(joints)
    return core.world_get_joint_reactions(self.native, joint_handles(self, joints))
end
-- a number a joint, all or none
function World:setJointTargets(joints, targets)
    core.world_set_joint_targets(self.native, joint_handles(self, joints), targets)
end
function World:setJointMotorSpeeds(joints, speeds)
    core.world_set_joint_motor_speeds(self.native, joint_handles(self, joints), speeds)
end
function World:addJointForces(joints, forces)
    core.world_add_joint_forces(self.native, joint_handles(self, joints), forces)
end

-- the bodies that the last step moved, and 7 numbers for each
function World:getMoved()
    local _, ids, numbers = core.world_get_moved(self.native)
    return all(self, Body, ids), numbers
end
