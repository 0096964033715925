// The ABI's sizes, offsets and values, checked by the compiler: on 64-bit machines, and on 32-bit ones that align
// 8-byte types to 8 or to 4.
#include <feather.h>
#include <stddef.h>

#ifdef __cplusplus
#define FE_ASSERT(condition, text) static_assert(condition, text)
#else
#define FE_ASSERT(condition, text) _Static_assert(condition, text)
#endif
#define FE_SIZE(type, bytes) FE_ASSERT(sizeof(type) == bytes, "size of " #type);
#define FE_OFFSET(type, field, bytes) FE_ASSERT(offsetof(type, field) == bytes, "offset of " #type "." #field);
#define FE_VALUE(name, value) FE_ASSERT((name) == value, "value of " #name);

#if UINTPTR_MAX == UINT64_MAX
#include "layout.h"
#elif defined(__i386__) && !defined(_WIN32)
#include "layout_i686.h"
#else
#include "layout_wasm32.h"
#endif
FE_ASSERT(sizeof(fe_result) == 4 && sizeof(fe_handle) == 8, "size of what every function takes or returns");
