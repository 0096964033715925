-- What editors and people read (bindings/lua/library/feather.lua, docs/reference/lua.md): its grammar, its types, and
-- that it has each method.
local lu = require("luaunit")
local feather = require("feather")
local objects = require("feather.objects")

local PLAIN = { any = true, ["nil"] = true, number = true, integer = true, string = true, boolean = true, table = true }
local GRAMMAR = {
    meta = "^feather$", class = "^feather[%w.]*$", field = "^%w+%??%s(%S+)", param = "^[%w_.]+%??%s(%S+)$",
    ["return"] = "^(%S+)$",
}

local function lines()
    local file = assert(io.open("bindings/lua/library/feather.lua"))
    local text = file:read("*a")
    file:close()
    return text, text:gmatch("([^\n]*)\n")
end

TestAnnotations = {}

function TestAnnotations.testALuaCompilesThem()
    lu.assertNotNil((loadstring or load)((lines())))
end

function TestAnnotations.testGrammarAndTypes()
    local known, used, parameters, functions = {}, {}, {}, 0
    local _, each = lines()
    for line in each do
        local tag, rest = line:match("^%-%-%-@(%w+) (.*)$")
        if tag then
            local pattern = GRAMMAR[tag]
            lu.assertNotNil(pattern, line)
            local kind = rest:match(pattern)
            lu.assertNotNil(kind, line)
            if tag == "class" then known[rest] = true end
            if tag == "field" or tag == "param" or tag == "return" then used[kind] = line end
            if tag == "param" then parameters[#parameters + 1] = rest:match("^[%w_.]+") end
        elseif line:find("^function") then
            functions = functions + 1
            lu.assertEquals(line:match("%((.*)%) end$"), table.concat(parameters, ", "), line)
            parameters = {}
        else
            lu.assertTrue(line == "" or line:find("^%-%-") ~= nil or line:find("^local %w+ = {}$") ~= nil
                or line == "return feather", line)
        end
    end
    lu.assertTrue(functions > 250)
    for types, line in pairs(used) do
        for one in types:gmatch("[^|]+") do
            local name = one:gsub("%[%]", "")
            lu.assertTrue(PLAIN[name] or known[name], line)
        end
    end
end

-- Each public function of the layer is among those found, and nothing else but drawArray.
local function meet_all(had)
    local function meet(name, methods)
        for method, value in pairs(methods) do
            if type(value) == "function" and not method:find("^_") then
                lu.assertTrue(had[name .. "." .. method], name .. "." .. method .. " is missing")
                had[name .. "." .. method] = nil
            end
        end
    end
    meet("feather", feather)
    for name, class in pairs(objects) do
        if type(class) == "table" and rawget(class, "__name") then meet(name, class) end
    end
    had["World.drawArray"] = nil -- LuaJIT's alone
    lu.assertEquals(had, {})
end

function TestAnnotations.testEachMethodIsThereAndNoOther()
    local had = {}
    for class, method in (lines()):gmatch("\nfunction (%w+)[.:](%w+)%(") do had[class .. "." .. method] = true end
    meet_all(had)
end

function TestAnnotations.testThePageHasEachMethodAndNoOther()
    local file = assert(io.open("docs/reference/lua.md"))
    local had, class = {}, nil
    for line in file:lines() do
        class = line:match("^## (%w+)$") or class
        local owner, method = line:match("^%*%*`(%w+)[.:](%w+)%(")
        if owner then
            lu.assertEquals(owner, class == "feather" and class or class:lower())
            had[class .. "." .. method] = true
        end
    end
    file:close()
    meet_all(had)
end

function TestAnnotations.testOptionsAreTaken()
    local world, seen = feather.newWorld(), 0
    local owner
    for line in select(2, lines()) do
        owner = line:match("^%-%-%-@class feather%.(%w+)$") or owner
        local name, kind = line:match("^%-%-%-@field (%w+)%? (%S+)")
        if owner == "BodyOptions" and kind == "number" then
            world:newBody({ [name] = 0.5 })
            seen = seen + 1
        elseif owner == "BodyOptions" and kind == "boolean" then
            world:newBody({ [name] = true })
            seen = seen + 1
        elseif name and owner == "Tuning" then
            lu.assertNotNil(world:getTuning()[name], name)
            seen = seen + 1
        elseif owner == "HingeJointOptions" and kind == "boolean" then
            local body = world:newBody()
            body:newSphere(1)
            world:newHingeJoint({ bodyB = body, point = { 0, 0, 0 }, axis = { 0, 0, 1 }, [name] = true })
            seen = seen + 1
        end
    end
    lu.assertTrue(seen > 20)
end

os.exit(lu.LuaUnit.run(), true)
