# feather.h as LuaJIT's ffi.cdef reads it: without comments, preprocessor and sugar, in a Lua module that returns it as
# a string.
BEGIN { print "-- Made from include/feather.h by bindings/lua/header.awk\nreturn [[" }
/^\/\/ ---- sugar/ { exit }
/^#ifdef __cplusplus/ { skip = 1 }
/^#/ { if (/^#endif/) skip = 0; next }
skip { next }
{ sub(/\/\/.*/, ""); gsub(/FE_API /, "") }
NF { print }
END { print "]]" }
