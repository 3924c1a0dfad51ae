#include "engine/session/tip_check.h"

#include <algorithm>
#include <cmath>

namespace orthonav::engine {

double TipCheck::along_sight_m(double size_sd) const {
  return rules_.distance_m * std::max(size_sd, rules_.least_size_sd);
}

double TipCheck::difference_sd_m(double size_sd, const Mat3& bone_from_guide) const {
  const double tags_m = along_sight_m(size_sd) / std::sqrt(3.0);
  const double prior_m = rules_.prior_sd_m;
  if (!last_ || !(prior_m > 0.0)) {
    return std::hypot(prior_m, tags_m);
  }
  // The posterior of two normal distributions; without consent the tip stays off by the mean.
  const double left_m = prior_m * last_->sd_m / std::hypot(prior_m, last_->sd_m);
  const double off_m = last_->corrected ? 0.0 : last_->by_m.norm() / std::sqrt(3.0);
  // Half of the difference is the pointer's, on average, and does not turn with the guide: turned
  // by an angle a, that part (SD `prior_m` / sqrt(2)) is off by 2 sin(a/2) in two of three
  // directions.
  const double turned_rad = rotation_angle_rad(held_, bone_from_guide);
  const double turned_m = std::sqrt(4.0 / 3.0) * std::sin(0.5 * turned_rad) * prior_m;
  return std::hypot(std::hypot(left_m, off_m, tags_m), turned_m);
}

std::variant<TipDifference, TouchRefusal> TipCheck::take(
    const nav::PressedPlace& place, const Transform<World, Marker>& world_from_guide,
    const nav::PressedPlace& pointer_tip, bool anchored, double size_sd) {
  const double tags_m = along_sight_m(size_sd);
  const double each_m2 = landmark_.touch_variance_m2(anchored);
  TipDifference found;
  found.apart_m = world_from_guide.rotation().transposed() * (place.place - pointer_tip.place);
  // The pointer's place is the mean of all its touches; the guide's is a single touch.
  found.sd_m = std::sqrt(place.sd_m * place.sd_m + pointer_tip.sd_m * pointer_tip.sd_m + each_m2 +
                         each_m2 / landmark_.touches_of(anchored) + tags_m * tags_m / 3.0);
  const double prior_m2 = rules_.prior_sd_m * rules_.prior_sd_m;
  const double known = prior_m2 / (prior_m2 + found.sd_m * found.sd_m);
  found.by_m = known * found.apart_m;
  found.limit_m = rules_.worth_m / known;
  if (!(known > 0.0)) {
    found.limit_m = rules_.most_m;  // tips that are known exactly need no correction
  }
  if (!(found.apart_m.norm() <= rules_.most_m)) {
    return TouchRefusal{TouchRefusal::Kind::kTouchesApart, found.apart_m.norm(), rules_.most_m};
  }
  last_ = found;
  compared_ = true;
  return found;
}

Vec3 TipCheck::correct() {
  last_->corrected = true;
  return last_->by_m;
}

}  // namespace orthonav::engine
