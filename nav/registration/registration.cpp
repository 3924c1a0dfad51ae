#include "nav/registration/registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/reason.h"
#include "base/translation.h"
#include "nav/geometry/matrix_as.h"
#include "nav/geometry/principal_axes.h"
#include "nav/geometry/triangle.h"
#include "nav/registration/decision.h"
#include "nav/registration/search.h"
#include "nav/statistics/symmetric_eigen.h"

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
using Vector6 = Eigen::Matrix<double, 6, 1>;

// ---------------------------------------------------------------------------------------------
// What an uncertain pose means at the targets.

/// Both ends of a bone along each of its principal axes, about.
std::vector<Point<Vertebra>> ends_of(const PrincipalAxes& bone) {
  constexpr double kEndSds = 2.0;
  std::vector<Point<Vertebra>> ends;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double side : {kEndSds, -kEndSds}) {
      ends.push_back({bone.centre_m + side * bone.deviation_m[k] * bone.axes[k]});
    }
  }
  return ends;
}

constexpr double kCovered_m = 0.005;
/// The SD of a place after a few strokes over it.
constexpr double kPinned_m = 0.0003;
/// The spinous process lies within this distance of the midline.
constexpr double kMidline_m = 0.007;
constexpr double kLateral_m = 0.028;
/// Within this distance of the middle, a place is neither upper nor lower.
constexpr double kMiddle_m = 0.006;

Vec3 middle(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return (mesh.vertices_m[t[0]] + mesh.vertices_m[t[1]] + mesh.vertices_m[t[2]]) / 3.0;
}

BonePlace place_of(const VertebraModel& model, Vec3 p) {
  using Height = BonePlace::Height;
  using Part = BonePlace::Part;
  const Vec3 centre = model.reachable_axes().centre_m;
  const double x = p.x - centre.x;
  const double z = p.z - centre.z;
  const Height height = z > kMiddle_m    ? Height::kUpper
                        : z < -kMiddle_m ? Height::kLower
                                         : Height::kMiddle;
  if (std::abs(x) < kMidline_m) {
    return {Part::kSpinousProcess, std::nullopt, height};
  }
  return {std::abs(x) > kLateral_m ? Part::kFacet : Part::kLamina,
          x > 0.0 ? Side::kLeft : Side::kRight, height};
}

/// The largest part of a motion at the targets; (translation, rotation) in the vertebra's axes.
UncertainMotion::Kind kind_of(const Vector6& motion, double lever_m) {
  using enum UncertainMotion::Kind;
  constexpr std::array<UncertainMotion::Kind, 6> kKinds = {
      kLateral, kAnteroposterior, kCraniocaudal, kFlexion, kLateralBending, kAxialRotation};
  std::size_t most = 0;
  double length = 0.0;
  for (std::size_t k = 0; k < 6; ++k) {
    const double m = std::abs(motion(static_cast<Eigen::Index>(k))) * (k < 3 ? 1.0 : lever_m);
    if (m > length) {
      length = m, most = k;
    }
  }
  return kKinds[most];
}

/// The motion in whose direction the error at the targets is largest.
UncertainMotion::Kind worst_motion(const Matrix6& covariance, Vec3 centre_m,
                                   std::span<const Point<Vertebra>> targets) {
  Matrix6 at_targets = Matrix6::Zero();
  double lever_m = 0.0;
  for (const Point<Vertebra>& target : targets) {
    const auto m = moves_as<Eigen::Matrix<double, 3, 6>>(target.v - centre_m);
    at_targets += m.transpose() * m;
    lever_m = std::max(lever_m, (target.v - centre_m).norm());
  }
  // A square root of the covariance: root · rootᵀ.
  const SymmetricEigen6 own = symmetric_eigen(rows_of<36>(covariance));
  const Eigen::Map<const Vector6> variances(own.values.data());
  const Matrix6 root = Eigen::Map<const Matrix6>(own.vectors.data()) *
                       variances.cwiseMax(0.0).cwiseSqrt().asDiagonal();
  const SymmetricEigen6 errors =
      symmetric_eigen(rows_of<36>(Matrix6(root.transpose() * at_targets * root)));
  return kind_of(root * Eigen::Map<const Matrix6>(errors.vectors.data()).col(5), lever_m);
}

/// The covariance after one more touch there: Kalman's update.
Matrix6 after_touch(const Matrix6& covariance, Vec3 lever_arm, Vec3 normal) {
  const Vec3 by_rotation = lever_arm.cross(normal);
  Vector6 j;
  j << normal.x, normal.y, normal.z, by_rotation.x, by_rotation.y, by_rotation.z;
  const Vector6 gain = covariance * j;
  return covariance - gain * gain.transpose() / (j.dot(gain) + kPinned_m * kPinned_m);
}

/// Names the motion that adds most to the error at the worst of the targets, and the place of the
/// reachable surface where strokes would reduce that error most.
void put_weakest(const VertebraModel& model, const PoseUncertainty& uncertainty,
                 std::span<const Point<Vertebra>> targets, Registration& r) {
  const auto covariance = matrix_as<Matrix6>(uncertainty.covariance());
  const Vec3 centre = uncertainty.centre_m();
  double least_m = worst_tre_m(uncertainty, targets);
  r.weakest = {worst_motion(covariance, centre, targets), least_m};
  r.stroke_next.reset();
  r.stroke_next_at = {};
  const TriangleMesh& mesh = model.reachable();
  const std::size_t step = std::max<std::size_t>(1, mesh.triangles.size() / 400);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += step) {
    const auto& t = mesh.triangles[i];
    const Vec3 at = middle(mesh, t);
    const Vec3 normal =
        triangle_normal({mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]});
    const Matrix6 then = after_touch(covariance, at - centre, normal);
    const double then_m = worst_tre_m({centre, rows_of<36>(then)}, targets);
    if (then_m < least_m) {
      least_m = then_m;
      r.stroke_next = place_of(model, at);
      r.stroke_next_at = {at};
    }
  }
}

/// The fraction of the reachable surface's area that lies within about 5 mm of one of these places.
double coverage_fraction(const VertebraModel& model, std::span<const Vec3> places_m) {
  // Cells that hold a place, and their neighbours.
  const auto cell = [](double x) { return static_cast<int>(std::floor(x / kCovered_m)); };
  std::set<std::array<int, 3>> touched;
  for (const Vec3& at : places_m) {
    touched.insert({cell(at.x), cell(at.y), cell(at.z)});
  }
  const auto near = [&](Vec3 at) {
    for (const double dx : {-0.5, 0.5}) {
      for (const double dy : {-0.5, 0.5}) {
        for (const double dz : {-0.5, 0.5}) {
          if (touched.count({cell(at.x + dx * kCovered_m), cell(at.y + dy * kCovered_m),
                             cell(at.z + dz * kCovered_m)}) != 0) {
            return true;
          }
        }
      }
    }
    return false;
  };
  double covered = 0.0;
  double all = 0.0;
  const TriangleMesh& mesh = model.reachable();
  for (const auto& t : mesh.triangles) {
    const double area =
        triangle_area_m2({mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]});
    all += area;
    if (near(middle(mesh, t))) {
      covered += area;
    }
  }
  return all > 0.0 ? covered / all : 0.0;
}

// ---------------------------------------------------------------------------------------------
// The answer, from the decision.

/// The points against the bone's whole surface at a pose.
struct Fit {
  std::vector<Vec3> places_m;  ///< of the points, in the model's frame
  double rmse_m = 0.0;         ///< about the mean height of the tip
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
    const auto place = bone.at(at_m);
    const Vec3 turned = (at_m - centre_m).cross(place.out);
    Eigen::Matrix<double, 6, 1> moves;
    moves << place.out.x, place.out.y, place.out.z, turned.x, turned.y, turned.z;
    out.information += moves * moves.transpose();
    out.places_m.push_back(at_m);
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
  return by_each > 0.0 ? static_cast<double>(fit.places_m.size()) * spread_m2 / by_each : 0.0;
}

/// Whether an explanation is of the answer's own width: the targets are where it puts them, about.
bool is_width(const Explanation& e, const Decision& d, std::span<const Point<Vertebra>> targets) {
  constexpr double kSameAtTargets_m = 0.002;
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
  const RegistrationLimits limits = registration_limits();
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
  if (d.wrong <= kMayBeWrong) {
    return reasons;
  }
  double of_width = 0.0, of_poses = 0.0, of_mirror = 0.0, of_size = 0.0, of_levels = 0.0;
  double of_likeliest = 0.0;
  std::string level = r.fits_better;
  for (const Explanation& e : d.explanations) {
    const double wrong = e.probability * e.wrong;
    switch (e.kind) {
      case Explanation::Kind::kAnswer:
      case Explanation::Kind::kOtherPose:
        (is_width(e, d, question.targets) ? of_width : of_poses) += wrong;
        break;
      case Explanation::Kind::kLevel:
        of_levels += wrong;
        if (r.fits_better.empty() && wrong > of_likeliest) {
          of_likeliest = wrong;
          level = e.level;
        }
        break;
      case Explanation::Kind::kMirror:
        of_mirror += wrong;
        break;
      case Explanation::Kind::kSize:
        of_size += wrong;
        break;
    }
  }
  const double most = std::max({of_width, of_poses, of_mirror, of_size, of_levels});
  const auto counts = [&](double wrong) { return wrong > kMayBeWrong || wrong > kGoodPart * most; };
  // What the bone is comes first: strokes of another one have other faults too.
  if (counts(of_mirror)) {
    reasons.insert(reasons.begin(),
                   {Kind::kMirrored, r.mirror_log_likelihood, limits.mirror_log_likelihood});
  }
  if (counts(of_levels)) {
    reasons.insert(reasons.begin(), {Kind::kFitsOtherLevel, 0.0, 0.0, {}, level});
  }
  if (counts(of_poses)) {
    reasons.push_back(
        {Kind::kLogLikelihoodRatio, r.log_likelihood_ratio, limits.log_likelihood_ratio});
  }
  if (counts(of_size)) {
    reasons.push_back({Kind::kModelSize, r.size, kMaxSizeOff});
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

std::vector<Point<Vertebra>> targets_of(const VertebraModel& model,
                                        const PoseSearchRegistrationOptions& options) {
  if (!options.targets.empty()) {
    return options.targets;
  }
  if (model.bone() == Bone::kAny) {
    return ends_of(model.reachable_axes());
  }
  // Pedicle screws enter about 20 mm beside the midline and end in the body.
  const Vec3 back = model.reachable_axes().centre_m;
  std::vector<Point<Vertebra>> usual;
  for (const double side : {1.0, -1.0}) {
    usual.push_back({back + Vec3{side * 0.020, 0.0, 0.0}});
    usual.push_back({back + Vec3{side * 0.008, -0.045, 0.0}});
  }
  return usual;
}

void put_errors(const VertebraModel& model, const PoseUncertainty& own, const CommonErrors& common,
                std::span<const Point<Vertebra>> targets, Registration& r) {
  r.predicted_tre_m = worst_tre_m(own, targets);
  r.tre_95_m = r.tre_99_m = 0.0;
  for (const Point<Vertebra>& target : targets) {
    r.tre_95_m = std::max(r.tre_95_m, own.tre_quantile_m(target, 0.95));
    r.tre_99_m = std::max(r.tre_99_m, own.tre_quantile_m(target, 0.99));
  }
  if (model.bone() == Bone::kVertebra) {  // whose places and motions have names
    put_weakest(model, own, targets, r);
  }
  r.common = common;
  r.uncertainty = with_common(own, common);
}

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

RegistrationLimits registration_limits() {
  constexpr double kLeastPredicted = 1e-3;  // of data like these, by the prior
  constexpr double kOutlierPower = 18.0;    // 1 of 20 points on average, 3 of 10 once in 600
  const Prior prior;
  // The log ratio at which an explanation with these odds is as probable as it may be.
  const auto takes_too_much = [](double odds) {
    return std::log(kMayBeWrong / (1.0 - kMayBeWrong) / odds);
  };
  return {scatter_exceeded_m(prior, kLeastPredicted),
          std::pow(kLeastPredicted, 1.0 / kOutlierPower),
          // As if the share were drawn from an exponential density with the prior's mean.
          -prior.shaft_in_bone * std::log(kLeastPredicted), -takes_too_much(1.0),
          takes_too_much(prior.mirror_odds)};
}

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
  if (const Status s = validate_points(points_in_world, kFewestPoints, model.bone()); !s) {
    return s.error();
  }
  const Observations observations =
      observed(points_in_world, options.tip_radius_m, options.shafts, options.times_s);
  Question question;
  question.targets = targets_of(model, options);
  question.neighbours = options.neighbours;
  question.most_m = options.max_tre_99_m;
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
  r.coverage_fraction = coverage_fraction(model, fit.places_m);
  r.shaft_collision_fraction = d.shaft_collision_fraction;
  r.field_sd_m = answer.uneven_m;
  r.heights = answer.heights;
  r.model_share = answer.model_share;
  r.correlation_across_strokes = answer.across_strokes;
  r.size = answer.size;
  r.size_sd = answer.size_sd;
  put_errors(model, PoseUncertainty(answer.centre_m, answer.covariance), options.common,
             question.targets, r);
  // At any of the targets, and by draws of the whole mixture: more than `put_errors` says, which is
  // of one target at a time and of one Gaussian, as it is with pressed places.
  r.tre_95_m = d.within_95_m;
  r.tre_99_m = d.within_99_m;

  r.log_likelihood_ratio = std::numeric_limits<double>::infinity();
  r.mirror_log_likelihood = -std::numeric_limits<double>::infinity();
  r.levels_compared = options.neighbours.size();
  for (const Explanation& e : d.explanations) {
    if (e.kind == Explanation::Kind::kMirror) {
      r.mirror_log_likelihood = e.log_ratio;
    } else if (e.kind == Explanation::Kind::kLevel && e.probability > kMayBeWrong &&
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
