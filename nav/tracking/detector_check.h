#pragma once

#include "base/image.h"
#include "base/result.h"
#include "nav/tracking/marker_detector.h"

namespace orthonav::nav {

/// What the detector can't be made with: the first problem.
[[nodiscard]] Status check(const DetectorOptions& options);
/// What it can't look at: no pixels, too many for the library, a buffer of another length.
[[nodiscard]] Status check(const GreyImage& image);

}  // namespace orthonav::nav
