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
