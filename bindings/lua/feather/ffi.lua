-- The functions of feather.h for LuaJIT, without a C module: reads the prototypes of the header (feather.header) and writes a Lua function for each,
-- with the arguments and results that feather.core has (bindings/lua/lua.i): vectors in as tables, out as values; arrays as flat tables.
local ffi = require("ffi")
local header = require("feather.header")
ffi.cdef(header)

local function library()
    local path = os.getenv("FEATHER_LIBRARY")
    if not path and package.searchpath then path = package.searchpath("libfeather", package.cpath) end
    return ffi.load(path or "feather")
end

local C = library()
local core = { ffi = true }
local Box = ffi.typeof("struct { fe_world *p; }")
local PoolBox = ffi.typeof("struct { fe_pool *p; }")
local env = { C = C, ffi = ffi, Box = Box, PoolBox = PoolBox, tonumber = tonumber, type = type, error = error, null = nil }

-- ---- what the written functions call -------------------------------------------------------------------------------------------------

local function fail(...) error("feather: " .. string.format(...), 0) end

function env.world(box)
    if not ffi.istype(Box, box) then fail("a world is needed, not a %s", type(box)) end
    if box.p == nil then fail("the world is destroyed") end
    return box.p
end
function env.pool(box)
    if not ffi.istype(PoolBox, box) then fail("a pool is needed, not a %s", type(box)) end
    if box.p == nil then fail("the pool is destroyed") end
    return box.p
end
-- Finalizers run in any order: a pool refuses its end while a world of it lives, and then ends with that world.
local refused = {}
local function end_world(box)
    if box.p ~= nil and C.fe_world_destroy(box.p) == 0 then box.p = nil end
    for pool in pairs(refused) do
        if C.fe_pool_destroy(pool.p) == 0 then refused[pool] = nil end
    end
end
local function end_pool(box)
    if box.p ~= nil and C.fe_pool_destroy(box.p) ~= 0 then refused[box] = true end
end
function env.new_world(pointer) return ffi.gc(Box(pointer), end_world) end
function env.new_pool(pointer) return ffi.gc(PoolBox(pointer), end_pool) end
function env.check(result)
    if result < 0 then error(ffi.string(C.fe_last_error()), 0) end
    return result
end
function env.number(value, name)
    if type(value) ~= "number" then fail("%s: a number is needed, not a %s", name, type(value)) end
    return value
end
function env.integer(value, low, high, name)
    if type(value) ~= "number" then fail("%s: a number is needed, not a %s", name, type(value)) end
    if not (value >= low and value <= high) or value % 1 ~= 0 then fail("%s: %f is no integer of its range", name, value) end
    return value
end
local function check_table(value, name)
    if type(value) ~= "table" then fail("%s: a table is needed, not a %s", name, type(value)) end
    return value
end
env.check_table = check_table
function env.record(value, kind, name)
    if value ~= nil and not ffi.istype(kind, value) then fail("%s: %s is needed, not a %s", name, tostring(kind), type(value)) end
    return value
end

-- An array of `width` numbers a record; count is that of other arrays of the call.
local function array(kind, width, value, count, name)
    check_table(value, name)
    local length = #value
    if length % width ~= 0 then fail("%s: %d numbers are not whole records of %d", name, length, width) end
    if count and count ~= length / width then fail("%s: %d records where the other table has %d", name, length / width, count) end
    local made = ffi.new(kind, math.max(length, 1))
    for i = 1, length do made[i - 1] = env.number(value[i], name) end
    return made, length / width
end
local Handles, Floats, Bytes = ffi.typeof("fe_handle[?]"), ffi.typeof("float[?]"), ffi.typeof("uint8_t[?]")
function env.handles(value, count, name)
    check_table(value, name)
    for i = 1, #value do env.integer(value[i], 0, 2 ^ 53, name) end
    return array(Handles, 1, value, count, name)
end
function env.floats(value, width, count, name) return array(Floats, width, value, count, name) end
function env.heights(value, rows, columns, name)
    local made = array(Floats, 1, value, nil, name)
    if rows > 0 and columns > 0 and rows * columns > #value then fail("heights: %d where %d x %d are needed", #value, rows, columns) end
    return made
end
-- records of numbers, filled field by field
function env.records(kind, width, put, value, count, name)
    check_table(value, name)
    if #value % width ~= 0 then fail("%s: %d numbers are not whole records of %d", name, #value, width) end
    local length = #value / width
    if count and count ~= length then fail("%s: %d records where the other table has %d", name, length, count) end
    local made = ffi.new(kind, math.max(length, 1))
    for i = 0, length - 1 do put(made[i], value, i * width) end
    return made, length
end
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
function env.put_material(v, t, n)
    v.static_friction, v.dynamic_friction, v.restitution = item(t, n + 1), item(t, n + 2), item(t, n + 3)
    v.rolling_resistance, v.spinning_resistance = item(t, n + 4), item(t, n + 5)
end

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
    if value.materials ~= nil then
        local count = #check_table(value.materials, "materials")
        if count > 255 then fail("materials: at most 255") end
        kept[4] = ffi.new("fe_material[?]", math.max(count, 1))
        for i = 1, count do env.put_material(kept[4][i - 1], check_table(value.materials[i], "materials"), 0) end
        made.materials, made.material_count = kept[4], count
    end
    return made, kept
end

-- ---- the header's structs and prototypes -----------------------------------------------------------------------------------------------

local text = header:gsub("%s+", " ")
local structs = {}
for body, name in text:gmatch("typedef struct [%w_]+ (%b{}) ([%w_]+);") do
    local fields = {}
    for kind, names in body:sub(2, -2):gmatch("([%w_]+) ([^;%(]+);") do
        for field in names:gmatch("[^,]+") do
            local plain, length = field:match("([%w_]+)%[(%d+)%]")
            fields[#fields + 1] = { kind = kind, name = plain or field:match("[%w_]+"), length = tonumber(length) }
        end
    end
    structs[name] = fields
end

-- The expressions that read the scalars of a struct one after the other.
local function scalars(kind, path, found)
    local fields = structs[kind]
    if not fields then
        found[#found + 1] = "tonumber(" .. path .. ")"
        return found
    end
    for _, field in ipairs(fields) do
        for i = 0, (field.length or 1) - 1 do
            scalars(field.kind, path .. "." .. field.name .. (field.length and "[" .. i .. "]" or ""), found)
        end
    end
    return found
end

local SMALL = { fe_vec3 = "put_vec3", fe_dvec3 = "put_vec3", fe_quat = "put_quat", fe_transform = "put_transform", fe_material = "put_material" }
local ARRAYS = {
    transforms = 'records(ffi.typeof("fe_transform[?]"), 7, put_transform, %s, count, "transforms")',
    rays = 'records(ffi.typeof("fe_ray[?]"), 6, put_ray, %s, count, "rays")',
    paths = 'records(ffi.typeof("fe_path[?]"), 10, put_path, %s, count, "paths")',
    floats = 'floats(%s, 6, count, "floats")',
}
local HANDLES = { fe_handle = true, fe_body = true, fe_shape = true, fe_joint = true, fe_asset = true }
local RANGES = { int32_t = "-2147483648, 2147483647", uint32_t = "0, 4294967295" }
local FOUND = { stride = "0", ray_stride = "0", path_stride = "0" }
local PLURAL = { out_bodies = true, out_shapes = true, out_joints = true, out_transforms = true, out_hits = true, out_events = true, out_contacts = true }
-- what the C module has otherwise, or not at all
local ABSENT = { fe_query_filter_init = true, fe_heightfield_def_init = true, fe_body_create_many = true, fe_last_error = true, fe_result_name = true }

-- Writes one parameter: adds to the lists of the function's arguments, code before the call, arguments of the call, results.
local function write_parameter(f, kind, name, stars, const, index, has_capacity)
    local a = "a" .. index
    local function argument(expression)
        f.arguments[#f.arguments + 1] = a
        f.call[#f.call + 1] = expression
    end
    local function static(declaration)
        f.upvalues[#f.upvalues + 1] = ("local o%d = ffi.new(%q)"):format(index, declaration)
        f.call[#f.call + 1] = "o" .. index
    end
    local function result(expression) f.results[#f.results + 1] = expression end
    local o = "o" .. index
    if kind == "fe_world" and stars == 1 then argument("world(" .. a .. ")")
    elseif kind == "fe_pool" and stars == 1 then argument("pool(" .. a .. ")")
    elseif stars == 2 then
        static(kind .. " *[1]")
        result(kind == "fe_world" and "new_world(" .. o .. "[0])" or "new_pool(" .. o .. "[0])")
    elseif FOUND[name] then f.call[#f.call + 1] = FOUND[name]
    elseif name == "count" or name == "capacity" then f.call[#f.call + 1] = name
    elseif stars == 0 and (HANDLES[kind] or RANGES[kind]) then
        argument(("integer(%s, %s, %q)"):format(a, RANGES[kind] or "0, 9007199254740992", name))
    elseif stars == 0 then argument(("number(%s, %q)"):format(a, name))
    elseif kind == "fe_query_filter" then
        f.before[#f.before + 1] = ("local f%d, kept%d = filter(%s)"):format(index, index, a)
        argument("f" .. index)
    elseif kind == "fe_heightfield_def" then
        f.before[#f.before + 1] = ("local f%d, kept%d = heightfield(%s)"):format(index, index, a)
        argument("f" .. index)
    elseif const and HANDLES[kind] then
        f.before[#f.before + 1] = ("local h%d h%d, count = handles(%s, count, %q)"):format(index, index, a, name)
        argument("h" .. index)
    elseif const and ARRAYS[name] then
        f.before[#f.before + 1] = ("local h%d h%d, count = "):format(index, index) .. ARRAYS[name]:format(a)
        argument("h" .. index)
    elseif const and name == "heights" then
        f.before[#f.before + 1] = ("local h%d = heights(%s, a%d, a%d, %q)"):format(index, a, index - 2, index - 1, name)
        argument("h" .. index)
    elseif const and SMALL[kind] then
        f.upvalues[#f.upvalues + 1] = ("local o%d = ffi.new(%q)"):format(index, kind)
        f.before[#f.before + 1] = ("%s(%s, check_table(%s, %q), 0)"):format(SMALL[kind], o, a, name)
        argument(o)
    elseif name == "out_words" then
        static("uint32_t[2]")
        result(('hex(%s)'):format(o))
    elseif name == "out_floats" or name == "out_heights" then
        local width = f.name:find("transforms_f32") and "7 * count" or name == "out_floats" and "6 * count" or ("math.max(a%d * a%d, 0)"):format(index - 2, index - 1)
        f.before[#f.before + 1] = ('local n%d = %s local o%d = ffi.new("float[?]", n%d + 1)'):format(index, width, index, index)
        f.call[#f.call + 1] = o
        result(("list(%s, n%d)"):format(o, index))
    elseif PLURAL[name] and (has_capacity or kind == "fe_transform" or kind == "fe_hit") then
        local length = has_capacity and "capacity" or "count"
        f.arrays[#f.arrays + 1] = ('o%d = ffi.new("%s[?]", %s + 1)'):format(index, kind, length)
        f.before[#f.before + 1] = "local o" .. index
        f.call[#f.call + 1] = o
        f.upvalues[#f.upvalues + 1] = ("local function put%d(t, n, e) %s return n + %d end"):format(index, (function()
            local code = {}
            for i, expression in ipairs(scalars(kind, "e", {})) do code[i] = ("t[n + %d] = %s"):format(i, expression) end
            return table.concat(code, " ")
        end)(), #scalars(kind, "e", {}))
        result(("all(%s, %s, put%d)"):format(o, length, index))
    elseif name:find("^out_") and (HANDLES[kind] or RANGES[kind] or kind == "float") then
        static(kind .. "[1]")
        result("tonumber(" .. o .. "[0])")
    elseif name:find("^out_") and SMALL[kind] then
        static(kind)
        for _, expression in ipairs(scalars(kind, o, {})) do result(expression) end
    elseif name:find("^out_") then
        f.upvalues[#f.upvalues + 1] = ("local T%d = ffi.typeof(%q)"):format(index, kind)
        f.before[#f.before + 1] = ("local o%d = T%d()"):format(index, index)
        if structs[kind][1].name == "struct_size" then f.before[#f.before + 1] = ("o%d.struct_size = ffi.sizeof(T%d)"):format(index, index) end
        f.call[#f.call + 1] = o
        f.missing = true
        result(o)
    else
        f.upvalues[#f.upvalues + 1] = ("local T%d = ffi.typeof(%q)"):format(index, kind)
        argument(("record(%s, T%d, %q)"):format(a, index, name))
    end
end

local function write(result, name, parameters)
    local f = { name = name, arguments = {}, upvalues = {}, before = {}, call = {}, results = {}, arrays = {} }
    local capacity = parameters:find("capacity") ~= nil
    local index = 0
    for parameter in parameters:sub(2, -2):gmatch("[^,]+") do
        local const, kind, stars, plain = parameter:match("^ ?(c?o?n?s?t?) ?([%w_]+) (%**)([%w_]+)")
        if plain then
            index = index + 1
            write_parameter(f, kind, plain, #stars, const == "const", index, capacity)
        end
    end
    local code = { "local C, ffi = C, ffi", "local call = C." .. name }
    for _, line in ipairs(f.upvalues) do code[#code + 1] = line end
    code[#code + 1] = "return function(" .. table.concat(f.arguments, ", ") .. ") local count"
    if capacity then code[#code + 1] = "local capacity = 0" end
    for _, line in ipairs(f.before) do code[#code + 1] = line end
    local call = "call(" .. table.concat(f.call, ", ") .. ")"
    local returned = table.concat(f.results, ", ")
    if #f.arrays > 0 and not capacity then
        for _, line in ipairs(f.arrays) do code[#code + 1] = line end
    end
    if result == "void" then
        code[#code + 1] = call .. " return " .. returned
    elseif result == "fe_result" then
        code[#code + 1] = "local r = tonumber(" .. call .. ") if r < 0 then check(r) end"
        if name:find("_any$") then code[#code + 1] = "return r == 0"
        elseif f.missing then code[#code + 1] = "if r ~= 0 then return nil end return " .. returned
        else code[#code + 1] = "return " .. returned end
        if name:find("_destroy$") and (name:find("world") or name:find("pool")) then code[#code] = "a1.p = nil" end
    elseif result == "int32_t" then
        code[#code + 1] = "local r = check(" .. call .. ")"
        if capacity then
            code[#code + 1] = "if r > 0 then capacity = r " .. table.concat(f.arrays, " ") .. " r = check(" .. call .. ") end"
        end
        code[#code + 1] = "return r" .. (returned ~= "" and ", " .. returned or "")
    else
        code[#code + 1] = "return tonumber(" .. call .. ")"
    end
    code[#code + 1] = "end"
    local chunk = assert(loadstring(table.concat(code, "\n"), "=" .. name))
    return setfenv(chunk, env)()
end

env.math = math
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

local prototypes = text:gsub("typedef [%w_]+ [%w_]+ %b{} [%w_]+;", "")
for result, name, parameters in prototypes:gmatch("([%w_]+) (fe_[%w_]+)(%b());") do
    if not ABSENT[name] and not name:find("_def_init$") and not name:find("_tuning_init$") then core[name:sub(4)] = write(result, name, parameters) end
end

-- definitions with their defaults
for name in prototypes:gmatch("void (fe_[%w_]+)_init%(") do
    if name ~= "fe_query_filter" and name ~= "fe_heightfield_def" then
        local kind, init = ffi.typeof(name), C[name .. "_init"]
        core[name:sub(4)] = function()
            local made = kind()
            init(made, ffi.sizeof(kind))
            return made
        end
    end
end

-- the twins of the C module (bindings/twins.h)
local transform = ffi.new("fe_transform")
local get_transform, set_transform = C.fe_body_get_transform, C.fe_body_set_transform
local function read(world, body)
    local r = get_transform(env.world(world), env.integer(body, 0, 2 ^ 53, "body"), transform)
    if r ~= 0 then env.check(tonumber(r)) end
end
function core.body_get_position(world, body)
    read(world, body)
    return transform.position.x, transform.position.y, transform.position.z
end
function core.body_get_rotation(world, body)
    read(world, body)
    return transform.rotation.x, transform.rotation.y, transform.rotation.z, transform.rotation.w
end
function core.body_set_position(world, body, position)
    read(world, body)
    env.put_vec3(transform.position, check_table(position, "position"), 0)
    env.check(tonumber(set_transform(world.p, body, transform)))
end
function core.body_set_rotation(world, body, rotation)
    read(world, body)
    env.put_quat(transform.rotation, check_table(rotation, "rotation"), 0)
    env.check(tonumber(set_transform(world.p, body, transform)))
end

function core.axis_of(desc, coordinate) return desc.axes[coordinate] end
function core.set_pool(desc, pool) desc.pool = env.pool(pool) end

return core
