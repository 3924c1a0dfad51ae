#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/transform.h"
#include "nav/registration/findings.h"
#include "nav/registration/model_error.h"
#include "nav/registration/tre.h"
#include "nav/registration/vertebra_model.h"

namespace orthonav::nav {

/// Another vertebra of the patient, to which the strokes might belong.
struct NeighbourLevel {
  std::string label;
  const VertebraModel* model = nullptr;
};

struct PoseSearchRegistrationOptions {
  /// Where the pose must be certain: the plan's entries and targets. If empty, places where screws
  /// usually go are used, or the ends of another bone than a vertebra.
  std::vector<Point<Vertebra>> targets;
  /// A larger error at any of them makes the pose wrong.
  double max_tre_99_m = 0.002;
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
/// By the default prior.
[[nodiscard]] RegistrationLimits registration_limits();

/// The result of a registration. If `accepted` is false, `reasons` says why, and it must not be
/// used for guidance.
struct Registration {
  bool accepted = false;
  std::vector<RefusalReason> reasons;
  /// Refused only because of the error at the screws, which pressing places on the bone can reduce
  /// (nav/registration/presses.h).
  bool provisional = false;
  Transform<World, Vertebra> world_from_vertebra;
  double rmse_m = 0.0;
  double runner_up_rmse_m = 0.0;
  Transform<World, Vertebra> runner_up;
  int iterations = 0;
  std::size_t points = 0;
  /// The remaining uncertainty, including common errors; absent with `paper`.
  std::optional<PoseUncertainty> uncertainty;
  /// Root mean square error to expect from the registration alone, at the worst target. Infinite
  /// with `paper`, which predicts none.
  double predicted_tre_m = 0.0;

  // Reported by `best` only; zero or empty with `paper`.
  double tre_95_m = 0.0;  ///< the error that 95 of 100 stay below, at the worst target
  double tre_99_m = 0.0;
  CommonErrors common;                ///< included in `uncertainty`, and nowhere else
  double noise_m = 0.0;               ///< SD of the tip's height at the points, without outliers
  double standoff_m = 0.0;            ///< mean height of the tip above the bone
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

/// Where the pose must be certain: the targets in the options, or, if there are none, where screws
/// usually go, or both ends of another bone along each of its principal axes.
[[nodiscard]] std::vector<Point<Vertebra>> targets_of(const VertebraModel& model,
                                                      const PoseSearchRegistrationOptions& options);

/// Fills in what a pose's uncertainty means at the targets: without common errors, the expected
/// errors, the motion behind them and where strokes would help most; and, with common errors, the
/// total uncertainty.
void put_errors(const VertebraModel& model, const PoseUncertainty& own, const CommonErrors& common,
                std::span<const Point<Vertebra>> targets, Registration& r);

/// A pose search takes no fewer.
inline constexpr std::size_t kFewestPoints = 100;

/// Refuses points that can't be registered at all: too few, not finite, spread too widely, on a
/// line.
Status validate_points(std::span<const Point<World>> points, std::size_t min_points,
                       Bone bone = Bone::kVertebra);

}  // namespace orthonav::nav
