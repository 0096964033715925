-- Batches for LuaJIT: what bindings/lua/batch.h is for the C module.
local ffi = require("ffi")
local fail = require("feather.where").fail

return function(core, env)
    local C = env.C
    local BatchBox = ffi.typeof("struct { fe_batch *const p; fe_pool *const pool; int32_t count; }")
    local Def, Array = ffi.typeof("fe_batch_def"), ffi.typeof("fe_array")

    local function destroy(box)
        local result = tonumber(C.fe_batch_destroy(box.p))
        if result == 0 then
            ffi.cast("void **", box)[0] = nil
            env.release(box.pool)
        end
        return result
    end
    local function end_batch(box)
        if box.p ~= nil then destroy(box) end
    end
    local function batch_of(box)
        if not ffi.istype(BatchBox, box) then fail("a batch is needed, not a %s", type(box)) end
        if box.p == nil then fail("the batch is closed") end
        return box.p
    end

    -- A template's pair filter would ask its function outside of a step of the template.
    local function take_filters(batch, count)
        local out = ffi.new("fe_world *[1]")
        for i = 0, count - 1 do
            env.check(tonumber(C.fe_batch_get_world(batch, i, out)))
            env.check(tonumber(C.fe_world_set_pair_filter(out[0], nil, nil)))
        end
    end

    local INT = 2147483647
    function core.batch_create(world, count, workers, block, simd, pool)
        local source, def, out = env.world(world), Def(), ffi.new("fe_batch *[1]")
        C.fe_batch_def_init(def, ffi.sizeof(Def))
        def.world_count = env.integer(count, -INT, INT, "world_count")
        def.worker_count = env.integer(workers, -INT, INT, "worker_count")
        def.block, def.simd = env.integer(block, -INT, INT, "block"), env.integer(simd, -INT, INT, "simd")
        if pool ~= nil then def.pool = env.pool(pool) end
        env.check(tonumber(C.fe_batch_create(source, def, out)))
        env.use(def.pool)
        local box = ffi.gc(BatchBox(out[0], def.pool, def.world_count), end_batch)
        take_filters(out[0], def.world_count)
        return box
    end
    function core.batch_destroy(box)
        batch_of(box)
        env.check(destroy(box))
    end

    -- ---- arguments --------------------------------------------------------------------------------------------------

    local function to_mask(mask, worlds)
        if mask == nil then return nil end
        env.check_table(mask, "mask")
        if #mask ~= worlds then fail("mask: %d switches are needed, not %d", worlds, #mask) end
        local made = ffi.new("uint8_t[?]", worlds)
        for i = 1, worlds do made[i - 1] = mask[i] and 1 or 0 end
        return made
    end
    local function to_states(states, worlds)
        if states == nil then return nil end
        env.check_table(states, "states")
        local made = ffi.new("const fe_state *[?]", worlds)
        for i = 1, worlds do made[i - 1] = states[i] and env.state(states[i]) or nil end
        return made
    end
    local function to_array(box, field, items, row)
        local array, count, ids = Array(), 1, nil
        C.fe_array_init(array, ffi.sizeof(Array))
        array.field = env.integer(field, 0, INT, "field")
        row = env.integer(row, 1, 16, "row")
        if items ~= nil then ids, count = env.handles(items, nil, "items") end
        local numbers = row * count * box.count
        if numbers > INT / 4 then fail("items: too many numbers") end
        array.items, array.item_count, array.bytes = ids, count, 4 * numbers
        return array, numbers, ids
    end
    local function outcome(failed, results, worlds)
        failed = env.check(tonumber(failed))
        if failed == 0 then return failed end
        local made = {}
        for i = 1, worlds do made[i] = results[i - 1] end
        return failed, made
    end
    local function new_results(box) return ffi.new("int32_t[?]", box.count) end

    -- ---- calls ------------------------------------------------------------------------------------------------------

    function core.batch_step(box, dt, steps, mask)
        local batch, results = batch_of(box), new_results(box)
        local given, count = to_mask(mask, box.count), env.integer(steps, -INT, INT, "steps")
        return outcome(C.fe_batch_step(batch, env.number(dt, "dt"), count, given, results), results, box.count)
    end
    function core.batch_reset(box, mask, states)
        local batch, results = batch_of(box), new_results(box)
        local given, list = to_mask(mask, box.count), to_states(states, box.count)
        return outcome(C.fe_batch_reset(batch, given, list, results), results, box.count)
    end
    function core.batch_read(box, field, items, row)
        local batch, results = batch_of(box), new_results(box)
        local array, numbers, kept = to_array(box, field, items, row)
        local data = ffi.new("float[?]", numbers)
        array.data = data
        local failed = env.check(tonumber(C.fe_batch_read(batch, array, results)))
        local made = {}
        for i = 1, numbers do made[i] = tonumber(data[i - 1]) end
        kept = nil
        return made, outcome(failed, results, box.count)
    end
    function core.batch_write(box, field, items, row, values, mask)
        local batch, results = batch_of(box), new_results(box)
        local array, numbers, kept = to_array(box, field, items, row)
        local data, count = env.floats(values, 1, nil, "numbers")
        if count ~= numbers then fail("numbers: %d are needed, not %d", numbers, count) end
        array.data = data
        local given = to_mask(mask, box.count)
        local failed = C.fe_batch_write(batch, array, given, results)
        kept = nil
        return outcome(failed, results, box.count)
    end
    function core.batch_hash(box)
        local batch, made = batch_of(box), {}
        local words = ffi.new("uint32_t[?]", 2 * box.count)
        env.check(tonumber(C.fe_batch_hash(batch, words)))
        for i = 1, box.count do made[i] = env.hex(words + 2 * (i - 1)) end
        return made
    end
end
