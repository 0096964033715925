-- Players for LuaJIT: what bindings/lua/player.h is for the C module.
local ffi = require("ffi")
local fail = require("feather.where").fail

return function(core, env)
    local C, INT = env.C, 2147483647
    local PlayerBox = ffi.typeof("struct { fe_player *const p; fe_pool *const pool; fe_store *const store; }")
    local views = setmetatable({}, { __mode = "kv" }) -- the world of a player, while somebody has it

    local function destroy(box)
        local result = tonumber(C.fe_player_destroy(box.p))
        if result ~= 0 then return result end
        ffi.cast("void **", box)[0] = nil
        env.release(box.pool)
        env.release(box.store)
        local view = views[box]
        if view then ffi.cast("void **", view)[0] = nil end
        views[box] = nil
        return result
    end
    local function end_player(box)
        if box.p ~= nil then destroy(box) end
    end
    local function player_of(box)
        if not ffi.istype(PlayerBox, box) then fail("a player is needed, not a %s", type(box)) end
        if box.p == nil then fail("the player is closed") end
        return box.p
    end

    function core.player_create(workers, simd, pool, store)
        local def, out = ffi.new("fe_player_def"), ffi.new("fe_player *[1]")
        C.fe_player_def_init(def, ffi.sizeof("fe_player_def"))
        def.worker_count = env.integer(workers, -INT, INT, "worker_count")
        def.simd = env.integer(simd, -INT, INT, "simd")
        if pool ~= nil then def.pool = env.pool(pool) end
        if store ~= nil then def.store = env.store(store) end
        env.check(tonumber(C.fe_player_create(def, out)))
        env.use(def.pool)
        env.use(def.store)
        return ffi.gc(PlayerBox(out[0], def.pool, def.store), end_player)
    end
    function core.player_destroy(box)
        player_of(box)
        env.check(destroy(box))
    end
    function core.player_feed(box, bytes)
        local player = player_of(box)
        if type(bytes) ~= "string" then fail("bytes: a string is needed, not a %s", type(bytes)) end
        env.check(tonumber(C.fe_player_feed(player, bytes, #bytes)))
    end
    -- false: there is no more
    local function is_there(result) return env.check(tonumber(result)) ~= C.FE_END end
    function core.player_step(box) return is_there(C.fe_player_step(player_of(box))) end
    function core.player_seek(box, step)
        local player = player_of(box)
        return is_there(C.fe_player_seek(player, env.integer(step, -2 ^ 53, 2 ^ 53, "step")))
    end

    function core.player_get_world(box)
        local out = ffi.new("const fe_world *[1]")
        env.check(tonumber(C.fe_player_get_world(player_of(box), out)))
        if not views[box] then
            views[box] = env.new_view(ffi.cast("fe_world *", out[0]), box.pool, box.store, box)
        end
        return views[box]
    end
    function core.player_release(box)
        local view, out = core.player_get_world(box), ffi.new("fe_world *[1]")
        env.check(tonumber(C.fe_player_release(box.p, out)))
        views[box] = nil
        return env.own_view(view)
    end

    -- ---- what it tells ----------------------------------------------------------------------------------------------

    local function told(kind, get, box)
        local record = ffi.new(kind)
        record.struct_size = ffi.sizeof(kind)
        env.check(tonumber(get(player_of(box), record)))
        return record
    end
    function core.player_get_info(box)
        local i = told("fe_player_info", C.fe_player_get_info, box)
        return {
            library = i.library, flags = i.flags, foreign = i.foreign ~= 0, hasDiverged = i.has_diverged ~= 0,
            firstStep = tonumber(i.first_step), lastStep = tonumber(i.last_step), step = tonumber(i.step),
            calls = tonumber(i.calls), bytes = tonumber(i.bytes), keyframes = i.keyframes, notes = i.notes,
        }
    end
    function core.player_get_notes(box)
        local player, size = player_of(box), ffi.sizeof("fe_note")
        local count, made = env.check(tonumber(C.fe_player_get_notes(player, nil, size, 0))), {}
        local notes = ffi.new("fe_note[?]", count + 1)
        env.check(tonumber(C.fe_player_get_notes(player, notes, size, count)))
        for i = 0, count - 1 do
            local note = notes[i]
            made[i + 1] = { step = tonumber(note.step), about = tonumber(note.about), text = ffi.string(note.text) }
        end
        return made
    end
    function core.player_get_divergence(box)
        local d = told("fe_divergence", C.fe_player_get_divergence, box)
        return {
            type = d.type, step = tonumber(d.step), body = tonumber(d.body), component = d.component,
            field = ffi.string(d.field), text = ffi.string(d.text),
        }
    end
end
