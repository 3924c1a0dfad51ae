#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/transform.h"
#include "nav/geometry/closest_grid.h"
#include "nav/geometry/mesh.h"
#include "nav/geometry/principal_axes.h"
#include "nav/registration/findings.h"
#include "nav/registration/model_error.h"
#include "nav/registration/pose_search.h"
#include "nav/registration/tre.h"

namespace orthonav::nav {

/// Raise this with every change that prepares the same mesh differently: stored preparations
/// (engine/case/model_cache.h) are then made again. A test checks it against the figures of a known
/// bone.
inline constexpr std::uint32_t kPreparationVersion = 2;

/// The parts of a vertebra's preparation that are slow to compute, as plain numbers that can be
/// stored.
struct PreparedParts {
  std::vector<std::uint32_t> reachable;  ///< faces, ascending
  std::vector<Vec3> closest_m;           ///< of `reachable_grid`
  std::vector<float> distance_m;         ///< of `search_field`
};

/// The preoperative vertebra, prepared once: its mesh (frame Vertebra: LPS axes, metres), the part
/// a pointer can reach from behind, and their indices. Of any other bone the whole surface counts
/// as reachable.
class VertebraModel {
 public:
  static Result<std::shared_ptr<const VertebraModel>> prepare(TriangleMesh mesh,
                                                              Bone bone = Bone::kVertebra);
  /// The same, but faster, from the parts of an earlier preparation of this mesh. Refuses parts of
  /// another mesh, judged by their counts and a hundred or so samples: enough against mix-ups, not
  /// against malice. Parts with wrong numbers never cause a crash.
  static Result<std::shared_ptr<const VertebraModel>> restore(TriangleMesh mesh,
                                                              PreparedParts parts);
  [[nodiscard]] PreparedParts parts() const;

  [[nodiscard]] Bone bone() const { return bone_; }
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] const SurfaceIndex& surface() const { return surface_; }
  /// The posterior part: what is left after trimming what a pointer can't reach.
  [[nodiscard]] const TriangleMesh& reachable() const { return reachable_; }
  [[nodiscard]] const SurfaceIndex& reachable_surface() const { return reachable_surface_; }
  /// Its faces in `mesh()`, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& reachable_faces() const {
    return reachable_faces_;
  }
  /// Approximate closest points by fast look-up.
  [[nodiscard]] const ClosestGrid& reachable_grid() const { return reachable_grid_; }
  /// Principal axes of the reachable surface, by area.
  [[nodiscard]] const PrincipalAxes& reachable_axes() const { return reachable_axes_; }
  /// For the search of every pose.
  [[nodiscard]] const SearchField& search_field() const { return search_field_; }

 private:
  struct Surfaces;
  VertebraModel(Bone bone, Surfaces surfaces, ClosestGrid grid, SearchField field);
  Bone bone_;
  TriangleMesh mesh_;
  std::vector<std::uint32_t> reachable_faces_;
  TriangleMesh reachable_;
  SurfaceIndex surface_;
  SurfaceIndex reachable_surface_;
  ClosestGrid reachable_grid_;
  PrincipalAxes reachable_axes_;
  SearchField search_field_;
};

/// Another vertebra of the patient, to which the strokes might belong.
struct NeighbourLevel {
  std::string label;
  const VertebraModel* model = nullptr;
};

/// How high the tip was above the bone, at one place.
struct EstimatedHeight {
  Point<Vertebra> at;
  double height_m = 0.0;
};

struct PoseSearchRegistrationOptions {
  std::size_t min_points = 100;
  /// Where the pose must be certain: the plan's entries and targets. If empty, places where screws
  /// usually go are used, or the ends of another bone than a vertebra.
  std::vector<Point<Vertebra>> targets;
  /// A larger error at any of them makes the pose wrong, and so does a bone that is off the model's
  /// size by more than this.
  double max_tre_99_m = 0.002;
  double max_size_off = 0.015;
  double tip_radius_m = 0.0;  ///< of the ball at the pointer's end
  /// SD over the bone by which the model is known to differ from it, at least: the heights of the
  /// strokes may show less by chance.
  double least_model_sd_m = 0.0;
  /// When each point was measured, ascending. Empty: not known.
  std::vector<double> times_s;
  /// From the tip back along the pointer's shaft, unit vectors in World: there can be no bone where
  /// the shaft was. Empty: not known.
  std::vector<Vec3> shafts;
  std::vector<NeighbourLevel> neighbours;
  CommonErrors common;
};

/// What a registration is held against beside the probability that it is wrong: what the prior
/// predicts less than once in a thousand, and the log-likelihood ratios from which another pose, or
/// the mirror image, takes 1 % of the probability.
struct RegistrationLimits {
  double noise_m = 0.0;                   ///< most
  double inlier_fraction = 0.0;           ///< least
  double shaft_collision_fraction = 0.0;  ///< most
  double log_likelihood_ratio = 0.0;      ///< least
  double mirror_log_likelihood = 0.0;     ///< most
};
[[nodiscard]] RegistrationLimits registration_limits();

/// The result of a registration. If `accepted` is false, `reasons` says why, and it must not be
/// used for guidance.
struct Registration {
  bool accepted = false;
  std::vector<RefusalReason> reasons;
  /// Refused only because of the error at the screws, which pressing places on the bone can reduce
  /// (nav/registration/pressed_places.h).
  bool provisional = false;
  Transform<World, Vertebra> world_from_vertebra;
  double rmse_m = 0.0;
  double runner_up_rmse_m = 0.0;
  Transform<World, Vertebra> runner_up;
  int iterations = 0;
  std::size_t points = 0;
  /// The remaining uncertainty, including common errors; absent if a motion is undetermined.
  std::optional<PoseUncertainty> uncertainty;
  /// Root mean square error to expect from the registration alone, at the worst target. Infinite if
  /// a motion is undetermined, and with `paper`, which predicts none.
  double predicted_tre_m = 0.0;

  // Reported by `best` only; zero or empty with `paper`.
  double tre_95_m = 0.0;  ///< the error that 95 of 100 stay below, at the worst target
  double tre_99_m = 0.0;
  CommonErrors common;                ///< included in `uncertainty`, and nowhere else
  double noise_m = 0.0;               ///< SD of the points about the surface, without outliers
  double standoff_m = 0.0;            ///< mean height of the tip above the bone; 0 if not certain
  double inlier_fraction = 0.0;       ///< of the points
  double effective_points = 0.0;      ///< number of independent points with the same information
  double log_likelihood_ratio = 0.0;  ///< against the runner-up
  double coverage_fraction = 0.0;     ///< of the reachable surface
  double shaft_collision_fraction = 0.0;  ///< of the points whose pointer would have gone through
                                          ///< bone
  /// The least certain motion, and the part of the bone where strokes would help most.
  std::optional<UncertainMotion> weakest;
  std::optional<BonePlace> stroke_next;
  Point<Vertebra> stroke_next_at;  ///< if there is one
  /// SD over the bone of the tip's height: soft tissue, or a model that is not quite the bone.
  double field_sd_m = 0.0;
  std::vector<EstimatedHeight> heights;  ///< of the tip along the strokes, without noise
  ModelShare model_share;                ///< in the pose, without common errors
  /// Correlation of the heights of neighbouring places on different strokes: about 0 over bare
  /// bone.
  double correlation_across_strokes = 0.0;
  double size = 1.0;  ///< of the bone relative to the model, from the points
  double size_sd = 0.0;
  double mirror_log_likelihood = 0.0;  ///< of the mirror image, relative to the model itself
  std::size_t levels_compared = 0;     ///< number of other levels of the patient that were tried
  std::string fits_better;  ///< label of a neighbouring level that fits the points as well or
                            ///< better
};

/// Whether only the error at the screws speaks against it, and is small enough that pressing places
/// on the bone can reduce it.
[[nodiscard]] bool is_provisional(const Registration& registration);

/// Searches all poses, and weighs them against each other and against other explanations of the
/// points by one posterior (docs/registration.md). Accepted only if the pose is wrong with a
/// probability of at most 1 %. `points_in_world` must be in the order of time.
Result<Registration> register_by_pose_search(const VertebraModel& model,
                                             std::span<const Point<World>> points_in_world,
                                             const PoseSearchRegistrationOptions& options = {});

/// Refuses points that can't be registered at all: too few, not finite, spread too widely, on a
/// line.
Status validate_points(std::span<const Point<World>> points, std::size_t min_points,
                       Bone bone = Bone::kVertebra);

}  // namespace orthonav::nav
