#pragma once

/// Before a loop whose steps don't depend on one another and whose arrays don't overlap: compilers
/// make vector instructions of it without comparing every pair of arrays first. GCC gives up beyond
/// ten such comparisons, `__restrict` or not.
#if defined(__clang__)
#define ORTHONAV_VECTORIZED _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define ORTHONAV_VECTORIZED _Pragma("GCC ivdep")
#else
#define ORTHONAV_VECTORIZED
#endif
