#pragma once

#include <string>

#include "base/result.h"

namespace orthonav::engine {

/// Refuses a NIfTI file (plain or gzip, version 1 or 2, either byte order) whose header holds
/// spacings or orientations that are not finite or beyond any scanner: ITK never finds the nearest
/// rotation there. Any other file passes; its reader says what is wrong with it.
Status check_nifti_numbers(const std::string& path);

}  // namespace orthonav::engine
