#include "nav/statistics/median.h"

#include <gtest/gtest.h>

namespace orthonav::nav {
namespace {

TEST(Median, IsTheValueInTheMiddle) {
  EXPECT_EQ(median({4.0}), 4.0);
  EXPECT_EQ(median({9.0, -1.0, 2.0}), 2.0);
  EXPECT_EQ(median({1.0, 1.0, 7.0, 7.0, 7.0}), 7.0);
}

TEST(Median, IsTheLargerOfTwoInTheMiddle) {
  EXPECT_EQ(median({3.0, 5.0}), 5.0);
  EXPECT_EQ(median({8.0, 2.0, 6.0, 4.0}), 6.0);
}

}  // namespace
}  // namespace orthonav::nav
