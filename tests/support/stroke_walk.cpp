#include "tests/support/stroke_walk.h"

#include <algorithm>
#include <cmath>

#include "base/angle.h"

namespace orthonav::test {
namespace {

constexpr double kAimStep_m = 0.00025;
/// A tip that moves more in one step has fallen off an edge.
constexpr double kFall_m = 0.0012;
constexpr double kShortestWalk_m = 0.006;
/// The pointer starts this far outside.
constexpr double kOutside_m = 0.15;
/// Cosine between the pointer and the surface's normal below which it can't be held on the bone.
constexpr double kFlattest = 0.12;
/// Over the canal: how far in front of its back wall the tip goes, as a fraction of its depth.
constexpr double kDeepest = 0.5;
/// How the handle slants along a lane.
constexpr double kSlant_rad = 6.0 * kRadiansPerDegree;

bool is_spinous_side(BoneRegion r) {
  return r == BoneRegion::kLeftSpinousSide || r == BoneRegion::kRightSpinousSide;
}

}  // namespace

const Touch& Walk::at(double along_m) const {
  const auto after = std::lower_bound(arc_m.begin(), arc_m.end(), along_m);
  if (after == arc_m.end()) {
    return touches.back();
  }
  const auto i = static_cast<std::size_t>(after - arc_m.begin());
  return i > 0 && along_m - arc_m[i - 1] < arc_m[i] - along_m ? touches[i - 1] : touches[i];
}

Walk Walk::part(double from_m, double to_m) const {
  Walk cut{region, {}, {}};
  for (std::size_t i = 0; i < touches.size(); ++i) {
    if (arc_m[i] < from_m || arc_m[i] > to_m) {
      continue;
    }
    cut.touches.push_back(touches[i]);
    cut.arc_m.push_back(arc_m[i]);
  }
  const double start_m = cut.arc_m.empty() ? 0.0 : cut.arc_m.front();
  for (double& s : cut.arc_m) {
    s -= start_m;
  }
  return cut;
}

bool TouchableBone::belongs(BoneRegion region, const Touch& touch) const {
  constexpr double kOverCrest_m = 0.002;
  if (touch.normal.dot(touch.approach) < kFlattest) {
    return false;
  }
  const double aside_m = touch.surface_m.x - marks_.midline_x_m;
  const double width_m = marks_.canal_half_width_m;
  const double y_m = touch.surface_m.y;
  // Between the laminae the body's back wall is visible through the canal, which is closed by
  // ligament, and beside the isthmus the body's rear edge, where the nerve root lies.
  const double canal_m = marks_.arch_front_y_m - marks_.body_back_y_m;
  const double depth_m = marks_.arch_front_y_m - y_m;
  if (depth_m > (std::abs(aside_m) < 1.2 * width_m ? kDeepest : pointer_.deepest_aside) * canal_m) {
    return false;
  }
  const int side = side_of(region);
  if (is_spinous_side(region)) {
    return side * aside_m > -kOverCrest_m && std::abs(aside_m) < width_m;
  }
  return std::abs(aside_m) < 2.6 * width_m && side * aside_m >= 0.0;
}

std::optional<Touch> TouchableBone::lower(Vec3 aim_m, Vec3 approach) const {
  const Vec3 start_m = aim_m + kOutside_m * approach;
  if (pointer_.tip_radius_m <= 0.0) {
    const auto hit = surface_->first_hit(start_m, -approach);
    if (!hit) {
      return std::nullopt;
    }
    return Touch{hit->point_m, hit->point_m, hit->normal, approach};
  }
  // The ball may move by its distance from the surface before the distance is measured again.
  constexpr double kTouching_m = 1e-6;
  constexpr int kMostSteps = 400;
  double gone_m = 0.0;
  for (int step = 0; step < kMostSteps && gone_m < 2.0 * kOutside_m; ++step) {
    const Vec3 centre_m = start_m - gone_m * approach;
    const auto near = surface_->nearest(centre_m);
    if (!near) {
      return std::nullopt;
    }
    const double free_m = near->distance_m - pointer_.tip_radius_m;
    if (free_m < kTouching_m) {
      return Touch{centre_m, near->point_m, (centre_m - near->point_m).normalized(), approach};
    }
    gone_m += free_m;
  }
  return std::nullopt;
}

std::vector<Walk> TouchableBone::walk(const Lane& lane) const {
  std::vector<Walk> walks;
  Walk walk{lane.region, {}, {}};
  const auto end = [&] {
    if (walk.length_m() >= kShortestWalk_m) {
      walks.push_back(walk);
    }
    walk.touches.clear();
    walk.arc_m.clear();
  };
  const double length_m = (lane.to_m - lane.from_m).norm();
  const Vec3 along = (lane.to_m - lane.from_m).normalized();
  const Vec3 across = along.cross(lane.approach()).normalized();
  for (double s_m = 0.0; s_m <= length_m; s_m += kAimStep_m) {
    const double wave_rad = 2.0 * std::numbers::pi * s_m / lane.wave_m + lane.phase_rad;
    const Vec3 aim_m = lane.from_m + s_m * along + lane.sway_m * std::sin(wave_rad) * across;
    const auto touch = lower(aim_m, lane.approach(kSlant_rad * std::sin(0.37 * wave_rad),
                                                  kSlant_rad * std::cos(0.53 * wave_rad)));
    if (!touch || !belongs(lane.region, *touch)) {
      end();
      continue;
    }
    const double step_m =
        walk.touches.empty() ? 0.0 : (touch->tip_m - walk.touches.back().tip_m).norm();
    if (step_m > kFall_m) {
      end();
    }
    walk.arc_m.push_back(walk.arc_m.empty() ? 0.0 : walk.arc_m.back() + step_m);
    walk.touches.push_back(*touch);
  }
  end();
  return walks;
}

}  // namespace orthonav::test
