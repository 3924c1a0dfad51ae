#include "tools/orthonav/shared/disk_space.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/command_line.h"

namespace orthonav::tools::disk_space_test {
namespace {

using ::testing::IsEmpty;
using ::testing::MatchesRegex;

TEST(DiskSpace, SaysWhatIsFreeAndNeededWhereThatIsMore) {
  const test::ScratchFolder folder;
  // The place of a folder that is still to be made.
  const std::string place = folder.file("out/of/it");
  EXPECT_THAT(short_of_space("--record", place, 1e18),
              MatchesRegex("--record .*/out/of/it: [0-9.]+ GB free, up to 1000000000.0 GB needed"));
  EXPECT_THAT(short_of_space("--record", place, 1.0), IsEmpty());
  EXPECT_THAT(short_of_space("--record", "new", 1e18),
              MatchesRegex("--record new: [0-9.]+ GB free, .*"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(DiskSpace, IsNeededByARecordingAsLongAsItLasts) {
  EXPECT_NEAR(recording_bytes(60.0), 60.0 * 30.0 * 614'400.0, 1.0);
  EXPECT_NEAR(recording_bytes(0.0), recording_bytes(1200.0), 1.0);
}

}  // namespace
}  // namespace orthonav::tools::disk_space_test
