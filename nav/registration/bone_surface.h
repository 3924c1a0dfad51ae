#pragma once

#include <optional>

#include "nav/registration/vertebra_model.h"

namespace orthonav::nav::posterior {

/// The bone as the tip meets it: the whole surface of a model, with the sign from its solid. A
/// mirrored one is the model with left and right (x) swapped.
class BoneSurface {
 public:
  explicit BoneSurface(const VertebraModel& model, bool mirrored = false);

  struct Place {
    double distance_m = 0.0;  ///< outside positive, true inside too
    Vec3 out;                 ///< unit, away from the bone: the distance's gradient
    Vec3 nearest_m;
  };
  /// The nearest place of the surface.
  [[nodiscard]] Place at(Vec3 query_m) const;
  /// The same, sooner, where the nearest place is known to be near `hint_m`, which lies on the
  /// surface.
  [[nodiscard]] Place near(Vec3 query_m, Vec3 hint_m) const;

  /// How far above the bone, on average, a circle of this radius lies in the plane that touches it
  /// at a place; `out`: unit, away from the bone there. Negative in a valley.
  [[nodiscard]] double mean_height_around_m(Vec3 place_m, Vec3 out, double aside_m) const;
  /// The sum of the two principal curvatures about a place of the surface, convex positive, as seen
  /// from points that lie `aside_m` beside it; `out`: unit, away from the bone there.
  [[nodiscard]] double curvature_1_m(Vec3 place_m, Vec3 out, double aside_m) const;

 private:
  [[nodiscard]] std::optional<Place> within(Vec3 query_m, double within_m) const;
  const VertebraModel* model_;
  double side_ = 1.0;
};

}  // namespace orthonav::nav::posterior
