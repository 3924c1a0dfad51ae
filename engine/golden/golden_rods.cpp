#include <utility>

#include "base/angle.h"
#include "engine/golden/golden_stage.h"
#include "engine/holograms/render_values.h"
#include "engine/holograms/rod_in_hand_hologram.h"

namespace orthonav::engine::golden {
namespace {

constexpr double kRodLength_m = 0.118;

/// Instructions of which the first `made` bends are made.
nav::RodInstructions instructed(std::size_t made) {
  nav::RodInstructions told;
  told.bends = {{{0.031, 0.020, 14.2 * kRadiansPerDegree, 0.0}, 19.3 * kRadiansPerDegree, 0},
                {{0.073, 0.020, 12.6 * kRadiansPerDegree, 40.0 * kRadiansPerDegree},
                 17.5 * kRadiansPerDegree,
                 1}};
  told.made = made;
  told.fit.length_m = kRodLength_m;
  return told;
}

/// A rod on the table, as wide as a headset sees it.
GoldenScene in_hand(const std::string& name, const std::string& what, std::size_t made,
                    double length_m, float look_at_x_m) {
  GoldenScene golden = start_wide(name, what, close_view({look_at_x_m, 0.045f, 0.0f}));
  for (render::View& view : golden.views) {
    view.tan_left = view.tan_right = 0.360f;
    view.tan_up = view.tan_down = 0.234f;
  }
  // From right to left as the surgeon looks at it. Its drawn line points up, away from the table.
  const Mat3 world_from_rod = Mat3::from_columns({0, 1, 0}, {0, 0, 1}, {1, 0, 0});
  LyingRod rod = lying_rod(instructed(made), world_from_rod,
                           {0.020 - 0.5 * kRodLength_m, 0.040, 0.0}, length_m);
  rod.diameter_m = 0.0055;
  add_rod_in_hand(golden.scene, rod, tube_of(rod));
  golden.covered.push_back({kRodInHandLabel, to_float3(rod.axis.front().v)});
  golden.covered.push_back({kRodInHandLabel, to_float3(rod.axis.back().v)});
  return golden;
}

}  // namespace

void add_rod_scenes(std::vector<GoldenScene>& scenes) {
  scenes.push_back(in_hand("h10_in_hand",
                           "outline of a rod with one bend; where and how to make the second", 1,
                           kRodLength_m, 0.020f));
  scenes.push_back(
      in_hand("h10_in_hand_straight",
              "outline of a straight rod that is too long; where to cut and to bend it", 0, 0.145,
              -0.020f));
  scenes.push_back(in_hand("h10_in_hand_done", "outline of a rod with both bends, nothing to do", 2,
                           kRodLength_m, 0.020f));
}

}  // namespace orthonav::engine::golden
