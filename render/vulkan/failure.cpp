#include "render/vulkan/failure.h"

#include <exception>
#include <new>

namespace orthonav::render {
namespace {

std::string name_of(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of device memory";
    case VK_ERROR_DEVICE_LOST:
      return "device lost";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "initialization failed";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "layer not installed";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "extension not present";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "feature not present";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "no Vulkan driver";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return "too many objects";
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
      return "format not supported";
    case VK_TIMEOUT:
      return "not finished in time";
    default:
      return "VkResult " + std::to_string(static_cast<int>(result));
  }
}

ErrorCode code_of(VkResult result) {
  switch (result) {
    case VK_ERROR_DEVICE_LOST:
      return ErrorCode::kLost;
    case VK_ERROR_LAYER_NOT_PRESENT:
    case VK_ERROR_EXTENSION_NOT_PRESENT:
    case VK_ERROR_FEATURE_NOT_PRESENT:
    case VK_ERROR_INCOMPATIBLE_DRIVER:
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
      return ErrorCode::kNotFound;
    default:
      return ErrorCode::kUnavailable;
  }
}

}  // namespace

Failure::Failure(const Error& error) : std::runtime_error(error.message), code_(error.code) {}

Failure::Failure(VkResult result, const std::string& what)
    : std::runtime_error("renderer: " + what + ": " + name_of(result)), code_(code_of(result)) {}

void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS) {
    throw Failure(result, what);
  }
}

Error error_in_flight() {
  try {
    throw;
  } catch (const Failure& failure) {
    return failure.error();
  } catch (const std::runtime_error& failure) {
    return {failure.what(), ErrorCode::kUnavailable};
  } catch (const std::bad_alloc&) {
    return {"renderer: out of host memory", ErrorCode::kUnavailable};
  } catch (const std::exception& failure) {
    return {std::string("renderer: ") + failure.what(), ErrorCode::kUnavailable};
  }
}

}  // namespace orthonav::render
