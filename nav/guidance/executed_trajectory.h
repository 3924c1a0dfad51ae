#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "nav/guidance/screw.h"
#include "nav/registration/tre.h"

namespace orthonav::nav {

/// Where a screw's tool went, as tracked. It is not where the screw lies: a wire may bend after it
/// was tracked.
struct ExecutedTrajectory {
  /// Unit direction into the bone; its point lies in the plane through the planned entry
  /// perpendicular to the planned axis.
  Axis<Vertebra> axis;
  double depth_m = 0.0;   ///< mean, of the tip past the planned entry along the planned axis
  std::size_t pairs = 0;  ///< averaged
  /// 3x3 by rows, of the errors of the axis's point (m²) and of its direction as a rotation vector
  /// (rad²); absent if the pose's covariance is unknown. Errors of the registration and of the tool
  /// itself are the same in every pair, so averaging does not reduce them; the scatter between
  /// pairs is added as the SD of a mean.
  std::optional<std::array<double, 9>> point_covariance_m2;
  std::optional<std::array<double, 9>> direction_covariance_rad2;
};

/// Averages the measurements at depth: within a millimetre of the deepest, until the tool is drawn
/// back. Allocates nothing.
class TrajectoryAtDepth {
 public:
  static constexpr double kAtDepth_m = 0.001;

  /// Adds the tool in a pair in which it was measured: its tip and its unit direction into the
  /// bone. `uncertainty` is that of its pose relative to the bone, or null. A tool perpendicular to
  /// the plan is left out.
  void add(const ScrewPlan& plan, const Axis<Vertebra>& tool, const PoseUncertainty* uncertainty);
  void forget() { *this = {}; }
  /// Empty before the first.
  [[nodiscard]] std::optional<ExecutedTrajectory> mean() const;

 private:
  using Sums = std::array<double, 9>;

  std::size_t pairs_ = 0;
  double first_depth_m_ = 0.0;
  double depths_m_ = 0.0;
  // Sums, relative to the first pair, of the differences and of their squares.
  Vec3 first_point_m_;
  Vec3 first_direction_;
  Vec3 points_m_;
  Vec3 directions_;
  Sums point_squares_{};
  Sums direction_squares_{};
  std::optional<PoseUncertainty> uncertainty_;  ///< newest
};

}  // namespace orthonav::nav
