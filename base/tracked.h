#pragma once

#include <array>
#include <cmath>

#include "base/time.h"

namespace orthonav {

/// How a value was obtained. Only `kMeasured` values may be digitized.
enum class PoseStatus { kMeasured, kPredicted, kLost };

/// 6×6 covariance, row-major, of (translation m, rotation vector rad), both in the parent frame.
using PoseCovariance = std::array<double, 36>;
/// The 3-D SD of the translation, and of the rotation.
[[nodiscard]] inline double translation_sigma_m(const PoseCovariance& c) {
  return std::sqrt(c[0] + c[7] + c[14]);
}
[[nodiscard]] inline double rotation_sigma_rad(const PoseCovariance& c) {
  return std::sqrt(c[21] + c[28] + c[35]);
}

/// A value with its time, how it was obtained and how certain it is. With `kLost` the value is
/// meaningless and must not be read.
template <class T>
struct Tracked {
  T value{};
  Timestamp time{};
  PoseStatus status = PoseStatus::kLost;
  PoseCovariance covariance{};

  [[nodiscard]] Duration age(Timestamp now) const { return now - time; }
};

}  // namespace orthonav
