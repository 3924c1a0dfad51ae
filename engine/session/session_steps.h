#pragma once

#include <cstddef>
#include <optional>

#include "engine/session/guide_checks.h"
#include "engine/session/operation_in_work.h"
#include "engine/session/steps/digitizing.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/steps/landmarking.h"
#include "engine/session/steps/placing.h"
#include "engine/session/steps/replanning.h"
#include "engine/session/steps/rod_templating.h"
#include "engine/session/steps/verifying.h"

namespace orthonav::engine {

/// The steps of one operation, each with its state and actions, and what several of them share: the
/// checks of the guide, and changes of the screw. A step that begins anew is a new object.
struct SessionSteps {
  explicit SessionSteps(const OperationInWork& work);

  Digitizing digitizing;
  Verifying verifying;
  Landmarking landmarking;
  GuideChecks guide_checks;
  Guiding guiding;
  Placing placing;
  Replanning replanning;
  RodTemplating rods;

  void expect_landmark(const OperationInWork& work);
  void expect_wire(const OperationInWork& work);
  void select_screw(const OperationInWork& work);
  /// Discards the registration of the current level and everything based on it.
  void forget_registration(const OperationInWork& work);

  /// The button was held too long, so no click will follow.
  void drop_touch(OperationInWork& work, Timestamp time);
  /// Passes the newest pair to the present step.
  void collect(OperationInWork& work);

  /// "accept" applies the pending change of a screw.
  [[nodiscard]] std::optional<Event> consent(OperationInWork& work, Timestamp said);
  /// "accept" corrects the guide as its touch of the landmark, or of a wire, showed.
  void correct_guide(OperationInWork& work, Timestamp time);

  /// The tool that the present step works with, if any.
  [[nodiscard]] std::optional<std::size_t> tool(const OperationInWork& work) const;
  [[nodiscard]] StepOnDisplay on_display(const OperationInWork& work) const;
  [[nodiscard]] StepState state(const OperationInWork& work) const;
  /// Writes what each step shows; `hidden`: no guidance.
  void write(const OperationInWork& work, bool hidden, Guidance& out);
};

}  // namespace orthonav::engine
