#include "nav/registration/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orthonav::nav {
namespace {

using Kind = RefusalReason::Kind;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Nothing speaks against it.
Registration good(double standoff_m, double noise_m) {
  Registration r;
  r.standoff_m = standoff_m;
  r.noise_m = noise_m;
  r.inlier_fraction = 1.0;
  r.coverage_fraction = 0.5;
  r.log_likelihood_ratio = 100.0;
  r.predicted_tre_m = 0.0005;
  r.tre_99_m = 0.001;
  r.uncertainty = PoseUncertainty();
  return r;
}

std::vector<Kind> kinds_against(const Registration& r) {
  std::vector<Kind> kinds;
  for (const RefusalReason& reason : reasons_against(r, {})) {
    kinds.push_back(reason.kind);
  }
  return kinds;
}

TEST(Verdict, ScatterHighAboveTheBoneIsTissue) {
  EXPECT_THAT(kinds_against(good(0.0, 0.0015)), IsEmpty());
  EXPECT_THAT(kinds_against(good(0.0015, 0.0015)), IsEmpty());
  EXPECT_THAT(kinds_against(good(0.002, 0.00125)), IsEmpty());
  EXPECT_THAT(kinds_against(good(0.002, 0.00135)), ElementsAre(Kind::kSoftTissue));
  EXPECT_THAT(kinds_against(good(0.003, 0.00095)), IsEmpty());
  EXPECT_THAT(kinds_against(good(0.003, 0.00105)), ElementsAre(Kind::kSoftTissue));
}

TEST(Verdict, ScatterHighAboveTheBoneAsksForPressedPlaces) {
  Registration r = good(0.003, 0.00105);
  r.reasons = reasons_against(r, {});
  ASSERT_EQ(r.reasons.size(), 1u);
  EXPECT_DOUBLE_EQ(r.reasons[0].value, 0.00105);
  EXPECT_DOUBLE_EQ(r.reasons[0].limit, 0.001);
  EXPECT_TRUE(is_provisional(r));
}

TEST(Verdict, ScatterBeyondAnyHandIsNoise) {
  EXPECT_THAT(kinds_against(good(0.0, 0.0017)), ElementsAre(Kind::kNoise));
  EXPECT_THAT(kinds_against(good(0.003, 0.0017)), ElementsAre(Kind::kNoise));
}

}  // namespace
}  // namespace orthonav::nav
