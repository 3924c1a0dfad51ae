#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/vec.h"

namespace orthonav::nav {

/// What one pair says of a small rotation of the right camera against how it is reported: the
/// equations of the rotation vector (rad, in the right camera's frame), everything else eliminated.
struct AlignmentEquations {
  std::array<double, 9> information{};  ///< 3×3, row-major
  std::array<double, 3> right{};
};

struct AlignmentOptions {
  /// Errors repeat from pair to pair: so much of a pair's information is new.
  double independent_fraction = 0.05;
  /// Less than 30 pairs are an accident.
  std::int64_t min_pairs = 30;
  /// Squared and normalised, 3 degrees of freedom: 1 in 10 million by chance.
  double significance = 35.0;
  /// Below it, a twentieth of a pixel, there is nothing to mend.
  double min_rotation_rad = 0.00015;
  /// Beyond it the device is broken, or the calibration is another one's.
  double max_rotation_rad = 0.01;
};

/// How the cameras seem to be turned against each other.
struct StereoAlignment {
  Vec3 rotation_rad{};  ///< of the right camera, in its frame, against the reported calibration
  Vec3 sd_rad{};
  std::int64_t pairs = 0;
  bool significant = false;
  bool within_bounds = true;
  bool applied = false;  ///< poses take it into account
};

/// Adds up pairs.
class AlignmentEstimator {
 public:
  AlignmentEstimator() = default;
  explicit AlignmentEstimator(const AlignmentOptions& options) : options_(options) {}

  void add(const AlignmentEquations& pair);
  /// Nothing before the first pair, or while a direction is not determined at all.
  [[nodiscard]] std::optional<StereoAlignment> estimate() const;
  /// Begins anew; what was found so far has been applied.
  void restart();

 private:
  AlignmentOptions options_;
  std::array<double, 9> information_{};
  std::array<double, 3> right_{};
  std::int64_t pairs_ = 0;
};

}  // namespace orthonav::nav
