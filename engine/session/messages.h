#pragma once

#include <string>

#include "base/time.h"
#include "hal/api/devices.h"

namespace orthonav::engine {

/// What the surgeon must be told, until they do something that is taken, and what was heard, both
/// for a while at most.
class Messages {
 public:
  Messages(Duration message_for, Duration heard_for)
      : message_for_(message_for), heard_for_(heard_for) {}

  void say(std::string message, Timestamp time);
  /// A surgeon who was misheard must see it at once, and one who was heard need not ask.
  void echo(const Phrase& phrase, bool sure);
  /// Something was taken: what was said before is answered.
  void clear() { message_.clear(); }
  void expire(Timestamp now);
  [[nodiscard]] const std::string& message() const { return message_; }
  [[nodiscard]] const std::string& heard() const { return heard_; }

 private:
  Duration message_for_;
  Duration heard_for_;
  std::string message_;
  Timestamp message_until_{};
  std::string heard_;
  Timestamp heard_until_{};
};

}  // namespace orthonav::engine
