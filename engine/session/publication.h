#pragma once

#include "engine/session/guidance.h"
#include "engine/session/saving.h"
#include "engine/session/session_steps.h"
#include "engine/session/tools_in_hand.h"
#include "engine/session/watching.h"

namespace orthonav::engine {

/// What the surgeon is shown: the guidance after each pair, assembled from the output of each step.
class Publication {
 public:
  /// Sets the source of what the status line says about saving; null: none. Borrowed.
  void show_saving(const SaveWatch* saving) { saving_ = saving; }

  /// The guidance after a pair was processed. Like that of the calls below, it is valid until the
  /// next call.
  const Guidance& publish(const StereoFrame& frame, Timestamp display_time, OperationInWork& work,
                          SessionSteps& steps, const Watching& watching);
  /// No pair arrives: withdraws the guidance of the last one, and says why.
  const Guidance& expire(Timestamp display_time, Message why, OperationInWork& work,
                         SessionSteps& steps);
  /// The session is over: only the status line remains.
  const Guidance& end(Timestamp display_time, OperationInWork& work, SessionSteps& steps);

  /// The head's last pose in World is void.
  void forget_head() { guidance_.head.reset(); }

 private:
  void publish_status(OperationInWork& work, SessionSteps& steps, const Watching& watching);
  void publish_tool(const OperationInWork& work, const SessionSteps& steps,
                    const Watching& watching);
  void publish_instruments(const OperationInWork& work, const SessionSteps& steps);
  [[nodiscard]] Saved saved(const OperationInWork& work) const;

  const SaveWatch* saving_ = nullptr;
  ToolsInHand in_hand_;
  Message why_no_guidance_;  ///< replaces any other message once no pair arrives
  Guidance guidance_;
};

}  // namespace orthonav::engine
