// The one list of commands: what it gives to each device is what a session understands.
#include "engine/session/workflow/commands.h"

#include <gmock/gmock.h>

#include <set>

namespace orthonav::engine::commands_test {
namespace {

using ::testing::Contains;
using ::testing::Not;

TEST(Commands, AreUnderstoodAsTheirEvents) {
  for (const Command& command : kCommands) {
    for (const std::string_view text : {command.phrase, command.name}) {
      const auto replan = replan_from(text);
      if (command.event == Event::kSayReplan) {
        EXPECT_TRUE(replan && *replan) << text;
        EXPECT_FALSE(command_event(text)) << text;
      } else {
        EXPECT_EQ(command_event(text), command.event) << text;
        EXPECT_EQ(phrase_of(command.event), command.phrase);
      }
    }
  }
  EXPECT_FALSE(command_event("accepted"));
  EXPECT_FALSE(phrase_of(Event::kSayReplan));
  EXPECT_FALSE(phrase_of(Event::kPress));
}

TEST(Commands, AreListenedForByTheHeadsetAndInPartByOurRecognition) {
  for (const Command& command : kCommands) {
    const std::string phrase(command.phrase);
    EXPECT_THAT(headset_phrases(), Contains(phrase).Times(1));
    EXPECT_THAT(spotted_phrases(), Contains(phrase).Times(command.spotted ? 1 : 0));
  }
  EXPECT_THAT(headset_phrases(), Contains("save")) << "as in the publication";
  EXPECT_THAT(headset_phrases(), Contains("delete"));
  EXPECT_THAT(spotted_phrases(), Not(Contains("save")));
}

TEST(Commands, HaveNamesPhrasesAndKeysOfTheirOwn) {
  std::set<std::string_view> names;
  std::set<std::string_view> phrases;
  std::set<char> keys;
  std::size_t with_key = 0;
  for (const Command& command : kCommands) {
    names.insert(command.name);
    phrases.insert(command.phrase);
    with_key += command.key != '\0' ? 1 : 0;
    if (command.key != '\0') {
      keys.insert(command.key);
    }
  }
  EXPECT_EQ(names.size(), kCommands.size());
  EXPECT_EQ(phrases.size(), kCommands.size());
  EXPECT_EQ(keys.size(), with_key);
}

}  // namespace
}  // namespace orthonav::engine::commands_test
