#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "nav/guidance/screw.h"
#include "nav/registration/tre.h"

namespace orthonav::nav {

/// Where a screw's tool went, as it was tracked: not where the screw lies, for a wire bends after
/// it was tracked.
struct ExecutedTrajectory {
  /// Unit into the bone; its point lies in the plane through the planned entry across the planned
  /// axis.
  Axis<Vertebra> axis;
  double depth_m = 0.0;   ///< mean, of the tip past the planned entry along the planned axis
  std::size_t pairs = 0;  ///< that it is the mean of
  /// 3x3 by rows, of the errors of the axis's point (m²) and of its direction as a rotation vector
  /// (rad²); absent where nobody knows the pose's. The registration's and the tool's own errors
  /// stay the same from pair to pair, so that a mean does not lessen them; scatter is added to them
  /// as it is left in a mean.
  std::optional<std::array<double, 9>> point_covariance_m2;
  std::optional<std::array<double, 9>> direction_covariance_rad2;
};

/// Averages what is measured at depth: within a millimetre of the deepest, until the tool is drawn
/// back. Allocates nothing.
class TrajectoryAtDepth {
 public:
  static constexpr double kAtDepth_m = 0.001;

  /// A tool on its way along the plan, in a pair in which it was measured: its tip and its unit
  /// direction into the bone. `uncertainty` of its pose relative to the bone, or null. One that
  /// runs across the plan is left out.
  void add(const ScrewPlan& plan, const Axis<Vertebra>& tool, const PoseUncertainty* uncertainty);
  void forget() { *this = {}; }
  /// None before the first.
  [[nodiscard]] std::optional<ExecutedTrajectory> mean() const;

 private:
  using Sums = std::array<double, 9>;

  std::size_t pairs_ = 0;
  double first_depth_m_ = 0.0;
  double depths_m_ = 0.0;
  // Sums from the first pair on, and of the squares of what differs from it.
  Vec3 first_point_m_;
  Vec3 first_direction_;
  Vec3 points_m_;
  Vec3 directions_;
  Sums point_squares_{};
  Sums direction_squares_{};
  std::optional<PoseUncertainty> uncertainty_;  ///< newest
};

}  // namespace orthonav::nav
