#pragma once

#include "base/time.h"
#include "engine/session/message.h"
#include "engine/session/status_line.h"
#include "hal/api/devices.h"

namespace orthonav::engine {

/// The message to the surgeon, until they do something that is accepted, and the phrase heard; both
/// expire after a while.
class Messages {
 public:
  Messages(Duration message_for, Duration heard_for)
      : message_for_(message_for), heard_for_(heard_for) {}

  void say(Message message, Timestamp time);
  /// A surgeon who was misheard must see it at once, and one who was heard need not ask. `from`:
  /// who asked, unless it was said in the room.
  void echo(const Phrase& phrase, bool sure, const std::string& from = {});
  /// Something was accepted, so the last message is settled.
  void clear() { message_ = {}; }
  void expire(Timestamp now);
  /// How often anything was said.
  [[nodiscard]] std::int64_t said() const { return said_; }
  /// Null: none.
  [[nodiscard]] const Message* message() const {
    return std::holds_alternative<std::monostate>(message_) ? nullptr : &message_;
  }
  [[nodiscard]] const HeardCommand* heard() const { return heard_ ? &*heard_ : nullptr; }

 private:
  Duration message_for_;
  Duration heard_for_;
  Message message_;
  Timestamp message_until_{};
  std::int64_t said_ = 0;
  std::optional<HeardCommand> heard_;
  Timestamp heard_until_{};
};

}  // namespace orthonav::engine
