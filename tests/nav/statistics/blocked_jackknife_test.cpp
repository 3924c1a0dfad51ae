#include "nav/statistics/blocked_jackknife.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orthonav::nav {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(WithoutBlock, LeavesOutAStretch) {
  EXPECT_THAT(without_block(20, 0),
              ElementsAre(2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19));
  EXPECT_THAT(without_block(12, 9), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
  EXPECT_THAT(without_block(0, 3), IsEmpty());
}

TEST(WithoutBlock, LeavesOutEveryIndexOnce) {
  for (std::size_t count = 1; count < 130; ++count) {
    std::vector<std::size_t> kept(count, 0);
    for (std::size_t block = 0; block < kJackknifeBlocks; ++block) {
      for (const std::size_t i : without_block(count, block)) {
        ++kept[i];
      }
    }
    for (const std::size_t times : kept) {
      EXPECT_EQ(times, kJackknifeBlocks - 1) << count;
    }
  }
}

}  // namespace
}  // namespace orthonav::nav
