#pragma once

#include <string>
#include <vector>

namespace orthonav::tools {

/// The candidate that a mistyped word probably stands for; empty: none is near. A letter missing,
/// added, changed or swapped with its neighbour is one mistake; a third of the word's letters may
/// be wrong.
[[nodiscard]] std::string closest(const std::string& word,
                                  const std::vector<std::string>& candidates);

}  // namespace orthonav::tools
