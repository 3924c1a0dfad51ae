#pragma once

#include <optional>
#include <vector>

#include "base/result.h"
#include "engine/session/log/logged_operation.h"
#include "engine/session/session_state.h"
#include "engine/session/steps/digitizing.h"
#include "engine/session/steps/rod_templating.h"
#include "engine/session/steps/verifying.h"

namespace orthonav::engine {

/// Continues an operation from its log. Nothing restored is guided on before it is verified.
class Resuming {
 public:
  /// Called before the first step. Refuses different levels or screws, and references in other
  /// places.
  Status restore(const LoggedOperation& logged, SessionState& work, RodTemplating& rods);
  /// A level begins: continues in the step that the operation had reached, or in the one before it
  /// in which the registration can be verified.
  [[nodiscard]] std::optional<Event> resume_level(SessionState& work, const RodTemplating& rods,
                                                  Digitizing& digitizing, Verifying& verifying,
                                                  Timestamp time);
  /// The saved regions were measured in a World that no longer exists.
  void forget_places() { strokes_.clear(); }

 private:
  bool resumed_ = false;
  bool told_finished_ = false;                     ///< which levels were finished
  std::vector<std::vector<nav::Region>> strokes_;  ///< saved regions of each level, until it begins
};

}  // namespace orthonav::engine
