#include "hal/openxr/session_state.h"

namespace orthonav::openxr {

SessionDuty SessionState::take(XrSessionState state) {
  state_ = state;
  switch (state) {
    case XR_SESSION_STATE_READY:
      if (running_) {
        return SessionDuty::kNone;
      }
      running_ = true;
      return SessionDuty::kBegin;
    case XR_SESSION_STATE_STOPPING:
      if (!running_) {
        return SessionDuty::kNone;
      }
      running_ = false;
      return SessionDuty::kEnd;
    case XR_SESSION_STATE_LOSS_PENDING:
      running_ = false;
      return SessionDuty::kRestart;
    case XR_SESSION_STATE_EXITING:
      running_ = false;
      return SessionDuty::kLeave;
    default:
      return SessionDuty::kNone;
  }
}

}  // namespace orthonav::openxr
