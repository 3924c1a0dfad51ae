#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/vec.h"
#include "hal/api/devices.h"

namespace orthonav::nav {

/// What one pair says about a small rotation of the right camera relative to its reported pose: the
/// equations of the rotation vector (rad, in the right camera's frame), everything else eliminated.
struct AlignmentEquations {
  std::array<double, 9> information{};  ///< 3×3, row-major
  std::array<double, 3> right{};
};

struct AlignmentOptions {
  /// Errors repeat from pair to pair: only this fraction of a pair's information is new.
  double independent_fraction = 0.05;
  /// Fewer pairs may agree by accident.
  std::int64_t min_pairs = 30;
  /// Squared and normalised, 3 degrees of freedom: 1 in 10 million by chance.
  double significance = 35.0;
  /// A smaller rotation, a twentieth of a pixel, needs no correction.
  double min_rotation_rad = 0.00015;
  /// With a larger one the device is broken, or the calibration belongs to another one.
  double max_rotation_rad = 0.01;
};

/// How the cameras appear to be rotated relative to each other.
struct StereoAlignment {
  Vec3 rotation_rad{};  ///< of the right camera, in its frame, relative to the reported calibration
  Vec3 sd_rad{};
  std::int64_t pairs = 0;
  bool significant = false;
  bool within_bounds = true;
  bool applied = false;  ///< poses take it into account
};

/// Accumulates pairs.
class AlignmentEstimator {
 public:
  AlignmentEstimator() = default;
  explicit AlignmentEstimator(const AlignmentOptions& options) : options_(options) {}

  void add(const AlignmentEquations& pair);
  /// Nothing before the first pair, or while a direction is undetermined.
  [[nodiscard]] std::optional<StereoAlignment> estimate() const;
  /// Starts over; what was found so far has been applied.
  void restart();

 private:
  AlignmentOptions options_;
  std::array<double, 9> information_{};
  std::array<double, 3> right_{};
  std::int64_t pairs_ = 0;
};

/// The rotation (rad) by which the right camera is to be turned now; nothing while the estimate is
/// not certain, or so large that the device is broken. `applied`, the sum of those taken so far,
/// then includes it, and the estimator starts over.
[[nodiscard]] std::optional<Vec3> take_correction(AlignmentEstimator& aligning,
                                                  std::optional<StereoAlignment>& applied);

/// Turns the right camera by a rotation vector (rad) in its own frame.
void turn_right_camera(StereoCalibration& calibration, Vec3 rotation_rad);

}  // namespace orthonav::nav
