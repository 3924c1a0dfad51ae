#include "hal/sim/error_model.h"

#include <gmock/gmock.h>

#include <limits>

namespace orthonav::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ErrorModel, DefaultsAndThePerfectWorldAreFine) {
  EXPECT_THAT(ErrorModel{}.check(), IsEmpty());
  EXPECT_THAT(ErrorModel::perfect().check(), IsEmpty());
}

TEST(ErrorModel, NavigationAloneKeepsWhatComesBeforeTheScreen) {
  const ErrorModel documented;
  const ErrorModel alone = ErrorModel::navigation_alone();
  EXPECT_THAT(alone.check(), IsEmpty());
  EXPECT_EQ(alone.wire_bending_rad, 0.0);
  EXPECT_EQ(alone.overlay_perception_m, 0.0);
  EXPECT_EQ(alone.stroke_lift_m, documented.stroke_lift_m);
  EXPECT_EQ(alone.tremor_rad, documented.tremor_rad);
}

TEST(ErrorModel, PerfectWorldHasNoImperfectionLeft) {
  // Each double but the pace, read as memory: a magnitude forgotten in perfect() is found here.
  const ErrorModel none = ErrorModel::perfect();
  static_assert(sizeof(ErrorModel) % sizeof(double) == 0);
  const auto* first = reinterpret_cast<const double*>(&none);
  for (std::size_t i = 0; i < sizeof(ErrorModel) / sizeof(double); ++i) {
    if (first + i == &none.pace) {
      continue;
    }
    EXPECT_EQ(first[i], 0.0) << "number " << i << " of the struct";
  }
}

TEST(ErrorModel, EveryProblemIsNamedAtOnce) {
  ErrorModel wrong;
  wrong.tremor_m = -0.001;
  wrong.pace = 0.0;
  wrong.map_drift_rad_per_sqrt_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(wrong.check(),
              ElementsAre(HasSubstr("map_drift_rad_per_sqrt_s"), HasSubstr("tremor_m is -0.001"),
                          HasSubstr("pace is 0, must lie in [0.1, 10]")));
}

}  // namespace
}  // namespace orthonav::sim
