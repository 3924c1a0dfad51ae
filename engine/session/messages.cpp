#include "engine/session/messages.h"

#include <utility>

namespace orthonav::engine {

void Messages::say(Message message, Timestamp time) {
  message_ = std::move(message);
  message_until_ = time + message_for_;
  ++said_;
}

void Messages::echo(const Phrase& phrase, bool sure, const std::string& from) {
  heard_ = HeardCommand{phrase.text, sure, from};
  heard_until_ = phrase.time + heard_for_;
}

void Messages::expire(Timestamp now) {
  if (now >= message_until_) {
    clear();
  }
  if (now >= heard_until_) {
    heard_.reset();
  }
}

}  // namespace orthonav::engine
