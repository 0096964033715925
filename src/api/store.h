// store.h - what the API functions of stores open with.
#ifndef FE_API_STORE_H
#define FE_API_STORE_H
#include "api/check.h"

#define FE_BEGIN_STORE(store)        \
    const char *function = __func__; \
    FE_CHECK_POINTER(store)

#endif
