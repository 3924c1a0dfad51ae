#include "nav/registration/pressed_places.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <limits>

#include "nav/registration/errors_at_targets.h"
#include "nav/registration/verdict.h"

namespace orthonav::nav {
namespace {

using Pose6 = Eigen::Matrix<double, 6, 1>;
using Covariance6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using Rows6 = Eigen::Matrix<double, Eigen::Dynamic, 6>;

/// Nearer to the surface than this, the direction to it says nothing.
constexpr double kOnSurface_m = 1e-5;

/// Soft tissue under a pressed tip is alike over such a distance.
constexpr double kSameTissue_m = 0.003;

/// How high a point of the model's frame lies above the reachable bone, and the way up.
struct HeightThere {
  double height_m = 0.0;
  Vec3 up;
};

HeightThere height_at(const VertebraModel& model, Vec3 p) {
  const auto nearest = model.reachable_surface().nearest(p);
  if (!nearest) {
    return {std::numeric_limits<double>::quiet_NaN(), {}};
  }
  const double sign = model.surface().contains(p) ? -1.0 : 1.0;
  const Vec3 away = p - nearest->point_m;
  return {sign * nearest->distance_m, nearest->distance_m > kOnSurface_m
                                          ? (sign / nearest->distance_m) * away
                                          : nearest->normal};
}

/// By a step of the pose, the points moving in the model's frame about `centre`.
Pose6 slope(Vec3 lever_arm, Vec3 up) {
  const Vec3 by_rotation = lever_arm.cross(up);
  Pose6 j;
  j << up.x, up.y, up.z, by_rotation.x, by_rotation.y, by_rotation.z;
  return j;
}

/// A step of the pose about `centre_m`, from the registered vertebra to the true one.
Transform<Vertebra, Vertebra> moved_by(const Pose6& x, Vec3 centre_m) {
  const Mat3 rotation = orthonormalized(rotation_from_vector({x(3), x(4), x(5)}));
  return {rotation, centre_m + Vec3{x(0), x(1), x(2)} - rotation * centre_m};
}

/// The heights of places, linear about a pose.
struct Heights {
  Eigen::VectorXd above_press_m;  ///< of the step 0, what a press leaves taken off
  Rows6 slopes;
  Eigen::MatrixXd noise_m2;
};

Heights linear_heights(const VertebraModel& model, const Transform<Vertebra, World>& from_world,
                       std::span<const PressedPlace> places, const Pose6& at, Vec3 centre_m,
                       const PressModel& press) {
  const auto n = static_cast<Eigen::Index>(places.size());
  Heights out;
  out.above_press_m.resize(n);
  out.slopes.resize(n, 6);
  out.noise_m2 = Eigen::MatrixXd::Constant(n, n, press.common_sd_m * press.common_sd_m);
  const auto here = moved_by(at, centre_m) * from_world;
  for (Eigen::Index i = 0; i < n; ++i) {
    const PressedPlace& place = places[static_cast<std::size_t>(i)];
    const Vec3 p = (here * place.place).v;
    const HeightThere height = height_at(model, p);
    out.slopes.row(i) = slope(p - centre_m, height.up).transpose();
    out.above_press_m(i) =
        height.height_m - press.height_m - press.tip_radius_m - out.slopes.row(i).dot(at);
    out.noise_m2(i, i) += press.sd_m * press.sd_m + place.sd_m * place.sd_m;
    for (Eigen::Index k = 0; k < i; ++k) {
      // Over the same tissue, a second press leaves what the first one left.
      const double apart_m = (places[static_cast<std::size_t>(k)].place - place.place).norm();
      const double shared_m2 = press.sd_m * press.sd_m * std::exp(-apart_m / kSameTissue_m);
      out.noise_m2(i, k) += shared_m2;
      out.noise_m2(k, i) += shared_m2;
    }
  }
  return out;
}

/// A number for each place; empty where any is not finite.
struct Update {
  Pose6 step = Pose6::Zero();
  Covariance6 covariance = Covariance6::Zero();
  Eigen::VectorXd off_m;
  Eigen::VectorXd off_sd_m;
};

std::optional<Update> update(const Heights& heights, const Covariance6& before) {
  const Eigen::MatrixXd spread =
      heights.slopes * before * heights.slopes.transpose() + heights.noise_m2;
  const Eigen::LLT<Eigen::MatrixXd> llt(spread);
  if (llt.info() != Eigen::Success || !heights.above_press_m.allFinite()) {
    return std::nullopt;
  }
  const Eigen::MatrixXd inverse =
      llt.solve(Eigen::MatrixXd::Identity(spread.rows(), spread.cols()));
  Update out;
  const Rows6 gain = inverse * heights.slopes * before;
  // The heights are to become what a press leaves.
  out.step = -gain.transpose() * heights.above_press_m;
  out.covariance = before - before * heights.slopes.transpose() * gain;
  out.covariance = 0.5 * (out.covariance + out.covariance.transpose()).eval();
  const Eigen::VectorXd weighed = inverse * heights.above_press_m;
  out.off_m = weighed.cwiseQuotient(inverse.diagonal());
  out.off_sd_m = inverse.diagonal().cwiseSqrt().cwiseInverse();
  return out;
}

Covariance6 covariance_now(const Registration& strokes, const PressModel& press) {
  const PoseUncertainty own = without_common(*strokes.uncertainty, strokes.common);
  Covariance6 covariance = Eigen::Map<const Covariance6>(own.covariance().data());
  const double moved_m = press.moved_sd_m;
  covariance.topLeftCorner<3, 3>().diagonal().array() += moved_m * moved_m;
  return covariance;
}

PoseUncertainty uncertainty_of(const Covariance6& covariance, Vec3 centre_m) {
  std::array<double, 36> rows{};
  Eigen::Map<Covariance6>(rows.data()) = covariance;
  return {centre_m, rows};
}

/// Places touched do not see what the strokes were refused for otherwise.
void judge(const PoseSearchRegistrationOptions& options, Registration& r) {
  using Kind = RefusalReason::Kind;
  std::erase_if(r.reasons, [](const RefusalReason& reason) {
    return reason.kind == Kind::kTreAtScrews || reason.kind == Kind::kTre99AtScrews ||
           reason.kind == Kind::kSoftTissue;
  });
  if (const auto reason = error_at_screws(r, options)) {
    r.reasons.push_back(*reason);
  }
  r.accepted = r.reasons.empty();
  r.provisional = is_provisional(r);
}

}  // namespace

std::optional<JoinedPlaces> join_places(const VertebraModel& model, const Registration& strokes,
                                        std::span<const PressedPlace> places,
                                        const PoseSearchRegistrationOptions& options,
                                        const PressModel& press) {
  if (!strokes.uncertainty || places.empty()) {
    return std::nullopt;
  }
  constexpr int kRounds = 6;
  constexpr double kStands_m = 1e-6;
  const Vec3 centre_m = strokes.uncertainty->centre_m();
  const auto from_world = strokes.world_from_vertebra.inverse();
  const Covariance6 before = covariance_now(strokes, press);
  std::optional<Update> found;
  Pose6 at = Pose6::Zero();
  for (int round = 0; round < kRounds; ++round) {
    found = update(linear_heights(model, from_world, places, at, centre_m, press), before);
    if (!found || !found->step.allFinite()) {
      return std::nullopt;
    }
    const double moved_m = (found->step - at).head<3>().norm();
    at = found->step;
    if (moved_m < kStands_m) {
      break;
    }
  }
  JoinedPlaces out;
  out.off_m.assign(found->off_m.begin(), found->off_m.end());
  out.off_sd_m.assign(found->off_sd_m.begin(), found->off_sd_m.end());
  Registration& r = out.registration;
  r = strokes;
  r.world_from_vertebra = strokes.world_from_vertebra * moved_by(at, centre_m).inverse();
  if (strokes.runner_up == strokes.world_from_vertebra) {
    r.runner_up = r.world_from_vertebra;  // there is none
  }
  CommonErrors common = strokes.common;
  common.map_m = press.moved_since_sd_m;
  put_errors(model, uncertainty_of(found->covariance, centre_m), common, targets_of(model, options),
             r);
  judge(options, r);
  return out;
}

std::optional<Point<World>> place_to_press(const VertebraModel& model, const Registration& joined,
                                           std::span<const Point<World>> stroked,
                                           std::span<const PressedPlace> pressed,
                                           const PoseSearchRegistrationOptions& options,
                                           double apart_m) {
  if (!joined.uncertainty || stroked.empty()) {
    return std::nullopt;
  }
  constexpr std::size_t kMostTried = 150;
  constexpr double kOnBone_m = 0.003;
  const PressModel press;
  const double noise_m2 = press.sd_m * press.sd_m + press.common_sd_m * press.common_sd_m;
  const auto targets = targets_of(model, options);
  const PoseUncertainty own = without_common(*joined.uncertainty, joined.common);
  const Covariance6 before = Eigen::Map<const Covariance6>(own.covariance().data());
  const auto from_world = joined.world_from_vertebra.inverse();
  std::optional<Point<World>> best;
  double least_m = std::numeric_limits<double>::infinity();
  const std::size_t step = std::max<std::size_t>(1, stroked.size() / kMostTried);
  for (std::size_t i = 0; i < stroked.size(); i += step) {
    const auto nearest = model.reachable_surface().nearest((from_world * stroked[i]).v, kOnBone_m);
    if (!nearest) {
      continue;
    }
    const Point<World> place = joined.world_from_vertebra * Point<Vertebra>{nearest->point_m};
    if (std::any_of(pressed.begin(), pressed.end(),
                    [&](const PressedPlace& p) { return (p.place - place).norm() < apart_m; })) {
      continue;
    }
    const Pose6 j = slope(nearest->point_m - own.centre_m(), nearest->normal);
    const Pose6 gain = before * j;
    const Covariance6 after = before - gain * gain.transpose() / (j.dot(gain) + noise_m2);
    const PoseUncertainty there = uncertainty_of(after, own.centre_m());
    double worst_m = 0.0;
    for (const Point<Vertebra>& target : targets) {
      worst_m = std::max(worst_m, there.predicted_tre_m(target));
    }
    if (worst_m < least_m) {
      least_m = worst_m;
      best = place;
    }
  }
  return best;
}

}  // namespace orthonav::nav
