// Tracks the tools of a recording and prints where they are, once a second.
//   track_recording FOLDER [TOOLS]      TOOLS: their definitions, default the recording's own
#include <orthonav/engine/case/tool_file.h>
#include <orthonav/hal/replay/replay_headset.h>
#include <orthonav/nav/tracking/tool_tracker.h>

#include "must.h"

using namespace orthonav;

void print(const nav::ToolGeometry& tool, const nav::TrackedPose& pose) {
  if (pose.status == PoseStatus::kLost) {
    std::printf("  %s is lost\n", tool.name.c_str());
    return;
  }
  const Point<World> tip = pose.value * tool.tip_in_marker;
  std::printf("  %s %s, tip at %.1f %.1f %.1f mm, SD of its tag %.2f mm\n", tool.name.c_str(),
              pose.status == PoseStatus::kMeasured ? "measured" : "predicted", tip.v.x * 1e3,
              tip.v.y * 1e3, tip.v.z * 1e3, translation_sigma_m(pose.covariance) * 1e3);
}

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("track_recording FOLDER [TOOLS]\n", stderr);
    return 2;
  }
  const std::string folder = argv[1];
  const auto headset = must(replay::ReplayHeadset::open(folder));
  StereoCamera& cameras = *headset->cameras();
  const auto tracker = must(nav::create_photometric_tracker(
      cameras.calibration(),
      must(engine::load_tools(argc > 2 ? argv[2] : folder + "/tools.json"))));
  StereoFrame frame;
  double next_s = 0.0;
  int pairs = 0;
  for (;;) {
    auto next = cameras.next(frame);
    if (!next && frame.repeats) {
      continue;  // an old picture under a new time
    }
    if (must(std::move(next)) != Next::kFrame) {
      break;
    }
    ++pairs;
    const auto states = tracker->track(frame);
    const double time_s = seconds(frame.time.time_since_epoch());
    if (time_s < next_s) {
      continue;
    }
    next_s = time_s + 1.0;
    std::printf("%.2f s\n", time_s);
    for (const nav::ToolState& state : states) {
      print(tracker->tools()[state.tool], state.world_from_marker);
    }
  }
  std::printf("%d pairs\n", pairs);
}
