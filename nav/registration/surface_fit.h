#pragma once

#include <optional>
#include <span>
#include <vector>

#include "nav/registration/surface_step.h"

namespace orthonav::nav {

struct SurfaceFitOptions {
  int max_iterations = 12;
  double last_step_m = 1e-5;  ///< a shorter step ends the fit
  double farthest_m = 0.005;  ///< points farther off count as this far and move nothing
  double tip_radius_m = 0.0;  ///< of the ball at the pointer's end; the points are its centre
  /// Whether a mean height of the tip above the bone (soft tissue, a light hand) is one of the
  /// unknowns: surfaces that face different ways distinguish it from a translation.
  bool with_standoff = false;
  double first_standoff_m = 0.0;  ///< starting value; fixed if it is not an unknown
  /// For each point, any place on the surface, which limits the first search. Only saves time.
  /// Empty: none known.
  std::span<const Vec3> near_m{};
  /// Limits of the assumed SD of the residuals.
  double least_noise_m = 0.00015;
  double most_noise_m = 0.002;
};

/// One point at the fitted pose.
struct FittedPoint {
  Vec3 lever_arm_m;         ///< from the points' centre, in the vertebra's frame
  Vec3 gradient;            ///< of the residual by the point's position
  Vec3 nearest_m;           ///< on the surface
  double residual_m = 0.0;  ///< outside the surface positive
  double weight = 0.0;      ///< robust, in [0, 1]
};

struct SurfaceFit {
  CentredPose pose;
  bool with_standoff = false;
  double standoff_m = 0.0;  ///< residuals are measured from it
  double noise_m = 0.0;     ///< SD of the residuals without outliers
  int iterations = 0;
  std::vector<FittedPoint> points;  ///< in the order given
};

/// The pose at which the points lie on the surface itself, with nearest points searched for exactly
/// and weights by Tukey's biweight, whose width follows the residuals' own spread. The start must
/// be within a few millimetres. `points_m` are about their centre. Nothing when the pose is
/// undetermined.
[[nodiscard]] std::optional<SurfaceFit> fit_to_surface(const SurfaceIndex& surface,
                                                       std::span<const Vec3> points_m,
                                                       const CentredPose& start,
                                                       const SurfaceFitOptions& options);

/// Mean squared residual, truncated at `width_m`; outliers count as that.
[[nodiscard]] double truncated_cost_m2(const SurfaceFit& fit, double width_m);

}  // namespace orthonav::nav
