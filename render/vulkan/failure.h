#pragma once

#include <vulkan/vulkan.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "base/result.h"

namespace orthonav::render {

/// Carries an Error out of a constructor or out of code deep in a frame. It never leaves render/:
/// the renderers' public calls turn it back into an Error.
class Failure : public std::runtime_error {
 public:
  explicit Failure(const Error& error);
  /// A Vulkan call that failed. `what` names what was tried.
  Failure(VkResult result, const std::string& what);
  [[nodiscard]] Error error() const { return {what(), code_}; }

 private:
  ErrorCode code_;
};

/// Throws Failure unless `result` is success. `what` names what was tried.
void check(VkResult result, const char* what);

/// The value; throws its Error as a Failure. For constructors, which can't return one.
template <class T>
[[nodiscard]] T value_of(Result<T> result) {
  if (!result) {
    throw Failure(result.error());
  }
  return std::move(*result);
}

/// The exception being caught, as an Error; only inside a catch clause.
[[nodiscard]] Error error_in_flight();

}  // namespace orthonav::render
