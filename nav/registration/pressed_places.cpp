#include "nav/registration/pressed_places.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "nav/registration/decision.h"
#include "nav/registration/errors_at_targets.h"

namespace orthonav::nav {
namespace {

/// The SD that averaging a tip at rest for a second leaves.
constexpr double kUsualSd_m = 0.0002;

posterior::Height press_of(const PressedPlace& place) {
  const posterior::Prior prior;
  return {place.place, prior.press_gap_m, place.sd_m, prior.press_sd_m, prior.press_common_sd_m};
}

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

double worst_tre_m(Vec3 centre_m, const std::array<double, 36>& covariance,
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
                                        std::span<const PressedPlace> places,
                                        const PoseSearchRegistrationOptions& options,
                                        const MotionOfWorld& motion) {
  if (!strokes.uncertainty) {
    return std::nullopt;
  }
  const PoseUncertainty own = without_common(*strokes.uncertainty, strokes.common);
  const auto prior = strokes.strokes ? strokes.strokes
                                     : posterior::told_by(strokes.world_from_vertebra,
                                                          own.centre_m(), own.covariance());
  std::vector<posterior::Height> heights;
  for (const PressedPlace& place : places) {
    heights.push_back(press_of(place));
  }
  auto joined = posterior::joined(prior, posterior::BoneSurface(model), heights, motion.before_m);
  if (!joined) {
    return std::nullopt;
  }
  JoinedPlaces out;
  Registration& r = out.registration;
  r = strokes;
  const posterior::Posterior& answer = joined->posterior;
  r.world_from_vertebra = answer.world_from_vertebra;
  if (strokes.runner_up == strokes.world_from_vertebra) {
    r.runner_up = r.world_from_vertebra;  // there is none
  }
  CommonErrors common = strokes.common;
  common.map_m = motion.since_m;
  const auto targets = targets_of(model, options);
  put_errors(model, PoseUncertainty(answer.centre_m, answer.covariance), common, targets, r);
  const auto errors_m = posterior::errors_m(answer, answer.world_from_vertebra, targets);
  r.tre_95_m = posterior::quantile_m(errors_m, 0.95);
  r.tre_99_m = posterior::quantile_m(errors_m, 0.99);
  judge(options, r);
  out.joined = std::move(*joined);
  return out;
}

std::optional<NextPlace> place_to_press(const VertebraModel& model, const JoinedPlaces& joined,
                                        std::span<const Point<World>> stroked,
                                        std::span<const PressedPlace> pressed,
                                        const PoseSearchRegistrationOptions& options,
                                        double apart_m) {
  constexpr std::size_t kMaxTried = 250;
  constexpr double kOnBone_m = 0.003;
  const auto targets = targets_of(model, options);
  const Transform<World, Vertebra>& world_from_vertebra = joined.registration.world_from_vertebra;
  const auto from_world = world_from_vertebra.inverse();
  std::vector<posterior::Height> candidates;
  const std::size_t step = std::max<std::size_t>(1, stroked.size() / kMaxTried);
  for (std::size_t i = 0; i < stroked.size(); i += step) {
    const auto nearest = model.reachable_surface().nearest((from_world * stroked[i]).v, kOnBone_m);
    if (!nearest) {
      continue;
    }
    const Point<World> place = world_from_vertebra * Point<Vertebra>{nearest->point_m};
    if (std::none_of(pressed.begin(), pressed.end(),
                     [&](const PressedPlace& p) { return (p.place - place).norm() < apart_m; })) {
      candidates.push_back(press_of({place, kUsualSd_m}));
    }
  }
  const auto foreseen = joined.joined.foreseen(posterior::BoneSurface(model), candidates);
  const Vec3 centre_m = joined.joined.posterior.centre_m;
  NextPlace best;
  best.tre_m = worst_tre_m(centre_m, foreseen.now, targets);
  best.tre_then_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double then_m = worst_tre_m(centre_m, foreseen.then[i], targets);
    if (then_m < best.tre_then_m) {
      best.tre_then_m = then_m;
      best.place = candidates[i].at;
    }
  }
  return candidates.empty() ? std::nullopt : std::optional(best);
}

}  // namespace orthonav::nav
