#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

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
