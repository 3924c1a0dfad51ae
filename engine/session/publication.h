#pragma once

#include "engine/session/guidance.h"
#include "engine/session/saving.h"
#include "engine/session/session_steps.h"
#include "engine/session/tools_in_hand.h"
#include "engine/session/watching.h"

namespace orthonav::engine {

/// What the surgeon is shown: the guidance after each pair, put together from what each step
/// writes.
class Publication {
 public:
  /// What the status line says of saving from now on; null: nothing. Borrowed.
  void show_saving(const SaveWatch* saving) { saving_ = saving; }

  /// After a pair was answered. Valid until the next call, as what follows.
  const Guidance& publish(const StereoFrame& frame, Timestamp display_time, OperationInWork& work,
                          SessionSteps& steps, const Watching& watching);
  /// No pair comes: takes back what was guided on the last one.
  const Guidance& expire(Timestamp display_time, OperationInWork& work, SessionSteps& steps);
  /// Nothing more will come: only the status line is left.
  const Guidance& end(Timestamp display_time, OperationInWork& work, SessionSteps& steps);

  /// Where the head was in World says nothing any more.
  void forget_head() { guidance_.head.reset(); }

 private:
  void publish_status(OperationInWork& work, SessionSteps& steps, const Watching& watching);
  void publish_tool(const OperationInWork& work, const SessionSteps& steps,
                    const Watching& watching);
  void publish_instruments(const OperationInWork& work, const SessionSteps& steps);
  [[nodiscard]] Saved saved(const OperationInWork& work) const;

  const SaveWatch* saving_ = nullptr;
  ToolsInHand in_hand_;
  Message why_no_guidance_;  ///< stands in place of any other message once no pair comes
  Guidance guidance_;
};

}  // namespace orthonav::engine
