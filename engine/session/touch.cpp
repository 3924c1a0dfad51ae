#include "engine/session/touch.h"

#include <cmath>

namespace orthonav::engine {

Touch::Touch() { tips_.reserve(64); }

void Touch::begin() {
  tips_.clear();
  begun_ = true;
  down_ = true;
}

void Touch::drop() {
  tips_.clear();
  begun_ = false;
  down_ = false;
}

TouchedPlace Touch::take_place(const std::optional<Point<World>>& last_tip, double max_spread_m) {
  TouchedPlace place = TouchRefusal{TouchRefusal::Kind::kPressAgain};
  if (begun_ && !tips_.empty()) {
    place = mean_tip(max_spread_m);
  } else if (begun_ && last_tip) {
    place = *last_tip;
  } else if (begun_) {
    place = TouchRefusal{TouchRefusal::Kind::kPointerNotSeen};
  }
  drop();
  return place;
}

TouchedPlace Touch::mean_tip(double max_spread_m) const {
  const auto count = static_cast<double>(tips_.size());
  Vec3 sum{};
  for (const Point<World>& tip : tips_) {
    sum += tip.v;
  }
  const Vec3 mean = sum / count;
  double squares = 0.0;
  for (const Point<World>& tip : tips_) {
    squares += (tip.v - mean).dot(tip.v - mean);
  }
  const double spread_m = std::sqrt(squares / count);
  if (spread_m <= max_spread_m) {
    return Point<World>{mean};
  }
  return TouchRefusal{TouchRefusal::Kind::kTipMoved, spread_m, max_spread_m};
}

}  // namespace orthonav::engine
