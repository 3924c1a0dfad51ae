#include "hal/sim/surgeon/drilling.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hal/sim/surgeon/surgeon_body.h"

namespace orthonav::sim {
namespace {

constexpr double kTick_s = 1.0 / 120.0;

}  // namespace

double left_by_correcting() {
  static const double left = [] {
    const auto ticks = static_cast<std::size_t>(kDriving_s / kTick_s);
    const auto reaction = static_cast<std::size_t>(kReaction_s / kTick_s);
    std::vector<double> seen;
    double corrected = 0.0;
    double wire = 0.0;
    for (std::size_t i = 0; i < ticks; ++i) {
      const double way = minimum_jerk(static_cast<double>(i) / static_cast<double>(ticks));
      const double next = minimum_jerk(static_cast<double>(i + 1) / static_cast<double>(ticks));
      // A hand that turns evenly with the advance turns by twice what the chord does.
      seen.push_back(2.0 * way + corrected);
      if (i >= reaction) {
        corrected -= kGain_per_s * kTick_s * seen[i - reaction];
      }
      wire += (next - way) * seen.back();
    }
    return wire;
  }();
  return left;
}

HandWhileDrilling hand_while_drilling(const ErrorModel& error_model, GuidanceProfile guidance) {
  if (guidance != GuidanceProfile::kClosedLoop) {
    return {error_model.hand_drilling_rad, 0.0};
  }
  const double total = error_model.hand_drilling_corrected_rad;
  const double left = left_by_correcting();
  const double of_wire = std::min(error_model.hand_drilling_rad, total / left);
  const double seen = left * of_wire;
  return {of_wire, std::sqrt(std::max(0.0, total * total - seen * seen))};
}

void AdvancingWire::follow(Vec3 inwards, const Drilling& now) {
  sum_ += (now.way - newest_.way) * inwards;
  newest_ = now;
}

Vec3 AdvancingWire::direction(Vec3 first) const {
  return sum_.norm() > 0.0 ? sum_.normalized() : first;
}

}  // namespace orthonav::sim
