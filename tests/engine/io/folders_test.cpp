#include "engine/io/folders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

#include "tests/support/file_calls.h"
#include "tests/support/is_ok.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine {
namespace {

using orthonav::test::error_of;
using orthonav::test::FileCalls;
using orthonav::test::is_ok;
using orthonav::test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Folders, AreDurableInEachParentThatGotANewOne) {
  const TemporaryFolder folder;
  const FileCalls calls(folder.path().string());
  ASSERT_TRUE(is_ok(make_folders(folder.file("a/b/c/"))));
  EXPECT_THAT(FileCalls::made(), ElementsAre("fsync .", "fsync a", "fsync a/b"));
  ASSERT_TRUE(is_ok(make_folders(folder.file("a/b/d"))));
  EXPECT_THAT(FileCalls::made(), ElementsAre("fsync .", "fsync a", "fsync a/b", "fsync a/b"));
  ASSERT_TRUE(is_ok(make_folders(folder.file("a/b/d"))));
  EXPECT_EQ(FileCalls::made().size(), 4u) << "nothing was made";
}

TEST(Folders, AreToldTheInnermostFirstAndGoAgainWhereTheyAreEmpty) {
  const TemporaryFolder folder;
  const auto made = make_folders(folder.file("a/b"));
  ASSERT_TRUE(is_ok(made));
  EXPECT_THAT(*made, ElementsAre(folder / "a/b", folder / "a"));
  std::ofstream(folder / "a/kept") << "by someone";
  remove_empty(*made);
  EXPECT_TRUE(std::filesystem::exists(folder / "a/kept"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a/b"));
  EXPECT_THAT(*make_folders(folder.file("a")), IsEmpty());
}

TEST(Folders, LeaveNothingWhereOneIsNotDurable) {
  const TemporaryFolder folder;
  const FileCalls calls(folder.path().string());
  FileCalls::fail_next("fsync .", EIO);
  EXPECT_EQ(error_of(make_folders(folder.file("a/b"))),
            folder.path().string() + ": cannot be written: Input/output error");
  EXPECT_EQ(folder.count(), 0u);
}

TEST(Folders, AreRefusedWhereAFileLies) {
  const TemporaryFolder folder;
  const std::string file = folder.with("file", "");
  EXPECT_THAT(error_of(make_folders(file)), HasSubstr(file + ": Not a directory"));
  EXPECT_THAT(error_of(make_folders(file + "/below")), HasSubstr("Not a directory"));
}

}  // namespace
}  // namespace orthonav::engine
