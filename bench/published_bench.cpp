// How often the published registration (nav/published) is right, over every vertebra at hand and
// ways of stroking: bare bone and strokes that lie above it, each with the tracker's noise.
//   bench_published [SEEDS]        default 4
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/random.h"
#include "bench/wilson.h"
#include "hal/sim/surgeon/stroke_plan.h"
#include "nav/published/registration.h"
#include "nav/registration/registration.h"
#include "tests/support/registration_builder.h"

using namespace orthonav;

namespace {

/// Points of a registration (the publication's had 1,983 ± 404) and their noise along each axis.
constexpr double kPoints = 2000.0;
constexpr double kNoise_m = 0.0005;
/// At the worst entry or target. Beyond the second limit the bone lies in another place.
constexpr double kRight_m = 0.002;
constexpr double kNear_m = 0.006;

struct Way {
  const char* name;
  sim::Exposure exposure;
  double lift_m;   ///< of the tip above the bone
  double short_m;  ///< careless: each transverse process is left up to this far before its tip
};
constexpr std::array<Way, 5> kWays = {{
    {"trained pattern", sim::Exposure::kTrainedPattern, 0.0, 0.0},
    {"trained, 1.5 mm above the bone", sim::Exposure::kTrainedPattern, 0.0015, 0.0},
    {"careless, up to 12 mm short", sim::Exposure::kTrainedPattern, 0.0, 0.012},
    {"lines over all, processes included", sim::Exposure::kTransverseProcesses, 0.0, 0.0},
    {"laminae alone", sim::Exposure::kLaminae, 0.0, 0.0},
}};

std::vector<Point<World>> digitized(const std::vector<sim::StrokeRegion>& regions, const Way& way,
                                    Random& random) {
  double length_m = 0.0;
  double right_m = 1.0;
  double left_m = -1.0;
  for (const sim::StrokeRegion& region : regions) {
    length_m += region.length_m();
    for (const sim::Stroke& stroke : region.strokes) {
      for (const sim::BoneSpot& spot : stroke.spots) {
        right_m = std::min(right_m, spot.point.x);
        left_m = std::max(left_m, spot.point.x);
      }
    }
  }
  right_m += way.short_m * random.uniform();
  left_m -= way.short_m * random.uniform();
  std::vector<Point<World>> points;
  for (const sim::StrokeRegion& region : regions) {
    for (const sim::Stroke& stroke : region.strokes) {
      const int count = std::max(2, static_cast<int>(kPoints * stroke.length_m() / length_m));
      for (int i = 0; i < count; ++i) {
        const sim::BoneSpot spot = stroke.at(stroke.length_m() * i / (count - 1));
        const Vec3 noise = kNoise_m * Vec3{random.normal(), random.normal(), random.normal()};
        if (spot.point.x >= right_m && spot.point.x <= left_m) {
          points.push_back({spot.point + way.lift_m * spot.normal + noise});
        }
      }
    }
  }
  return points;
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 4;
  const auto levels = test::anatomy_levels();
  std::printf(
      "The published registration on %zu vertebrae, %d seeds each: noise of %.1f mm along each "
      "axis, "
      "bare bone unless stated. Right: within %.0f mm at the worst entry or target.\n\n"
      "| strokes | n | right | 95 %% | %.0f-%.0f mm | beyond | not right on "
      "|\n|---|---|---|---|---|---|"
      "---|\n",
      levels.size(), seeds, kNoise_m * 1e3, kRight_m * 1e3, kRight_m * 1e3, kNear_m * 1e3);
  std::vector<std::shared_ptr<const nav::VertebraModel>> models;
  for (const test::AnatomyLevel& level : levels) {
    models.push_back(nav::VertebraModel::prepare(level.mesh).value());
  }
  for (const Way& way : kWays) {
    int n = 0;
    int right = 0;
    int near = 0;
    std::string others;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const sim::RoomLevel bone{
          levels[i].name, levels[i].mesh.vertices_m, levels[i].mesh.triangles, {}};
      const auto regions = sim::plan_strokes(bone, way.exposure);
      int wrong = 0;
      for (int seed = 1; seed <= seeds; ++seed, ++n) {
        Random random(static_cast<std::uint64_t>(seed));
        const auto points = digitized(regions, way, random);
        const auto found = nav::published::register_points(models[i]->reachable(),
                                                           models[i]->reachable_surface(), points);
        const double error_m =
            found ? test::worst_screw_error_m(levels[i], (*found)[0].world_from_vertebra, {}) : 1.0;
        right += error_m <= kRight_m ? 1 : 0;
        near += error_m > kRight_m && error_m <= kNear_m ? 1 : 0;
        wrong += error_m > kRight_m ? 1 : 0;
      }
      if (wrong > 0) {
        others += (others.empty() ? "" : ", ") + levels[i].name + " " + std::to_string(wrong);
      }
    }
    const auto interval = wilson(right, static_cast<std::size_t>(n));
    std::printf("| %s | %d | %d | %.0f-%.0f %% | %d | %d | %s |\n", way.name, n, right,
                1e2 * interval.low, 1e2 * interval.high, near, n - right - near, others.c_str());
  }
}
