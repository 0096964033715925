-- Errors name the caller's line, not one of this package.
local debug, error, format = debug, error, string.format
local where = { own = "@feather/" }
if debug then where.own = debug.getinfo(1, "S").source:gsub("[^/\\]*$", "") end

local function is_own(source)
    return source:sub(1, #where.own) == where.own or source:sub(1, 4) == "=fe_"
end

-- "file:line: " of the innermost line that is not the package's own, or "".
function where.position()
    local level, frame = 2, nil
    repeat
        frame = debug and debug.getinfo(level, "Sl")
        if frame and frame.currentline > 0 and not is_own(frame.source) then
            return format("%s:%d: ", frame.short_src, frame.currentline)
        end
        level = level + 1
    until not frame
    return ""
end

function where.fail(...) error(where.position() .. "feather: " .. format(...), 0) end

return where
