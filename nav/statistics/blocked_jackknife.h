#pragma once

#include <cstddef>
#include <vector>

namespace orthonav::nav {

// The blocked jackknife (Kuensch 1989): what is measured one after the other errs together, so not
// single measurements are left out in turn but whole stretches of them.

inline constexpr std::size_t kJackknifeBlocks = 10;

/// The indices below `count` but those of one tenth; every index belongs to one of them.
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
