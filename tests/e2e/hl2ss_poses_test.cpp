#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>

#include "engine/case/tool_file.h"
#include "hal/api/as_headset.h"
#include "hal/hl2ss/hl2ss_headset.h"
#include "hal/hl2ss/server/server.h"
#include "hal/sim/sim_headset.h"
#include "nav/tracking/tool_tracker.h"
#include "tests/support/wait_until.h"

namespace orthonav::engine::hl2ss_poses_test {
namespace {

/// A table with the built-in pointer and guide hovering over it, for a second.
sim::RoomDescription table() {
  sim::RoomDescription room;
  for (const nav::ToolGeometry& tool : built_in_tools()) {
    sim::RoomTool there;
    there.name = tool.name;
    there.kind =
        tool.role == nav::ToolRole::kGuide ? sim::ToolKind::kGuide : sim::ToolKind::kPointer;
    there.id = tool.marker.id;
    there.size_m = tool.marker.size_m;
    there.tip_in_marker = tool.tip_in_marker;
    room.tools.push_back(there);
  }
  return room;
}

struct Apart {
  int poses = 0;
  double worst_m = 0.0;
  double worst_deg = 0.0;
};

/// Tracks the same second directly and over TCP; returns the largest differences of the tools'
/// poses.
Apart compare(hl2ss::VideoProfile profile, const sim::ErrorModel& error_model = {}) {
  sim::SimOptions sim;
  sim.error_model = error_model;
  sim.seed = 9;
  sim.limit_s = 1.0;
  hl2ss::ServerOptions options;
  options.first_port = 0;
  options.paced = true;
  const auto open = [sim] { return as_headset(sim::SimHeadset::open(table(), sim)); };
  const auto server = hl2ss::Server::start(options, open);
  auto direct = open();
  EXPECT_TRUE(server.ok() && direct.ok());
  hl2ss::Hl2ssOptions client = (*server)->client_options();
  client.profile = profile;
  auto headset = hl2ss::Hl2ssHeadset::open(client);
  EXPECT_TRUE(headset.ok()) << headset.error().message;
  if (!headset) {
    return {};
  }
  auto here =
      nav::create_photometric_tracker((*direct)->cameras()->calibration(), built_in_tools());
  auto there =
      nav::create_photometric_tracker((*headset)->cameras()->calibration(), built_in_tools());
  EXPECT_TRUE(here.ok() && there.ok());
  StereoFrame frame;
  StereoFrame expected;
  Apart apart;
  const auto next_pair = [&] {
    Result<Next> next = Next::kNone;
    EXPECT_TRUE(test::wait_until([&] {
      next = (*headset)->cameras()->next(frame);
      return next && *next != Next::kNone;
    }));
    return next && *next == Next::kFrame;
  };
  while (next_pair()) {
    EXPECT_TRUE((*direct)->cameras()->next(expected).ok());
    EXPECT_EQ(frame.time, expected.time);
    const auto a = (*there)->track(frame);
    const auto b = (*here)->track(expected);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const auto& x = a[i].world_from_marker;
      const auto& y = b[i].world_from_marker;
      if (x.status != PoseStatus::kMeasured || y.status != PoseStatus::kMeasured) {
        continue;
      }
      ++apart.poses;
      apart.worst_m =
          std::max(apart.worst_m, (x.value.translation() - y.value.translation()).norm());
      apart.worst_deg =
          std::max(apart.worst_deg, rotation_angle_rad(x.value.rotation(), y.value.rotation()) *
                                        180.0 / std::numbers::pi);
    }
  }
  return apart;
}

TEST(PosesOverTcp, RawAreThoseOfTheDirectRun) {
  // Calibration and head pose in single precision: 1e-7 of a metre and of a focal length.
  const Apart apart = compare(hl2ss::VideoProfile::kRaw);
  EXPECT_GE(apart.poses, 40);
  EXPECT_LT(apart.worst_m, 0.00001);
  EXPECT_LT(apart.worst_deg, 0.005);
}

TEST(PosesOverTcp, H264AreThoseOfTheDirectRunWithinTheCodecsNoise) {
  // Only the codec is bounded here: bent and glossy tags under flickering light amplify its noise
  // (up to 1.5 mm and 1°).
  sim::ErrorModel plain;
  plain.tag_bow_m = 0.0;
  plain.tag_gloss = 0.0;
  plain.light_flicker = 0.0;
  const Apart apart = compare(hl2ss::VideoProfile::kH264Base, plain);
  EXPECT_GE(apart.poses, 40);
  EXPECT_LT(apart.worst_m, 0.001);
  EXPECT_LT(apart.worst_deg, 0.5);
  EXPECT_GT(apart.worst_m, 0.00001) << "the codec leaves something: the twin of the test above";
}

}  // namespace
}  // namespace orthonav::engine::hl2ss_poses_test
