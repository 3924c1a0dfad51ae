#pragma once

#include <utility>

#include "engine/session/event.h"
#include "engine/session/message.h"

namespace orthonav::engine {

/// An event that the engine detects while it answers another one or processes a pair. A function
/// that returns one does nothing more: the session answers it next.
struct Raised {
  /// Implicit: most events bring no message.
  Raised(Event what, Message message = {}) : event(what), then_say(std::move(message)) {}

  Event event;
  /// Said after the event was answered, because the answer clears earlier messages.
  Message then_say;
};

}  // namespace orthonav::engine
