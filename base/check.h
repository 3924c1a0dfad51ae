#pragma once

namespace orthonav {

/// Says on standard error what does not hold and where, in one line, and ends the program.
[[noreturn]] void check_failed(const char* what, const char* file, int line);

}  // namespace orthonav

/// For our own bugs alone, in release too: what can't be true ends the program before anybody is
/// guided by it. What the world can do is a Result.
#define ORTHONAV_CHECK(condition) \
  (static_cast<bool>(condition) ? void() : ::orthonav::check_failed(#condition, __FILE__, __LINE__))
