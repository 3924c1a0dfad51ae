#include <gtest/gtest.h>

#include <vector>

#include "engine/case/operation_plan.h"
#include "engine/phantom/phantom.h"
#include "hal/fake/scripted.h"
#include "tests/soak/flaky_headset.h"
#include "tests/soak/memory_curve.h"
#include "tests/soak/soak_operation.h"
#include "tests/support/scripted_pairs.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::soak {
namespace {

TEST(MemoryCurve, TellsALeakFromNoiseAndFromOneLargeOperation) {
  std::vector<double> level;
  std::vector<double> leaks;
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    level.push_back(100'000.0 + random.uniform(-800.0, 800.0) + (i == 40 ? 50'000.0 : 0.0));
    leaks.push_back(level.back() + 100.0 * i);
  }
  EXPECT_NEAR(growth_kib(level), 0.0, 15.0);
  EXPECT_NEAR(growth_kib(leaks), 100.0, 15.0);
  EXPECT_EQ(growth_kib({1.0}), 0.0);
}

TEST(MemoryCurve, GrowsByWhatIsKept) {
  const std::int64_t before = resident_kib();
  const std::vector<char> kept(std::size_t{64} << 20U, 'x');
  EXPECT_NEAR(static_cast<double>(resident_kib() - before), 65'536.0, 4'096.0) << kept.back();
}

TEST(FlakyHeadset, CountsAFrameWhoseGuidanceIsTooOld) {
  fake::FakeHeadset inner(test::pairs(1));
  FlakyHeadset flaky(inner, Random(1), {0.0, 0.0, 0.0});
  ShownFrame frame;
  ShownHologram triangle;
  triangle.kind = HologramKind::kTriangle;
  frame.holograms = {triangle};
  frame.pose_time = Timestamp(std::chrono::seconds(1));
  frame.display_time = frame.pose_time + std::chrono::milliseconds(100);
  ASSERT_TRUE(flaky.display().shown(frame).ok());
  EXPECT_EQ(flaky.stale_frames(), 0);
  frame.display_time += Duration(1);
  ASSERT_TRUE(flaky.display().shown(frame).ok());
  EXPECT_EQ(flaky.stale_frames(), 1);
}

TEST(FlakyHeadset, MovesTheMapForTheEngineAndBackForTheWearer) {
  fake::FakeHeadset inner(test::pairs(2));
  FlakyHeadset flaky(inner, Random(1), {0.0, 1.0, 0.0});
  StereoFrame frame;
  frame.map_epoch = 7;  // of whatever was in the buffer before
  ASSERT_EQ(*flaky.cameras().next(frame), Next::kFrame);
  EXPECT_EQ(frame.map_epoch, 1);
  const auto inner_from_flaky = frame.world_from_rig->inverse();
  ShownFrame shown;
  ShownHologram path;
  path.points_in_world = {*frame.world_from_rig * Point<Rig>{{0.1, 0.2, 0.3}}};
  shown.holograms = {path};
  ASSERT_TRUE(flaky.display().shown(shown).ok());
  const auto seen = inner.display().frames().at(0).holograms.at(0).points_in_world.at(0);
  const auto rig = inner_from_flaky * path.points_in_world[0];
  EXPECT_LT((seen.v - rig.v).norm(), 1e-9) << "the rig stands at the origin of the scripted world";
}

TEST(SoakOperation, GoesThroughItsTroubles) {
  const engine::Case source = engine::phantom();
  engine::ModelCache models;
  const auto planned = engine::plan_operation(source, {"L5"}, models);
  ASSERT_TRUE(planned.ok());
  const test::TemporaryFolder folder;
  const SoakRow row = soak_operation(source, *planned, 1, folder.path().string());
  EXPECT_EQ(row.trouble, "");
  EXPECT_TRUE(row.completed);
  EXPECT_EQ(row.screws, 2);
  EXPECT_EQ(row.stale, 0);
  EXPECT_EQ(row.lost, 0);
  EXPECT_GT(row.troubles[0] + row.troubles[1] + row.troubles[2] + row.troubles[3], 0);
}

}  // namespace
}  // namespace orthonav::soak
