// error.h - the sentence of the last failure of each thread.
//
// Written by the API layer alone, read by fe_last_error. A fixed buffer: telling of an error never needs memory.
#ifndef FE_API_ERROR_H
#define FE_API_ERROR_H
#include "feather.h"

#ifdef __GNUC__
#define FE_PRINTF_LIKE(text, first) __attribute__((format(printf, text, first)))
#else
#define FE_PRINTF_LIKE(text, first)
#endif

// Keeps "function: sentence" for fe_last_error and returns `result`.
fe_result fe__fail(const char *function, fe_result result, const char *format, ...) FE_PRINTF_LIKE(3, 4);
// The same for what a lower layer gave as a reason: FE_ERROR_MEMORY, FE_ERROR_LIMIT. FE_OK passes.
fe_result fe__report(const char *function, fe_result result);

#endif
