#include "nav/planning/canal.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angle.h"
#include "nav/statistics/median.h"

namespace orthonav::nav {
namespace {

constexpr double kCanalGrid_m = 0.003;
constexpr double kOffMiddle_m = 0.012;
/// Canals are 12-18 mm deep and 20-35 mm wide (Panjabi et al. 1992); with a tilt, somewhat more.
constexpr double kFarthestWall_m = 0.030;
/// Fewer places than this form a dent, not a canal.
constexpr std::size_t kLeastPlaces = 20;

/// The distance to bone along the direction; nothing if none is near, or if the place lies in bone.
std::optional<double> to_bone_m(const SurfaceIndex& surface, Vec3 place_m, Vec3 direction) {
  const auto hit = surface.first_hit(place_m, direction);
  if (!hit || hit->distance_m > kFarthestWall_m || !(hit->normal.dot(direction) < 0.0)) {
    return std::nullopt;
  }
  return hit->distance_m;
}

bool enclosed(const SurfaceIndex& surface, Vec3 place_m) {
  return to_bone_m(surface, place_m, {0, -1, 0}) && to_bone_m(surface, place_m, {0, 1, 0}) &&
         to_bone_m(surface, place_m, {1, 0, 0}) && to_bone_m(surface, place_m, {-1, 0, 0});
}

std::optional<Vec3> middle_of_enclosed(const TriangleMesh& mesh, const SurfaceIndex& surface) {
  const Bounds box = bounds_of(mesh);
  const double middle_x_m = box.centre().x;
  std::vector<double> x, y, z;
  for (double px = middle_x_m - kOffMiddle_m; px <= middle_x_m + kOffMiddle_m; px += kCanalGrid_m) {
    for (double py = box.low.y; py <= box.high.y; py += kCanalGrid_m) {
      for (double pz = box.low.z; pz <= box.high.z; pz += kCanalGrid_m) {
        if (enclosed(surface, {px, py, pz})) {
          x.push_back(px), y.push_back(py), z.push_back(pz);
        }
      }
    }
  }
  if (x.size() < kLeastPlaces) {
    return std::nullopt;
  }
  return Vec3{median(x), median(y), median(z)};
}

/// A line through the canal, and its distance from bone minus the penalty for its lean.
struct Passage {
  Vec3 centre_m;
  Vec3 up{0, 0, 1};
  double free_m = 0.0;
};

/// Takes the line if all of it stays farther from bone than the best so far. Each degree of lean
/// must gain `kPerDegree_m`.
void consider(const SurfaceIndex& surface, Vec3 centre_m, Vec3 up, Passage& best) {
  constexpr double kPerDegree_m = 0.00003;
  const double lost_m = kPerDegree_m * kDegreesPerRadian * angle_between_rad(up, {0, 0, 1});
  constexpr double kHalf_m = 0.010;
  constexpr int kSteps = 4;
  double free_m = 1.0;
  for (int i = -kSteps; i <= kSteps; ++i) {
    const auto near = surface.nearest(centre_m + kHalf_m * i / kSteps * up);
    free_m = std::min(free_m, (near ? near->distance_m : 0.0) - lost_m);
    if (free_m <= best.free_m) {
      return;
    }
  }
  best = {centre_m, up, free_m};
}

Passage widest_passage(const SurfaceIndex& surface, Vec3 middle_m) {
  constexpr int kTilts = 6;   // of 7.5 degrees
  constexpr int kLeans = 2;   // of 10 degrees
  constexpr int kPlaces = 3;  // of 2 mm
  constexpr double kPlace_m = 0.002;
  constexpr double kTilt_rad = 7.5 / kDegreesPerRadian;
  constexpr double kLean_rad = 10.0 / kDegreesPerRadian;
  Passage best;
  for (int tilt = -kTilts; tilt <= kTilts; ++tilt) {
    for (int lean = -kLeans; lean <= kLeans; ++lean) {
      const Vec3 up = Vec3{std::tan(lean * kLean_rad), std::tan(tilt * kTilt_rad), 1}.normalized();
      for (int i = -kPlaces; i <= kPlaces; ++i) {
        for (int k = -kPlaces; k <= kPlaces; ++k) {
          const Vec3 place_m = middle_m + kPlace_m * Vec3{double(i), double(k), 0};
          if (!surface.contains(place_m)) {
            consider(surface, place_m, up, best);
          }
        }
      }
    }
  }
  return best;
}

}  // namespace

std::optional<CanalFrame> find_canal(const TriangleMesh& mesh, const SurfaceIndex& surface) {
  constexpr double kLeastFree_m = 0.003;
  const auto middle_m = middle_of_enclosed(mesh, surface);
  if (!middle_m) {
    return std::nullopt;
  }
  const Passage passage = widest_passage(surface, *middle_m);
  if (passage.free_m < kLeastFree_m) {
    return std::nullopt;
  }
  CanalFrame frame;
  frame.centre_m = passage.centre_m;
  frame.up = passage.up;
  frame.behind = passage.up.cross({1, 0, 0}).normalized();
  frame.left = frame.behind.cross(frame.up);
  const auto body_m = to_bone_m(surface, frame.centre_m, -frame.behind);
  if (!body_m) {
    return std::nullopt;
  }
  // Most of the bone is the body, in front of the canal.
  if ((solid_of(mesh).centroid_m - frame.centre_m).dot(frame.behind) >= 0.0) {
    return std::nullopt;
  }
  frame.to_body_m = *body_m;
  return frame;
}

}  // namespace orthonav::nav
