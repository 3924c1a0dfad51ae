#include <gmock/gmock.h>

#include "tests/engine/live/watched_loop.h"
#include "tests/support/scripted_pairs.h"

namespace orthonav::engine::watchdog_test {
namespace {

using test::kPair;
using test::kStart;
using test::pairs;
using test::wait_until;

TEST_F(WatchedLoop, ACameraThatHangsIsNamedByTheDrawer) {
  fake::FakeHeadset inner(pairs(3));
  EventfulHeadset headset(inner, {1, [&] { hang_until_drawn(inner, Part::kCamera); }});
  const auto report = run(headset);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.stalls, 1);
  EXPECT_TRUE(shows_triangle(seen.frames().at(2))) << "and it goes on with the next";
}

TEST_F(WatchedLoop, AWarningThatCannotBeDrawnIsCounted) {
  fake::FakeHeadset inner(pairs(3));
  sink.warns = false;
  EventfulHeadset headset(inner, {1, [&] { hang_until_drawn(inner, Part::kCamera); }});
  const auto report = run(headset);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.draw_failures, 1);
  EXPECT_EQ(report.last_failure, "no warnings");
}

TEST_F(WatchedLoop, ATrackerThatHangsIsNamedByTheDrawer) {
  fake::FakeHeadset inner(pairs(3));
  std::atomic<int> steps = 0;
  Stepped slow([&](const Guidance&) {
    if (steps++ == 1) {
      hang_until_drawn(inner, Part::kTracker);
    }
  });
  const auto report = run(inner, &slow);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.stalls, 1);
}

TEST_F(WatchedLoop, AVoiceThatHangsInItsPollIsNamedByTheDrawer) {
  fake::FakeHeadset inner(pairs(3));
  EventfulHeadset headset(inner, {}, [&, polls = 0](Timestamp) mutable {
    if (polls++ == 1) {
      hang_until_drawn(inner, Part::kVoice);
    }
    return Status{};
  });
  ASSERT_TRUE(run(headset).ended.ok());
}

TEST_F(WatchedLoop, AVoiceThatSaysItStalledHidesGuidanceAndEndsNothing) {
  constexpr int kPairs = 60;
  fake::FakeHeadset inner(pairs(kPairs));
  // Far longer than other failures may last.
  EventfulHeadset headset(inner, {}, [](Timestamp until) {
    return until < kStart + 50 * kPair ? Status(Error{"voice", ErrorCode::kUnavailable}) : Status{};
  });
  std::vector<std::optional<Part>> stalled;
  Stepped see([&](const Guidance& guidance) { stalled.push_back(guidance.status.stalled); });
  const auto report = run(headset, &see);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.stalls, 1);
  const auto frames = seen.frames();
  ASSERT_EQ(frames.size(), kPairs + 1u);
  ASSERT_EQ(stalled.size(), static_cast<std::size_t>(kPairs));
  EXPECT_TRUE(frames[10].holograms.empty());
  EXPECT_EQ(stalled[10], Part::kVoice);
  EXPECT_TRUE(shows_triangle(frames[55]));
  EXPECT_EQ(stalled[55], std::nullopt);
}

TEST_F(WatchedLoop, ARendererThatHangsIsNamedByTheTracker) {
  fake::FakeHeadset headset(pairs(40));
  sink.hangs_at = 0;
  std::int64_t pair = 0;
  std::int64_t named = 0;
  std::optional<std::size_t> first;
  // The clock goes with the pairs; from the third on the drawing thread hangs.
  Stepped see([&](const Guidance& guidance) {
    if (++pair == 3) {
      EXPECT_TRUE(wait_until([&] { return sink.hanging.load(); }));
    }
    if (guidance.status.stalled == Part::kRenderer && named++ == 0) {
      first = static_cast<std::size_t>(pair - 1);
    }
    sink.let_go = sink.let_go || named >= 3;
  });
  const auto report = run(headset, &see);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  const auto frames = seen.frames();
  ASSERT_TRUE(first.has_value());
  ASSERT_GT(frames.size(), *first);
  EXPECT_TRUE(frames[*first].holograms.empty());
  EXPECT_GE(report.stalls, 1);
}

TEST_F(WatchedLoop, APresenterThatHangsByItselfIsNamedToo) {
  fake::FakeHeadset headset(pairs(3));
  sink.hangs_by_itself = true;
  std::vector<std::optional<Part>> stalled;
  Stepped see([&](const Guidance& guidance) { stalled.push_back(guidance.status.stalled); });
  const auto report = run(headset, &see);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  ASSERT_FALSE(stalled.empty());
  EXPECT_EQ(stalled.front(), Part::kRenderer);
}

TEST_F(WatchedLoop, NothingIsNamedWhileAllGoWell) {
  fake::FakeHeadset headset(pairs(40));
  const auto report = run(headset);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.stalls, 0);
  EXPECT_TRUE(sink.stalls().empty());
  EXPECT_TRUE(shows_triangle(seen.frames().at(39)));
}

TEST_F(WatchedLoop, WhoeverDiesOnTheTrackingThreadIsNamedAndNothingIsGuided) {
  fake::FakeHeadset inner(pairs(9));
  Stepped dies([steps = 0](const Guidance&) mutable {
    if (++steps == 4) {
      throw std::bad_alloc();
    }
  });
  const auto report = run(inner, &dies);
  ASSERT_FALSE(report.ended.ok());
  EXPECT_EQ(report.ended.error().message, "tracker: out of memory");
  const auto frames = seen.frames();
  ASSERT_EQ(frames.size(), 4u) << "three pairs, and one that takes back";
  EXPECT_TRUE(frames.back().holograms.empty());

  fake::FakeHeadset other(pairs(9));
  EventfulHeadset camera(other, {3, [] { throw std::runtime_error("driver"); }});
  const auto of_camera = run(camera);
  ASSERT_FALSE(of_camera.ended.ok());
  EXPECT_EQ(of_camera.ended.error().message, "camera: ended by an exception: driver");
  EXPECT_TRUE(seen.frames().back().holograms.empty());
}

TEST_F(WatchedLoop, ASimulationDoesNotDependOnHowFastItIsDrawn) {
  options.real_time = false;
  options.draw_every = 15;
  fake::FakeHeadset headset(pairs(60));
  sink.hangs_at = 0;
  // While the first picture is drawn, tracking goes on for 0.7 s of the simulated clock.
  Stepped goes_on([&, steps = 0](const Guidance&) mutable {
    // The first pair is handed over for drawing once it was stepped.
    if (steps == 1) {
      EXPECT_TRUE(wait_until([&] { return sink.hanging.load(); }));
    }
    headset.manual_clock().advance(kStallAfter / 10);
    if (++steps == 20) {
      sink.let_go = true;
    }
  });
  const auto report = run(headset, &goes_on);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.stalls, 0);
  EXPECT_EQ(report.displayed, 60);
}

TEST_F(WatchedLoop, ARendererThatDiesEndsTheRunInOrder) {
  for (const bool waits : {false, true}) {
    options.real_time = !waits;
    fake::FakeHeadset headset(pairs(500));
    sink.dies_at = 0;
    const auto report = run(headset);
    ASSERT_FALSE(report.ended.ok()) << waits;
    EXPECT_EQ(report.ended.error().message, "renderer: ended by an exception: driver");
    EXPECT_TRUE(seen.frames().back().holograms.empty());
  }
}

}  // namespace
}  // namespace orthonav::engine::watchdog_test
