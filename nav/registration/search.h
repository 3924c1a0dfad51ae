#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "base/transform.h"
#include "nav/registration/vertebra_model.h"

namespace orthonav::nav {

// Where the points may lie: every pose in the distance field, coarsely, then the best of them on
// the surface itself.

/// Vertebra from points about their centre: the position of the centre, and the rotation.
struct CentredPose {
  Mat3 rotation = Mat3::identity();
  Vec3 centre_m;
};

/// The pose of the vertebra in the frame of the points, whose centre is given.
[[nodiscard]] Transform<World, Vertebra> world_from(const CentredPose& pose, Vec3 points_centre_m);
[[nodiscard]] CentredPose centred(const Transform<World, Vertebra>& pose, Vec3 points_centre_m);

/// A pose that fits, and the mean cost of its points there (m²; squared distances, truncated).
struct FoundPose {
  Transform<World, Vertebra> world_from_vertebra;
  double cost_m2 = 0.0;
};

struct PoseSearchOptions {
  std::size_t most = 8;  ///< poses to return
  /// Two poses closer than both of these count as one.
  double same_m = 0.003;
  double same_rad = 0.1;
  double tip_radius_m = 0.0;
};

/// The poses at which the points could lie on the surface, the best first. Every orientation (a
/// low-discrepancy set, 12° apart on average; Alexa 2022, "Super-Fibonacci spirals") and every
/// place is examined coarsely; thousands are then refined in the field by robust Gauss-Newton
/// steps. Needs no start, no prior and no axis of the strokes.
[[nodiscard]] std::vector<FoundPose> search_poses(const SearchField& vertebra,
                                                  std::span<const Vec3> points_in_world_m,
                                                  const PoseSearchOptions& options = {});

struct SurfaceFitOptions {
  int max_iterations = 12;
  double last_step_m = 1e-5;  ///< a shorter step ends the fit
  double farthest_m = 0.005;  ///< points farther off count as this far and move nothing
  double tip_radius_m = 0.0;  ///< of the ball at the pointer's end; the points are its centre
  /// Whether a mean height of the tip above the bone (soft tissue, a light hand) is one of the
  /// unknowns: surfaces that face different ways distinguish it from a translation.
  bool with_standoff = false;
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

/// Two poses that put every target within this distance count as the same.
inline constexpr double kSameAtTargets_m = 0.002;

/// Digitized points for the search.
struct Cloud {
  std::vector<Vec3> in_world_m;
  std::vector<Vec3> few_m;  ///< about the centre: a subset, enough to tell candidates apart
  Vec3 centre_m;            ///< in World
};
[[nodiscard]] Cloud cloud_of(std::span<const Point<World>> points);

/// How far apart two poses put the farthest of the targets.
[[nodiscard]] double apart_m(const Transform<World, Vertebra>& a,
                             const Transform<World, Vertebra>& b,
                             std::span<const Point<Vertebra>> targets);

/// Fits points to the reachable surface; finds `SurfaceFitOptions::near_m` itself.
[[nodiscard]] std::optional<SurfaceFit> fit_to_bone(const VertebraModel& model,
                                                    std::span<const Vec3> points_m,
                                                    const CentredPose& start,
                                                    SurfaceFitOptions options);

struct Candidate {
  SurfaceFit fit;
  double cost_m2 = 0.0;  ///< mean squared distance, truncated at some SDs of the noise
};

/// Every pose that could explain the points, each fitted to `few_m`, the best first. If targets are
/// given, the search continues until one candidate differs from the first one at the targets.
[[nodiscard]] std::vector<Candidate> find_candidates(const VertebraModel& model, const Cloud& cloud,
                                                     std::span<const Point<Vertebra>> targets,
                                                     double tip_radius_m);

}  // namespace orthonav::nav
