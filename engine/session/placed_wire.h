#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/angle.h"
#include "nav/guidance/placed_axis.h"

namespace orthonav::engine {

/// A placed wire as measured with the guide's sleeve over it
/// (docs/decisions/0066-the-placed-wire-is-measured.md).
struct PlacedWire {
  nav::PlacedAxis axis;
  std::size_t pairs = 0;  ///< averaged for `axis`
  double angle_limit_rad = 0.0;
  double entry_limit_m = 0.0;
  bool kept = false;  ///< by the surgeon's decision, although it is beyond a limit

  [[nodiscard]] bool angle_within() const { return axis.angle_rad.value <= angle_limit_rad; }
  [[nodiscard]] bool entry_within() const { return axis.entry_m.value <= entry_limit_m; }
  [[nodiscard]] bool within() const { return angle_within() && entry_within(); }
  /// It waits for the surgeon's decision.
  [[nodiscard]] bool undecided() const { return !within() && !kept; }
};

/// What counts as a measurement of a wire, and when it is as planned.
struct PlacedWireRules {
  double angle_limit_rad = 2.0 * kRadiansPerDegree;
  double entry_limit_m = 0.002;
  /// A measurement with a larger SD can hardly tell within from beyond a limit: three quarters of
  /// that limit.
  double most_entry_sd_m = 0.0015;
  /// SDs of the guide's axis about each direction across it, and of its tip, after calibration.
  double axis_sd_rad = 0.010;
  double tip_sd_m = 0.0005;
  /// SD of the sleeve's direction relative to the wire in it: 0.25°.
  double play_rad = 0.25 * kRadiansPerDegree;
  /// Diameter of the hole that a wire leaves: another entry is at least this far from its middle.
  double drill_diameter_m = 0.0032;

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// "0.8°, 0.6 mm": how far it is from the plan.
void append_wire(std::string& out, const PlacedWire& wire);

}  // namespace orthonav::engine
