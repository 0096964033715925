-- Drawing: what a world looks like, as numbers. Options are { parts = { "shapes", "contacts"... }, origin, lower, upper,
-- only = body, scale, segments }, or nothing.
local native = require("feather.native")
local objects = require("feather.objects")
local options = require("feather.options")
local fail = require("feather.where").fail
local core = native.core
local World, Body = objects.World, objects.Body

local PARTS = {
    shapes = 1, contacts = 2, forces = 4, joints = 8, limits = 16, islands = 32, sleep = 64, bounds = 128,
    centres = 256, trees = 512,
}
local KINDS = { lines = true, triangles = true, points = true, instances = true }

local function bits_of(parts)
    if type(parts) == "string" then parts = { parts } end
    if type(parts) ~= "table" then fail("parts: a table of words is needed, not a %s", type(parts)) end
    local bits, seen = 0, {}
    for _, name in ipairs(parts) do
        if not seen[name] then bits = bits + options.word(PARTS, name, "parts") end
        seen[name] = true
    end
    return bits
end

local function record_of(world, given)
    if given == nil then return nil end
    local record = core.draw_options()
    for name, value in pairs(given) do
        if name == "parts" then record.parts = bits_of(value)
        elseif name == "only" then record.only = objects.handle(world, value, Body)
        else options.put(record, "fe_draw_options", name, value) end
    end
    return record
end

-- 5 numbers a vertex: x, y, z, rgba, the handle of its shape or joint. Two vertices a line, three a triangle.
function World:drawLines(given) return (select(2, core.world_draw_lines(self.native, record_of(self, given)))) end
function World:drawTriangles(given)
    return (select(2, core.world_draw_triangles(self.native, record_of(self, given))))
end
function World:drawPoints(given) return (select(2, core.world_draw_points(self.native, record_of(self, given)))) end
-- 16 numbers a shape: type, rgba, shape, body, asset, x, y, z, rotation x, y, z, w, half extents x, y, z, part
function World:drawInstances(given)
    return (select(2, core.world_draw_instances(self.native, record_of(self, given))))
end
-- LuaJIT only: "lines", "triangles", "points" or "instances" as an array of fe_draw_vertex or fe_draw_instance, and how
-- many there are. Give back what an earlier call returned, and nothing is allocated while it is large enough.
if core.ffi then
    function World:drawArray(kind, given, array)
        if not KINDS[kind] then options.word(KINDS, kind, "kind") end
        return core.draw_array(self.native, kind, record_of(self, given), array)
    end
end
