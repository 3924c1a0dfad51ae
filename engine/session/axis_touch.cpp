#include "engine/session/axis_touch.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace orthonav::engine {
namespace {

using Axes = std::span<const nav::Axis<World>>;

/// SDs along and about an axis in one pair, as far as few pairs can't tell them; they count as much
/// as this many pairs.
constexpr double kPairTip_m = 0.0006;
constexpr double kPairTurn_rad = 0.004;
constexpr double kPriorPairs = 3.0;
/// Half a second.
constexpr std::size_t kAxesBefore = 15;
/// A tool that differs by more from one quarter of a second to the next is on its way.
constexpr double kTipAtRest_m = 0.001;
constexpr double kTurnAtRest_rad = 0.009;

nav::Axis<World> mean_axis(Axes axes) {
  Vec3 tip;
  Vec3 direction;
  for (const nav::Axis<World>& axis : axes) {
    tip += axis.point.v;
    direction += axis.direction;
  }
  return {{tip / static_cast<double>(axes.size())}, direction.normalized()};
}

bool alike(const nav::Axis<World>& a, const nav::Axis<World>& b) {
  return (a.point - b.point).norm() <= kTipAtRest_m &&
         angle_between_rad(a.direction, b.direction) <= kTurnAtRest_rad;
}

/// Of the mean along one of so many axes, from the squares of what differs from it.
double sd_of_mean(double pair_sd, double squares, double axes, double count) {
  const double variance =
      (kPriorPairs * pair_sd * pair_sd + squares / axes) / (kPriorPairs + count);
  return std::sqrt(variance / count);
}

}  // namespace

AxisTouch::AxisTouch() {
  axes_.reserve(64 + kAxesBefore);
  before_.reserve(kAxesBefore);
}

void AxisTouch::begin() {
  axes_.clear();
  begun_ = true;
  down_ = true;
  lost_ = false;
}

void AxisTouch::drop() {
  axes_.clear();
  before_.clear();
  begun_ = false;
  down_ = false;
  lost_ = false;
}

void AxisTouch::add(const nav::Axis<World>& axis) {
  if (down_) {
    axes_.push_back(axis);
    return;
  }
  if (before_.size() == kAxesBefore) {
    before_.erase(before_.begin());
  }
  before_.push_back(axis);
}

void AxisTouch::lose() {
  before_.clear();
  lost_ = lost_ || begun_;
}

void AxisTouch::take_rest_before() {
  if (before_.size() < kAxesBefore) {
    return;
  }
  const Axes all(before_);
  const auto late = mean_axis(all.last(kAxesBefore / 2));
  if (alike(mean_axis(all.first(kAxesBefore / 2)), late) && alike(late, mean_axis(axes_))) {
    axes_.insert(axes_.end(), before_.begin(), before_.end());
  }
}

std::variant<RestingAxis, TouchRefusal> AxisTouch::take(double max_spread_m, double max_turn_rad) {
  std::variant<RestingAxis, TouchRefusal> found = TouchRefusal{TouchRefusal::Kind::kPressAgain};
  if (begun_ && (lost_ || axes_.empty())) {
    found = TouchRefusal{TouchRefusal::Kind::kGuideNotSeen};
  } else if (begun_) {
    take_rest_before();
    found = mean(max_spread_m, max_turn_rad);
  }
  drop();
  return found;
}

std::variant<RestingAxis, TouchRefusal> AxisTouch::mean(double max_spread_m,
                                                        double max_turn_rad) const {
  const nav::Axis<World> middle = mean_axis(axes_);
  double squares_m2 = 0.0;
  double squares_rad2 = 0.0;
  for (const nav::Axis<World>& axis : axes_) {
    const double off_m = (axis.point - middle.point).norm();
    const double turn_rad = angle_between_rad(axis.direction, middle.direction);
    squares_m2 += off_m * off_m;
    squares_rad2 += turn_rad * turn_rad;
  }
  const auto count = static_cast<double>(axes_.size());
  const double spread_m = std::sqrt(squares_m2 / count);
  const double turn_rad = std::sqrt(squares_rad2 / count);
  if (!(spread_m <= max_spread_m)) {
    return TouchRefusal{TouchRefusal::Kind::kTipMoved, spread_m, max_spread_m};
  }
  if (!(turn_rad <= max_turn_rad)) {
    return TouchRefusal{TouchRefusal::Kind::kSleeveTurned, 0.0, 0.0, turn_rad, max_turn_rad};
  }
  return RestingAxis{middle, sd_of_mean(kPairTurn_rad, squares_rad2, 2.0, count),
                     sd_of_mean(kPairTip_m, squares_m2, 3.0, count), axes_.size()};
}

}  // namespace orthonav::engine
