// fuzz_api.c - the harness as a libFuzzer target: make fuzz. Each stream is run in a world of several workers, so that
// merging is fuzzed too, and in a twin that may not tell anything else.
#include "support/fuzz.h"

#include "feather.h"

#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

// The first byte: wild values or not, and in what the twin differs
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    enum { WORKERS, SETS, ORDER, MEMORY, TWINS };
    if (size == 0) return 0;
    const int32_t which = bytes[0] / 2 % TWINS;
    fuzz_setting setting = {.workers = 3, .simd = FE_SIMD_AUTO, .is_wild = bytes[0] % 2}, twin;
    if (which == MEMORY) setting.failures = 1;
    twin = setting;
    if (which == WORKERS) twin.workers = 1;
    if (which == SETS) twin.simd = FE_SIMD_PLAIN;
    if (which == ORDER) twin.is_reversed = 1;
    if (which == MEMORY) twin.failures = 2u + bytes[0];
    if (fuzz_run(bytes + 1, size - 1, &setting) == fuzz_run(bytes + 1, size - 1, &twin)) return 0;
    fprintf(stderr, "the twin ends otherwise: its %s\n",
            (const char *const[]){"workers", "SIMD set", "order of tasks", "memory, which failed"}[which]);
    abort();
}
