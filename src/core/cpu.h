// cpu.h - which SIMD sets this processor has and its operating system saves.
//
// The engine asks the processor itself: a compiler's __builtin_cpu_supports needs a runtime library of the compiler's,
// which clang-cl and cross compilers do not link.
#ifndef FE_CORE_CPU_H
#define FE_CORE_CPU_H
#include <stdint.h>

// What an x86 processor tells of itself
typedef struct fe__cpu_registers {
    uint32_t last_leaf;            // EAX of CPUID 0: the last leaf that it answers
    uint32_t leaf1_ecx, leaf1_edx; // of CPUID 1
    uint32_t leaf7_ebx;            // of CPUID 7, 0
    uint32_t xcr0;                 // the low half of XGETBV 0: what the system saves; read only where OSXSAVE is set
} fe__cpu_registers;

// Bit s for set s of fe_simd that may run
uint32_t fe__simd_of_cpu(const fe__cpu_registers *cpu);
// The same of this machine, which is asked once
uint32_t fe__simd_here(void);

#endif
