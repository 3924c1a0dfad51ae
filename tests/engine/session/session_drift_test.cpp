#include <gmock/gmock.h>

#include <cmath>

#include "engine/session/operation_state.h"
#include "engine/session/session.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_drift_test {
namespace {

using test::guide_at;
using test::said;
using test::ScriptedOperation;
using ::testing::HasSubstr;
using ::testing::Not;

// Arithmetic on values of the order of 1.
constexpr double kExact = 1e-9;
/// Within a pair or two of the limit.
constexpr double kPairs_s = 0.1;
constexpr double kDrift = 0.0005;  // m/sqrt(s): seconds instead of minutes
/// After this time the map may have drifted by the limit.
const double kLongest_s = std::pow(kMaxWalked_m / kDrift, 2);
const Vec3 kAway{0.0, 0.15, 0.0};

SessionOptions drifting() {
  SessionOptions options = test::three_places();
  options.map_drift_m_per_sqrt_s = kDrift;
  return options;
}

/// On a map that drifts, while the first screw is guided; the guide is not at the bone.
class DriftingMap : public ::testing::Test {
 protected:
  explicit DriftingMap(bool reference = false, const SessionOptions& options = drifting())
      : s({"L4"}, options, Verification::kByTouch, false, reference) {
    s.registers_within(0.0003);
    s.accepts_first_by_touch();
    s.tracker().guide = guide_at(kAway, 0.0);
    s.touches_landmark();
    s.says("next");
  }
  /// Runs pairs until the bone was last found this long ago, or guidance ends.
  void waits_s(double since_s) {
    while (s.session().current_step() == Step::kGuide &&
           seconds(s.now() - found().time) < since_s) {
      s.pair();
    }
  }
  const BoneFound& found() { return *s.session().levels()[0].bone_found; }
  ScriptedOperation s;
};

TEST_F(DriftingMap, BeforeADrillIsSetAsksForTheLandmarkAgain) {
  waits_s(kLongest_s - kPairs_s);
  ASSERT_EQ(s.session().current_step(), Step::kGuide);
  waits_s(kLongest_s + kPairs_s);
  ASSERT_EQ(s.session().current_step(), Step::kTouchLandmark);
  const Guidance& g = s.pair();
  EXPECT_FALSE(g.tool) << "nothing is guided";
  ASSERT_NE(said<BoneUnchecked>(g), nullptr);
  EXPECT_NEAR(said<BoneUnchecked>(g)->for_s, kLongest_s, kPairs_s);
  EXPECT_NEAR(said<BoneUnchecked>(g)->drift_m, 2.0 * kMaxWalked_m, 5e-5);
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kTouchMore);
  EXPECT_EQ(s.says("next").step, Step::kTouchLandmark) << "not without it";
  s.touches_landmark();
  EXPECT_EQ(s.says("next").step, Step::kGuide);
  EXPECT_LT(seconds(s.now() - found().time), 1.0) << "it counts anew";
}

TEST_F(DriftingMap, OnceTheDrillIsSetGuidesOnAndSaysHowUnsureItIs) {
  s.tracker().guide = guide_at({0.015, 0.020, 0.0}, 0.0);
  s.says("drill");
  const auto sd_now = [this] { return s.pair().tool->numbers->tip_cranial.sd_tenths.value(); };
  const int before = sd_now();
  waits_s(4.0 * kLongest_s);
  EXPECT_EQ(s.session().current_step(), Step::kGuide);
  EXPECT_GE(sd_now(), before + 5) << "tenths of a millimetre";
  const auto tool = s.pair().tool;
  EXPECT_FALSE(tool->numbers->tip_cranial.sure);
  ASSERT_TRUE(tool->depth);
  EXPECT_EQ(tool->depth->certainty, nav::Certainty::kBound) << "the depth drifts as well";
}

class OnReference : public DriftingMap {
 protected:
  OnReference() : DriftingMap(true, test::three_places()) {}
};

TEST_F(OnReference, NothingDriftsAndNothingIsAskedAgain) {
  waits_s(4.0 * kLongest_s);
  EXPECT_EQ(s.session().current_step(), Step::kGuide);
  EXPECT_EQ(found().sd_at_m(s.now()), 0.0);
}

TEST(BoneFound, WalksWithTheRootOfTime) {
  const BoneFound found{Timestamp{} + from_seconds(10.0), 0.0003, 0.0002};
  EXPECT_NEAR(found.drift_sd_m(Timestamp{} + from_seconds(14.0)), 0.0004, kExact);
  EXPECT_NEAR(found.sd_at_m(Timestamp{} + from_seconds(14.0)), 0.0005, kExact);
  EXPECT_NEAR(found.drift_sd_m(Timestamp{}), 0.0, kExact) << "nothing before it";
}

TEST(BoneFound, RecordingTheLandmarkTellsNothingAndFindingItDoes) {
  const Timestamp later = Timestamp{} + from_seconds(100.0);
  const BoneFound accepted{Timestamp{}, 0.0, 0.0002};
  LandmarkTouch touch{true, 0, 0.0, 0.0014, 0.0004};
  Landmark landmark;
  const BoneFound recorded = found_by_landmark(accepted, touch, landmark, later);
  EXPECT_NEAR(recorded.sd_m, 0.002, kExact);
  EXPECT_EQ(recorded.time, later);
  // Recorded soon after acceptance, and found 0.9 mm off a minute later.
  landmark.bone_sd_m = 0.0003;
  touch = {false, 0, 0.0009, 0.0014, 0.0004};
  const BoneFound again = found_by_landmark(recorded, touch, landmark, later + from_seconds(60.0));
  EXPECT_NEAR(again.sd_m, std::hypot(0.0003, 0.0009 / std::sqrt(3.0), 0.0004), kExact);
  // Never less precise than before: just after acceptance the drift is more precise than the
  // touches.
  const BoneFound soon =
      found_by_landmark(accepted, touch, landmark, Timestamp{} + from_seconds(1.0));
  EXPECT_NEAR(soon.sd_m, 0.0002, kExact);
}

}  // namespace
}  // namespace orthonav::engine::session_drift_test
