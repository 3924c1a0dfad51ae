#include <benchmark/benchmark.h>

#include <cstdlib>

#include "nav/published/corner_tracker.h"
#include "nav/tracking/tool_tracker.h"
#include "tests/support/tag_scene.h"

// What tracking two tools through a stereo pair costs: whole images or boxes, one thread or two.
namespace orthonav::nav {
namespace {

constexpr int kPairs = 10;

std::vector<StereoFrame> frames_of(const StereoCalibration& calibration) {
  std::vector<StereoFrame> frames;
  for (int k = 0; k < kPairs; ++k) {
    frames.push_back(test::stereo_frame(
        calibration,
        {{"tag36h11", 3, 0.05, test::facing({0.001 * k, 0.04, 0.0}, {0.3, -0.3, 0.2})},
         {"tag36h11", 5, 0.07, test::facing({-0.05, -0.06, 0.05}, {-0.2, 0.3, 1.6})}},
        {}));
  }
  return frames;
}

std::vector<ToolGeometry> two_tools() {
  std::vector<ToolGeometry> tools = {{"pointer", ToolRole::kPointer, {"tag36h11", 3, 0.05}, {}, {}},
                                     {"guide", ToolRole::kGuide, {"tag36h11", 5, 0.07}, {}, {}}};
  for (ToolGeometry& tool : tools) {
    tool.axis_in_marker = {{0, 1, 0}};
  }
  return tools;
}

/// Arguments: full_search_interval, two threads or one.
void track_pair(benchmark::State& bench) {
  const StereoCalibration calibration = test::test_calibration();
  std::vector<StereoFrame> frames = frames_of(calibration);
  TrackerOptions options;
  options.full_search_interval = static_cast<int>(bench.range(0));
  options.parallel = bench.range(1) != 0;
  auto tracker = published::create_corner_tracker(calibration, two_tools(), options);
  if (!tracker) {
    std::abort();
  }
  int k = 0;
  std::int64_t measured = 0;
  for (auto _ : bench) {
    // There and back, so that the tools never jump.
    const int place = k % (2 * kPairs) < kPairs ? k % kPairs : kPairs - 1 - k % kPairs;
    StereoFrame& frame = frames[static_cast<std::size_t>(place)];
    frame.time = Timestamp(std::chrono::milliseconds(33 * k++));
    for (const ToolState& state : (*tracker)->track(frame)) {
      measured += state.world_from_marker.status == PoseStatus::kMeasured ? 1 : 0;
    }
  }
  bench.counters["measured_a_pair"] = static_cast<double>(measured) / static_cast<double>(k);
}
BENCHMARK(track_pair)
    ->ArgNames({"full_search_every", "two_threads"})
    ->ArgsProduct({{1, 10}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace orthonav::nav

BENCHMARK_MAIN();
