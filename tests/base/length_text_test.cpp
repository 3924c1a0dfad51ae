#include "base/length_text.h"

#include <gtest/gtest.h>

namespace orthonav {
namespace {

TEST(LengthText, IsInMillimetres) {
  EXPECT_EQ(in_mm(0.0012345), "1.2 mm");
  EXPECT_EQ(in_mm(0.0012345, 3), "1.234 mm");
  EXPECT_EQ(in_mm(-0.25, 0), "-250 mm");
}

}  // namespace
}  // namespace orthonav
