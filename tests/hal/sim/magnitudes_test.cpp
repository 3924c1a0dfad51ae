#include "hal/sim/magnitudes.h"

#include <gmock/gmock.h>

#include <set>

#include "hal/sim/room/instruments.h"

namespace orthonav::sim {
namespace {

using ::testing::HasSubstr;

TEST(Magnitudes, NameEveryNumberOfTheErrorModelOnce) {
  std::set<std::string_view> names;
  std::set<std::size_t> places;
  const ErrorModel model;
  for (const Magnitude& magnitude : magnitudes()) {
    names.insert(magnitude.name);
    places.insert(static_cast<std::size_t>(&(model.*magnitude.value) -
                                           reinterpret_cast<const double*>(&model)));
    EXPECT_FALSE(magnitude.source.empty()) << magnitude.name;
  }
  EXPECT_EQ(names.size(), magnitudes().size());
  EXPECT_EQ(places.size(), sizeof(ErrorModel) / sizeof(double));
}

TEST(Magnitudes, AreByDefaultWhatMayWellBeTrue) {
  const ErrorModel model;
  for (const Magnitude& m : magnitudes()) {
    EXPECT_LE(m.lowest, m.low) << m.name;
    EXPECT_LE(m.low, m.high) << m.name;
    EXPECT_LE(m.high, m.highest) << m.name;
    const double value = model.*m.value;
    const bool off = value == 0.0;  // a breath that a phantom does not take
    EXPECT_TRUE(off || (value >= m.low && value <= m.high)) << m.name << " is " << value;
  }
}

TEST(Magnitudes, AreFoundByTheirNames) {
  ASSERT_NE(magnitude_named("tremor_m"), nullptr);
  EXPECT_EQ(magnitude_named("tremor_m")->unit, "m");
  EXPECT_EQ(magnitude_named("tremor"), nullptr);
}

TEST(Instruments, DecideWhatIsTheirs) {
  ErrorModel model;
  ASSERT_TRUE(use_instrument("cannula", model).ok());
  EXPECT_LT(model.wire_bending_rad, ErrorModel{}.wire_bending_rad);
  EXPECT_EQ(model.hole_following_rad, 0.0);
  EXPECT_EQ(model.tremor_m, ErrorModel{}.tremor_m);
  ASSERT_TRUE(use_instrument("screw", model).ok());
  EXPECT_GT(model.hole_following_rad, 0.0);
  ASSERT_TRUE(use_instrument("robot arm", model).ok());
  EXPECT_EQ(model.tremor_m, 0.0);
  EXPECT_EQ(model.hand_drilling_corrected_rad, 0.0);
}

TEST(Instruments, RefuseAnUnknownOne) {
  ErrorModel model;
  const Status status = use_instrument("spoon", model);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr("instrument 'spoon': unknown (known: wire,"));
}

}  // namespace
}  // namespace orthonav::sim
