#pragma once

namespace orthonav {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ORTHONAV_MAPS_MORE_THAN_IT_USES 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ORTHONAV_MAPS_MORE_THAN_IT_USES 1
#endif
#endif

/// False under sanitizers: they map terabytes that they never use, and a process whose memory is
/// limited ends there at once.
[[nodiscard]] constexpr bool memory_can_be_limited() {
#ifdef ORTHONAV_MAPS_MORE_THAN_IT_USES
  return false;
#else
  return true;
#endif
}

}  // namespace orthonav
