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
#include "nav/registration/findings.h"
#include "nav/registration/pose_search.h"
#include "nav/registration/principal_axes.h"
#include "nav/registration/tre.h"

namespace orthonav::nav {

/// Raise it with every change after which the same mesh is prepared otherwise: what was kept of
/// earlier preparations (engine/case/model_cache.h) is then made anew. A test holds it against the
/// figures of a known bone.
inline constexpr std::uint32_t kPreparationVersion = 1;

/// What is slow to make of a vertebra, as plain numbers that can be kept.
struct PreparedParts {
  std::vector<std::uint32_t> reachable;  ///< faces, ascending
  std::vector<Vec3> closest_m;           ///< of `reachable_grid`
  std::vector<float> distance_m;         ///< of `search_field`
};

/// The preoperative vertebra, prepared once: its mesh (frame Vertebra: LPS axes, metres), the part
/// a pointer can reach from behind, and their indices.
class VertebraModel {
 public:
  static Result<std::shared_ptr<const VertebraModel>> prepare(TriangleMesh mesh);
  /// The same, sooner, from the parts that an earlier preparation of this mesh gave. Refuses parts
  /// that are not this mesh's as far as their counts and some hundred samples tell: enough against
  /// mix-ups, not against malice. Parts with wrong numbers never crash.
  static Result<std::shared_ptr<const VertebraModel>> restore(TriangleMesh mesh,
                                                              PreparedParts parts);
  [[nodiscard]] PreparedParts parts() const;

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] const SurfaceIndex& surface() const { return surface_; }
  /// The posterior part: what is left after trimming what a pointer can't reach.
  [[nodiscard]] const TriangleMesh& reachable() const { return reachable_; }
  [[nodiscard]] const SurfaceIndex& reachable_surface() const { return reachable_surface_; }
  /// Its faces in `mesh()`, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& reachable_faces() const {
    return reachable_faces_;
  }
  /// Its closest points, roughly and fast.
  [[nodiscard]] const ClosestGrid& reachable_grid() const { return reachable_grid_; }
  /// Principal axes of the reachable surface (by area) and its extreme points along them.
  [[nodiscard]] const PrincipalAxes& reachable_axes() const { return reachable_axes_; }
  [[nodiscard]] const std::array<Vec3, 6>& reachable_extremes() const { return extremes_; }
  /// For the search of every pose.
  [[nodiscard]] const SearchField& search_field() const { return search_field_; }

 private:
  struct Surfaces;
  VertebraModel(Surfaces surfaces, ClosestGrid grid, SearchField field);
  TriangleMesh mesh_;
  std::vector<std::uint32_t> reachable_faces_;
  TriangleMesh reachable_;
  SurfaceIndex surface_;
  SurfaceIndex reachable_surface_;
  ClosestGrid reachable_grid_;
  PrincipalAxes reachable_axes_;
  std::array<Vec3, 6> extremes_;
  SearchField search_field_;
};

struct RegistrationOptions {
  std::size_t min_points = 100;
  int max_iterations = 200;
  double converged_m = 1e-8;  ///< change of the RMSE that ends ICP; it creeps towards its end
  double max_rmse_m = 0.003;  ///< above: refused
  /// Runner-up RMSE / RMSE that is still taken. With full strokes a wrong pose fits at least twice
  /// as badly; where two fit alike, the strokes don't tell.
  double min_runner_up_ratio = 1.25;
  /// Error to expect at the model's centre (nav/registration/tre.h); above: refused.
  double max_predicted_tre_m = 0.003;
};

/// Another vertebra of the patient, which the strokes might belong to.
struct NeighbourLevel {
  std::string label;
  const VertebraModel* model = nullptr;
};

/// How high the tip stood above the bone, at one place.
struct EstimatedHeight {
  Point<Vertebra> at;
  double height_m = 0.0;
};

struct PoseSearchRegistrationOptions {
  std::size_t min_points = 100;
  /// Where the pose must be sure: the plan's entries and targets. Without any, places where screws
  /// usually go are taken.
  std::vector<Point<Vertebra>> targets;
  /// Root mean square error to expect at the worst of them; above: refused.
  double max_predicted_tre_m = 0.0015;
  /// What 99 of 100 errors are below, at the worst of them; above: refused.
  double max_tre_99_m = 0.002;
  /// By how much another pose must explain the points worse (log-likelihood ratio).
  double min_log_likelihood_ratio = 12.0;
  double max_noise_m = 0.0016;          ///< SD of the points about the surface
  double min_inlier_fraction = 0.7;     ///< of the points that lie on the surface within the noise
  double min_coverage_fraction = 0.10;  ///< of the reachable surface within 5 mm of a point
  double tip_radius_m = 0.0;            ///< of a ball at the pointer's end
  /// How exactly each point was tracked (SD along an axis): those known better count for more.
  /// Empty: all alike.
  std::vector<double> point_sd_m;
  /// From the tip back along the pointer's shaft, unit vectors in World: where it was is no bone.
  /// Empty: not known.
  std::vector<Vec3> shafts;
  double max_shaft_collision_fraction = 0.15;  ///< of the points whose shaft would go through bone
  std::vector<NeighbourLevel> neighbours;
  CommonErrors common;
  /// By how much (natural logarithm) the model's mirror image may explain the points better; and
  /// how far off the model's size may be.
  double max_mirror_log_likelihood = 4.0;
  double max_size_off = 0.015;
};

/// What registration says. `accepted` false: `reasons` tells why, nothing may be guided on it.
struct Registration {
  bool accepted = false;
  std::vector<RefusalReason> reasons;
  /// Refused, but for the error at the screws only: places pressed to the bone can take it away
  /// (nav/registration/pressed_places.h).
  bool provisional = false;
  Transform<World, Vertebra> world_from_vertebra;
  double rmse_m = 0.0;
  double runner_up_rmse_m = 0.0;
  Transform<World, Vertebra> runner_up;
  int iterations = 0;
  std::size_t points = 0;
  /// What the points leave open, with the errors in common; absent when a whole motion is.
  std::optional<PoseUncertainty> uncertainty;
  /// Root mean square error to expect, `paper` at the centre of the model, `best` at the worst
  /// target; of the registration alone. Infinite when a motion is open.
  double predicted_tre_m = 0.0;

  // What `best` says besides; zero and empty with `paper`.
  double tre_95_m = 0.0;  ///< what 95 of 100 errors are below, at the worst target
  double tre_99_m = 0.0;
  CommonErrors common;            ///< that are in `uncertainty`, and nowhere else
  double noise_m = 0.0;           ///< SD of the points about the surface, outliers left aside
  double standoff_m = 0.0;        ///< mean height of the tip above the bone; 0 where not certain
  double inlier_fraction = 0.0;   ///< of the points
  double effective_points = 0.0;  ///< independent ones that would tell as much
  double log_likelihood_ratio = 0.0;  ///< against the runner-up
  double coverage_fraction = 0.0;     ///< of the reachable surface
  double shaft_collision_fraction =
      0.0;  ///< of the points whose pointer would have gone through bone
  /// The motion known worst, and the part of the bone whose strokes would tell most.
  std::optional<UncertainMotion> weakest;
  std::optional<BonePlace> stroke_next;
  Point<Vertebra> stroke_next_at;  ///< where there is one
  /// SD over the bone of the tip's height: soft tissue, or a model that is not quite the bone.
  double field_sd_m = 0.0;
  std::vector<EstimatedHeight> heights;  ///< of the tip along the strokes, noise left out
  /// Of the heights of places beside each other on different strokes: about 0 over bare bone.
  double correlation_across_strokes = 0.0;
  double size = 1.0;  ///< of the bone, as the points say; that of the model is 1
  double size_sd = 0.0;
  double mirror_log_likelihood = 0.0;  ///< of the mirror image, against the model as it is
  std::size_t levels_compared = 0;  ///< other levels of the patient that the points were tried on
  std::string fits_better;  ///< label of a neighbouring level that the points fit as well or better
};

/// The published method: PCA extreme points (paper eq. 1) give the coarse poses, of which the two
/// best configurations remain (nav/registration/coarse.h says where it goes further than eq. 2),
/// ICP (Besl & McKay 1992) refines both on the reachable surface, the smaller RMSE wins. An Error
/// means unusable input (too few, collinear, non-finite points).
Result<Registration> register_by_principal_axes(const VertebraModel& model,
                                                std::span<const Point<World>> points_in_world,
                                                const RegistrationOptions& options = {});

/// Every pose is searched for, the best ones are fitted exactly and robustly
/// (docs/registration.md). Accepted only when nothing else explains the points, the error to expect
/// at every target is small, and no neighbouring level fits as well. `points_in_world` in the order
/// of time.
Result<Registration> register_by_pose_search(const VertebraModel& model,
                                             std::span<const Point<World>> points_in_world,
                                             const PoseSearchRegistrationOptions& options = {});

/// What keeps points from being registered at all: too few, not finite, all over the place, a line.
Status validate_points(std::span<const Point<World>> points, std::size_t min_points);
/// What is wrong with standard deviations that shall be theirs; none are fine.
Status check_point_sds(std::span<const double> sd_m, std::size_t points);

}  // namespace orthonav::nav
