#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"

namespace orthonav::test {

/// Writes a transform of that kind with the Insight Toolkit, `.h5` or text by the file's name.
/// False where it can't.
[[nodiscard]] bool itk_writes(const std::string& path, const std::string& kind,
                              const std::vector<double>& parameters,
                              const std::vector<double>& fixed_parameters);

/// Where the transform in the file, as the Insight Toolkit reads it, takes a point; mm. Nothing
/// where it reads none.
[[nodiscard]] std::optional<Vec3> itk_takes(const std::string& path, Vec3 point_mm);

}  // namespace orthonav::test
