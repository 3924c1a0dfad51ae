#include "engine/io/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <tuple>

#include "tests/support/file_calls.h"
#include "tests/support/full_disk.h"
#include "tests/support/is_ok.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine {
namespace {

using orthonav::test::content_of;
using orthonav::test::FileCalls;
using orthonav::test::FullDisk;
using orthonav::test::is_ok;
using orthonav::test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class StagedFile : public ::testing::TestWithParam<Staging> {};

TEST_P(StagedFile, AppearsUnderItsNameOnlyWhenCommitted) {
  const TemporaryFolder folder;
  const std::string path = folder.file("report.json");
  for (const char* content : {"whole", "newer"}) {
    auto file = AtomicFile::create(path, GetParam());
    ASSERT_TRUE(file.ok()) << file.error().message;
    const bool there = std::filesystem::exists(path);
    std::ofstream(file->temporary_path()) << content;
    EXPECT_EQ(there, std::filesystem::exists(path));
    EXPECT_TRUE(file->commit().ok());
    EXPECT_EQ(content_of(path), content);
    EXPECT_EQ(folder.count(), 1u);
  }
}

TEST_P(StagedFile, LeavesNothingWhenDropped) {
  const TemporaryFolder folder;
  std::ignore = folder.with("report.json", "old");
  {
    auto file = AtomicFile::create(folder.file("report.json"), GetParam());
    ASSERT_TRUE(file.ok());
    std::ofstream(file->temporary_path()) << "half";
  }
  EXPECT_EQ(folder.count(), 1u);
  EXPECT_EQ(content_of(folder.file("report.json")), "old");
}

INSTANTIATE_TEST_SUITE_P(Every, StagedFile, ::testing::Values(Staging::kNameless, Staging::kBeside),
                         [](const auto& each) {
                           return each.param == Staging::kNameless ? "Nameless" : "Beside";
                         });

/// However a process ends, it leaves no unfinished files.
TEST(AtomicFile, HasNoNameBeforeTheCommit) {
  const TemporaryFolder folder;
  auto file = AtomicFile::create(folder.file("report.json"));
  ASSERT_TRUE(file.ok());
  std::ofstream(file->temporary_path()) << "half";
  EXPECT_EQ(folder.count(), 0u);
}

TEST(AtomicFile, IsVisibleWhereItHasANameBeforeTheCommit) {
  const TemporaryFolder folder;
  auto file = AtomicFile::create(folder.file("operation.mp4"), Staging::kBeside);
  ASSERT_TRUE(file.ok());
  const std::string name = std::filesystem::path(file->temporary_path()).filename().string();
  EXPECT_THAT(name, ::testing::StartsWith("operation.part-"));
  EXPECT_THAT(name, ::testing::EndsWith(".mp4"));
}

/// First its content is durable, then its name, and only then is the commit reported as done.
TEST(AtomicFile, IsDurableInTheOrderThatACrashNeeds) {
  const TemporaryFolder folder;
  auto nameless = AtomicFile::create(folder.file("report.json"));
  ASSERT_TRUE(is_ok(nameless));
  {
    const FileCalls calls(folder.path().string());
    ASSERT_TRUE(is_ok(nameless->commit()));
    EXPECT_THAT(FileCalls::made(),
                ElementsAre("fsync (nameless)", "link (nameless) report.json", "fsync ."));
  }
  auto beside = AtomicFile::create(folder.file("report.json"), Staging::kBeside);
  ASSERT_TRUE(is_ok(beside));
  const std::string part = std::filesystem::path(beside->temporary_path()).filename().string();
  const FileCalls calls(folder.path().string());
  ASSERT_TRUE(is_ok(beside->commit()));
  EXPECT_THAT(FileCalls::made(),
              ElementsAre("fsync " + part, "rename " + part + " report.json", "fsync ."));
}

TEST(AtomicFile, TakesNoNameWhereItsContentIsNotDurable) {
  const TemporaryFolder folder;
  std::ignore = folder.with("report.json", "old");
  auto file = AtomicFile::create(folder.file("report.json"), Staging::kBeside);
  ASSERT_TRUE(is_ok(file));
  const std::string part = std::filesystem::path(file->temporary_path()).filename().string();
  const FileCalls calls(folder.path().string());
  FileCalls::fail_next("fsync " + part, EIO);
  EXPECT_THAT(file->commit().error().message, HasSubstr("cannot be written: Input/output error"));
  EXPECT_EQ(content_of(folder.file("report.json")), "old");
}

TEST(AtomicFile, TellsOfANameThatIsNotDurable) {
  const TemporaryFolder folder;
  auto file = AtomicFile::create(folder.file("report.json"));
  ASSERT_TRUE(is_ok(file));
  const FileCalls calls(folder.path().string());
  FileCalls::fail_next("fsync .", EIO);
  EXPECT_THAT(file->commit().error().message, HasSubstr("cannot be written: Input/output error"));
}

TEST(AtomicFile, MovesWithoutLosingOrKeepingTheFile) {
  const TemporaryFolder folder;
  {
    auto first = AtomicFile::create(folder.file("a.txt"), Staging::kBeside);
    ASSERT_TRUE(first.ok());
    AtomicFile moved = std::move(*first);
    EXPECT_EQ(folder.count(), 1u);
    EXPECT_TRUE(moved.commit().ok());
    EXPECT_FALSE(moved.commit().ok()) << "committed twice";
  }
  EXPECT_TRUE(std::filesystem::exists(folder.file("a.txt")));
}

TEST(AtomicFile, WritesThroughALinkWithoutReplacingIt) {
  const TemporaryFolder folder;
  std::ignore = folder.with("target.txt", "old");
  std::filesystem::create_symlink("target.txt", folder.file("link.txt"));
  EXPECT_TRUE(write_file(folder.file("link.txt"), "new").ok());
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link.txt")));
  EXPECT_EQ(content_of(folder.file("target.txt")), "new");
}

TEST(AtomicFile, WritesADeviceInPlace) {
  EXPECT_TRUE(write_file("/dev/null", "gone").ok());
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, TellsAFullDiskByItsCode) {
  const TemporaryFolder folder;
  const FullDisk full(10);
  const Status written = write_file(folder.file("report.json"), std::string(100, 'x'));
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.error().code, ErrorCode::kIo);
}

TEST(AtomicFile, RefusesWhatCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_THAT(AtomicFile::create("").error().message, HasSubstr("no name"));
  EXPECT_THAT(AtomicFile::create(folder.path().string()).error().message, HasSubstr("is a folder"));
  const auto nowhere = AtomicFile::create(folder.file("none/a.txt"));
  EXPECT_THAT(nowhere.error().message, HasSubstr("does not exist"));
  EXPECT_EQ(nowhere.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace orthonav::engine
