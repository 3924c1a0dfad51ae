#pragma once

#include "engine/session/message.h"
#include "engine/session/status_parts.h"

namespace orthonav::engine {

/// What the surgeon must be told, in words; as parts where it is more than one.
void write_message(PartedText text, const Message& message);

}  // namespace orthonav::engine
