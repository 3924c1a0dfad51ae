#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/tools/command_line.h"

namespace orthonav::test::report_command_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// A real session on one level, from its first word to its last.
std::string journal_of_a_session() {
  return content_of(std::filesystem::path(ORTHONAV_SOURCE_DIR) / "tests/data/session.orthonav");
}

TEST(ReportCommand, MakesThePageOfASessionAndOfWhatIsLeftOfOne) {
  const std::string whole = journal_of_a_session();
  ASSERT_GT(whole.size(), 10'000U);
  const ScratchFolder folder;
  const std::string page = folder.file("page.html");
  const Called done = orthonav({"report", folder.with("session.orthonav", whole), "--out", page,
                                "--json", folder.file("page.json")});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(done.err, "");
  EXPECT_THAT(content_of(page), HasSubstr("Operation completed"));
  const json figures = json::parse(content_of(folder.file("page.json")));
  EXPECT_EQ(figures["completed"], true);
  EXPECT_EQ(figures["levels"][0]["screws"].size(), 2U);

  const ScratchFolder results;
  const std::string part = results.with("session.orthonav.part", whole.substr(0, 10'240));
  const Called cut = orthonav({"report", results.file(""), "--out", page});
  ASSERT_EQ(cut.code, 0) << cut.err;
  EXPECT_THAT(cut.err, HasSubstr("warning: " + part + ": The journal has no end: its last line"));
  EXPECT_THAT(content_of(page), HasSubstr("This session was cut off"));
}

TEST(ReportCommand, SaysWhatItCannotRead) {
  const ScratchFolder folder;
  const std::string page = folder.file("page.html");
  const Called none = orthonav({"report", folder.file(""), "--out", page});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("holds no session.orthonav and no session.orthonav.part"));
  const Called empty = orthonav({"report", folder.with("session.orthonav", ""), "--out", page});
  EXPECT_EQ(empty.code, 2);
  EXPECT_THAT(empty.err, HasSubstr("session.orthonav: is empty"));
  std::ignore = folder.with("session.orthonav.part", "");
  EXPECT_THAT(orthonav({"report", folder.file(""), "--out", page}).err,
              HasSubstr("name one of them"));
  EXPECT_FALSE(std::filesystem::exists(page));
}

}  // namespace
}  // namespace orthonav::test::report_command_test
