-- Shapes: their forms, materials and filters.
local native = require("feather.native")
local objects = require("feather.objects")
local options = require("feather.options")
local fail = require("feather.where").fail
local asset_of = require("feather.store").asset_of
local core, xyz = native.core, objects.xyz
local Body, Shape = objects.Body, objects.Shape
local unpack = unpack or table.unpack
local shapes = {}

objects.life(Shape, "shape")
objects.accessors(Shape, "shape", {
    Density = "density", Tag = "user_data", Filter = "filter", Frame = "frame", SurfaceVelocity = "surface_velocity",
    Bounds = "bounds",
})
objects.switches(Shape, "shape", { Trigger = "trigger" })

-- ---- forms ----------------------------------------------------------------------------------------------------------

-- { "sphere", radius }, { "capsule", halfHeight, radius }, { "box", x, y, z }, { "cylinder", halfHeight, radius },
-- { "cone", halfHeight, radius }, { "plane", nx, ny, nz, distance }, { "hull", hull }, { "mesh", mesh },
-- { "heightfield", heightfield }, { "compound", compound }: how many numbers each has. Hulls and meshes may be followed
-- by three more: their scale
local FORMS = {
    sphere = 1, capsule = 2, box = 3, cylinder = 2, cone = 2, plane = 4, hull = 1, mesh = 1, heightfield = 1,
    compound = 1,
}
local ASSETS = {
    hull = objects.Hull, mesh = objects.Mesh, heightfield = objects.Heightfield, compound = objects.Compound,
}
local READ = {
    [1] = function(g) return { "sphere", g.radius } end,
    [2] = function(g) return { "capsule", g.half_height, g.radius } end,
    [3] = function(g) return { "box", g.half_extents.x, g.half_extents.y, g.half_extents.z } end,
    [4] = function(g) return { "cylinder", g.half_height, g.radius } end,
    [5] = function(g) return { "cone", g.half_height, g.radius } end,
    [64] = function(g) return { "plane", g.normal.x, g.normal.y, g.normal.z, g.distance } end,
}
local READ_ASSET = { [32] = "hull", [96] = "heightfield", [97] = "mesh", [98] = "compound" }

function shapes.geometry(form)
    if type(form) ~= "table" then fail("a form is needed: { \"sphere\", 0.5 }...") end
    local count = options.word(FORMS, form[1], "form")
    local class, asset = ASSETS[form[1]], form[2]
    if not class then return core["geometry_" .. form[1]](unpack(form, 2, 1 + count)) end
    if type(asset) ~= "table" or getmetatable(asset) ~= class then
        fail("a %s is needed, not a %s", class.__name, type(asset))
    end
    local made = core["geometry_" .. form[1]](asset.id)
    if form[3] ~= nil then core.geometry_set_scale(made, form[3], form[4], form[5]) end
    return made
end

-- The reverse, of assets of this store
function shapes.form_of(store, g)
    local read = READ[g.type]
    if read then return read(g) end
    local word, s = READ_ASSET[g.type], g.scale
    local form = { word, asset_of(store, ASSETS[word], native.number(g.asset)) }
    if s.x ~= 1 or s.y ~= 1 or s.z ~= 1 then form[3], form[4], form[5] = s.x, s.y, s.z end
    return form
end

function Shape:setForm(form) core.shape_set_geometry(self.native, self.id, shapes.geometry(form)) end
function Shape:getForm()
    return shapes.form_of(self.world:getStore(), core.shape_get_geometry(self.native, self.id))
end

-- ---- making them ----------------------------------------------------------------------------------------------------

local function put_option(def, name, value)
    if name == "position" then options.put_numbers(def.frame.position, "fe_vec3", value, name)
    elseif name == "rotation" then options.put_numbers(def.frame.rotation, "fe_quat", value, name)
    elseif name == "friction" or name == "restitution" then options.put_material(def.material, { [name] = value })
    elseif name ~= "material" and name ~= "userData" then options.put(def, "fe_shape_def", name, value) end
end

function Body:newShape(form, given)
    local def = core.shape_def()
    for name, value in pairs(given or {}) do put_option(def, name, value) end
    if given and given.material ~= nil then options.put_material(def.material, given.material) end
    local id = core.shape_create(self.native, self.id, def, shapes.geometry(form))
    self.world.data[id] = given and given.userData
    return objects.of(self.world, Shape, id)
end
-- A ball, by its radius, m.
function Body:newSphere(radius, given) return self:newShape({ "sphere", radius }, given) end
-- A rod with round ends along local Y: half the height of its axis, and its radius, m.
function Body:newCapsule(half_height, radius, given) return self:newShape({ "capsule", half_height, radius }, given) end
-- A box, by half its edges, m.
function Body:newBox(x, y, z, given) return self:newShape({ "box", x, y, z }, given) end
-- A cylinder along local Y: half its height, and its radius, m.
function Body:newCylinder(half_height, radius, given) return self:newShape({ "cylinder", half_height, radius }, given) end
-- A cone along local Y, its tip up: half its height, and the radius of its base, m.
function Body:newCone(half_height, radius, given) return self:newShape({ "cone", half_height, radius }, given) end
-- A shape of a hull; its points are in the shape's frame.
function Body:newHull(hull, given) return self:newShape({ "hull", hull }, given) end
-- A shape of a mesh, on a static or kinematic body; its vertices are in the shape's frame.
function Body:newMesh(mesh, given) return self:newShape({ "mesh", mesh }, given) end
-- The half space normal . p <= distance, on a static body.
function Body:newPlane(nx, ny, nz, distance, given) return self:newShape({ "plane", nx, ny, nz, distance }, given) end
-- A shape of a heightfield, on a static body: terrain in the shape's frame.
function Body:newHeightfield(field, given) return self:newShape({ "heightfield", field }, given) end

-- ---- what they are --------------------------------------------------------------------------------------------------

-- The body that it belongs to.
function Shape:getBody() return objects.of(self.world, Body, core.shape_get_body(self.native, self.id)) end
function Shape:setFilter(layer, mask, group) core.shape_set_filter(self.native, self.id, layer, mask, group or 0) end
function Shape:setFrame(x, y, z, qx, qy, qz, qw)
    core.shape_set_frame(self.native, self.id, objects.pose({ x, y, z, qx, qy, qz, qw }))
end
function Shape:setSurfaceVelocity(x, y, z) core.shape_set_surface_velocity(self.native, self.id, xyz(x, y, z)) end
function Shape:setEvents(events) core.shape_set_events(self.native, self.id, options.event_bits(events)) end
function Shape:getEvents() return options.event_words(core.shape_get_events(self.native, self.id)) end
function Shape:setPairFilter(value)
    core.shape_set_pair_filter(self.native, self.id, options.switch(value, "pairFilter"))
end
function Shape:getPairFilter() return core.shape_get_pair_filter(self.native, self.id) ~= 0 end
-- The direction may be left out: it stays as it is.
function Shape:setOneWay(value, x, y, z)
    core.shape_set_one_way(self.native, self.id, options.switch(value, "oneWay"), x ~= nil and xyz(x, y, z) or nil)
end
function Shape:getOneWay()
    local enabled, x, y, z = core.shape_get_one_way(self.native, self.id)
    return enabled ~= 0, x, y, z
end
-- Changes what the table names.
function Shape:setMaterial(material)
    local now = { core.shape_get_material(self.native, self.id) }
    core.shape_set_material(self.native, self.id, options.material_numbers(material, now))
end
function Shape:getMaterial() return options.read_material(core.shape_get_material(self.native, self.id)) end
function Shape:getOverlaps()
    return objects.all(self.world, Shape, (select(2, core.shape_get_overlaps(self.native, self.id))))
end

return shapes
