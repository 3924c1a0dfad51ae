#pragma once

#include <utility>

#include "engine/session/event.h"
#include "engine/session/message.h"

namespace orthonav::engine {

/// An event that the engine itself finds out while it answers another one or looks at a pair.
/// Whoever returns one is done: the session answers it next.
struct Raised {
  /// Implicit: most events bring no message.
  Raised(Event what, Message message = {}) : event(what), then_say(std::move(message)) {}

  Event event;
  /// Said once the event was answered, since its answer takes back what was said before.
  Message then_say;
};

}  // namespace orthonav::engine
