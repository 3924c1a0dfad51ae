#include "engine/session/touch.h"

#include <cmath>
#include <span>

namespace orthonav::engine {

namespace {

/// SD along an axis of a tip at rest in one pair, as far as few pairs can't tell it: jitter of the
/// head's pose, and tremor. It counts as much as this many pairs.
constexpr double kTipSd_m = 0.0006;
constexpr double kTipSdPairs = 3.0;
/// Half a second.
constexpr std::size_t kPairsBefore = 15;
/// A tip whose place in one quarter of a second differs by more from that in the next one is on its
/// way, not at rest: twice what jitter and tremor do.
constexpr double kAtRest_m = 0.001;

Vec3 mean_of(std::span<const Point<World>> tips) {
  Vec3 sum{};
  for (const Point<World>& tip : tips) {
    sum += tip.v;
  }
  return sum / static_cast<double>(tips.size());
}

}  // namespace

Touch::Touch() {
  tips_.reserve(64 + kPairsBefore);
  before_.reserve(kPairsBefore);
}

void Touch::add(Point<World> tip) {
  if (down_) {
    tips_.push_back(tip);
    return;
  }
  if (before_.size() == kPairsBefore) {
    before_.erase(before_.begin());
  }
  before_.push_back(tip);
}

void Touch::take_rest_before() {
  if (before_.size() < kPairsBefore) {
    return;
  }
  const auto half = static_cast<std::ptrdiff_t>(kPairsBefore / 2);
  const Vec3 early = mean_of({before_.begin(), before_.begin() + half});
  const Vec3 late = mean_of({before_.end() - half, before_.end()});
  const Vec3 pressed = mean_of(tips_);
  if ((early - late).norm() <= kAtRest_m && (late - pressed).norm() <= kAtRest_m) {
    tips_.insert(tips_.end(), before_.begin(), before_.end());
  }
}

void Touch::begin() {
  tips_.clear();
  begun_ = true;
  down_ = true;
}

void Touch::drop() {
  tips_.clear();
  before_.clear();
  begun_ = false;
  down_ = false;
}

TouchedPlace Touch::take_place(const std::optional<Point<World>>& last_tip, double max_spread_m) {
  TouchedPlace place = TouchRefusal{TouchRefusal::Kind::kPressAgain};
  if (begun_ && !tips_.empty()) {
    take_rest_before();
    place = mean_tip(max_spread_m);
  } else if (begun_ && last_tip) {
    place = nav::PressedPlace{*last_tip, kTipSd_m};
  } else if (begun_) {
    place = TouchRefusal{TouchRefusal::Kind::kPointerNotSeen};
  }
  drop();
  return place;
}

TouchedPlace Touch::mean_tip(double max_spread_m) const {
  const auto count = static_cast<double>(tips_.size());
  const Vec3 mean = mean_of(tips_);
  double squares = 0.0;
  for (const Point<World>& tip : tips_) {
    squares += (tip.v - mean).dot(tip.v - mean);
  }
  const double spread_m = std::sqrt(squares / count);
  if (spread_m <= max_spread_m) {
    const double variance_m2 =
        (kTipSdPairs * kTipSd_m * kTipSd_m + squares / 3.0) / (kTipSdPairs + count);
    return nav::PressedPlace{{mean}, std::sqrt(variance_m2 / count)};
  }
  return TouchRefusal{TouchRefusal::Kind::kTipMoved, spread_m, max_spread_m};
}

}  // namespace orthonav::engine
