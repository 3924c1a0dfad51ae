#include <gtest/gtest.h>

#include <vector>

#include "engine/case/operation_plan.h"
#include "engine/phantom/phantom.h"
#include "engine/session/log/observer_list.h"
#include "hal/fake/scripted.h"
#include "study/surgeon/written_frame.h"
#include "tests/soak/flaky_headset.h"
#include "tests/soak/memory_curve.h"
#include "tests/soak/memory_picture.h"
#include "tests/soak/soak_operation.h"
#include "tests/support/resumed_operation.h"
#include "tests/support/scripted_pairs.h"
#include "tests/support/scripted_surgeon.h"
#include "tests/support/telling_headset.h"
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

TEST(FlakyHeadset, PassesOnWhatItsDeviceTells) {
  test::TellingHeadset device;
  FlakyHeadset flaky(device, Random(1), {});
  test::expect_passed_on(device, flaky, false);
}

TEST(FlakyHeadset, CountsAFrameWhoseGuidanceIsTooOld) {
  test::TellingHeadset inner;
  FlakyHeadset flaky(inner, Random(1), {0.0, 0.0, 0.0});
  engine::ShownFrame frame;
  engine::ShownHologram triangle;
  triangle.kind = engine::HologramKind::kTriangle;
  frame.holograms = {triangle};
  frame.pose_time = Timestamp(std::chrono::seconds(1));
  frame.display_time = frame.pose_time + std::chrono::milliseconds(100);
  flaky.wearer()->see(sim::written(frame));
  EXPECT_EQ(flaky.stale_frames(), 0);
  frame.display_time += Duration(1);
  flaky.wearer()->see(sim::written(frame));
  EXPECT_EQ(flaky.stale_frames(), 1);
}

TEST(FlakyHeadset, MovesTheMapForTheEngineAndBackForTheWearer) {
  test::TellingHeadset inner(test::pairs(2));
  FlakyHeadset flaky(inner, Random(1), {0.0, 1.0, 0.0});
  StereoFrame frame;
  frame.map_epoch = 7;  // of whatever was in the buffer before
  ASSERT_EQ(*flaky.cameras()->next(frame), Next::kFrame);
  EXPECT_EQ(frame.map_epoch, 1);
  const auto inner_from_flaky = frame.world_from_rig->inverse();
  engine::ShownFrame shown;
  engine::ShownHologram path;
  path.points_in_world = {*frame.world_from_rig * Point<Rig>{{0.1, 0.2, 0.3}}};
  shown.holograms = {path};
  flaky.wearer()->see(sim::written(shown));
  const auto seen = sim::shown_in(inner.seen().at(0)).value().holograms.at(0).points_in_world.at(0);
  const auto rig = inner_from_flaky * path.points_in_world[0];
  EXPECT_LT((seen.v - rig.v).norm(), 1e-9) << "the rig stands at the origin of the scripted world";
}

/// A scripted operation to its end: what was told of it, and its log.
struct ToldAndKept {
  ToldAndKept() {
    test::MemoryEnv env;
    auto s = test::touched_operation(true);
    auto log = test::log_of(*s, env, true);
    engine::ObserverList both({&told, log.get()});
    s->session().observe(&both);
    test::ScriptedSurgeon(*s).finish();
    EXPECT_TRUE(log->finish(true, "").ok());
    records = engine::read_log(env, test::kLogPath).value().records;
  }
  [[nodiscard]] std::size_t first(engine::OperationRecord type) const {
    std::size_t i = 0;
    while (records[i].type != static_cast<std::uint16_t>(type)) {
      ++i;
    }
    return i;
  }
  [[nodiscard]] Differences found() const { return differences(told.all(), kept_events(records)); }
  ToldEvents told;
  std::vector<engine::Record> records;
};

TEST(KeptEvents, OfAWholeLogAreThoseThatWereTold) {
  const ToldAndKept whole;
  const Differences found = whole.found();
  EXPECT_EQ(found.lost, Counts{});
  EXPECT_EQ(found.lost_samples, 0);
  EXPECT_EQ(found.doubled, 0);
  EXPECT_EQ(screws_done_twice(whole.records), 0);
  for (const std::int64_t count : counts_of(kept_events(whole.records))) {
    EXPECT_GT(count, 1) << "of every kind";
  }
}

TEST(KeptEvents, TellALostRegionWithItsSamplesAndADoubledScrew) {
  ToldAndKept damaged;
  damaged.records.erase(damaged.records.begin() + static_cast<std::ptrdiff_t>(damaged.first(
                                                      engine::OperationRecord::kRegion)));
  damaged.records.push_back(damaged.records[damaged.first(engine::OperationRecord::kScrew)]);
  const Differences found = damaged.found();
  EXPECT_EQ(found.lost[static_cast<std::size_t>(Kind::kRegion)], 1);
  EXPECT_EQ(found.lost_samples, 5);
  EXPECT_EQ(found.doubled, 1);
  EXPECT_EQ(screws_done_twice(damaged.records), 1);
}

TEST(KeptEvents, TellASampleThatLiesElsewhere) {
  ToldAndKept damaged;
  std::string& region = damaged.records[damaged.first(engine::OperationRecord::kRegion)].payload;
  const std::string tips = "\"tips_in_world_m\":[";
  const std::size_t at = region.find(tips);
  ASSERT_NE(at, std::string::npos);
  region.replace(at, tips.size(), tips + "1");
  EXPECT_EQ(damaged.found().lost_samples, 5) << "with the whole region";
  EXPECT_EQ(damaged.found().doubled, 1) << "one that nobody stroked";
}

TEST(MemoryPicture, HasAPointForEachOperation) {
  const std::string svg = memory_picture(std::vector<double>(20, 65'000.0), 8, 0.0);
  std::size_t points = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1)) {
    ++points;
  }
  EXPECT_EQ(points, 20u);
  EXPECT_NE(svg.find("+0.0 KiB an operation"), std::string::npos);
}

TEST(SoakOperation, GoesThroughItsTroubles) {
  const engine::Case source = engine::phantom();
  const auto planned = engine::plan_operation(source, {"L5"});
  ASSERT_TRUE(planned.ok());
  const test::TemporaryFolder folder;
  const SoakRow row = soak_operation(source, *planned, 1, folder.path().string());
  EXPECT_EQ(row.trouble, "");
  EXPECT_TRUE(row.completed);
  EXPECT_EQ(row.kept[static_cast<std::size_t>(Kind::kScrew)], 2);
  EXPECT_EQ(row.stale, 0);
  EXPECT_EQ(row.lost, Counts{});
  EXPECT_EQ(row.lost_samples, 0);
  EXPECT_EQ(row.doubled, 0);
  EXPECT_EQ(row.twice, 0);
  EXPECT_GT(row.samples, 500);
  EXPECT_GT(row.troubles[0] + row.troubles[1] + row.troubles[2] + row.troubles[3], 0);
}

}  // namespace
}  // namespace orthonav::soak
