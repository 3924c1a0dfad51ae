#include <gtest/gtest.h>

#include "base/stopwatch.h"
#include "hal/api/depth_camera.h"
#include "hal/replay/recorder.h"
#include "hal/replay/replay_headset.h"
#include "tests/hal/hl2ss/served_room.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::hl2ss {
namespace {

using orthonav::test::next_pair;
using orthonav::test::ServedRoom;
using orthonav::test::TemporaryFolder;
using orthonav::test::wait_until;

constexpr std::size_t kEnough = 2;

/// What the headset's one depth camera shows while its pairs are taken. Each pair waits a moment
/// for the first pictures: a connection that is slower than the pairs would bring none.
std::vector<DepthFrame> depth_of_session(Headset& headset) {
  constexpr auto kMoment = std::chrono::milliseconds(40);
  std::vector<DepthFrame> frames;
  StereoFrame pair;
  DepthFrame frame;
  while (next_pair(headset, pair) == Next::kFrame) {
    const Stopwatch waited;
    (void)wait_until([&] {
      for (auto next = headset.depth_cameras().front()->next(frame); next && *next == Next::kFrame;
           next = headset.depth_cameras().front()->next(frame)) {
        frames.push_back(frame);
      }
      return frames.size() >= kEnough || waited.elapsed() > kMoment;
    });
  }
  return frames;
}

/// A stream that came over the network, recorded and replayed: the same pictures, times and poses.
void expect_recorded(const DepthWish& wish, double limit_s) {
  sim::SimOptions sim;
  sim.seed = 5;
  sim.render = false;
  sim.limit_s = limit_s;
  sim.depth = {wish.stream};
  ServerOptions server;
  server.paced = true;
  ServedRoom room(sim, server);
  Hl2ssOptions options = room.client_options();
  options.depth = wish;
  const auto headset = Hl2ssHeadset::open(options);
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  const TemporaryFolder folder;
  auto recorder = replay::RecordingHeadset::around(**headset, folder / "session");
  ASSERT_TRUE(recorder.ok()) << recorder.error().message;
  const auto live = depth_of_session(**recorder);
  ASSERT_GE(live.size(), kEnough);
  ASSERT_TRUE((*recorder)->close().ok()) << (*recorder)->close().error().message;

  const auto replayed = replay::ReplayHeadset::open(folder / "session");
  ASSERT_TRUE(replayed.ok()) << replayed.error().message;
  ASSERT_EQ((*replayed)->depth_cameras().size(), 1u);
  EXPECT_EQ((*replayed)->depth_cameras().front()->calibration().rays,
            (*headset)->depth_cameras().front()->calibration().rays);
  const auto again = depth_of_session(**replayed);
  ASSERT_EQ(again.size(), live.size());
  for (std::size_t i = 0; i < live.size(); ++i) {
    EXPECT_EQ(again[i].time, live[i].time);
    EXPECT_EQ(again[i].map_epoch, live[i].map_epoch);
    EXPECT_TRUE(again[i].range_mm == live[i].range_mm);
    EXPECT_TRUE(again[i].brightness == live[i].brightness);
    ASSERT_EQ(again[i].world_from_rig.has_value(), live[i].world_from_rig.has_value());
    if (live[i].world_from_rig) {
      EXPECT_LT(
          (again[i].world_from_rig->translation() - live[i].world_from_rig->translation()).norm(),
          1e-12);
    }
  }
}

TEST(DepthRecorded, OfAhatComesBack) {
  expect_recorded({DepthStream::kAhat, DepthCoding::kRaw}, 0.4);
}

TEST(DepthRecorded, OfLongThrowComesBack) {
  expect_recorded({DepthStream::kLongThrow, DepthCoding::kPng}, 1.2);
}

}  // namespace
}  // namespace orthonav::hl2ss
