#pragma once

#include <cstddef>
#include <optional>

#include "engine/session/digitizing.h"
#include "engine/session/guide_checks.h"
#include "engine/session/guiding.h"
#include "engine/session/landmarking.h"
#include "engine/session/operation_in_work.h"
#include "engine/session/placing.h"
#include "engine/session/replanning.h"
#include "engine/session/rod_templating.h"
#include "engine/session/verifying.h"

namespace orthonav::engine {

/// The steps of one operation, each with what it knows and what the table asks of it, and what
/// several of them share: the checks of the guide, and changes of the screw. A step that is begun
/// anew is another object.
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
  /// The registration of the level in work is gone, and what stands on it.
  void forget_registration(const OperationInWork& work);

  /// Pressed, let go, or held too long: samples are taken, or a place is touched.
  void button(Action action, OperationInWork& work, Timestamp time);
  /// The newest pair, to the present step.
  void collect(const OperationInWork& work);

  /// "accept" takes the change of a screw that waits for it; false where none does.
  [[nodiscard]] bool consent(OperationInWork& work, Timestamp said);

  /// The tool that the present step works with, if any.
  [[nodiscard]] std::optional<std::size_t> tool(const OperationInWork& work) const;
  [[nodiscard]] StepOnDisplay on_display(const OperationInWork& work) const;
  [[nodiscard]] StepState state(const OperationInWork& work) const;
  /// What each step shows; `hidden`: nothing is guided.
  void write(const OperationInWork& work, bool hidden, Guidance& out);
};

}  // namespace orthonav::engine
