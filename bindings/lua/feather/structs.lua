-- The structs of feather.h: for each its fields in their order, { kind = "float", name = "lower", length = nil,
-- pointer = false }. Functions that a struct points to are left out.
local text = require("feather.header"):gsub("%s+", " ")
local structs = {}

for body, name in text:gmatch("typedef struct [%w_]+ (%b{}) ([%w_]+);") do
    local fields = {}
    for statement in body:sub(2, -2):gmatch("[^;]+") do
        local kind, names = statement:gsub("const ", ""):match("([%w_]+) ([^%(]+)$")
        for field in (names or ""):gmatch("[^,]+") do
            local plain, length = field:match("([%w_]+)%[(%d+)%]")
            fields[#fields + 1] = {
                kind = kind, name = plain or field:match("[%w_]+"), length = tonumber(length),
                pointer = field:find("*", 1, true) ~= nil,
            }
        end
    end
    structs[name] = fields
end

return structs
