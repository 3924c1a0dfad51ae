#pragma once

#include <optional>
#include <string>

#include "base/time.h"
#include "engine/session/text/status_line.h"

namespace orthonav::tools {

/// The changes with a pair, for line-by-line reports of an operation. Allocates nothing if nothing
/// changed.
class StatusChanges {
 public:
  void look(Timestamp time, const engine::StatusLine& status);
  /// Since the first pair.
  [[nodiscard]] double time_s() const { return time_s_; }
  /// The step, if it changed; otherwise empty.
  [[nodiscard]] const std::string& new_step() const { return new_step_; }
  /// The message to the surgeon, if it is another one; otherwise empty. One that goes and comes
  /// back within a step is told once.
  [[nodiscard]] const std::string& new_message() const { return new_message_; }
  /// How often the message before came back untold. Known once another message or step is told.
  [[nodiscard]] int untold() const { return untold_; }

 private:
  std::optional<Timestamp> first_;
  double time_s_ = 0.0;
  std::optional<engine::StepOnDisplay> step_;
  std::string shown_;  ///< empty: none
  std::string told_;   ///< the last one that was told in this step
  int back_ = 0;       ///< how often it came back since
  int untold_ = 0;
  std::string new_step_;
  std::string new_message_;
};

}  // namespace orthonav::tools
