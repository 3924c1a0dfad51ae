#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <set>

#include "hal/fake/scripted.h"
#include "hal/replay/recorder.h"
#include "tests/support/file_calls.h"
#include "tests/support/is_ok.h"
#include "tests/support/scripted_session.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::replay {
namespace {

using orthonav::test::FileCalls;
using orthonav::test::is_ok;
using orthonav::test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSubsetOf;

/// One pair, not closed yet.
std::unique_ptr<RecordingHeadset> of_one_pair(const TemporaryFolder& folder) {
  auto recorder =
      RecordingHeadset::create(std::make_unique<fake::FakeHeadset>(test::scripted_session()),
                               folder / "session")
          .value();
  StereoFrame frame;
  EXPECT_TRUE(is_ok(recorder->cameras()->next(frame)));
  return recorder;
}

TEST(RecordingOnDisk, HasItsNameOnlyOnceAllOfItWouldOutlastALossOfPower) {
  const TemporaryFolder folder;
  const auto recorder = of_one_pair(folder);
  std::set<std::string> synced;
  for (const auto& file : std::filesystem::directory_iterator(folder / "session.part")) {
    synced.insert("fsync session.part/" + file.path().filename().string());
  }
  ASSERT_GT(synced.size(), 5u);
  const FileCalls calls(folder.path().string());
  ASSERT_TRUE(is_ok(recorder->close()));
  std::vector<std::string> made = FileCalls::made();
  ASSERT_GT(made.size(), 3u);
  EXPECT_THAT(std::vector(made.end() - 3, made.end()),
              ElementsAre("fsync session.part", "rename session.part session", "fsync ."));
  EXPECT_THAT(synced, IsSubsetOf(made));
  const auto last_write = std::find_if(made.rbegin(), made.rend(), [](const std::string& call) {
    return call.starts_with("write");
  });
  const auto first_sync = std::find_if(
      made.begin(), made.end(), [](const std::string& call) { return call.starts_with("fsync"); });
  EXPECT_LE(last_write.base(), first_sync) << "what is written later would not be durable";
}

TEST(RecordingOnDisk, KeepsItsTemporaryNameWhereASyncFailed) {
  const TemporaryFolder folder;
  const auto recorder = of_one_pair(folder);
  const FileCalls calls(folder.path().string());
  FileCalls::fail_next("fsync session.part/VLC LF.tar", EIO);
  const Status closed = recorder->close();
  ASSERT_FALSE(closed.ok());
  EXPECT_THAT(closed.error().message,
              HasSubstr("VLC LF.tar: may not outlast a loss of power: Input/output error"));
  EXPECT_EQ(closed.error().code, ErrorCode::kIo);
  EXPECT_TRUE(std::filesystem::exists(folder / "session.part"));
  EXPECT_FALSE(std::filesystem::exists(folder / "session"));
}

}  // namespace
}  // namespace orthonav::replay
