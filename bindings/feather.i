// One interface for every language: SWIG makes of it and of include/feather.h a flat private module for each, in which each function of the
// header stands without its prefix (fe_world_step is world_step) and each constant under its own name. What a type becomes in a language is
// said once, by type and name of a parameter, in python/python.i, csharp/csharp.i, lua/lua.i: a new function appears by itself. On the flat modules
// stand the layers written by hand. (LuaJIT has no module: lua/feather/ffi.lua reads the header itself.)
#if defined(SWIGCSHARP)
%module Native
#elif defined(SWIGPYTHON)
%module(package="feather_physics") flat
#else
%module core
#endif

%{
#include "feather.h"
#include "twins.h"
%}

%include <stdint.i>

%rename("%(strip:[fe_])s") "";
%rename("$ignore", regexmatch$name="FORCE32$") "";

// For hosts in C only: functions that the library calls from the thread that steps, or from the host's own workers.
%ignore fe_allocator;
%ignore fe_task_system;
%ignore fe_task;
%ignore fe_world_def::allocator;
%ignore fe_world_def::tasks;

#if defined(SWIGPYTHON)
%include "python/python.i"
#elif defined(SWIGLUA)
%include "lua/lua.i"
#elif defined(SWIGCSHARP)
%include "csharp/csharp.i"
#endif

%include "feather.h"
%include "twins.h"
