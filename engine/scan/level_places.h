#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "base/vec.h"

namespace orthonav::engine {

/// A vertebra and the middle of its surface or voxels in the scan, metres, LPS.
struct LevelPlace {
  std::string label;
  Vec3 middle_m;
};

/// The vertebrae of a spine from the head down: C1 to C7, T1 to T13, L1 to L6, S1.
[[nodiscard]] const std::vector<std::string>& spine_labels();

/// How far the middles of two vertebrae lie apart in an adult, from the upper to the lower one:
/// body and disc of each level between (17 mm in the neck, 18 to 27 mm in the chest, 35 mm below).
[[nodiscard]] double usual_distance_m(const std::string& upper, const std::string& lower);

/// Signs that vertebrae have the names of others: from the head down they lie out of order, or
/// too near together or too far apart (0.72 and 1.35 times the usual distance). The Error ends
/// with `hint`.
Status check_places(const std::vector<LevelPlace>& from_the_head, const std::string& hint);

/// How vertebrae lie in a scan.
struct BoneInScan {
  double outside = 0.0;  ///< the part of their volume that lies outside of the scan, 0 to 1
  double mean_hu = 0.0;  ///< of the rest
};

/// Refuses what does not lie on bone: more than a tenth outside of the scan, or less than 50 HU on
/// average inside. `what`: "labels", for the Error.
Status check_bone(const BoneInScan& bone, const std::string& what);

}  // namespace orthonav::engine
