// contraction.h - a * b + c is rounded twice, on every machine.
//
// C lets a compiler contract an expression (C11 6.5): where the machine has a fused multiply-add, a * b + c is then
// rounded once, and the bits differ from those of a machine without. -ffp-contract=off, last on each command line of
// this project's builds, forbids it to every compiler. The pragma forbids it to clang also where the sources are built
// by other command lines, from here to the end of the source; gcc does not know it. math.h, simd.h and lanes.h include
// this file, and tests/house/includes asks that it reaches each source that computes.
#ifndef FE_CORE_CONTRACTION_H
#define FE_CORE_CONTRACTION_H
#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif
#endif
