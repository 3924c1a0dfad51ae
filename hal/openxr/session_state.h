#pragma once

#include "hal/openxr/xr.h"

namespace orthonav::openxr {

/// What a change of the session's state asks for.
enum class SessionDuty {
  kNone,
  kBegin,    ///< xrBeginSession
  kEnd,      ///< xrEndSession
  kRestart,  ///< the session is lost: destroy it and make a new one
  kLeave     ///< the user has left: destroy it
};

/// The life cycle of a session after OpenXR 1.0, section 9.1. A pure table: `take` says what is to
/// be done and assumes that it is.
class SessionState {
 public:
  /// An unknown state asks for nothing.
  SessionDuty take(XrSessionState state);
  /// Frames must be waited for, begun and ended.
  [[nodiscard]] bool running() const { return running_; }
  /// Input reaches the application.
  [[nodiscard]] bool focused() const { return running_ && state_ == XR_SESSION_STATE_FOCUSED; }

 private:
  XrSessionState state_ = XR_SESSION_STATE_UNKNOWN;
  bool running_ = false;
};

}  // namespace orthonav::openxr
