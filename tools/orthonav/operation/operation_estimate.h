#pragma once

#include "engine/session/guidance.h"

namespace orthonav::tools {

/// The fraction of an operation's time that has passed, from the usual duration of the parts left.
class OperationEstimate {
 public:
  /// In [0, 1]; it grows during every step and never falls: stroking a level again takes longer but
  /// undoes nothing.
  [[nodiscard]] double fraction(Timestamp time, const engine::Guidance& guidance);

 private:
  std::optional<Timestamp> began_;
  std::optional<engine::StepOnDisplay> step_;
  Timestamp step_began_{};
  double most_ = 0.0;
};

}  // namespace orthonav::tools
