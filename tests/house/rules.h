#pragma once

#include <string>
#include <vector>

namespace orthonav::house {

/// What a source file does against the rules of docs/architecture.md, a line each. `path` is
/// relative to the root of the project ("nav/geometry/mesh.h"), `text` the whole file.
[[nodiscard]] std::vector<std::string> broken_rules(const std::string& path,
                                                    const std::string& text);

}  // namespace orthonav::house
