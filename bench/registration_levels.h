#pragma once

#include <string>
#include <vector>

#include "bench/registration_methods.h"

namespace orthonav::bench {

/// Which bones are measured, and how their models differ from them.
struct LevelOptions {
  std::string anatomy;              ///< folder of case folders
  std::vector<std::string> levels;  ///< "visible-human/L4"; empty: all
  double segmented_m = 0.0;         ///< SD of the model's own error
  double voxel_m = 0.0;             ///< the model is made from a label of such voxels; 0: it is not
  double scale = 1.0;               ///< size of the model relative to the bone
  bool mirrored = false;            ///< the model is the bone's mirror image
  bool alone = false;               ///< levels are registered without the others of their case
};

/// Whether a name is among those wanted; an empty list means all.
[[nodiscard]] bool chosen(const std::vector<std::string>& wanted, const std::string& name);

/// Sorted by case. Each is prepared; an Error if none is found.
Result<std::vector<BenchLevel>> load_levels(const LevelOptions& options);

}  // namespace orthonav::bench
