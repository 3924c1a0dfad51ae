// What `run --stats` reports about the display.
#include <gtest/gtest.h>

#include "base/stopwatch.h"
#include "tests/hal/openxr/runtime_test.h"
#include "tests/hal/openxr/status_scene.h"

namespace orthonav::test::timing_test {
namespace {

using TimingTest = RuntimeTest;

TEST_F(TimingTest, KeepsAccountOfLateAndMissedFrames) {
  RuntimeTraits traits;
  traits.period_ns = 12'500'000;
  runtime().reset(traits);
  open();
  ASSERT_TRUE(present().ok());
  ASSERT_TRUE(show(scene_that_says("digitize L4")).ok());
  ASSERT_TRUE(eventually([&] { return count_drawn() >= 3; }));
  runtime().skip(4);
  ASSERT_TRUE(frames_pass(3));
  // A frame is due three periods after it was begun; this one takes longer.
  hold_ = true;
  ASSERT_TRUE(eventually([&] { return held_.load(); }));
  const Stopwatch held;
  ASSERT_TRUE(eventually([&] { return held.elapsed() > std::chrono::milliseconds(50); }));
  hold_ = false;
  ASSERT_TRUE(frames_pass(3));
  const engine::PresentReport report = presenter_->stop();
  EXPECT_EQ(report.missed, 4);
  EXPECT_GE(report.late, 1);
  EXPECT_EQ(report.period, Duration(traits.period_ns));
  EXPECT_EQ(report.wait_ms.count(), report.frames);
  EXPECT_EQ(report.submit_ms.count(), report.frames);
}

}  // namespace
}  // namespace orthonav::test::timing_test
