#include "tools/orthonav/sample/sample_scan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/printed.h"
#include "base/random.h"
#include "engine/io/atomic_file.h"

namespace orthonav::tools {
namespace {

constexpr double kVoxel_m = 0.0008;
constexpr double kMargin_m = 0.015;
constexpr double kCortex_m = 0.0012;
constexpr double kSoft_hu = 30.0;
constexpr double kCortex_hu = 950.0;
constexpr double kCancellous_hu = 230.0;
constexpr double kTitanium_hu = 8000.0;
constexpr double kNoise_hu = 20.0;
/// What 12 bits hold.
constexpr double kLowest_hu = -1024.0;
constexpr double kHighest_hu = 3071.0;
/// Of a head, which begins at the bone.
constexpr double kHeadLength_m = 0.012;
constexpr double kHeadRadius_m = 0.006;

/// The share of a voxel within a surface, by the signed distance of its middle (negative inside).
double share_inside(double outside_m) { return std::clamp(0.5 - outside_m / kVoxel_m, 0.0, 1.0); }

double outside_cylinder_m(Vec3 from_m, Vec3 to_m, double radius_m, Vec3 place_m) {
  const Vec3 way = to_m - from_m;
  const double length_m = way.norm();
  const double along_m = (place_m - from_m).dot(way) / length_m;
  const double across_m = (place_m - from_m - (along_m / length_m) * way).norm();
  return std::max({across_m - radius_m, -along_m, along_m - length_m});
}

double outside_screw_m(const MetalScrew& screw, Vec3 place_m) {
  const Vec3 back = (screw.entry_m - screw.tip_m).normalized();
  const Vec3 head_m = screw.entry_m + kHeadLength_m * back;
  return std::min(outside_cylinder_m(screw.entry_m, screw.tip_m, screw.radius_m, place_m),
                  outside_cylinder_m(screw.entry_m, head_m, kHeadRadius_m, place_m));
}

/// Indices from `first` up to `end` along each axis.
struct Block {
  std::array<int, 3> first{};
  std::array<int, 3> end{};
};

Block block_about(const engine::VolumeGrid& grid, Vec3 low_m, Vec3 high_m) {
  Block block;
  const Vec3 first = grid.index_of(low_m);
  const Vec3 last = grid.index_of(high_m);
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<std::size_t>(a);
    block.first[n] = std::clamp(static_cast<int>(first[a]) - 2, 0, grid.size[n]);
    block.end[n] = std::clamp(static_cast<int>(last[a]) + 3, 0, grid.size[n]);
  }
  return block;
}

template <class Do>
void for_each_voxel(const engine::VolumeGrid& grid, const Block& block, const Do& act) {
  for (int k = block.first[2]; k < block.end[2]; ++k) {
    for (int j = block.first[1]; j < block.end[1]; ++j) {
      for (int i = block.first[0]; i < block.end[0]; ++i) {
        act(grid.at(i, j, k), grid.place_m({double(i), double(j), double(k)}));
      }
    }
  }
}

void mix(float& hu, double share, double other_hu) {
  hu += static_cast<float>(share * (other_hu - static_cast<double>(hu)));
}

void put_bone(const nav::TriangleMesh& mesh, float value, SampleScan& scan) {
  const nav::SurfaceIndex surface(mesh);
  const nav::Bounds bounds = nav::bounds_of(mesh);
  const engine::VolumeGrid& grid = scan.ct.grid;
  // No surface is within `clear_m` of `seen_m`, so that nearby voxels lie on the same side of it.
  Vec3 seen_m;
  double clear_m = 0.0;
  bool inside = false;
  for_each_voxel(grid, block_about(grid, bounds.low, bounds.high), [&](std::size_t n, Vec3 p) {
    double depth_m = clear_m - (p - seen_m).norm();
    if (depth_m < kCortex_m + kVoxel_m) {
      seen_m = p;
      depth_m = clear_m = surface.nearest(p)->distance_m;
      inside = surface.contains(p);
    }
    mix(scan.ct.values[n], share_inside(inside ? -depth_m : depth_m), kCortex_hu);
    if (inside) {
      mix(scan.ct.values[n], share_inside(kCortex_m - depth_m), kCancellous_hu);
      scan.labels.values[n] = value;
    }
  });
}

void put_screw(const MetalScrew& screw, engine::Volume& ct) {
  Vec3 low = screw.tip_m;
  Vec3 high = screw.tip_m;
  for (int a = 0; a < 3; ++a) {
    constexpr double kBeyond_m = kHeadLength_m + kHeadRadius_m;
    low[a] = std::min(low[a], screw.entry_m[a] - kBeyond_m);
    high[a] = std::max(high[a], screw.entry_m[a] + kBeyond_m);
  }
  for_each_voxel(ct.grid, block_about(ct.grid, low, high), [&](std::size_t n, Vec3 p) {
    mix(ct.values[n], share_inside(outside_screw_m(screw, p)), kTitanium_hu);
  });
}

engine::VolumeGrid grid_about(const std::vector<nav::TriangleMesh>& meshes) {
  nav::Bounds all = nav::bounds_of(meshes.front());
  for (const nav::TriangleMesh& mesh : meshes) {
    const nav::Bounds one = nav::bounds_of(mesh);
    for (int a = 0; a < 3; ++a) {
      all.low[a] = std::min(all.low[a], one.low[a]);
      all.high[a] = std::max(all.high[a], one.high[a]);
    }
  }
  engine::VolumeGrid grid;
  grid.spacing_m = {kVoxel_m, kVoxel_m, kVoxel_m};
  grid.origin_m = all.low - Vec3{kMargin_m, kMargin_m, kMargin_m};
  for (int a = 0; a < 3; ++a) {
    grid.size[static_cast<std::size_t>(a)] =
        static_cast<int>((all.high[a] - all.low[a] + 2.0 * kMargin_m) / kVoxel_m) + 1;
  }
  return grid;
}

}  // namespace

SampleScan scan_of(const engine::Case& subject, std::span<const MetalScrew> screws) {
  std::vector<nav::TriangleMesh> meshes;
  for (const engine::CaseLevel& level : subject.levels) {
    meshes.push_back(level.mesh);
    for (Vec3& v : meshes.back().vertices_m) {
      v = (level.spine_from_vertebra * Point<Vertebra>{v}).v;
    }
  }
  SampleScan scan;
  scan.ct.grid = scan.labels.grid = grid_about(meshes);
  scan.ct.values.assign(scan.ct.grid.voxels(), static_cast<float>(kSoft_hu));
  scan.labels.values.assign(scan.ct.grid.voxels(), 0.0F);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    constexpr int kBeforeL1 = 19;
    put_bone(meshes[i], static_cast<float>(kBeforeL1 + subject.levels[i].label.back() - '0'), scan);
  }
  for (const MetalScrew& screw : screws) {
    put_screw(screw, scan.ct);
  }
  Random random(1);
  for (float& hu : scan.ct.values) {
    hu = static_cast<float>(
        std::clamp(std::round(hu + random.normal(0.0, kNoise_hu)), kLowest_hu, kHighest_hu));
  }
  return scan;
}

Status save_scan(const std::string& path, const engine::Volume& scan) {
  const engine::VolumeGrid& grid = scan.grid;
  const Vec3 s = grid.spacing_m * 1e3;
  const Vec3 o = grid.origin_m * 1e3;
  std::string text = printed(
      "NRRD0004\ntype: int16\ndimension: 3\nsizes: %d %d %d\nencoding: raw\nendian: little\n"
      "space: left-posterior-superior\nspace directions: (%.9f,0,0) (0,%.9f,0) (0,0,%.9f)\n"
      "space origin: (%.9f,%.9f,%.9f)\n\n",
      grid.size[0], grid.size[1], grid.size[2], s.x, s.y, s.z, o.x, o.y, o.z);
  text.reserve(text.size() + 2 * scan.values.size());
  for (const float value : scan.values) {
    const auto bits = static_cast<std::uint16_t>(static_cast<std::int16_t>(value));
    text.push_back(static_cast<char>(bits & 0xFFU));
    text.push_back(static_cast<char>(bits >> 8U));
  }
  return engine::write_file(path, text);
}

}  // namespace orthonav::tools
