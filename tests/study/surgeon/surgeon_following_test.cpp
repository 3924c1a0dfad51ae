// The surgeon's behaviour with holograms that are off.
#include <gmock/gmock.h>

#include <atomic>
#include <numbers>
#include <thread>

#include "hal/sim/room/bone_surface.h"
#include "study/surgeon/written_frame.h"
#include "tests/study/surgeon/fake_engine.h"

namespace orthonav::sim::surgeon_following_test {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
/// Without errors the last correction is exact: rounding alone is left of the angle. The tip's way
/// on a bone of facets leaves 0.7 µm of the entry; three times that.
constexpr double kObeyedAngle_rad = 1e-6 * kDeg;
constexpr double kObeyedEntry_m = 2e-6;

/// A screw as the holograms show it, where its axis enters the bone.
struct ShownScrew {
  Vec3 entry;
  Vec3 inwards;
};

ShownScrew shown(const FakeEngine& engine, const BoneSurface& bone, const TestScrew& screw) {
  const auto vertebra_from_shown = engine.vertebra_from_shown(screw.level);
  const Vec3 entry = (vertebra_from_shown * screw.entry).v;
  const Vec3 inwards = ((vertebra_from_shown * screw.target).v - entry).normalized();
  const auto hit = bone.first_hit(entry - 0.02 * inwards, inwards, 0.04);
  EXPECT_TRUE(hit.has_value());
  return {hit ? hit->point : Vec3{}, inwards};
}

struct OffBy {
  Vec3 translation_m;
  Vec3 rotation_rad;
  double least_entry_m;    ///< by which every wire misses its plan
  double least_angle_rad;  ///< likewise; a turn tilts what is not parallel to it
};

/// Compared with the holograms and, as the control, with the plan.
void expect_followed(const FakeEngine& engine, const TestCase& test_case, const Truth& truth,
                     const OffBy& off) {
  ASSERT_EQ(truth.wires.size(), test_case.screws.size());
  for (std::size_t i = 0; i < truth.wires.size(); ++i) {
    const DrivenWire& wire = truth.wires[i];
    const TestScrew& screw = test_case.screws[i];
    ASSERT_EQ(wire.level, screw.level);
    ASSERT_EQ(wire.side, screw.side);
    const ShownScrew expected = shown(engine, BoneSurface(test_case.room.levels[i / 2]), screw);
    EXPECT_LT(angle_between_rad(wire.direction, expected.inwards), kObeyedAngle_rad) << i;
    EXPECT_LT((wire.entry.v - expected.entry).norm(), kObeyedEntry_m) << i;
    EXPECT_GE(angle_between_rad(wire.direction, screw.target - screw.entry), off.least_angle_rad);
    EXPECT_GE((wire.entry - screw.entry).norm(), off.least_entry_m) << i;
  }
}

TEST(Surgeon, FollowsTheHologramsAndNotThePlan) {
  const TestCase test_case = synthetic_case();
  for (const OffBy& off :
       {OffBy{{0.0, 0.0, 0.002}, {}, 0.0019, 0.0},
        OffBy{{}, {0.0, 0.0, 3.0 * kDeg}, 0.0015, 2.9 * kDeg},
        OffBy{{}, {-3.0 * kDeg, 0.0, 0.0}, 0.0012, 2.6 * kDeg},
        OffBy{{0.001, 0.0, -0.001}, {0.0, 2.0 * kDeg, 0.0}, 0.0009, 0.9 * kDeg}}) {
    auto headset = SimHeadset::open(test_case.room, without_pixels(2, ErrorModel::perfect()));
    ASSERT_TRUE(headset.ok()) << headset.error().message;
    EngineOptions options;
    options.registration_error_m = off.translation_m;
    options.registration_rotation_rad = off.rotation_rad;
    FakeEngine engine(**headset, test_case, options);
    ASSERT_GT(engine.run(), 0);
    expect_followed(engine, test_case, (*headset)->truth(), off);
  }
}

std::vector<std::string> history_with_model_off(Vec3 off_m, const ErrorModel& error_model,
                                                std::size_t& wires) {
  const TestCase test_case = synthetic_case();
  auto headset = SimHeadset::open(test_case.room, without_pixels(3, error_model));
  EXPECT_TRUE(headset.ok());
  EngineOptions options;
  options.registration_error_m = off_m;
  FakeEngine engine(**headset, test_case, options);
  EXPECT_GT(engine.run(), 0);
  wires = (*headset)->truth().wires.size();
  return engine.history();
}

const std::vector<std::string> kRejectedThreeTimes = {"setup",       "digitize L4", "verify L4",
                                                      "digitize L4", "verify L4",   "digitize L4",
                                                      "verify L4",   "digitize L4"};

TEST(Surgeon, RejectsAModelThatIsNotWhereTheBoneIs) {
  // 15 mm, 2.5 times the limit: whatever the surgeon's errors, no bone is drilled.
  std::size_t wires = 0;
  EXPECT_EQ(history_with_model_off({0.015, 0.0, 0.0}, {}, wires), kRejectedThreeTimes);
  EXPECT_EQ(wires, 0U);
}

/// Holograms farther than this from the bone are rejected (`kAcceptedOverlay_m` of surgeon.cpp);
/// without errors of the eye, a tenth of a millimetre on either side decides.
constexpr double kAcceptedOverlay_m = 0.006;
constexpr double kJust_m = 0.0001;

TEST(Surgeon, RejectsJustBeyondTheLimitAndAcceptsJustWithin) {
  for (const Vec3 way : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0.6, 0.8}}) {
    std::size_t wires = 0;
    const auto within =
        history_with_model_off((kAcceptedOverlay_m - kJust_m) * way, ErrorModel::perfect(), wires);
    ASSERT_GE(within.size(), 4U);
    EXPECT_EQ(within[3], "landmark L4") << way.x << " " << way.y << " " << way.z;
    EXPECT_EQ(within.back(), "done");
    EXPECT_EQ(wires, 4U);
    EXPECT_EQ(
        history_with_model_off((kAcceptedOverlay_m + kJust_m) * way, ErrorModel::perfect(), wires),
        kRejectedThreeTimes);
    EXPECT_EQ(wires, 0U);
  }
}

TEST(SimHeadset, PartsMayBeUsedFromDifferentThreadsFromDifferentThreads) {
  // Nothing to compare: the thread sanitizer would find a race.
  const SimOptions options = without_pixels(1);
  const TestCase test_case = synthetic_case();
  const auto headset = SimHeadset::open(test_case.room, options).value();
  std::atomic<bool> running{true};
  std::thread other([&headset, &running] {
    std::vector<ClickerEvent> clicks;
    std::vector<Phrase> phrases;
    while (running) {
      const Timestamp now = headset->clock().now();
      EXPECT_TRUE(headset->clicker().poll(now, clicks).ok());
      EXPECT_TRUE(headset->voice().poll(now, phrases).ok());
      static_cast<void>(headset->head().world_from_rig(now));
      ShownFrame shown;
      shown.display_time = now + headset->display_latency();
      shown.status = ShownStatus{.at = {Step::kDigitize, "L4", {}}};
      // Not seen while no new frame has moved the clock.
      headset->wearer()->see(written(shown));
      static_cast<void>(headset->state());
      static_cast<void>(headset->world_from_room());
    }
  });
  for (int i = 0; i < 600; ++i) {
    StereoFrame frame;
    EXPECT_TRUE(headset->cameras()->next(frame).ok());
  }
  running = false;
  other.join();
}

}  // namespace
}  // namespace orthonav::sim::surgeon_following_test
