// What feather.h's types become in C#: every pointer is void* here, and the layer above pins its own records (FeatherPhysics/*.cs, Records.cs made
// from the header by records.py); handles are ulong, results and counts int. A negative one is thrown, so that no error passes unseen. Worlds are
// pointers that World guards. Built with -DSWIG_CSHARP_NO_EXCEPTION_HELPER and its like (rules.mk): no callbacks, no static constructor.
%pragma(csharp) moduleclassmodifiers="internal static unsafe class"
%pragma(csharp) imclassclassmodifiers="internal static unsafe class"
%csmethodmodifiers "[global::System.Runtime.CompilerServices.MethodImpl(global::System.Runtime.CompilerServices.MethodImplOptions.AggressiveInlining)] public";
%csconst(1);

%rename("$ignore", %$isconstant) "";
%rename("$ignore", %$isclass) "";
%rename("$ignore", %$isenum) "";
%rename("$ignore", %$isenumitem) "";

%typemap(ctype)  SWIGTYPE *, SWIGTYPE **, const char * "void *"
%typemap(imtype) SWIGTYPE *, SWIGTYPE **, const char * "void*"
%typemap(cstype) SWIGTYPE *, SWIGTYPE **, const char * "void*"
%typemap(csin)   SWIGTYPE *, SWIGTYPE ** "$csinput"
%typemap(in)     SWIGTYPE *, SWIGTYPE ** "$1 = ($1_ltype)$input;"
%typemap(out)    SWIGTYPE *, const char * "$result = (void *)$1;"
%typemap(csout)  SWIGTYPE *, const char * { return $imcall; }

%typemap(ctype)  fe_result "int"
%typemap(imtype) fe_result "int"
%typemap(cstype) fe_result "int"
%typemap(out)    fe_result "$result = (int)$1;"
%typemap(csout)  fe_result, int32_t {
    int result = $imcall;
    if (result < 0) FeatherException.Throw(result);
    return result;
  }
