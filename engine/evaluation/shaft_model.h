#pragma once

#include <vector>

#include "engine/evaluation/border_voxels.h"

namespace orthonav::engine {

/// SD of a scanner's point spread where nothing else is known.
inline constexpr double kUsualBlur_m = 0.0005;

/// How the voxels about blurred shafts of one density are computed, and compared with a scan.
struct ShaftModel {
  double metal_hu = 0.0;
  double highest_hu = 0.0;     ///< where the scan clips
  std::vector<Vec3> places_m;  ///< where a voxel is sampled, from its middle

  /// A voxel's misfit in SDs, where `fraction` of it is metal: both are clipped below, where bone
  /// and streaks are, and above. Misfits much larger than the noise count for less (Cauchy).
  [[nodiscard]] double misfit(double hu, double fraction) const;
};

/// SD of a voxel's misfit, as assumed.
inline constexpr double kNoise_hu = 80.0;

[[nodiscard]] ShaftModel shaft_model(const ScanField& scan, const std::vector<BorderVoxel>& voxels,
                                     const Shaft& shaft);

/// The share of metal before an end that lies `ahead_m` further on.
[[nodiscard]] double share_before_end(double ahead_m, double blur_m);

/// The share of metal of an endless shaft, blurred, at a distance from its axis.
[[nodiscard]] double share_across(double radius_m, double off_m, double blur_m);

}  // namespace orthonav::engine
