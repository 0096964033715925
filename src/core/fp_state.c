// fp_state.c - the floating-point state of a thread, see fp_state.h.
//
// Audio and game threads switch flush-to-zero on, some hosts round otherwise or trap. One register of each CPU says so,
// for scalar and vector instructions of any width. It is written only when it is not as it should be: arithmetic waits
// for the write, some 5 ns a call. Flags that were raised are left to the host. The functions have a file of their own,
// so that no arithmetic of the caller moves across the switch. x86: Intel 64 Manual 1, 10.2.3 (MXCSR governs SSE, AVX
// and AVX-512). AArch64: Arm ARM C5.2.8 (FPCR). z/Architecture: Principles of Operation, SA22-7832, chapter 19 (FPC
// register). WebAssembly has only the one state.
#include "core/fp_state.h"

#if defined(__i386__) && !defined(__SSE2_MATH__)
#error "the 387 computes in 80 bits: build with -msse2 -mfpmath=sse"
#endif

#if defined(__x86_64__) || defined(__i386__)
#include <xmmintrin.h>

// all six exceptions masked (bits 7-12), round to nearest (13-14), flush to zero (15) and denormals are zero (6) off,
// no flag raised (0-5)
enum { MXCSR_STATE = 0x1F80, MXCSR_FLAGS = 0x3F };

#if defined(__i386__)
// 64-bit integers become doubles in the 387, which rounds by a control word of its own: all masked, 64 bits, to nearest
enum { X87_STATE = 0x037F };

static uint64_t read_x87(void)
{
    uint16_t control;
    __asm__ volatile("fnstcw %0" : "=m"(control));
    return control;
}

static void write_x87(uint64_t state)
{
    uint16_t control = (uint16_t)state;
    __asm__ volatile("fldcw %0" : : "m"(control));
}
#else
enum { X87_STATE = 0 };
static uint64_t read_x87(void) { return X87_STATE; }
static void write_x87(uint64_t state) { (void)state; }
#endif

// MXCSR in the low half
static int is_right(uint64_t state)
{
    return (state & ~(uint64_t)MXCSR_FLAGS) == ((uint64_t)X87_STATE << 32 | MXCSR_STATE);
}

static void write_state(uint64_t state)
{
    _mm_setcsr((uint32_t)state);
    write_x87(state >> 32);
}

fe__fp_state fe__fp_enter(void)
{
    fe__fp_state state = {read_x87() << 32 | _mm_getcsr()};
    if (!is_right(state.saved)) write_state((uint64_t)X87_STATE << 32 | MXCSR_STATE);
    return state;
}

void fe__fp_leave(fe__fp_state state)
{
    if (!is_right(state.saved)) write_state(state.saved);
}

#elif defined(__aarch64__)

// FPCR 0: no traps, round to nearest, no flushing of inputs or results, NaNs kept
fe__fp_state fe__fp_enter(void)
{
    fe__fp_state state;
    __asm__ volatile("mrs %0, fpcr" : "=r"(state.saved) : : "memory");
    if (state.saved != 0) __asm__ volatile("msr fpcr, %0" : : "r"((uint64_t)0) : "memory");
    return state;
}

void fe__fp_leave(fe__fp_state state)
{
    if (state.saved != 0) __asm__ volatile("msr fpcr, %0" : : "r"(state.saved) : "memory");
}

#elif defined(__s390x__)

// traps of the five exceptions (bits 0-4, counted from the top) off, round to nearest (29-31)
#define FPC_STATE_BITS 0xF8000007u

fe__fp_state fe__fp_enter(void)
{
    uint32_t fpc;
    __asm__ volatile("efpc %0" : "=d"(fpc) : : "memory");
    fe__fp_state state = {fpc};
    if (fpc & FPC_STATE_BITS) __asm__ volatile("sfpc %0" : : "d"(0) : "memory");
    return state;
}

void fe__fp_leave(fe__fp_state state)
{
    if (state.saved & FPC_STATE_BITS) __asm__ volatile("sfpc %0" : : "d"((uint32_t)state.saved) : "memory");
}

#elif defined(__wasm__)

fe__fp_state fe__fp_enter(void) { return (fe__fp_state){0}; }

void fe__fp_leave(fe__fp_state state) { (void)state; }

#else
#error "which register holds this machine's rounding and flushing modes?"
#endif
