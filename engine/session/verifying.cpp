#include "engine/session/verifying.h"

#include <algorithm>
#include <limits>

#include "nav/registration/unstroked_surface.h"

namespace orthonav::engine {
namespace {

std::vector<float> distances_m(const LevelState& level) {
  const auto vertebra_from_world = level.registration->world_from_vertebra.inverse();
  const auto& surface = level.plan.model->reachable_surface();
  std::vector<float> each_m;
  for (const Point<World>& point : level.newest->points) {
    const auto nearest = surface.nearest((vertebra_from_world * point).v);
    each_m.push_back(nearest ? static_cast<float>(nearest->distance_m)
                             : std::numeric_limits<float>::infinity());
  }
  return each_m;
}

/// One sample says little: the mean over a stretch of the stroke, or it is a speckle.
std::vector<float> smoothed(std::span<const float> each_m) {
  constexpr std::size_t kStretch = 10;
  std::vector<float> smooth_m;
  for (std::size_t i = 0; i < each_m.size(); ++i) {
    const std::size_t first = i - std::min(i, kStretch);
    const std::size_t last = std::min(i + kStretch + 1, each_m.size());
    float sum = 0.0f;
    for (std::size_t k = first; k < last; ++k) {
      sum += each_m[k];
    }
    smooth_m.push_back(sum / static_cast<float>(last - first));
  }
  return smooth_m;
}

}  // namespace

Verifying::Verifying(const LevelState& level, Verification verification,
                     const nav::CheckPointRules& rules)
    : rules_(rules),
      residuals_m_(smoothed(distances_m(level))),
      unstroked_(nav::unstroked_surface(*level.plan.model, level.registration->world_from_vertebra,
                                        level.newest->points)) {
  if (verification == Verification::kByTouch) {
    places_ = nav::places_to_check(*level.plan.model, level.registration->world_from_vertebra,
                                   level.newest->points, rules);
  }
  judge(level);
}

void Verifying::judge(const LevelState& level) {
  to_check_ = nav::still_to_check(places_, level.check_points);
  verdict_ = nav::verdict_on(level.check_points, rules_);
}

void Verifying::show(Timestamp display_time) {
  if (!visible_at_) {
    visible_at_ = display_time;
  }
}

bool Verifying::shown_before(Timestamp spoken) const {
  return visible_at_ && *visible_at_ <= spoken;
}

std::optional<TouchRefusal> Verifying::record(LevelState& level, const TouchedPlace& place) {
  const auto* touched = std::get_if<Point<World>>(&place);
  if (!touched) {
    return std::get<TouchRefusal>(place);
  }
  if (level.check_points.size() >= nav::kMostCheckPoints) {
    return TouchRefusal{TouchRefusal::Kind::kTooMany};
  }
  level.check_points.push_back(nav::check_point(
      *level.plan.model, level.registration->world_from_vertebra, *touched, rules_));
  judge(level);
  return std::nullopt;
}

bool Verifying::drop(LevelState& level) {
  if (level.check_points.empty()) {
    return false;
  }
  level.check_points.pop_back();
  judge(level);
  return true;
}

ChecksSoFar Verifying::state(const LevelState& level) const {
  ChecksSoFar checks;
  checks.expected_m = nav::worst_m(level.predicted);
  checks.count = level.check_points.size();
  if (checks.count > 0 && level.check_points.back().within) {
    checks.last_m = level.check_points.back().distance_m;
  }
  checks.verdict = &verdict_;
  return checks;
}

}  // namespace orthonav::engine
