#include "hal/openxr/xr_error.h"

#include <openxr/openxr_reflection.h>

namespace orthonav::openxr {

std::string name_of(XrResult result) {
#define ORTHONAV_NAME(name, value) \
  case name:                       \
    return #name;
  switch (result) { XR_LIST_ENUM_XrResult(ORTHONAV_NAME) default : break; }
#undef ORTHONAV_NAME
  return "XrResult " + std::to_string(static_cast<int>(result));
}

namespace {

ErrorCode code_of(XrResult result) {
  switch (result) {
    case XR_ERROR_INSTANCE_LOST:
    case XR_ERROR_SESSION_LOST:
    case XR_SESSION_LOSS_PENDING:
      return ErrorCode::kLost;
    case XR_ERROR_RUNTIME_UNAVAILABLE:
    case XR_ERROR_FORM_FACTOR_UNAVAILABLE:
      return ErrorCode::kUnavailable;
    default:
      return ErrorCode::kInvalid;
  }
}

}  // namespace

Error error_of(const std::string& what, XrResult result) {
  return Error{"openxr: " + what + ": " + name_of(result), code_of(result)};
}

Status status_of(const std::string& what, XrResult result) {
  if (XR_FAILED(result)) {
    return error_of(what, result);
  }
  return {};
}

std::string version_text(XrVersion version) {
  return std::to_string(XR_VERSION_MAJOR(version)) + "." +
         std::to_string(XR_VERSION_MINOR(version)) + "." +
         std::to_string(XR_VERSION_PATCH(version));
}

}  // namespace orthonav::openxr
