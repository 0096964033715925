// library.c - what belongs to no world.
#include "feather.h"

uint32_t fe_version(void)
{
    return (uint32_t)FE_VERSION_MAJOR << 16 | (uint32_t)FE_VERSION_MINOR << 8 | (uint32_t)FE_VERSION_PATCH;
}
