// error.c - see error.h.
#include "api/error.h"

#include <stdarg.h>
#include <stdio.h>

enum { SENTENCE_SIZE = 320 }; // longer ones are cut

static _Thread_local char sentence[SENTENCE_SIZE] = "no failure so far";

const char *fe_last_error(void) { return sentence; }

fe_result fe__fail(const char *function, fe_result result, const char *format, ...)
{
    int used = snprintf(sentence, sizeof sentence, "%s: ", function);
    if (used < 0 || used >= SENTENCE_SIZE) return result;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence + used, sizeof sentence - (size_t)used, format, arguments);
    va_end(arguments);
    return result;
}

fe_result fe__report(const char *function, fe_result result)
{
    switch ((int)result) {
    case FE_OK:
        return FE_OK;
    case FE_ERROR_MEMORY:
        return fe__fail(function, result, "the allocator gave no memory; nothing was changed");
    case FE_ERROR_LIMIT:
        return fe__fail(function, result, "more than a world or a store can hold; nothing was changed");
    default:
        return fe__fail(function, result, "%s", fe_result_name(result));
    }
}

const char *fe_result_name(int32_t result)
{
    switch (result) {
    case FE_OK:
        return "FE_OK";
    case FE_FOREIGN:
        return "FE_FOREIGN";
    case FE_END:
        return "FE_END";
    case FE_ERROR_ARGUMENT:
        return "FE_ERROR_ARGUMENT";
    case FE_ERROR_STALE:
        return "FE_ERROR_STALE";
    case FE_ERROR_KIND:
        return "FE_ERROR_KIND";
    case FE_ERROR_STEPPING:
        return "FE_ERROR_STEPPING";
    case FE_ERROR_MEMORY:
        return "FE_ERROR_MEMORY";
    case FE_ERROR_LIMIT:
        return "FE_ERROR_LIMIT";
    case FE_ERROR_UNSUPPORTED:
        return "FE_ERROR_UNSUPPORTED";
    case FE_ERROR_STATE:
        return "FE_ERROR_STATE";
    case FE_ERROR_BUSY:
        return "FE_ERROR_BUSY";
    case FE_ERROR_DEGENERATE:
        return "FE_ERROR_DEGENERATE";
    case FE_ERROR_DATA:
        return "FE_ERROR_DATA";
    case FE_ERROR_VERSION:
        return "FE_ERROR_VERSION";
    case FE_ERROR_DIVERGED:
        return "FE_ERROR_DIVERGED";
    default:
        return "unknown";
    }
}
