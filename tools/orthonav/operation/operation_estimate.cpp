#include "tools/orthonav/operation/operation_estimate.h"

#include <algorithm>
#include <cmath>

namespace orthonav::tools {
namespace {

// The usual time of each part in the simulated room, in seconds.
constexpr double kDigitize_s = 150.0;
constexpr double kVerify_s = 30.0;
constexpr double kGuide_s = 25.0;
constexpr double kPlaced_s = 25.0;
constexpr double kRods_s = 25.0;

double usual_s(engine::Step step) {
  switch (step) {
    case engine::Step::kDigitize:
      return kDigitize_s;
    case engine::Step::kVerify:
      return kVerify_s;
    case engine::Step::kGuide:
      return kGuide_s;
    case engine::Step::kMeasureWire:
      return kPlaced_s;
    case engine::Step::kRod:
      return kRods_s;
    default:
      return 0.0;
  }
}

/// What is done of a step that usually takes this long; never all of it.
double done_of_s(double usual_s, double since_s) {
  return usual_s > 0.0 ? 0.95 * usual_s * (1.0 - std::exp(-since_s / usual_s)) : 0.0;
}

double left_s(const engine::LevelState& level) {
  const auto screws = std::ranges::count(level.screws, false, &engine::ScrewState::done);
  return (level.registration ? 0.0 : kDigitize_s) + (level.accepted ? 0.0 : kVerify_s) +
         static_cast<double>(screws) * (kGuide_s + kPlaced_s);
}

}  // namespace

double OperationEstimate::fraction(Timestamp time, const engine::Guidance& guidance) {
  if (!began_) {
    began_ = time;
  }
  if (step_ != guidance.status.at) {
    step_ = guidance.status.at;
    step_began_ = time;
  }
  if (guidance.step == engine::Step::kDone) {
    return most_ = 1.0;
  }
  // A rod joins levels; without levels there are rods alone.
  double all_left_s = guidance.levels.size() != 1 ? kRods_s : 0.0;
  for (const engine::LevelState& level : guidance.levels) {
    all_left_s += left_s(level);
  }
  all_left_s -= done_of_s(usual_s(guidance.step), seconds(time - step_began_)) +
                (guidance.step == engine::Step::kMeasureWire ? kGuide_s : 0.0);
  const double passed_s = seconds(time - *began_);
  most_ = std::max(most_, std::min(passed_s / (passed_s + std::max(all_left_s, 1.0)), 0.99));
  return most_;
}

}  // namespace orthonav::tools
