#include "engine/evaluation/metal_cloud.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orthonav::engine {
namespace {

constexpr int kFarthest = 150;  ///< slabs to either side
constexpr int kGap = 3;         ///< slabs without metal that do not yet end it

/// A voxel counts in each slab by its share in it, because voxels are not much smaller than slabs.
void add_voxel(const MetalCloud& cloud, double s_m, double half_voxel_m, Vec2 off_m,
               std::vector<MetalSection>& all) {
  const double low = (s_m - half_voxel_m) / MetalSections::kStep_m;
  const double high = (s_m + half_voxel_m) / MetalSections::kStep_m;
  const double first = std::max(std::round(low), -static_cast<double>(kFarthest));
  const double last = std::min(std::round(high), static_cast<double>(kFarthest));
  for (double slab = first; slab <= last; ++slab) {
    const double fraction = (std::min(high, slab + 0.5) - std::max(low, slab - 0.5)) / (high - low);
    const double area_m2 = std::max(0.0, fraction) * cloud.voxel_m3() / MetalSections::kStep_m;
    MetalSection& here = all[static_cast<std::size_t>(slab + kFarthest)];
    here.area_m2 += area_m2;
    here.middle_m = here.middle_m + area_m2 * off_m;
  }
}

}  // namespace

double MetalCloud::half_extent_m(Vec3 direction) const {
  const Vec3 along = directions_.transposed() * direction;
  return 0.5 * (std::abs(along.x) * spacing_m_.x + std::abs(along.y) * spacing_m_.y +
                std::abs(along.z) * spacing_m_.z);
}

MetalCloud::MetalCloud(const ScanField& scan) {
  const VolumeGrid& grid = scan.grid();
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (scan.value(grid.at(i, j, k)) >= kMetal_hu) {
          places_m_.push_back(grid.place_m({double(i), double(j), double(k)}));
        }
      }
    }
  }
  spacing_m_ = grid.spacing_m;
  directions_ = grid.directions;
}

double MetalSections::radius_m(std::size_t slab) const {
  return std::sqrt(slabs[slab].area_m2 / std::numbers::pi);
}

MetalSections sections_about(const MetalCloud& cloud, const Centreline& line, double within_m) {
  std::vector<MetalSection> all(2 * kFarthest + 1);
  const double half_voxel_m = cloud.half_extent_m(line.direction);
  for (const Vec3& place : cloud.places_m()) {
    const double s = line.s_of(place);
    const Vec3 off = place - line.at(s);
    if (off.squared_norm() <= within_m * within_m) {
      add_voxel(cloud, s, half_voxel_m, {off.dot(line.across), off.dot(line.athwart)}, all);
    }
  }
  for (MetalSection& section : all) {
    if (section.area_m2 > 0.0) {
      section.middle_m = (1.0 / section.area_m2) * section.middle_m;
    }
  }
  const auto end_towards = [&](int step) {
    int last = kFarthest;
    for (int at = kFarthest, empty = 0; at >= 0 && at <= 2 * kFarthest && empty <= kGap;
         at += step) {
      const bool metal = all[static_cast<std::size_t>(at)].area_m2 > 0.0;
      empty = metal ? 0 : empty + 1;
      last = metal ? at : last;
    }
    return last;
  };
  const int first = end_towards(-1);
  const int last = end_towards(1);
  return {(first - kFarthest) * MetalSections::kStep_m,
          {all.begin() + first, all.begin() + last + 1}};
}

}  // namespace orthonav::engine
