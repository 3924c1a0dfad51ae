#pragma once

#include <optional>
#include <vector>

#include "base/result.h"
#include "engine/session/logged_operation.h"
#include "engine/session/session_steps.h"

namespace orthonav::engine {

/// Goes on with an operation as its log tells it. Nothing restored is guided on before it was
/// verified.
class Resuming {
 public:
  /// Before the first step. Refuses other levels or screws, and references elsewhere.
  Status restore(const LoggedOperation& logged, OperationInWork& work, RodTemplating& rods);
  /// A level begins: on to the step that the operation had reached, or to the one before it in
  /// which its registration can be verified.
  [[nodiscard]] std::optional<Event> go_on(OperationInWork& work, SessionSteps& steps,
                                           Timestamp time);
  /// The saved regions lie in a World that is gone.
  void forget_places() { regions_.clear(); }

 private:
  bool resumed_ = false;
  std::vector<std::vector<nav::Region>> regions_;  ///< saved, of each level, until it is begun
};

}  // namespace orthonav::engine
