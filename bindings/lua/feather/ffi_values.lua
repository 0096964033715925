-- What the functions that feather.ffi_writer writes call: Lua values into C's and back. The module is a function that
-- adds them to an environment, in which C is the library.
local ffi = require("ffi")
local fail = require("feather.where").fail
local position = require("feather.where").position

return function(env)
local C = env.C

function env.check(result)
    if result < 0 then
        local sentence = ffi.string(C.fe_last_error())
        error(position() .. sentence, 0)
    end
    return result
end
function env.number(value, name)
    if type(value) ~= "number" then fail("%s: a number is needed, not a %s", name, type(value)) end
    return value
end
function env.integer(value, low, high, name)
    if type(value) ~= "number" then fail("%s: a number is needed, not a %s", name, type(value)) end
    if not (value >= low and value <= high) or value % 1 ~= 0 then
        fail("%s: %f is no integer of its range", name, value)
    end
    return value
end
-- 64 bits: numbers up to 2^53, ULL and LL beyond.
function env.to_u64(value, name)
    if type(value) == "cdata" and (ffi.istype("uint64_t", value) or ffi.istype("int64_t", value)) then
        return ffi.cast("uint64_t", value)
    end
    return env.integer(value, 0, 2 ^ 53, name)
end
function env.from_u64(value)
    if value <= 9007199254740992ULL then return tonumber(value) end
    return value
end
local function check_table(value, name)
    if type(value) ~= "table" then fail("%s: a table is needed, not a %s", name, type(value)) end
    return value
end
env.check_table = check_table
function env.record(value, kind, name)
    if value ~= nil and not ffi.istype(kind, value) then
        fail("%s: %s is needed, not a %s", name, tostring(kind), type(value))
    end
    return value
end


-- ---- arrays that go in ----------------------------------------------------------------------------------------------

-- How many records of `width` numbers a table has; count is that of other tables of the call.
local function records_in(value, width, count, name)
    local length = #check_table(value, name)
    if length % width ~= 0 then fail("%s: %d numbers are not whole records of %d", name, length, width) end
    length = length / width
    if count and count ~= length then
        fail("%s: %d records where the other table has %d", name, length, count)
    end
    return length
end

local function array(kind, width, value, count, name)
    local length = records_in(value, width, count, name)
    local made = ffi.new(kind, math.max(length * width, 1))
    for i = 1, length * width do made[i - 1] = env.number(value[i], name) end
    return made, length
end
local Handles, Floats, Bytes = ffi.typeof("fe_handle[?]"), ffi.typeof("float[?]"), ffi.typeof("uint8_t[?]")
local Words = ffi.typeof("uint32_t[?]")
function env.handles(value, count, name)
    check_table(value, name)
    for i = 1, #value do env.integer(value[i], 0, 2 ^ 53, name) end
    return array(Handles, 1, value, count, name)
end
function env.floats(value, width, count, name) return array(Floats, width, value, count, name) end
function env.heights(value, rows, columns, name)
    local made = array(Floats, 1, value, nil, name)
    if rows > 0 and columns > 0 and rows * columns > #value then
        fail("heights: %d where %d x %d are needed", #value, rows, columns)
    end
    return made
end
-- records of numbers, filled field by field
function env.records(kind, width, put, value, count, name)
    local length = records_in(value, width, count, name)
    local made = ffi.new(kind, math.max(length, 1))
    for i = 0, length - 1 do put(made[i], value, i * width) end
    return made, length
end

-- ---- numbers into structs -------------------------------------------------------------------------------------------

-- ffi itself would take true for 1
local function item(t, i)
    local value = t[i]
    if type(value) ~= "number" then fail("item %d is no number but a %s", i, type(value)) end
    return value
end
function env.put_vec3(v, t, n) v.x, v.y, v.z = item(t, n + 1), item(t, n + 2), item(t, n + 3) end
function env.put_quat(v, t, n) v.x, v.y, v.z, v.w = item(t, n + 1), item(t, n + 2), item(t, n + 3), item(t, n + 4) end
function env.put_transform(v, t, n)
    env.put_vec3(v.position, t, n)
    env.put_quat(v.rotation, t, n + 3)
end
function env.put_ray(v, t, n)
    env.put_vec3(v.origin, t, n)
    env.put_vec3(v.translation, t, n + 3)
end
function env.put_path(v, t, n)
    env.put_transform(v.start, t, n)
    env.put_vec3(v.translation, t, n + 7)
end
function env.put_frame(v, t, n)
    env.put_vec3(v.position, t, n)
    env.put_quat(v.rotation, t, n + 3)
end
function env.put_bounds(v, t, n)
    env.put_vec3(v.lower, t, n)
    env.put_vec3(v.upper, t, n + 3)
end
function env.put_material(v, t, n)
    C.fe_material_init(v)
    v.static_friction, v.dynamic_friction, v.restitution = item(t, n + 1), item(t, n + 2), item(t, n + 3)
    v.rolling_resistance, v.spinning_resistance = item(t, n + 4), item(t, n + 5)
    v.friction_combine = env.integer(t[n + 6], -2 ^ 31, 2 ^ 31 - 1, "friction_combine")
    v.restitution_combine = env.integer(t[n + 7], -2 ^ 31, 2 ^ 31 - 1, "restitution_combine")
    v.user_id = env.to_u64(t[n + 8], "user_id")
end

-- ---- tables that stand for structs ----------------------------------------------------------------------------------

local Filter, Field = ffi.typeof("fe_query_filter"), ffi.typeof("fe_heightfield_def")
function env.filter(value)
    if value == nil then return nil end
    check_table(value, "filter")
    local made, kept = Filter(), nil
    C.fe_query_filter_init(made, ffi.sizeof(Filter))
    if value.mask ~= nil then made.mask = env.integer(value.mask, 0, 2 ^ 32 - 1, "mask") end
    if value.flags ~= nil then made.flags = env.integer(value.flags, 0, 2 ^ 32 - 1, "flags") end
    if value.excluded ~= nil then
        kept, made.excluded_count = env.handles(value.excluded, nil, "excluded")
        made.excluded = kept
    end
    return made, kept
end
function env.materials(value)
    local count = #check_table(value, "materials")
    if count > 255 then fail("materials: at most 255") end
    local made = ffi.new("fe_material[?]", math.max(count, 1))
    for i = 1, count do env.put_material(made[i - 1], check_table(value[i], "materials"), 0) end
    return made, count
end
local Part = ffi.typeof("fe_compound_part")
function env.parts(value)
    local count = #check_table(value, "parts")
    local made = ffi.new("fe_compound_part[?]", math.max(count, 1))
    for i = 1, count do
        if not ffi.istype(Part, value[i]) then fail("parts: %s is needed, not a %s", tostring(Part), type(value[i])) end
        made[i - 1] = value[i]
    end
    return made, count
end
local function words(value, width, count, name)
    check_table(value, name)
    for i = 1, #value do env.integer(value[i], 0, 2 ^ 32 - 1, name) end
    return array(Words, width, value, count, name)
end
local HullDef, MeshDef = ffi.typeof("fe_hull_def"), ffi.typeof("fe_mesh_def")
function env.hull(value)
    check_table(value, "hull")
    local made, kept = HullDef(), nil
    C.fe_hull_def_init(made, ffi.sizeof(HullDef))
    kept, made.point_count = array(Floats, 3, value.points, nil, "points")
    made.points = kept
    made.max_vertices = env.integer(value.max_vertices, -2 ^ 31, 2 ^ 31 - 1, "max_vertices")
    made.tolerance = env.number(value.tolerance, "tolerance")
    return made, kept
end
function env.mesh(value)
    check_table(value, "mesh")
    local made, kept = MeshDef(), {}
    C.fe_mesh_def_init(made, ffi.sizeof(MeshDef))
    kept[1], made.vertex_count = array(Floats, 3, value.vertices, nil, "vertices")
    kept[2], made.triangle_count = words(value.triangles, 3, nil, "triangles")
    made.vertices, made.indices = kept[1], kept[2]
    made.flags = env.integer(value.flags, 0, 2 ^ 32 - 1, "flags")
    made.weld_distance = env.number(value.weld_distance, "weld_distance")
    made.edge_angle = env.number(value.edge_angle, "edge_angle")
    if value.triangle_materials ~= nil then
        local count, name = made.triangle_count, "triangle_materials"
        if #check_table(value.triangle_materials, name) ~= count then fail("%s: %d numbers are needed", name, count) end
        for i = 1, count do env.integer(value.triangle_materials[i], 0, 255, name) end
        kept[3] = array(Bytes, 1, value.triangle_materials, count, name)
        made.triangle_materials = kept[3]
    end
    if value.materials ~= nil then kept[4], made.material_count = env.materials(value.materials) end
    made.materials = kept[4]
    if value.triangle_data ~= nil then
        kept[5] = words(value.triangle_data, 1, made.triangle_count, "triangle_data")
        made.triangle_data = kept[5]
    end
    return made, kept
end
function env.heightfield(value)
    check_table(value, "heightfield")
    local made, kept = Field(), {}
    C.fe_heightfield_def_init(made, ffi.sizeof(Field))
    made.rows, made.columns = env.integer(value.rows, 2, 32768, "rows"), env.integer(value.columns, 2, 32768, "columns")
    made.cell_x, made.cell_z = env.number(value.cell_x, "cell_x"), env.number(value.cell_z, "cell_z")
    kept[1] = env.heights(value.heights, made.rows, made.columns, "heights")
    made.heights = kept[1]
    local cells = (made.rows - 1) * (made.columns - 1)
    for i, name in ipairs({ "holes", "cell_materials" }) do
        if value[name] ~= nil then
            if #check_table(value[name], name) ~= cells then fail("%s: %d numbers are needed", name, cells) end
            kept[1 + i] = array(Bytes, 1, value[name], cells, name)
            made[name] = kept[1 + i]
        end
    end
    if value.materials ~= nil then kept[4], made.material_count = env.materials(value.materials) end
    made.materials = kept[4]
    return made, kept
end

-- ---- arrays that come out -------------------------------------------------------------------------------------------

-- the hash, as every language prints it
function env.hex(words) return string.format("%08x%08x", words[1], words[0]) end
function env.list(floats, count)
    local made = {}
    for i = 1, count do made[i] = floats[i - 1] end
    return made
end
function env.all(records, count, put)
    local made, n = {}, 0
    for i = 0, count - 1 do n = put(made, n, records[i]) end
    return made
end

end
