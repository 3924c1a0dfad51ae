#pragma once

#include <optional>
#include <string>

#include "base/time.h"
#include "engine/session/status_line.h"

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
  /// The message to the surgeon, if it changed; otherwise empty.
  [[nodiscard]] const std::string& new_message() const { return new_message_; }

 private:
  std::optional<Timestamp> first_;
  double time_s_ = 0.0;
  std::optional<StepOnDisplay> step_;
  std::string message_;
  std::string new_step_;
  std::string new_message_;
};

}  // namespace orthonav::tools
