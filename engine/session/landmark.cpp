#include "engine/session/landmark.h"

#include <algorithm>
#include <cmath>

namespace orthonav::engine {

double LandmarkRules::touch_variance_m2(bool anchored) const {
  const double lasting_m = anchored ? lasting_sd_anchored_m : lasting_sd_m;
  return dimple_sd_m * dimple_sd_m + lasting_m * lasting_m;
}

double LandmarkRules::distance_sd_m(double recorded_sd_m, double sd_m, bool anchored) const {
  return std::sqrt(recorded_sd_m * recorded_sd_m + sd_m * sd_m +
                   2.0 * touch_variance_m2(anchored) / touches_of(anchored));
}

double LandmarkRules::limit_m(double distance_sd_m) const {
  return std::min(sds * distance_sd_m, most_m);
}

double LandmarkRules::apart_m(double sd_m, bool anchored) const {
  return sds * std::sqrt(2.0 * (sd_m * sd_m + touch_variance_m2(anchored)));
}

std::vector<std::string> LandmarkRules::check() const {
  std::vector<std::string> problems;
  const auto in = [&problems](const char* name, double value, double above, double most) {
    if (!(value > above && value <= most)) {
      problems.push_back(std::string(name) + " must lie in (" + std::to_string(above) + ", " +
                         std::to_string(most) + "]");
    }
  };
  in("landmark.dimple_sd_m", dimple_sd_m, 0.0, 0.001);
  for (const int count : {touches, touches_anchored}) {
    if (count < 1 || count > 5) {
      problems.emplace_back("landmark.touches must lie in [1, 5]");
    }
  }
  in("landmark.lasting_sd_m", lasting_sd_m, 0.0, 0.001);
  in("landmark.lasting_sd_anchored_m", lasting_sd_anchored_m, 0.0, 0.001);
  in("landmark.sds", sds, 2.0, 6.0);
  in("landmark.most_m", most_m, 0.0005, 0.003);
  in("landmark.most_walked_m", most_walked_m, 0.0, 0.003);
  in("landmark.from_reference_m", from_reference_m, 0.0, 0.1);
  in("landmark.reach", reach, 0.0, 1.0);
  return problems;
}

}  // namespace orthonav::engine
