// The truth does not leak: when holograms are off, every wire is off with them, whatever guidance
// the surgeon uses. A surgeon who sees the truth is detected.
#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>

#include "tests/study/surgeon/fake_engine.h"

namespace orthonav::sim::leak_test {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr double kOff_m = 0.003;
constexpr double kRotation_rad = 3.0 * kDeg;
/// The numbers of a closed loop are rounded up to tenths, and a tip within 0.4 mm is left.
constexpr double kFollowed_m = 0.0008;
constexpr double kFollowed_rad = 0.3 * kDeg;

struct Misses {
  double from_shown_m = 0.0;
  double from_shown_rad = 0.0;
};

/// The largest distance of the wires from the shown holograms.
Misses of_holograms(GuidanceProfile guidance, bool peeks) {
  const TestCase test_case = synthetic_case();
  SimOptions options = without_pixels(4, ErrorModel::perfect());
  options.guidance = guidance;
  auto headset = SimHeadset::open(test_case.room, options);
  EngineOptions wrong;
  wrong.registration_error_m = {0.0, 0.0, kOff_m};
  wrong.registration_rotation_rad = {0.0, 0.0, kRotation_rad};
  wrong.peeks = peeks;
  FakeEngine engine(**headset, test_case, wrong);
  EXPECT_GT(engine.run(), 0);
  const Truth& truth = (*headset)->truth();
  EXPECT_EQ(truth.wires.size(), test_case.screws.size());
  Misses worst;
  for (std::size_t i = 0; i < truth.wires.size(); ++i) {
    const TestScrew& screw = test_case.screws[i];
    const auto shown = engine.vertebra_from_shown(screw.level);
    const Vec3 inwards = (shown * screw.target - shown * screw.entry).normalized();
    const Vec3 off = truth.wires[i].entry - shown * screw.entry;
    worst.from_shown_m = std::max(worst.from_shown_m, off.cross(inwards).norm());
    worst.from_shown_rad =
        std::max(worst.from_shown_rad, angle_between_rad(inwards, truth.wires[i].direction));
  }
  return worst;
}

bool follows(const Misses& misses) {
  return misses.from_shown_m < kFollowed_m && misses.from_shown_rad < kFollowed_rad;
}

TEST(Leak, NoGuidanceProfileKnowsMoreThanTheHologramsShow) {
  for (const auto guidance :
       {GuidanceProfile::kOverlay, GuidanceProfile::kNumbers, GuidanceProfile::kClosedLoop}) {
    const Misses misses = of_holograms(guidance, false);
    EXPECT_TRUE(follows(misses)) << static_cast<int>(guidance) << ": " << misses.from_shown_m
                                 << " m, " << misses.from_shown_rad << " rad";
  }
}

TEST(Leak, ASurgeonWhoPeeksIsCaughtInEveryProfile) {
  for (const auto guidance :
       {GuidanceProfile::kOverlay, GuidanceProfile::kNumbers, GuidanceProfile::kClosedLoop}) {
    EXPECT_FALSE(follows(of_holograms(guidance, true))) << static_cast<int>(guidance);
  }
}

}  // namespace
}  // namespace orthonav::sim::leak_test
