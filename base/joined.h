#pragma once

#include <span>
#include <string>

namespace orthonav {

/// Every problem in one line, for a message: "a; b; c".
[[nodiscard]] inline std::string joined(std::span<const std::string> problems) {
  std::string line;
  for (const std::string& problem : problems) {
    line += (line.empty() ? "" : "; ") + problem;
  }
  return line;
}

}  // namespace orthonav
