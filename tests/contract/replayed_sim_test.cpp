#include <gtest/gtest.h>

#include "hal/open/open.h"
#include "hal/replay/recorder.h"
#include "tests/support/session_log.h"
#include "tests/support/temporary_folder.h"

namespace orthonav {
namespace {

TEST(SimulatedSession, ReplaysToTheBit) {
  const orthonav::test::TemporaryFolder folder;
  OpenOptions options;
  options.sim.limit_s = 0.5;
  auto sim = open_headset("sim:?seed=4", options);
  ASSERT_TRUE(sim.ok()) << sim.error().message;
  const StereoCalibration calibration = (*sim)->cameras()->calibration();
  auto recorder = replay::RecordingHeadset::create(*std::move(sim), folder / "session");
  ASSERT_TRUE(recorder.ok()) << recorder.error().message;
  const auto live = orthonav::test::play(**recorder);
  ASSERT_TRUE((*recorder)->close().ok());
  ASSERT_GE(live.moments.size(), 10u);
  auto replayed = open_headset("replay:" + (folder / "session").string());
  ASSERT_TRUE(replayed.ok()) << replayed.error().message;
  orthonav::test::expect_same((*replayed)->cameras()->calibration(), calibration);
  orthonav::test::expect_same(orthonav::test::play(**replayed), live);
}

}  // namespace
}  // namespace orthonav
