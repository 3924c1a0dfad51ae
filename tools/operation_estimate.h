#pragma once

#include "engine/session/guidance.h"

namespace orthonav::tools {

/// How much of an operation is done, by the time that its parts usually take.
class OperationEstimate {
 public:
  /// In [0, 1]; it grows with every moment that a step lasts, and never falls: a level that is
  /// stroked again takes longer, nothing is undone.
  [[nodiscard]] double fraction(Timestamp time, const engine::Guidance& guidance);

 private:
  std::optional<StepOnDisplay> step_;
  Timestamp step_began_{};
  double most_ = 0.0;
};

}  // namespace orthonav::tools
