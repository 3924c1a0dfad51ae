#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/report/registration_figures.h"

namespace orthonav::engine {

/// A digitized point at the registered pose.
struct PlacedPoint {
  Vec3 place_m;  ///< in the model's frame
  /// Distance to the touchable surface, minus the mean height of the tip above it if that is
  /// certain; negative inside.
  double residual_m = 0.0;
  bool off_bone = false;  ///< farther off than the scatter of the others explains
};

/// The data for drawing a registration, in addition to the model, computed once for all views.
struct RegistrationScene {
  /// At most a few thousand, evenly chosen: a drawing of a million would be no clearer.
  std::vector<PlacedPoint> points;
  std::size_t off_bone = 0;         ///< of those
  std::vector<PlacedPoint> checks;  ///< touched to verify the registration
  /// How far each vertex of the touchable surface is from the nearest stroke on the bone.
  std::vector<double> from_strokes_m;
  /// Height of the tip above each vertex of the touchable surface, from nearby strokes: soft
  /// tissue. NaN where none is near. Empty if there is no evidence of tissue.
  std::vector<double> tissue_m;
  std::optional<Vec3> scrape_m;  ///< the place to press to the bone next
  double full_colour_m = 0.0;    ///< the residual with the last colour
  /// By how much the predicted errors are magnified when drawn.
  double magnified = 1.0;
  bool one_scale = false;  ///< all levels of the report are magnified equally
};

/// Surface within this distance of a stroke counts as stroked.
inline constexpr double kStroked_m = 0.005;

[[nodiscard]] RegistrationScene registration_scene(const RegisteredLevel& level);

/// The magnification that suits each of these levels, so that their ellipsoids can be compared.
[[nodiscard]] double common_magnification(std::span<const RegisteredLevel> levels);

/// Half the longest axis of the 95 % error ellipsoid (normal distribution in space), as a multiple
/// of the standard deviation along it.
[[nodiscard]] double ellipsoid_scale();

}  // namespace orthonav::engine
