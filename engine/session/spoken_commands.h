#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/session/workflow.h"

namespace orthonav::engine {

/// Every phrase that a session understands, lower case.
[[nodiscard]] std::vector<std::string> spoken_commands();

/// Those of them that our own recognition was trained on (tools/voice/train). The others are heard
/// by the headset's own and come from scripts; whatever they do, the session finds out by itself
/// too.
[[nodiscard]] std::vector<std::string> trained_commands();

/// What a phrase asks for; nothing when it is no command.
[[nodiscard]] std::optional<Event> command_event(std::string_view phrase);

}  // namespace orthonav::engine
