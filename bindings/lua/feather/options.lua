-- Tables of options on their way into the header's structs and back. The names are the header's in camelCase, or as
-- they stand there; words stand for enumerators, true and false for switches, tables of numbers for vectors. What the
-- struct does not have is an error that names it.
local native = require("feather.native")
local structs = require("feather.structs")
local fail = require("feather.where").fail
local options = {}

-- ---- words ----------------------------------------------------------------------------------------------------------

options.BODY_TYPES = { static = 0, kinematic = 1, dynamic = 2 }
options.EVENTS = { touch = 1, stay = 2, hit = 4 }
options.DOFS = { linearX = 0, linearY = 1, linearZ = 2, angularX = 3, angularY = 4, angularZ = 5 }
local MOTIONS = { locked = 0, limited = 1, free = 2 }
local SPRINGS = { none = 0, hertz = 1, stiffness = 2 }
local COMBINES = { default = 0, average = 1, minimum = 2, multiply = 3, maximum = 4 }
local SIMD = { auto = 0, plain = 1, sse2 = 2, avx2 = 3, avx512 = 4, neon = 5, wasm = 6 }
local AXES = { x = 1, y = 2, z = 4 }

function options.word(words, text, what)
    local found = words[text]
    if found == nil then
        local known = {}
        for name in pairs(words) do known[#known + 1] = name end
        table.sort(known)
        fail("%s: one of %s is needed, not %s", what, table.concat(known, ", "), tostring(text))
    end
    return found
end

function options.name_of(words, number)
    for name, value in pairs(words) do
        if value == number then return name end
    end
end

function options.event_bits(events)
    if type(events) == "string" then events = { events } end
    if type(events) ~= "table" then fail("events: a table of words is needed, not a %s", type(events)) end
    local bits, seen = 0, {}
    for _, name in ipairs(events) do
        if not seen[name] then bits = bits + options.word(options.EVENTS, name, "events") end
        seen[name] = true
    end
    return bits
end

function options.event_words(bits)
    local found = {}
    for _, name in ipairs({ "touch", "stay", "hit" }) do
        local bit = options.EVENTS[name]
        if bits % (2 * bit) >= bit then found[#found + 1] = name end
    end
    return found
end

-- "xz" for the axes X and Z.
function options.axis_bits(text)
    if type(text) ~= "string" then fail("axes: letters of xyz are needed, not a %s", type(text)) end
    local bits, seen = 0, {}
    for letter in text:gmatch(".") do
        if not seen[letter] then bits = bits + options.word(AXES, letter, "axes") end
        seen[letter] = true
    end
    return bits
end

function options.axis_text(bits)
    return (bits % 2 >= 1 and "x" or "") .. (bits % 4 >= 2 and "y" or "") .. (bits >= 4 and "z" or "")
end

local function enumeration(words)
    return {
        put = function(value, what) return options.word(words, value, what) end,
        read = function(number) return options.name_of(words, number) end,
    }
end

-- true or false
local switch = {
    put = function(value, what)
        if value == 0 or value == 1 then return value end
        if type(value) ~= "boolean" then fail("%s: true or false is needed, not a %s", what, type(value)) end
        return value and 1 or 0
    end,
    read = function(number) return number ~= 0 end,
}
options.switch = switch.put

local AXIS_LETTERS = { put = options.axis_bits, read = options.axis_text }
-- fields that are more than the numbers they hold
local CODED = {
    type = enumeration(options.BODY_TYPES), simd = enumeration(SIMD), motion = enumeration(MOTIONS),
    spring = enumeration(SPRINGS),
    friction_combine = enumeration(COMBINES), restitution_combine = enumeration(COMBINES),
    events = { put = options.event_bits, read = options.event_words },
    linear_locks = AXIS_LETTERS, angular_locks = AXIS_LETTERS,
}
function options.version_text(number)
    return string.format("%d.%d.%d", math.floor(number / 65536), math.floor(number / 256) % 256, number % 256)
end
CODED.library = { read = options.version_text } -- of a snapshot
for name in ([[awake sleep_allowed enabled bullet trigger pair_filter one_way collide_connected limit_enabled
    cone_enabled sleep_enabled continuous_enabled warm_start_enabled new_number foreign filter]]):gmatch("%S+") do CODED[name] = switch end
local CODED_STRUCTS = {
    fe_world_def = true, fe_world_tuning = true, fe_body_def = true, fe_shape_def = true, fe_material = true,
    fe_joint_axis = true, fe_joint_def = true, fe_distance_joint_def = true, fe_ball_joint_def = true,
    fe_hinge_joint_def = true, fe_fixed_joint_def = true, fe_configurable_joint_def = true,
    fe_restore_options = true, fe_snapshot_info = true,
}

-- ---- vectors --------------------------------------------------------------------------------------------------------

local function item(value, i, what)
    local number = value[i]
    if type(number) ~= "number" then fail("%s: number %d is missing or a %s", what, i, type(number)) end
    return number
end

local function put_vector(target, value, what, first)
    target.x, target.y, target.z = item(value, first, what), item(value, first + 1, what), item(value, first + 2, what)
end

local function put_rotation(target, value, what, first)
    put_vector(target, value, what, first)
    target.w = item(value, first + 3, what)
end

local function put_pose(target, value, what)
    put_vector(target.position, value, what, 1)
    put_rotation(target.rotation, value, what, 4)
end

local function read_vector(v) return { v.x, v.y, v.z } end
local function read_rotation(v) return { v.x, v.y, v.z, v.w } end
local function read_pose(v)
    local p, q = v.position, v.rotation
    return { p.x, p.y, p.z, q.x, q.y, q.z, q.w }
end

local TABLES = {
    fe_vec3 = { put = put_vector, read = read_vector }, fe_dvec3 = { put = put_vector, read = read_vector },
    fe_quat = { put = put_rotation, read = read_rotation },
    fe_frame = { put = put_pose, read = read_pose }, fe_transform = { put = put_pose, read = read_pose },
}

-- Writes a table of numbers into a vector, a rotation or a pose.
function options.put_numbers(target, kind, value, what)
    if type(value) ~= "table" then fail("%s: a table of numbers is needed, not a %s", what, type(value)) end
    TABLES[kind].put(target, value, what, 1)
end

-- ---- fields ---------------------------------------------------------------------------------------------------------

local INTEGERS = { int32_t = { -2 ^ 31, 2 ^ 31 - 1 }, uint32_t = { 0, 2 ^ 32 - 1 } }
local NUMBERS = { int32_t = true, uint32_t = true, int64_t = true, float = true, double = true }
local tables = {} -- by struct: the fields that options may set, by name

local function fields_of(struct)
    local found = tables[struct]
    if not found then
        found = {}
        for _, field in ipairs(structs[struct]) do
            local known = NUMBERS[field.kind] or TABLES[field.kind] or field.kind == "uint64_t"
            local hidden = field.name:find("^reserved") or field.name == "struct_size" or field.pointer or field.length
            if known and not hidden then found[field.name] = field end
        end
        tables[struct] = found
    end
    return found
end

local function header_name(name)
    if name == "tag" then return "user_data" end
    return (tostring(name):gsub("%u", function(letter) return "_" .. letter:lower() end))
end

local function option_name(field)
    if field == "user_data" then return "tag" end
    return (field:gsub("_(%l)", string.upper))
end

-- Writes one option into a record. A struct's own user data is called tag: userData is any value of Lua's.
function options.put(record, struct, name, value)
    local field = fields_of(struct)[header_name(name)]
    if not field or name == "user_data" or name == "userData" then fail("there is no field %s", tostring(name)) end
    local coded, kind = CODED_STRUCTS[struct] and CODED[field.name], field.kind
    if coded then
        record[field.name] = coded.put(value, name)
    elseif TABLES[kind] then
        options.put_numbers(record[field.name], kind, value, name)
    elseif kind == "uint64_t" then
        record[field.name] = native.to_u64(value, name)
    else
        if type(value) ~= "number" then fail("%s: a number is needed, not a %s", name, type(value)) end
        local range = INTEGERS[kind]
        if range and not (value >= range[1] and value <= range[2] and value % 1 == 0) then
            fail("%s: %s is no integer of its range", name, tostring(value))
        end
        record[field.name] = value
    end
end

-- A record as a table of the options that put would take.
function options.read(record, struct)
    local made = {}
    for name, field in pairs(fields_of(struct)) do
        local value, coded, kind = record[name], CODED_STRUCTS[struct] and CODED[name], field.kind
        if coded then value = coded.read(native.number(value))
        elseif TABLES[kind] then value = TABLES[kind].read(value)
        elseif kind == "uint64_t" then value = native.from_u64(value)
        else value = native.number(value) end
        made[option_name(name)] = value
    end
    return made
end

-- Is it a table of options, all of whose names are in `known`? nil is none.
function options.check(value, known, what)
    if type(value) ~= "table" then fail("%s: a table is needed, not a %s", what, type(value)) end
    for name in pairs(value) do
        if not known[name] then fail("%s: there is no %s", what, tostring(name)) end
    end
    return value
end

-- ---- materials: 8 numbers in the flat functions, as the struct has its fields --------------------------------

local MATERIAL = {}
for _, field in ipairs(structs.fe_material) do
    if not field.name:find("^reserved") then MATERIAL[#MATERIAL + 1] = field.name end
end

function options.material_numbers(value, base)
    local record = {}
    for i, name in ipairs(MATERIAL) do record[name] = base[i] end
    options.put_material(record, value)
    local numbers = {}
    for i, name in ipairs(MATERIAL) do numbers[i] = record[name] end
    return numbers
end

function options.read_material(...)
    local record, numbers = {}, { ... }
    for i, name in ipairs(MATERIAL) do record[name] = numbers[i] end
    return options.read(record, "fe_material")
end

function options.put_material(record, value)
    if type(value) ~= "table" then fail("material: a table is needed, not a %s", type(value)) end
    if value.friction ~= nil then
        options.put(record, "fe_material", "staticFriction", value.friction)
        options.put(record, "fe_material", "dynamicFriction", value.friction)
    end
    for name, field in pairs(value) do
        if name ~= "friction" then options.put(record, "fe_material", name, field) end
    end
end

local default_material
function options.default_material()
    if not default_material then
        local material = native.core.shape_def().material
        default_material = {}
        for i, name in ipairs(MATERIAL) do default_material[i] = native.number(material[name]) end
    end
    return default_material
end

return options
