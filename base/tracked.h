#pragma once

#include <array>
#include <cmath>

#include "base/time.h"

namespace orthonav {

/// How a value came about. Only `kMeasured` values may be digitized.
enum class PoseStatus { kMeasured, kPredicted, kLost };

/// 6×6 covariance, row-major, of (translation m, rotation vector rad), both in the parent frame.
using PoseCovariance = std::array<double, 36>;
/// Its 3-D SDs.
[[nodiscard]] inline double translation_sigma_m(const PoseCovariance& c) {
  return std::sqrt(c[0] + c[7] + c[14]);
}
[[nodiscard]] inline double rotation_sigma_rad(const PoseCovariance& c) {
  return std::sqrt(c[21] + c[28] + c[35]);
}

/// Truth has an age: a value with its time, how it was obtained and how sure it is.
/// With `kLost` the value is meaningless and must not be read.
template <class T>
struct Tracked {
  T value{};
  Timestamp time{};
  PoseStatus status = PoseStatus::kLost;
  PoseCovariance covariance{};

  [[nodiscard]] Duration age(Timestamp now) const { return now - time; }
};

}  // namespace orthonav
