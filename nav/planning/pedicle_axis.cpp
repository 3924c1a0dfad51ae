#include "nav/planning/pedicle_axis.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angle.h"
#include "nav/geometry/surface_depth.h"

namespace orthonav::nav {
namespace {

/// A ray from this far behind the pedicle meets the bone first at the entry.
constexpr double kFromBehind_m = 0.060;
/// An entry nearer to the pedicle's plane lies on the side of the body, not behind the pedicle.
constexpr double kLeastBehind_m = 0.006;
/// A screw ends this share of the way, and this far, before the far cortex.
constexpr double kFractionBeforeFront = 0.15;
constexpr double kLeastBeforeFront_m = 0.005;

double outward(Side side) { return side == Side::kLeft ? 1.0 : -1.0; }

/// The least depth of the axis between two places; stops early once it is known to be at most
/// `floor_m`. Depth changes by no more than the distance moved, so deep parts are passed in long
/// steps.
double least_depth_m(DepthProbe& depths, Vec3 entry_m, Vec3 direction, double to_m,
                     double floor_m) {
  constexpr double kStep_m = 0.0007;
  double least_m = 1e9;
  for (double at_m = CylinderSurface::kFrom_m;;) {
    const auto depth = depths.at(entry_m + at_m * direction);
    least_m = std::min(least_m, depth ? depth->depth_m : -1.0);
    if (least_m <= floor_m || at_m >= to_m) {
      return least_m;
    }
    at_m = std::min(to_m, at_m + std::max(kStep_m, depth->depth_m - least_m));
  }
}

/// A place in the pedicle's plane, and how deep it lies in bone.
struct Place {
  double lateral_m = 0.0;
  double up_m = 0.0;
  double depth_m = 0.0;
};

}  // namespace

Vec3 PedicleSearch::point_m(Side side, const PedicleAxis& axis) const {
  return canal_.centre_m + outward(side) * axis.lateral_m * canal_.left + axis.up_m * canal_.up -
         0.5 * canal_.to_body_m * canal_.behind;
}

Vec3 PedicleSearch::direction(Side side, const PedicleAxis& axis) const {
  const Vec3 level = -std::cos(axis.convergence_rad) * canal_.behind -
                     outward(side) * std::sin(axis.convergence_rad) * canal_.left;
  return std::cos(axis.cranial_rad) * level + std::sin(axis.cranial_rad) * canal_.up;
}

std::optional<PedicleSearch::Way> PedicleSearch::way(Side side, const PedicleAxis& axis) const {
  const Vec3 through_m = point_m(side, axis);
  Way way;
  way.direction = direction(side, axis);
  const auto front = bone_.first_hit(through_m, way.direction);
  if (!front || !(front->normal.dot(way.direction) > 0.0)) {
    return std::nullopt;
  }
  const auto entry = bone_.first_hit(through_m - kFromBehind_m * way.direction, way.direction);
  if (!entry || !(-entry->normal.dot(way.direction) >= std::cos(steepest_rad_))) {
    return std::nullopt;
  }
  const double behind_m = kFromBehind_m - entry->distance_m;
  if (behind_m < kLeastBehind_m) {
    return std::nullopt;
  }
  way.entry = {entry->point_m};
  way.to_front_m = behind_m + front->distance_m;
  way.to_body_m =
      behind_m + 0.5 * canal_.to_body_m / std::max(0.1, -way.direction.dot(canal_.behind));
  return way;
}

double PedicleSearch::safe_length_m(const Way& way) {
  return way.to_front_m - std::max(kLeastBeforeFront_m, kFractionBeforeFront * way.to_front_m);
}

std::optional<PedicleAxis> PedicleSearch::coarse(Side side, double longest_m) const {
  constexpr double kPlaceGrid_m = 0.0015;
  constexpr double kAngle_rad = 5.0 * kRadiansPerDegree;
  DepthProbe depths(bone_);
  std::vector<Place> places;
  for (int i = 2; i <= 22; ++i) {
    for (int k = -14; k <= 14; ++k) {
      const Place place{kPlaceGrid_m * i, kPlaceGrid_m * k};
      const auto depth = depths.at(point_m(side, {place.lateral_m, place.up_m}));
      if (depth && depth->depth_m > 0.0) {
        places.push_back({place.lateral_m, place.up_m, depth->depth_m});
      }
    }
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.depth_m > b.depth_m; });
  Best best;
  for (const Place& place : places) {
    if (place.depth_m <= best.score_m) {
      break;  // no axis through it is deeper
    }
    for (int i = -1; i <= 8; ++i) {
      for (int k = -5; k <= 5; ++k) {
        consider(side, {place.lateral_m, place.up_m, i * kAngle_rad, k * kAngle_rad}, longest_m,
                 depths, best);
      }
    }
  }
  return best.axis;
}

void PedicleSearch::consider(Side side, const PedicleAxis& axis, double longest_m,
                             DepthProbe& depths, Best& best) const {
  constexpr double kPerDegree_m = 0.00002;
  constexpr double kUsualLength_m = 0.045;
  constexpr double kPerMissing = 0.05;
  const auto there = way(side, axis);
  if (!there) {
    return;
  }
  const double tip_m = std::min(longest_m, safe_length_m(*there));
  if (tip_m <= there->to_body_m) {
    return;
  }
  const double off_rad = std::hypot(axis.convergence_rad - kUsualConvergence_rad, axis.cranial_rad);
  const double lost_m = kPerDegree_m * off_rad * kDegreesPerRadian +
                        kPerMissing * std::max(0.0, kUsualLength_m - tip_m);
  const double score_m =
      least_depth_m(depths, there->entry.v, there->direction, tip_m, best.score_m + lost_m) -
      lost_m;
  if (score_m > best.score_m) {
    best = {axis, score_m};
  }
}

}  // namespace orthonav::nav
