#include "engine/evaluation/bone_edges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/vertex_normals.h"
#include "engine/scan/grid_lines.h"

namespace orthonav::engine {
namespace {

constexpr double kStep_m = 0.0003;
constexpr double kHalfWidth_m = 0.00075;  ///< of the difference that gives a slope
constexpr double kLeastFall_hu = 120.0;
constexpr double kLeastBone_hu = 150.0;

/// One vertex with a normal from each cube that has one.
std::vector<std::size_t> one_in_each_cube(const nav::TriangleMesh& mesh,
                                          const std::vector<Vec3>& areas_m2, double side_m) {
  std::map<std::array<int, 3>, std::size_t> cubes;
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    if (areas_m2[i].squared_norm() > 0.0) {
      const Vec3 q = mesh.vertices_m[i] / side_m;
      cubes.try_emplace({static_cast<int>(std::floor(q.x)), static_cast<int>(std::floor(q.y)),
                         static_cast<int>(std::floor(q.z))},
                        i);
    }
  }
  std::vector<std::size_t> out;
  for (const auto& [cube, vertex] : cubes) {
    out.push_back(vertex);
  }
  return out;
}

/// The values along a normal, from -reach to reach; empty if metal or the border is near.
struct Profile {
  std::vector<double> hu;
  bool masked = false;
  bool outside = false;
};

void read_profile(const ScanField& scan, const MetalMask& mask, Vec3 place_m, Vec3 normal,
                  int reach, Profile& out) {
  out.hu.clear();
  out.masked = mask.covers(place_m);
  out.outside = !scan.holds(place_m);
  if (out.masked || out.outside) {
    return;
  }
  for (int step = -reach; step <= reach; ++step) {
    const Vec3 at_m = place_m + (step * kStep_m) * normal;
    out.hu.push_back(mask.covers(at_m) ? std::nan("") : scan.at(at_m));
  }
}

/// The steepest fall outward, to a fraction of a step.
std::optional<double> steepest_fall_m(const Profile& profile, int reach, double within_m) {
  const int half = static_cast<int>(std::lround(kHalfWidth_m / kStep_m));
  const auto fall = [&](int step) {
    const auto at = static_cast<std::size_t>(step + reach);
    const auto h = static_cast<std::size_t>(half);
    return profile.hu[at - h] - profile.hu[at + h];
  };
  std::optional<int> best;
  double best_score = 0.0;
  const int last = reach - half - 1;
  for (int step = -last; step <= last; ++step) {
    const double f = fall(step);
    const double off = step * kStep_m / within_m;
    const double score = f * (1.0 - 0.5 * off * off);
    // NaN compares false.
    if (f >= kLeastFall_hu && score > best_score &&
        profile.hu[static_cast<std::size_t>(step + reach - half)] >= kLeastBone_hu) {
      best = step;
      best_score = score;
    }
  }
  if (!best || std::abs(*best) == last) {
    return std::nullopt;
  }
  const double before = fall(*best - 1);
  const double here = fall(*best);
  const double after = fall(*best + 1);
  const double curve = before - 2.0 * here + after;
  const double part = curve < 0.0 ? std::clamp(0.5 * (before - after) / curve, -0.5, 0.5) : 0.0;
  return std::isfinite(part) ? std::optional((*best + part) * kStep_m) : std::nullopt;
}

/// Widens the masked voxels along one line by `far` to either side.
void spread(std::size_t start, std::size_t stride, std::size_t count, std::size_t far,
            std::vector<bool>& masked) {
  std::vector<bool> line(count);
  std::size_t until = 0;  // places before this one are near metal
  for (std::size_t i = 0; i < count; ++i) {
    if (masked[start + i * stride]) {
      const std::size_t from = std::max(until, i > far ? i - far : 0);
      until = std::min(count, i + far + 1);
      std::fill(line.begin() + static_cast<std::ptrdiff_t>(from),
                line.begin() + static_cast<std::ptrdiff_t>(until), true);
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    masked[start + i * stride] = line[i];
  }
}

}  // namespace

std::vector<SurfaceSample> surface_samples(const nav::TriangleMesh& mesh, std::size_t wanted) {
  const std::vector<Vec3> areas_m2 = vertex_areas_m2(mesh.vertices_m, mesh.triangles);
  double side_m = 0.001;
  std::vector<std::size_t> kept = one_in_each_cube(mesh, areas_m2, side_m);
  while (kept.size() > wanted) {
    side_m *= 1.1;
    kept = one_in_each_cube(mesh, areas_m2, side_m);
  }
  std::vector<SurfaceSample> out;
  for (const std::size_t vertex : kept) {
    out.push_back({mesh.vertices_m[vertex], areas_m2[vertex].normalized()});
  }
  return out;
}

MetalMask::MetalMask(const ScanField& scan, double margin_m)
    : grid_(scan.grid()), masked_(scan.grid().voxels()) {
  for (std::size_t voxel = 0; voxel < masked_.size(); ++voxel) {
    masked_[voxel] = scan.value(voxel) >= kMetal_hu;
  }
  // Spreading along one index after another turns a voxel into a box.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto far =
        static_cast<std::size_t>(std::ceil(margin_m / grid_.spacing_m[static_cast<int>(axis)]));
    for_each_line(grid_, axis, [&](std::size_t first, std::size_t stride, std::size_t count) {
      spread(first, stride, count, far, masked_);
    });
  }
}

bool MetalMask::covers(Vec3 place_m) const {
  const auto voxel = grid_.voxel_around(place_m);
  return voxel && masked_[*voxel];
}

BoneEdges bone_edges(const ScanField& scan, const MetalMask& mask,
                     const std::vector<SurfaceSample>& samples,
                     const Transform<Scan, Vertebra>& scan_from_vertebra, double within_m) {
  BoneEdges out;
  const int reach = static_cast<int>(std::ceil((within_m + kHalfWidth_m) / kStep_m)) + 1;
  Profile profile;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3 place_m = (scan_from_vertebra * Point<Vertebra>{samples[i].place_m}).v;
    const Vec3 normal = (scan_from_vertebra * Direction<Vertebra>{samples[i].normal}).v;
    read_profile(scan, mask, place_m, normal, reach, profile);
    out.outside += profile.outside ? 1 : 0;
    if (profile.outside || profile.masked) {
      continue;
    }
    ++out.looked_for;
    if (const auto edge = steepest_fall_m(profile, reach, within_m)) {
      out.edges.push_back({i, *edge});
    }
  }
  return out;
}

}  // namespace orthonav::engine
