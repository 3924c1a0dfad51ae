#include "engine/session/landmark.h"

#include <algorithm>
#include <cmath>

namespace orthonav::engine {

double landmark_variance_m2(bool anchored) {
  const double lasting_m = anchored ? kLastingSdAnchored_m : kLastingSd_m;
  return kLandmarkSeatingSd_m * kLandmarkSeatingSd_m + lasting_m * lasting_m;
}

double landmark_distance_sd_m(double recorded_sd_m, double sd_m, bool anchored) {
  return std::sqrt(recorded_sd_m * recorded_sd_m + sd_m * sd_m +
                   2.0 * landmark_variance_m2(anchored) / landmark_touches(anchored));
}

double landmark_limit_m(double distance_sd_m) {
  return std::min(kLandmarkSds * distance_sd_m, kMaxLandmarkOff_m);
}

double landmark_apart_m(double sd_m, bool anchored) {
  return kLandmarkSds * std::sqrt(2.0 * (sd_m * sd_m + landmark_variance_m2(anchored)));
}

}  // namespace orthonav::engine
