#pragma once

#include "hal/openxr/xr.h"

namespace orthonav::openxr {

/// The action that a change of the session's state requires.
enum class SessionDuty {
  kNone,
  kBegin,    ///< xrBeginSession
  kEnd,      ///< xrEndSession
  kRestart,  ///< the session is lost: destroy it and make a new one
  kLeave     ///< the user has left: destroy it
};

/// The life cycle of a session according to OpenXR 1.0, section 9.1. A pure table: `take` says what
/// to do and assumes that it is done.
class SessionState {
 public:
  /// An unknown state requires nothing.
  SessionDuty take(XrSessionState state);
  /// Whether frames must be waited for, begun and ended.
  [[nodiscard]] bool running() const { return running_; }
  /// Whether input reaches the application.
  [[nodiscard]] bool focused() const { return running_ && state_ == XR_SESSION_STATE_FOCUSED; }

 private:
  XrSessionState state_ = XR_SESSION_STATE_UNKNOWN;
  bool running_ = false;
};

}  // namespace orthonav::openxr
