#pragma once

#include <optional>

#include "hal/openxr/actions.h"
#include "hal/openxr/xr_values.h"

namespace orthonav::openxr {

struct GazePose;  ///< of the gaze: its origin is between the eyes, which look along -z

/// Where the eyes look, by XR_EXT_eye_gaze_interaction.
class GazeRay {
 public:
  /// A gaze that is older than this when asked for is not used.
  static constexpr XrDuration kOldest_ns = 100'000'000;

  GazeRay() = default;
  ~GazeRay() { destroy(); }
  GazeRay(const GazeRay&) = delete;
  GazeRay& operator=(const GazeRay&) = delete;

  /// Once per session. If the runtime refuses, there is no gaze.
  void create(const Actions& actions, XrSession session);
  void destroy();

  struct Seen {
    Transform<Space, GazePose> space_from_gaze;
    XrTime time = 0;  ///< when the eyes were seen
  };
  /// In `space`. Absent if the eyes are not tracked, or were seen too long before `now`.
  [[nodiscard]] std::optional<Seen> locate(XrSpace space, XrTime at, XrTime now) const;

 private:
  XrAction action_ = XR_NULL_HANDLE;
  XrSession session_ = XR_NULL_HANDLE;
  XrSpace gaze_ = XR_NULL_HANDLE;
};

}  // namespace orthonav::openxr
