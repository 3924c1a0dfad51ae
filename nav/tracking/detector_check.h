#pragma once

#include "base/image.h"
#include "base/result.h"
#include "nav/tracking/marker_detector.h"

namespace orthonav::nav {

/// Refuses options that the detector can't work with: the first problem.
[[nodiscard]] Status check(const DetectorOptions& options);
/// Refuses an image that it can't process: no pixels, too many for the library, a buffer of the
/// wrong length.
[[nodiscard]] Status check(const GreyImage& image);

}  // namespace orthonav::nav
