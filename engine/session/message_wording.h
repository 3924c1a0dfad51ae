#pragma once

#include "engine/session/message.h"
#include "engine/session/status_parts.h"

namespace orthonav::engine {

/// A message to the surgeon in words, in several parts where needed.
void write_message(PartedText text, const Message& message);

}  // namespace orthonav::engine
