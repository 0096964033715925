// cpu.c - see cpu.h.
//
// An instruction may be used where the processor has it and the system saves its registers when it switches threads:
// Intel 64 Manual 1, 14.3 (AVX: OSXSAVE, then XCR0, then the processor's bit), 14.7.1 (AVX2), 15.2 (AVX-512);
// AMD64 Manual 3, appendix E, has the same bits.
#include "core/cpu.h"

#include "feather.h"
#include <stdatomic.h>

enum {
    LEAF1_ECX_OSXSAVE = 1 << 27, // XGETBV may be asked
    LEAF1_ECX_AVX = 1 << 28,
    LEAF1_EDX_SSE2 = 1 << 26,
    LEAF7_EBX_AVX2 = 1 << 5,
    LEAF7_EBX_AVX512F = 1 << 16,
    XCR0_AVX = 0x06,    // xmm, and the upper halves of ymm0-15
    XCR0_AVX512 = 0xE0, // masks, the upper halves of zmm0-15, zmm16-31
};

static int has(uint32_t bits, uint32_t wanted) { return (bits & wanted) == wanted; }

uint32_t fe__simd_of_cpu(const fe__cpu_registers *cpu)
{
    uint32_t sets = 1u << FE_SIMD_PLAIN;
    if (cpu->last_leaf < 1 || !has(cpu->leaf1_edx, LEAF1_EDX_SSE2)) return sets;
    sets |= 1u << FE_SIMD_SSE2;
    // Beyond its last leaf a processor answers with another leaf's bits.
    if (cpu->last_leaf < 7 || !has(cpu->leaf1_ecx, LEAF1_ECX_OSXSAVE | LEAF1_ECX_AVX)) return sets;
    if (!has(cpu->xcr0, XCR0_AVX) || !has(cpu->leaf7_ebx, LEAF7_EBX_AVX2)) return sets;
    sets |= 1u << FE_SIMD_AVX2;
    if (has(cpu->xcr0, XCR0_AVX512) && has(cpu->leaf7_ebx, LEAF7_EBX_AVX512F)) sets |= 1u << FE_SIMD_AVX512;
    return sets;
}

#if defined(__x86_64__) || defined(__i386__)
// EAX, EBX, ECX, EDX of a leaf. Every compiler of the engine, clang-cl among them, has gcc's assembler statements.
static void cpuid(uint32_t leaf, uint32_t registers[4])
{
    __asm__ volatile("cpuid"
                     : "=a"(registers[0]), "=b"(registers[1]), "=c"(registers[2]), "=d"(registers[3])
                     : "a"(leaf), "c"(0));
}

static uint32_t xcr0(void)
{
    uint32_t low, high;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    (void)high;
#ifdef __APPLE__
    // Darwin saves the registers of AVX-512 from a thread's first use of them on, and shows them from then on.
    if (has(low, XCR0_AVX)) low |= XCR0_AVX512;
#endif
    return low;
}

static uint32_t ask(void)
{
    uint32_t leaf[4];
    fe__cpu_registers cpu = {0};
    cpuid(0, leaf);
    cpu.last_leaf = leaf[0];
    cpuid(1, leaf);
    cpu.leaf1_ecx = leaf[2];
    cpu.leaf1_edx = leaf[3];
    cpuid(7, leaf);
    cpu.leaf7_ebx = leaf[1];
    if (has(cpu.leaf1_ecx, LEAF1_ECX_OSXSAVE)) cpu.xcr0 = xcr0();
    return fe__simd_of_cpu(&cpu);
}
#else
// A program for another machine has its vectors as a matter of course, and a module of WebAssembly with them would not
// have been loaded without.
static uint32_t ask(void) { return 1u << FE_SIMD_PLAIN | 1u << FE_SIMD_NEON | 1u << FE_SIMD_WASM; }
#endif

uint32_t fe__simd_here(void)
{
    static _Atomic uint32_t known; // 0: not asked yet. Threads that ask at once write the same.
    uint32_t sets = atomic_load_explicit(&known, memory_order_relaxed);
    if (sets == 0) {
        sets = ask(); // some microseconds each time, in a virtual machine
        atomic_store_explicit(&known, sets, memory_order_relaxed);
    }
    return sets;
}
