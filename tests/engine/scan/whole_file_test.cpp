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

}  // namespace
}  // namespace orthonav::engine::whole_file_test
