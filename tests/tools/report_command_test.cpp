#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/whole_log.h"
#include "tests/tools/command_line.h"

namespace orthonav::test::report_command_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

TEST(ReportCommand, MakesThePageOfASessionAndOfWhatIsLeftOfOne) {
  const std::string whole = whole_log();
  ASSERT_GT(whole.size(), 10'000U);
  const ScratchFolder folder;
  const std::string page = folder.file("page.html");
  const Called done =
      orthonav({"report", folder.with("operation.resume", whole), "--out", page, "--json",
                folder.file("page.json"), "--records", folder.file("records.jsonl")});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(done.err, "");
  EXPECT_THAT(content_of(page), HasSubstr("Operation completed"));
  const json figures = json::parse(content_of(folder.file("page.json")));
  EXPECT_EQ(figures["completed"], true);
  EXPECT_EQ(figures["levels"][0]["screws"].size(), 2U);
  std::istringstream records(content_of(folder.file("records.jsonl")));
  std::vector<json> lines;
  for (std::string line; std::getline(records, line);) {
    lines.push_back(json::parse(line));
  }
  ASSERT_GT(lines.size(), 50U);
  EXPECT_EQ(lines.front()["what"], "begun");
  EXPECT_EQ(lines.back()["what"], "ended");
  EXPECT_EQ(lines.back()["record"], lines.size());
  EXPECT_EQ(figures["session"]["records"], lines.size());

  const ScratchFolder results;
  const std::string part = results.with("operation.resume", whole.substr(0, whole.size() / 2));
  const Called cut = orthonav({"report", results.file(""), "--out", page});
  ASSERT_EQ(cut.code, 0) << cut.err;
  EXPECT_THAT(cut.err, HasSubstr("warning: " + part + ": The log has no end: its last record"));
  EXPECT_THAT(content_of(page), HasSubstr("This session was cut off"));
}

TEST(ReportCommand, SaysWhatItCannotRead) {
  const ScratchFolder folder;
  const std::string page = folder.file("page.html");
  const Called none = orthonav({"report", folder.file(""), "--out", page});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("holds no operation.resume"));
  const std::string journal = folder.with("session.orthonav", "{\"format\":\"orthonav session\"}");
  for (const std::string& earlier : {journal, folder.file("")}) {
    EXPECT_THAT(orthonav({"report", earlier, "--out", page}).err,
                HasSubstr("holds a journal (session.orthonav) of an earlier version of orthonav"));
  }
  const Called empty = orthonav({"report", folder.with("operation.resume", ""), "--out", page});
  EXPECT_EQ(empty.code, 2);
  EXPECT_THAT(empty.err, HasSubstr("operation.resume: holds no whole record"));
  std::ignore = folder.with("operation.resume", "not records");
  EXPECT_THAT(orthonav({"report", folder.file(""), "--out", page}).err,
              HasSubstr("operation.resume: is not a file of records of an operation"));
  EXPECT_FALSE(std::filesystem::exists(page));
}

}  // namespace
}  // namespace orthonav::test::report_command_test
