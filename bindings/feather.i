// One interface for every language. SWIG makes a flat private module from it and from include/feather.h: each function
// of the header stands there without its prefix (fe_world_step is world_step), each constant under its own name. What a
// type becomes in a language is stated once, by the type and the name of a parameter, in python/python.i,
// csharp/csharp.i and lua/lua.i: a new function appears by itself. The layers written by hand stand on the flat
// modules. (LuaJIT has no module: lua/feather/ffi.lua reads the header itself.)
//
// The inline functions at the end of the header (fe_geometry_sphere...) and those of twins.h are compiled into each
// module. They stand beside the others: geometry_sphere, body_get_position.
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
%rename("$ignore", regexmatch$name="^reserved(_end)?$") "";

// For hosts in C only: functions that the library calls from the thread that steps, or from the host's own workers.
%ignore fe_allocator;
%ignore fe_allocator_init;
%ignore fe_task_system;
%ignore fe_task_system_init;
%ignore fe_task;
%ignore fe_world_def::allocator;
%ignore fe_world_def::tasks;
%ignore fe_store_def::allocator;

// Batches: in Python and Lua their calls are written by hand (python/batch.h, lua/batch.h).
#if !defined(SWIGCSHARP)
%rename("$ignore", regexmatch$name="^fe_batch(_[a-z_]+)?$") "";
%ignore fe_array;
%ignore fe_array_init;
#endif
#if !defined(SWIGPYTHON) && !defined(SWIGCSHARP)
// Players: in Lua their calls are written by hand (lua/player.h).
%rename("$ignore", regexmatch$name="^fe_(player|divergence)(_(?!type$)[a-z_]+)?$") "";
%ignore fe_note;
#endif

#if defined(SWIGPYTHON)
%include "python/python.i"
#elif defined(SWIGLUA)
%include "lua/lua.i"
#elif defined(SWIGCSHARP)
%include "csharp/csharp.i"
#endif

%include "feather.h"
%include "twins.h"
