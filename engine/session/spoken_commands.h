#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/session/workflow.h"

namespace orthonav::engine {

/// Every phrase that a session understands, lower case.
[[nodiscard]] std::vector<std::string> spoken_commands();

/// The commands that our own recognition was trained on (tools/voice/train). The others come from
/// the headset's recognition and from scripts; the session also detects by itself what they
/// announce.
[[nodiscard]] std::vector<std::string> trained_commands();

/// What a phrase asks for; nothing if it is not a command.
[[nodiscard]] std::optional<Event> command_event(std::string_view phrase);

}  // namespace orthonav::engine
