#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/io/posix_env.h"
#include "engine/session/log/operation_log.h"
#include "tests/support/wait_until.h"
#include "tests/tools/faults/failing_disk.h"
#include "tests/tools/faults/short_run.h"

namespace orthonav::test::resumed_commands_test {
namespace {

using engine::LoggedOperation;
using engine::OperationLog;
using engine::OperationRecord;
using nlohmann::json;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A folder with an operation that was begun by `run` and interrupted.
class KeptCommand : public ::testing::Test {
 protected:
  void SetUp() override { write_one_level_case(folder_.file("case")); }

  /// The words of a command for that operation.
  std::vector<std::string> words(const std::string& command, std::vector<std::string> more = {}) {
    std::vector<std::string> all = {command, "--case", folder_.file("case"), "--out", out_};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  std::vector<std::string> run(std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--headset", "sim:?seed=1", "--frames", "3"});
    return words("run", std::move(more));
  }
  /// As if `screws` screws had been placed when the computer died.
  void place(std::size_t screws) {
    auto found = OperationLog::find(env_, out_).value();
    engine::LevelState level = found.operation.state.levels.front();
    const auto log =
        OperationLog::reopen(env_, std::move(found), engine::RecordWriter::Waits::kUntilDurable);
    const Timestamp then(std::chrono::seconds(60));
    level.registration.emplace().accepted = true;
    level.newest.emplace().registration = *level.registration;
    log->registered(then, level, {level.registration, std::nullopt});
    log->accepted(then, level, "verify L5");
    for (std::size_t screw = 0; screw < screws; ++screw) {
      log->screw_done(then, level, screw, nullptr);
    }
    ASSERT_TRUE(log->written().ok());
  }
  /// The sides of the screws in the order in which they were placed.
  std::vector<std::string> placed() {
    std::vector<std::string> sides;
    const auto read = engine::read_log(env_, out_ + "/operation.resume").value();
    for (const engine::Record& record : read.records) {
      if (record.type == static_cast<std::uint16_t>(OperationRecord::kScrew)) {
        sides.push_back(json::parse(record.payload)["side"]);
      }
    }
    return sides;
  }
  static void expect_refused(const Called& called, const std::string& why) {
    EXPECT_EQ(called.code, 2) << called.err;
    EXPECT_THAT(called.out, IsEmpty());
    EXPECT_THAT(called.err, HasSubstr(why));
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
  }

  ScratchFolder folder_;
  std::string out_ = folder_.file("out");
  engine::PosixEnv env_;
};

TEST_F(KeptCommand, RunGoesOnAfterAPlacedScrewAndPlacesItNoSecondTime) {
  ASSERT_EQ(orthonav(run()).code, 0);
  place(1);
  for (int time = 0; time < 2; ++time) {
    const Called resumed = orthonav(run({"--resume", "--json"}));
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_THAT(resumed.err, HasSubstr("orthonav: placed: L5 left\n"));
    const json screws = json::parse(resumed.out)["levels"][0]["screws"];
    EXPECT_EQ(screws[0]["done"], true);
    EXPECT_EQ(screws[1]["done"], false);
    EXPECT_THAT(placed(), ElementsAre("left"));
  }
}

TEST_F(KeptCommand, RunGoesOnThoughItsDiskCanOnlyBeRead) {
  if (!disk_can_fail()) {
    GTEST_SKIP() << "a sanitizer's runtime must be loaded first, where the failing calls must be";
  }
  ASSERT_EQ(orthonav(run()).code, 0);
  place(1);
  StartedCommand resumed(run({"--resume", "--json"}), [this] {
    fail_disk(out_, {"open", 1, EROFS, true});
  });
  const Called ended = resumed.wait();
  EXPECT_EQ(ended.code, 2) << "not all was saved";
  EXPECT_THAT(ended.err, HasSubstr("orthonav: NOT SAVED from here on: "));
  EXPECT_THAT(ended.err, HasSubstr("orthonav: placed: L5 left\n"));
  EXPECT_EQ(json::parse(ended.out)["levels"][0]["screws"][0]["done"], true);
}

TEST_F(KeptCommand, DemoGoesOnWithWhatWasPlacedAndComesToItsEnd) {
  ASSERT_EQ(orthonav(run()).code, 0);
  place(2);
  const std::vector<std::string> demo =
      words("demo", {"--pace", "4", "--no-video", "--resume", "--json"});
  const Called resumed = orthonav(demo);
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("orthonav: placed: L5 left, L5 right\n"));
  const json report = json::parse(resumed.out);
  EXPECT_EQ(report["completed"], true);
  EXPECT_EQ(report["levels"][0]["screws"][0]["done"], true);
  EXPECT_EQ(report["levels"][0]["screws"][1]["done"], true);
  EXPECT_THAT(placed(), ElementsAre("left", "right")) << "none twice";
  expect_refused(orthonav(demo), "that operation was done, there is nothing to resume");
}

TEST_F(KeptCommand, DemoThatFindsNoRoomForAPictureSaysSoAndComesToItsEnd) {
  if (!disk_can_fail()) {
    GTEST_SKIP() << "a sanitizer's runtime must be loaded first, where the failing calls must be";
  }
  ASSERT_EQ(orthonav(run()).code, 0);
  place(2);
  StartedCommand demo(words("demo", {"--pace", "4", "--resume"}), [this] {
    fail_disk(out_, {"rename", 1, ENOSPC, false, "01-setup.png"});
  });
  const Called ended = demo.wait();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, ContainsRegex("setup.*\northonav: .*/01-setup.png: cannot be written: No "
                                       "space left on device; the operation goes on without\n"));
  EXPECT_EQ(json::parse(content_of(out_ + "/report.json"))["completed"], true);
  EXPECT_TRUE(std::filesystem::exists(out_ + "/operation.mp4")) << "the film goes on";
  EXPECT_THAT(content_of(out_ + "/report.html"), HasSubstr("operation.mp4"));
}

TEST_F(KeptCommand, DemoWhoseFilmFindsNoMoreRoomSaysSoAndComesToItsEnd) {
  if (!disk_can_fail()) {
    GTEST_SKIP() << "a sanitizer's runtime must be loaded first, where the failing calls must be";
  }
  ASSERT_EQ(orthonav(run()).code, 0);
  place(2);
  StartedCommand demo(words("demo", {"--pace", "4", "--resume"}), [this] {
    fail_disk(out_, {"write", 3, ENOSPC, true, "operation.part"});
  });
  const Called ended = demo.wait();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, ContainsRegex("operation.mp4: writing failed .No space left on device.; "
                                       "what was written plays: .*operation.part-.*mp4\n"));
  EXPECT_EQ(json::parse(content_of(out_ + "/report.json"))["completed"], true);
  EXPECT_TRUE(std::filesystem::exists(out_ + "/01-setup.png")) << "the pictures go on";
  EXPECT_FALSE(std::filesystem::exists(out_ + "/operation.mp4"));
  EXPECT_THAT(content_of(out_ + "/report.html"), Not(HasSubstr("operation.mp4")));
}

/// A whole operation, which takes minutes: of tools/test --all.
TEST_F(KeptCommand, DemoInterruptedAfterItsFirstScrewEndsWithBothAndNoneTwice) {
  if (!every_fault_is_tried()) {
    GTEST_SKIP() << "ORTHONAV_EVERY_FAULT is not set";
  }
  const std::vector<std::string> demo = words("demo", {"--pace", "4", "--no-video", "--json"});
  StartedCommand first(demo);
  const auto placed_one = [this] {
    return wait_until([this] {
      return std::filesystem::exists(out_ + "/operation.resume") && !placed().empty();
    });
  };
  constexpr int kMaxWaits = 20;
  int waits = 0;
  while (!placed_one() && ++waits < kMaxWaits) {
  }
  first.send(SIGTERM);
  const Called interrupted = first.wait();
  ASSERT_EQ(interrupted.code, 1) << interrupted.err;
  EXPECT_THAT(placed(), ElementsAre("left"));
  const json before = json::parse(interrupted.out)["levels"][0]["screws"][0];
  const std::string log = content_of(out_ + "/operation.resume");
  std::vector<std::string> resume = demo;
  resume.emplace_back("--resume");
  const Called resumed = orthonav(resume);
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("orthonav: placed: L5 left\n"));
  EXPECT_THAT(placed(), ElementsAre("left", "right"));
  EXPECT_EQ(content_of(out_ + "/operation.resume").substr(0, log.size()), log);
  const json after = json::parse(resumed.out)["levels"][0]["screws"];
  EXPECT_EQ(after[0]["done"], true);
  EXPECT_EQ(after[0]["planned"], before["planned"]);
  EXPECT_EQ(after[1]["done"], true);
}

TEST_F(KeptCommand, RefusesTheCaseOfAnotherPatientAndChangesNothing) {
  ASSERT_EQ(orthonav(run()).code, 0);
  const std::string log = content_of(out_ + "/operation.resume");
  std::filesystem::remove_all(folder_.file("case"));
  write_one_level_case(folder_.file("case"), "L4");
  expect_refused(orthonav(run({"--resume"})),
                 "out/operation.resume: is of another patient: the models");
  EXPECT_EQ(content_of(out_ + "/operation.resume"), log);
}

TEST_F(KeptCommand, HasItsFolderForItselfAlone) {
  const StartedCommand first(
      words("run", {"--headset", "sim:?seed=1", "--record", folder_.file("recording")}));
  ASSERT_TRUE(wait_until([this] {
    std::error_code none;
    return std::filesystem::file_size(folder_.file("recording.part/frames.csv"), none) > 100 &&
           !none;
  }));
  const std::string log = content_of(out_ + "/operation.resume");
  expect_refused(orthonav(run()), "out: is in use by another operation");
  expect_refused(orthonav(run({"--resume"})), "out: is in use by another operation");
  expect_refused(orthonav(words("demo")), "out: is in use by another operation");
  EXPECT_EQ(content_of(out_ + "/operation.resume"), log);
}

}  // namespace
}  // namespace orthonav::test::resumed_commands_test
