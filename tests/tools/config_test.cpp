#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/command_line.h"
#include "tests/tools/run_refusal.h"

namespace orthonav::test::config_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Settings with this content, refused by `run`.
void expect_refusal(const std::string& content, const std::string& reason,
                    const std::vector<std::string>& more = {}) {
  const ScratchFolder folder;
  std::vector<std::string> arguments = {"--config", folder.with("theatre.toml", content)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  expect_run_refusal(arguments, reason);
}

TEST(Config, RefusesWhatItDoesNotKnowByNameAndLine) {
  expect_refusal("[tools]\nfile = \"t.json\"\nfiel = \"t.json\"\n",
                 "theatre.toml:3: unknown key of [tools] \"fiel\"; did you mean file?");
  expect_refusal("\n[tolls]\n", "theatre.toml:2: unknown section \"tolls\"; did you mean tools?");
  expect_refusal("headset = \"sim:\"\n", "theatre.toml:1: unknown section \"headset\"");
  expect_refusal("[limits]\nwire_mm = [1, 2]\n",
                 "theatre.toml:2: limits.wire_mm must be a text, a number, true or false");
  expect_refusal("[rig]\nheadset = \"\"\n", "theatre.toml:2: rig.headset must not be empty");
  expect_refusal("[rig\n", "theatre.toml:1: ");
  expect_refusal("[limits]\nwire_mm = 40\n",
                 "theatre.toml:2: limits.wire_mm (--wire-mm: \"40\" must");
}

TEST(Config, NamesFilesFromWhereItLiesAndAFlagWins) {
  // The missing case is refused only after the settings are read.
  expect_refusal("[tools]\nfile = \"absent.json\"\n", "/absent.json");
  expect_refusal("[rig]\nheadset = \"holo:\"\n", "unknown scheme");
  expect_refusal("[rig]\nheadset = \"holo:\"\n", "/none", {"--headset", "sim:"});
  const Called absent = orthonav({"run", "--config", "/none.toml"});
  EXPECT_EQ(absent.code, 2);
  EXPECT_THAT(absent.err, HasSubstr("/none.toml"));
}

TEST(Config, IsShownAsAFileThatIsReadBackToTheSame) {
  const ScratchFolder folder;
  const std::string mine = folder.with(
      "mine.toml",
      "[limits]\nwire_mm = 1.5\n[voice]\ndevice = \"mic:a\\\"b\"\n[tools]\nreference = true\n");
  const Called shown = orthonav({"config", "show", "--config", mine});
  ASSERT_EQ(shown.code, 0) << shown.err;
  EXPECT_THAT(shown.out, AllOf(HasSubstr("\nwire_mm = 1.5\n"), HasSubstr("\nreference = true\n"),
                               HasSubstr("\ndevice = \"mic:a\\\"b\"\n"),
                               HasSubstr("\n#good_deg = 2\n"), HasSubstr("(--tools of ")));
  const std::string again = folder.with("again.toml", shown.out);
  EXPECT_EQ(orthonav({"config", "show", "--config", again}).out, shown.out);
  EXPECT_EQ(orthonav({"config", "show"}).out.find("\nwire_mm"), std::string::npos);
}

}  // namespace
}  // namespace orthonav::test::config_test
