#include "engine/case/screw_sizes.h"

#include <gmock/gmock.h>

namespace orthonav::engine::screw_sizes_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ScrewSizes, TheBuiltInOnesAreWhole) {
  const ScrewSizes sizes = ScrewSizes::built_in();
  EXPECT_THAT(sizes.check(), IsEmpty());
  EXPECT_EQ(sizes.by_diameter.size(), 8u);
  EXPECT_TRUE(sizes.has(0.0055, 0.045));
  EXPECT_FALSE(sizes.has(0.0080, 0.045)) << "by 1 mm from 7.5 on";
  EXPECT_FALSE(sizes.has(0.0055, 0.065));
}

TEST(ScrewSizes, ALengthCountsToHalfAMillimetre) {
  const ScrewSizes sizes = ScrewSizes::built_in();
  EXPECT_TRUE(sizes.has(0.0055, 0.0454));
  EXPECT_FALSE(sizes.has(0.0055, 0.0456));
  EXPECT_TRUE(sizes.has_length(0.0446));
  EXPECT_FALSE(sizes.has_length(0.0444));
}

TEST(ScrewSizes, TheNextOneIsThatOfTheListOrNone) {
  const ScrewSizes sizes = ScrewSizes::built_in();
  EXPECT_EQ(sizes.next_diameter_m(0.0075, true), 0.0085);
  EXPECT_EQ(sizes.next_diameter_m(0.0085, true), std::nullopt);
  EXPECT_EQ(sizes.next_diameter_m(0.0052, false), 0.0050) << "from between two";
  EXPECT_EQ(sizes.next_length_m(0.006, 0.0425, true), 0.045);
  EXPECT_EQ(sizes.next_length_m(0.006, 0.0425, false), 0.040);
  EXPECT_EQ(sizes.next_length_m(0.006, 0.025, false), std::nullopt);
  EXPECT_EQ(sizes.next_length_m(0.0, 0.040, true), 0.045) << "no diameter stated";
}

TEST(ScrewSizes, EveryProblemIsToldAtOnce) {
  EXPECT_THAT(ScrewSizes{}.check(), ElementsAre(HasSubstr("no screw")));
  const ScrewSizes bad{{{0.006, {0.045, 0.040}, {}}, {0.006, {}, {}}, {0.020, {0.005}, 0.1}}};
  EXPECT_THAT(bad.check(), ElementsAre(HasSubstr("length 40.0 mm"), HasSubstr("has no length"),
                                       HasSubstr("thicker than"), HasSubstr("[2, 12] mm"),
                                       HasSubstr("[10, 120] mm"), HasSubstr("seat")));
}

}  // namespace
}  // namespace orthonav::engine::screw_sizes_test
