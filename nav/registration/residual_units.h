#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nav/registration/surface_fit.h"

namespace orthonav::nav {

/// The unknowns of a height above the bone: translation and rotation of the points (about their
/// centre), standoff, and model size (natural logarithm).
inline constexpr std::size_t kHeightUnknowns = 8;
inline constexpr std::size_t kStandoffUnknown = 6;
inline constexpr std::size_t kSizeUnknown = 7;

/// A few millimetres of a stroke, whose points count as one.
struct ResidualUnit {
  int stroke = 0;
  std::size_t first = 0;  ///< in `ResidualUnits::order`, and the one after its last
  std::size_t end = 0;
  std::array<Vec3, 2> halves_m;  ///< where its halves lie, from the points' centre
  double weight = 0.0;           ///< sum of its points'
  double height_m = 0.0;         ///< of the tip above the bone, weighted mean
  std::array<double, kHeightUnknowns> derivative{};  ///< of `height_m`, weighted mean
};

/// The points of a fit that lie on the bone, each place only once, along their strokes.
struct ResidualUnits {
  std::vector<ResidualUnit> all;
  std::vector<std::uint32_t> order;  ///< of points
  std::vector<int> stroke;           ///< of each entry of `order`
  /// False if most steps are leaps; a unit then consists of the points in a cell of space.
  bool along_strokes = true;

  [[nodiscard]] std::span<const std::uint32_t> points_of(const ResidualUnit& unit) const {
    return std::span(order).subspan(unit.first, unit.end - unit.first);
  }
};

/// The same points in the same units, with their heights from another fit.
[[nodiscard]] ResidualUnits refilled(const ResidualUnits& units, const SurfaceFit& fit);

/// At most about `most` units. A step of more than 8 mm begins another stroke. Points within 0.05
/// mm of an earlier one add nothing and are left out.
[[nodiscard]] ResidualUnits residual_units(const SurfaceFit& fit, std::size_t most);

}  // namespace orthonav::nav
