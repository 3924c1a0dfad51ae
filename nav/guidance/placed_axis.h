#pragma once

#include <array>

#include "nav/guidance/anatomical_deviation.h"

namespace orthonav::nav {

/// SDs of an axis measured with a sleeve, in addition to those of the sleeve's pose: of its
/// direction, about each axis across it, and of its tip, along each axis.
struct SleeveErrors {
  double axis_rad = 0.0;
  double tip_m = 0.0;
};

/// A placed wire, measured by a sleeve that was put over it. How far along the wire the sleeve sits
/// is unknown, so this is a line without a position along it.
struct PlacedAxis {
  Axis<Vertebra> line;     ///< unit into the bone; its point is the nearest to the planned entry
  NumberWithSd angle_rad;  ///< between the line and the planned trajectory, [0, pi]
  NumberWithSd entry_m;    ///< of the line from the planned entry
  /// 3x3 by rows, of the errors of that point (m²) and of the direction as a rotation vector
  /// (rad²).
  std::array<double, 9> point_covariance_m2{};
  std::array<double, 9> direction_covariance_rad2{};
};

/// `sleeve` is its tip and its unit direction into the bone, `pose` the uncertainty of its pose
/// relative to the bone, as `with_tool` gives it. To first order: an error of the direction about
/// the tip moves the entry in proportion to the distance between them. If the line lies on the
/// plan, the SDs are averages over directions, since no direction stands out. The plan's entry and
/// target must differ.
[[nodiscard]] PlacedAxis placed_axis(const ScrewPlan& plan, const Axis<Vertebra>& sleeve,
                                     const PoseUncertainty& pose, const SleeveErrors& errors);

}  // namespace orthonav::nav
