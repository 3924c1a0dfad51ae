#pragma once

#include <cstdint>
#include <vector>

namespace orthonav::bench {

/// A cluttered surface of side 1: cloth, sheets, strips and lettering, reflectance 0.03 to 0.9.
/// Beyond its edges it continues mirrored.
class Clutter {
 public:
  explicit Clutter(std::uint64_t seed);
  [[nodiscard]] float at(double u, double v) const;

 private:
  std::vector<float> texels_;
};

}  // namespace orthonav::bench
