// fuzz_api.c - the harness as a libFuzzer target: make fuzz. The world has several workers, so that merging is fuzzed
// too.
#include "support/fuzz.h"

#include "feather.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    if (size == 0) return 0;
    const fuzz_setting setting = {.workers = 3, .simd = FE_SIMD_AUTO, .is_wild = bytes[0] % 2};
    fuzz_run(bytes + 1, size - 1, &setting);
    return 0;
}
