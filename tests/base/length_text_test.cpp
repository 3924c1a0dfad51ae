#include "base/length_text.h"

#include <gtest/gtest.h>

namespace orthonav {
namespace {

TEST(LengthText, IsInMillimetres) {
  EXPECT_EQ(in_mm(0.0012345), "1.2 mm");
  EXPECT_EQ(in_mm(0.0012345, 3), "1.234 mm");
  EXPECT_EQ(in_mm(-0.25, 0), "-250 mm");
  EXPECT_EQ(in_mm(-1e-9), "0.0 mm");
  EXPECT_EQ(in_mm_outside(0.15004, 0.005, 0.150, 0), "150.04 mm");
  EXPECT_EQ(in_mm_outside(0.00499, 0.005, 0.150), "4.99 mm");
}

}  // namespace
}  // namespace orthonav
