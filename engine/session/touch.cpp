#include "engine/session/touch.h"

#include <cmath>
#include <span>

namespace orthonav::engine {

double sd_of_mean(double sample_sd, double squares, double axes, double count) {
  constexpr double kPriorSamples = 3.0;
  const double variance =
      (kPriorSamples * sample_sd * sample_sd + squares / axes) / (kPriorSamples + count);
  return std::sqrt(variance / count);
}

namespace {

Vec3 mean_of(std::span<const Point<World>> tips) {
  Vec3 sum{};
  for (const Point<World>& tip : tips) {
    sum += tip.v;
  }
  return sum / static_cast<double>(tips.size());
}

bool at_rest(Vec3 a, Vec3 b) { return (a - b).norm() <= kTipAtRest_m; }

}  // namespace

TouchedPlace Touch::take_place(const std::optional<Point<World>>& last_tip, double max_spread_m) {
  TouchedPlace place = TouchRefusal{TouchRefusal::Kind::kPressAgain};
  if (tips_.begun() && !tips_.samples().empty()) {
    tips_.take_rest_before(mean_of, at_rest);
    place = mean_tip(max_spread_m);
  } else if (tips_.begun() && last_tip) {
    place = nav::PressedPlace{*last_tip, kRestingTipSd_m};
  } else if (tips_.begun()) {
    place = TouchRefusal{TouchRefusal::Kind::kPointerNotSeen};
  }
  drop();
  return place;
}

TouchedPlace Touch::mean_tip(double max_spread_m) const {
  const auto count = static_cast<double>(tips_.samples().size());
  const Vec3 mean = mean_of(tips_.samples());
  double squares = 0.0;
  for (const Point<World>& tip : tips_.samples()) {
    squares += (tip.v - mean).dot(tip.v - mean);
  }
  const double spread_m = std::sqrt(squares / count);
  if (spread_m <= max_spread_m) {
    return nav::PressedPlace{{mean}, sd_of_mean(kRestingTipSd_m, squares, 3.0, count)};
  }
  return TouchRefusal{TouchRefusal::Kind::kTipMoved, spread_m, max_spread_m};
}

namespace {

using ToolAxes = std::span<const nav::Axis<World>>;

/// SD about an axis in one pair, used where few pairs can't show it.
constexpr double kPairTurn_rad = 0.004;
/// A tool that turns by more from one quarter of a second to the next is not at rest.
constexpr double kTurnAtRest_rad = 0.009;

nav::Axis<World> mean_axis(ToolAxes axes) {
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

}  // namespace

std::variant<RestingAxis, TouchRefusal> AxisTouch::take(double max_spread_m, double max_turn_rad) {
  std::variant<RestingAxis, TouchRefusal> found = TouchRefusal{TouchRefusal::Kind::kPressAgain};
  if (axes_.begun() && (axes_.lost() || axes_.samples().empty())) {
    found = TouchRefusal{TouchRefusal::Kind::kGuideNotSeen};
  } else if (axes_.begun()) {
    axes_.take_rest_before(mean_axis, alike);
    found = mean(max_spread_m, max_turn_rad);
  }
  drop();
  return found;
}

std::variant<RestingAxis, TouchRefusal> AxisTouch::mean(double max_spread_m,
                                                        double max_turn_rad) const {
  const nav::Axis<World> middle = mean_axis(axes_.samples());
  double squares_m2 = 0.0;
  double squares_rad2 = 0.0;
  for (const nav::Axis<World>& axis : axes_.samples()) {
    const double off_m = (axis.point - middle.point).norm();
    const double turn_rad = angle_between_rad(axis.direction, middle.direction);
    squares_m2 += off_m * off_m;
    squares_rad2 += turn_rad * turn_rad;
  }
  const auto count = static_cast<double>(axes_.samples().size());
  const double spread_m = std::sqrt(squares_m2 / count);
  const double turn_rad = std::sqrt(squares_rad2 / count);
  if (!(spread_m <= max_spread_m)) {
    return TouchRefusal{TouchRefusal::Kind::kTipMoved, spread_m, max_spread_m};
  }
  if (!(turn_rad <= max_turn_rad)) {
    return TouchRefusal{TouchRefusal::Kind::kSleeveTurned, 0.0, 0.0, turn_rad, max_turn_rad};
  }
  return RestingAxis{middle, sd_of_mean(kPairTurn_rad, squares_rad2, 2.0, count),
                     sd_of_mean(kRestingTipSd_m, squares_m2, 3.0, count), axes_.samples().size()};
}

}  // namespace orthonav::engine
