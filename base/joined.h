#pragma once

#include <span>
#include <string>

namespace orthonav {

/// All parts in one line, for a message: "a; b; c".
[[nodiscard]] inline std::string joined(std::span<const std::string> parts,
                                        const char* separator = "; ") {
  std::string line;
  for (const std::string& part : parts) {
    line += (line.empty() ? "" : separator) + part;
  }
  return line;
}

}  // namespace orthonav
