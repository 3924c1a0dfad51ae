#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/session/workflow.h"

namespace orthonav::engine {

/// What is said for each command, lower case: "go to next". Keys, scripts and logs use a command's
/// name: "next".
[[nodiscard]] std::vector<std::string> spoken_commands();

/// Those that our own recognition knows. The others come from the headset's recognition and from
/// scripts; the session also detects by itself what they announce.
[[nodiscard]] std::vector<std::string> recognized_commands();

/// What a phrase or a command's name asks for; nothing if it is not a command.
[[nodiscard]] std::optional<Event> command_event(std::string_view text);

/// What is said for an event; nothing if it is not a command.
[[nodiscard]] std::optional<std::string_view> phrase_of(Event event);

}  // namespace orthonav::engine
