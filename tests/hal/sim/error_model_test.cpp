#include "hal/sim/error_model.h"

#include <gmock/gmock.h>

#include <limits>

namespace orthonav::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Magnitudes, DefaultsAndThePerfectWorldAreFine) {
  EXPECT_THAT(Magnitudes{}.check(), IsEmpty());
  EXPECT_THAT(Magnitudes::perfect().check(), IsEmpty());
}

TEST(Magnitudes, NavigationAloneKeepsWhatComesBeforeTheScreen) {
  const Magnitudes documented;
  const Magnitudes alone = Magnitudes::navigation_alone();
  EXPECT_THAT(alone.check(), IsEmpty());
  EXPECT_EQ(alone.wire_bending_rad, 0.0);
  EXPECT_EQ(alone.overlay_perception_m, 0.0);
  EXPECT_EQ(alone.stroke_lift_m, documented.stroke_lift_m);
  EXPECT_EQ(alone.tremor_rad, documented.tremor_rad);
}

TEST(Magnitudes, PerfectWorldHasNoImperfectionLeft) {
  // Each double but the pace, read as memory: a magnitude forgotten in perfect() is found here.
  const Magnitudes none = Magnitudes::perfect();
  static_assert(sizeof(Magnitudes) % sizeof(double) == 0);
  const auto* first = reinterpret_cast<const double*>(&none);
  for (std::size_t i = 0; i < sizeof(Magnitudes) / sizeof(double); ++i) {
    if (first + i == &none.pace) continue;
    EXPECT_EQ(first[i], 0.0) << "number " << i << " of the struct";
  }
}

TEST(Magnitudes, EveryProblemIsNamedAtOnce) {
  Magnitudes wrong;
  wrong.tremor_m = -0.001;
  wrong.pace = 0.0;
  wrong.map_drift_rad_per_sqrt_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(wrong.check(),
              ElementsAre(HasSubstr("map_drift_rad_per_sqrt_s"), HasSubstr("tremor_m is -0.001"),
                          HasSubstr("pace is 0, must lie in [0.1, 10]")));
}

}  // namespace
}  // namespace orthonav::sim
