#include "engine/evaluation/shaft_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nav/statistics/median.h"

namespace orthonav::engine {
namespace {

constexpr double kLow_hu = 1300.0;   ///< bone and most streaks are below
constexpr double kClip_hu = 3071.0;  ///< of 12 bits
constexpr double kTitanium_hu = 8000.0;
constexpr double kSteel_hu = 12000.0;  ///< of wires
constexpr double kAround_hu = 300.0;

/// More places along a voxel's longer sides.
std::vector<Vec3> places_in_voxel(const VolumeGrid& grid) {
  std::array<int, 3> parts{};
  for (int a = 0; a < 3; ++a) {
    parts[static_cast<std::size_t>(a)] =
        std::clamp(static_cast<int>(std::ceil(grid.spacing_m[a] / 0.0006 - 0.2)), 1, 5);
  }
  std::vector<Vec3> out;
  for (int i = 0; i < parts[0]; ++i) {
    for (int j = 0; j < parts[1]; ++j) {
      for (int k = 0; k < parts[2]; ++k) {
        const Vec3 part{(i + 0.5) / parts[0] - 0.5, (j + 0.5) / parts[1] - 0.5,
                        (k + 0.5) / parts[2] - 0.5};
        out.push_back(grid.directions * Vec3{part.x * grid.spacing_m.x, part.y * grid.spacing_m.y,
                                             part.z * grid.spacing_m.z});
      }
    }
  }
  return out;
}

double soft(double misfit) {
  constexpr double kWidth = 3.0;
  const double q = misfit / kWidth;
  return std::copysign(kWidth * std::sqrt(std::log1p(q * q)), misfit);
}

}  // namespace

double ShaftModel::misfit(double hu, double fraction) const {
  const double model_hu = kAround_hu + fraction * (metal_hu - kAround_hu);
  return soft((std::clamp(hu, kLow_hu, highest_hu) - std::clamp(model_hu, kLow_hu, highest_hu)) /
              kNoise_hu);
}

ShaftModel shaft_model(const ScanField& scan, const std::vector<BorderVoxel>& voxels,
                       const Shaft& shaft) {
  ShaftModel out{shaft.is_wire() ? kSteel_hu : kTitanium_hu, kClip_hu,
                 places_in_voxel(scan.grid())};
  std::vector<double> core;
  for (const BorderVoxel& voxel : voxels) {
    if (shaft.line.off_m(voxel.place_m) < 0.7 * shaft.radius_m && voxel.hu > kMetal_hu) {
      core.push_back(voxel.hu);
    }
  }
  const double core_hu = core.empty() ? 0.0 : nav::median(std::move(core));
  // A scan that does not clip shows the metal's own density.
  if (core_hu > kClip_hu + 200.0) {
    out.metal_hu = core_hu;
    out.highest_hu = 0.9 * out.metal_hu;
  }
  return out;
}

double share_before_end(double ahead_m, double blur_m) {
  return 0.5 * std::erfc(-0.70710678118654752 * ahead_m / blur_m);
}

double share_across(double radius_m, double off_m, double blur_m) {
  // A flat border would keep its full height; a thin cylinder is blurred from all sides.
  const double q = radius_m / blur_m;
  return share_before_end(radius_m - off_m, blur_m) * (1.0 - std::exp(-0.5 * q * q)) /
         share_before_end(radius_m, blur_m);
}

}  // namespace orthonav::engine
