#pragma once

#include <string>
#include <vector>

#include "base/result.h"

namespace orthonav::tools {

struct ImagePair {
  std::string left;
  std::string right;
};

struct PairedImages {
  std::vector<ImagePair> pairs;
  std::vector<std::string> alone;  ///< without a partner
};

/// The files of these names; a name with * or ? stands for all files that match, sorted.
Result<std::vector<std::string>> expanded(const std::vector<std::string>& names);

/// Pairs left and right images by the numbers in their names ("left07.jpg" and "right07.jpg"), so
/// that an image missing on one side does not shift the others. If the names have no numbers, or a
/// repeated one, they are paired by order; then the counts must be equal.
Result<PairedImages> paired(const std::vector<std::string>& left,
                            const std::vector<std::string>& right);

}  // namespace orthonav::tools
