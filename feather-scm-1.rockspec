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
    build_command = "make -j4 lua-rock LUA_INCDIR=$(LUA_INCDIR)",
    install = {
        lua = {
            ["feather.init"] = "bindings/lua/feather/init.lua",
            ["feather.body"] = "bindings/lua/feather/body.lua",
            ["feather.compound"] = "bindings/lua/feather/compound.lua",
            ["feather.draw"] = "bindings/lua/feather/draw.lua",
            ["feather.events"] = "bindings/lua/feather/events.lua",
            ["feather.ffi"] = "bindings/lua/feather/ffi.lua",
            ["feather.ffi_bytes"] = "bindings/lua/feather/ffi_bytes.lua",
            ["feather.ffi_values"] = "bindings/lua/feather/ffi_values.lua",
            ["feather.ffi_writer"] = "bindings/lua/feather/ffi_writer.lua",
            ["feather.joint"] = "bindings/lua/feather/joint.lua",
            ["feather.native"] = "bindings/lua/feather/native.lua",
            ["feather.objects"] = "bindings/lua/feather/objects.lua",
            ["feather.options"] = "bindings/lua/feather/options.lua",
            ["feather.packed"] = "bindings/lua/feather/packed.lua",
            ["feather.query"] = "bindings/lua/feather/query.lua",
            ["feather.shape"] = "bindings/lua/feather/shape.lua",
            ["feather.history"] = "bindings/lua/feather/history.lua",
            ["feather.batch"] = "bindings/lua/feather/batch.lua",
            ["feather.ffi_batch"] = "bindings/lua/feather/ffi_batch.lua",
            ["feather.player"] = "bindings/lua/feather/player.lua",
            ["feather.ffi_player"] = "bindings/lua/feather/ffi_player.lua",
            ["feather.state"] = "bindings/lua/feather/state.lua",
            ["feather.recording"] = "bindings/lua/feather/recording.lua",
            ["feather.snapshot"] = "bindings/lua/feather/snapshot.lua",
            ["feather.store"] = "bindings/lua/feather/store.lua",
            ["feather.structs"] = "bindings/lua/feather/structs.lua",
            ["feather.where"] = "bindings/lua/feather/where.lua",
            ["feather.world"] = "bindings/lua/feather/world.lua",
            ["feather.header"] = "build/rock/header.lua",
        },
        lib = { ["feather.core"] = "build/rock/core.so", libfeather = "build/rock/libfeather.so" },
    },
}
