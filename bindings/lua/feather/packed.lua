-- A game of LÖVE that holds the native library, perhaps inside its archive: feather/native/linux-x64/libfeather.so. The
-- system opens no library inside an archive, so it is unpacked into the game's save folder, under the hash of its
-- content: versions do not meet there, and a file that was cut short or changed is written again.
local ffi = require("ffi")
local packed = {}

local SYSTEMS = { Linux = "linux", Windows = "win", OSX = "osx" }
local NAMES = { Windows = "feather.dll", OSX = "libfeather.dylib" }
packed.name = NAMES[ffi.os] or "libfeather.so"

-- The path of the library for this machine, or nil where the game holds none.
function packed.path()
    local love = type(love) == "table" and love
    local filesystem = love and love.filesystem
    local target = (SYSTEMS[ffi.os] or "") .. "-" .. ffi.arch
    local held = filesystem and filesystem.read("feather/native/" .. target .. "/" .. packed.name)
    if not held then return nil end
    require("love.data")
    local hash = love.data.encode("string", "hex", love.data.hash("sha256", held))
    local file = "feather-" .. target .. "-" .. hash:sub(1, 32) .. packed.name:match("%.%w+$")
    local path = filesystem.getSaveDirectory() .. "/" .. file
    if filesystem.read(file) == held then return path end
    -- Whole, then under its name: another game that starts now finds no half of it.
    local part = file .. ".part" .. tostring(love):match("%x+$")
    local done, message = filesystem.write(part, held)
    os.remove(path) -- Windows renames onto no file
    if done then done, message = os.rename(filesystem.getSaveDirectory() .. "/" .. part, path) end
    if not done then error("feather: " .. path .. " cannot be unpacked: " .. tostring(message), 0) end
    return path
end

return packed
