#pragma once

namespace orthonav {

/// Reports on standard error, in one line, what does not hold and where, and ends the program.
[[noreturn]] void check_failed(const char* what, const char* file, int line);

}  // namespace orthonav

/// For our own bugs only, in release too: what can't be true ends the program before anybody is
/// guided by it. What the world can do is a Result.
#define ORTHONAV_CHECK(condition) \
  (static_cast<bool>(condition) ? void() : ::orthonav::check_failed(#condition, __FILE__, __LINE__))
