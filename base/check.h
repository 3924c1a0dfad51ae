#pragma once

namespace orthonav {

/// Prints one line to standard error that says which condition failed and where, and ends the
/// program.
[[noreturn]] void check_failed(const char* what, const char* file, int line);

}  // namespace orthonav

/// For our own bugs only, in release builds too: a broken invariant ends the program before it can
/// guide anyone. A failure that the outside world can cause is a Result.
#define ORTHONAV_CHECK(condition) \
  (static_cast<bool>(condition) ? void() : ::orthonav::check_failed(#condition, __FILE__, __LINE__))
