#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/length_text.h"

namespace orthonav::engine {

// For the *_wording.cpp: values in the formats of what is said. Nothing here allocates if the
// string has room.

/// A length for a `%s`: "1.2 mm", "-- mm" if it is not finite.
[[nodiscard]] inline std::string said_mm(double length_m, int decimals = 1) {
  std::string text;  // shorter than what a string allocates for
  append_mm(text, length_m, decimals);
  return text;
}

/// Puts a format around what was appended since `begin`, which takes the place of its `%s`.
inline void enclose(std::string& out, std::size_t begin, std::string_view format) {
  constexpr std::string_view kPlace = "%s";
  const std::size_t place = format.find(kPlace);
  out.insert(begin, format.substr(0, place));
  if (place != std::string_view::npos) {
    out.append(format.substr(place + kPlace.size()));
  }
}

/// Appends a format with a text in the place of its `%s`.
inline void append_with(std::string& out, std::string_view format, std::string_view text) {
  const std::size_t begin = out.size();
  out.append(text);
  enclose(out, begin, format);
}

}  // namespace orthonav::engine
