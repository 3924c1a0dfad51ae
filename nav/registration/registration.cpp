#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/reason.h"
#include "base/translation.h"
#include "nav/geometry/principal_axes.h"
#include "nav/registration/decision.h"
#include "nav/registration/degeneracy.h"
#include "nav/registration/errors_at_targets.h"
#include "nav/registration/pose_candidates.h"

namespace orthonav::nav {
namespace {

using namespace posterior;

/// Strokes narrower than this (standard deviation) along their second axis are a line.
constexpr double kNarrowest_m = 0.001;
/// Points of one vertebra, and of any other bone, are not farther than this (standard deviation)
/// from their centre.
constexpr double kWidest_m = 0.1;
constexpr double kWidestOfAnyBone_m = 0.3;

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The points against the bone's whole surface at a pose.
struct Fit {
  SurfaceFit touched;   ///< the points' places alone
  double rmse_m = 0.0;  ///< about the mean height of the tip
  /// Of the pose, about the points' centre, by points that each tell of the height with SD 1.
  Matrix6 information = Matrix6::Zero();
};

Fit fit_at(const BoneSurface& bone, const Observations& observations,
           const Transform<World, Vertebra>& world_from_vertebra, Vec3 centre_m,
           double standoff_m) {
  Fit out;
  const auto from_world = world_from_vertebra.inverse();
  double squares_m2 = 0.0;
  for (const StrokePoint& point : observations.strokes) {
    const Vec3 at_m = (from_world * point.tip).v;
    const auto place = bone.near(at_m, bone.place_near(at_m));
    const Vec3 turned = (at_m - centre_m).cross(place.out);
    Eigen::Matrix<double, 6, 1> moves;
    moves << place.out.x, place.out.y, place.out.z, turned.x, turned.y, turned.z;
    out.information += moves * moves.transpose();
    FittedPoint& touched = out.touched.points.emplace_back();
    touched.lever_arm_m = at_m;
    touched.weight = 1.0;
    squares_m2 += std::pow(place.distance_m - observations.tip_radius_m - standoff_m, 2);
  }
  out.rmse_m = std::sqrt(squares_m2 / static_cast<double>(observations.strokes.size()));
  return out;
}

/// How many independent points would leave as much of the pose open.
double effective_points(const Posterior& answer, const Fit& fit) {
  const Matrix6 covariance = Eigen::Map<const Matrix6>(answer.covariance.data());
  const double spread_m2 = answer.hand.spread_m * answer.hand.spread_m;
  const double by_each = std::pow((fit.information * covariance).determinant(), 1.0 / 6.0);
  return by_each > 0.0 ? static_cast<double>(fit.touched.points.size()) * spread_m2 / by_each : 0.0;
}

/// Whether an explanation is of the answer's own width: the targets are where it puts them, about.
bool is_width(const Explanation& e, const Decision& d, std::span<const Point<Vertebra>> targets) {
  return e.kind == Explanation::Kind::kAnswer ||
         (e.kind == Explanation::Kind::kOtherPose &&
          apart_m(e.world_from_vertebra, d.answer.world_from_vertebra, targets) < kSameAtTargets_m);
}

/// What the mixture says against the answer: what it can't predict, then every explanation under
/// which the answer is wrong that takes a good part of the probability of that.
std::vector<RefusalReason> reasons_of(const Decision& d, const Question& question, Bone bone,
                                      const Registration& r) {
  using Kind = RefusalReason::Kind;
  constexpr double kGoodPart = 0.25;
  // A smaller field can't be distinguished from a segmentation's own error.
  constexpr double kUneven_m = 0.0003;
  const RegistrationLimits limits = limits_of(question);
  std::vector<RefusalReason> reasons;
  if (d.accepted) {
    return reasons;
  }
  if (!(d.answer.hand.spread_m <= limits.noise_m)) {
    reasons.push_back({Kind::kNoise, d.answer.hand.spread_m, limits.noise_m});
  }
  if (!(d.inlier_fraction >= limits.inlier_fraction)) {
    reasons.push_back({Kind::kInliers, d.inlier_fraction, limits.inlier_fraction});
  }
  if (!(d.shaft_collision_fraction <= limits.shaft_collision_fraction)) {
    reasons.push_back(
        {Kind::kShaftCollision, d.shaft_collision_fraction, limits.shaft_collision_fraction});
  }
  if (d.wrong <= question.may_be_wrong) {
    return reasons;
  }
  double of_width = 0.0, of_poses = 0.0, of_mirror = 0.0, of_size = 0.0;
  for (const Explanation& e : d.explanations) {
    const double wrong = e.probability * e.wrong;
    switch (e.kind) {
      case Explanation::Kind::kAnswer:
      case Explanation::Kind::kOtherPose:
        (is_width(e, d, question.targets) ? of_width : of_poses) += wrong;
        break;
      case Explanation::Kind::kLevel:
        break;  // `fits_better` says
      case Explanation::Kind::kMirror:
        of_mirror += wrong;
        break;
      case Explanation::Kind::kSize:
        of_size += wrong;
        break;
    }
  }
  const double most = std::max({of_width, of_poses, of_mirror, of_size});
  const auto counts = [&](double wrong) {
    return wrong > question.may_be_wrong || wrong > kGoodPart * most;
  };
  // What the bone is comes first: strokes of another one have other faults too.
  if (counts(of_mirror)) {
    reasons.insert(reasons.begin(),
                   {Kind::kMirrored, r.mirror_log_likelihood, limits.mirror_log_likelihood});
  }
  if (!r.fits_better.empty()) {
    reasons.insert(reasons.begin(), {Kind::kFitsOtherLevel, 0.0, 0.0, {}, r.fits_better});
  }
  if (counts(of_poses)) {
    reasons.push_back(
        {Kind::kLogLikelihoodRatio, r.log_likelihood_ratio, limits.log_likelihood_ratio});
  }
  if (counts(of_size)) {
    reasons.push_back({Kind::kModelSize, r.size, question.size_off});
  }
  if (counts(of_width) || reasons.empty()) {
    reasons.push_back({bone == Bone::kVertebra ? Kind::kTre99AtScrews : Kind::kTre99AtEnds,
                       r.tre_99_m, question.most_m, r.weakest});
    if (d.answer.uneven_m > kUneven_m) {
      reasons.push_back({Kind::kSoftTissue, d.answer.uneven_m, kUneven_m, {}, {}, r.stroke_next});
    }
  }
  return reasons;
}

}  // namespace

bool is_provisional(const Registration& r) {
  using Kind = RefusalReason::Kind;
  // Root mean square error at the screws above which a pose is not good enough for pressed places.
  constexpr double kMaxProvisional_m = 0.004;
  const auto about_error = [](const RefusalReason& reason) {
    return reason.kind == Kind::kTre99AtScrews || reason.kind == Kind::kSoftTissue;
  };
  return !r.reasons.empty() && std::all_of(r.reasons.begin(), r.reasons.end(), about_error) &&
         r.uncertainty && r.predicted_tre_m <= kMaxProvisional_m;
}

RegistrationLimits registration_limits() { return limits_of({}); }

Status validate_points(std::span<const Point<World>> points, std::size_t min_points, Bone bone) {
  const std::size_t fewest = std::max<std::size_t>(min_points, 3);
  if (points.size() < fewest) {
    return refused(
        {translatable("registration has %zu points, needs at least %zu"), {points.size(), fewest}});
  }
  std::vector<Vec3> numbers(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].v.is_finite()) {
      return refused({translatable("registration point %zu is not finite"), {i + 1}});
    }
    numbers[i] = points[i].v;
  }
  const PrincipalAxes axes = principal_axes(numbers);
  const double widest_m = bone == Bone::kVertebra ? kWidest_m : kWidestOfAnyBone_m;
  if (!(axes.deviation_m[0] <= widest_m)) {
    return refused(
        {translatable("registration points spread %.4g mm (standard deviation), limit %.0f mm: "
                      "not one bone, or not in the unit given"),
         {axes.deviation_m[0] * 1e3, widest_m * 1e3},
         true});
  }
  if (!(axes.deviation_m[1] >= kNarrowest_m)) {
    return refused(
        {translatable("registration points lie on a line or in one place (%.3g mm wide, at "
                      "least %.0f mm)"),
         {axes.deviation_m[1] * 1e3, kNarrowest_m * 1e3},
         true});
  }
  return {};
}

Result<Registration> register_by_pose_search(const VertebraModel& model,
                                             std::span<const Point<World>> points_in_world,
                                             const PoseSearchRegistrationOptions& options) {
  if (const Status s = validate_points(points_in_world, options.min_points, model.bone()); !s) {
    return s.error();
  }
  const Observations observations =
      observed(points_in_world, options.tip_radius_m, options.shafts, options.times_s);
  Question question;
  question.targets = targets_of(model, options);
  question.neighbours = options.neighbours;
  question.most_m = options.max_tre_99_m;
  question.size_off = options.max_size_off;
  question.prior.least_off_m = options.least_model_sd_m;
  const Result<Decision> found = decided(model, observations, question);
  if (!found) {
    return found.error();
  }
  const Decision& d = *found;
  const Posterior& answer = d.answer;
  const BoneSurface bone(model);
  const Fit fit =
      fit_at(bone, observations, answer.world_from_vertebra, answer.centre_m, answer.standoff_m);

  Registration r;
  r.points = points_in_world.size();
  r.world_from_vertebra = r.runner_up = answer.world_from_vertebra;
  r.rmse_m = r.runner_up_rmse_m = fit.rmse_m;
  r.noise_m = answer.hand.spread_m;
  r.standoff_m = answer.standoff_m;
  r.inlier_fraction = d.inlier_fraction;
  r.effective_points = effective_points(answer, fit);
  r.coverage_fraction = coverage_fraction(model, fit.touched);
  r.shaft_collision_fraction = d.shaft_collision_fraction;
  r.field_sd_m = answer.uneven_m;
  r.heights = answer.heights;
  r.model_share = answer.model_share;
  r.correlation_across_strokes = answer.across_strokes;
  r.size = answer.size;
  r.size_sd = answer.size_sd;
  put_errors(model, PoseUncertainty(answer.centre_m, answer.covariance), options.common,
             question.targets, r);
  r.tre_95_m = d.within_95_m;
  r.tre_99_m = d.within_99_m;

  r.log_likelihood_ratio = std::numeric_limits<double>::infinity();
  r.mirror_log_likelihood = -std::numeric_limits<double>::infinity();
  r.levels_compared = options.neighbours.size();
  for (const Explanation& e : d.explanations) {
    if (e.kind == Explanation::Kind::kMirror) {
      r.mirror_log_likelihood = e.log_ratio;
    } else if (e.kind == Explanation::Kind::kLevel && e.probability > question.may_be_wrong &&
               e.level != r.fits_better) {
      r.fits_better = r.fits_better.empty() ? e.level : std::string(kSeveralLevels);
    } else if (e.kind == Explanation::Kind::kOtherPose && !is_width(e, d, question.targets) &&
               -e.log_ratio < r.log_likelihood_ratio) {
      r.log_likelihood_ratio = -e.log_ratio;
      r.runner_up = e.world_from_vertebra;
    }
  }
  if (std::isfinite(r.log_likelihood_ratio)) {
    r.runner_up_rmse_m =
        fit_at(bone, observations, r.runner_up, answer.centre_m, answer.standoff_m).rmse_m;
  }
  r.reasons = reasons_of(d, question, model.bone(), r);
  r.accepted = d.accepted;
  r.provisional = is_provisional(r);
  return r;
}

}  // namespace orthonav::nav
