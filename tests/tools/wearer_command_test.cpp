#include <gtest/gtest.h>

#include "tests/tools/run_refusal.h"

namespace orthonav::test::wearer_command_test {
namespace {

TEST(LanguageOption, RefusesAFileThatIsNotComplete) {
  const ScratchFolder folder;
  expect_run_refusal({"--language", folder.with("my.toml", "\"stop\" = \"STOPP\"\n")},
                     "my.toml: lacks ");
  expect_run_refusal({"--language", "fr"}, "--language: fr: ");
  expect_run_refusal({"--language", "de"}, "/none");
}

TEST(LanguageOption, IsAKeyOfTheSettingsToo) {
  const ScratchFolder folder;
  const auto with = [&](const std::string& language) {
    return std::vector<std::string>{
        "--config", folder.with("theatre.toml", "[display]\nlanguage = \"" + language + "\"\n")};
  };
  expect_run_refusal(with("de"), "/none");
  expect_run_refusal(with("my.toml"), folder.file("my.toml"));
  expect_run_refusal(with("no/such"), folder.file("no/such"));
}

TEST(ColoursOption, RefusesWhatWouldMislead) {
  const ScratchFolder folder;
  expect_run_refusal({"--colours", "good=#FFA010"}, "--colours: good and fair are too much alike");
  expect_run_refusal({"--colours", "colour-blind"}, "/none");
  expect_run_refusal(
      {"--config", folder.with("theatre.toml", "[display]\ncolours = \"poor=#600000\"\n")},
      "--colours: poor has 0.02 of white's luminance");
}

}  // namespace
}  // namespace orthonav::test::wearer_command_test
