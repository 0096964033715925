-- Bytes of assets and of worlds for LuaJIT, which are strings, and keys of assets, which are 32 hexadecimal digits. The
-- module is a function that adds them to feather.ffi's, with the arguments and results that the C module has.
local ffi = require("ffi")
local fail = require("feather.where").fail

return function(core, env)
local C = env.C

local function check_bytes(value)
    if type(value) ~= "string" then fail("bytes: a string is needed, not a %s", type(value)) end
    return value
end

-- What write(out, capacity) writes, whose size it tells first; before it the size, as the C module has it.
local function written(write)
    local size = env.check(tonumber(write(nil, 0)))
    local bytes = ffi.new("char[?]", size)
    size = env.check(tonumber(write(bytes, size)))
    return size, ffi.string(bytes, size)
end

local function hex(word)
    return string.format("%08x%08x", tonumber(word / 4294967296ULL), tonumber(word % 4294967296ULL))
end
local function key_text(key) return hex(key.words[0]) .. hex(key.words[1]) end

-- ---- assets ---------------------------------------------------------------------------------------------------------

function core.asset_save(store, asset)
    local pointer, id = env.store(store), env.integer(asset, 0, 2 ^ 53, "asset")
    return written(function(out, capacity) return C.fe_asset_save(pointer, id, out, capacity) end)
end

local loaded = ffi.new("fe_asset[1]")
function core.asset_load(store, bytes)
    local pointer = env.store(store)
    env.check(tonumber(C.fe_asset_load(pointer, check_bytes(bytes), #bytes, loaded)))
    return tonumber(loaded[0])
end

local key = ffi.new("fe_asset_key")
function core.asset_get_key(store, asset)
    env.check(tonumber(C.fe_asset_get_key(env.store(store), env.integer(asset, 0, 2 ^ 53, "asset"), key)))
    return key_text(key)
end

-- ---- worlds ---------------------------------------------------------------------------------------------------------

local SaveOptions, RestoreOptions = ffi.typeof("fe_save_options"), ffi.typeof("fe_restore_options")
local Definition, Info = ffi.typeof("fe_world_def"), ffi.typeof("fe_snapshot_info")

-- The string is its owner's, who keeps it until the call that reads the record.
function core.set_base(record, bytes)
    record.base, record.base_size = ffi.cast("const char *", check_bytes(bytes)), #bytes
end

function core.world_save(world, options)
    local pointer = env.world(world)
    env.record(options, SaveOptions, "options")
    return written(function(out, capacity) return C.fe_world_save(pointer, options, out, capacity) end)
end

-- Is it from a library whose results differ?
local function is_foreign(result) return env.check(tonumber(result)) == tonumber(C.FE_FOREIGN) end

function core.world_restore(world, options, bytes)
    local pointer = env.world(world)
    env.record(options, RestoreOptions, "options")
    return is_foreign(C.fe_world_restore(pointer, options, check_bytes(bytes), #bytes))
end

local made = ffi.new("fe_world *[1]")
function core.world_load(def, options, bytes)
    env.record(def, Definition, "def")
    env.record(options, RestoreOptions, "options")
    local foreign = is_foreign(C.fe_world_load(def, options, check_bytes(bytes), #bytes, made))
    return foreign, env.new_world(made[0], def)
end

function core.snapshot_check(bytes)
    local info = Info()
    info.struct_size = ffi.sizeof(Info)
    env.check(tonumber(C.fe_snapshot_check(check_bytes(bytes), #bytes, info)))
    return info
end

local KEY_SIZE = ffi.sizeof("fe_asset_key")
function core.snapshot_get_assets(bytes)
    local count = env.check(tonumber(C.fe_snapshot_get_assets(check_bytes(bytes), #bytes, nil, KEY_SIZE, 0)))
    local all, keys = ffi.new("fe_asset_key[?]", count + 1), {}
    env.check(tonumber(C.fe_snapshot_get_assets(bytes, #bytes, all, KEY_SIZE, count)))
    for i = 1, count do keys[i] = key_text(all[i - 1]) end
    return count, keys
end

-- ---- recordings -----------------------------------------------------------------------------------------------------

local size = ffi.new("int64_t[1]")
function core.recorder_read(recorder)
    local pointer = env.recorder(recorder)
    env.check(tonumber(C.fe_recorder_read(pointer, nil, 0, size)))
    local waiting = tonumber(size[0])
    if waiting == 0 then return "" end
    local bytes = ffi.new("char[?]", waiting)
    env.check(tonumber(C.fe_recorder_read(pointer, bytes, waiting, size)))
    return ffi.string(bytes, tonumber(size[0]))
end

function core.recorder_note(recorder, about, text)
    local pointer = env.recorder(recorder)
    about = env.integer(about, 0, 2 ^ 53, "about")
    if type(text) ~= "string" then fail("text: a string is needed, not a %s", type(text)) end
    if text:find("%z") then fail("text: it has a zero in it") end
    env.check(tonumber(C.fe_recorder_note(pointer, about, text)))
end

-- ---- differences ----------------------------------------------------------------------------------------------------

core.text = ffi.string
local Difference = ffi.typeof("fe_difference")
function core.snapshot_compare(a, b)
    local found = Difference()
    found.struct_size = ffi.sizeof(Difference)
    local result = C.fe_snapshot_compare(check_bytes(a), #a, check_bytes(b), #b, found)
    if env.check(tonumber(result)) == 1 then return found end
end

end
