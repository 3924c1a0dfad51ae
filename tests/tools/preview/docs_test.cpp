#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "engine/session/workflow/commands.h"
#include "tools/preview/keys.h"
#include "tools/preview/planning/plan_script.h"
#include "tools/preview/script.h"

namespace orthonav::preview::docs_test {
namespace {

std::string page() {
  std::ostringstream text;
  text << std::ifstream(ORTHONAV_SOURCE_DIR "/docs/preview.md").rdbuf();
  return text.str();
}

void expect_named(const std::string& text, std::string_view name) {
  EXPECT_NE(text.find("`" + std::string(name) + "`"), std::string::npos) << name;
}

void expect_said(const std::string& text, std::string_view phrase) {
  EXPECT_NE(text.find("\"" + std::string(phrase) + "\""), std::string::npos) << phrase;
}

TEST(PreviewDocs, NameEveryKeyAndEveryPhrase) {
  const std::string text = page();
  for (const KeyBinding& binding : key_bindings()) {
    // `1` … `9` stand for those between.
    const bool between = binding.name >= "2" && binding.name <= "8";
    if (!between) {
      expect_named(text, binding.name);
    }
    if (binding.command == Command::kSay) {
      expect_said(text, binding.what);
    }
  }
  for (const PlanKeyBinding& binding : plan_key_bindings()) {
    expect_named(text, binding.name);
    if (binding.command == PlanCommand::kSay) {
      expect_said(text, binding.what);
    }
  }
}

/// The commands' keys come from the session; none of them is one of the window's own.
TEST(PreviewKeys, SayEveryCommandThatHasOne) {
  for (const engine::Command& command : engine::kCommands) {
    if (command.key == '\0') {
      continue;
    }
    const KeyBinding* binding = binding_of(key_of(command.key));
    ASSERT_NE(binding, nullptr) << command.name;
    EXPECT_EQ(binding->command, Command::kSay) << command.name;
    EXPECT_EQ(binding->what, command.name);
    const PlanKeyBinding* of_plan = plan_binding_of(key_of(command.key));
    if (command.event == engine::Event::kSayReplan) {
      ASSERT_NE(of_plan, nullptr) << command.name;
      EXPECT_EQ(of_plan->what, command.name);
    }
  }
  std::set<Key> keys;
  for (const KeyBinding& binding : key_bindings()) {
    EXPECT_TRUE(keys.insert(binding.key).second) << binding.name;
  }
  keys.clear();
  for (const PlanKeyBinding& binding : plan_key_bindings()) {
    EXPECT_TRUE(keys.insert(binding.key).second) << binding.name;
  }
}

TEST(PreviewDocs, NameEveryWordOfAScript) {
  const std::string text = page();
  for (const auto words : {script_words(), plan_script_words()}) {
    ASSERT_FALSE(words.empty());
    for (const ScriptWord& word : words) {
      const std::string name(word.word);
      EXPECT_TRUE(text.find("`" + name + " ") != std::string::npos ||
                  text.find("`" + name + "`") != std::string::npos)
          << name;
    }
  }
}

}  // namespace
}  // namespace orthonav::preview::docs_test
