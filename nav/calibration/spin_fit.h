#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "base/transform.h"

namespace orthonav::nav {

/// The axis about which some poses turn, in the marker's frame and in the world's.
struct SpinFit {
  Vec3 axis_in_marker;  ///< unit
  Vec3 axis_in_world;   ///< unit
  double spread = 0.0;  ///< as `SpinCalibration::spread`
  double wobble_rad = 0.0;
  double axis_sigma_rad = 0.0;  ///< predicted from wobble and spread

  [[nodiscard]] double miss_rad(const Transform<World, Marker>& pose) const;
};

/// Fits the poses with these indices; empty if they do not turn.
[[nodiscard]] std::optional<SpinFit> fit_spin(std::span<const Transform<World, Marker>> poses,
                                              std::span<const std::size_t> chosen);

/// From the line about which these poses turn to `tip`, in the marker's frame, at right angles to
/// the axis.
[[nodiscard]] Vec3 beside_axis_m(std::span<const Transform<World, Marker>> poses,
                                 std::span<const std::size_t> chosen, const SpinFit& fit,
                                 Point<Marker> tip);

}  // namespace orthonav::nav
