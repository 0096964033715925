-- Compounds: one form of several parts.
local native = require("feather.native")
local objects = require("feather.objects")
local options = require("feather.options")
local shapes = require("feather.shape")
local asset_of = require("feather.store").asset_of
local fail = require("feather.where").fail
local core = native.core
local World, Store, Body, Compound = objects.World, objects.Store, objects.Body, objects.Compound

local function put_option(part, name, value)
    if name == "position" then options.put_numbers(part.frame.position, "fe_vec3", value, name)
    elseif name == "rotation" then options.put_numbers(part.frame.rotation, "fe_quat", value, name)
    elseif name == "material" then
        part.own_material = 1
        options.put_material(part.material, value)
    elseif name == "density" or name == "tag" then options.put(part, "fe_compound_part", name, value)
    elseif type(name) ~= "number" then fail("parts: there is no %s", tostring(name)) end
end

local function part_of(given)
    if type(given) ~= "table" then fail("parts: a table is needed, not a %s", type(given)) end
    local part = core.compound_part()
    part.geometry = shapes.geometry(given)
    for name, value in pairs(given) do put_option(part, name, value) end
    return part
end

-- A table of parts, each a form with what else it has: { { "box", 1, 0.05, 0.6 }, { "sphere", 0.2, position = { 0, 1, 0 },
-- rotation = { 0, 0, 0, 1 }, density = 500, material = { friction = 0.2 }, tag = 7 }... }. Density and material are the
-- shape's where a part has none. The first part is 0, as hits tell it.
function Store:newCompound(parts)
    if type(parts) ~= "table" then fail("parts: a table is needed, not a %s", type(parts)) end
    local made = {}
    for i = 1, #parts do made[i] = part_of(parts[i]) end
    return asset_of(self, Compound, core.compound_create(self.native, made))
end
-- In the world's store, as Store:newCompound.
function World:newCompound(parts) return self:getStore():newCompound(parts) end
-- A shape of a compound: its parts are in the shape's frame.
function Body:newCompound(compound, given) return self:newShape({ "compound", compound }, given) end

function Compound:getInfo() return options.read(core.compound_get_info(self.native, self.id), "fe_compound_info") end
-- A part as newCompound takes it.
function Compound:getPart(number)
    local part = core.compound_get_part(self.native, self.id, number)
    local form, p, q = shapes.form_of(self.store, part.geometry), part.frame.position, part.frame.rotation
    form.position, form.rotation = { p.x, p.y, p.z }, { q.x, q.y, q.z, q.w }
    if part.density ~= -1 then form.density = part.density end
    if part.own_material ~= 0 then form.material = options.read(part.material, "fe_material") end
    form.tag = native.from_u64(part.user_data)
    return form
end
