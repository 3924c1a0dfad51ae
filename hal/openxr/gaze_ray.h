#pragma once

#include <optional>

#include "hal/openxr/actions.h"
#include "hal/openxr/xr_values.h"

namespace orthonav::openxr {

struct GazePose;  ///< where the eyes look from: -z is the direction

/// Where the eyes look, by XR_EXT_eye_gaze_interaction.
class GazeRay {
 public:
  /// A gaze that was seen longer before it is asked for means nothing any more.
  static constexpr XrDuration kOldest_ns = 100'000'000;

  GazeRay() = default;
  ~GazeRay() { destroy(); }
  GazeRay(const GazeRay&) = delete;
  GazeRay& operator=(const GazeRay&) = delete;

  /// Once per session; without a gaze where the runtime refuses it.
  void create(const Actions& actions, XrSession session);
  void destroy();

  struct Seen {
    Transform<Space, GazePose> space_from_gaze;
    XrTime time = 0;  ///< when the eyes were seen
  };
  /// In `space`. Absent where the eyes are not tracked, or were seen too long before `now`.
  [[nodiscard]] std::optional<Seen> locate(XrSpace space, XrTime at, XrTime now) const;

 private:
  XrAction action_ = XR_NULL_HANDLE;
  XrSession session_ = XR_NULL_HANDLE;
  XrSpace gaze_ = XR_NULL_HANDLE;
};

}  // namespace orthonav::openxr
