#include "engine/session/bone_found.h"

#include <algorithm>
#include <cmath>

namespace orthonav::engine {

double BoneFound::walked_sd_m(Timestamp now) const {
  return drift_m_per_sqrt_s * std::sqrt(std::max(0.0, seconds(now - time)));
}

double BoneFound::sd_at_m(Timestamp now) const { return std::hypot(sd_m, walked_sd_m(now)); }

BoneFound found_by_landmark(const BoneFound& before, const LandmarkTouch& touch,
                            const Landmark& landmark, Timestamp now) {
  BoneFound found{now, before.sd_at_m(now), before.drift_m_per_sqrt_s};
  if (!touch.first) {
    const double off_sd_m = touch.off_m / std::sqrt(3.0);
    found.sd_m = std::min(found.sd_m, std::hypot(landmark.bone_sd_m, off_sd_m, touch.sd_m));
  }
  return found;
}

}  // namespace orthonav::engine
