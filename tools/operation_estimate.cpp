#include "tools/operation_estimate.h"

#include <algorithm>
#include <cmath>

namespace orthonav::tools {
namespace {

// The approximate time of each part in the simulated room, in seconds.
constexpr double kDigitize_s = 150.0;
constexpr double kVerify_s = 30.0;
constexpr double kScrew_s = 45.0;
constexpr double kRods_s = 60.0;

double usual_s(Step step) {
  switch (step) {
    case Step::kDigitize:
      return kDigitize_s;
    case Step::kVerify:
      return kVerify_s;
    case Step::kGuide:
    case Step::kPlaced:
      return kScrew_s;
    case Step::kRod:
      return kRods_s;
    default:
      return 0.0;
  }
}

/// The done fraction of a step that usually takes this long; never reaches 1.
double done_of_s(double usual_s, double since_s) {
  return usual_s > 0.0 ? 0.95 * usual_s * (1.0 - std::exp(-since_s / usual_s)) : 0.0;
}

}  // namespace

double OperationEstimate::fraction(Timestamp time, const engine::Guidance& guidance) {
  if (step_ != guidance.status.at) {
    step_ = guidance.status.at;
    step_began_ = time;
  }
  // A rod joins levels; without levels there are rods alone.
  double all_s = guidance.levels.size() != 1 ? kRods_s : 0.0;
  double done_s = done_of_s(usual_s(guidance.step), seconds(time - step_began_));
  for (const engine::LevelState& level : guidance.levels) {
    const double screws = static_cast<double>(level.screw_done.size());
    const auto done = std::count(level.screw_done.begin(), level.screw_done.end(), true);
    all_s += kDigitize_s + kVerify_s + screws * kScrew_s;
    done_s += (level.registration ? kDigitize_s : 0.0) + (level.accepted ? kVerify_s : 0.0) +
              static_cast<double>(done) * kScrew_s;
  }
  const bool finished = guidance.step == Step::kDone;
  most_ = std::max(most_, finished ? 1.0 : std::min(done_s / all_s, 0.99));
  return most_;
}

}  // namespace orthonav::tools
