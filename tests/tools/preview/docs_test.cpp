#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tools/preview/keys.h"
#include "tools/preview/script.h"

namespace orthonav::preview::docs_test {
namespace {

std::string page() {
  std::ostringstream text;
  text << std::ifstream(ORTHONAV_SOURCE_DIR "/docs/preview.md").rdbuf();
  return text.str();
}

TEST(PreviewDocs, NameEveryKeyAndEveryPhrase) {
  const std::string text = page();
  for (const KeyBinding& binding : key_bindings()) {
    // `1` … `9` stand for those between.
    const bool between = binding.name >= "2" && binding.name <= "8";
    if (!between) {
      EXPECT_NE(text.find("`" + std::string(binding.name) + "`"), std::string::npos)
          << binding.name;
    }
    if (binding.command == Command::kSay) {
      EXPECT_NE(text.find("\"" + std::string(binding.what) + "\""), std::string::npos)
          << binding.what;
    }
  }
}

TEST(PreviewDocs, NameEveryWordOfAScript) {
  const std::string text = page();
  ASSERT_FALSE(script_words().empty());
  for (const std::string_view word : script_words()) {
    const std::string name(word);
    EXPECT_TRUE(text.find("`" + name + " ") != std::string::npos ||
                text.find("`" + name + "`") != std::string::npos)
        << name;
  }
}

}  // namespace
}  // namespace orthonav::preview::docs_test
