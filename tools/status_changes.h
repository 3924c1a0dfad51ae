#pragma once

#include <optional>
#include <string>

#include "base/time.h"
#include "engine/session/status_line.h"

namespace orthonav::tools {

/// What became new with a pair, for those who tell of an operation line by line. Allocates nothing
/// where nothing is new.
class StatusChanges {
 public:
  void look(Timestamp time, const engine::StatusLine& status);
  /// Since the first pair.
  [[nodiscard]] double time_s() const { return time_s_; }
  /// The step, where it is another one; else empty.
  [[nodiscard]] const std::string& new_step() const { return new_step_; }
  /// The message to the surgeon, where it is another one; else empty.
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
