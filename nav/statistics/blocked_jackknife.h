#pragma once

#include <cstddef>
#include <vector>

namespace orthonav::nav {

// The blocked jackknife (Kuensch 1989): consecutive measurements err together, so whole stretches
// of them are left out in turn and not single ones.

inline constexpr std::size_t kJackknifeBlocks = 10;

/// The indices below `count` except those of one tenth; every index belongs to exactly one tenth.
[[nodiscard]] inline std::vector<std::size_t> without_block(std::size_t count, std::size_t block) {
  std::vector<std::size_t> rest;
  for (std::size_t i = 0; i < count; ++i) {
    if (i * kJackknifeBlocks / count != block) {
      rest.push_back(i);
    }
  }
  return rest;
}

}  // namespace orthonav::nav
