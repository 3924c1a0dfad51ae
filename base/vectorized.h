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

/// Goes before a function: it is compiled for AVX2 as well, and the machine decides at the start.
/// Without fused multiply-add (-ffp-contract=off) the results are the same to the bit.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__OPTIMIZE__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define ORTHONAV_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define ORTHONAV_WIDE
#endif
