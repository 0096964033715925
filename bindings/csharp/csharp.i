// What feather.h's types become in C#. Every pointer is void*: the layer above pins its own records
// (FeatherPhysics/*.cs, and Records.cs, made from the header by records.py). Handles are ulong, results and counts int.
// A negative one is thrown, so that no error passes unseen. Built with -DSWIG_CSHARP_NO_EXCEPTION_HELPER and its like
// (rules.mk): no callbacks, no static constructor.
%pragma(csharp) moduleclassmodifiers="internal static unsafe class"
%pragma(csharp) imclassclassmodifiers="internal static unsafe class"
%csmethodmodifiers "[global::System.Runtime.CompilerServices.MethodImpl(
    global::System.Runtime.CompilerServices.MethodImplOptions.AggressiveInlining)] public";
%csconst(1);

%rename("$ignore", %$isconstant) "";
%rename("$ignore", %$isclass) "";
%rename("$ignore", %$isenum) "";
%rename("$ignore", %$isenumitem) "";
%warnfilter(314) fe_restore_options::base; // a word of C#: the record is made by records.py
%warnfilter(314) fe_save_options::base; // a word of C#: the record is made by records.py

%typemap(ctype)  SWIGTYPE *, SWIGTYPE **, const char * "void *"
%typemap(imtype) SWIGTYPE *, SWIGTYPE **, const char * "void*"
%typemap(cstype) SWIGTYPE *, SWIGTYPE **, const char * "void*"
%typemap(csin)   SWIGTYPE *, SWIGTYPE ** "$csinput"
%typemap(in)     SWIGTYPE *, SWIGTYPE ** "$1 = ($1_ltype)$input;"
%typemap(out)    SWIGTYPE *, const char * "$result = (void *)$1;"
%typemap(csout)  SWIGTYPE *, const char * { return $imcall; }

%apply SWIGTYPE * { void *user, fe_pair_filter filter, void *out, const void *bytes, const void *a, const void *b,
                     const fe_state *const *states, const char *text };

%typemap(ctype)  fe_result "int"
%typemap(imtype) fe_result "int"
%typemap(cstype) fe_result "int"
%typemap(out)    fe_result "$result = (int)$1;"
%typemap(csout)  fe_result, int32_t {
    int result = $imcall;
    if (result < 0) FeatherException.Throw(result);
    return result;
  }
%typemap(csout)  int64_t {
    long result = $imcall;
    if (result < 0) FeatherException.Throw((int)result);
    return result;
  }

// Worlds whose memory outlives them: see shell.h.
%{
#include "csharp/shell.h"
%}
typedef struct fe_shell fe_shell;
fe_result fe_shell_create_world(fe_world_def *def, fe_world **out_world, fe_shell **out_shell);
fe_result fe_shell_load_world(fe_world_def *def, const fe_restore_options *options, const void *bytes, int64_t size,
                              fe_world **out_world, fe_shell **out_shell);
fe_result fe_shell_clone_world(const fe_world *source, fe_world_def *def, fe_world **out_world, fe_shell **out_shell);
void fe_shell_enter(fe_shell *shell);
void fe_shell_leave(fe_shell *shell);
