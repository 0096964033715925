// Which SIMD sets a processor has: the rules of the manuals, as a table, over registers drawn at random; and this
// machine's, as the compiler's library and the kernel find them.
//
//     test_cpu [draws [seed]]
#include "fe_test.h"

#include "core/cpu.h"
#include "feather.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int32_t draws = 100000;
static uint64_t seed = 1;

// What each set needs. Intel 64 Manual 2, CPUID and XGETBV; Manual 1, 13.3 for the bits of XCR0.
typedef struct need {
    int32_t simd;
    const char *bit;
    size_t place; // of the register in fe__cpu_registers
    int32_t shift;
} need;
#define REGISTER(name) offsetof(fe__cpu_registers, name)
static const need needs[] = {
    {FE_SIMD_SSE2, "SSE2", REGISTER(leaf1_edx), 26},       {FE_SIMD_AVX2, "SSE2", REGISTER(leaf1_edx), 26},
    {FE_SIMD_AVX2, "OSXSAVE", REGISTER(leaf1_ecx), 27},    {FE_SIMD_AVX2, "AVX", REGISTER(leaf1_ecx), 28},
    {FE_SIMD_AVX2, "AVX2", REGISTER(leaf7_ebx), 5},        {FE_SIMD_AVX2, "xmm saved", REGISTER(xcr0), 1},
    {FE_SIMD_AVX2, "ymm saved", REGISTER(xcr0), 2},        {FE_SIMD_AVX512, "SSE2", REGISTER(leaf1_edx), 26},
    {FE_SIMD_AVX512, "OSXSAVE", REGISTER(leaf1_ecx), 27},  {FE_SIMD_AVX512, "AVX", REGISTER(leaf1_ecx), 28},
    {FE_SIMD_AVX512, "AVX2", REGISTER(leaf7_ebx), 5},      {FE_SIMD_AVX512, "xmm saved", REGISTER(xcr0), 1},
    {FE_SIMD_AVX512, "ymm saved", REGISTER(xcr0), 2},      {FE_SIMD_AVX512, "AVX512F", REGISTER(leaf7_ebx), 16},
    {FE_SIMD_AVX512, "masks saved", REGISTER(xcr0), 5},    {FE_SIMD_AVX512, "zmm0-15 saved", REGISTER(xcr0), 6},
    {FE_SIMD_AVX512, "zmm16-31 saved", REGISTER(xcr0), 7},
};
enum { NEEDS = sizeof needs / sizeof *needs };
static const struct {
    int32_t simd;
    uint32_t leaves;
} leaves_of[] = {{FE_SIMD_SSE2, 1}, {FE_SIMD_AVX2, 7}, {FE_SIMD_AVX512, 7}};

static uint32_t *register_of(fe__cpu_registers *cpu, const need *n) { return (uint32_t *)((char *)cpu + n->place); }

static uint32_t expected(fe__cpu_registers cpu)
{
    uint32_t sets = 1u << FE_SIMD_PLAIN | 1u << FE_SIMD_SSE2 | 1u << FE_SIMD_AVX2 | 1u << FE_SIMD_AVX512;
    for (int32_t i = 0; i < NEEDS; ++i)
        if (!(*register_of(&cpu, needs + i) >> needs[i].shift & 1)) sets &= ~(1u << needs[i].simd);
    for (int32_t i = 0; i < 3; ++i)
        if (cpu.last_leaf < leaves_of[i].leaves) sets &= ~(1u << leaves_of[i].simd);
    return sets;
}

// xorshift64*: Vigna, "An experimental exploration of Marsaglia's xorshift generators, scrambled", 2016
static uint32_t draw(uint64_t *random)
{
    *random ^= *random >> 12, *random ^= *random << 25, *random ^= *random >> 27;
    return (uint32_t)(*random * 0x2545F4914F6CDD1Du >> 32);
}

static void judge(const fe__cpu_registers *cpu, const char *what)
{
    uint32_t sets = fe__simd_of_cpu(cpu);
    if (sets == expected(*cpu)) return;
    fail_msg("%s: sets %#x instead of %#x: leaf %u, 1: ecx %#x edx %#x, 7: ebx %#x, xcr0 %#x", what, sets,
             expected(*cpu), cpu->last_leaf, cpu->leaf1_ecx, cpu->leaf1_edx, cpu->leaf7_ebx, cpu->xcr0);
}

// What matters is set in seven of eight draws, bit by bit, so that each way out is taken often; all else is noise.
static void sets_are_those_of_the_manuals(void **state)
{
    (void)state;
    uint64_t random = seed * 0x9E3779B97F4A7C15u + 1;
    uint32_t met = 0;
    for (int32_t i = 0; i < draws; ++i) {
        fe__cpu_registers cpu;
        cpu.last_leaf = draw(&random) % 12;
        cpu.leaf1_ecx = draw(&random);
        cpu.leaf1_edx = draw(&random);
        cpu.leaf7_ebx = draw(&random);
        cpu.xcr0 = draw(&random);
        if (draw(&random) % 2) cpu.last_leaf = 7 + draw(&random) % 30;
        for (int32_t k = 0; k < NEEDS; ++k)
            if (draw(&random) % 8) *register_of(&cpu, needs + k) |= 1u << needs[k].shift;
        judge(&cpu, "drawn");
        met |= 1u << expected(cpu) / 2; // of plain, +sse2, +avx2, +avx512: bits 1, 3, 7, 15
    }
    if (draws >= 1000) assert_int_equal(met, 1u << 1 | 1u << 3 | 1u << 7 | 1u << 15);
}

// From all that AVX-512 needs, one thing is taken away at a time.
static void each_need_is_needed(void **state)
{
    (void)state;
    fe__cpu_registers whole = {7, 0, 0, 0, 0};
    for (int32_t i = 0; i < NEEDS; ++i) *register_of(&whole, needs + i) |= 1u << needs[i].shift;
    judge(&whole, "all of it");
    assert_true(fe__simd_of_cpu(&whole) >> FE_SIMD_AVX512 & 1);
    for (int32_t i = 0; i < NEEDS; ++i) {
        fe__cpu_registers less = whole;
        *register_of(&less, needs + i) &= ~(1u << needs[i].shift);
        judge(&less, needs[i].bit);
        assert_false(fe__simd_of_cpu(&less) >> needs[i].simd & 1);
    }
    for (uint32_t leaf = 0; leaf < 7; ++leaf) {
        fe__cpu_registers less = whole;
        less.last_leaf = leaf;
        judge(&less, "too few leaves");
    }
}

static void this_machine_has_what_the_compiler_finds(void **state)
{
    (void)state;
    uint32_t here = fe__simd_here();
    assert_true(here >> FE_SIMD_PLAIN & 1);
    assert_int_equal(here, fe__simd_here());
#if defined(__x86_64__) || defined(__i386__)
    __builtin_cpu_init();
    assert_int_equal(here >> FE_SIMD_SSE2 & 1, __builtin_cpu_supports("sse2") != 0);
    assert_int_equal(here >> FE_SIMD_AVX2 & 1, __builtin_cpu_supports("avx2") != 0);
    assert_int_equal(here >> FE_SIMD_AVX512 & 1, __builtin_cpu_supports("avx512f") != 0);
#endif
}

// The first line "flags : fpu vme ..." of /proc/cpuinfo, which leaves out what Linux does not save
static void this_machine_has_what_the_kernel_finds(void **state)
{
    (void)state;
    static const struct {
        int32_t simd;
        const char *flag;
    } sets[] = {{FE_SIMD_SSE2, " sse2 "}, {FE_SIMD_AVX2, " avx2 "}, {FE_SIMD_AVX512, " avx512f "}};
    char line[8192];
    FILE *file = fopen("/proc/cpuinfo", "r");
    int32_t found = 0;
    while (file && !found && fgets(line, sizeof line - 1, file)) found = strncmp(line, "flags", 5) == 0;
    if (file) fclose(file);
    if (!found) return; // no x86, or not Linux
    for (char *end = line + strlen(line); end > line && end[-1] == '\n'; --end) end[-1] = ' ';
    for (int32_t i = 0; i < 3; ++i)
        assert_int_equal(fe__simd_here() >> sets[i].simd & 1, strstr(line, sets[i].flag) != NULL);
}

int main(int argc, char **argv)
{
    if (argc > 1) draws = atoi(argv[1]);
    if (argc > 2) seed = strtoull(argv[2], NULL, 0);
    printf("%d draws, seed %" PRIu64 "\n", draws, seed);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sets_are_those_of_the_manuals),
        cmocka_unit_test(each_need_is_needed),
        cmocka_unit_test(this_machine_has_what_the_compiler_finds),
        cmocka_unit_test(this_machine_has_what_the_kernel_finds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
