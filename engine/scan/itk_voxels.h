#pragma once

#include <exception>
#include <string>
#include <vector>

#include "base/result.h"

namespace itk {
class ImageIOBase;
}

namespace orthonav::engine {

/// Appends the voxels of what `io` was told to read. Throws what ITK throws.
Status read_voxels(itk::ImageIOBase& io, std::vector<float>& values);

/// An exception of ITK or of the standard library as one line.
[[nodiscard]] std::string itk_problem(const std::exception& error);

}  // namespace orthonav::engine
