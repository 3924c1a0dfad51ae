#pragma once

#include <array>
#include <optional>

#include "base/result.h"
#include "hal/openxr/runtime.h"

namespace orthonav::openxr {

/// Both hands as XR_EXT_hand_tracking sees them, for runtimes that report joints but no pinch.
class HandJoints {
 public:
  HandJoints() = default;
  ~HandJoints() { destroy(); }
  HandJoints(const HandJoints&) = delete;
  HandJoints& operator=(const HandJoints&) = delete;

  /// Once per session. If the runtime refuses, there are no hands.
  void create(const Runtime& runtime, XrSession session);
  void destroy();
  [[nodiscard]] bool offered() const { return locate_ != nullptr; }
  /// How far thumb and index finger are closed, 0 to 1; absent if either tip is not tracked.
  [[nodiscard]] std::optional<float> closed(std::size_t hand, XrSpace space, XrTime at) const;

 private:
  PFN_xrDestroyHandTrackerEXT destroy_ = nullptr;
  PFN_xrLocateHandJointsEXT locate_ = nullptr;
  std::array<XrHandTrackerEXT, 2> trackers_{};
};

}  // namespace orthonav::openxr
