rockspec_format = "3.0"
package = "feather"
version = "scm-1"
source = { url = "." }
description = {
    summary = "3D rigid-body physics, the same bits on every machine",
    detailed = "The API is in the style of love.physics; see docs/lua.md. Needs make, gcc or clang, and SWIG.",
    license = "Apache-2.0",
}
dependencies = { "lua >= 5.1, < 5.5" }
build = {
    type = "command",
    build_command = "make lua-rock LUA_INCDIR=$(LUA_INCDIR)",
    install = {
        lua = {
            ["feather.init"] = "bindings/lua/feather/init.lua",
            ["feather.ffi"] = "bindings/lua/feather/ffi.lua",
            ["feather.header"] = "build/rock/header.lua",
        },
        lib = { ["feather.core"] = "build/rock/core.so", libfeather = "build/rock/libfeather.so" },
    },
}
