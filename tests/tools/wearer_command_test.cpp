#include <gmock/gmock.h>

#include <algorithm>

#include "tests/tools/command_line.h"

namespace orthonav::test::wearer_command_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Refused before anything is prepared, in one line.
void expect_refusal(const std::vector<std::string>& arguments, const std::string& reason) {
  std::vector<std::string> words = {"run", "--case", "/none"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const Called called = orthonav(words);
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.out, IsEmpty());
  EXPECT_THAT(called.err, HasSubstr(reason));
  EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
}

TEST(LanguageOption, RefusesAFileThatIsNotComplete) {
  const ScratchFolder folder;
  expect_refusal({"--language", folder.with("my.toml", "\"stop\" = \"STOPP\"\n")},
                 "my.toml: lacks ");
  expect_refusal({"--language", "fr"}, "--language: fr: ");
  expect_refusal({"--language", "de"}, "/none");
}

TEST(LanguageOption, IsAKeyOfTheSettingsToo) {
  const ScratchFolder folder;
  const auto with = [&](const std::string& language) {
    return std::vector<std::string>{
        "--config", folder.with("theatre.toml", "[display]\nlanguage = \"" + language + "\"\n")};
  };
  expect_refusal(with("de"), "/none");
  expect_refusal(with("my.toml"), folder.file("my.toml"));
  expect_refusal(with("no/such"), folder.file("no/such"));
}

TEST(ColoursOption, RefusesWhatWouldMislead) {
  const ScratchFolder folder;
  expect_refusal({"--colours", "good=#FFA010"}, "--colours: good and fair are too much alike");
  expect_refusal({"--colours", "colour-blind"}, "/none");
  expect_refusal(
      {"--config", folder.with("theatre.toml", "[display]\ncolours = \"poor=#600000\"\n")},
      "--colours: poor has 0.02 of white's luminance");
}

}  // namespace
}  // namespace orthonav::test::wearer_command_test
