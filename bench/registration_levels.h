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
  double scale = 1.0;               ///< size of the model, that of the bone being 1
  bool mirrored = false;            ///< the model is the bone's mirror image
  bool alone = false;               ///< no level knows of the others of its case
};

/// Whether a name is among those wanted; none wanted: all are.
[[nodiscard]] bool chosen(const std::vector<std::string>& wanted, const std::string& name);

/// Sorted by case. Each is prepared; an Error where none is found.
Result<std::vector<BenchLevel>> load_levels(const LevelOptions& options);

}  // namespace orthonav::bench
