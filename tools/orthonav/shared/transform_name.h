#pragma once

#include <string>

namespace orthonav::tools {

/// The file of a level's transform for 3D Slicer: "L4.tfm".
[[nodiscard]] inline std::string transform_name(const std::string& label) { return label + ".tfm"; }

}  // namespace orthonav::tools
