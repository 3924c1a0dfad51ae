#include "engine/evaluation/border_voxels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/evaluation/every_nth.h"
#include "nav/geometry/mesh.h"

namespace orthonav::engine {
namespace {

constexpr double kBorder_m = 0.0025;

bool belongs_to_other(std::span<const Shaft> others, Vec3 place_m, double reach_m) {
  return std::any_of(others.begin(), others.end(), [&](const Shaft& other) {
    const double s = other.line.s_of(place_m);
    const double behind_m = other.headed ? 0.020 : reach_m;
    const double wide_m = s < other.from_s_m ? 0.008 : other.radius_m;
    return s > other.from_s_m - behind_m && s < other.to_s_m + reach_m &&
           other.line.off_m(place_m) < wide_m + reach_m;
  });
}

nav::Bounds box_about(const Shaft& shaft, double reach_m) {
  nav::Bounds box{shaft.rear().v, shaft.rear().v};
  for (const double s : {shaft.from_s_m, 0.0, shaft.to_s_m}) {
    for (int a = 0; a < 3; ++a) {
      box.low[a] = std::min(box.low[a], shaft.line.at(s)[a] - shaft.radius_m - reach_m);
      box.high[a] = std::max(box.high[a], shaft.line.at(s)[a] + shaft.radius_m + reach_m);
    }
  }
  return box;
}

/// The indices of a box's corners, from the least to the greatest.
nav::Bounds indices_of(const VolumeGrid& grid, const nav::Bounds& box_m) {
  const Vec3 any = grid.index_of(box_m.low);
  nav::Bounds out{any, any};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 index = grid.index_of({(corner & 1) != 0 ? box_m.high.x : box_m.low.x,
                                      (corner & 2) != 0 ? box_m.high.y : box_m.low.y,
                                      (corner & 4) != 0 ? box_m.high.z : box_m.low.z});
    for (int a = 0; a < 3; ++a) {
      out.low[a] = std::min(out.low[a], index[a]);
      out.high[a] = std::max(out.high[a], index[a]);
    }
  }
  return out;
}

/// Calls `visit(voxel, place_m)` for each voxel of the grid whose middle may lie in a box.
template <class Visit>
void for_each_voxel_in(const VolumeGrid& grid, const nav::Bounds& box_m, const Visit& visit) {
  const nav::Bounds box = indices_of(grid, box_m);
  std::array<int, 3> first{};
  std::array<int, 3> last{};
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<std::size_t>(a);
    first[n] = std::max(0, static_cast<int>(std::ceil(std::max(box.low[a], -1.0))));
    last[n] = std::min(grid.size[n] - 1, static_cast<int>(std::floor(std::min(box.high[a], 1e6))));
  }
  for (int k = first[2]; k <= last[2]; ++k) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) {
        visit(grid.at(i, j, k), grid.place_m({double(i), double(j), double(k)}));
      }
    }
  }
}

}  // namespace

std::vector<BorderVoxel> border_voxels(const ScanField& scan, const Shaft& shaft,
                                       std::span<const Shaft> others) {
  constexpr std::size_t kMost = 3500;
  const double reach_m = kBorder_m + 0.5 * scan.grid().spacing_m.z;
  const double first_s = shaft.goes_on ? shaft.from_s_m + 0.002 : shaft.from_s_m - 0.004;
  const double last_s = shaft.to_s_m + (shaft.cut ? -0.002 : 0.004);
  std::vector<BorderVoxel> out;
  for_each_voxel_in(scan.grid(), box_about(shaft, reach_m), [&](std::size_t voxel, Vec3 place_m) {
    const double s = shaft.line.s_of(place_m);
    if (s < first_s || s > last_s) {
      return;
    }
    const double off_m = shaft.line.off_m(place_m);
    const bool at_end = s > shaft.to_s_m - reach_m || s < shaft.from_s_m + reach_m;
    if (off_m < shaft.radius_m + reach_m && (at_end || off_m > shaft.radius_m - reach_m) &&
        !belongs_to_other(others, place_m, 0.0015)) {
      out.push_back({place_m, scan.value(voxel)});
    }
  });
  return every_nth<BorderVoxel>(out, out.size() / kMost + 1);
}

}  // namespace orthonav::engine
