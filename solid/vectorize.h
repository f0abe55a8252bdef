/* VECTORIZE before a loop: its passes do not depend on each other, whatever the compiler can prove. */
#ifndef SOLID_VECTORIZE_H
#define SOLID_VECTORIZE_H

#if defined(__clang__)
#define VECTORIZE _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define VECTORIZE _Pragma("GCC ivdep")
#else
#define VECTORIZE
#endif
#endif
