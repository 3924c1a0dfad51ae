#include "engine/session/spoken_commands.h"

#include <array>
#include <utility>

namespace orthonav::engine {
namespace {

constexpr std::array<std::pair<std::string_view, Event>, 10> kCommands = {{
    {"start", Event::kSayStart},
    {"save", Event::kSaySave},
    {"delete", Event::kSayDelete},
    {"accept", Event::kSayAccept},
    {"reject", Event::kSayReject},
    {"next", Event::kSayNext},
    {"done", Event::kSayDone},
    {"move rod", Event::kSayMoveRod},
    {"twin", Event::kSayTwin},
    {"drill", Event::kSayDrill},
}};

}  // namespace

std::vector<std::string> spoken_commands() {
  std::vector<std::string> commands;
  for (const auto& command : kCommands) {
    commands.emplace_back(command.first);
  }
  return commands;
}

std::vector<std::string> trained_commands() {
  std::vector<std::string> commands = spoken_commands();
  std::erase(commands, "drill");
  return commands;
}

std::optional<Event> command_event(std::string_view phrase) {
  for (const auto& [command, event] : kCommands) {
    if (command == phrase) {
      return event;
    }
  }
  return std::nullopt;
}

}  // namespace orthonav::engine
