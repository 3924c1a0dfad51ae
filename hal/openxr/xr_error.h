#pragma once

#include <string>

#include "base/result.h"
#include "hal/openxr/xr.h"

namespace orthonav::openxr {

/// "XR_ERROR_FORM_FACTOR_UNAVAILABLE", or the number of a result newer than OpenXR 1.0.20.
[[nodiscard]] std::string name_of(XrResult result);
/// "openxr: begin a frame: XR_ERROR_SESSION_NOT_RUNNING".
[[nodiscard]] Error error_of(const std::string& what, XrResult result);
/// The same as a Status; success if the call succeeded.
[[nodiscard]] Status status_of(const std::string& what, XrResult result);

/// "2.1.0"
[[nodiscard]] std::string version_text(XrVersion version);

}  // namespace orthonav::openxr
