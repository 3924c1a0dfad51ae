#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace orthonav::engine {

/// Appends what `printf` would print, cut at 199 characters; allocates nothing where the string has
/// the room.
template <class... Values>
void append_printed(std::string& out, const char* format, Values... values) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  out += text.data();
}

/// "1.2 mm"; "-- mm" for what is not finite.
inline void append_mm(std::string& out, double length_m, int decimals) {
  if (!std::isfinite(length_m)) {
    out += "-- mm";
    return;
  }
  append_printed(out, "%.*f mm", decimals, length_m * 1e3);
}

}  // namespace orthonav::engine
