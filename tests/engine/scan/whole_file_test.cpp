#include "engine/scan/whole_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace orthonav::engine::whole_file_test {
namespace {

using ::testing::HasSubstr;

TEST(WholeFile, CountsTheBytesThatAreThere) {
  const orthonav::test::TemporaryFolder folder;
  const std::string path = folder.with("plain.nii", std::string(1000, 'x'));
  EXPECT_TRUE(check_whole(path, 1000).ok());
  const Status cut = check_whole(path, 1001);
  ASSERT_FALSE(cut.ok());
  EXPECT_THAT(cut.error().message, HasSubstr("it holds 1000 bytes, must hold 1001"));
  EXPECT_FALSE(check_whole(folder.file("none.nii"), 1).ok());
}

TEST(WholeFile, IsTooShortForMoreVoxelsThanAnyCompressionHolds) {
  const orthonav::test::TemporaryFolder folder;
  const std::string path = folder.with("slice.dcm", std::string(100, 'x'));
  EXPECT_TRUE(check_long_enough(path, 103'200).ok());
  const Status short_of = check_long_enough(path, 104'232);
  ASSERT_FALSE(short_of.ok());
  EXPECT_THAT(short_of.error().message,
              HasSubstr("is 100 bytes long, too short for 104232 bytes of voxels"));
  EXPECT_FALSE(check_long_enough(folder.file("none.dcm"), 1).ok());
}

TEST(WholeFile, NamesNoOtherFile) {
  const orthonav::test::TemporaryFolder folder;
  EXPECT_TRUE(check_names_no_other_file(
      folder.with("own.nrrd", "NRRD0004\ntype: short\n\ndata file: is voxels here")));
  for (const char* field :
       {"data file: ../other.raw", "Data File: LIST", "datafile: /etc/passwd"}) {
    EXPECT_FALSE(check_names_no_other_file(
        folder.with("other.nrrd", std::string("NRRD0004\ntype: short\n") + field + "\n\n")))
        << field;
  }
}

}  // namespace
}  // namespace orthonav::engine::whole_file_test
