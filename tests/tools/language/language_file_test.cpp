#include "tools/orthonav/language/language_file.h"

#include <gmock/gmock.h>

#include "tests/support/temporary_folder.h"
#include "tools/orthonav/language/language_check.h"

namespace orthonav::tools::language_file_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> kTexts = {"tool lost", "tip moved %.1f mm, limit %.1f mm",
                                         "say accept result to take it", "only %.0f %% of it"};

std::vector<LanguageLine> german() {
  return {{"tool lost", "Werkzeug verloren", 1},
          {"tip moved %.1f mm, limit %.1f mm", "Spitze %.1f mm verrutscht, Grenze %.1f mm", 2},
          {"say accept result to take it", "zum Übernehmen accept result sagen", 3},
          {"only %.0f %% of it", "nur %.0f %% davon", 4}};
}

/// The German lines with one text replaced.
std::string refusal_with(std::size_t line, const std::string& text) {
  auto lines = german();
  lines[line].text = text;
  const auto checked = checked_translation("my.toml", lines, kTexts);
  return checked ? "" : checked.error().message;
}

TEST(Language, IsTakenWhenItIsComplete) {
  const auto checked = checked_translation("my.toml", german(), kTexts);
  ASSERT_TRUE(checked) << checked.error().message;
  ASSERT_NE(checked->find("tool lost"), nullptr);
  EXPECT_EQ(*checked->find("tool lost"), "Werkzeug verloren");
  EXPECT_EQ(checked->find("tool"), nullptr);
}

TEST(Language, LacksNoText) {
  EXPECT_EQ(refusal_with(1, ""),
            "my.toml: lacks 1 of 4 texts, the first is \"tip moved %.1f mm, limit %.1f mm\"");
  const auto none = checked_translation("my.toml", {}, kTexts);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "my.toml: lacks 4 of 4 texts, the first is \"tool lost\"");
}

TEST(Language, HasNoTextThatThereIsNot) {
  auto lines = german();
  lines.push_back({"tool\nfound", "Werkzeug gefunden", 5});
  const auto checked = checked_translation("my.toml", lines, kTexts);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().message, "my.toml:5: \"tool found\" is not a text of this version");
}

TEST(Language, KeepsEveryNumber) {
  const std::string start =
      "my.toml:2: the translation of \"tip moved %.1f mm, limit %.1f mm\" has the conversions ";
  EXPECT_EQ(refusal_with(1, "Spitze %.1f mm verrutscht"), start + "%.1f, must have %.1f %.1f");
  EXPECT_EQ(refusal_with(1, "%.1f %.2f"), start + "%.1f %.2f, must have %.1f %.1f");
  EXPECT_EQ(refusal_with(1, "%.1f %.1f %s"), start + "%.1f %.1f %s, must have %.1f %.1f");
  EXPECT_EQ(refusal_with(1, "%.1f %n"), start + "%.1f %n, must have %.1f %.1f");
  EXPECT_EQ(refusal_with(1, "keine"), start + "none, must have %.1f %.1f");
  EXPECT_EQ(refusal_with(1, "%.1f %.1f %"), start + "%.1f %.1f %, must have %.1f %.1f");
  EXPECT_THAT(refusal_with(0, "zu 5 % verloren"), HasSubstr("(a percent sign is written %%)"));
  EXPECT_EQ(refusal_with(3, "%% %.0f"), "");
}

TEST(Language, KeepsTheCommands) {
  EXPECT_EQ(refusal_with(2, "zum Übernehmen annehmen sagen"),
            "my.toml:3: the translation of \"say accept result to take it\" lacks the command "
            "\"accept result\", which is said in English");
  EXPECT_NE(refusal_with(2, "acceptieren"), "") << "a part of a word is not a command";
  const std::vector<std::string> texts = {"check again or reject level", "the tip is done"};
  const auto checked = checked_translation(
      "my.toml", {{texts[1], "fertig", 1}, {texts[0], "erneut prüfen", 2}}, texts);
  ASSERT_FALSE(checked);
  EXPECT_THAT(checked.error().message, HasSubstr("lacks the command \"reject level\""));
}

TEST(Language, HoldsOnlyWhatTheDisplayShows) {
  const std::string start = "my.toml:1: the translation of \"tool lost\" ";
  EXPECT_EQ(refusal_with(0, "инструмент"), start + "holds U+0438, which the display's font lacks");
  EXPECT_EQ(refusal_with(0, "a\nb"), start + "holds a control character, U+000a");
  EXPECT_EQ(refusal_with(0, "a\xc2\x85"), start + "holds a control character, U+0085");
  EXPECT_EQ(refusal_with(0, "a\xff"), start + "is not UTF-8");
  EXPECT_EQ(refusal_with(0, " verloren"), start + "begins or ends with a space");
  EXPECT_EQ(refusal_with(0, "ÄÖÜäöüßéèçñøåÿ"), "");
}

/// What is said of a file with this content.
std::string refusal_of(const std::string& content) {
  const test::TemporaryFolder folder;
  const auto loaded = language_named(folder.with("my.toml", content));
  const std::string message = loaded ? "" : loaded.error().message;
  EXPECT_THAT(message, Not(HasSubstr("\n")));
  return message;
}

TEST(LanguageFile, IsRefusedInOneLine) {
  EXPECT_THAT(refusal_of(""), HasSubstr("the first is \"just over\""));
  EXPECT_THAT(refusal_of("\"just over\" = 5\n"),
              HasSubstr("my.toml:1: \"just over\" must be a text"));
  EXPECT_THAT(refusal_of("\n\"just over\n"), HasSubstr("my.toml:2: "));
  EXPECT_THAT(refusal_of("\"stop\" = \"a\"\n\"stop\" = \"b\"\n"), HasSubstr("my.toml:2: "));
  EXPECT_THAT(refusal_of("\"stop\" = \"\\u0007\"\n"), HasSubstr("U+0007"));
  EXPECT_THAT(refusal_of("\"stop\" = \"\xff\"\n"), HasSubstr("my.toml:1: "));
  EXPECT_THAT(refusal_of("\"stopp\" = \"a\"\n"),
              HasSubstr("my.toml:1: \"stopp\" is not a text of this version"));
  const auto absent = language_named("/none.toml");
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, ErrorCode::kNotFound);
}

TEST(LanguageFile, OfGermanIsComplete) {
  const auto english = language_named("en");
  ASSERT_TRUE(english);
  EXPECT_EQ(*english, nullptr);
  const auto german = language_named("de");
  ASSERT_TRUE(german) << german.error().message;
  ASSERT_NE(*german, nullptr);
  const std::string* lost = (*german)->find("tool lost");
  ASSERT_NE(lost, nullptr);
  EXPECT_EQ(*lost, "Werkzeug verloren");
  EXPECT_EQ((*german)->entries().size(), texts_to_translate().size());
}

}  // namespace
}  // namespace orthonav::tools::language_file_test
