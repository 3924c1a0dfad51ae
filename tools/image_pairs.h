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

/// Which left and right images belong together: by the numbers in their names ("left07.jpg" and
/// "right07.jpg"), so that an image that is missing on one side shifts nothing. Where the names
/// hold no numbers, or one twice, by their order; then the counts must be the same.
Result<PairedImages> paired(const std::vector<std::string>& left,
                            const std::vector<std::string>& right);

}  // namespace orthonav::tools
