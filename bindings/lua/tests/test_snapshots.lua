-- Snapshots on every Lua: worlds as strings, restored in place and loaded anew.
local lu = require("luaunit")
local feather = require("feather")
local core = feather._core
local STEP = 1 / 60
local CUBE = { -1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1, 1 }

local function fails(text, call, ...)
    local ok, told = pcall(call, ...)
    lu.assertFalse(ok)
    lu.assertStrContains(tostring(told), text)
    return told
end

local function steps(world, count)
    for _ = 1, count do world:update(STEP) end
end

-- Boxes, a hull and a ball on a joint fall on a heightfield.
local function scene(given)
    local world = feather.newWorld(given)
    local field = world:newHeightfield({ rows = 2, columns = 2, cellX = 20, cellZ = 20, heights = { 0, 0.5, 0, 0.5 } })
    world:newBody({ type = "static" }):newHeightfield(field, { position = { -10, 0, -10 } })
    local hull, bodies = world:newHull({ points = CUBE }), {}
    for i = 1, 6 do
        bodies[i] = world:newBody({ position = { 0.1 * i, 1.2 * i, 0 }, userData = "body " .. i, tag = i })
        bodies[i]:newBox(0.5, 0.5, 0.5, { events = { "touch" } })
    end
    bodies[6]:newHull(hull, { position = { 2, 0, 0 } })
    world:newBallJoint({ bodyA = bodies[5], bodyB = bodies[6], point = { 0.5, 6.6, 0 }, userData = "joint" })
    return world, bodies, hull, field
end

TestSnapshots = {}

-- A clone goes on as its source, with the filter and the user data, and outlives it.
function TestSnapshots.testACloneGoesOnAsItsSource()
    local asked = {}
    local world, bodies = scene()
    world:setUserData("level")
    world:setPairFilter(function() asked[#asked + 1] = 1 return true end)
    steps(world, 20)
    world:newBody({ position = { 0.2, 12, 0 } }):newSphere(0.2, { pairFilter = true })
    local clone = world:clone({ workers = 2 })
    local body = clone:getBodies()[2]
    lu.assertEquals(body.id, world:getBodies()[2].id)
    lu.assertEquals({ clone:getUserData(), body:getUserData() }, { "level", world:getBodies()[2]:getUserData() })
    asked = {}
    steps(world, 90)
    local count = #asked
    asked = {}
    steps(clone, 90)
    lu.assertEquals({ clone:getHash(), #asked }, { world:getHash(), count })
    lu.assertTrue(count > 0)
    world:setPairFilter(nil) -- of the source alone
    world:destroy()
    world, bodies = nil, nil
    collectgarbage()
    collectgarbage()
    steps(clone, 5)
    lu.assertEquals(#clone:getBodies(), 8)
    fails("store", clone.clone, clone, { store = feather.newStore() })
    fails("worker_count", clone.clone, clone, { workers = 1000 })
end

function TestSnapshots.testAStateIsGoneBackTo()
    local world, bodies = scene()
    steps(world, 10)
    local state, hash = world:newState(), world:getHash()
    local clone = world:clone()
    local later = world:newBody({ userData = "later" })
    steps(world, 25)
    steps(clone, 3)
    world:setState(state)
    clone:setState(state)
    lu.assertEquals({ world:getHash(), clone:getHash() }, { hash, hash })
    lu.assertTrue(later:isDestroyed())
    lu.assertEquals(bodies[1]:getUserData(), "body 1")
    fails("world", scene().setState, scene(), state) -- of another store
    fails("newState", world.setState, world, {})
    fails("newState", world.setState, world, nil)
    fails("state", core.world_set_state, world.native, world.native)
    state:close()
    state:close()
    fails("closed", world.setState, world, state)
    lu.assertEquals(world:getHash(), hash)
end

-- What differs from a base, and back
function TestSnapshots.testADifferenceGoesWithItsBase()
    local world = scene()
    steps(world, 40)
    local base = world:save()
    steps(world, 1)
    local whole, diff = world:save(), world:save({ base = base })
    lu.assertTrue(#diff < #whole / 2)
    steps(world, 5)
    world:restore(diff, { base = base })
    lu.assertEquals(world:save(), whole)
    lu.assertTrue(#world:save({ base = whole }) <= 64)
    fails("base", world.restore, world, diff)
    fails("another base", world.restore, world, diff, { base = whole })
    fails("base", world.save, world, { base = diff })
    fails("string", world.save, world, { base = 7 })
    fails("string", world.restore, world, diff, { base = {} })
    lu.assertEquals(world:save(), whole)
end

-- Back and on: the same bits. Objects that are gone are forgotten, and bad calls are told.
function TestSnapshots.testAHistoryGoesBackAndOn()
    local world, bodies = scene()
    local history = world:newHistory({ frames = 8 })
    local hashes = {}
    for frame = 1, 20 do
        history:keep(frame)
        hashes[frame] = world:getHash()
        steps(world, 1)
    end
    lu.assertEquals(#history:getFrames(), 8)
    lu.assertEquals(history:getFrames()[1].frame, 13)
    lu.assertTrue(history:getFrames()[1].bytes > 1000)
    local late = world:newBody({ userData = "late" })
    history:restore(14)
    lu.assertTrue(late:isDestroyed())
    lu.assertEquals(bodies[2]:getUserData(), "body 2")
    lu.assertEquals(world:getHash(), hashes[14])
    for frame = 15, 20 do
        steps(world, 1)
        history:keep(frame)
        lu.assertEquals(world:getHash(), hashes[frame])
    end
    fails("frame 12 is not kept", history.restore, history, 12)
    fails("must be above 20", history.keep, history, 20)
    fails("frame", history.keep, history, "x")
    fails("frame", history.keep, history, 0 / 0)
    fails("frames", world.newHistory, world, { frames = 0 })
    history:close()
    fails("destroyed", history.keep, history, 21)
    local other = world:newHistory()
    world:destroy()
    fails("destroyed", other.keep, other, 21)
end

-- In place and loaded, with other workers: the same bits.
function TestSnapshots.testItGoesOnBitForBit()
    local world, bodies = scene({ number = 3 })
    steps(world, 40)
    local saved, hash = world:save({ assets = true }), world:getHash()
    lu.assertEquals(world:save({ assets = true }), saved)
    lu.assertTrue(#world:save() < #saved)
    lu.assertEquals(world:save({}), world:save())
    lu.assertEquals(world:save({ assets = false }), world:save())
    local poses, events = world:getExactTransforms(bodies), #world:getContactEvents()
    steps(world, 80)
    local later = world:getHash()
    lu.assertNotEquals(later, hash)

    lu.assertEquals(select("#", world:restore(saved)), 0)
    lu.assertEquals(world:getHash(), hash)
    lu.assertEquals(world:save({ assets = true }), saved)
    lu.assertEquals(world:getExactTransforms(bodies), poses)
    lu.assertEquals(#world:getContactEvents(), events)
    steps(world, 80)
    lu.assertEquals(world:getHash(), later)

    for _, given in ipairs({ false, { workers = 2 }, { pool = feather.newPool(2), store = feather.newStore() } }) do
        local twin = feather.loadWorld(saved, given or nil)
        lu.assertEquals(twin:getHash(), hash)
        lu.assertEquals(twin:save({ assets = true }), saved)
        steps(twin, 80)
        lu.assertEquals(twin:getHash(), later)
        if given and given.store then lu.assertIs(twin:getStore(), given.store) end
    end
    lu.assertEquals(select("#", feather.loadWorld(saved)), 1)
end

-- ---- objects and user data ------------------------------------------------------------------------------------------

function TestSnapshots.testObjectsAndUserData()
    local world, bodies = scene()
    world:setUserData("world")
    local shape, joint = bodies[1]:getShapes()[1], world:getJoints()[1]
    local saved = world:save({ assets = true })
    local late = world:newBody({ userData = "late" })
    local late_shape = late:newSphere(1, { userData = "late shape" })
    local late_joint = world:newFixedJoint({ bodyB = late, point = { 0, 0, 0 }, userData = "late joint" })
    bodies[2]:destroy()
    world:restore(saved)
    for _, gone in ipairs({ late, late_shape, late_joint }) do lu.assertTrue(gone:isDestroyed()) end
    fails("fe_body_get_transform", core.body_get_transform, world.native, late.id)
    fails("fe_body", late.getPosition, late)
    fails("fe_shape", late_shape.getDensity, late_shape)
    fails("fe_joint", late_joint.getFrames, late_joint)
    fails("fe_fixed_joint", world.newFixedJoint, world, { bodyB = late, point = { 0, 0, 0 } })
    -- what lives is the same object, with its user data; what was destroyed lives again, without
    lu.assertIs(world:getBodies()[2], bodies[1])
    lu.assertIs(bodies[1]:getShapes()[1], shape)
    lu.assertIs(world:getJoints()[1], joint)
    lu.assertEquals({ bodies[1]:getUserData(), joint:getUserData(), world:getUserData() }, { "body 1", "joint", "world" })
    lu.assertFalse(bodies[2]:isDestroyed())
    lu.assertNil(bodies[2]:getUserData())
    lu.assertEquals(bodies[2]:getTag(), 2)
    -- a handle that is given again has nothing of what had it
    local again = world:newBody()
    lu.assertEquals(again.id, late.id)
    lu.assertNotIs(again, late)
    lu.assertNil(again:getUserData())
    local shape_again = core.shape_create(world.native, again.id, nil, core.geometry_sphere(1))
    lu.assertEquals(shape_again, late_shape.id)
    lu.assertNil(again:getShapes()[1]:getUserData())

    local twin = feather.loadWorld(saved, { userData = "twin" })
    lu.assertEquals(twin:getUserData(), "twin")
    lu.assertNil(twin:getBodies()[2]:getUserData())
    lu.assertEquals(twin:getBodies()[2]:getTag(), 1)
end

function TestSnapshots.testNumbersOfHandles()
    local world, bodies = scene({ number = 11 })
    local saved = world:save({ assets = true })
    lu.assertEquals(feather.loadWorld(saved, { number = 12 }):getNumber(), 11)
    local other = feather.loadWorld(saved, { number = 12, newNumber = true })
    lu.assertEquals(other:getNumber(), 12)
    fails("another world", other.getTransforms, other, { bodies[1] })
    lu.assertEquals(core.body_is_valid(other.native, bodies[1].id), 0)
    lu.assertEquals(core.body_is_valid(feather.loadWorld(saved, { newNumber = false }).native, bodies[1].id), 1)
    other:restore(saved, { newNumber = true })
    lu.assertEquals(other:getNumber(), 12)
    local first = other:getBodies()[1]
    other:restore(saved)
    lu.assertEquals(other:getNumber(), 11)
    lu.assertTrue(first:isDestroyed())
    lu.assertEquals(other:getBodyIds(), world:getBodyIds())
end

-- ---- the pair filter, and callbacks ---------------------------------------------------------------------------------

function TestSnapshots.testThePairFilterIsYours()
    local world, asked = feather.newWorld(), 0
    world:newBody({ type = "static" }):newPlane(0, 1, 0, 0)
    world:newBody({ position = { 0, 0.6, 0 } }):newSphere(0.5, { pairFilter = true })
    local saved
    local function judge()
        asked = asked + 1
        fails("in a step", world.save, world)
        fails("in a step", world.restore, world, saved)
        return true
    end
    world:setPairFilter(judge)
    saved = world:save()
    lu.assertTrue(feather.checkSnapshot(saved).filter)
    fails("pair filter", feather.loadWorld, saved)
    local bare = feather.newWorld()
    fails("pair filter", bare.restore, bare, saved)
    steps(world, 20)
    lu.assertEquals(asked, 1)
    local hash = world:getHash()
    world:restore(saved)
    steps(world, 20)
    lu.assertEquals({ asked, world:getHash() }, { 2, hash })
    bare:setPairFilter(function() return true end)
    bare:restore(saved)
    steps(bare, 20)
    lu.assertEquals(bare:getHash(), hash)
end

-- The step is over when callbacks run: they may rewind the world.
function TestSnapshots.testACallbackRestores()
    local world = scene()
    local saved, hash, rewound = world:save(), world:getHash(), 0
    world:setCallbacks({
        beginContact = function()
            rewound = rewound + 1
            world:restore(saved)
        end,
    })
    repeat world:update(STEP) until rewound > 0
    lu.assertEquals(world:getHash(), hash)
end

-- ---- assets ---------------------------------------------------------------------------------------------------------

function TestSnapshots.testKeysOfAssets()
    local world, bodies, hull, field = scene()
    local key = hull:getKey()
    lu.assertStrMatches(key, ("%x"):rep(32))
    lu.assertEquals(feather.newWorld():newHull({ points = CUBE }):getKey(), key)
    lu.assertNotEquals(field:getKey(), key)
    local before = field:getKey()
    field:setHeights(0, 0, 1, 1, { 0.25 })
    lu.assertNotEquals(field:getKey(), before)
    local keys, known = feather.getSnapshotAssets(world:save()), { [key] = true, [field:getKey()] = true }
    lu.assertEquals(#keys, 2)
    lu.assertTrue(known[keys[1]] and known[keys[2]] and keys[1] ~= keys[2])
    lu.assertEquals(feather.getSnapshotAssets(feather.newWorld():save()), {})
    local mesh = world:newMesh({ vertices = CUBE, triangles = { 0, 2, 3 } })
    local compound = world:newCompound({ { "sphere", 1 } })
    lu.assertEquals({ #mesh:getKey(), #compound:getKey() }, { 32, 32 })
    bodies[1]:newCompound(compound)
    lu.assertEquals(feather.loadWorld(world:save({ assets = true })):getHash(), world:getHash())
    hull:destroy()
    fails("destroyed", hull.getKey, hull)
    fails("a number is needed", core.asset_get_key, world:getStore().native, "x")
end

-- By their keys: in the world's store, or nowhere, which tells the key.
function TestSnapshots.testWhereAssetsAreFound()
    local world, _, hull = scene()
    local saved = world:save()
    local key = hull:getKey()
    local told = fails("fe_world_load", feather.loadWorld, saved)
    local first, second = told:match("(%x+) (%x+) is nowhere")
    lu.assertEquals(#feather.getSnapshotAssets(saved), 2)
    lu.assertTrue(first .. second == key or first .. second == feather.getSnapshotAssets(saved)[1])
    steps(world, 30)
    local twin = feather.loadWorld(saved, { store = scene({ store = feather.newStore() }):getStore() })
    steps(twin, 30)
    lu.assertEquals(twin:getHash(), world:getHash())
end

-- ---- what strings tell, and bytes that are none ---------------------------------------------------------------------

function TestSnapshots.testWhatASnapshotTells()
    local world = scene({ number = 21 })
    steps(world, 7)
    local info = feather.checkSnapshot(world:save({ assets = true }))
    lu.assertEquals(info, {
        library = feather.VERSION, foreign = false, number = 21, step = 7, bodies = 7, shapes = 8, joints = 1,
        assets = 2, inside = 2, filter = false,
    })
    lu.assertEquals(feather.checkSnapshot(world:save()).inside, 0)
end

function TestSnapshots.testTheFirstDifference()
    local world = scene({ number = 21 })
    steps(world, 7)
    local saved = world:save()
    lu.assertNil(feather.compareSnapshots(saved, world:save()))
    world:setGravity(0, -2.5, 0)
    lu.assertEquals(feather.compareSnapshots(saved, world:save()).b, "-2.5")
    local found = feather.compareSnapshots(world:save(), saved)
    lu.assertEquals({ found.kind, found.field, found.element, found.a }, { "world", "gravity", 2, "-2.5" })
    lu.assertEquals({ found.handle, found.other, found.index }, { 0, 0, 1 })
    fails("b: ", feather.compareSnapshots, saved, "")
end

-- Every place that takes a snapshot refuses these by name, and nothing changes.
function TestSnapshots.testBytesThatAreNoSnapshot()
    local world, _, hull = scene()
    steps(world, 5)
    local saved, store = world:save({ assets = true }), feather.newStore()
    local target, bytes = scene({ store = store }), nil
    steps(target, 3)
    local before, size = target:save({ assets = true }), store:getBytes()
    local function refused(text, ...)
        for i = 1, select("#", ...) do
            bytes = select(i, ...)
            fails(text, target.restore, target, bytes)
            fails(text, feather.loadWorld, bytes)
            fails(text, feather.loadWorld, bytes, { store = store })
            fails(text, feather.checkSnapshot, bytes)
            fails(text, feather.getSnapshotAssets, bytes)
        end
    end
    refused("bytes: a string is needed, not a", nil, 5, {}, true, print)
    refused("a header has 48", "", "x", saved:sub(1, 47))
    refused("there are", saved:sub(1, 48), saved:sub(1, -9), saved:sub(1, -2), saved .. "x")
    refused("no bytes of fe_world_save", ("x"):rep(100), hull:save(), ("\0"):rep(1000))
    refused("newer library", saved:sub(1, 8) .. "\9" .. saved:sub(10))
    refused("altered", saved:sub(1, 199) .. string.char((saved:byte(200) + 1) % 256) .. saved:sub(201))
    local seed = 1
    for length = 0, 39 do
        local noise = {}
        for i = 1, 48 + 8 * length do
            seed = seed * 16807 % 2147483647
            noise[i] = string.char(seed % 256)
        end
        noise = table.concat(noise)
        refused("no bytes of fe_world_save", noise)
        refused("byte", saved:sub(1, 48) .. noise, saved:sub(1, -1 - #noise) .. noise) -- a header, and a whole size
    end
    lu.assertEquals(target:save({ assets = true }), before)
    lu.assertEquals(store:getBytes(), size)
    lu.assertStrContains(fails("header", function() target:restore("") end), "test_snapshots.lua:")
end

function TestSnapshots.testWrongOptions()
    local world = scene()
    local saved = world:save({ assets = true })
    fails("asets", world.save, world, { asets = true })
    fails("assets: true or false is needed", world.save, world, { assets = "yes" })
    fails("a table is needed", world.save, world, true)
    fails("newNumbr", world.restore, world, saved, { newNumbr = true })
    fails("newNumber: true or false is needed", world.restore, world, saved, { newNumber = {} })
    fails("a table is needed", world.restore, world, saved, 1)
    fails("newNumber: true or false is needed", feather.loadWorld, saved, { newNumber = "x" })
    fails("there is no field gravty", feather.loadWorld, saved, { gravty = 1 })
    fails("what newPool returns", feather.loadWorld, saved, { pool = {} })
    lu.assertFalse(pcall(core.world_save, world.native, core.body_def()))
    lu.assertFalse(pcall(core.world_restore, world.native, core.save_options(), saved))
    lu.assertFalse(pcall(core.world_load, core.restore_options(), nil, saved))
    local flags = core.save_options()
    flags.flags = 4
    fails("flags", core.world_save, world.native, flags)
    world:destroy()
    fails("the world is destroyed", world.save, world)
    fails("the world is destroyed", world.restore, world, saved)
end

-- ---- a library with other results -----------------------------------------------------------------------------------

-- 64 bits: integers of Lua 5.3, ULL of LuaJIT; Lua 5.1 has none.
local wide
if math.type then
    wide = load([[return { zero = 0, factor = 0x9E3779B97F4A7C15, xor = function(a, b) return a ~ b end,
        right = function(a, n) return a >> n end }]])()
elseif jit then
    wide = loadstring([[local bit = require("bit")
        return { zero = 0ULL, factor = 0x9E3779B97F4A7C15ULL, xor = bit.bxor, right = bit.rshift }]])()
end

local function word_at(bytes, at, size)
    local word = wide.zero
    for i = size, 1, -1 do word = word * 256 + bytes:byte(at + i) end
    return word
end

local function word_bytes(word)
    local made = {}
    for i = 1, 8 do made[i] = string.char(tonumber(wide.right(word, 8 * (i - 1)) % 256)) end
    return table.concat(made)
end

-- Of src/core/bytes.h and src/snapshot/write.c: the sum of a header's fields.
local function header_sum(bytes)
    local state = wide.zero
    local words = { word_at(bytes, 0, 8), word_at(bytes, 8, 8), word_at(bytes, 16, 4), word_at(bytes, 24, 8),
        word_at(bytes, 40, 8), wide.zero + 5, wide.zero, wide.zero }
    for _, word in ipairs(words) do
        state = wide.xor(state, word) * wide.factor
        state = wide.xor(state, wide.right(state, 32))
    end
    return state
end

-- The string with other results in its header. The sum of all is (sum of the sections ^ that of the header) * factor + 1.
local function of_other_results(saved)
    local changed = saved:sub(1, 12) .. "\77" .. saved:sub(14)
    local inverse = wide.factor
    for _ = 1, 5 do inverse = inverse * (2 - wide.factor * inverse) end
    local joined = (word_at(saved, 32, 8) - 1) * inverse
    joined = wide.xor(joined, wide.xor(header_sum(saved), header_sum(changed)))
    return changed:sub(1, 32) .. word_bytes(joined * wide.factor + 1) .. changed:sub(41)
end

function TestSnapshots.testAForeignSnapshot()
    if not wide then return end
    local world = scene()
    steps(world, 5)
    local saved, hash = world:save({ assets = true }), world:getHash()
    local foreign = of_other_results(saved)
    lu.assertTrue(feather.checkSnapshot(foreign).foreign)
    steps(world, 5)
    lu.assertEquals(world:restore(foreign), "foreign")
    lu.assertEquals(world:getHash(), hash)
    local twin, told = feather.loadWorld(foreign)
    lu.assertEquals({ told, twin:getHash() }, { "foreign", hash })
    steps(twin, 5)
end

-- ---- memory ---------------------------------------------------------------------------------------------------------

-- A loaded world keeps its pool and its store, whatever the collector takes first.
function TestSnapshots.testALoadedWorldKeepsWhatItUses()
    local saved = scene():save({ assets = true })
    local natives = {}
    for i = 1, 10 do natives[i] = feather.loadWorld(saved, { pool = feather.newPool(2), store = feather.newStore() }).native end
    for _ = 1, 3 do collectgarbage() end
    for i = 1, 10 do core.world_step(natives[i], STEP) end
end

os.exit(lu.LuaUnit.run(), true)
