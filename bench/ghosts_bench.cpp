// Pairs of images full of texture but without tools, and the tools that the trackers claim to see
// in them. Each claim is a ghost; there must be none.
//   bench_ghosts [IMAGES]     20,000 by default, half of them left, half right
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "base/random.h"
#include "hal/sim/cameras/hololens2.h"
#include "nav/published/corner_tracker.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::bench {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
/// The right image is the left one shifted, as for near things, so that what fits in one fits in
/// the other.
constexpr int kOffset_px = 60;

/// Smooth noise of one scale, added.
void add_clouds(Random& random, int cell_px, double strength, std::vector<float>& grey, int width) {
  const int columns = width / cell_px + 2;
  const int rows = kHeight / cell_px + 2;
  std::vector<float> lattice(static_cast<std::size_t>(columns * rows));
  for (float& v : lattice) {
    v = static_cast<float>(random.uniform(-strength, strength));
  }
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < width; ++x) {
      const int i = x / cell_px;
      const int j = y / cell_px;
      const float s = static_cast<float>(x % cell_px) / static_cast<float>(cell_px);
      const float t = static_cast<float>(y % cell_px) / static_cast<float>(cell_px);
      const float* top = lattice.data() + j * columns + i;
      const float* low = top + columns;
      grey[static_cast<std::size_t>(y * width + x)] +=
          (1 - t) * ((1 - s) * top[0] + s * top[1]) + t * ((1 - s) * low[0] + s * low[1]);
    }
  }
}

/// Dark squares full of black and white cells, which look like tags from afar.
void add_boards(Random& random, std::vector<float>& grey, int width) {
  for (int board = 0; board < 6; ++board) {
    const double cell = random.uniform(3.0, 8.0);
    const double angle_rad = random.uniform(0.0, 6.3);
    const double cx = random.uniform(40.0, width - 40.0);
    const double cy = random.uniform(40.0, kHeight - 40.0);
    std::vector<bool> white(100);
    for (std::size_t i = 0; i < 100; ++i) {
      const std::size_t ring = std::min({i / 10, i % 10, 9 - i / 10, 9 - i % 10});
      white[i] = ring == 0 || (ring > 1 && random.uniform() < 0.5);
    }
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < width; ++x) {
        const double u =
            (std::cos(angle_rad) * (x - cx) + std::sin(angle_rad) * (y - cy)) / cell + 5.0;
        const double v =
            (-std::sin(angle_rad) * (x - cx) + std::cos(angle_rad) * (y - cy)) / cell + 5.0;
        if (!(u >= 0.0 && v >= 0.0 && u < 10.0 && v < 10.0)) {
          continue;
        }
        const auto i = static_cast<std::size_t>(static_cast<int>(v) * 10 + static_cast<int>(u));
        grey[static_cast<std::size_t>(y * width + x)] = white[i] ? 90.0F : -90.0F;
      }
    }
  }
}

void make_pair(std::uint64_t seed, StereoFrame& frame) {
  Random random(seed);
  const int width = kWidth + kOffset_px;
  std::vector<float> grey(static_cast<std::size_t>(width * kHeight), 0.0F);
  for (const int cell : {64, 24, 9, 4}) {
    add_clouds(random, cell, 45.0, grey, width);
  }
  if (seed % 2 == 0) {
    add_boards(random, grey, width);
  }
  frame.left = GreyImage(kWidth, kHeight);
  frame.right = GreyImage(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto at = [&](int column) {
        const double noisy =
            static_cast<double>(grey[static_cast<std::size_t>(y * width + column)]);
        return static_cast<std::uint8_t>(
            std::clamp(120.0 + noisy + random.normal(0.0, 3.0), 0.0, 255.0));
      };
      frame.left.at(x, y) = at(x);
      // The right camera is mounted turned by 180°.
      frame.right.at(kWidth - 1 - x, kHeight - 1 - y) = at(x + kOffset_px);
    }
  }
}

std::unique_ptr<nav::ToolTracker> created(auto create) {
  std::vector<nav::ToolGeometry> tools;
  for (int id = 0; id < 8; ++id) {
    nav::ToolGeometry tool;
    tool.name = "tool " + std::to_string(id);
    tool.marker = {"tag36h11", id, 0.04};
    tools.push_back(tool);
  }
  auto made = create(sim::hololens2_calibration(), tools, nav::TrackerOptions{});
  if (!made) {
    std::fprintf(stderr, "%s\n", made.error().message.c_str());
    std::exit(2);
  }
  return std::move(*made);
}

}  // namespace
}  // namespace orthonav::bench

int main(int argc, char** argv) {
  using namespace orthonav;
  using namespace orthonav::bench;
  const int pairs = std::max((argc > 1 ? std::atoi(argv[1]) : 20000) / 2, 1);
  const auto best = created(nav::create_photometric_tracker);
  const auto paper = created(nav::published::create_corner_tracker);
  int best_ghosts = 0;
  int paper_ghosts = 0;
  StereoFrame frame;
  for (int k = 0; k < pairs; ++k) {
    make_pair(static_cast<std::uint64_t>(k) + 1, frame);
    frame.sequence = k;
    frame.time = Timestamp(std::chrono::milliseconds(33 * (k + 1)));
    frame.world_from_rig = Transform<World, Rig>{};
    const auto count = [&](nav::ToolTracker& tracker) {
      int seen = 0;
      for (const nav::ToolState& state : tracker.track(frame)) {
        seen += state.world_from_marker.status == PoseStatus::kMeasured ? 1 : 0;
      }
      return seen;
    };
    best_ghosts += count(*best);
    paper_ghosts += count(*paper);
  }
  std::printf("%d images of texture, 8 tools: ghosts of best %d, of paper %d\n", 2 * pairs,
              best_ghosts, paper_ghosts);
  return best_ghosts > 0 ? 1 : 0;
}
