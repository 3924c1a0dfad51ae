#include "engine/session/spoken_commands.h"

#include <algorithm>
#include <array>

namespace orthonav::engine {
namespace {

struct Command {
  std::string_view name;
  std::string_view phrase;
  Event event;
};

// Phrases are long and unlike what else is said in a room: words of one syllable sound like too
// many others ("stop" like "start").
constexpr std::array<Command, 11> kCommands = {{
    {"start", "begin guiding", Event::kSayStart},
    {"save", "save points", Event::kSaySave},
    {"delete", "delete last", Event::kSayDelete},
    {"accept", "accept result", Event::kSayAccept},
    {"reject", "reject level", Event::kSayReject},
    {"next", "go to next", Event::kSayNext},
    {"done", "finish rod", Event::kSayDone},
    {"move rod", "move template", Event::kSayMoveRod},
    {"twin", "twin screw", Event::kSayTwin},
    {"numbers", "show numbers", Event::kSayNumbers},
    {"drill", "drill", Event::kSayDrill},
}};

}  // namespace

std::vector<std::string> spoken_commands() {
  std::vector<std::string> phrases;
  for (const Command& command : kCommands) {
    phrases.emplace_back(command.phrase);
  }
  return phrases;
}

std::vector<std::string> recognized_commands() {
  std::vector<std::string> phrases = spoken_commands();
  std::erase_if(phrases, [](const std::string& phrase) {
    return phrase == "drill" || phrase == "show numbers";
  });
  return phrases;
}

std::optional<Event> command_event(std::string_view text) {
  for (const Command& command : kCommands) {
    if (command.phrase == text || command.name == text) {
      return command.event;
    }
  }
  return std::nullopt;
}

std::optional<std::string_view> phrase_of(Event event) {
  const auto* const command = std::ranges::find(kCommands, event, &Command::event);
  return command == kCommands.end() ? std::nullopt : std::optional(command->phrase);
}

}  // namespace orthonav::engine
