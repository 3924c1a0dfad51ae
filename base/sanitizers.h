#pragma once

namespace orthonav {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ORTHONAV_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ORTHONAV_SANITIZED 1
#endif
#endif

/// Whether this is a build with AddressSanitizer or ThreadSanitizer. They map terabytes that they
/// never use, so memory can't be limited, and everything takes many times as long.
[[nodiscard]] constexpr bool sanitized() {
#ifdef ORTHONAV_SANITIZED
  return true;
#else
  return false;
#endif
}

}  // namespace orthonav
