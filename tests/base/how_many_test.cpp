#include "base/how_many.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace orthonav {
namespace {

TEST(HowMany, HasThePluralOfEveryCountButOne) {
  EXPECT_EQ(how_many(0, "bend"), "0 bends");
  EXPECT_EQ(how_many(1, "bend"), "1 bend");
  EXPECT_EQ(how_many(std::size_t{2}, "stereo pair"), "2 stereo pairs");
  EXPECT_EQ(how_many(-1, "frame"), "-1 frames");
}

}  // namespace
}  // namespace orthonav
