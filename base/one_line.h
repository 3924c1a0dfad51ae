#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace orthonav {

/// Text from a file, fit for a message: control characters, line ends among them, become spaces.
[[nodiscard]] inline std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return text;
}

}  // namespace orthonav
