// fuzz.h - a stream of bytes as calls of the API. The same harness serves libFuzzer (fuzz_api.c) and a bounded test
// (test_fuzz.c).
#ifndef FE_TESTS_FUZZ_H
#define FE_TESTS_FUZZ_H
#include "feather.h"

#include <stddef.h>
#include <stdint.h>

typedef struct fuzz_setting {
    int32_t workers;     // above 1: tasks of one thread, in an order of their own
    int32_t is_reversed; // 1: in another one, the last task first
    int32_t simd;        // fe_simd
    int32_t is_wild; // 1: every value that the API takes, up to its limits. Results may then overflow, and only crashes
                     // count
    uint32_t failures; // 0: the stream says which allocations fail. 1: none does. Above: a seed; inside steps every
                       // second one does, by chance, and a step that failed is repeated at once
    void (*begins)(fe_world *world, void *user); // with the world, before the first call; NULL: none
    void (*ends)(fe_world *world, void *user);   // after the last one
    void *user;
    int64_t *refused; // counts calls that were refused; or NULL
} fuzz_setting;

// Makes a world, calls what the bytes say, checks what must always hold and aborts when it does not. Returns a
// fingerprint of all results, which no setting may change.
uint64_t fuzz_run(const uint8_t *bytes, size_t size, const fuzz_setting *setting);

#endif
