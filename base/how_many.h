#pragma once

#include <concepts>
#include <string>

namespace orthonav {

/// "1 pair", "2 pairs"; `what` is the singular of a noun whose plural ends in s.
[[nodiscard]] std::string how_many(std::integral auto count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace orthonav
