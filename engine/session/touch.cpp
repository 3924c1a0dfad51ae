#include "engine/session/touch.h"

#include <cmath>
#include <span>

namespace orthonav::engine {

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

}  // namespace orthonav::engine
