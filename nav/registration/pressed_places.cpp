#include "nav/registration/pressed_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <limits>

#include "nav/registration/errors_at_targets.h"
#include "nav/registration/press_fit.h"
#include "nav/registration/verdict.h"

namespace orthonav::nav {
namespace {

/// What the noise of a tip at rest for a second leaves.
constexpr double kUsualSd_m = 0.0002;

constexpr std::array<double, 8> kModelSds_m = {0.0001, 0.0002,  0.0003, 0.0004,
                                               0.0005, 0.00065, 0.0008, 0.001};
constexpr std::array<double, 3> kModelLengths_m = {0.005, 0.007, 0.010};
constexpr double kUsualModel_m = 0.0005;
constexpr double kModelSpread = 0.5;  ///< SD of the natural logarithm

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

using Covariance6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// What World's walk makes of the pose's covariance after all presses, by the gain that was used.
Covariance6 walk_left(const PressFit& fit, const PressModel& press) {
  const double walk_m2 = press.drift_m_per_sqrt_s * press.drift_m_per_sqrt_s;
  const auto n = static_cast<Eigen::Index>(fit.heights.size());
  const Eigen::Map<const Eigen::MatrixXd> inverse(fit.inverse_1_m2.data(), n, n);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>> shared(
      fit.shared.front().data(), n, 6);
  Eigen::MatrixXd with_now = Eigen::MatrixXd::Zero(n, 6);
  Eigen::MatrixXd walk(n, n);
  double now_s = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const PressedHeight& a = fit.heights[static_cast<std::size_t>(i)];
    now_s = std::max(now_s, a.time_s);
    with_now.row(i).head<3>() << a.time_s * a.up.x, a.time_s * a.up.y, a.time_s * a.up.z;
    for (Eigen::Index k = 0; k < n; ++k) {
      const PressedHeight& b = fit.heights[static_cast<std::size_t>(k)];
      walk(i, k) = std::min(a.time_s, b.time_s) * a.up.dot(b.up);
    }
  }
  const Eigen::MatrixXd gain = shared.transpose() * inverse;
  const Covariance6 taken = gain * with_now;
  Covariance6 left = gain * walk * gain.transpose() - taken - taken.transpose();
  left.topLeftCorner<3, 3>().diagonal().array() += now_s;
  return walk_m2 * left;
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

std::vector<ModelErrorHypothesis> model_error_hypotheses() {
  std::vector<ModelErrorHypothesis> all;
  for (const double sd_m : kModelSds_m) {
    const double off = std::log(sd_m / kUsualModel_m) / kModelSpread;
    for (const double length_m : kModelLengths_m) {
      all.push_back({{sd_m, length_m}, -0.5 * off * off});
    }
  }
  return all;
}

double shared_error_m2(const ModelError& error, Vec3 a, Vec3 b) {
  return error.sd_m * error.sd_m * std::exp(-(a - b).norm() / error.length_m);
}

std::optional<JoinedPlaces> join_places(const VertebraModel& model, const Registration& strokes,
                                        std::span<const PressedPlace> places,
                                        const PoseSearchRegistrationOptions& options,
                                        const PressModel& press) {
  if (!strokes.uncertainty || places.empty()) {
    return std::nullopt;
  }
  const auto fit = fit_presses(model, strokes, places, press);
  if (!fit) {
    return std::nullopt;
  }
  JoinedPlaces out;
  out.off_m = fit->off_m;
  out.off_sd_m = fit->off_sd_m;
  out.model = fit->model;
  Registration& r = out.registration;
  r = strokes;
  r.world_from_vertebra =
      strokes.world_from_vertebra * moved_by(fit->step, fit->centre_m).inverse();
  if (strokes.runner_up == strokes.world_from_vertebra) {
    r.runner_up = r.world_from_vertebra;  // there is none
  }
  CommonErrors common = strokes.common;
  common.map_m = 0.0;
  const PoseUncertainty whole(fit->centre_m, fit->covariance);
  // Limits are about the registration. How World walks no press takes away; it is told with the
  // rest.
  std::array<double, 36> own = fit->covariance;
  Eigen::Map<Covariance6>(own.data()) -= walk_left(*fit, press);
  put_errors(model, {fit->centre_m, own}, common, targets_of(model, options), r);
  r.uncertainty = with_common(whole, common);
  judge(options, r);
  return out;
}

std::optional<NextPlace> place_to_press(const VertebraModel& model, const Registration& strokes,
                                        std::span<const Point<World>> stroked,
                                        std::span<const PressedPlace> pressed,
                                        const PoseSearchRegistrationOptions& options,
                                        const PressModel& press, double apart_m) {
  if (!strokes.uncertainty || stroked.empty()) {
    return std::nullopt;
  }
  const auto fit = fit_presses(model, strokes, pressed, press);
  if (!fit) {
    return std::nullopt;
  }
  constexpr std::size_t kMostTried = 150;
  constexpr double kOnBone_m = 0.003;
  const auto targets = targets_of(model, options);
  const auto world_from_vertebra =
      strokes.world_from_vertebra * moved_by(fit->step, fit->centre_m).inverse();
  const auto from_world = world_from_vertebra.inverse();
  double now_s = 0.0;
  for (const PressedPlace& place : pressed) {
    now_s = std::max(now_s, place.time_s);
  }
  NextPlace best;
  best.tre_m = worst_tre_m(fit->likeliest_covariance, fit->centre_m, targets);
  best.tre_then_m = std::numeric_limits<double>::infinity();
  const std::size_t step = std::max<std::size_t>(1, stroked.size() / kMostTried);
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
    const PressedHeight next{nearest->point_m, nearest->normal, now_s, kUsualSd_m};
    const double then_m = worst_tre_m(fit->with(next, press), fit->centre_m, targets);
    if (then_m < best.tre_then_m) {
      best.tre_then_m = then_m;
      best.place = place;
    }
  }
  return std::isfinite(best.tre_then_m) ? std::optional(best) : std::nullopt;
}

}  // namespace orthonav::nav
