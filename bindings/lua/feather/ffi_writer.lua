-- Writes a Lua function for each prototype of feather.h, for LuaJIT: it takes and returns what the same function of
-- feather.core does, and calls C through ffi. What the code calls stands in its environment, see feather.ffi_values.
local ffi = require("ffi")
local structs = require("feather.structs")

-- The expressions that read the scalars of a struct one after the other, without the reserved ones.
local function scalars(kind, path, found)
    local fields = structs[kind]
    if kind == "uint64_t" then
        found[#found + 1] = "from_u64(" .. path .. ")"
    elseif not fields then
        found[#found + 1] = "tonumber(" .. path .. ")"
    end
    for _, field in ipairs(fields or {}) do
        for i = 0, field.name:find("^reserved") and -1 or (field.length or 1) - 1 do
            scalars(field.kind, path .. "." .. field.name .. (field.length and "[" .. i .. "]" or ""), found)
        end
    end
    return found
end

local SMALL = {
    fe_vec3 = "put_vec3", fe_dvec3 = "put_vec3", fe_quat = "put_quat", fe_transform = "put_transform",
    fe_frame = "put_frame", fe_bounds = "put_bounds", fe_material = "put_material",
}
local MANY = { fe_transform = true, fe_hit = true } -- one for each record that goes in
local FOUND = { fe_hit = true, fe_closest = true } -- what a query fills when it returns 1
local ARRAYS = {
    transforms = 'records(ffi.typeof("fe_transform[?]"), 7, put_transform, %s, count, "transforms")',
    rays = 'records(ffi.typeof("fe_ray[?]"), 6, put_ray, %s, count, "rays")',
    paths = 'records(ffi.typeof("fe_path[?]"), 10, put_path, %s, count, "paths")',
    floats = 'floats(%s, 6, count, "floats")',
    values = 'floats(%s, 1, count, "values")',
}
local BOXES = { fe_world = "world", fe_pool = "pool", fe_store = "store", fe_history = "history",
    fe_recorder = "recorder", fe_state = "state",
}
local TABLES = {
    fe_query_filter = "filter", fe_heightfield_def = "heightfield", fe_hull_def = "hull", fe_mesh_def = "mesh",
}
local HANDLES = { fe_handle = true, fe_body = true, fe_shape = true, fe_joint = true, fe_asset = true }
local RANGES = {
    int32_t = "-2147483648, 2147483647", uint32_t = "0, 4294967295", int64_t = "-9007199254740992, 9007199254740992",
}
local PLURAL = {
    out_bodies = true, out_shapes = true, out_joints = true, out_transforms = true, out_hits = true,
    out_overlaps = true, out_events = true, out_contacts = true, out_vertices = true, out_faces = true,
    out_corners = true, out_instances = true, out_frames = true,
}
local DESTROYED = {
    fe_world_destroy = true, fe_pool_destroy = true, fe_store_destroy = true, fe_history_destroy = true,
    fe_recorder_destroy = true, fe_state_destroy = true,
}

-- ---- parameters: each adds to the function f its argument, code before the call, the call's argument, results -------

local function add(list, format, ...) list[#list + 1] = select("#", ...) > 0 and format:format(...) or format end

-- A number, or what is known without the caller.
local function write_scalar(f, p)
    if p.name == "ray_stride" then add(f.call, "%d", ffi.sizeof("fe_ray"))
    elseif p.name == "path_stride" then add(f.call, "%d", ffi.sizeof("fe_path"))
    elseif p.name == "stride" then add(f.call, "%d", f.grows and ffi.sizeof(f.grows) or 0)
    elseif p.name == "count" or p.name == "capacity" then add(f.call, p.name)
    else
        add(f.arguments, p.a)
        local range = HANDLES[p.kind] and "0, 9007199254740992" or RANGES[p.kind]
        if range then add(f.call, "integer(%s, %s, %q)", p.a, range, p.name)
        elseif p.kind == "uint64_t" then add(f.call, "to_u64(%s, %q)", p.a, p.name)
        else add(f.call, "number(%s, %q)", p.a, p.name) end
    end
end

-- A vector, a pose, a material: put into one struct again and again. A direction may be nil.
local function write_small(f, p)
    add(f.upvalues, "local %s = ffi.new(%q)", p.o, p.kind)
    local put = ("%s(%s, check_table(%s, %q), 0)"):format(SMALL[p.kind], p.o, p.a, p.name)
    if p.name == "direction" then
        add(f.before, "if %s ~= nil then %s end", p.a, put)
        add(f.call, "%s ~= nil and %s or nil", p.a, p.o)
    else
        add(f.before, put)
        add(f.call, p.o)
    end
end

-- A table that becomes an array or a struct, which `kept` keeps until the call is done; or a record.
local function write_input(f, p)
    local i, a = p.index, p.a
    if p.kind == "fe_allocator" then -- for hosts in C
        add(f.call, "nil")
        return
    end
    add(f.arguments, a)
    if BOXES[p.kind] then add(f.call, "%s(%s)", BOXES[p.kind], a)
    elseif TABLES[p.kind] then
        add(f.before, "local h%d, kept%d = %s(%s)", i, i, TABLES[p.kind], a)
        add(f.call, "h%d", i)
    elseif p.const and HANDLES[p.kind] then
        add(f.before, "local h%d h%d, count = handles(%s, count, %q)", i, i, a, p.name)
        add(f.call, "h%d", i)
    elseif p.const and ARRAYS[p.name] then
        add(f.before, "local h%d h%d, count = " .. ARRAYS[p.name], i, i, a)
        add(f.call, "h%d", i)
    elseif p.const and p.name == "heights" then
        add(f.before, "local h%d = heights(%s, a%d, a%d, %q)", i, a, i - 2, i - 1, p.name)
        add(f.call, "h%d", i)
    elseif p.const and p.name == "materials" then
        add(f.before, "local h%d h%d, count = materials(%s)", i, i, a)
        add(f.call, "h%d", i)
    elseif p.const and p.name == "parts" then
        f.grows = p.kind
        add(f.before, "local h%d h%d, count = parts(%s)", i, i, a)
        add(f.call, "h%d", i)
    elseif p.const and SMALL[p.kind] then write_small(f, p)
    else
        add(f.upvalues, "local T%d = ffi.typeof(%q)", i, p.kind)
        add(f.call, "record(%s, T%d, %q)", a, i, p.name)
    end
end

-- One value or struct, read from a variable that is used again and again.
local function write_output(f, p)
    local o = p.o
    local length = structs[p.kind] and "" or p.name == "out_words" and "[2]" or "[1]"
    add(f.upvalues, "local %s = ffi.new(%q)", o, p.kind .. length)
    add(f.call, o)
    if p.name == "out_words" then add(f.results, "hex(%s)", o)
    elseif not structs[p.kind] then add(f.results, scalars(p.kind, o .. "[0]", {})[1])
    else
        f.found = FOUND[p.kind]
        for _, expression in ipairs(scalars(p.kind, o, {})) do add(f.results, expression) end
    end
end

local function write_box(f, p)
    add(f.upvalues, "local %s = ffi.new(%q)", p.o, p.kind .. " *[1]")
    add(f.call, p.o)
    if f.name == "fe_world_get_store" then add(f.results, "store_of(%s[0], a1)", p.o)
    elseif f.name == "fe_world_clone" then add(f.results, "new_clone(%s[0], a1, a2)", p.o)
    elseif p.kind == "fe_world" then add(f.results, "new_world(%s[0], a1)", p.o) -- behind its definition
    elseif p.kind == "fe_history" then add(f.results, "new_history(%s[0], a1)", p.o) -- behind its world
    else add(f.results, "new%s(%s[0])", p.kind:sub(3), p.o) end
end

-- A record of the caller's own.
local function write_record(f, p)
    add(f.upvalues, "local T%d = ffi.typeof(%q)", p.index, p.kind)
    add(f.before, "local %s = T%d()", p.o, p.index)
    if structs[p.kind][1].name == "struct_size" then
        add(f.before, "%s.struct_size = ffi.sizeof(T%d)", p.o, p.index)
    end
    add(f.call, p.o)
    add(f.results, p.o)
end

local function write_floats(f, p)
    local length = "6 * count"
    if p.name == "out_heights" then length = ("math.max(a%d * a%d, 0)"):format(p.index - 2, p.index - 1)
    elseif f.name:find("transforms_f32") then length = "7 * count"
    elseif f.name:find("joint_coordinates") then length = "2 * count" end
    add(f.before, "local n%d = %s", p.index, length)
    add(f.before, 'local %s = ffi.new("float[?]", n%d + 1)', p.o, p.index)
    add(f.call, p.o)
    add(f.results, "list(%s, n%d)", p.o, p.index)
end

-- All there are, asked for their number first, or one for each record that goes in.
local function write_array(f, p)
    local length, puts = f.capacity and "capacity" or "count", scalars(p.kind, "e", {})
    if structs[p.kind] and not SMALL[p.kind] then f.grows = p.kind end
    for i, expression in ipairs(puts) do puts[i] = ("t[n + %d] = %s"):format(i, expression) end
    add(f.upvalues, "local function put%d(t, n, e) %s return n + %d end", p.index, table.concat(puts, " "), #puts)
    add(f.before, "local %s", p.o)
    add(f.arrays, '%s = ffi.new("%s[?]", %s + 1)', p.o, p.kind, length)
    add(f.call, p.o)
    add(f.results, "all(%s, %s, put%d)", p.o, length, p.index)
end

local function write_parameter(f, p)
    if p.stars == 0 then write_scalar(f, p)
    elseif p.stars == 2 then write_box(f, p)
    elseif not p.name:find("^out_") then write_input(f, p)
    elseif p.name == "out_floats" or p.name == "out_heights" then write_floats(f, p)
    elseif PLURAL[p.name] and (f.capacity or MANY[p.kind]) then write_array(f, p)
    elseif not structs[p.kind] or SMALL[p.kind] or FOUND[p.kind] then write_output(f, p)
    else write_record(f, p) end
end

-- ---- functions ------------------------------------------------------------------------------------------------------

-- The code of the call and of what is returned, by the type of the C function's result.
local function write_call(f, code)
    local call, returned = "call(" .. table.concat(f.call, ", ") .. ")", table.concat(f.results, ", ")
    local arrays = table.concat(f.arrays, " ")
    if not f.capacity then add(code, arrays) end
    if f.result == "fe_result" then
        add(code, "local r = tonumber(" .. call .. ") if r < 0 then check(r) end")
        add(code, DESTROYED[f.name] and "forget(a1)" or "return " .. returned)
        return
    elseif f.result ~= "int32_t" then
        add(code, "return tonumber(" .. call .. ")")
        return
    end
    add(code, "local r = check(" .. call .. ")")
    if f.capacity then add(code, "if r > 0 then capacity = r " .. arrays .. " r = check(" .. call .. ") end") end
    if f.name:find("_any$") then add(code, "return r > 0")
    elseif f.found then add(code, "if r == 0 then return nil end return " .. returned)
    else add(code, "return r" .. (returned ~= "" and ", " .. returned or "")) end
end

-- The Lua function of a prototype: its result type, its name, its parameters in parentheses.
return function(env, result, name, parameters)
    local f = {
        name = name, result = result, capacity = parameters:find("capacity") ~= nil,
        arguments = {}, upvalues = {}, before = {}, call = {}, results = {}, arrays = {},
    }
    local index = 0
    for parameter in parameters:sub(2, -2):gmatch("[^,]+") do
        local const, kind, stars, plain = parameter:match("^ ?(c?o?n?s?t?) ?([%w_]+) (%**)([%w_]+)")
        if plain then
            index = index + 1
            write_parameter(f, {
                kind = kind, name = plain, stars = #stars, const = const == "const", index = index,
                a = "a" .. index, o = "o" .. index,
            })
        end
    end
    local code = { "local C, ffi = C, ffi", "local call = C." .. name }
    for _, line in ipairs(f.upvalues) do add(code, line) end
    add(code, "return function(" .. table.concat(f.arguments, ", ") .. ") local count")
    if f.capacity then add(code, "local capacity = 0") end
    for _, line in ipairs(f.before) do add(code, line) end
    write_call(f, code)
    add(code, "end")
    return setfenv(assert(loadstring(table.concat(code, "\n"), "=" .. name)), env)()
end
