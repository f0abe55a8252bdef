/* VECTORIZE before a loop: its passes do not depend on each other, whatever the compiler can prove.
 * WIDE before a function: it is compiled for processors with AVX2, too, and the loader takes the one that fits.  Without
 * fused multiply-adds both give the same bits.  (Not under sanitizers, which start after the loader has chosen.) */
#ifndef CORACLE_VECTORIZE_H
#define CORACLE_VECTORIZE_H
#include <stdlib.h> /* __GLIBC__ */

#if defined(__clang__)
#define VECTORIZE _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define VECTORIZE _Pragma("GCC ivdep")
#else
#define VECTORIZE
#endif

#if defined(__x86_64__) && defined(__linux__) && defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) &&     \
    (!defined(__clang__) || __clang_major__ >= 14)
#define WIDE __attribute__((target_clones("avx2", "default")))
#else
#define WIDE
#endif
#endif
