#pragma once

/// Goes before a loop whose steps are independent and whose arrays don't overlap: compilers then
/// vectorize it without first comparing every pair of arrays. GCC gives up beyond ten such
/// comparisons, even with `__restrict`.
#if defined(__clang__)
#define ORTHONAV_VECTORIZED _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define ORTHONAV_VECTORIZED _Pragma("GCC ivdep")
#else
#define ORTHONAV_VECTORIZED
#endif

/// Goes before a function made of such loops: it is also compiled for AVX2, and each start of the
/// program takes what the processor has. The results are the same to the bit, since no compiler
/// joins a product and a sum (-ffp-contract=off). What it calls in these loops must be inlined:
/// beside a call GCC 12 can leave out the instruction that ends AVX code, and what follows is slow.
/// Not under sanitizers, whose instrumentation is not ready when that choice is made.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__gnu_linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define ORTHONAV_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define ORTHONAV_WIDE
#endif
