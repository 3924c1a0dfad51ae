#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace orthonav::engine {

/// The elements at 0, `step`, 2 · `step`, ...; `step` is at least 1.
template <class T>
std::vector<T> every_nth(std::span<const T> all, std::size_t step) {
  std::vector<T> out;
  out.reserve(all.size() / step + 1);
  for (std::size_t i = 0; i < all.size(); i += step) {
    out.push_back(all[i]);
  }
  return out;
}

}  // namespace orthonav::engine
