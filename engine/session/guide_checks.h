#pragma once

#include "engine/session/axis_check.h"
#include "engine/session/operation_in_work.h"
#include "engine/session/tip_check.h"
#include "engine/session/tool_in_vertebra.h"

namespace orthonav::engine {

/// What an operation finds out about its guide: its tip compared with the pointer's in the
/// landmark, and its axis on the wires. Lasts for the whole operation.
class GuideChecks {
 public:
  explicit GuideChecks(const SessionOptions& options);

  /// Another screw is next: the tips are to be compared as the guide is held for it.
  void expect_tips() { tips_.expect(); }
  /// The guide's tip was put at `place` after the pointer's was at `pointer_tip`.
  void compare_tips(OperationInWork& work, const nav::PressedPlace& place,
                    const nav::PressedPlace& pointer_tip, Timestamp time);
  /// The sleeve was turned over a wire.
  void compare_axis(OperationInWork& work, const nav::SpinCalibration& spin, Timestamp time);
  /// The surgeon consents to the correction that the status line offers: of the tip first, then of
  /// the axis. False if none is offered.
  [[nodiscard]] bool correct_guide(OperationInWork& work, Timestamp time);

  /// How far off the guide may be on the current level, as it was last seen.
  [[nodiscard]] ToolErrors errors(const OperationInWork& work, Timestamp now) const;
  [[nodiscard]] const TipCheck& tips() const { return tips_; }
  [[nodiscard]] const AxisCheck& axis() const { return axis_; }

 private:
  TipCheck tips_;
  AxisCheck axis_;
};

}  // namespace orthonav::engine
