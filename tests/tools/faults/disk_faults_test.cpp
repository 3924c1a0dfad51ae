#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "tests/support/tag_scene.h"
#include "tests/support/wait_until.h"
#include "tests/tools/faults/failing_disk.h"
#include "tests/tools/faults/short_run.h"
#include "tests/tools/tag_recording.h"

namespace orthonav::test::disk_faults_test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

/// The calls on the disk of a run without faults, in order.
std::vector<DiskCall> calls_of(ShortRun& run) {
  const Called whole = run.run([&run] { fail_disk(run.written(), {}, run.list()); });
  EXPECT_EQ(whole.code, 0) << whole.err;
  EXPECT_TRUE(all_is_kept(run));
  EXPECT_THAT(whole.err + content_of(run.log()), Not(HasSubstr("NOT RECORDED")));
  return listed_calls(run.list());
}

/// A full or read-only disk stays so; other errors occur once.
DiskFault fault_of(const std::string& kind, std::size_t at, int problem) {
  return {kind, at, problem, problem != EIO};
}

constexpr std::array<int, 3> kProblems = {ENOSPC, EIO, EROFS};

/// Every call with every error.
std::vector<DiskFault> all_faults(const std::vector<DiskCall>& calls) {
  std::map<std::string, std::size_t> counted;
  std::vector<DiskFault> faults;
  for (const DiskCall& call : calls) {
    const std::size_t at = ++counted[call.kind];
    for (const int problem : kProblems) {
      faults.push_back(fault_of(call.kind, at, problem));
    }
  }
  return faults;
}

/// The first and the last call of every kind, with each error in turn, and passing errors within an
/// image and between the lists of a recording.
std::vector<DiskFault> few_faults(const std::vector<DiskCall>& calls) {
  std::map<std::string, std::size_t> counted;
  for (const DiskCall& call : calls) {
    ++counted[call.kind];
  }
  std::vector<DiskFault> faults = {{"write", 6, EIO, false, "VLC LF.tar"},
                                   {"write", 2, EIO, false, "VLC RF_rig2world.txt"}};
  for (const auto& [kind, count] : counted) {
    for (const std::size_t at : std::set<std::size_t>{1, count}) {
      faults.push_back(fault_of(kind, at, kProblems.at(faults.size() % kProblems.size())));
    }
  }
  return faults;
}

/// Either everything is kept, or the run reports that something is not.
void expect_told(const ShortRun& run, const Called& called) {
  EXPECT_NE(called.code, -1) << "it crashed or hung: " << called.err;
  if (!all_is_kept(run)) {
    EXPECT_EQ(called.code, 2) << called.err;
    EXPECT_THAT(called.err, HasSubstr("orthonav: "));
    EXPECT_THAT(called.err, HasSubstr(run.written())) << "the file is named";
  }
}

class DiskFaults : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!disk_can_fail()) {
      GTEST_SKIP() << "a sanitizer's runtime must be loaded first, where the failing calls must be";
    }
  }
  ShortRun run_;
};

TEST_F(DiskFaults, AtAnyCallOfARunAreToldAndLeaveWhatCanBeRead) {
  const std::vector<DiskCall> calls = calls_of(run_);
  const std::vector<DiskFault> faults =
      every_fault_is_tried() ? all_faults(calls) : few_faults(calls);
  ASSERT_GE(faults.size(), 13U) << "of open, write, sync, rename, mkdir and close";
  int lost_something = 0;
  for (const DiskFault& fault : faults) {
    const Called called = run_.run([&] { fail_disk(run_.written(), fault); });
    SCOPED_TRACE(fault.kind + " " + std::to_string(fault.at) + ": " +
                 std::generic_category().message(fault.problem));
    expect_told(run_, called);
    expect_readable(run_);
    lost_something += all_is_kept(run_) ? 0 : 1;
  }
  EXPECT_GE(lost_something, static_cast<int>(faults.size() / 3)) << "the calls do fail";
  RecordProperty("calls", static_cast<int>(calls.size()));
  RecordProperty("faults", static_cast<int>(faults.size()));
  RecordProperty("lost_something", lost_something);
}

TEST_F(DiskFaults, OfARecordingAreToldAtOnceAndTheOperationGoesOn) {
  // Each image takes four writes, so the second pair's right one begins with the fifth.
  const DiskFault full{"write", 5, ENOSPC, false, "VLC RF.tar"};
  const Called called = run_.run([&] { fail_disk(run_.written(), full); });
  EXPECT_EQ(called.code, 2) << called.err;
  EXPECT_THAT(called.err,
              HasSubstr("orthonav: NOT RECORDED from here on: " + run_.written() +
                        "/recording.part/VLC RF.tar: cannot be written: No space left on device"));
  const std::string log = content_of(run_.log());
  EXPECT_THAT(log, ContainsRegex("warning NOT RECORDED from here on: .*VLC RF.tar"));
  EXPECT_THAT(log, ContainsRegex("warning 0.03 s: the status line says NOT RECORDED\n"))
      << "with the second pair of three";
  EXPECT_THAT(log, HasSubstr("3 frames shown"));
  expect_readable(run_);
}

/// A device that fails for good: the images of a recording are cut off while it is replayed.
TEST(DeviceThatFails, LeavesTheReportsOfWhatWasMeasured) {
  const ScratchFolder folder;
  write_one_level_case(folder.file("case"));
  const std::string out = folder.file("out");
  const std::string recording = folder.file("recording");
  record(recording, test_calibration(), std::vector<std::vector<PlacedTag>>(std::size_t{70}));
  StartedCommand command({"run", "--case", folder.file("case"), "--headset",
                          "replay:" + recording + "?pace=realtime", "--out", out});
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(out + "/operation.resume"); }));
  std::filesystem::resize_file(recording + "/VLC LF.tar", std::uintmax_t{1} << 20U);
  const Called ended = command.wait();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("31 failures in a row (limit 30)"));
  const auto report = nlohmann::json::parse(content_of(out + "/report.json"));
  EXPECT_GE(report["frames"]["displayed"], 1);
  EXPECT_THAT(report["why_not"].get<std::string>(),
              ::testing::AllOf(HasSubstr("ended at setup of L5"), HasSubstr("31 failures")));
  EXPECT_TRUE(std::filesystem::exists(out + "/report.html"));
  EXPECT_THAT(content_of(out + "/operation.resume"), HasSubstr("31 failures in a row"));
}

}  // namespace
}  // namespace orthonav::test::disk_faults_test
