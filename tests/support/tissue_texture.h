#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/random.h"
#include "base/vec.h"

namespace orthonav::test {

/// Smooth noise of SD 1 on a lattice of 3 mm.
class TissueTexture {
 public:
  explicit TissueTexture(std::uint64_t seed) {
    Random random(seed);
    for (float& v : lattice_) {
      v = static_cast<float>(random.normal());
    }
  }
  [[nodiscard]] double at(Vec3 p_m) const {
    std::array<int, 3> whole{};
    Vec3 part;
    for (int a = 0; a < 3; ++a) {
      const double q = p_m[a] / 0.003;
      whole[static_cast<std::size_t>(a)] = static_cast<int>(std::floor(q));
      part[a] = q - std::floor(q);
    }
    double sum = 0.0;
    for (int c = 0; c < 8; ++c) {
      double weight = 1.0;
      std::size_t index = 0;
      for (int a = 0; a < 3; ++a) {
        const int up = (c >> a) & 1;
        weight *= up ? part[a] : 1.0 - part[a];
        index = index * kSide +
                static_cast<std::size_t>((whole[static_cast<std::size_t>(a)] + up) & (kSide - 1));
      }
      sum += weight * static_cast<double>(lattice_[index]);
    }
    return 1.7 * sum;
  }

 private:
  static constexpr int kSide = 32;
  std::array<float, kSide * kSide * kSide> lattice_{};
};

}  // namespace orthonav::test
