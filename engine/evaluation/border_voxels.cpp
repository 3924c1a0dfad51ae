#include "engine/evaluation/border_voxels.h"

#include <algorithm>

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

}  // namespace

std::vector<BorderVoxel> border_voxels(const ScanField& scan, const Shaft& shaft,
                                       std::span<const Shaft> others) {
  constexpr std::size_t kMost = 3500;
  const double reach_m = kBorder_m + 0.5 * scan.grid().spacing_m.z;
  Vec3 low = shaft.rear().v;
  Vec3 high = low;
  for (const double s : {shaft.from_s_m, 0.0, shaft.to_s_m}) {
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], shaft.line.at(s)[a] - shaft.radius_m - reach_m);
      high[a] = std::max(high[a], shaft.line.at(s)[a] + shaft.radius_m + reach_m);
    }
  }
  const double first_s = shaft.goes_on ? shaft.from_s_m + 0.002 : shaft.from_s_m - 0.004;
  const double last_s = shaft.to_s_m + (shaft.cut ? -0.002 : 0.004);
  std::vector<BorderVoxel> out;
  for_each_voxel_in(scan.grid(), low, high, [&](std::array<int, 3> at, Vec3 place_m) {
    const double s = shaft.line.s_of(place_m);
    if (s < first_s || s > last_s) {
      return;
    }
    const double off_m = shaft.line.off_m(place_m);
    const bool at_end = s > shaft.to_s_m - reach_m || s < shaft.from_s_m + reach_m;
    if (off_m < shaft.radius_m + reach_m && (at_end || off_m > shaft.radius_m - reach_m) &&
        !belongs_to_other(others, place_m, 0.0015)) {
      out.push_back({place_m, scan.value(at[0], at[1], at[2])});
    }
  });
  const std::size_t every = out.size() / kMost + 1;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < out.size(); i += every) {
    out[kept++] = out[i];
  }
  out.resize(kept);
  return out;
}

}  // namespace orthonav::engine
