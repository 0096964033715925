-- The functions of feather.h for LuaJIT, without a C module. It reads the prototypes of the header (feather.header) and
-- writes a Lua function for each, with the arguments and results that feather.core has (bindings/lua/lua.i): vectors in
-- as tables, out as values; arrays as flat tables.
local ffi = require("ffi")
local fail = require("feather.where").fail
local header = require("feather.header")
local packed = require("feather.packed")
local write = require("feather.ffi_writer")
if not pcall(ffi.typeof, "fe_vec3") then ffi.cdef(header) end -- a second time when package.loaded was cleared

-- FEATHER_LIBRARY, what a game of LÖVE holds, package.cpath, the folders of the game, the system's.
local function library()
    local path = os.getenv("FEATHER_LIBRARY") or packed.path()
    if not path and package.searchpath then path = package.searchpath("libfeather", package.cpath) end
    local filesystem = type(love) == "table" and love.filesystem
    for _, folder in ipairs(filesystem and { "getSource", "getSourceBaseDirectory", "getSaveDirectory" } or {}) do
        local found = not path and filesystem[folder]() .. "/" .. packed.name
        local file = found and io.open(found, "rb")
        if file then
            file:close()
            path = found
        end
    end
    return ffi.load(path or "feather")
end

local C = library()
local core = { ffi = true }
-- const: nobody but forget changes them
local Box = ffi.typeof("struct { fe_world *const p; fe_pool *const pool; fe_store *const store; }")
local PoolBox = ffi.typeof("struct { fe_pool *const p; }")
local StoreBox = ffi.typeof("struct { fe_store *const p; }")
local HistoryBox = ffi.typeof("struct { fe_history *const p; }")
local StateBox = ffi.typeof("struct { fe_state *const p; }")
local RecorderBox = ffi.typeof("struct { fe_recorder *const p; }")
local env = { C = C, ffi = ffi, tonumber = tonumber, type = type, math = math }

-- ---- worlds, pools and stores ---------------------------------------------------------------------------------------

-- How many worlds use a pool or a store, by its address. One whose finalizer comes first waits for the last of them: a
-- call that is refused would take the place of the error that a script is about to be told.
local users, waiting = {}, {}
local function address(pointer) return tonumber(ffi.cast("uintptr_t", pointer)) end
local function use(pointer)
    if pointer ~= nil then users[address(pointer)] = (users[address(pointer)] or 0) + 1 end
end
local function release(pointer)
    local at = pointer ~= nil and address(pointer)
    if not at then return end
    users[at] = users[at] > 1 and users[at] - 1 or nil
    if not users[at] and waiting[at] then
        waiting[at](pointer)
        waiting[at] = nil
    end
end
env.use, env.release = use, release
local function end_shared(pointer, destroy)
    if pointer == nil then return end
    if users[address(pointer)] then waiting[address(pointer)] = destroy else destroy(pointer) end
end

function env.forget(box)
    ffi.cast("void **", box)[0] = nil
    if ffi.istype(Box, box) then
        release(box.pool)
        release(box.store)
    end
end
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
-- Stores that a world was asked for, and the world: they live at most as long.
local owners = setmetatable({}, { __mode = "k" })
function env.store(box)
    if not ffi.istype(StoreBox, box) then fail("a store is needed, not a %s", type(box)) end
    local owner = owners[box]
    if box.p == nil or (owner and owner.p == nil) then fail("the store is destroyed") end
    return box.p
end

-- A history ends with its world, which it keeps.
function env.history(box)
    if not ffi.istype(HistoryBox, box) then fail("a history is needed, not a %s", type(box)) end
    if box.p == nil or owners[box].p == nil then fail("the history is destroyed") end
    return box.p
end
function env.new_history(pointer, world)
    local box = HistoryBox(pointer)
    owners[box] = world
    return box
end

function env.recorder(box)
    if not ffi.istype(RecorderBox, box) then fail("a recorder is needed, not a %s", type(box)) end
    if box.p == nil then fail("the recorder is closed") end
    return box.p
end
-- In a step of its world, which the pair filter may be in, it is refused, and ends with the world.
local function end_recorder(box)
    if box.p ~= nil then C.fe_recorder_destroy(box.p) end
end
function env.new_recorder(pointer) return ffi.gc(RecorderBox(pointer), end_recorder) end

function env.state(box)
    if not ffi.istype(StateBox, box) then fail("a state is needed, not a %s", type(box)) end
    if box.p == nil then fail("the state is closed") end
    return box.p
end
local function end_state(box)
    if box.p ~= nil then C.fe_state_destroy(box.p) end
end
function env.new_state(pointer) return ffi.gc(StateBox(pointer), end_state) end

local function end_world(box)
    if box.p ~= nil and C.fe_world_destroy(box.p) == 0 then env.forget(box) end
end
local function end_pool(box) end_shared(box.p, C.fe_pool_destroy) end
local function end_store(box) end_shared(box.p, C.fe_store_destroy) end
local function new_world(pointer, pool, store)
    use(pool)
    use(store)
    return ffi.gc(Box(pointer, pool, store), end_world)
end
function env.new_world(pointer, def) return new_world(pointer, def and def.pool or nil, def and def.store or nil) end
-- Its filter would ask the function of its source.
function env.new_clone(pointer, source, def)
    C.fe_world_set_pair_filter(pointer, nil, nil)
    return new_world(pointer, def and def.pool or nil, source.store)
end
-- The world of a player: it keeps it, and owns nothing until it is handed over.
local players = setmetatable({}, { __mode = "k" })
function env.new_view(pointer, pool, store, player)
    local box = Box(pointer, pool, store)
    players[box] = player
    return box
end
function env.own_view(box)
    use(box.pool)
    use(box.store)
    players[box] = nil
    return ffi.gc(box, end_world)
end
function env.new_pool(pointer) return ffi.gc(PoolBox(pointer), end_pool) end
function env.new_store(pointer) return ffi.gc(StoreBox(pointer), end_store) end
function env.store_of(pointer, world)
    local box = StoreBox(pointer)
    owners[box] = world
    return box
end

require("feather.ffi_values")(env)
core.to_u64, core.from_u64 = env.to_u64, env.from_u64

-- ---- the functions of the header ------------------------------------------------------------------------------------

-- what the C module has otherwise, or not at all
local ABSENT = {
    fe_body_create_many = true, fe_last_error = true, fe_result_name = true, fe_world_set_pair_filter = true,
    fe_asset_save = true, fe_asset_load = true, fe_asset_get_key = true, fe_world_save = true, fe_world_restore = true,
    fe_world_load = true, fe_snapshot_check = true, fe_snapshot_get_assets = true,
    fe_snapshot_compare = true,
    fe_recorder_read = true, fe_recorder_note = true,
}
-- for hosts in C
local FOR_C = { "^fe_player", "^fe_div", "^fe_batch", "^fe_array" }
local function is_for_c(name)
    for _, front in ipairs(FOR_C) do
        if name:find(front) then return true end
    end
    return false
end
local prototypes = header:gsub("%s+", " "):gsub("typedef [%w_]+ [%w_]+ %b{} [%w_]+;", "")
for result, name, parameters in prototypes:gmatch("([%w_]+) (fe_[%w_]+)(%b());") do
    if not ABSENT[name] and not is_for_c(name) and result ~= "void" then
        core[name:sub(4)] = write(env, result, name, parameters)
    end
end

-- Structs with their defaults. Those of hosts in C, and those that are tables here, are left out.
local NO_RECORD = {
    fe_allocator = true, fe_task_system = true, fe_query_filter = true, fe_heightfield_def = true, fe_hull_def = true,
    fe_mesh_def = true,
}
for name, parameters in prototypes:gmatch("void (fe_[%w_]+)_init(%b())") do
    if not NO_RECORD[name] and not is_for_c(name) then
        local kind, init, sized = ffi.typeof(name), C[name .. "_init"], parameters:find("struct_size")
        core[name:sub(4)] = function()
            local made = kind()
            if sized then init(made, ffi.sizeof(kind)) else init(made) end
            return made
        end
    end
end

require("feather.ffi_bytes")(core, env)
require("feather.ffi_batch")(core, env)
require("feather.ffi_player")(core, env)

-- ---- geometries: the inline functions of the header -----------------------------------------------------------------

local function geometry(type)
    local made = core.geometry()
    made.type = type
    return made
end
function core.geometry_sphere(radius)
    local made = geometry(C.FE_GEOMETRY_SPHERE)
    made.radius = env.number(radius, "radius")
    return made
end
function core.geometry_capsule(half_height, radius)
    local made = geometry(C.FE_GEOMETRY_CAPSULE)
    made.half_height, made.radius = env.number(half_height, "half_height"), env.number(radius, "radius")
    return made
end
function core.geometry_box(half_x, half_y, half_z)
    local made = geometry(C.FE_GEOMETRY_BOX)
    env.put_vec3(made.half_extents, { half_x, half_y, half_z }, 0)
    return made
end
function core.geometry_plane(normal_x, normal_y, normal_z, distance)
    local made = geometry(C.FE_GEOMETRY_PLANE)
    env.put_vec3(made.normal, { normal_x, normal_y, normal_z }, 0)
    made.distance = env.number(distance, "distance")
    return made
end
function core.geometry_cylinder(half_height, radius)
    local made = geometry(C.FE_GEOMETRY_CYLINDER)
    made.half_height, made.radius = env.number(half_height, "half_height"), env.number(radius, "radius")
    return made
end
function core.geometry_cone(half_height, radius)
    local made = geometry(C.FE_GEOMETRY_CONE)
    made.half_height, made.radius = env.number(half_height, "half_height"), env.number(radius, "radius")
    return made
end
for name, type in pairs({
    heightfield = C.FE_GEOMETRY_HEIGHTFIELD, hull = C.FE_GEOMETRY_HULL, mesh = C.FE_GEOMETRY_MESH,
    compound = C.FE_GEOMETRY_COMPOUND,
}) do
    core["geometry_" .. name] = function(asset)
        local made = geometry(type)
        made.asset = env.integer(asset, 0, 2 ^ 53, name)
        return made
    end
end
function core.geometry_set_scale(made, x, y, z) env.put_vec3(made.scale, { x, y, z }, 0) end

-- ---- drawing into the caller's own array ----------------------------------------------------------------------------

local DRAWS = {
    lines = C.fe_world_draw_lines, triangles = C.fe_world_draw_triangles, points = C.fe_world_draw_points,
    instances = C.fe_world_draw_instances,
}
local Vertices, Instances = ffi.typeof("fe_draw_vertex[?]"), ffi.typeof("fe_draw_instance[?]")
-- `array` is what an earlier call returned, or nil: it comes back, or a larger one, and how many records are in it.
function core.draw_array(world, kind, options, array)
    local pointer, draw = env.world(world), DRAWS[kind]
    local made = kind == "instances" and Instances or Vertices
    local size = ffi.sizeof(kind == "instances" and "fe_draw_instance" or "fe_draw_vertex")
    local room = array and ffi.sizeof(array) / size or 0
    if array ~= nil and not ffi.istype(made, array) then fail("array: %s is needed", tostring(made)) end
    local count = env.check(tonumber(draw(pointer, options, array, size, room)))
    if count > room then
        array = made(count + math.floor(count / 4))
        env.check(tonumber(draw(pointer, options, array, size, count)))
    end
    return array or made(1), count
end

-- ---- the pair filter ------------------------------------------------------------------------------------------------

local filters = setmetatable({}, { __mode = "k" }) -- the function of each world that has one
local running -- the filter of the step that is being made, and its first error
local judge   -- the one C callback, made for the first filter

-- No error may pass through the library: the first one is kept, and the pair may collide.
local function answer(_, pair)
    local run = running
    local done, may = pcall(run.filter, tonumber(pair.body_a), tonumber(pair.body_b), tonumber(pair.shape_a),
        tonumber(pair.shape_b), env.from_u64(pair.body_user_data_a), env.from_u64(pair.body_user_data_b),
        env.from_u64(pair.shape_user_data_a), env.from_u64(pair.shape_user_data_b))
    if done and type(may) == "boolean" then return may and 1 or 0 end
    if done then may = "feather: the pair filter returned a " .. type(may) .. ", not true or false" end
    run.failed = run.failed or { may }
    return 1
end

function core.world_set_pair_filter(world, filter)
    local pointer = env.world(world)
    if filter ~= nil and type(filter) ~= "function" then
        fail("filter: a function is needed, not a %s", type(filter))
    end
    if filter and not judge then judge = ffi.cast("fe_pair_filter", answer) end
    env.check(tonumber(C.fe_world_set_pair_filter(pointer, filter and judge or nil, nil)))
    filters[world] = filter
end

-- A C function that calls back must not be called from compiled code.
local function step_with_filter(world, filter, dt)
    local pointer, outer, run = env.world(world), running, { filter = filter }
    dt = env.number(dt, "dt")
    running = run
    local result = tonumber(C.fe_world_step(pointer, dt))
    running = outer
    if run.failed then error(run.failed[1], 0) end
    env.check(result)
end
jit.off(step_with_filter)
jit.off(answer)

local step = core.world_step
function core.world_step(world, dt)
    local filter = filters[world]
    if filter then return step_with_filter(world, filter, dt) end
    return step(world, dt)
end

-- ---- twins.h --------------------------------------------------------------------------------------------------------

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
    env.put_vec3(transform.position, env.check_table(position, "position"), 0)
    env.check(tonumber(set_transform(world.p, body, transform)))
end
function core.body_set_rotation(world, body, rotation)
    read(world, body)
    env.put_quat(transform.rotation, env.check_table(rotation, "rotation"), 0)
    env.check(tonumber(set_transform(world.p, body, transform)))
end

function core.axis_of(def, dof) return def.axes[dof] end
function core.set_pool(def, pool) def.pool = env.pool(pool) end
function core.set_store(def, store) def.store = env.store(store) end

return core
