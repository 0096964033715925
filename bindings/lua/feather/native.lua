-- The flat functions of feather.h, from the C module or, in LuaJIT, from feather.ffi, and what differs between the two.
local where = require("feather.where")
local native = {}

if type(jit) == "table" and not os.getenv("FEATHER_NO_FFI") then
    local core = require("feather.ffi")
    native.core, native.axis_of = core, core.axis_of
    native.set_pool, native.set_store, native.set_base = core.set_pool, core.set_store, core.set_base
    native.number, native.to_u64, native.from_u64 = tonumber, core.to_u64, core.from_u64
else
    local core = require("feather.core")
    core.hide_lines(where.own)
    local function same(value) return value end
    native.core = core
    function native.axis_of(def, dof) return def:axis(dof) end
    function native.set_pool(def, pool) def.pool = pool end
    function native.set_store(def, store) def.store = store end
    function native.set_base(record, bytes) record:set_base(bytes) end
    native.number, native.to_u64, native.from_u64 = same, same, same
end

return native
