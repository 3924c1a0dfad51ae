#include "hal/replay/late_poses.h"

#include <iterator>
#include <optional>

#include "hal/api/head_among.h"
#include "hal/replay/map_jumps.h"

namespace orthonav::replay {
namespace {

using Pose = PosesByTicks::value_type;

constexpr Duration kTick(100);

/// Poses in two different worlds can't be interpolated.
bool is_one_motion(const Pose& a, const Pose& b, const std::vector<std::int64_t>& jumps) {
  const Duration apart = (b.first - a.first) * kTick;
  const double apart_s = seconds(apart);
  return jumps_until(jumps, a.first) == jumps_until(jumps, b.first) &&
         apart <= HeadTracker::kMaxHeadPrediction &&
         (b.second.translation() - a.second.translation()).norm() <= kFastestHead_m_s * apart_s &&
         rotation_angle_rad(b.second.rotation(), a.second.rotation()) <=
             kFastestHead_rad_s * apart_s;
}

/// On the way from `a` to `b`, or before `a` on its line.
Transform<World, Rig> at(double ticks, const Pose& a, const Pose& b) {
  return interpolated(
      a.second, b.second,
      (ticks - static_cast<double>(a.first)) / static_cast<double>(b.first - a.first));
}

}  // namespace

PosesByTicks poses_at_exposure(const PosesByTicks& at_stamps, Duration late,
                               const std::vector<std::int64_t>& jumps) {
  const double late_ticks = static_cast<double>(late / kTick);
  PosesByTicks poses;
  for (auto here = at_stamps.begin(); here != at_stamps.end(); ++here) {
    const double taken = static_cast<double>(here->first) - late_ticks;
    const auto after = std::next(here);
    if (here != at_stamps.begin() && is_one_motion(*std::prev(here), *here, jumps)) {
      poses.emplace(here->first, at(taken, *std::prev(here), *here));
    } else if (after != at_stamps.end() && is_one_motion(*here, *after, jumps)) {
      poses.emplace(here->first, at(taken, *here, *after));
    }
  }
  return poses;
}

}  // namespace orthonav::replay
