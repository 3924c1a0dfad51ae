#include "nav/registration/pressed_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <limits>

#include "nav/registration/errors_at_targets.h"
#include "nav/registration/press_fit.h"

namespace orthonav::nav {
namespace {

/// The SD that averaging a tip at rest for a second leaves.
constexpr double kUsualSd_m = 0.0002;

/// Judges the registration again; touched places can't remove the other reasons for which the
/// strokes were refused.
void judge(const PoseSearchRegistrationOptions& options, Registration& r) {
  using Kind = RefusalReason::Kind;
  std::erase_if(r.reasons, [](const RefusalReason& reason) {
    return reason.kind == Kind::kTre99AtScrews || reason.kind == Kind::kSoftTissue;
  });
  if (!(r.tre_99_m <= options.max_tre_99_m)) {
    r.reasons.push_back({Kind::kTre99AtScrews, r.tre_99_m, options.max_tre_99_m, r.weakest});
  }
  r.accepted = r.reasons.empty();
  r.provisional = is_provisional(r);
}

using Covariance6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// What a unit of each height moves the pose by, with the likeliest field.
Eigen::MatrixXd gain_of(const PressFit& fit) {
  const auto n = static_cast<Eigen::Index>(fit.heights.size());
  const Eigen::Map<const Eigen::MatrixXd> inverse(fit.inverse_1_m2.data(), n, n);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>> shared(
      fit.shared.front().data(), n, 6);
  return shared.transpose() * inverse;
}

/// What an error of the model that the fit did not know of adds to the pose's covariance.
Covariance6 model_left(const PressFit& fit, const ModelError& error) {
  const auto n = static_cast<Eigen::Index>(fit.heights.size());
  Eigen::MatrixXd off_m2(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < n; ++k) {
      off_m2(i, k) = shared_error_m2(error, fit.heights[static_cast<std::size_t>(i)].at_m,
                                     fit.heights[static_cast<std::size_t>(k)].at_m);
    }
  }
  const Eigen::MatrixXd gain = gain_of(fit);
  return gain * off_m2 * gain.transpose();
}

/// The part of the pose's covariance after all presses that comes from World's drift, by the gain
/// of the likeliest field.
Covariance6 walk_left(const PressFit& fit, const PressModel& press) {
  const double walk_m2 = press.drift_m_per_sqrt_s * press.drift_m_per_sqrt_s;
  const auto n = static_cast<Eigen::Index>(fit.heights.size());
  Eigen::MatrixXd with_now = Eigen::MatrixXd::Zero(n, 6);
  Eigen::MatrixXd walk(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const PressedHeight& a = fit.heights[static_cast<std::size_t>(i)];
    with_now.row(i).head<3>() << a.time_s * a.up.x, a.time_s * a.up.y, a.time_s * a.up.z;
    for (Eigen::Index k = 0; k < n; ++k) {
      const PressedHeight& b = fit.heights[static_cast<std::size_t>(k)];
      walk(i, k) = std::min(a.time_s, b.time_s) * a.up.dot(b.up);
    }
  }
  const Eigen::MatrixXd gain = gain_of(fit);
  const Covariance6 taken = gain * with_now;
  Covariance6 left = gain * walk * gain.transpose() - taken - taken.transpose();
  left.topLeftCorner<3, 3>().diagonal().array() += fit.now_s;
  return walk_m2 * left;
}

/// The pose's covariance without World's walk. The gain of one field does not quite match the
/// covariance of all of them: if the difference is not a covariance, the drift is kept.
std::array<double, 36> without_walk(const PressFit& fit, const PressModel& press) {
  std::array<double, 36> own = fit.covariance;
  Eigen::Map<Covariance6> left(own.data());
  left -= walk_left(fit, press);
  return Eigen::LLT<Covariance6>(left).info() == Eigen::Success ? own : fit.covariance;
}

double worst_tre_m(const std::array<double, 36>& covariance, Vec3 centre_m,
                   std::span<const Point<Vertebra>> targets) {
  const PoseUncertainty uncertainty(centre_m, covariance);
  double worst_m = 0.0;
  for (const Point<Vertebra>& target : targets) {
    worst_m = std::max(worst_m, uncertainty.predicted_tre_m(target));
  }
  return worst_m;
}

}  // namespace

std::optional<JoinedPlaces> join_places(const VertebraModel& model, const Registration& strokes,
                                        const PressFit& fit, const PressModel& press,
                                        const PoseSearchRegistrationOptions& options) {
  if (fit.heights.empty()) {
    return std::nullopt;
  }
  JoinedPlaces out;
  out.off_m = fit.off_m;
  out.off_sd_m = fit.off_sd_m;
  out.model = fit.model;
  Registration& r = out.registration;
  r = strokes;
  r.world_from_vertebra = fit.moved(strokes.world_from_vertebra);
  if (strokes.runner_up == strokes.world_from_vertebra) {
    r.runner_up = r.world_from_vertebra;  // there is none
  }
  CommonErrors common = strokes.common;
  common.map_m = press.since_sd_m;
  std::array<double, 36> covariance = fit.covariance;
  if (press.left_out) {
    Eigen::Map<Covariance6>(covariance.data()) += model_left(fit, *press.left_out);
  }
  const PoseUncertainty whole(fit.centre_m, covariance);
  // Limits judge the registration alone, without World's drift, which no press can reduce. The
  // drift stays in the uncertainty.
  put_errors(model, {fit.centre_m, without_walk(fit, press)}, common, targets_of(model, options),
             r);
  r.uncertainty = with_common(whole, common);
  judge(options, r);
  return out;
}

std::optional<NextPlace> place_to_press(const VertebraModel& model, const Registration& strokes,
                                        std::span<const Point<World>> stroked,
                                        std::span<const PressedPlace> pressed, const PressFit& fit,
                                        const PressModel& press,
                                        const PoseSearchRegistrationOptions& options,
                                        double apart_m) {
  constexpr std::size_t kMaxTried = 250;
  constexpr double kOnBone_m = 0.003;
  const auto targets = targets_of(model, options);
  const auto world_from_vertebra = fit.moved(strokes.world_from_vertebra);
  const auto from_world = world_from_vertebra.inverse();
  NextPlace best;
  std::vector<Point<World>> places;
  std::vector<PressedHeight> next;
  best.tre_m = worst_tre_m(fit.likeliest_covariance, fit.centre_m, targets);
  best.tre_then_m = std::numeric_limits<double>::infinity();
  const std::size_t step = std::max<std::size_t>(1, stroked.size() / kMaxTried);
  for (std::size_t i = 0; i < stroked.size(); i += step) {
    const auto nearest = model.reachable_surface().nearest((from_world * stroked[i]).v, kOnBone_m);
    if (!nearest) {
      continue;
    }
    const Point<World> place = world_from_vertebra * Point<Vertebra>{nearest->point_m};
    if (std::any_of(pressed.begin(), pressed.end(),
                    [&](const PressedPlace& p) { return (p.place - place).norm() < apart_m; })) {
      continue;
    }
    places.push_back(place);
    next.push_back({nearest->point_m, nearest->normal, {}, 0, fit.now_s, kUsualSd_m});
  }
  const auto then = fit.with(next, press);
  for (std::size_t i = 0; i < then.size(); ++i) {
    const double then_m = worst_tre_m(then[i], fit.centre_m, targets);
    if (then_m < best.tre_then_m) {
      best.tre_then_m = then_m;
      best.place = places[i];
    }
  }
  return std::isfinite(best.tre_then_m) ? std::optional(best) : std::nullopt;
}

}  // namespace orthonav::nav
