#pragma once

// To be included before any header of ITK. Debian's ITK was configured for GCC and refuses other
// compilers. Clang reads its users for checks; of the skipped definitions it needs these two.
#ifdef __clang__
#define ITK_COMPILER_DETECTION_H
#define ITK_NOEXCEPT noexcept
#define ITK_NOEXCEPT_EXPR(X) noexcept(X)
#endif
